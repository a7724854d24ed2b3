/**
 * The page's beginning: one store of what the server sends, views of it in the containers that
 * the shell makes, and `window.equipoise` for the tests.
 */

import { firstSteps } from "./first_steps.js";
import { sayInstead } from "./instead.js";
import { keepLinked, linkWords } from "./link.js";
import { showNumbers } from "./numbers.js";
import { Store } from "./store.js";
import { showStory } from "./story.js";
import { showTimebar } from "./timebar.js";
import { showViews } from "./views.js";

const WAIT_MS = 50;
const NO_LIBRARIES =
  "This part needs files of others that are not installed: run make where npm is found.";

const store = new Store();
const shown = { kind: "bench", span_s: 60 };
let link = "closed";
let sayLink = () => {};

/** @returns {Promise<HTMLElement>} the shell makes its elements after this script has run */
function present(id) {
  return new Promise((resolve) => {
    const lineStyle = () => {
      const place = document.getElementById(id);
      if (place) resolve(place);
      else setTimeout(lineStyle, WAIT_MS);
    };
    lineStyle();
  });
}

function change(what) {
  Object.assign(shown, what);
  store.notify("redraw");
}

/** Where a module's libraries are not installed, a sentence stands instead. */
async function showWithLibraries(id, module, start) {
  const place = await present(id);
  try {
    await import(module);
  } catch (error) {
    if (!(error instanceof TypeError)) throw error; // what browsers say of a missing file
    return sayInstead(place, NO_LIBRARIES);
  }
  store.show(start(await import(module), place));
}

function state() {
  const series = {};
  for (const [name, kept] of store.series) series[name] = { rows: kept.rows, last: kept.last() };
  const { about, t, steps, frames } = store;
  return { clock: about?.clock ?? null, t, series, steps: steps.size, frames, link };
}

window.equipoise = { state };

// Whoever changes the theme, canvases have to be drawn anew.
new MutationObserver(() => store.notify("recolour")).observe(document.documentElement, {
  attributeFilter: ["data-theme"],
});

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
present("eq-story").then((place) => store.show(showStory(place, { hint: () => firstSteps(store.about) })));
present("eq-time").then((place) => store.show(showTimebar(place, store)));
present("eq-numbers").then((place) => store.show(showNumbers(place, store, () => shown.kind)));
showWithLibraries("eq-charts", "./charts.js", ({ showCharts }, place) =>
  showCharts(place, store, shown),
).then(async () => {
  const place = await present("eq-views"); // after the charts: it has to find them
  const themed = (dark) => place.dispatchEvent(new CustomEvent("themed", { detail: dark }));
  store.show(showViews(place, store, { live: true, change, themed }));
});
showWithLibraries("eq-scene", "./scene.js", ({ showScene }, place) => showScene(place, store));
