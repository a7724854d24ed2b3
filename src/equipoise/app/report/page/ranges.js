/** What charts of one record share: the stretch of the axis that they show, and a moment of it. */

const ranges = new Map();

/** @param {string} record @returns {Range} the one of this record */
export function rangeOf(record) {
  if (!ranges.has(record)) ranges.set(record, new Range());
  return ranges.get(record);
}

const CLOSEST = 1e-5; // of the whole, chosen: no zoom goes on beyond it

export class Range {
  constructor() {
    this.whole = [Infinity, -Infinity];
    this.shown = null; // [from, to]; null: the whole
    this.charts = [];
  }

  /** @param {{show: () => void, mark: (at: number) => void}} chart @param {number[]} x */
  join(chart, x) {
    this.whole = [Math.min(this.whole[0], x[0]), Math.max(this.whole[1], x.at(-1))];
    this.charts.push(chart);
  }

  get span() {
    return this.shown ?? this.whole;
  }

  /** Show a stretch, kept within the whole. */
  show(from, to) {
    const [first, last] = this.whole;
    const length = Math.min(Math.max(to - from, CLOSEST * (last - first)), last - first);
    const start = Math.min(Math.max(from, first), last - length);
    this.shown = length < last - first ? [start, start + length] : null;
    this.notify();
  }

  showWhole() {
    this.shown = null;
    this.notify();
  }

  /** Longer or shorter by a factor about a point; the middle if there is none. */
  zoom(factor, about = null) {
    const [from, to] = this.span;
    const at = about ?? (from + to) / 2;
    this.show(at - (at - from) * factor, at + (to - at) * factor);
  }

  /** Move by a share of what is shown. */
  pan(share) {
    const [from, to] = this.span;
    this.show(from + share * (to - from), to + share * (to - from));
  }

  /** Put the cursor of all charts at a moment. */
  mark(at) {
    for (const chart of this.charts) chart.mark(at);
  }

  notify() {
    for (const chart of this.charts) chart.show();
  }
}
