"""What a document holds: its version, the model that is wanted, and the files that it includes."""

from __future__ import annotations

import os

from ...diagnostics import YamaroError, did_you_mean
from ...model.values import attribute_text, child_named, content
from ...xml.reader import read_xml
from ...xml.tree import Element
from .scopes import FRAME, JOINT, LINK, WORLD, Anchor, Scope
from .values import text_span
from .versions import VERSIONS, convert

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...source import Source, Span
    from .values import Reading

DEEPEST = 60
"""Models in one another."""
MODEL_FILES = (".sdf", ".world", ".xml", ".urdf")
"""The endings of addresses that name a file, not the folder of a model."""


class Choice:
    """The model that is read.

    Attributes:
        scope: the model.
        world: the `<world>` that it is in, or None.
        name: its name.
        joints: those of the world that hold it there.
    """

    __slots__ = ("joints", "name", "scope", "world")

    def __init__(self, scope: Scope, name: str, world: Element | None) -> None:
        self.scope = scope
        self.name = name
        self.world = world
        self.joints: list[Anchor] = []


class Document:
    """Opens a document and what it includes."""

    __slots__ = ("_files", "_reading")

    def __init__(self, reading: Reading) -> None:
        self._reading = reading
        self._files: list[str] = []  # those that are being read, each included by the one before

    def choice(self, root: Element) -> Choice:
        """Return the model that is wanted, else the first one.

        Raises:
            YamaroError: there is none, or the version is not one that is read.
        """
        reading, wanted = self._reading, self._reading.host.model
        self._check_version(root)
        self._files.append(os.path.abspath(root.span.source.path or root.span.source.name))
        worlds = [each for each in root.elements() if each.name == "world"]
        found: list[tuple[str, Element, Element | None, Element | None]] = []
        for holder in (root, *worlds):
            world = None if holder is root else holder
            found += [
                (attribute_text(each, "name") or "", each, None, world)
                for each in holder.elements()
                if each.name == "model"
            ]
        includes = [
            (each, None if holder is root else holder)
            for holder in (root, *worlds)
            for each in holder.elements()
            if each.name == "include"
        ]
        if wanted is not None:
            chosen = next((each for each in found if each[0] == wanted), None)
            if chosen is None:
                chosen = self._wanted_include(includes, wanted)
        else:
            chosen = found[0] if found else self._first_include(includes)
        names = [each[0] for each in found] + [_name_of_include(each) for each, _ in includes]
        if chosen is None:
            self._fail_without_model(root, wanted, names)
            raise YamaroError(reading.errors)
        name, element, include, world = chosen
        others = [each for each in names if each != name]
        if wanted is None and len(found) > 1:
            listed = ", ".join(f"'{each}'" for each in others[:6])
            reading.warn(
                "several-models",
                f"this file has {len(found)} models, and only the first, '{name}', is read",
                element.value_span("name"),
                hint=f"--model chooses another one: {listed}" + (" …" if len(others) > 6 else ""),
            )
        scope = self._scope(element, "", None, include)
        choice = Choice(scope, name, world)
        if world is not None:
            self._read_world(world, choice)
        return choice

    def _check_version(self, root: Element) -> None:
        version = (attribute_text(root, "version") or "").strip()
        self._reading.versions[id(root.span.source)] = version
        if version in VERSIONS:
            convert(root, version)
            return
        if not version:
            self._reading.warn(
                "sdf-assumed",
                "this <sdf> has no version; it is read as 1.12",
                root.span,
                hint='write <sdf version="1.9">',
            )
            return
        self._reading.fail(
            "sdf-version",
            f"version '{version}' of SDFormat is not one that can be read",
            root.value_span("version"),
            hint=f"the versions are {VERSIONS[0]} to {VERSIONS[-1]}",
        )
        self._reading.settle()

    def _fail_without_model(self, root: Element, wanted: str | None, names: list[str]) -> None:
        if wanted is None:
            kinds = [each.name for each in root.elements() if each.name in ("light", "actor")]
            what = f"a <{kinds[0]}>" if kinds else "no <model>"
            self._reading.fail(
                "sdf-model",
                f"this file holds {what}, and a robot is a <model>",
                root.span,
                hint='write <model name="…"> in <sdf>, or in a <world>',
            )
            return
        listed = ", ".join(f"'{each}'" for each in names[:8])
        self._reading.fail(
            "sdf-model",
            f"there is no model '{wanted}' in this file",
            root.span,
            hint=did_you_mean(wanted, names) or (f"there are {listed}" if names else None),
        )

    def _read_world(self, world: Element, choice: Choice) -> None:
        """Take the joints that hold the model in the world, and report what else a world says."""
        name = choice.name
        around = Scope(world, "", None, None)
        around.members[name] = choice.scope.anchor
        kinds: dict[str, None] = {}
        for each in world.elements():
            if each.name == JOINT:
                ends = [content(child_named(each, end)) or "" for end in ("parent", "child")]
                if all(end == WORLD or end.split("::")[0] == name for end in ends):
                    own = self._reading.name(each)
                    choice.joints.append(Anchor(JOINT, own, each, around))
                    continue
            if each.name not in ("model", "include"):
                kinds[each.name] = None
        if kinds:
            self._reading.warn(
                "sdf-lost",
                "what a world says is not part of a robot: "
                + ", ".join(f"<{each}>" for each in kinds),
                world.span,
            )

    # --- models that are included ---

    def _wanted_include(
        self, includes: list[tuple[Element, Element | None]], wanted: str
    ) -> tuple[str, Element, Element | None, Element | None] | None:
        """Return the model of the include that has a name, or whose file says it."""
        for include, world in includes:
            if _name_of_include(include) == wanted:
                model = self._load(include)
                return None if model is None else (wanted, model, include, world)
        return None

    def _first_include(
        self, includes: list[tuple[Element, Element | None]]
    ) -> tuple[str, Element, Element | None, Element | None] | None:
        """Return the first model that is included; files that hold lights are passed over."""
        for include, world in includes:
            model = self._load(include)
            if model is not None:
                own = content(child_named(include, "name"))
                return own or attribute_text(model, "name") or "", model, include, world
        self._reading.settle()
        return None

    def _load(self, include: Element) -> Element | None:
        """Return the `<model>` of a file that is included, or None, with an error or a light."""
        reading = self._reading
        uri = child_named(include, "uri")
        address = (content(uri) or "").strip()
        if uri is None or not address:
            reading.fail(
                "sdf-include",
                "this <include> has no <uri>",
                include.span,
                hint="write <uri>model://NAME</uri>, or the path of a file",
            )
            return None
        span = text_span(uri)
        source = self._open(address, span)
        if source is None:
            return None
        path = os.path.abspath(source.path or source.name)
        if path in self._files:
            names = " → ".join(os.path.basename(each) for each in (*self._files, path))
            reading.fail("sdf-cycle", f"files include each other: {names}", span)
            return None
        if len(self._files) > DEEPEST:
            reading.fail("sdf-cycle", f"files are included more than {DEEPEST} deep", span)
            return None
        reading.enter(source, include)
        root = read_xml(source, reading.host.limits).root
        if root.name not in ("sdf", "gazebo"):
            of_urdf = root.name == "robot"
            reading.fail(
                "sdf-include",
                f"'{address}' is {'URDF' if of_urdf else f'a <{root.name}>'}, and <include> takes "
                "SDF",
                span,
                hint="`yamaro FILE --to sdf` makes SDF of it" if of_urdf else None,
            )
            return None
        self._check_version(root)
        model = next((each for each in root.elements() if each.name == "model"), None)
        if model is None and not any(each.name in ("light", "actor") for each in root.elements()):
            reading.fail("sdf-include", f"there is no <model> in '{address}'", span)
        return model

    def _open(self, address: str, span: Span) -> Source | None:
        """Return the file that an address means: itself, or that of the folder of a model."""
        reading = self._reading
        host = reading.host
        if "://" in address and not address.startswith(("model://", "package://", "file://")):
            reading.fail(
                "sdf-include",
                f"'{address}' is not on this machine",
                span,
                hint="download the model, and include the file",
            )
            return None
        # As in Gazebo, a name without a folder can be that of a model on a search path.
        is_name = "://" not in address and not os.path.isabs(address)
        missing: YamaroError | None = None
        for each in (address, *([f"model://{address}"] if is_name else [])):
            path = host.finder.path_meant(each, span)
            try:
                if path is not None:
                    return self._open_path(path, span)
            except YamaroError as error:
                if error.diagnostics[0].code != "missing-file":
                    raise
                missing = missing or error
        if missing is not None and not is_name:
            raise missing
        reading.fail(
            "sdf-include",
            f"the model '{address}' is not found",
            span,
            hint="name the folder that holds it in GZ_SIM_RESOURCE_PATH",
        )
        return None

    def _open_path(self, path: str, span: Span) -> Source:
        """Return the file of a path: itself, or that of the folder of a model."""
        host = self._reading.host
        if path.lower().endswith(MODEL_FILES):
            return host.read(path, span)
        try:
            manifest = host.read(os.path.join(path, "model.config"), span)
        except YamaroError as error:
            if error.diagnostics[0].code != "missing-file":
                raise
            return host.read(os.path.join(path, "model.sdf"), span)
        listed = [each for each in read_xml(manifest, host.limits).root.elements()
                  if each.name == "sdf" and content(each)]  # fmt: skip
        known = [each for each in listed if attribute_text(each, "version") in VERSIONS]
        best = max(known, key=_version_of, default=listed[0] if listed else None)
        file = content(best) if best is not None else "model.sdf"
        return host.read(os.path.join(path, file or "model.sdf"), span)

    # --- scopes ---

    def _scope(
        self, model: Element, name: str, outer: Scope | None, include: Element | None
    ) -> Scope:
        """Return a model with all that is in it."""
        scope = Scope(model, name, outer, include)
        depth = len(scope.path())
        if depth > DEEPEST:
            self._reading.fail(
                "sdf-cycle", f"models are nested more than {DEEPEST} deep", model.span
            )
            return scope
        for child in model.elements():
            if child.name in (LINK, JOINT, FRAME):
                own = self._reading.name(child)
                if own:
                    anchor = Anchor(child.name, own, child, scope)
                    scope.anchors.append(anchor)
                    self._add(scope, own, anchor)
            elif child.name == "model":
                own = self._reading.name(child)
                if own:
                    self._nest(scope, child, own, None)
            elif child.name == "include":
                self._include(scope, child)
        return scope

    def _include(self, scope: Scope, include: Element) -> None:
        model = self._load(include)
        if model is None:
            return
        named = child_named(include, "name")
        name = content(named) or attribute_text(model, "name") or ""
        self._files.append(os.path.abspath(model.span.source.path or model.span.source.name))
        merges = (attribute_text(include, "merge") or "").lower() in ("true", "1")
        if not merges:
            self._nest(scope, model, name, include)
        else:
            inner = self._scope(model, "", scope, include)
            scope.inner.append(inner)
            for own, anchor in inner.members.items():
                self._add(scope, own, anchor)
            scope.members.setdefault(f"_merged__{name}__model__", inner.anchor)
        self._files.pop()

    def _nest(self, scope: Scope, model: Element, name: str, include: Element | None) -> None:
        inner = self._scope(model, name, scope, include)
        scope.inner.append(inner)
        self._add(scope, name, inner.anchor)

    def _add(self, scope: Scope, name: str, anchor: Anchor) -> None:
        """Take a name for something in a model, which has to be the only one."""
        first = scope.members.setdefault(name, anchor)
        if first is not anchor and JOINT in (first.kind, anchor.kind) and first.kind != anchor.kind:
            if first.kind == JOINT:  # what names it means the link
                scope.members[name] = anchor
            self._reading.warn(
                "sdf-renamed",
                f"a joint and a {LINK if LINK in (first.kind, anchor.kind) else FRAME} of this "
                f"model are both called '{name}'",
                anchor.element.value_span("name"),
                hint="rename one of them; libsdformat renames the frame of the joint",
            )
        elif first is not anchor:
            self._reading.fail(
                "bad-sdf",
                f"two things in this model are called '{name}'",
                anchor.element.value_span("name"),
                hint="links, joints, frames and models of one model need different names",
                notes=[f"the first is at {first.element.value_span('name').place()}"],
            )
        elif (name == WORLD and anchor.kind != JOINT) or (
            name.startswith("__") and name.endswith("__")
        ):
            self._reading.fail(
                "bad-sdf",
                f"the name '{name}' is reserved",
                anchor.element.value_span("name"),
                hint=f"write another one, such as '{name.strip('_')}_link'",
            )


def _version_of(element: Element) -> int:
    return int((attribute_text(element, "version") or "1.0").partition(".")[2])


def _name_of_include(include: Element) -> str:
    """Return the name of an include: its own, or that of the folder of the model."""
    own = content(child_named(include, "name"))
    return own or (content(child_named(include, "uri")) or "").rstrip("/").split("/")[-1]
