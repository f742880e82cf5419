"""Completion in URDF and xacro: tags, macros with their parameters, names, files, packages."""

from __future__ import annotations

import re

from ...model.schema import ELEMENTS
from ...xacro.evaluator import predefined
from ...xacro.names import PARAMETER, TAGS
from ...xacro.statements import PREFIX
from ...xacro.symbol_table import ARGUMENT, MACRO, PROPERTY, definition_of
from .contexts import PREDEFINED, about
from .robot_xml import (
    BODY,
    JOINT,
    LINK,
    MATERIAL,
    RobotFiles,
    comment_above,
    kind_of_attribute,
    listed,
    parameter_texts,
    values_of,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ...xacro.names import Name
    from .completion import Items
    from .workspace import Text, Workspace

_EXPRESSION = re.compile(r"\$\{([^{}]*)$")
_SUBSTITUTION = re.compile(r"\$\(([^()]*)$")
_COMMAND = re.compile(r"(arg|find|eval)\s+(.*)", re.DOTALL)
_COMMANDS = {
    "arg": "an argument of the file",
    "find": "the folder of a package",
    "env": "a variable of the environment",
    "optenv": "a variable of the environment, or a default",
    "eval": "Python, in which arguments are names",
    "cwd": "the current folder",
}
_TAG = re.compile(r"<(/?)([\w:.-]*)")
_ATTRIBUTE = re.compile(r"\s*([\w:.-]+)\s*=\s*(\"[^\"]*\"|'[^']*')")
_IN_VALUE = re.compile(r"\s+([\w:.-]+)\s*=\s*[\"']([^\"']*)$")
_TRUTHS = ("true", "false")
_VALUES = {
    ("xacro:property", "scope"): ("parent", "global"),
    ("xacro:property", "lazy_eval"): _TRUTHS,
    ("xacro:property", "remove"): _TRUTHS,
    ("xacro:include", "optional"): _TRUTHS,
}
_FILES = {("xacro:include", "filename"), ("mesh", "filename"), ("texture", "filename")}
_TAGS_OF_XACRO = {
    "arg": 'arg name="${1:name}" default="$2"/>',
    "if": 'if value="\\${${1:condition}}">\n  $0\n</xacro:if>',
    "include": 'include filename="$1"/>',
    "insert_block": 'insert_block name="$1"/>',
    "macro": 'macro name="${1:name}" params="$2">\n  $0\n</xacro:macro>',
    "property": 'property name="${1:name}" value="$2"/>',
    "unless": 'unless value="\\${${1:condition}}">\n  $0\n</xacro:unless>',
}


class XmlCompletion:
    """One request."""

    def __init__(self, workspace: Workspace, text: Text, offset: int, items: Items) -> None:
        self._workspace = workspace
        self._text = text
        self._offset = offset
        self._items = items
        self._files = RobotFiles(workspace, text.path)

    def run(self) -> None:
        """Add the items for the place."""
        text, offset = self._text.text, self._offset
        start = max(text.rfind("<", 0, offset), 0)
        before = text[start:offset]
        is_comment = text.rfind("<!--", 0, offset) > text.rfind("-->", 0, offset)
        if is_comment or before.startswith(("<?", "<!")):
            return
        computed = _EXPRESSION.search(before)
        if computed is not None:
            self._expression(computed[1])
            return
        substitution = _SUBSTITUTION.search(before)
        if substitution is not None:
            self._substitution(substitution[1])
            return
        tag = _TAG.match(before)
        if tag is None:
            return
        if tag.end() == len(before):
            if tag[1]:
                around = self._text.tags.around(start)
                if around:
                    self._items.add(around[-1].name, "field", text=f"{around[-1].name}>")
            else:
                self._tag(start, tag[2])
            return
        at, given = tag.end(), []
        while (found := _ATTRIBUTE.match(before, at)) is not None:
            given.append(found[1])
            at = found.end()
        rest = before[at:]
        value = _IN_VALUE.fullmatch(rest)
        if value is not None:
            self._value(tag[2], value[1], value[2])
        elif ">" not in rest and re.fullmatch(r"\s+[\w:.-]*", rest):
            self._attribute(tag[2], given)

    # --- what is computed -------------------------------------------------------------------

    def _expression(self, before: str) -> None:
        space = re.search(r"(\w+)\.\w*$", before)
        texts = None
        if space is not None:
            if space[1] in ("math", "python", "xacro"):
                for label in _predefined()[space[1]]:
                    self._items.add(label, "function", detail=space[1])
                return
            texts = list(self._files.in_namespace(self._text, space[1]))
        macro = self._macro_around()
        for own, name in self._files.defined(PROPERTY, PARAMETER):
            is_inner = name.macro is not None
            if (texts is not None and own.path not in texts) or (
                is_inner
                and (name.macro is not macro or own is not self._text)
                and "scope" not in name.element.attributes
            ):
                continue
            detail = name.element.attributes.get("value", name.kind)
            values = values_of(self._workspace, own, name.span, name.name)
            self._items.add(
                name.name,
                "variable",
                detail=str(detail)[:80],
                documentation=f"value: {listed(values)}" if values else "",
                rank="1" if is_inner else "2",
            )
        if texts is None:
            for label in _predefined():
                if not label.startswith("_"):
                    known = PREDEFINED.get(label, "")
                    self._items.add(label, "constant", documentation=known, rank="8")

    def _macro_around(self) -> object:
        """Return the macro that the cursor is in, or None."""
        starts = {
            tag.start + 1
            for tag in self._text.tags.around(self._offset)
            if tag.name == "xacro:macro"
        }
        found = None
        for name in self._text.robot_names.found:
            if name.kind == MACRO and name.is_definition and name.element.span.start in starts:
                found = name.element  # the innermost comes last
        return found

    def _substitution(self, before: str) -> None:
        command = _COMMAND.fullmatch(before)
        if command is None:
            for word, known in _COMMANDS.items():
                if re.fullmatch(r"\w*", before):
                    self._items.add(word, "keyword", documentation=known)
            return
        if command[1] == "find":
            for package in self._workspace.finder.names(self._text.folder)[:_MOST_PACKAGES]:
                self._items.add(package, "module", detail="package")
            return
        for _, name in self._files.defined(ARGUMENT):
            default = str(name.element.attributes.get("default", ""))
            self._items.add(name.name, "variable", detail=default[:80])

    # --- tags -------------------------------------------------------------------------------

    def _tag(self, start: int, typed: str) -> None:
        items, text = self._items, self._text
        is_xacro = typed.startswith(PREFIX)
        follows = text.text[self._offset : self._offset + 1]
        is_new = not follows or follows in "\r\n<"
        for own, name in self._files.defined(MACRO):
            items.add(
                name.name if is_xacro else f"{PREFIX}{name.name}",
                "function",
                detail=" ".join(parameter_texts(name.element))[:200],
                documentation=comment_above(own, name.element),
                snippet=_call(name, is_xacro=is_xacro) if is_new else None,
                rank="1",
            )
        for tag, snippet in _TAGS_OF_XACRO.items():
            prefix = "" if is_xacro else PREFIX
            whole = f"{prefix}{snippet}" if is_new else None
            items.add(f"{prefix}{tag}", "keyword", detail="xacro", snippet=whole, rank="4")
        if is_xacro:
            return
        around = [each.name for each in text.tags.around(start)]
        inside = next((each for each in reversed(around) if not each.startswith("xacro:")), "robot")
        rule = ELEMENTS.get(inside)
        for child in rule.children if rule is not None else ():
            items.add(child, "field", detail=f"in <{inside}>", rank="2")

    def _attribute(self, tag: str, given: list[str]) -> None:
        follows = self._text.text[self._offset :].lstrip("\t ")[:1]
        known: dict[str, str] = {}
        ranks: dict[str, str] = {}
        own = tag.removeprefix(PREFIX)
        if tag.startswith(PREFIX) and own in TAGS:
            known = dict.fromkeys(TAGS[own], "")
        elif tag.startswith(PREFIX):
            for _, name in self._files.defined(MACRO):
                if name.name == own.rpartition(".")[2]:
                    defined = definition_of(name.element)
                    for each in defined.parameters() if defined is not None else ():
                        if not each.is_block:
                            has_default = each.is_forwarded or each.default is not None
                            shown = each.default or "what the caller has"
                            known[each.name] = f"default: {shown}" if has_default else "required"
                            ranks[each.name] = "2" if has_default else "1"
        else:
            rule = ELEMENTS.get(tag)
            for field in rule.attributes if rule is not None else ():
                known[field] = about(tag, field) or ""
        for label, detail in known.items():
            if label not in given:
                snippet = None if follows == "=" else f'{label}="$1"'
                rank = ranks.get(label, "2")
                self._items.add(label, "field", detail=detail, snippet=snippet, rank=rank)

    # --- values -----------------------------------------------------------------------------

    def _value(self, tag: str, attribute: str, typed: str) -> None:
        rule = ELEMENTS.get(tag)
        field = rule.attributes.get(attribute) if rule is not None else None
        for word in (field.choices if field is not None else ()) or ():
            self._items.add(word, "enum", rank="1")
        for word in _VALUES.get((tag, attribute), ()):
            self._items.add(word, "enum", rank="1")
        if (tag, attribute) in _FILES:
            self._items.add_files(typed)
        elif tag == "xacro:insert_block":
            for _, name in self._files.defined(PARAMETER):
                self._items.add(name.name, "variable", detail="block")
        else:
            self._bodies(kind_of_attribute(tag, attribute))

    def _bodies(self, kind: str) -> None:
        if kind not in (LINK, JOINT, BODY, MATERIAL):
            return
        kinds = (LINK, JOINT) if kind == BODY else (kind,)
        for _, name in self._files.defined(*kinds):
            self._items.add(name.name, "reference", detail=name.kind, rank="1")
        for result in self._workspace.results_of(self._text.path):
            robot = result.robot
            if robot is None:
                continue
            every = {LINK: robot.links, JOINT: robot.joints, MATERIAL: robot.materials}
            for each in kinds:
                for label in every[each]:
                    self._items.add(label, "reference", detail=each, rank="2")


_MOST_PACKAGES = 500


class _NoActions:
    """What the functions of expressions do where only their names are wanted."""

    def __getattr__(self, name: str) -> None:
        return None


def _predefined() -> dict[str, Any]:
    """Return the names that every expression sees, with those in the namespaces among them."""
    return predefined(_NoActions())  # type: ignore[arg-type]


def _call(name: Name, *, is_xacro: bool) -> str:
    """Return the snippet of a call: what has no default, and the blocks."""
    tag = name.name if is_xacro else f"{PREFIX}{name.name}"
    defined = definition_of(name.element)
    parameters = defined.parameters() if defined is not None else []
    needed = [
        each
        for each in parameters
        if not each.is_block and each.default is None and not each.is_forwarded
    ]
    values = "".join(f' {each.name}="${index}"' for index, each in enumerate(needed, 1))
    if any(each.is_block for each in parameters):
        return f"{tag}{values}>\n  $0\n</{PREFIX}{name.name}>"
    return f"{tag}{values}/>$0"
