/**
 * Units to show numbers in: those of the bench (um, mm, deg ...) or SI. All numbers inside are SI.
 * @typedef {"bench"|"si"} Kind
 * @typedef {{name: string, size: number}} Unit  `size` is how large it is in SI
 */

const DEG = Math.PI / 180;

/** For what the server's `about` states no unit, by SI unit: the units of the printed reports. */
const SHOWN = {
  s: { bench: ["s", 1], si: ["s", 1] },
  m: { bench: ["um", 1e-6], si: ["m", 1] },
  rad: { bench: ["deg", DEG], si: ["rad", 1] },
  "rad/s": { bench: ["deg/s", DEG], si: ["rad/s", 1] },
  "N m": { bench: ["uN m", 1e-6], si: ["N m", 1] },
  J: { bench: ["mJ", 1e-3], si: ["J", 1] },
};

/**
 * @param {{bench: [string, number], si: [string, number]}} pair  as `about` has it
 * @param {Kind} kind
 * @returns {Unit}
 */
export function unitOf(pair, kind) {
  const [name, size] = pair[kind];
  return { name: typeset(name), size };
}

/** @returns {Unit} the unit of a quantity that has this SI unit */
export const unitForSi = (si, kind) => unitOf(SHOWN[si], kind);

/** @returns {string} a unit as people write it: um is µm, m2 is m² */
export function typeset(name) {
  return name.replace(/\bu(?=[a-zA-Z])/g, "µ").replace(/([a-z])2\b/g, "$1²");
}

/**
 * A number with as many figures as can be read at a glance: four, fewer below 0.001, no tail.
 * @param {number|null} value  in the unit to be shown; NaN or null: not known
 */
export function figures(value) {
  if (value === null || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size === 0) return "0";
  if (size < 1e-3 || size >= 1e6) return minus(value.toExponential(2));
  return minus(value.toFixed(Math.max(0, Math.min(4, 3 - Math.floor(Math.log10(size))))));
}

/**
 * A number and its standard deviation, both to the second figure of the sd; small ones, as those
 * of SI are, both with the same power of a thousand.
 * @param {number} value
 * @param {number} sd
 * @param {string} unit
 */
export function withSd(value, sd, unit) {
  if (!Number.isFinite(value) || !Number.isFinite(sd) || sd <= 0) return withUnit(value, unit);
  const thousands = Math.floor(Math.log10(Math.max(Math.abs(value), sd)) / 3);
  const power = thousands < -1 ? 3 * thousands : 0;
  const decimals = Math.max(0, Math.min(6, 1 - Math.floor(Math.log10(sd) - power)));
  const write = (x) => (x / 10 ** power).toFixed(decimals) + (power ? `e${power}` : "");
  return `${minus(write(value))} ± ${minus(write(sd))} ${unit}`;
}

/** @returns {string} a number with its unit; the unit alone says nothing where nothing is known */
export function withUnit(value, unit) {
  const text = figures(value);
  return text === "–" ? text : `${text} ${unit}`;
}

/** A number at an axis. Ticks are round; what the machine adds in the 16th figure is not shown. */
export function tick(value) {
  const round = Number(value.toPrecision(9));
  return minus(round !== 0 && Math.abs(round) < 1e-3 ? round.toExponential() : String(round));
}

/** Bench time (s), with tenths, that does not change its width in a column of them. */
export const seconds = (t) => `${minus(t.toFixed(1))} s`;

const minus = (text) => text.replaceAll("-", "−");
