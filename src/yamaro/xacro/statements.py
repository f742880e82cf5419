"""xacro's tags: what a property, a macro or an include says, before anything is evaluated.

Values are templates still (see `templates.py`), except where xacro takes them as they stand.
"""

from __future__ import annotations

import re

from ..diagnostics import did_you_mean, failure
from .places import XacroPlace

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..diagnostics import Frame, Reporter
    from ..xml.tree import Element

PREFIX = "xacro:"


class Property:
    """`<xacro:property>`: a value, a default, a block, or a removal.

    Attributes:
        element: the tag; the block, if there is neither value nor default.
        name, value, default: templates, or None.
        remove, lazy_eval: templates of truth values, or None.
        scope: "parent", "global" or None.
    """

    __slots__ = ("default", "element", "lazy_eval", "name", "remove", "scope", "value")

    def __init__(self, element: Element, given: dict[str, str]) -> None:
        self.element = element
        self.name = given["name"]
        self.value = given.get("value")
        self.default = given.get("default")
        self.remove = given.get("remove")
        self.scope = given.get("scope")
        self.lazy_eval = given.get("lazy_eval")


class MacroDefinition:
    """`<xacro:macro>`.

    Attributes:
        element: the tag, whose content is the body.
        name: as it is called, without `xacro:`.
        parameters: in the order in which they are listed.
    """

    __slots__ = ("element", "name", "parameters")

    def __init__(self, element: Element, name: str, parameters: list[Parameter]) -> None:
        self.element = element
        self.name = name
        self.parameters = parameters


class Include:
    """`<xacro:include>`.

    Attributes:
        element: the tag.
        filename: a template.
        namespace: a template, or None.
        optional: the text of the attribute, such as "true", or None.
    """

    __slots__ = ("element", "filename", "namespace", "optional")

    def __init__(self, element: Element, given: dict[str, str]) -> None:
        self.element = element
        self.filename = given["filename"]
        self.namespace = given.get("ns")
        self.optional = given.get("optional")


class Statements:
    """Reads xacro's tags, and says what is wrong with their attributes.

    Attributes:
        trace: the calls and includes that led to the tag being read.
    """

    __slots__ = ("_reporter", "trace")

    def __init__(self, reporter: Reporter) -> None:
        self._reporter = reporter
        self.trace: Frame | None = None

    def property(self, element: Element) -> Property:
        """Read `<xacro:property>`."""
        optional = ("value", "default", "remove", "scope", "lazy_eval")
        return Property(element, self.attributes(element, ("name",), optional))

    def include(self, element: Element) -> Include:
        """Read `<xacro:include>`."""
        given = self.attributes(element, ("filename",), ("ns", "optional"))
        if element.elements():
            self._reporter.report(
                "xacro-ignored",
                "what is in <xacro:include> is ignored",
                element.elements()[0].span,
                trace=self.trace,
            )
        return Include(element, given)

    def macro(self, element: Element) -> MacroDefinition:
        """Read `<xacro:macro>`."""
        given = self.attributes(element, ("name",), ("params",))
        name = given["name"]
        problem = None
        if name == "call":
            problem = "no macro can have the name 'call': <xacro:call> has a meaning"
        elif "." in name:
            problem = f"the name '{name}' has a '.' in it, which follows a namespace"
        if problem:
            place = element.value_span("name")
            raise failure(
                "xacro-name", problem, place, hint="choose another name", trace=self.trace
            )
        if name.startswith(PREFIX):
            name = name[len(PREFIX) :]
            self._reporter.report(
                "xacro-name",
                f"the macro '{name}' is defined without 'xacro:' before its name",
                element.value_span("name"),
                hint=f'write name="{name}"',
                trace=self.trace,
            )
        return MacroDefinition(element, name, parse_parameters(given.get("params", "")))

    def attributes(
        self, element: Element, required: tuple[str, ...], optional: tuple[str, ...] = ()
    ) -> dict[str, str]:
        """Return the attributes of a tag, having looked whether there are those it needs.

        Raises:
            YamaroError: one is missing.
        """
        given: dict[str, str] = element.attributes  # type: ignore[assignment]
        self.require(element, *required)
        for name in given:
            if name not in required and name not in optional and not name.startswith("xmlns:"):
                self._reporter.report(
                    "xacro-unknown-attribute",
                    f"<{element.name}> has no attribute '{name}'",
                    element.name_span(name),
                    hint=did_you_mean(name, (*required, *optional)),
                    trace=self.trace,
                )
        return given

    def require(self, element: Element, *names: str) -> list[str]:
        """Return the values of attributes; raise YamaroError if one is missing."""
        for name in names:
            if name not in element.attributes:
                raise failure(
                    "xacro-missing-attribute",
                    f"<{element.name}> needs the attribute '{name}'",
                    element.span,
                    trace=self.trace,
                )
        return [str(element.attributes[name]) for name in names]

    def place(self, element: Element, attribute: str) -> XacroPlace:
        """Return the place of an attribute's value, as it is reached now."""
        return XacroPlace(element, attribute, self.trace)


