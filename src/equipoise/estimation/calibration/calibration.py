"""Calibration: what each mass really does for its command, and how the sensors stand.

A trajectory fit in which the drives of all masses that move are in doubt
(``actuators.drive_errors``) and may give way, the camera may lean and the gyro may be scaled and
turned: plainly to find rails and backlashes, then in the model that the record supports
(``reference_fit``), about these. Then the
numbers a person wants (``drive_calibration``, ``sensor_alignment``), y = f(x) of its unknowns x,

    cov y = F cov x F^T,      F = df/dx by central differences

Scale. The motion does not change when J, com and all gains are stretched alike. Ratios of gains,
rails and sensors are free of that; the common factor is known by one of: a trusted mass, whose
weight and steps are exact; a momentum or torque that devices reported; a held value or the
testbed's inertia as prior; or else by the prior that each product m d is stated to ``DOUBT.gain``.
No balance depends on it: com and the moves that cancel it are stretched alike.

Cannot see what never moved; see also the files named.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from equipoise.estimation.calibration.drive_calibration import (
    NUMBERS,
    Drive,
    alike_reasons,
    drives_of,
    labels_of,
    of_drive,
    pull,
    scatter_of,
    shown,
    together,
)
from equipoise.estimation.calibration.sensor_alignment import (
    ALIGNMENT,
    GYRO,
    SCALES,
    alignment_of,
    matrix_of,
)
from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.trajectory import params_of, run
from equipoise.estimation.model_selection.reference_fit import check_sensors
from equipoise.estimation.output_error.fit_estimate import UNSETTLED, conclude
from equipoise.estimation.output_error.free_vertical import PLUMB
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.estimation.search_budget import UNLIMITED, Budget, Stage
from equipoise.model import torque_terms
from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError, nearest
from equipoise.model.estimate import COM, INERTIA, Estimate, Parameter
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.data_reasons import Unexplained
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording, arranged
from equipoise.model.testbed import DriveDoubt, SlidingMass, Testbed

METHOD = "calibration"
DOUBT = DriveDoubt(0.1, 0.1, 1e-3)  # chosen: a weight and a pitch unmeasured; 6 deg; a worn screw
SAG = torque_terms.GROUPS["sag"]
STEP = 1e-6  # in SI, chosen: the unknowns bend over whole units
NEAR = 1e-3  # rad, chosen: stops err by 1e-3 mm aside then
SOON = 5e-3  # s, chosen: by which plays may be taken up too late; 50 ms moved backlashes by 2 sd
ROUNDS = 5  # plain fits at most
SURE = 4.0  # sd of a scatter before it counts as more than chance


@dataclass(frozen=True, slots=True, eq=False)
class CalibrateOptions:
    """What is asked for, and what is trusted."""

    reference: tuple[str, ...] = ()  # masses whose weight and steps are trusted
    terms: tuple[str, ...] = ()  # torques to estimate, beside the testbed's own
    hold: tuple[str, ...] = ()
    use_prior: bool = False
    budget: Budget = UNLIMITED  # of the search


def in_doubt(testbed: Testbed, reference: tuple[str, ...]) -> Testbed:
    """Return the testbed with all drives in doubt; of trusted masses only rail and backlash."""
    for name in reference:
        if name not in testbed.mass_names:
            wanted = nearest(name, list(testbed.mass_names)) if testbed.masses else "no masses"
            raise InputError("reference", f"'{name}'", wanted)

    def doubted(mass: SlidingMass) -> SlidingMass:
        gain = 0.0 if mass.name in reference else DOUBT.gain
        return replace(mass, doubt=replace(DOUBT, gain=gain))

    return replace(testbed, masses=tuple(doubted(mass) for mass in testbed.masses))


def sensor_terms_for(recording: Recording) -> tuple[str, ...]:
    """Return what a record may show of its sensors: a lean; by both, the gyro's axes."""
    camera = recording.attitude is not None and len(recording.attitude) > 0
    gyro = recording.rate is not None and len(recording.rate) > 0
    return (*(PLUMB if camera else ()), *(GYRO if camera and gyro else ()))


def calibrate(recording: Recording, testbed: Testbed, options: CalibrateOptions) -> Estimate:
    """Return the calibration; InputError for a mass to trust that does not exist."""
    recording = arranged(recording, testbed.mass_names)
    check_sensors(recording, testbed)
    doubted = in_doubt(testbed, options.reference)
    sag = SAG if any(mass.sag_sd > 0 for mass in testbed.masses) else ()  # of drives that give way
    terms = (*options.terms, *sag, *sensor_terms_for(recording))
    budget = options.budget.renewed()
    requested = Options(terms, options.hold, options.use_prior, budget=budget)
    about = drives_found(recording, doubted, params_of(doubted, requested))
    fitted = run(recording, about, requested)
    lost = nothing(fitted)
    if lost is not None:
        return lost
    drives = drives_of(doubted.masses, about.masses, recording, fitted)
    return concluded(fitted, drives, recording, options)


