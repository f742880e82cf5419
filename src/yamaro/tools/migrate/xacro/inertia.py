"""Macros of xacro that compute the inertia of a solid, and what a call of one says in a part."""

from __future__ import annotations

from itertools import permutations

from ....model.values import values_of
from ....xacro.faults import Fault
from ....xacro.templates import Expression, parse_template
from ....xml.tree import Comment, Element, Text
from ....xml.values import format_value
from ..part_forms import MOMENTS
from ..solids import SIZES, NotComputed, Sample, are_equal, is_inertia_of, key_of, samples

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from ....xml.tree import Node
    from .macros import Macro
    from .program import XacroProgram


class SolidMacro:
    """A macro that gives the inertia of a solid.

    Attributes:
        macro: the macro.
        kind: of the solid.
        mass, sizes: the parameters that are its mass and its sizes.
        inertial: the `<inertial>` that it gives, or None if it gives no more than `<inertia>`.
    """

    def __init__(
        self,
        macro: Macro,
        kind: str,
        mass: str,
        sizes: tuple[str, ...],
        inertial: Element | None,
    ) -> None:
        self.macro = macro
        self.kind = kind
        self.mass = mass
        self.sizes = sizes
        self.inertial = inertial

    def read(self, call: Element) -> SolidInertia | None:
        """Return what a call of it says, or None if that is not to be seen."""
        given = self._arguments(call)
        if given is None:
            return None
        children: list[Node] | None = []
        if self.inertial is not None:
            children = self._children(call, given)
        if children is None:
            return None
        sizes = [given[name] for name in self.sizes]
        return SolidInertia(self, given[self.mass], sizes, children)

    def _arguments(self, call: Element) -> dict[str, str] | None:
        """Return the texts that the parameters get: those of the call, or plain defaults."""
        given = values_of(call)
        for own in self.macro.parameters:
            if own.is_block or own.name in given:
                continue
            if own.is_forwarded or own.default is None or "$" in own.default:
                return None
            given[own.name] = own.default.strip("'")
        if set(given) != set(self.macro.values()):
            return None
        sample = samples()[0]
        try:
            numbers = [sample.number(given[name]) for name in (self.mass, *self.sizes)]
        except NotComputed:
            return None
        is_number = ["$" not in given[name] for name in (self.mass, *self.sizes)]
        if any(number <= 0 and plain for number, plain in zip(numbers, is_number, strict=True)):
            return None
        return given

    def _children(self, call: Element, given: Mapping[str, str]) -> list[Node] | None:
        """Return what is in the `<inertial>` beside the inertia, as the call makes it."""
        assert self.inertial is not None
        blocks = call.elements()
        children: list[Node] = []
        for child in self.inertial.elements():
            if child.name == "xacro:insert_block":
                if len(blocks) != 1 or len(self.macro.blocks()) != 1:
                    return None
                children.append(blocks[0])
            elif child.name == "inertia":
                continue
            else:
                texts = {key: _filled_in(text, given) for key, text in values_of(child).items()}
                attributes = {key: text for key, text in texts.items() if text is not None}
                if len(attributes) < len(texts) or child.elements():
                    return None
                children.append(Element(child.name, call.span, dict(attributes)))
        return children


class SolidInertia:
    """The inertia of a solid as a call gives it, in texts of xacro.

    Attributes:
        source: the macro that is called.
        mass: of the solid.
        sizes: its sizes.
        children: what is beside the inertia in the `<inertial>` that the call gives.
    """

    def __init__(
        self, source: SolidMacro, mass: str, sizes: list[str], children: list[Node]
    ) -> None:
        self.source = source
        self.mass = mass.strip()
        self.sizes = [size.strip() for size in sizes]
        self.children = children

    @property
    def kind(self) -> str:
        """The kind of the solid."""
        return self.source.kind


