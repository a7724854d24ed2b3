/** One strip chart: a heading with current values, and lines with bands of one sd against time. */

import uPlot from "./vendor/uPlot.esm.js";
import { looks } from "./colours.js";
import { drawn } from "./decimate.js";
import { drawRule, drawTargets } from "./marks.js";
import { niceRange } from "./nice.js";
import { figures, seconds, unitOf } from "./units.js";

const FONT = '11px system-ui, "DejaVu Sans", sans-serif';
const BAND_ALPHA = "30"; // of 255 in hexadecimal, chosen: three bands on one another can be seen
const TARGETED = "com"; // the series that the goal's target and tolerance are of

export class Chart {
  /**
   * @param {HTMLElement} place
   * @param {{name: string, title: string, columns: string[], sd: boolean, unit: object,
   *   line: number|null}} told  as `about` has it
   * @param {import("./store.js").Store} store
   */
  constructor(place, told, store) {
    this.told = told;
    this.store = store;
    this.looks = looks(told.columns);
    this.buildElements(place);
    const arrays = 1 + told.columns.length * (told.sd ? 3 : 1);
    this.out = Array.from({ length: arrays }, () => []);
    this.plot = new uPlot(this.options(), this.inDrawingOrder(), this.plotPlace);
    this.fit();
  }

  buildElements(place) {
    this.element = make("figure", "eq-chart", place);
    const heading = make("figcaption", "", this.element);
    make("b", "", heading).textContent = this.told.title;
    this.unitPlace = make("span", "eq-unit", heading);
    const keys = make("span", "eq-keys", heading);
    this.values = this.told.columns.map((name, i) => this.addKey(keys, name, this.looks[i]));
    this.plotPlace = make("div", "eq-plot", this.element);
    this.plotPlace.setAttribute("role", "img");
    this.plotPlace.setAttribute("aria-label", `${this.told.title} against bench time`);
  }

  addKey(keys, name, look) {
    const key = make("span", "eq-key", keys);
    key.style.setProperty("--line", `var(--eq-line-${look.colour})`);
    key.dataset.dashed = look.dash.length > 0;
    make("span", "", key).textContent = name;
    return make("span", "eq-value", key);
  }

  /** Bands come first, so that lines lie on them. */
  inDrawingOrder() {
    const n = this.told.columns.length;
    return [this.out[0], ...this.out.slice(1 + n), ...this.out.slice(1, 1 + n)];
  }

  options() {
    const n = this.told.sd ? this.told.columns.length : 0;
    const edges = Array.from({ length: 2 * n }, () => ({ width: 0, points: { show: false } }));
    return {
      width: 300,
      height: 120,
      padding: [6, 10, 0, 0],
      legend: { show: false },
      cursor: { y: false, drag: { x: false, y: false }, sync: { key: "equipoise" } },
      scales: { x: { time: false, auto: false }, y: { auto: false, range: (_, a, b) => [a, b] } },
      axes: [this.axis(22, 64, seconds0), this.axis(52, 24, (y) => figuresOf(y))],
      series: [{}, ...edges, ...this.looks.map((look) => this.line(look))],
      bands: this.looks.slice(0, n).map((look, c) => this.band(look, c)),
      hooks: { drawAxes: [() => this.drawMarks()], setCursor: [() => this.writeValues()] },
    };
  }

  axis(size, space, text) {
    return {
      size,
      space,
      gap: 3,
      font: FONT,
      stroke: () => this.colours?.quiet,
      grid: { stroke: () => this.colours?.grid, width: 1 },
      ticks: { stroke: () => this.colours?.grid, width: 1, size: 4 },
      values: (_, splits) => splits.map(text),
    };
  }

  line(look) {
    const stroke = () => this.colours?.lines[look.colour];
    return { stroke, width: 1.5, dash: look.dash, points: { show: false } };
  }

  band(look, c) {
    const fill = () => this.colours && this.colours.lines[look.colour] + BAND_ALPHA;
    return { series: [2 + 2 * c, 1 + 2 * c], fill };
  }

