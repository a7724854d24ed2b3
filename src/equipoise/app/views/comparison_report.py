"""Methods and laws compared: terminal, one JSON document, and the files of a folder."""

from collections.abc import Iterator

from rich.text import Text

from equipoise.app.console.rich_tables import show_sheet
from equipoise.app.console.terminal import stdout
from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.study import compared_accuracy, compared_coverage, compared_torque
from equipoise.app.report.run_record import Account, origin
from equipoise.app.report.write import Files
from equipoise.app.report.write import files_of as report_files
from equipoise.app.runs.comparison import Compared
from equipoise.app.text.json_document import View, dump
from equipoise.app.text.sheet import Sheet
from equipoise.app.text.units import MICRO
from equipoise.app.views.law_views import comparison_json, laws_csv, laws_sheet
from equipoise.app.views.method_comparison import methods_csv, methods_json, sheets, shown_order
from equipoise.app.views.review_views import laws_sheet as table_3
from equipoise.app.views.review_views import methods_sheet as table_2
from equipoise.model.verdict import Verdict
from equipoise.study.compare_methods import MethodComparison
from equipoise.study.recommend import Advice, advised_law, advised_method, least_share


def advice(done: Compared) -> list[Advice]:
    """Return what is recommended."""
    reported = list[Advice]()
    if done.methods is not None:
        reported.append(advised_method(done.methods.methods, "com"))
        if any(method.inertia.stated.part for method in done.methods.methods):
            reported.append(advised_method(done.methods.methods, "inertia"))
    if done.laws is not None:
        reported.append(advised_law(done.laws))
    return reported


def all_sheets(done: Compared) -> Iterator[Sheet]:
    """Yield every table."""
    name = done.testbed.name
    if done.methods is not None:
        yield from sheets(done.methods)
        yield table_2(done.methods.methods, name)
    if done.laws is not None:
        yield laws_sheet(done.laws)
        yield table_3(done.laws.laws, name)


def show(done: Compared) -> None:
    """Print the tables, and below them what is recommended."""
    console = stdout()
    for sheet in all_sheets(done):
        show_sheet(sheet)
    console.print()
    for each in advice(done):
        console.print(Text(each.sentence, style="bold" if each.name else "bold yellow"))


def document(done: Compared) -> View:
    """Return one document: of methods, of laws, or of both, schema equipoise/compare/1."""
    methods = None if done.methods is None else methods_json(done.methods)
    laws = None if done.laws is None else comparison_json(done.laws)
    if methods is not None and laws is not None:
        return {"schema": "equipoise/compare/1", "methods": methods, "laws": laws}
    return methods or laws or {}


def pictures(done: Compared) -> Iterator[Picture]:
    """Yield the figures."""
    if done.methods is not None:
        yield from method_pictures(done.methods)
    if done.laws is not None and done.laws.laws:
        laws = sorted(done.laws.laws, key=lambda law: law.left.most)
        left = [compared_torque.Left(law.law, law.left.median * MICRO, law.left.most * MICRO)
                for law in laws]  # fmt: skip
        drawn = compared_torque.draw(left, done.laws.required * MICRO)
        yield Picture("laws_torque", compared_torque.CAPTION, drawn)


def method_pictures(found: MethodComparison) -> Iterator[Picture]:
    """Yield accuracy and coverage of the methods that have any."""
    order = shown_order(found)
    ratios = [compared_accuracy.Accuracy(m.method, m.com.rmse, m.inertia.rmse, m.failed > 0)
              for m in order if m.com.stated.part or m.inertia.stated.part]  # fmt: skip
    if ratios:
        drawn = compared_accuracy.draw(ratios)
        yield Picture("methods_accuracy", compared_accuracy.CAPTION, drawn)
    shares = [compared_coverage.Coverage(m.method, m.coverage.value, least_share(m.trusted))
              for m in order if m.coverage.of]  # fmt: skip
    if shares:
        drawn = compared_coverage.draw(shares)
        yield Picture("methods_coverage", compared_coverage.CAPTION, drawn)


def files_of(done: Compared) -> Files:
    """Return compare.json, methods.csv, laws.csv, the figures and the report."""
    drawn = list(pictures(done))
    reported = advice(done)
    parts = {"records": done.methods, "laws": done.laws}
    left_out = {key for key, found in parts.items() if found is None}
    account = Account(
        title="Methods and laws compared",
        requested={key: text for key, text in done.requested.items() if key not in left_out},
        testbed=done.testbed,
        chapters={},
        origin=origin(),
        verdict=Verdict(all(a.name for a in reported), " ".join(a.sentence for a in reported)),
        pictures=drawn,
        sheets=tuple(all_sheets(done)),
    )
    files = report_files(account) | {"compare.json": dump(document(done)) + "\n"}
    if done.methods is not None:
        files["methods.csv"] = methods_csv(done.methods.runs)
    if done.laws is not None:
        files["laws.csv"] = laws_csv(done.laws)
    return files
