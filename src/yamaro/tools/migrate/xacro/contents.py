"""What the statements of xacro put where they are, and which of it may end up in a part.

A call, a block or a condition in a joint, link or section makes elements there. To know how many of
a name there may be, whatever the arguments are, the macros and all their calls are looked at.
"""

from __future__ import annotations

from ....xacro.symbol_table import assigned_in, called_by, names_in, used_in
from ....xml.tree import Element
from ....xml.values import format_value
from ..elements import name_of
from .names import reached_from

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from .program import Macro, XacroProgram

    Content = str | tuple[str | None, str]
    """A macro by its name, or a block by the name of its macro and its own."""

Counts = dict[str, tuple[int, int]]
"""How many elements of a name there are at least, and at most."""

HOLDERS = frozenset(("joint", "link", "visual", "collision", "inertial"))
"""Elements that are written with keys in a part."""


class UnknownContent(Exception):
    """What a statement makes is not known before it is run."""


class Contents:
    """Knows what statements make, over all files of a robot."""

    def __init__(self, program: XacroProgram) -> None:
        """Look at the macros, their calls, and the blocks that are properties."""
        self._macros: dict[str, list[Macro]] = {}
        self._calls: dict[str, list[tuple[Element, Macro | None]]] = {}
        self._blocks: dict[str, list[Element]] = {}
        self._at_work: set[object] = set()
        self._in_parts: set[str | tuple[str | None, str]] = set()
        by_element = {id(macro.element): macro for macro in program.definitions.values()}
        for macro in program.definitions.values():
            self._macros.setdefault(macro.name, []).append(macro)
        for root in program.roots.values():
            self._gather(root, None, by_element)
        for root in program.roots.values():
            self._find_parts(root, None, by_element)
        if not program.has_computed_calls:
            # note macros that nothing calls, such as those of a library, if they are for parts
            for name, macros in self._macros.items():
                inside = {each.name for macro in macros for each in macro.element.elements()}
                if name not in self._calls and inside and inside <= _OF_PARTS:
                    self._put_macro_in_part(name)

        # What calls of macros set that is read outside of them, by the macros' names.
        # What a macro sets for its caller is the caller's own; what is global goes on.
        def callers_of(name: str) -> list[str]:
            return [around.name for _, around in self._calls.get(name, ()) if around]

        found: dict[str, set[str]] = {}
        for name, macros in self._macros.items():
            assigned = set().union(*(assigned_in(macro.element) for macro in macros))
            if assigned:
                found.setdefault(name, set()).update(assigned)
            own = set().union(*(assigned_in(macro.element, "global") for macro in macros))
            if own:
                # add global names to all that may call a macro
                for caller in reached_from([name], callers_of):
                    found.setdefault(caller, set()).update(own)
        self._setters = found

    def _gather(self, root: Element, around: Macro | None, known: dict[int, Macro]) -> None:
        for element in root.elements():
            if element.name == "xacro:property" and element.elements():
                self._blocks.setdefault(name_of(element), []).append(element)
            elif element.name == "xacro:call":
                called = format_value(element.attributes.get("macro"))
                self._calls.setdefault(called, []).append((element, around))
            elif element.name.startswith("xacro:"):
                self._calls.setdefault(called_by(element), []).append((element, around))
            self._gather(element, known.get(id(element), around), known)

    # --- what is made ---------------------------------------------------------------------------

    def counts(self, nodes: Iterable[object], around: Macro | None) -> Counts:
        """Return how many elements of each name nodes make.

        Args:
            nodes: what is in a row.
            around: the macro that they are in.

        Raises:
            UnknownContent: it depends on more than conditions.
        """
        rows: list[Counts] = []
        before: tuple[str, Counts] | None = None  # a condition and what stands under it
        for node in nodes:
            if not isinstance(node, Element):
                continue
            made = self._made(node, around)
            condition = format_value(node.attributes.get("value"))
            is_opposite = node.name == "xacro:unless" and before and before[0] == condition
            if before is not None and is_opposite:
                rows[-1] = _either(before[1], made)
            elif node.name in ("xacro:if", "xacro:unless"):
                rows.append(_either(made, {}))
            else:
                rows.append(made)
            before = (condition, made) if node.name == "xacro:if" else None
        counts: Counts = {}
        for row in rows:
            for name, (least, most) in row.items():
                first, second = counts.get(name, (0, 0))
                counts[name] = first + least, second + most
        return counts

    def _made(self, node: Element, around: Macro | None) -> Counts:
        name = node.name
        if not name.startswith("xacro:"):
            return {name: (1, 1)}
        if name in ("xacro:if", "xacro:unless"):
            return self.counts(node.children, around)
        if name == "xacro:insert_block":
            block = name_of(node)
            if around is not None and block in {own.lstrip("*") for own in around.blocks()}:
                given = self.given(around, block)
                if not given and block.endswith("origin"):
                    return {"origin": (1, 1)}
                if not given:
                    raise UnknownContent
                return _any_of([self._once((around, block, id(c)), n, a) for c, n, a in given])
            if block in self._blocks:
                blocks = self._blocks[block]
                return _any_of([self._once(id(each), each.children, None) for each in blocks])
            raise UnknownContent
        if name == "xacro:property":
            return {}
        macros = self._macros.get(called_by(node))
        if name in _UNKNOWN or macros is None:
            raise UnknownContent
        return _any_of([self._once(macro, macro.element.children, macro) for macro in macros])

    def _once(self, key: object, nodes: Iterable[object], around: Macro | None) -> Counts:
        """Return what nodes make that are not looked at already: what calls itself has no end."""
        if key in self._at_work:
            raise UnknownContent
        self._at_work.add(key)
        try:
            return self.counts(nodes, around)
        finally:
            self._at_work.discard(key)

    def given(self, macro: Macro, name: str) -> list[tuple[Element, list[Element], Macro | None]]:
        """Return what the calls of a macro give for a block, with the macros they are in."""
        found = []
        for call, around in self._calls.get(macro.name, ()):
            children = call.elements()
            blocks = macro.blocks()
            index = [own.lstrip("*") for own in blocks].index(name)
            if len(children) == len(blocks):
                child = children[index]
                nodes = child.elements() if blocks[index].startswith("**") else [child]
            elif len(blocks) == 1 and not blocks[0].startswith("**"):
                nodes = children
            else:
                raise UnknownContent
            found.append((call, nodes, around))
        return found

    def sets_variables(self, node: Element) -> bool:
        """Return whether an element has statements in it that set what is read after them."""
        words = ("xacro:property", "xacro:call", "xacro:include")
        return any(own.name in words or called_by(own) in self._setters for own in node.iter())

    def first_setters(self, link: Element) -> tuple[int, set[str]]:
        """Return how many children of a link are calls that set what the rest reads, and the names.

        Raises:
            UnknownContent: something is set elsewhere in it.
        """
        count, names = 0, set[str]()
        for index, child in enumerate(link.children):
            if not isinstance(child, Element):
                continue
            called = called_by(child)
            if called not in self._setters or child.elements() or child.name == "xacro:call":
                break
            count = index + 1
            names |= self._setters[called]
        rest = [child for child in link.children[count:] if isinstance(child, Element)]
        read_before = set().union(*map(names_in, map(format_value, link.attributes.values())))
        if any(map(self.sets_variables, rest)) or names & read_before:
            raise UnknownContent
        return count, names

    def may_pass(self, node: Element, names: set[str]) -> bool:
        """Return whether an element may be moved past what sets variables."""
        inside = [own.name for own in node.iter() if own.name.startswith("xacro:")]
        return not names & used_in(node) and set(inside) <= _PLAIN

    # --- where it stands ------------------------------------------------------------------------

    def in_parts(self) -> set[str | tuple[str | None, str]]:
        """Return the macros and blocks of which things may come to be in a part."""
        return set(self._in_parts)

    def may_be_in_part(self, macro: Macro) -> bool:
        """Return whether what is in a macro may end up in a joint, link or section."""
        return macro.name in self._in_parts

    def may_block_be_in_part(self, macro: Macro | None, name: str) -> bool:
        """Return the same for a block of a macro, or of one that is a property."""
        return (macro.name if macro is not None else None, name) in self._in_parts

    def _find_parts(self, root: Element, around: Macro | None, known: dict[int, Macro]) -> None:
        for element in root.elements():
            if element.name in HOLDERS:
                for child in element.elements():
                    self._put_in_part(child, around)
            self._find_parts(element, known.get(id(element), around), known)

    def _put_in_part(self, node: Element, around: Macro | None) -> None:
        """Note that what a node makes is in a part."""
        if node.name in ("xacro:if", "xacro:unless"):
            for child in node.elements():
                self._put_in_part(child, around)
        elif node.name == "xacro:insert_block":
            self._put_block_in_part(name_of(node), around)
        elif node.name == "xacro:call":
            for name in self._macros:
                self._put_macro_in_part(name)
        elif node.name.startswith("xacro:"):
            self._put_macro_in_part(called_by(node))

    def _put_macro_in_part(self, name: str) -> None:
        if name in self._in_parts or name not in self._macros:
            return
        self._in_parts.add(name)
        for macro in self._macros[name]:
            for child in macro.element.elements():
                self._put_in_part(child, macro)

    def _put_block_in_part(self, name: str, around: Macro | None) -> None:
        if around is None or name not in {own.lstrip("*") for own in around.blocks()}:
            self._in_parts.add((None, name))
            return
        if (around.name, name) in self._in_parts:
            return
        self._in_parts.add((around.name, name))
        try:
            given = self.given(around, name)
        except UnknownContent:
            return
        for _, nodes, caller in given:
            for node in nodes:
                self._put_in_part(node, caller)


