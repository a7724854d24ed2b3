"""PID on tilt by sliding masses, tuned by a relay experiment after Ziegler and Nichols.

On each of two horizontal axes of a platform that hangs (``hanging``; a = m g / J)

    theta'' = -w0^2 theta + a (c + v),      c = u x r,  v = u x s
    v = -f (K_p theta + K_d rate) - I,      I' = f K_i theta - (v_done - v_asked) / T_a
    f = min(1, SPARE R / |slope of the demand|)                             (``hanging.spared``)

The derivative is the gyro's rate, not a differenced angle. The integral carries v to -c, so the
tilt goes to zero and with it the sideways part of r + s; the height is unobservable to this loop.
v_done is the shift that the last Sample reports: an integral whose command was not delivered
unwinds (back-calculation: Astrom and Wittenmark; T_a = K_p / K_i). f limits the demand of a large
swing to the speed of the masses (R, m/s). K_i decreases with the swing's frequency on a platform
that has been raised: the integral of a deep pendulum would destabilise a shallow one.

    1 settle   -f K_d rate, with calculated gains, while masses lower the centre of mass
    2 relay    +-d about the rest tilt, both axes at once: K_u and T_u (``ziegler_nichols``)
    3 level    the PID, until tilt, rate and shift stay quiet (``settling``)
    4 measure  the height of the swinging platform (``height_adjustment``); then level again, from
               further up, and at the end a last shift to the target

Source: Ziegler and Nichols 1942, and their use for balancing in da Silva et al. 2021 section 4.
Their test increases the proportional gain alone until the loop just oscillates. It is impossible
here: without damping the loop oscillates at every gain. It is done on tilt and rate together, and
T_u is set by the masses' lag. ``begin`` raises InputError where masses cannot make the platform
hang, are too slow or coarse for the relay, or where the sampled loop is not stable at half to twice
the gains.
"""

from dataclasses import dataclass, replace
from itertools import product
from typing import Literal

import numpy as np

from equipoise.control.elements import height_adjustment as heights
from equipoise.control.elements import ziegler_nichols as tuning
from equipoise.control.elements.loop_stability import Sampled, closed, radius, steps_late
from equipoise.control.elements.tilt_pid import Gains, Integral, damped, pid_step
from equipoise.control.law import Law, Sample
from equipoise.control.plant import pendulum
from equipoise.control.plant.moving_means import Bounds
from equipoise.control.plant.settling import (
    PERIOD,
    Rest,
    bounds,
    finest_bounds,
    is_quiet,
    settle,
)
from equipoise.control.plant.tilt_axes import Feedback
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.command import Command
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.law_card import LawCard
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import Reason, one_reason
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM

LATE = 0.5  # chosen: the share of the lead that masses and sensors may be late in the relay's cycle
STEPS = 4  # chosen: motor steps in the relay's amplitude, at the least
PATIENCE = 3.0  # chosen: of the calculated time, before the relay is given up
IMPLAUSIBLE = 2.0  # chosen: a measured gain off the calculated one by more is rejected
MARGIN = 2.0  # chosen: the gains may be wrong by this factor
RAISED = 0.1  # chosen: of the swing's frequency, for a platform that has been raised
ROUGH = 0.005  # chosen: of the depth, an offset that counts as none before the first measurement

Pair = tuple[tuning.Gains, tuning.Gains]  # of both axes

CARD = LawCard(
    name="pid",
    idea=(
        "Tilt, its integral and the gyro rate drive the masses; a relay experiment tunes the gains."
    ),
    source="Ziegler and Nichols 1942; Astrom and Hagglund 1984; da Silva et al. 2021, section 4",
    needs=("masses", "gyro", "attitude"),
    leaves="the height, which only the final measurements determine, limited by the inertia",
    stable=(
        "hanging; sensors and fine masses with up to 0.6 s of delay at 14 kg and steps of "
        "0.25 s; spin to 17 deg/s; masses of 1.4 um/s too; a swing larger than masses can "
        "follow is damped slowly"
    ),
    period=PERIOD,
)


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """The constants of a run."""

    plant: pendulum.Hanging
    loops: tuple[tuning.Loop, tuning.Loop]
    cycles: tuple[tuning.Ultimate, tuning.Ultimate]  # calculated
    gains: Pair  # calculated
    calm: Bounds  # before the relay
    rough: Bounds  # before the first measurement
    quiet: Bounds  # after it


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """Where it stands."""

    phase: Literal["settle", "relay", "level"]
    gains: Pair
    rest: Rest
    search: heights.HeightSearch
    requested: Vector3 | None = None  # m, the last shift
    integral: Floats | None = None  # (2,) m
    relays: tuple[tuning.Relay, tuning.Relay] = (tuning.Relay(), tuning.Relay())
    started: float = 0.0  # s, the relay


