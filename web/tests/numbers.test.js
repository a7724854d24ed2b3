import assert from "node:assert/strict";
import { test } from "node:test";
import { lineStyles } from "../../src/equipoise/app/dashboard/static/colours.js";
import { tilt } from "../../src/equipoise/app/dashboard/static/numbers.js";

const about = (axis, angle) => [0, Math.cos(angle / 2), ...axis.map((a) => a * Math.sin(angle / 2))];

test("tilt is the angle that the body's upright axis was turned by, and heading is none", () => {
  for (const axis of [[1, 0, 0], [0, 1, 0], [0.6, 0.8, 0]]) {
    assert.ok(Math.abs(tilt(about(axis, 0.1234), [0, 0, 1]) - 0.1234) < 1e-12);
  }
  assert.ok(tilt(about([0, 0, 1], 2), [0, 0, 1]) < 1e-7);
});

test("tilt of a platform whose x axis points up is none when x is up", () => {
  assert.ok(tilt(about([0, 1, 0], -Math.PI / 2), [1, 0, 0]) < 1e-7);
  assert.ok(Math.abs(tilt(about([0, 1, 0], 0), [1, 0, 0]) - Math.PI / 2) < 1e-12);
});

test("tilt is not known before a pose", () => assert.ok(Number.isNaN(tilt(null, [0, 0, 1]))));

test("columns of an axis have its colour, and differ by dashes where there are more", () => {
  assert.deepEqual(lineStyles(["x", "y", "z"]).map((style) => style.colour), [0, 1, 2]);
  assert.deepEqual(lineStyles(["wheel:z", "com_x"]).map((style) => style.colour), [2, 0]);
  const [x1, x2, y1] = lineStyles(["x1", "x2", "y1"]);
  assert.equal(x1.colour, x2.colour);
  assert.notDeepEqual(x1.dash, x2.dash);
  assert.deepEqual(y1, { colour: 1, dash: [] });
});

test("columns without axes have colours by turn", () => {
  assert.deepEqual(lineStyles(["tilt", "rate", "travel"]).map((style) => style.colour), [0, 1, 2]);
  assert.deepEqual(lineStyles(["kinetic", "energy"])[1], { colour: 1, dash: [] });
});
