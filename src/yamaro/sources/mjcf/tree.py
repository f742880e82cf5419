"""The tree of bodies: each with what is in it, defaults and frames resolved, names complete."""

from __future__ import annotations

import os

from ...diagnostics import YamaroError, failure
from ...model.pose import IDENTITY, Pose
from ...xml.mjcf_references import OBJECTS, REFERENCES, kind_in, words
from ...xml.reader import read_xml
from ...xml.tree import Element
from .classes import Classes, unknown
from .compiler import Compiler, chosen, completed, fault, given_by, number, truth
from .document import BODY, WORLD, attributes_of, load, text
from .references import COST, SUFFIX, WORLD_BODY, grown, is_within, names_in, replicate, too_many

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...source import Span
    from ..host import Host
    from .classes import Given
    from .document import Document
    from .references import Names

OF_BODY = frozenset(("gravcomp", "mocap", "user", "sleep", "fuse", "simple"))
"""What a body says of itself besides its pose."""
JOINT_TYPES = ("free", "ball", "slide", "hinge")
NAMING = REFERENCES.keys() | OBJECTS.keys()
"""The attributes that name something."""
_KINDS = {"equality": "equality", "tendon": "tendon"}
"""The default element of all that is in a section."""


class Thing:
    """An element with all that it has: its own attributes, and those of its class.

    Attributes:
        element: the element.
        kind: its name.
        name: the name that it has in the model, or "".
        given: its attributes except for names and classes; names in them are those in the model.
        context: the document that it is of.
    """

    __slots__ = ("context", "element", "given", "kind", "name")

    def __init__(self, element: Element, context: Context, given: Given) -> None:
        self.element = element
        self.kind = element.name
        self.context = context
        name = given.pop("name", None)
        self.name = context.named(name[0], self.kind) if name is not None and name[0] else ""
        given.pop("class", None)
        if context.prefix or context.suffix:
            for attribute in NAMING & given.keys():
                value, span = given[attribute]
                kind = kind_in(element, attribute)
                written = (context.named(each, kind) for each in words(element, value))
                given[attribute] = (" ".join(written), span)
        self.given = given

    @property
    def spot(self) -> tuple[int, ...]:
        """Return the identities of what attaches it, and of its element."""
        return (*self.context.place, id(self.element))

    @property
    def children(self) -> list[Thing]:
        """Return what is in it, such as the joints of a tendon."""
        return [Thing(each, self.context, given_by(each)) for each in self.element.elements()]

    @property
    def span(self) -> Span:
        """Return where it is written."""
        return self.element.span

    @property
    def name_span(self) -> Span:
        """Return where its name is written."""
        return self.element.value_span("name")

    def where(self, attribute: str) -> Span:
        """Return where an attribute is written, in the element or in its class."""
        found = self.given.get(attribute)
        return found[1] if found is not None else self.element.span

    def text(self, attribute: str) -> str | None:
        """Return an attribute as it is written, or None."""
        found = self.given.get(attribute)
        return found[0] if found is not None else None


class Placed(Thing):
    """A thing that is in a body at a pose.

    Attributes:
        pose: T_body_thing.
    """

    __slots__ = ("pose",)

    pose: Pose


class Body:
    """A body.

    Attributes:
        thing: its element, and the attributes of it.
        name: its name.
        pose: T_parent_body.
        inertial: its `<inertial>`, or None.
        joints: in order; with the frame around each, T_body_frame.
        geoms, sites: in order.
        others: what else is in it, such as cameras, with the frame around each.
        bodies: those in it.
    """

    __slots__ = (
        "bodies",
        "geoms",
        "inertial",
        "joints",
        "name",
        "others",
        "pose",
        "sites",
        "thing",
    )

    def __init__(self, thing: Thing, name: str, pose: Pose) -> None:
        self.thing = thing
        self.name = name
        self.pose = pose
        self.inertial: Placed | None = None
        self.joints: list[Placed] = []
        self.geoms: list[Placed] = []
        self.sites: list[Placed] = []
        self.others: list[Placed] = []
        self.bodies: list[Body] = []

    def iter(self) -> Iterator[Body]:
        """Yield it and all bodies in it, each before those in it."""
        pending = [self]
        while pending:
            body = pending.pop()
            yield body
            pending += reversed(body.bodies)


def type_of(joint: Placed) -> str:
    """Return the type of a joint."""
    if joint.kind == "freejoint":
        return "free"
    return chosen(joint.given, "type", JOINT_TYPES, "hinge")


def joint_kinds(world: Body) -> tuple[dict[str, str], dict[str, float]]:
    """Return the type of each joint, and its reference in radians or metres, by its name.

    Raises:
        YamaroError: two joints have one name.
    """
    kinds: dict[str, str] = {}
    refs: dict[str, float] = {}
    for body in world.iter():
        for joint in body.joints:
            if not joint.name:
                continue
            if joint.name in kinds:
                raise fault(
                    f"there are two joints named '{joint.name}'",
                    joint.name_span,
                    "give each its own name",
                )
            kinds[joint.name] = kind = type_of(joint)
            angle = joint.context.compiler.angle if kind == "hinge" else float
            refs[joint.name] = angle(number(joint.given, "ref", 0.0))
    return kinds, refs


