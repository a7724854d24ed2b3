/** The table of current numbers. */

import { paced } from "./pace.js";
import { seconds, unitForSi, withSd } from "./units.js";

const PERIOD_MS = 200; // faster is not read; chosen

/**
 * Each row: its name in data-name, what people read, the SI unit, and a function of the store that
 * gives the SI value and, where there is one, its sd.
 */
const ROWS = [
  ["time", "bench time", "s", (store) => [store.t ?? NaN]],
  ["tilt", "tilt", "rad", (store) => [tilt(store.last("pose"), store.about?.up)]],
  ["rate", "rate", "rad/s", (store) => [length(store.last("rate"))]],
  ["energy", "total energy", "J", (store) => valueAndSd(store.last("energy"), 2)],
  ["com_x", "com x", "m", (store) => valueAndSd(store.last("com"), 0)],
  ["com_y", "com y", "m", (store) => valueAndSd(store.last("com"), 1)],
  ["com_z", "com z", "m", (store) => valueAndSd(store.last("com"), 2)],
  ["torque", "torque", "N m", (store) => [length(store.last("torque"))]],
];

/** @returns {number} the angle (rad) between the body axis `up` and the laboratory's vertical */
export function tilt(pose, up) {
  if (!pose || !up) return NaN;
  const [, w, x, y, z] = pose;
  const vertical = [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)];
  const cosine = vertical[0] * up[0] + vertical[1] * up[1] + vertical[2] * up[2];
  return Math.acos(Math.max(-1, Math.min(1, cosine)));
}

const length = (row) => (row ? Math.hypot(row[1], row[2], row[3]) : NaN);
const valueAndSd = (row, i) => (row ? [row[1 + i], row[4 + i]] : [NaN, NaN]);

/**
 * @param {HTMLElement} place
 * @param {import("./store.js").Store} store
 * @param {() => import("./units.js").Kind} kind
 */
export function showNumbers(place, store, kind) {
  const outputs = ROWS.map(([name, words]) => addRow(place, name, words));
  const draw = () => ROWS.forEach((row, i) => write(outputs[i], row, store, kind()));
  const request = paced(draw, PERIOD_MS);
  return { about: request, rows: request, redraw: draw };
}

function addRow(place, name, words) {
  const row = document.createElement("div");
  const label = document.createElement("label");
  const output = document.createElement("output");
  output.id = `eq-number-${name}`;
  output.dataset.name = name;
  // An output is a live region by itself; these change too often to be read out.
  output.setAttribute("aria-live", "off");
  label.htmlFor = output.id;
  label.textContent = words;
  row.append(label, output);
  place.append(row);
  return output;
}

function write(output, [name, , si, read], store, kind) {
  const [value, sd] = read(store);
  const unit = unitForSi(si, kind);
  output.dataset.si = JSON.stringify(Number.isFinite(value) ? value : null);
  if (sd !== undefined) output.dataset.sd = JSON.stringify(Number.isFinite(sd) ? sd : null);
  if (name === "time") output.textContent = Number.isFinite(value) ? seconds(value) : "–";
  else output.textContent = withSd(value / unit.size, sd / unit.size, unit.name);
}
