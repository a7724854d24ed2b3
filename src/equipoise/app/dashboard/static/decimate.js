/**
 * What a chart draws of a series: rows as they are while there are fewer than its pixels, else the
 * least and the greatest of each bucket, so that no spike is lost. A bucket begins at a multiple
 * of its width, whatever the window, so that a picture that scrolls does not flicker.
 *
 * Arrays go back into `out`, as uPlot takes them: time, the values of each column, and, with sds,
 * value - sd and value + sd of each. Null: not known.
 */

/**
 * @param {import("./series.js").Series} series
 * @param {{from: number, to: number, length: number}} span  s; the length by itself, since the
 *   difference of the others is another one in its last figure, and so would buckets be
 * @param {{values: number, sd: boolean, unit: number, buckets: number}} how
 * @param {(number|null)[][]} out  as many arrays as 1 + values (1 + 2 sd); used again each time
 */
export function drawn(series, span, how, out) {
  for (const column of out) column.length = 0;
  // One row on either side, so that lines go on to the edges.
  const first = Math.max(0, series.firstFrom(span.from) - 1);
  const end = Math.min(series.rows, series.firstFrom(span.to) + 1);
  if (end - first <= 2 * how.buckets) rowsAsTheyAre(series, first, end, how, out);
  else leastAndGreatest(series, first, end, span.length / how.buckets, how, out);
}

function rowsAsTheyAre(series, first, end, how, out) {
  for (let row = first; row < end; row++) {
    out[0].push(series.at(row, 0));
    for (let c = 0; c < how.values; c++) {
      const value = series.at(row, 1 + c) / how.unit;
      out[1 + c].push(known(value));
      if (how.sd) pushBand(out, how.values, c, value, sdAt(series, row, c, how));
    }
  }
}

function pushBand(out, values, c, value, sd) {
  out[1 + values + 2 * c].push(known(value - sd));
  out[2 + values + 2 * c].push(known(value + sd));
}

const sdAt = (series, row, c, how) => series.at(row, 1 + how.values + c) / how.unit;
const known = (value) => (Number.isFinite(value) ? value : null);

function leastAndGreatest(series, first, end, width, how, out) {
  let row = first;
  while (row < end) {
    const bucket = Math.floor(series.at(row, 0) / width);
    const start = row;
    while (row < end && Math.floor(series.at(row, 0) / width) === bucket) row++;
    out[0].push((bucket + 0.25) * width, (bucket + 0.75) * width);
    for (let c = 0; c < how.values; c++) pushBucket(series, start, row, c, how, out);
  }
}

function pushBucket(series, start, end, c, how, out) {
  const observed = extremes(series, start, end, c, how);
  const inOrder = observed.rowOfLeast <= observed.rowOfGreatest;
  const [one, other] = inOrder ? [observed.least, observed.greatest] : [observed.greatest, observed.least];
  out[1 + c].push(known(one), known(other));
  if (!how.sd) return;
  const [low, high] = [known(observed.low), known(observed.high)];
  out[1 + how.values + 2 * c].push(low, low);
  out[2 + how.values + 2 * c].push(high, high);
}

/** Unknown values are passed over; where all are, the least stays infinite, which is not known. */
function extremes(series, start, end, c, how) {
  const observed = { least: Infinity, greatest: -Infinity, low: Infinity, high: -Infinity };
  for (let row = start; row < end; row++) {
    const value = series.at(row, 1 + c) / how.unit;
    if (value < observed.least) [observed.least, observed.rowOfLeast] = [value, row];
    if (value > observed.greatest) [observed.greatest, observed.rowOfGreatest] = [value, row];
    if (!how.sd) continue;
    const sd = sdAt(series, row, c, how);
    if (value - sd < observed.low) observed.low = value - sd;
    if (value + sd > observed.high) observed.high = value + sd;
  }
  return observed;
}
