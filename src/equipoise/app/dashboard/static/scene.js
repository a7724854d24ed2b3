/** The 3-D view: when it is drawn, and of what. */

import { WebGLRenderer, Scene, PerspectiveCamera, HemisphereLight, DirectionalLight } from "./vendor/three.module.js";
import { palette } from "./colours.js";
import { Orbit } from "./orbit.js";
import { sayInstead } from "./instead.js";
import { paced } from "./pace.js";
import { dispose } from "./scene_makings.js";
import { Platform } from "./scene_platform.js";
import { Balance } from "./scene_balance.js";
import { room } from "./scene_room.js";

const PERIOD_MS = 1000 / 30;
const PERIOD_IN_SOFTWARE_MS = 1000 / 10; // without a graphics card the processor draws each pixel
const NO_WEBGL = "The 3-D view needs WebGL, which this browser does not offer here.";

/**
 * @param {HTMLElement} place
 * @param {import("./store.js").Store} store
 */
export function showScene(place, store) {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("webgl2", { antialias: devicePixelRatio < 2 });
  if (!context) {
    sayInstead(place, NO_WEBGL);
    return {};
  }
  return new View(place, store, canvas, context);
}

class View {
  constructor(place, store, canvas, context) {
    this.place = place;
    this.store = store;
    this.software = drawnInSoftware(context);
    this.renderer = new WebGLRenderer({ canvas, context, alpha: true });
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(32, 1, 0.01, 100);
    this.request = paced(() => this.draw(), this.software ? PERIOD_IN_SOFTWARE_MS : PERIOD_MS);
    this.rows = this.request;
    this.state = this.request;
    this.buildElements(canvas);
    this.scene.add(...lights());
    this.orbit = new Orbit(canvas, this.camera, this.request);
    new ResizeObserver(() => this.fit()).observe(place);
    canvas.addEventListener("webglcontextrestored", this.request);
  }

  buildElements(canvas) {
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", "The platform in 3-D. Arrow keys turn the view, plus and minus zoom.");
    this.caption = document.createElement("p");
    this.caption.className = "eq-caption";
    this.place.append(canvas, this.caption);
  }

  about() {
    this.factor = 0;
    this.recolour();
  }

  /** Build everything anew: the testbed or the theme is another. */
  recolour() {
    if (!this.store.about) return;
    if (this.contents) for (const content of this.contents) dispose(content);
    const colours = palette();
    this.platform = new Platform(this.store.about, colours);
    this.balance = new Balance(this.platform.radius, colours);
    this.platform.group.add(this.balance.inBody);
    this.contents = [room(this.platform.radius, this.store.about.layout, colours), this.platform.group, this.balance.inRoom];
    this.scene.add(...this.contents);
    this.orbit.reach(this.platform.radius);
    this.request();
  }

  fit() {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (!width || !height) return;
    this.renderer.setPixelRatio(this.software ? 1 : Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw(); // at once: another size has emptied the canvas
  }

  draw() {
    if (!this.platform) return;
    const { store } = this;
    this.platform.stand(store.last("pose"));
    this.platform.placeMasses(store.last("masses"));
    this.platform.turnWheels(store.last("wheels"));
    this.platform.turnGimbals(store.last("gimbals"));
    this.factor = this.balance.show(estimated(store), this.factor, this.platform.group);
    this.caption.textContent = this.factor
      ? `centre of mass × ${this.factor}, ellipsoid 1 sd`
      : "centre of mass not known yet";
    this.renderer.render(this.scene, this.camera);
  }
}

/**
 * Where the centre of mass is, from the rows, which come oftener, and its covariance, from the
 * estimate.
 * @returns {{com: number[], covariance: number[]}|null} m, m2
 */
function estimated(store) {
  const row = store.last("com");
  const estimate = store.state?.estimate;
  const com = row && row.slice(1, 4).every(Number.isFinite) ? row.slice(1, 4) : estimate?.com;
  if (!com) return null;
  return { com, covariance: estimate?.covariance ?? diagonal(row?.slice(4, 7)) };
}

function diagonal(sd) {
  const [x, y, z] = (sd ?? [0, 0, 0]).map((each) => (Number.isFinite(each) ? each ** 2 : 0));
  return [x, 0, 0, 0, y ?? 0, 0, 0, 0, z ?? 0];
}

function drawnInSoftware(context) {
  const names = context.getExtension("WEBGL_debug_renderer_info");
  const name = context.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : context.RENDERER);
  return /swiftshader|llvmpipe|software/i.test(String(name));
}

function lights() {
  const sky = new HemisphereLight(0xffffff, 0x8d8d99, 2.2);
  sky.position.set(0, 0, 1);
  const sun = new DirectionalLight(0xffffff, 1.6);
  sun.position.set(2, -3, 5);
  return [sky, sun];
}
