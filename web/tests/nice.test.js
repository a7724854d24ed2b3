import assert from "node:assert/strict";
import { test } from "node:test";
import { exaggeration, extent, niceBelow, niceRange } from "../../src/equipoise/app/dashboard/static/nice.js";

test("nice numbers are 1, 2 or 5 times a power of ten, just below", () => {
  const pairs = [[1, 1], [1.9, 1], [2, 2], [4.99, 2], [5, 5], [9.9, 5], [10, 10], [1000, 1000], [0.003, 0.002], [0.1, 0.1]];
  for (const [x, nice] of pairs) assert.equal(niceBelow(x), nice);
});

test("a length is exaggerated until it fills a third to nine tenths of its room", () => {
  for (let length = 1e-7; length < 0.05; length *= 1.7) {
    const factor = exaggeration(length, 0.2, 0);
    const share = (factor * length) / 0.2;
    assert.ok((share > 0.35 && share <= 0.9) || factor === 1, `${length} m is shown at ${share}`);
    assert.ok([1, 2, 5].includes(Number(factor.toExponential()[0])), `${factor}`);
  }
});

test("the factor stays while the length changes by a third, and follows a greater change", () => {
  const factor = exaggeration(100e-6, 0.2, 0);
  assert.equal(factor, 1000);
  assert.equal(exaggeration(135e-6, 0.2, factor), 1000);
  assert.equal(exaggeration(70e-6, 0.2, factor), 1000);
  assert.equal(exaggeration(5e-6, 0.2, factor), 20_000);
  assert.equal(exaggeration(5e-3, 0.2, factor), 20);
});

test("what is nowhere or not known changes no factor", () => {
  assert.equal(exaggeration(0, 0.2, 200), 200);
  assert.equal(exaggeration(NaN, 0.2, 200), 200);
  assert.equal(exaggeration(0, 0.2, 0), 1);
});

test("a range holds what it has to, with room, and stands still for a little more", () => {
  const [least, greatest] = niceRange(-3.2, 4.1);
  assert.ok(least < -3.2 && greatest > 4.1);
  assert.ok(greatest - least < 2 * 7.3);
  assert.deepEqual(niceRange(-3.25, 4.15), [least, greatest]);
});

test("a range of one value, of zero too, has a width", () => {
  for (const value of [0, 5, -2e-6]) {
    const [least, greatest] = niceRange(value, value);
    assert.ok(least < value && value < greatest);
  }
});

test("a line that stays at zero gets round ticks of about one unit, not of rounding errors", () => {
  const [least, greatest] = niceRange(0, 0);
  assert.ok(least <= -0.05 && least >= -1 && greatest >= 0.05 && greatest <= 1);
});

test("an extent passes over what is not known", () => {
  assert.deepEqual(extent([null, 3, undefined, NaN, -1, Infinity]), [-1, 3]);
  assert.deepEqual(extent([]), [Infinity, -Infinity]);
});
