"""The YAML event stream: libyaml's event parser where PyYAML has it, PyYAML's own otherwise.

Importing `yaml` costs ten times what the libyaml binding alone does, because the package loads
constructors, representers and emitters that Yamaro never uses. So the binding is loaded alone,
under a stand-in for the package that is removed again: a later `import yaml` gets the real one.
"""

from __future__ import annotations

import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import ModuleType
    from typing import Any

_ERROR_MODULES = (
    ("reader", "ReaderError"),
    ("scanner", "ScannerError"),
    ("parser", "ParserError"),
    ("composer", "ComposerError"),
    ("constructor", "ConstructorError"),
    ("emitter", "EmitterError"),
    ("serializer", "SerializerError"),
    ("representer", "RepresenterError"),
)


def _load_binding() -> Any:
    """Import `yaml._yaml` without running the package's own `__init__`."""
    if "yaml" in sys.modules:
        from yaml import _yaml

        return _yaml
    places = _find_package()
    if places is None:
        raise ImportError("No module named 'yaml'")
    package: ModuleType = type(sys)("yaml")
    package.__path__ = places
    stand_in: Any = package
    sys.modules["yaml"] = package
    try:
        for name in ("error", "tokens", "events", "nodes"):
            setattr(stand_in, name, _import(f"yaml.{name}"))
        base = stand_in.error.MarkedYAMLError
        for module, error in _ERROR_MODULES:
            holder: Any = type(sys)(f"yaml.{module}")
            parent = stand_in.error.YAMLError if error == "ReaderError" else base
            fields = {"__init__": _init_reader_error} if error == "ReaderError" else {}
            setattr(holder, error, type(error, (parent,), fields))
            setattr(stand_in, module, holder)
        return _import("yaml._yaml")
    finally:
        del sys.modules["yaml"]


def _find_package() -> list[str] | None:
    """Return the folders of the package, as importlib.util.find_spec does, without that import."""
    for finder in sys.meta_path:
        find_spec = getattr(finder, "find_spec", None)  # some of old have none
        spec = find_spec("yaml", None) if find_spec is not None else None
        if spec is not None and spec.submodule_search_locations is not None:
            return list(spec.submodule_search_locations)
    return None


def _import(name: str) -> ModuleType:
    __import__(name)
    return sys.modules[name]


def _init_reader_error(
    self: Any, name: str, position: int, character: object, encoding: str, reason: str
) -> None:
    Exception.__init__(self, reason)
    self.position, self.character, self.reason = position, character, reason


def _choose() -> tuple[Any, Any]:
    """Return the event parser class and the base class of its errors."""
    try:
        binding = _load_binding()
        return binding.CParser, sys.modules["yaml.error"].YAMLError
    except ImportError:
        import yaml

        from .pure import PureParser

        return PureParser, yaml.YAMLError


Parser, YAMLError = _choose()


class DeepParser:
    """Parses a text of any depth, in Python below the 1,000 levels that libyaml 0.2.6 reads."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._parser = Parser(text)
        self._given = 0
        self._is_pure = False

    def get_event(self) -> Any:
        """Return the next event, or None at the end."""
        return self._next("get_event")

    def get_token(self) -> Any:
        """Return the next token, or None at the end."""
        return self._next("get_token")

    def dispose(self) -> None:
        """Forget the text."""
        self._parser.dispose()

    def _next(self, what: str) -> Any:
        try:
            found = getattr(self._parser, what)()
        except YAMLError as error:
            if not is_nested_too_deep(error) or self._is_pure:
                raise
            from .pure import PureParser

            self._parser.dispose()
            self._parser, self._is_pure = PureParser(self._text), True
            for _ in range(self._given):
                getattr(self._parser, what)()
            found = getattr(self._parser, what)()
        self._given += 1
        return found


def is_nested_too_deep(error: Any) -> bool:
    """Return whether libyaml gave up because of the depth."""
    return getattr(error, "problem", None) == "exceeded maximum nesting depth"


from yaml.events import (  # noqa: E402 - only now is it settled which yaml this is
    AliasEvent,
    DocumentStartEvent,
    MappingEndEvent,
    MappingStartEvent,
    ScalarEvent,
    SequenceEndEvent,
    SequenceStartEvent,
    StreamEndEvent,
)

__all__ = [
    "AliasEvent",
    "DeepParser",
    "DocumentStartEvent",
    "MappingEndEvent",
    "MappingStartEvent",
    "Parser",
    "ScalarEvent",
    "SequenceEndEvent",
    "SequenceStartEvent",
    "StreamEndEvent",
    "YAMLError",
    "is_nested_too_deep",
]
