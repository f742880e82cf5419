"""Changes of files: renaming, quick fixes, formatting."""

from __future__ import annotations

import re
from fnmatch import fnmatchcase

from ...allowances import acceptance
from ...diagnostics import YamaroError
from ...layout import LayoutFault, formatted
from ...source import Span
from ...syntax.names import is_function_name, is_identifier, python_name
from ...syntax.nodes import IncludeNode, VariableEntry
from ...syntax.symbol_table import ARGUMENT, ASSIGNED, CALLED, FILE, IMPORTED, VARIABLE
from .bindings import Place, Program, visible_names
from .findings import diagnostic_json, diagnostics_of
from .parts import Named, Reference
from .protocol import RequestFailed, offset_at, path_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from .protocol import Json
    from .workspace import Text, Workspace

_PART_NAME = re.compile(r"[^\s$,'\"#:{}\[\]&*!|>%@`]+")


def rename(workspace: Workspace, parameters: Json) -> Json:
    """Return the edits; raise RequestFailed with the reason if there are none."""
    text = workspace.text_at(parameters)
    renaming = Renaming(workspace, text, workspace.offset_in(text, parameters))
    return workspace_edit(workspace, renaming.edits(str(parameters["newName"])))


def workspace_edit(workspace: Workspace, edits: Sequence[tuple[Span, str]]) -> Json:
    """Return edits as the protocol has them, with the versions of open files if it can."""
    by_path: dict[str, list[Json]] = {}
    for span, new in edits:
        edit = {"range": workspace.range(span), "newText": new}
        by_path.setdefault(span.source.path, []).append(edit)
    client = (workspace.client.get("workspace") or {}).get("workspaceEdit") or {}
    if not client.get("documentChanges"):
        return {"changes": {workspace.uri(path): own for path, own in by_path.items()}}
    changes = []
    for path, own in by_path.items():
        opened = workspace.open.get(path)
        version = opened.version if opened is not None else None
        document = {"uri": workspace.uri(path), "version": version}
        changes.append({"textDocument": document, "edits": own})
    return {"documentChanges": changes}


