"""`equipoise identify`: mass properties from a recording."""

from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.terminal import busy, stdout, tell_paths, watched

if TYPE_CHECKING:
    from collections.abc import Sequence

    from equipoise.app.account import Account
    from equipoise.assessment.finding import Finding
    from equipoise.model.estimate import Estimate
    from equipoise.model.recording import Recording
    from equipoise.model.step import Step
    from equipoise.model.testbed import Testbed


def identify(
    file: str,
    /,
    *,
    testbed: str,
    method: str = "auto",
    hold: tuple[str, ...] = (),
    term: tuple[str, ...] = (),
    prior: bool = False,
    robust: bool = False,
    from_s: float | None = None,
    to_s: float | None = None,
    dialect: str | None = None,
    columns: str | None = None,
    json: bool = False,
    out: Path | None = None,
) -> int:
    """Estimate centre of mass and inertia from a recording, and say what it cannot show.

    Ends with 1 when the estimate is not usable; the sentence under the tables says why.

    Parameters
    ----------
    file
        Recording, as CSV or Parquet.
    testbed
        Testbed file, or a preset's name.
    method
        auto, trajectory, momentum_body, momentum_laboratory, equilibrium or tracker.
    hold
        Parameter to keep at the testbed's value, such as inertia_P_zz. May be repeated.
    term
        Torque to estimate too: viscous, quadratic, constant, swirl, sag or drift. May be repeated.
    prior
        Use the testbed's inertia and centre of mass with their sd; this fixes an open scale.
    robust
        Give rows that stand far off less weight.
    from_s
        Leave out what is before this time.
    to_s
        Leave out what is after this time.
    dialect
        How to read the table: native, optitrack or ros. Left out: by its header.
    columns
        Column map (TOML) for a table of any other kind.
    json
        Print one JSON document instead.
    out
        Folder for figures, report.html and estimate.json.
    """
    from equipoise.app.archive import write_account
    from equipoise.app.options import one_of
    from equipoise.app.views_json import dump, estimate_json
    from equipoise.app.wiring import fitting_recording_of, part_of, testbed_of
    from equipoise.assessment.record_findings import findings
    from equipoise.io.whole_folder import check_folder
    from equipoise.model.estimate import COM, INERTIA
    from equipoise.model.torque_terms import expand

    bed, terms = testbed_of(testbed), expand(term, "--term")
    for name in hold:
        one_of("--hold", name, [*COM, *INERTIA])
    if out is not None:
        check_folder(out)
    recording = part_of(fitting_recording_of(file, dialect, columns, bed), from_s, to_s)
    found = findings(recording, bed)
    with busy("identifying", announce=False):
        from equipoise.procedure.identify import METHODS, IdentifyOptions
        from equipoise.procedure.identify import identify as procedure

        one_of("--method", method, ["auto", *METHODS])
        options = IdentifyOptions(method, terms, hold, prior, robust)
        steps = procedure(recording, bed, options)
    if not json:
        _show_findings(found)
    done = list(watched(steps, "identifying"))
    estimate = done[-1].estimate
    assert estimate is not None
    if json:
        print(dump(estimate_json(estimate, found)))
    else:
        _show(done, estimate)
    if out is not None:
        with busy("drawing"):
            account = _account(recording, bed, found, done)
            document = estimate_json(estimate, found)
            paths = write_account(account, document, "estimate", out)
        tell_paths(paths, json)
    return 0 if estimate.outcome.usable else 1


def _show_findings(found: "Sequence[Finding]") -> None:
    from equipoise.app.tables import finding_line

    console = stdout()
    for finding in found:
        console.print(finding_line(finding))


def _show(steps: "Sequence[Step]", estimate: "Estimate") -> None:
    """Print what was done, the tables, what was not seen, and the sentence that sums it up."""
    from equipoise.app.tables import estimate_tables, residual_line, step_line

    console = stdout()
    console.print()
    for step in steps:
        console.print(step_line(step))
    for table in estimate_tables(estimate):
        console.print()
        console.print(table)
    console.print()
    for sentence in estimate.unobservable:
        console.print(f"not seen: {sentence}", style="yellow", markup=False)
    if estimate.residual is not None:
        console.print(residual_line(estimate.residual), markup=False)
    style = "bold green" if estimate.outcome.usable else "bold red"
    console.print(estimate.outcome.sentence, style=style, markup=False)


def _account(
    recording: "Recording",
    testbed: "Testbed",
    found: "Sequence[Finding]",
    steps: "Sequence[Step]",
) -> "Account":
    from equipoise.app.account import Account, origin
    from equipoise.app.pictures import of_estimate

    estimate = steps[-1].estimate
    assert estimate is not None
    return Account(
        title="Mass properties from a recording",
        asked={"recording": recording.source, "method": estimate.method},
        testbed=testbed,
        chapters={"Steps": steps},
        origin=origin(sha256=recording.sha256),
        findings=found,
        estimate=estimate,
        pictures=list(of_estimate(recording, testbed, estimate)),
    )
