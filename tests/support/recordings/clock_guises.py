"""Guises of the clock: counters that wrap, dates, texts, stamps that are wrong."""

from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np

from tests.support.recordings.recorded_motion import Motion
from tests.support.recordings.variant import Reads, Refused, answered
from tests.support.recordings.written_tables import (
    ROS,
    changed,
    columns,
    lines,
    named,
    ours,
    saved,
    text,
)

START = 1_714_745_500  # s since 1970: 2024-05-03
DOUBLE = 5e-7  # s: what is left of a date's digits in a double
TICKED = 2e-5  # s: of the year 2024 in seconds since the year 1
COARSE = 6e-3  # s: stamps to the hundredth
TWICE = tuple(range(99, 2400, 50))


def since_1970(motion: Motion, folder: Path, clock: str, decimals: int) -> Path:
    """Write dates in digits: a double would lose some. None of decimals: seconds with six."""
    stamps = [round(1e3 * t) for t in motion.t.tolist()]
    point, zeros = ("", decimals - 3) if decimals else (".", 3)
    dates = [f"{START + k // 1000}{point}{k % 1000:03d}{'0' * zeros}" for k in stamps]
    return stamped(motion, folder, clock, dates)


def stamped(motion: Motion, folder: Path, clock: str, stamps: list[str]) -> Path:
    """Write stamps that are texts."""
    head, *rows = lines(columns(motion, clock))
    body = [f"{s},{row.split(',', 1)[1]}" for s, row in zip(stamps, rows, strict=True)]
    return saved(folder, "\n".join([head, *body]))


def dates(motion: Motion) -> list[datetime]:
    first = datetime.fromtimestamp(START, UTC)
    return [first + timedelta(milliseconds=round(1e3 * t)) for t in motion.t.tolist()]


def clocks(motion: Motion, start_s: int) -> list[str]:
    """Return a clock of the day, to the millisecond."""
    whole = [start_s * 1000 + round(1e3 * t) for t in motion.t.tolist()]
    parts = [(k // 3_600_000 % 24, k // 60_000 % 60, k // 1000 % 60, k % 1000) for k in whole]
    return [f"{h:02d}:{m:02d}:{s:02d}.{ms:03d}" for h, m, s, ms in parts]


@answered(Reads(said="The clock restarted after 65.536 s"))
def counter_of_16_bits(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion, t=(1e3 * motion.t + 40_000) % 2**16)))


@answered(Reads(said="The clock restarted after 4294967"))
def milliseconds_of_32_bits(motion: Motion, folder: Path) -> Path:
    counted = (1e3 * motion.t + 2.0**32 - 20_000) % 2.0**32
    return saved(folder, text(columns(motion, "millis", counted)))


@answered(Reads("inspect", said="The clock restarted after 604800 s"))
def week_of_satellite_navigation(motion: Motion, folder: Path) -> Path:
    late = named(ROS, np.column_stack([(604_770 + motion.t) % 604_800, motion.q, motion.w]))
    return saved(folder, text(late))


@answered(Reads(said="The clock restarted after 86400 s"))
def midnight(motion: Motion, folder: Path) -> Path:
    return stamped(motion, folder, "time", clocks(motion, 86_370))


@answered(Reads(time=DOUBLE, said="The clock starts at 1714745500.000 s"))
def date_in_s(motion: Motion, folder: Path) -> Path:
    return since_1970(motion, folder, "timestamp", 0)


@answered(Reads(time=DOUBLE))
def date_in_ms(motion: Motion, folder: Path) -> Path:
    return since_1970(motion, folder, "timestamp", 3)


@answered(Reads(time=DOUBLE))
def date_in_us(motion: Motion, folder: Path) -> Path:
    return since_1970(motion, folder, "stamp", 6)


@answered(Reads(time=DOUBLE))
def date_in_ns(motion: Motion, folder: Path) -> Path:
    return since_1970(motion, folder, "c0", 9)


@answered(Reads(said="clock starts at 2024-05-03.14:11:40"))
def iso_dates(motion: Motion, folder: Path) -> Path:
    stamps = [date.isoformat(timespec="milliseconds") for date in dates(motion)]
    return stamped(motion, folder, "timestamp", stamps)


