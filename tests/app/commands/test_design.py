"""`equipoise design`: tables, JSON, figures and exit codes."""

import pytest

SHORT = ("--record-s", "60")


@pytest.fixture
def one_rail(tmp_path):
    """A platform with one mass, along x."""
    path = tmp_path.parent / "rail.toml"
    path.write_text(
        'name = "rail"\n[platform]\nmass_kg = 10.0\n'
        "inertia_kg_m2 = [[0.3, 0.0, 0.0], [0.0, 0.35, 0.0], [0.0, 0.0, 0.5]]\n"
        "com_um = [0.0, 0.0, -100.0]\ncom_sd_um = [30.0, 30.0, 30.0]\n"
        '[[sliding_mass]]\nname = "a"\nmass_g = 100.0\nhome_mm = [0.0, 100.0, 0.0]\n'
        "axis = [1.0, 0.0, 0.0]\ntravel_mm = [-50.0, 50.0]\n"
        "[sensor.attitude]\nrate_hz = 10.0\nnoise_deg = 0.1\n",
        encoding="utf-8",
    )
    return path


def test_it_reports_reach_steps_measurements_budget_and_the_limiting_contribution(equipoise):
    done = equipoise("design", "sputnix", *SHORT)
    assert done.code == 0
    for text in ("110", "1.1", "153", "limits the result", "Improvements, most effective first"):
        assert text in done.out
    assert "Not stated, and therefore neglected: misalignment of the rails" in done.out


def test_json_is_one_document(equipoise, strict_json):
    done = equipoise("design", "sputnix", *SHORT, "--json")
    reported = strict_json(done.out)
    assert reported["schema"] == "equipoise/design/1"
    assert reported["reach"]["tolerance_m"] == pytest.approx(109.55e-6, rel=1e-4)
    assert reported["masses"][0]["torque_N_m"] == pytest.approx(1.53e-4, rel=1e-3)
    assert [measurement["record_s"] for measurement in reported["measurements"]] == [60.0]
    assert (reported["verdict"]["outcome"], reported["verdict"]["code"]) == (
        "passed",
        "nothing_required",
    )
    assert {line["name"] for line in reported["budget"]} >= {"measurement", "steps", "stops", "air"}


def test_a_requirement_that_cannot_be_met_ends_with_1(equipoise):
    done = equipoise("design", "unb", *SHORT, "--require-torque", "1e-7")
    assert done.code == 1
    assert "cannot be met" in done.out


def test_the_directions_that_a_single_rail_cannot_shift_are_reported(equipoise, one_rail):
    done = equipoise("design", one_rail, *SHORT)
    assert done.code == 0
    said = " ".join(done.out.split())
    assert "The masses act one line only" in said
    assert "(0, 1, 0), (0, 0, 1)" in said or "(0, 0, 1), (0, 1, 0)" in said


def test_report_figures_and_document_are_written(equipoise, tmp_path):
    assert equipoise("design", "sputnix", *SHORT, "--out", "found").code == 0
    files = {path.relative_to(tmp_path / "found").as_posix()
             for path in (tmp_path / "found").rglob("*.*")}  # fmt: skip
    assert files >= {"report.html", "report.pdf", "report.json", "design.json"}
    assert files >= {"figures/reach.svg", "figures/budget.svg"}


@pytest.mark.parametrize(
    "words",
    [("--record-s", "0"), ("--tilt-deg", "-3"), ("--moves", "0"), ("--misalignment-deg", "-1"),
     ("--require-torque", "0"), ("--temperature-k", "-1"), ("--bending-hz", "nan")],
    ids=lambda words: words[0],
)  # fmt: skip
def test_wrong_use_ends_with_2(equipoise, words):
    done = equipoise("design", "sputnix", *words)
    assert done.code == 2
    assert words[0] in done.err


def test_a_testbed_without_masses_is_refused(equipoise, one_rail, tmp_path):
    text = one_rail.read_text(encoding="utf-8")
    bare = tmp_path.parent / "bare.toml"
    head, tail = text.split("[[sliding_mass]]")
    bare.write_text(head + tail[tail.index("[sensor") :], encoding="utf-8")
    done = equipoise("design", bare)
    assert done.code == 2
    assert "sliding_mass" in done.err
