"""A document of MJCF: its files put into one tree, its names checked, its sections gathered."""

from __future__ import annotations

import os

from ...diagnostics import YamaroError, did_you_mean, failure
from ...xml.reader import read_xml
from ...xml.tree import Element
from ...xml.values import format_value
from .names import ATTRIBUTES

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ...xml.tree import Node
    from ..host import Host
    from .classes import Classes
    from .compiler import Compiler
    from .references import Names

ROOT = "mujoco"
BODY, WORLD = "body", "worldbody"
_INCLUDED = ("mujocoinclude", ROOT)


class Document:
    """An MJCF file with all that it includes.

    Attributes:
        root: its outermost element, in which included files are put in their places.
        folder: the folder of the main file, in which all its paths start.
        name: the name of the model, or "".
        settings: what its compiler and its default classes say, once they are read.
        models: the elements that name other documents, by the names of these, once they are read.
        parts: what was attached of it by the name of a body or frame: the element, the class around
            it, the names in it.
    """

    __slots__ = ("_sections", "folder", "models", "name", "parts", "root", "settings")

    def __init__(self, root: Element, folder: str) -> None:
        self.root = root
        self.folder = folder
        self.settings: tuple[Compiler, Classes] | None = None
        self.models: dict[str, Element] | None = None
        self.parts: dict[tuple[str, str], tuple[Element, str | None, Names]] = {}
        self.name = text(root, "model") or ""
        self._sections: dict[str, list[Element]] = {}
        for child in root.elements():
            self._sections.setdefault(child.name, []).append(child)

    def sections(self, name: str) -> list[Element]:
        """Return the sections of a name; MuJoCo takes several together as one."""
        return self._sections.get(name, [])

    def inside(self, *names: str) -> list[Element]:
        """Return the elements in all sections of these names."""
        return [
            child for name in names for each in self.sections(name) for child in each.elements()
        ]

    def others(self, known: Iterable[str]) -> list[Element]:
        """Return the sections of other names, in the order written."""
        return [each for each in self.root.elements() if each.name not in known]


def text(element: Element, attribute: str) -> str | None:
    """Return an attribute as it is written, or None."""
    value = element.attributes.get(attribute)
    return value if value is None or type(value) is str else format_value(value)


def load(root: Element, host: Host, folder: str) -> Document:
    """Return the document of a root element that was read.

    Raises:
        YamaroError: a file that it includes cannot be read, is included twice, or an element or
            attribute is not of MJCF; it holds all such errors of the files.
    """
    files = {os.path.normpath(root.span.source.path)}
    _include(root, host, folder, files, 0)
    errors: list[YamaroError] = []
    _check(root, "", errors)
    if errors:
        raise YamaroError([each for error in errors for each in error.diagnostics])
    return Document(root, folder)


def _include(element: Element, host: Host, folder: str, files: set[str], depth: int) -> None:
    """Put the content of included files in the place of each `<include>`."""
    if not any(child.name == "include" for child in element.iter() if child is not element):
        return
    pending = [(element, depth)]
    while pending:
        around, depth = pending.pop()
        children: list[Node] = []
        for child in around.children:
            if isinstance(child, Element) and child.name == "include":
                inner = _included(child, host, folder, files, depth)
                _include(inner, host, folder, files, depth + 1)
                children += inner.children
            else:
                children.append(child)
        around.children = children
        pending += [(child, depth) for child in around.elements()]


def _included(element: Element, host: Host, folder: str, files: set[str], depth: int) -> Element:
    span = element.value_span("file")
    name = (text(element, "file") or "").strip()
    if not name:
        raise failure(
            "missing-file",
            "this include names no file",
            element.span,
            hint='write <include file="other.xml"/>',
        )
    path = os.path.normpath(os.path.join(folder, name))
    beside = os.path.normpath(os.path.join(os.path.dirname(span.source.path), name))
    if beside != path and not os.path.isfile(path) and os.path.isfile(beside):
        path = beside  # MuJoCo looks there second
    if path in files:
        raise failure(
            "mjcf-include-twice",
            f"the file '{name}' is included a second time",
            span,
            hint="MuJoCo includes a file at most once in a model: remove this include, or attach "
            "the model with <attach>",
        )
    if depth >= host.limits.nesting:
        raise failure(
            "too-deep",
            f"includes are nested {depth:,} levels deep here",
            span,
            hint=host.limits.hint("nesting"),
        )
    files.add(path)
    root = read_xml(host.read(path, span), host.limits).root
    if root.name not in _INCLUDED:
        raise failure(
            "unknown-mjcf",
            f"the included file is not MJCF: its root is '{root.name}'",
            root.span,
            hint="the root of an included file is 'mujocoinclude' or 'mujoco'",
        )
    return root


