"""Prims of USD: their names, their poses, and elements at the places of what they are made of."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from pxr import Gf, Sdf, UsdGeom, Vt

from ...model.pose import quaternion_from_rotation
from ..bodies import Bodies
from ..elements import UsedNames, element

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from pxr import Usd

    from ...model.extras import Loop, Sensor, State
    from ...model.joint import Joint
    from ...model.link import Link
    from ...model.pose import Pose
    from ...model.robot import Robot
    from ...model.values import Written
    from ...source import Span
    from ...xml.tree import Element
    from ..elements import Attributes, Owner
    from ..losses import Losses
    from ..output import Wanted


def element_of(
    prim: Usd.Prim,
    owner: Owner,
    *,
    children: Iterable[Element] = (),
    places: Mapping[str, Span] | None = None,
    is_named: bool = True,
) -> Element:
    """Return an element with the name, the path and the values of a prim that are one word.

    They are called as in their schema: `upperLimit` is `physics:upperLimit` in the prim. This is
    what `yamaro why` looks up.

    Args:
        prim: the prim.
        owner: what it is made of.
        children: the elements in it.
        places: where its values are written, if not there.
        is_named: whether its name is that of one prim; what is in an element can do without.
    """
    values = {each.GetBaseName(): each.Get() for each in prim.GetAuthoredAttributes()}
    attributes: Attributes = {"path": str(prim.GetPath())}
    if is_named:
        attributes = {"name": prim.GetName(), **attributes}
    for name, value in values.items():
        if isinstance(value, (str, float, int)):
            attributes[name] = value
    return element(prim.GetTypeName(), attributes, children=children, owner=owner, places=places)


class Writing:
    """What the writers of one robot share.

    Attributes:
        stage: takes the prims.
        robot: the robot.
        wanted: what is asked for; finds meshes.
        bodies: which links are bodies.
        names: names prims.
        root: the path of the robot.
        paths: the prims of links and frames, by name.
    """

    __slots__ = ("bodies", "names", "paths", "robot", "root", "stage", "wanted")

    def __init__(
        self, stage: Usd.Stage, robot: Robot, wanted: Wanted, names: Names, root: str
    ) -> None:
        self.stage = stage
        self.robot = robot
        self.wanted = wanted
        self.bodies = Bodies(robot)
        self.names = names
        self.root = root
        self.paths: dict[str, str] = {}


# --- schemas that OpenUSD does not have itself ------------------------------------------------

NEWTON_SCHEMAS = "0.6.0"
"""The version of newton-usd-schemas whose names and units are written."""


def set_values(
    prim: Usd.Prim,
    schema: str,
    namespace: str,
    values: Mapping[str, float | None],
    *,
    keeps_zeros: bool = False,
) -> None:
    """Give a prim values of a schema of Newton or PhysX, whose library does not have to be there.

    Args:
        prim: the prim.
        schema: the schema, which is applied if there is a value.
        namespace: what is before the names of its values, without the last colon.
        values: the values by name; those that are None are left out.
        keeps_zeros: whether 0 is written, though it may be what the schema has anyway.
    """
    given = {name: value for name, value in values.items() if value or (value == 0 and keeps_zeros)}
    if not given:
        return
    prim.AddAppliedSchema(schema)
    for name, value in given.items():
        attribute = prim.CreateAttribute(
            f"{namespace}:{name}", Sdf.ValueTypeNames.Float, custom=False
        )
        attribute.Set(value)


# --- names of prims: letters, digits and underscores, with no digit at the start --------------


_OTHER = re.compile(r"[^0-9A-Za-z_]")


class Names:
    """The names that prims have, by the path of the prim around them.

    Attributes:
        losses: what is renamed.
        names: by kind and path, what the prims of links, joints, … are called in the robot.
    """

    __slots__ = ("_used", "losses", "names")

    def __init__(self, losses: Losses) -> None:
        self._used = UsedNames()
        self.names: dict[str, dict[str, str]] = {}
        self.losses = losses

    def new(self, around: str, name: str) -> str:
        """Return the path of a new prim, with a name as near to this one as can be."""
        plain = _OTHER.sub("_", name) or "_"
        if plain[0].isdigit():
            plain = f"_{plain}"
        return f"{around}/{self._used.fresh(around, plain)}"

    def told(
        self, around: str, kind: str, name: str, owner: Link | Joint | Sensor | Loop | State,
        part: Written | None = None,
    ) -> str:  # fmt: skip
        """Return the path of a new prim, and note it if its name is another one.

        Args:
            around: the path of the prim around it.
            kind: what it is made of: `link`, `frame`, `joint`, `loop`, `sensor`, `state` or
                `material`.
            name: what that is called.
            owner: the same, or the link that has it.
            part: the part of that link.
        """
        path = self.new(around, name)
        self.names.setdefault(kind, {})[path] = name
        new = path.rpartition("/")[2]
        if new != name:
            label = f"{kind} '{name}'"
            self.losses.rename(f"{kind}s", owner, part=part, field="name", label=label, new=new)
        return path


# --- poses of prims ---------------------------------------------------------------------------


def quaternion_of(pose: Pose) -> Gf.Quatd:
    """Return the rotation of a pose; Gf's own way through an angle is exact to 1e-5 only."""
    w, x, y, z = quaternion_from_rotation(pose.rotation)
    return Gf.Quatd(w, x, y, z)


def place(prim: UsdGeom.Xformable, pose: Pose, scale: tuple[float, ...] | None = None) -> None:
    """Put a prim at a pose in the one around it, and scale it."""
    xform = UsdGeom.Xformable(prim)
    xform.AddTranslateOp().Set(Gf.Vec3d(*pose.position))
    xform.AddOrientOp(UsdGeom.XformOp.PrecisionDouble).Set(quaternion_of(pose))
    if scale is not None:
        xform.AddScaleOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Vec3d(*scale))


def place_by_name(prim: Usd.Prim, pose: Pose) -> None:
    """Put a prim at a pose in the one around it, whose type is of another library."""
    kinds = Sdf.ValueTypeNames
    values = {
        "xformOp:translate": (kinds.Double3, Gf.Vec3d(*pose.position)),
        "xformOp:orient": (kinds.Quatd, quaternion_of(pose)),
    }
    for name, (kind, value) in values.items():
        prim.CreateAttribute(name, kind, custom=False).Set(value)
    order = prim.CreateAttribute("xformOpOrder", kinds.TokenArray, custom=False)
    order.Set(Vt.TokenArray(list(values)))
