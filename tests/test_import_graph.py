"""The rooms of the package have no circle, and no folder is a warehouse."""

from pathlib import Path

import pytest

from tests.support.import_graph import circles, import_graph, inside, modules

SOURCE = Path(__file__).parents[1] / "src"
FILES, GRAPH = modules(SOURCE), import_graph(SOURCE)
ROOMS = [name for name, path in FILES.items() if path.name == "__init__.py"]
MOST = 20  # Python files in a folder
LISTS = {"app/commands", "estimation/methods", "model"}  # one file a command, a method, a noun


def test_no_module_imports_itself_by_a_detour():
    assert circles(GRAPH) == []


def test_no_room_has_a_circle_among_its_sub_rooms():
    found = {room: circles(inside(GRAPH, room)) for room in ROOMS}
    assert {room: names for room, names in found.items() if names} == {}


def test_no_folder_holds_more_files_than_one_takes_in():
    counts = {
        folder.relative_to(SOURCE / "equipoise").as_posix(): len(list(folder.glob("*.py")))
        for folder in {path.parent for path in FILES.values()}
    }
    assert {name: n for name, n in counts.items() if n > MOST and name not in LISTS} == {}


def test_every_folder_has_something_in_it():
    folders = {path.parent for path in FILES.values()}
    assert {folder for folder in folders if len(list(folder.iterdir())) < 2} == set()


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("import a.b", ["a.b"]),
        ("def f():\n    from a import b", ["a.b"]),
        ("from a import nothing", ["a"]),
        ("from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import a.b", []),
    ],
)
def test_an_import_is_observed_where_it_runs(tmp_path, text, found):
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "__init__.py").write_text("")
    (tmp_path / "a" / "b.py").write_text("")
    (tmp_path / "user.py").write_text(text)
    assert sorted(import_graph(tmp_path)["user"]) == found


def test_a_circle_has_all_its_members():
    graph = {"a": frozenset("b"), "b": frozenset("c"), "c": frozenset("a"), "d": frozenset("a")}
    assert circles(graph) == [["a", "b", "c"]]


def test_sub_rooms_count_as_one_each():
    graph = {"r.a.x": frozenset({"r.b.y"}), "r.b.z": frozenset({"r.a.x"}), "q": frozenset()}
    assert circles(graph) == []
    assert circles(inside(graph, "r")) == [["a", "b"]]
