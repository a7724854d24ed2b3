"""A board on paper at its true size: markers at right angles, black squares, white paper around."""

import numpy as np

from equipoise.hardware.camera import aruco
from equipoise.hardware.camera.tag_board import TagBoard


def board_print(board: TagBoard, dpi: int) -> aruco.Picture:
    """Return a board of markers turned by quarters, at so many dots per inch."""
    left, bottom, right, top = board.extent
    margin = board.margin
    size = (top - bottom + 2 * margin, right - left + 2 * margin)
    paper = np.full(tuple(aruco.dots(each, dpi) for each in size), 255, np.uint8)
    markers = aruco.dictionary(board.dictionary, "print-board")

    def put(x: float, y: float, side: float, picture: aruco.Picture) -> None:
        column = aruco.dots(x - side / 2 - left + margin, dpi)
        row = aruco.dots(top + margin - y - side / 2, dpi)
        paper[row : row + len(picture), column : column + len(picture)] = picture

    for square in board.squares:
        dots = aruco.dots(square.side, dpi)
        put(square.x, square.y, square.side, np.zeros((dots, dots), np.uint8))
    for each in board.markers:
        picture = aruco.drawn(markers, each.number, aruco.dots(each.side, dpi), board.border)
        turned = np.rot90(picture, round(each.rotation / (np.pi / 2)))
        put(each.x, each.y, each.side, turned)
    return paper