def nothing(fitted: Estimate) -> Estimate | None:
    """Return a calibration without numbers, if a fit says nothing of drives and sensors."""
    outcome = fitted.outcome
    if outcome is not UNSETTLED and fitted.has(GYRO[0]):
        mirrored = np.linalg.det(matrix_of(fitted.values(GYRO))) <= 0
        outcome = because(Why.GYRO_MIRRORED, outcome) if mirrored else outcome
    if fitted.parameters and outcome is fitted.outcome and outcome is not UNSETTLED:
        return None
    return replace(fitted, method=METHOD, outcome=outcome, parameters=(), ratios=(),
                   covariance=np.zeros((0, 0)), unobservable=())  # fmt: skip


def drives_found(recording: Recording, testbed: Testbed, params: Params) -> Testbed:
    """Return the testbed with rails and backlashes of plain fits, each about those of the last."""
    about = testbed
    for _ in range(ROUNDS):
        if not params.budget.allows(Stage.MOTION):
            break
        plain = fit(recording, about, params)
        found = conclude(plain, METHOD, recording)
        x = np.array([p.value for p in found.parameters])
        drives = drives_of(testbed.masses, about.masses, recording, found)
        guesses = {drive.mass.name: guess(drive, x) for drive in drives}
        before, masses = about.masses, [guesses.get(m.name, m) for m in about.masses]
        about = replace(testbed, masses=tuple(masses))
        if all(near(a, b) for a, b in zip(before, about.masses, strict=True)):
            break
    return about


def guess(drive: Drive, x: Floats) -> SlidingMass:
    """Return a mass on the rail, and with the backlash, that a fit found."""
    _, _, *axis, _, _, backlash = of_drive(drive, x)
    return replace(drive.mass, axis=np.array(axis), backlash=max(backlash, 0.0))


def near(one: SlidingMass, other: SlidingMass) -> bool:
    """Say whether two guesses of a drive leave a fit the same."""
    aside = float(np.abs(one.axis - other.axis).max())
    return aside < NEAR and abs(one.backlash - other.backlash) < SOON * one.speed


@dataclass(frozen=True, slots=True, eq=False)
class Map:
    """The numbers a person wants as a function of the fit's parameters."""

    labels: list[tuple[str, str]]
    of: Callable[[Floats], Floats]


def map_of(fitted: Estimate, drives: tuple[Drive, ...]) -> Map:
    """Return drives, sensors and the body, in this order."""
    same = [(name, "rad") for name in PLUMB if fitted.has(name)]
    same += [(name, "m") for name in COM] + [(name, "kg m2") for name in INERTIA]
    kept = np.array([fitted.index(name) for name, _ in same])
    turned = fitted.has(GYRO[0])
    gyro = np.array([fitted.index(name) for name in GYRO if turned], dtype=np.int64)
    axes = [(name, "rad") for name in ALIGNMENT] + [(name, "1") for name in SCALES]

    def of(x: Floats) -> Floats:
        sensors = alignment_of(x[gyro]) if turned else np.zeros(0)
        return np.concatenate([*(of_drive(drive, x) for drive in drives), sensors, x[kept]])

    labels = [label for drive in drives for label in labels_of(drive)]
    return Map([*labels, *(axes if turned else []), *same], of)


def slopes(of: Callable[[Floats], Floats], x: Floats) -> Floats:
    """Return F (m, n) by central differences."""
    steps = STEP * np.eye(len(x))
    return np.column_stack([(of(x + h) - of(x - h)) / (2 * STEP) for h in steps])


