"""Names and where they are visible: contexts, the five scopes, lookup and assignment.

A `Scope` is the dict that Python expressions are evaluated in: a name it does not hold itself is
looked up along the rules of the language. Functions and blocks live in the same dicts as variables,
under a key no variable can have (`function_key`), so that the scopes mean the same for all three.
"""

from __future__ import annotations

from ..namespace import MISSING, Namespace
from ..syntax.nodes import BRIDGE, CHILD, GLOBAL, LOCAL, PARENT

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from typing import Any

    from ..diagnostics import Frame
    from ..source import Source, Span

# What every context begins with, and most end with. One is made for each call, so they share these;
# the code that adds a first name creates its own dict or set.
_NO_KINDS: dict[str, str] = {}
_NONE_BRIDGED: set[str] = set()
_NONE_PASSED: frozenset[str] = frozenset()
_NO_PLACES: dict[str, Span | None] = {}


def function_key(name: str) -> str:
    """Return the key under which a scope keeps a function or block of that name."""
    return f"{name}()"


class SharedNames:
    """Global and bridge names, which all contexts of one conversion share.

    Attributes:
        declared: every such name, in the order of the declarations, repeated ones included.
        children: every name that was ever declared `child`, so that only those are searched for
            among the callers.
        places: where each of them was set last.
    """

    __slots__ = ("bridges", "children", "declared", "globals", "places")

    def __init__(self) -> None:
        """Start without names."""
        self.globals: dict[str, Any] = {}
        self.bridges: dict[str, Any] = {}
        self.declared: list[str] = []
        self.children: set[str] = set()
        self.places: dict[str, Span | None] = {}

    def find(self, name: str) -> Any:
        """Return what a name means everywhere, or MISSING."""
        if name in self.bridges:
            return self.bridges[name]
        return self.globals.get(name, MISSING)


class Home:
    """A file being run: what its expressions see whatever the context.

    Attributes:
        names: the file's imports over the predefined names over Python's builtins.
        directory: where its relative paths start.
        frame: the include that brought it in, or None for the main file.
    """

    __slots__ = ("directory", "frame", "names", "source")

    def __init__(
        self, source: Source, directory: str, names: dict[str, Any], frame: Frame | None
    ) -> None:
        self.source = source
        self.directory = directory
        self.names = names
        self.frame = frame


