"""Balance with sliding masses alone, with an integral of the tilt that the printed law lacks.

    rh' = gamma Phi^T w + gamma m w_i P_up g_b           (P_up g_b = up x (g_b x up))

Rest is where P_up g_b = 0: level, so that the centre of mass is under P however low it is. To
first order the loop has s^3 + 2 zeta w_a s^2 + (w_a^2 + w_z^2) s + w_i w_a^2, stable where
2 zeta w_a (w_a^2 + w_z^2) > w_i w_a^2 (``tilt_feedback``); ``begin`` requires that of the greatest
likely height. Not published; the integral stops while masses are late (anti-windup).
"""

from equipoise.control.elements.tilt_feedback import INTEGRAL, frequency_of, routh_margin, swing_of
from equipoise.control.law import Law
from equipoise.control.laws import two_steps
from equipoise.control.laws.two_steps import PERIOD, Params, State
from equipoise.control.plant.offset_bounds import likely_height
from equipoise.model.arrays import Vector3
from equipoise.model.errors import InputError
from equipoise.model.law_card import LawCard
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM

MARGIN = 0.3  # chosen: of Routh's condition


def begin(testbed: Testbed, target: Vector3) -> tuple[State, Params]:
    """Return state and parameters; InputError where the loop would not be stable."""
    state, params = two_steps.begin(testbed, target, INTEGRAL)
    height = likely_height(testbed)
    w, swing = frequency_of(params.gains, testbed), min(swing_of(testbed, height), 0.0)
    margin = routh_margin(w, params.gains.integral, swing)
    if margin < MARGIN:
        raise InputError(
            testbed.name,
            f"a centre of mass that may be {height / UM:.3g} um above P, where Routh's condition "
            f"has a margin of {margin:.2g}",
            (f"{MARGIN} or more: lower the centre of mass first, or state a smaller com_sd"),
        )
    return state, params


LAW = Law(
    LawCard(
        "underactuated_integral",
        ("As underactuated, with an integral of the tilt that removes the offset across up."),
        "Equipoise; Chesi 2014 for the rest, da Silva 2021 Eqs. 39-41 with errata R20-R23",
        ("masses", "gyro", "attitude"),
        "a motor step of the masses; spin about up; r_up as underactuated",
        "as underactuated, and 2 zeta w_a (w_a^2 + w_z^2) > w_i w_a^2 (Routh; an eighth is used)",
        PERIOD,
    ),
    begin,
    two_steps.step,
)
