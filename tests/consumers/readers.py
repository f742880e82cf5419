"""Whether programs that read URDF refuse a robot, report something, or read it without a word.

`python -m tests.consumers.readers` writes what they do with every faulty robot of
tests/check/bad_robots to `readers.txt`, from which docs/checks.md has its columns. With names of
robots, it prints what they do with these.
"""

from __future__ import annotations

import json
import logging
import os
import re
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterable
from pathlib import Path

from tests.check.test_check import BadRobot, bad_robots
from tests.consumers import oracles
from tests.consumers.sdf_judges import complaint_of_libsdformat

RECORDED = Path(__file__).with_name("readers.txt")
REFUSES, REPORTS, READS, CRASHES = VERDICTS = "refuses", "reports", "reads", "crashes"
GROUPS = ("tree", "joints", "links")
LINK = re.compile(r'<link name="([^"]*)"(/>|>(?:(?!<inertial|</link>).)*</link>)', re.DOTALL)
INERTIAL = """<inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>"""
SHAPES = """<visual><geometry><box size="1 1 1"/></geometry></visual>
<collision><geometry><box size="1 1 1"/></geometry></collision>"""


def solid(text: str) -> str:
    """Return a robot whose links have a mass, and the empty ones a shape.

    Some programs have no links without, and would refuse the robot for that.
    """

    def of(found: re.Match[str]) -> str:
        name, rest = found[1], found[2]
        inside = SHAPES + "</link>" if rest == "/>" else rest[1:]
        return f'<link name="{name}">{INERTIAL}{inside}'

    return LINK.sub(of, text)


def urdfdom(text: str) -> str:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "robot.urdf")
        path.write_text(text, encoding="utf-8")
        done = oracles.run_check_urdf(path)
    if done.returncode:
        return REFUSES
    said = (done.stdout + done.stderr).lower()
    return REPORTS if "error" in said or "warning" in said else READS


def yourdfpy(text: str) -> str:
    oracles.require_module("yourdfpy")
    with tempfile.TemporaryDirectory() as folder:
        return _in_process(lambda: oracles.load_yourdfpy(text, Path(folder)))


def pinocchio(text: str) -> str:
    oracles.require_module("pinocchio")
    return _in_process(lambda: oracles.load_pinocchio(text))


def mujoco(text: str) -> str:
    oracles.require_module("mujoco")
    return _in_process(lambda: oracles.load_mujoco(text))


def drake(text: str) -> str:
    parsing = oracles.require_module("pydrake.multibody.parsing")
    plants = oracles.require_module("pydrake.multibody.plant")

    def read() -> None:
        plant = plants.MultibodyPlant(0.001)
        parsing.Parser(plant).AddModelsFromString(text, "urdf")
        plant.Finalize()

    return _in_process(read)


def libsdformat(text: str) -> str:
    oracles.require_program("ign")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "robot.urdf")
        path.write_text(text, encoding="utf-8")
        complaint = complaint_of_libsdformat(path)
    if not complaint:
        return READS
    return REPORTS if "Valid." in complaint else REFUSES


READERS: dict[str, Callable[[str], str]] = {
    each.__name__: each for each in (urdfdom, yourdfpy, pinocchio, mujoco, drake, libsdformat)
}


QUICK = [name for name in READERS if name != "libsdformat"]
"""Programs that take milliseconds."""
SOUND = '<robot name="r"><link name="a"/></robot>'


class _Heard(logging.Handler):
    """Keeps what is logged as a warning or worse."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.lines.append(record.getMessage())


def _in_process(read: Callable[[], object]) -> str:
    """Return the verdict of a reader that is run in a process of its own, since some end theirs.

    Its modules have to be imported before, so that not each of these processes does.
    """
    child = os.fork()
    if not child:
        verdict = CRASHES
        try:
            with tempfile.TemporaryFile() as errors:
                os.dup2(errors.fileno(), 2)
                verdict = _verdict(read)
                if verdict == READS and os.fstat(errors.fileno()).st_size:
                    verdict = REPORTS
        finally:
            os._exit(VERDICTS.index(verdict))
    status = os.waitpid(child, 0)[1]
    return VERDICTS[os.WEXITSTATUS(status)] if os.WIFEXITED(status) else CRASHES


def _verdict(read: Callable[[], object]) -> str:
    heard = _Heard()
    logging.getLogger().addHandler(heard)
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        try:
            read()
        except Exception:
            return REFUSES
    return REPORTS if heard.lines or warned else READS


def robots() -> list[BadRobot]:
    """Return the robots with a fault each."""
    return [robot for group in GROUPS for robot in bad_robots(group)]


def recorded() -> dict[str, list[str]]:
    """Return the verdicts on each robot by its name, in the order of READERS."""
    lines = RECORDED.read_text(encoding="utf-8").splitlines()
    return {name: words.split() for name, _, words in (line.partition(": ") for line in lines)}


def judged(text: str, programs: Iterable[str] = READERS) -> list[str]:
    """Return what each program does with a robot, in a process that has no other threads."""
    return [READERS[name](solid(text)) for name in programs]


if __name__ == "__main__":
    names = sys.argv[1:]
    if names:  # what the quick programs do with robots of these names, or with a sound one
        texts = {SOUND: SOUND, **{robot.name: robot.text for robot in robots()}}
        print(json.dumps([judged(texts[name], QUICK) for name in names]))
    else:
        rows = [f"robot: {' '.join(READERS)}\n"]
        rows += [f"{robot.name}: {' '.join(judged(robot.text))}\n" for robot in robots()]
        RECORDED.write_text("".join(rows), encoding="utf-8")