  fit() {
    const { clientWidth: width, clientHeight: height } = this.plotPlace;
    if (width && height) this.plot.setSize({ width, height });
  }

  /**
   * @param {{from: number, to: number}} span  s
   * @param {import("./units.js").Kind} kind
   */
  draw(span, kind, colours) {
    this.colours = colours;
    this.unit = unitOf(this.told.unit, kind);
    this.unitPlace.textContent = `[${this.unit.name}]`;
    const { columns, sd } = this.told;
    const buckets = Math.max(50, Math.round(this.plot.bbox.width / devicePixelRatio));
    const how = { values: columns.length, sd, factor: this.unit.factor, buckets };
    const series = this.store.series.get(this.told.name);
    if (series) drawn(series, span, how, this.out);
    const [min, max] = this.range();
    this.plot.batch(() => {
      this.plot.setData(this.inDrawingOrder(), false);
      this.plot.setScale("x", { min: span.from, max: span.to });
      this.plot.setScale("y", { min, max });
    });
    this.writeValues();
  }

  /** @returns {[number, number]} lines, marks and the newest bands; older, wider bands may leave */
  range() {
    const n = this.told.columns.length;
    const wanted = this.marked();
    for (const column of this.out.slice(1, 1 + n)) wanted.push(...extremes(column));
    for (const column of this.out.slice(1 + n)) wanted.push(column.at(-1) ?? NaN);
    const known = wanted.filter(Number.isFinite);
    return known.length ? niceRange(Math.min(...known), Math.max(...known)) : [0, 1];
  }

  /** @returns {number[]} what is marked on the y axis, in the unit shown */
  marked() {
    const marks = this.told.line === null ? [] : [0, this.told.line * this.unit.factor];
    for (const { value, tolerance } of this.targets()) marks.push(value - tolerance, value + tolerance);
    return marks;
  }

  targets() {
    const goal = this.told.name === TARGETED ? this.store.state?.goal : null;
    if (!goal) return [];
    const { factor } = this.unit;
    return goal.target.map((target, i) => ({
      value: target * factor,
      tolerance: goal.tolerance[i] * factor,
      colour: this.colours.lines[this.looks[i].colour],
    }));
  }

  drawMarks() {
    if (!this.unit) return;
    if (this.told.line !== null) {
      drawRule(this.plot, this.told.line * this.unit.factor, this.colours.warn);
    }
    drawTargets(this.plot, this.targets());
  }

  /** The values under the cursor, which all charts share, else the newest. */
  writeValues() {
    if (!this.unit) return;
    const { idx } = this.plot.cursor;
    const under = idx !== null && idx !== undefined && this.plot.cursor.left >= 0;
    const last = this.store.last(this.told.name);
    const at = under ? ` at ${seconds(this.out[0][idx])}` : "";
    this.unitPlace.textContent = `[${this.unit.name}]${at}`;
    this.values.forEach((place, c) => {
      const value = under ? this.out[1 + c][idx] : last && last[1 + c] * this.unit.factor;
      place.textContent = figures(value ?? null);
    });
  }

  destroy() {
    this.plot.destroy();
    this.element.remove();
  }
}

function extremes(column) {
  let [least, greatest] = [Infinity, -Infinity];
  for (const value of column) {
    if (value === null) continue;
    if (value < least) least = value;
    if (value > greatest) greatest = value;
  }
  return [least, greatest];
}

/** Ticks are round numbers; what the machine adds to them in the 16th figure is not shown. */
const figuresOf = (y) => tickText(Number(y.toPrecision(6)));
const tickText = (y) => (y !== 0 && Math.abs(y) < 1e-3 ? y.toExponential() : String(y)).replace("-", "−");
const seconds0 = (t) => `${Number(t.toPrecision(9))} s`.replace("-", "−");

function make(tag, className, parent) {
  const element = document.createElement(tag);
  if (className) element.className = className;
  parent.append(element);
  return element;
}
