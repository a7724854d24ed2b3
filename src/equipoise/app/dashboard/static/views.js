/**
 * What each reader chooses for this page alone: units, theme, the time shown, which panels. Made
 * here and kept in the browser; a server is not asked.
 */

import { make } from "./chart_heading.js";
import { keep, kept } from "./kept.js";

const UNITS = { bench: "µm, mm, deg", si: "SI" };
const SPANS = { 20: "20 s", 60: "1 min", 300: "5 min", 1200: "20 min" };
const PANELS = { scene: "3-D view", numbers: "Numbers", story: "Steps" };

/**
 * @param {HTMLElement} place
 * @param {import("./store.js").Store} store
 * @param {{live: boolean, change: (what: object) => void, themed?: (dark: boolean) => void}} how
 *   `change` takes `kind` and, of a live page, `span_s`
 * @returns {import("./store.js").View}
 */
export function showViews(place, store, { live, change, themed }) {
  const before = kept();
  if (live) addChoice(place, "Time shown", SPANS, before.span, 60, (span) => {
    keep({ span });
    change({ span_s: Number(span) });
  });
  addChoice(place, "Units", UNITS, before.units, "bench", (units) => {
    keep({ units });
    change({ kind: units });
  });
  addSwitch(place, before.dark ?? matchMedia("(prefers-color-scheme: dark)").matches, (dark) => {
    document.documentElement.dataset.theme = dark ? "dark" : "light";
    themed?.(dark);
  });
  return panels(place, store, new Set(before.hidden));
}

function addChoice(place, words, options, before, first, chosen) {
  const select = make("select", "eq-choice", place);
  select.setAttribute("aria-label", words);
  for (const [value, text] of Object.entries(options)) {
    const option = make("option", "", select);
    Object.assign(option, { value, textContent: text });
  }
  select.value = before in options ? before : first;
  select.addEventListener("change", () => chosen(select.value));
  chosen(select.value);
}

/** The theme is that of the system until a reader has chosen another. */
function addSwitch(place, on, turned) {
  const box = checkbox(place, "Dark", on, () => {
    keep({ dark: box.checked });
    turned(box.checked);
  });
  box.setAttribute("role", "switch");
  turned(on);
}

function checkbox(place, words, on, changed) {
  const label = make("label", "eq-check", place);
  const box = make("input", "", label);
  Object.assign(box, { type: "checkbox", checked: on });
  box.addEventListener("change", changed);
  make("span", "", label).textContent = words;
  return box;
}

/** A menu of the panels that there are; those that are not ticked are hidden. */
function panels(place, store, hidden) {
  const menu = make("details", "eq-menu", place);
  make("summary", "", menu).textContent = "Panels";
  const list = make("fieldset", "", menu);
  list.setAttribute("aria-label", "Panels");
  menu.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    menu.open = false;
    menu.firstElementChild.focus();
  });
  const apply = () => {
    for (const part of elements()) part.hidden = hidden.has(part.id.replace("eq-", ""));
    for (const chart of document.querySelectorAll(".eq-chart")) chart.hidden = hidden.has(chart.dataset.series);
    for (const section of document.querySelectorAll(".eq-view, .eq-story")) {
      section.hidden = elements().filter((part) => section.contains(part)).every((part) => part.hidden);
    }
  };
  const about = () => {
    list.replaceChildren();
    const charts = store.about.series.filter((series) => series.chart);
    const all = { ...PANELS, ...Object.fromEntries(charts.map(({ name, title }) => [name, title])) };
    for (const [name, words] of Object.entries(all)) {
      const box = checkbox(list, words, !hidden.has(name), () => {
        if (box.checked) hidden.delete(name);
        else hidden.add(name);
        keep({ hidden: [...hidden] });
        apply();
      });
    }
    apply();
  };
  return { about };
}

const elements = () => Object.keys(PANELS).map((name) => document.getElementById(`eq-${name}`));
