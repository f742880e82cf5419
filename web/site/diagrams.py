"""Draws the diagrams of docs/language.md: what `pivot`, frames and scopes are.

    python web/site/diagrams.py FOLDER     writes pivot.svg, frames.svg and scopes.svg there

All positions come from robots that Yamaro builds. The background is opaque, so that the diagrams
can be read on light and dark pages.
"""

from __future__ import annotations

import math
import sys
import tempfile
from collections.abc import Iterator
from html import escape
from pathlib import Path
from xml.etree import ElementTree as ET

import yamaro

RED, BLUE, GREY, DARK, ORANGE = "#c62f2f", "#2458b8", "#8a919c", "#22262c", "#c26a00"
FILL, SEEN, UNSEEN = "#dfe5ee", "#bfe3c4", "#f1f2f4"
MONO = "ui-monospace, SFMono-Regular, Menlo, Consolas, monospace"

Pose = tuple[float, float, float]
"""x and z in m, and the angle about y in radians: all that is seen from the right side."""


class Drawing:
    """An SVG of a size; lengths are in pixels, y points down."""

    def __init__(self, width: int, height: int, title: str) -> None:
        self.head = (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
            f'width="{width}" height="{height}" font-family="system-ui, sans-serif" font-size="14">'
        )
        self.lines = [
            f"<title>{escape(title)}</title>",
            f'<rect width="{width}" height="{height}" rx="8" fill="#ffffff"/>',
        ]

    def add(self, line: str) -> None:
        """Add an element."""
        self.lines.append(line)

    def text(self, x: float, y: float, text: str, **more: str) -> None:
        """Write a line of text."""
        given = {"fill": DARK, **more}
        words = "".join(f' {key.replace("_", "-")}="{value}"' for key, value in given.items())
        self.add(f'<text x="{x:.1f}" y="{y:.1f}"{words}>{escape(text)}</text>')

    def code(self, x: float, y: float, text: str, **more: str) -> None:
        """Write a line of code."""
        self.text(x, y, text, font_family=MONO, font_size="13", **more)

    def arrow(self, start: tuple[float, float], end: tuple[float, float], colour: str) -> None:
        """Draw an arrow."""
        (x, y), (u, v) = start, end
        length = math.hypot(u - x, v - y)
        dx, dy = (u - x) / length, (v - y) / length
        self.add(
            f'<path d="M{x:.1f} {y:.1f}L{u - 6 * dx:.1f} {v - 6 * dy:.1f}" stroke="{colour}" '
            'stroke-width="2.5" fill="none"/>'
        )
        points = [(u, v), (u - 9 * dx + 4.5 * dy, v - 9 * dy - 4.5 * dx)]
        points.append((u - 9 * dx - 4.5 * dy, v - 9 * dy + 4.5 * dx))
        corners = " ".join(f"{a:.1f},{b:.1f}" for a, b in points)
        self.add(f'<polygon points="{corners}" fill="{colour}"/>')

    def svg(self) -> str:
        """Return the file."""
        return "\n".join([self.head, *self.lines, "</svg>"]) + "\n"


