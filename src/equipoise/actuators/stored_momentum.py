"""Momentum and torque of devices on a platform, from their reports: never from commands.

    h(t)   = sum I_i n_i a_i + sum momentum_j s_j(x_j) + gimbal_inertia_j x_j' g_j
    tau(t) = (sum d_k a_k) x B(t) + sum T_l a_l

with speeds n of tachometers, angles x of encoders, dipoles d and jets' torques T from the recorded
columns. (In a singularity of the gyros, or at a limit, the torque commanded is not that applied:
Lee et al., section V.) They are the known side of the equations that identify the platform.

Rates of gimbals are differences of angles over the neighbouring rows, of second order in their
spacing; noise of an encoder comes through as gimbal_inertia noise / spacing. The field is the
magnetometer's, or the testbed's with what a cage reports, turned into body axes by the measured
attitude at the rows' stamps: pass attitudes stamped at their exposure.

Pulses of jets between two rows are lost: a row within each is needed.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from equipoise.actuators.control_moment_gyros import gimbal_momentum, rotor_momentum
from equipoise.actuators.jets import on_platform
from equipoise.actuators.magnetorquers import magnetic_torque
from equipoise.actuators.reaction_wheels import wheel_momentum
from equipoise.maths.attitude import to_matrix
from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Floats, Series, Series1, Series3
from equipoise.model.devices import Device, recorded_name
from equipoise.model.errors import InputError, nearest
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed

STEADY = 1e-3  # of a field, chosen: it turns by less than a magnetometer's mounting is known


def reported(recording: Recording, devices: Sequence[Device]) -> Series:
    """Return the reports of these devices, (n, k) SI; InputError for one without."""
    names = list(recording.device_names)
    for device in devices:
        if recorded_name(device) not in names:
            where = f"{recording.source or 'recording'}: devices"
            raise InputError(where, f"no '{device.name}'", nearest(recorded_name(device), names))
    assert recording.devices is not None
    return recording.devices.values[:, [names.index(recorded_name(d)) for d in devices]]


def stored_momentum(recording: Recording, testbed: Testbed) -> Samples | None:
    """Return the momentum (n, 3) N m s of wheels and gyros; None where there are no such rows."""
    wheels, cmgs, rows = testbed.wheels, testbed.cmgs, recording.devices
    if rows is None or not (wheels or cmgs):
        return None
    h: Series3 = np.zeros((len(rows), 3))
    if wheels:
        h += wheel_momentum(wheels, reported(recording, wheels))
    if cmgs:
        angles = reported(recording, cmgs)
        h += rotor_momentum(cmgs, angles)
        if len(rows) > 1:
            h += gimbal_momentum(cmgs, np.gradient(angles, rows.t, axis=0))
    return Samples(rows.t, h)


def field_at(t: Series1, recording: Recording, testbed: Testbed) -> Series3:
    """Return the magnetic field (n, 3) T in body axes: measured, or else known and turned.

    InputError where there is neither, or no attitude to turn it by.
    """
    measured = recording.field
    if measured is not None and len(measured):
        return read_at(t, measured.t, measured.values)
    attitude = recording.attitude
    known = None
    if attitude is not None and len(attitude):
        known = testbed.field_N(cage_at(attitude.t, recording, testbed))
    if known is None or attitude is None:
        wanted = "a magnetometer's rows, or a known field and an attitude"
        raise InputError(recording.source or "recording", "no magnetic field", wanted)
    turned: Floats = np.einsum("...i,...ij->...j", known, to_matrix(attitude.values))
    return read_at(t, attitude.t, turned)


def cage_at(t: Series1, recording: Recording, testbed: Testbed) -> Floats | None:
    """Return the fields (n, k) T that the coil pairs of a cage reported; None: as at the start."""
    rows = recording.devices
    if not testbed.coil_pairs or rows is None or not len(rows):
        return None
    return read_at(t, rows.t, reported(recording, testbed.coil_pairs))


def changes_field(recording: Recording, testbed: Testbed) -> bool:
    """Say whether a cage turned or changed the field on the way: it shows no attitude then."""
    rows = recording.devices
    cage = None if rows is None else cage_at(rows.t, recording, testbed)
    field_N = None if cage is None else testbed.field_N(cage)
    if field_N is None:
        return False
    most = np.linalg.norm(field_N, axis=1).max()
    return bool(np.ptp(field_N, axis=0).max() > STEADY * most)


def known_torque(recording: Recording, testbed: Testbed) -> Samples | None:
    """Return the torque (n, 3) N m of magnetorquers and jets; None where there are no such rows."""
    coils, jets, rows = testbed.magnetorquers, testbed.jets, recording.devices
    if rows is None or not (coils or jets):
        return None
    tau: Series3 = np.zeros((len(rows), 3))
    if coils:
        field = field_at(rows.t, recording, testbed)
        tau += magnetic_torque(coils, reported(recording, coils), field)
    if jets:
        tau += on_platform(jets, reported(recording, jets))
    return Samples(rows.t, tau)


def with_known_inputs(recording: Recording, testbed: Testbed) -> Recording:
    """Return a recording with momentum and torque from its devices' rows, where it has no other."""
    if recording.devices is None:
        return recording
    momentum = recording.momentum or stored_momentum(recording, testbed)
    return replace(recording, momentum=momentum,
                   torque=recording.torque or known_torque(recording, testbed))  # fmt: skip
