"""Builds of main files in a jail, in a thread of their own, with the texts that are in the editor.

A build is given up as soon as a newer edit makes its result worthless. Its values are looked up by
the places that they come from, of which those in an earlier text are found in that of now.
"""

from __future__ import annotations

import os
import queue
import re
import threading
from functools import partial
from itertools import islice

from ...diagnostics import YamaroError
from ...files.loader import FileLoader, LoadError, MemoryLoader, OverlayLoader
from ...options import UsageError
from ...source import Reading, RecordedSpan, Source, Span, is_xml_file
from ...xml.tree import Element
from ...xml.tree import Text as XmlText
from ...xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from ...diagnostics import Diagnostic
    from ...model.robot import Robot
    from ...source import Reading
    from ...xml.tree import Element
    from .workspace import Settings, Text


class Result:
    """The result of a build, good or bad.

    Attributes:
        main: the file that was built.
        files: the files that were read, as far as that is known.
        diagnostics: what is to be said of them.
        root: the finished tree, or None if there is none.
        fault: what went wrong in Yamaro itself, or None.
        supplied: arguments that a xacro file has to be given and that the user has not set, each
            `name:=value`: what the file says of it further down, else nothing.
        texts: those that were open then, by path.
    """

    def __init__(self, main: str) -> None:
        """Begin with nothing."""
        self.main = main
        self.files: Sequence[str] = [main]
        self.diagnostics: Sequence[Diagnostic] = []
        self.root: Element | None = None
        self.fault: str | None = None
        self.supplied: list[str] = []
        self.texts: Mapping[str, str] = {}
        self._moves: dict[str, Move] = {}
        self._read_robot: Callable[[], Robot] | None = None
        self._robot: Robot | None = None
        self._values: Values | None = None
        self._noted: Sequence[Reading] = ()

    @property
    def robot(self) -> Robot | None:
        """Return the robot, or None if there is none."""
        if self._robot is None and self._read_robot is not None:
            try:
                self._robot = self._read_robot()
            except YamaroError:
                self._read_robot = None
        return self._robot

    def offset_then(self, text: Text, offset: int) -> int:
        """Return where in the text that was built an offset of now was; -1 if it is new."""
        then = self.texts.get(text.path)
        if then is None or then == text.text:
            return offset
        move = self._moves.get(text.path)
        if move is None or move.new != text.text:
            move = self._moves[text.path] = Move(then, text.text)
        return move.back(offset)

    @property
    def values(self) -> Values:
        """Return what is written where in the tree, and what was read there."""
        if self._values is None:
            self._values = Values(self.root, self._noted)
        return self._values


class Job:
    """A build that was asked for."""

    def __init__(self, main: str, texts: Mapping[str, str]) -> None:
        """Build a main file, with the texts of all files that are open."""
        self.main = main
        self.texts = texts
        self.is_abandoned = False

    def run(self, settings: Settings) -> Result | None:
        """Return the result; None if the build was given up."""
        from ...confined import FaultInJail
        from ...sandbox.jail import JailAbandoned

        if self.is_abandoned:
            return None
        result = Result(self.main)
        result.texts = self.texts
        try:
            self._build_with_all(settings, result)
        except YamaroError as error:
            result.diagnostics = [*result.diagnostics, *error.diagnostics]
            paths: dict[str, None] = {}
            for diagnostic in error.diagnostics:
                paths[diagnostic.span.source.path] = None
                frame, count = diagnostic.trace, 0
                while frame is not None and count < 100:
                    paths[frame.span.source.path] = None
                    frame, count = frame.parent, count + 1
            result.files = [self.main, *[path for path in paths if path]]
        except UsageError:  # the file is gone, or an argument that the user has set is not one
            pass
        except JailAbandoned:
            return None
        except FaultInJail as error:
            result.fault = f"{error.kind}: {error} at {error.place}"
        return None if self.is_abandoned else result

    def _build_with_all(self, settings: Settings, result: Result) -> None:
        """Build, and again with each argument that is missing; that it is missing stays an error.

        Otherwise nothing would be known of a robot that is only built from a launch file.
        """
        lacking: list[Diagnostic] = []
        while True:
            try:
                self._build(settings, result)
            except YamaroError as error:
                first = error.diagnostics[0]
                missing = _MISSING_ARGUMENT.match(first.message)
                if missing is None or len(lacking) == MOST_SUPPLIED or self.is_abandoned:
                    raise
                result.supplied.append(f"{missing[1]}:={self._default_of(missing[1])}")
                first.hint = "declare it above, or give it in the setting 'arguments' of the editor"
                lacking.append(first)
                result.diagnostics = lacking
            else:
                result.diagnostics = [*lacking, *result.diagnostics]
                return

    def _default_of(self, name: str) -> str:
        """Return the default that the main file gives an argument somewhere, "" if it has none."""
        from ...xacro.symbol_table import ARGUMENT, definitions_in
        from ...xml.reader import read_xml

        try:
            loader = OverlayLoader(self.texts, FileLoader())
            text = loader.read(self.main).decode("utf-8", "replace")
            root = read_xml(Source(text, name=self.main, path=self.main)).root
        except (LoadError, YamaroError):
            return ""
        for each in definitions_in(root):
            if each.kind == ARGUMENT and each.name == name and "$" not in each.text:
                return each.text
        return ""

    def _build(self, settings: Settings, result: Result) -> None:
        from ...program import Program
        from ...request import reach_of

        policy = settings.policy(lambda: self.is_abandoned)
        reach = reach_of(self.main, policy, settings.all_packages)
        program = Program(
            self.main,
            loader=OverlayLoader(self.texts, FileLoader(policy.limits, reach)),
            policy=policy,
            packages=settings.all_packages,
        )
        build = program.build(
            command_line=[*settings.arguments_of(self.main), *result.supplied],
            advice=True,
            records=True,
            on_message=_drop,
        )
        result.diagnostics = build.warnings
        result.files = build.files
        result.root = build.root
        result._noted = build.noted
        result._read_robot = lambda: build.robot


