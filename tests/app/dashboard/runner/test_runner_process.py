"""The runner's process lives as long as whoever began it."""

from multiprocessing import Pipe, get_context

from equipoise.app.dashboard.protocol import requests
from equipoise.app.dashboard.runner.runner_process import Opening, run_runner
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
