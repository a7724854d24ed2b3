import assert from "node:assert/strict";
import { test } from "node:test";
import { Store } from "../../src/equipoise/app/dashboard/static/store.js";

const notify = (store, message) => store.receive(JSON.stringify(message));
const about = { kind: "about", clock: 7, series: [] };
const step = (index, sentence) => ({ kind: "step", index, of: "measurement", t: 1, sentence, outcome: null });

test("a step with an index that was there replaces it", () => {
  const store = new Store();
  notify(store, about);
  for (const each of [step(0, "measures"), step(1, "moves"), step(0, "measured")]) notify(store, each);
  assert.deepEqual([...store.steps.values()].map((s) => s.sentence), ["measured", "moves"]);
});

test("each about forgets rows, steps and state, of the same clock too", () => {
  const store = new Store();
  notify(store, about);
  notify(store, step(0, "measures"));
  notify(store, { kind: "state", t: 1 });
  store.takeRows({ t: 2, parts: [{ name: "com", rows: 1, columns: 2, data: Float64Array.of(2, 5) }] });
  assert.deepEqual([store.t, store.began, store.last("com")], [2, 2, [2, 5]]);
  notify(store, about);
  assert.deepEqual([store.t, store.began, store.last("com"), store.state], [null, null, null, null]);
  assert.equal(store.steps.size, 0);
});

test("a view that comes late hears what is known already, in order", () => {
  const store = new Store();
  notify(store, about);
  notify(store, step(0, "measures"));
  notify(store, { kind: "state", t: 1 });
  const received = [];
  const receive = (what) => () => received.push(what);
  store.show({ about: receive("about"), rows: receive("rows"), step: receive("step"), state: receive("state") });
  assert.deepEqual(received, ["about", "step", "state", "rows"]);
});

test("a message of a kind that is not known yet changes nothing", () => {
  const store = new Store();
  notify(store, about);
  notify(store, { kind: "weather" });
  assert.equal(store.about.clock, 7);
});
