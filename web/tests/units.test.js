import assert from "node:assert/strict";
import { test } from "node:test";
import { figures, seconds, tick, typeset, unitForSi, unitOf, withSd } from "../../src/equipoise/app/dashboard/static/units.js";

test("units are typeset as people write them", () => {
  const pairs = { um: "µm", "uN m": "µN m", mJ: "mJ", deg: "deg", "kg m2": "kg m²", "N m": "N m", "rad/s": "rad/s" };
  for (const [plain, printed] of Object.entries(pairs)) assert.equal(typeset(plain), printed);
});

test("a pair of units gives the one of the kind", () => {
  const pair = { bench: ["um", 1e-6], si: ["m", 1] };
  assert.deepEqual(unitOf(pair, "bench"), { name: "µm", size: 1e-6 });
  assert.deepEqual(unitOf(pair, "si"), { name: "m", size: 1 });
});

test("90 deg are a quarter turn, 12 uN m are 12e-6 N m", () => {
  assert.equal((Math.PI / 2) / unitForSi("rad", "bench").size, 90);
  assert.equal(figures(12e-6 / unitForSi("N m", "bench").size), "12.00");
  assert.equal(unitForSi("J", "si").name, "J");
});

test("four figures are shown, at most four decimals, and powers of ten beyond", () => {
  const pairs = [[0, "0"], [1234.6, "1235"], [123.46, "123.5"], [-5.5602, "−5.560"], [0.95112, "0.9511"], [0.01234, "0.0123"], [1.2e-5, "1.20e−5"], [2.5e7, "2.50e+7"]];
  for (const [value, text] of pairs) assert.equal(figures(value), text);
});

test("what is not known is a dash, without a unit", () => {
  for (const value of [NaN, null, Infinity]) assert.equal(figures(value), "–");
  assert.equal(withSd(NaN, 1, "µm"), "–");
});

test("a value is rounded as its sd is, to two figures of that", () => {
  assert.equal(withSd(-72.561, 0.481, "µm"), "−72.56 ± 0.48 µm");
  assert.equal(withSd(-72.561, 12.3, "µm"), "−73 ± 12 µm");
  assert.equal(withSd(16.6, 1041, "µm"), "17 ± 1041 µm");
  assert.equal(withSd(0.0072, 0.0041, "rad"), "0.0072 ± 0.0041 rad");
  assert.equal(withSd(3, NaN, "µm"), "3.000 µm");
  assert.equal(withSd(-7.2561e-5, 4.81e-7, "m"), "−72.56e−6 ± 0.48e−6 m");
});

test("ticks and times are short", () => {
  assert.equal(tick(0.1 + 0.2), "0.3");
  assert.equal(tick(-20), "−20");
  assert.equal(tick(2e-5), "2e−5");
  assert.equal(seconds(31.26), "31.3 s");
});
