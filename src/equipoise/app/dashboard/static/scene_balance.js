/**
 * The centre of rotation, the centre of mass with its ellipsoid of one sd, and gravity there.
 * Both lengths are micrometres beside a platform of decimetres: they are exaggerated alike.
 */

import * as THREE from "./vendor/three.module.js";
import { eigen } from "./jacobi.js";
import { exaggeration } from "./nice.js";
import { along, arrow, label, lines, solid } from "./scene_makings.js";

const DOWN = [0, 0, -1];
const THINNEST = 0.012; // of the radius: a flat ellipsoid is still visible; chosen

export class Balance {
  /** @param {number} radius  m, of the platform */
  constructor(radius, colours) {
    this.radius = radius;
    this.com = solid(new THREE.SphereGeometry(0.03 * radius, 20, 14), colours.com);
    this.ellipsoid = solid(new THREE.SphereGeometry(1, 24, 16), colours.com, 0.4);
    this.lever = lines([[0, 0, 0], [0, 0, 1]], colours.com);
    this.word = label("com", colours.com, 0.15 * radius);
    this.word.center.set(-0.3, 0.5); // to the right of its point, whatever the view
    const centre = solid(new THREE.SphereGeometry(0.03 * radius, 16, 10), colours.text);
    for (const part of [this.com, this.ellipsoid, this.lever, centre]) drawOverBody(part);
    this.inBody = new THREE.Group().add(centre, this.com, this.ellipsoid, this.lever, this.word);
    this.inRoom = along(arrow(0.5 * radius, colours.text), DOWN);
    const g = label("g", colours.text, 0.17 * radius);
    g.position.z = 0.58 * radius;
    this.inRoom.add(g);
    this.inRoom.traverse((part) => part.isMesh && drawOverBody(part)); // the pedestal would hide it
  }

  /**
   * @param {{com: number[], covariance: number[]}|null} estimated  m, m2, body axes
   * @param {number} before  the factor until now
   * @param {THREE.Group} body
   * @returns {number} the factor shown, 0 where nothing is known
   */
  show(estimated, before, body) {
    const parts = [this.com, this.ellipsoid, this.lever, this.word];
    for (const part of parts) part.visible = estimated !== null;
    if (!estimated) {
      this.inRoom.position.set(0, 0, 0);
      return 0;
    }
    const { values, vectors } = eigen(estimated.covariance);
    const sds = values.map((variance) => Math.sqrt(Math.max(0, variance)));
    const observed = Math.hypot(...estimated.com) + Math.max(...sds);
    const factor = exaggeration(observed, this.radius, before);
    this.placeCom(estimated.com.map((c) => c * factor));
    this.shapeEllipsoid(sds.map((sd) => sd * factor), vectors);
    this.inRoom.position.copy(this.com.position).applyMatrix4(body.matrixWorld);
    return factor;
  }

  placeCom(at) {
    this.com.position.set(...at);
    this.ellipsoid.position.copy(this.com.position);
    this.word.position.copy(this.com.position);
    const ends = this.lever.geometry.attributes.position;
    ends.setXYZ(1, ...at);
    ends.needsUpdate = true;
    this.lever.geometry.computeBoundingSphere();
  }

  shapeEllipsoid(axes, vectors) {
    const [x, y, z] = vectors.map((vector) => new THREE.Vector3(...vector));
    this.ellipsoid.quaternion.setFromRotationMatrix(new THREE.Matrix4().makeBasis(x, y, z));
    this.ellipsoid.scale.set(...axes.map((axis) => Math.max(axis, THINNEST * this.radius)));
  }
}

/** The centre lies inside the body, and is what the view is for. */
function drawOverBody(part) {
  part.material.depthTest = false;
  part.material.transparent = true;
  part.renderOrder = 5;
}
