"""The robot that an SRDF is checked against: one that is given as well, or one beside it."""

from __future__ import annotations

import os

from ..check.semantics import findings_against
from ..diagnostics import Reporter, YamaroError
from ..files.loader import FileLoader, LoadError, decode
from ..model.reading import read_robot
from ..model.schema import is_semantic
from ..model.values import attribute_text
from ..request import reach_of
from ..xml.reader import read_xml
from .settings import make_policy, read_adjustment, read_packages

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ..diagnostics import Diagnostic
    from ..model.robot import Robot
    from ..result import Build
    from ..streams import Streams
    from .arguments import Arguments

MOST_NEIGHBOURS = 100
"""Files in the folder of an SRDF that are looked at."""


class Semantics:
    """Checks SRDF against robots.

    A robot beside an SRDF is read if it is plain URDF. Xacro and YAML are programs, which are run
    only if they are named.
    """

    def __init__(
        self, arguments: Arguments, streams: Streams, texts: Mapping[str, str] | None
    ) -> None:
        """Begin without robots; `texts` are read in place of some files."""
        self._arguments = arguments
        self._streams = streams
        self._texts = texts or {}
        self._robots: list[Robot] = []

    def keep(self, build: Build) -> Sequence[Diagnostic]:
        """Keep a robot that was given; find nothing."""
        if build.root_name == "robot" and build.robot.links:
            self._robots.append(build.robot)
        return ()

    def findings(self, build: Build) -> Sequence[Diagnostic]:
        """Return what is wrong with an SRDF as one of its robot."""
        if build.root_name != "robot" or not is_semantic(root := build.robot_tree()):
            return ()
        source = root.span.source
        name = attribute_text(root, "name") or ""
        given = [robot for robot in self._robots if robot.name == name] or self._robots[:1]
        robot = given[0] if given else self._beside(source.path, name)
        if robot is None:
            if not self._streams.quiet and not self._arguments.has("format"):
                self._streams.say(
                    f"{source.name}: checked without its robot; name that as well, as in "
                    f"`yamaro check robot.urdf {os.path.basename(source.name)}`"
                )
            return ()
        reporter = Reporter()
        findings_against(root, robot, reporter)
        read_adjustment(self._arguments).deny(reporter.diagnostics)
        return reporter.diagnostics

    def _beside(self, path: str, name: str) -> Robot | None:
        """Return the URDF in a folder that is called as the SRDF is, or has its robot's name."""
        if not path:
            return None
        folder, own = os.path.split(path)
        stem = own[: own.lower().index(".srdf")] if ".srdf" in own.lower() else own
        policy = make_policy(self._arguments)
        reach = reach_of(path, policy, read_packages(self._arguments))
        loader = FileLoader(policy.limits, reach)
        try:
            files = [each for each in os.listdir(folder) if each.lower().endswith(".urdf")]
        except OSError:
            return None
        files.sort(key=lambda each: (each[: -len(".urdf")] != stem, each))
        for each in files[:MOST_NEIGHBOURS]:
            whole = os.path.join(folder, each)
            try:
                text = self._texts.get(whole)
                data = loader.read(whole) if text is None else text.encode()
                source = decode(data, name=whole, path=whole)
                root = read_xml(source, policy.limits).root
            except (LoadError, YamaroError):
                continue
            is_called = each[: -len(".urdf")] == stem or attribute_text(root, "name") == name
            if root.name == "robot" and is_called and not is_semantic(root):
                return read_robot(root)
        return None
