"""Explains where a value in a finished document comes from: `yamaro why FILE ADDRESS`.

An address names an element, and perhaps an attribute of it: `rod_joint/limit@upper`,
`link:base/visual[2]/origin@xyz`, `/gazebo[3]`, `/@name`. It is looked up in the finished tree, in
which each element knows where it was made, and what the expressions there read: `RecordedSpan`.
"""

from __future__ import annotations

from ...diagnostics import Frame, suggest
from ...model.schema import ELEMENTS
from ...rendering import excerpt_lines, trace_lines
from ...source import OverlaidSpan, RecordedSpan, Span
from ...targets.holding import FORMATS, cell
from ...terminal import BOLD, CYAN, painted, shortened
from ...xml.tree import Element, Text
from ...xml.values import escaped_attribute, format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from ...model.extras import Fitted
    from ...result import Build
    from ...source import Reading
    from ...targets.losses import Loss

    Path = list[Element]
    Found = list[tuple[Path, str | None]]

MAX_STEPS = 200
"""Calls and includes that an answer names at most."""


class UnknownAddress(Exception):
    """An address that leads nowhere; the text says what is wrong, and what may be meant."""


class Answer:
    """Where an element, or the value of an attribute, comes from.

    Attributes:
        address: as it was asked.
        element: the element.
        fit: how its shape was worked out from a mesh; None if it was not.
        attribute: the name of the attribute, or None for the element itself.
        value: the attribute's value, or the text of the element; None for an element without text.
        span: where the value is written, or the key that made the element.
        name_span: where the name is written that the value contains, for names of parts.
        is_derived: whether no text gives the value: it follows from what is written at `span`.
        trace: the calls and includes that led there.
        formats: what each output format makes of it, by the name of the format.
        path: the elements around the element, from a child of the root to the element itself.
    """

    __slots__ = (
        "address",
        "attribute",
        "element",
        "fit",
        "formats",
        "is_derived",
        "name_span",
        "path",
        "span",
        "trace",
        "value",
    )

    def __init__(self, address: str, path: Sequence[Element], attribute: str | None) -> None:
        """Answer for the last element of a path from the root, or for one of its attributes."""
        element = path[-1]
        self.address = address
        self.element = element
        self.attribute = attribute
        self.path = path
        self.fit: Fitted | None = None
        self.formats = {"urdf": tags_of(path, attribute)}
        own = [each.trace for each in reversed(path) if not each.inherits_trace()]
        self.trace: Frame | None = own[0] if own else None
        self.span: Span = element.span
        self.value: str | None = None
        self.is_derived = False
        self.name_span: Span | None = None
        if attribute is not None:
            self.value = format_value(element.attributes[attribute])
            self.span = element.value_span(attribute)
            if isinstance(self.span, RecordedSpan) and attribute in ("name", "link"):
                self.name_span = self.span.name_span
            if self.name_span is None:
                is_mass_by_volume = element.name == "mass" and element.span.written() == "density"
                self.is_derived = self._follows_from_key() or is_mass_by_volume
            return
        texts = [child for child in element.children if isinstance(child, Text)]
        if texts and format_value(texts[0].value).strip():
            self.value, self.span = element.text(), texts[0].span
            self.is_derived = self._follows_from_key()

    def _follows_from_key(self) -> bool:
        """Return whether the value has no place of its own, and is not what its key says."""
        text = self.span.written()
        before, expression, _ = text.partition("$")
        is_value = bool(expression) and "=" not in before  # and no key such as frame/name=$(side)
        return self.span.key() == self.element.span.key() and text != self.value and not is_value

    @property
    def readings(self) -> Sequence[Reading]:
        """Return the variables that expressions in the value read."""
        span = self.span
        return span.readings if isinstance(span, RecordedSpan) else ()

    @property
    def others(self) -> Sequence[Span]:
        """Return further places that the value is computed from."""
        if not isinstance(self.span, RecordedSpan):
            return ()
        mirrors = [span.key() for span in self.mirrors]
        return [span for span in self.span.others if span.key() not in mirrors]

    @property
    def replaced(self) -> Sequence[OverlaidSpan]:
        """Return the places in overlays that changed the value, the last of them first."""
        found = []
        span: Span | None = self.span
        while isinstance(span, OverlaidSpan):
            found.append(span)
            span = span.replaced
        return found

    @property
    def mirrors(self) -> Sequence[Span]:
        """Return the places of the `mirror` statements that made the link or joint."""
        outermost = self.path[1] if len(self.path) > 1 else self.element
        return outermost.span.others if isinstance(outermost.span, RecordedSpan) else ()


