"""Why a motor board may not move masses: what was observed, and what to do next.

Every sentence says what was requested, how long ago, and what was received last. None names a cause
that nobody saw: a board that is silent may be unplugged, switched off, busy or hung.
"""

from equipoise.model.reasons.reason import Code


class BoardFault(Code):
    """One fault, with its sentence; a text that a device gave is quoted."""

    PORT_GONE = (
        "port_gone",
        "its port is gone ({0}); its position is lost; connect it, then home again",
    )
    NOTHING_RECEIVED = (
        "nothing_received",
        "nothing was received from it in the {waited:.1f} s since its port was opened; check its "
        "power, its port and its baud rate",
    )
    NOT_ITS_KIND = (
        "not_its_kind",
        "it does not answer as {0} does: it said {1}; check driver, port and baud rate",
    )
    OUTDATED = "outdated", "it says {0}; wanted Grbl 1.1 or later"
    SILENT = (
        "board_silent",
        "it does not answer: {0} was requested {waited:.1f} s ago; last line received: {1}, "
        "{ago:.1f} s ago. Its position is lost; check power and cable, then home again",
    )
    UNANSWERED = (
        "unanswered",
        "it does not answer {0} of {waited:.1f} s ago, though it reports its state: the last line "
        "received is {1}, {ago:.1f} s ago; home again",
    )
    BEGAN_ANEW = (
        "began_anew",
        "it restarted by itself ({0}); its position is lost; check its power supply, then home "
        "again",
    )
    NOT_BEGUN = (
        "not_begun",
        "it has not restarted {waited:.1f} s after a reset; the last line received is {0}, "
        "{ago:.1f} s ago; switch it off and on, then home again",
    )
    ALARM = "board_alarm", "{0} (ALARM:{number:.0f}); home again"
    REFUSED = "board_refused", "{0}; home again"
    LOCKED = "board_state", "it is in state {0}: {1}; home again"
    NOT_STOPPED = (
        "not_stopped",
        "it still says {0} {waited:.1f} s after the halt, and was reset; its position is lost; "
        "home again",
    )
    STALLED = (
        "stalled",
        "its masses have stood for {waited:.1f} s on their way, in state {0}; home again",
    )
    MOVED = (
        "moved_by_reset",
        "mass {0} was at {before:mm .3f} mm before a reset, is at {now:mm .3f}; home again",
    )
    DISAGREES = "disagrees", "{0}; correct one of the two"
    HOMING_BROKEN = "homing_broken", "homing was broken off; its position is not known; home again"
    HOMING_LONG = (
        "homing_long",
        "homing has not ended after {waited:.0f} s, longer than its settings explain; last line "
        "received: {0}, {ago:.1f} s ago. Check the switches, then home again",
    )
    SWITCH_HIT = (
        "switch_hit",
        "a limit switch was hit (mass {0}); the position is likely lost; home again",
    )


class BoardRemark(Code):
    """What a board is set to that makes it worse than it need be; it stops nothing."""

    SLOW_TO_STOP = (
        "slow_to_stop",
        "mass {0} takes {taken:.2f} s to stop with {acceleration:mm g} mm/s^2 ({1}); set "
        "{wanted:mm plain} mm/s^2 or more, so that it stops within {limit:.1f} s",
    )