# --- the parameters of a macro, as its attribute `params` lists them --------------------------


_NAME = re.compile(r"\s*(?P<name>[^\s:=]+)\s*:?=(?P<space>\s*)")
_WORD = re.compile(r"\s*(?P<name>\S+)")
_PLAIN = re.compile(r"[^\s'\"]+")
_OUTER = re.compile(r"\^\|?")


class Parameter:
    """A parameter of a macro.

    Attributes:
        name: with the stars of a block.
        default: the template of its default value, or None.
        is_forwarded: whether the caller's property of the same name comes before the default.
        start, end: where in the list it is.
    """

    __slots__ = ("default", "end", "is_forwarded", "name", "start")

    def __init__(
        self, name: str, default: str | None, is_forwarded: bool, start: int, end: int
    ) -> None:
        self.name = name
        self.default = default
        self.is_forwarded = is_forwarded
        self.start = start
        self.end = end

    @property
    def is_block(self) -> bool:
        """Return whether it takes an element, not a value."""
        return self.name[0] == "*"


def parse_parameters(text: str) -> list[Parameter]:
    """Return the parameters that are listed in a text."""
    parameters = []
    position = 0
    while text[position:].strip():
        parameter = _with_default(text, position) or _without_default(text, position)
        parameters.append(parameter)
        position = parameter.end
    return parameters


def _without_default(text: str, position: int) -> Parameter:
    word = _WORD.match(text, position)
    assert word is not None  # there is more than space
    return Parameter(word["name"], None, False, word.start("name"), word.end())


def _with_default(text: str, position: int) -> Parameter | None:
    head = _NAME.match(text, position)
    if head is None:
        return None
    start, after = head.start("name"), head.end()
    outer = _OUTER.match(text, after)
    # '^|' may also be '^' and a default that begins with '|', or a default as it is.
    for taken in (outer.end(), outer.start() + 1, after) if outer else (after,):
        end = _default_end(text, taken)
        if end is None and _is_border(text, taken) and taken > after:
            end = taken
        if end is not None:
            return Parameter(head["name"], text[taken:end] or None, taken > after, start, end)
    if head["space"] or after == len(text):  # there is no default after all
        return Parameter(head["name"], None, False, start, head.start("space"))
    return None


def _is_border(text: str, position: int) -> bool:
    return position == len(text) or text[position].isspace()


def _default_end(text: str, start: int) -> int | None:
    """Return where a default that begins at `start` ends, or None if there is no default."""
    for opener, closer in (("${", "}"), ("$(", ")")):
        if text.startswith(opener, start):
            end = text.find(closer, start)
            while end >= 0:
                if _is_border(text, end + 1):
                    return end + 1
                end = text.find(closer, end + 1)
    if _is_border(text, start):
        return None
    return _word_end(text, start, set())


def _word_end(text: str, start: int, hopeless: set[int]) -> int | None:
    """Return where a word ends that may have quoted spaces, or None.

    A quote ends as early as the rest allows: what comes after it has to make up the word.
    """
    plain = _PLAIN.match(text, start)
    position = plain.end() if plain else start
    if _is_border(text, position):
        return position
    if position in hopeless:
        return None
    quote = text[position]
    closing = text.find(quote, position + 1)
    while closing >= 0:
        end = _word_end(text, closing + 1, hopeless)
        if end is not None:
            return end
        closing = text.find(quote, closing + 1)
    hopeless.add(position)
    return None
