"""Why a picture of a board of markers gives no attitude."""

from equipoise.model.reasons.reason import Code


class Unseen(Code):
    """One cause: what was found in the picture, and what was wanted."""

    OTHER_SIZE = (
        "other_size",
        "a picture of {width:g} x {height:g} px, and the lens is known for {lens_width:g} x "
        "{lens_height:g} px",
    )
    NO_MARKER = "no_marker", "no marker found, {wanted:g} wanted"
    OTHER_MARKERS = (
        "other_markers",
        "no marker of the board found, {wanted:g} wanted; markers with other ids: {others:g}",
    )
    ONE_MARKER = "one_marker", "1 marker found, {wanted:g} wanted"
    NO_FIT = "no_fit", "markers found, and no attitude fits their borders"
    AMBIGUOUS = "ambiguous", "two attitudes fit alike"
