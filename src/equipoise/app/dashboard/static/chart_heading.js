/** What stands over a chart: title, unit, and a key for each line with its value. */

import { figures, seconds } from "./units.js";

export class Heading {
  /**
   * @param {HTMLElement} figure
   * @param {{title: string, columns: string[]}} reported
   * @param {{colour: number, dash: number[]}[]} lineStyles
   * @param {(column: number, shown: boolean) => void} toggled  a line is hidden, or shown again
   */
  constructor(figure, reported, lineStyles, toggled) {
    const heading = make("figcaption", "", figure);
    make("b", "", heading).textContent = reported.title;
    this.unitPlace = make("span", "eq-unit", heading);
    const keys = make("span", "eq-keys", heading);
    this.values = reported.columns.map((name, c) => addKey(keys, name, lineStyles[c], (on) => toggled(c, on)));
  }

  /**
   * @param {string} unit
   * @param {number|null} at  s, where these values are from; null: now
   * @param {(number|null)[]} values  in that unit
   */
  write(unit, at, values) {
    const words = [unit && `[${unit}]`, at !== null && `at ${seconds(at)}`];
    this.unitPlace.textContent = words.filter(Boolean).join(" ");
    this.values.forEach((place, c) => (place.textContent = figures(values[c] ?? null)));
  }
}

/** Pressing a key hides its line, so that the others have the whole height. */
function addKey(keys, name, lineStyle, toggled) {
  const key = make("button", "eq-key", keys);
  key.type = "button";
  key.style.setProperty("--line", `var(--eq-line-${lineStyle.colour})`);
  key.dataset.dashed = lineStyle.dash.length > 0;
  key.setAttribute("aria-pressed", "true");
  key.addEventListener("click", () => {
    const on = key.getAttribute("aria-pressed") === "false";
    key.setAttribute("aria-pressed", on);
    toggled(on);
  });
  make("span", "", key).textContent = name;
  return make("span", "eq-value", key);
}

/** Make an element in `parent`. */
export function make(tag, className, parent) {
  const element = document.createElement(tag);
  if (className) element.className = className;
  parent.append(element);
  return element;
}