MOST_SUPPLIED = 10
"""Missing arguments that are supplied to a build."""
_MISSING_ARGUMENT = re.compile(r"the argument '([^\s']+)' is not declared before this place$")


def _drop(message: str) -> None:
    """Take what a file prints: nobody asked for it."""


class Builder:
    """A thread that works off jobs, one after the other."""

    def __init__(self, settings: Settings, done: Callable[[object], None]) -> None:
        """Start it; `done` is called in it with each result, and with what a task returns."""
        self._settings = settings
        self._done = done
        self._jobs: queue.SimpleQueue[Job | Callable[[], object]] = queue.SimpleQueue()
        self._current: dict[str, Job] = {}
        threading.Thread(target=self._run, name="builds", daemon=True).start()

    def build(self, main: str, texts: Mapping[str, str]) -> None:
        """Build a main file, and give up a build of the same file that was asked for before."""
        self.abandon(main)
        job = self._current[main] = Job(main, texts)
        self._jobs.put(job)

    def abandon(self, main: str) -> None:
        """Give up the build of a main file, if there is one."""
        job = self._current.pop(main, None)
        if job is not None:
            job.is_abandoned = True

    def knows(self, main: str) -> bool:
        """Return whether a build of a main file was asked for, and not given up since."""
        return main in self._current

    def work(self, task: Callable[[], object]) -> None:
        """Do something else after the jobs that wait."""
        self._jobs.put(task)

    def _run(self) -> None:
        warm: set[bool] = set()  # whether for XML, and for YAML
        while True:
            job = self._jobs.get()
            try:
                result = job.run(self._settings) if isinstance(job, Job) else job()
            except Exception as error:  # must not end the thread
                result = Result(job.main if isinstance(job, Job) else "")
                result.fault = f"{type(error).__name__}: {error}"
            if result is not None:
                self._done(result)
            if isinstance(job, Job) and (is_xml := is_xml_file(job.main)) not in warm:
                warm.add(is_xml)  # the first result does not wait for it
                self._jobs.put(partial(warm_up, is_xml=is_xml))


def warm_up(*, is_xml: bool = False) -> None:
    """Import what builds need: a jail is a copy of this process, and has it then from the start.

    Otherwise each build would import it again, which takes ten times as long as a build.
    """
    from importlib import import_module

    from ...program import Program

    text, name = (_USUAL_XACRO, "usual.xacro") if is_xml else (_USUAL, "usual.yaml")
    path = os.path.join(os.path.dirname(__file__), name)  # there is no such file
    program = Program(path, text=text, loader=MemoryLoader({}))
    program.build(advice=True, records=True, on_message=_drop)
    for name in _OF_JAILS:
        import_module(name, __package__)