class Renaming:
    """What is under the cursor, if it can be renamed."""

    def __init__(self, workspace: Workspace, text: Text, offset: int) -> None:
        """Find it.

        Raises:
            RequestFailed: it cannot be renamed; the text says why.
        """
        if not text.is_yaml:
            raise RequestFailed("names in XML files cannot be renamed here")
        self._workspace = workspace
        self._text = text
        self._program = Program(workspace, text.path)
        self._place = self._program.at(text, offset)
        self._places: list[Place] = []
        self._part: Named | None = None
        self._word = ""
        if self._place is not None:
            self.span, self.name = self._place.span, self._place.name
            self._places = self._program.places(self._place)
            self._check_name(self._place)
            return
        found = text.parts.at(offset)
        if found is None:
            raise RequestFailed("there is no variable, function, parameter or part here")
        self.span, self.name = self._find_part(found, offset)

    def edits(self, new: str) -> list[tuple[Span, str]]:
        """Return the places to change and what to write there.

        Raises:
            RequestFailed: the new name is not valid, or taken.
        """
        if self._part is not None:
            return self._part_edits(self._part, new)
        self._check_new_name(new)
        return [(place.span, new) for place in self._places]

    # --- variables and functions ------------------------------------------------------------

    def _check_name(self, place: Place) -> None:
        name = place.name
        if not self._places:
            if place.use is not None and isinstance(place.use.owner, IncludeNode):
                raise RequestFailed(f"'{name}' is a variable of a file that cannot be read here")
            raise RequestFailed(
                f"'{name}' is not declared in these files: it is predefined or from Python"
            )
        for each in self._places:
            declaration, use = each.declaration, each.use
            if each.span.written() != name:
                raise RequestFailed(f"'{name}' is written as '{each.span.written()}' elsewhere")
            is_assigned = declaration is not None and declaration.kind == ASSIGNED
            if is_assigned or (use is not None and use.is_assigned):
                raise RequestFailed(f"'{name}' is assigned in `process` at {each.span.place()}")
            if declaration is None:
                continue
            if declaration.kind == IMPORTED:
                raise RequestFailed(f"'{name}' comes from Python")
            node = declaration.node
            if isinstance(node, VariableEntry) and len(node.values) > 1:
                raise RequestFailed(f"'{name}' is given several times at {each.span.place()}")
            path = each.text.path
            is_of_file = declaration.context.kind == FILE
            is_passable = is_of_file and declaration.kind in (VARIABLE, ARGUMENT)
            if is_passable and self._workspace.mains_of(path) == [path]:
                passed = self._workspace.settings.arguments_of(path)
                # An argument of the old name would be unknown then.
                if name in [text.partition(":=")[0] for text in passed]:
                    raise RequestFailed(f"'{name}' is passed by the settings of the editor")
        computed = [text for text in self._program.texts if text.names.has_computed]
        is_variable = any(
            each.declaration is not None and each.declaration.kind == VARIABLE
            for each in self._places
        )
        if computed and is_variable:
            file = computed[0].path
            raise RequestFailed(f"'{name}' may be meant by a name that is computed in {file}")

    def _check_new_name(self, new: str) -> None:
        assert self._place is not None
        is_called = any(
            each.declaration is not None and each.declaration.kind in CALLED
            for each in self._places
        )
        if is_called:
            if not is_function_name(new) or "." in new:
                raise RequestFailed(f"'{new}' is not a name of a function: write a capital first")
        elif not is_identifier(new) or python_name(new) != new:
            raise RequestFailed(f"'{new}' is not a name of a variable")
        for each in self._places:
            found = each.declaration or each.use
            assert found is not None
            for other in visible_names(self._program, each.text, found.context):
                declared = other.declaration
                assert declared is not None
                if other.name == new and (declared.kind in CALLED) == is_called:
                    raise RequestFailed(f"'{new}' is declared already, at {other.span.place()}")

    # --- parts ------------------------------------------------------------------------------

    def _find_part(self, found: Named | Reference, offset: int) -> tuple[Span, str]:
        """Return the word under the cursor, having found the part it means."""
        if found.name is None or "$" in found.name:
            raise RequestFailed(f"the name '{found.span.written()}' is computed")
        named: list[Named] = [found] if isinstance(found, Named) else []
        if isinstance(found, Reference):
            named = [
                each
                for text in self._program.texts
                for each in text.parts.named
                if each.answers_to(found.name)
            ]
        if not named:
            raise RequestFailed(f"no part is named '{found.name}' in these files")
        if len({(each.span.source.path, each.span.start) for each in named}) > 1:
            raise RequestFailed(f"several parts are named '{found.name}'")
        part = self._part = named[0]
        assert part.name is not None
        words = part.name.split()
        self._word = words[0]
        if len(words) == 2:
            at = offset - found.span.start if found is part else -1
            is_second = at > part.name.find(words[1]) - 1 if at >= 0 else found.name == words[1]
            self._word = words[is_second]
        if found is part:
            start = part.span.start + part.span.written().find(self._word)
            return Span(part.span.source, start, start + len(self._word)), self._word
        return found.span, found.name

    def _part_edits(self, part: Named, new: str) -> list[tuple[Span, str]]:
        assert part.name is not None
        is_pair = len(part.name.split()) == 2
        if self.name != self._word:  # a reference such as wheel_link, whose part is `wheel`
            before, _, after = self.name.partition(self._word)
            if not (new.startswith(before) and new.endswith(after)):
                raise RequestFailed(f"the part is named '{self._word}': keep '{before}*{after}'")
            new = new[len(before) : len(new) - len(after)]
        if not _PART_NAME.fullmatch(new):
            raise RequestFailed(f"'{new}' is not a name of a part: write one word")
        renamed = {self._word: new}  # the part, its link and its joint
        for name in (part.link, part.joint):
            if name is not None and not is_pair and self._word in name:
                renamed[name] = name.replace(self._word, new, 1)
        start = part.span.start + part.span.written().rfind(self._word)
        own = Span(part.span.source, start, start + len(self._word))
        edits = [(own, new)]
        has_prefixes = any(
            include.node.own_prefix is not None
            for text in self._program.texts
            for include in text.names.includes
        )
        for text in self._program.texts:
            for each in text.parts.references:
                if each.name in renamed:
                    edits.append((each.span, renamed[each.name]))
                elif each.is_computed:
                    pattern = "".join(_pattern(each.name))
                    if any(re.fullmatch(pattern, old, re.DOTALL) for old in renamed):
                        raise RequestFailed(f"a computed name may mean it, at {each.span.place()}")
                elif "*" in each.name:
                    for old, later in renamed.items():
                        if fnmatchcase(old, each.name) != fnmatchcase(later, each.name):
                            raise RequestFailed(f"the pattern at {each.span.place()} would not fit")
                elif has_prefixes and any(each.name.endswith(old) for old in renamed):
                    raise RequestFailed(f"'{each.name}' may mean it, at {each.span.place()}")
            for other in text.parts.named:
                if other is not part and other.name in renamed.values():
                    raise RequestFailed(f"'{other.name}' is named already, {other.span.place()}")
        return edits


