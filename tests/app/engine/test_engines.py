"""Every engine gives the same results, and reports errors in the same way."""

import math
import os
import socket
from contextlib import ExitStack

import pytest
from distributed import LocalCluster

from equipoise.app.engine import dask_engine
from equipoise.app.engine.choice import engine_of
from equipoise.app.engine.chunks import EACH, LEAST, Pace, chunk_done
from equipoise.app.engine.dask_engine import dask_at
from equipoise.app.engine.spread import as_they_come, spread_over
from equipoise.app.engine.worker_processes import ONE_THREAD, worker_processes
from equipoise.model.errors import InputError
from tests.support import many_pieces
from tests.support.dask_cluster import cluster, is_alive, until
from tests.support.many_pieces import pieces_in


def environment(_piece):
    """How many threads libraries of linear algebra may start here."""
    return {os.environ.get(name) for name in ONE_THREAD}


def process(_piece):
    return os.getpid()


@pytest.fixture(scope="module")
def pools(tmp_path_factory):
    """A pool of every kind; all of them are open at once."""
    with ExitStack() as stack:
        dask = stack.enter_context(cluster(tmp_path_factory.mktemp("dask")))
        names = {"here": ("local", 1), "processes": ("local", 2), "dask": (dask.on, 2)}
        yield {k: stack.enter_context(engine_of(*v)()) for k, v in names.items()}


def test_all_engines_give_the_same_in_the_same_order(pools):
    """Linear algebra to the last bit, and pieces that come back out of order."""
    found = {
        name: [each.tobytes() for each in spread_over(pool)(many_pieces.algebra, range(50))]
        for name, pool in pools.items()
    }
    assert len(set(found["here"])) == 50
    assert found["processes"] == found["dask"] == found["here"]
    for pool in pools.values():
        spread = spread_over(pool)
        assert list(spread(many_pieces.uneven, range(60))) == [k * k for k in range(60)]
        assert list(spread(many_pieces.uneven, [])) == []
        assert sorted(as_they_come(pool, math.sqrt, [4.0, 9.0, 16.0], [0, 2])) == [(0, 2), (2, 4)]


def test_the_first_piece_that_fails_is_the_one_that_is_reported(pools):
    """Later ones fail sooner here; the error keeps its kind, and names its piece."""
    for name, pool in pools.items():
        with pytest.raises(InputError, match="piece 13: found an odd one") as error:
            list(spread_over(pool)(many_pieces.failing, range(40)))
        assert any("chunk 13 of the work" in note for note in error.value.__notes__), name


def test_workers_have_one_thread_of_linear_algebra_and_are_other_processes(pools):
    """Also where this process allows more."""
    for name in ("processes", "dask"):
        spread = spread_over(pools[name])
        assert list(spread(environment, range(4))) == [{"1"}] * 4
        assert os.getpid() not in spread(process, range(4))
    assert set(spread_over(pools["here"])(process, range(2))) == {os.getpid()}


def test_what_is_done_is_counted(pools):
    counts = []

    class Counting:
        def __enter__(self):
            return lambda done, total: counts.append((done, total))

        def __exit__(self, *_):
            counts.append("end")

    assert list(spread_over(pools["here"], Counting)(abs, [-1, -2, -3])) == [1, 2, 3]
    assert counts == [(0, 3), (1, 3), (2, 3), (3, 3), "end"]


def test_a_dask_worker_that_is_killed_costs_no_result(tmp_path):
    """Of two workers one is killed with work in its hands; the other does it too."""
    with cluster(tmp_path) as dask, dask_at(dask.address) as pool:
        found = []
        for result in spread_over(pool)(many_pieces.noted, pieces_in(tmp_path, "done.txt")):
            found.append(result)
            if len(found) == 3000:
                dask.workers[0].kill()
        assert dask.workers[0].wait() < 0
        assert dask.workers[1].poll() is None
    assert found == [(math.sin(0.1 * k), math.cos(0.1 * k)) for k in range(many_pieces.MANY)]