@answered(Reads())
def dates_of_python_logging(motion: Motion, folder: Path) -> Path:
    """A comma before the milliseconds, in quotes."""
    stamps = [f'"{d:%Y-%m-%d %H:%M:%S},{d.microsecond // 1000:03d}"' for d in dates(motion)]
    return stamped(motion, folder, "asctime", stamps)


@answered(Reads(lost=TWICE, said="47 rows with a duplicate time stamp"))
def some_stamps_twice(motion: Motion, folder: Path) -> Path:
    t = 1e3 * motion.t
    t[list(TWICE)] = t[[k - 1 for k in TWICE]]
    return saved(folder, text(columns(motion, t=t)))


@answered(Refused(r"again \(2340 of 2401 rows are faulty\)", "a time of its own for each row"))
def whole_seconds(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(ours(motion) | {"time_s": np.floor(motion.t)}))


@answered(Reads("inspect", time=COARSE))
def hundredths_of_seconds(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(ours(motion, ROS) | {"__time": np.round(motion.t, 2)}))


@answered(Reads(time=0.012))
def jitter(motion: Motion, folder: Path) -> Path:
    shaken = 1e3 * motion.t + np.random.default_rng(1).uniform(-10.0, 10.0, len(motion.t))
    return saved(folder, text(columns(motion, t=shaken)))


@answered(Refused("line 1003: found time going backwards, from 25 s to 0 s", "cut the file there"))
def restart(motion: Motion, folder: Path) -> Path:
    """The logger was started twice into one file."""
    t = np.where(motion.t > 25.0, motion.t - 25.025, motion.t)
    return saved(folder, text(ours(motion, ROS) | {"__time": t}))


@answered(Reads(lost=(1000,), said="1 row whose time is out of order, line 1002"))
def one_stamp_in_the_past(motion: Motion, folder: Path) -> Path:
    rows = lines(columns(motion))
    return saved(folder, changed(rows, {1000: "3" + rows[1001][rows[1001].index(",") :]}))


@answered(Reads("inspect", lost=(0, 1, 2), time=DOUBLE, said="3 rows of another time"))
def first_rows_of_a_clock_not_yet_set(motion: Motion, folder: Path) -> Path:
    """The date is that of 1970 until the first message of the network's time."""
    t = motion.t + START
    t[:3] -= START
    return saved(folder, text(ours(motion, ROS) | {"__time": t}))


@answered(Reads(said="clock: 't' in ms"))
def no_unit(motion: Motion, folder: Path) -> Path:
    return saved(folder, text(columns(motion, "t")))


@answered(Reads("inspect", time=DOUBLE))
def seconds_and_nanoseconds(motion: Motion, folder: Path) -> Path:
    ms = np.round(1e3 * motion.t)
    stamp = {
        "/imu/header/stamp/sec": START + ms // 1000,
        "/imu/header/stamp/nanosec": ms % 1000 * 1e6,
    }
    rest = {name: column for name, column in ours(motion, ROS).items() if name != "__time"}
    return saved(folder, text(stamp | rest))


def ticks_since(year: int, motion: Motion) -> list[str]:
    """Return dates as whole counts of 100 ns since the first of January of a year."""
    before = (datetime(1970, 1, 1, tzinfo=UTC) - datetime(year, 1, 1, tzinfo=UTC)).days * 86_400
    ticks = (before + START) * 10**7 + np.round(1e7 * motion.t).astype(np.int64)
    return [str(k) for k in ticks.tolist()]


@answered(Reads(time=TICKED, said="'Ticks' in 100 ns"))
def ticks_of_dot_net(motion: Motion, folder: Path) -> Path:
    return stamped(motion, folder, "Ticks", ticks_since(1, motion))


@answered(Reads(time=TICKED, said="'c0' in 100 ns"))
def file_time_of_windows(motion: Motion, folder: Path) -> Path:
    return stamped(motion, folder, "c0", ticks_since(1601, motion))
