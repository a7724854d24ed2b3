/** How a panel is moved and zoomed besides by selecting: Shift and drag, wheel, double click, keys. */

const WHEEL = 0.0015; // of a zoom for a notch's pixel, chosen
const KEYS = {
  "+": (range) => range.zoom(0.6),
  "=": (range) => range.zoom(0.6), // plus without its shift key
  "-": (range) => range.zoom(1 / 0.6),
  ArrowLeft: (range) => range.pan(-0.2),
  ArrowRight: (range) => range.pan(0.2),
  0: (range) => range.showWhole(),
};

export class Pointer {
  /** @param {HTMLElement} place @param {object} plot @param {import("./ranges.js").Range} range */
  constructor(place, plot, range) {
    Object.assign(this, { plot, range });
    const { over } = plot;
    over.addEventListener("mousedown", (event) => this.begin(event), { capture: true });
    over.addEventListener("dblclick", () => range.showWhole());
    over.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    place.addEventListener("keydown", (event) => {
      const act = KEYS[event.key];
      if (!act || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      act(range);
    });
  }

  /** With Shift the stretch moves along with the pointer, and nothing is selected. */
  begin(event) {
    if (!event.shiftKey || event.button !== 0) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    const [from, to] = this.range.span;
    const perPixel = (to - from) / this.plot.over.clientWidth;
    const move = ({ clientX }) => {
      const by = (event.clientX - clientX) * perPixel;
      this.range.show(from + by, to + by);
    };
    const end = () => document.removeEventListener("mousemove", move);
    document.addEventListener("mousemove", move);
    document.addEventListener("mouseup", end, { once: true });
  }

  /** With Ctrl, so that the page scrolls over charts as elsewhere. */
  wheel(event) {
    if (!event.ctrlKey) return;
    event.preventDefault();
    const at = this.plot.posToVal(event.offsetX, "x");
    this.range.zoom(Math.exp(event.deltaY * WHEEL), at);
  }
}
