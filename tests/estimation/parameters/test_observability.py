"""What is observable and what is not, from information matrices made by hand."""

import numpy as np
import pytest

from equipoise.dynamics.regressor import N_TORQUES
from equipoise.estimation.parameters import observability
from equipoise.estimation.parameters.fit_parameters import JP, Layout, R, Unknowns, physical
from equipoise.estimation.parameters.observability import Visibility, natural_sizes, scale_of
from equipoise.maths.linalg import unpack_symmetric
from equipoise.maths.pseudo_inertia import from_inertia
from equipoise.model.mass_properties import parallel_axis
from equipoise.sensors.camera import N_SENSOR
from tests.support.builders import ATTITUDE, COM, INERTIA, MASS, RATE

LAYOUT = Layout(("swirl",), ("error_x_1",), bias=True)
N = LAYOUT.size
J_C = unpack_symmetric(INERTIA) - parallel_axis(MASS, COM)
POINT = Unknowns(
    ATTITUDE,
    RATE,
    from_inertia(J_C),
    COM,
    np.zeros(N_TORQUES),
    np.zeros(N_SENSOR),
    np.zeros(1),
    np.zeros(3),
)
SIZE = natural_sizes(POINT, MASS, LAYOUT)
VALUES = physical(POINT, MASS, LAYOUT)
SHARP = 1e6  # information that gives an sd of 1e-3 natural sizes


def examine(natural: np.ndarray) -> Visibility:
    """Examine information given in natural sizes."""
    information = natural / np.outer(SIZE, SIZE)
    return observability.examine(information, scale_of(VALUES, SIZE), SIZE, LAYOUT.names)


def without(*directions) -> np.ndarray:
    """Return sharp information about everything but these directions (natural sizes)."""
    basis, _ = np.linalg.qr(np.column_stack(directions))
    return SHARP * (np.eye(N) - basis @ basis.T)


def unit(*names) -> np.ndarray:
    return np.isin(LAYOUT.names, names).astype(float)


def stretched() -> np.ndarray:
    way = np.zeros(N)
    way[JP], way[R] = VALUES[JP], VALUES[R]
    return way / SIZE


def hidden(view: Visibility) -> set[str]:
    return {name for name, gone in zip(LAYOUT.names, view.hidden, strict=True) if gone}


def test_full_information_leaves_nothing_unobservable():
    """Nothing to say, and the covariance is the inverse in SI units."""
    view = examine(SHARP * np.eye(N))
    assert hidden(view) == set()
    assert view.unobservable == ()
    assert not view.scale_open
    np.testing.assert_allclose(view.covariance, np.diag(SIZE**2 / SHARP), rtol=1e-9, atol=1e-25)


@pytest.mark.parametrize("name", ["com_z", "swirl", "error_x_1", "gyro_bias_y", "rate_x"])
def test_one_unobservable_parameter_is_named_and_no_other(name):
    """No information about one coordinate: it alone is hidden, the others keep their sd."""
    view = examine(without(unit(name)))
    assert hidden(view) == {name}
    assert len(view.unobservable) == 1
    assert name in view.unobservable[0].parameters
    kept = unit(name) == 0
    sd = np.sqrt(np.diag(view.covariance))
    np.testing.assert_allclose(sd[kept], SIZE[kept] / 1e3, rtol=1e-6)


def test_two_indistinguishable_parameters_are_named_together():
    """Only their sum is observable: both are hidden, in one sentence."""
    view = examine(without(unit("com_x") - unit("swirl")))
    assert hidden(view) == {"com_x", "swirl"}
    assert len(view.unobservable) == 1
    assert "com_x" in view.unobservable[0].parameters
    assert "swirl" in view.unobservable[0].parameters


def test_two_unobservable_parameters_are_two_sentences():
    """Different amounts of information keep the directions apart."""
    information = without(unit("com_z"), unit("gyro_bias_z"))
    information += 1e-3 * np.diag(unit("com_z"))
    view = examine(information)
    assert hidden(view) == {"com_z", "gyro_bias_z"}
    assert len(view.unobservable) == 2