# --- Begin -----------------------------------------------------------------------------------


def loop_of(plant: pendulum.Hanging, axis: int) -> tuning.Loop:
    """Return one axis with its lead and its relay; InputError for masses too slow or coarse."""
    frequency = float(plant.frequency[axis])
    lead, delay = 1 / frequency, plant.delay + PERIOD / 2
    relay = plant.slew * (LATE * lead - delay)
    if relay < STEPS * plant.step or relay <= 0:
        raise InputError(
            "law pid",
            (
                f"masses that shift the centre of mass by {plant.slew / UM:.3g} um/s in "
                f"steps of {plant.step / UM:.3g} um, with {delay:.2g} s of delay"
            ),
            f"{STEPS} steps in {LATE * lead:.2g} s, a quarter of a hanging swing's radian",
        )
    return tuning.Loop(float(plant.gain[axis]), frequency, lead, delay, plant.slew, relay)


def check(loop: tuning.Loop, gains: tuning.Gains, delay: float) -> None:
    """Raise InputError where the sampled loop is unstable at half or twice the gains."""
    axis = Sampled(loop.gain, loop.frequency, PERIOD, steps_late(delay, PERIOD))
    for factor, share in product((1 / MARGIN, 1.0, MARGIN), (1.0, RAISED)):
        at = axis._replace(frequency=share * axis.frequency)
        p, i, d = np.array(gains) * factor
        size = radius(closed(at, tuning.Gains(p, share * i, d)))
        if size >= 1:
            raise InputError(
                "law pid",
                (
                    f"a loop that is unstable at {factor:.2g} times its gains, with a "
                    f"sampling period of {PERIOD} s and {delay:.2g} s of delay"
                ),
                (
                    "sensors with less delay, fine masses that quickly correct a coarse "
                    "step, or a slower platform"
                ),
            )


def begin(testbed: Testbed, target: Vector3) -> tuple[State, Params]:
    """Return where the law begins; InputError where it would not be stable."""
    plant = pendulum.hanging(testbed)
    loops = (loop_of(plant, 0), loop_of(plant, 1))
    cycles = (tuning.ultimate(loops[0]), tuning.ultimate(loops[1]))
    first, second = (tuning.rule(c, loop.lead) for c, loop in zip(cycles, loops, strict=True))
    for loop, gains in zip(loops, (first, second), strict=True):
        check(loop, gains, plant.delay + plant.filling)
    calm, quiet = bounds(plant, 0.3 * loops[0].relay), finest_bounds(plant)
    rough = bounds(plant, max(quiet.shift, ROUGH * plant.depth))
    params = Params(plant, loops, cycles, (first, second), calm, rough, quiet)
    return State("settle", params.gains, Rest(), heights.height_search(plant, target)), params


# --- Step ------------------------------------------------------------------------------------


def both(gains: Pair, plant: pendulum.Hanging) -> Gains:
    """Return the gains of both axes with what limits them."""
    (p, q), (i, j), (d, e) = zip(*gains, strict=True)
    feedback = Feedback((p, q), (d, e), pendulum.pair(plant.frequency), plant.slew)
    return Gains(feedback, (i, j))


def damping(state: State, sample: Sample, params: Params) -> Floats:
    """Return -f K_d rate, m."""
    rate = pendulum.pair(pendulum.rate_of(params.plant, sample))
    return np.array(damped(both(state.gains, params.plant), rate))


def settle_phase(state: State, sample: Sample, params: Params) -> tuple[State, Command]:
    """Return the next step of the first phase."""
    rest = settle(state.rest, sample, params.plant, params.calm, level=False)
    v, note = damping(state, sample, params), ()
    state = replace(state, rest=rest)
    if is_quiet(rest, sample.t, params.calm):
        state = replace(state, phase="relay", started=sample.t)
        note = one_reason(LawReason.RELAY_BEGINS)
    return state, Command(shift=heights.shift_at_height(state.search, v), note=note)