def concluded(
    fitted: Estimate, drives: tuple[Drive, ...], recording: Recording, options: CalibrateOptions
) -> Estimate:
    """Return the calibration that a fit amounts to."""
    x = np.array([p.value for p in fitted.parameters])
    hidden = np.array([not p.observable for p in fitted.parameters])
    wanted = map_of(fitted, drives)
    F = slopes(wanted.of, x)
    covariance = F @ fitted.covariance @ F.T
    sd = np.sqrt(np.maximum(np.diag(covariance), 0.0))
    observed = ~np.any(np.abs(F[:, hidden]) > 0, axis=1)
    alike = together(drives, fitted.covariance)
    for i, drive in enumerate(drives):
        part = slice(NUMBERS * i, NUMBERS * (i + 1))
        observed[part] &= shown(
            drive, sd[part], [k for k, each in alike.items() if i in chain(*each)]
        )
    found = [
        Parameter(name, unit, float(value), float(s) if ok else float("inf"), bool(ok))
        for (name, unit), value, s, ok in zip(
            wanted.labels, wanted.of(x), sd, observed, strict=True
        )
    ]
    scatters = [scatter_of(d, fitted, float(np.linalg.norm(pull(d, x)))) for d in drives]
    n, m = len(found), len(scatters)
    spread = np.zeros((n + m, n + m))
    spread[:n, :n] = covariance
    return replace(
        fitted,
        method=METHOD,
        outcome=outcome_of(fitted, drives),
        parameters=(*found, *scatters),
        covariance=spread,
        ratios=relative_gains(drives, wanted.of(x), covariance),
        unexplained=(
            *fitted.unexplained,
            *alike_reasons(drives, alike),
            *scale_reasons(drives, covariance, recording, options),
            *scatter_reasons(drives, scatters),
        ),
    )


def outcome_of(fitted: Estimate, drives: tuple[Drive, ...]) -> Outcome:
    """Return the fit's outcome; a record without moves calibrates no mass."""
    if drives:
        return fitted.outcome
    return because(Why.NO_MASS_MOVES, fitted.outcome)


def because(why: Why, fitted: Outcome) -> Outcome:
    """Return a fit's outcome with a reason before it."""
    return Outcome((Reason(why), *fitted.reasons))


def relative_gains(
    drives: tuple[Drive, ...], values: Floats, covariance: Floats
) -> tuple[Parameter, ...]:
    """Return each gain over the mean of all, which no scale changes; none for one drive alone."""
    n = len(drives)
    if n < 2:
        return ()
    at = NUMBERS * np.arange(n)
    gain, spread = values[at], covariance[np.ix_(at, at)]
    mean = float(gain.mean())
    F = (np.eye(n) - np.outer(gain, np.full(n, 1 / n)) / mean) / mean
    sd = np.sqrt(np.diag(F @ spread @ F.T))
    return tuple(
        Parameter(f"gain_{drive.mass.name} / mean", "1", float(g / mean), float(s))
        for drive, g, s in zip(drives, gain, sd, strict=True)
    )


def scale_reasons(
    drives: tuple[Drive, ...], covariance: Floats, recording: Recording, options: CalibrateOptions
) -> tuple[Reason, ...]:
    """Return by what the common scale of gains, inertia and centre of mass is known."""
    trusted = tuple(drive.mass.name for drive in drives if drive.trusted)
    inputs = (recording.momentum, recording.torque)
    if not drives:
        return ()
    if trusted:
        return (Reason(Unexplained.SCALE_BY_REFERENCE, trusted),)
    if any(c is not None and bool(np.any(c.values)) for c in inputs):
        return (Reason(Unexplained.SCALE_BY_DEVICES),)
    if options.hold or options.use_prior:
        return (Reason(Unexplained.SCALE_BY_INERTIA),)
    at = NUMBERS * np.arange(len(drives))
    sd = float(np.sqrt(covariance[np.ix_(at, at)].mean()))
    return (Reason(Unexplained.SCALE_BY_STATEMENTS, (), {"sd": sd, "stated": DOUBT.gain}),)


def scatter_reasons(drives: tuple[Drive, ...], scatters: list[Parameter]) -> list[Reason]:
    """Return whose stops scatter by more than is stated."""
    return [
        Reason(
            Unexplained.STOPS_SCATTER,
            (drive.mass.name,),
            {"found": found.value, "stated": drive.mass.accuracy},
        )
        for drive, found in zip(drives, scatters, strict=True)
        if found.observable and found.value - drive.mass.accuracy > SURE * found.sd / 2
    ]


def calibrated(testbed: Testbed, found: Estimate) -> Testbed:
    """Return the testbed with the gains, rails and backlashes that a calibration shows.

    A backlash whose interval holds zero stays as it is stated.
    """
    return replace(testbed, masses=tuple(mended(mass, found) for mass in testbed.masses))


def mended(mass: SlidingMass, found: Estimate) -> SlidingMass:
    """Return a mass as it was found."""
    gain, backlash = f"gain_{mass.name}", f"backlash_{mass.name}"
    rail = tuple(f"axis_{mass.name}_{letter}" for letter in "xyz")
    if found.sees((gain,)):
        mass = replace(mass, gain=float(found.values((gain,))[0]))
    if found.sees(rail):
        axis = found.values(rail)
        mass = replace(mass, axis=axis / np.linalg.norm(axis))
    if found.sees((backlash,)) and found.parameters[found.index(backlash)].low95 > 0:
        mass = replace(mass, backlash=float(found.values((backlash,))[0]))
    return mass
