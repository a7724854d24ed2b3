"""What moves masses during a hold, and what does not."""

import numpy as np

from equipoise.io.testbed.presets import read_preset
from equipoise.model.units import UM
from equipoise.procedure.balancing.hold import HoldOptions
from equipoise.procedure.balancing.hold_moves import significant_com
from equipoise.procedure.balancing.hold_verdict import Measured
from equipoise.study.papers.ivanov_hold import HoldTrial, held_while_drifting

AIM = HoldOptions(duration=60.0)  # within 3 um on every axis


def offset_that_counts(off_um, sd_um):
    later = Measured(AIM.target + np.array(off_um) * UM, np.diag(np.square(sd_um)) * UM**2)
    return (significant_com(later, AIM) - AIM.target) / UM


def test_what_is_known_counts_however_small():
    """1.4 um is less than half of the tolerance."""
    found = offset_that_counts((0.3, -1.0, 2.0), (0.1, 1.4, 1.4))
    np.testing.assert_allclose(found, (0.3, -1.0, 2.0), atol=1e-9)


def test_what_is_open_counts_only_beyond_two_sd():
    """1.6 um is more than half of it: 3.1 um are within two sd, 3.3 um are not."""
    found = offset_that_counts((3.1, -3.1, 3.3), (1.6, 1.6, 1.6))
    np.testing.assert_allclose(found, (0.0, 0.0, 3.3), atol=1e-9)
    found = offset_that_counts((0.5, 0.0, -11.0), (0.2, 0.2, 5.2))
    np.testing.assert_allclose(found, (0.5, 0.0, -11.0), atol=1e-9)


def test_a_contact_that_was_none_moves_no_mass_out_of_tolerance():
    """Of this platform the tracker suspects one after 15 s, and knows the height to 5 um then."""
    run = held_while_drifting(HoldTrial(read_preset("sputnix"), 56, 60.0)).run
    assert run.well, run.worst / UM
