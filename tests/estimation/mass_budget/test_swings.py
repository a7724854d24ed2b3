"""Moments of inertia from periods: by hand, against MuJoCo's hinge, and a tensor of them."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from equipoise.estimation.mass_budget.budget import mass_budget
from equipoise.estimation.mass_budget.oscillations import agm
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.errors import InputError
from equipoise.model.mass_properties import from_centre
from equipoise.model.outcome import OutcomeCode, Trust
from tests.estimation.mass_budget.part_builders import part, parts_list, swing

G = 9.81
COM = np.array([0.004, -0.003, -0.02])
INERTIA_C = np.array([[0.35, -0.008, 0.03], [-0.008, 0.53, 0.011], [0.03, 0.011, 0.80]])
BODY = from_centre(14.0, COM, INERTIA_C)
SMALL = np.radians(0.5)
AXES = ([1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [1, 0, 1], [0, 1, 1])


def only_check(swing, *parts):
    (check,) = mass_budget(parts_list(*parts, swings=[swing])).checks
    return check


def test_a_point_on_an_arm_is_a_mathematical_pendulum():
    """T = 2 pi sqrt(L / g), so the period of 0.4 m makes m L^2 of 2 kg: 0.32 kg m^2."""
    period = 2 * np.pi * np.sqrt(0.4 / G)
    found = only_check(swing([1, 0, 0], period=period), part("point", 2.0, (), (0, 0, -0.4)))
    assert found.measured == pytest.approx(0.32, rel=1e-12)
    assert found.expected == pytest.approx(0.32, rel=1e-12)
    assert found.off == pytest.approx(0.0, abs=1e-6)


def test_a_ball_about_an_axis_beside_it():
    """2 kg of 200 mm, 0.3 m below an axis that does not go through P: J = m (d^2 / 10 + 0.09)."""
    moment = 2.0 * (0.004 + 0.09)
    period = 2 * np.pi * np.sqrt(moment / (2.0 * G * 0.3))
    ball = part("sphere", 2.0, (0.2,), (0.05, 0.1, 0.2))
    found = only_check(swing([0, 1, 0], through=np.array([0.05, -0.7, 0.5]), period=period), ball)
    assert found.expected == pytest.approx(moment, rel=1e-12)
    assert found.measured == pytest.approx(moment, rel=1e-12)


def test_a_wire_has_its_stiffness_and_the_fixture_its_inertia():
    """J = k (T / 2 pi)^2, less the fixture; gravity has no part in it."""
    box = part("box", 3.0, (0.3, 0.4, 0.1), (0.1, 0, 0))
    moment = 3.0 * 0.25 / 12 + 3.0 * 0.01
    period = 2 * np.pi * np.sqrt((moment + 0.05) / 0.02)
    wire = swing([0, 0, 1], period=period, stiffness=0.02, fixture=0.05, amplitude=0.5)
    assert only_check(wire, box).measured == pytest.approx(moment + 0.05, rel=1e-12)
    assert only_check(wire, box).expected == pytest.approx(moment + 0.05, rel=1e-12)


def test_a_weight_on_an_arm_adds_its_moment_and_its_inertia():
    """1 kg on 0.5 m below a balanced ball: k = m g d, J = J_ball + m d^2."""
    moment = 4.0 * 0.004 + 0.25
    period = 2 * np.pi * np.sqrt(moment / (G * 0.5))
    hung = swing([0, 1, 0], period=period, weight=1.0, place=np.array([0, 0.2, -0.5]))
    found = only_check(hung, part("sphere", 4.0, (0.2,)))
    assert found.measured == pytest.approx(moment, rel=1e-12)
    assert found.expected == pytest.approx(moment, rel=1e-12)


@pytest.mark.parametrize(
    ("degrees", "ratio"), [(10, 1.001907), (45, 1.039973), (60, 1.073182), (90, 1.180341)]
)
def test_a_large_swing_is_slower(degrees, ratio):
    """T / T0 = 2 K(sin A/2) / pi, from tables of the elliptic integral."""
    assert 1 / agm(1.0, np.cos(np.radians(degrees) / 2)) == pytest.approx(ratio, rel=1e-6)
    amplitude = np.radians(degrees)
    period = ratio * 2 * np.pi * np.sqrt(0.4 / G)
    found = only_check(
        swing([1, 0, 0], period=period, amplitude=amplitude), part("point", 2.0, (), (0, 0, -0.4))
    )
    assert found.measured == pytest.approx(0.32, rel=3e-6)


def hinged(axis, through, damping, start):
    """The period of MuJoCo's body on a hinge, from crossings of rest; axis level, com below."""
    six = " ".join(repr(float(x)) for x in pack_symmetric(INERTIA_C))
    down = np.cross(axis, np.cross(axis, COM - through))  # where s lies, away from the axis
    gravity = -down / np.linalg.norm(down) * G
    texts = [" ".join(repr(float(x)) for x in v) for v in (gravity, axis, through, COM)]
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option gravity="{texts[0]}" timestep="0.0005" integrator="RK4"/><worldbody>'
        f'<body><joint type="hinge" axis="{texts[1]}" pos="{texts[2]}" damping="{damping}"/>'
        f'<inertial pos="{texts[3]}" mass="14" fullinertia="{six}"/></body></worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    data.qpos[0] = start
    before, crossings = start, []
    while len(crossings) < 12:
        mujoco.mj_step(model, data)
        now = data.qpos[0]
        if before < 0 <= now:
            crossings.append(data.time - 0.0005 * now / (now - before))
        before = now
    return (crossings[-1] - crossings[0]) / (len(crossings) - 1)


