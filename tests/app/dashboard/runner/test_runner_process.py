"""The runner's process lives as long as whoever began it."""

import os
import threading
import time
from multiprocessing import Pipe, get_context

import pytest

from equipoise.app.dashboard.protocol import requests
from equipoise.app.dashboard.runner.runner_process import Opening, run_runner
from equipoise.app.dashboard.server.server import RemoteRunner
from equipoise.hardware.bench.stop_signals import STOPPING
from tests.app.dashboard.conftest import BALANCE


def test_the_runner_ends_with_who_began_it_in_the_middle_of_a_balance(nanosat, tmp_path):
    page, remote = Pipe()
    opening = Opening(nanosat, tmp_path, 1)
    process = get_context("spawn").Process(target=run_runner, args=(remote, opening))
    process.start()
    remote.close()
    assert page.poll(300)  # it may have to compile
    assert page.recv() == ("ready", None)
    page.send(requests.Pause(False))
    page.send(BALANCE)
    while page.poll(300):
        kind, what = page.recv()
        if kind == "step":
            break
    assert what["of"] == "measurement"
    page.close()
    process.join(120)
    assert process.exitcode == 0


@pytest.mark.skipif(os.name == "nt", reason="no signals between processes")
def test_the_runner_leaves_signals_to_the_server_and_ends_by_itself(nanosat, tmp_path):
    """While the server's thread reads from the pipe, as it does; 0: nobody had to kill it."""
    runner = RemoteRunner(Opening(nanosat, tmp_path, 1))
    runner.wait_until_ready()
    reader = threading.Thread(target=received_until_closed, args=(runner.pipe,), daemon=True)
    reader.start()
    time.sleep(0.2)
    for number in STOPPING:
        os.kill(runner._process.pid, number)
    time.sleep(0.2)
    assert runner._process.is_alive()
    runner.close()
    assert runner._process.exitcode == 0
    reader.join(10)
    assert not reader.is_alive()
    assert not runner.pipe.closed  # under who reads


def received_until_closed(pipe):
    """Read as the server's thread does."""
    try:
        while True:
            pipe.recv()
    except (EOFError, OSError):
        return