def test_open_scale_is_called_by_its_name():
    """J and r stretch together: that is the scale, and it hides all of both that are not zero."""
    view = examine(without(stretched()))
    assert view.scale_open
    assert view.unobservable[0].code == "scale"
    assert {"com_z", "inertia_P_xx", "inertia_P_yy", "inertia_P_zz"} <= hidden(view)
    assert not hidden(view) & {"rate_x", "attitude_z", "swirl", "error_x_1", "gyro_bias_x"}


def test_ratios_keep_their_sd_when_the_scale_is_open():
    """d(J_xx / J_zz) has no part along the scale."""
    view = examine(without(stretched()))
    gradient = np.zeros(N)
    xx, zz = JP.start, JP.start + 2
    gradient[xx], gradient[zz] = 1 / VALUES[zz], -VALUES[xx] / VALUES[zz] ** 2
    sd = np.sqrt(gradient @ view.covariance @ gradient)
    by_hand = np.linalg.norm(gradient * SIZE) / np.sqrt(SHARP)
    assert sd == pytest.approx(by_hand, rel=1e-6)


def test_com_alone_is_not_the_scale():
    """A vertical offset that is unobservable is just that."""
    assert not examine(without(unit("com_z"))).scale_open


@pytest.mark.parametrize(("sd", "observed"), [(0.49, True), (0.51, False)])
def test_half_a_natural_size_is_the_limit(sd, observed):
    """A moment of inertia known to half its own size or better counts as observable."""
    k = LAYOUT.names.index("inertia_P_yy")
    information = SHARP * np.eye(N)
    information[k, k] = sd**-2
    view = examine(information)
    assert ("inertia_P_yy" not in hidden(view)) == observed
    if observed:
        assert np.sqrt(view.covariance[k, k]) == pytest.approx(sd * SIZE[k])


def test_natural_sizes_by_hand():
    """The mean moment of inertia, the distance of the centre of mass; at least 10 um of it."""
    by_name = dict(zip(LAYOUT.names, SIZE, strict=True))
    assert by_name["inertia_P_xy"] == pytest.approx(INERTIA[:3].mean())
    assert by_name["com_x"] == pytest.approx(np.linalg.norm(COM))
    assert by_name["error_x_1"] == 1e-3
    centred = Unknowns(
        ATTITUDE,
        RATE,
        POINT.six,
        np.zeros(3),
        np.zeros(N_TORQUES),
        np.zeros(N_SENSOR),
        np.zeros(1),
        RATE,
    )
    assert natural_sizes(centred, MASS, LAYOUT)[R].tolist() == [1e-5] * 3


def test_what_is_held_does_not_drown_the_rest():
    """Three moments known to 1e-9, three products to nothing at all: one direction is unobservable.

    The sd of the others stay to rounding what they are without them, those of the held are theirs.
    """
    held = np.zeros(N, dtype=bool)
    held[JP] = True
    natural = without(unit("com_z"))
    natural[held], natural[:, held] = 0.0, 0.0
    natural[held, held] = [1e18] * 3 + [1e36] * 3
    information = natural / np.outer(SIZE, SIZE)
    scale = scale_of(VALUES, SIZE)
    view = observability.examine_unheld(information, scale, SIZE, LAYOUT.names, held)
    assert hidden(view) == {"com_z"}
    assert [each.sentence for each in view.unobservable] == ["the data do not determine com_z"]
    observed = ~held & (unit("com_z") == 0)
    sd = np.sqrt(np.diag(view.covariance))
    np.testing.assert_allclose(sd[observed], SIZE[observed] / 1e3, rtol=1e-9)
    np.testing.assert_allclose(sd[JP] / SIZE[JP], [1e-9] * 3 + [1e-18] * 3, rtol=1e-9)
    assert view.unseen.shape == (N, 1)
    assert np.argmax(np.abs(view.unseen[:, 0] / SIZE)) == LAYOUT.names.index("com_z")
