/** The time of a replay: play, pause, a speed, and a bar with the steps on it. */

import { make } from "./chart_heading.js";
import { seconds } from "./units.js";

const SPEEDS = { 0.25: "¼ ×", 0.5: "½ ×", 1: "1 ×", 2: "2 ×", 5: "5 ×", 20: "20 ×" };
const THUMB_PX = 16; // the bar ends half of its thumb before its edges

export class Player {
  /**
   * @param {HTMLElement} place
   * @param {import("./replay_store.js").ReplayStore} store
   * @param {(t: number) => void} moved  the time has been moved
   */
  constructor(place, store, moved) {
    Object.assign(this, { store, moved, speed: 1, since_ms: null });
    this.button = make("button", "eq-press", place);
    this.button.type = "button";
    this.button.addEventListener("click", () => this.turn(!this.playing));
    this.buildBar(make("div", "eq-bar", place));
    this.time = make("output", "eq-now", place);
    this.time.setAttribute("aria-live", "off");
    this.time.setAttribute("aria-label", "Time");
    this.buildSpeeds(place);
    this.turn(false);
    this.go(store.whole.from);
  }

  buildBar(place) {
    const { from, length } = this.store.whole;
    this.bar = make("input", "", place);
    Object.assign(this.bar, { type: "range", min: from, max: from + length, step: "any" });
    this.bar.setAttribute("aria-label", "Time of the recording");
    this.bar.addEventListener("input", () => this.go(Number(this.bar.value)));
    for (const step of this.store.steps.values()) {
      const share = Math.min(1, Math.max(0, (step.t - from) / (length || 1)));
      const mark = make("i", "eq-mark", place);
      mark.style.left = `calc(${THUMB_PX / 2}px + (100% - ${THUMB_PX}px) * ${share})`;
      mark.title = `${seconds(step.t)} ${step.of}`;
    }
  }

  buildSpeeds(place) {
    const select = make("select", "eq-choice", place);
    select.setAttribute("aria-label", "Speed");
    for (const [value, text] of Object.entries(SPEEDS)) {
      Object.assign(make("option", "", select), { value, textContent: text });
    }
    select.value = "1";
    select.addEventListener("change", () => (this.speed = Number(select.value)));
  }

  get end() {
    return this.store.whole.from + this.store.whole.length;
  }

  /** Play, or pause; at the end it begins again. */
  turn(on) {
    if (on && this.store.now >= this.end) this.go(this.store.whole.from);
    this.playing = on;
    this.since_ms = null;
    this.button.textContent = on ? "Pause" : "Play";
    if (on) requestAnimationFrame((now_ms) => this.advance(now_ms));
  }

  advance(now_ms) {
    if (!this.playing) return;
    const passed_s = (now_ms - (this.since_ms ?? now_ms)) / 1000;
    this.since_ms = now_ms;
    this.go(this.store.now + this.speed * passed_s);
    if (this.store.now >= this.end) this.turn(false);
    else requestAnimationFrame((next_ms) => this.advance(next_ms));
  }

  go(t) {
    this.store.go(t);
    this.bar.value = this.store.now;
    this.bar.setAttribute("aria-valuetext", seconds(this.store.now));
    this.time.textContent = `${seconds(this.store.now)} of ${seconds(this.end)}`;
    this.moved(this.store.now);
  }
}