def relay_v(state: State, sample: Sample, params: Params) -> tuple[State, Floats]:
    """Return the relays after a sample, and v (m)."""
    tilt = pendulum.tilt_of(params.plant, sample) - state.rest.tilt
    rate = pendulum.rate_of(params.plant, sample)
    relays, v = list(state.relays), damping(state, sample, params)
    for i, (loop, relay) in enumerate(zip(params.loops, state.relays, strict=True)):
        if not tuning.has_settled(relay):
            band = tuning.band_of(loop, params.cycles[i])
            sigma = float(tilt[i] + loop.lead * rate[i])
            relays[i] = tuning.relay_step(relay, sample.t, sigma, band)
            v[i] = relays[i].output * loop.relay
    return replace(state, relays=(relays[0], relays[1])), v


def tuned(state: State, params: Params) -> tuple[Pair, tuple[Reason, ...]]:
    """Return the gains by the experiment, or the calculated ones where it is implausible."""
    found, notes = list[tuning.Gains](), list[Reason]()
    for i, (loop, relay) in enumerate(zip(params.loops, state.relays, strict=True)):
        cycle = tuning.measured(relay, loop.relay) if tuning.has_settled(relay) else None
        expected = params.cycles[i]
        if cycle is None or not 1 / IMPLAUSIBLE < cycle.gain / expected.gain < IMPLAUSIBLE:
            found.append(params.gains[i])
            notes.append(Reason(LawReason.CYCLE_REJECTED))
        else:
            found.append(tuning.rule(cycle, loop.lead))
            calculated = {"expected_gain": expected.gain, "expected_period": expected.period}
            numbers = {"gain": cycle.gain, "period": cycle.period} | calculated
            notes.append(Reason(LawReason.CYCLE_MEASURED, (), numbers))
    return (found[0], found[1]), tuple(notes)


def relay_phase(state: State, sample: Sample, params: Params) -> tuple[State, Command]:
    """Return the next step of the experiment."""
    state, v = relay_v(state, sample, params)
    note = ()
    longest = max(cycle.period for cycle in params.cycles)
    late = (
        sample.t - state.started > PATIENCE * (tuning.CYCLES_IN + tuning.CYCLES_USED + 1) * longest
    )
    if late or all(tuning.has_settled(relay) for relay in state.relays):
        gains, note = tuned(state, params)
        state = replace(state, phase="level", gains=gains, integral=np.zeros(2))
    shift = heights.shift_at_height(state.search, v)
    return replace(state, requested=shift), Command(shift=shift, note=note)


def level_phase(state: State, sample: Sample, params: Params) -> tuple[State, Command]:
    """Return the next step of the PID."""
    plant = params.plant
    tilt, rate = pendulum.tilt_of(plant, sample), pendulum.rate_of(plant, sample)
    assert state.integral is not None
    assert state.requested is not None
    height = state.search.height
    undelivered = pendulum.turned(plant, sample.shift - state.requested)
    before = Integral(pendulum.pair(state.integral), pendulum.pair(undelivered))
    time = PERIOD * (height.depth / plant.depth) ** 0.5
    gains = both(state.gains, plant)
    v, integral = pid_step(gains, pendulum.pair(tilt), pendulum.pair(rate), before, time)
    shift = heights.shift_at_height(state.search, np.array(v))
    quiet = params.quiet if height.measurements else params.rough
    search, command = heights.levelling(state.search, sample, shift, quiet)
    return replace(state, integral=np.array(integral), requested=shift, search=search), command


def level_again(state: State) -> tuple[State, Command]:
    """Return the first step of the PID after a measurement that raised the platform."""
    assert state.integral is not None
    shift = heights.shift_at_height(state.search, -state.integral)
    return replace(state, requested=shift), Command(
        shift=shift, note=heights.raised_note(state.search)
    )


def step(state: State, sample: Sample | Estimate, params: Params) -> tuple[State, Command]:
    """Return the next state and command."""
    search, command = heights.continued(state.search, sample)
    state = replace(state, search=search)
    if command is not None:
        return state, command
    if isinstance(sample, Estimate):
        return level_again(state)
    phases = {"settle": settle_phase, "relay": relay_phase, "level": level_phase}
    return phases[state.phase](state, sample, params)


LAW = Law(CARD, begin, step)