def on_hinge(axis, through, damping=0.0, start=SMALL):
    """A swing as MuJoCo has it, and the moment about its axis."""
    n = np.array(axis, float) / np.linalg.norm(axis)
    period = hinged(n, np.array(through), damping, start)
    return swing(n, through=np.array(through), period=period)


def whole(**more):
    return part("tensor", 14.0, (), COM, inertia=INERTIA_C, **more)


@pytest.mark.parametrize(
    ("axis", "through", "start"),
    [
        ([1, 0, 0], (0.0, 0.0, 0.3), 0.5),
        ([0, 1, 0], (0.1, 0.0, 0.2), 0.5),
        ([1, 1, 0], (0.05, -0.1, 0.4), 40.0),
        ([1, 2, 3], (0.2, 0.1, -0.1), 0.5),
    ],
)
def test_a_swing_on_a_hinge_of_mujoco_shows_the_moment_about_it(axis, through, start):
    made = on_hinge(axis, through, start=np.radians(start))
    found = only_check(replace(made, amplitude=np.radians(start)), whole())
    n, d = made.axis, COM - np.array(through)
    moment = n @ (INERTIA_C + 14.0 * (d @ d * np.eye(3) - np.outer(d, d))) @ n
    assert found.expected == pytest.approx(moment, rel=1e-9)
    assert found.measured == pytest.approx(moment, rel=1e-4)


def test_damping_slows_a_swing_and_is_taken_out():
    """Decay l = c / 2 J: w0^2 = w_d^2 + l^2; without it the moment is 2 % off."""
    made = on_hinge([1, 0, 0], (0.0, 0.0, 0.3), damping=1.5)
    moment = made.axis @ (INERTIA_C + 14.0 * (0.003**2 + 0.32**2) * np.eye(3)) @ made.axis
    found = only_check(replace(made, decay=1.5 / (2 * moment)), whole())
    assert found.measured == pytest.approx(moment, rel=1e-4)
    assert only_check(made, whole()).measured > 1.005 * moment


