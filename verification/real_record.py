"""A real recording: free motion, the scale fixed by CAD, and a full minute that does not fit.

The recording does not belong to the project; without it nothing is measured.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from equipoise.io.recording_file import read_recording
from equipoise.io.testbed_file import read_testbed
from equipoise.model.estimate import Estimate
from equipoise.model.recording import window
from equipoise.procedure.identify import IdentifyOptions, identify
from verification.result import Result, Row, Spread, at_most, in_turn, triple

ROOT = Path(__file__).parents[1]
RECORD = ROOT.parent / "shared" / "data" / "optitrack_tumbling.csv"
TESTBED = ROOT / "verification" / "optitrack.toml"
QUIET, WHOLE = (20.0, 40.0), (0.0, 60.0)  # s
HELD = ("com_y",)
RMS = 0.21  # deg per axis
NEAR_CAD = 0.08
MOMENTS = ("inertia_P_xx", "inertia_P_yy", "inertia_P_zz")
Job = tuple[tuple[float, float], tuple[str, ...]]


def identified(job: Job) -> Estimate:
    """Identify a part of the record with values held at CAD."""
    (start, end), hold = job
    recording, testbed = window(read_recording(RECORD), start, end), read_testbed(TESTBED)
    *_, last = identify(recording, testbed, IdentifyOptions("trajectory", hold=hold))
    return last.estimate


def said(quantity: str, sentence: str, wanted: str, ok: bool) -> Row:
    """Return a row whose finding is a sentence."""
    return Row(quantity, sentence, wanted, ok)


def quiet_rows(quiet: Estimate) -> tuple[Row, ...]:
    """Return the rows of the part that the model explains."""
    cad = np.diag(read_testbed(TESTBED).body.inertia_P)
    moments = quiet.values(MOMENTS)
    off = float(np.abs(moments / cad - 1).max())
    residual, shown = quiet.residual, triple(1e3 * moments)
    there = residual.held_out_rms is not None and bool(np.isfinite(residual.held_out_rms))
    ahead = f"{np.degrees(residual.held_out_rms):.3g} deg rms" if there else "none"
    start, end = residual.held_out_span or (np.nan, np.nan)
    return (
        at_most("20-40 s, com_y held: deg rms per axis",
                float(np.degrees(residual.attitude_rms)), RMS),
        at_most(f"the same: J {shown} g m2 about P, from CAD {triple(1e3 * cad)}; worst",
                off, NEAR_CAD, ".1%"),
        said(f"the same: {start:g}-{end:g} s predicted from what comes before", ahead, "present",
             there),
        said("the same: outcome", quiet.outcome.sentence, "usable", quiet.outcome.usable),
    )  # fmt: skip


def open_row(free: Estimate) -> Row:
    """Return the row of the same part with nothing held."""
    infinite = all(np.isinf(free.parameters[free.index(name)].sd) for name in MOMENTS)
    ok = "scale is open" in free.outcome.sentence and infinite and len(free.ratios) > 0
    wanted = "scale is open, moments without interval, ratios given"
    return said("20-40 s, nothing held: outcome", free.outcome.sentence, wanted, ok)


def whole_row(whole: Estimate) -> Row:
    """Return the row of the whole minute."""
    ok = not whole.outcome.usable and "does not explain" in whole.outcome.sentence
    return said("0-60 s, com_y held: outcome", whole.outcome.sentence,
                "not usable: does not explain", ok)  # fmt: skip


def measure(seeds: Sequence[int] = (), spread: Spread = in_turn) -> Result:
    """Identify the parts; nothing is random, so the seeds do not matter."""
    claim = (
        "A published OptiTrack recording (2.686 kg, 601 rows, free motion): the quiet part fits "
        "and agrees with CAD, the open scale and the misfit of the whole are said."
    )
    if not RECORD.is_file():
        return Result("real_record", claim, (), (f"Not measured: {RECORD.name} is not at hand.",))
    jobs: list[Job] = [(QUIET, HELD), (QUIET, ()), (WHOLE, HELD)]
    quiet, free, whole = spread(identified, jobs)
    ratios = ", ".join(f"{p.name} {p.value:.4g} +/- {p.sd:.2g}" for p in free.ratios[3:5])
    return Result(
        "real_record", claim, (*quiet_rows(quiet), open_row(free), whole_row(whole)),
        (f"Ratios with nothing held: {ratios}.",),
    )  # fmt: skip
