"""The readings of an unknown table in words: what was found, by what, and what else it may be."""

from dataclasses import dataclass
from math import degrees, inf, pi, sqrt

from equipoise.app.text.blocks import Block, Blocks, Claim, Heading, items, sentences
from equipoise.app.text.json_lists import IMPORT
from equipoise.app.text.json_shape import View
from equipoise.assessment.hypotheses.gyro_zero import GyroZero
from equipoise.assessment.hypotheses.inertial_unit import InertialUnit, Triad
from equipoise.assessment.hypotheses.ranking import Ranked, TableReading
from equipoise.assessment.hypotheses.verticals import Vertical
from equipoise.io.recording.frame_check import LEANS
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

PLACE = (
    "wanted: [sensor.accelerometer] with its position, and [sensor.gyro], in the "
    "testbed file; the table does not tell which axes of the platform these are."
)
NAMED = 8  # columns ignored that are named (chosen: two lines of a terminal)


@dataclass(frozen=True, slots=True)
class TableRead:
    """What `import` found of a table."""

    source: str
    ranked: Ranked
    taken: TableReading | InertialUnit | None  # None: the file says it itself, or it is open
    by_header: bool = False  # the file says itself what it holds, and nothing was compared
    notes: tuple[str, ...] = ()
    left_aside: tuple[str, ...] = ()  # columns that the reading does not take

    @property
    def outcome(self) -> str:
        """Return how it is read: by its header, by its numbers, or not, as it is open."""
        by_numbers = "open" if self.taken is None else "by numbers"
        return "by header" if self.by_header else by_numbers


def import_blocks(found: TableRead) -> Blocks:
    """Return the reading that is taken with its evidence, the others, and what is ignored."""
    notes = items([*_aside_lines(found.left_aside), *found.notes], "quiet")
    if found.by_header:
        return (Claim("The file itself states what it holds.", "good"), *notes)
    if isinstance(found.taken, InertialUnit):
        return (*_unit_blocks(found.taken), *notes)
    shown = _open_blocks(found.ranked) if found.taken is None else _taken_blocks(found, found.taken)
    return (*shown, *_next_blocks(found.ranked, found.taken), *notes)


def import_json(found: TableRead) -> View:
    """Return the same as a document, with every sentence that the terminal shows."""
    return IMPORT.write({
        "source": found.source,
        "outcome": found.outcome,
        "taken": found.taken if isinstance(found.taken, TableReading) else None,
        "inertial_unit": found.taken if isinstance(found.taken, InertialUnit) else None,
        "alike": found.ranked.alike,
        "next": found.ranked.runner_up,
        "left_aside": found.left_aside,
        "sentences": list(sentences(import_blocks(found))),
    })  # fmt: skip


def _open_blocks(ranked: Ranked) -> Blocks:
    blocks: list[Block] = [Claim(_undecided(ranked), "caution")]
    for number, reading in enumerate(ranked.alike, 1):
        blocks += [Heading(f"Reading {number}"), *items(reading_lines(reading), "plain")]
    return tuple(blocks)


def _unit_blocks(unit: InertialUnit) -> Blocks:
    """Return a gyro and an accelerometer, and how well they agree."""
    clock, load, gyro = unit.clock, unit.accelerometer, unit.gyro
    lines = [
        f"clock: '{clock.column}' in {clock.unit}, one row every {clock.step:.4g} s.",
        f"accelerometer: x, y, z = {_named(load, 'm/s2')}.",
        f"gyro: x, y, z = {_named(gyro, 'rad/s')}.",
        f"up: {unit.up} of the accelerometer.",
    ]
    evidence = (
        f"gravity: {100 * (1 - unit.misfit):.1f}% of its rotation in the body over "
        f"{unit.spans} spans agrees with the gyro."
    )
    return (
        Claim("No attitude, but an inertial unit; the table is read as follows.", "good"),
        *items(lines, "plain"),
        *items([evidence], "good"),
        *items([PLACE], "quiet"),
    )