def periods(rng, sd, axes=AXES, weight=0.5):
    """Swings on wires about axes through P, timed with an sd (s); one axis's J from k = 0.1 N m."""
    for axis in axes:
        n = np.array(axis, float) / np.linalg.norm(axis)
        period = 2 * np.pi * np.sqrt(n @ BODY.inertia_P @ n / 0.1)
        yield swing(n, period=period + sd * rng.normal(), period_sd=sd, stiffness=0.1,
                    name=f"axis {axis}")  # fmt: skip


def unknown(**more):
    return part("unknown", 14.0, (), COM, **more)


def test_six_axes_determine_a_tensor_of_which_nothing_is_known():
    """60 draws of the timing: the mean square error is that of the stated covariance."""
    rng, squares = np.random.default_rng(3), []
    true = pack_symmetric(BODY.inertia_P)
    for _ in range(60):
        found = mass_budget(parts_list(unknown(), swings=periods(rng, 0.01))).estimate
        error = found.values(tuple(p.name for p in found.parameters[4:])) - true
        squares.append(error @ np.linalg.solve(found.covariance[4:, 4:], error) / 6)
    assert found.outcome.trust is Trust.TRUSTWORTHY
    assert np.mean(squares) == pytest.approx(1.0, abs=4 * np.sqrt(2 / 6 / 60))


def test_what_no_axis_shows_has_no_interval():
    """Three axes: moments are known, products are not."""
    rng = np.random.default_rng(4)
    found = mass_budget(parts_list(unknown(), swings=periods(rng, 0.01, AXES[:3])))
    shown = {p.name[-2:]: p.observable for p in found.estimate.parameters[4:]}
    assert shown == {"xx": True, "yy": True, "zz": True, "xy": False, "xz": False, "yz": False}
    assert found.estimate.outcome.code == OutcomeCode.PART_UNOBSERVABLE
    assert not any(p.observable for p in found.central[3:])
    moments = [p.value for p in found.estimate.parameters[4:7]]
    np.testing.assert_allclose(moments, np.diag(BODY.inertia_P), rtol=0.02)


def test_a_swing_sharpens_what_parts_said():
    """One moment, known to 10 % of a part and to 1 % of a swing: both weigh by 1 / sd^2."""
    box = part("box", 3.0, (0.3, 0.4, 0.1), inertia_sd=0.1)
    stated = 3.0 * 0.25 / 12
    measured = 1.05 * stated
    made = swing([0, 0, 1], stiffness=0.02, period=2 * np.pi * np.sqrt(measured / 0.02))
    made = replace(made, period_sd=0.005 * made.period)  # 1 % of J
    found = mass_budget(parts_list(box, swings=[made]))
    zz = found.estimate.parameters[found.estimate.index("inertia_P_zz")]
    prior, timed = 1 / (0.1 * stated) ** 2, 1 / (0.01 * measured) ** 2
    assert zz.value == pytest.approx((prior * stated + timed * measured) / (prior + timed))
    assert zz.sd == pytest.approx((prior + timed) ** -0.5)
    xx = found.estimate.parameters[found.estimate.index("inertia_P_xx")]
    assert xx.value > 3.0 * 0.17 / 12  # one factor of its own inertia: all moments go with it


def test_gravity_alone_shows_a_ratio_and_a_known_weight_the_scale():
    """Hung low by an unknown 20 +- 5 mm: one swing leaves J open by a quarter, a second with a
    weight settles J and the height."""
    vague = unknown(centre_sd=5e-3)
    first = swing([1, 0, 0], period=1.0, period_sd=1e-4)
    k = 14.0 * G * float(np.hypot(0.003, 0.02))
    first = replace(first, period=2 * np.pi * np.sqrt(BODY.inertia_P[0, 0] / k), name="bare")
    hung = replace(first, weight=1.0, place=np.array([0, 0, -0.3]), name="weighted")
    lever = np.hypot(14.0 * 0.003, 14.0 * 0.02 + 0.3)
    moment = BODY.inertia_P[0, 0] + 0.09
    hung = replace(hung, period=2 * np.pi * np.sqrt(moment / (G * lever)))
    one = mass_budget(parts_list(vague, swings=[first])).estimate.parameters[4]
    both = mass_budget(parts_list(vague, swings=[first, hung])).estimate
    assert one.sd == pytest.approx(0.25 * one.value, rel=0.1)
    assert both.parameters[4].value == pytest.approx(BODY.inertia_P[0, 0], rel=0.01)
    assert both.parameters[4].sd < 0.04 * BODY.inertia_P[0, 0]
    assert both.parameters[3].sd < 0.3 * 5e-3


