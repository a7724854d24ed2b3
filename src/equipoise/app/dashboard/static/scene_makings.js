/** What the things of the scene are made of, and how they are taken apart. */

import * as THREE from "./vendor/three.module.js";

const LABEL_PX = 64;

/** @returns {THREE.Mesh} dull, as painted metal */
export function solid(geometry, colour, opacity = 1) {
  const material = new THREE.MeshLambertMaterial({
    color: colour,
    transparent: opacity < 1,
    opacity,
    depthWrite: opacity === 1,
  });
  return new THREE.Mesh(geometry, material);
}

/** @returns {THREE.LineSegments} from points two by two */
export function lines(points, colour, opacity = 1) {
  const geometry = new THREE.BufferGeometry().setFromPoints(points.map((p) => new THREE.Vector3(...p)));
  const material = new THREE.LineBasicMaterial({ color: colour, transparent: opacity < 1, opacity });
  return new THREE.LineSegments(geometry, material);
}

/** @returns {THREE.Group} an arrow from the origin along +z, `length` (m) with its head */
export function arrow(length, colour) {
  const thick = length * 0.018;
  const head = length * 0.14;
  const shaft = solid(new THREE.CylinderGeometry(thick, thick, length - head, 10), colour);
  const tip = solid(new THREE.ConeGeometry(3 * thick, head, 14), colour);
  shaft.position.z = (length - head) / 2;
  tip.position.z = length - head / 2;
  // three.js stands cylinders and cones along y.
  for (const part of [shaft, tip]) part.rotation.x = Math.PI / 2;
  return new THREE.Group().add(shaft, tip);
}

/** Turns a thing that was made along +z to the direction. @param {number[]} direction  unit */
export function along(thing, direction) {
  thing.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), new THREE.Vector3(...direction));
  return thing;
}

/** @returns {THREE.Sprite} a few letters that always face the viewer, `size` (m) high */
export function label(text, colour, size) {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d");
  const font = `600 ${LABEL_PX * 0.75}px system-ui, "DejaVu Sans", sans-serif`;
  context.font = font;
  canvas.width = Math.ceil(context.measureText(text).width) + 8;
  canvas.height = LABEL_PX;
  Object.assign(context, { font, fillStyle: colour, textAlign: "center", textBaseline: "middle" });
  context.fillText(text, canvas.width / 2, LABEL_PX / 2);
  const map = new THREE.CanvasTexture(canvas);
  map.colorSpace = THREE.SRGBColorSpace;
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map, depthTest: false }));
  sprite.scale.set((size * canvas.width) / LABEL_PX, size, 1);
  sprite.renderOrder = 10; // over all that is translucent
  return sprite;
}

/** Take a thing out of its scene and give back what it holds on the graphics card. */
export function dispose(thing) {
  thing.removeFromParent();
  thing.traverse((part) => {
    part.geometry?.dispose();
    part.material?.map?.dispose();
    part.material?.dispose();
  });
}