class Context:
    """A document while it is read, as the main model or as one that is attached.

    Attributes:
        document: the document.
        classes: its default classes.
        compiler: its settings.
        prefix, suffix: what is before and after the names of all that is in it.
        place: the identities of the elements that attach it; none of the main document.
        part: the names in the part of it that is attached; None for all of it.
        has_keyframes: whether its keyframes are of the model.
    """

    __slots__ = (
        "classes", "compiler", "document", "has_keyframes", "host", "part", "place", "prefix",
        "suffix",
    )  # fmt: skip

    def __init__(
        self,
        document: Document,
        host: Host,
        prefix: str = "",
        suffix: str = "",
        place: tuple[int, ...] = (),
    ) -> None:
        """Read the settings and classes of a document, and replicate what it says.

        Raises:
            YamaroError: one of them is faulty.
        """
        self.document = document
        self.host = host
        self.prefix, self.suffix = prefix, suffix
        self.place = place
        self.part: Names | None = None
        self.has_keyframes = True
        if document.settings is None:
            compiler = Compiler(document)
            replicate(document, compiler, host.limits)
            document.settings = compiler, Classes(document.sections("default"))
        self.compiler, self.classes = document.settings

    def given(self, element: Element, childclass: str | None = None, *, section: str = "") -> Given:
        """Return the attributes of an element and those of its class.

        Args:
            element: the element.
            childclass: the class of those that have none.
            section: the section that it is in, unless it is in a body.

        Raises:
            YamaroError: it has a class that is not there.
        """
        own = given_by(element)
        named = own.get("class")
        name = named[0] if named is not None else childclass
        span = named[1] if named is not None else element.span
        kinds = self.classes.of(name, span)
        if section == "actuator" and element.name != "plugin":
            from .actuators import defaults

            base = defaults(self.classes.actuators(name, span), element.name)
        elif section in ("", "asset", "contact", "equality", "tendon"):
            base = kinds.get(_KINDS.get(section, element.name), {})
            if section == "tendon":
                allowed = attributes_of(section, element.name) or ()
                base = {each: value for each, value in base.items() if each in allowed}
        else:
            return own
        return completed(own, base) if base else own

    def named(self, name: str, kind: str | None) -> str:
        """Return the name in the model of what the document calls so."""
        is_world = name == WORLD_BODY and kind == BODY
        return name if is_world else f"{self.prefix}{name}{self.suffix}"

    def path(self, name: str, folder: str) -> str:
        """Return the absolute path of a file that the document names.

        Args:
            name: the file.
            folder: `meshdir` or `texturedir`.
        """
        if truth(self.compiler.given, "strippath", False):
            name = os.path.basename(name.replace("\\", "/"))
        return os.path.normpath(os.path.join(self.document.folder, folder, name))

    def things(self, section: str) -> list[Thing]:
        """Return the elements of all sections of a name."""
        return [
            Thing(each, self, self.given(each, section=section))
            for each in self.document.inside(section)
            if self.has(each, section)
        ]

    def has(self, element: Element, section: str) -> bool:
        """Return whether an element of a section belongs to what is attached of the document."""
        if self.part is None or section in ("asset", "extension"):
            return True
        return is_within(element, self.part)

    def models(self) -> dict[str, Element]:
        """Return the elements that name other documents, by the names of these."""
        found = self.document.models
        if found is None:
            found = self.document.models = {}
            for each in self.document.inside("asset"):
                if each.name == "model":
                    name = text(each, "name")
                    found[name or self._name_in(each) or ""] = each
        return found

    def _name_in(self, asset: Element) -> str | None:
        """Return the name that the document of an asset gives itself."""
        path = os.path.join(self.document.folder, text(asset, "file") or "")
        return text(read_xml(self.host.read(path, asset.value_span("file"))).root, "model")


