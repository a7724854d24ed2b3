/** Numbers that people like on axes and as factors: 1, 2 or 5 times a power of ten. */

/** @returns {number} the greatest 1-2-5 number that is not above `x` (> 0) */
export function niceBelow(x) {
  const power = 10 ** Math.floor(Math.log10(x) + 1e-12);
  const digit = x / power + 1e-9;
  return Number(((digit >= 5 ? 5 : digit >= 2 ? 2 : 1) * power).toPrecision(1));
}

const FLAT = 1; // of the unit shown, about a line that stays at zero; chosen

/**
 * A range of an axis that holds least and greatest with some room, and moves in steps only, so
 * that an axis stands still while its line wanders.
 * @returns {[number, number]}
 */
export function niceRange(least, greatest) {
  const width = greatest - least || Math.abs(greatest) * 0.1 || FLAT;
  const step = niceBelow(width / 4);
  const room = width * 0.06;
  return [Math.floor((least - room) / step) * step, Math.ceil((greatest + room) / step) * step];
}

/**
 * @param {(number|null|undefined)[]} values
 * @returns {[number, number]} the least and the greatest that are known; infinite: none is
 */
export function extent(values) {
  let [least, greatest] = [Infinity, -Infinity];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    if (value < least) least = value;
    if (value > greatest) greatest = value;
  }
  return [least, greatest];
}

const WANTED = 0.9; // of the radius in which the thing is shown, at most; chosen
const KEPT = [0.3, 1.2]; // the factor stays while the thing is shown between these; chosen

/**
 * The factor by which to exaggerate a small length: steady, in steps of 1-2-5, never below 1.
 * @param {number} length  m, what is to be visible
 * @param {number} radius  m, in which it is to be visible
 * @param {number} before  the factor until now; 0: none yet
 */
export function exaggeration(length, radius, before) {
  const share = (length * before) / radius;
  if (before && share > KEPT[0] && share < KEPT[1]) return before;
  if (!(length > 0) || !Number.isFinite(length)) return before || 1;
  return Math.max(1, niceBelow((WANTED * radius) / length));
}
