/** A figure of the report as charts: its panels below each other, and the tools beside them. */

import { make } from "./chart_heading.js";
import { Panel } from "./panel.js";
import { rangeOf } from "./ranges.js";

const STEP = 0.6; // of the span, chosen: a press of a key or a button
const HELP = "Drag to zoom, Shift and drag to move, double-click for the whole. Keys: + − ← → 0.";
const TOOLS = [
  ["Zoom in", (range) => range.zoom(STEP)],
  ["Zoom out", (range) => range.zoom(1 / STEP)],
  ["Earlier", (range) => range.pan(-STEP / 2)],
  ["Later", (range) => range.pan(STEP / 2)],
  ["Whole", (range) => range.showWhole()],
];

export class ChartFigure {
  /** @param {HTMLElement} place @param {object} block  a chart of the document */
  constructor(place, block) {
    this.name = block.name;
    this.range = rangeOf(block.record || block.name);
    this.live = place.querySelector(".live");
    this.live.hidden = false;
    place.hidden = false;
    place.dataset.live = "true"; // the drawing, if there is one, stands on paper only
    const tools = make("div", "tools", this.live);
    for (const [word, act] of TOOLS) this.addTool(tools, word, act);
    make("span", "note", tools).textContent = HELP;
    this.panels = block.panels.map((panel) => new Panel(this.live, panel, block, this.range));
  }

  addTool(tools, word, act) {
    const button = make("button", "", tools);
    button.type = "button";
    button.textContent = word;
    button.addEventListener("click", () => act(this.range));
  }

  recolour(colours) {
    for (const panel of this.panels) panel.recolour(colours);
  }
}
