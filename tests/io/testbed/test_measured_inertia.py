"""Measured moments that no body can have: the nearest possible, within their sd, and said."""

import numpy as np
import pytest

from equipoise.assessment.findings.record_findings import findings
from equipoise.io.testbed.inertia_check import measured
from equipoise.io.testbed.testbed_file import parse_testbed, text_of_testbed
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.model.errors import InputError
from equipoise.model.mass_properties import second_moments, smallest_second_moment
from equipoise.model.reasons.finding_reasons import FindingReason
from equipoise.model.recording import Recording

TEXT = """
name = "flat"
[platform]
mass_kg = 10.0
inertia_kg_m2 = [[0.3, 0.0, 0.0], [0.0, 0.4, 0.0], [0.0, 0.0, {greatest}]]
{more}
[sensor.attitude]
rate_hz = 5.0
noise_deg = 0.2
"""


def read(greatest, more="inertia_sd_percent = 2.0"):
    return parse_testbed(TEXT.format(greatest=greatest, more=more), "flat.toml")


def test_moments_by_hand():
    """J = (3, 4, 7.1), s = 1 %: 0.1 beyond an sd of 0.01 sqrt(9 + 16 + 50.41) = 0.0868, 1.15 sd.

    Each goes by J_k^2 / 75.41 of 0.1 + 0.00868: 0.01297, 0.02306 and 0.07265 kg m^2.
    """
    found, (reason,) = measured(np.diag([3.0, 4.0, 7.1]), 0.01, "here")
    np.testing.assert_allclose(np.diag(found), [3.01297, 4.02306, 7.02735], atol=1e-5)
    assert reason.code is FindingReason.INERTIA_PROJECTED
    assert reason.numbers["sds"] == pytest.approx(1.1516, abs=1e-4)
    assert (reason.numbers["greatest"], reason.numbers["others"]) == pytest.approx((7.1, 7.0))


def test_it_is_the_nearest_in_units_of_the_sd():
    """No possible triple as far inside is nearer; in turned axes the same."""
    stated, share = np.array([0.3, 0.4, 0.71]), 0.02
    R = to_matrix(exponential(np.array([0.3, -0.5, 0.9])))
    found, _ = measured(R @ np.diag(stated) @ R.T, share, "here")
    moments = np.linalg.eigvalsh(found)
    np.testing.assert_allclose(R.T @ found @ R, np.diag(moments), atol=1e-12)
    inside = moments[0] + moments[1] - moments[2]
    assert inside > 0.0

    def off(triple):
        return np.linalg.norm((triple - stated) / (share * stated))

    rng = np.random.default_rng(0)
    for low, middle in moments[:2] + 1e-3 * rng.normal(size=(200, 2)):
        assert off(np.array([low, middle, low + middle - inside])) >= off(moments) - 1e-9


@pytest.mark.parametrize("share", [0.001, 0.02, 0.1])
def test_what_a_body_can_have_is_left_alone(share):
    inertia = np.diag([0.3, 0.4, 0.699])
    found, mended = measured(inertia, share, "here")
    np.testing.assert_array_equal(found, inertia)
    assert mended == ()


def test_a_testbed_says_so_wherever_its_record_is_inspected():
    bed = read(0.72)
    assert smallest_second_moment(bed.body.inertia_C) > 0.0
    (said,) = [f for f in findings(Recording(), bed) if f.code is FindingReason.INERTIA_PROJECTED]
    assert said.kind == "mended"
    assert "0.72 kg m2" in said.sentence
    assert "0.7 kg m2" in said.sentence


def test_a_flat_plate_as_it_is_drawn_is_taken():
    """J_z = J_x + J_y to the last digit: 0 sd beyond, a tenth of an sd inside now."""
    bed = read(0.7)
    (reason,) = bed.mended
    assert reason.numbers["sds"] == pytest.approx(0.0, abs=1e-9)
    gap = 2 * np.linalg.eigvalsh(second_moments(bed.body.inertia_C))[0]
    assert gap == pytest.approx(0.1 * 0.02 * np.sqrt(0.09 + 0.16 + 0.49), rel=1e-6)


def test_what_was_taken_is_written_and_read_as_it_is():
    bed = read(0.72)
    again = parse_testbed(text_of_testbed(bed), "again.toml")
    assert again.mended == ()
    np.testing.assert_allclose(again.body.inertia_P, bed.body.inertia_P, rtol=1e-14)


@pytest.mark.parametrize(
    ("greatest", "more"),
    [
        (0.76, "inertia_sd_percent = 2.0"),  # 3.2 sd
        (0.72, "inertia_sd_percent = 0.5"),  # 4.4 sd
        (0.72, ""),  # none is stated
        (0.7, ""),
    ],
)
def test_what_is_no_chance_is_refused(greatest, more):
    with pytest.raises(InputError, match="physically inconsistent inertia"):
        read(greatest, more)


def test_about_p_it_is_the_inertia_about_c_that_counts():
    """The centre of mass 0.1 m along z: J_C is 0.1 less about x and y, so 0.65 is beyond 0.5."""
    more = 'inertia_sd_percent = 10.0\nabout = "P"\ncom_um = [0.0, 0.0, 1e5]'
    bed = read(0.65, more)
    (reason,) = bed.mended
    assert (reason.numbers["greatest"], reason.numbers["others"]) == pytest.approx((0.65, 0.5))
    assert smallest_second_moment(bed.body.inertia_C) > 0.0
