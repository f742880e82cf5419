"""Which declaration a name means, in all files of a program, without running it."""

from __future__ import annotations

from ...syntax.nodes import LOCAL, PARENT, CallNode, IncludeNode
from ...syntax.symbol_table import (
    ARGUMENT,
    BLOCK,
    CALLED,
    FILE,
    IMPORTED,
    NAMESPACE,
    VARIABLE,
    Context,
    Declaration,
    Use,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from ...source import Span
    from .workspace import Text, Workspace

Key = tuple[object, ...]
"""What is equal for all places that mean the same variable, function or parameter."""


class Place:
    """A name in a file, where it is declared or used."""

    __slots__ = ("declaration", "text", "use")

    def __init__(self, text: Text, *, declaration: Declaration | None, use: Use | None) -> None:
        self.text = text
        self.declaration = declaration
        self.use = use

    @property
    def name(self) -> str:
        """Return the name."""
        return self._found.name

    @property
    def span(self) -> Span:
        """Return where it is written."""
        return self._found.span

    @property
    def _found(self) -> Declaration | Use:
        found = self.declaration or self.use
        assert found is not None
        return found


class Program:
    """The files that are run together, with the names in them."""

    def __init__(self, workspace: Workspace, path: str) -> None:
        """Take all files of the programs that a file is in."""
        self._workspace = workspace
        self.texts = [text for text in workspace.program_of(path) if text.is_yaml]
        self._shared: dict[tuple[str, bool], list[Place]] | None = None

    # --- what is at a place -----------------------------------------------------------------

    def at(self, text: Text, offset: int) -> Place | None:
        """Return the name that an offset is in, or right behind."""
        names = text.names
        for declaration in names.declarations:
            if declaration.span.start <= offset <= declaration.span.end:
                return Place(text, declaration=declaration, use=None)
        for use in names.uses:
            if use.span.start <= offset <= use.span.end:
                return Place(text, declaration=None, use=use)
        return None

    def key(self, place: Place) -> Key | None:
        """Return what is equal for all places that mean the same; None if nothing declares it."""
        if place.declaration is not None:
            return self._key_of(place.text, place.declaration)
        found = self.declarations(place)
        if found and found[0].declaration is not None:
            return self._key_of(found[0].text, found[0].declaration)
        use = place.use
        assert use is not None
        if isinstance(use.owner, IncludeNode):
            return ("passed", self._included(place.text, use.owner), use.name)
        if not use.is_called and use.owner is None and self._passed_to(place.text, use.name):
            return ("passed", place.text.path, use.name)
        return None

    def _key_of(self, text: Text, declaration: Declaration) -> Key:
        is_called = declaration.kind in CALLED
        same = declaration.context.find(declaration.name, is_called=is_called)
        is_root = declaration.context.kind == FILE and declaration.kind in (VARIABLE, ARGUMENT)
        shared = self._shared_of(declaration.name, is_called=is_called)
        if any(each.scope != LOCAL for each in same) or (
            is_root and any(place.text is not text for place in shared)
        ):
            return ("shared", declaration.name, is_called)
        context = declaration.context
        return (text.path, context.kind, context.start, declaration.name, is_called)

    # --- declarations -----------------------------------------------------------------------

    def declarations(self, place: Place) -> list[Place]:
        """Return where a name is declared: the nearest context that has it, or other files."""
        if place.declaration is not None:
            declaration = place.declaration
            is_called = declaration.kind in CALLED
            own = declaration.context.find(declaration.name, is_called=is_called)
            return [Place(place.text, declaration=each, use=None) for each in own]
        use = place.use
        assert use is not None
        if isinstance(use.owner, CallNode):
            parameters = []
            for function in self.functions(place.text, use.owner.name, use.context):
                context = function_context(function)
                if context is None:
                    continue
                for is_called in (False, True):
                    parameters += [
                        Place(function.text, declaration=each, use=None)
                        for each in context.find(use.name, is_called=is_called)
                    ]
            return parameters
        if isinstance(use.owner, IncludeNode):
            file = self._file(self._included(place.text, use.owner))
            found = [] if file is None else file.names.file.find(use.name, is_called=False)
            return [
                Place(file, declaration=each, use=None)
                for each in found
                if file is not None and each.kind in (VARIABLE, ARGUMENT)
            ]
        if isinstance(use.owner, str):
            return [
                found
                for file in self._files_in(place.text, use.owner)
                for found in _declared_in(file, use.name, is_called=use.is_called)
            ]
        return self._visible(place.text, use.name, use.context, is_called=use.is_called)

    def _visible(
        self, text: Text, name: str, context: Context | None, *, is_called: bool
    ) -> list[Place]:
        start = context
        while context is not None:
            if context.kind == BLOCK and not is_called:
                inner = self._in_callee(text, context, name)
                if inner:
                    return inner
            found = context.find(name, is_called=is_called)
            if found:
                return [Place(text, declaration=each, use=None) for each in found]
            context = context.parent
        shared = self._shared_of(name, is_called=is_called)
        if shared:
            return shared
        if is_called and start is not None:
            return []
        return self._passed_to(text, name)

    def _in_callee(self, text: Text, block: Context, name: str) -> list[Place]:
        """Return the parameters and locals of the function that a block is passed to."""
        own = block.find(name, is_called=False)
        if own:
            return [Place(text, declaration=each, use=None) for each in own]
        found = []
        for function in self.functions(text, block.callee, block.parent):
            context = function_context(function)
            if context is not None:
                found += [
                    Place(function.text, declaration=each, use=None)
                    for each in context.find(name, is_called=False)
                ]
        return found

    def functions(self, text: Text, name: str, context: Context | None) -> list[Place]:
        """Return the functions that a call `Name` or `space.Name` may mean."""
        space, _, last = name.rpartition(".")
        if space:
            return [
                place
                for file in self._files_in(text, space)
                for place in _declared_in(file, last, is_called=True)
            ]
        found = self._visible(text, last, context, is_called=True)
        return [place for place in found if function_context(place) is not None]

    def _files_in(self, text: Text, space: str) -> Iterator[Text]:
        """Yield the files that are included into a namespace."""
        for include in text.names.includes:
            if include.node.namespace == space:
                file = self._file(self._included(text, include.node))
                if file is not None:
                    yield file

    def in_namespaces(self, text: Text) -> Iterator[tuple[str, Place]]:
        """Yield what includes of a file put into namespaces, each with its namespace."""
        for include in text.names.includes:
            space = include.node.namespace
            file = self._file(self._included(text, include.node))
            if file is None or not isinstance(space, str):
                continue  # without a namespace, or with one that is computed
            for each in file.names.declarations:
                if each.scope != LOCAL and each.kind not in (IMPORTED, NAMESPACE):
                    yield space, Place(file, declaration=each, use=None)

    def is_only_in_namespaces(self, file: Text) -> bool:
        """Return whether each include of a file puts what comes back into a namespace."""
        spaces = [
            include.node.namespace
            for text in self.texts
            for include in text.names.includes
            if include.path is not None and self._workspace.resolve(text, include.path) == file.path
        ]
        return bool(spaces) and all(spaces)

    # --- between files ----------------------------------------------------------------------

    def _included(self, text: Text, node: IncludeNode) -> str:
        for include in text.names.includes:
            if include.node is node and include.path is not None:
                return self._workspace.resolve(text, include.path) or ""
        return ""

    def _file(self, path: str) -> Text | None:
        return next((text for text in self.texts if text.path == path), None)

    def _passed_to(self, text: Text, name: str) -> list[Place]:
        """Return the arguments of includes that pass a variable to a file."""
        found = []
        for other in self.texts:
            for include in other.names.includes:
                passed = [each for each in include.node.arguments if each.name == name]
                if passed and self._included(other, include.node) == text.path:
                    found += [
                        Place(other, declaration=None, use=use)
                        for use in other.names.uses
                        if use.owner is include.node and use.name == name
                    ]
        return found

    def _shared_of(self, name: str, *, is_called: bool) -> list[Place]:
        """Return the declarations of a name that other contexts can see."""
        if self._shared is None:
            self._shared = {}
            for text in self.texts:
                for each in text.names.declarations:
                    if each.scope != LOCAL:
                        place = Place(text, declaration=each, use=None)
                        key = (each.name, each.kind in CALLED)
                        self._shared.setdefault(key, []).append(place)
        return self._shared.get((name, is_called), [])

    # --- all places -------------------------------------------------------------------------

    def places(self, place: Place) -> list[Place]:
        """Return all places that mean what a place means, in order of files and places."""
        key = self.key(place)
        if key is None:
            return []
        found = []
        for text in self.texts:
            own = [
                Place(text, declaration=each, use=None)
                for each in text.names.declarations
                if each.name == place.name and self._key_of(text, each) == key
            ]
            seen = {each.span.start for each in own}
            for use in text.names.uses:
                if use.name == place.name and use.span.start not in seen:
                    other = Place(text, declaration=None, use=use)
                    if self.key(other) == key:
                        seen.add(use.span.start)
                        own.append(other)
            found += sorted(own, key=lambda each: each.span.start)
        return found


def function_context(place: Place) -> Context | None:
    """Return the context of a function that is declared at a place; None for anything else."""
    declaration = place.declaration
    if declaration is None or declaration.kind != "function":
        return None
    span: Span = declaration.node.span  # type: ignore[attr-defined]
    for context in place.text.names.contexts:
        if context.kind == "function" and context.start == span.start:
            return context
    return None


def _declared_in(text: Text, name: str, *, is_called: bool) -> list[Place]:
    """Return what a file hands back to its includer under a name."""
    found = [
        each
        for each in text.names.declarations
        if each.name == name
        and (each.kind in CALLED) == is_called
        and each.scope != LOCAL
        and each.kind not in (IMPORTED, NAMESPACE)
    ]
    return [Place(text, declaration=each, use=None) for each in found]


def visible_names(program: Program, text: Text, context: Context) -> Sequence[Place]:
    """Return the declarations that an expression in a context sees, the nearest first."""
    found: dict[tuple[str, bool], Place] = {}
    inner: Context | None = context
    while inner is not None:
        if inner.kind == BLOCK:
            for function in program.functions(text, inner.callee, inner.parent):
                callee = function_context(function)
                for declared in callee.declared.values() if callee is not None else ():
                    for each in declared:
                        if each.kind not in CALLED:
                            place = Place(function.text, declaration=each, use=None)
                            found.setdefault((each.name, False), place)
        for declared in inner.declared.values():
            for each in declared:
                place = Place(text, declaration=each, use=None)
                found.setdefault((each.name, each.kind in CALLED), place)
        inner = inner.parent
    for other in program.texts:
        is_apart = other is not text and program.is_only_in_namespaces(other)
        for each in other.names.declarations:
            if each.scope != LOCAL and not (is_apart and each.scope == PARENT):
                place = Place(other, declaration=each, use=None)
                found.setdefault((each.name, each.kind in CALLED), place)
    return list(found.values())
