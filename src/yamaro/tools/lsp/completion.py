"""Completion: keys, values, names in expressions, arguments of calls, links, files, packages.

While one types the text is rarely YAML. So it is read with the word at the cursor replaced by a
mark, and the rest of a faulty text is recovered from as always; the keys around the mark say what
can stand there.
"""

from __future__ import annotations

import re

from ...diagnostics import Reporter
from ...model.shapes import SIZES
from ...sandbox.deep_stack import run_on_deep_stack
from ...source import Source
from ...yaml.brackets import find_close
from ...yaml.nodes import MappingNode, ScalarNode, SequenceNode
from ...yaml.reader import read_on
from .bindings import Program, visible_names
from .completion_items import Items
from .contexts import ANY, BODY, CONTENTS, DATA, ROOT, VALUE, XML, place_of
from .cursor import Cursor, cursor_at, word_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .contexts import Place
    from .texts import Text
    from .wire import Json
    from .workspace import Workspace

_MARK = "yamaroCursor"
_WORD = re.compile(r"[\w.]*$")
_KEY_LINE = re.compile(r"\s*(?:- +)*$")
_FLOW_KEY = re.compile(r"[{,]\s*$")
_ATTRIBUTES = re.compile(r"<?([\w.:-]*[\w.-])\s*/((?:(?!: ).)*)")
_PYTHON_KEYS = ("condition", "in", "range")
MOST = 1_000
"""Items that are offered."""


def answer(workspace: Workspace, parameters: Json) -> Json:
    """Return what can be written at a place."""
    text = workspace.text_at(parameters)
    offset = workspace.offset_in(text, parameters)
    items = Items(workspace, text, offset)
    if text.is_yaml:
        Completion(workspace, text, offset, items).run()
    found = items.found[:MOST]
    return {"isIncomplete": len(items.found) > MOST, "items": found}


