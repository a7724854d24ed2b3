/** Everything that the server has sent since its last `about`, and the views that receive it. */

import { decodeFrame } from "./frames.js";
import { Series } from "./series.js";

// Rows kept of each series: 20 min at 100 Hz, which is the longest span. Chosen.
const CAPACITY = 120_000;
const POSES_KEPT = 16; // only the newest is shown

/**
 * What a view may have. The first four are called after the store has changed, `redraw` when units
 * or span have, `recolour` when the theme has.
 * @typedef {{about?: () => void, rows?: () => void, step?: (step: object) => void,
 *   state?: () => void, redraw?: () => void, recolour?: () => void}} View
 */

export class Store {
  constructor() {
    /** @type {View[]} */
    this.views = [];
    this.frames = 0;
    this.forget(null);
  }

  /** Add a view, which receives at once what is there already. @param {View} view */
  show(view) {
    this.views.push(view);
    if (!this.about) return;
    view.about?.();
    for (const step of this.steps.values()) view.step?.(step);
    if (this.state) view.state?.();
    view.rows?.();
  }

  /** @param {string|ArrayBuffer} message  as it came through the socket */
  receive(message) {
    if (typeof message !== "string") return this.takeRows(decodeFrame(message));
    const reported = JSON.parse(message);
    if (reported.kind === "about") this.takeAbout(reported);
    else if (reported.kind === "step") this.takeStep(reported);
    else if (reported.kind === "state") this.takeState(reported);
  }

  forget(about) {
    this.about = about;
    /** @type {Map<string, Series>} */
    this.series = new Map();
    /** @type {Map<number, object>} */
    this.steps = new Map();
    this.state = null;
    this.t = null;
    this.began = null; // s, the first row
  }

  /** Each connection begins with `about`, and all that is kept comes again after it. */
  takeAbout(about) {
    this.forget(about);
    this.notify("about");
  }

  takeStep(step) {
    this.steps.set(step.index, step);
    this.notify("step", step);
  }

  takeState(state) {
    this.state = state;
    this.notify("state");
  }

  takeRows(frame) {
    this.frames++;
    this.t = frame.t;
    for (const part of frame.parts) {
      this.seriesFor(part).push(part.data);
      if (part.rows) this.began = Math.min(this.began ?? Infinity, part.data[0]);
    }
    this.notify("rows");
  }

  seriesFor({ name, columns }) {
    if (!this.series.has(name)) {
      this.series.set(name, new Series(columns, name === "pose" ? POSES_KEPT : CAPACITY));
    }
    return this.series.get(name);
  }

  /** @returns {number[]|null} the newest row of a series, time first */
  last(name) {
    return this.series.get(name)?.last() ?? null;
  }

  notify(what, ...rest) {
    for (const view of this.views) view[what]?.(...rest);
  }
}
