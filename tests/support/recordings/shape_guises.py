"""Guises of a text: separators, points, comments, headers, encodings."""

from pathlib import Path

from tests.support.recordings.recorded_motion import Motion
from tests.support.recordings.variant import Reads, Refused, answered
from tests.support.recordings.written_tables import (
    OURS,
    ROS,
    columns,
    lines,
    ours,
    saved,
    text,
)

PREAMBLE = ("Test stand 3", "Operator: N. N.", "Date: 2024-05-03, 14:11", "Firmware 2.1, rev. 7")


@answered(Reads())
def semicolons_and_decimal_commas(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion), ";").replace(".", ","))


@answered(Reads())
def tabs_and_decimal_commas(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion), "\t").replace(".", ","), "run.txt")


@answered(Reads())
def aligned_by_spaces(motion: Motion, folder: Path) -> Path:
    rows = [row.split(",") for row in lines(columns(motion))]
    return saved(folder, "\n".join("".join(f"{c:>14}" for c in row) for row in rows), "run.dat")


@answered(Reads())
def spaces_around_commas(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion), " , "))


@answered(Reads())
def bars(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion), " | "), "run.txt")


@answered(Reads())
def comments_above_the_header(motion: Motion, folder: Path) -> Path:
    head = "".join(f"# {line}\n" for line in PREAMBLE)
    return saved(folder, head + text(columns(motion)))


@answered(Reads())
def settings_above_the_header(motion: Motion, folder: Path) -> Path:
    return saved(folder, "\n".join([*PREAMBLE, "", *lines(columns(motion))]))


@answered(Reads())
def a_header_that_is_a_comment(motion: Motion, folder: Path) -> Path:
    return saved(folder, "# " + text(columns(motion)))


@answered(Reads(renamed=True, inspected="columns 1, 2, 3", said="There is no header"))
def no_header(motion: Motion, folder: Path) -> Path:
    return saved(folder, "\n".join(lines(columns(motion))[1:]))


@answered(Reads())
def blank_lines_between(motion: Motion, folder: Path) -> Path:
    return saved(folder, "\n\n".join(lines(columns(motion))))


@answered(Reads())
def quotes_around_each_cell(motion: Motion, folder: Path) -> Path:
    rows = [row.split(",") for row in lines(columns(motion))]
    return saved(folder, "\n".join(",".join(f'"{cell}"' for cell in row) for row in rows))


@answered(Reads("inspect"))
def a_mark_of_utf_8(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(ours(motion)).encode("utf-8-sig"))


@answered(Reads("inspect"))
def utf_16_of_notepad(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(ours(motion, ROS)).replace("\n", "\r\n").encode("utf-16"))


@answered(Reads())
def utf_16_without_a_mark(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion)).encode("utf-16-le"))


@answered(Reads())
def latin_1_with_a_degree_sign(motion: Motion, folder: Path) -> Path:
    head, *rows = lines(columns(motion))
    return saved(
        folder, "\n".join([f"{head},T [°C]", *(f"{r},21.5" for r in rows)]).encode("latin-1")
    )


@answered(Reads())
def line_ends_of_an_old_mac(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion)).replace("\n", "\r"))


@answered(Reads(said="1 row"))
def the_header_twice(motion: Motion, folder: Path) -> Path:
    """A logger that was restarted while the board's clock went on."""
    rows = lines(columns(motion))
    return saved(folder, "\n".join([*rows[:1200], rows[0], *rows[1200:]]))


@answered(Reads())
def a_comma_after_each_row(motion: Motion, folder: Path) -> Path:
    return saved(folder, ",\n".join([*lines(columns(motion)), ""]))


@answered(Reads())
def columns_that_mean_nothing(motion: Motion, folder: Path) -> Path:
    """A state in words, a counter, a version, a battery."""
    head, *rows = lines(columns(motion))
    body = [f"{k},RUN,{row},v1.2,{11.9 - k * 1e-5:.3f}" for k, row in enumerate(rows)]
    return saved(folder, "\n".join([f"n,state,{head},version,battery", *body]))


@answered(Reads())
def numbers_with_exponents_and_signs(motion: Motion, folder: Path) -> Path:
    table = columns(motion)
    rows = zip(*(column.tolist() for column in table.values()), strict=True)
    body = [" ".join(f"{value:+.9E}" for value in row) for row in rows]
    return saved(folder, "\n".join([" ".join(table), *body]), "run.txt")


def of_fortran(motion: Motion, letter: str, separator: str) -> str:
    """Return a table whose numbers have the exponents of double precision."""
    head, *rows = lines(columns(motion))
    cells = [[f"{float(c):.12e}".replace("e", letter) for c in row.split(",")] for row in rows]
    return "\n".join(map(separator.join, [head.split(","), *cells]))


@answered(Reads())
def exponents_of_fortran(motion: Motion, folder: Path) -> Path:
    return saved(folder, of_fortran(motion, "D", "  "), "run.dat")


@answered(Reads())
def small_exponents_of_fortran(motion: Motion, folder: Path) -> Path:
    return saved(folder, of_fortran(motion, "d", ","))


def with_names(motion: Motion, sign: str, between: str) -> list[str]:
    """Return rows that say before each number what it is."""
    head, *rows = lines(columns(motion))
    names = head.split(",")
    return [
        between.join(f"{n}{sign}{c}" for n, c in zip(names, row.split(","), strict=True))
        for row in rows
    ]


@answered(Reads(said="Each number has its name before it"))
def names_before_each_number(motion: Motion, folder: Path) -> Path:
    """As a serial plotter takes it."""
    return saved(folder, "\n".join(with_names(motion, ":", " ")), "run.txt")


@answered(Reads(lost=(1200,), said="1 row with fewer cells than the header, line 1201"))
def names_with_equals_signs(motion: Motion, folder: Path) -> Path:
    """With a word of the program between."""
    rows = with_names(motion, "=", ", ")
    rows[1200] = "low battery"
    return saved(folder, "\n".join(rows))


@answered(Reads(said="Each line starts with the terminal's clock"))
def names_with_a_space_behind_a_terminals_clock(motion: Motion, folder: Path) -> Path:
    rows = with_names(motion, ": ", "\t")
    return saved(folder, "\n".join(f"14:03:21.000 -> {row}" for row in rows), "run.txt")


@answered(Refused("two columns 'time_s'", "wanted one"))
def a_name_twice(motion: Motion, folder: Path) -> Path:
    head, *rows = lines(ours(motion))
    twice = [f"{head},{OURS[0]}", *(f"{row},{k}" for k, row in enumerate(rows))]
    return saved(folder, "\n".join(twice))
