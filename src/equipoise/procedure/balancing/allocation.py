"""Allocation of a law's Command to the devices of a testbed.

Masses go to the whole motor steps nearest to the requested shift, wheels share a torque, gyros
without wheels are steered by the generalised singularity-robust inverse, coils make the part of a
torque across the field, jets make whole pulses. Inputs beyond a limit are reduced here, as a bench
refuses them; the next Sample reports what the devices did.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from equipoise.actuators.cmg_steering import generalised_robust, limited_rates
from equipoise.actuators.jets import on_platform, pulses_for
from equipoise.actuators.magnetorquers import dipoles_for
from equipoise.actuators.mass_allocation import Rails, rails_of, without_delay
from equipoise.actuators.reaction_wheels import wheel_torques
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.bench import Bench
from equipoise.model.command import Command
from equipoise.model.devices import Device
from equipoise.model.testbed import Testbed
from equipoise.procedure.steps.sampler import Eyes

Inputs = dict[str, float]


@dataclass(frozen=True, slots=True, eq=False)
class Hands:
    """The last requests to the devices."""

    rails: Rails
    goal: Floats  # m, (k,) where the masses were sent
    inputs: Mapping[str, float]  # of devices, jets' pulses apart
    left: Vector3  # N m s, impulse still owed: less than a pulse


def opened_hands(testbed: Testbed, here: Floats) -> Hands:
    """Return the beginning, before any request; masses stand where they are, m."""
    steady = (*testbed.wheels, *testbed.cmgs, *testbed.magnetorquers)
    off = dict.fromkeys((device.name for device in steady), 0.0)
    rails = rails_of(testbed.masses, testbed.body.mass)
    return Hands(rails, here, off, np.zeros(3))


def carry_out(bench: Bench, command: Command, eyes: Eyes, hands: Hands, period: float) -> Hands:
    """Carry a command out, until the next one ``period`` seconds later."""
    if command.shift is not None:
        hands = send(bench, command.shift, eyes.displacement, hands)
    testbed = bench.testbed
    inputs = {
        **torquing(testbed, command.torque, eyes, bench.time, period),
        **magnetising(testbed, command.magnetic, eyes.field),
    }
    pulses, left = pulsing(testbed, command.impulse, hands.left, period)
    changed = {name: value for name, value in inputs.items() if value != hands.inputs[name]}
    if changed or pulses:
        bench.drive({**changed, **pulses})
    return replace(hands, inputs=inputs, left=left)


def send(bench: Bench, shift: Vector3, here: Floats, hands: Hands) -> Hands:
    """Send the masses from ``here`` (m) to where they shift the centre of mass so (m)."""
    masses = bench.testbed.masses
    goal = without_delay(hands.rails, hands.goal, here, shift)
    changed = np.flatnonzero(goal != hands.goal)
    if not len(changed):
        return hands
    bench.move({masses[i].name: float(goal[i]) for i in changed})
    return replace(hands, goal=goal)


def torquing(
    testbed: Testbed, torque: Vector3 | None, eyes: Eyes, now: float, period: float
) -> Inputs:
    """Return inputs of wheels, or else of gyros, for a torque (N m) on the platform."""
    wheels, cmgs = testbed.wheels, testbed.cmgs
    w, g = len(wheels), len(cmgs)
    if torque is None:
        return dict.fromkeys((device.name for device in (*wheels, *cmgs)), 0.0)
    if wheels:
        found = wheel_torques(wheels, torque, eyes.states[:w], period).inputs
        still = dict.fromkeys((cmg.name for cmg in cmgs), 0.0)
        return {**named(wheels, found), **still}
    if not cmgs:
        return {}
    angles = eyes.states[w : w + g]
    return named(cmgs, limited_rates(cmgs, generalised_robust(cmgs, angles, torque, now)))


def magnetising(testbed: Testbed, torque: Vector3 | None, field: Vector3 | None) -> Inputs:
    """Return dipoles for a torque (N m) on the platform; none in an unknown field."""
    coils = testbed.magnetorquers
    if torque is None or field is None or not coils:
        return dict.fromkeys((coil.name for coil in coils), 0.0)
    return named(coils, dipoles_for(coils, torque, field).inputs)


def pulsing(
    testbed: Testbed, impulse: Vector3 | None, left: Vector3, period: float
) -> tuple[Inputs, Vector3]:
    """Return pulses (N m s) for an impulse and the remainder of the last, and the new remainder.

    No pulse is longer than the period: the next one would end it.
    """
    jets = testbed.jets
    if impulse is None or not jets:
        return {}, left
    most = period * np.array([jet.torque for jet in jets])
    pulses: Floats = np.clip(pulses_for(jets, impulse + left).impulses, -most, most)
    given = {name: value for name, value in named(jets, pulses).items() if value != 0.0}
    return given, impulse + left - on_platform(jets, pulses)


def named(devices: Sequence[Device], values: Floats) -> Inputs:
    """Return values by their devices' names."""
    return {device.name: float(value) for device, value in zip(devices, values, strict=True)}


def let_rest(bench: Bench, eyes: Eyes, hands: Hands) -> tuple[Hands, float]:
    """Leave devices without effect; return also how long the masses still travel, s."""
    on = {name: 0.0 for name, value in hands.inputs.items() if value != 0.0}
    if on:
        bench.drive(on)
    wait = travel_time(bench.testbed, hands.goal, eyes.displacement)
    still = dict.fromkeys(hands.inputs, 0.0)
    return replace(hands, inputs=still, left=np.zeros(3)), wait


def travel_time(testbed: Testbed, goal: Floats, here: Floats) -> float:
    """Return how long the masses travel from ``here`` to a goal (m), s."""
    speed = np.array([mass.speed for mass in testbed.masses])
    return float((np.abs(goal - here) / speed).max(initial=0.0))
