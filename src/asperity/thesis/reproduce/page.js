// Search: shows claims, figures and tables whose text has all words, and claims of a verdict.
const form = document.querySelector(".search");
const items = [...document.querySelectorAll("article.claim, section figure, section .wide")];
const texts = items.map((item) => item.textContent.toLowerCase());
function search() {
  const words = form.words.value.toLowerCase().split(/\s+/).filter(Boolean);
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
