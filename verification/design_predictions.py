"""What `equipoise design` predicts beside Monte Carlo: reach, what moves leave, what looks tell.

Moves are made by the simulator's actuators, mostly to the steps that ``displacements_for`` finds,
which is not how predictions allocate them; looks are fitted from records of the simulated bench.
Predicted and found agree within 15 %, or within what chance does to so few runs.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

from equipoise.actuators.mass_allocation import allocate, rails_of
from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.estimation.output_error import trajectory
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.estimation.output_error.free_vertical import PLUMB
from equipoise.io.testbed.presets import read_preset
from equipoise.model.defects import CameraErrors
from equipoise.model.estimate import END, INERTIA
from equipoise.model.testbed import SlidingMass, Testbed
from equipoise.planning.manoeuvre.reference_manoeuvre import usual_swing
from equipoise.planning.sizing.budget import SOME, budget_of, even_normals, mean_square, platforms
from equipoise.planning.sizing.case import Case
from equipoise.planning.sizing.expected_torque import expected_torque
from equipoise.planning.sizing.measurement_bound import first_bound
from equipoise.planning.sizing.move_error import at_home, move
from equipoise.planning.sizing.reachable_set import contains, reach_of
from equipoise.procedure.steps.displacement_choice import displacements_for
from equipoise.simulation import actuator
from equipoise.simulation.carried_out import bench_for, carried_out
from equipoise.simulation.draw_truth import own_truth
from verification.result import Result, Row, Spread, at_most, between, in_turn

AGREE = 0.15  # what predictions may be off by
CHANCE = 3.5  # sd of a root mean square over few runs, 1 / sqrt(2 n) of it
SECONDS = 120.0  # s: so long that what is known beforehand does not matter
TILT = np.radians(20.0)
MEASUREMENT = 60.0  # s
Array = NDArray[np.float64]


def pyramid() -> Testbed:
    """Return four masses on rails that rise to the middle, with backlash (after Liu 2016)."""
    bed = read_preset("sputnix")
    slant = np.radians(40.0)
    masses = [
        SlidingMass(
            f"m{k}", 0.2, 0.2 * np.array([np.cos(a), np.sin(a), 0.0]),
            np.array([-np.cos(a) * np.cos(slant), -np.sin(a) * np.cos(slant), np.sin(slant)]),
            (-0.03, 0.03), 2e-4, 5e-5, 1e-4, 0.01, 0.0, 0.0,
        )
        for k, a in enumerate(np.arange(4) * np.pi / 2)
    ]  # fmt: skip
    return replace(bed, name="pyramid", masses=tuple(masses), com_sd=np.full(3, 8e-5))


def beds() -> tuple[Testbed, ...]:
    """Return the testbeds on which moves are tried."""
    return *map(read_preset, ("sputnix", "unb", "reference-table")), pyramid()


def band(n: int) -> tuple[float, float]:
    """Return within what a ratio of root mean squares over n runs should lie."""
    off = max(AGREE, CHANCE / np.sqrt(2 * n))
    return 1 - off, 1 + off


# --- Reach -----------------------------------------------------------------------------------


def can_be_reached(testbed: Testbed, shift: Array) -> bool:
    """Say by linear programming whether some displacements make a shift."""
    gain = mass_maps(testbed.masses).first_moment / testbed.body.mass
    k, bounds = len(testbed.masses), [mass.travel for mass in testbed.masses]
    return linprog(np.zeros(k), A_eq=gain.T * 1e6, b_eq=shift * 1e6, bounds=bounds).status == 0


def reach_rows(testbed: Testbed, n: int) -> tuple[Row, Row]:
    """Return how far random commands go, and whether reach says what a programme does."""
    rng, reach = np.random.default_rng(n), reach_of(testbed.masses, testbed.body.mass)
    low, high = np.array([mass.travel for mass in testbed.masses]).T
    share = rng.uniform(-0.5, 1.5, (200 * n, len(low))).clip(0, 1)  # half of them at an end
    maps = mass_maps(testbed.masses)
    made = (low + share * (high - low)) @ maps.first_moment / testbed.body.mass
    ways = rng.normal(size=(20, 3))
    support = ways @ reach.centre + np.abs(ways @ reach.edges.T).sum(axis=1)
    found = (made @ ways.T).max(axis=0) / support
    tried = 1.3 * np.abs(made).max(axis=0) * rng.uniform(-1, 1, (n, 3))
    said = contains(reach, tried)
    wrong = sum(can_be_reached(testbed, s) != bool(k) for s, k in zip(tried, said, strict=True))
    return (
        between(f"{testbed.name}: {200 * n} random commands reach of what is predicted, least and "
                "most of 20 directions", float(found.min()), (1 - AGREE, 1 + 1e-9), ".3f"),
        at_most(f"{testbed.name}: of {n} shifts, told within reach or not against a linear "
                "programme", float(wrong), 0.0, ".0f"),
    )  # fmt: skip


# --- Moves -----------------------------------------------------------------------------------


class Chain(NamedTuple):
    """One platform balanced by looks and moves: errors about the target, m."""

    first: Array  # after the first move, had the look before it been exact
    last: Array  # after the last move


def goals_for(testbed: Testbed, now: Array, wanted: Array) -> Array:
    """Return where masses should go (m), as ``balance`` has it on rails at right angles.

    Where coarse and fine masses share a rail, and on skew rails, ``balance`` finds combinations of
    steps that laws miss, and leaves less. There they go as laws send them.
    """
    masses, total = testbed.masses, testbed.body.mass
    rails = rails_of(masses, total)
    if rails.tier.any() or np.count_nonzero(rails.gain) > len(masses):
        return allocate(rails, now, wanted + com_shift(mass_maps(masses), total, now))
    return displacements_for(testbed, now, wanted)


def is_expected_to_pay(
    testbed: Testbed, travel: actuator.Travel, wanted: Array, change: Array
) -> bool:
    """Say whether a change of displacements should leave less than there is."""
    maps, total = mass_maps(testbed.masses), testbed.body.mass
    missed = wanted - com_shift(maps, total, change)
    stops = np.array([m.accuracy * m.mass / total for m in testbed.masses])
    stopped = travel.end[actuator.REAL] != travel.end[actuator.HELD]
    left = missed @ missed + np.sum(stops**2 * (1 + stopped) * (change != 0))
    return bool(left < wanted @ wanted)


def moved(
    testbed: Testbed, travel: actuator.Travel, wanted: Array, rng: np.random.Generator
) -> actuator.Travel:
    """Return masses sent to where they shift the centre of mass by what is wanted, if it pays."""
    now = travel.end[actuator.REPORTED]
    goal = goals_for(testbed, now, wanted)
    if not is_expected_to_pay(testbed, travel, wanted, goal - now):
        return travel
    targets = {i: float(d) for i, d in enumerate(goal) if d != now[i]}
    later = float(travel.arrive.max()) + 1.0
    return actuator.sent(travel, later, targets, testbed.masses, (), rng)


def chain(testbed: Testbed, measurements: tuple[Array, Array, Array], seed: int) -> Chain:
    """Balance one platform by two moves.

    ``measurements`` are covariances (m^2): of the first measurement, of what is left after the
    first move, and of the second measurement.
    """
    rng = np.random.default_rng([seed, 5])
    maps, total = mass_maps(testbed.masses), testbed.body.mass
    reach = reach_of(testbed.masses, total)

    def stands(travel: actuator.Travel) -> Array:
        return com + com_shift(maps, total, travel.end[actuator.REAL])

    com = testbed.body.com + testbed.com_sd * rng.normal(size=3)
    while not contains(reach, -com[None])[0]:
        com = testbed.body.com + testbed.com_sd * rng.normal(size=3)
    home, (first, before, last) = actuator.left_at(testbed.masses, {}, rng), measurements
    exact = stands(moved(testbed, home, -com, rng))
    travel = moved(testbed, home, -com - rng.multivariate_normal(np.zeros(3), first), rng)
    noise = np.linalg.inv(np.linalg.inv(last) - np.linalg.inv(before))
    measured = stands(travel) + rng.multivariate_normal(np.zeros(3), noise)
    found = last @ np.linalg.solve(noise, measured)
    return Chain(exact, stands(moved(testbed, travel, -found, rng)))


def case_of(testbed: Testbed) -> Case:
    """Return the case that is tried: two moves to the centre of rotation."""
    return Case(testbed, np.zeros(3), TILT, MEASUREMENT, 2)


def left_by_first(testbed: Testbed) -> Array:
    """Return what is predicted of the first move after an exact look, m^2."""
    case, k = case_of(testbed), len(testbed.masses)
    reach, normals = reach_of(testbed.masses, testbed.body.mass), even_normals(SOME, 3 + 3 * k)
    kept, offsets = platforms(case, reach, normals[:, :3])
    rails, stops = np.split(normals[kept, 3:], [2 * k], axis=1)
    home = at_home(testbed, offsets, rails, case.rail_lean)
    after, _ = move(testbed, home, offsets, stops, case.rail_lean)
    return mean_square(after.error)


def move_rows(testbed: Testbed, seeds: Sequence[int]) -> tuple[Row, ...]:
    """Return what moves leave, found over predicted."""
    one, two = budget_of(replace(case_of(testbed), moves=1)), budget_of(case_of(testbed))
    measurements = (one.last.com, mean_square(one.standing.error), two.last.com)
    runs, n = [chain(testbed, measurements, seed) for seed in seeds], len(seeds)
    first = mean_square(np.array([run.first for run in runs]))
    axes = np.sqrt(np.diag(first) / np.diag(left_by_first(testbed)))
    torque = expected_torque(testbed, mean_square(np.array([run.last for run in runs])), TILT)
    reported = expected_torque(testbed, mean_square(two.standing.error), TILT)
    name = f"{testbed.name}, {n} runs"
    return (
        between(f"{name}: rms of com after one move by an exact look, found / predicted, least "
                "axis", float(axes.min()), band(n), ".3f"),
        between(f"{name}: the same, greatest axis", float(axes.max()), band(n), ".3f"),
        between(f"{name}: rms torque after two looks and moves, found / predicted "
                f"({1e6 * reported:.3g} uN m)", torque / reported, band(n), ".3f"),
    )  # fmt: skip


# --- Looks -----------------------------------------------------------------------------------


def stiff(name: str) -> Testbed:
    """Return a preset whose masses neither lag nor hang, and whose bench is as it states."""
    bed = read_preset(name)
    masses = tuple(replace(m, lag_sd=0.0, sag_sd=0.0) for m in bed.masses)
    return replace(bed, masses=masses, truth=None)


def bench_bed(testbed: Testbed, seed: int) -> Testbed:
    """Return the testbed with a truth as stated, its camera leaning and its gyro off as it may."""
    rng, truth = np.random.default_rng([seed, 3]), own_truth(testbed)
    camera, gyro = testbed.attitude, testbed.gyro
    lean = np.append((camera.plumb_sd if camera else 0.0) * rng.normal(size=2), 0.0)
    bias = (gyro.bias_sd if gyro else 0.0) * rng.normal(size=3)
    return replace(testbed, truth=replace(truth, camera=CameraErrors(plumb=lean), gyro_bias=bias))


def measurement_error(name: str, seed: int) -> Array:
    """Return how far a fit of one record is off in com at its end and in the moments of inertia."""
    testbed = stiff(name)
    manoeuvre = replace(usual_swing(testbed, SECONDS).manoeuvre, tilt_sd=0.0, rate_sd=0.0)
    bench = bench_for(bench_bed(testbed, seed), manoeuvre, seed)
    recording = carried_out(bench, manoeuvre)
    params = trajectory.Params((), sensor=PLUMB, use_prior=True)
    fitted = trajectory.fit(recording, testbed, params)
    reported = conclude(fitted, trajectory.METHOD, recording).values((*END, *INERTIA[:3]))
    return reported - np.append(bench.com, np.diag(testbed.body.inertia_P))


def measurement_rows(name: str, errors: Sequence[Array]) -> tuple[Row, ...]:
    """Return errors of fits over what was predicted."""
    reported = first_bound(stiff(name), SECONDS)
    ratio = np.sqrt(np.mean(np.square(errors), axis=0)) / np.append(
        reported.com_sd, reported.inertia_sd[:3]
    )
    n, text = len(errors), "RMSE of a fit / predicted sd"
    com, inertia = ratio[:3], ratio[3:]
    return tuple(
        between(f"{name}, {n} records of {SECONDS:g} s: {text}, {what}", float(value), band(n),
                ".3f")
        for what, value in (
            ("com, least axis", com.min()), ("com, greatest axis", com.max()),
            ("J, least axis", inertia.min()), ("J, greatest axis", inertia.max()),
        )
    )  # fmt: skip


def measure(seeds: Sequence[int], spread: Spread = in_turn, every: int = 1) -> Result:
    """Try reach and moves on four testbeds, looks on two; ``every`` so-manieth seed has a look."""
    rows: list[Row] = []
    for testbed in beds():
        rows += reach_rows(testbed, len(seeds))
    for found in spread(partial(move_rows, seeds=seeds), beds()):
        rows += found
    for name in ("sputnix", "unb"):
        rows += measurement_rows(name, spread(partial(measurement_error, name), seeds[::every]))
    claim = (
        "What `equipoise design` predicts of reach, of the centre of mass after a move, of the "
        "torque after two, and of what records tell agrees with Monte Carlo within 15 %."
    )
    return Result("design_predictions", claim, tuple(rows))
