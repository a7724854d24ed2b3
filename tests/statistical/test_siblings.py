"""The section `siblings` of `make verify`, reduced; and that it counts what it says."""

import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from equipoise.model.estimate import COM, Parameter
from equipoise.model.reasons.data_reasons import Unobservable
from equipoise.model.reasons.estimate_reasons import EstimateReason
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from tests.oracle.corpus import corpus_record
from tests.support import thorough
from tests.support.limited_work import broken, dead, endless
from verification import siblings
from verification.judged_records import (
    Conclusion,
    Judged,
    concluded,
    errors,
    is_shown,
    judged,
    part_of,
    reference,
)
from verification.limited import limited

SEEDS = (1, 5, 4)  # short records, with masses: exact, by command only, late


@pytest.mark.parametrize("seed", thorough.some(SEEDS, 1))
def test_no_number_is_wrong_and_halves_agree(seed) -> None:
    record = corpus_record(seed)
    parts = [part_of(record.recording, part) for part in range(3)]
    conclusions = [reference(part, record.testbed) for part in parts]
    runs = [
        Judged("", conclusion, errors(conclusion, record), None, 1.0, "")
        for conclusion in conclusions
    ]
    assert runs[0].conclusion.usable
    assert not any(run.wrong for run in runs)
    assert siblings.sibling_row("halves", [runs[1:]]).ok


@pytest.mark.parametrize("seed", thorough.some((8, 69), 1))
def test_records_that_were_wrong_are_within_their_intervals(seed) -> None:
    """Masses between rows 1 s apart (J was 5.7 sd off); masses that contradict each other (29)."""
    record = corpus_record(seed)
    conclusion = reference(record.recording, record.testbed)
    z = errors(conclusion, record)
    assert {"com_z", "inertia_P_xx", "inertia_P_zz"} <= set(z)
    assert max(map(abs, z.values())) < 4.0


@pytest.mark.parametrize("seed", [189, *thorough.some((71,), 0)])
def test_a_log_that_is_late_gives_the_scale_and_says_so(seed) -> None:
    """Measured positions, stamped late: record 71 called the move an event, and had no scale."""
    record = corpus_record(seed)
    *_, last = identify(record.recording, record.testbed, IdentifyOptions("trajectory"))
    found = last.estimate
    (reason,) = [r for r in found.outcome.reasons if r.code is EstimateReason.LATE_LOG]
    late = found.parameters[found.index(reason.parameters[0])]
    assert abs(late.value + record.choices.late) < 3.0 * late.sd
    assert max(map(abs, errors(concluded(found), record).values())) < 4.0
    assert found.parameters[found.index("inertia_P_zz")].observable


def test_a_gyro_alone_does_not_leave_the_platform_upside_down() -> None:
    """com and gravity, both reversed, move it alike: com was 199 sd off, of the other sign."""
    record = corpus_record(201)
    z = errors(reference(record.recording, record.testbed), record)
    assert "com_z/inertia_P_yy" in z
    assert max(map(abs, z.values())) < 4.0


@pytest.mark.parametrize("seed", [94, 120, *thorough.some((158,), 0)])
def test_com_is_open_where_a_gyro_alone_does_not_show_the_tilt(seed) -> None:
    """com_z was 5.7, 45 and 10 sd off, at tilts of 50, 62 and 7 +- 2 deg; true were 8, 3 and 1."""
    record = corpus_record(seed)
    *_, last = identify(record.recording, record.testbed, IdentifyOptions("trajectory"))
    assert Unobservable.TILT in {reason.code for reason in last.estimate.unobservable}
    found = last.estimate
    assert not any(found.parameters[found.index(name)].observable for name in COM)


def test_a_ratio_is_open_where_the_misfit_hardly_rises_beside_it() -> None:
    """The optimum was nearly flat, the truth a sphere: J_xx/J_zz 0.33 +- 0.08, 7.9 sd off."""
    record = corpus_record(294)
    *_, last = identify(record.recording, record.testbed, IdentifyOptions("trajectory"))
    found = last.estimate
    flat = [r.parameters[0] for r in found.unobservable if r.code is Unobservable.MISFIT_FLAT]
    assert "inertia_P_xx/inertia_P_zz" in flat
    assert not any(p.observable for p in found.ratios if p.name in flat)
    assert max(map(abs, errors(concluded(found), record).values()), default=0.0) < 4.0


