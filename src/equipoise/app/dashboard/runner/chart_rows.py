"""From rows and estimates to the columns that the page draws; nothing is estimated here."""

import numpy as np

from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.app.dashboard.protocol.frames import Part
from equipoise.app.dashboard.protocol.series import drawn_devices
from equipoise.app.live.live_estimate import LiveEstimate
from equipoise.assessment.metrics.gravity_torque import gravity_torque
from equipoise.assessment.metrics.motion_energy import motion_energy
from equipoise.estimation.tracker.tracker import Track
from equipoise.maths.attitude import euler321_sd, tilt, to_euler321
from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Floats, Series1, Series3
from equipoise.model.devices import recorded_name
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

COM = slice(0, 3)  # of an estimate's covariance


def parts_of(
    rows: Recording, testbed: Testbed, posterior: LiveEstimate, track: Track | None
) -> list[Part]:
    """Return the series (``series_of``) along some rows; one without any is left out."""
    parts = [*_attitude(rows, testbed), *_rate(rows, testbed, track), *_masses(rows, testbed)]
    parts.append(("limits", _limits(rows, testbed)))
    if track is not None and posterior.tail is not None and posterior.covariance is not None:
        parts += _estimated(posterior.tail, testbed, track, posterior.covariance)
    return [(name, values) for name, values in parts if len(values)]


def standing_com(rows: Recording, testbed: Testbed, t: Series1, com: Series3) -> Series3:
    """Return the centre of mass (m) with the masses as they stand, of that with them at home."""
    if rows.masses is None or not len(rows.masses):
        return com
    at = read_at(t, rows.masses.t, rows.masses.values)
    return com + com_shift(mass_maps(testbed.masses), testbed.body.mass, at)


def _attitude(rows: Recording, testbed: Testbed) -> list[Part]:
    if rows.attitude is None:
        return []
    t, q = rows.attitude.t, rows.attitude.values
    angles = to_euler321(q)
    noise = np.nan if testbed.attitude is None else testbed.attitude.noise
    return [
        ("pose", np.column_stack([t, q])),
        ("attitude", np.column_stack([t, *angles, *euler321_sd(angles[1], noise)])),
    ]


def _rate(rows: Recording, testbed: Testbed, track: Track | None) -> list[Part]:
    """Return the gyro's rate with its stated noise; without a gyro the tracker's estimate."""
    if rows.rate is not None:
        t, rate = rows.rate.t, rows.rate.values
        sd = np.full_like(rate, np.nan if testbed.gyro is None else testbed.gyro.noise)
    elif track is not None and testbed.gyro is None:
        t, rate, sd = track.t, track.rate, track.rate_sd
    else:
        return []
    return [("rate", np.column_stack([t, rate, sd]))]


def _limits(rows: Recording, testbed: Testbed) -> Floats:
    """Return tilt and, of a real bench, rate as shares of what stops the masses, in time's order.

    What a row does not contain is NaN.
    """
    hardware = testbed.hardware
    width, found = 2 if hardware is None else 3, list[Floats]()
    if rows.attitude is not None:
        share = tilt(rows.attitude.values, testbed.up) / testbed.tilt_limit
        found.append(_beside(rows.attitude.t, share, 1, width))
    if rows.rate is not None and hardware is not None:
        share = np.linalg.norm(rows.rate.values, axis=1) / hardware.limits.rate
        found.append(_beside(rows.rate.t, share, 2, width))
    table = np.vstack([np.zeros((0, width)), *found])
    return table[np.argsort(table[:, 0], kind="stable")]


def _beside(t: Series1, share: Series1, column: int, width: int) -> Floats:
    table = np.full((len(t), width), np.nan)
    table[:, 0], table[:, column] = t, share
    return table


def _masses(rows: Recording, testbed: Testbed) -> list[Part]:
    parts: list[Part] = []
    if rows.masses is not None:
        parts.append(("masses", np.column_stack([rows.masses.t, rows.masses.values])))
    for name, devices in drawn_devices(testbed).items():
        if rows.devices is not None and devices:
            where = [rows.device_names.index(recorded_name(device)) for device in devices]
            parts.append((name, np.column_stack([rows.devices.t, rows.devices.values[:, where]])))
    return parts


def _estimated(known: Recording, testbed: Testbed, track: Track, covariance: Floats) -> list[Part]:
    """Return centre of mass, residual torque and energy along the tracker's course."""
    com = standing_com(known, testbed, track.t, track.com)
    torque, torque_sd = gravity_torque(testbed, track.q, com, covariance[COM, COM])
    motion = (track.q, track.rate, com)
    energy, energy_sd = motion_energy(
        testbed, motion, track.end.inertia_P, covariance, track.rate_sd
    )
    return [
        ("com", np.column_stack([track.t, com, track.com_sd])),
        ("torque", np.column_stack([track.t, torque, torque_sd])),
        ("energy", np.column_stack([track.t, energy, energy_sd])),
    ]