def _named(triad: Triad, si: str) -> str:
    pairs = zip(triad.signs, triad.columns, strict=True)
    columns = ", ".join(f"{'-' if sign < 0 else ''}'{name}'" for sign, name in pairs)
    return f"{columns}; {triad.unit or f'{triad.factor:.4g} {si} per count'}"


def _taken_blocks(found: TableRead, taken: TableReading) -> Blocks:
    blocks: list[Block] = [Claim("The table is read as follows.", "good")]
    blocks += items(reading_lines(taken), "plain")
    blocks += items(evidence_lines(taken), "good")
    blocks += _gravity_blocks(taken)
    blocks += items([assumed_line(taken)], "quiet")
    if others := [each for each in found.ranked.alike if each is not taken]:
        blocks.append(Heading("Equally supported, less common"))
        blocks += items((_differs(each, taken) for each in others), "quiet")
    return tuple(blocks)


def _next_blocks(ranked: Ranked, taken: TableReading | None) -> Blocks:
    other = ranked.runner_up
    if other is None:
        return ()
    first = taken or ranked.alike[0]
    return items([f"The next reading{_worse(other, first)}: {_differs(other, first)}"], "quiet")


def _aside_lines(columns: tuple[str, ...]) -> list[str]:
    """Return which columns are not read, some of many by name."""
    if not columns:
        return []
    named = ", ".join(f"'{name}'" for name in columns[:NAMED])
    more = f" and {len(columns) - NAMED} more" if len(columns) > NAMED else ""
    count = "1 column was" if len(columns) == 1 else f"{len(columns)} columns were"
    return [f"ignored: {count} not read, {named}{more}."]


def _undecided(ranked: Ranked) -> str:
    if not ranked.alike:
        return (
            "No clock with four columns of a quaternion, or three named angles, was "
            "found. --write-map writes a column map for you to complete."
        )
    count = len(ranked.alike)
    if count == 1:
        return (
            "The gyro may also give rates about laboratory axes, for the inverse "
            "quaternion: then convert the rates to body axes first; otherwise take "
            "--choose 1."
        )
    return (
        f"The numbers support {count} interpretations equally: choose one, --choose 1 to {count}."
    )


def reading_lines(reading: TableReading) -> list[str]:
    """Return what each part of a table is in a reading."""
    clock, attitude, gyro = reading.clock, reading.attitude, reading.gyro
    lines = [f"clock: '{clock.column}' in {clock.unit}, one row every {clock.step:.3g} s."]
    if attitude.sequence:
        unit = "deg" if attitude.degrees else "rad"
        named = ", ".join(
            f"{'-' if sign < 0 else ''}'{name}'"
            for name, sign in zip(attitude.columns, attitude.signs, strict=True)
        )
        lines.append(f"attitude: angles {named} in {unit} about x, y, z; {attitude.sequence}.")
    else:
        named = ", ".join(f"'{name}'" for name in attitude.ordered)
        way = "laboratory to body" if attitude.inverse else "body to laboratory"
        lines.append(f"attitude: quaternion w, x, y, z = {named}; it turns {way}.")
    lines.append(_gyro_line(reading) if gyro else "gyro: no columns that agree with the attitude.")
    frame = reading.frame
    return [
        *lines,
        f"up: {frame.lab_up} of the laboratory, {frame.body_up} of the attitude's body.",
    ]


def _gyro_line(reading: TableReading) -> str:
    gyro = reading.gyro
    if gyro is None:
        return ""
    named = ", ".join(
        f"{'-' if sign < 0 else ''}'{name}'"
        for name, sign in zip(gyro.columns, gyro.signs, strict=True)
    )
    unit = gyro.unit or f"{gyro.factor:.4g} rad/s per count, as measured"
    handed = "" if reading.handed else "; the columns in this order are left-handed"
    return f"gyro: x, y, z = {named}; {unit}{handed}."


