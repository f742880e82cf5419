"""Expands a xacro file: walks its elements, and adds what they expand to.

Elements are never changed. A macro's body, a block or a file is walked as often as it is used, and
each walk makes new elements. What a block held when it was given to a macro is itself walked again
where it is put in, as xacro does.
"""

from __future__ import annotations

import os

from ..diagnostics import Frame, YamaroError, did_you_mean, failure
from ..xml.reader import CData, read_xml
from ..xml.tree import Comment, Element, Text
from ..xml.values import is_comment_text
from .calls import call_by_name, call_macro, insert_block
from .evaluator import Python, XacroEvaluator
from .faults import add_trace
from .places import XacroPlace
from .scope import (
    Macros,
    Namespace,
    Scope,
    Site,
    declare_argument,
    define_macro,
    define_property,
    warn_if_hiding,
)
from .statements import PREFIX, Statements
from .templates import truth
from .tidying import Comments, declare_lost, lift_prefixes, tidy

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from ..diagnostics import Reporter
    from ..source import Source, Span
    from ..xml.reader import XmlDocument
    from ..xml.tree import Element, Node
    from .host import Host
    from .noted import Noted
    from .scope import Macros, Scope
    from .statements import Include

    Handler = Callable[["Expansion", Element, "Site"], None]


def expand(
    source: Source,
    host: Host,
    arguments: Mapping[str, str],
    reporter: Reporter,
    *,
    root: Element | None = None,
    python: Python | None = None,
    frame: Frame | None = None,
    places: Mapping[str, Span] | None = None,
    noted: Noted | None = None,
) -> Element:
    """Return the root element of what xacro makes of a file, without xmlns:xacro.

    Call it where the stack is deep (`sandbox/deep_stack.py`): macros may recurse.

    Args:
        source: the file; its path is what relative paths in it are relative to.
        host: gives other files, packages and the environment.
        arguments: values for `<xacro:arg>`, by name.
        reporter: collects warnings.
        root: the root of the file, if it was read before (`read_xml`, exactly).
        python: evaluates expressions, if not as Python does.
        frame: the include that led to the file, if one did.
        places: where arguments are given; those that the file does not know are warned of there.
        noted: notes the values of names and expressions.

    Raises:
        YamaroError: the file cannot be expanded; the first fault, with its place.
    """
    evaluator = XacroEvaluator(host, reporter, python or Python(host.limits), arguments)
    evaluator.noted = noted
    result = Expansion(host, reporter, evaluator, frame).expand(source, root)
    known = evaluator.arguments.used
    for name, span in (places or {}).items():
        if name not in known:
            reporter.report(
                "unknown-variable",
                f"'{os.path.basename(source.name)}' has no argument '{name}'",
                span,
                hint=did_you_mean(name, sorted(known)) or _list_of(known),
                trace=frame.parent if frame else None,
            )
    return result


def _list_of(arguments: Iterable[str]) -> str:
    names = ", ".join(sorted(arguments))
    return f"it takes {names}" if names else "it has none"


