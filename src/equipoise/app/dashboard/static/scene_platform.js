/** The platform: its body and axes, its masses on their rails, wheels and gyros. Body axes. */

import * as THREE from "./vendor/three.module.js";
import { bodyOf } from "./scene_layouts.js";
import { along, arrow, label, lines, solid } from "./scene_makings.js";

const SMALLEST = 0.15; // m, radius of a platform whose masses have no stated places
const AXES = [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]];
// A wheel is drawn turning at a fiftieth of its rate; at the whole one it would seem to stand or
// to turn back in a picture that is drawn 10 to 30 times a second. Chosen.
const SLOWER = 0.02;

export class Platform {
  constructor(about, colours) {
    this.about = about;
    this.radius = radiusOf(about.masses);
    this.group = new THREE.Group();
    this.group.add(this.body(colours), ...this.axes(colours));
    this.masses = about.masses.map((mass) => this.mass(mass, colours));
    this.wheels = about.wheels.map((wheel, i) => this.wheel(wheel, i, colours));
    this.gyros = about.gyros.map((gyro, i) => this.gyro(gyro, about.wheels.length + i, colours));
    this.lastTurn_s = null;
  }

  body(colours) {
    return along(bodyOf(this.about.layout, this.radius, colours), this.about.up);
  }

  axes(colours) {
    return AXES.flatMap(([name, direction], i) => {
      const colour = colours.lines[i];
      const word = label(name, colour, 0.2 * this.radius);
      word.position.set(...direction.map((d) => d * 1.37 * this.radius));
      return [along(arrow(1.25 * this.radius, colour), direction), word];
    });
  }

  mass(mass, colours) {
    const ends = mass.travel.map((way) => mass.home.map((home, i) => home + way * mass.axis[i]));
    const colour = colours.lines[axisOf(mass.axis)];
    const box = solid(new THREE.BoxGeometry(...Array(3).fill(0.13 * this.radius)), colour);
    along(box, mass.axis);
    box.position.set(...mass.home);
    this.group.add(lines(ends, colours.text), box);
    return { box, home: new THREE.Vector3(...mass.home), axis: new THREE.Vector3(...mass.axis) };
  }

  /** Each lies across its axis. */
  wheel(wheel, i, colours) {
    const spun = this.rotor(colours);
    const held = along(new THREE.Group().add(spun), wheel.axis);
    held.position.copy(this.devicePlace(i));
    this.group.add(held);
    return spun;
  }

  /** A rotor that its gimbal, drawn as a line, turns. */
  gyro({ gimbal, spin }, i, colours) {
    const ends = [-0.3, 0.3].map((way) => gimbal.map((part) => way * this.radius * part));
    const turned = new THREE.Group().add(along(this.rotor(colours), spin));
    const held = new THREE.Group().add(lines(ends, colours.text), turned);
    held.position.copy(this.devicePlace(i));
    this.group.add(held);
    return { turned, gimbal: new THREE.Vector3(...gimbal) };
  }

  /** A disc with spokes across +z. */
  rotor(colours) {
    const r = 0.2 * this.radius;
    const rotor = solid(new THREE.CylinderGeometry(r, r, 0.3 * r, 24), colours.metal);
    rotor.rotation.x = Math.PI / 2;
    const height = 0.16 * r;
    const spokes = lines([[-r, 0, height], [r, 0, height], [0, -r, height], [0, r, height]], colours.panel);
    return new THREE.Group().add(rotor, spokes);
  }

  /** The places of wheels and gyros are not stated: they stand round the centre, on top. */
  devicePlace(i) {
    const turn = 0.5 + (2 * Math.PI * i) / (this.about.wheels.length + this.about.gyros.length);
    const place = new THREE.Vector3(Math.cos(turn), Math.sin(turn), 0.45).multiplyScalar(0.5 * this.radius);
    return place.applyQuaternion(along(new THREE.Object3D(), this.about.up).quaternion);
  }

  /** @param {number[]|null} pose  t, then body to laboratory, scalar first; three.js has it last */
  stand(pose) {
    if (!pose || !pose.every(Number.isFinite)) return;
    const [, w, x, y, z] = pose;
    this.group.quaternion.set(x, y, z, w).normalize();
    this.group.updateMatrixWorld();
  }

  /** @param {number[]|null} row  t, then displacements (m) along the axes */
  placeMasses(row) {
    if (!row) return;
    this.masses.forEach(({ box, home, axis }, i) => {
      if (Number.isFinite(row[1 + i])) box.position.copy(home).addScaledVector(axis, row[1 + i]);
    });
  }

  /** @param {number[]|null} row  t, then rates (rad/s) */
  turnWheels(row) {
    if (!row) return;
    const since_s = row[0] - (this.lastTurn_s ?? row[0]);
    this.lastTurn_s = row[0];
    this.wheels.forEach((wheel, i) => {
      if (Number.isFinite(row[1 + i])) wheel.rotation.z += SLOWER * row[1 + i] * since_s;
    });
  }

  /** @param {number[]|null} row  t, then angles (rad) of the gimbals */
  turnGimbals(row) {
    if (!row) return;
    this.gyros.forEach(({ turned, gimbal }, i) => {
      if (Number.isFinite(row[1 + i])) turned.setRotationFromAxisAngle(gimbal, row[1 + i]);
    });
  }
}

function radiusOf(masses) {
  const reaches = masses.flatMap(({ home, axis, travel }) =>
    travel.map((way) => Math.hypot(...home.map((h, i) => h + way * axis[i]))),
  );
  return Math.max(SMALLEST, ...reaches);
}

/** @returns {number} 0, 1, 2: the axis along which a direction lies mostly */
function axisOf(direction) {
  const sizes = direction.map(Math.abs);
  return sizes.indexOf(Math.max(...sizes));
}
