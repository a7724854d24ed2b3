"""Between a law and a bench: samples are what was done, and runs end as they should."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.law import Law, Sample
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.model.command import Command, Measurement
from equipoise.model.defects import Gap
from equipoise.model.devices import JetPair, MagneticField, Magnetorquer, ReactionWheel
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM, Estimate
from equipoise.model.law_card import LawCard
from equipoise.model.mass_properties import MassProperties
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import one_reason
from equipoise.model.testbed import AttitudeSensor, Gyro, SlidingMass, Testbed, Truth
from equipoise.procedure.balancing.allocation import opened_hands
from equipoise.procedure.balancing.run_law import (
    LawOptions,
    control,
    first_sight,
    measured_estimate,
    run_law,
)
from equipoise.procedure.steps.sampler import opened, sample_of, sampled
from equipoise.simulation.bench import SimulatedBench
from tests.support.emulated_lab import lab
from tests.support.gyro_pyramid import pyramid
from verification.laws_on_ports import bed_for

EYE = np.eye(3)
MASS, INERTIA = 10.0, np.diag([1.0, 2.0, 2.5])
HANGING = np.array([20e-6, -30e-6, -400e-6])
FIELD = np.array([20e-6, 0.0, -40e-6])
WHEELS = tuple(
    ReactionWheel(f"w{a}", axis, 1e-3, 20.0, 5e-3) for a, axis in zip("xyz", EYE, strict=True)
)
JETS = tuple(JetPair(f"j{a}", axis, 0.05, 0.01) for a, axis in zip("xyz", EYE, strict=True))
COILS = tuple(Magnetorquer(f"m{a}", axis, 1.0) for a, axis in zip("xyz", EYE, strict=True))
RAILS = tuple(
    SlidingMass(a, 0.5, home, axis, (-0.05, 0.05), 0.0, 0.0, 0.0, 0.01, 0.0, 0.0)
    for a, home, axis in zip("xyz", 0.1 * np.roll(EYE, 1, axis=0), EYE, strict=True)
)
PERIOD = 0.5
TORQUE = np.array([1e-3, -2e-3, 5e-4])
DONE = LawReason.FOLLOWED  # as good as any other


def platform(com=(0.0, 0.0, 0.0), attitude=(0.0, 0.0, 0.0), rate=(0.0, 0.0, 0.0), **changes):
    """Ten kilogrammes with one device of every kind along each axis; sensors hardly err."""
    body = MassProperties(MASS, np.array(com), INERTIA)
    zero = np.zeros(3)
    truth = Truth(body.com, zero, zero, INERTIA, 0.0, np.array(attitude), 0.0, np.array(rate), 0.0,
                  {}, 0.0, 30.0, zero)  # fmt: skip
    plain = Testbed(
        "plain", body, 0.01, np.full(3, 1e-4), EYE[2], 0.5, 9.81, RAILS,
        AttitudeSensor(20.0, 1e-5, plumb_sd=0.0), Gyro(50.0, 1e-6, 1e-7), truth=truth,
        wheels=WHEELS, jets=JETS, magnetorquers=COILS, magnetic_field=MagneticField(FIELD),
    )  # fmt: skip
    more = changes.pop("truth", {})
    return replace(plain, truth=replace(truth, **more), **changes)


def codes(step):
    """Return the codes of a step's reasons."""
    return [reason.code for reason in step.reasons]


def reported(*commands, observed=None):
    """A law that asks for one thing after the other, and then has done its work."""

    def step(state, each, _):
        if observed is not None:
            observed.append(each)
        command = commands[state] if state < len(commands) else Command(finished=one_reason(DONE))
        return state + 1, command

    card = LawCard("scripted", "", "", ("attitude",), "", "", PERIOD)
    return Law(card, lambda _bed, _target: (0, None), step)


def samples_of(testbed, *commands):
    """Return what a law sees while its commands are carried out, and the bench; no proof."""
    observed, bench = [], SimulatedBench(testbed, 1)
    for step in run_law(bench, reported(*commands, observed=observed), LawOptions(max_time=1e3)):
        if DONE in codes(step):
            break
    return observed, bench


