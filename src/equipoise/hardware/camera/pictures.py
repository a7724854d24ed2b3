"""Pictures from a video file or a folder, one after the other, with their times."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from equipoise.hardware.camera.aruco import SIDE, Picture, decoded, opencv
from equipoise.model.errors import InputError

LARGEST = 400_000_000  # bytes of a picture (chosen: four for each pixel)
SUFFIXES = (".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".pgm")


@dataclass(frozen=True, slots=True, eq=False)
class Taken:
    """One picture."""

    t: float  # s, from the first
    grey: Picture
    share: float  # of all pictures, up to this one


def pictures_of(source: Path, rate: float | None) -> Iterator[Taken]:
    """Return the pictures of a folder or a video, at a rate (Hz) if one is given.

    InputError for what is neither, and for a folder without a rate.
    """
    if not (source.is_file() or source.is_dir()):
        raise InputError(str(source), "no such file", "a video, a folder of pictures, or a camera")
    return _of_folder(source, rate) if source.is_dir() else _of_video(source, rate)


def picture_at(path: Path) -> Picture:
    """Return the picture in a file."""
    picture = decoded(_bytes_of(path))
    if picture is None:
        wanted = f"one of {', '.join(SUFFIXES)}, of {SIDE} x {SIDE} pixels at most"
        raise InputError(str(path), "no picture", wanted)
    return picture


def _bytes_of(path: Path) -> bytes:
    """Return the bytes of a regular file; a picture of more is none of a camera."""
    if not path.is_file():
        raise InputError(str(path), "no file", "a picture")
    try:
        with path.open("rb") as file:
            return file.read(LARGEST)
    except OSError as error:
        raise InputError(str(path), error.strerror or str(error), "a picture") from error


def _of_folder(folder: Path, rate: float | None) -> Iterator[Taken]:
    """Return pictures in the order of their names."""
    paths = sorted(path for path in folder.iterdir() if path.suffix.lower() in SUFFIXES)
    if not paths:
        raise InputError(str(folder), "no picture", "files ending in " + ", ".join(SUFFIXES))
    if rate is None:
        raise InputError("--rate-hz", "nothing", "how many pictures of the folder are a second")
    for k, path in enumerate(paths):
        yield Taken(k / rate, picture_at(path), (k + 1) / len(paths))


def _of_video(path: Path, rate: float | None) -> Iterator[Taken]:
    cv2 = opencv("track")
    video = cv2.VideoCapture(str(path))
    try:
        if not video.isOpened():
            raise InputError(str(path), "no video that can be read", "a video file")
        width = video.get(cv2.CAP_PROP_FRAME_WIDTH)
        height = video.get(cv2.CAP_PROP_FRAME_HEIGHT)
        if width * height > SIDE**2:
            found = f"pictures of {width:g} x {height:g} pixels"
            raise InputError(str(path), found, f"{SIDE} x {SIDE} at most")
        count = max(float(video.get(cv2.CAP_PROP_FRAME_COUNT)), 1.0)
        reported = float(video.get(cv2.CAP_PROP_FPS))
        if rate is None and not reported > 0:
            raise InputError(str(path), "a video that states no rate", "--rate-hz")
        for k, picture in enumerate(_frames(video)):
            grey = cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY)
            yield Taken(k / (rate or reported), grey, min((k + 1) / count, 1.0))
    finally:
        video.release()


def _frames(video: Any) -> Iterator[Any]:
    good, picture = video.read()
    while good:
        yield picture
        good, picture = video.read()
