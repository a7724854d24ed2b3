/** What this browser keeps of a person's layout: units, theme, spans, panels that are hidden. */

const KEY = "equipoise-layout";

/** @returns {Record<string, any>} what was kept; nothing where the browser keeps nothing */
export function kept() {
  try {
    const found = JSON.parse(localStorage.getItem(KEY) ?? "{}");
    return found !== null && typeof found === "object" ? found : {};
  } catch {
    return {};
  }
}

/** Keep some values beside those that are kept. @param {Record<string, any>} values */
export function keep(values) {
  try {
    localStorage.setItem(KEY, JSON.stringify({ ...kept(), ...values }));
  } catch {
    // A browser that keeps nothing shows the page as it is at first, each time.
  }
}
