"""The readings of an unknown table in words: what was found, by what, and what else it may be."""

from collections.abc import Sequence
from math import degrees, inf, sqrt

from equipoise.app.text.blocks import Block, Blocks, Claim, Heading, Item, Items, items
from equipoise.assessment.hypotheses.ranking import Ranked, TableReading


def import_blocks(
    ranked: Ranked, chosen: TableReading | None, notes: Sequence[str], by_header: bool = False
) -> Blocks:
    """Return the reading that is taken with its evidence, and the others.

    ``by_header``: the file says itself what it holds, and nothing was compared.
    """
    blocks: list[Block] = []
    if by_header:
        return (Claim("The file says itself what it holds.", "good"), *items(notes, "quiet"))
    if chosen is None:
        blocks.append(Claim(_undecided(ranked), "caution"))
        for number, reading in enumerate(ranked.alike, 1):
            blocks += [Heading(f"Reading {number}"), *items(reading_lines(reading), "plain")]
    else:
        blocks.append(Claim("The table is read as follows.", "good"))
        blocks += items(reading_lines(chosen), "plain")
        blocks += items(evidence_lines(chosen), "good")
        blocks += items([assumed_line(chosen)], "quiet")
        if others := [r for r in ranked.alike if r is not chosen]:
            blocks.append(Heading("As good by the numbers, less usual"))
            blocks.append(Items(tuple(Item(_differs(r, chosen), "quiet") for r in others)))
    if ranked.runner_up is not None:
        first = chosen or ranked.alike[0]
        other = ranked.runner_up
        text = f"The next reading{_worse(other, first)}: {_differs(other, first)}"
        blocks += items([text], "quiet")
    return (*blocks, *items(notes, "quiet"))


def _undecided(ranked: Ranked) -> str:
    if not ranked.alike:
        return (
            "No clock with four columns of a quaternion, or three named angles, was found. "
            "--write-map writes a column map to start from, for you to fill in."
        )
    count = len(ranked.alike)
    if count == 1:
        return (
            "The gyro may as well give rates about laboratory axes, for a quaternion that turns "
            "the other way: turn such rates into body axes first, else take --choose 1."
        )
    return f"The numbers leave {count} readings alike: choose one, --choose 1 to {count}."


def reading_lines(reading: TableReading) -> list[str]:
    """Return what each part of a table is in a reading."""
    clock, attitude, gyro = reading.clock, reading.attitude, reading.gyro
    lines = [f"clock: '{clock.column}' in {clock.unit}, a row each {clock.step:.3g} s."]
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
    lines.append(_gyro_line(reading) if gyro else "gyro: none that agrees with the attitude.")
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
    unit = gyro.unit or f"{gyro.factor:.4g} rad/s a count, as measured"
    handed = "" if reading.handed else "; as the columns stand, they are left-handed"
    return f"gyro: x, y, z = {named}; {unit}{handed}."


def evidence_lines(reading: TableReading) -> list[str]:
    """Return what speaks for a reading."""
    lines: list[str] = []
    if not reading.attitude.sequence:
        lines.append(f"unit length: the four columns keep it within {reading.norm_sd:.2g} (sd).")
    if reading.gyro is not None:
        share = 1 - reading.gyro.misfit
        lines.append(
            f"gyro: {share:.1%} of its variation and the attitude's over {reading.gyro.spans} "
            "spans is the same turning."
        )
    tilt = degrees(reading.frame.tilt)
    return [*lines, f"gravity: the upright axis is {tilt:.2g} deg from the vertical (median)."]


def assumed_line(reading: TableReading) -> str:
    """Return what no number shows: a mirrored platform moves alike where down is up."""
    lab, body = reading.frame.lab_up, reading.frame.body_up
    other = (_opposite(lab), _opposite(body))
    return (
        f"taken for granted: {lab} of the laboratory points up. In tables of flight (NED) it "
        f'points down: there a map (--write-map) has lab_up = "{other[0]}", and a body whose '
        f'upright axis is "{other[1]}".'
    )


def _opposite(axis: str) -> str:
    return axis[1:] if axis.startswith("-") else f"-{axis}"


def _worse(reading: TableReading, best: TableReading) -> str:
    if reading.gyro is None or best.gyro is None:
        return ", without a gyro"
    times = sqrt(reading.gyro.misfit / best.gyro.misfit) if best.gyro.misfit > 0 else inf
    return f" leaves {times:.3g} times as much of the turning"


def _differs(reading: TableReading, other: TableReading) -> str:
    """Return the lines of a reading that are not those of another."""
    lines = [a for a in reading_lines(reading) if a not in reading_lines(other)]
    return " ".join(lines) or "the same columns."