def answer(root: Element, address: str, *, format: str = "urdf") -> Answer:
    """Return where what an address names comes from, in a document of a format.

    Raises:
        UnknownAddress: it leads nowhere.
    """
    if address.startswith("/"):
        path, rest = [root], address if not address.startswith("/@") else address[1:]
    else:
        path, rest = _named(root, address) if format == "urdf" else _named_deep(root, address)
    steps, at, attribute = rest.partition("@")
    for step in steps.split("/"):
        if step:
            path.append(_child(path[-1], step))
    element = path[-1]
    if at and element.attributes.get(attribute) is None:
        known = [name for name, value in element.attributes.items() if value is not None]
        likely = _likely(attribute, known, element)
        raise UnknownAddress(f"<{element.name}> has no attribute '{attribute}'{likely}")
    return Answer(address, path, attribute if at else None)


def addresses(root: Element) -> Iterator[str]:
    """Yield an address for each element of a tree and for each attribute, in order."""
    pending = [(root, "")]
    while pending:
        element, address = pending.pop()
        yield address or "/"
        for name, value in element.attributes.items():
            if value is not None:
                yield f"{address or '/'}@{name}"
        counts: dict[str, int] = {}
        inner = []
        for child in element.elements():
            counts[child.name] = counts.get(child.name, 0) + 1
            inner.append((child, f"{address}/{child.name}[{counts[child.name]}]"))
        pending += reversed(inner)


def _named(root: Element, address: str) -> tuple[list[Element], str]:
    """Return the path to the child of the root that an address begins with, and the rest of it."""
    kind, colon, rest = address.partition(":")
    elements = root.elements()
    kinds = {element.name for element in elements}
    if not colon or kind not in kinds | {"link", "joint"}:
        kind, rest = "", address
    among = [element for element in elements if element.name == kind] if kind else elements
    found: dict[str, list[Element]] = {}
    for element in among:
        name = _name_of(element)
        if name and (rest == name or rest.startswith((f"{name}/", f"{name}@"))):
            found.setdefault(name, []).append(element)
    if not found:
        name = rest.partition("@")[0].partition("/")[0]
        known = [known for element in among if (known := _name_of(element))]
        begun = [each for each in (f"{name}_joint", f"{name}_link") if each in known]
        near = "; did you mean " + " or ".join(map(repr, begun)) + "?" if begun else ""
        what = kind or "link or joint"
        raise UnknownAddress(f"there is no {what} '{name}'{near or _likely(name, known)}")
    name = max(found, key=len)
    matches = found[name]
    if not kind and len({element.name for element in matches}) > 1:
        matches = [each for each in matches if each.name in ("link", "joint")] or matches
    if not kind and len({element.name for element in matches}) > 1:
        choices = " or ".join(dict.fromkeys(f"'{each.name}:{name}'" for each in matches))
        raise UnknownAddress(f"'{name}' is ambiguous; write {choices}")
    return [root, matches[0]], rest[len(name) :]


def _named_deep(root: Element, address: str) -> tuple[list[Element], str]:
    """Return the path to the element, however deep, that an address begins with, and the rest."""
    paths: dict[int, list[Element]] = {id(root): [root]}
    pending = [root]
    for element in pending:
        for child in element.elements():
            paths[id(child)] = [*paths[id(element)], child]
            pending.append(child)
    whole = root.with_children([each for each in pending if each is not root])
    found, rest = _named(whole, address)
    return paths[id(found[-1])], rest


def _name_of(element: Element) -> str:
    value = element.attributes.get("name", element.attributes.get("reference"))
    return "" if value is None else format_value(value)


def _child(element: Element, step: str) -> Element:
    """Return the child that a step names: `limit`, `visual[2]`, `visual[NAME]`."""
    name, bracket, which = step.partition("[")
    which = which.removesuffix("]")
    children = [child for child in element.elements() if child.name == name]
    if not children:
        known = [child.name for child in element.elements()]
        likely = _likely(name, known, element)
        raise UnknownAddress(f"<{element.name}> has no child '{name}'{likely}")
    if not bracket:
        return children[0]
    named = [child for child in children if _name_of(child) == which]
    if named:
        return named[0]
    if which.isdecimal() and 1 <= int(which) <= len(children):
        return children[int(which) - 1]
    count = f"{len(children)} '{name}'"
    raise UnknownAddress(f"<{element.name}> has {count}, and '{which}' is not one of them")


