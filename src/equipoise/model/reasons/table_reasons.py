"""What there is to know about an estimate of a platform whose bearing moves over a table."""

from equipoise.model.reasons.reason import Code


class TableReason(Code):
    """One thing to know about such an estimate, with its sentence."""

    EXPLAINED_POSITION = (
        "explained_position",
        "Positions on the table scatter by {position_rms:mm .2g} mm rms per axis.",
    )
    UNEXPLAINED_ON_TABLE = (
        "unexplained_on_table",
        "The model does not explain the record: residuals are {times:.2g} times the stated noise "
        "({attitude_rms:deg .3g} deg, {position_rms:mm .2g} mm rms). Use a part without pushes, "
        "scraping pads or the table's edge.",
    )
    FRICTION_MAP = "friction_map", "The friction map has {nodes:.0f} x {nodes:.0f} nodes."
    NO_POSITION = (
        "no_position",
        "The method needs attitude and position in the record, and both sensors and [table] in "
        "the testbed.",
    )
    BEARING_MOVES = (
        "bearing_moves",
        "The bearing moves over a table, which this method does not model. Use the method auto.",
    )
