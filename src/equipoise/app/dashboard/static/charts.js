/** The grid of strip charts: which there are, and when they are drawn. */

import { Chart } from "./chart.js";
import { palette } from "./colours.js";
import { paced } from "./pace.js";

const PERIOD_MS = 100; // smooth to the eye for lines that creep; chosen

/**
 * @param {HTMLElement} place
 * @param {import("./store.js").Store} store
 * @param {{kind: import("./units.js").Kind, span_s: number, span?: import("./span.js").Span}} shown
 *   `span`: the part of a recording; without one the charts follow the newest row
 * @param {(chart: Chart) => void} made  is given each chart that is made
 */
export function showCharts(place, store, shown, made = () => {}) {
  /** @type {Map<Element, Chart>} */
  const charts = new Map();
  const inSight = new Set();
  let colours = palette();
  let built = null; // the series for which there are charts, as JSON

  // A young record grows from the left edge; then the window moves along with it.
  const newest = () => {
    const to = Math.max(store.t ?? 0, (store.began ?? 0) + shown.span_s);
    return { from: to - shown.span_s, to, length: shown.span_s };
  };
  const draw = () => {
    const span = shown.span ? { ...shown.span, to: shown.span.from + shown.span.length } : newest();
    for (const element of inSight) charts.get(element)?.draw(span, shown.kind, colours);
  };
  const request = paced(draw, PERIOD_MS);
  const observed = watchSight(inSight, request);
  const sizes = new ResizeObserver((entries) => {
    for (const { target } of entries) charts.get(target.parentElement)?.fit();
    request();
  });

  const clear = () => {
    for (const [element, chart] of charts) {
      observed.unobserve(element);
      sizes.unobserve(chart.plotPlace);
      chart.destroy();
    }
    charts.clear();
    inSight.clear();
  };
  const about = () => {
    const wanted = JSON.stringify(store.about.series);
    if (wanted === built) return request(); // lines that a person has hidden stay so
    built = wanted;
    clear();
    for (const reported of store.about.series.filter((series) => series.chart)) {
      const chart = new Chart(place, reported, store, request);
      charts.set(chart.element, chart);
      made(chart);
      observed.observe(chart.element);
      sizes.observe(chart.plotPlace);
    }
  };
  const recolour = () => {
    colours = palette();
    request();
  };
  const rows = () => {
    for (const chart of charts.values()) chart.sayWhetherEmpty(); // one that is not in sight, too
    request();
  };
  return { about, rows, state: request, step: request, redraw: request, recolour };
}

/** Keeps `inSight` to the elements that are visible, and asks for a drawing when one comes. */
function watchSight(inSight, request) {
  return new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      if (isIntersecting) inSight.add(target);
      else inSight.delete(target);
    }
    request();
  });
}