def slopes(observed, of="rate"):
    """Return by how much (1/s) a vector of the samples changes from one to the next."""
    values = np.array([getattr(each, of) for each in observed])
    return np.diff(values, axis=0) / np.diff([each.t for each in observed])[:, None]


def test_the_commanded_torque_is_sampled_and_rotates_the_platform():
    """-h' = J w' with its sign; what is stored is -torque t. (Mean rates: from the third on.)"""
    observed, _ = samples_of(platform(), *[Command(torque=TORQUE)] * 6)
    for each in observed[1:]:
        np.testing.assert_allclose(each.torque, TORQUE, rtol=0.05, atol=1e-6)
    np.testing.assert_allclose(observed[-1].torque, TORQUE, rtol=1e-9)
    np.testing.assert_allclose(observed[-1].momentum, -TORQUE * 3.0, rtol=1e-9)
    np.testing.assert_allclose(slopes(observed)[2:] @ INERTIA, [TORQUE] * 4, atol=2e-5)


def test_without_a_torque_wheels_keep_their_speed():
    observed, _ = samples_of(platform(), Command(torque=TORQUE), Command(), Command())
    np.testing.assert_allclose(observed[-1].torque, 0.0, atol=1e-12)
    np.testing.assert_allclose(observed[-1].momentum, -TORQUE * PERIOD, rtol=1e-9)


def test_a_torque_beyond_the_drives_keeps_its_direction():
    """5 mN m at most about y: all three are a quarter of what was asked."""
    observed, _ = samples_of(platform(), *[Command(torque=10 * TORQUE)] * 3)
    np.testing.assert_allclose(observed[-1].torque, 10 * TORQUE / 4, rtol=1e-6)


def test_full_wheels_give_nothing_and_the_sample_says_so():
    """20 mN m s of room at 5 mN m: full after 4 s, and never driven beyond; back at once."""
    requested = np.array([5e-3, 0.0, 0.0])
    up, down = [Command(torque=requested)] * 11, [Command(torque=-requested)] * 2
    observed, _ = samples_of(platform(), *up, *down)
    np.testing.assert_allclose(observed[11].torque, 0.0, atol=1e-9)
    np.testing.assert_allclose(observed[11].momentum, [-0.02, 0.0, 0.0], atol=1e-9)
    np.testing.assert_allclose(observed[13].torque, -requested, atol=1e-9)


def test_gyros_give_a_torque_where_there_are_no_wheels():
    """0.2 N m s each, in a pyramid; with wheels, the gimbals rest."""
    gyros = pyramid(np.radians(54.7), 0.2, 1.0)
    observed, _ = samples_of(platform(wheels=(), cmgs=gyros), *[Command(torque=TORQUE)] * 6)
    np.testing.assert_allclose([each.torque for each in observed[2:]], [TORQUE] * 5, rtol=0.05)
    np.testing.assert_allclose(slopes(observed)[2:] @ INERTIA, [TORQUE] * 4, atol=1e-4)
    _, bench = samples_of(platform(cmgs=gyros), *[Command(torque=TORQUE)] * 2)
    np.testing.assert_array_equal(bench.read(0.1).devices.values[:, 3:7], 0.0)


def test_an_impulse_is_sampled_and_rotates_the_platform():
    impulse = np.array([2e-3, -1e-3, 4e-3])
    observed, _ = samples_of(platform(), Command(), Command(impulse=impulse), *[Command()] * 2)
    np.testing.assert_allclose(observed[2].impulse, impulse, rtol=1e-6)
    np.testing.assert_array_equal(observed[1].impulse, 0.0)
    np.testing.assert_allclose(observed[3].impulse, 0.0, atol=1e-12)
    gained = INERTIA @ (observed[3].rate - observed[1].rate)
    np.testing.assert_allclose(gained, impulse, atol=5e-6)


