/** What stands still: floor, pedestal with the bearing's cup, the centre of rotation, up. */

import * as THREE from "./vendor/three.module.js";
import { cupOf } from "./scene_layouts.js";
import { arrow, label, lines, solid } from "./scene_makings.js";

const FLOOR = -1.25; // of the platform's radius, below the centre of rotation
const CELLS = 8; // of the floor's grid, from its middle to each side

/**
 * @param {number} radius  m, of the platform
 * @param {string} layout  as `about` has it
 * @returns {THREE.Group} laboratory axes, z up
 */
export function room(radius, layout, colours) {
  const group = new THREE.Group();
  group.add(floor(radius, colours), pedestal(radius, cupOf(layout), colours));
  const up = arrow(0.5 * radius, colours.quiet);
  const word = label("up", colours.quiet, 0.17 * radius);
  up.position.set(-1.3 * radius, -0.95 * radius, FLOOR * radius); // to the left, in the first view
  word.position.copy(up.position).add(new THREE.Vector3(0, 0, 0.62 * radius));
  return group.add(up, word);
}

function floor(radius, colours) {
  const cell = (2.2 * radius) / CELLS;
  const reach = cell * CELLS;
  const points = [];
  for (let i = -CELLS; i <= CELLS; i++) {
    points.push([i * cell, -reach, 0], [i * cell, reach, 0], [-reach, i * cell, 0], [reach, i * cell, 0]);
  }
  const grid = lines(points, colours.quiet, 0.28);
  grid.position.z = FLOOR * radius;
  return grid;
}

/** Its top is the cup, in which the platform sits. */
function pedestal(radius, cup, colours) {
  const height = (cup.top - FLOOR) * radius;
  const foot = Math.max(0.34, cup.ball) * radius;
  const column = solid(new THREE.CylinderGeometry(cup.ball * radius, foot, height, 28), colours.metal);
  column.rotation.x = Math.PI / 2;
  column.position.z = FLOOR * radius + height / 2;
  return new THREE.Group().add(column);
}
