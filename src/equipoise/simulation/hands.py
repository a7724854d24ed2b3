"""Simulated hands: a platform that is loaded, levelled by eye, let go and caught.

Every weight has its own mass and every place its own error, drawn once: what is taken off is what
was put on. Each swing is a simulated bench of its own, whose truth is the platform as loaded; it is
let go within ``truth.tilt`` of level and caught at its stop, or after ``ENOUGH`` seconds.
"""

from dataclasses import replace

import numpy as np

from equipoise.actuators.placed_weights import Load, refusal, stages
from equipoise.model.arrays import Ints
from equipoise.model.errors import InputError
from equipoise.model.mass_properties import MassProperties, parallel_axis
from equipoise.model.recording import Recording, joined
from equipoise.model.testbed import Testbed
from equipoise.model.weights import places_of, unloaded
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.draw_truth import own_truth

ENOUGH = 60.0  # s, chosen: two swings of a platform whose centre of mass is 100 um low
GLANCE = 1.0  # s, chosen: how soon a person sees that it lies on its stop


class SimulatedHands:
    """The verbs of ``model.hands.Hands``; the seed's platform is that of the simulated bench."""

    def __init__(self, testbed: Testbed, seed: int) -> None:
        self.testbed = testbed  # as stated, without any weights
        self.seed = seed  # of all that is drawn
        self._swings, self._time = 0, 0.0
        self._platform = SimulatedBench(testbed, seed).platform.body
        rng = np.random.default_rng(np.random.SeedSequence(seed).spawn(9)[-1])
        self._box: list[list[float]] = [
            list(map(float, rng.normal(w.mass, w.mass_sd, w.count))) for w in testbed.weights
        ]
        places = places_of(testbed.grids)
        self._piles: list[list[list[float]]] = [[[] for _ in testbed.weights] for _ in places]
        self._off = [
            p.grid.place_sd * (a * p.grid.letter_axis + b * p.grid.number_axis)
            for p, (a, b) in zip(places, rng.normal(size=(len(places), 2)), strict=True)
        ]
        self._loading = unloaded(testbed.grids, testbed.weights)
        self._bench: SimulatedBench | None = None  # once it is released

    @property
    def time(self) -> float:
        """Time recorded so far, s."""
        return self._time

    def swing(self) -> Recording:
        """Let go, and return what was recorded until it is caught."""
        self._swings += 1
        seed = np.random.SeedSequence([self.seed, self._swings]).generate_state(1)[0]
        known = replace(self.testbed, body=self._loaded())
        bench = SimulatedBench(self._as_loaded(known), int(seed))
        parts = [bench.read(GLANCE)]
        while bench.time < ENOUGH and not bench.touches:
            parts.append(bench.read(GLANCE))
        self._time += bench.time
        return joined(parts)

    def place(self, wanted: Ints) -> Ints:
        """Load the platform as wanted: first what comes off, then what goes on."""
        why = refusal(self.testbed, wanted)
        if why:
            raise InputError("placing", why, "what stock and piles allow")
        change = wanted - self._loading
        for way in (-1, 1):
            for p, k in np.argwhere(np.sign(change) == way):
                pile, box = self._piles[int(p)][int(k)], self._box[int(k)]
                giver, taker = (pile, box) if way < 0 else (box, pile)
                taker.extend(giver.pop() for _ in range(abs(int(change[p, k]))))
        self._loading = wanted.copy()
        return self._loading

    def released(self, known: Testbed) -> SimulatedBench:
        """Return the bench of the platform as it is loaded, of which ``known`` is known.

        It is the same platform, drawn with the same seed, its mass as known: weights are off by
        little beside it, and neither the first moment nor the inertia is touched by that.
        """
        self._bench = SimulatedBench(self._as_loaded(known), self.seed)
        return self._bench

    def truth(self) -> MassProperties:
        """Return the mass properties as the platform is really loaded, and its masses stand."""
        return self._loaded() if self._bench is None else self._bench.truth()

    def _loaded(self) -> MassProperties:
        load, body = self._load(), self._platform
        mass = body.mass + load.mass
        com = (body.first_moment + load.first_moment) / mass
        return MassProperties(mass, com, body.inertia_P + load.inertia_P)

    def _load(self) -> Load:
        mass, moment, inertia = 0.0, np.zeros(3), np.zeros((3, 3))
        for p, place in enumerate(places_of(self.testbed.grids)):
            if not self._loading[p].any():
                continue
            real = [m for pile in self._piles[p] for m in pile]
            middles = stages(place, self.testbed.weights, self._loading[p])
            for m, (_, middle) in zip(real, middles, strict=True):
                x = middle + self._off[p]
                mass, moment, inertia = mass + m, moment + m * x, inertia + parallel_axis(m, x)
        return Load(mass, moment, inertia)

    def _as_loaded(self, known: Testbed) -> Testbed:
        """Return a testbed with the truth that makes a simulated bench of the platform as loaded.

        The first moment is the true one, whatever mass is ``known``.
        """
        body, stated = self._loaded(), self.testbed
        com = body.first_moment / known.body.mass
        truth = replace(stated.truth or own_truth(stated), com=com, inertia_P=body.inertia_P)
        return replace(known, truth=truth)
