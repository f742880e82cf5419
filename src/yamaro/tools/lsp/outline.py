"""The outline of a file: symbols, stretches to fold, semantic tokens."""

from __future__ import annotations

from ...syntax.symbol_table import (
    ARGUMENT,
    BLOCK_NAME,
    CALLED,
    IMPORTED,
    ITERATOR,
    NAMESPACE,
    PARAMETER,
)
from ...yaml.nodes import MappingNode, ScalarNode, SequenceNode, pairs_below
from .contexts import pairs_of_mappings, word_of
from .protocol import TYPES, range_of, width

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...source import Span
    from ...xml.tree import Element
    from ...yaml.nodes import YamlNode
    from .protocol import Json
    from .workspace import Text, Workspace

_MODULE, _NAMESPACE, _CLASS, _PROPERTY, _FIELD = 2, 3, 5, 7, 8
_FUNCTION, _VARIABLE, _CONSTANT, _OBJECT, _KEY = 12, 13, 14, 19, 20
_MOST_DEPTH = 40
_WITHOUT_INNER = ("naming", "base", "import", "print", "process")


def document_symbols(workspace: Workspace, parameters: Json) -> Json:
    """Return the symbols of a file as a tree, or as a list for editors that know no trees."""
    text = workspace.text_at(parameters)
    builder = _Symbols(workspace, text)
    if text.is_yaml:
        found = builder.of_root(text.root)
    else:
        from .xml_names import format_of

        if text.is_foreign:
            found = []
        elif format_of(text.xml):
            found = builder.of_element(text.xml, hoists=format_of(text.xml) == "mjcf")
        else:
            found = builder.of_robot(text.xml)
    own = (workspace.client.get("textDocument") or {}).get("documentSymbol") or {}
    if own.get("hierarchicalDocumentSymbolSupport"):
        return found
    return _flat(found, parameters["textDocument"]["uri"], "")


def _flat(symbols: list[Json], uri: str, container: str) -> list[Json]:
    found = []
    for each in symbols:
        location = {"uri": uri, "range": each["range"]}
        found.append({"name": each["name"], "kind": each["kind"], "location": location})
        if container:
            found[-1]["containerName"] = container
        found += _flat(each.get("children", []), uri, each["name"])
    return found


