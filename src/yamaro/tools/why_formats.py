"""What each output format makes of an element or attribute, for `yamaro why`.

The elements of an output know the place of what they are made of. So what a format makes of a
value is what is at the same place, in the link or joint of the same name.
"""

from __future__ import annotations

from ..xml.tree import Element, Text
from ..xml.values import escaped_attribute, format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from ..result import Build
    from ..targets.output import Loss
    from .why import Answer

    Path = list[Element]
    Found = list[tuple[Path, str | None]]

OTHERWISE = {
    "lower": ("range", "lowerLimit"),
    "upper": ("range", "upperLimit"),
    "effort": ("maxForce",),
}
"""Attributes that formats call otherwise, or write in one, with the names that they may have."""
POSES = {"xyz": ("pos",), "rpy": ("quat", "euler")}
"""The attributes of an origin, with the names of the attributes that hold them in MJCF."""
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
        else:
            said[format] = _in_format(answer, output)
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


def _in_format(answer: Answer, output: Build) -> str:
    loss = _loss_of(answer, output.losses)
    found = _found(answer, output.root)
    if loss is not None:
        how = f": {loss.how}" if loss.how else ""
        said = f"{loss.kind} ({loss.what}){how}"
        if loss.kind == "lost" or not found:
            return said
        return f"{_shown(found)}, {said}"
    return _shown(found) if found else "nothing"


def _shown(found: Found) -> str:
    texts = [tags_of(_near(path), attribute) for path, attribute in found[:MOST]]
    texts = [
        f"{text} {path[-1].text().strip()}".strip()
        for text, (path, _) in zip(texts, found, strict=False)
    ]
    more = f", and {len(found) - MOST} more" if len(found) > MOST else ""
    return "; ".join(dict.fromkeys(texts)) + more


def _near(path: Path) -> Path:
    """Return a path from the innermost element around the end that has a name."""
    for index in range(len(path) - 2, 0, -1):
        if "name" in path[index].attributes:
            return [path[0], *path[index:]]
    return [path[0], path[-1]]


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


def _found(answer: Answer, root: Element) -> Found:
    """Return the elements and attributes that are made of what was asked for.

    They are at its place; or else in what is made of its link or joint, and called like it; or at
    least made of the same element.
    """
    owner = _owner(answer.path)
    paths = list(_paths(root))
    homes = _homes(answer, paths, owner)
    poses = _pose_of(answer, homes)
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
    if exact and answer.attribute is not None:
        return exact
    inner: Found = [(path, None) for path in paths if _is_in(path, homes) and _is_of(path, owner)]
    named = _named_like(answer, inner)
    return named or exact or _own(_made_of(paths, answer.element), owner) or homes[:1]


def _named_like(answer: Answer, inner: Found) -> Found:
    """Return what has the name of the attribute or element asked for, or the one it has there."""
    if answer.attribute is None:
        return []
    named: Found = [
        (path, name)
        for path, _ in inner
        for name in OTHERWISE.get(answer.attribute, ())
        if name in path[-1].attributes
    ]
    for word in (answer.attribute, answer.element.name):
        named = named or [found for found in inner if found[0][-1].name == word]
    return named


def _pose_of(answer: Answer, homes: Found) -> Found:
    """Return the poses of what an origin is in: an element `pose`, or attributes of a body."""
    if answer.element.name != "origin":
        return []
    found: Found = []
    for path, _ in homes:
        found += [([*path, child], None) for child in path[-1].elements() if child.name == "pose"]
        # The origin of a joint is the pose of the body that the joint moves.
        around = path[:-1] if path[-1].name == "joint" and path[-2].name == "body" else path
        for name in POSES.get(answer.attribute or "", ()):
            if name in around[-1].attributes:
                found.append((around, name))
    return found


def _homes(answer: Answer, paths: list[Path], owner: str) -> Found:
    """Return what is made of the innermost element around the one asked for, or of itself."""
    around = answer.path[1:-1] or answer.path[-1:]
    for element in reversed(around):
        found = _own(_made_of(paths, element), owner)
        if found:
            return found
    return []


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


def _paths(root: Element) -> Iterator[Path]:
    """Yield the path from the root to each element, in order."""
    pending: list[Path] = [[root]]
    while pending:
        path = pending.pop()
        yield path
        pending += [[*path, child] for child in reversed(path[-1].elements())]


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
        if "name" in element.attributes:
            return False
    return False
