/** What the procedure did and found, step by step, the newest at the end. */

import { seconds } from "./units.js";

const NEAR_END_PX = 40; // a person who is this near to the end wants to see the newest; chosen

/** Class of the badge and what it says, by the code of a verdict's outcome. */
const BADGES = {
  passed: { mood: "good", text: "passed" },
  failed: { mood: "bad", text: "failed" },
  halted: { mood: "bad", text: "halted" },
  undecided: { mood: "unsure", text: "cannot tell" },
};

/**
 * @param {HTMLElement} place  the box that scrolls
 * @param {{seek?: (t: number) => void, hint?: () => Node|null}} how  `seek`: the time of a step is
 *   a button that goes there; `hint`: what stands here while there is no step
 */
export function showStory(place, { seek, hint } = {}) {
  const list = document.createElement("ol");
  const items = new Map();
  place.tabIndex = 0; // scrolls with the keyboard
  place.setAttribute("role", seek ? "region" : "log");
  place.setAttribute("aria-label", "Steps");
  const hinted = document.createElement("div");
  hinted.className = "eq-hint";
  place.append(hinted, list);
  const say = () => {
    const found = items.size === 0 && hint?.();
    hinted.replaceChildren(...(found ? [found] : []));
    list.hidden = items.size === 0; // a list without items is no list
  };
  let follows = true;
  let top_px = 0;
  const toEnd = () => {
    if (follows && !seek && items.size) place.scrollTop = place.scrollHeight;
  };
  // Only a person scrolls up. A box that becomes lower is not at its end either, for a moment.
  place.addEventListener("scroll", () => {
    const nearEnd = place.scrollHeight - place.scrollTop - place.clientHeight < NEAR_END_PX;
    follows = nearEnd || (follows && place.scrollTop >= top_px);
    top_px = place.scrollTop;
  });
  new ResizeObserver(toEnd).observe(place);
  return {
    about() {
      items.clear();
      follows = !seek;
      list.replaceChildren();
      say();
    },
    step(step) {
      const item = itemOf(step, seek);
      if (items.has(step.index)) items.get(step.index).replaceWith(item);
      else list.append(item);
      items.set(step.index, item);
      say();
      toEnd();
    },
  };
}

function itemOf(step, seek) {
  const item = document.createElement("li");
  item.dataset.of = step.of;
  item.append(
    seek ? goTo(step, seek) : textIn("time", seconds(step.t)),
    textIn("b", step.of),
    textIn("span", step.sentence),
  );
  if (step.outcome) item.append(badge(step.outcome));
  return item;
}

function goTo(step, seek) {
  const button = textIn("button", seconds(step.t));
  button.type = "button";
  button.className = "eq-at";
  button.title = "Go to this time";
  button.addEventListener("click", () => seek(step.t));
  return button;
}

function badge(outcome) {
  const { mood, text } = BADGES[outcome];
  const element = textIn("em", text);
  element.dataset.mood = mood;
  return element;
}

function textIn(tag, text) {
  const element = document.createElement(tag);
  element.textContent = text;
  return element;
}
