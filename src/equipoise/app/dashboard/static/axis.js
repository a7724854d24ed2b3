/** The axes of every chart: the live page's, the viewer's and a report's. */

export const FONT = '11px system-ui, "DejaVu Sans", sans-serif';

/**
 * @param {() => ReturnType<import("./colours.js").palette> | undefined} colours  of now
 * @param {number} size  px, of the room for its texts
 * @param {number} space  px, least distance of ticks
 * @param {(value: number) => string} text  of a tick
 */
export function axisOf(colours, size, space, text) {
  return {
    size,
    space,
    gap: 3,
    font: FONT,
    stroke: () => colours()?.quiet,
    grid: { stroke: () => colours()?.grid, width: 1 },
    ticks: { stroke: () => colours()?.grid, width: 1, size: 4 },
    values: (_, splits) => splits.map(text),
  };
}