_USUAL = """
robot: usual
arguments:
  length: {default: 1, help: of a link}
variables:
  half: $(length / 2)
functions:
  Arm(side):
  - part:
      name: $(side)_arm
      joint: {type: revolute, parent: base, xyz: 0 0 $(half), limit: {lower: -1, upper: 1}}
      link: {geometry: box, size: 1 1 1, mass: 1, material: red, color: 1 0 0 1}
model:
- part:
    name: base
    link: {geometry: cylinder, size: 1 1}
- for side in ['left', 'right']:
  - if side == 'left':
    - Arm: $(side)
"""
"""A robot with what most robots have, which `warm_up` builds."""
_USUAL_XACRO = """<robot name="usual" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="length" default="1"/>
  <xacro:property name="half" value="${float(xacro.arg('length')) / 2}"/>
  <xacro:macro name="arm" params="side *origin">
    <link name="${side}_arm">
      <visual><geometry><box size="1 1 ${half}"/></geometry><material name="red"/></visual>
      <inertial><mass value="1"/>
        <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    </link>
    <joint name="${side}_joint" type="revolute">
      <parent link="base"/><child link="${side}_arm"/><xacro:insert_block name="origin"/>
      <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
    </joint>
  </xacro:macro>
  <material name="red"><color rgba="1 0 0 1"/></material>
  <link name="base"/>
  <xacro:if value="$(eval length == 1)"><xacro:arm side="left"><origin/></xacro:arm></xacro:if>
  <gazebo reference="base"/><transmission name="t"/><ros2_control name="c" type="system"/>
</robot>
"""
"""The same in xacro."""
_OF_JAILS = (
    "...confined",
    "...safe.runtime",
    "...sandbox.transfer",
    "...sandbox.jail.parent",
    "...runtime.python_errors",
    "...runtime.includes",
    "...runtime.python_errors",
)


# --- places in an earlier text ----------------------------------------------------------------


class Move:
    """From one text to another; nothing is known of the stretch in which they differ.

    Attributes:
        old: the earlier text.
        new: the later one.
    """

    __slots__ = ("_end", "_same", "new", "old")

    def __init__(self, old: str, new: str) -> None:
        """Compare two texts: how much is the same at the begin, and at the end."""
        self.old = old
        self.new = new
        self._same = _common(old, new)
        self._end = _common(old[self._same :][::-1], new[self._same :][::-1])

    def shift(self, start: int, end: int) -> int | None:
        """Return by how much a stretch of the old text has moved; None if it has changed."""
        if end <= self._same:
            return 0
        if start >= len(self.old) - self._end:
            return len(self.new) - len(self.old)
        return None

    def back(self, offset: int) -> int:
        """Return where an offset of the new text was in the old one; -1 if it is new."""
        if offset <= self._same:
            return offset
        if offset >= len(self.new) - self._end:
            return offset - (len(self.new) - len(self.old))
        return -1


def _common(one: str, other: str) -> int:
    """Return how many characters two texts begin with in common."""
    most = min(len(one), len(other))
    if one[:most] == other[:most]:
        return most
    least = 0
    while most - least > 1:
        middle = (least + most) // 2
        if one[:middle] == other[:middle]:
            least = middle
        else:
            most = middle
    return least


# --- values -----------------------------------------------------------------------------------


Key = tuple[str, int]
"""A file and the offset at which something is written."""
MOST_ELEMENTS = 200_000


class Values:
    """The values in a finished tree by the places they come from.

    Attributes:
        written: what each value, as a whole, came out as, in order.
        set: the values of names, by where they are declared, and the name.
        read: likewise, by the place of the value that read them.
    """

    def __init__(self, root: Element | None, noted: Sequence[Reading]) -> None:
        """Look through a tree, or nothing, and the values that were noted while it was built."""
        self.written: dict[Key, dict[str, None]] = {}
        self.set: dict[tuple[str, int, str], dict[str, None]] = {}
        self.read: dict[tuple[str, int, str], dict[str, None]] = {}
        for reading in noted:
            if reading.span is not None:
                at = (reading.span.source.path, reading.span.start, reading.name)
                self.set.setdefault(at, {}).setdefault(reading.value)
        for element in islice(root.iter(), MOST_ELEMENTS) if root is not None else ():
            for name, value in element.attributes.items():
                if value is not None:
                    self._note(element.value_span(name), value)
            for child in element.children:
                if isinstance(child, XmlText):
                    self._note(child.span, child.value)

    def _note(self, span: Span, value: object) -> None:
        key = (span.source.path, span.start)
        if not isinstance(span, RecordedSpan):
            if "$" in span.source.text[span.start : span.end]:  # in xacro
                self.written.setdefault(key, {}).setdefault(format_value(value))
            return
        self.written.setdefault(key, {}).setdefault(format_value(value))
        for other in (span, span.name_span, *span.others):
            if not isinstance(other, RecordedSpan):
                continue
            for reading in other.readings:
                where = (other.source.path, other.start, reading.name)
                self.read.setdefault(where, {}).setdefault(reading.value)
