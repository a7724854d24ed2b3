/** The viewer's beginning: it fetches a whole recording, and shows it; nothing is ever sent. */

import { make } from "./chart_heading.js";
import { showCharts } from "./charts.js";
import { decodeFrame } from "./frames.js";
import { followGestures } from "./gestures.js";
import { sayInstead } from "./instead.js";
import { showNumbers } from "./numbers.js";
import { Player } from "./player.js";
import { ReplayStore } from "./replay_store.js";
import { csvOf, pictureOf, save } from "./save.js";
import { showScene } from "./scene.js";
import { between, following, panned, zoomed } from "./span.js";
import { showStory } from "./story.js";
import { showViews } from "./views.js";

const STEP = 0.5; // of the span, by which a key or a button pans; chosen
const FACTOR = 0.5; // of the span's length, by which one zooms in; chosen
const GONE = "The recording is not there: start equipoise replay again, and reload this page.";

const at = (id) => document.getElementById(id);

async function fetched(address) {
  const answer = await fetch(address);
  if (!answer.ok) throw new TypeError(`${address}: ${answer.status}`);
  return answer;
}

async function recording() {
  const [document, rows] = await Promise.all([fetched("/replay/document"), fetched("/replay/rows")]);
  return new ReplayStore(await document.json(), decodeFrame(await rows.arrayBuffer()));
}

function show(store) {
  const shown = { kind: "bench", span_s: store.whole.length, span: store.whole };
  const change = (what) => {
    Object.assign(shown, what);
    store.notify("redraw");
  };
  const showSpan = (span) => change({ span });
  // Whoever changes the theme, canvases have to be drawn anew.
  new MutationObserver(() => store.notify("recolour")).observe(document.documentElement, {
    attributeFilter: ["data-theme"],
  });
  const player = new Player(at("eq-player"), store, (t) => showSpan(following(shown.span, store.whole, t)));
  const actions = {
    seek: (t) => player.go(t),
    show: (one, other) => showSpan(between(one, other, store.whole)),
    pan: (share) => showSpan(panned(shown.span, store.whole, share)),
    zoom: (factor, t) => showSpan(zoomed(shown.span, store.whole, factor, t)),
    whole: () => showSpan(store.whole),
  };
  addZoom(at("eq-zoom"), actions, store);
  followKeys(at("eq-charts"), actions, store, player);
  store.show(showScene(at("eq-scene"), store));
  store.show(showNumbers(at("eq-numbers"), store, () => shown.kind));
  store.show(showStory(at("eq-story"), { seek: actions.seek, hint: noSteps }));
  store.show(showCharts(at("eq-charts"), store, shown, (chart) => {
    followGestures(chart.plot, actions);
    addSaving(chart, store, shown);
  }));
  store.show(showViews(at("eq-views"), store, { live: false, change }));
  const state = () => ({ now: store.now, span: shown.span, whole: store.whole, playing: player.playing });
  window.equipoise = { state };
}

function noSteps() {
  const words = document.createElement("p");
  words.textContent = "This recording has no steps or marks.";
  return words;
}

function addButton(place, text, title, act) {
  const button = make("button", "eq-press", place);
  Object.assign(button, { type: "button", textContent: text, title });
  button.addEventListener("click", act);
  return button;
}

function addZoom(place, actions, store) {
  const buttons = [
    ["◀", "Earlier", () => actions.pan(-STEP)],
    ["▶", "Later", () => actions.pan(STEP)],
    ["−", "Zoom out", () => actions.zoom(1 / FACTOR, store.now)],
    ["+", "Zoom in", () => actions.zoom(FACTOR, store.now)],
    ["Whole", "Show the whole recording", actions.whole],
  ];
  for (const [text, title, act] of buttons) addButton(place, text, title, act).setAttribute("aria-label", title);
}

/** On the charts, as on the buttons. */
function followKeys(place, actions, store, player) {
  const keys = {
    ArrowLeft: () => actions.pan(-STEP / 5),
    ArrowRight: () => actions.pan(STEP / 5),
    "+": () => actions.zoom(FACTOR, store.now),
    "=": () => actions.zoom(FACTOR, store.now), // plus without its shift key
    "-": () => actions.zoom(1 / FACTOR, store.now),
    0: actions.whole,
    " ": () => player.turn(!player.playing),
  };
  place.addEventListener("keydown", (event) => {
    const act = keys[event.key];
    if (!act || event.target !== place || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  });
}

function addSaving(chart, store, shown) {
  const { name, title } = chart.reported;
  const place = make("span", "eq-saving", chart.element.querySelector("figcaption"));
  const span = () => ({ from: shown.span.from, to: shown.span.from + shown.span.length });
  const file = (suffix) => `${name}_${span().from.toFixed(1)}-${span().to.toFixed(1)}s.${suffix}`;
  addButton(place, "PNG", `Save ${title} as a picture (PNG)`, () =>
    pictureOf(chart).toBlob((blob) => save(blob, file("png"))),
  );
  addButton(place, "CSV", `Save the rows shown of ${title} as CSV`, () => {
    const text = csvOf(store.series.get(name), chart.reported, { kind: shown.kind, ...span(), hidden: chart.hidden });
    save(new Blob([text], { type: "text/csv" }), file("csv"));
  });
}

recording().then(show, () => sayInstead(at("eq-charts"), GONE));
