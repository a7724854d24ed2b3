"""Balance with sliding masses alone: level by the printed adaptive law, swing, trim the height.

The feedback is that of ``tilt_feedback`` with w_i = 0, the rounds are those of ``two_steps``
(Chesi 2014; da Silva 2021 Eqs. 39-41; errata R20-R23; Bahu & Modenini 2020 for repeating it). Each
round leaves |r_up| / (|r_up| + X), X = w_a^2 J / (m g), of the sideways offset: little once the
height has been trimmed.
"""

from functools import partial

from equipoise.control.law import Law
from equipoise.control.laws import two_steps
from equipoise.model.law_card import LawCard

LAW = Law(
    LawCard(
        "underactuated",
        (
            "Masses level the platform by an adaptive law; a swing then determines its "
            "height, which they trim; repeated until there is no further improvement."
        ),
        "Chesi 2014; da Silva 2021 Eqs. 39-41 with errata R20-R23; Bahu & Modenini 2020",
        ("masses", "gyro", "attitude"),
        (
            "each round leaves |r_up| / (|r_up| + w_a^2 J / (m g)) of the offset across "
            "up; spin about up; r_up by the relative error of J times the last height "
            "correction"
        ),
        (
            "w_a T below 1 (0.1 is used); w_a |r| / v below 1 (0.5 is used, 2.5 is "
            "unstable); up to w_a^2 J / (m g) above P (half is used); spin of 0.2 rad/s"
        ),
        two_steps.PERIOD,
    ),
    partial(two_steps.begin, integral=0.0),
    two_steps.step,
)