_OF_PARTS = frozenset(("visual", "collision", "inertial", "origin", "inertia", "limit"))
"""Elements that are written in macros so that links and joints do not repeat them."""

_UNKNOWN = frozenset(
    f"xacro:{name}" for name in ("property", "element", "attribute", "include", "arg", "macro")
)


_PLAIN = frozenset(("xacro:if", "xacro:unless", "xacro:insert_block"))
"""Statements that neither set variables nor read other names than those written in them."""


def _either(first: Counts, second: Counts) -> Counts:
    pairs = {
        name: (first.get(name, (0, 0)), second.get(name, (0, 0))) for name in {**first, **second}
    }
    return {name: (min(a[0], b[0]), max(a[1], b[1])) for name, (a, b) in pairs.items()}


def _any_of(several: list[Counts]) -> Counts:
    if not several:
        return {}
    counts = several[0]
    for other in several[1:]:
        counts = _either(counts, other)
    return counts


# --- what gives things to parts only ----------------------------------------------------------
# A function does not know where it is called: `xyz` is a pose in a part, and an element elsewhere.
# So the files are written as if every macro and block that may be in a part were in parts only.
# What turns out to be elsewhere too is noted, and the files are written again without it.


IN_PART = "in a part"
"""Where something is that is written in a joint, link or section of a part."""


class Placing:
    """Knows which macros and blocks give things to parts only.

    Attributes:
        in_parts: those that do, as far as is known.
    """

    def __init__(self, candidates: Iterable[Content]) -> None:
        self.in_parts: set[Content] = set(candidates)
        self._used: set[tuple[Content, Content | None]] = set()

    def note(self, content: Content, place: Content | None) -> None:
        """Note that what a macro or block gives is put into a part, another of them, or neither."""
        self._used.add((content, place))

    def settle(self) -> bool:
        """Return whether all was written as it has to be; if not, remember what is not in parts."""
        known = len(self.in_parts)
        while wrong := {
            content
            for content, place in self._used
            if content in self.in_parts and place != IN_PART and place not in self.in_parts
        }:
            self.in_parts -= wrong
        self._used.clear()
        return len(self.in_parts) == known
