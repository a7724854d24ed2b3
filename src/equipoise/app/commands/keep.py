"""`equipoise keep`: masses keep a platform balanced while an experiment runs on it."""

from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from equipoise.app.arguments.options import Json, Listed, Triple, Whole
from equipoise.app.commands.on_bench import SIMULATED, OnBench, check_on_bench, let_go, prepare
from equipoise.app.console.terminal import announced, busy, stderr
from equipoise.model.errors import InputError

if TYPE_CHECKING:
    from equipoise.app.live.feed_forward import Listener
    from equipoise.app.runs.keeping import Keeping, Session
    from equipoise.model.testbed import Testbed
    from equipoise.procedure.balancing.hold import HoldOptions

HOST = "127.0.0.1"


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class Experiment:
    """What the experiment tolerates of the masses.

    Attributes
    ----------
    most_torque_un_m
        Greatest torque that moving masses may add, rms in any second, in uN m.
    most_torque_rate_un_m_s
        Greatest rate at which they may change the torque of gravity, in uN m/s.
    quiet
        Time of the day in which masses stand still, such as 22:00-06:30. May be repeated.
    experiment_port
        UDP port of this computer on which the experiment says hold, free or done.
    feed_forward
        HOST:PORT to send gravity's torque to in UDP datagrams, for the experiment's controller.
    """

    most_torque_un_m: float = 2.0
    most_torque_rate_un_m_s: float | None = None
    quiet: Listed = ()
    experiment_port: Whole | None = None
    feed_forward: str | None = None


USUAL = Experiment()


def keep(
    testbed: str,
    /,
    *,
    lasts: Annotated[str, Parameter(name="--for")] = "30min",
    target_um: Triple = (0.0, 0.0, -100.0),
    tolerance_um: Triple = (3.0, 3.0, 3.0),
    experiment: Experiment = USUAL,
    seed: Whole = 1,
    resume: Path | None = None,
    on_bench: OnBench = SIMULATED,
    json: Json = False,
    out: Path | None = None,
) -> int:
    """Keep a platform balanced while an experiment runs on it.

    The platform is balanced first. Then masses follow drift and heat, slowly enough not to disturb
    the experiment, and stand still when it says so. Simulated; with --bench the real platform.
    Exit code 1: the centre of mass was not within tolerance all the time, or that is not known.

    Parameters
    ----------
    testbed
        Testbed file, or a preset's name.
    lasts
        How long to keep the balance: 2h, 90min, 1800s.
    target_um
        Target of the centre of mass, from the centre of rotation, body axes.
    tolerance_um
        Tolerance around the target along each axis.
    seed
        Random seed of a simulated platform.
    resume
        Folder of a keep that was interrupted: continue it, with its target and the time left.
    out
        Folder for report, keep.json and held.json. If omitted: a folder of its own in
        equipoise-runs.
    """
    from equipoise.app.arguments.checks import check_outputs, seed_of
    from equipoise.app.arguments.inputs import testbed_from

    check_on_bench(on_bench)
    bed, drawn = announced(testbed_from(testbed)), seed_of(seed)
    check_outputs(out)
    with busy("preparing the bench", announce=False), ExitStack() as held:
        from equipoise.app.logbook.output import hand_over, show_report
        from equipoise.app.logbook.run_folder import own_folder
        from equipoise.app.report.write import write_output
        from equipoise.app.runs.keeping import Session, interrupted
        from equipoise.app.views.balancing.keep_views import output_of

        options = _options(lasts, target_um, tolerance_um, experiment, held)
        listener = _listener(experiment, held)
        begun = None if resume is None else interrupted(resume, bed)
        folder = out or own_folder("keep", bed.name)
        if folder is not None:
            folder.mkdir(parents=True, exist_ok=True)
        session, opened = Session(options, begun, folder, listener), held.pop_all()
    with opened:
        done = _run(bed, session, drawn, on_bench, show=not json)
    hand_over(output_of(done), json, None, below=True)
    if folder is not None:
        with busy("writing the report", announce=False):
            show_report(write_output(output_of(done), folder), json)
    return done.stopped_with or (0 if done.verdict.passed else 1)


def _options(
    lasts: str, target_um: Triple, tolerance_um: Triple, experiment: Experiment, held: ExitStack
) -> "HoldOptions":
    """Return the options of the hold, checked; the port of the experiment is open then."""
    from datetime import datetime

    from equipoise.app.arguments.checks import positive, tolerance, vector
    from equipoise.app.arguments.durations import duration_from, quiet_times
    from equipoise.app.runs.balancing import Goal
    from equipoise.app.runs.keeping import options_for
    from equipoise.hardware.transport.experiment_port import ExperimentPort
    from equipoise.model.units import UM, UN_M
    from equipoise.procedure.balancing.hold import HoldOptions
    from equipoise.procedure.balancing.motion_budget import MotionBudget
    from equipoise.procedure.balancing.schedule import Schedule, always_free

    duration = duration_from("--for", lasts)
    goal = Goal(vector("--target-um", target_um, UM), tolerance("--tolerance-um", tolerance_um, UM))
    torque = positive("--most-torque-un-m", experiment.most_torque_un_m) * UN_M
    rate = positive("--most-torque-rate-un-m-s", experiment.most_torque_rate_un_m_s)
    budget = MotionBudget(torque) if rate is None else MotionBudget(torque, rate * UN_M)
    quiet = quiet_times("--quiet", experiment.quiet, datetime.now())
    says = always_free
    if experiment.experiment_port is not None:
        port = experiment.experiment_port
        if not 0 <= port < 2**16:
            raise InputError("--experiment-port", str(port), "0 to 65535")
        says = held.enter_context(ExperimentPort(HOST, port))
        host, port = says.address
        stderr().print(f"the experiment may say hold, free or done to udp:{host}:{port}")
    wanted = HoldOptions(duration=duration, motion=budget, schedule=Schedule(says, quiet))
    return options_for(goal, duration, wanted)


def _listener(experiment: Experiment, held: ExitStack) -> "Listener | None":
    """Return where gravity's torque is sent; the port is open then."""
    if experiment.feed_forward is None:
        return None
    from equipoise.app.arguments.feeding import address_of
    from equipoise.app.live.feed_forward import DatagramStream

    return held.enter_context(DatagramStream(*address_of(experiment.feed_forward)))


def _run(
    bed: "Testbed", session: "Session", seed: int, on_bench: OnBench, *, show: bool
) -> "Keeping":
    """Keep the simulated platform, or the real one, and show each step."""
    from equipoise.app.runs.balancing import Goal, Limits
    from equipoise.app.runs.keeping import run
    from equipoise.app.runs.terminal_balancing import at_terminal
    from equipoise.app.runs.terminal_waiting import show_step
    from equipoise.simulation.bench import SimulatedBench

    start, standing = session.start, None
    if start is not None:
        session = replace(session, options=start.options(session.options))
        standing = start.standing(bed)
    shown, through = show_step if show else None, at_terminal(bed)
    if not on_bench.bench:
        return run(SimulatedBench(bed, seed, standing), session, shown, through)
    prepare(bed, Goal(session.options.target, session.options.tolerance), Limits(), on_bench)
    with let_go(bed, on_bench, standing) as bench:
        return run(bench, session, shown, through)
