import assert from "node:assert/strict";
import { test } from "node:test";
import { decodeFrame } from "../../src/equipoise/app/dashboard/static/frames.js";

/** As the server writes it, by the contract. */
function encode(t, parts) {
  let json = JSON.stringify({ t, parts: parts.map(([name, rows, columns]) => [name, rows, columns]) });
  while ((4 + new TextEncoder().encode(json).length) % 8) json += " ";
  const head = new TextEncoder().encode(json);
  const numbers = parts.flatMap(([, , , data]) => data);
  const buffer = new ArrayBuffer(4 + head.length + 8 * numbers.length);
  const view = new DataView(buffer);
  view.setUint32(0, head.length, true);
  new Uint8Array(buffer, 4, head.length).set(head);
  numbers.forEach((x, i) => view.setFloat64(4 + head.length + 8 * i, x, true));
  return buffer;
}

test("a frame gives back every part with its rows, bit for bit", () => {
  const frame = decodeFrame(
    encode(31.3, [
      ["attitude", 2, 3, [31.2, 0.1, 0.01, 31.3, 0.2, 0.02]],
      ["pose", 1, 5, [31.3, 1, 0, 0, -0.5]],
    ]),
  );
  assert.equal(frame.t, 31.3);
  assert.deepEqual(frame.parts.map(({ name, rows, columns }) => [name, rows, columns]), [
    ["attitude", 2, 3],
    ["pose", 1, 5],
  ]);
  assert.deepEqual([...frame.parts[0].data], [31.2, 0.1, 0.01, 31.3, 0.2, 0.02]);
  assert.deepEqual([...frame.parts[1].data], [31.3, 1, 0, 0, -0.5]);
});

test("names beyond ASCII are padded by their bytes, not their letters", () => {
  const frame = decodeFrame(encode(1, [["Trägheit µ", 1, 2, [1, 2]]]));
  assert.deepEqual([...frame.parts[0].data], [1, 2]);
});

test("NaN stays NaN, and a part without rows is empty", () => {
  const frame = decodeFrame(encode(1, [["rate", 0, 7, []], ["com", 1, 2, [1, NaN]]]));
  assert.equal(frame.parts[0].data.length, 0);
  assert.ok(Number.isNaN(frame.parts[1].data[1]));
});

test("a frame whose parts do not fill it is refused", () => {
  assert.throws(() => decodeFrame(encode(1, [["rate", 1, 2, [1, 2, 3]]])), RangeError);
  assert.throws(() => decodeFrame(encode(1, [["rate", 2, 2, [1, 2, 3]]])), RangeError);
});
