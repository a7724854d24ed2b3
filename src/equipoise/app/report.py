"""The report of a run: one HTML page that needs no other file. It adds no number of its own."""

import base64
from collections.abc import Iterable, Iterator, Mapping, Sequence
from html import escape
from importlib.resources import files
from string import Template

from equipoise.app.account import Account
from equipoise.app.change import HEADS, rows
from equipoise.app.numbers import fixed
from equipoise.app.pictures import Picture
from equipoise.app.tables import cells, groups, residual_line
from equipoise.app.units import GRAM, MM, PER_DEG
from equipoise.model.estimate import Estimate
from equipoise.model.testbed import Testbed

PAGE = Template((files("equipoise.app") / "report.html").read_text(encoding="utf-8"))
TYPESET = {
    "um": "µm",
    "uN m": "µN m",
    "uN m s": "µN m s",
    "uN m s2": "µN m s²",
    "um/min": "µm/min",
    "kg m2": "kg m²",
    "um/(kg m2)": "µm/(kg m²)",
}


def report(account: Account, images: Mapping[str, bytes]) -> str:
    """Return the page; ``images`` are the account's pictures as PNG, by name."""
    parts = [part for section in SECTIONS for part in section(account)]
    parts += [*_figures(account.pictures, images), *_origin(account)]
    title = escape(account.title)
    return PAGE.substitute(
        title=title, platform=escape(account.testbed.name), body="\n".join(parts)
    )


def _verdict(account: Account) -> Iterator[str]:
    if account.verdict is not None:
        good, sentence = account.verdict.passed, account.verdict.sentence
    elif account.estimate is not None:
        good, sentence = account.estimate.outcome.usable, account.estimate.outcome.sentence
    else:
        return
    yield f'<p class="verdict {"good" if good else "bad"}">{escape(sentence)}</p>'


def _change(account: Account) -> Iterator[str]:
    if account.change is None:
        return
    lines = [list(row) for row in rows(account.change)]
    last = len(HEADS) if any(line[-1] for line in lines) else len(HEADS) - 2
    yield _section("Before and after", _table(HEADS[:last], (line[:last] for line in lines)))


def _asked(account: Account) -> Iterator[str]:
    yield _section("What was asked", _pairs(account.asked))


def _platform(account: Account) -> Iterator[str]:
    bed = account.testbed
    masses = [
        [
            mass.name,
            f"{mass.mass * GRAM:.4g}",
            f"{mass.travel[0] * MM:g} to {mass.travel[1] * MM:g}",
            f"{mass.resolution * MM:g}",
            f"{mass.accuracy * MM:g}",
        ]
        for mass in bed.masses
    ]
    heads = ("sliding mass", "g", "travel, mm", "step, mm", "accuracy (1 sd), mm")
    body = _pairs(_platform_pairs(bed)) + (_table(heads, masses) if masses else "")
    if bed.assumed:
        body += "<h3>Assumed, not measured</h3>" + _pairs(bed.assumed)
    yield _section("Platform", body)


def _platform_pairs(bed: Testbed) -> dict[str, str]:
    pairs = {"file": bed.source, "mass": f"{bed.body.mass:.5g} kg"}
    if bed.attitude is not None:
        noise = f"{bed.attitude.noise * PER_DEG:.3g} deg (1 sd)"
        pairs["camera"] = f"{bed.attitude.rate:g} Hz, {noise}"
    if bed.gyro is not None:
        pairs["gyro"] = f"{bed.gyro.rate:g} Hz, {bed.gyro.noise * PER_DEG:.3g} deg/s (1 sd)"
    return pairs


def _findings(account: Account) -> Iterator[str]:
    if account.findings:
        lines = ((f.kind, f.sentence) for f in account.findings)
        yield _section("What the recording holds", _table(("", ""), lines))


def _steps(account: Account) -> Iterator[str]:
    for title, steps in account.chapters.items():
        lines = ((fixed(s.time, 1), s.kind, s.sentence) for s in steps)
        yield _section(title, _table(("time, s", "", ""), lines))


def _sheets(account: Account) -> Iterator[str]:
    for sheet in account.sheets:
        remarks = "".join(f"<p>{escape(remark)}</p>" for remark in sheet.remarks)
        yield _section(sheet.title, _table(sheet.heads, sheet.lines, sheet.words[1:]) + remarks)


def _mass_properties(account: Account) -> Iterator[str]:
    if account.estimate is None:
        return
    heads = ("", "value", "sd", "95 % interval", "unit")
    body = [f"<p>{escape(account.estimate.outcome.sentence)}</p>"]
    for title, group in groups(account.estimate):
        if group:
            body += [f"<h3>{escape(title)}</h3>", _table(heads, map(cells, group))]
    if account.estimate.residual is not None:
        body.append(f"<p>{escape(residual_line(account.estimate.residual))}</p>")
    yield _section("Mass properties", "".join(body))


def _unseen(account: Account) -> Iterator[str]:
    if account.estimate is not None:
        yield _section("What the data cannot see", _unseen_list(account.estimate))


def _unseen_list(estimate: Estimate) -> str:
    if not estimate.unobservable:
        return "<p>Every quantity above was seen in the data or given beforehand.</p>"
    return "<ul>" + "".join(f"<li>{escape(s)}</li>" for s in estimate.unobservable) + "</ul>"


def _figures(pictures: Sequence[Picture], images: Mapping[str, bytes]) -> Iterator[str]:
    if pictures:
        yield _section("Figures", "".join(_figure(p, images[p.name]) for p in pictures))


def _figure(picture: Picture, image: bytes) -> str:
    data = base64.b64encode(image).decode()
    source = f'<img alt="{escape(picture.name)}" src="data:image/png;base64,{data}">'
    return f"<figure>{source}<figcaption>{escape(picture.caption)}</figcaption></figure>"


def _origin(account: Account) -> Iterator[str]:
    yield _section("Where this comes from", _pairs(account.origin))


SECTIONS = (
    _verdict,
    _change,
    _asked,
    _platform,
    _findings,
    _steps,
    _sheets,
    _mass_properties,
    _unseen,
)


def _section(title: str, body: str) -> str:
    return f"<section><h2>{escape(title)}</h2>{body}</section>"


def _pairs(pairs: Mapping[str, str]) -> str:
    cells_ = (f"<dt>{escape(k)}</dt><dd>{escape(v)}</dd>" for k, v in pairs.items())
    return f"<dl>{''.join(cells_)}</dl>"


def _table(heads: Sequence[str], lines: Iterable[Sequence[str]], words: Sequence[int] = ()) -> str:
    """Return a table; columns of ``words`` may be folded."""
    head = "".join(f"<th>{escape(h)}</th>" for h in heads) if any(heads) else ""
    body = "".join(
        "<tr>" + "".join(_cell(c, k in words) for k, c in enumerate(line)) + "</tr>"
        for line in lines
    )
    top = f"<thead><tr>{head}</tr></thead>" if head else ""
    return f'<div class="wide"><table>{top}<tbody>{body}</tbody></table></div>'


def _cell(text: str, words: bool) -> str:
    kind = ' class="words"' if words else ""
    return f"<td{kind}>{escape(TYPESET.get(text, text))}</td>"
