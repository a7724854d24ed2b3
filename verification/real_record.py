"""A real recording: touches, a leaning camera, means of frames, one bad row; scale fixed by CAD.

The recording does not belong to the project; without it nothing is measured.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import numpy as np

from equipoise.assessment.findings.record_findings import findings
from equipoise.estimation.events.record_model import jumping
from equipoise.estimation.model_selection import reference_fit
from equipoise.estimation.output_error.solution import evaluate
from equipoise.estimation.output_error.trajectory import Params
from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.testbed_file import read_testbed
from equipoise.model.estimate import Estimate
from equipoise.model.outcome import OutcomeCode
from equipoise.model.reasons.finding_reasons import FindingReason
from equipoise.model.recording import window
from equipoise.model.torque_terms import GROUPS
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from equipoise.procedure.identification.swing_metrics import swing_metrics
from equipoise.procedure.steps.clean_record import sound
from verification.result import Result, Row, Spread, at_most, in_turn, triple

ROOT = Path(__file__).parents[1]
RECORD = ROOT.parent / "shared" / "data" / "optitrack_tumbling.csv"
TESTBED = ROOT / "verification" / "optitrack.toml"
WHOLE, QUIET = (0.0, 60.0), (20.0, 40.0)  # s
WINDOWS = ((0.0, 15.0), (15.0, 30.0), (30.0, 45.0), (45.0, 60.0))
HELD = ("com_y",)
TOUCHES = (3.46, 3.90, 10.9, 11.3, 18.4, 25.8)  # s, as read before by other means
NEAR_TOUCH, CALM_FROM = 0.3, 30.0  # s
RMS, AHEAD, SEPARATION, CONTRADICT = 0.12, 1.5, 0.005, 3.0  # deg per axis, deg, -, sd
NEAR_CAD = 0.08
MOMENTS = ("inertia_P_xx", "inertia_P_yy", "inertia_P_zz")
MODES = {0: "the slow swing", 1: "the quick swing", None: "both swings"}
Job = tuple[tuple[float, float], tuple[str, ...]]


def identified(job: Job) -> Estimate:
    """Identify a part of the record with values held at CAD."""
    (start, end), hold = job
    recording, testbed = window(read_recording(RECORD), start, end), read_testbed(TESTBED)
    *_, last = identify(recording, testbed, IdentifyOptions("trajectory", hold=hold))
    assert last.estimate is not None
    return last.estimate


def said(quantity: str, sentence: str, wanted: str, ok: bool) -> Row:
    """Return a row whose finding is a sentence."""
    return Row(quantity, sentence, wanted, ok)


def predicted() -> float:
    """Return how far (deg rms per axis) a model of 0-30 s alone is from the rows of 30-60 s."""
    recording, testbed = sound(read_recording(RECORD), read_testbed(TESTBED))
    part = window(recording, WHOLE[0], CALM_FROM)
    params = Params(GROUPS["viscous"], hold=HELD)
    posterior = reference_fit.steady(reference_fit.surveyed(part, testbed, params))
    problem, jumps = jumping(posterior, recording, posterior.fitted.problem.jumps)
    left = evaluate(problem, posterior.fitted.point, jumps).left_q * problem.observed.attitude_sd
    assert recording.attitude is not None
    fresh = left[recording.attitude.t > CALM_FROM]
    return float(np.degrees(np.sqrt(np.mean(fresh**2))))


def touch_rows(whole: Estimate) -> tuple[Row, ...]:
    """Return the rows about what touched the platform."""
    times = np.array([event.t for event in whole.events])
    worst = max(float(np.abs(times - t).min()) for t in TOUCHES) if len(times) else np.inf
    late = int(np.sum(times > CALM_FROM))
    shown = ", ".join(f"{t:.2f}" for t in times)
    return (
        at_most(f"0-60 s: events at {shown} s; farthest of the six known touches from one, s",
                worst, NEAR_TOUCH),
        at_most("the same: events after 30 s, where there are none", late, 0, "d"),
    )  # fmt: skip


def finding_rows() -> tuple[Row, ...]:
    """Return the rows about what reading alone tells."""
    recording, testbed = read_recording(RECORD), read_testbed(TESTBED)
    found = {f.code: f for f in findings(recording, testbed)}
    means = FindingReason.ROWS_AVERAGED in found
    odd = found.get(FindingReason.ROW_NOT_A_MEAN)
    last = odd is not None and odd.reasons[0].numbers["row"] == len(recording.attitude or ())
    return (
        said("rows are means of frames", "told" if means else "not told", "told", means),
        said("the last row is not", "told" if last else "not told", "told", last),
    )  # fmt: skip


def whole_rows(whole: Estimate) -> tuple[Row, ...]:
    """Return the rows of the whole minute."""
    assert whole.residual is not None
    calm = float(np.degrees(whole.residual.steady_rms or np.nan))
    white = whole.residual.whiteness
    return (
        at_most("the same: deg rms per axis left without process noise", calm, RMS),
        said("the same: probability of what is left being white noise", f"{white:.2g}",
             "tested and told", np.isfinite(white)),
        said("the same: outcome", whole.outcome.sentence, "usable", whole.outcome.usable),
    )  # fmt: skip


def window_rows(parts: Sequence[Estimate]) -> tuple[Row, ...]:
    """Return the rows about what four parts of the record say by themselves."""
    J = np.array([part.values(MOMENTS) for part in parts])
    sd = np.array([[part.parameters[part.index(n)].sd for n in MOMENTS] for part in parts])
    separation = float((J.std(axis=0, ddof=1) / J.mean(axis=0)).max())
    off = max(
        float((np.abs(J[a] - J[b]) / np.hypot(sd[a], sd[b])).max())
        for a, b in combinations(range(len(parts)), 2)
    )
    shown = "; ".join(triple(1e3 * moments) for moments in J)
    return (
        at_most(f"four 15 s parts: J {shown} g m2; sd of any moment among them", separation,
                SEPARATION, ".2%"),
        at_most("the same: greatest difference of two, in its sd", off, CONTRADICT),
    )  # fmt: skip


def quiet_rows(quiet: Estimate) -> tuple[Row, ...]:
    """Return the rows of the part in which almost nothing happens."""
    cad = np.diag(read_testbed(TESTBED).body.inertia_P)
    moments = quiet.values(MOMENTS)
    off = float(np.abs(moments / cad - 1).max())
    return (
        at_most(f"20-40 s: J {triple(1e3 * moments)} g m2 about P, from CAD {triple(1e3 * cad)}; "
                "worst", off, NEAR_CAD, ".1%"),
    )  # fmt: skip


def measurement_rows(quiet: Estimate) -> tuple[Row, ...]:
    """Return how simple looks at the same part agree on how far the centre of mass hangs from P.

    J is that of the fit; the distance of the fit is CAD's, which is held.
    """
    recording, testbed = sound(window(read_recording(RECORD), *QUIET), read_testbed(TESTBED))
    body = replace(testbed.body, com=quiet.com, inertia_P=quiet.inertia_P)
    observed = swing_metrics(recording, replace(testbed, body=body))
    assert observed.torque_fit is not None
    held, weight = float(np.linalg.norm(quiet.com)), testbed.weight
    torque = observed.torque_fit
    found = {
        MODES[each.mode]: (each.moment / weight, each.sd / weight) for each in observed.hanging
    }
    y = torque.parameters[torque.index("com_y")]
    found["balance of torques"] = (abs(y.value), y.sd)
    return tuple(
        at_most(
            f"20-40 s, spin 105 deg/s: distance by {name} {1e3 * value:.2f} +/- {1e3 * sd:.2f} mm, "
            f"held {1e3 * held:.2f} mm; off, in sd",
            abs(value - held) / sd,
            CONTRADICT,
        )
        for name, (value, sd) in found.items()
    )


def open_row(free: Estimate) -> Row:
    """Return the row of the same part with nothing held."""
    infinite = all(np.isinf(free.parameters[free.index(name)].sd) for name in MOMENTS)
    ok = free.outcome.code is OutcomeCode.SCALE_OPEN and infinite and len(free.ratios) > 0
    wanted = "scale is open, moments without interval, ratios given"
    return said("20-40 s, nothing held: outcome", free.outcome.sentence, wanted, ok)


def measure(seeds: Sequence[int] = (), spread: Spread = in_turn) -> Result:
    """Identify the parts; nothing is random, so the seeds do not matter."""
    claim = (
        "A published OptiTrack recording (2.686 kg, 601 rows, free motion), scale fixed by CAD: "
        "touches are found without being told, and what remains fits, agrees and predicts."
    )
    if not RECORD.is_file():
        return Result("real_record", claim, (), (f"Not measured: {RECORD.name} is not at hand.",))
    jobs: list[Job] = [(WHOLE, HELD), (QUIET, HELD), (QUIET, ()), *((w, HELD) for w in WINDOWS)]
    whole, quiet, free, *parts = spread(identified, jobs)
    rows = (
        *finding_rows(), *touch_rows(whole), *whole_rows(whole),
        at_most("0-30 s alone: deg rms per axis predicted for 30-60 s", predicted(), AHEAD),
        *window_rows(parts), *quiet_rows(quiet), *measurement_rows(quiet), open_row(free),
    )  # fmt: skip
    return Result("real_record", claim, rows, ())