def test_a_dask_worker_of_several_threads_is_refused():
    """Its kernels would wait for each other, and its times be those of all."""
    with (
        LocalCluster(
            n_workers=1,
            threads_per_worker=2,
            processes=False,
            protocol="tcp://",
            dashboard_address="127.0.0.1:0",
        ) as here,
        pytest.raises(InputError, match="a worker with 2 threads"),
        dask_at(here.scheduler_address.removeprefix("tcp://")),
    ):
        pass  # fmt: skip


def test_a_scheduler_that_does_not_answer_is_reported(monkeypatch):
    """Nobody listens at a port that was bound and closed again."""
    monkeypatch.setattr(dask_engine, "DEADLINE", 0.2)
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
    with pytest.raises(InputError, match="no Dask scheduler that answers within"):
        engine_of(f"dask://127.0.0.1:{port}", 2)().__enter__()


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("lokal", "did you mean 'local'?"),
        ("dask", "one of local, dask-local, dask://HOST:PORT"),
        ("dask://somewhere", "dask://HOST:PORT, such as"),
        ("dask://host:port", "dask://HOST:PORT, such as"),
        ("ray", "one of local, dask-local, dask://HOST:PORT"),
    ],
)
def test_an_engine_that_is_unknown_is_reported(name, wanted):
    with pytest.raises(InputError) as error:
        engine_of(name, 2)
    assert wanted in str(error.value)


def test_an_address_may_be_a_name_or_a_number():
    for name in ("dask://node-7.example.org:8786", "dask://10.0.0.5:1", "dask://[fe80::1]:8786"):
        assert callable(engine_of(name, 2))


# --- Processes ---------------------------------------------------------------------------------


def test_a_process_that_ends_suddenly_is_reported():
    with (
        worker_processes(1) as pool,
        pytest.raises(InputError, match="a worker process: found its sudden end"),
    ):
        list(spread_over(pool)(many_pieces.ending, [3]))


def test_an_error_ends_workers_that_have_long_work_at_once():
    """Nobody waits for ten minutes here; of Ctrl-C it is the same."""
    workers = set[int]()

    def interrupted():
        with worker_processes(2) as pool:
            workers.update(spread_over(pool)(process, range(4)))
            for _ in range(2):
                pool.executor.submit(many_pieces.lasting, 0)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    until(lambda: not any(is_alive(each) for each in workers))


# --- Chunks ------------------------------------------------------------------------------------


def test_chunks_grow_until_they_are_worth_sending():
    """Pieces of 1/64 s: LEAST / (1/64) = 6.4, so 7 a chunk, after 1, 2 and 4."""
    pace, sizes = Pace(), []
    for _ in range(5):
        sizes.append(pace.size(workers=2))
        pace.note(sizes[-1], sizes[-1] / 64)
    assert sizes == [1, 2, 4, 7, 7]
    assert LEAST == 0.1
    # 200 workers want 2 ms each: 0.4 s, which are 25.6 pieces; but at most twice as many.
    assert [pace.size(workers=200) for _ in range(2)] == [14, 26]
    assert EACH == 2e-3


def test_a_first_piece_that_takes_long_is_forgotten():
    """Kernels load for 8 s, then pieces take 1/64 s: half of the excess goes with each chunk."""
    pace = Pace()
    pace.note(1, 8.0)
    assert pace.size(workers=2) == 1
    for _ in range(20):
        pace.note(1, 1 / 64)
    for _ in range(4):
        size = pace.size(workers=2)
    assert size == 7


def test_long_pieces_go_one_by_one():
    pace = Pace()
    pace.note(1, 3.0)
    assert [pace.size(workers=8) for _ in range(3)] == [1, 1, 1]


def test_a_worker_of_another_version_does_nothing():
    with pytest.raises(InputError, match=r"found equipoise .*; wanted 0.0.1, as on the send"):
        chunk_done("0.0.1", many_pieces.ending, [0], [0])
