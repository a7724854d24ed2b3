"""The rooms of the package as its folders and imports have them, and the picture made from that.

``make rooms`` draws ``docs/figures/rooms.svg`` and writes the table of ``docs/architecture.md``.
"""

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from html import escape
from pathlib import Path
from textwrap import wrap

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "src" / "equipoise"
PAGE = ROOT / "docs" / "architecture.md"
PICTURE = ROOT / "docs" / "figures" / "rooms.svg"
BEGIN, END = "<!-- rooms: written by `make rooms` -->", "<!-- end of rooms -->"

# Where rooms stand in the picture: left, top, width in cells of a grid of 12 columns, and height
# in rows; a room that stands nowhere is an error.
PLACES = {
    "app": (0, 0, 12, 3), "study": (0, 3, 4, 2), "procedure": (4, 3, 5, 2),
    "planning": (0, 5, 4, 3), "simulation": (4, 5, 3, 3), "onboard": (7, 5, 2, 3),
    "estimation": (0, 8, 5, 5),
    "control": (5, 8, 2, 5), "assessment": (7, 8, 2, 5), "dynamics": (0, 13, 9, 2),
    "sensors": (0, 15, 4, 2), "actuators": (4, 15, 5, 2), "io": (9, 3, 3, 7),
    "hardware": (9, 10, 3, 7), "maths": (0, 17, 12, 2), "model": (0, 19, 12, 2),
}  # fmt: skip
CELL, ROW, GAP, MARGIN = 84, 40, 12, 14  # px
LINE, SMALL, LARGE, COLUMN, LETTER = 15, 11, 14, 165, 6.5  # px


@dataclass(frozen=True)
class Room:
    """A folder of the package: its modules, its duty and the folders in it."""

    name: str  # path below the package, with slashes
    files: int
    duty: str
    inside: tuple["Room", ...]


def room_at(folder: Path) -> Room:
    """Return the room of a folder with all rooms in it."""
    document = ast.get_docstring(ast.parse((folder / "__init__.py").read_text(encoding="utf-8")))
    inside = sorted(path.parent for path in folder.glob("*/__init__.py"))
    return Room(
        folder.relative_to(PACKAGE).as_posix(),
        sum(path.name != "__init__.py" for path in folder.glob("*.py")),
        (document or "").splitlines()[0],
        tuple(map(room_at, inside)),
    )


@cache
def rooms() -> tuple[Room, ...]:
    """Return the rooms at the top, from those that import to those that are imported."""
    found = {room.name: room for room in room_at(PACKAGE).inside}
    assert set(found) == set(PLACES), f"no place in the picture: {set(found) ^ set(PLACES)}"
    return tuple(found[name] for name in PLACES)


def all_rooms(tops: tuple[Room, ...]) -> Iterator[Room]:
    """Yield every room, each before those in it."""
    for room in tops:
        yield room
        yield from all_rooms(room.inside)


def imported(path: Path) -> Iterator[str]:
    """Yield the names of the package's modules that a file imports, anywhere in it."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("equipoise."):
            yield node.module or ""


@cache
def arrows() -> frozenset[tuple[str, str]]:
    """Return which top room imports which; an arrow that others imply is left out."""
    found: dict[str, set[str]] = {name: set() for name in PLACES}
    for path in PACKAGE.rglob("*.py"):
        room = path.relative_to(PACKAGE).parts[0]
        if room in found:
            found[room] |= {name.split(".")[1] for name in imported(path)} - {room}
    return frozenset(
        (above, below)
        for above, belows in found.items()
        for below in belows
        if not any(below in reached(found, other) for other in belows - {below})
    )


def reached(graph: dict[str, set[str]], name: str) -> set[str]:
    """Return all rooms below one."""
    return graph[name].union(*(reached(graph, other) for other in graph[name]), set())


# --- The picture -----------------------------------------------------------------------------


def box(name: str) -> tuple[float, float, float, float]:
    """Return left, top, width and height of a room's box, px."""
    left, top, width, height = PLACES[name]
    return (
        MARGIN + left * CELL, MARGIN + top * (ROW + GAP),
        width * CELL - GAP, height * (ROW + GAP) - GAP,
    )  # fmt: skip