def test_impulses_below_the_least_pulse_are_owed_until_they_make_one():
    """0.2 mN m s a step, 0.5 at least: one pulse in three steps, and nothing is lost."""
    requested = np.array([0.0, 2e-4, 0.0])
    observed, _ = samples_of(platform(), *[Command(impulse=requested)] * 9)
    given = np.array([each.impulse[1] for each in observed[1:]])
    np.testing.assert_allclose(given, np.tile([0.0, 0.0, 6e-4], 3), atol=1e-9)


def test_the_sampled_shift_is_the_actual_one_and_not_the_commanded_one():
    """0.5 kg at 10 mm/s: 0.5 mm/s of the centre of mass, until it is where it was asked."""
    requested = np.array([1e-3, 0.0, -1e-3])
    observed, _ = samples_of(platform(), *[Command(shift=requested)] * 6)
    way = np.array([each.shift for each in observed])
    expected = np.minimum(0.25e-3 * np.arange(7), 1e-3)[:, None] * [1.0, 0.0, -1.0]
    np.testing.assert_allclose(way, expected, atol=2e-6)


def test_masses_stay_when_no_shift_is_commanded():
    requested = np.array([0.0, 1e-3, 0.0])
    observed, _ = samples_of(platform(), Command(shift=requested), *[Command()] * 6)
    np.testing.assert_allclose(observed[-1].shift, requested, atol=1e-9)


def test_a_shift_beyond_the_rails_ends_at_their_ends():
    """50 mm of 0.5 kg are 2.5 mm: the sample does not reach what a law asked for (anti-windup)."""
    observed, _ = samples_of(platform(), *[Command(shift=np.array([1e-2, 0.0, 0.0]))] * 12)
    np.testing.assert_allclose(observed[-1].shift, [2.5e-3, 0.0, 0.0], atol=1e-9)


def test_gravity_and_field_are_turned_into_the_body():
    """Yawed by 90 deg, the laboratory's x is minus the body's y."""
    observed, _ = samples_of(platform(attitude=(0.0, 0.0, np.pi / 2)), Command())
    np.testing.assert_allclose(observed[-1].field, [0.0, -20e-6, -40e-6], atol=1e-9)
    np.testing.assert_allclose(observed[-1].gravity, [0.0, 0.0, -9.81], atol=1e-3)
    leaning, _ = samples_of(platform(attitude=(0.3, 0.0, 0.0)), Command())
    np.testing.assert_allclose(
        leaning[-1].gravity, -9.81 * np.array([0.0, np.sin(0.3), np.cos(0.3)]), atol=1e-3
    )
    unknown, _ = samples_of(platform(magnetic_field=None), Command())
    assert unknown[-1].field is None


def test_a_magnetic_torque_turns_the_platform_across_the_field():
    """Of a torque along y all is given, being across B."""
    requested, strong = np.array([0.0, 3e-4, 0.0]), MagneticField(10 * FIELD)
    observed, _ = samples_of(platform(magnetic_field=strong), *[Command(magnetic=requested)] * 8)
    turning = INERTIA @ (observed[8].rate - observed[2].rate) / (observed[8].t - observed[2].t)
    np.testing.assert_allclose(turning, requested, atol=6e-6)


def test_a_measured_field_goes_before_the_known_one():
    bench = SimulatedBench(platform(), 1)
    before, fresh = opened(bench.testbed), bench.read(1.0)
    rows = np.array([[1e-6, 2e-6, 3e-6], [3e-6, 2e-6, 1e-6]])
    measured = replace(fresh, field=type(fresh.rate)(np.array([0.2, 0.4]), rows))
    now = sampled(before, measured, bench.testbed)
    sample = sample_of(before, now, measured, bench.testbed)
    np.testing.assert_allclose(sample.field, [2e-6, 2e-6, 2e-6])


def test_nothing_is_given_by_a_testbed_without_devices():
    """Torques and impulses come to nothing where nothing gives them; the law sees zeros."""
    bare = platform(wheels=(), jets=(), magnetorquers=(), magnetic_field=None)
    every = Command(torque=TORQUE, magnetic=TORQUE, impulse=TORQUE)
    observed, bench = samples_of(bare, *[every] * 3)
    for each in observed:
        for vector in (each.shift, each.momentum, each.torque, each.impulse):
            np.testing.assert_array_equal(vector, 0.0)
    assert bench.tilt_now() < 1e-6