def evidence_lines(reading: TableReading) -> list[str]:
    """Return what speaks for a reading."""
    lines: list[str] = []
    if not reading.attitude.sequence:
        lines.append(f"unit length: the four columns keep it within {reading.norm_sd:.2g} (sd).")
    if reading.gyro is not None:
        share = 1 - reading.gyro.misfit
        lines.append(
            f"gyro: {share:.1%} of its variation agrees with the attitude's rotation "
            f"over {reading.gyro.spans} spans."
        )
    if reading.zero is not None and reading.zero.is_clear:
        lines.append(_zero_line(reading.zero))
    if reading.vertical is not None and not reading.vertical.is_off:
        lines.append(_vertical_line(reading, reading.vertical))
    return lines


def _gravity_blocks(reading: TableReading) -> Blocks:
    tilt = reading.frame.tilt
    line = f"gravity: the upright axis is {degrees(tilt):.2g} deg from the vertical (median)."
    return items([line], "good" if tilt <= LEANS else "caution")


def _vertical_line(reading: TableReading, vertical: Vertical) -> str:
    named = ", ".join(f"'{name}'" for name in vertical.columns)
    return (
        f"vertical: by the accelerometer {named} it is {degrees(vertical.tilt):.2g} deg from "
        f"{reading.frame.lab_up} of the laboratory (scatter {degrees(vertical.scatter):.2g} deg)."
    )


def unchecked(
    taken: TableReading | InertialUnit | None, recording: Recording, testbed: Testbed | None
) -> tuple[str, ...]:
    """Say how much the laboratory may be tilted without anyone noticing."""
    measured = isinstance(taken, TableReading) and taken.vertical is not None
    if recording.attitude is None or measured:
        return ()
    if testbed is None or testbed.tilt_limit >= pi:
        return (
            (
                "not checked: whether the laboratory axis taken as up is vertical. An "
                "accelerometer in the table would show it; --testbed checks it roughly, "
                "by the tilt limit."
            ),
        )
    stop = degrees(max(testbed.tilt_limit, LEANS))
    return (
        (
            f"not checked: a laboratory tilt below {stop:.0f} deg: only the platform's "
            "tilt limit bounds it here; an accelerometer would measure it."
        ),
    )


def _zero_line(zero: GyroZero) -> str:
    rates = ", ".join(f"{degrees(rate):.3g}" for rate in zero.rate)
    sd = ", ".join(f"{degrees(sd):.1g}" for sd in zero.sd)
    return (
        f"gyro bias: at rest it reports {rates} deg/s about x, y, z of the attitude "
        f"(sd {sd}); `identify` estimates it."
    )


def assumed_line(reading: TableReading) -> str:
    """Return what no number shows: a mirrored platform moves alike where down is up."""
    lab, body = reading.frame.lab_up, reading.frame.body_up
    other = (_opposite(lab), _opposite(body))
    return (
        f"assumed: {lab} of the laboratory points up. In flight data (NED) it points "
        f'down: then set lab_up = "{other[0]}" in a map (--write-map), with a body '
        f'whose upright axis is "{other[1]}".'
    )


def _opposite(axis: str) -> str:
    return axis[1:] if axis.startswith("-") else f"-{axis}"


def _worse(reading: TableReading, best: TableReading) -> str:
    if reading.gyro is None or best.gyro is None:
        return ", without a gyro"
    times = sqrt(reading.gyro.misfit / best.gyro.misfit) if best.gyro.misfit > 0 else inf
    return f" leaves {times:.3g} times the residual rotation"


def _differs(reading: TableReading, other: TableReading) -> str:
    """Return the lines of a reading that are not those of another."""
    lines = [a for a in reading_lines(reading) if a not in reading_lines(other)]
    return " ".join(lines) or "the same columns."