def _below(element: Element, word: str) -> str:
    """Return the steps from an element to the first attribute or element in it of a name, or ""."""
    for child in element.elements():
        if child.attributes.get(word) is not None:
            return f"{child.name}@{word}"
        if any(each.name == word for each in child.elements()):
            return f"{child.name}/{word}"
        below = _below(child, word)
        if below:
            return f"{child.name}/{below}"
    return ""


def _likely(word: str, known: Sequence[str], element: Element | None = None) -> str:
    near = suggest(word, known)
    if near is not None:
        return f"; did you mean '{near}'?"
    below = _below(element, word) if element is not None else ""
    if below:
        return f"; did you mean '{below}'?"
    listed = list(dict.fromkeys(known))
    return f"; it has {', '.join(listed)}" if 0 < len(listed) <= 8 else ""


# --- as text and as data ----------------------------------------------------------------------


def answer_text(answer: Answer, *, color: bool = False) -> str:
    """Return an answer for people, which ends in a line break."""
    paint = painted if color else lambda text, _: text
    value = "" if answer.value is None else f" = {answer.value}"
    lines = [paint(shortened(answer.address + value), BOLD)]
    lines += excerpt_lines(answer.span, list(_remarks(answer)), CYAN, paint)
    if answer.attribute is None:
        rows = []
        for name, attribute in answer.element.attributes.items():
            if attribute is not None:
                text = shortened(f"{name} = {format_value(attribute)}")
                rows.append((text, answer.element.value_span(name).place()))
        width = max((len(text) for text, _ in rows), default=0)
        lines += [f"  @{text.ljust(width)}  {place}" for text, place in rows]
    return "\n".join(lines) + "\n"


def _remarks(answer: Answer) -> Iterator[tuple[str, str]]:
    if answer.is_derived:
        yield "", f"not written in the file; it follows from '{answer.span.written()}' here"
    if answer.name_span is not None:
        written = answer.name_span.written()
        yield "name: ", f"{written}, at {answer.name_span.place()}"
    for changed in answer.replaced:
        yield "", changed.note
    for span in answer.others:
        yield "and: ", f"{span.written()}, at {span.place()}"
    for reading in _all_readings(answer):
        place = "" if reading.span is None else f", set at {reading.span.place()}"
        yield f"{reading.name} = ", f"{reading.value}{place}"
    for line in trace_lines(answer.trace):
        yield "", line
    for span in answer.mirrors:
        yield "", f"mirrored by '{span.written()}' at {span.place()}"
    if answer.fit is not None:
        yield "", f"{answer.fit.asked} of '{answer.fit.mesh}': {answer.fit.quality()}"
    for name, text in answer.formats.items():
        yield f"{name}: ", text


def _all_readings(answer: Answer) -> list[Reading]:
    """Return the variables of the value, of the part's name in it and of other places."""
    readings = list(answer.readings)
    if isinstance(answer.name_span, RecordedSpan):
        readings += answer.name_span.readings
    for span in answer.others:
        readings += span.readings if isinstance(span, RecordedSpan) else ()
    return readings


def answer_data(answer: Answer) -> dict[str, object]:
    """Return an answer as data for JSON. Lines and columns count from 1."""
    steps: list[Frame] = []  # the calls and includes that led there, innermost first
    trace = answer.trace
    while trace is not None and len(steps) < MAX_STEPS:
        steps.append(trace)
        trace = trace.parent
    return {
        "address": answer.address,
        "element": answer.element.name,
        "attribute": answer.attribute,
        "value": answer.value,
        "derived": answer.is_derived,
        "place": _place(answer.span),
        "name_place": None if answer.name_span is None else _place(answer.name_span),
        "replaced_places": [
            _place(each.replaced) for each in answer.replaced if each.replaced is not None
        ],
        "other_places": [_place(span) for span in answer.others],
        "mirrored_by": [_place(span) for span in answer.mirrors],
        "variables": [
            {
                "name": each.name,
                "value": each.value,
                "place": None if each.span is None else _place(each.span),
            }
            for each in _all_readings(answer)
        ],
        "steps": [
            {"kind": step.kind, "name": step.name, "place": _place(step.span)} for step in steps
        ],
        "formats": answer.formats,
        "fit": None
        if answer.fit is None
        else {
            "asked": answer.fit.asked,
            "mesh": answer.fit.mesh,
            "distance": answer.fit.distance,
            "excess": answer.fit.excess,
            "size": answer.fit.size,
        },
        "attributes": {}
        if answer.attribute is not None
        else {
            name: {"value": format_value(value), "place": _place(answer.element.value_span(name))}
            for name, value in answer.element.attributes.items()
            if value is not None
        },
    }


