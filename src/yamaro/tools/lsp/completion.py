"""Completion: keys, values, names, arguments, links, files, packages; signatures of calls.

While one types the text is rarely YAML. So it is read with the word at the cursor replaced by a
mark, and the rest of a faulty text is recovered from as always; the keys around the mark say what
can stand there.
"""

from __future__ import annotations

import os
import re

from ...diagnostics import Reporter
from ...model.controllers import known_type
from ...model.schema import ELEMENTS, RECORDS
from ...model.shapes import SIZES
from ...sandbox.deep_stack import run_on_deep_stack
from ...source import Source
from ...syntax.nodes import LOCAL, SCOPES, FunctionNode
from ...syntax.symbol_table import ARGUMENT, CALLED, FUNCTION_NAME, VARIABLE
from ...yaml.brackets import find_close
from ...yaml.nodes import MappingNode, ScalarNode, SequenceNode
from ...yaml.reader import read_on
from .bindings import Program, visible_names
from .contexts import (
    ANY,
    BODY,
    CONTENTS,
    DATA,
    MANUAL,
    PREDEFINED,
    ROOT,
    USEFUL_BUILTINS,
    VALUE,
    VALUES,
    XML,
    Cursor,
    cursor_at,
    place_below,
    word_of,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .bindings import Place as NamePlace
    from .bindings import Program
    from .contexts import Place
    from .protocol import Json
    from .workspace import Text, Workspace


# --- items ------------------------------------------------------------------------------------


_FUNCTION, _FIELD, _VARIABLE, _MODULE, _PROPERTY = 3, 5, 6, 9, 10
_VALUE, _ENUM, _KEYWORD, _SNIPPET, _FILE, _REFERENCE = 12, 13, 14, 15, 17, 18
_FOLDER, _CONSTANT = 19, 21
_KINDS = {
    "constant": _CONSTANT,
    "enum": _ENUM,
    "field": _FIELD,
    "function": _FUNCTION,
    "keyword": _KEYWORD,
    "module": _MODULE,
    "reference": _REFERENCE,
    "variable": _VARIABLE,
}
"""Kinds of items by the words that completion of XML has for them."""
_WITH_BODY = frozenset(
    "model variables functions arguments part joint link visual collision inertial material frame "
    "sensor actuator surface attach mirror loop control controllers states groups collisions "
    "naming body else input".split()
).union(name for name in RECORDS if ELEMENTS[name].scalar is None)
_SNIPPETS = {
    ("statement", "part"): "part:\n    name: ${1:name}\n    joint: {type: ${2:fixed}, "
    "parent: ${3:base}, xyz: ${4:0 0 0}}\n    link:\n      $0",
    ("statement", "if"): "if ${1:condition}:\n  - $0",
    ("statement", "for"): "for ${1:i} in ${2:range(3)}:\n  - $0",
}
_PARTS = frozenset(("parent", "child", "to", "at", "of", "frame", "between", "chain", "links"))
_JOINTS = frozenset(("mimic", "joints"))
_PATHS = frozenset(("include", "path", "geometry", "texture", "filename"))
_MODULES = ("math", "numpy as np", "random", "itertools", "functools", "statistics")
MOST_FILES = 200


class Items:
    """Gathers items; the same label counts once."""

    def __init__(self, workspace: Workspace, text: Text, offset: int, *, signs: str = "_") -> None:
        """Complete the word at an offset, made of letters, digits and signs."""
        self.found: list[Json] = []
        self._workspace = workspace
        self._text = text
        self._seen: set[str] = set()
        start = offset
        while start > 0 and (text.text[start - 1].isalnum() or text.text[start - 1] in signs):
            start -= 1
        self._range = {
            "start": workspace.position(text, start),
            "end": workspace.position(text, offset),
        }
        end = offset
        while end < len(text.text) and (text.text[end].isalnum() or text.text[end] in signs):
            end += 1
        self._has_colon = text.text[end : end + 1] == ":"
        item = ((workspace.client.get("textDocument") or {}).get("completion") or {}).get(
            "completionItem"
        ) or {}
        self._has_snippets = bool(item.get("snippetSupport"))

    def add(
        self,
        label: str,
        kind: int | str,
        *,
        text: str | None = None,
        detail: str = "",
        documentation: str = "",
        snippet: str | None = None,
        rank: str = "5",
    ) -> None:
        """Add an item unless its label is there already."""
        if label in self._seen:
            return
        self._seen.add(label)
        new = label if text is None else text
        number = _KINDS[kind] if isinstance(kind, str) else kind
        item: Json = {"label": label, "kind": number, "sortText": f"{rank}{label}"}
        if snippet is not None and self._has_snippets and not self._has_colon:
            item["insertTextFormat"] = 2
            new = snippet
        item["textEdit"] = {"range": self._range, "newText": new}
        if detail:
            item["detail"] = detail
        if documentation:
            item["documentation"] = {"kind": "markdown", "value": documentation}
        self.found.append(item)

    def _key(self, word: str) -> str:
        """Return a key as it is written."""
        if self._has_colon:
            return word
        return f"{word}:" if word in _WITH_BODY else f"{word}: "

    # --- words ------------------------------------------------------------------------------

    def add_words(self, place: str, present: object) -> None:
        """Add the keys of a place; those that are there already come last."""
        for word, about in MANUAL.get(place, {}).items():
            is_there = isinstance(present, (set, tuple, list)) and word in present
            is_repeatable = place in ("statement", "root") or word in ("visual", "collision")
            if is_there and not is_repeatable:
                continue
            rank = "6" if place == "statement" else "1"
            self.add(
                word,
                _KEYWORD if place in ("statement", "root") else _PROPERTY,
                text=self._key(word),
                documentation=about,
                snippet=_SNIPPETS.get((place, word)),
                rank=rank,
            )

    def add_elements(self, element: str) -> None:
        """Add the XML elements that URDF has in an element."""
        rule = ELEMENTS.get(element)
        for name in rule.children if rule is not None else ():
            self.add(name, _FIELD, text=self._key(name), detail="XML element", rank="7")

    def add_attributes(self, element: str) -> None:
        """Add the attributes of an XML element."""
        rule = ELEMENTS.get(element)
        names = list(rule.fields) if rule is not None else ["name"]
        for name in names:
            self.add(name, _PROPERTY, text=f"{name}=", detail=f"attribute of <{element}>", rank="2")

    def add_attribute_values(self, program: Program, element: str, attribute: str) -> None:
        """Add values of an attribute in a key."""
        if attribute in ("link", "joint", "reference", "parent", "child"):
            self.add_parts(program)
        for value in VALUES.get((element, attribute), ()):
            self.add(value, _ENUM, rank="1")

    def add_scopes(self) -> None:
        """Add the scopes of variables and functions."""
        for scope in SCOPES:
            self.add(scope, _ENUM, detail="scope", rank="3")

    def add_values(
        self, program: Program, place: Place, key: str, words: list[str], typed: str
    ) -> None:
        """Add what a value can be."""
        name = place.name
        for word in VALUES.get((name, key), ()):
            self.add(word, _ENUM, rank="1")
        if name == "any":
            for (_, other), values in VALUES.items():
                for word in values if other == key else ():
                    self.add(word, _ENUM, rank="2")
        if key in _PARTS or key in _JOINTS or words[-2:-1] == ["mimic"]:
            self.add_parts(program)
        if key == "material" or (name == "material" and key == "name"):
            for result in self._workspace.results_of(self._text.path):
                for name in result.robot.materials if result.robot is not None else ():
                    self.add(name, _REFERENCE, detail="material", rank="1")
        if key in _PATHS:
            self.add_files(typed)
        if key == "import" or words[:1] == ["import"]:
            self.add_modules()
        if name == "call" or key in ("print",):
            return
        if name == "control" and key == "state":
            for result in self._workspace.results_of(self._text.path):
                for name in result.robot.states if result.robot is not None else ():
                    self.add(name, _REFERENCE, detail="state", rank="1")

    # --- names ------------------------------------------------------------------------------

    def add_variable(self, place: NamePlace) -> None:
        """Add a variable that an expression sees."""
        declared = place.declaration
        if declared is None or declared.kind in CALLED:
            return
        scope = "" if declared.scope == LOCAL else f", {declared.scope}"
        rank = "1" if declared.context.kind == "function" else "2"
        detail = f"{declared.kind}{scope}"
        self.add(declared.name, _VARIABLE, detail=detail, rank=rank)

    def add_function(self, place: NamePlace, *, space: str = "") -> None:
        """Add a function that can be called, with its parameters; `space` is its namespace."""
        declared = place.declaration
        if declared is None or declared.kind not in CALLED:
            return
        node = declared.node
        if not isinstance(node, FunctionNode):
            self.add(declared.name, _REFERENCE, text=self._key(declared.name), detail="block")
            return
        names = [each for each in node.parameters if not each.is_block]
        inner = ", ".join(f"${{{index}:{each.name}}}" for index, each in enumerate(names, 1))
        name = f"{space}.{declared.name}" if space else declared.name
        self.add(
            name,
            _FUNCTION,
            text=self._key(name),
            detail=node.signature(),
            documentation=place.text.comment_on(declared.span),
            snippet=f"{name}: {inner}$0",
            rank="3",
        )

    def add_parameters(self, function: NamePlace, present: object, *, sign: str = ": ") -> None:
        """Add the parameters of a function as arguments of a call."""
        node = function.declaration.node if function.declaration is not None else None
        for each in node.parameters if isinstance(node, FunctionNode) else ():
            if isinstance(present, (set, tuple)) and each.name in present:
                continue
            text = f"{each.name}:" if each.is_block else f"{each.name}{sign}"
            if self._has_colon:
                text = each.name
            about = "block" if each.is_block else "required"
            if not each.is_block and each.default is not None:
                about = each.text
            if not each.is_block or sign == ": ":
                self.add(each.name, _FIELD, text=text, detail=about, rank="0")

    def add_passed(self, file: Text, present: object) -> None:
        """Add what may be passed to a file."""
        for each in file.names.file.declared.values():
            first = each[0]
            is_there = isinstance(present, (set, tuple)) and first.name in present
            if first.kind in (VARIABLE, ARGUMENT) and not is_there:
                self.add(first.name, _FIELD, text=self._key(first.name), detail=first.kind)

    def add_namespace(self, program: Program, space: str) -> None:
        """Add what an include has put into a namespace."""
        for include in self._text.names.includes:
            if include.node.namespace == space and include.path is not None:
                path = self._workspace.resolve(self._text, include.path)
                for text in program.texts:
                    for each in text.names.declarations if text.path == path else ():
                        if each.scope != LOCAL:
                            kind = _FUNCTION if each.kind == FUNCTION_NAME else _VARIABLE
                            self.add(each.name, kind, detail=each.kind)

    def add_predefined(self) -> None:
        """Add the names that every expression sees."""
        for name, about in PREDEFINED.items():
            self.add(name, _CONSTANT, documentation=about, rank="8")
        for name in USEFUL_BUILTINS:
            self.add(name, _FUNCTION, detail="Python", rank="9")

    def add_parts(self, program: Program, *, is_key: bool = False) -> None:
        """Add the names of parts, links and frames."""
        for text in program.texts:
            for named in text.parts.named:
                for name in (named.name, named.link):
                    if name is not None and " " not in name:
                        text_of_it = self._key(name) if is_key else name
                        self.add(name, _REFERENCE, text=text_of_it, detail=named.kind, rank="1")
        for result in self._workspace.results_of(self._text.path):
            robot = result.robot
            for name in robot.links if robot is not None else ():
                self.add(name, _REFERENCE, detail="link", rank="2")

    # --- files ------------------------------------------------------------------------------

    def add_modules(self) -> None:
        """Add Python modules, those beside the file first."""
        for name in _listed(self._text.folder):
            if name.endswith(".py") and name[:-3].isidentifier():
                self.add(name[:-3], _MODULE, detail="beside this file", rank="1")
        for name in _MODULES:
            self.add(name, _MODULE, rank="2")

    def add_files(self, typed: str) -> None:
        """Add the files and folders in the folder that is typed so far."""
        folder, slash, _ = typed.rpartition("/")
        where: str | None = self._text.folder
        if slash:
            where = self._workspace.resolve(self._text, folder + slash + "x")
            where = os.path.dirname(where) if where is not None else None
        for name in _listed(where) if where is not None else ():
            path = os.path.join(where or "", name)
            if name.startswith(".") or path == self._text.path:
                continue
            if os.path.isdir(path):
                self.add(name, _FOLDER, text=f"{name}/", rank="4")
            else:
                self.add(name, _FILE, rank="3")
        if not slash or typed.rpartition("/")[0] == "package:/":
            is_begun = slash != ""  # `package://` is there then
            for name in self._workspace.finder.names(self._text.folder)[:MOST_FILES]:
                label, new = (name, f"{name}/") if is_begun else (f"package://{name}/", None)
                self.add(label, _FOLDER, text=new, detail="package", rank="5")


def _listed(folder: str) -> list[str]:
    try:
        return sorted(os.listdir(folder))[:MOST_FILES]
    except OSError:
        return []


# --- one request ------------------------------------------------------------------------------


_MARK = "yamaroCursor"
_WORD = re.compile(r"[\w.]*$")
_KEY_LINE = re.compile(r"\s*(?:- +)*$")
_FLOW_KEY = re.compile(r"[{,]\s*$")
_ATTRIBUTES = re.compile(r"<?([\w.:-]*[\w.-])\s*/((?:(?!: ).)*)")
_PYTHON_KEYS = ("condition", "in", "range")
MOST = 1_000
"""Items that are offered."""


def completion(workspace: Workspace, parameters: Json) -> Json:
    """Return what can be written at a place."""
    text = workspace.text_at(parameters)
    offset = workspace.offset_in(text, parameters)
    is_quote = (parameters.get("context") or {}).get("triggerCharacter") in ('"', "'", "<")
    items = Items(workspace, text, offset, signs="_" if text.is_yaml else "_-")
    if text.is_yaml and not is_quote:
        Completion(workspace, text, offset, items).run()
    elif not text.is_yaml and not text.is_foreign:
        from .xml_completion import XmlCompletion
        from .xml_names import format_of

        if not format_of(text.xml):
            XmlCompletion(workspace, text, offset, items).run()
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
            name, written = attributes[1], attributes[2]
            last = written.rpartition(",")[2]
            if "=" in last:
                attribute = last.partition("=")[0].strip().removesuffix(":")
                self._items.add_attribute_values(self._program(), name, attribute)
            else:
                self._items.add_attributes(name)
                if "=" not in written:
                    self._items.add_scopes()
            return
        word = _WORD.search(before)
        typed = word[0] if word is not None else ""
        is_key = self._is_at_key(before[: len(before) - len(typed)])
        cursor = run_on_deep_stack(lambda: self._read(typed, is_key=is_key))
        if is_key:
            self._keys(place_below(cursor.keys), cursor)
        if not (is_key and cursor.scalar is not None and cursor.is_key):
            self._values(cursor)  # for keys too if nothing is there yet, or the text is faulty

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
        line = self._line + tail
        pending: list[str] = []  # the brackets that the line leaves open: no YAML follows them
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
        closed = tail + "".join(reversed(pending))
        source = Source(text[:start] + mark + closed + text[line_end:], name=self._text.path)
        reading = read_on(source, reporter=Reporter())
        return cursor_at(reading.root, start + (mark.startswith(" ")) + 1)

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
            context = self._text.names.context_at(self._offset)
            for function in self._program().functions(self._text, place.call, context):
                items.add_parameters(function, present)
            items.add_words("statement", ())
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
        if place.name == "controller":
            for key, value in pairs:
                known = known_type(value.text) if isinstance(value, ScalarNode) else None
                if key.text == "type" and known is not None:
                    items.add_words(f"controller {known.word}", present)
        if place.name in CONTENTS or place.name == XML:
            if place.name != ROOT:
                items.add_words("statement", ())
                self._functions()
            if place.name == ANY:
                for name in ("part", "joint", "link"):
                    items.add_words(name, present)
        if place.name == "include" or place.name == "attach":
            for key, value in cursor.mapping.pairs if cursor.mapping is not None else ():
                if key.text == "path" and isinstance(value, ScalarNode):
                    path = self._workspace.resolve(self._text, value.text)
                    file = self._workspace.text_of(path) if path is not None else None
                    if file is not None and file.is_yaml:
                        self._items.add_passed(file, present)
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

    # --- values -----------------------------------------------------------------------------

    def _values(self, cursor: Cursor) -> None:
        if not cursor.keys:
            return
        words = cursor.words()
        key, place = words[-1], place_below(cursor.keys[:-1])
        if (key in _PYTHON_KEYS and place.name in ("if", "for")) or key == "process":
            self._names(self._line)
        else:
            typed = self._line.rpartition(": ")[2].lstrip(" '\"[")
            self._items.add_values(self._program(), place, key, words, typed)
            if key[:1].isupper() or place.name == "call":
                context = self._text.names.context_at(self._offset)
                for function in self._program().functions(self._text, key, context):
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


# --- parameters of a call being written -------------------------------------------------------


def signature_help(workspace: Workspace, parameters: Json) -> Json:
    """Return the signature, with the parameter that is being written."""
    text = workspace.text_at(parameters)
    offset = workspace.offset_in(text, parameters)
    if not text.is_yaml:
        return None
    name, index, given = _call_at(text, offset)
    if not name:
        return None
    program = Program(workspace, text.path)
    context = text.names.context_at(offset)
    signatures: list[Json] = []
    for place in program.functions(text, name, context):
        node = place.declaration.node if place.declaration is not None else None
        if isinstance(node, FunctionNode):
            names = [each.name for each in node.parameters]
            active = names.index(given) if given in names else index
            signature: Json = {
                "label": f"{node.name}({', '.join(each.text for each in node.parameters)})",
                "parameters": [{"label": each.text} for each in node.parameters],
                "activeParameter": active,
            }
            comment = place.text.comment_on(place.span)
            if comment:
                signature["documentation"] = comment
            signatures.append(signature)
    if not signatures:
        return None
    active = signatures[0]["activeParameter"]
    return {"signatures": signatures, "activeSignature": 0, "activeParameter": active}


def _call_at(text: Text, offset: int) -> tuple[str, int, str]:
    """Return the function called at an offset, the number of the argument, and its name."""
    start = max(text.text.rfind("\n", 0, offset), text.text.rfind("\r", 0, offset)) + 1
    line = text.text[start:offset]
    key, colon, rest = line.lstrip(" -").partition(":")
    if colon and key[:1].isupper() and key.replace(".", "").isidentifier():
        pieces: list[str] = []  # the arguments that are written so far
        depth = at = begin = 0
        while at < len(rest):
            if rest.startswith("$(", at):
                close = find_close(rest, at + 2)
                at = close if close >= 0 else len(rest)
            elif rest[at : at + 1] in "[{":
                depth += 1
            elif rest[at : at + 1] in "]}":
                depth -= 1
            elif rest[at : at + 1] == "," and depth <= 0:
                pieces.append(rest[begin:at])
                begin = at + 1
            at += 1
        name, sign, _ = rest[begin:].partition("=")
        return key, len(pieces), name.strip() if sign else ""
    cursor = cursor_at(text.root, offset)
    for depth in range(len(cursor.keys), 0, -1):
        place = place_below(cursor.keys[:depth])
        if place.name == "call":
            inner = cursor.keys[depth:]
            scalar = cursor.scalar
            given = inner[0].text if inner else scalar.text if scalar is not None else ""
            return place.call, 0, given
    return "", 0, ""
