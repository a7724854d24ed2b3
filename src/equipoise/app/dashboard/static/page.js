/**
 * The page's beginning: one store of what the server tells, views of it in the containers that
 * the shell makes, and `window.equipoise` for the shell's buttons and the tests.
 */

import { keepLinked, linkWords } from "./link.js";
import { showNumbers } from "./numbers.js";
import { Store } from "./store.js";
import { showStory } from "./story.js";

const WAIT_MS = 50;
const NO_LIBRARIES =
  "This part needs files of others that are not installed: run make where npm is found.";

const store = new Store();
const shown = { kind: "bench", span_s: 60, follow: true };
/** Views that have something to redraw when theme, units or span change. */
const views = [];
let link = "closed";
let sayLink = () => {};

/** @returns {Promise<HTMLElement>} the shell makes its elements after this script has run */
function present(id) {
  return new Promise((resolve) => {
    const look = () => {
      const place = document.getElementById(id);
      if (place) resolve(place);
      else setTimeout(look, WAIT_MS);
    };
    look();
  });
}

function add(view) {
  views.push(view);
  store.show(view);
}

function redraw() {
  for (const view of views) view.redraw?.();
}

function change(what) {
  Object.assign(shown, what);
  redraw();
}

/** Where a module's libraries are not installed, a sentence stands instead. */
async function showWithLibraries(id, module, start) {
  const place = await present(id);
  try {
    await import(module);
  } catch (error) {
    if (!(error instanceof TypeError)) throw error; // what browsers say of a missing file
    place.textContent = NO_LIBRARIES;
    return;
  }
  add(start(await import(module), place));
}

function state() {
  const series = {};
  for (const [name, kept] of store.series) series[name] = { rows: kept.rows, last: kept.last() };
  const { about, t, steps, frames } = store;
  return { clock: about?.clock ?? null, t, series, steps: steps.size, frames, link };
}

window.equipoise = {
  units: (kind) => change({ kind }),
  span: (span_s) => change({ span_s }),
  follow: (follow) => change({ follow }),
  dark(on) {
    document.documentElement.dataset.theme = on ? "dark" : "light";
  },
  state,
};

// Whoever changes the theme, canvases have to be drawn anew.
new MutationObserver(redraw).observe(document.documentElement, { attributeFilter: ["data-theme"] });

keepLinked(
  (message) => store.receive(message),
  (now) => {
    link = now;
    sayLink(now);
  },
);

present("eq-link").then((place) => {
  sayLink = linkWords(place);
  sayLink(link);
});
present("eq-story").then((place) => add(showStory(place)));
present("eq-numbers").then((place) => add(showNumbers(place, store, () => shown.kind)));
showWithLibraries("eq-charts", "./charts.js", ({ showCharts }, place) =>
  showCharts(place, store, shown),
);
showWithLibraries("eq-scene", "./scene.js", ({ showScene }, place) => showScene(place, store));
