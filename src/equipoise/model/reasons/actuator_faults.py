"""Why electronics of wheels, gyros, coils or jets may not drive: what was observed, what to do.

As with boards (``board_faults``), no sentence names a cause that nobody saw.
"""

from equipoise.model.reasons.reason import Code


class ActuatorFault(Code):
    """One fault, with its sentence; a text that a device gave is quoted."""

    PORT_GONE = "actuator_port_gone", "its port is gone ({0}); connect it, then home again"
    NOTHING_RECEIVED = (
        "actuator_nothing_received",
        "nothing was received from it in the {waited:.1f} s since its port was opened; check its "
        "power, its port and its baud rate",
    )
    NOT_ITS_KIND = (
        "actuator_not_its_kind",
        "it does not answer as {0} does: it said {1}; check driver, port and baud rate",
    )
    DISAGREES = "actuator_disagrees", "{0}; correct one of the two"
    SILENT = (
        "actuator_silent",
        "it has not reported for {waited:.1f} s; the last line received is {0}; check power and "
        "cable, then home again",
    )
    LATE = (
        "actuator_late",
        "it has not taken {0} of {waited:.1f} s ago, though it reports; check its cable, then home "
        "again",
    )
    REFUSED = "actuator_refused", "it refuses {0}: {1}; home again"
    DEADMAN = (
        "actuator_deadman",
        "it came to rest by itself, since no command reached it for {allowed:.1f} s; check cable "
        "and computer, then home again",
    )
    BEGAN_ANEW = (
        "actuator_began_anew",
        "it restarted by itself and is at rest; check its power supply, then home again",
    )
    HALTED_THERE = "actuator_halted_there", "it was halted, and not by this program; home again"
    OWN_FAULT = (
        "actuator_own_fault",
        "it reports fault {number:.0f} of its own; look it up in its manual, then home again",
    )
    NOT_STOPPED = (
        "actuator_not_stopped",
        "it still works {waited:.1f} s after it was halted; cut its power",
    )


class ActuatorRemark(Code):
    """What a device declares that makes a stop worse than it need be; it stops nothing."""

    SPINS_DOWN = (
        "actuator_spins_down",
        "{0} slows down when it comes to rest, which turns the platform; a wheel that keeps its "
        "speed disturbs nothing",
    )
