/** A recording that is there as a whole: the newest row of a series is the one at a time. */

import { Series } from "./series.js";
import { Store } from "./store.js";

export class ReplayStore extends Store {
  /**
   * @param {{about: object, steps: object[], state: object}} document
   * @param {{t: number, parts: import("./frames.js").Part[]}} frame  all rows
   */
  constructor(document, frame) {
    super();
    const recorded = new Map(frame.parts.map((part) => [part.name, part]));
    const series = document.about.series.filter(({ name }) => recorded.get(name)?.rows);
    this.takeAbout({ ...document.about, series });
    for (const step of document.steps) this.takeStep(step);
    this.takeState(document.state);
    this.takeRows(frame);
    const [from, to] = document.state.span;
    this.whole = { from, length: to - from };
    this.now = from;
    this.t = from;
  }

  seriesFor({ name, rows, columns }) {
    if (!this.series.has(name)) this.series.set(name, new Series(columns, Math.max(1, rows)));
    return this.series.get(name);
  }

  /** Go to a time (s) of the recording, and show the rows there. */
  go(t) {
    this.now = Math.min(Math.max(t, this.whole.from), this.whole.from + this.whole.length);
    this.t = this.now;
    this.notify("rows");
  }

  /** @returns {number[]|null} the last row of a series that is not after the time shown */
  last(name) {
    const series = this.series.get(name);
    const row = series ? series.firstAfter(this.now) - 1 : -1;
    return row < 0 ? null : series.row(row);
  }
}
