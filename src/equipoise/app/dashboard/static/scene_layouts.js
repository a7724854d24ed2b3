/**
 * How a platform sits on its bearing: what of it turns, and what it sits in.
 * Of the layouts nothing but the kind is known: the proportions are a picture's.
 */

import * as THREE from "./vendor/three.module.js";
import { solid } from "./scene_makings.js";

const BALL = 0.19; // of the platform's radius
const GLASS = 0.38; // masses and centre of mass are seen through it
const ROUND = 48; // sides of what is round

/**
 * @param {string} layout  as `about` has it
 * @param {number} r  m, of the platform
 * @returns {THREE.Group} centre of rotation at the origin, up along +z, a shaft along +x
 */
export function bodyOf(layout, r, colours) {
  return new THREE.Group().add(...BODIES[layout](r, colours));
}

/** @returns {{top: number, ball: number}} the pedestal's top and its radius there, of the radius */
export function cupOf(layout) {
  return layout === "spherical-rotor" ? { top: -0.85, ball: 0.53 } : { top: -0.12, ball: 0.2 };
}

const BODIES = {
  "table-top": (r, colours) => [...deck(r, 0.1 * r, colours), halfBall(r, colours)],

  umbrella: (r, colours) => {
    const canopy = outlined(new THREE.CylinderGeometry(0.3 * r, r, 0.34 * r, ROUND, 1, true), colours);
    for (const part of canopy) standing(part).position.z = 0.27 * r;
    canopy[0].material.side = THREE.DoubleSide;
    const lid = solid(new THREE.CylinderGeometry(0.3 * r, 0.3 * r, 0.03 * r, ROUND), colours.body, 0.75);
    const post = solid(new THREE.CylinderGeometry(0.06 * r, 0.06 * r, 0.44 * r, 20), colours.metal);
    standing(lid).position.z = 0.44 * r;
    standing(post).position.z = 0.22 * r;
    return [...canopy, lid, post, halfBall(r, colours)];
  },

  dumbbell: (r, colours) => {
    const shaft = solid(new THREE.CylinderGeometry(0.06 * r, 0.06 * r, 1.8 * r, 20), colours.metal);
    const ends = [-0.9, 0.9].flatMap((at) => {
      const parts = outlined(new THREE.CylinderGeometry(0.55 * r, 0.55 * r, 0.07 * r, ROUND), colours);
      for (const part of parts) lying(part).position.x = at * r;
      return parts;
    });
    return [lying(shaft), ...ends, solid(new THREE.SphereGeometry(BALL * r, 28, 20), colours.body, 0.75)];
  },

  "spherical-rotor": (r, colours) => {
    const sphere = solid(new THREE.SphereGeometry(r, ROUND, 32), colours.body, GLASS);
    const rings = [0, Math.PI / 2].map((turn) => {
      const ring = outline(new THREE.CylinderGeometry(r, r, 0, ROUND), colours);
      ring.rotation.x = turn; // the equator, and a meridian
      return ring;
    });
    return [standing(sphere), ...rings];
  },
};

function deck(radius, thickness, colours) {
  return outlined(new THREE.CylinderGeometry(radius, radius, thickness, ROUND), colours).map(standing);
}

function halfBall(r, colours) {
  const half = [0, 2 * Math.PI, Math.PI / 2, Math.PI / 2];
  return standing(solid(new THREE.SphereGeometry(BALL * r, 28, 14, ...half), colours.body, 0.75));
}

function outlined(geometry, colours) {
  return [solid(geometry, colours.body, GLASS), outline(geometry, colours)];
}

function outline(geometry, colours) {
  const material = new THREE.LineBasicMaterial({ color: colours.quiet });
  return new THREE.LineSegments(new THREE.EdgesGeometry(geometry, 30), material);
}

/** three.js stands round things along y: from there to +z, or to +x. */
function standing(thing) {
  thing.rotation.x = Math.PI / 2;
  return thing;
}

function lying(thing) {
  thing.rotation.z = -Math.PI / 2;
  return thing;
}
