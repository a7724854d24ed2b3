"""Methods and laws compared: terminal, one JSON document, and a report."""

from collections.abc import Iterator

from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.study import compared_accuracy, compared_coverage, compared_torque
from equipoise.app.report.run_record import Output, RunRecord, origin
from equipoise.app.runs.comparison import Compared
from equipoise.app.text.blocks import Blocks, Claim, Section, Table
from equipoise.app.text.json_lists import COMPARE
from equipoise.app.text.json_shape import View, name_of
from equipoise.app.views.study.law_views import comparison_json, laws_csv, laws_table
from equipoise.app.views.study.method_comparison import (
    methods_csv,
    methods_json,
    shown_order,
    tables,
)
from equipoise.app.views.study.review_views import laws_table as table_3
from equipoise.app.views.study.review_views import methods_table as table_2
from equipoise.model.units import UN_M
from equipoise.study.compare_laws import Comparison
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


def all_tables(done: Compared) -> Iterator[Table]:
    """Yield every table."""
    name = done.testbed.name
    if done.methods is not None:
        yield from tables(done.methods)
        yield table_2(done.methods.methods, name)
    if done.laws is not None:
        yield laws_table(done.laws)
        yield table_3(done.laws.laws, name)


def output_of(done: Compared) -> Output:
    """Return all that is handed over."""
    return Output("compare", document(done), blocks(done), lambda: record_of(done))


def blocks(done: Compared) -> Blocks:
    """Return the tables, and below them what is recommended."""
    return (*all_tables(done), *recommendations(done))


def recommendations(done: Compared) -> Blocks:
    """Return what is recommended, and of what nothing can be."""
    return tuple(Claim(a.sentence, "good" if a.name else "caution") for a in advice(done))


def document(done: Compared) -> View:
    """Return one document: of methods, of laws, or of both."""
    methods = None if done.methods is None else methods_json(done.methods)
    laws = None if done.laws is None else comparison_json(done.laws)
    if methods is not None and laws is not None:
        return {"schema": name_of(COMPARE), "methods": methods, "laws": laws}
    return methods or laws or {}


def pictures(done: Compared) -> Iterator[Picture]:
    """Yield the figures."""
    if done.methods is not None:
        yield from method_pictures(done.methods)
    if done.laws is not None:
        yield from law_pictures(done.laws)


def law_pictures(found: Comparison) -> Iterator[Picture]:
    """Yield the torque that laws leave, if any ran."""
    if found.laws:
        laws = sorted(found.laws, key=lambda law: law.left.most)
        left = [compared_torque.Left(law.law, law.left.median / UN_M, law.left.most / UN_M)
                for law in laws]  # fmt: skip
        drawn = compared_torque.draw(left, found.required / UN_M)
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


def record_of(done: Compared) -> RunRecord:
    """Return the comparison as a report, with a file a kind, a line a run."""
    parts = {"records": done.methods, "laws": done.laws}
    left_out = {key for key, found in parts.items() if found is None}
    files: dict[str, str | bytes] = {}
    if done.methods is not None:
        files["methods.csv"] = methods_csv(done.methods.runs)
    if done.laws is not None:
        files["laws.csv"] = laws_csv(done.laws)
    return RunRecord(
        title="Methods and laws compared",
        requested={key: text for key, text in done.requested.items() if key not in left_out},
        testbed=done.testbed,
        conclusion=recommendations(done),
        sections=(Section("Results", tuple(all_tables(done))),),
        origin=origin(),
        figures=list(pictures(done)),
        files=files,
    )
