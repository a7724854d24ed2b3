/** One strip chart: lines with bands of one sd against bench time, and marks behind them. */

import uPlot from "./vendor/uPlot.esm.js";
import { Heading, make } from "./chart_heading.js";
import { looks } from "./colours.js";
import { drawn } from "./decimate.js";
import { drawRule, drawTargets } from "./marks.js";
import { extent, niceRange } from "./nice.js";
import { tick, unitOf } from "./units.js";

const FONT = '11px system-ui, "DejaVu Sans", sans-serif';
const BAND_ALPHA = "30"; // of 255 in hexadecimal, chosen: three bands on one another can be seen
const TARGETED = "com"; // the series that the goal's target and tolerance are of
const FEWEST_BUCKETS = 50; // of a chart that has no size yet

export class Chart {
  /**
   * @param {HTMLElement} place
   * @param {{name: string, title: string, columns: string[], sd: boolean, unit: object,
   *   line: number|null}} told  as `about` has it
   * @param {import("./store.js").Store} store
   * @param {() => void} ask  for a drawing
   */
  constructor(place, told, store, ask) {
    Object.assign(this, { told, store, ask, looks: looks(told.columns), hidden: new Set() });
    const arrays = 1 + told.columns.length * (told.sd ? 3 : 1);
    this.out = Array.from({ length: arrays }, () => []);
    this.element = make("figure", "eq-chart", place);
    this.heading = new Heading(this.element, told, this.looks, (c, on) => this.toggle(c, on));
    this.plotPlace = make("div", "eq-plot", this.element);
    this.plotPlace.setAttribute("role", "img");
    this.plotPlace.setAttribute("aria-label", `${told.title} against bench time`);
    this.plot = new uPlot(this.options(), this.inDrawingOrder(), this.plotPlace);
    this.fit();
  }

  /** Bands come first, so that lines lie on them. */
  inDrawingOrder() {
    const n = this.told.columns.length;
    return [this.out[0], ...this.out.slice(1 + n), ...this.out.slice(1, 1 + n)];
  }

  options() {
    const banded = this.told.sd ? this.looks : [];
    const edges = Array.from({ length: 2 * banded.length }, () => ({ points: { show: false } }));
    return {
      width: 300, // until it is fitted
      height: 120,
      padding: [6, 16, 0, 0],
      legend: { show: false },
      cursor: { y: false, drag: { x: false, y: false }, sync: { key: "equipoise" } },
      scales: { x: { time: false, auto: false }, y: { auto: false, range: (_, a, b) => [a, b] } },
      axes: [this.axis(22, 64, (t) => `${tick(t)} s`), this.axis(52, 24, tick)],
      series: [{}, ...edges, ...this.looks.map((look) => this.line(look))],
      bands: banded.map((look, c) => this.band(look, c)),
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

  toggle(column, on) {
    if (on) this.hidden.delete(column);
    else this.hidden.add(column);
    const banded = this.told.sd ? this.told.columns.length : 0;
    const edges = banded ? [1 + 2 * column, 2 + 2 * column] : [];
    for (const i of [...edges, 1 + 2 * banded + column]) this.plot.setSeries(i, { show: on });
    this.ask();
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
    this.unit = unitOf(this.told.unit, kind);
    this.decimate(span);
    const [min, max] = this.range();
    this.plot.batch(() => {
      this.plot.setData(this.inDrawingOrder(), false);
      this.plot.setScale("x", { min: span.from, max: span.to });
      this.plot.setScale("y", { min, max });
    });
    this.writeValues();
  }

  decimate(span) {
    const series = this.store.series.get(this.told.name);
    if (!series) return this.out.forEach((column) => (column.length = 0));
    const pixels = Math.round(this.plot.bbox.width / devicePixelRatio);
    const { columns, sd } = this.told;
    const buckets = Math.max(FEWEST_BUCKETS, pixels);
    drawn(series, span, { values: columns.length, sd, factor: this.unit.factor, buckets }, this.out);
  }

  /** @returns {[number, number]} lines, marks and the newest bands; older, wider bands may leave */
  range() {
    const n = this.told.columns.length;
    const wanted = this.marked();
    for (let c = 0; c < n; c++) {
      if (this.hidden.has(c)) continue;
      wanted.push(...extent(this.out[1 + c]));
      if (this.told.sd) for (const edge of [1, 2]) wanted.push(this.out[n + 2 * c + edge].at(-1));
    }
    const [least, greatest] = extent(wanted);
    return least <= greatest ? niceRange(least, greatest) : [0, 1];
  }

  /** @returns {number[]} what is marked on the y axis, in the unit shown */
  marked() {
    const rule = this.told.line === null ? [] : [0, this.told.line * this.unit.factor];
    const targets = this.targets().flatMap((t) => [t.value - t.tolerance, t.value + t.tolerance]);
    return [...rule, ...targets];
  }

  targets() {
    const goal = this.told.name === TARGETED ? this.store.state?.goal : null;
    if (!goal) return [];
    const { factor } = this.unit;
    const all = goal.target.map((target, c) => ({
      value: target * factor,
      tolerance: goal.tolerance[c] * factor,
      colour: this.colours.lines[this.looks[c].colour],
    }));
    return all.filter((_, c) => !this.hidden.has(c));
  }

  drawMarks() {
    if (!this.unit) return;
    const { line } = this.told;
    if (line !== null) drawRule(this.plot, line * this.unit.factor, this.colours.text);
    drawTargets(this.plot, this.targets());
  }

  /** The values under the cursor, which all charts share, else the newest. */
  writeValues() {
    if (!this.unit) return;
    const { idx, left } = this.plot.cursor;
    const columns = this.told.columns.map((_, c) => 1 + c);
    if (left >= 0 && idx !== null && idx < this.out[0].length) {
      const under = columns.map((column) => this.out[column][idx]);
      this.heading.write(this.unit.name, this.out[0][idx], under);
    } else {
      const last = this.store.last(this.told.name);
      const newest = columns.map((column) => last && last[column] * this.unit.factor);
      this.heading.write(this.unit.name, null, newest);
    }
  }

  destroy() {
    this.plot.destroy();
    this.element.remove();
  }
}
