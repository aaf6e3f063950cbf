/** The first page: three questions, each with what answers it in motion, and what was open last. */
import { html } from "../../vendor/preact.js";
import { about } from "../api.js";
import { address, go } from "../state.js";
import { inWords } from "../symbols.js";
import { lastOpened } from "../visited.js";

/** Slanted threads and teeth, as many as make one turn of the picture. */
const THREADS = Array.from({ length: 14 }, (_, n) => 16 * n - 32);
const TEETH = Array.from({ length: 24 }, (_, n) => 15 * n);

const Gear = () => html`<svg viewBox="0 0 240 150" aria-hidden="true">
  <g class="turns slow" ><circle class="outline" cx="120" cy="60" r="42" />
    ${TEETH.map((at) => html`<path class="tooth" transform=${`rotate(${at} 120 60)`} d="M116 18l2 -8h4l2 8" />`)}
    ${[0, 60, 120].map((at) => html`<path class="spoke" transform=${`rotate(${at} 120 60)`} d="M120 18V102" />`)}
    <circle class="outline" cx="120" cy="60" r="9" /></g>
  <clipPath id="worm"><rect x="40" y="108" width="160" height="32" rx="4" /></clipPath>
  <rect class="worm" x="40" y="108" width="160" height="32" rx="4" />
  <g clip-path="url(#worm)"><g class="runs-on">${THREADS.map((x) => html`
    <path class="thread" d=${`M${x + 40} 142l10 -36`} />`)}</g></g>
  <path class="shaft" d="M12 124H40M200 124H228" /></svg>`;

const Body = () => html`<svg viewBox="0 0 240 150" aria-hidden="true">
  <g class="shakes"><rect class="plate" x="-20" y="100" width="280" height="60" />
    ${[20, 60, 100, 140, 180, 220].map((x) => html`<path class="mark" d=${`M${x} 116v12M${x - 6} 122h12`} />`)}</g>
  <rect class="block" x="80" y="52" width="80" height="40" rx="5" />
  <path class="spring" d="M160 72h8l4 -6l7 12l7 -12l7 12l4 -6h22" />
  <g class="bends">${[88, 104, 120, 136, 152].map((x) => html`<path class="bristle" d=${`M${x} 92l-3 9`} />`)}</g>
  <path class="friction" d="M120 72H64m9 -5l-9 5l9 5" /></svg>`;

const Rig = () => html`<svg viewBox="0 0 240 150" aria-hidden="true">
  <g class="turns"><circle class="outline" cx="66" cy="52" r="38" /><path class="spoke" d="M66 14V90M28 52H104" /></g>
  <g class="turns back"><circle class="outline" cx="142" cy="52" r="38" />
    <path class="spoke" d="M142 14V90M104 52H180" /></g>
  <path class="axis" d="M20 140H224" />
  <path class="trace" pathLength="1" d="M20 112l8 2l7 -3l8 2l9 -1l8 2l8 -3l9 2l8 0l7 14l8 -1l8 2l8 -2l9 1
    l8 2l8 -3l7 2l8 1l8 -2l9 1l8 -1l8 2l8 -2" />
  <text x="190" y="60">torque</text></svg>`;

const QUESTIONS = [
  { ask: "Does my gear hold?", says: "A worm gear rated by three standards: what fails first, and what mends it.",
    screen: "gear", picture: Gear,
    more: [["size", "begin with ratio and torque"], ["flanks", "see it mesh"], ["drive", "shake it"]] },
  { ask: "Which way do I shake it?", says: "A body pulled over a shaken plate: how much easier it goes, and why.",
    screen: "slide", picture: Body, more: [["sweep", "over a grid"], ["block", "as an elastic body"]] },
  { ask: "What did my rig measure?", says: "From a recording to numbers with intervals, and to a friction law.",
    screen: "rig", picture: Rig, more: [["thesis", "what a thesis found"]] },
];

const Link = ({ screen, children, name }) => html`<a href=${`#/${screen}`} class=${name}
  onClick=${(event) => {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    go(screen);
  }}>${children}</a>`;

/** Screens whose cases are handed out here, by the kind of case that they open, which is their name. */
const KINDS = [["gear", "Worm gearsets"], ["drive", "Gearsets, shaken"], ["slide", "Bodies, shaken"],
  ["block", "Elastic blocks"], ["rig", "Rigs"]];
/** So many of a kind. */
const SHOWN = 3;

/** Cases to begin with, of the folder first; each opens on its screen. */
function Begin() {
  const groups = KINDS.map(([screen, said]) => ({ screen, said, cases: (about.value?.cases ?? [])
    .filter(({ kind }) => kind === screen).toSorted((one, other) => Number(one.shipped) - Number(other.shipped)) }));
  const some = groups.filter(({ cases }) => cases.length);
  return some.length ? html`<section class="panel" aria-label="begin with a case"><h2>Begin with a case</h2>
    <div class="begin">${some.map(({ screen, said, cases }) => html`<div key=${screen}><h3>${said}</h3>
      <ul class="plain">${cases.slice(0, SHOWN).map(({ name, alias, title }) => html`<li key=${name}>
        <a href=${address({ screen, params: { case: name } })}>${alias || name}</a>${" "}
        <span class="says">${inWords(title)}</span></li>`)}</ul></div>`)}</div></section>` : null;
}

export function view() {
  const last = lastOpened();
  return html`<h1>What would you like to know?</h1>
    <div class="questions">${QUESTIONS.map(({ ask, says, screen, picture: Picture, more }) => html`
      <section class="panel question" key=${screen} aria-label=${ask}>
        <${Link} screen=${screen} name="asks"><${Picture} /><h2>${ask}</h2><//>
        <p>${says}</p>
        <p class="row">${more.map(([to, said]) => html`<${Link} key=${to} screen=${to} name="also">${said}<//>`)}</p>
      </section>`)}</div>
    ${last.length ? html`<section class="panel" aria-label="open last"><h2>Open last</h2>
      <ul class="plain">${last.map(({ title, says, hash }) => html`<li key=${hash}>
        <a href=${hash}>${title}</a> <span class="says">${says}</span></li>`)}</ul></section>` : null}
    <${Begin} />`;
}
