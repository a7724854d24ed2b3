"""What there is to choose from: methods of identification, laws of balancing."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

from equipoise.control.law import LawCard
from equipoise.estimation.method_contract import Card
from equipoise.estimation.methods.registry import METHODS
from equipoise.model.errors import InputError, nearest
from equipoise.model.presentation import Shown
from equipoise.procedure.balancing.catalogue import CARDS


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Catalogue(Shown):
    """Cards by name: what each method or law needs, what it cannot do, and where it comes from."""

    kind: Literal["method", "law"]
    cards: Mapping[str, Card] | Mapping[str, LawCard]

    def __getitem__(self, name: str) -> Card | LawCard:
        """Return a card; InputError for an unknown name, with the nearest known one."""
        if name not in self.cards:
            raise InputError(self.kind, f"'{name}'", nearest(name, list(self.cards)))
        return self.cards[name]

    def __iter__(self) -> Iterator[str]:
        """Return the names, in the order of the command's list."""
        return iter(self.cards)

    def __len__(self) -> int:
        """Return how many there are."""
        return len(self.cards)


def methods() -> Catalogue:
    """Return the methods that ``identify`` takes, by name: ``methods()["trajectory"].needs``."""
    return Catalogue("method", {name: method.card for name, method in METHODS.items()})


def laws() -> Catalogue:
    """Return the laws that ``balance`` takes, by name: ``laws()["pid"].stable``."""
    return Catalogue("law", CARDS)
