import assert from "node:assert/strict";
import { test } from "node:test";
import { drawn } from "../../src/equipoise/app/dashboard/static/decimate.js";
import { Series } from "../../src/equipoise/app/dashboard/static/series.js";

/** Rows of t, value, sd. */
function seriesOf(rows, valueAt, { dt = 0.01, sd = 0.5 } = {}) {
  const series = new Series(3, 100_000);
  for (let i = 0; i < rows; i++) series.push(Float64Array.of(i * dt, valueAt(i), sd));
  return series;
}

function draw(series, from, to, buckets, unit = 1) {
  const out = [[9, 9], [9], [], []]; // what was drawn before has to go
  const span = { from, to, length: Math.round(1000 * (to - from)) / 1000 };
  drawn(series, span, { values: 1, sd: true, unit, buckets }, out);
  return out;
}

test("few rows are drawn as they are, in the unit shown", () => {
  const out = draw(seriesOf(5, (i) => i), 0, 0.04, 100, 1e-3);
  assert.deepEqual(out[1], [0, 1000, 2000, 3000, 4000]);
  assert.deepEqual(out[2], [-500, 500, 1500, 2500, 3500]);
  assert.deepEqual(out[3], [500, 1500, 2500, 3500, 4500]);
});

test("a window takes one row beyond each edge, so that lines reach the edges", () => {
  const out = draw(seriesOf(100, (i) => i), 0.2, 0.3, 100);
  assert.equal(out[1][0], 19);
  assert.ok(out[0].at(-1) >= 0.3);
});

test("many rows become two for each bucket, and no spike is lost", () => {
  const series = seriesOf(10_000, (i) => (i === 5003 ? 40 : i === 7001 ? -30 : Math.sin(i)));
  const out = draw(series, 0, 100, 200);
  assert.ok(out[0].length <= 2 * 202, `${out[0].length} points`);
  assert.equal(Math.max(...out[1]), 40);
  assert.equal(Math.min(...out[1]), -30);
  assert.equal(Math.max(...out[3]), 40.5);
  assert.equal(Math.min(...out[2]), -30.5);
});

test("times of what is drawn grow", () => {
  const [times] = draw(seriesOf(10_000, Math.sin), 0, 100, 200);
  for (let i = 1; i < times.length; i++) assert.ok(times[i] > times[i - 1]);
});

test("the least comes before the greatest where it was before it", () => {
  const rising = draw(seriesOf(1000, (i) => i), 0, 10, 10)[1];
  const falling = draw(seriesOf(1000, (i) => -i), 0, 10, 10)[1];
  assert.ok(rising[0] < rising[1]);
  assert.ok(falling[0] > falling[1]);
});

test("a window that moves on leaves the buckets within it as they were", () => {
  const series = seriesOf(10_000, (i) => Math.sin(0.7 * i));
  const before = draw(series, 10, 60, 100);
  const after = draw(series, 10.1, 60.1, 100);
  const inside = ([times, values]) =>
    times.map((t, i) => [t, values[i]]).filter(([t]) => t > 11 && t < 59);
  assert.deepEqual(inside(after), inside(before));
});

test("what is not known is a gap, alone and in a bucket that knows nothing else", () => {
  assert.deepEqual(draw(seriesOf(3, (i) => (i === 1 ? NaN : i)), 0, 1, 100)[1], [0, null, 2]);
  const out = draw(seriesOf(1000, (i) => (i >= 300 && i < 400 ? NaN : 1)), 0, 10, 10);
  assert.deepEqual(out[1].slice(4, 10), [1, 1, null, null, 1, 1]);
  assert.deepEqual(out[2].slice(6, 8), [null, null]);
});

test("a value whose sd is not known keeps its line and has no band", () => {
  const out = draw(seriesOf(3, (i) => i, { sd: NaN }), 0, 1, 100);
  assert.deepEqual(out[1], [0, 1, 2]);
  assert.deepEqual(out[2], [null, null, null]);
});