def _place(span: Span) -> dict[str, object]:
    source = span.source
    line, column = span.location()
    end_line, end_column = source.location(span.end)
    return {
        "file": source.path or source.name,
        "line": line,
        "column": column,
        "end_line": end_line,
        "end_column": end_column,
        "text": span.written(),
    }


# --- what each output format makes of an element or attribute ---------------------------------


def fit_of(answer: Answer, build: Build) -> Fitted | None:
    """Return how the shape that an answer is about was worked out from a mesh, or None."""
    section = next((each for each in answer.path if each.name in ("visual", "collision")), None)
    if section is None:
        return None
    places = {inner.span.key() for inner in section.iter()}
    owner = _owner(answer.path[:2])
    for fitted in build.robot.fits:
        if fitted.link == owner and fitted.span.key() in places:
            return fitted
    return None


MOST = 3
"""How many places in an output are named."""
SHAPES = ("visual", "collision", "geom")
NAMES = ("name", "joint", "link", "reference", "body1", "joint1", "site", "objname")
"""The attributes that say whose an element is."""


def in_formats(answer: Answer, home: str, build: Build) -> dict[str, str]:
    """Return what each format makes of an answer, by the name of the format.

    Args:
        answer: the answer, in the document of the format `home`.
        home: the format that it was asked for in.
        build: the build of all formats.
    """
    said: dict[str, str] = {}
    for format, output in build.outputs.items():
        if format == home:
            said[format] = tags_of(answer.path, answer.attribute)
            continue
        loss = _loss_of(answer, output.losses)
        found = _found(answer, output.root, _names_in(format, answer))
        texts = [_shown(found)] if found else []
        if loss is not None:
            texts = [] if loss.kind == "lost" else texts
            texts.append(f"{loss.kind} ({loss.what})" + (f": {loss.how}" if loss.how else ""))
        said[format] = ", ".join(texts) or "nothing"
    for format, reason in build.refused.items():
        said[format] = f"not written: {reason}"
    return said


def tags_of(path: Sequence[Element], attribute: str | None) -> str:
    """Return the tags around an element, and its own with an attribute of it."""
    inner = path[1:] if len(path) > 1 else path
    tags = []
    for element in inner:
        name = "name" if "name" in element.attributes else "reference"
        shown = attribute if element is path[-1] and attribute is not None else name
        value = element.attributes.get(shown)
        text = "" if value is None else f' {shown}="{escaped_attribute(format_value(value))}"'
        tags.append(f"<{element.name}{text}>")
    return " ".join(tags)


def _names_in(format: str, answer: Answer) -> list[str]:
    """Return what a format calls the value asked for; of an origin as a whole, each of its values.

    USD's names are those in their schema: `lowerLimit` is `physics:lowerLimit` in a prim.
    """
    thing, attribute = ELEMENTS.get(answer.element.name), answer.attribute
    if thing is None or format not in FORMATS or attribute == "name":  # all have a name
        return []
    fields = list(thing.fields) if attribute is None and thing.name == "origin" else [attribute]
    cells = [cell(format, thing.name, each) for each in fields if each in thing.fields]
    return [each.rpartition(":")[2] for each in cells if isinstance(each, str)]


def _shown(found: Found) -> str:
    texts = []
    for path, attribute in found[:MOST]:
        named = [at for at in range(1, len(path) - 1) if "name" in path[at].attributes]
        near = [path[0], *path[named[-1] if named else -1 :]]
        texts.append(f"{tags_of(near, attribute)} {path[-1].text().strip()}".strip())
    more = f", and {len(found) - MOST} more" if len(found) > MOST else ""
    return "; ".join(dict.fromkeys(texts)) + more


# --- losses -----------------------------------------------------------------------------------


