"""How a paper's many runs are carried out: what whoever starts them hands in."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

Spread = Callable[[Callable[[Any], Any], Sequence[Any]], Iterator[Any]]  # results in order
By = Callable[[str], Spread]  # takes what is done, for those who wait
