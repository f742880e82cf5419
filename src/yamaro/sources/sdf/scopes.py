"""The models of a document, one in the other, and the frames that poses in them are relative to.

Each link, joint, `<frame>` and model is an `Anchor`: a frame that others name. Its pose is relative
to one other anchor, so that all lead up to the frame of the outermost model. A nested model is a
scope of names; one that is included with `merge` gives its names to the model around it.
"""

from __future__ import annotations

from math import isfinite

from ...diagnostics import did_you_mean
from ...model.pose import IDENTITY, Pose
from ...model.values import attribute_text, child_named, content
from ...source import Source, Span
from .values import compose, text_span

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...xml.tree import Element
    from .values import Reading

MODEL = "__model__"
WORLD = "world"
LINK, JOINT, FRAME = "link", "joint", "frame"
_NOWHERE = Span(Source("", name=""), 0, 0)
FEW = 8
"""Steps from one frame to another that are followed one by one."""


class Anchor:
    """Something that poses are relative to.

    Attributes:
        kind: LINK, JOINT, FRAME, or MODEL for the frame of a model.
        name: its name in its model.
        element: what says it.
        scope: the model that it is in; of a model, that model.
    """

    __slots__ = ("element", "kind", "name", "scope")

    def __init__(self, kind: str, name: str, element: Element, scope: Scope) -> None:
        self.kind = kind
        self.name = name
        self.element = element
        self.scope = scope


class Scope:
    """A model.

    Attributes:
        element: the `<model>`.
        include: the `<include>` that brought it in, or None.
        outer: the model that it is in, or None.
        name: its name; "" for the outermost one, and for one that is merged.
        anchor: its own frame.
        anchors: what is in it, in the order of the document.
        members: links, joints, frames and models by the names that it has for them.
        inner: the models in it.
    """

    __slots__ = (
        "anchor", "anchors", "element", "include", "inner", "members", "name", "outer",
    )  # fmt: skip

    def __init__(
        self, element: Element, name: str, outer: Scope | None, include: Element | None
    ) -> None:
        self.element = element
        self.include = include
        self.outer = outer
        self.name = name
        self.anchor = Anchor(MODEL, name, element, self)
        self.anchors: list[Anchor] = []
        self.members: dict[str, Anchor] = {}
        self.inner: list[Scope] = []

    def pose_element(self) -> Element | None:
        """Return the `<pose>` of the model: that of the include wins."""
        own = child_named(self.include, "pose") if self.include is not None else None
        return own or child_named(self.element, "pose")

    def placed_by(self) -> tuple[str, Span]:
        """Return the name of the frame that its pose places, "" for its own, and where it is."""
        place = child_named(self.include, "placement_frame") if self.include is not None else None
        if place is not None:
            return (content(place) or "").strip(), text_span(place)
        found = attribute_text(self.element, "placement_frame") or ""
        return found, self.element.value_span("placement_frame")

    def all_scopes(self) -> list[Scope]:
        """Return it and the models in it, however deep, in the order of the document."""
        found, pending = [], [self]
        while pending:
            scope = pending.pop()
            found.append(scope)
            pending += reversed(scope.inner)
        return found

    def path(self) -> list[str]:
        """Return the names of the models around what is in it, without the outermost."""
        names: list[str] = []
        scope: Scope | None = self
        while scope is not None:
            if scope.name:
                names.append(scope.name)
            scope = scope.outer
        return names[::-1]