def test_an_attitude_and_a_rate_are_those_of_the_platform():
    """Spun about the vertical for 3 s at 0.1 rad/s."""
    observed, _ = samples_of(platform(rate=(0.0, 0.0, 0.1)), *[Command()] * 4)
    last = observed[-1]
    assert last.t == pytest.approx(3.0, abs=0.05)
    np.testing.assert_allclose(last.rate, [0.0, 0.0, 0.1], atol=2e-5)
    turned = to_matrix(exponential(np.array([0.0, 0.0, 0.1 * last.t])))
    np.testing.assert_allclose(to_matrix(last.q), turned, atol=1e-4)


# --- Measurements ----------------------------------------------------------------------------


def measurement_of(*commands, measurement, testbed=None, options=None):
    """Return the steps and what the law received, of commands, a measurement and the end."""
    observed = []
    bed = platform(HANGING, attitude=(0.05, -0.03, 0.2)) if testbed is None else testbed
    bench = SimulatedBench(bed, 1)
    law = reported(*commands, Command(measurement=measurement), observed=observed)
    steps = []
    for step in run_law(bench, law, LawOptions(max_time=1e3) if options is None else options):
        steps.append(step)
        if DONE in codes(step):
            break
    return steps, observed, bench


def test_a_measurement_gives_the_law_an_estimate_of_the_unactuated_platform():
    """Wheels are not driven in it, masses have arrived; the next observation is the Estimate."""
    shift = np.array([0.0, 0.0, -2e-4])
    driven = Command(torque=np.array([1e-4, 0.0, 0.0]), shift=shift)
    steps, observed, bench = measurement_of(
        driven, measurement=Measurement(20.0, "trajectory", use_prior=True)
    )
    assert [step.kind for step in steps] == ["measurement", "estimate", "control"]
    recording, estimate = steps[0].recording, observed[-1]
    assert isinstance(estimate, Estimate)
    assert recording.span[1] - recording.span[0] == pytest.approx(20.0, abs=0.1)
    assert np.ptp(recording.masses.values, axis=0).max() == 0.0
    np.testing.assert_allclose(np.diff(recording.devices.values[:, :3], axis=0), 0.0, atol=1e-9)
    sd = np.sqrt(np.diag(estimate.covariance_of(COM)))
    assert np.all(np.abs(estimate.com - HANGING) < 4 * sd)
    assert np.all(sd < 5e-6)
    assert all(isinstance(each, Sample) for each in observed[:-1])
    np.testing.assert_allclose(bench.truth().com, HANGING + shift, atol=1e-9)


def test_a_measurement_since_a_time_includes_the_actuation_after_it():
    """The push is part of the record: masses move in it, and it begins when it was asked to."""
    pushes = [Command(shift=np.array([2e-4, 0.0, 0.0]))] * 2 + [Command(shift=np.zeros(3))] * 2
    steps, observed, _ = measurement_of(
        *pushes, measurement=Measurement(15.0, "trajectory", since=1.2, use_prior=True)
    )
    recording = steps[0].recording
    assert recording.span[0] == pytest.approx(1.2, abs=0.1)
    assert recording.span[1] == pytest.approx(18.0, abs=0.1)
    assert np.ptp(recording.masses.values[:, 0]) == pytest.approx(4e-3, abs=1e-4)
    assert isinstance(observed[-1], Estimate)


def test_a_measurement_since_a_time_accounts_for_device_actuation():
    """Wheels, coils and jets drive it while it hangs, and com is found all the same."""
    every = Command(torque=np.array([1e-3, -1e-3, 0.0]), impulse=np.array([0.0, 1e-3, 0.0]),
                    magnetic=np.array([2e-5, -3e-5, 1e-5]))  # fmt: skip
    steps, observed, _ = measurement_of(
        *[every] * 6, measurement=Measurement(15.0, "trajectory", since=1.0, use_prior=True)
    )
    assert np.ptp(steps[0].recording.momentum.values, axis=0)[0] > 2e-3
    assert steps[0].recording.torque is not None
    sd = np.sqrt(np.diag(observed[-1].covariance_of(COM)))
    assert np.all(np.abs(observed[-1].com - HANGING) < 4 * sd)


