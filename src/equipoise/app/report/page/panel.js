/** One panel of a chart: lines with bands, dots or bars; zoomed, moved, with lines to be hidden. */

import uPlot from "./vendor/uPlot.esm.js";
import { FONT, axisOf } from "./axis.js";
import { Heading, make } from "./chart_heading.js";
import { lineStyles } from "./colours.js";
import { drawBand, drawShaded, drawStems } from "./panel_marks.js";
import { Pointer } from "./pointer.js";
import { extent, niceRange } from "./nice.js";
import { tick, typeset } from "./units.js";

const BAND_ALPHA = "30"; // of 255 in hexadecimal, chosen: three bands on one another are visible
const DOT_ALPHA = "80"; // chosen: a line of the same colour is visible on dots
const HEIGHT = 210; // px
const GAP_AS_IT_IS = 2; // uPlot's word for: unknown rows break a line up to its next known row
const BARS = ["bars", "stems"];
const ALONE = 5; // the colour of a line by itself, which is no axis
const FEW = 300; // dots that are drawn larger; chosen: they do not touch

export class Panel {
  /**
   * @param {HTMLElement} place
   * @param {{title: string, unit: string, rows: object[], band: number|null,
   *   scale: number[]|null}} panel
   * @param {{name: string, axis: string, axis_unit: string, record: string,
   *   shaded: number[][]}} chart
   * @param {import("./ranges.js").Range} range
   */
  constructor(place, panel, chart, range) {
    Object.assign(this, { panel, chart, range, hidden: new Set() });
    this.columns = panel.rows.flatMap((rows) => rows.names.map((name, k) => ({ name, rows, k })));
    this.lineStyles = stylesOf(panel.rows);
    this.data = joined(panel.rows);
    this.element = make("figure", "eq-chart", place);
    const reported = { title: panel.title, columns: this.columns.map(({ name }) => name) };
    this.heading = new Heading(this.element, reported, this.lineStyles, (c, on) => this.toggle(c, on));
    this.columns.forEach(({ rows }, c) => (this.heading.values[c].parentElement.dataset.mark = rows.mark));
    this.plotPlace = make("div", "eq-plot", this.element);
    this.plotPlace.tabIndex = 0;
    this.plotPlace.setAttribute("role", "img");
    this.plotPlace.setAttribute("aria-label", `${panel.title} against ${chart.axis}`);
    this.plot = new uPlot(this.options(), this.data, this.plotPlace);
    this.pointer = new Pointer(this.plotPlace, this.plot, range);
    range.join(this, reachOf(this.data[0], panel.rows));
    new ResizeObserver(() => this.fit()).observe(this.plotPlace);
    this.writeValues();
  }

  options() {
    const sync = { key: this.chart.record || this.chart.name, scales: ["x", null], filters: { pub: isMove, sub: isMove } };
    const banded = this.columns.filter(({ rows }) => rows.low.length);
    return {
      width: 600, // until it is fitted
      height: HEIGHT,
      padding: [6, 16, 0, 0],
      legend: { show: false },
      cursor: { y: false, drag: { x: true, y: false, setScale: false }, sync, dataIdx: nearest },
      scales: { x: { time: false, auto: false }, y: { auto: false, range: (_, a, b) => [a, b] } },
      axes: [this.abscissa(), this.axis(58, 24, tick)],
      series: [{}, ...this.columns.map((_, c) => this.line(c)),
        ...banded.flatMap(() => [{ points: { show: false } }, { points: { show: false } }])],
      bands: banded.map((column, b) => this.band(column, b)),
      hooks: {
        drawAxes: [() => this.drawMarks()],
        draw: [() => this.drawBars()],
        setCursor: [() => this.writeValues()],
        setSelect: [() => this.zoomToSelection()],
      },
    };
  }

  /** Seconds stand at each tick; another axis says below it what it is. */
  abscissa() {
    const { axis, axis_unit: unit } = this.chart;
    if (unit === "s") return this.axis(22, 64, (t) => `${tick(t)} s`);
    return { ...this.axis(22, 64, tick), label: `${axis}, ${unit}`, labelSize: 18, labelFont: FONT };
  }

  axis(size, space, text) {
    return axisOf(() => this.colours, size, space, text);
  }

  colour(c) {
    return this.colours?.lines[this.lineStyles[c].colour];
  }

  line(c) {
    const { mark, x } = this.columns[c].rows;
    const stroke = () => this.colour(c);
    if (mark === "line") return { stroke, width: 1.5, dash: this.lineStyles[c].dash, points: { show: false } };
    const show = mark === "dots";
    const size = x.length > FEW ? 3 : 5;
    const fill = () => this.colours && this.colour(c) + DOT_ALPHA;
    return { stroke, paths: () => null, points: { show, size, width: 0, stroke: fill, fill } };
  }

  /** Edges of bands stand behind all columns. */
  band(column, b) {
    const low = 1 + this.columns.length + 2 * b;
    const fill = () => this.colours && this.colour(this.columns.indexOf(column)) + BAND_ALPHA;
    return { series: [low + 1, low], fill };
  }

