"""Balancing by hand: from 500 um to 5 um, the posteriors and the instructions on the way."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.actuators.placed_weights import handling_covariance, load_of
from equipoise.estimation.information.single_record_information import shown_by
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import tilt
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.hands import Hands
from equipoise.model.mass_properties import MassProperties
from equipoise.model.placing import Placing
from equipoise.model.recording import Recording, Samples
from equipoise.model.units import UM
from equipoise.model.weights import places_of, unloaded
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.procedure.balancing.balance_manually import (
    HandOptions,
    balance_by_hand,
    caught,
    errands,
    requested_of,
    sag_doubt,
)
from equipoise.procedure.balancing.manual_estimate import first_posterior, reloaded, taught
from equipoise.simulation.hands import SimulatedHands
from equipoise.study.law_run import Task
from equipoise.study.manual_run import manual_run
from tests.support.clumsy_hands import Clumsy
from verification import manual
from verification.manual import TARGET, half_a_millimetre_off

BED = read_preset("weights-by-hand")
placed = cache(manual.placed)


def at(testbed, **counts):
    """Return a loading by place, such as deck_A1=3."""
    names = [place.name for place in places_of(testbed.grids)]
    loading = unloaded(testbed.grids, testbed.weights)
    for name, count in counts.items():
        loading[names.index(name.replace("_", ":")), 0] = count
    return loading


@pytest.mark.parametrize("seed", range(3))
def test_half_a_millimetre_becomes_five_micrometres_in_four_rounds(seed):
    """1 g weights on a 25 mm grid; inertia up to 10 % off, a camera that leans, noise torques."""
    run = placed(seed)
    assert run.before == pytest.approx(500 * UM, rel=1e-9)
    assert run.after < 5 * UM
    assert run.rounds <= 4
    assert run.passed


def test_what_is_stated_on_the_way_covers_the_truth():
    """Errors of com and moments after every recording, in units of their sd."""
    errors = np.vstack([placed(seed).errors for seed in range(3)])
    assert len(errors) >= 6
    assert 0.5 < np.sqrt(np.mean(errors**2)) < 1.7  # 36 numbers and more: by chance +- 0.35 (3 sd)


def test_weights_added_to_an_estimate_are_added_to_its_body():
    """Agreement with putting the two bodies together; the doubt of com shrinks as mass grows."""
    before = first_posterior(BED)
    loading = at(BED, deck_A1=5, left_K13=2)
    load = load_of(BED, loading)
    mass = BED.body.mass + load.mass
    com = (BED.body.first_moment + load.first_moment) / mass
    after = reloaded(before, BED, unloaded(BED.grids, BED.weights), loading)
    assert after.mass == pytest.approx(mass)
    np.testing.assert_allclose(after.com, com, rtol=1e-12)
    np.testing.assert_allclose(
        after.body.inertia_P, BED.body.inertia_P + load.inertia_P, rtol=1e-12, atol=1e-15
    )
    share = before.mass / after.mass
    none = unloaded(BED.grids, BED.weights)
    handling = handling_covariance(BED, none, loading) / after.mass**2
    stated = share**2 * before.com_covariance + handling
    np.testing.assert_allclose(after.com_covariance, stated, rtol=1e-9, atol=1e-18)
    there = reloaded(after, BED, loading, unloaded(BED.grids, BED.weights))
    np.testing.assert_allclose(there.mean, before.mean, rtol=1e-9, atol=1e-15)


def test_a_free_swing_leaves_the_scale_open_and_a_known_load_closes_it():
    """J_xx: 6 % before, as much after one recording, under 2 % after a second, loaded one."""
    hands = SimulatedHands(half_a_millimetre_off(BED, 0), 0)
    posterior, none = first_posterior(BED), unloaded(BED.grids, BED.weights)
    shown = shown_by(caught(hands.swing(), BED), BED)
    scale = shown.estimate.values((*INERTIA, *COM))
    assert scale @ shown.information @ scale < 1.0  # alone, it knows the scale to 100 % at best
    wrong_way = scale * np.repeat([1.0, -1.0], [6, 3])
    assert wrong_way @ shown.information @ wrong_way > 1e3
    first = taught(posterior, shown)
    loading = next(
        step.placing.after for step in balance_by_hand(
            SimulatedHands(half_a_millimetre_off(BED, 0), 0), HandOptions(TARGET)
        ) if step.placing is not None
    )  # fmt: skip
    hands.place(loading)
    second = reloaded(first, BED, none, loading)
    known = replace(BED, body=MassProperties(second.mass, second.com, second.body.inertia_P))
    last = taught(second, shown_by(caught(hands.swing(), BED), known))
    sd = [np.sqrt(b.covariance[0, 0]) / b.mean[0] for b in (posterior, first, last)]
    assert sd[0] == pytest.approx(0.06, rel=1e-6)
    assert sd[1] > 0.03
    assert sd[2] < 0.02


def test_what_a_recording_says_does_not_depend_on_the_prior_it_was_fitted_with():
    """Nominal values 8 % and 100 um apart, the same prior: the same within a tenth sd."""
    hands = SimulatedHands(half_a_millimetre_off(BED, 5), 5)
    fresh, posterior = caught(hands.swing(), BED), first_posterior(BED)
    other = MassProperties(14.0, np.array([60.0, -80.0, 20.0]) * UM, 1.08 * BED.body.inertia_P)
    one, two = (
        taught(posterior, shown_by(fresh, replace(BED, body=body))) for body in (BED.body, other)
    )
    sd = np.sqrt(np.diag(one.covariance))
    assert np.abs((one.mean - two.mean) / sd).max() < 0.25
    np.testing.assert_allclose(np.sqrt(np.diag(two.covariance)), sd, rtol=0.25)


EXACT = replace(BED, weights=tuple(replace(weight, mass_sd=0.0) for weight in BED.weights))


@pytest.mark.parametrize("bed", [BED, EXACT], ids=["as stated", "exact weights"])
def test_what_hands_do_wrong_is_as_large_as_is_stated(bed):
    """Chi-square of the first moment over 60 people: 3 a person, by chance 2.05 to 3.95 (3 sd).

    Where weights are known exactly, the errors of places alone.
    """
    loading, none = at(bed, deck_A1=8, left_C5=3, right_B2=5), unloaded(bed.grids, bed.weights)
    nominal, square = load_of(bed, loading).first_moment, 0.0
    weight = np.linalg.inv(handling_covariance(bed, none, loading))
    for seed in range(60):
        hands = SimulatedHands(bed, seed)
        before = hands.truth().first_moment
        hands.place(loading)
        off = hands.truth().first_moment - before - nominal
        square += off @ weight @ off
    assert 2.05 < square / 60 < 3.95


def test_a_pile_that_was_forgotten_is_noticed_and_balanced_all_the_same():
    """The recording after it does not fit; from there on it alone counts."""
    hands = Clumsy(half_a_millimetre_off(BED, 3), 3)
    steps = list(balance_by_hand(hands, HandOptions(TARGET)))
    astray = [step.code == "com_astray" for step in steps if step.kind == "estimate"]
    assert astray[:2] == [False, True]
    assert not any(astray[2:])
    assert steps[-1].verdict.passed
    assert np.linalg.norm(hands.truth().com - TARGET) < 5 * UM


def test_simulated_hands_are_hands_and_give_the_same_for_the_same_seed():
    first, second = (SimulatedHands(half_a_millimetre_off(BED, 5), 5) for _ in range(2))
    assert isinstance(first, Hands)
    a, b = first.swing(), second.swing()
    np.testing.assert_array_equal(a.attitude.values, b.attitude.values)
    again = first.swing()
    assert not np.array_equal(again.attitude.values[:5], a.attitude.values[:5])


def test_what_is_taken_off_is_what_was_put_on():
    """Every weight has its own mass: after a round trip the platform is what it was."""
    hands = SimulatedHands(half_a_millimetre_off(BED, 6), 6)
    before = hands.truth()
    hands.place(at(BED, deck_A1=4, right_B2=3))
    loaded = hands.truth()
    assert loaded.mass != pytest.approx(before.mass + 7e-3, abs=1e-7)  # weights are not exact
    assert loaded.mass == pytest.approx(before.mass + 7e-3, abs=1e-4)
    hands.place(unloaded(BED.grids, BED.weights))
    np.testing.assert_array_equal(hands.truth().com, before.com)


def test_hands_refuse_what_no_stock_allows():
    hands = SimulatedHands(BED, 1)
    with pytest.raises(InputError, match="9 weights at deck:A1, which holds 8"):
        hands.place(at(BED, deck_A1=9))
    assert hands.truth().mass == BED.body.mass


def test_a_swing_ends_soon_after_the_platform_meets_its_stop():
    hands = SimulatedHands(half_a_millimetre_off(BED, 1), 1)
    swing = hands.swing()
    lean = tilt(swing.attitude.values, BED.up)
    first = swing.attitude.t[np.flatnonzero(lean > BED.tilt_limit - np.radians(0.2))[0]]
    assert swing.span[1] < first + 2.0
    assert lean.max() < BED.tilt_limit + np.radians(0.5)  # five sd of the camera


def test_a_recording_ends_where_the_platform_comes_to_its_stop():
    hands = SimulatedHands(half_a_millimetre_off(BED, 1), 1)
    narrow, swing = replace(BED, tilt_limit=np.radians(10)), hands.swing()
    cut = caught(swing, narrow)
    lean = tilt(cut.attitude.values, BED.up)
    assert cut.span[1] < swing.span[1]
    after = swing.attitude.values[len(lean)]
    assert tilt(after, BED.up) > narrow.tilt_at_stop
    assert np.all(lean <= narrow.tilt_at_stop)
    assert cut.rate.t[-1] <= cut.attitude.t[-1]
    assert caught(cut, replace(BED, tilt_limit=3.0)) is cut


def placing_of(before, after, left=(0.0, 0.0, -100.0)):
    return Placing(before, after, np.array(left) * UM, np.eye(3) * UM**2)


def test_placement_instructions_list_moves_first():
    """Three off A1 and one off A2, two to B1: two are moved and two come off."""
    before, after = at(BED, deck_A1=3, deck_A2=1), at(BED, deck_B1=2)
    reported = errands(placing_of(before, after), BED)
    assert [reason.sentence for reason in reported] == [
        "Move 2 x washer from deck:A1 to deck:B1.",
        "Remove 1 x washer at deck:A1, 1 x washer at deck:A2.",
    ]
    assert placing_of(before, after).handled == 4
    assert errands(placing_of(after, before), BED)[1].code == "weights_to_put_on"


def test_what_cannot_be_reached_is_said_with_its_axes():
    before, after = at(BED), at(BED, deck_A1=3)
    options = HandOptions(TARGET)
    short = requested_of(placing_of(before, after, (40.0, 0.0, -60.0)), BED, options)
    assert short[-1].sentence == "Stock and places do not reach the target along x, z."
    assert requested_of(placing_of(before, after), BED, options)[-1].code == "placing_leaves"
    assert requested_of(placing_of(before, before), BED, options)[0].code == "nothing_to_place"


def test_an_insufficient_stock_is_reported_and_the_verdict_fails():
    """Ten weights cannot balance half a millimetre; the procedure says so and stops in time."""
    few = replace(BED, weights=(replace(BED.weights[0], count=10),))
    hands = SimulatedHands(half_a_millimetre_off(few, 2), 2)
    steps = list(balance_by_hand(hands, HandOptions(TARGET, max_rounds=1)))
    assert any(step.reasons[-1].code == "target_out_of_reach" for step in steps)
    assert not steps[-1].verdict.passed
    assert steps[-1].kind == "stop"


@pytest.mark.parametrize(
    ("tilt_deg", "share"), [(0.0, 0.0), (30.0, 1 - 0.5 / 0.75**0.5), (80.0, 1.0)]
)
def test_a_declared_sag_leaves_the_height_open_by_the_tilt(tilt_deg, share):
    """Of 1.5 sqrt(2) 30 um: 1 - cos 60 / cos 30 at 30 deg, all of it from 45 deg on."""
    half = np.radians(tilt_deg) / 2
    q = np.array([[1.0, 0.0, 0.0, 0.0], [np.cos(half), np.sin(half), 0.0, 0.0]])
    record = Recording(attitude=Samples(np.array([0.0, 1.0]), q))
    sags = replace(BED, disturbances=("sag_xx",))
    assert sag_doubt(sags, record) == pytest.approx(1.5 * 2**0.5 * 30e-6 * share, abs=1e-12)
    assert sag_doubt(replace(BED, disturbances=()), record) == 0.0


def test_no_verdict_by_hand_passes_the_height_of_a_platform_that_sags():
    """25 um of sag: the height by swings to 30 deg was 8 um off, and stated to 0.7."""
    table = read_preset("reference-table")
    bed = replace(table, weights=BED.weights, grids=BED.grids)
    options = BalanceOptions(np.zeros(3), np.array([2e-6, 2e-6, 3e-6]))
    run = manual_run(Task("by_hand", bed, 3, options, 600.0, 0.35))
    assert abs(run.offset[2]) > options.tolerance[2]
    assert not run.verdict.passed


def test_a_testbed_without_weights_is_refused():
    hands = SimulatedHands(replace(BED, weights=(), grids=()), 1)
    with pytest.raises(InputError, match="no weights to place"):
        next(balance_by_hand(hands, HandOptions()))
