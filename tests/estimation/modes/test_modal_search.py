"""A mode that what was found since explains as well is left out again; a true one stays."""

import numpy as np

from equipoise.estimation.modes.modal_fit import agreed
from equipoise.estimation.modes.modal_search import earned
from equipoise.model.modes import FreeMode, Mode, freed
from tests.support.modal_records import INERTIA, modal_record, rigid_model

MODE = Mode(1.3, 0.004, np.array([0.1, 0.06, 0.02]), deflection=1e-3)
NEEDLESS = FreeMode(3.1, 0.01, np.array([0.0, 0.03, 0.03]))


def test_a_needless_mode_is_left_out():
    recording, testbed, _ = modal_record(3)
    model = agreed(rigid_model(recording, testbed), [NEEDLESS])
    left = earned(model)
    assert left.modes == ()
    assert left.params.modal is None


def test_of_two_modes_the_true_one_stays():
    recording, testbed, _ = modal_record(2, MODE)
    true = freed(MODE, INERTIA)
    model = agreed(rigid_model(recording, testbed), [NEEDLESS, true])
    assert [mode.frequency for mode in earned(model).modes] == [true.frequency]
