/**
 * The part of a recording that its charts show: zoom and pan, never beyond the whole.
 * @typedef {{from: number, length: number}} Span  s
 */

const SHORTEST_S = 0.05; // chosen: a few rows at 100 Hz

/** @returns {Span} the nearest span that lies within the whole */
export function within({ from, length }, whole) {
  const fitted = Math.min(Math.max(length, SHORTEST_S), whole.length);
  const last = whole.from + whole.length - fitted;
  return { from: Math.min(Math.max(from, whole.from), last), length: fitted };
}

/**
 * @param {Span} span
 * @param {Span} whole
 * @param {number} factor  of the length: below 1 shows less time, and more of it
 * @param {number} at  s, stays where it is in the picture
 */
export function zoomed(span, whole, factor, at) {
  const { length } = within({ from: span.from, length: span.length * factor }, whole);
  return within({ from: at - ((at - span.from) * length) / span.length, length }, whole);
}

/** @param {number} share  of the length; negative: earlier */
export function panned(span, whole, share) {
  return within({ from: span.from + share * span.length, length: span.length }, whole);
}

/** @returns {Span} what lies between two times, in whichever order */
export function between(one, other, whole) {
  return within({ from: Math.min(one, other), length: Math.abs(other - one) }, whole);
}

/** @returns {Span} the span, or one of the same length that begins at a time outside of it */
export function following(span, whole, t) {
  const shown = t >= span.from && t <= span.from + span.length;
  return shown ? span : within({ from: t, length: span.length }, whole);
}
