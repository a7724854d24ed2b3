"""A record for methods to be compared on: one platform of a testbed, its truth, and its bound.

The platform is drawn by the seed within what the testbed's [truth] says, and let go so that it
meets no stop where it can be, as `equipoise simulate` does. Rows are prepared as `equipoise
identify` prepares them (``procedure.sound_rows``).

    truth   com with the masses at home when the record begins, com as they stand when it ends, and
            the inertia about P with the masses at home; elastic sag is part of com unless it is
            sought (``SimulatedBench.truth``)
    bound   the Cramer-Rao bound at that truth, for a fit with the same options

No method knows any of this.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from equipoise.dynamics.sag_trim import SAG_TERMS
from equipoise.estimation.information.information_matrix import least_sd
from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.trajectory import params_of
from equipoise.estimation.output_error.trajectory import Params
from equipoise.estimation.parameters.fit_parameters import Unknowns
from equipoise.maths import pseudo_inertia
from equipoise.maths.linalg import pack_symmetric
from equipoise.model import sensor_terms
from equipoise.model.arrays import Vector3, Vector6
from equipoise.model.estimate import COM, END, INERTIA
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.procedure.steps.clean_record import sound
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.carried_out import Moves, recorded
from equipoise.simulation.draw_truth import SimulatedPlatform
from equipoise.simulation.free_start import freely


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """What is recorded of each platform, and the options of the methods."""

    testbed: Testbed
    duration: float  # s
    moves: Moves  # s, m
    options: Options


@dataclass(frozen=True, slots=True, eq=False)
class JudgedRecord:
    """What methods get, and what they are judged by."""

    recording: Recording
    testbed: Testbed  # sensors as the rows show them
    options: Options
    truth: Mapping[str, float]  # by parameter, SI
    bound: Mapping[str, float]  # sd by parameter, SI; infinite: the record does not show it
    met_stop: bool = False  # the platform did: no method and no bound knows of it


def judged_record(scene: Scene, seed: int) -> JudgedRecord:
    """Return the record of a seed; InputError for moves that the platform cannot make."""
    params = params_of(scene.testbed, scene.options)
    sags = bool(set(SAG_TERMS) & set(params.terms))

    def watched(bench: SimulatedBench) -> tuple[Vector3, Vector6, Recording]:
        home, inertia = com_of(bench, sags), pack_symmetric(bench.truth().inertia_P)
        return home, inertia, recorded(bench, scene.duration, scene.moves)

    bench, (home, inertia, whole) = freely(scene.testbed, seed, watched)
    values = map(float, (*home, *com_of(bench, sags), *inertia))
    truth = dict(zip((*COM, *END, *INERTIA), values, strict=True))
    recording, testbed = sound(whole, scene.testbed)
    bound = bounds(recording, testbed, params, bench.platform)
    met_stop = bool(bench.touches)
    return JudgedRecord(recording, testbed, scene.options, truth, bound, met_stop)


def com_of(bench: SimulatedBench, sags: bool) -> Vector3:
    """Return the centre of mass now, m; of a fit that seeks sag too, or of one that does not."""
    return bench.com if sags else bench.truth().com


def bounds(
    recording: Recording, testbed: Testbed, params: Params, platform: SimulatedPlatform
) -> dict[str, float]:
    """Return the bound of centre of mass, at home and at the end, and of inertia."""
    six = pseudo_inertia.from_inertia(platform.body.inertia_C)
    truth = Unknowns(
        platform.attitude, platform.rate, six, platform.body.com, platform.torque,
        np.zeros(len(sensor_terms.TERMS)), np.zeros(0), platform.truth.gyro_bias,
    )  # fmt: skip
    found = least_sd(recording, testbed, params, truth)
    found = dict(zip(END, (found[name] for name in COM), strict=True)) | found
    return {name: found[name] for name in (*COM, *END, *INERTIA) if name not in params.hold}
