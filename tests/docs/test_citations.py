"""A number that is cited stands in the paper for what the card is about.

The tables are the papers' own: which equations and sections there are, and of what they treat. They
were written from the papers, not from the cards.
"""

import re
from pathlib import Path

import pytest

from equipoise.control.laws.registry import LAWS
from equipoise.estimation.methods.registry import METHODS

ROOT = Path(__file__).parents[2]
REVIEW = {  # da Silva et al. 2021: first and last equation, and the topic
    (1, 3): "kinematics", (4, 5): "dynamics", (6, 6): "simplified model", (7, 7): "sizing",
    (8, 9): "simplified least squares", (10, 15): "torque", (16, 21): "momentum",
    (22, 25): "recursive", (26, 27): "filters", (28, 31): "linear filter",
    (32, 34): "filter of com", (35, 36): "filter of all", (37, 38): "complex step",
    (39, 41): "underactuated", (42, 42): "fully actuated",
}  # fmt: skip
SECTIONS = {
    "2": "dynamics", "3": "identification", "3.1": "batch", "3.1.1": "simplified least squares",
    "3.1.2": "torque", "3.1.3": "recursive", "3.1.4": "Levenberg-Marquardt", "3.2": "filters",
    "4": "active control", "4.1": "underactuated", "4.2": "fully actuated", "5": "assessment",
}  # fmt: skip
IVANOV = {"2.1", "2.2", "2.3", "2.4", "2.5", "2.6", "3.1", "5.1"}
PAPERS = {
    r"da Silva(?: et al\.)? \(?2021\)?": {str(k) for k in range(1, 43)},
    r"Ivanov(?: et al\.)? \(?2021\)?": IVANOV,
    r"Lee(?: et al\.)?": {str(k) for k in range(1, 11)},
}
ABOUT = {  # by the beginning of a name; the longest that fits counts
    "simplified": {"simplified least squares"},
    "simplified_recursive": {"simplified least squares", "recursive"},
    "torque": {"torque"},
    "torque_recursive": {"torque", "recursive"},
    "momentum": {"momentum", "batch"},
    "momentum_damped": {"momentum", "batch", "Levenberg-Marquardt"},
    "momentum_recursive": {"momentum", "recursive"},
    "td_td_rls": {"recursive"},
    "equilibrium": {"identification"},
    "kf_simplified": {"linear filter"},
    "ekf_6": {"filter of com"},
    "ekf_12": {"filter of all", "complex step"},
    "ukf_6": {"filters"},
    "ukf_12": {"filter of all"},
    "ukf_4": {"underactuated"},
    "pid": {"active control"},
    "l1_adaptive": {"active control"},
    "impulse_feedback": {"active control"},
    "parameter_adaptive": {"identification"},
    "underactuated": {"underactuated"},
    "fully_actuated": {"fully actuated"},
}
CARDS = {name: one.card.source for name, one in (*METHODS.items(), *LAWS.items())}
NUMBER = r"\d+(?:\.\d+)?(?:-\d+(?:\.\d+)?)?"
EQUATIONS = rf"Eqs?\. ({NUMBER}(?:(?:,| and|, and) {NUMBER})*)"


def subjects(name):
    """Return what a method or law may cite the review for."""
    fits = [begin for begin in ABOUT if name.startswith(begin)]
    return ABOUT[max(fits, key=len)] if fits else set()


def equations(text):
    """Return the equations that a text cites: "Eqs. 8-9 and 22" has 8, 9 and 22."""
    for found in re.findall(EQUATIONS, text):
        for part in re.findall(NUMBER, found):
            first, _, last = part.partition("-")
            whole = last and "." not in part
            yield from map(str, range(int(first), int(last) + 1)) if whole else (first,)


def topics(source):
    """Return the topics of the review's places that a source line cites."""
    for cited in re.findall(r"da Silva[^;|]*", source):
        for number in map(int, equations(cited)):
            yield next(
                (topic for (first, last), topic in REVIEW.items() if first <= number <= last),
                f"no equation {number}",
            )
        for section in re.findall(r"section (\d(?:\.\d)*)", cited):
            yield SECTIONS.get(section, f"no section {section}")


def test_the_tables_leave_no_equation_out():
    numbers = [k for first, last in REVIEW for k in range(first, last + 1)]
    assert numbers == list(range(1, 43))


@pytest.mark.parametrize("name", [name for name, source in CARDS.items() if "da Silva" in source])
def test_a_card_cites_what_treats_of_it(name):
    found = set(topics(CARDS[name]))
    assert found
    assert found <= subjects(name)


@pytest.mark.parametrize(
    ("name", "source"),
    [
        ("pid", "da Silva et al. 2021, section 5"),
        ("underactuated", "da Silva 2021 Eqs. 39-42"),
        ("ukf_6", "da Silva 2021 Eq. 38"),
        ("simplified", "da Silva 2021 Eqs. 7-21"),
    ],
)
def test_a_wrong_place_is_found(name, source):
    """Four that stood here once."""
    assert not set(topics(source)) <= subjects(name)


def test_the_tables_of_methods_and_laws_cite_as_the_cards_do():
    rows = [
        line.strip("| ").split(" | ")
        for page in (ROOT / "docs" / "methods.md", ROOT / "docs" / "laws.md")
        for line in page.read_text("utf-8").splitlines()
        if line.startswith("| `")
    ]
    checked = 0
    for row in rows:
        names = re.findall(r"`(\w+)`", row[0])
        stem = names[0].partition("_")[0]
        allowed = {s for n in names for s in subjects(stem + n if n[0] == "_" else n)}
        assert set(topics(row[-1])) <= allowed, row
        checked += "da Silva" in row[-1]
    assert checked > 5


def test_every_equation_that_is_cited_exists():
    """Of the three papers, in code, documents and tests of them."""
    texts = [*(ROOT / "src").rglob("*.py"), *(ROOT / "docs").glob("*.md"), ROOT / "README.md"]
    cited, wrong = 0, []
    for path in texts:
        text = " ".join(path.read_text("utf-8").split())
        for paper, known in PAPERS.items():
            for found in re.findall(rf"\b{paper},? {EQUATIONS}", text):
                numbers = list(equations(f"Eqs. {found}"))
                cited += len(numbers)
                wrong += [f"{path.name}: {paper} {n}" for n in numbers if n not in known]
    assert cited > 100
    assert wrong == []
