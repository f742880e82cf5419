"""What stands around what is being written: the macro, the part, the element."""

from __future__ import annotations

from copy import copy

from ..document import Body, Entry
from .names import defined_in, used_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from .macros import Macro
    from .parts import Write
    from .placing import Content
    from .program import XacroProgram


class Surroundings:
    """What stands around a piece of a file.

    Attributes:
        macro: the innermost macro, if there is one.
        is_top: whether the piece stands right in the file.
        is_in_element: whether it is in an element, where nothing is a part.
        place: what writes the elements that end up in a part.
        holder: the part, macro or block whose elements these are, where it is known.
        renamed: the variables that are read by another name here.
        hides: the arguments whose names mean something else here.
        visible: the names that are visible.
        read: the names that are read here.
        parameters, locals, blocks: the names that the macro has.
    """

    def __init__(self, program: XacroProgram) -> None:
        """Stand at the top of a file."""
        self.macro: Macro | None = None
        self.is_top = True
        self.is_in_element = program.result.name != "robot"
        self.place: Write | None = None
        self.holder: Content | None = None
        self.renamed: dict[str, str] = {}
        self.hides: set[str] = set()
        self.visible = program.at_top
        self.read = program.read
        self.parameters: set[str] = set()
        self.locals: set[str] = set()
        self.blocks: set[str] = set()

    def within(
        self, place: Write | None, *, is_in_element: bool, holder: Content | None = None
    ) -> Surroundings:
        """Return those in an element or part."""
        inner = copy(self)
        inner.place, inner.is_in_element = place, is_in_element
        inner.holder = holder if place is not None else None
        return inner

    def renaming(self, names: dict[str, str]) -> Surroundings:
        """Return the same where variables are read by other names."""
        inner = copy(self)
        inner.renamed = self.renamed | names
        return inner

    def below_top(self) -> Surroundings:
        """Return the same for what does not stand right in the file."""
        inner = copy(self)
        inner.is_top = False
        return inner

    def in_macro(self, macro: Macro, program: XacroProgram, place: Write | None) -> Surroundings:
        """Return those in a macro, whose elements are written by `place`."""
        inner = self.within(place, is_in_element=False, holder=macro.name)
        inner.macro = macro
        inner.is_top = False
        inner.hides = self.hides | program.hidden.in_macro(macro)
        inner.visible = program.visible_in(macro)
        inner.read = used_in(macro.element) | program.inherited
        inner.parameters = set(macro.values())
        inner.locals = defined_in(macro.element, nested=True)
        inner.blocks = {own.lstrip("*") for own in macro.blocks()}
        return inner


def names_of(variables: Iterable[Entry]) -> set[str]:
    """Return the names of the variables that entries declare."""
    return {entry.key.partition("/")[0] for entry in variables}


def body_of_last(body: Body, key: str) -> Body:
    """Return the body of the last entry if it has this key, else of one that is added."""
    last = body.entries[-1] if body.entries else None
    if last is None or last.key != key:
        last = Entry(key, Body())
        body.append(last)
    assert isinstance(last.value, Body)
    return last.value


def move_opening(inner: Body | None, outer: Body) -> None:
    """Move a comment at the end of an opening tag to the key that replaces the tag."""
    if inner is not None:
        outer.opening, inner.opening = inner.opening, ""
