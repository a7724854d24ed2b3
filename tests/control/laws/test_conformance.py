"""Every law of the registry keeps the same promises, whoever wrote it."""

import math
from dataclasses import dataclass, field, fields, is_dataclass, replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from equipoise.control.law import Law
from equipoise.control.laws.registry import ALL, LAWS
from equipoise.io.testbed.presets import read_preset
from equipoise.model.command import Command, Measurement
from equipoise.model.devices import JetPair, Magnetorquer, ReactionWheel
from equipoise.model.errors import EquipoiseError, InputError
from equipoise.model.law_card import NEEDS
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.procedure.balancing.catalogue import CARDS
from equipoise.procedure.balancing.run_law import LawOptions, check, run_law
from equipoise.simulation.bench import SimulatedBench

every_law = pytest.mark.parametrize("name", LAWS)
TARGET = LawOptions().target
SHORT = LawOptions(max_time=30.0, proof=10.0)  # 20 s of the law
STRONGER = (100.0, 10.0)  # inertia and torque of wheels, for a law that finds the table's too weak
WITHOUT = {
    "masses": {"masses": ()},
    "momentum": {"wheels": (), "cmgs": ()},
    "magnetorquers": {"magnetorquers": (), "magnetic_field": None},
    "jets": {"jets": ()},
    "gyro": {"gyro": None},
    "attitude": {"attitude": None},
}
# On the table's stop, to the side to which it falls.
LEANING = {"attitude": np.radians([30.0, 0.0, 0.0]), "com": np.array([0.0, -3e-4, -1e-4])}
THROWN = {"attitude": np.zeros(3), "rate": np.array([0.4, 0.0, 0.0])}  # there after 1.3 s
AFTER = 2.0  # s that are checked when the platform was stopped


def frozen(value: object) -> object:
    """Return a copy of a value that equals another one only if every number in it does."""
    if isinstance(value, np.ndarray):
        return value.shape, value.tobytes()
    if is_dataclass(value) and not isinstance(value, type):
        parts = [(f.name, frozen(getattr(value, f.name))) for f in fields(value)]
        return type(value).__name__, tuple(parts)
    if isinstance(value, dict):
        return tuple((key, frozen(each)) for key, each in value.items())
    if isinstance(value, tuple | list):
        return type(value).__name__, tuple(map(frozen, value))
    return repr(value)


class GuardedBench(SimulatedBench):
    """A simulated bench that notes whatever it is asked for beyond a limit."""

    def __init__(self, testbed: Testbed, seed: int) -> None:
        super().__init__(testbed, seed)
        self.refused: list[str] = []

    def move(self, targets, speed=math.inf):
        self._noted(super().move, targets)

    def drive(self, inputs):
        self._noted(super().drive, inputs)

    def _noted(self, verb, wanted):
        try:
            verb(wanted)
        except EquipoiseError as refusal:
            self.refused.append(str(refusal))


@dataclass
class Course:
    """The observed actions of a law."""

    bench: GuardedBench
    steps: list[Step] = field(default_factory=list)
    commands: list[Command] = field(default_factory=list)
    impure: list[str] = field(default_factory=list)


def watched(law: Law[Any, Any], course: Course) -> Law[Any, Any]:
    """Return a law whose every step is made twice, its input compared before and after."""

    def step(state, observed, params):
        given = frozen((state, observed, params))
        first, again = law.step(state, observed, params), law.step(state, observed, params)
        if frozen((state, observed, params)) != given:
            course.impure.append(f"step {len(course.commands)} changed what it was given")
        if frozen(first) != frozen(again):
            course.impure.append(f"step {len(course.commands)} came out in two ways")
        course.commands.append(first[1])
        return first

    return replace(law, step=step)


def refusal(name: str, bed: Testbed) -> str:
    """Return why a law does not begin on a testbed, or nothing."""
    try:
        LAWS[name].begin(bed, TARGET)
    except InputError as refused:
        return str(refused)
    return ""


@cache
def bed_for(name: str) -> Testbed:
    """The reference table; its wheels stronger for a law that finds them too weak."""
    bed = read_preset("reference-table")
    if not refusal(name, bed):
        return bed
    inertia, torque = STRONGER
    return replace(bed, wheels=tuple(
        replace(w, inertia=inertia * w.inertia, max_torque=torque * w.max_torque)
        for w in bed.wheels
    ))  # fmt: skip


def run_on(name: str, bed: Testbed, options: LawOptions) -> Course:
    course = Course(GuardedBench(bed, 1))
    course.steps = list(run_law(course.bench, watched(LAWS[name], course), options))
    return course


@cache
def ran(name: str) -> Course:
    """Twenty seconds of a law on the reference table, and a proof."""
    return run_on(name, bed_for(name), SHORT)


@cache
def halted(name: str, how: str) -> Course:
    """A platform that comes to its stop, at once or soon."""
    bed = bed_for(name)
    assert bed.truth is not None
    start = {"leaning": LEANING, "thrown": THROWN}[how]
    return run_on(name, replace(bed, truth=replace(bed.truth, **start)), SHORT)