def _loss_of(answer: Answer, losses: Sequence[Loss]) -> Loss | None:
    """Return the loss of what was asked for, or of something around it in a link or joint."""
    inner = answer.path[2:] if len(answer.path) > 2 else answer.path[1:]
    keys = [answer.span.key(), *(element.span.key() for element in reversed(inner))]
    owner = _owner(answer.path)
    for key in keys:
        alike = [loss for loss in losses if loss.span.key() == key]
        own = [loss for loss in alike if f"'{owner}'" in loss.owner]
        if own or len(alike) == 1:
            return (own or alike)[0]
    return None


def _owner(path: Sequence[Element]) -> str:
    """Return the name of the innermost element with one."""
    for element in reversed(path):
        if element.attributes.get("name") is not None:
            return format_value(element.attributes["name"])
    return ""


# --- places -----------------------------------------------------------------------------------


def _found(answer: Answer, root: Element, names: list[str]) -> Found:
    """Return the elements and attributes that are made of what was asked for.

    They are at its place; or else in what is made of its link or joint, and called like it, or
    by one of the names; or at least made of the same element.
    """
    owner = _owner(answer.path)
    paths: list[Path] = []
    pending: list[Path] = [[root]]
    while pending:
        path = pending.pop()
        paths.append(path)
        pending += [[*path, child] for child in reversed(path[-1].elements())]
    homes: Found = []  # what is made of the innermost element around it, or of itself
    for element in reversed(answer.path[1:-1] or answer.path[-1:]):
        homes = homes or _own(_made_of(paths, element), owner)
    if answer.element.name == "origin":
        # The poses of what an origin is in: elements, or attributes of a body.
        poses: Found = []
        for path, _ in homes:
            # The origin of a joint is the pose of the body that the joint moves.
            around = path[:-1] if path[-1].name == "joint" and path[-2].name == "body" else path
            for name in dict.fromkeys(names):
                poses += [
                    ([*path, each], None) for each in path[-1].elements() if each.name == name
                ]
                if name in around[-1].attributes:
                    poses.append((around, name))
        if poses:
            return poses
    exact: Found = []
    if answer.value is not None:
        exact = _own([found for path in paths for found in _at(path, answer.span.key())], owner)
        inside = [found for found in exact if _is_in(found[0], homes)]
        is_of_shape = any(element.name in SHAPES for element in answer.path)
        if homes:  # a mirrored limit is at the place of the other side's
            exact = [found for found in exact if _is_of(found[0], owner)]
        exact = inside or ([] if is_of_shape else exact)
    if answer.attribute is None:
        return exact or _own(_made_of(paths, answer.element), owner) or homes[:1]
    if exact:
        return exact
    inner = [path for path in paths if _is_in(path, homes) and _is_of(path, owner)]
    named: Found = [(path, name) for path in inner for name in names if name in path[-1].attributes]
    for word in (*names, answer.attribute, answer.element.name):
        named = named or [(path, None) for path in inner if path[-1].name == word]
    return named or _own(_made_of(paths, answer.element), owner) or homes[:1]


def _is_in(path: Path, homes: Found) -> bool:
    return any(home[-1] in path for home, _ in homes)


def _made_of(paths: list[Path], element: Element) -> Found:
    """Return the outermost elements that are made of an element."""
    key = element.span.key()
    return [
        (path, None)
        for path in paths
        if path[-1].span.key() == key
        and ("name" in path[-1].attributes or len(path) < 2 or path[-2].span.key() != key)
    ]


def _at(path: Path, key: object) -> Found:
    """Return the attributes of an element that are at a place, or its text."""
    element = path[-1]
    found: Found = [
        (path, name)
        for name, value in element.attributes.items()
        if value is not None and element.value_span(name).key() == key and name != "name"
    ]
    is_text = any(
        isinstance(child, Text) and child.span.key() == key and format_value(child.value).strip()
        for child in element.children
    )
    return [*found, (path, None)] if is_text else found


def _own(found: Found, owner: str) -> Found:
    """Return what belongs to a link or joint, if that is known."""
    return [each for each in found if _is_of(each[0], owner)] or found


def _is_of(path: Path, owner: str) -> bool:
    """Return whether an element is that of a link or joint, is in it, or refers to it."""
    for element in reversed(path):
        if owner in [format_value(element.attributes.get(name) or "") for name in NAMES]:
            return True
        if "name" in element.attributes and element.name not in SHAPES:
            return False
    return False
