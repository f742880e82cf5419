"""FlexiDict: an ordered mapping in which a key may stand several times."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from typing import Any


class FlexiDict:
    """A sequence of key-value pairs that can also be asked by key.

    Iterating gives the pairs in order; `d["key"]` is the list of that key's values, `d[2]` the
    third pair.
    """

    __slots__ = ("pairs",)

    def __init__(self, pairs: Iterable[tuple[Any, Any]] = ()) -> None:
        self.pairs: list[tuple[Any, Any]] = list(pairs)

    def add(self, key: Any, value: Any) -> None:
        """Append a pair, even if the key is there already."""
        self.pairs.append((key, value))

    def keys(self) -> list[Any]:
        """Return every different key once, in the order of first appearance."""
        return list(dict.fromkeys(key for key, _ in self.pairs))

    def __getitem__(self, key: Any) -> Any:
        """Return the values of a key as a list, or the pair at an integer index.

        Raises:
            KeyError: no pair has that key.
            IndexError: there is no pair at that index.
        """
        if isinstance(key, int) and not isinstance(key, bool):
            return self.pairs[key]
        values = [value for own, value in self.pairs if own == key]
        if not values:
            raise KeyError(key)
        return values

    def __contains__(self, key: object) -> bool:
        return any(own == key for own, _ in self.pairs)

    def __iter__(self) -> Iterator[tuple[Any, Any]]:
        return iter(self.pairs)

    def __len__(self) -> int:
        return len(self.pairs)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, FlexiDict) and self.pairs == other.pairs

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"FlexiDict({self.pairs!r})"
