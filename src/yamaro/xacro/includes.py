"""Includes of other xacro files."""

from __future__ import annotations

import os

from ..diagnostics import YamaroError, failure
from ..xml.reader import read_xml
from ..xml.tree import Element
from .definitions import warn_if_hiding
from .faults import add_trace
from .literals import truth
from .namespaces import lift_prefixes
from .scope import Macros, Namespace, Scope
from .site import Site
from .statements import PREFIX

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..source import Source, Span
    from ..xml.reader import XmlDocument
    from ..xml.tree import Node
    from .expansion import Expansion
    from .statements import Include

MISSING_FILE = "missing-file"
"""The code of the error that an include ignores if it is optional."""


def include(expansion: Expansion, node: Element, site: Site) -> None:
    """Add the content of the files that an include names."""
    given = expansion.statements.include(node)
    macros, scope = _namespace(expansion, given, site)
    is_optional = _is_optional(expansion, given)
    included: list[Node] = []
    for path in _paths(expansion, given, site):
        frame, depth, files = expansion.frame, expansion.depth, len(expansion.evaluator.files)
        try:
            root, content = _read(expansion, path, node, macros, scope)
        except YamaroError as error:
            if not is_optional or error.diagnostics[0].code != MISSING_FILE:
                raise
            expansion.frame, expansion.depth = frame, depth
            del expansion.evaluator.files[files:]
            continue
        included += content
        lift_prefixes(expansion, root, site.holder)
    leave_mark = expansion.leave_mark(node, site)
    site.out += included
    leave_mark()


def _namespace(expansion: Expansion, given: Include, site: Site) -> tuple[Macros, Scope]:
    """Return where the macros and properties of the file go."""
    if not given.namespace:
        return site.macros, site.scope
    place = expansion.place(given.element, "ns")
    name = expansion.evaluator.text(given.namespace, site.scope, place)
    macros = site.macros[name] = Macros()
    scope = Namespace(site.scope, expansion.evaluator.resolve)
    warn_if_hiding(expansion, name, place)
    site.scope.put(name, scope)
    return macros, scope


def _is_optional(expansion: Expansion, given: Include) -> bool:
    if given.optional is None:
        return False
    try:
        return truth(given.optional)
    except ValueError:
        raise failure(
            "xacro-condition",
            f'optional="{given.optional}" is neither true nor false',
            given.element.value_span("optional"),
            hint="write true or false; an expression is not allowed here",
            trace=expansion.frame,
        ) from None


def _paths(expansion: Expansion, given: Include, site: Site) -> list[str]:
    """Return the paths of the files that are meant: one, or those that a pattern matches."""
    place = expansion.place(given.element, "filename")
    name = expansion.evaluator.text(given.filename, site.scope, place)
    path = expansion.evaluator.abs_filename(name)
    if not any(char in path for char in "*[?"):
        if "$" in given.filename:
            span = place.span()
            expansion.named.setdefault((span.source.path, span.start), {})[name] = path
        return [path]
    paths = sorted(expansion.host.glob(path))
    if not paths:
        expansion.reporter.warn(
            "xacro-no-files",
            f"no file matches '{name}'",
            place.span(),
            trace=expansion.frame,
        )
    return paths


def _source(expansion: Expansion, path: str, place: Span) -> Source:
    try:
        return expansion.host.read(path, place)
    except YamaroError as error:
        add_trace(error, expansion.frame)
        raise


def _parsed(expansion: Expansion, path: str, source: Source) -> XmlDocument:
    try:
        document = read_xml(source, expansion.limits, exact=True)
    except YamaroError as error:
        add_trace(error, expansion.frame)
        raise
    expansion.documents[path] = document
    return document


def _read(
    expansion: Expansion, path: str, node: Element, macros: Macros, scope: Scope
) -> tuple[Element, list[Node]]:
    """Return the root of a file, without children, and what its content expands to."""
    place = node.value_span("filename")
    paths = expansion.included.setdefault((place.source.path, place.start), [])
    if path not in paths:
        paths.append(path)
    known = expansion.documents.get(path)
    source = _source(expansion, path, place) if known is None else None
    expansion.enter("included", os.path.basename(path), place)
    expansion.evaluator.files.append(path)
    document = known if source is None else _parsed(expansion, path, source)
    assert document is not None
    file = document.root
    attributes: dict[str, object] = {}
    for name, value in file.attributes.items():
        if not name.startswith(PREFIX):
            where = expansion.place(file, name)
            attributes[name] = expansion.evaluator.text(value, scope, where)  # type: ignore[arg-type]
    attributes.pop("xmlns:xacro", None)
    root = Element(file.name, file.span, attributes, None, expansion.frame, file.value_spans)
    content: list[Node] = []
    expansion.children(file.children, Site(content, root, macros, scope))
    expansion.evaluator.files.pop()
    expansion.leave()
    return root, content
