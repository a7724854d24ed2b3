/** One strip chart: lines with bands of one sd against bench time, and marks behind them. */

import uPlot from "./vendor/uPlot.esm.js";
import { axisOf } from "./axis.js";
import { Heading, make } from "./chart_heading.js";
import { lineStyles } from "./colours.js";
import { drawn } from "./decimate.js";
import { drawMoments, drawRule, drawTargets } from "./marks.js";
import { extent, niceRange } from "./nice.js";
import { tick, unitOf } from "./units.js";

const BAND_ALPHA = "30"; // of 255 in hexadecimal, chosen: three bands on one another are visible
const TARGETED = "com"; // the series that the goal's target and tolerance are of
const NO_ROWS = "No measurement yet.";
const FEWEST_BUCKETS = 50; // of a chart that has no size yet

export class Chart {
  /**
   * @param {HTMLElement} place
   * @param {{name: string, title: string, columns: string[], sd: boolean, unit: object,
   *   line: number|null}} reported  as `about` has it
   * @param {import("./store.js").Store} store
   * @param {() => void} request  for a drawing
   */
  constructor(place, reported, store, request) {
    Object.assign(this, { reported, store, request, lineStyles: lineStyles(reported.columns), hidden: new Set() });
    const arrays = 1 + reported.columns.length * (reported.sd ? 3 : 1);
    this.out = Array.from({ length: arrays }, () => []);
    this.element = make("figure", "eq-chart", place);
    this.heading = new Heading(this.element, reported, this.lineStyles, (c, on) => this.toggle(c, on));
    this.plotPlace = make("div", "eq-plot", this.element);
    this.plotPlace.setAttribute("role", "img");
    this.plotPlace.setAttribute("aria-label", `${reported.title} against bench time`);
    this.plot = new uPlot(this.options(), this.inDrawingOrder(), this.plotPlace);
    make("p", "eq-empty", this.element).textContent = NO_ROWS;
    this.element.dataset.series = reported.name;
    this.sayWhetherEmpty();
    this.fit();
  }

  /** Bands come first, so that lines lie on them. */
  inDrawingOrder() {
    const n = this.reported.columns.length;
    return [this.out[0], ...this.out.slice(1 + n), ...this.out.slice(1, 1 + n)];
  }

  options() {
    const banded = this.reported.sd ? this.lineStyles : [];
    const edges = Array.from({ length: 2 * banded.length }, () => ({ points: { show: false } }));
    return {
      width: 300, // until it is fitted
      height: 120,
      padding: [6, 16, 0, 0],
      legend: { show: false },
      cursor: { y: false, drag: { x: false, y: false }, sync: { key: "equipoise" } },
      scales: { x: { time: false, auto: false }, y: { auto: false, range: (_, a, b) => [a, b] } },
      axes: [this.axis(22, 64, (t) => `${tick(t)} s`), this.axis(52, 24, tick)],
      series: [{}, ...edges, ...this.lineStyles.map((lineStyle) => this.line(lineStyle))],
      bands: banded.map((lineStyle, c) => this.band(lineStyle, c)),
      hooks: {
        drawAxes: [() => this.drawMarks()],
        draw: [() => this.drawTimes()],
        setCursor: [() => this.writeValues()],
      },
    };
  }

  axis(size, space, text) {
    return axisOf(() => this.colours, size, space, text);
  }

  line(lineStyle) {
    const stroke = () => this.colours?.lines[lineStyle.colour];
    return { stroke, width: 1.5, dash: lineStyle.dash, points: { show: false } };
  }

  band(lineStyle, c) {
    const fill = () => this.colours && this.colours.lines[lineStyle.colour] + BAND_ALPHA;
    return { series: [2 + 2 * c, 1 + 2 * c], fill };
  }

  toggle(column, on) {
    if (on) this.hidden.delete(column);
    else this.hidden.add(column);
    const banded = this.reported.sd ? this.reported.columns.length : 0;
    const edges = banded ? [1 + 2 * column, 2 + 2 * column] : [];
    for (const i of [...edges, 1 + 2 * banded + column]) this.plot.setSeries(i, { show: on });
    this.request();
  }

