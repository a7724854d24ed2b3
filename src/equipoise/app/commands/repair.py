"""`equipoise repair`: what is whole of a recording that was cut off or garbled, with an index."""

from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.console.terminal import show_paths

if TYPE_CHECKING:
    from equipoise.io.mcap.mcap_repair import Repaired


def repair(file: str, /, *, out: Path, max_memory_mb: float | None = None) -> int:
    """Recover the readable part of a damaged recording.

    The repaired file has an index, by which Foxglove navigates hours of data. Nothing is written
    for a file that is whole and has an index.

    Parameters
    ----------
    file
        Recording, as MCAP.
    out
        File to write, .mcap.
    max_memory_mb
        Memory for reading the file, in MB. If omitted: 64 times the file, at least 256, at most
        2000.
    """
    from equipoise.app.arguments.inputs import memory_of
    from equipoise.app.arguments.options import Reading
    from equipoise.app.console.rich_blocks import show
    from equipoise.app.text.blocks import paragraphs
    from equipoise.io.files.atomic_file import check_writable
    from equipoise.io.files.reading_budget import ReadingBudget
    from equipoise.io.mcap.mcap_repair import repair as repaired

    budget = ReadingBudget(memory_of(Reading(max_memory_mb=max_memory_mb), "--"))
    check_writable(out)
    done = repaired(file, out, budget)
    show(paragraphs(*_sentences(file, done)))
    if done.written:
        show_paths([out])
    return 0


def _sentences(file: str, done: "Repaired") -> list[str]:
    found = done.found
    kept = f"{found.count} messages, up to {done.last:.3f} s"
    if not done.written:
        return [f"{file} is complete: {kept}. Nothing was written."]
    if found.whole:
        return [f"{file} is complete: {kept}. It has no index; the new file has one."]
    reported = [f"Saved: {kept}."]
    if found.lost_places:
        places = f"{found.lost_bytes} bytes in {_counted(found.lost_places, 'place')}"
        reported.append(f"Lost: {places} that could not be decoded.")
    if found.lost_messages:
        reported.append(
            f"Lost: {_counted(found.lost_messages, 'message')}, according to the file's own count."
        )
    if not found.ended:
        reported.append("The file has no end record: how many messages followed is unknown.")
    return reported


def _counted(count: int, thing: str) -> str:
    return f"{count} {thing}{'s' * (count != 1)}"
