/** Drawing no oftener than makes sense: when asked for, in step with the screen, and not dear. */

const SHARE = 0.25; // of the time that drawing one thing may take; chosen

/**
 * @param {() => void} draw
 * @param {number} period_ms  the shortest time between two beginnings
 * @returns {() => void} asks for a drawing; asking again before it comes changes nothing
 */
export function paced(draw, period_ms) {
  let requested = false;
  let next_ms = 0;
  const turn = (now_ms) => {
    if (now_ms < next_ms) return requestAnimationFrame(turn);
    requested = false;
    const start_ms = performance.now();
    draw();
    next_ms = now_ms + Math.max(period_ms, (performance.now() - start_ms) / SHARE);
  };
  return () => {
    if (requested) return;
    requested = true;
    requestAnimationFrame(turn);
  };
}