  toggle(c, on) {
    if (on) this.hidden.delete(c);
    else this.hidden.add(c);
    const banded = this.columns.filter(({ rows }) => rows.low.length);
    const b = banded.indexOf(this.columns[c]);
    const low = 1 + this.columns.length + 2 * b;
    for (const s of b < 0 ? [1 + c] : [1 + c, low, low + 1]) this.plot.setSeries(s, { show: on });
    this.show();
  }

  recolour(colours) {
    this.colours = colours;
    this.show();
  }

  fit() {
    const { clientWidth: width } = this.plotPlace;
    if (width && width !== this.plot.width) this.plot.setSize({ width, height: HEIGHT });
  }

  /** Draw the stretch of the range, the ordinate fitted to what is visible of it. */
  show() {
    const [from, to] = this.range.span;
    const [min, max] = this.ordinate(from, to);
    this.plot.batch(() => {
      this.plot.setScale("x", { min: from, max: to });
      this.plot.setScale("y", { min, max });
    });
    this.plot.redraw(false, true);
  }

  ordinate(from, to) {
    const { scale, band } = this.panel;
    if (scale && !this.range.shown && !this.hidden.size) return scale;
    const [t] = this.data;
    const shown = this.columns.flatMap((_, c) =>
      this.hidden.has(c) ? [] : this.data[1 + c].filter((_, i) => t[i] >= from && t[i] <= to),
    );
    const bars = this.panel.rows.some(({ mark }) => mark === "bars");
    const [least, greatest] = extent([...shown, ...(bars ? [0] : []), ...(band ? [-band, band] : [])]);
    if (!(least <= greatest)) return [0, 1];
    const [low, high] = niceRange(least, greatest);
    return [bars && least >= 0 ? 0 : low, high]; // bars stand on the axis
  }

  mark(at) {
    const left = this.plot.valToPos(at, "x");
    this.plot.setCursor({ left: at === null ? -10 : left, top: 0 }, false);
    this.writeValues();
  }

  zoomToSelection() {
    const { left, width } = this.plot.select;
    if (!width) return;
    const [from, to] = [left, left + width].map((x) => this.plot.posToVal(x, "x"));
    this.plot.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    this.range.show(from, to);
  }

  drawMarks() {
    if (!this.colours) return;
    drawShaded(this.plot, this.chart.shaded, this.colours.quiet);
    if (this.panel.band) drawBand(this.plot, this.panel.band, this.colours.quiet);
  }

  drawBars() {
    if (!this.colours) return;
    const barred = this.columns.map((column, c) => ({ ...column, c }))
      .filter(({ rows, c }) => BARS.includes(rows.mark) && !this.hidden.has(c));
    const many = barred.length;
    barred.forEach(({ rows, k, c }, i) =>
      drawStems(this.plot, rows.x, rows.columns[k], this.colour(c), (i - (many - 1) / 2) / (many + 0.5)),
    );
  }

  /** The values under the cursor, which the charts of a record share. */
  writeValues() {
    const { idx, idxs, left } = this.plot.cursor;
    const under = left >= 0 && idx !== null && idx !== undefined;
    const values = this.columns.map((_, c) => (under ? this.data[1 + c][idxs[1 + c]] : null));
    const seconds = under && this.chart.axis_unit === "s" ? this.plot.posToVal(left, "x") : null;
    this.heading.write(typeset(this.panel.unit), seconds, values);
    if (!under) for (const place of this.heading.values) place.textContent = "";
  }
}

/** Rows that share a name's axis share its colour; dashes tell lines apart, not dots from lines. */
function stylesOf(rows) {
  const ofLines = lineStyles(rows.flatMap(({ names, mark }) => (mark === "line" ? names : [])));
  return rows.flatMap(({ names, mark }) => {
    if (names.length === 1) return [{ colour: ALONE, dash: [] }];
    return mark === "line" ? ofLines.splice(0, names.length) : lineStyles(names).map(undashed);
  });
}

const undashed = (style) => ({ ...style, dash: [] });

/** From the first abscissa to the last; bars need half their place more. */
function reachOf(x, rows) {
  const half = rows.some(({ mark }) => BARS.includes(mark)) ? (x[1] - x[0]) / 2 : 0;
  return [x[0] - half, x.at(-1) + half];
}

/** @returns {(number|null|undefined)[][]} abscissae, columns, and the edges of bands, for uPlot */
function joined(rows) {
  const edges = rows.flatMap(({ x, low, high }) => low.map((column, k) => [x, column, high[k]]));
  const tables = [...rows.map(({ x, columns }) => [x, ...columns]), ...edges];
  return uPlot.join(tables, tables.map((table) => table.map(() => GAP_AS_IT_IS)));
}

/** Charts share the cursor alone; what is selected in one is its own. */
const isMove = (type) => type === "mousemove" || type === "mouseleave";

/** Where rows have times of their own, the nearest row of each. */
function nearest(plot, s, idx) {
  const column = plot.data[s];
  for (let away = 0; away < column.length; away++) {
    if (column[idx - away] !== undefined && column[idx - away] !== null) return idx - away;
    if (column[idx + away] !== undefined && column[idx + away] !== null) return idx + away;
  }
  return idx;
}
