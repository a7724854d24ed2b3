"""Every method of the registry keeps the same promises, whoever wrote it."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import equipoise.estimation.methods as package
from equipoise.estimation.method_contract import Options, estimated
from equipoise.estimation.methods.registry import METHODS
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.method_card import REGIMES
from equipoise.procedure.steps.clean_record import sound as made_sound
from tests.estimation.methods.faulty_records import AWKWARD, bed, sound
from tests.support import thorough
from tests.support.builders import COM as TRUE_COM
from tests.support.builders import INERTIA as TRUE_INERTIA

pytestmark = pytest.mark.usefixtures("few_draws")

every_method = pytest.mark.parametrize("name", METHODS)
TRUTH = dict(zip((*COM, *INERTIA), (*TRUE_COM, *TRUE_INERTIA), strict=True))
FARTHEST = 6.0  # sd
# Flipped signs have a test of their own, which asks for more.
TROUBLES = ["none", *(name for name in AWKWARD if name != "sign_flips")]
REQUESTED = {
    "term": Options(terms=("viscous_x",)),
    "hold": Options(hold=("inertia_P_zz",)),
    "prior": Options(use_prior=True),
    "robust": Options(robust=True),
}


@cache
def found(name):
    """What a method makes of the sound record."""
    return METHODS[name].run(sound(), bed(), Options())


@cache
def screened(trouble, exact=True):
    """What `identify` gives a method of a record: its rows screened, once for all methods."""
    return made_sound(sound() if trouble == "none" else AWKWARD[trouble](), bed(exact))


@cache
def identified(name, trouble, exact=True):
    return estimated(METHODS[name], *screened(trouble, exact), Options())


def test_the_registry_is_the_whole_folder():
    """A method's file has its name; a file that is in no list would be lost."""
    folder = Path(package.__file__).parent
    files = {path.stem for path in folder.glob("*.py")} - {"__init__", "registry"}
    assert files == set(METHODS)


@every_method
def test_the_card_says_it_all(name):
    card = METHODS[name].card
    assert card.name == name
    said = (card.formulation, card.solver, card.source, card.needs, card.cannot_see)
    assert all(len(text) > 5 for text in said)
    assert card.regime in REGIMES
    assert set(card.heeds) <= set(REQUESTED)


@pytest.mark.parametrize(("name", "option"), thorough.pairs(METHODS, REQUESTED, 4))
def test_an_option_is_known_or_refused(name, option):
    """Nothing that is asked for is passed over in silence."""
    method = METHODS[name]
    if option in method.card.heeds:
        assert estimated(method, sound(), bed(), REQUESTED[option]).outcome.sentence
    else:
        with pytest.raises(InputError, match=f"--{option}"):
            estimated(method, sound(), bed(), REQUESTED[option])


@pytest.mark.parametrize("name", thorough.some(list(METHODS), 6))
def test_a_method_is_pure_and_repeatable(name):
    """The record is as it was, and a second run gives the same numbers to the last digit."""
    record, before = sound(), [c.values.copy() for c in (sound().attitude, sound().rate)]
    again = METHODS[name].run(record, bed(), Options())
    for old, channel in zip(before, (record.attitude, record.rate), strict=True):
        np.testing.assert_array_equal(old, channel.values)
    values = [[p.value for p in each.parameters] for each in (found(name), again)]
    assert values[0] == values[1]
    np.testing.assert_array_equal(found(name).covariance, again.covariance)


@every_method
def test_covariance_and_intervals_agree(name):
    """Symmetric, not negative, and its diagonal is what the intervals are made of."""
    estimate = found(name)
    n = len(estimate.parameters)
    assert estimate.covariance.shape == (n, n)
    if n == 0:
        assert not estimate.outcome.usable
        return
    np.testing.assert_allclose(estimate.covariance, estimate.covariance.T, rtol=1e-9, atol=1e-30)
    sd = np.sqrt(np.maximum(np.diag(estimate.covariance), 0.0))
    unit = estimate.covariance / np.outer(np.maximum(sd, 1e-150), np.maximum(sd, 1e-150))
    assert np.linalg.eigvalsh(0.5 * (unit + unit.T))[0] > -1e-6
    for k, p in enumerate(estimate.parameters):
        assert not p.observable or p.sd == pytest.approx(sd[k], rel=1e-6)
        assert p.observable == np.isfinite(p.sd)


@every_method
def test_the_outcome_is_a_sentence(name):
    sentence = found(name).outcome.sentence
    assert sentence[0].isupper()
    assert sentence.endswith(".")


@every_method
def test_an_estimate_says_where_it_comes_from(name):
    estimate = found(name)
    assert estimate.method == name
    if estimate.parameters:
        assert estimate.provenance["version"]


@pytest.mark.parametrize(("name", "trouble"), thorough.pairs(METHODS, TROUBLES, 6))
def test_a_faulty_record_is_handled_or_reported(name, trouble):
    """As `identify` runs it: an answer within 6 sd of the truth, or word that it is not to be
    trusted, or a refusal with its reason. (What stands level has its com above or below P.)"""
    estimate = identified(name, trouble)
    assert estimate.outcome.sentence
    if estimate.outcome.warns:
        return
    off = {p.name: (p.value - TRUTH[p.name]) / p.sd for p in estimate.parameters
           if p.observable and p.name in TRUTH and p.sd > 0
           and not (trouble == "at_rest" and p.name in COM[:2])}  # fmt: skip
    assert all(abs(z) < FARTHEST for z in off.values()), off


@every_method
def test_flipped_signs_change_nothing(name):
    """q and -q are the same attitude: to rounding."""
    flipped = AWKWARD["sign_flips"]()
    other = METHODS[name].run(flipped, bed(), Options())
    for p, q in zip(found(name).parameters, other.parameters, strict=True):
        assert q.value == pytest.approx(p.value, rel=1e-6, abs=1e-3 * min(p.sd, 1.0) + 1e-15)


@every_method
def test_an_uncertain_inertia_widens_what_rests_on_it(name):
    """Where J is taken as known, its stated sd is part of that of com.

    Not so in the simplified filter, whose gain is smaller then, and takes in less of what its model
    leaves out.
    """
    if name == "kf_simplified":
        return
    exact = identified(name, "none")
    if not exact.has("com_x") or not exact.sees(COM) or exact.has(INERTIA[0]):
        return
    vague = identified(name, "none", exact=False)
    if not vague.sees(COM):
        return
    assert np.trace(vague.covariance_of(COM)) >= np.trace(exact.covariance_of(COM))


def test_a_record_without_sensors_is_no_reason_to_fail():
    """Neither camera nor gyro: every method refuses."""
    nothing = replace(sound(), attitude=None, rate=None)
    for method in METHODS.values():
        if method.card.name in ("trajectory", "smoother"):
            continue  # reading such a file is refused before
        assert not method.run(nothing, bed(), Options()).outcome.usable
