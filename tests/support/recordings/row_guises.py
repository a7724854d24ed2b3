"""Guises of rows that are bad: cut, garbled, mixed, up to the share that is left out and beyond."""

from pathlib import Path

import numpy as np

from tests.support.recordings.recorded_motion import Motion
from tests.support.recordings.variant import Reads, Refused, answered
from tests.support.recordings.written_tables import ROS, changed, columns, lines, ours, saved, text

FEW, MANY = tuple(range(20, 2400, 25)), tuple(range(20, 2400, 16))  # 4 % of the rows; 6 %
SOME = tuple(range(100, 2400, 100))
LOST = tuple(range(600, 800))  # 5 s: more than may be faulty
NOTHING = "," * 7


def spoilt(rows: list[str], k: int) -> str:
    """Return a row as one of four kinds of bad row."""
    clock, *cells = rows[k + 1].split(",")
    return (
        ",".join([clock, *(["NaN"] * len(cells))]),
        ",".join([clock, *cells[:3]]),
        ",".join(["", *cells]),
        ",".join([clock, *cells, clock, *cells]),
    )[k // 5 % 4]


def mixed(motion: Motion, folder: Path, which: tuple[int, ...]) -> Path:
    rows = lines(ours(motion, ROS))
    return saved(folder, changed(rows, {k: spoilt(rows, k) for k in which}))


@answered(Reads("inspect", lost=FEW, said="without a time"))
def four_percent_of_four_kinds(motion: Motion, folder: Path) -> Path:
    return mixed(motion, folder, FEW)


@answered(Refused(r"\(149 of 2401 rows are faulty\)", r"--bad-rows 0\.07"))
def six_percent_of_four_kinds(motion: Motion, folder: Path) -> Path:
    return mixed(motion, folder, MANY)


@answered(Reads("inspect", lost=MANY, options=("--bad-rows", "0.07")))
def six_percent_that_may_be_left_out(motion: Motion, folder: Path) -> Path:
    return mixed(motion, folder, MANY)


@answered(Reads("inspect", lost=LOST, rate_lost=()))
def a_camera_that_lost_its_target(motion: Motion, folder: Path) -> Path:
    q = motion.q.copy()
    q[list(LOST)] = np.nan
    values = ours(Motion(motion.t, q, motion.w, motion.truth), ROS)
    return saved(folder, text(values))


@answered(Reads(lost=SOME, rate_lost=(), said="not unit length"))
def a_camera_that_writes_zeros(motion: Motion, folder: Path) -> Path:
    q = motion.q.copy()
    q[list(SOME)] = 0.0
    return saved(folder, text(columns(motion, q=q)))


@answered(Refused("line 2.*NaN.*2401 of 2401 rows", "wanted a finite number"))
def a_camera_without_a_row(motion: Motion, folder: Path) -> Path:
    rows = lines(ours(motion, ROS))
    return saved(
        folder, "\n".join([rows[0], *(f"{r.split(',')[0]}{',NaN' * 7}" for r in rows[1:])])
    )


@answered(Reads(lost=SOME, said="23 rows without a time"))
def words_of_the_logger_between_rows(motion: Motion, folder: Path) -> Path:
    rows = lines(columns(motion))
    return saved(folder, changed(rows, dict.fromkeys(SOME, "I2C error, resetting,,,,,,")))


@answered(Reads(lost=(2400,), said="The last row .* is cut short"))
def power_lost_in_the_last_row(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion))[:-40])


@answered(Reads(lost=(900, 901)))
def zero_bytes_where_power_was_lost(motion: Motion, folder: Path) -> Path:
    rows = lines(columns(motion))
    return saved(folder, changed(rows, {900: rows[901][:20] + "\0" * 60, 901: "\0" * 40}))


@answered(Reads("inspect", lost=SOME, said="23 rows"))
def not_a_number_of_windows(motion: Motion, folder: Path) -> Path:
    rows = lines(ours(motion, ROS))
    bad = {k: rows[k + 1].split(",")[0] + ",-1.#IND" * 7 for k in SOME}
    return saved(folder, changed(rows, bad))


@answered(Reads(lost=SOME))
def rows_of_commas(motion: Motion, folder: Path) -> Path:
    rows = lines(columns(motion))
    return saved(folder, changed(rows, dict.fromkeys(SOME, NOTHING)))


@answered(Reads(lost=SOME, rate_lost=(), said="no number"))
def words_in_one_cell(motion: Motion, folder: Path) -> Path:
    rows = lines(columns(motion))
    cells = {k: rows[k + 1].split(",") for k in SOME}
    bad = {k: ",".join([c[0], c[1], "ERR", *c[3:]]) for k, c in cells.items()}
    return saved(folder, changed(rows, bad))


@answered(Reads("inspect", lost=SOME, time=5e-7, said="23 rows without a time"))
def one_of_two_columns_of_the_time_blank(motion: Motion, folder: Path) -> Path:
    ms = np.round(1e3 * motion.t)
    ns = ms % 1000 * 1e6
    ns[list(SOME)] = np.nan
    stamp = {"/imu/header/stamp/sec": ms // 1000, "/imu/header/stamp/nanosec": ns}
    rest = {name: column for name, column in ours(motion, ROS).items() if name != "__time"}
    return saved(folder, text(stamp | rest))


def marked(motion: Motion, which: tuple[int, ...], sensors: str, mark: float) -> Motion:
    """Return a motion in which a number stands for no reading: of attitude, of gyro's y."""
    q, w = motion.q.copy(), motion.w.copy()
    if "q" in sensors:
        q[list(which)] = mark
    if "w" in sensors:
        w[list(which), 1] = mark
    return Motion(motion.t, q, w, motion.truth)


@answered(Reads(lost=SOME, rate_lost=(), said="23 rows with a number that stands for no reading"))
def a_camera_that_writes_minus_999(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(marked(motion, SOME, "q", -999.0))))


@answered(Reads(rate_lost=SOME, said="23 rows with a number that stands for no reading"))
def a_gyro_that_writes_minus_9999(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(marked(motion, SOME, "w", -9999.0))))


@answered(Reads("inspect", rate_lost=SOME, said="23 rows with a number that stands for no reading"))
def a_gyro_that_writes_1e30(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(ours(marked(motion, SOME, "w", 1e30), ROS)))


@answered(Refused(r"-999, a marker of missing data \(149 of 2401", r"--bad-rows 0\.07"))
def six_percent_of_minus_999(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(ours(marked(motion, MANY, "qw", -999.0), ROS)))