class Scope(dict[str, "Any"]):
    """One context: a run of a file, or one call of a function.

    As a dict it holds the names of its own; asking for another one looks it up, and setting one
    assigns as `process` does. `declare` is what `variables:` does.

    Attributes:
        given_at: where the arguments of a call stand; other calls may share it.
        places: where the other names were set, None for those that `process` has set.
    """

    __slots__ = (
        "bridged",
        "caller",
        "closure",
        "dynamic",
        "given_at",
        "has_children",
        "home",
        "kinds",
        "passed",
        "places",
        "shared_names",
    )

    def __init__(
        self, home: Home, shared_names: SharedNames, *, closure: Scope | None, caller: Scope | None
    ) -> None:
        """Begin a context.

        Args:
            home: the file whose imports it sees.
            shared_names: the conversion's global and bridge names.
            closure: the context its function was defined in.
            caller: the context that called or included it.
        """
        self.home = home
        self.shared_names = shared_names
        self.closure = closure
        self.caller = caller
        self.kinds = _NO_KINDS  # scope of each own name that is not local
        self.bridged = _NONE_BRIDGED  # names that mean the bridge variable here
        self.passed = _NONE_PASSED
        self.places = _NO_PLACES
        self.given_at: Mapping[str, Span | None] = _NO_PLACES
        self.has_children = False  # whether a name was ever declared `child` here
        self.dynamic: Scope | None = None  # the nearest caller of which that is true
        if caller is not None:
            self.dynamic = caller if caller.has_children else caller.dynamic
        dict.__setitem__(self, "__builtins__", home.names)

    # --- looking up ---

    def __missing__(self, name: str) -> Any:
        value = self.find(name)
        if value is MISSING:
            raise KeyError(name)
        return value

    def find(self, name: str) -> Any:
        """Return what a name means here, or MISSING."""
        holder = self.holder(name)
        if holder is not None:
            return holder.own(name)
        value = self.find_child(name)
        if value is MISSING:
            value = self.shared_names.find(name)
        if value is MISSING:
            value = self.home.names.get(name, MISSING)
        return value

    def holder(self, name: str) -> Scope | None:
        """Return the context that has the name as its own: this one or one around it."""
        scope: Scope | None = self
        while scope is not None:
            if name in scope or name in scope.bridged:
                return scope
            scope = scope.closure
            if type(scope) is BlockScope:
                return scope.holder(name)
        return None

    def own(self, name: str) -> Any:
        """Return the value of a name that `holder` found here."""
        if name in self:
            return dict.__getitem__(self, name)
        return self.shared_names.bridges[name]

    def find_child(self, name: str) -> Any:
        """Return the value of the nearest caller's `child` name, or MISSING."""
        if name not in self.shared_names.children:
            return MISSING
        scope = self.dynamic
        while scope is not None:
            if scope.kinds.get(name) == CHILD:
                return dict.__getitem__(scope, name)
            scope = scope.dynamic
        return MISSING

    def place_of(self, name: str) -> Span | None:
        """Return where the value of a name was set, as far as that is known."""
        holder = self.holder(name)
        if holder is None:
            holder = self.dynamic
            while holder is not None and holder.kinds.get(name) != CHILD:
                holder = holder.dynamic
        if holder is None or name not in holder:
            return self.shared_names.places.get(name)
        return holder.places[name] if name in holder.places else holder.given_at.get(name)

    def is_passed_in(self, name: str) -> bool:
        """Return whether a file's own `variables:` entry is only a default for this name."""
        if name in self.passed or self.find_child(name) is not MISSING:
            return True
        return name in self.shared_names.bridges and name not in self.bridged

    def visible_names(self) -> Iterator[str]:
        """Give every name that can be seen from here; functions under their keys."""
        scope: Scope | None = self
        while scope is not None:
            yield from scope
            yield from scope.bridged
            if isinstance(scope, BlockScope):
                for host in scope.hosts:
                    yield from host
            scope = scope.closure
        scope = self.dynamic
        while scope is not None:
            yield from (name for name, kind in scope.kinds.items() if kind == CHILD)
            scope = scope.dynamic
        yield from self.shared_names.bridges
        yield from self.shared_names.globals
        yield from self.home.names

    # --- changing ---

    @property
    def context(self) -> Scope:
        """Return the context that declarations go to."""
        return self

    def declare(self, name: str, value: Any, kind: str = LOCAL, place: Span | None = None) -> None:
        """Declare a name in this context, as `variables:` does."""
        if kind == LOCAL:
            dict.__setitem__(self, name, value)
            self._note_place(name, place)
            if self.kinds:
                self.kinds.pop(name, None)
        elif kind in (PARENT, CHILD):
            dict.__setitem__(self, name, value)
            self._note_place(name, place)
            if self.kinds is _NO_KINDS:
                self.kinds = {}
            self.kinds[name] = kind
            if kind == CHILD:
                self.has_children = True
                self.shared_names.children.add(name)
        elif kind == GLOBAL:
            self._forget(name)
            self.shared_names.globals[name] = value
            self.shared_names.places[name] = place
            self.shared_names.declared.append(name)
        elif kind == BRIDGE:
            self.shared_names.bridges[name] = value
            self.shared_names.places[name] = place
            self.shared_names.declared.append(name)
            scope: Scope | None = self
            while scope is not None:
                scope._forget(name)
                if scope.bridged is _NONE_BRIDGED:
                    scope.bridged = set()
                scope.bridged.add(name)
                scope = scope.caller
        else:
            raise AssertionError(f"unknown scope {kind}")

    def _note_place(self, name: str, place: Span | None) -> None:
        if self.places is _NO_PLACES:
            if place is None and name not in self.given_at:
                return
            self.places = {}
        self.places[name] = place

    def _forget(self, name: str) -> None:
        if name in self:
            dict.__delitem__(self, name)
            self.kinds.pop(name, None)
        self.bridged.discard(name)

    def __setitem__(self, name: str, value: Any) -> None:
        """Assign as `process` does: change the variable that is seen, or make a local."""
        holder = self.holder(name)
        if holder is not None:
            holder.set_own(name, value)
        elif self.find_child(name) is not MISSING:
            self.context.declare(name, value)
        elif name in self.shared_names.bridges:
            self.shared_names.bridges[name] = value
            self.shared_names.places[name] = None
        elif name in self.shared_names.globals:
            self.shared_names.globals[name] = value
            self.shared_names.places[name] = None
        else:
            self.context.declare(name, value)

    def set_own(self, name: str, value: Any) -> None:
        """Change a name that `holder` found here."""
        if name in self:
            dict.__setitem__(self, name, value)
            self._note_place(name, None)
        else:
            self.shared_names.bridges[name] = value
            self.shared_names.places[name] = None

    def __delitem__(self, name: str) -> None:
        holder = self.holder(name)
        if holder is not None:
            holder._forget(name)
        elif name in self.shared_names.globals:
            del self.shared_names.globals[name]
        else:
            raise KeyError(name)

    def exported(self) -> list[tuple[str, Any]]:
        """Return the `parent` names with their values, for the caller or the including file."""
        if not self.kinds:
            return []
        return [
            (name, dict.__getitem__(self, name))
            for name, kind in self.kinds.items()
            if kind == PARENT
        ]


