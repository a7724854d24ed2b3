/** What is drawn behind the lines of a panel, and bars. */

const SHADED_ALPHA = 0.16; // chosen: lines on it keep their contrast

/** Strips over the whole height. @param {number[][]} spans  from, to */
export function drawShaded(plot, spans, colour) {
  const { left, top, width, height } = plot.bbox;
  filled(plot, colour, (ctx) => {
    for (const [from, to] of spans) {
      const a = Math.max(plot.valToPos(from, "x", true), left);
      const b = Math.min(plot.valToPos(to, "x", true), left + width);
      if (b > a) ctx.fillRect(a, top, b - a, height);
    }
  });
}

/** A band of `half` on either side of zero. */
export function drawBand(plot, half, colour) {
  const { left, width } = plot.bbox;
  const [high, low] = [half, -half].map((y) => plot.valToPos(y, "y", true));
  filled(plot, colour, (ctx) => ctx.fillRect(left, high, width, low - high));
}

function filled(plot, colour, fill) {
  const { ctx } = plot;
  within(plot, () => {
    ctx.globalAlpha = SHADED_ALPHA;
    ctx.fillStyle = colour;
    fill(ctx);
  });
}

/** Bars from zero; those of several columns stand side by side. @param {number} side  of a bar's place */
export function drawStems(plot, x, y, colour, side) {
  const { ctx } = plot;
  const [a, b] = [x[0], x[1]].map((at) => plot.valToPos(at, "x", true));
  const width = Math.max((b - a) * 0.27, devicePixelRatio);
  const zero = plot.valToPos(0, "y", true);
  within(plot, () => {
    ctx.fillStyle = colour;
    x.forEach((at, i) => {
      if (y[i] === null) return;
      const top = plot.valToPos(y[i], "y", true);
      ctx.fillRect(plot.valToPos(at, "x", true) + side * (b - a) - width / 2, Math.min(top, zero), width, Math.abs(top - zero));
    });
  });
}

function within({ ctx, bbox }, draw) {
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  draw();
  ctx.restore();
}