class Completion:
    """One request."""

    def __init__(self, workspace: Workspace, text: Text, offset: int, items: Items) -> None:
        self._workspace = workspace
        self._text = text
        self._offset = offset
        self._items = items
        start = text.text.rfind("\n", 0, offset) + 1
        self._line = text.text[start:offset].rpartition("\r")[2]
        self._start = offset - len(self._line)

    def run(self) -> None:
        """Add the items for the place."""
        before = self._line
        opened = self._open_expression()
        if opened >= 0:
            self._names(before[opened + 2 :])
            return
        stripped = before.lstrip(" -")
        if stripped.startswith(("#", "---")) or " #" in before:
            return
        head = re.match(r"(?:(?:if|elif)\b|for\b.*\bin\b)", stripped)
        if head is not None and stripped[head.end() :][:1] in (" ", "("):
            self._names(stripped)
            return
        attributes = _ATTRIBUTES.fullmatch(stripped)
        if attributes is not None:
            self._attributes(attributes[1], attributes[2])
            return
        word = _WORD.search(before)
        typed = word[0] if word is not None else ""
        is_key = self._is_at_key(before[: len(before) - len(typed)])
        cursor = run_on_deep_stack(lambda: self._read(typed, is_key=is_key))
        self._offer(cursor, typed, is_key=is_key)

    def _open_expression(self) -> int:
        """Return where a `$(` that the cursor is in begins in the line, or -1."""
        at = self._line.find("$(")
        while at >= 0:
            close = find_close(self._line, at + 2)
            if close < 0:
                return at
            at = self._line.find("$(", close)
        return -1

    def _is_at_key(self, before: str) -> bool:
        """Return whether a word behind some text of the line would be a key."""
        if _KEY_LINE.fullmatch(before):
            return True
        inner = before.rpartition("{")[2] if "{" in before else ""
        is_open = before.count("{") > before.count("}")
        return is_open and (not inner.strip() or bool(_FLOW_KEY.search(before)))

    def _read(self, typed: str, *, is_key: bool) -> Cursor:
        """Return where the cursor is in the text with a mark in place of the word."""
        text, offset = self._text.text, self._offset
        start = offset - len(typed)
        end = offset
        while end < len(text) and (text[end].isalnum() or text[end] in "_."):
            end += 1
        rest = text[end : end + 200].partition("\n")[0].lstrip(" ")
        mark = _MARK
        if is_key and not rest.startswith(":"):
            is_flow = "{" in self._line
            mark = f"{_MARK}: 0" if not is_flow or rest[:1] in ("", "}", ",") else f"{_MARK}: 0, "
        elif not is_key and self._line.count("'") % 2 == 0 and typed == "":
            mark = f" {_MARK}" if self._line[-1:] == ":" else _MARK
        line_end = end + len(text[end:].split("\n", 1)[0].rstrip("\r"))
        tail = text[end:line_end]
        closed = tail + _closing(self._line + tail)
        source = Source(text[:start] + mark + closed + text[line_end:], name=self._text.path)
        reading = read_on(source, reporter=Reporter())
        return cursor_at(reading.root, start + (mark.startswith(" ")) + 1)

    def _offer(self, cursor: Cursor, typed: str, *, is_key: bool) -> None:
        keys = cursor.keys
        scalar = cursor.scalar
        if is_key and scalar is not None and cursor.is_key:
            self._keys(place_of(keys), cursor)
            return
        if is_key:  # nothing there yet: the item of a list, or a faulty text
            self._keys(place_of(keys), cursor)
            self._values(cursor)
            return
        self._values(cursor)

    # --- keys -------------------------------------------------------------------------------

    def _keys(self, place: Place, cursor: Cursor) -> None:
        items = self._items
        qualified = re.search(r"(\w+)\.\w*$", self._line)
        if qualified is not None:
            for space, function in self._program().in_namespaces(self._text):
                if space == qualified[1]:
                    items.add_function(function)
            return
        pairs = cursor.mapping.pairs if cursor.mapping is not None else []
        present = {word_of(key.text) for key, _ in pairs} | _sizes_of_other_shapes(cursor)
        if place.name == "call":
            self._arguments(place.call, present)
            return
        if place.name in (VALUE, DATA, "variables", "arguments", "functions", "groups", "import"):
            if place.name == "import":
                items.add_modules()
            if place.name == DATA and cursor.keys[:1] and cursor.keys[0].text == "states":
                items.add_parts(self._program(), is_key=True)
            return
        if place.name == XML:
            items.add_elements(place.element)
        else:
            items.add_words(place.name, present)
        if place.name in CONTENTS or place.name == XML:
            if place.name != ROOT:
                items.add_words("statement", ())
                self._functions()
            if place.name == ANY:
                for name in ("part", "joint", "link"):
                    items.add_words(name, present)
        if place.name == "include" or place.name == "attach":
            self._passed(cursor, present)
        if place.name == BODY:
            items.add_elements("robot")

    def _program(self) -> Program:
        return Program(self._workspace, self._text.path)

    def _functions(self) -> None:
        """Offer the functions that can be called, those of namespaces by their whole name."""
        program = self._program()
        context = self._text.names.context_at(self._offset)
        for place in visible_names(program, self._text, context):
            self._items.add_function(place)
        for space, place in program.in_namespaces(self._text):
            self._items.add_function(place, space=space)

    def _arguments(self, call: str, present: object) -> None:
        program = self._program()
        context = self._text.names.context_at(self._offset)
        for function in program.functions(self._text, call, context):
            self._items.add_parameters(function, present)
        self._items.add_words("statement", ())

    def _passed(self, cursor: Cursor, present: object) -> None:
        """Offer what may be passed to the file that an include names."""
        for key, value in cursor.mapping.pairs if cursor.mapping is not None else ():
            if key.text == "path" and isinstance(value, ScalarNode):
                path = self._workspace.resolve(self._text, value.text)
                file = self._workspace.text_of(path) if path is not None else None
                if file is not None and file.is_yaml:
                    self._items.add_passed(file, present)

    def _attributes(self, name: str, written: str) -> None:
        """Offer the attributes in a key `name/attribute=value`, or the scopes of a name."""
        last = written.rpartition(",")[2]
        if "=" in last:
            attribute = last.partition("=")[0].strip().removesuffix(":")
            self._items.add_attribute_values(self._program(), name, attribute)
        else:
            self._items.add_attributes(name)
            if "=" not in written:
                self._items.add_scopes()

    # --- values -----------------------------------------------------------------------------

    def _values(self, cursor: Cursor) -> None:
        if not cursor.keys:
            return
        words = cursor.words()
        key, place = words[-1], place_of(cursor.keys[:-1])
        if (key in _PYTHON_KEYS and place.name in ("if", "for")) or key == "process":
            self._names(self._line)
        else:
            typed = self._line.rpartition(": ")[2].lstrip(" '\"[")
            self._items.add_values(self._program(), place, key, words, typed)
            if key[:1].isupper() or place.name == "call":
                self._short_call(key)

    def _short_call(self, name: str) -> None:
        program = self._program()
        context = self._text.names.context_at(self._offset)
        for function in program.functions(self._text, name, context):
            self._items.add_parameters(function, (), sign="=")

    # --- expressions ------------------------------------------------------------------------

    def _names(self, before: str) -> None:
        """Offer what an expression sees; behind `space.` what is in the namespace."""
        found = re.search(r"(\w+)\.\w*$", before)
        program = self._program()
        if found is not None and not found[1].isdigit():
            self._items.add_namespace(program, found[1])
            return
        context = self._text.names.context_at(self._offset)
        for place in visible_names(program, self._text, context):
            self._items.add_variable(place)
        self._items.add_predefined()


def _sizes_of_other_shapes(cursor: Cursor) -> set[str]:
    """Return the sizes that the shape around the cursor does not have, or has in another form."""
    for depth in (1, 2):  # its own shape, or that of the link around a section
        words = [word_of(key.text) for key in cursor.keys[-depth:]]
        if len(words) < depth or (depth == 2 and words[0] != "link"):
            return set()
        node = cursor.nodes[-depth]
        items = node.items if isinstance(node, SequenceNode) else [node]
        pairs = [pair for item in items if isinstance(item, MappingNode) for pair in item.pairs]
        given = {word_of(key.text): value for key, value in pairs}
        shape = given.get("geometry")
        if isinstance(shape, ScalarNode) and "$" not in shape.text:
            own = SIZES.get(shape.text.strip().lower(), ())
            others = {name for sizes in SIZES.values() for name in sizes if name not in own}
            if depth == 1 and "scale" in given:
                return {*others, *own}
            return {*others, "scale"} if depth == 1 and own and own[0] in given else others
    return set()


def _closing(line: str) -> str:
    """Return the brackets that a line leaves open, closed; without them no YAML follows."""
    pending: list[str] = []
    at = 0
    while at < len(line):
        char = line[at]
        if line.startswith("$(", at):
            close = find_close(line, at + 2)
            at = close if close >= 0 else len(line)
        elif char in "'\"" and line[at - 1 : at] in ("", " ", "{", "[", ","):
            close = line.find(char, at + 1)
            at = close if close >= 0 else at
        elif char in "{[" and (pending or line[at - 1 : at] in ("", " ")):
            pending.append("}" if char == "{" else "]")
        elif pending and char == pending[-1]:
            pending.pop()
        at += 1
    return "".join(reversed(pending))