class BlockScope(Scope):
    """A block being run: sees what its insertion sees of calls, then the place it was written in.

    Variables it declares go to the call it runs in. Functions and blocks are looked up only where
    the block was written; those it defines are its own.

    Attributes:
        host: the call it runs in.
        hosts: the calls whose parameters and locals it sees, nearest first: the host and, where the
            insertion itself is in a block, the calls that one sees and the one it comes from.
    """

    __slots__ = ("host", "hosts")

    def __init__(self, inserting: Scope, written: Scope) -> None:
        """Run a block written in `written`, which is inserted in `inserting`."""
        self.host = inserting.context
        self.hosts = _calls_seen(inserting)
        super().__init__(
            written.home, self.host.shared_names, closure=written, caller=self.host.caller
        )
        self.dynamic = self.host.dynamic

    def holder(self, name: str) -> Scope | None:
        """Return the context that has the name as its own."""
        if name in self:
            return self
        if not name.endswith("()") and name != "__builtins__":
            for host in self.hosts:
                if name in host or name in host.bridged:
                    return host
        return self.closure.holder(name) if self.closure is not None else None

    def find(self, name: str) -> Any:
        """Return what a name means here, or MISSING."""
        if name.endswith("()") and name not in self and self.closure is not None:
            return self.closure.find(name)
        return super().find(name)

    @property
    def context(self) -> Scope:
        """Return the call that declarations go to."""
        return self.host

    def declare(self, name: str, value: Any, kind: str = LOCAL, place: Span | None = None) -> None:
        """Declare a variable in the call; a function in the block, which is what can name it."""
        is_function = name.endswith("()") and kind in (LOCAL, PARENT, CHILD)
        if is_function or isinstance(value, Namespace):
            dict.__setitem__(self, name, value)
        if not (name.endswith("()") and kind == LOCAL):
            self.host.declare(name, value, kind, place)


def _calls_seen(scope: Scope) -> tuple[Scope, ...]:
    """Return the calls whose parameters and locals are seen from a scope, nearest first."""
    if not isinstance(scope, BlockScope):
        return (scope,)
    written = scope.closure
    assert written is not None, "a block is written somewhere"
    seen = {id(host): host for host in (*scope.hosts, *_calls_seen(written))}
    return tuple(seen.values())


def variable_names(scope: Scope) -> list[str]:
    """Return the names of variables, imports and predefined names visible from a scope."""
    return [name for name in scope.visible_names() if name.isidentifier() and name[:2] != "__"]


def function_names(scope: Scope) -> list[str]:
    """Return the names of functions and blocks visible from a scope."""
    names = list(scope.visible_names())
    found = [name[:-2] for name in names if name.endswith("()")]
    for name in names:
        if name.endswith("()") or not name.isidentifier():
            continue
        value = scope.find(name)
        if isinstance(value, Namespace):
            found.extend(f"{name}.{inner[:-2]}" for inner in value._names if inner.endswith("()"))
    return found
