"""MAT files of version 7.3 read in a process of their own, which may hang or crash.

The library of HDF5 is written in C, and broken bytes let it run for ever: 7 kB of an attribute did.
Nothing within a process ends that. So it is read in another, which takes the open file, has so
much processor time and no more, and hands on the arrays, each as a line of JSON before its bytes.

    processor time   0.15 of the time that the budget has: 3 s and 0.75 s for each MB of the file
"""

import json
import math
import signal
import subprocess
import sys
import tempfile
import traceback
from collections.abc import Generator
from contextlib import contextmanager
from io import UnsupportedOperation
from typing import IO, Any

import numpy as np

from equipoise.io.files.file_content import Content
from equipoise.io.files.reading_budget import Meter
from equipoise.io.formats.matlab.mat_variables import Array
from equipoise.io.formats.matlab.mat_version_73 import MATLAB_73, variables_73
from equipoise.model.errors import InputError
from equipoise.model.optional_libraries import extra_library

SHARE = 0.15  # of the budget's time; chosen: thirty times what such files take
BEGIN = (
    "import json, sys; request = json.loads(sys.argv[1]); sys.path[:] = request.pop('path'); "
    f"from {__name__} import hand_on; hand_on(**request)"
)


def variables_from_process(content: Content, source: str) -> dict[str, Array]:
    """Return the real arrays by name, as ``variables_73`` does; ValueError if the file is broken.

    InputError where they take too much, or the library is not there.
    """
    extra_library("h5py", source, *MATLAB_73)
    meter = content.meter
    request = {"source": source, "size": len(content), "memory": meter.left,
               "seconds": meter.seconds, "path": sys.path}  # fmt: skip
    with _on_disk(content) as file, tempfile.TemporaryFile() as found:
        command = [sys.executable, "-c", BEGIN, json.dumps(request)]
        try:
            ended = subprocess.run(
                command, stdin=file, stdout=found, stderr=subprocess.DEVNULL,
                timeout=meter.seconds, check=False,
            )  # fmt: skip
        except subprocess.TimeoutExpired as error:
            raise meter.refused(f"not read within {meter.seconds:.0f} s") from error
        if ended.returncode:
            raise ValueError(_ending(ended.returncode, SHARE * meter.seconds))
        found.seek(0)
        return _taken(found, meter)


@contextmanager
def _on_disk(content: Content) -> Generator[IO[bytes] | Any]:
    """Lend a file of the system: the content's own, unless that is in memory."""
    try:
        content.file.fileno()
    except UnsupportedOperation:
        with tempfile.TemporaryFile() as copy:
            copy.writelines(content.blocks())
            copy.flush()
            yield copy
    else:
        yield content.file


def _ending(code: int, seconds: float) -> str:
    """Say how a process ended that did not end by itself."""
    if code == -getattr(signal, "SIGXCPU", 0):
        return f"not read within {seconds:.0f} s of processor time"
    name = signal.Signals(-code).name if code < 0 else f"code {code}"
    return f"the library that reads it ended by {name}"


def _taken(found: IO[bytes], meter: Meter) -> dict[str, Array]:
    arrays: dict[str, Array] = {}
    for line in found:
        said: Any = json.loads(line)
        match said:
            case {"broken": text}:
                raise ValueError(text)
            case {"refused": parts}:
                raise InputError(*parts)
            case {"unforeseen": text}:
                raise RuntimeError(text)
            case _:
                count = math.prod(said["shape"])
                meter.take(8 * count)
                values = np.frombuffer(found.read(8 * count), dtype=np.float64)
                arrays[said["name"]] = values.reshape(said["shape"])
    return arrays


def hand_on(source: str, size: int, memory: int, seconds: float) -> None:
    """Read the file at the standard input; its arrays go to the standard output."""
    meter = Meter(source, size, memory, seconds)
    extra_library("h5py", source, *MATLAB_73)  # what its import takes is not counted
    _limit(SHARE * seconds)
    with open(0, "rb", closefd=False) as file, open(1, "wb", closefd=False) as out:
        _answer(out, Content(file, size, meter))


def _answer(out: IO[bytes], content: Content) -> None:
    try:
        arrays = variables_73(content, content.meter.source)
    except InputError as error:
        _say(out, refused=[error.where, error.found, error.wanted])
    except ValueError as error:
        _say(out, broken=str(error))
    except Exception:
        _say(out, unforeseen=traceback.format_exc())
    else:
        for name, values in arrays.items():
            _say(out, name=name, shape=values.shape)
            out.write(np.ascontiguousarray(values).tobytes())


def _say(out: IO[bytes], **said: Any) -> None:
    out.write(json.dumps(said).encode() + b"\n")


def _limit(seconds: float) -> None:
    """Let the system end this process after so much more processor time, where it can."""
    try:
        import resource
    except ImportError:  # Windows
        return
    used = resource.getrusage(resource.RUSAGE_SELF)
    most = math.ceil(used.ru_utime + used.ru_stime + seconds)
    resource.setrlimit(resource.RLIMIT_CPU, (most, most + 1))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
