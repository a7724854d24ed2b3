/** The time of a recording: a slider that follows the replay, except while a hand is on it. */

/**
 * The shell makes the slider and receives its "seek"; it is shown where there is a recording.
 * @param {HTMLInputElement} place
 * @param {import("./store.js").Store} store
 */
export function showTimebar(place, store) {
  let held = false;
  place.addEventListener("input", () => (held = true));
  place.addEventListener("change", () => {
    held = false;
    place.dispatchEvent(new CustomEvent("seek", { detail: Number(place.value) }));
  });
  const follow = () => {
    const span = store.state?.span;
    place.parentElement.hidden = !span;
    if (!span || held) return;
    [place.min, place.max] = span;
    place.value = store.state.t;
    place.title = `${Number(place.value).toFixed(1)} of ${span[1].toFixed(1)} s`;
  };
  return { about: follow, state: follow };
}