TILTED = np.array([0.0, 0.6, 0.8])
DOUBTS = {"period": 1e-3, "amplitude": 1e-3, "fixture": 1e-4, "weight": 1e-4, "stiffness": 1e-3}


def off(made):
    found = only_check(made, whole())
    return found.measured - found.expected


def doubtful(**more):
    known = {"period": 2.0, "period_sd": 1e-9, "amplitude": 0.5, "fixture": 0.02, "weight": 0.4,
             "place": np.array([0.3, -0.2, 0.1])}  # fmt: skip
    return swing(TILTED, **(known | more))


@pytest.mark.parametrize("name", DOUBTS)
def test_every_doubt_of_a_swing_widens_its_moment(name):
    """By half of what the moment differs for a number that is one sd more, or less."""
    sd, share = DOUBTS[name], 0.2 if name == "stiffness" else 1.0
    base = doubtful(stiffness=0.2 if name == "stiffness" else None)
    low, high = (
        off(replace(base, **{name: getattr(base, name) + way * sd * share})) for way in (-1, 1)
    )
    stated = only_check(replace(base, **{f"{name}_sd": sd}), whole()).measured_sd
    assert stated == pytest.approx(abs(high - low) / 2, rel=1e-3)


def test_a_doubtful_axis_turns_both_ways_across_itself():
    sd, turns = 1e-3, (np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.8, -0.6]))
    ways = [
        [off(replace(doubtful(), axis=to_matrix(exponential(way * sd * turn)) @ TILTED))
         for way in (-1, 1)]
        for turn in turns
    ]  # fmt: skip
    stated = only_check(doubtful(axis_sd=sd), whole()).measured_sd
    assert stated == pytest.approx(np.hypot(*(np.diff(ways, axis=1)[:, 0] / 2)), rel=1e-3)


def test_a_place_of_the_weight_counts():
    hung = swing([1, 0, 0], weight=1.0, place=np.array([0.0, 0.1, -0.3]), period_sd=1e-9)
    narrow = only_check(replace(hung, place_sd=1e-3), whole()).measured_sd
    wide = only_check(replace(hung, place_sd=3e-3), whole()).measured_sd
    assert wide == pytest.approx(3 * narrow, rel=1e-3)


def test_swings_that_contradict_the_parts_are_named():
    box = part("box", 3.0, (0.3, 0.4, 0.1), inertia_sd=0.01)
    good = swing(
        [0, 0, 1],
        stiffness=0.02,
        period_sd=1e-2,
        name="good",
        period=2 * np.pi * np.sqrt(3.0 * 0.25 / 12 / 0.02),
    )
    wrong = swing(
        [1, 0, 0],
        stiffness=0.02,
        period_sd=1e-2,
        name="wrong",
        period=2.4 * np.pi * np.sqrt(3.0 * 0.17 / 12 / 0.02),
    )
    outcome = mass_budget(parts_list(box, swings=[good, wrong])).estimate.outcome
    assert outcome.trust is Trust.NOT_TRUSTWORTHY
    assert outcome.reasons[-1].parameters == ("wrong",)
    assert mass_budget(parts_list(box, swings=[good])).estimate.outcome.trust is Trust.TRUSTWORTHY


def test_an_axis_through_the_centre_of_mass_is_refused():
    with pytest.raises(InputError, match="oscillation bare: found a centre of mass on its axis"):
        mass_budget(parts_list(part("sphere", 4.0, (0.2,)), swings=[swing([1, 0, 0], name="bare")]))