def drawn_room(room: Room) -> Iterator[str]:
    """Yield the box of a room: its duty, and the rooms in it with the number of their files."""
    x, y, width, height = box(room.name)
    yield f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="5" class="room"/>'
    yield text(x + 10, y + 18, f"{room.name}  {room.files or ''}".strip(), "name")
    duty = wrap(room.duty, int(width / LETTER))
    for k, words in enumerate(duty):
        yield text(x + 10, y + 34 + k * LINE, words, "duty")
    names = [(each.name.removeprefix(f"{room.name}/"), each.files) for each in inner_rooms(room)]
    columns = max(int(width // COLUMN), 1)
    rows = max(-(-len(names) // columns), 1)
    for k, (name, files) in enumerate(names):
        column, row = divmod(k, rows)
        place = x + 10 + column * COLUMN, y + 38 + (len(duty) + row) * LINE
        yield text(*place, f"{name}  {files or ''}".strip(), "inner")


def inner_rooms(room: Room) -> Iterator[Room]:
    """Yield the rooms within a room that hold modules."""
    return (each for each in all_rooms(room.inside) if each.files)


def text(x: float, y: float, words: str, kind: str) -> str:
    """Return a line of text."""
    return f'<text x="{x:.0f}" y="{y:.0f}" class="{kind}">{escape(words)}</text>'


def drawn_arrow(above: str, below: str) -> str:
    """Return an arrow from the edge of one box to the edge of another."""
    (x, y, width, height), (u, v, across, down) = box(above), box(below)
    if u >= x + width and v < y + height:  # beside each other
        level = (max(y, v) + min(y + height, v + down)) / 2
        return f'<path d="M{x + width:.0f} {level:.0f} L{u:.0f} {level:.0f}" class="arrow"/>'
    shared = max(x, u), min(x + width, u + across)
    middle = sum(shared) / 2 if shared[0] < shared[1] else u + across / 2
    start = min(max(middle, x + 10), x + width - 10)
    return f'<path d="M{start:.0f} {y + height:.0f} L{middle:.0f} {v:.0f}" class="arrow"/>'


def picture() -> str:
    """Return the picture of all rooms as SVG."""
    width = 2 * MARGIN + 12 * CELL - GAP
    height = 2 * MARGIN + max(top + tall for _, top, _, tall in PLACES.values()) * (ROW + GAP) - GAP
    near = sorted(pair for pair in arrows() if touching(*pair))
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" role="img">',
        "<title>Rooms of Equipoise: each imports from rooms below it only</title>",
        "<defs><marker id='tip' viewBox='0 0 8 8' refX='7' refY='4' markerWidth='7' "
        "markerHeight='7' orient='auto'><path d='M0 0 L8 4 L0 8 z' fill='#3465a4'/></marker>"
        "</defs>",
        "<style>.room{fill:#f7f7f5;stroke:#8a8a85} .arrow{stroke:#3465a4;stroke-width:1.5;"
        "marker-end:url(#tip)} text{font-family:sans-serif;fill:#222} "
        f".name{{font-size:{LARGE}px;font-weight:bold}} "
        f".inner,.duty{{font-size:{SMALL}px}} .duty{{fill:#666}}</style>",
        f'<rect width="{width}" height="{height}" fill="#ffffff"/>',
        *(line for room in rooms() for line in drawn_room(room)),
        *(drawn_arrow(*pair) for pair in near),
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def touching(above: str, below: str) -> bool:
    """Say whether nothing stands between two boxes: their arrow crosses no other room."""
    (x, y, width, height), (u, v, across, down) = box(above), box(below)
    beneath = 0 <= v - (y + height) <= GAP and max(x, u) < min(x + width, u + across)
    beside = 0 <= u - (x + width) <= GAP and max(y, v) < min(y + height, v + down)
    return beneath or beside


def table() -> str:
    """Return the rooms as a table: files, and the duty in a sentence."""
    lines = ["| room | files | duty |", "|---|---|---|"]
    for room in all_rooms(rooms()):
        depth = "&emsp;" * room.name.count("/")
        lines.append(f"| {depth}`{room.name}` | {room.files or ''} | {room.duty} |")
    return "\n".join(lines)


def page(text_before: str) -> str:
    """Return the page with its table written anew."""
    head, rest = text_before.split(BEGIN)
    return f"{head}{BEGIN}\n\n{table()}\n\n{END}{rest.split(END)[1]}"


if __name__ == "__main__":
    PICTURE.write_text(picture(), encoding="utf-8")
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
