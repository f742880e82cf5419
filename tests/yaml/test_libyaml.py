"""The YAML event stream: libyaml's binding without its package, or PyYAML's own parser."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from yamaro.yaml import libyaml


@pytest.fixture(autouse=True)
def without_yaml() -> Iterator[None]:
    """Let no part of the package be loaded, and put it back in the end."""

    def take_out() -> dict[str, ModuleType]:
        names = [name for name in sys.modules if name.partition(".")[0] == "yaml"]
        return {name: sys.modules.pop(name) for name in names}

    loaded = take_out()
    yield
    take_out()
    sys.modules.update(loaded)


def binding() -> Any:
    """Return the binding, loaded anew; skip the test where PyYAML comes without it."""
    pytest.importorskip("yaml._yaml")
    for name in [name for name in sys.modules if name.partition(".")[0] == "yaml"]:
        del sys.modules[name]
    return libyaml._load_binding()


def events(text: str, parser: Any) -> list[str]:
    reader = parser(text)
    found = []
    while reader.check_event():
        found.append(type(reader.get_event()).__name__)
    return found


def test_the_binding_is_loaded_without_the_package() -> None:
    loaded = binding()
    assert loaded is sys.modules["yaml._yaml"]
    assert "yaml" not in sys.modules
    assert not hasattr(sys.modules["yaml.error"], "load")
    assert events("a: [1]", loaded.CParser) == [
        "StreamStartEvent",
        "DocumentStartEvent",
        "MappingStartEvent",
        "ScalarEvent",
        "SequenceStartEvent",
        "ScalarEvent",
        "SequenceEndEvent",
        "MappingEndEvent",
        "DocumentEndEvent",
        "StreamEndEvent",
    ]


def test_the_package_can_be_imported_afterwards() -> None:
    binding()
    import yaml

    assert yaml.safe_load("a: 1") == {"a": 1}
    assert libyaml._load_binding() is sys.modules["yaml._yaml"]


def test_a_package_that_is_loaded_is_used() -> None:
    import yaml

    assert libyaml._load_binding() is yaml._yaml
    assert sys.modules["yaml"] is yaml


def test_a_package_without_a_binding_has_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "yaml", ModuleType("yaml"))
    with pytest.raises(ImportError):
        libyaml._load_binding()


@pytest.fixture
def stand_in(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Return what the binding finds in place of its package."""
    found: list[Any] = []
    import_really = libyaml._import

    def import_and_look(name: str) -> ModuleType:
        if name == "yaml._yaml":
            found.append(sys.modules["yaml"])
        return import_really(name)

    monkeypatch.setattr(libyaml, "_import", import_and_look)
    binding()
    return found[-1]


def test_the_binding_finds_what_it_makes_its_answers_of(stand_in: Any) -> None:
    assert stand_in.__name__ == "yaml"
    assert stand_in.events.ScalarEvent.__module__ == "yaml.events"
    assert stand_in.tokens.ScalarToken.__module__ == "yaml.tokens"
    assert stand_in.nodes.ScalarNode.__module__ == "yaml.nodes"


@pytest.mark.parametrize(
    ("module", "name"),
    [
        ("scanner", "ScannerError"),
        ("parser", "ParserError"),
        ("composer", "ComposerError"),
        ("constructor", "ConstructorError"),
        ("emitter", "EmitterError"),
        ("serializer", "SerializerError"),
        ("representer", "RepresenterError"),
    ],
)
def test_its_errors_tell_their_place(stand_in: Any, module: str, name: str) -> None:
    holder = getattr(stand_in, module)
    kind = getattr(holder, name)
    assert (holder.__name__, kind.__name__) == (f"yaml.{module}", name)
    error = kind("while reading", None, "it went wrong", None)
    assert isinstance(error, stand_in.error.MarkedYAMLError)
    assert (error.context, error.problem) == ("while reading", "it went wrong")


def test_the_error_of_its_reader_tells_the_character(stand_in: Any) -> None:
    kind = stand_in.reader.ReaderError
    assert kind.__name__ == "ReaderError"
    assert kind.__bases__ == (stand_in.error.YAMLError,)
    error = kind("<unicode string>", 1, 7, "unicode", "control characters are not allowed")
    assert (error.position, error.character) == (1, 7)
    assert error.reason == str(error) == "control characters are not allowed"


def test_the_errors_it_raises_are_caught() -> None:
    with pytest.raises(libyaml.YAMLError) as caught:
        events("a: [", libyaml.Parser)
    mark = caught.value.problem_mark
    assert (mark.line, mark.column) in [(0, 4), (1, 0)]  # the binding's, and PyYAML's own
    with pytest.raises(libyaml.YAMLError) as caught:
        events("a\x01", libyaml.Parser)
    assert caught.value.position == 1


def test_a_binding_that_fails_leaves_no_stand_in(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(name: str) -> ModuleType:
        raise ImportError(name)

    monkeypatch.setattr(libyaml, "_import", fail)
    with pytest.raises(ImportError):
        libyaml._load_binding()
    assert "yaml" not in sys.modules


def test_without_the_package_its_absence_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "meta_path", [object()])
    assert libyaml._find_package() is None
    with pytest.raises(ImportError, match=r"^No module named 'yaml'$"):
        libyaml._load_binding()


def test_the_package_is_found_where_python_finds_it() -> None:
    places = libyaml._find_package()
    assert places is not None
    assert [(Path(place) / "events.py").is_file() for place in places] == [True]


def test_a_finder_may_know_nothing_of_it(monkeypatch: pytest.MonkeyPatch) -> None:
    class Nothing:
        @staticmethod
        def find_spec(name: str, path: object) -> None:
            assert (name, path) == ("yaml", None)

    class File:
        """Finds it as a single file."""

        @staticmethod
        def find_spec(name: str, path: object) -> Any:
            return type("Spec", (), {"submodule_search_locations": None})

    monkeypatch.setattr(sys, "meta_path", [object(), Nothing, File, *sys.meta_path])
    assert len(libyaml._find_package() or ()) == 1


def test_without_the_binding_the_package_reads(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail() -> Any:
        raise ImportError

    monkeypatch.setattr(libyaml, "_load_binding", fail)
    import yaml

    from yamaro.yaml.pure import PureParser

    assert libyaml._choose() == (PureParser, yaml.YAMLError)


def test_the_parser_and_its_errors_are_chosen_together() -> None:
    loaded = binding()
    assert libyaml._choose() == (loaded.CParser, sys.modules["yaml.error"].YAMLError)