def _pattern(text: str) -> Iterator[str]:
    """Yield a regular expression for what a text with `$(…)` may become."""
    from ...syntax.python import skip_expression

    at = 0
    while at < len(text):
        after = skip_expression(text, at)
        if after > at:
            yield ".*"
            at = after
        else:
            yield re.escape(text[at])
            at += 1


def rename_range(workspace: Workspace, parameters: Json) -> Json:
    """Return the stretch and its name; raise RequestFailed with the reason if it is fixed."""
    text = workspace.text_at(parameters)
    renaming = Renaming(workspace, text, workspace.offset_in(text, parameters))
    return {"range": workspace.range(renaming.span), "placeholder": renaming.name}


# --- quick fixes ------------------------------------------------------------------------------


def code_actions(workspace: Workspace, parameters: Json) -> Json:
    """Return the fixes of the diagnostics in a range; one that is certain is preferred.

    Those that only accept a finding come last.
    """
    text = workspace.text_at(parameters)
    path = path_of(parameters["textDocument"]["uri"])
    asked = parameters["range"]
    start = offset_at(text.source, asked["start"], workspace.encoding)
    end = offset_at(text.source, asked["end"], workspace.encoding)
    only = (parameters.get("context") or {}).get("only")
    if only and not any(kind in ("", "quickfix") for kind in only):
        return []
    actions: list[Json] = []
    acceptances: list[Json] = []
    for found in diagnostics_of(workspace, path):
        span = found.span
        if span.end < start or span.start > end:
            continue
        for fix in (found.fix, acceptance(found)):
            if fix is None:
                continue
            edits = [(edit.span, edit.text) for edit in fix.edits]
            action = {
                "title": fix.title,
                "kind": "quickfix",
                "diagnostics": [diagnostic_json(workspace, found, path)],
                "isPreferred": fix.is_safe,
                "edit": workspace_edit(workspace, edits),
            }
            (actions if fix is found.fix else acceptances).append(action)
    return [*actions, *acceptances]


# --- formatting -------------------------------------------------------------------------------


def formatting(workspace: Workspace, parameters: Json) -> Json:
    """Return the edits; raise RequestFailed for a file that is not YAML."""
    text = workspace.text_at(parameters)
    if not text.is_yaml:
        raise RequestFailed("only YAML files are formatted")
    if not text.text.strip():  # each editor formats when it saves, also a file that just begins
        return []
    try:
        new = formatted(text.source)
    except YamaroError as error:
        first = error.diagnostics[0]
        line, _ = first.span.location()
        raise RequestFailed(f"line {line}: {first.message}") from None
    except LayoutFault as error:
        raise RequestFailed(str(error)) from None
    return _edits(workspace, text, new)


def _edits(workspace: Workspace, text: Text, new: str) -> list[Json]:
    """Return an edit for each stretch of lines that differ, so that the cursor stays."""
    from difflib import SequenceMatcher

    old_lines, new_lines = text.text.splitlines(keepends=True), new.splitlines(keepends=True)
    starts = [0]
    for line in old_lines:
        starts.append(starts[-1] + len(line))
    if len(old_lines) == len(new_lines):  # the usual case, for which no search is needed
        changed = [
            (i, i + 1, i, i + 1)
            for i, (old, other) in enumerate(zip(old_lines, new_lines, strict=True))
            if old != other
        ]
    else:
        matcher = SequenceMatcher(None, old_lines, new_lines, autojunk=False)
        changed = [codes[1:] for codes in matcher.get_opcodes() if codes[0] != "equal"]
    return [
        {
            "range": {
                "start": workspace.position(text, starts[first]),
                "end": workspace.position(text, starts[last]),
            },
            "newText": "".join(new_lines[other_first:other_last]),
        }
        for first, last, other_first, other_last in changed
    ]
