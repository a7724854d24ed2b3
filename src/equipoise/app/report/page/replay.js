/** The recorded motion in 3-D, as the dashboard shows it live, with play, pause and a time slider. */

import { SphereGeometry, Matrix4, Vector3 } from "./vendor/three.module.js";
import { make } from "./chart_heading.js";
import { palette } from "./colours.js";
import { reported } from "./embedded.js";
import { rangeOf } from "./ranges.js";
import { showScene } from "./scene.js";
import { solid } from "./scene_makings.js";
import { followTheme } from "./theme.js";
import { seconds } from "./units.js";

const SPEEDS = [0.5, 1, 2, 5, 10];
const OPACITY = 0.3; // of the inertia ellipsoid, chosen: the body is seen through it

class Player {
  constructor(place, block) {
    Object.assign(this, { block, at: block.t[0], speed: 1, playing: false });
    this.range = rangeOf(block.record);
    const live = place.querySelector(".live");
    live.hidden = false;
    this.store = storeOf(block);
    const scene = make("div", "scene", live);
    scene.addEventListener("wheel", letPageScroll, { capture: true });
    this.view = showScene(scene, this.store);
    this.addTools(make("div", "tools", live));
    place.hidden = false;
    this.view.about?.();
    followTheme(() => this.recolour());
    this.place(this.at);
  }

  addTools(tools) {
    this.button = make("button", "", tools);
    this.button.type = "button";
    this.button.textContent = "Play";
    this.button.addEventListener("click", () => this.play(!this.playing));
    this.slider = make("input", "", tools);
    Object.assign(this.slider, { type: "range", min: this.block.t[0], max: this.block.t.at(-1), step: "any" });
    this.slider.setAttribute("aria-label", "Time of the replay");
    this.slider.addEventListener("input", () => this.go(Number(this.slider.value)));
    this.clock = make("output", "", tools);
    const label = make("label", "", tools);
    label.append("Speed ");
    const speed = make("select", "", label);
    for (const factor of SPEEDS) speed.add(new Option(`${factor} ×`, factor, factor === 1, factor === 1));
    speed.addEventListener("change", () => (this.speed = Number(speed.value)));
  }

  play(on) {
    const end = this.block.t.at(-1);
    if (on && this.at >= end) this.go(this.block.t[0]);
    this.playing = on;
    this.button.textContent = on ? "Pause" : "Play";
    let before_ms = null;
    const turn = (now_ms) => {
      if (!this.playing) return;
      if (before_ms !== null) this.go(this.at + ((now_ms - before_ms) / 1000) * this.speed);
      before_ms = now_ms;
      if (this.at >= end) this.play(false);
      else requestAnimationFrame(turn);
    };
    if (on) requestAnimationFrame(turn);
  }

  /** Show a moment (s), here and under the cursor of the record's charts. */
  go(t) {
    this.place(t);
    this.range.mark(this.at);
  }

  place(t) {
    this.at = Math.min(Math.max(t, this.block.t[0]), this.block.t.at(-1));
    this.store.at = rowAt(this.block.t, this.at);
    this.slider.value = this.at;
    this.clock.textContent = seconds(this.at);
    this.view.rows?.();
  }

  recolour() {
    this.view.recolour?.();
    if (this.view.platform && this.block.ellipsoid) this.view.platform.group.add(ellipsoid(this.block));
  }
}

/** The wheel zooms with Ctrl, as it does over charts. */
function letPageScroll(event) {
  if (!event.ctrlKey) event.stopPropagation();
}

/** What the scene reads: the geometry, the newest rows, the estimate. */
function storeOf(block) {
  const masses = block.masses;
  const about = { masses, wheels: [], gyros: [], up: block.up, layout: block.layout };
  const rows = {
    pose: (i) => [block.t[i], ...block.attitude[i]],
    masses: (i) => [block.t[i], ...block.displacements[i]],
  };
  return {
    about,
    at: 0,
    state: { estimate: block.com && { com: block.com, covariance: block.com_covariance } },
    last(name) {
      return rows[name]?.(this.at) ?? null;
    },
  };
}

/** The ellipsoid of even density with the body's inertia, true to scale about the centre of mass. */
function ellipsoid({ ellipsoid: { semi_axes, directions }, com }) {
  const mesh = solid(new SphereGeometry(1, 32, 20), palette().lines[4], OPACITY);
  const basis = directions.map((direction) => new Vector3(...direction));
  if (new Matrix4().makeBasis(...basis).determinant() < 0) basis[2].negate();
  mesh.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(...basis));
  mesh.scale.set(...semi_axes);
  mesh.position.set(...com);
  return mesh;
}

/** @returns {number} the last row that is not after t */
function rowAt(t, at) {
  let [low, high] = [0, t.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (t[middle] <= at) low = middle;
    else high = middle - 1;
  }
  return low;
}

window.equipoiseReport.replays = reported("replay").map(({ place, block }) => new Player(place, block));
