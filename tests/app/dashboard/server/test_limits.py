"""Buckets by their own clock; connections that wait, and those that do not."""

import asyncio

from equipoise.app.dashboard.server.limits import Bucket, Waiting


def test_a_bucket_has_a_burst_and_a_rate():
    now = [0.0]
    bucket = Bucket(2.0, 3.0, lambda: now[0])
    assert [bucket.take() for _ in range(4)] == [True, True, True, False]
    now[0] = 1.0
    assert [bucket.take() for _ in range(3)] == [True, True, False]
    now[0] = 1e9
    assert [bucket.take() for _ in range(4)] == [True, True, True, False]


class Line:
    """A connection that notes whether it was closed."""

    def __init__(self):
        self.closed = False

    def abort(self):
        self.closed = True


def test_the_one_that_waits_longest_gives_way():
    async def run():
        waiting, lines = Waiting(most=3, silence=60.0), [Line() for _ in range(6)]
        for line in lines[:4]:
            waiting.join(line)
        assert [line.closed for line in lines] == [True, False, False, False, False, False]
        waiting.leave(lines[1])  # a request of its is under way
        waiting.join(lines[4])
        assert not lines[1].closed
        assert not lines[2].closed
        waiting.join(lines[2])  # answered: it begins to wait anew
        waiting.join(lines[5])
        assert [line.closed for line in lines] == [True, False, False, True, False, False]

    asyncio.run(run())


def test_silence_closes_a_connection():
    async def run():
        waiting, silent, busy = Waiting(most=9, silence=0.05), Line(), Line()
        waiting.join(silent)
        waiting.join(busy)
        waiting.leave(busy)
        await asyncio.sleep(0.5)
        assert silent.closed
        assert not busy.closed

    asyncio.run(run())
