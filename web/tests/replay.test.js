import assert from "node:assert/strict";
import { test } from "node:test";
import { ReplayStore } from "../../src/equipoise/app/dashboard/static/replay_store.js";
import { csvOf } from "../../src/equipoise/app/dashboard/static/save.js";
import { Series } from "../../src/equipoise/app/dashboard/static/series.js";

const step = { kind: "step", index: 0, of: "move", t: 2, sentence: "moved", outcome: null };
const part = { name: "com", rows: 3, columns: 2, data: Float64Array.of(1, 10, 2, 20, 3, 30) };
const replay = () => new ReplayStore(
  { about: { series: [{ name: "com" }, { name: "wheels" }] }, steps: [step], state: { span: [1, 4] } },
  { t: 4, parts: [part] },
);

test("a replay begins at the first row, with all rows and steps, and without empty series", () => {
  const store = replay();
  assert.deepEqual([store.now, store.whole, store.steps.size], [1, { from: 1, length: 3 }, 1]);
  assert.deepEqual(store.about.series, [{ name: "com" }]);
  assert.equal(store.series.get("com").rows, 3);
});

test("what is shown at a time is the last row that is not after it", () => {
  const store = replay();
  const shown = [1, 1.99, 2, 2.5, 3, 9].map((t) => {
    store.go(t);
    return store.last("com")[1];
  });
  assert.deepEqual(shown, [10, 10, 20, 20, 30, 30]);
  assert.equal(store.now, 4);
  assert.equal(store.last("wheels"), null);
});

test("a time before the first row of a series has no row", () => {
  const store = replay();
  store.now = 0.5;
  assert.equal(store.last("com"), null);
});

test("views are called at each time that is gone to", () => {
  const store = replay();
  let called = 0;
  store.show({ rows: () => called++ });
  store.go(2);
  assert.equal(called, 2);
});

const reported = { name: "com", columns: ["x", "potential (gravity)"], sd: true, unit: { bench: ["uN m", 1e-6], si: ["N m", 1] } };
const filled = () => {
  const series = new Series(5, 4);
  for (let t = 0; t < 4; t++) series.push(Float64Array.of(t, t * 1e-6, NaN, 0.5, 0.25));
  return series;
};

test("a table has the rows of the part shown, in the unit shown, with their sds", () => {
  const text = csvOf(filled(), reported, { kind: "si", from: 1, to: 2, hidden: new Set() });
  assert.equal(text, "time_s,com_x_N_m,com_potential_gravity_N_m,com_x_sd_N_m,com_potential_gravity_sd_N_m\n1,0.000001,,0.5,0.25\n2,0.000002,,0.5,0.25\n");
});

test("a line that is hidden is not in the table, nor is its sd", () => {
  const text = csvOf(filled(), reported, { kind: "bench", from: 2.5, to: 9, hidden: new Set([1]) });
  assert.deepEqual(text.split("\n").slice(0, 2), ["time_s,com_x_uN_m,com_x_sd_uN_m", "3,3,500000"]);
});

test("shares are in percent, and what has no unit has none in its name", () => {
  const names = [["%", "percent"], ["-", "com_x"], ["rad/s", "com_x_rad_s"], ["", "com_x"]];
  for (const [unit, ending] of names) {
    const one = { name: "com", columns: ["x"], sd: false, unit: { bench: [unit, 1] } };
    const head = csvOf(filled(), one, { kind: "bench", from: 9, to: 9, hidden: new Set() });
    assert.ok(head.endsWith(`${ending}\n`), head);
  }
});