class Solids:
    """The macros of a robot that give the inertia of a solid."""

    def __init__(self, program: XacroProgram) -> None:
        """Look at all macros; one that is defined twice does not count."""
        self._macros: dict[str, SolidMacro] = {}
        names = [macro.name for macro in program.definitions.values()]
        for macro in program.definitions.values():
            found = solid_macro(macro) if names.count(macro.name) == 1 else None
            if found is not None:
                self._macros[macro.name] = found
        self.replaced: set[str] = set()

    def __bool__(self) -> bool:
        """Return whether there are any."""
        return bool(self._macros)

    def without_calls(self, link: Element) -> tuple[Element, dict[int, SolidInertia]]:
        """Return a link whose inertials have no inertia where a call of such a macro gives it.

        Returns:
            the link, and the inertia of each such inertial, by identity.
        """
        found: dict[int, SolidInertia] = {}
        if not self:
            return link, found
        children: list[Node] = []
        for child in link.children:
            made = self._inertial(child) if isinstance(child, Element) else None
            if made is None:
                children.append(child)
                continue
            inertial, inertia = made
            found[id(inertial)] = inertia
            children.append(inertial)
        return (link.with_children(children) if found else link), found

    def _inertial(self, node: Element) -> tuple[Element, SolidInertia] | None:
        if node.name != "inertial":
            inertia = self._read(node)
            if inertia is None or inertia.source.inertial is None:
                return None
            return Element("inertial", node.span, {}, inertia.children), inertia
        mass = next((child for child in node.elements() if child.name == "mass"), None)
        for child in node.elements():
            inertia = self._read(child)
            if inertia is None or inertia.source.inertial is not None or mass is None:
                continue
            if are_equal([values_of(mass).get("value", "")], [inertia.mass]):
                return node.with_children([n for n in node.children if n is not child]), inertia
        return None

    def _read(self, call: Element) -> SolidInertia | None:
        macro = self._macros.get(call.name.removeprefix("xacro:"))
        return macro.read(call) if macro is not None and call.name.startswith("xacro:") else None


def solid_macro(macro: Macro) -> SolidMacro | None:
    """Return what solid's inertia a macro gives, and by which parameters; None for any other."""
    content = _only_element(macro.element.children)
    if content is None or (content.attributes and content.name == "inertial"):
        return None
    inertia, own_mass = content, None
    if content.name == "inertial":
        parts = {child.name: child for child in content.elements()}
        if len(parts) != len(content.elements()) or not {"mass", "inertia"} <= parts.keys():
            return None
        if parts.keys() - {"mass", "inertia", "origin", "xacro:insert_block"} or len(parts) > 3:
            return None
        own_mass = _parameter(values_of(parts["mass"]).get("value", ""), macro)
        if own_mass is None:
            return None
        inertia = parts["inertia"]
    moments = values_of(inertia)
    if inertia.name != "inertia" or sorted(moments) != sorted(MOMENTS) or inertia.elements():
        return None
    found = _roles(macro, [moments[name] for name in MOMENTS], own_mass)
    if found is None:
        return None
    kind, mass, sizes = found
    return SolidMacro(macro, kind, mass, sizes, content if content is not inertia else None)


def _roles(
    macro: Macro, moments: list[str], own_mass: str | None
) -> tuple[str, str, tuple[str, ...]] | None:
    """Return the kind of solid, and which parameters are its mass and its sizes."""
    names = _read_by(moments, macro)
    if names is None:
        return None
    for kind, count in SIZES.items():
        if len(names) != count + 1:
            continue
        for mass, *sizes in permutations(names):
            if own_mass not in (None, mass):
                continue
            words = [f"${{{name}}}" for name in sizes]
            if is_inertia_of(kind, words, f"${{{mass}}}", moments):
                return kind, mass, tuple(sizes)
    return None


def _read_by(moments: Iterable[str], macro: Macro) -> list[str] | None:
    """Return the parameters that formulas read; None if they read anything else."""
    sample: Sample = samples()[0]
    try:
        for moment in moments:
            sample.number(moment)
    except NotComputed:
        return None
    keys = {key_of(name): name for name in macro.values() if name.isidentifier()}
    if not sample.values.keys() <= keys.keys():
        return None
    return [keys[key] for key in sample.values]


def _only_element(nodes: list[Node]) -> Element | None:
    """Return the one element that has nothing beside it but comments."""
    elements = [node for node in nodes if isinstance(node, Element)]
    texts = [node for node in nodes if not isinstance(node, (Element, Comment))]
    has_text = any(isinstance(t, Text) and format_value(t.value).strip() for t in texts)
    return elements[0] if len(elements) == 1 and not has_text else None


def _parameter(text: str, macro: Macro) -> str | None:
    """Return the parameter that a text consists of."""
    text = text.strip()
    name = text[2:-1].strip() if text.startswith("${") and text.endswith("}") else ""
    return name if name in macro.values() else None


def _filled_in(text: str, given: Mapping[str, str]) -> str | None:
    """Return a text with arguments in place of parameters; None if it computes with any name."""
    pieces: list[str] = []
    try:
        parts = parse_template(text).parts
    except Fault:
        return None
    for part in parts:
        if isinstance(part, str):
            pieces.append(part)
        elif isinstance(part, Expression) and part.text.strip() in given:
            pieces.append(given[part.text.strip()])
        else:
            return None
    return "".join(pieces)
