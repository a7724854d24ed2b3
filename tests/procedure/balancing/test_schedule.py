"""The experiment's word comes before quiet times, and each change says why."""

import pytest

from equipoise.model.errors import InputError
from equipoise.model.reasons.step_reasons import StepReason
from equipoise.procedure.balancing.schedule import Schedule

QUIET = ((10.0, 20.0), (30.0, 31.0))


@pytest.mark.parametrize(
    ("said", "t", "may", "why"),
    [
        ("free", 5.0, "free", StepReason.MASSES_FREE),
        ("free", 10.0, "hold", StepReason.QUIET_TIME),
        ("free", 20.0, "free", StepReason.MASSES_FREE),
        ("hold", 5.0, "hold", StepReason.EXPERIMENT_HOLDS),
        ("hold", 15.0, "hold", StepReason.EXPERIMENT_HOLDS),
        ("done", 15.0, "done", StepReason.EXPERIMENT_DONE),
    ],
)
def test_what_masses_may_do(said, t, may, why):
    permission, reasons = Schedule(lambda: said, QUIET).at(t)
    assert permission == may
    assert [reason.code for reason in reasons] == [why]


def test_a_word_that_states_nothing_is_refused():
    with pytest.raises(InputError, match=r"experiment: found 'go'; wanted free, hold, done"):
        Schedule(lambda: "go").at(0.0)
