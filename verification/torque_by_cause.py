"""Torque by cause against the truth of simulated platforms, and on a real recording.

Every record is of another platform. Its true torque is integrated from the simulated motion
(`study.true_torque`), cause by cause, second by second.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.presets import read_preset
from equipoise.io.testbed.testbed_file import read_testbed
from equipoise.model.testbed import Gyro, Testbed
from equipoise.model.torque_by_cause import CAUSES, TOTAL, TorqueByCause
from equipoise.model.torque_terms import expand, typical_sizes
from equipoise.model.units import PERCENT
from equipoise.procedure.identification.attribute_torque import attribute_torque
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from equipoise.simulation.carried_out import Moves, recorded
from equipoise.study.true_torque import TrueTorqueBench
from verification import torque_on_mujoco
from verification.judged_torque import Judged, judged_by, share
from verification.real_record import HELD, RECORD, TESTBED
from verification.result import Result, Row, Spread, at_least, at_most, between, in_turn

DURATION = 60.0  # s
SEED = 100  # of the first platform
ON_MUJOCO = {torque_on_mujoco.MOVED: torque_on_mujoco.moved,
             torque_on_mujoco.KEPT: torque_on_mujoco.kept}  # fmt: skip
BAND = (0.92, 0.98)  # of components within their 95 % intervals
Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Kind:
    """What acts on a platform."""

    name: str
    noise: float = 2e-6  # N m, of air
    terms: tuple[str, ...] = ()
    torque: Mapping[str, float] = field(default_factory=dict[str, float])
    drawn: tuple[str, ...] = ()  # terms as large as their stated sizes, another on each platform
    height: float = -100e-6  # m, of the centre of mass
    aside: float = 8e-6  # m, the same across, at most
    moves: Moves = ((20.5, {"x1": 2e-3}), (40.5, {"y1": -2e-3}))
    gyro: bool = True


KINDS = (
    Kind("air"),
    Kind("still air", noise=0.0),
    Kind("strong air", noise=1e-5),
    Kind("drift", terms=("drift",), torque={"drift_x": 3e-8, "drift_y": -5e-8}),
    Kind("sag", terms=("sag",), drawn=("sag",), height=-400e-6),
    Kind("damped", terms=("viscous",),
         torque={"viscous_x": 2e-4, "viscous_y": 2e-4, "viscous_z": 4e-4}),
    Kind("nearly balanced", height=-5e-6, aside=5e-7, moves=((20.5, {"x1": 2e-4}),)),
    Kind("camera alone", noise=1e-5, gyro=False),
)  # fmt: skip


def torque_of(kind: Kind, seed: int) -> dict[str, float]:
    """Return what acts on one platform, by term.

    A record of a minute hardly shows a sag: an interval of it is honest for sags as they are
    stated, not for one that was chosen.
    """
    drawn, rng = expand(kind.drawn), np.random.default_rng([seed, 1])
    sizes = typical_sizes(drawn) * rng.standard_normal(len(drawn))
    return dict(kind.torque) | dict(zip(drawn, sizes.tolist(), strict=True))


def testbed_of(kind: Kind, seed: int) -> Testbed:
    """Return a table whose masses stop within 20 um and whose description is honest."""
    preset, torque = read_preset("sputnix"), torque_of(kind, seed)
    assert preset.truth is not None
    masses = tuple(replace(m, accuracy=2e-5, resolution=1e-5) for m in preset.masses)
    low, high = (np.array([s * kind.aside, s * kind.aside, f * kind.height])
                 for s, f in ((-1, 1.3), (1, 0.7)))  # fmt: skip
    com = 0.5 * (low + high)
    truth = replace(preset.truth, torque=torque, noise_torque=kind.noise,
                    noise_correlation=30.0, com_low=low, com_high=high,
                    rate_limit=0.3 * preset.truth.rate_limit)  # fmt: skip
    gyro = Gyro(20.0, 5e-5, 1e-3) if kind.gyro else None
    return replace(
        preset, masses=masses, gyro=gyro, truth=truth, disturbances=expand(kind.terms),
        com_sd=(high - low) / np.sqrt(12.0), body=replace(preset.body, com=com),
    )  # fmt: skip


def judged(kind: Kind, seed: int) -> Judged | None:
    """Return one record against its truth; None where the platform met its stop, or no estimate."""
    testbed = testbed_of(kind, seed)
    bench = TrueTorqueBench(testbed, seed)
    recording = recorded(bench, DURATION, kind.moves)
    *_, last = identify(recording, testbed, IdentifyOptions("trajectory"))
    if bench.touches or last.estimate is None or not last.estimate.outcome.usable:
        return None
    found = attribute_torque(recording, testbed, last.estimate)
    true = bench.torque_by_cause(np.append(found.t, found.t[-1] + found.interval))
    by_name = dict(zip(CAUSES, np.moveaxis(true, 1, 0), strict=True))
    return judged_by(kind.name, found, by_name | {TOTAL: true.sum(axis=1)})


def cause_rows(runs: Sequence[Judged]) -> tuple[Row, ...]:
    """Return the coverage of each cause that acted, and of the sum."""
    z = np.concatenate([run.z for run in runs])
    every = {name: z[:, k] for k, name in enumerate(CAUSES)}
    shares = {name: share(z) for name, z in every.items()}
    shares["total"] = share(np.concatenate([run.total for run in runs]))
    return tuple(
        between(f"{name}: share of its mean torque in a second within the 95 % interval", found,
                BAND)
        for name, found in shares.items()
        if np.isfinite(found)
    )  # fmt: skip


def real_torque() -> TorqueByCause:
    """Return the torque by cause of the real recording, com_y held at CAD."""
    recording, testbed = read_recording(RECORD), read_testbed(TESTBED)
    *_, last = identify(recording, testbed, IdentifyOptions("trajectory", hold=HELD))
    assert last.estimate is not None
    return attribute_torque(recording, testbed, last.estimate)


def closure_rows(torque: TorqueByCause) -> tuple[Row, ...]:
    """Return whether the sum closes the momentum balance of a real recording."""
    closure = torque.closure
    return (
        at_most("real recording: what is left of the momentum balance, rms, in its sd",
                closure.normalised_rms, 1.2),
        at_least("real recording: share of it within its 95 % band", closure.share_within, 0.9),
    )  # fmt: skip


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Divide the torque of one platform of each kind for each seed."""
    jobs = [(kind, SEED + len(KINDS) * seed + k) for seed in seeds for k, kind in enumerate(KINDS)]
    jobs += [(kind, seed) for seed in seeds for kind in ON_MUJOCO]
    runs = [run for run in spread(_judged_job, jobs) if run is not None]
    closure = float(np.sqrt(np.mean([run.closure**2 for run in runs])))
    rows = [
        *cause_rows(runs),
        at_most("what is left of the momentum balance, rms, in its sd", closure, 1.2),
        *(closure_rows(real_torque()) if RECORD.exists() else ()),
    ]
    notes = [
        f"{name}: the total is within in {share(np.concatenate(own)) / PERCENT:.1f} % of the "
        f"seconds of {len(own)} records."
        for name in (*(kind.name for kind in KINDS), *ON_MUJOCO)
        if (own := [run.total for run in runs if run.kind == name])
    ]
    claim = (
        f"{len(runs)} records, each of another platform, of {len(KINDS)} simulated kinds (14 kg, "
        f"{DURATION:g} s: air torque of 0 to 10 uN m, drift, sag, damping, nearly balanced, camera "
        "alone) and two of MuJoCo bodies: moved once (14 kg, 60 s), and kept balanced in an "
        "experiment (4 kg, 150 s, slow masses, wheels, drift, lamp), both in air of 3 uN m. Mean "
        "torque of each cause in each second against the truth. "
        "Errors within a record are correlated: com and the scale err once a platform."
    )
    return Result("ledger", claim, tuple(rows), tuple(notes))


def _judged_job(job: tuple[Kind | str, int]) -> Judged | None:
    kind, seed = job
    return ON_MUJOCO[kind](seed) if isinstance(kind, str) else judged(kind, seed)
