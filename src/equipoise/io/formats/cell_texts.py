"""Cells of a column that hold no number, as text: block by block, each block's in one piece."""

from bisect import bisect_right
from collections.abc import Iterable

import numpy as np

from equipoise.model.arrays import Ints


class CellTexts:
    """The texts of some rows of a column."""

    def __init__(self) -> None:
        self._first: list[int] = []  # row of each block
        self._rows: list[Ints] = []
        self._ends: list[Ints] = []
        self._bytes: list[bytes] = []
        self._shown: tuple[int, dict[int, str]] = (-1, {})  # the block that was read last

    def add(self, rows: Ints, texts: Iterable[str]) -> int:
        """Keep the texts of rows beyond those so far; return how many bytes that takes."""
        parts = [text.encode(errors="surrogatepass") for text in texts]
        ends = np.cumsum([len(part) for part in parts], dtype=np.int64)
        self._first.append(int(rows[0]))
        self._rows.append(rows)
        self._ends.append(ends)
        self._bytes.append(b"".join(parts))
        return len(self._bytes[-1]) + rows.nbytes + ends.nbytes

    def of(self, row: int) -> str | None:
        """Return the text of a row; None where none is kept."""
        block = bisect_right(self._first, row) - 1
        if block < 0:
            return None
        if self._shown[0] != block:  # rows are mostly asked for one after the other
            self._shown = (block, self._block(block))
        return self._shown[1].get(row)

    def _block(self, block: int) -> dict[int, str]:
        ends = self._ends[block].tolist()
        whole = self._bytes[block]
        texts = (
            whole[begin:end].decode(errors="surrogatepass")
            for begin, end in zip([0, *ends], ends, strict=False)
        )
        return dict(zip(self._rows[block].tolist(), texts, strict=True))
