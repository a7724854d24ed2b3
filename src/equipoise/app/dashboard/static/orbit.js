/** Walking round the platform with mouse, finger or keys; it stays in the middle of the view. */

const PER_PIXEL = 0.008; // rad, chosen
const PER_KEY = 0.12; // rad, chosen
const HEIGHTS = [-0.25, 1.5]; // rad above the horizon: not below the floor, not over the top
const ZOOMS = [0.45, 3];

/** Turn to the left, turn up, zoom. */
const KEYS = {
  ArrowLeft: [PER_KEY, 0, 1],
  ArrowRight: [-PER_KEY, 0, 1],
  ArrowUp: [0, PER_KEY, 1],
  ArrowDown: [0, -PER_KEY, 1],
  "+": [0, 0, 0.9],
  "=": [0, 0, 0.9], // plus without its shift key
  "-": [0, 0, 1 / 0.9],
};

export class Orbit {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {import("./vendor/three.module.js").PerspectiveCamera} camera
   * @param {() => void} moved
   */
  constructor(canvas, camera, moved) {
    Object.assign(this, { camera, moved, heading: -0.95, height: 0.42, zoom: 1, distance: 1 });
    camera.up.set(0, 0, 1);
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      if (!canvas.hasPointerCapture(event.pointerId)) return;
      this.turn(-event.movementX * PER_PIXEL, event.movementY * PER_PIXEL, 1);
    });
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.turn(0, 0, Math.exp(event.deltaY * 0.001));
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const change = KEYS[event.key];
      if (!change || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      this.turn(...change);
    });
  }

  /** Stand so far away that a platform of this radius (m), and what it stands on, fit. */
  reach(radius) {
    this.distance = 5.6 * radius;
    this.lower = 0.1 * radius;
    this.turn(0, 0, 1);
  }

  turn(heading, height, zoom) {
    this.heading += heading;
    this.height = clamp(this.height + height, HEIGHTS);
    this.zoom = clamp(this.zoom * zoom, ZOOMS);
    const away = this.distance * this.zoom;
    const flat = away * Math.cos(this.height);
    const z = away * Math.sin(this.height) - this.lower;
    this.camera.position.set(flat * Math.cos(this.heading), flat * Math.sin(this.heading), z);
    this.camera.lookAt(0, 0, -this.lower);
    this.moved();
  }
}

const clamp = (x, [least, greatest]) => Math.max(least, Math.min(greatest, x));
