"""Default classes: what an element has that neither it nor its class says differently."""

from __future__ import annotations

from ...diagnostics import YamaroError, did_you_mean, failure
from .compiler import completed, given_by
from .document import text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ...source import Span
    from ...xml.tree import Element

    Given = dict[str, tuple[str, Span]]
    """Attributes by name: the text of each, and where it is written."""

MAIN = "main"
"""The name of the outermost class."""
ACTUATORS = (
    "general", "motor", "position", "velocity", "intvelocity", "orientation", "pid", "damper",
    "cylinder", "muscle", "adhesion", "dcmotor", "plugin",
)  # fmt: skip
"""The elements of the section `actuator`."""


class Classes:
    """The default classes of a model, by name: for each kind of element its attributes."""

    __slots__ = ("_actuators", "_by_name")

    def __init__(self, sections: Iterable[Element]) -> None:
        """Read the outermost `<default>` elements.

        Raises:
            YamaroError: a class has no name, or that of another one.
        """
        main: dict[str, Given] = {}
        self._by_name: dict[str, dict[str, Given]] = {MAIN: main}
        self._actuators: dict[int, list[tuple[str, Given]]] = {id(main): []}
        pending: list[tuple[Element, dict[str, Given]]] = []
        for section in reversed([*sections]):
            name = text(section, "class")
            if name is not None and name != MAIN:
                self._by_name[name] = main
            pending.append((section, main))
        while pending:
            section, given = pending.pop()
            inner = []
            for child in section.elements():
                if child.name == "default":
                    inner.append(child)
                else:
                    self._take(child, given)
                    if child.name in ACTUATORS:
                        self._actuators[id(given)].append((child.name, given_by(child)))
            begun = [(child, self._begin(child, given)) for child in inner]
            pending += reversed(begun)

    def _begin(self, section: Element, above: dict[str, Given]) -> dict[str, Given]:
        name = text(section, "class")
        if not name:
            raise failure(
                "bad-mjcf",
                "a default class inside another one needs a name",
                section.span,
                hint='write <default class="name">',
            )
        if name in self._by_name:
            raise failure(
                "bad-mjcf",
                f"there are two default classes named '{name}'",
                section.value_span("class"),
                hint="give each its own name",
            )
        own = dict(above)
        self._by_name[name] = own
        self._actuators[id(own)] = [*self._actuators[id(above)]]
        return own

    @staticmethod
    def _take(element: Element, given: dict[str, Given]) -> None:
        given[element.name] = completed(given_by(element), given.get(element.name, {}))

    def of(self, name: str | None, span: Span) -> dict[str, Given]:
        """Return the attributes of each kind of element in a class.

        Raises:
            YamaroError: there is no such class.
        """
        if name is None:
            return self._by_name[MAIN]
        found = self._by_name.get(name)
        if found is None:
            raise unknown("default class", name, self._by_name, span)
        return found

    def actuators(self, name: str | None, span: Span) -> list[tuple[str, Given]]:
        """Return the elements for actuators in a class and those around it, in their order."""
        return self._actuators[id(self.of(name, span))]


def unknown(kind: str, name: str, known: Iterable[str], span: Span) -> YamaroError:
    """Return the error for a name that nothing has."""
    names = [*known]
    return failure(
        "unknown-mjcf-name",
        f"there is no {kind} '{name}'",
        span,
        hint=did_you_mean(name, names)
        or (f"the names are {', '.join(names[:8])}" if names else f"the model has no {kind}"),
    )
