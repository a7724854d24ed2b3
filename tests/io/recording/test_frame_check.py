"""A platform that seems to lie: what the rows show is said, and what mends it does."""

import re
import tomllib
from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.columns.axis_permutation import TO_Z_UP, axes_matrix
from equipoise.io.recording.frame_check import check_frame
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import conjugate, exponential, from_matrix, multiply
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording, Samples

BED = read_preset("sputnix")
T = np.arange(40.0)
Z = np.array([0.0, 0.0, 1.0])
SPIN = exponential(np.outer(0.4 * T, Z))  # two turns and a half, about the vertical


def recorded(q) -> Recording:
    return Recording(attitude=Samples(T[: len(q)], q), source="run.csv")


def leaning(angle_deg: float):
    """Return attitudes that lean about x, each in another direction of the laboratory."""
    return multiply(SPIN, exponential(np.radians([angle_deg, 0.0, 0.0])))


def labelled(q, body: tuple[str, str, str]):
    """Return attitudes whose body axes bear other names: new ones in terms of the old."""
    return multiply(q, conjugate(from_matrix(axes_matrix(body))))


def refused(q, bed=BED) -> str:
    with pytest.raises(InputError) as caught:
        check_frame(recorded(q), bed)
    return str(caught.value)


@pytest.mark.parametrize("angle", [0, 30, 59])
def test_a_leaning_platform_is_no_wrong_frame(angle) -> None:
    """Tilts that a table can have pass."""
    check_frame(recorded(leaning(angle)), BED)


# What was the body's z is now called so; the names are those of a right-handed frame.
NEW_NAMES = {
    "y": ("y", "z", "x"),
    "x": ("z", "x", "y"),
    "-y": ("x", "-z", "y"),
    "-x": ("-z", "y", "x"),
    "-z": ("x", "-y", "-z"),
}


@pytest.mark.parametrize(("axis", "names"), NEW_NAMES.items())
def test_the_body_axis_that_stays_upright_is_named_and_both_remedies_work(axis, names) -> None:
    """A tracker's body, made level in a laboratory of its own: nothing is said of laboratories."""
    q = labelled(leaning(12.0), names)
    text = refused(q)
    assert f"its body axis {axis} is 12 deg from the vertical" in text
    assert "lab_up" not in text
    assert "dialect" not in text
    up, body = text.partition("platform.up = ")[2], text.partition("; if not, ")[2]
    direction = tomllib.loads(f"up = {up.partition(' in the')[0]}")["up"]
    check_frame(recorded(q), replace(BED, up=np.array(direction, float)))
    mended = tomllib.loads(body.partition(" in a column map")[0])["body"]
    check_frame(recorded(labelled(q, tuple(mended))), BED)


def test_a_body_up_that_is_no_axis_has_no_other_names() -> None:
    """Where the testbed's up lies between axes, no order of names makes it stand."""
    bed = replace(BED, up=np.array([0.6, 0.0, -0.8]))
    text = refused(SPIN, bed)
    assert "platform.up = [0, 0, 1]" in text
    assert "body = " not in text


@pytest.mark.parametrize("along", ["x", "y", "-x", "-y"])
def test_a_laboratory_axis_is_named_where_no_body_axis_stays_upright(along) -> None:
    """Read as Z up, a laboratory whose other axis is up lets every body axis sweep about."""
    q = multiply(conjugate(np.array(TO_Z_UP[along])), leaning(5.0))
    text = refused(q)
    assert "no body axis stays near the vertical" in text
    assert f"z is 5 deg from the laboratory's {along} in the median" in text
    assert f'lab_up = "{along}" in a column map' in text
    assert "platform.up" not in text
    check_frame(recorded(multiply(np.array(TO_Z_UP[along]), q)), BED)


@pytest.mark.parametrize("up", ["z", "-z", "x", "-x"])
def test_a_table_turned_from_y_up_is_mended_in_its_own_axes(up) -> None:
    """The second remedy holds for a table whose laboratory was taken as Y up and is not."""
    of_table = multiply(conjugate(np.array(TO_Z_UP[up])), leaning(5.0))
    text = refused(multiply(np.array(TO_Z_UP["y"]), of_table))
    assert f'"{up}" of one that was read as Y up' in text


def test_a_platform_that_fell_is_said_to_have_stood_before() -> None:
    """Upright for five rows, then on its side."""
    text = refused(np.concatenate([leaning(10.0)[:5], leaning(95.0)[5:]]))
    assert "it stood upright until 5 s" in text
    assert "record it until you catch it" in text
    assert "column map" not in text


def test_attitudes_without_any_steady_axis_name_no_cause() -> None:
    """Tumbling through all attitudes: neither axes nor laboratory are blamed."""
    q = np.random.default_rng(3).normal(size=(40, 4))
    q[0] = [0.0, 1.0, 0.0, 0.0]  # on its head at first
    text = refused(q / np.linalg.norm(q, axis=1, keepdims=True))
    assert "nor near another axis of the laboratory" in text
    assert not any(word in text for word in ("lab_up", "platform.up", "fall"))


def askew(angle_deg: float, lean_deg: float = 5.0):
    """Return attitudes of a platform that leans in a laboratory that was set up askew."""
    return multiply(exponential(np.radians([0.0, angle_deg, 0.0])), leaning(lean_deg))


@pytest.mark.parametrize("angle", [35, 45, 55])
def test_a_laboratory_askew_beyond_the_stop_is_refused(angle) -> None:
    text = refused(askew(angle))
    found = re.search(r"a direction that is (\d+) deg from the laboratory's vertical", text)
    assert found is not None
    assert abs(int(found[1]) - angle) <= 2
    assert "beyond the platform's stop at 30 deg" in text
    assert "level its axes" in text


@pytest.mark.parametrize(("angle", "lean"), [(25, 5), (35, 20)])
def test_what_the_stop_or_the_swing_may_explain_passes(angle, lean) -> None:
    """Within the stop; or a swing too wide for its middle to be known."""
    check_frame(recorded(askew(angle, lean)), BED)


def test_a_platform_without_a_stop_may_stand_at_any_tilt() -> None:
    check_frame(recorded(askew(45)), replace(BED, tilt_limit=np.pi))