class Frames:
    """Where the anchors of a document are, and what they are attached to."""

    __slots__ = ("_bodies", "_poses", "_reading", "_ups")

    def __init__(self, reading: Reading) -> None:
        self._reading = reading
        self._ups: dict[Anchor, tuple[Anchor | None, Pose]] = {}
        self._poses: dict[Anchor, Pose] = {}
        self._bodies: dict[Anchor, Anchor | None] = {}

    # --- names ---

    def seek(self, name: str, scope: Scope) -> Anchor | None:
        """Return what a name in a model means, or None."""
        if name == MODEL:
            return scope.anchor
        found = scope.members.get(name)
        if found is not None or "::" not in name:
            return found
        where = scope
        for word in name.split("::"):
            if found is not None:
                if found.kind != MODEL:
                    return None
                where = found.scope
            found = where.anchor if word == MODEL else where.members.get(word)
            if found is None:
                return None
        return found

    def find(self, name: str, scope: Scope, span: Span) -> Anchor | None:
        """Return what a name in a model means; None with an error for what is not there."""
        name = name.strip()
        found = self.seek(name, scope)
        if found is None:
            around, _, _ = name.rpartition("::")
            home = self.seek(around, scope) if around else None
            where = home.scope if home is not None and home.kind == MODEL else scope
            before = f"{around}::" if where is not scope else ""
            there = [f"{before}{each}" for each in where.members]
            hint: str | None = did_you_mean(name, there)
            if name == WORLD:
                hint = "in a model, only the <parent> of a joint can be the world"
            elif hint is None and there:
                listed = ", ".join(there[:8])
                hint = f"there are {listed}" + (" …" if len(there) > 8 else "")
            self._reading.fail(
                "sdf-frame", f"there is no link, joint, frame or model '{name}'", span, hint=hint
            )
        return found

    # --- poses ---

    def pose(self, anchor: Anchor) -> Pose:
        """Return T_outermost_anchor."""
        way: list[Anchor] = []
        here: Anchor | None = anchor
        seen: set[Anchor] = set()
        while here is not None and here not in self._poses:
            if here in seen:
                self._fail_of_cycle(way[way.index(here) :], "relative to")
                self._poses[here] = IDENTITY
                break
            seen.add(here)
            way.append(here)
            here = self._up(here)[0]
        for each in reversed(way):
            if each in self._poses:
                continue
            above, step = self._up(each)
            made = compose(self._poses[above], step) if above is not None else IDENTITY
            if not all(map(isfinite, made.position)):
                self._reading.fail(
                    "bad-sdf", f"the position of '{each.name}' is too far away", each.element.span
                )
                made = IDENTITY
            self._poses[each] = made
        return self._poses[anchor]

    def between(self, first: Anchor, second: Anchor) -> Pose:
        """Return T_first_second, as it is written if the pose of the second leads to the first."""
        if first is second:
            return IDENTITY
        here, step = second, IDENTITY
        for _ in range(FEW):
            above, own = self._up(here)
            if above is None:
                break
            here, step = above, compose(own, step)
            if here is first:
                return step
        one, other = self.pose(first), self.pose(second)
        if one == other:
            return IDENTITY
        return other if one is IDENTITY else one.inverse() @ other

    def pose_in(self, home: Anchor, element: Element | None, scope: Scope) -> Pose:
        """Return T_home_x of a `<pose>` in what is at home there; it may be relative to another."""
        pose = self._reading.pose(element)
        named, span = relative_to(element)
        if not named or element is None:
            return pose
        other = self.find(named, scope, span)
        return pose if other is None else compose(self.between(home, other), pose)

    def _up(self, anchor: Anchor) -> tuple[Anchor | None, Pose]:
        """Return the anchor that one is placed in, and T_above_anchor; None for the outermost."""
        known = self._ups.get(anchor)
        if known is None:
            self._ups[anchor] = (anchor.scope.anchor, IDENTITY)  # while it is found out
            known = self._ups[anchor] = self._found_up(anchor)
        return known

    def _found_up(self, anchor: Anchor) -> tuple[Anchor | None, Pose]:
        scope = anchor.scope
        if anchor.kind == MODEL:
            if scope.outer is None:
                return None, IDENTITY
            element, outer = scope.pose_element(), scope.outer
            pose, home = self._reading.pose(element), outer.anchor
            placed, span = scope.placed_by()
            if placed:
                inner = self.find(placed, scope, span)
                if inner is not None and inner is not anchor:
                    pose = compose(pose, self._within(inner, anchor).inverse())
        else:
            element = child_named(anchor.element, "pose")
            pose, home, outer = self._reading.pose(element), scope.anchor, scope
            if anchor.kind == FRAME:
                home = self._named_by(anchor, "attached_to") or home
            elif anchor.kind == JOINT:
                child = child_named(anchor.element, "child")
                named = (content(child) or "").strip()
                if child is not None and named and named != WORLD:
                    home = self.find(named, scope, text_span(child)) or home
        named, span = relative_to(element)
        if named:
            home = self.find(named, outer, span) or home
        return home, pose

    def _within(self, inner: Anchor, model: Anchor) -> Pose:
        """Return T_model_inner of what is placed in a model."""
        pose, here, seen = IDENTITY, inner, {inner}
        while here is not model:
            above, step = self._up(here)
            pose = compose(step, pose)
            if above is None or above in seen:
                self._fail_of_cycle([inner, model], "placed by")
                return IDENTITY
            seen.add(above)
            here = above
        return pose

    def _named_by(self, anchor: Anchor, attribute: str) -> Anchor | None:
        named = (attribute_text(anchor.element, attribute) or "").strip()
        if not named:
            return None
        return self.find(named, anchor.scope, anchor.element.value_span(attribute))

    def _fail_of_cycle(self, cycle: list[Anchor], how: str) -> None:
        names = " → ".join(f"'{each.name}'" for each in (*cycle[:6], cycle[0]))
        self._reading.fail(
            "sdf-cycle",
            f"frames are {how} each other: {names}",
            cycle[0].element.span,
            hint="give one of them a pose relative to another frame",
        )

    # --- bodies ---

    def body(self, anchor: Anchor) -> Anchor | None:
        """Return the link that something is attached to; None with an error if it is to none."""
        way: list[Anchor] = []
        here: Anchor | None = anchor
        while here is not None and here.kind != LINK:
            if here in self._bodies:
                here = self._bodies[here]
                break
            if here in way or len(way) > 10_000:
                self._fail_of_cycle(way[way.index(here) :], "attached to")
                here = None
                break
            way.append(here)
            here = self._attached_to(here)
        for each in way:
            self._bodies[each] = here
        return here

    def _attached_to(self, anchor: Anchor) -> Anchor | None:
        if anchor.kind == MODEL:
            return self.canonical(anchor.scope)
        if anchor.kind == FRAME:
            return self._named_by(anchor, "attached_to") or anchor.scope.anchor
        child = child_named(anchor.element, "child")
        named = (content(child) or "").strip()
        if child is None or not named or named == WORLD:
            return None
        return self.find(named, anchor.scope, text_span(child))

    def canonical(self, scope: Scope) -> Anchor | None:
        """Return the link that a model's frame is attached to: by default the first one."""
        named = (attribute_text(scope.element, "canonical_link") or "").strip()
        if named:
            return self.find(named, scope, scope.element.value_span("canonical_link"))
        merged = [scope]
        for each in merged:
            link = next((one for one in each.anchors if one.kind == LINK), None)
            if link is not None:
                return link
            merged += [one for one in each.inner if not one.name]
        nested = [each for each in scope.inner if each.name]
        return self.canonical(nested[0]) if nested else None


def relative_to(pose: Element | None) -> tuple[str, Span]:
    """Return the frame that a `<pose>` names, or "", and where; before 1.7 it is called `frame`."""
    for attribute in ("relative_to", "frame") if pose is not None else ():
        named = (attribute_text(pose, attribute) or "").strip()
        if named and pose is not None:
            return named, pose.value_span(attribute)
    return "", _NOWHERE