class _Symbols:
    def __init__(self, workspace: Workspace, text: Text) -> None:
        self._encoding = workspace.encoding
        self._text = text

    def of_root(self, root: YamlNode | None) -> list[Json]:
        found = []
        for key, value in pairs_of_mappings(root):
            word = word_of(key.text)
            if word in ("variables", "arguments"):
                kind = _VARIABLE if word == "variables" else _CONSTANT
                inner = self._entries(value, kind)
            elif word == "functions":
                inner = self._functions(value)
            elif word in _WITHOUT_INNER or (word == "robot" and isinstance(value, ScalarNode)):
                inner = []
            else:
                inner = self._body(value, 0)
            name, detail = key.text, ""
            if isinstance(value, ScalarNode) and value.text:
                detail = " ".join(value.text.split())[:80]
            found.append(self._symbol(name, _NAMESPACE, key, value, inner, detail=detail))
        return found

    def _entries(self, node: YamlNode, kind: int) -> list[Json]:
        found = []
        for key, value in pairs_of_mappings(node):
            name = key.text.partition("/")[0].strip() or key.text
            written = self._text.text[value.start : value.end]
            detail = " ".join(written.split())[:80]
            found.append(self._symbol(name, kind, key, value, [], detail=detail))
        return found

    def _functions(self, node: YamlNode) -> list[Json]:
        found = []
        for key, value in pairs_of_mappings(node):
            name, bracket, rest = key.text.partition("(")
            detail = f"({rest}" if bracket else ""
            body = value
            for own, inner in pairs_of_mappings(value):
                if own.text == "input" and isinstance(inner, ScalarNode):
                    detail = f"({' '.join(inner.text.split())})"
                if own.text == "body":
                    body = inner
            name = name.partition("/")[0].strip() or key.text
            inner_symbols = self._body(body, 0)
            found.append(self._symbol(name, _FUNCTION, key, value, inner_symbols, detail=detail))
        return found

    def _body(self, node: YamlNode, depth: int) -> list[Json]:
        """Return the symbols in statements: parts, calls, elements with a name, declarations."""
        found: list[Json] = []
        if depth > _MOST_DEPTH:
            return found
        for key, value in pairs_of_mappings(node):
            word = word_of(key.text)
            if word == "part":
                found.append(self._part(key, value, depth))
            elif word == "variables":
                found += self._entries(value, _VARIABLE)
            elif word == "functions":
                found += self._functions(value)
            elif word[:1].isupper() and word.replace(".", "").isidentifier():
                inner = self._body(value, depth + 1)
                found.append(self._symbol(key.text, _OBJECT, key, value, inner, detail="call"))
            elif "name=" in key.text or word in ("attach", "mirror", "include"):
                inner = self._body(value, depth + 1)
                found.append(self._symbol(_title(key, value), _FIELD, key, value, inner))
            else:
                found += self._body(value, depth + 1)
        return found

    def _part(self, key: ScalarNode, value: YamlNode, depth: int) -> Json:
        name, detail = "part", ""
        for own, inner in pairs_of_mappings(value):
            if own.text == "name" and isinstance(inner, ScalarNode) and inner.text:
                name = inner.text
            if word_of(own.text) == "joint":
                for entry, scalar in pairs_of_mappings(inner):
                    if entry.text == "type" and isinstance(scalar, ScalarNode):
                        detail = scalar.text
        return self._symbol(name, _CLASS, key, value, self._body(value, depth + 1), detail=detail)

    def _symbol(
        self,
        name: str,
        kind: int,
        key: ScalarNode,
        value: YamlNode,
        inner: list[Json],
        *,
        detail: str = "",
    ) -> Json:
        end = value.end
        while end > key.end and self._text.text[end - 1 : end].isspace():
            end -= 1
        whole = range_of(key.source, key.start, max(key.end, end), self._encoding)
        symbol = {
            "name": name or "?",
            "kind": kind,
            "range": whole,
            "selectionRange": range_of(key.source, key.start, key.end, self._encoding),
        }
        if detail:
            symbol["detail"] = detail
        if inner:
            symbol["children"] = inner
        return symbol

    # --- XML --------------------------------------------------------------------------------

    def of_element(self, root: Element | None, *, hoists: bool = False) -> list[Json]:
        """Return the elements with a name, each with those in it.

        Args:
            root: what they are in.
            hoists: whether what is in elements without a name is beside them, as in MJCF.
        """
        if root is None:
            return []
        found = []
        for child in root.elements():
            name = child.attributes.get("name", child.attributes.get("filename"))
            if child.name == "default":
                name = child.attributes.get("class")
            inner = self.of_element(child, hoists=hoists)
            if name is None:
                found += inner if hoists else []
                continue
            span = child.span
            whole = range_of(span.source, span.start, span.end, self._encoding)
            symbol = {
                "name": str(name),
                "detail": child.name,
                "kind": _FUNCTION if child.name == "xacro:macro" else _CLASS,
                "range": whole,
                "selectionRange": whole,
            }
            if inner:
                symbol["range"] = {"start": whole["start"], "end": inner[-1]["range"]["end"]}
                symbol["children"] = inner
            found.append(symbol)
        return found

    def of_robot(self, root: Element | None) -> list[Json]:
        """Return what a URDF or xacro file defines and calls, with what is in that."""
        stops = {tag.start + 1: tag.stop for tag in self._text.tags.found}
        return [] if root is None else self._in_robot(root, stops, 0)

    def _in_robot(self, element: Element, stops: dict[int, int], depth: int) -> list[Json]:
        found: list[Json] = []
        for child in element.elements() if depth <= _MOST_DEPTH else ():
            given = child.attributes
            is_call = child.name.startswith("xacro:")
            kind = _IN_ROBOT.get(child.name, _OBJECT if is_call else None)
            inner = self._in_robot(child, stops, depth + 1)
            if kind is None or (child.name == "material" and not child.elements()):
                found += inner
                continue
            name, detail = str(given.get("name", "")), child.name.removeprefix("xacro:")
            if child.name == "xacro:include":
                name = str(given.get("filename", ""))
            elif child.name in ("gazebo", "xacro:if", "xacro:unless"):
                value = given.get("reference", given.get("value", ""))
                name, detail = f"{detail} {value}".strip(), ""
            elif child.name in ("joint", "xacro:macro", "xacro:property", "xacro:arg"):
                own = ("type", "params", "value", "default")
                more = next((str(given[each]) for each in own if each in given), "")
                detail = f"{detail} {' '.join(more.split())}"[:80]
            elif child.name not in _IN_ROBOT:  # a call of a macro
                values = (f"{key}={value}" for key, value in given.items())
                name, detail = child.name, " ".join(values)[:80]
            span = child.span
            start = span.start - 1
            stop = max(stops.get(span.start, span.end), span.end)
            symbol = {
                "name": name or child.name,
                "kind": kind,
                "range": range_of(span.source, start, stop, self._encoding),
                "selectionRange": range_of(span.source, start, span.end, self._encoding),
            }
            if detail:
                symbol["detail"] = detail
            if inner:
                symbol["children"] = inner
            found.append(symbol)
        return found