def test_a_sample_after_a_measurement_covers_the_time_since_it():
    """Torque is a mean since the measurement's last row, and no earlier pulse counts again."""
    observed = []
    bench = SimulatedBench(platform(HANGING), 1)
    measurement = Command(measurement=Measurement(10.0, "trajectory", use_prior=True))
    law = reported(
        Command(torque=TORQUE, impulse=TORQUE),
        measurement,
        Command(torque=-TORQUE),
        observed=observed,
    )
    for step in run_law(bench, law, LawOptions(max_time=1e3)):
        if DONE in codes(step):
            break
    np.testing.assert_allclose(observed[-1].torque, -TORQUE, rtol=0.1)
    np.testing.assert_array_equal(observed[-1].impulse, 0.0)


# --- Ends ------------------------------------------------------------------------------------


def ended(law, testbed=None, seed=1, **options):
    swinging = platform(HANGING, (0.05, -0.03, 0.2), (0.01, 0.005, 0.0))
    bench = SimulatedBench(swinging if testbed is None else testbed, seed)
    return list(run_law(bench, law, LawOptions(**options))), bench


def test_what_a_law_claims_is_proved_by_what_comes_after():
    """com is where it is wanted, within 2.6 sd: passed, on a swing after the last step."""
    law = reported(Command(note=one_reason(LawReason.LEVEL_AGAIN)))
    steps, bench = ended(law, target=HANGING, tolerance=np.full(3, 6e-6), proof=30.0)
    assert [step.kind for step in steps] == ["control", "control", "verify"]
    assert steps[0].sentence == "Level again."
    assert steps[1].sentence == f"scripted for 0 s of bench time: {DONE.template}"
    assert steps[2].verdict.passed
    assert steps[2].recording.span[0] >= steps[1].time
    assert bench.time == pytest.approx(1.5 + 30.0)
    assert not steps[2].estimate.has("drift_z")  # over a swing com is taken to stand still


def test_a_law_that_is_wrong_fails_by_the_proof():
    steps, _ = ended(reported(), target=HANGING + 2e-5, tolerance=np.full(3, 5e-6), proof=30.0)
    assert steps[-1].kind == "stop"
    assert not steps[-1].verdict.passed
    assert steps[-1].verdict.code == "outside_tolerance"


def test_time_is_used_up_with_the_proof_included():
    steps, bench = ended(reported(*[Command()] * 1000), max_time=25.0, proof=15.0)
    assert "time_used_up" in codes(steps[-2])
    assert bench.time == pytest.approx(25.0, abs=PERIOD)
    assert steps[-1].verdict is not None


def test_masses_have_arrived_before_the_proof():
    away = Command(shift=np.array([0.0, 0.0, -1e-3]))
    steps, _ = ended(reported(away), max_time=60.0, proof=15.0)
    assert np.ptp(steps[-1].recording.masses.values, axis=0).max() == 0.0


def test_a_platform_beyond_its_tilt_limit_is_stopped():
    """Its masses stop on their way, wheels give nothing; the verdict is that it was halted."""
    thrown = platform(HANGING, rate=(0.3, 0.0, 0.0))
    wide = Command(shift=np.array([0.0, 0.0, 2e-3]), torque=TORQUE)
    steps, bench = ended(reported(*[wide] * 50), thrown)
    verdict = steps[-1].verdict
    assert (steps[-1].kind, verdict.outcome) == ("stop", "halted")
    assert "reaches its tilt limit" in verdict.sentence
    stood = bench.displacements
    assert 0.0 < stood[2] < 0.04
    observed = bench.read(2.0)
    np.testing.assert_array_equal(bench.displacements, stood)
    np.testing.assert_allclose(np.diff(observed.devices.values[5:, :3], axis=0), 0.0, atol=1e-12)


