/** A sentence that stands where a part of the page cannot. */
export function sayInstead(place, sentence) {
  const paragraph = document.createElement("p");
  paragraph.className = "eq-instead";
  paragraph.textContent = sentence;
  place.replaceChildren(paragraph);
}