  fit() {
    const { clientWidth: width, clientHeight: height } = this.plotPlace;
    if (width && height) this.plot.setSize({ width, height });
  }

  /**
   * @param {{from: number, to: number, length: number}} span  s
   * @param {import("./units.js").Kind} kind
   * @param {ReturnType<import("./colours.js").palette>} colours
   */
  draw(span, kind, colours) {
    this.colours = colours;
    this.unit = unitOf(this.reported.unit, kind);
    this.decimate(span);
    this.sayWhetherEmpty();
    const [min, max] = this.range();
    this.plot.batch(() => {
      this.plot.setData(this.inDrawingOrder(), false);
      this.plot.setScale("x", { min: span.from, max: span.to });
      this.plot.setScale("y", { min, max });
    });
    this.writeValues();
  }

  sayWhetherEmpty() {
    const empty = String(!this.store.series.get(this.reported.name)?.rows);
    if (this.element.dataset.empty !== empty) this.element.dataset.empty = empty;
  }

  decimate(span) {
    const series = this.store.series.get(this.reported.name);
    if (!series) return this.out.forEach((column) => (column.length = 0));
    const pixels = Math.round(this.plot.bbox.width / devicePixelRatio);
    const { columns, sd } = this.reported;
    const buckets = Math.max(FEWEST_BUCKETS, pixels);
    drawn(series, span, { values: columns.length, sd, unit: this.unit.size, buckets }, this.out);
  }

  /** @returns {[number, number]} lines, marks and the newest bands; older, wider bands may leave */
  range() {
    const n = this.reported.columns.length;
    const wanted = this.marked();
    for (let c = 0; c < n; c++) {
      if (this.hidden.has(c)) continue;
      wanted.push(...extent(this.out[1 + c]));
      if (this.reported.sd) for (const edge of [1, 2]) wanted.push(this.out[n + 2 * c + edge].at(-1));
    }
    const [least, greatest] = extent(wanted);
    return least <= greatest ? niceRange(least, greatest) : [0, 1];
  }

  /** @returns {number[]} what is marked on the y axis, in the unit shown */
  marked() {
    const rule = this.reported.line === null ? [] : [0, this.reported.line / this.unit.size];
    const targets = this.targets().flatMap((t) => [t.value - t.tolerance, t.value + t.tolerance]);
    return [...rule, ...targets];
  }

  targets() {
    const goal = this.reported.name === TARGETED ? this.store.state?.goal : null;
    if (!goal) return [];
    const { size } = this.unit;
    const all = goal.target.map((target, c) => ({
      value: target / size,
      tolerance: goal.tolerance[c] / size,
      colour: this.colours.lines[this.lineStyles[c].colour],
    }));
    return all.filter((_, c) => !this.hidden.has(c));
  }

  drawMarks() {
    if (!this.unit) return;
    const { line } = this.reported;
    if (line !== null) drawRule(this.plot, line / this.unit.size, this.colours.text);
    drawTargets(this.plot, this.targets());
  }

  /** When steps were done, and in a replay the time that is shown. */
  drawTimes() {
    if (!this.unit) return;
    const steps = [...(this.store.steps?.values() ?? [])];
    drawMoments(this.plot, steps.map((step) => step.t), { colour: this.colours.quiet, dashed: true });
    const { now } = this.store;
    if (now !== undefined) drawMoments(this.plot, [now], { colour: this.colours.text, dashed: false });
  }

  /** The values under the cursor, which all charts share, else the newest. */
  writeValues() {
    if (!this.unit) return;
    const { idx, left } = this.plot.cursor;
    const columns = this.reported.columns.map((_, c) => 1 + c);
    if (left >= 0 && idx !== null && idx < this.out[0].length) {
      const under = columns.map((column) => this.out[column][idx]);
      this.heading.write(this.unit.name, this.out[0][idx], under);
    } else {
      const last = this.store.last(this.reported.name);
      const newest = columns.map((column) => last && last[column] / this.unit.size);
      this.heading.write(this.unit.name, null, newest);
    }
  }

  destroy() {
    this.plot.destroy();
    this.element.remove();
  }
}