class Reader:
    """Reads the bodies of a document, and of those that are attached.

    Attributes:
        host: gives files.
        attached: the documents that are attached, each as often as it is.
        documents: those that were read, by the paths of their files.
    """

    __slots__ = ("_attaching", "_copied", "_depth", "attached", "documents", "host")

    def __init__(self, host: Host, documents: dict[str, Document] | None = None) -> None:
        self.host = host
        self.attached: list[Context] = []
        self._depth = 0
        self._attaching: list[Element] = []
        self._copied = 0
        self.documents = {} if documents is None else documents

    def world(self, context: Context) -> Body:
        """Return the world of a document with all bodies in it.

        Raises:
            YamaroError: the document has an error.
        """
        sections = context.document.sections(WORLD)
        element = sections[0] if sections else context.document.root
        world = Body(Thing(element, context, {}), "world", IDENTITY)
        for section in sections:
            name = text(section, "childclass")
            self._read(context, section, world, IDENTITY, name)
        return world

    def _read(
        self, context: Context, around: Element, body: Body, frame: Pose, childclass: str | None
    ) -> None:
        """Read what is in a body, or in a frame in it."""
        compiler = context.compiler
        elements = around.elements()
        if context.place:
            self._copied += len(elements)
            if self._copied * COST > self.host.limits.statements:
                raise too_many(self._attaching[-1], self.host.limits)
        for element in elements:
            kind = element.name
            if kind == BODY:
                self._body(context, element, body, frame, childclass)
            elif kind == "attach":
                self._attach(context, element, body, frame, childclass)
            elif kind == "frame":
                given = given_by(element)
                inner = given.get("childclass")
                pose = compiler.pose(given)
                self._read(
                    context,
                    element,
                    body,
                    pose if frame is IDENTITY else frame @ pose,
                    inner[0] if inner is not None else childclass,
                )
            else:
                thing = Placed(element, context, context.given(element, childclass))
                thing.pose = frame
                if kind == "geom":
                    body.geoms.append(thing)
                elif kind == "site":
                    body.sites.append(thing)
                elif kind in ("joint", "freejoint"):
                    body.joints.append(thing)
                elif kind == "inertial":
                    body.inertial = thing
                else:
                    body.others.append(thing)

    def _body(
        self, context: Context, element: Element, parent: Body, frame: Pose, childclass: str | None
    ) -> None:
        given = given_by(element)
        inner = given.pop("childclass", None)
        thing = Thing(element, context, given)
        pose = context.compiler.pose(given)
        if frame is not IDENTITY:
            pose = frame @ pose
        body = Body(thing, thing.name, pose)
        parent.bodies.append(body)
        self._depth += 1
        if self._depth > self.host.limits.nesting:
            raise too_deep(self.host, self._depth, element.span)
        self._read(context, element, body, IDENTITY, inner[0] if inner is not None else childclass)
        self._depth -= 1

    # --- other models ---

    def _attach(
        self, context: Context, element: Element, body: Body, frame: Pose, childclass: str | None
    ) -> None:
        """Read another document, or a part of it, where it is attached."""
        prefix = context.prefix + (text(element, "prefix") or "")
        self._attaching.append(element)
        self._depth += 1
        if self._depth > self.host.limits.nesting:
            raise too_deep(self.host, self._depth, element.span)
        name = text(element, "model")
        document = context.document
        if name is not None:
            document = self._document(context, name, element.value_span("model"))
        self._copied += sum(len(each.children) for each in document.others((WORLD,)))
        suffix = (text(element, SUFFIX) or "") + context.suffix
        inner = Context(document, self.host, prefix, suffix, (*context.place, id(element)))
        inner.has_keyframes = name is not None
        self.attached.append(inner)
        for kind in ("body", "frame"):
            wanted = text(element, kind)
            if wanted is None:
                continue
            part = document.parts.get((kind, wanted))
            if part is None:
                found, above = _found(document, kind, wanted, element.value_span(kind))
                part = (found, above, grown(names_in(found), document))
                document.parts[kind, wanted] = part
            found, above, inner.part = part
            holder = Element(WORLD, element.span, children=[found])
            self._read(inner, holder, body, frame, above)
            break
        else:
            if name is None:
                raise failure(
                    "bad-mjcf",
                    "this attach names neither a model nor a body",
                    element.span,
                    hint='write <attach model="…" prefix="…"/>',
                )
            for section in document.sections(WORLD):
                self._read(inner, section, body, frame, text(section, "childclass"))
        self._attaching.pop()
        self._depth -= 1

    def _document(self, context: Context, name: str, span: Span) -> Document:
        """Return the document of a model that can be attached."""
        models = context.models()
        if name not in models:
            raise unknown("model", name, models, span)
        asset = models[name]
        file, place = text(asset, "file") or "", asset.value_span("file")
        path = os.path.normpath(os.path.join(context.document.folder, file))
        if path not in self.documents:
            root = read_xml(self.host.read(path, place), self.host.limits).root
            self.documents[path] = load(root, self.host, os.path.dirname(path))
        return self.documents[path]


def too_deep(host: Host, depth: int, span: Span) -> YamaroError:
    """Return the error for bodies or models that are nested too deep."""
    return failure(
        "too-deep",
        f"bodies are nested {depth:,} levels deep here",
        span,
        hint=host.limits.hint("nesting"),
    )


def _found(document: Document, kind: str, name: str, span: Span) -> tuple[Element, str | None]:
    """Return a body or frame of a document, and the class that is around it.

    Raises:
        YamaroError: there is none of the name.
    """
    pending = [(each, text(each, "childclass")) for each in document.sections(WORLD)]
    known = []
    while pending:
        element, around = pending.pop()
        for child in element.elements():
            if child.name == kind:
                known.append(text(child, "name") or "")
                if known[-1] == name:
                    return child, around
            pending.append((child, text(child, "childclass") or around))
    raise unknown(kind, name, known, span)
