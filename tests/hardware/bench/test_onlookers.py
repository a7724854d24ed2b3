"""An onlooker that fails is dropped alone, once, with its name."""

import pytest

from equipoise.hardware.bench.onlookers import Onlookers, why_lost
from equipoise.model.errors import BenchStopped


def failing(_word):
    raise ZeroDivisionError("in the view")


def test_one_that_fails_is_dropped_and_the_others_get_all():
    lost, received = [], []
    onlookers = Onlookers(lambda name, error: lost.append(why_lost(name, error)))
    onlookers.add("first", received.append)
    onlookers.add("view", failing)
    onlookers.add("last", received.append)
    for word in "ab":
        onlookers.hand_on(lambda each, word=word: each(word))
    assert received == ["a", "a", "b", "b"]
    assert len(lost) == 1
    assert lost[0].startswith("view: failed, the bench goes on")
    assert len(onlookers) == 2


def test_what_goes_to_one_goes_to_that_one_alone():
    one, other = [], []
    onlookers = Onlookers(lambda name, error: None)
    onlookers.add("one", one.append)
    onlookers.add("other", other.append)
    onlookers.hand_on(lambda each: each("a"), to="one")
    assert (one, other) == (["a"], [])


def test_one_lost_while_anothers_loss_is_met_is_lost_once():
    """As where to note that one has failed makes the other fail."""
    lost = []

    def met(name, _error):
        lost.append(name)
        onlookers.hand_on(lambda each: each("lost"))

    onlookers = Onlookers(met)
    onlookers.add("one", failing)
    onlookers.add("other", failing)
    onlookers.hand_on(lambda each: each("a"))
    assert lost == ["one", "other"]


def test_ctrl_c_is_no_failure_of_an_onlooker():
    def interrupted(_word):
        raise KeyboardInterrupt

    onlookers = Onlookers(lambda name, error: None)
    onlookers.add("view", interrupted)
    with pytest.raises(KeyboardInterrupt):
        onlookers.hand_on(lambda each: each("a"))
    assert len(onlookers) == 1


def test_what_a_loss_means_may_be_the_end_of_all():
    def met(name, error):
        raise BenchStopped(why_lost(name, error))

    onlookers = Onlookers(met)
    onlookers.add("record", failing)
    with pytest.raises(BenchStopped, match="record: failed"):
        onlookers.hand_on(lambda each: each("a"))
