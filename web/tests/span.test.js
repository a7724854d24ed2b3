import assert from "node:assert/strict";
import { test } from "node:test";
import { between, following, panned, within, zoomed } from "../../src/equipoise/app/dashboard/static/span.js";

const WHOLE = { from: 10, length: 100 };

test("a zoom leaves the time under the pointer where it is", () => {
  // 85 s lies three quarters along 10 to 110 s, and three quarters along 47.5 to 97.5 s.
  assert.deepEqual(zoomed(WHOLE, WHOLE, 0.5, 85), { from: 47.5, length: 50 });
});

test("nothing is shown that was not recorded", () => {
  assert.deepEqual(zoomed({ from: 50, length: 20 }, WHOLE, 100, 60), WHOLE);
  assert.deepEqual(panned({ from: 15, length: 20 }, WHOLE, -1), { from: 10, length: 20 });
  assert.deepEqual(panned({ from: 80, length: 20 }, WHOLE, 1), { from: 90, length: 20 });
});

test("a pan by a half moves by half of what is shown, later where it is positive", () => {
  assert.deepEqual(panned({ from: 40, length: 20 }, WHOLE, 0.5), { from: 50, length: 20 });
});

test("a part is chosen from either end, and is never a point", () => {
  assert.deepEqual(between(60, 40, WHOLE), { from: 40, length: 20 });
  assert.ok(between(60, 60, WHOLE).length > 0);
});

test("a recording shorter than the shortest span is shown whole", () => {
  const short = { from: 3, length: 0.01 };
  assert.deepEqual(within({ from: 3, length: 0.001 }, short), short);
});

test("the part shown follows a time that has left it, and else stands still", () => {
  const span = { from: 40, length: 20 };
  assert.equal(following(span, WHOLE, 60), span);
  assert.deepEqual(following(span, WHOLE, 61), { from: 61, length: 20 });
  assert.deepEqual(following(span, WHOLE, 12), { from: 12, length: 20 });
});