class Expansion:
    """One expansion of a file.

    Attributes:
        frame: the innermost call or include.
        documents: the files that were included, by path.
        included: the paths that each include meant, by the place of its `filename`.
        named: those paths by the names that were computed there.
        walked: how many elements, texts and comments were reached.
        lost: attributes and prefixes that were meant for a condition, and so for nothing.
    """

    def __init__(
        self, host: Host, reporter: Reporter, evaluator: XacroEvaluator, frame: Frame | None = None
    ) -> None:
        """Begin outside of all files, or in one that `frame` includes."""
        self.host = host
        self.limits = host.limits
        self.reporter = reporter
        self.evaluator = evaluator
        self.statements = Statements(reporter)
        self.comments = Comments()
        self.frame = frame
        self.documents: dict[str, XmlDocument] = {}
        self.included: dict[tuple[str, int], list[str]] = {}
        self.named: dict[tuple[str, int], dict[str, str]] = {}
        self.lost: dict[str, object] = {}
        self.depth = 0
        self.walked = 0

    def expand(self, source: Source, root: Element | None = None) -> Element:
        """Return the root element of the file, expanded; `root` is its own, if it was read."""
        if root is None:
            root = read_xml(source, self.limits, exact=True).root
        self.evaluator.files.append(source.path)
        namespace = root.attributes.get("xacro:targetNamespace")
        if namespace:
            attributes = {**root.attributes, "xmlns": namespace}
            spans = root.value_spans
            root = Element(root.name, root.span, attributes, root.children, value_spans=spans)
            if root.value_spans is not None:
                span = root.value_span("xacro:targetNamespace")
                root.value_spans = {"xmlns": span}
        try:
            scope = self.scope(self.evaluator.names)
            result = self.element(root, Macros(), scope)
            if self.evaluator.noted is not None:
                self.evaluator.resolve_all(scope)
        except RecursionError:
            raise self.too_deep(self.frame.span if self.frame else root.span) from None
        if self.lost:
            declare_lost(result, self.lost)
        tidy(result)
        return result

    def scope(self, parent: dict[str, object]) -> Scope:
        """Return a new scope in another."""
        return Scope(parent, self.evaluator.resolve)

    def place(self, node: Element | Text | Comment, attribute: str = "") -> XacroPlace:
        """Return the place of a value, as it is reached now."""
        return XacroPlace(node, attribute, self.frame)

    # --- the walk ---------------------------------------------------------------------------

    def element(self, node: Element, macros: Macros, scope: Scope) -> Element:
        """Return an element that stays, with what is in it expanded."""
        attributes: dict[str, object] = {}
        for name, value in node.attributes.items():
            if ":" in name and name.startswith(PREFIX):
                continue
            if "$" in value:  # type: ignore[operator]
                value = self.evaluator.text(value, scope, XacroPlace(node, name, self.frame))  # type: ignore[arg-type]
            attributes[name] = value
        attributes.pop("xmlns:xacro", None)
        spans = node.value_spans
        made = Element(node.name, node.span, attributes, [], self.frame, spans, True)
        if node.children:
            self.children(node.children, Site(made.children, made, macros, scope))
        return made

    def children(self, nodes: list[Node], site: Site) -> None:
        """Add what the child nodes of one element expand to."""
        out, scope = site.out, site.scope
        last = len(nodes) - 1
        in_comments = False
        self.walked += last + 1
        if self.walked > self.limits.statements:
            raise failure(
                "limit-statements",
                f"more than {self.limits.statements:,} elements and texts are expanded, "
                "which is the limit",
                nodes[0].span,
                hint=self.limits.hint("statements"),
                trace=self.frame,
            )
        for index, node in enumerate(nodes):
            if isinstance(node, Element):
                in_comments = False
                if node.name.startswith(PREFIX):
                    site.is_last = index == last
                    self.statements.trace = self.frame
                    _HANDLERS.get(node.name, call_macro)(self, node, site)
                else:
                    out.append(self.element(node, site.macros, scope))
            elif isinstance(node, Text):
                value: str = node.value  # type: ignore[assignment]
                if "$" in value and type(node) is not CData:
                    value = self.evaluator.text(value, scope, self.place(node))
                    node = Text(value, node.span)
                if in_comments and type(node) is not CData and value.strip():
                    in_comments = False
                out.append(node)
            elif "xacro:eval-comments" in node.text:
                in_comments = "xacro:eval-comments:off" not in node.text
            else:
                out.append(self._comment(node, scope) if in_comments else node)

    def leave_mark(self, node: Element, site: Site) -> Callable[[], None]:
        """Take away the comments that belong to a tag; call what is returned after its content."""
        mark = self.comments.take_away(site.out, node.span, site.is_last)
        if mark is None:
            return _nothing
        return lambda: site.out.append(mark)

    def _comment(self, node: Comment, scope: Scope) -> Comment:
        if "$" not in node.text:
            return node
        place = self.place(node)
        text = self.evaluator.text(node.text, scope, place)
        if not is_comment_text(text):
            raise failure(
                "bad-comment",
                "this makes a comment with '--' in it, or a '-' at its end",
                place.span(),
                trace=self.frame,
            )
        return Comment(text, node.span)

    # --- how deep, how much -----------------------------------------------------------------

    def enter(self, kind: str, name: str, span: Span, home: Frame | None = None) -> None:
        """Begin a call or an include."""
        if self.depth >= self.limits.nesting:
            raise self.too_deep(span)
        self.depth += 1
        self.frame = Frame(kind, name, span, parent=self.frame, home=home)

    def leave(self) -> None:
        """End the innermost call or include."""
        assert self.frame is not None
        self.depth -= 1
        self.frame = self.frame.parent

    def too_deep(self, span: Span) -> YamaroError:
        """Return the error for calls and includes without end."""
        return failure(
            "too-deep",
            f"calls and includes are nested {self.depth:,} levels "
            "deep here, which is probably endless",
            span,
            hint="a macro or file that uses itself needs a condition under which it stops; "
            + self.limits.hint("nesting"),
            trace=self.frame,
        )


