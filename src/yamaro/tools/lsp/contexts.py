"""Which words are keys where: the place that the keys around an offset lead to."""

from __future__ import annotations

from .cursor import word_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...yaml.nodes import ScalarNode

ROOT, BODY, ANY, VALUE, DATA, XML = "root", "body", "any", "value", "data", "xml"
"""Places that have no row of their own in the manual: a body of statements; one that may be
inserted anywhere; a value; data whose keys are names; the content of an XML element."""

_OF_ROOT = {
    "variables": "variables",
    "functions": "functions",
    "arguments": "arguments",
    "model": BODY,
    "naming": "naming",
    "control": "control",
    "states": DATA,
    "groups": "groups",
    "collisions": "collisions",
    "import": "import",
    "print": VALUE,
    "process": VALUE,
    "base": VALUE,
}
_INNER = {
    "part": {"joint": "joint", "link": "link"},
    "joint": {
        word: word
        for word in ("limit", "dynamics", "mimic", "safety_controller", "calibration", "actuator")
    },
    "link": {word: word for word in ("visual", "collision", "inertial", "frame")},
    "visual": {"material": "material"},
    "collision": {"material": "material", "surface": "surface"},
    "attach": {"joint": "joint", "arguments": DATA, "body": BODY},
    "mirror": {"body": BODY, "rename": DATA, "meshes": DATA},
    "include": {"arguments": DATA},
    "groups": {},
    "argument": {},
    "control": {"params": DATA, "gpio": DATA},
}
_STATEMENTS = {
    "part": "part",
    "include": "include",
    "attach": "attach",
    "mirror": "mirror",
    "loop": "loop",
    "variables": "variables",
    "functions": "functions",
    "print": VALUE,
    "process": VALUE,
}
_TRANSPARENT = ("if", "elif", "else", "for")
_NAMED = {"arguments": "argument", "groups": "group", "functions": "function", "variables": VALUE}
CONTENTS = frozenset((ROOT, BODY, ANY, "part", "joint", "link", "visual", "collision", "inertial"))
"""Places in which statements may be."""


class Place:
    """Where keys are: what they mean there.

    Attributes:
        name: a place of the manual, or one of those above.
        call: the name of the function whose arguments they are, or "".
        element: the name of the XML element around them, or "".
    """

    __slots__ = ("call", "element", "name")

    def __init__(self, name: str) -> None:
        self.name = name
        self.call = ""
        self.element = ""


def place_of(keys: Sequence[ScalarNode]) -> Place:
    """Return the place below some keys, the outermost first."""
    place, content = Place(ROOT), ROOT
    for key in keys:
        place, content = _below(place, content, key.text)
    return place


def _below(place: Place, content: str, key: str) -> tuple[Place, str]:
    """Return the place below a key, and the place of the statements in it."""
    word, name = word_of(key), place.name
    if key.startswith("<"):
        return _element(word), XML
    if name in ("if", "for"):
        return (Place(content), content) if word == "body" else (Place(VALUE), content)
    if name in CONTENTS and word in _TRANSPARENT:
        is_long = key in ("if", "elif", "for")
        return (
            (Place("for" if word == "for" else "if"), content)
            if is_long
            else (
                Place(content),
                content,
            )
        )
    if name == "function":
        return (Place(ANY), ANY) if word == "body" else (Place(VALUE), VALUE)
    if name == "functions" and "(" in key:
        return Place(ANY), ANY
    if name in _NAMED:
        return Place(_NAMED[name]), content
    if name == "call":
        return (Place(ANY), ANY) if word[:1].isupper() else (Place(VALUE), VALUE)
    found = _inner(name, word, key)
    return found, (found.name if found.name in CONTENTS else content)


def _inner(name: str, word: str, key: str) -> Place:
    if name == ROOT and word in _OF_ROOT and "/" not in key:
        return Place(_OF_ROOT[word])
    if name in _INNER and word in _INNER[name]:
        return Place(_INNER[name][word])
    if name in ("link", "joint", ANY) and word == "sensor":
        return Place("sensor")
    if name == ANY and any(word in inner for inner in _INNER.values()):
        return Place(next(inner[word] for inner in _INNER.values() if word in inner))
    if name in CONTENTS and word in _STATEMENTS and "/" not in key:
        return Place(_STATEMENTS[word])
    if name in CONTENTS and word[:1].isupper() and "/" not in key:
        place = Place("call")
        place.call = key.strip()
        return place
    if name in (DATA, VALUE):
        return Place(DATA)
    return Place(BODY) if name == ROOT else _element(word)


def _element(word: str) -> Place:
    place = Place(XML)
    place.element = word
    return place