_IN_ROBOT = {
    **dict.fromkeys(("link", "joint"), _CLASS),
    **dict.fromkeys(("material", "gazebo", "transmission", "ros2_control", "sensor"), _FIELD),
    **dict.fromkeys(("xacro:if", "xacro:unless"), _NAMESPACE),
    "xacro:macro": _FUNCTION,
    "xacro:property": _VARIABLE,
    "xacro:arg": _CONSTANT,
    "xacro:include": _MODULE,
}
"""What the outline of a URDF or xacro file shows, with the kind of its symbol."""


def _title(key: ScalarNode, value: YamlNode) -> str:
    """Return what to call an element or statement."""
    if word_of(key.text) in ("attach", "mirror", "include"):
        scalars = [value] if isinstance(value, ScalarNode) else []
        if isinstance(value, (MappingNode, SequenceNode)):
            pairs = pairs_of_mappings(value)
            scalars = [
                each for own, each in pairs if own.text == "path" and isinstance(each, ScalarNode)
            ]
        return f"{key.text} {scalars[0].text}" if scalars else key.text
    return key.text


# --- folding ----------------------------------------------------------------------------------


MOST = 5_000


def folding_ranges(workspace: Workspace, parameters: Json) -> Json:
    """Return the stretches as lines, from 0."""
    text = workspace.text_at(parameters)
    if not text.is_yaml:
        stretches = [
            (_line(text, tag.start), _line(text, tag.close) - 1)
            for tag in text.tags.found
            if tag.close != tag.end
        ]
        kinds = dict.fromkeys(stretches, "region")
    else:
        found: list[tuple[int, int]] = []
        for key, value in pairs_below(text.root):
            end = value.end
            while end > key.end and text.text[end - 1 : end].isspace():
                end -= 1
            found.append((_line(text, key.start), _line(text, max(key.start, end - 1))))
        kinds = dict.fromkeys(found, "region")
        found = []  # the stretches of lines that hold nothing but comments
        start = -1
        lines = text.text.splitlines()
        for number, line in enumerate([*lines, ""]):
            if line.lstrip().startswith("#"):
                start = number if start < 0 else start
            elif start >= 0:
                found.append((start, number - 1))
                start = -1
        kinds.update(dict.fromkeys(found, "comment"))
    found = sorted((start, end) for start, end in kinds if end > start)[:MOST]
    return [
        {"startLine": start, "endLine": end}
        | ({"kind": "comment"} if kinds[start, end] == "comment" else {})
        for start, end in found
    ]


def _line(text: Text, offset: int) -> int:
    return text.source.location(offset)[0] - 1


# --- semantic tokens --------------------------------------------------------------------------


_DECLARES = 1
_TOKENS = {
    **dict.fromkeys((PARAMETER, BLOCK_NAME, ITERATOR, ARGUMENT), "parameter"),
    **dict.fromkeys((NAMESPACE, IMPORTED), "namespace"),
}


def semantic_tokens(workspace: Workspace, parameters: Json) -> Json:
    """Return the tokens of a file, each relative to the one before."""
    text = workspace.text_at(parameters)
    data: list[int] = []
    last_line = last_column = 0
    for span, kind, modifiers in _tokens(text) if text.is_yaml else ():
        start = workspace.position(text, span.start)
        line, column = start["line"], start["character"]
        written = text.text[span.start : span.end]
        if "\n" in written or not written:
            continue
        if line != last_line:
            last_column = 0
        length = width(written, workspace.encoding)
        data += [line - last_line, column - last_column, length, TYPES.index(kind), modifiers]
        last_line, last_column = line, column
    return {"data": data}


def _tokens(text: Text) -> list[tuple[Span, str, int]]:
    """Return the tokens in order; none overlaps another."""
    names = text.names
    parameters = {
        each.name for each in names.declarations if each.kind in (PARAMETER, ITERATOR, ARGUMENT)
    }
    found: dict[int, tuple[Span, str, int]] = {}
    for declared in names.declarations:
        kind = "function" if declared.kind in CALLED else _TOKENS.get(declared.kind, "variable")
        found[declared.span.start] = (declared.span, kind, _DECLARES)
    for use in names.uses:
        kind = "function" if use.is_called else "variable"
        if use.name in parameters and not use.is_called:
            kind = "parameter"
        found.setdefault(use.span.start, (use.span, kind, 0))
    for part in text.parts.named:
        if part.name is not None:
            found.setdefault(part.span.start, (part.span, "class", _DECLARES))
    for reference in text.parts.references:
        if not reference.is_computed:
            found.setdefault(reference.span.start, (reference.span, "class", 0))
    kept = []
    end = 0
    for _, token in sorted(found.items(), key=lambda item: item[0]):
        if token[0].start >= end:
            kept.append(token)
            end = token[0].end
    return kept