class Side:
    """A robot seen from its right: x to the right, z up."""

    def __init__(self, drawing: Drawing, origin: tuple[float, float], scale: float) -> None:
        self.drawing = drawing
        self.origin = origin
        self.scale = scale

    def at(self, x: float, z: float) -> tuple[float, float]:
        """Return where a point is in the drawing."""
        return self.origin[0] + self.scale * x, self.origin[1] - self.scale * z

    def box(self, pose: Pose, width: float, height: float, style: str) -> None:
        """Draw a box about its centre."""
        corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
        points = [self.at(*moved(pose, a * width / 2, b * height / 2)[:2]) for a, b in corners]
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.drawing.add(f'<polygon points="{text}" {style}/>')

    def axes(self, pose: Pose, length: float) -> None:
        """Draw the x and z axes of a frame."""
        start = self.at(*pose[:2])
        self.drawing.arrow(start, self.at(*moved(pose, length, 0)[:2]), RED)
        self.drawing.arrow(start, self.at(*moved(pose, 0, length)[:2]), BLUE)

    def dot(self, pose: Pose, colour: str) -> None:
        """Mark the origin of a frame."""
        x, y = self.at(*pose[:2])
        self.drawing.add(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{colour}" stroke="#fff"/>')

    def cross(self, pose: Pose) -> None:
        """Mark the middle of a shape."""
        x, y = self.at(*pose[:2])
        lines = f"M{x - 5:.1f} {y:.1f}h10M{x:.1f} {y - 5:.1f}v10"
        self.drawing.add(f'<path d="{lines}" stroke="{DARK}" stroke-width="1.5"/>')


def moved(pose: Pose, x: float, z: float, angle: float = 0) -> Pose:
    """Return a pose that is relative to another one; a positive angle turns z towards x."""
    c, s = math.cos(pose[2]), math.sin(pose[2])
    return pose[0] + c * x + s * z, pose[1] - s * x + c * z, pose[2] + angle


def pose_of(origin: ET.Element) -> Pose:
    """Return the pose that an `<origin>` has in the plane of x and z."""
    x, y, z = map(float, origin.attrib["xyz"].split())
    roll, pitch, yaw = map(float, origin.attrib["rpy"].split())
    assert y == roll == yaw == 0, "not in the plane"
    return x, z, pitch


def built(text: str) -> ET.Element:
    """Return the URDF of a robot."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "robot.yaml"
        path.write_text(text, encoding="utf-8")
        return ET.fromstring(yamaro.convert(path))


# --- pivot --------------------------------------------------------------------------------------

PIVOTS = [
    ("the default: the centre", ["pivot: 0 0 0"]),
    ("the middle of the lower side", ["pivot: 0 0 -0.1"]),
    ("a corner", ["pivot: -0.15 0 -0.1"]),
    ("shapes turn about the pivot", ["pivot: 0 0 -0.1", "rpy: 0 30deg 0"]),
]
WIDTH, HEIGHT = 0.3, 0.2


def origin_of(keys: list[str]) -> ET.Element:
    """Return the `<origin>` of the box that has these keys."""
    link = ", ".join([f"geometry: box, size: {WIDTH} 0.1 {HEIGHT}, visual", *keys])
    robot = built(f"robot: r\nmodel:\n- part: {{name: a, link: {{{link}}}}}\n")
    origin = robot.find("link/visual/origin")
    assert origin is not None
    return origin


def pivot() -> str:
    """Draw one box with several pivots."""
    drawing = Drawing(480, 520, "The same box with four pivots, at the origin of its link")
    for number, (what, keys) in enumerate(PIVOTS):
        left, top = 240 * (number % 2), 250 * (number // 2)
        side = Side(drawing, (left + 100, top + 140), 330)
        origin = origin_of(keys)
        pose = pose_of(origin)
        side.box(pose, WIDTH, HEIGHT, f'fill="{FILL}" stroke="{GREY}" stroke-width="1.5"')
        side.axes((0, 0, 0), 0.17)
        side.cross(pose)
        side.dot((0, 0, 0), ORANGE)
        for line, key in enumerate(keys):
            drawing.code(left + 14, top + 24 + 17 * line, key, font_weight="600")
        drawing.text(left + 14, top + 214, what, font_size="13")
        x, y, z = (round(float(one), 3) for one in origin.attrib["xyz"].split())
        drawing.code(left + 14, top + 234, f'xyz="{x:g} {y:g} {z:g}"', fill="#5b626d")
    drawing.text(
        14, 508, "● pivot, at the origin of the link; + centre, at xyz in the URDF", font_size="13"
    )
    return drawing.svg()


# --- frames -------------------------------------------------------------------------------------

FRAMES = """\
robot: crane
model:
- part:
    name: base
    link: {geometry: box, size: 0.5 0.3 0.14, pivot: 0 0 -0.07, visual}
- part:
    name: arm
    joint: {type: continuous, parent: base, xyz: 0.1 0 0.14, rpy: 0 30deg 0, axis: y}
    link:
      geometry: box
      size: 0.07 0.07 0.44
      pivot: 0 0 -0.22
      visual:
      frame/name=tool0: {xyz: 0 0 0.44, rpy: 0 60deg 0}
"""
"""The example of docs/language.md, Poses."""


def frames() -> str:
    """Draw the frames from a parent to a tool."""
    robot = built(FRAMES)
    origins = [robot.find(path) for path in (
        "link[@name='base_link']/visual/origin", "joint[@name='arm_joint']/origin",
        "link[@name='arm_link']/visual/origin", "joint[@name='tool0_joint']/origin",
    )]  # fmt: skip
    base, joint, shape, tool = (pose_of(origin) for origin in origins if origin is not None)
    drawing = Drawing(480, 340, "The frames of a base, an arm on it and a tool")
    side = Side(drawing, (190, 266), 400)
    body = f'fill="{FILL}" stroke="{GREY}" stroke-width="1.5"'
    side.box(base, 0.5, 0.14, body)
    T_arm = joint
    T_shape = moved(T_arm, *shape)
    T_tool = moved(T_arm, *tool)
    side.box(T_shape, 0.07, 0.44, body)
    for pose in ((0.0, 0.0, 0.0), T_arm, T_tool):
        side.axes(pose, 0.12)
    side.cross(T_shape)
    side.dot((0, 0, 0), DARK)
    side.dot(T_arm, ORANGE)
    side.dot(T_tool, DARK)
    link(drawing, side, (0, 0, 0), T_arm)
    notes(drawing, side, (0, 0, 0), T_arm, T_shape, T_tool)
    return drawing.svg()


def link(drawing: Drawing, side: Side, start: Pose, end: Pose) -> None:
    """Draw a dashed line between two frames."""
    (x, y), (u, v) = side.at(*start[:2]), side.at(*end[:2])
    drawing.add(
        f'<path d="M{x:.1f} {y:.1f}L{u:.1f} {v:.1f}" stroke="{ORANGE}" stroke-width="2" '
        'stroke-dasharray="5 4"/>'
    )


def notes(drawing: Drawing, side: Side, base: Pose, arm: Pose, shape: Pose, tool: Pose) -> None:
    """Name the frames."""
    x, y = side.at(*base[:2])
    drawing.text(x - 96, y + 26, "frame of the parent, base_link")
    x, y = side.at(*arm[:2])
    drawing.text(14, y - 92, "joint: from the parent", fill=ORANGE, font_weight="600")
    drawing.code(14, y - 72, "xyz: 0.1 0 0.14", fill=ORANGE)
    drawing.code(14, y - 54, "rpy: 0 30deg 0", fill=ORANGE)
    drawing.text(x + 66, y - 24, "frame of the joint")
    drawing.text(x + 66, y - 6, "= frame of arm_link")
    x, y = side.at(*shape[:2])
    drawing.text(x + 44, y + 0, "+ centre of the shape")
    drawing.code(x + 44, y + 18, "pivot: 0 0 -0.22")
    x, y = side.at(*tool[:2])
    drawing.code(14, y - 18, "frame/name=tool0:")
    drawing.code(14, y + 0, "  {xyz: 0 0 0.44, rpy: …}")
    drawing.text(14, y + 18, "from arm_link")
    drawing.text(14, 328, "red: x; blue: z; y points away from you", font_size="13")


# --- scopes -------------------------------------------------------------------------------------

INCLUDES = {"cell.yaml": ["robot.yaml"], "robot.yaml": ["leg.yaml", "arm.yaml"],
            "leg.yaml": ["foot.yaml"], "arm.yaml": [], "foot.yaml": []}  # fmt: skip
"""Each file, and those that it includes, in this order."""
DECLARED_IN = "leg.yaml"
VISIBLE = {
    "local": {"leg.yaml"},
    "child": {"leg.yaml", "foot.yaml"},
    "parent": {"leg.yaml", "robot.yaml"},
    "global": {"leg.yaml", "foot.yaml", "robot.yaml", "arm.yaml", "cell.yaml"},
    "bridge": {"leg.yaml", "foot.yaml", "robot.yaml", "arm.yaml", "cell.yaml"},
}
"""Where a variable that leg.yaml declares is seen, by its scope."""
NOTES = {
    "local": "the default",
    "child": "what it starts",
    "parent": "one level up, when it is done",
    "global": "from then on; a local hides it",
    "bridge": "replaces a local of its callers",
}
EXPLANATION = (
    "cell.yaml includes robot.yaml,",
    "which includes leg.yaml and then",
    "arm.yaml; leg.yaml declares side",
    "and then includes foot.yaml.",
)
PLACES = {"cell.yaml": (60, 44), "robot.yaml": (60, 84), "leg.yaml": (8, 124),
          "arm.yaml": (120, 124), "foot.yaml": (8, 164)}  # fmt: skip


def scopes() -> str:
    """Draw where a variable of each scope is seen."""
    drawing = Drawing(480, 680, "Which files see a variable that leg.yaml declares, for each scope")
    for number, (scope, seen) in enumerate(VISIBLE.items()):
        panel(drawing, (8 + 236 * (number % 2), 8 + 222 * (number // 2)), scope, seen)
    left, top = 262, 490
    for line, text in enumerate(EXPLANATION):
        drawing.text(left, top + 19 * line, text, font_size="13")
    for line, (fill, text) in enumerate(
        ((SEEN, "side is seen here"), (UNSEEN, "side is not defined"))
    ):
        y = top + 92 + 28 * line
        drawing.add(f'<rect x="{left}" y="{y}" width="28" height="18" rx="4" fill="{fill}" '
                    f'stroke="{GREY}"/>')  # fmt: skip
        drawing.text(left + 38, y + 14, text, font_size="13")
    return drawing.svg()


def panel(drawing: Drawing, corner: tuple[int, int], scope: str, seen: set[str]) -> None:
    """Draw the files of one scope."""
    left, top = corner
    drawing.code(left + 8, top + 18, f"side/{scope}:", font_weight="600")
    drawing.text(left + 8, top + 35, NOTES[scope], font_size="12.5")
    for file, starts in INCLUDES.items():
        x, y = left + PLACES[file][0], top + PLACES[file][1]
        for other in starts:
            u, v = left + PLACES[other][0], top + PLACES[other][1]
            drawing.add(f'<path d="M{x + 50} {y + 26}L{u + 50} {v}" stroke="{GREY}" '
                        'stroke-width="1.5"/>')  # fmt: skip
    for file in INCLUDES:
        x, y = left + PLACES[file][0], top + PLACES[file][1]
        width = 2.5 if file == DECLARED_IN else 1
        colour = ORANGE if file == DECLARED_IN else GREY
        drawing.add(
            f'<rect x="{x}" y="{y}" width="100" height="26" rx="5" '
            f'fill="{SEEN if file in seen else UNSEEN}" stroke="{colour}" stroke-width="{width}"/>'
        )
        drawing.text(x + 50, y + 18, file, text_anchor="middle", font_size="13")


def diagrams() -> Iterator[tuple[str, str]]:
    """Yield each diagram after its name."""
    yield "pivot.svg", pivot()
    yield "frames.svg", frames()
    yield "scopes.svg", scopes()


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python web/site/diagrams.py FOLDER")
    for name, text in diagrams():
        (Path(sys.argv[1]) / name).write_text(text, encoding="utf-8")