def _nothing() -> None:
    """Leave no mark."""


# --- tags that concern the element around them --------------------------------------------------


def _condition(expansion: Expansion, node: Element, site: Site) -> None:
    """Add the content of `<xacro:if>` or `<xacro:unless>`, or nothing."""
    leave_mark = expansion.leave_mark(node, site)
    text = expansion.statements.attributes(node, ("value",))["value"]
    place = expansion.place(node, "value")
    value = expansion.evaluator.value(text, site.scope, place)
    try:
        holds = truth(value)
    except Exception:
        shown = f"'{value}'" if value == text else f"'{text}', which is '{value}',"
        raise failure(
            "xacro-condition",
            f"{shown} is neither true nor false",
            place.span(),
            hint="a condition is true, false or a number; compare: ${name == 'text'}",
            trace=expansion.frame,
        ) from None
    if holds == (node.name == "xacro:if"):
        for name, other in node.attributes.items():  # evaluated once more, for what that does
            if "(" in other or name != "value":  # type: ignore[operator]
                place = expansion.place(node, name)
                expansion.evaluator.text(other, site.scope, place)  # type: ignore[arg-type]
        kept: list[Node] = []
        holder = Element(node.name, node.span)
        expansion.children(node.children, Site(kept, holder, site.macros, site.scope))
        site.out += kept
        expansion.lost.update(holder.attributes)
    leave_mark()


def _element(expansion: Expansion, node: Element, site: Site) -> None:
    """Add `<xacro:element>` under the name it is given, which may be that of a tag of xacro."""
    (given,) = expansion.statements.require(node, "xacro:name")
    place = expansion.place(node, "xacro:name")
    name = _checked_name(expansion.evaluator.value(given, site.scope, place), node.name, place)
    others = {key: value for key, value in node.attributes.items() if key != "xacro:name"}
    named = Element(name, node.span, others, node.children, node.trace, node.value_spans, True)
    if not name.startswith(PREFIX):
        site.out.append(expansion.element(named, site.macros, site.scope))
        return
    _HANDLERS.get(name, call_macro)(expansion, named, site)


def _attribute(expansion: Expansion, node: Element, site: Site) -> None:
    """Add an attribute to the element around."""
    name, value = expansion.statements.require(node, "name", "value")
    place = expansion.place(node, "name")
    key = _checked_name(expansion.evaluator.value(name, site.scope, place), node.name, place)
    place = expansion.place(node, "value")
    holder = site.holder
    if holder.name.startswith(PREFIX):
        expansion.reporter.report(
            "xacro-lost",
            f"the attribute '{key}' is discarded, since <{holder.name}> is around it",
            node.span,
            hint=f"put <{holder.name}> around all of the element, or a condition into the value",
            trace=expansion.frame,
        )
    holder.attributes[key] = expansion.evaluator.text(value, site.scope, place)
    if holder.value_spans is not None:
        holder.value_spans = _OtherPlace(holder, key, node.value_span("value"))


def _checked_name(name: object, tag: str, place: XacroPlace) -> str:
    """Return the name of an element or attribute."""
    problem = None
    if name == "":
        problem = "is empty"
    elif not isinstance(name, str) or any(char in "<>&\"'/= \t\r\n" for char in name):
        problem = f"is '{name}', which is not a name"
    if problem:
        raise failure(
            "xacro-name", f"the name in <{tag}> {problem}", place.span(), trace=place.trace
        )
    return str(name)


class _OtherPlace:
    """The places of an element's values, one of which is written somewhere else."""

    __slots__ = ("_name", "_others", "_span")

    def __init__(self, holder: Element, name: str, span: Span) -> None:
        self._others = holder.value_spans
        self._name = name
        self._span = span

    def get(self, attribute: str, /) -> Span | None:
        if attribute == self._name:
            return self._span
        return self._others.get(attribute) if self._others is not None else None


# --- includes of other xacro files ------------------------------------------------------------


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
        expansion.reporter.report(
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


_HANDLERS: dict[str, Handler] = {
    "xacro:insert_block": insert_block,
    "xacro:include": include,
    "xacro:property": define_property,
    "xacro:macro": define_macro,
    "xacro:arg": declare_argument,
    "xacro:element": _element,
    "xacro:attribute": _attribute,
    "xacro:if": _condition,
    "xacro:unless": _condition,
    "xacro:call": call_by_name,
}
