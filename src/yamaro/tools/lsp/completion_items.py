"""The items of a completion, each with what is shown and what is written."""

from __future__ import annotations

import os

from ...syntax.nodes import LOCAL, SCOPES, FunctionNode, Parameter
from .comments import comment_on
from .manual import MANUAL, PREDEFINED, USEFUL_BUILTINS, VALUES
from .names import ARGUMENT, CALLED, FUNCTION_NAME, VARIABLE

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .bindings import Place as NamePlace
    from .bindings import Program
    from .contexts import Place
    from .texts import Text
    from .wire import Json
    from .workspace import Workspace

_FUNCTION, _FIELD, _VARIABLE, _MODULE, _PROPERTY = 3, 5, 6, 9, 10
_VALUE, _ENUM, _KEYWORD, _SNIPPET, _FILE, _REFERENCE = 12, 13, 14, 15, 17, 18
_FOLDER, _CONSTANT = 19, 21
_WITH_BODY = frozenset(
    "model variables functions arguments part joint link visual collision inertial limit dynamics "
    "safety_controller calibration material frame sensor actuator surface attach mirror loop "
    "control states groups collisions naming body else input".split()
)
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

    def __init__(self, workspace: Workspace, text: Text, offset: int) -> None:
        """Complete the word at an offset."""
        self.found: list[Json] = []
        self._workspace = workspace
        self._text = text
        self._seen: set[str] = set()
        start = offset
        while start > 0 and (text.text[start - 1].isalnum() or text.text[start - 1] == "_"):
            start -= 1
        self._range = {
            "start": workspace.position(text, start),
            "end": workspace.position(text, offset),
        }
        end = offset
        while end < len(text.text) and (text.text[end].isalnum() or text.text[end] == "_"):
            end += 1
        self._has_colon = text.text[end : end + 1] == ":"
        item = ((workspace.client.get("textDocument") or {}).get("completion") or {}).get(
            "completionItem"
        ) or {}
        self._has_snippets = bool(item.get("snippetSupport"))

    def add(
        self,
        label: str,
        kind: int,
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
        item: Json = {"label": label, "kind": kind, "sortText": f"{rank}{label}"}
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
        from ...model.schema import ELEMENTS

        rule = ELEMENTS.get(element)
        for name in rule.children if rule is not None else ():
            self.add(name, _FIELD, text=self._key(name), detail="XML element", rank="7")

    def add_attributes(self, element: str) -> None:
        """Add the attributes of an XML element."""
        from ...model.schema import ELEMENTS

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
            self._materials(program)
        if key in _PATHS:
            self._files(typed)
        if key == "import" or words[:1] == ["import"]:
            self.add_modules()
        if name == "call" or key in ("print",):
            return
        if name == "control" and key == "state":
            self._states(program)

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
            documentation=comment_on(place.text, declared.span),
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
            if not each.is_block or sign == ": ":
                self.add(each.name, _FIELD, text=text, detail=_about(each), rank="0")

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

    def _materials(self, program: Program) -> None:
        for result in self._workspace.results_of(self._text.path):
            robot = result.robot
            for name in robot.materials if robot is not None else ():
                self.add(name, _REFERENCE, detail="material", rank="1")

    def _states(self, program: Program) -> None:
        for result in self._workspace.results_of(self._text.path):
            robot = result.robot
            for name in robot.states if robot is not None else ():
                self.add(name, _REFERENCE, detail="state", rank="1")

    # --- files ------------------------------------------------------------------------------

    def add_modules(self) -> None:
        """Add Python modules, those beside the file first."""
        for name in _listed(self._text.folder):
            if name.endswith(".py") and name[:-3].isidentifier():
                self.add(name[:-3], _MODULE, detail="beside this file", rank="1")
        for name in _MODULES:
            self.add(name, _MODULE, rank="2")

    def _files(self, typed: str) -> None:
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
            self._packages(is_begun=slash != "")

    def _packages(self, *, is_begun: bool) -> None:
        """Add the packages that can be found; `package://` is there if it is begun."""
        from .builds import finder_of

        finder = finder_of(self._workspace.settings)
        for name in finder.names(self._text.folder)[:MOST_FILES]:
            label, new = (name, f"{name}/") if is_begun else (f"package://{name}/", None)
            self.add(label, _FOLDER, text=new, detail="package", rank="5")


def _listed(folder: str) -> list[str]:
    try:
        return sorted(os.listdir(folder))[:MOST_FILES]
    except OSError:
        return []


def _about(parameter: Parameter) -> str:
    if parameter.is_block:
        return "block"
    return parameter.text if parameter.default is not None else "required"
