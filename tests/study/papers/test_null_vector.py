"""The null state vector: where the plain law stops, by hand, and that a trajectory leads out."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.app.figures.papers.null_vector import pictures_of
from equipoise.control.laws.fully_actuated import LAW
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.study.papers.null_vector import OFFSET, TILT, null_vector, paper_rows
from equipoise.study.papers.paper_row import Agreement


@pytest.fixture(scope="module")
def found():
    return null_vector(read_preset("tas2"))


def test_the_plain_law_conserves_momentum_and_leaves_the_platform_unbalanced(found):
    plain = found.plain
    assert np.linalg.norm(plain.momentum, axis=1).max() > 0.1
    assert np.linalg.norm(plain.momentum[-1]) < 1e-5
    assert np.degrees(plain.angle[-1]) < 1e-3
    assert np.degrees(plain.angle[0]) > 30
    assert np.linalg.norm(plain.offset[-1]) > 0.5 * np.linalg.norm(OFFSET)
    (said,) = plain.finished
    assert said.code == "direction_not_swept"


def test_a_momentum_trajectory_leads_out_of_it(found):
    led = found.led
    assert np.linalg.norm(led.offset[0]) == pytest.approx(np.linalg.norm(OFFSET))
    assert np.linalg.norm(led.offset[-1]) < 8e-7
    assert [said.code for said in led.finished] == ["masses_at_rest"]


def test_a_round_platform_stops_where_its_tilt_says():
    """s = X (n - n_0) against r + s along n: |r_f| = | |r_0 + X n_0| - X |, X = w_a^2 j / (m g).

    With n = g_B / g and J = jE, j = 50 kg m^2.
    """
    bed = read_preset("tas2")
    round_ = replace(bed, body=replace(bed.body, inertia_P=50.0 * np.eye(3)))
    plain = null_vector(round_).plain
    w = LAW.begin(replace(round_, body=replace(round_.body, com=np.zeros(3))),
                  np.zeros(3))[1].cone.frequency  # fmt: skip
    X = w**2 * 50.0 / bed.weight
    n = -to_matrix(exponential(TILT))[2, :]
    expected = abs(np.linalg.norm(OFFSET + X * n) - X)
    assert np.linalg.norm(plain.offset[-1]) == pytest.approx(expected, rel=1e-4)
    assert expected > 5e-5


def test_rows_are_ours_alone_and_both_runs_have_them(found):
    """The review prints no number of its Fig. 3."""
    rows = paper_rows(found)
    assert {row.agreement for row in rows} == {Agreement.SHOWN}
    assert all(row.printed == () and np.all(np.isfinite(row.ours)) for row in rows)
    left = {row.quantity: row.ours for row in rows if row.unit == "um"}
    plain, led = left.values()
    assert plain[0] == pytest.approx(78.1025, abs=1e-3)  # sqrt(40^2 + 30^2 + 60^2)
    assert plain[1] > 50 > 1 > led[1]


def test_the_figure_shows_both_runs_in_three_panels_each(found):
    (picture,) = pictures_of(found)
    axes = picture.figure.get_axes()
    assert len(axes) == 6
    curves = [ax.get_lines()[0].get_xydata() for ax in axes]
    assert curves[0][-1] == pytest.approx([found.plain.t[-1], 0.0], abs=1e-4)
    assert curves[1][:, 1].max() == pytest.approx(
        np.linalg.norm(found.led.momentum, axis=1).max(), rel=1e-6
    )
    heights = [ax.get_lines()[2].get_ydata()[-1] for ax in axes[2:4]]
    assert heights == pytest.approx([1e6 * c.offset[-1, 2] for c in (found.plain, found.led)])