def test_names_differ_and_are_what_one_types():
    assert len(LAWS) == len(ALL) > 5
    assert all(name.replace("_", "").isalnum() and name == name.lower() for name in LAWS)


@pytest.mark.parametrize("name", CARDS)
def test_the_card_says_it_all(name):
    """A sentence for the idea; whatever it cites, a person who has only the papers can find."""
    card = CARDS[name]
    assert card.name == name
    for text in (card.idea, card.source, card.leaves, card.stable):
        assert len(text) > 8, text
        assert "TODO" not in text
        assert ".md" not in text
    assert card.idea[0].isupper()
    assert card.idea.endswith(".")
    assert card.needs
    assert set(card.needs) <= set(NEEDS)
    assert len(set(card.needs)) == len(card.needs)
    assert card.period > 0 or name not in LAWS


@every_law
def test_it_begins_on_the_reference_table_or_says_what_it_wants(name):
    why = refusal(name, read_preset("reference-table"))
    assert not why or "; wanted " in why
    assert not refusal(name, bed_for(name))


@every_law
def test_beginning_is_pure(name):
    bed, target = bed_for(name), TARGET.copy()
    before = frozen((bed, target))
    first, again = LAWS[name].begin(bed, target), LAWS[name].begin(bed, target)
    assert frozen((bed, target)) == before
    assert frozen(first) == frozen(again)


@every_law
def test_steps_are_pure(name):
    """Every step of a run, made twice: its input is as it was, and both come out alike."""
    assert len(ran(name).commands) >= 10
    assert ran(name).impure == []


@every_law
def test_commands_are_vectors_of_numbers(name):
    for command in ran(name).commands:
        for wanted in (command.shift, command.torque, command.magnetic, command.impulse):
            if wanted is not None:
                assert wanted.shape == (3,)
                assert np.all(np.isfinite(wanted))
        assert command.measurement is None or isinstance(command.measurement, Measurement)


@every_law
def test_a_testbed_that_lacks_a_device_is_refused_by_its_name(name):
    """Any one of the devices that the card names; with them all there is no refusal."""
    card, bed = LAWS[name].card, bed_for(name)
    check(card, bed)
    for need in card.needs:
        lacking = replace(bed, **WITHOUT[need])
        with pytest.raises(InputError, match=NEEDS[need]):
            check(card, lacking)
        with pytest.raises(InputError, match=f"law {name}.*{NEEDS[need]}"):
            next(run_law(SimulatedBench(lacking, 1), LAWS[name], SHORT))


@every_law
def test_what_the_card_names_is_enough(name):
    """Without any other device it begins, and makes its first steps."""
    card = LAWS[name].card
    others = [change for need, change in WITHOUT.items() if need not in card.needs]
    bare = replace(bed_for(name), **{key: value for each in others for key, value in each.items()})
    course = run_on(name, bare, LawOptions(max_time=13.0, proof=10.0))
    assert course.steps[-1].verdict is not None
    assert course.bench.refused == []


@every_law
def test_a_run_ends_with_a_verdict(name):
    """In time: no measurement begins that would overrun; masses under way may arrive.

    Cut short, masses may stand so that it topples, which then ends it.
    """
    course = ran(name)
    last = course.steps[-1]
    assert last.kind in ("verify", "stop")
    assert last.verdict is not None
    assert 10.0 < last.time < 20.0 + 15.0
    assert all(step.sentence for step in course.steps)


@every_law
def test_no_command_to_the_bench_exceeds_a_limit(name):
    for course in (ran(name), halted(name, "leaning"), halted(name, "thrown")):
        assert course.bench.refused == []


@every_law
@pytest.mark.parametrize("how", ["leaning", "thrown"])
def test_a_platform_at_its_tilt_limit_is_halted(name, how):
    """The verdict says so; every mass stands, and no device does anything any more."""
    course = halted(name, how)
    verdict = course.steps[-1].verdict
    assert verdict is not None
    assert (verdict.outcome, verdict.code) == ("halted", "tilted")
    bench = course.bench
    stood, measurements = (
        bench.displacements,
        sum(c.measurement is not None for c in course.commands),
    )
    assert measurements > 0 or bench.time < 5.0
    bench.read(0.5)  # what follows an input late has come to rest
    np.testing.assert_array_equal(bench.displacements, stood)
    observed = bench.read(AFTER)
    np.testing.assert_array_equal(bench.displacements, stood)
    assert observed.devices is not None
    for device, rows in zip(bench.testbed.devices, observed.devices.values.T, strict=True):
        if isinstance(device, ReactionWheel):
            gained = rows[-50:].mean() - rows[:50].mean()
            assert abs(gained) < 5 * device.speed_noise * np.sqrt(2 / 50)
        elif isinstance(device, Magnetorquer | JetPair):
            np.testing.assert_allclose(rows, 0.0, atol=1e-12)
