"""What verbs take, resolved: testbeds, recordings and plans as records, or where to find them."""

from collections.abc import Sequence
from pathlib import Path

from equipoise.actuators.stored_momentum import with_known_inputs
from equipoise.app.arguments.checks import one_of
from equipoise.estimation.method_contract import Options
from equipoise.io.documents.plan_file import read_plan
from equipoise.io.recording.frame_check import check_frame
from equipoise.io.recording.recording_file import check_names, read_recording
from equipoise.io.testbed.presets import preset_names, read_preset
from equipoise.io.testbed.testbed_file import read_testbed
from equipoise.model.errors import InputError, nearest
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.manoeuvre import Plan
from equipoise.model.recording import Recording, arranged, arranged_devices, window
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import expand

AnyTestbed = Testbed | str | Path  # a path goes before a preset's name
AnyRecording = Recording | str | Path
AnyPlan = Plan | str | Path
FEWEST = 3  # rows of a sensor that a window must leave, as when a file is read


def testbed_from(testbed: AnyTestbed) -> Testbed:
    """Return the testbed itself, of a file, or of a preset when there is no such file."""
    if isinstance(testbed, Testbed):
        return testbed
    path, name = Path(testbed), str(testbed)
    if not path.exists() and name in preset_names():
        return read_preset(name)
    if not path.exists() and path.name == name and not path.suffix:
        wanted = f"a testbed file, or a preset ({nearest(name, list(preset_names()))})"
        raise InputError("testbed", f"'{name}', which is no file", wanted)
    return read_testbed(path)


def testbed_with_masses(testbed: AnyTestbed) -> Testbed:
    """Return a testbed; InputError if it has no masses or no sensor."""
    bed = testbed_from(testbed)
    if not bed.masses:
        raise InputError(bed.source, "no sliding masses", "a [[sliding_mass]] at least")
    if bed.attitude is None and bed.gyro is None:
        raise InputError(bed.source, "no sensor", "[sensor.attitude] or [sensor.gyro]")
    return bed


def recording_from(recording: AnyRecording, testbed: Testbed) -> Recording:
    """Return a recording, or that of a file, from where the platform was let go, fitted."""
    if not isinstance(recording, Recording):
        recording = read_recording(recording, None, testbed)
    return part_of(fitted(recording, testbed), None, None)


def fitted(recording: Recording, testbed: Testbed) -> Recording:
    """Return a recording that fits a testbed: masses and devices are its, gravity points down.

    Fitted again it stays as it is.
    """
    check_names(recording, testbed)
    check_frame(recording, testbed)
    recording = arranged(recording, testbed.mass_names)
    return with_known_inputs(arranged_devices(recording, testbed.devices), testbed)


def part_of(recording: Recording, start: float | None, end: float | None) -> Recording:
    """Return the part between two times (s); one that is left out stands for the end there is.

    A bench's own record begins where the platform was let go, unless another time is given.
    What is known of times that no sensor saw is left out: a move behind the last row, say.
    """
    first, last = recording.span
    start = recording.free_from if start is None else start
    part = window(recording, first if start is None else start, last if end is None else end)
    if max(len(c) for c in (part.attitude, part.rate, ()) if c is not None) < FEWEST:
        found = f"fewer than {FEWEST} rows between --from-s and --to-s"
        raise InputError(recording.source, found, f"times within {first:g} to {last:g} s")
    return part


def plan_from(plan: AnyPlan, testbed: Testbed) -> Plan:
    """Return a plan, or that of a file; InputError for what the testbed cannot do."""
    return plan if isinstance(plan, Plan) else read_plan(plan, testbed)


def options_from(
    terms: Sequence[str], hold: Sequence[str], use_prior: bool = False, robust: bool = False
) -> Options:
    """Return the options of a fit, composed terms spelt out; unknown names are refused."""
    for name in hold:
        one_of("hold", name, [*COM, *INERTIA])
    return Options(expand(tuple(terms), "terms"), tuple(hold), use_prior, robust)
