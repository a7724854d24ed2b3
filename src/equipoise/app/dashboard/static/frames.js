/**
 * A binary message: uint32 little-endian N, N bytes of JSON padded so that 4 + N is a multiple of
 * eight, then Float64 little-endian, part after part, row-major.
 * @typedef {{name: string, rows: number, columns: number, data: Float64Array}} Part
 */

/**
 * @param {ArrayBuffer} buffer
 * @returns {{t: number, parts: Part[]}} data are views of the buffer, not copies
 */
export function decodeFrame(buffer) {
  const start = 4 + new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, start - 4)));
  let offset = start;
  const parts = header.parts.map(([name, rows, columns]) => {
    const data = new Float64Array(buffer, offset, rows * columns);
    offset += data.byteLength;
    return { name, rows, columns, data };
  });
  if (offset !== buffer.byteLength) throw new RangeError("a frame is longer than its parts");
  return { t: header.t, parts };
}
