"""An emulated bench that lives in a thread, on the wall's clock, behind real ports."""

import threading
import time
from contextlib import contextmanager

from equipoise.app.bench.emulation import emulate

PAUSE = 1e-3  # s, between turns


@contextmanager
def living(bed, seed=1):
    """Return the emulated bench; its testbed has the ports at which it is reached."""
    emulated, over, zero = emulate(bed, seed), threading.Event(), time.monotonic()

    def live():
        while not over.is_set():
            emulated.run(time.monotonic() - zero)
            time.sleep(PAUSE)

    thread = threading.Thread(target=live, daemon=True)
    thread.start()
    try:
        yield emulated
    finally:
        over.set()
        thread.join()
        emulated.close()
