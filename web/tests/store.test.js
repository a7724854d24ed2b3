import assert from "node:assert/strict";
import { test } from "node:test";
import { Store } from "../../src/equipoise/app/dashboard/static/store.js";

const tell = (store, message) => store.receive(JSON.stringify(message));
const about = { kind: "about", clock: 7, series: [] };
const step = (index, sentence) => ({ kind: "step", index, of: "look", t: 1, sentence, outcome: null });

test("a step with an index that was there replaces it", () => {
  const store = new Store();
  tell(store, about);
  for (const each of [step(0, "looks"), step(1, "moves"), step(0, "looked")]) tell(store, each);
  assert.deepEqual([...store.steps.values()].map((s) => s.sentence), ["looked", "moves"]);
});

test("each about forgets rows, steps and state, of the same clock too", () => {
  const store = new Store();
  tell(store, about);
  tell(store, step(0, "looks"));
  tell(store, { kind: "state", t: 1 });
  store.takeRows({ t: 2, parts: [{ name: "com", rows: 1, columns: 2, data: Float64Array.of(2, 5) }] });
  assert.deepEqual([store.t, store.began, store.last("com")], [2, 2, [2, 5]]);
  tell(store, about);
  assert.deepEqual([store.t, store.began, store.last("com"), store.state], [null, null, null, null]);
  assert.equal(store.steps.size, 0);
});

test("a view that comes late hears what is known already, in order", () => {
  const store = new Store();
  tell(store, about);
  tell(store, step(0, "looks"));
  tell(store, { kind: "state", t: 1 });
  const heard = [];
  const hear = (what) => () => heard.push(what);
  store.show({ about: hear("about"), rows: hear("rows"), step: hear("step"), state: hear("state") });
  assert.deepEqual(heard, ["about", "step", "state", "rows"]);
});

test("a message of a kind that is not known yet changes nothing", () => {
  const store = new Store();
  tell(store, about);
  tell(store, { kind: "weather" });
  assert.equal(store.about.clock, 7);
});
