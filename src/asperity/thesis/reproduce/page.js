// Search: shows claims, figures and tables whose text has all words, and claims of a verdict.
const form = document.querySelector(".search");
const items = [...document.querySelectorAll("article.claim, section figure, section .wide")];
// A symbol is found as it is set, as it is written, σ_a, and by its letter's name, sigma_a.
const letters = {
  "α": "alpha", "β": "beta", "γ": "gamma", "δ": "delta", "ε": "epsilon", "ζ": "zeta", "η": "eta", "θ": "theta",
  "κ": "kappa", "λ": "lambda", "μ": "mu", "ν": "nu", "ξ": "xi", "π": "pi", "ρ": "rho", "σ": "sigma", "τ": "tau",
  "φ": "phi", "χ": "chi", "ψ": "psi", "ω": "omega",
};
// The sign of a micrometre is the letter mu too.
const plain = (text) => text.toLowerCase().replaceAll("\u00b5", "μ");
const texts = items.map((item) => {
  const written = item.cloneNode(true);
  written.querySelectorAll("sub").forEach((index) => index.prepend("_"));
  const set = plain(item.textContent), indexed = plain(written.textContent);
  return [set, indexed, indexed.replace(/[α-ω]/g, (letter) => letters[letter] || letter)].join(" ");
});
function search() {
  const words = plain(form.words.value).split(/\s+/).filter(Boolean);
  const verdict = form.verdict.value;
  let shown = 0;
  items.forEach((item, n) => {
    const fits = words.every((word) => texts[n].includes(word)) && (!verdict || item.dataset.verdict === verdict);
    item.hidden = !fits;
    shown += fits;
  });
  form.querySelector("[role=status]").textContent = words.length || verdict ? `${shown} of ${items.length}` : "";
}
if (items.length) {
  form.hidden = false;
  form.addEventListener("input", search);
  form.addEventListener("submit", (event) => event.preventDefault());
}
// What is folded away is printed too.
addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((one) => { one.open = true; }));
// A link to what is not shown shows it.
addEventListener("hashchange", () => {
  const there = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (there && there.hidden) { form.reset(); search(); there.scrollIntoView(); }
});
