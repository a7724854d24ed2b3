"""A calibration for terminal, report and testbed file, in mm, g and deg."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from equipoise.app.report.run_record import Output, RunRecord, origin
from equipoise.app.text.blocks import Blocks, Column, Section, Table, number, paragraphs, table
from equipoise.app.text.estimate_text import outcome_claim, parameter_table, residual_line
from equipoise.app.text.json_document import estimate_json
from equipoise.app.text.numbers import with_sd
from equipoise.model.estimate import COM, INERTIA, Estimate, Parameter
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.model.units import DEG, GRAM, MM

# A column, what its parameter is called, its unit in SI.
DRIVES = (
    (number("gain"), "gain_{}", 1.0),
    (number("first moment", "g mm / mm"), "product_{}", GRAM),
    (number("misalignment 1", "deg"), "across_{}_1", DEG),
    (number("misalignment 2", "deg"), "across_{}_2", DEG),
    (number("backlash", "mm"), "backlash_{}", MM),
    (number("stop sd", "mm"), "scatter_{}", MM),
)
RAILS = tuple((number(letter), "axis_{}_" + letter, 1.0) for letter in "xyz")
SENSORS = ("gyro_", "plumb_")
STAYS = (
    "Sensor alignment is not written to a testbed file, which has no keys for it. "
    "identify estimates the camera's inclination in each record, and the gyro's axes "
    "with --term gyro_scale --term gyro_cross. For balancing with that gyro, correct "
    "its axes in its own settings."
)


def said(parameter: Parameter, unit: float) -> str:
    """Return a number with its sd, that it was trusted, or that the moves did not show it."""
    if not parameter.observable:
        return "not shown"
    value, sd = with_sd(parameter.value / unit, parameter.sd / unit)
    if sd == "held":
        return f"{value} trusted" if parameter.sd == 0 else value
    return f"{value} +/- {sd}"


def drive_table(
    title: str, found: Estimate, names: Sequence[str], drives: Sequence[tuple[Column, str, float]]
) -> Table:
    """Return one line for each mass."""
    rows = [
        (name, *(said(found.parameters[found.index(key.format(name))], f) for _, key, f in drives))
        for name in names
    ]
    return table(title, (Column("mass"), *(column for column, _, _ in drives)), rows)


def tables_of(found: Estimate, names: Sequence[str]) -> Iterator[Table]:
    """Return the tables, of masses that moved, of sensors and of the body."""
    if names:
        yield drive_table("Drives, with sd", found, names, DRIVES)
        yield drive_table("Rails, body axes", found, names, RAILS)
    sensors = [p for p in found.parameters if p.name.startswith(SENSORS)]
    body = [p for p in found.parameters if p.name in (*COM, *INERTIA)]
    for title, group in (
        ("Gains over their mean", found.ratios),
        ("Gyro axes relative to the camera's body axes, and the camera's vertical", sensors),
        ("Centre of mass and inertia about P, masses at home", body),
    ):
        if group:
            yield parameter_table(title, group)


@dataclass(frozen=True, slots=True, eq=False)
class Calibrated:
    """A calibration, and what it was made from."""

    testbed: Testbed
    recording: Recording
    estimate: Estimate

    @property
    def moved(self) -> tuple[str, ...]:
        """Names of the masses that moved."""
        masses = self.testbed.masses
        return tuple(m.name for m in masses if self.estimate.has(f"gain_{m.name}"))


def output_of(done: Calibrated) -> Output:
    """Return all that is handed over."""
    return Output("calibrate", estimate_json(done.estimate), blocks(done), lambda: record_of(done))


def blocks(done: Calibrated) -> Blocks:
    """Return drives, rails, sensors, the body, and what it all rests on."""
    tables = tables_of(done.estimate, done.moved)
    return (*tables, *sentences_of(done), outcome_claim(done.estimate))


def sentences_of(done: Calibrated) -> Blocks:
    """Return what was not shown, and how well the model explains the rows."""
    found, moved = done.estimate, done.moved
    still = [m.name for m in done.testbed.masses if m.name not in moved]
    unmoved = f"Never moved, hence not calibrated: {', '.join(still)}." if still and moved else ""
    stays = (STAYS,) if any(p.name.startswith(SENSORS) for p in found.parameters) else ()
    reasons = (reason.sentence for reason in (*found.unobservable, *found.unexplained))
    return paragraphs(unmoved, *reasons, *stays, residual_line(found.residual))


def record_of(done: Calibrated) -> RunRecord:
    """Return the calibration as a report."""
    return RunRecord(
        title="Calibration of masses and sensors",
        requested={"recording": done.recording.source, "method": done.estimate.method},
        testbed=done.testbed,
        conclusion=(outcome_claim(done.estimate),),
        sections=(
            Section("Results", tuple(tables_of(done.estimate, done.moved))),
            Section("Assumptions and remarks", sentences_of(done)),
        ),
        origin=origin(sha256=done.recording.sha256),
    )


def remarks_of(done: Calibrated) -> dict[str, str]:
    """Return what is written behind each calibrated key of a mass."""
    found, remarks = done.estimate, dict[str, str]()
    for name in done.moved:
        one, two = (found.parameters[found.index(f"across_{name}_{k}")] for k in (1, 2))
        texts = {
            "gain": said(found.parameters[found.index(f"gain_{name}")], 1.0),
            "axis": f"{said(one, DEG)} and {said(two, DEG)} deg from the stated value",
            "backlash_mm": said(found.parameters[found.index(f"backlash_{name}")], MM),
        }
        remarks |= {f"{key} {name}": f"calibrated: {text}" for key, text in texts.items()}
    return remarks
