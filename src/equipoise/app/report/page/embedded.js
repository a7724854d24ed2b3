/** The numbers of charts and replays, beside the drawings that they replace. */

import { blocks } from "./blocks.js";

/**
 * @param {"chart"|"replay"} kind
 * @returns {{place: HTMLElement, block: object}[]} the figures of a kind, and what they show
 */
export function reported(kind) {
  const places = [...document.querySelectorAll(`figure[data-kind="${kind}"]`)];
  return places.map((place) => ({ place, block: blocks[place.dataset.name] }));
}
