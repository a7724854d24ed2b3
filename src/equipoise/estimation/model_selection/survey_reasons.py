"""What a survey found: how noisy, how driven, what is still open."""

import numpy as np

from equipoise.actuators.lags import LAG
from equipoise.estimation.events.record_model import RecordModel, slowest
from equipoise.estimation.model_selection.cross_validation import posed_in
from equipoise.estimation.model_selection.lamp_response import follows
from equipoise.estimation.model_selection.model_choice import (
    candidates,
    is_of_sensors,
    with_group,
)
from equipoise.estimation.model_selection.term_support import is_supported
from equipoise.estimation.output_error.free_vertical import PLUMB
from equipoise.estimation.output_error.solution import evaluate
from equipoise.estimation.output_error.trajectory import Params
from equipoise.estimation.parameters.fit_parameters import CORE, sensor_sizes
from equipoise.estimation.stays_at_stop import stays
from equipoise.maths.linalg import inverse_spd
from equipoise.model import sensor_terms, torque_terms
from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import COM, Estimate
from equipoise.model.reasons.data_reasons import Unexplained
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason, axes_of
from equipoise.model.testbed import Testbed
from equipoise.sensors.at_stop import Span

NOISY = 1.3  # chosen: a noise, or a time, off by more is reported
OPEN = 5.0  # chosen: times an sd may grow by a term that is not asked for, unreported
IMPLAUSIBLE = 4.0  # sd of real sensors' errors, chosen
LEANS = 4.0  # sd, chosen: a smaller lean is corrected unreported
DRIVEN = 1 / 3  # chosen: wandering torque over gravity's, beyond which gravity's shows too little
CLOCK = sensor_terms.GROUPS[sensor_terms.GYRO_CLOCK]
GROUP_OF = {
    term: group
    for groups in (sensor_terms.GROUPS, torque_terms.GROUPS)
    for group, terms in groups.items()
    for term in terms
}


def noise_reasons(model: RecordModel) -> list[Reason]:
    """Return where sensors are noisier or quieter than stated."""
    pairs = (
        (Why.ATTITUDE_NOISE_OFF, model.testbed.attitude, model.stated.attitude),
        (Why.GYRO_NOISE_OFF, model.testbed.gyro, model.stated.gyro),
    )
    reasons: list[Reason] = []
    for code, found, stated in pairs:
        if found is None or stated is None:
            continue
        if not 1 / NOISY < found.noise / stated.noise < NOISY:
            reasons.append(Reason(code, (), {"found": found.noise, "stated": stated.noise}))
    return reasons


def added(model: RecordModel, requested: Params) -> tuple[str, ...]:
    """Return the terms that the record asked for by itself."""
    have = {*requested.sensor, *requested.terms, *PLUMB, *CLOCK}
    return tuple(t for t in (*model.params.sensor, *model.params.terms) if t not in have)


def is_open(group: tuple[str, ...], concluded: Estimate, testbed: Testbed) -> bool:
    """Say whether terms are errors of sensors that may as well be zero.

    They were added all the same: where an error is as likely there as not, com is several sd off
    without it.
    """
    if not is_of_sensors(group):
        return False
    return not is_supported(concluded, group, sensor_sizes(group, testbed))


def term_reasons(
    terms: tuple[str, ...], concluded: Estimate, testbed: Testbed
) -> tuple[Reason, ...]:
    """Return which added terms a record supports, and which errors of sensors it leaves open."""
    groups = {GROUP_OF[t]: tuple(u for u in terms if GROUP_OF[u] == GROUP_OF[t]) for t in terms}
    carried = tuple(name for name, group in groups.items() if is_open(group, concluded, testbed))
    found = reasons_of_added(tuple(t for t in terms if GROUP_OF[t] not in carried))
    return (*found, Reason(Why.TERMS_CARRIED, carried)) if carried else found


def reasons_of_added(terms: tuple[str, ...]) -> tuple[Reason, ...]:
    """Return that these terms were added, and which of them a testbed file can declare."""
    groups = tuple(dict.fromkeys(GROUP_OF[term] for term in terms))
    torques = tuple(group for group in groups if group in torque_terms.GROUPS)
    found = (Reason(Why.TERMS_ADDED, groups),) if groups else ()
    return (*found, Reason(Why.TERMS_TO_DECLARE, torques)) if torques else found


def lamp_reasons(model: RecordModel) -> list[Reason]:
    """Return how slowly a lamp warms the platform, where it is another time than stated."""
    found, stated = model.testbed.lamp, model.stated.lamp
    if not follows(model) or found is None or stated is None:
        return []
    if 1 / NOISY < found.time_constant / stated.time_constant < NOISY:
        return []
    numbers = {"found": found.time_constant, "stated": stated.time_constant}
    return [Reason(Why.LAMP_RESPONSE, (), numbers)]


