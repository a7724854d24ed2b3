/** Light or dark, as the system has it or as a person chose; paper is light. */

import { palette } from "./colours.js";

const SYSTEM = matchMedia("(prefers-color-scheme: dark)");
const listeners = [];
let chosen = null; // by the button; null: as the system

/** @param {(colours: ReturnType<palette>) => void} recolour  called at once, and at each change */
export function followTheme(recolour) {
  if (!listeners.length) begin();
  listeners.push(recolour);
  recolour(palette());
}

function begin() {
  SYSTEM.addEventListener("change", apply);
  const button = document.getElementById("theme");
  button.hidden = false;
  button.addEventListener("click", () => {
    chosen = isDark() ? "light" : "dark";
    apply();
  });
  apply();
}

const isDark = () => (chosen ?? (SYSTEM.matches ? "dark" : "light")) === "dark";

function apply() {
  document.documentElement.dataset.theme = isDark() ? "dark" : "light";
  document.getElementById("theme").textContent = isDark() ? "Light theme" : "Dark theme";
  const colours = palette();
  for (const recolour of listeners) recolour(colours);
}