@pytest.mark.parametrize(
    ("seed", "part", "name"),
    [
        (8, 2, "inertia_P_xx"),
        (33, 1, "inertia_P_yz/inertia_P_yy"),
        *thorough.some([(44, 2, "com_y/inertia_P_yy")], 0),
    ],
)
def test_a_number_is_open_that_goes_elsewhere_with_what_the_record_leaves_open(
    seed, part, name
) -> None:
    """12, 29 and 5 sd off: the valley bends on the way to the body that the laboratory states."""
    record = corpus_record(seed)
    of_part = part_of(record.recording, part)
    *_, last = identify(of_part, record.testbed, IdentifyOptions("trajectory"))
    found = last.estimate
    assert name in {r.parameters[0] for r in found.unobservable
                    if r.code is Unobservable.MISFIT_FLAT}  # fmt: skip
    assert max(map(abs, errors(concluded(found), record).values()), default=0.0) < 4.0


@thorough.whole
def test_masses_hang_within_the_steps_of_their_log() -> None:
    """0.2 mm as tilt goes, in a log of 2 mm steps that shows none: J_zz/J_xx was 5.6 sd off."""
    record = corpus_record(47)
    z = errors(reference(part_of(record.recording, 2), record.testbed), record)
    assert "inertia_P_zz/inertia_P_xx" in z
    assert max(map(abs, z.values())) < 4.0


@thorough.whole
def test_a_mass_that_flickers_in_its_log_does_not_give_the_scale() -> None:
    """It stands between two steps of 2 mm and trembles by 0.06: J was 4.7 sd off."""
    record = corpus_record(60)
    z = errors(reference(record.recording, record.testbed), record)
    assert {"com_z", "inertia_P_xx", "inertia_P_zz"} <= set(z)
    assert max(map(abs, z.values())) < 4.0


def test_the_bound_at_the_truth_shows_inertia_where_masses_move_alone() -> None:
    moved, free = corpus_record(4), corpus_record(0)
    assert is_shown(moved, moved.recording)
    assert not is_shown(free, free.recording)


# --- counting -------------------------------------------------------------------------------------


def run(z: float = 0.0, usable: bool = True, shown: bool | None = None, sd: float = 1.0) -> Judged:
    """Return a record whose com_x is z sd off zero."""
    firm = (Parameter("com_x", "m", z * sd, sd),) if usable else ()
    conclusion = Conclusion(usable, usable, "", firm)
    return Judged("seed 0", conclusion, {"com_x": z} if usable else {}, shown, 1.0, "")


LOST = Judged("seed 0", None, {}, None, 60.0, "no end within 60 s")


def found_by_row(runs: list[Judged]) -> dict[str, str]:
    """Return what is found, by the first words of the quantity."""
    return {
        row.quantity.split(":")[0].split(" (")[0]: row.found for row in siblings.corpus_rows(runs)
    }


def test_each_record_is_counted_once_for_what_it_is() -> None:
    runs = [run(1.0), run(5.1), run(usable=False, shown=True), run(usable=False, shown=False), LOST]
    found = found_by_row(runs)
    assert found["95 % intervals, of 2 stated as trustworthy, that hold the truth"] == "50.0%"
    assert found["records refused"] == "2 of 5"
    assert found["the same, though the bound tells J within 10%"] == "20.0%"
    assert (found["wrong"], found["lost"]) == ("1", "1")
    assert found["the same, worst"] == "60"


@pytest.mark.parametrize(
    ("one", "other", "ok"),
    [
        (run(0.0), run(4.2), True),  # 4.2 / sqrt(2) = 2.97
        (run(0.0), run(4.3), False),  # 3.04
        (run(0.0), run(usable=False), True),
        (run(0.0), LOST, True),
    ],
)
def test_siblings_agree_within_three_sd_or_one_is_refused(one, other, ok) -> None:
    assert siblings.sibling_row("halves", [[one, other]]).ok is ok


# --- limits ---------------------------------------------------------------------------------------


def test_work_without_end_is_stopped_and_its_answer_kept() -> None:
    tried = limited(endless, 7, 0.5)
    assert tried.answers == (7,)
    assert tried.stopped == "no end within 0.5 s"


@pytest.mark.parametrize(("work", "why"), [(broken, "ValueError: no rows"), (dead, "exit code 3")])
def test_what_stops_work_is_stated(work, why) -> None:
    tried = limited(work, 7, 5.0)
    assert tried.answers == (7,)
    assert tried.stopped.startswith(why)


@thorough.whole
def test_a_record_without_an_end_is_lost() -> None:
    """The limit is below what importing and fitting take."""
    lost = judged((3, 0), limit=0.5)
    assert lost.conclusion is None
    assert lost.stopped == "no end within 0.5 s"
