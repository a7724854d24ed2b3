/** What a person does first at a page on which nothing has been done yet. */

import { make } from "./chart_heading.js";

const TOKEN = "Copy the token from the terminal into the field Token, and press Command.";
const STARTING = "Press Start balancing. Each step and the verdict appear here.";
const OBSERVING = "Without the token this page shows everything, and commands nothing.";

/** By the kind of the bench, as `about` has it. */
const WORDS = {
  simulated: [
    TOKEN,
    "Press Let go: the simulated platform swings, and the charts show the estimate of its centre of mass.",
    STARTING,
  ],
  real: [
    TOKEN,
    "Hold the platform level, and tick the box that says so.",
    STARTING,
  ],
  replayed: [TOKEN, "Press Let go: the recording is played back."],
};

/** @returns {DocumentFragment} a heading and a list. @param {{bench: string}} about */
export function firstSteps(about) {
  const found = document.createDocumentFragment();
  make("h3", "", found).textContent = "What to do first";
  const list = make("ol", "", found);
  for (const words of WORDS[about.bench]) make("li", "", list).textContent = words;
  make("p", "", found).textContent = OBSERVING;
  return found;
}
