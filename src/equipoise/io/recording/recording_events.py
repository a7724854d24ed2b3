"""Events that a recording keeps beside its rows."""

from pathlib import Path

from equipoise.io.columns.read_options import AS_IT_IS, ReadOptions
from equipoise.io.mcap.mcap_events import mcap_events
from equipoise.io.mcap.mcap_records import MAGIC as MCAP
from equipoise.io.recording.format_registry import WANTED, content_of
from equipoise.model.errors import declared
from equipoise.model.recorded_step import RecordedStep


def read_events(path: str | Path, options: ReadOptions = AS_IT_IS) -> tuple[RecordedStep, ...]:
    """Return the events of a recording in their order; only our MCAP files keep any."""
    with declared(str(path), WANTED), content_of(Path(path), options.max_memory) as content:
        return mcap_events(content, str(path)) if content[: len(MCAP)] == MCAP else ()
