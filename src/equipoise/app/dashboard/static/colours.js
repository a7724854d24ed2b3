/**
 * Colours from the style sheet, for canvases. x, y and z have the same ones in charts and scene;
 * colour-blind people distinguish them and the rest, too (Okabe and Ito 2008).
 */

const AXES = { x: 0, y: 1, z: 2 };
const DASHES = [[], [5, 3], [2, 2], [9, 3, 2, 3]]; // px

/**
 * @param {string[]} columns  names as `about` has them: x1, wheel:y, com_z, roll, tilt ...
 * @returns {{colour: number, dash: number[]}[]} columns of the same axis differ in their dashes
 */
export function lineStyles(columns) {
  const axes = columns.map(axisOf);
  const byAxis = axes.every((axis) => axis !== null);
  const used = new Map();
  return columns.map((_, i) => {
    const colour = byAxis ? axes[i] : i % 8;
    const before = byAxis ? (used.get(colour) ?? 0) : Math.floor(i / 8);
    used.set(colour, before + 1);
    return { colour, dash: DASHES[before % DASHES.length] };
  });
}

function axisOf(name) {
  const found = /(?:^|[:_ ])([xyz])\d*$/.exec(name);
  return found ? AXES[found[1]] : null;
}

/** @returns {Record<string, string> & {lines: string[]}} the colours of the present theme */
export function palette() {
  const style = getComputedStyle(document.documentElement);
  const read = (name) => style.getPropertyValue(`--eq-${name}`).trim();
  return {
    lines: Array.from({ length: 8 }, (_, i) => read(`line-${i}`)),
    text: read("text"),
    quiet: read("quiet"),
    grid: read("grid"),
    panel: read("panel"),
    body: read("body"),
    metal: read("metal"),
    com: read("com"),
  };
}
