"""How far the torque of all causes explains the motion."""

from equipoise.model.reasons.reason import Code


class TorqueReason(Code):
    """One thing that a division of torque by cause shows, with its sentence."""

    BALANCE_CLOSED = (
        "balance_closed",
        "The torques close the momentum balance: what they leave is {rms:.2f} sd of the measured "
        "rates, {share:% .3g} % within the 95 % band.",
    )
    BALANCE_OPEN = (
        "balance_open",
        "The torques do not close the momentum balance: they leave {rms:.3g} sd of the measured "
        "rates. Do not subtract them; check the sensor noise in the testbed file.",
    )
    BALANCE_UNTESTED = (
        "balance_untested",
        "Too few sensor rows stand near the ends of the seconds to test the momentum balance.",
    )
    TORQUE_UNMODELLED = (
        "torque_unmodelled",
        "A torque that no term explains acts beside the others: {sd:uN m .2g} uN m rms per axis, "
        "correlated over {correlation:.2g} s. It counts as air.",
    )
