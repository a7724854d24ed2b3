"""Why every motor of a bench is stopped, or may not be started."""

from equipoise.model.reasons.reason import Code


class Interlock(Code):
    """One cause, with its sentence; a text that a device or a file gave is quoted."""

    TILT = "tilt", "the platform tilts by {tilt:deg .1f} deg; its limit is {limit:deg .1f} deg"
    RATE = (
        "rate",
        "the platform rotates at {rate:deg .1f} deg/s; the limit is {limit:deg .1f} deg/s",
    )
    SILENCE = "silence", "sensor {0} has not delivered a row of {1} for {seconds:.1f} s"
    TRAVEL = "travel", "mass {0} is at {at:mm .1f} mm; its travel is {low:mm g} to {high:mm g} mm"
    SPEED = (
        "speed",
        "mass {0} moves at {speed:mm .1f} mm/s; its limit is {limit:mm g} mm/s, or its "
        "board is misread",
    )
    MISMATCH = (
        "mismatch",
        "mass {0} is at {at:mm .2f} mm; its commanded position is {goal:mm .2f} mm",
    )
    FAULT = "fault", "board {0}: {1}"
    DEVICE_FAULT = "device_fault", "actuator {0}: {1}"
    NOT_FOLLOWING = (
        "not_following",
        "device {0} does not follow its commands: {wanted:.3g} {1} were commanded "
        "within {seconds:.1f} s, and {counted:.3g} {1} measured",
    )
    DEVICE_LIMIT = "device_limit", "device {0} is at {at:.4g} {1}; its limit is {limit:.4g} {1}"
    RECORD_LOST = "record_lost", "{0}"  # who records cannot go on
    NO_ROWS = "no_rows", "no sensor has delivered a row for {seconds:g} s"
    NOT_ANSWERING = "not_answering", "not every device responds after {seconds:g} s: {0}"
    NOT_HOME = "not_home", "the masses are not home after {seconds:g} s: {0}"
    NOT_STREAMING = "not_streaming", "not every sensor delivers rows after {seconds:g} s: {0}"
    NOT_MOVABLE = "not_movable", "masses cannot be moved after {seconds:g} s: {0}"

    # What stops nothing, but keeps masses from being moved
    UNREACHABLE = "unreachable", "{0} cannot be reached: {1}"
    POSITION_UNKNOWN = "position_unknown", "board {0}: its position is unknown; home it"
    SENSOR_SILENT = "sensor_silent", "sensor {0} delivers no row of {1}"
    SENSOR_BACK = "sensor_back", "sensor {0} delivers rows of {1} again"
