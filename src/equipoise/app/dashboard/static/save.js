/** A chart saved by its reader: as a table of the rows that it shows, or as a picture. */

import { make } from "./chart_heading.js";

const HEADING_PX = 26;
const MARGIN_PX = 10;

/**
 * The rows of a series within a span, in the unit shown, at full resolution.
 * @param {import("./series.js").Series} series
 * @param {{name: string, columns: string[], sd: boolean, unit: object}} reported
 * @param {{kind: import("./units.js").Kind, from: number, to: number, hidden: Set<number>}} shown
 * @returns {string} CSV; a cell that is not known is blank
 */
export function csvOf(series, reported, shown) {
  const [unit, size] = reported.unit[shown.kind];
  const columns = columnsOf(reported, shown.hidden);
  const head = ["time_s", ...columns.map(({ name }) => [reported.name, name, inNames(unit)].filter(Boolean).join("_"))];
  const lines = [head.join(",")];
  const end = series.firstAfter(shown.to);
  for (let row = series.firstFrom(shown.from); row < end; row++) {
    const cells = columns.map(({ at }) => cell(series.at(row, at) / size));
    lines.push([cell(series.at(row, 0)), ...cells].join(","));
  }
  return lines.join("\n") + "\n";
}

function columnsOf({ columns, sd }, hidden) {
  const shown = columns.map((name, c) => ({ name: plain(name), at: 1 + c })).filter((_, c) => !hidden.has(c));
  const sds = shown.map(({ name, at }) => ({ name: `${name}_sd`, at: at + columns.length }));
  return sd ? [...shown, ...sds] : shown;
}

const cell = (value) => (Number.isFinite(value) ? String(value) : "");
const plain = (name) => name.replace(/[^A-Za-z0-9]+/g, "_").replace(/^_|_$/g, "");

/** A unit as columns have it: rad/s is rad_s, N m is N_m. */
function inNames(unit) {
  if (unit === "%") return "percent";
  return unit === "-" ? "" : unit.replace(/[ /]/g, "_");
}

/**
 * A picture of a chart under its title, unit and key.
 * @param {import("./chart.js").Chart} chart
 * @returns {HTMLCanvasElement}
 */
export function pictureOf(chart) {
  const drawn = chart.plot.ctx.canvas;
  const canvas = document.createElement("canvas");
  canvas.width = drawn.width;
  canvas.height = drawn.height + HEADING_PX * devicePixelRatio;
  const context = canvas.getContext("2d");
  context.fillStyle = chart.colours.panel;
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(drawn, 0, HEADING_PX * devicePixelRatio);
  context.scale(devicePixelRatio, devicePixelRatio);
  writeHeading(context, chart);
  return canvas;
}

function writeHeading(context, { reported, unit, colours, lineStyles, hidden }) {
  const write = (text, weight, colour, x_px) => {
    Object.assign(context, { font: `${weight} 12px system-ui, "DejaVu Sans", sans-serif`, fillStyle: colour });
    context.fillText(text, x_px, HEADING_PX - 8);
    return x_px + context.measureText(text).width + MARGIN_PX;
  };
  let x_px = write(reported.title, 600, colours.text, MARGIN_PX);
  if (unit.name) x_px = write(`[${unit.name}]`, 400, colours.quiet, x_px);
  reported.columns.forEach((name, c) => {
    if (hidden.has(c)) return;
    context.strokeStyle = colours.lines[lineStyles[c].colour];
    context.lineWidth = 2;
    context.setLineDash(lineStyles[c].dash);
    context.beginPath();
    context.moveTo(x_px, HEADING_PX - 12);
    context.lineTo(x_px + 18, HEADING_PX - 12);
    context.stroke();
    x_px = write(name, 400, colours.text, x_px + 22);
  });
}

/** Let the browser save something. @param {Blob} blob */
export function save(blob, name) {
  const address = URL.createObjectURL(blob);
  const link = make("a", "", document.body);
  link.href = address;
  link.download = name;
  link.click();
  link.remove();
  URL.revokeObjectURL(address);
}
