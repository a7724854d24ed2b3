/** What is drawn beside the lines of a chart: where to stay below, where to go, and when. */

const DASH_PX = [6, 4];
const MOMENT_ALPHA = 0.7; // chosen: lighter than the lines of the chart
const DOTS_PX = [2, 3];
const TOLERANCE_ALPHA = 0.14; // chosen: lighter than the bands of one sd

/** A dashed line over the whole width at `y`. @param {import("./vendor/uPlot.esm.js").default} plot */
export function drawRule(plot, y, colour) {
  const { ctx, bbox } = plot;
  const y_px = plot.valToPos(y, "y", true);
  ctx.save();
  clip(ctx, bbox);
  ctx.strokeStyle = colour;
  ctx.lineWidth = devicePixelRatio;
  ctx.setLineDash(DASH_PX.map((part) => part * devicePixelRatio));
  ctx.beginPath();
  ctx.moveTo(bbox.left, y_px);
  ctx.lineTo(bbox.left + bbox.width, y_px);
  ctx.stroke();
  ctx.restore();
}

/**
 * Upright lines over the whole height.
 * @param {number[]} times  s; those outside of the chart are not drawn
 * @param {{colour: string, dashed: boolean}} how
 */
export function drawMoments(plot, times, { colour, dashed }) {
  const { ctx, bbox } = plot;
  ctx.save();
  clip(ctx, bbox);
  ctx.strokeStyle = colour;
  ctx.lineWidth = devicePixelRatio;
  if (dashed) ctx.globalAlpha = MOMENT_ALPHA;
  ctx.setLineDash(dashed ? DOTS_PX.map((part) => part * devicePixelRatio) : []);
  ctx.beginPath();
  for (const t of times) {
    const x_px = plot.valToPos(t, "x", true);
    ctx.moveTo(x_px, bbox.top);
    ctx.lineTo(x_px, bbox.top + bbox.height);
  }
  ctx.stroke();
  ctx.restore();
}

/** @param {{value: number, tolerance: number, colour: string}[]} targets  in the unit shown */
export function drawTargets(plot, targets) {
  for (const { value, tolerance, colour } of targets) {
    drawTolerance(plot, value, tolerance, colour);
    drawRule(plot, value, colour);
  }
}

function drawTolerance(plot, value, tolerance, colour) {
  const { ctx, bbox } = plot;
  const top_px = plot.valToPos(value + tolerance, "y", true);
  const bottom_px = plot.valToPos(value - tolerance, "y", true);
  ctx.save();
  clip(ctx, bbox);
  ctx.globalAlpha = TOLERANCE_ALPHA;
  ctx.fillStyle = colour;
  ctx.fillRect(bbox.left, top_px, bbox.width, bottom_px - top_px);
  ctx.restore();
}

function clip(ctx, bbox) {
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
}
