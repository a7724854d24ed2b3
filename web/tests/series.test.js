import assert from "node:assert/strict";
import { test } from "node:test";
import { Series } from "../../src/equipoise/app/dashboard/static/series.js";

const filled = (rows, capacity) => {
  const series = new Series(2, capacity);
  for (let t = 0; t < rows; t++) series.push(Float64Array.of(t, 10 * t));
  return series;
};

test("a series without rows has no last one", () => {
  const series = new Series(2, 4);
  assert.equal(series.rows, 0);
  assert.equal(series.last(), null);
  assert.equal(series.firstFrom(0), 0);
});

test("a ring that is not full keeps all rows in their order", () => {
  const series = filled(3, 4);
  assert.equal(series.rows, 3);
  assert.deepEqual([0, 1, 2].map((row) => series.at(row, 1)), [0, 10, 20]);
});

test("a ring that is full forgets the oldest rows", () => {
  const series = filled(11, 4);
  assert.equal(series.rows, 4);
  assert.deepEqual([0, 1, 2, 3].map((row) => series.at(row, 0)), [7, 8, 9, 10]);
  assert.deepEqual(series.last(), [10, 100]);
});

test("rows that come at once are rows one by one, across the ring's seam too", () => {
  const series = filled(3, 4);
  series.push(Float64Array.of(3, 30, 4, 40, 5, 50));
  assert.deepEqual([0, 1, 2, 3].map((row) => series.at(row, 1)), [20, 30, 40, 50]);
});

test("a ring holds no more memory after a million rows than when it was made", () => {
  const series = new Series(2, 16);
  for (let i = 0; i < 1000; i++) series.push(new Float64Array(2000));
  assert.deepEqual(series.kept.map((column) => column.length), [16, 16]);
  assert.equal(series.rows, 16);
});

test("the first row from a time on is found, before, between and after all", () => {
  const series = filled(11, 4); // times 7, 8, 9, 10
  assert.deepEqual([0, 7, 7.5, 10, 10.1].map((t) => series.firstFrom(t)), [0, 0, 1, 3, 4]);
});

test("the first row after a time is found; one at that time is not after it", () => {
  const series = filled(11, 4); // times 7, 8, 9, 10
  assert.deepEqual([0, 7, 7.5, 10].map((t) => series.firstAfter(t)), [0, 1, 1, 4]);
  assert.deepEqual(series.row(1), [8, 80]);
});

test("numbers that make no whole row are refused", () => {
  assert.throws(() => new Series(2, 4).push(Float64Array.of(1, 2, 3)), RangeError);
});
