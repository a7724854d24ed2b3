/** The socket to the server, which is opened again for ever. */

const PAUSES_MS = [250, 500, 1000, 2000]; // the last one is used on and on; chosen

const WORDS = {
  open: "connected",
  closed: "no connection, trying again ...",
};

/**
 * @param {(message: string|ArrayBuffer) => void} receive
 * @param {(link: "open"|"closed") => void} changed
 */
export function keepLinked(receive, changed) {
  let failures = 0;
  const open = () => {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}/live`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      failures = 0;
      changed("open");
    };
    socket.onmessage = (event) => receive(event.data);
    socket.onclose = () => {
      changed("closed");
      setTimeout(open, PAUSES_MS[Math.min(failures++, PAUSES_MS.length - 1)]);
    };
  };
  open();
}

/** Says in `place` how the link is. @param {HTMLElement} place */
export function linkWords(place) {
  place.setAttribute("role", "status");
  place.setAttribute("aria-live", "polite");
  return (link) => {
    place.dataset.link = link;
    place.textContent = WORDS[link];
  };
}
