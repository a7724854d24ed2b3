/* Unpack the report's modules and run them; a browser that cannot do that shows the drawings. */
(async () => {
  if (!window.DecompressionStream) return;
  const packed = document.getElementById("modules").textContent;
  const bytes = Uint8Array.from(atob(packed), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const { modules, first } = await new Response(stream).json();
  const places = {};
  for (const [name, text] of modules) {
    const linked = text.replace(/"module:([^"]+)"/g, (_, other) => JSON.stringify(places[other]));
    places[name] = URL.createObjectURL(new Blob([linked], { type: "text/javascript" }));
  }
  for (const name of first) await import(places[name]);
})();
