"""What `load_yaml` gives: YAML 1.1 as PyYAML reads it, with units, and `.` for `[…]`.

Lists and dicts in a list or dict are given out as copies, with the same abilities.
"""

from __future__ import annotations

from ..yaml.builder import UNITS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Any


class YamlList(list["Any"]):
    """A list that gives out lists and dicts as `with_dots` returns them."""

    __slots__ = ()

    def __getitem__(self, index: Any) -> Any:
        return with_dots(list.__getitem__(self, index))

    def __iter__(self) -> Iterator[Any]:
        return map(with_dots, list.__iter__(self))


class YamlDict(dict["Any", "Any"]):
    """A dict whose values can be read as attributes."""

    __slots__ = ()

    def __getattr__(self, key: str) -> Any:
        return self[key]

    def __getitem__(self, key: Any) -> Any:
        try:
            return with_dots(dict.__getitem__(self, key))
        except KeyError:
            raise AttributeError(f"the YAML dictionary has no key '{key}'") from None


def with_dots(value: Any) -> Any:
    """Return a list or dict as one that can be read with dots; all else as it is."""
    if isinstance(value, dict):
        return YamlDict(value)
    if isinstance(value, list):
        return YamlList(value)
    return value


def parse_yaml(text: str, evaluate: Callable[[str], Any]) -> Any:
    """Return what a YAML file holds.

    Args:
        text: its content.
        evaluate: returns the value of an expression, for numbers with a unit.

    Raises:
        yaml.YAMLError: the text is not YAML.
        Exception: whatever `evaluate` raises.
    """
    import yaml

    quick: Any = getattr(yaml, "CSafeLoader", None)
    if quick is not None:
        try:
            return with_dots(_load(text, quick, evaluate))
        except yaml.YAMLError:
            pass  # what libyaml does not read, or says worse
    return with_dots(_load(text, yaml.SafeLoader, evaluate))


def _load(text: str, base: Any, evaluate: Callable[[str], Any]) -> Any:
    def convert(loader: Any, node: Any) -> float:
        return float(evaluate(loader.construct_scalar(node))) * UNITS[node.tag]

    class Loader(base):  # type: ignore[misc]  # constructors are kept by class
        pass

    for tag in UNITS:
        Loader.add_constructor(tag, convert)
    loader = Loader(text)
    try:
        return loader.get_single_data()
    finally:
        loader.dispose()