def log_reasons(model: RecordModel, concluded: Estimate) -> list[Reason]:
    """Return by how much the log of the masses is late, where the record shows that it is."""
    if not any(mass.logged_late for mass in model.testbed.masses):
        return []
    lags = [p for p in concluded.parameters if p.name.startswith(LAG)]
    return [Reason(Why.LATE_LOG, (p.name,), {"late": p.value}) for p in lags]


def lean_reasons(model: RecordModel, concluded: Estimate) -> list[Reason]:
    """Return by how much the camera's vertical leans, where the record shows that it does."""
    if not set(PLUMB) <= set(model.params.sensor):
        return []
    lean, covariance = concluded.values(PLUMB), concluded.covariance_of(PLUMB)
    if lean @ np.linalg.solve(covariance, lean) < LEANS**2:
        return []
    return [Reason(Why.CAMERA_LEANS, (), {"lean": float(np.linalg.norm(lean))})]


def clock_reasons(model: RecordModel, concluded: Estimate) -> list[Reason]:
    """Return by how much the gyro's clock is fast, where the record shows that it is."""
    if not set(CLOCK) <= set(model.params.sensor):
        return []
    return [Reason(Why.GYRO_CLOCK, CLOCK, {"fast": float(concluded.values(CLOCK)[0])})]


def sensor_reasons(model: RecordModel, concluded: Estimate) -> list[Reason]:
    """Return the errors of sensors that are far larger than any real one, and not by chance.

    They may stand for another error, such as an attitude that turns the other way.
    """
    terms = model.params.sensor
    sizes = sensor_sizes(terms, model.stated)
    found = [concluded.parameters[concluded.index(term)] for term in terms]
    odd = [
        p.name
        for p, size in zip(found, sizes, strict=True)
        if abs(p.value) > IMPLAUSIBLE * size and abs(p.value) > LEANS * p.sd
    ]
    return [Reason(Why.SENSOR_IMPLAUSIBLE, tuple(odd))] if odd else []


def gravity_torque(model: RecordModel) -> float:
    """Return a typical torque of gravity in the record, N m: rms over the camera's rows."""
    observed, point = model.fitted.problem.observed, model.fitted.point
    weight = model.testbed.weight
    if not len(observed.attitude):
        return weight * float(np.linalg.norm(point.com))
    w, x, y, z = observed.attitude.T
    down: Floats = -np.column_stack(
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]
    )
    torque: Floats = weight * np.cross(point.com, down)
    off: Floats = torque - np.mean(torque, axis=0)
    return float(np.linalg.norm(off)) / len(off) ** 0.5


def driven(model: RecordModel) -> float:
    """Return the wandering torque over a swing as a share of gravity's."""
    size = float(np.linalg.norm(model.walk)) / np.sqrt(slowest(model))
    return size / max(gravity_torque(model), 1e-12)


def walk_reasons(model: RecordModel) -> list[Reason]:
    """Return how large the torque is that nothing explains."""
    if not model.wanders:
        return []
    seconds = slowest(model)
    torque = axes_of("torque", model.walk / np.sqrt(seconds))
    return [Reason(Why.TORQUE_WANDERS, (), torque | {"seconds": seconds})]


def core_sd(normal: Square) -> Floats:
    """Return the sd of inertia and com from the information on all unknowns."""
    return np.sqrt(np.diag(inverse_spd(normal)))[CORE]


def open_terms(model: RecordModel) -> tuple[Reason, ...]:
    """Return which absent terms the record could not separate from com or inertia.

    With such a term free, an sd would be more than OPEN times what it is.
    """
    names = model.fitted.problem.layout.names[CORE]
    firm, found = core_sd(model.fitted.at.normal), list[Reason]()
    for group in candidates(model):
        problem, jumps = posed_in(with_group(model, group), model.recording)
        free = core_sd(evaluate(problem, model.fitted.point, jumps).normal)
        k = int(np.argmax(free / firm))
        if free[k] > OPEN * firm[k]:
            unit = "um" if names[k] in COM else "kg m2"
            about = (names[k], group[0].split("_")[0], unit)
            found.append(Reason(Unexplained.TERM_WOULD_WIDEN, about, {"sd": float(free[k])}))
    return tuple(found)


def pressed_stays(model: RecordModel) -> list[Span]:
    """Return the stays at the stop (s) that are no turn of a swing: long, or with an event."""
    return [span for span in stays(model.recording, model.testbed) if is_pressed(model, span)]


def is_pressed(model: RecordModel, span: Span) -> bool:
    """Say whether a stay at the stop is longer than a swing's, or the fit needs an event at it."""
    start, end = span
    near = model.spacing
    pushed = any(start - near <= event.t <= end + near for event in model.events)
    return pushed or end - start > slowest(model)