def test_a_platform_that_hangs_by_its_limit_is_not():
    """0.48 rad of 0.5."""
    steps, _ = ended(reported(*[Command()] * 3), platform(attitude=(0.48, 0.0, 0.0)),
                     max_time=20.0, proof=15.0)  # fmt: skip
    assert steps[-1].verdict.outcome != "halted"


def test_a_bench_that_shows_no_attitude_is_refused():
    blind = platform(truth={"gaps": (Gap(0.0, 5.0),)})
    with pytest.raises(InputError, match="no attitude in 1 s"):
        ended(reported(), blind)


def test_the_clock_of_samples_is_the_benchs():
    bench = SimulatedBench(platform(), 1)
    session, first = first_sight(bench)
    assert first.t == pytest.approx(1.0, abs=0.05)
    _, second, fresh = control(bench, session, Command(), 0.25)
    assert second.t == pytest.approx(1.25, abs=0.05)
    assert fresh.span[1] == pytest.approx(1.25, abs=0.05)


def test_masses_that_stand_away_from_home_at_first_are_brought_where_a_law_wants_them():
    """5 mm along x, and a law that asks for no shift: home."""
    bench = SimulatedBench(platform(), 1)
    bench.move({"x": 5e-3})
    bench.read(2.0)
    steps = run_law(bench, reported(*[Command(shift=np.zeros(3))] * 4), LawOptions(max_time=1e3))
    assert DONE in codes(next(steps))
    assert bench.displacements == pytest.approx(np.zeros(3), abs=1e-12)


def test_a_torque_fixed_by_a_measurement_is_taken_as_zero():
    """Of drift and swirl, which the testbed considers, the measurement holds the drift."""
    bed = platform(HANGING, (0.05, -0.03, 0.2), disturbances=("swirl", "drift_x", "drift_z"))
    swing = SimulatedBench(bed, 1).read(20.0)
    measurement = Measurement(
        20.0, "trajectory", hold=("drift_x", "drift_z", "inertia_P_zz"), use_prior=True
    )
    estimate = measured_estimate(swing, bed, measurement)
    assert estimate.has("swirl")
    assert not estimate.has("drift_x")
    assert not estimate.has("drift_z")
    assert measured_estimate(swing, bed, replace(measurement, hold=())).has("drift_z")


def test_hands_begin_with_everything_off():
    """Three wheels and three coils; a pulse lasts no longer than itself."""
    assert opened_hands(platform(), np.zeros(0)).inputs == dict.fromkeys(
        ("wx", "wy", "wz", "mx", "my", "mz"), 0
    )


# --- Time ------------------------------------------------------------------------------------


@pytest.mark.parametrize(("expected", "warned"), [(61.0, True), (59.0, False)])
def test_a_law_whose_time_will_not_do_says_so_before_it_begins(expected, warned):
    """100 s less 40 s of proof: 60 s."""
    law = replace(reported(), expected=lambda _params: expected)
    steps = []
    for step in run_law(SimulatedBench(platform(HANGING), 1), law, LawOptions(max_time=100.0)):
        steps.append(step)
        if DONE in codes(step):
            break
    assert (codes(steps[0]) == ["law_will_be_late"]) is warned
    if warned:
        assert steps[0].time == 0.0
        assert steps[0].reasons[0].numbers == {"expected": 61.0, "available": 60.0}
        assert "scripted should take 61 s on this testbed, and has 60 s" in steps[0].sentence


def test_a_law_keeps_its_period_though_ports_take_their_time():
    """60 commands to masses and wheels, each answered later than at once: none adds to the next."""
    observed = []
    ways = [Command(shift=np.array([0.0, 0.0, 2e-6 * (k % 2)]), torque=TORQUE) for k in range(60)]
    with lab(bed_for("fully_actuated")) as found:
        law = reported(*ways, observed=observed)
        for step in run_law(found.bench, law, LawOptions(max_time=1e3)):
            if DONE in codes(step):
                break
    t = np.array([each.t for each in observed])
    assert len(t) == 61
    np.testing.assert_allclose(t - t[0], PERIOD * np.arange(61), rtol=0, atol=0.5 * PERIOD)
