"""A writer of formats for tests: it lists links, and loses joints."""

from __future__ import annotations

import sys
from types import ModuleType
from typing import TYPE_CHECKING

from yamaro.diagnostics import failure
from yamaro.targets.losses import APPROXIMATED, LOST, RENAMED, Loss
from yamaro.targets.output import MARK, Output
from yamaro.xml.tree import Element

if TYPE_CHECKING:
    import pytest

    from yamaro.model.robot import Robot
    from yamaro.targets.output import Wanted


def write(robot: Robot, wanted: Wanted) -> Output:
    """Write a list of links, in a format that has no joints; refuse a link named `refused`."""
    if "refused" in robot.links:
        raise failure("massless-moving", "the link is refused", robot.links["refused"].span)
    attributes = {
        "name": robot.name or wanted.name,
        "fixed": str(wanted.is_fixed).lower(),
        "version": wanted.version,
        "meshes": str(wanted.has_meshes).lower(),
        "repairs": str(wanted.repairs_inertia).lower(),
    }
    root = Element(wanted.format, robot.span, attributes=dict(attributes))
    root.children += [
        Element("body", link.span, attributes={"name": link.name}) for link in robot.links.values()
    ]
    losses = [
        Loss(LOST, "joints", f"joint '{joint.name}'", joint.span, hint="use links")
        for joint in robot.joints.values()
    ]
    if "square" in robot.links:
        square = robot.links["square"]
        losses += [
            Loss(APPROXIMATED, "squares", "link 'square'", square.span, how="circles"),
            Loss(RENAMED, "shapes", "link 'square'", square.span, how="circle"),
        ]
    return Output(root, losses, _files(wanted))


def _files(wanted: Wanted) -> dict[str, bytes]:
    """Return a file in `assets/` if meshes are wanted, and one beside the document if it is one."""
    files = {"assets/arm-12.stl": b"\0\1"} if wanted.has_meshes else {}
    if wanted.file_name:
        files["scene.xml"] = f"<!-- {MARK} -->\n<include file='{wanted.file_name}'/>\n".encode()
    return files


def write_with_stub(monkeypatch: pytest.MonkeyPatch) -> None:
    """Have all formats but URDF written by `write`."""
    for format in ("sdf", "mjcf", "srdf", "usd"):
        module = ModuleType(f"yamaro.targets.{format}.writer")
        module.write = write  # type: ignore[attr-defined]
        monkeypatch.setitem(sys.modules, module.__name__, module)