# --- names ------------------------------------------------------------------------------------

_SAME = {WORLD: BODY, "frame": BODY, "replicate": BODY}
"""The elements that hold what another one holds."""
_known: dict[str, frozenset[str]] = {}


def attributes_of(around: str, name: str) -> frozenset[str] | None:
    """Return the attributes of an element in another one, or None if it is not of MJCF there."""
    key = f"{_SAME.get(around, around)}/{name}"
    found = _known.get(key)
    if found is None:
        names = ATTRIBUTES.get(key)
        if key == f"{ROOT}/{WORLD}" or key in ("body/body", "default/default"):
            names = ATTRIBUTES.get(f"{ROOT}/{_SAME.get(name, name)}")
        if names is None:
            return None
        found = _known[key] = frozenset(names.split())
    return found


def _check(root: Element, around: str, errors: list[YamaroError]) -> None:
    """Note the elements and attributes that are not of MJCF where they are."""
    if attributes_of(around, root.name) is None:
        errors.append(_unknown_element(root, around))
        return
    pending = [(root, around)]
    while pending:
        element, around = pending.pop()
        known = attributes_of(around, element.name)
        assert known is not None, "the element was looked at"
        if not known.issuperset(element.attributes):
            errors += [
                _unknown_attribute(element, name, known)
                for name in element.attributes
                if name not in known and ":" not in name
            ]
        for name in NUMERIC & element.attributes.keys():
            _refuse_words(element, name, errors)
        below = []
        for child in element.elements():
            if attributes_of(element.name, child.name) is None:
                errors.append(_unknown_element(child, element.name))
            else:
                below.append((child, element.name))
        pending += reversed(below)


NUMERIC = frozenset(
    "act armature biasprm conaffinity condim contype ctrl cutoff dynprm fluidcoef force gainprm "
    "gap group margin mpos mquat noise polycoef priority qpos qvel range relpose rgba size solimp "
    "solimpfriction solimplimit solmix solref solreffriction solreflimit springdamper "
    "springlength springref springyield stiffness torquescale user width".split()
)
"""Attributes that hold numbers wherever they are, and are often passed on as they are written."""


def _refuse_words(element: Element, name: str, errors: list[YamaroError]) -> None:
    """Note a word in an attribute that holds numbers."""
    for word in (text(element, name) or "").split():
        try:
            float(word)
        except ValueError:
            says, span = (
                f"'{name}' takes numbers, and '{word}' is not one",
                element.value_span(name),
            )
            errors.append(failure("bad-mjcf", says, span, hint=f'write {name}="0.1"'))
            return


def _unknown_element(element: Element, around: str) -> YamaroError:
    home = _SAME.get(around, around)
    known = [key.partition("/")[2] for key in ATTRIBUTES if key.startswith(f"{home}/")]
    known += [BODY] if home == BODY else []
    others = [key.partition("/")[0] for key in ATTRIBUTES if key.endswith(f"/{element.name}")]
    hint: str | None = did_you_mean(element.name, known)
    if not hint and others:
        hint = f"<{element.name}> belongs in <{others[0]}>"
    return failure(
        "unknown-mjcf",
        f"MJCF has no <{element.name}> in <{around}>",
        element.span,
        hint=hint or f"<{around}> holds {', '.join(known)}",
    )


def _unknown_attribute(element: Element, name: str, known: frozenset[str]) -> YamaroError:
    return failure(
        "unknown-mjcf",
        f"<{element.name}> has no attribute '{name}'",
        element.name_span(name),
        hint=did_you_mean(name, sorted(known)) or f"its attributes are {', '.join(sorted(known))}",
    )
