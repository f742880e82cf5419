"""The features of SRDF, and those that are added to robots, whose URDF has none of them.

Source: http://wiki.ros.org/srdf.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from lxml import etree

from .feature import Feature, Key
from .urdf import Node, tree

NAME = re.compile(r"[A-Za-z_][\w-]*")
"""Names that mean nothing else in the keys of YAML."""
MOST_CHAINS = 3
MEMBERS = ("link", "joint", "group")


def read(text: str, own: Mapping[str, str]) -> Iterator[Key]:
    """Yield the features of an SRDF; nothing has another name in it than in the robot."""
    root = etree.fromstring(text.encode())
    for group in root.iterfind("group"):
        name = group.get("name")
        for member in group:
            if member.tag == "chain":
                yield ("chain", name, member.get("base_link"), member.get("tip_link"))
            else:
                yield ("member", name, member.tag, member.get("name"))
    for effector in root.iterfind("end_effector"):
        yield ("end effector", effector.get("name"), effector.get("parent_link"))
    for state in root.iterfind("group_state"):
        for joint in state:
            yield ("state", state.get("name"), joint.get("name"), float(joint.get("value")))
    yield from (
        ("disabled", *sorted((pair.get("link1"), pair.get("link2"))))
        for pair in root.iterfind("disable_collisions")
    )


class Planted:
    """A robot with groups, states and pairs of links to keep, chosen by its tree alone.

    Attributes:
        text: the file of YAML that includes it.
        features: what is added, each with the places of its line.
        kept: pairs of links that have to be looked at.
    """

    def __init__(self, path: Path, text: str) -> None:
        self.text = f"robot: {json.dumps(path.stem)}\nmodel:\n- include: {json.dumps(path.name)}\n"
        self.features: list[Feature] = []
        self.kept: list[tuple[str, str]] = []
        robot = tree(text)
        self._joints = [each for each in robot.children if each.name == "joint"]
        links = [each for each in robot.children if each.name == "link"]
        names = [each.get("name") for each in links]
        ends = [(_end(each, "parent"), _end(each, "child")) for each in self._joints]
        self._above = {child: parent for parent, child in ends if {parent, child} <= set(names)}
        self._groups([name for name in names if NAME.fullmatch(name)])
        self._states()
        solid = [each.get("name") for each in links if each.first("collision") is not None]
        self.text += "collisions:\n  samples: 50\n"
        if len(solid) > 1:
            self.kept.append((solid[0], solid[-1]))
            self.text += f"  keep: [{json.dumps(self.kept[0])}]\n"

    def _line(self, line: str, *keys: Key) -> None:
        start = len(self.text)
        self.text += f"{line}\n"
        places = frozenset(range(start, len(self.text)))
        self.features += [Feature(key, places) for key in keys]

    def _groups(self, links: list[str]) -> None:
        self._line("groups:")
        ends = [name for name in links if name in self._above and name not in self._above.values()]
        for number, tip in enumerate(ends[:MOST_CHAINS]):
            base = self._root_of(tip)
            name, pair = f"chain{number}", json.dumps([base, tip])
            self._line(f"  {name}: {{chain: {pair}}}", ("chain", name, base, tip))
        some = links[::2]
        keys = [("member", "links", "link", name) for name in some]
        self._line(f"  links: {{links: {json.dumps(some)}}}", *keys)
        if ends:
            tip, parent = ends[0], self._above[ends[0]]
            self._line(
                f"  hand: {{links: [{tip}], parent: {json.dumps(parent)}, end_effector: true}}",
                ("member", "hand", "link", tip),
                ("end effector", "hand", parent),
            )
            groups = ["chain0", "hand"]
            self._line(
                f"  both: {{groups: {json.dumps(groups)}}}",
                *(("member", "both", "group", name) for name in groups),
            )

    def _root_of(self, link: str) -> str:
        seen = set()
        while link in self._above and link not in seen:
            seen.add(link)
            link = self._above[link]
        return link

    def _states(self) -> None:
        """Add states of the joints that can be moved: those of no group are lost."""
        free = [joint for joint in self._joints if _moves(joint)]
        for name, part in (("home", 0.5), ("bent", 0.75)) if free else ():
            self._line("states:" if name == "home" else "")
            self._line(f"  {name}:")
            for joint in free:
                lower, upper = _limits(joint)
                value = float(f"{lower + part * (upper - lower):.6g}")
                own = joint.get("name")
                self._line(f"    {own}: {value!r}", ("state", name, own, value))


def _end(joint: Node, name: str) -> str:
    end = joint.first(name)
    return end.get("link") if end is not None else ""


def _moves(joint: Node) -> bool:
    is_single = joint.get("type") in ("revolute", "continuous", "prismatic")
    has_name = NAME.fullmatch(joint.get("name")) is not None
    return is_single and has_name and joint.first("mimic") is None


def _limits(joint: Node) -> tuple[float, float]:
    limit = joint.first("limit")
    if limit is None or joint.get("type") == "continuous":
        return -1.0, 1.0
    lower, upper = limit.number("lower") or 0.0, limit.number("upper") or 0.0
    return max(min(lower, upper), -100.0), min(max(lower, upper), 100.0)
