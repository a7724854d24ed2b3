"""Records as other laboratories make them: nothing may fail, and no wrong number be stated firmly.

A number counts when the estimate calls itself usable and states a finite sd for it: centre of mass
and inertia, or their ratios where the scale is open. A held value is no number that was found.
"""

import time
from collections.abc import Callable, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from equipoise.model.estimate import NORMAL_95, Estimate
from equipoise.model.units import MN_M
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from tests.oracle import laboratories as labs
from verification.result import Result, Row, Spread, at_least, at_most, in_turn
from verification.stated_errors import NAMES, true_values

WORST = 4.0  # sd
COVER = 0.90  # of the 95 % intervals, over all records
SLOWEST = 60.0  # s of one processor, chosen: what a person waits for
SCALE = ("inertia_P_zz",)
Make = Callable[[int], labs.Record]


class Kind(NamedTuple):
    """One way to make a record, and what the user holds."""

    make: Make
    hold: tuple[str, ...] = ()


QUIET = 0.2 * labs.NOISE
KINDS: dict[str, Kind] = {
    "280 deg/s": Kind(labs.spun),
    "280 deg/s, J_zz known": Kind(lambda seed: labs.spun(seed).knowing(2), SCALE),
    "280 deg/s, spinning down": Kind(partial(labs.spun, down=True)),
    "280 deg/s, com 3 mm below": Kind(partial(labs.spun, depth=0.003)),
    "tilts to 20 deg": Kind(labs.tilted),
    "tilts to 28 deg, no move": Kind(partial(labs.tilted, tilt_deg=28.0, moved=False)),
    "gyro in steps": Kind(labs.tumbling),
    "gyro in steps, J_zz known": Kind(lambda seed: labs.tumbling(seed).knowing(2), SCALE),
    "gyro in steps, masses moved": Kind(partial(labs.tumbling, moved=True)),
    "quiet gyro in steps, 10 min": Kind(
        partial(labs.tumbling, duration=600.0, noise=QUIET, stated=QUIET, spin=1.0, moved=True)
    ),
    "quiet gyro, noise said a tenth": Kind(
        partial(labs.tumbling, noise=QUIET, stated=0.1 * QUIET, reported=False, moved=True)
    ),
    "gyro that the testbed lacks": Kind(lambda seed: labs.tumbling(seed).unstated()),
    "pendulum in one plane": Kind(labs.in_a_plane),
    "pendulum in one plane, no move": Kind(partial(labs.in_a_plane, moved=False)),
    "hardly any motion": Kind(partial(labs.at_rest, rate_deg_s=0.05)),
    "at rest, then moved": Kind(partial(labs.at_rest, moved=True)),
    "gap of 28 s": Kind(lambda seed: labs.silent(labs.tilted(seed, 5.0), (70.0, 98.0))),
    "gap over the move": Kind(lambda seed: labs.silent(labs.tilted(seed, 5.0), (40.0, 68.0))),
    "three gaps": Kind(
        lambda seed: labs.silent(labs.tilted(seed, 5.0), (10.0, 38.0), (48.0, 76.0), (86.0, 114.0))
    ),
    "gap in a spin": Kind(lambda seed: labs.silent(labs.spun(seed), (8.0, 36.0))),
    "motor 5 mN m, bang-bang": Kind(lambda s: labs.motored(s, labs.bang_bang(5 * MN_M))),
    "motor 5 mN m, sine": Kind(lambda s: labs.motored(s, labs.sine(5 * MN_M))),
    "motor 5 mN m, ramps": Kind(lambda s: labs.motored(s, labs.sawtooth(5 * MN_M))),
    "motor 2 mN m, ramps": Kind(lambda s: labs.motored(s, labs.sawtooth(2 * MN_M))),
    "motor 50 mN m, bang-bang": Kind(lambda s: labs.motored(s, labs.bang_bang(50 * MN_M))),
}


class Found(NamedTuple):
    """One record identified."""

    kind: str
    seed: int
    usable: bool
    z: tuple[float, ...]  # errors of what is stated, in stated sd; none when not usable
    seconds: float
    failure: str  # what stopped it, if anything did


def stated(estimate: Estimate, record: labs.Record, held: tuple[str, ...]) -> tuple[float, ...]:
    """Return the errors of all numbers with a finite sd, in that sd."""
    true = dict(zip(NAMES, true_values(record.truth), strict=True))
    for ratio in estimate.ratios:
        above, below = ratio.name.split("/")
        true[ratio.name] = true[above] / true[below]
    reported = [p for p in (*estimate.parameters, *estimate.ratios) if p.name in true]
    firm = [p for p in reported if np.isfinite(p.sd) and p.name not in held]
    return tuple(float((p.value - true[p.name]) / p.sd) for p in firm)


def found(item: tuple[str, int]) -> Found:
    """Identify the record of one kind and seed."""
    name, seed = item
    kind = KINDS[name]
    record = kind.make(seed)
    began = time.process_time()
    try:
        options = IdentifyOptions("trajectory", hold=kind.hold)
        *_, last = identify(record.recording, record.testbed, options)
    except Exception as error:  # what is counted here is whatever goes wrong
        return Found(name, seed, False, (), 0.0, f"{type(error).__name__}: {error}")
    seconds = time.process_time() - began
    assert last.estimate is not None
    usable = last.estimate.outcome.usable
    z = stated(last.estimate, record, kind.hold) if usable else ()
    return Found(name, seed, usable, z, seconds, "")


def rows_of(runs: Sequence[Found], slowest: float = SLOWEST) -> tuple[Row, ...]:
    """Return the rows over all kinds."""
    failed = [run for run in runs if run.failure]
    z = np.array([value for run in runs for value in run.z])
    inside = float(np.mean(np.abs(z) < NORMAL_95)) if len(z) else 1.0
    late = max(runs, key=lambda run: run.seconds)
    why = f" ({failed[0].kind}, seed {failed[0].seed}: {failed[0].failure})" if failed else ""
    return (
        at_most(f"records that could not be identified{why}", len(failed), 0, "d"),
        at_least(f"95 % intervals, of {len(z)}, that hold the truth", inside, COVER, ".1%"),
        at_most(f"longest time, s ({late.kind})", late.seconds, slowest),
    )


def worst_rows(runs: Sequence[Found]) -> tuple[Row, ...]:
    """Return the greatest error of each kind of record, in stated sd."""
    rows: list[Row] = []
    for kind in dict.fromkeys(run.kind for run in runs):
        own = [run for run in runs if run.kind == kind]
        usable = sum(run.usable for run in own)
        worst = max((abs(value) for run in own for value in run.z), default=0.0)
        text = f"{kind}: greatest error / sd; {usable} of {len(own)} usable"
        rows.append(at_most(text, worst, WORST))
    return tuple(rows)


def measure(
    seeds: Sequence[int],
    spread: Spread = in_turn,
    kinds: Sequence[str] = tuple(KINDS),
    slowest: float = SLOWEST,
) -> Result:
    """Identify the records of all kinds, once for each seed."""
    claim = (
        f"On MuJoCo's records of {len(kinds)} other laboratories (inertia 20 % off beforehand), "
        f"{len(seeds)} of each kind, nothing fails and no wrong number is stated firmly: an "
        "estimate says that it is not usable, that a number is not seen, or is right within 4 sd."
    )
    runs = spread(found, [(kind, seed) for kind in kinds for seed in seeds])
    return Result("laboratories", claim, (*rows_of(runs, slowest), *worst_rows(runs)))
