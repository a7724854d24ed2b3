"""`equipoise keep`: balanced, kept, stopped by its experiment, and resumed."""

import contextlib
import json
import socket
import threading

import numpy as np
import pytest

from equipoise.app.cli import run
from equipoise.io.documents.held_file import read_held, write_held


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    """The exit code of two minutes of keeping, and its folder."""
    folder = tmp_path_factory.mktemp("kept")
    words = ["keep", "nanosat", "--for", "2min", "--json", "--out", str(folder), "--seed", "3"]
    return run(words), folder


@pytest.fixture
def folder(kept):
    return kept[1]


def test_a_platform_is_kept_and_reported(kept, strict_json):
    code, folder = kept
    document = strict_json((folder / "keep.json").read_text(encoding="utf-8"))
    assert code == (0 if document["verdict"]["passed"] else 1)
    assert document["schema"] == "equipoise/keep/1"
    assert document["verdict"]["code"] in ("held", "hold_undecided")
    assert document["verdict"]["reasons"][0]["numbers"]["duration"] == pytest.approx(120.0)
    assert len(document["t_s"]) == 2
    off = np.abs(np.array(document["com_m"]) - document["truth_m"])
    assert np.all(off < 4 * np.array(document["sd_m"]) + 1e-7)
    last = [step for step in document["steps"] if step["kind"] == "estimate"][-1]
    assert [reason["code"] for reason in last["reasons"]] == ["com_at", "com_drifts"]
    assert "What moves it, at the last report" in (folder / "report.html").read_text("utf-8")
    assert list(folder.glob("figures/kept_com*"))


def test_what_is_printed_is_what_is_kept(equipoise, strict_json, tmp_path):
    done = equipoise("keep", "nanosat", "--for", "20s", "--json", "--out", tmp_path / "one")
    kept = json.loads((tmp_path / "one" / "keep.json").read_text(encoding="utf-8"))
    assert strict_json(done.out)["verdict"] == kept["verdict"]


def test_an_interrupted_keep_goes_on_with_its_goal_and_the_time_left(
    equipoise, strict_json, folder, tmp_path
):
    """The platform of another seed stands for the same one, let go anew: com is found again."""
    held = read_held(folder)
    assert 0 < held.left_s < 120
    write_held(held, tmp_path)
    done = equipoise("keep", "nanosat", "--resume", tmp_path, "--json", "--out", tmp_path / "new",
                     "--seed", "3")  # fmt: skip
    document = strict_json(done.out)
    assert document["verdict"]["reasons"][0]["numbers"]["duration"] == pytest.approx(held.left_s)
    assert document["steps"][0]["kind"] in ("estimate", "verify")  # it was not balanced again


def test_a_keep_of_another_testbed_is_refused(equipoise, folder):
    done = equipoise("keep", "sputnix", "--resume", folder)
    assert done.code == 2
    assert "a keep of '4 kg nanosatellite'" in done.err


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as own:
        own.bind(("127.0.0.1", 0))
        return own.getsockname()[1]


def test_the_experiment_ends_it_through_the_socket(equipoise, strict_json, tmp_path):
    """It says done again and again until somebody answers; hours would be simulated else."""
    port, answers, ended = free_port(), [], threading.Event()

    def say():
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as own:
            own.settimeout(0.2)
            own.connect(("127.0.0.1", port))
            while not answers:
                over = ended.wait(0.1)
                with contextlib.suppress(OSError):  # nobody listens yet, or nobody looks
                    if not over:
                        own.send(b"done")
                    answers.append(own.recv(64))
                if over:
                    return

    speaker = threading.Thread(target=say)
    speaker.start()
    done = equipoise("keep", "nanosat", "--for", "2h", "--json", "--out", tmp_path,
                     "--experiment-port", str(port))  # fmt: skip
    ended.set()
    speaker.join()
    document = strict_json(done.out)
    assert answers == [b"ok done"]
    assert "experiment_done" in [step["code"] for step in document["steps"]]
    assert f"udp:127.0.0.1:{port}" in done.err


@pytest.mark.parametrize(
    ("words", "found"),
    [
        (("--for", "2 weeks"), "--for: found '2 weeks'"),
        (("--quiet", "noon"), "--quiet: found 'noon'"),
        (("--most-torque-un-m", "0"), "--most-torque-un-m: found 0"),
        (("--experiment-port", "70000"), "--experiment-port: found 70000"),
    ],
)
def test_wrong_use_is_named(equipoise, words, found):
    done = equipoise("keep", "nanosat", *words)
    assert done.code == 2
    assert found in done.err
