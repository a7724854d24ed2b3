/**
 * Mouse, finger and wheel on a chart of a whole recording:
 *
 *   click        go to that time
 *   drag         zoom to the part; with Shift, or with a finger: pan
 *   double click show the whole
 *   Ctrl + wheel zoom, Shift + wheel pan; the wheel alone scrolls the page
 */

const CLICK_PX = 4; // a hand trembles so much; chosen
const PER_WHEEL = 0.0015; // of the logarithm of the zoom, chosen

/**
 * @param {import("./vendor/uPlot.esm.js").default} plot
 * @param {{seek: (t: number) => void, show: (one: number, other: number) => void,
 *   pan: (share: number) => void, zoom: (factor: number, at: number) => void,
 *   whole: () => void}} actions  times in s
 */
export function followGestures(plot, actions) {
  const { over } = plot;
  let held = null;
  const x = (event) => event.clientX - over.getBoundingClientRect().left;
  const t = (x_px) => plot.posToVal(x_px, "x");
  const select = (left, width) => plot.setSelect({ left, width, top: 0, height: over.clientHeight }, false);

  over.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    held = { from: x(event), at: x(event), pans: event.shiftKey || event.pointerType === "touch" };
    over.setPointerCapture(event.pointerId);
  });
  over.addEventListener("pointermove", (event) => {
    if (!held) return;
    const at = x(event);
    if (held.pans) actions.pan((held.at - at) / over.clientWidth);
    else select(Math.min(held.from, at), Math.abs(at - held.from));
    held.at = at;
    held.moved ||= Math.abs(at - held.from) > CLICK_PX;
  });
  over.addEventListener("pointerup", (event) => {
    if (!held) return;
    const { from, moved, pans } = held;
    held = null;
    select(0, 0);
    if (!moved) actions.seek(t(x(event)));
    else if (!pans) actions.show(t(from), t(x(event)));
  });
  over.addEventListener("pointercancel", () => {
    held = null;
    select(0, 0);
  });
  over.addEventListener("dblclick", actions.whole);
  over.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.shiftKey) return;
    event.preventDefault();
    const turned = event.deltaY || event.deltaX;
    if (event.ctrlKey) actions.zoom(Math.exp(turned * PER_WHEEL), t(x(event)));
    else actions.pan(turned * PER_WHEEL);
  }, { passive: false });
}
