"""Writes a corpus of public robots as MJCF, and judges what comes out.

    python bench/mjcf.py [CORPUS] [--only REGEX] [--every N] [--others] [--stands]
                          [--repair-inertia] [--times]

CORPUS is as in bench/robots.py. Each robot that pinocchio reads is written as URDF and as MJCF,
without meshes where their files are not there. What MuJoCo makes of the MJCF is compared with what
pinocchio makes of the URDF, at random positions: poses of links and frames, mass matrix, inverse
dynamics, mass, limits, damping, efforts.
With `--others` pinocchio and Drake, if it is there, read the MJCF too. A robot agrees if all
differences are below 1e-9 of the greatest value; what was reported as a loss is left out. The table
counts robots: those that agree, those that are not written with the codes of the reasons, and those
that differ although nothing says so. `--repair-inertia` writes with that option, and counts the
robots whose inertia it changed. `--stands` gives
every independent joint a position actuator instead, and measures how each robot holds its home
position for five seconds. `--times` compares how long each robot takes as MJCF and as URDF,
both without meshes: the least processor time of several runs, which take turns.
"""

from __future__ import annotations

import argparse
import collections
import csv
import math
import os
import pickle
import re
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

import mujoco  # noqa: E402 - after the path

import yamaro  # noqa: E402
from tests.targets.mechanics import (  # noqa: E402
    DrakeMjcf,
    Mujoco,
    NotJudged,
    PinocchioMjcf,
    PinocchioUrdf,
    differences,
    joint_differences,
    mimic_differences,
    missing_frames,
)
from tests.targets.standing import Standing, with_position_actuators  # noqa: E402

UNKNOWN = "/opt/ros/unknown/share"
POSITIONS = 20
TOLERANCE = 1e-9
RUNS = 5
Judges = Sequence[tuple[str, Any]]
OF_INERTIA = frozenset(("mass matrix", "efforts"))
"""What differs if an inertia is replaced by one that a body can have."""
BALANCED = "moments of inertia that no body has"
"""How losses begin that report it."""
SHOWN = "0259"
"""How the kinds begin of which each robot is shown."""


def robots(corpus: Path) -> Iterator[tuple[str, Path]]:
    """Yield the finished URDF of each robot of the corpus, with its name."""
    for table, folder, column in (("urdf", "src", "path"), ("xacro", "", "expected")):
        with (corpus / f"{table}.tsv").open(encoding="utf-8", newline="") as file:
            for row in csv.DictReader(file, delimiter="\t"):
                yield row[column], corpus / folder / row[column]


def text_of(path: Path, corpus: Path) -> str:
    text = path.read_text("utf-8", "replace")
    return text.replace("@CORPUS@", str(corpus)).replace("@UNKNOWN@", UNKNOWN)


class Tally:
    def __init__(self) -> None:
        self.counts: collections.Counter[str] = collections.Counter()

    def add(self, kind: str, name: str, detail: str = "") -> None:
        self.counts[kind] += 1
        if kind[0] in SHOWN:
            print(f"{kind}: {name}  {detail}", flush=True)

    def show(self) -> None:
        for kind, count in sorted(self.counts.items()):
            print(f"{count:5}  {kind}")


def written(path: Path, text: str, **options: Any) -> Any:
    """Return the MJCF of a robot: without meshes where one is not there."""
    try:
        return yamaro.build(path, text=text, target="mjcf", on_message=print, **options)
    except yamaro.YamaroError as error:
        if "missing-mesh" not in {each.code for each in error.diagnostics}:
            raise
    return yamaro.build(path, text=text, target="mjcf", meshes="none", on_message=print, **options)


def judge(
    name: str, path: Path, corpus: Path, tally: Tally, judges: Judges, *, repairs: bool
) -> None:
    text = text_of(path, corpus)
    if "$(" in text or "${" in text:  # of xacro, which is expanded
        text = yamaro.build(path, text=text, on_message=print).xml()
    try:
        build = written(path, text, repair_inertia=repairs)
    except yamaro.YamaroError as error:
        codes = {each.code for each in error.diagnostics if each.severity == "error"}
        tally.add(f"2 not written: {', '.join(sorted(codes))}", name)
        return
    except Exception as error:
        tally.add("9 BROKEN", name, repr(error)[:300])
        return
    tally.add("1 written", name)
    mjcf = build.xml()
    is_fixed = not any(
        joint.endswith("_free") for joint in re.findall(r'<freejoint name="([^"]*)"', mjcf)
    )
    reference, joints = None, {}
    try:
        reference = PinocchioUrdf(text, is_fixed=is_fixed)
        joints = reference.joints
    except NotJudged as error:
        tally.add("0 not judged", name, str(error))
    except Exception as error:
        tally.add(
            "0 not read by pinocchio",
            name,
            (str(error).strip() or repr(error)).splitlines()[0][:120],
        )
    try:
        model = Mujoco(mjcf, build.assets, joints)
    except Exception as error:
        tally.add("9 MUJOCO REFUSES", name, str(error).replace("\n", " ")[:300])
        return
    tally.add("3 compiled by MuJoCo", name)
    if reference is None:
        return
    compare(name, build, reference, model, tally, judges)


def apart(make: Any, mjcf: str, files: dict[str, bytes], reference: Any) -> dict[str, float]:
    """Return the differences, worked out in another process: Drake ends its own on some faults."""
    reader, writer = os.pipe()
    sys.stdout.flush()
    child = os.fork()
    if not child:
        try:
            found: Any = differences(reference, make(mjcf, files, reference.joints), POSITIONS)
        except Exception as error:
            found = error
        try:
            answer = pickle.dumps(found)
        except Exception:
            answer = pickle.dumps(RuntimeError(str(found)))
        os.write(writer, answer)
        os._exit(0)
    os.close(writer)
    with open(reader, "rb") as file:
        data = file.read()
    os.waitpid(child, 0)
    if not data:
        raise RuntimeError("it ended the process")
    answer = pickle.loads(data)
    if isinstance(answer, Exception):
        raise answer
    return answer


def compare(
    name: str, build: Any, reference: Any, model: Any, tally: Tally, judges: Judges
) -> None:
    told = {loss.owner for loss in build.losses}
    lost = (
        missing_frames(reference, model)
        - {loss.owner.split("'")[1] for loss in build.losses if "'" in loss.owner}
        - {"world"}
    )
    wrong = {
        f"{joint}: {', '.join(what)}"
        for joint, what in joint_differences(reference.description, model.model).items()
        if f"joint '{joint}'" not in told
    }
    wrong |= {
        f"{joint}: mimic"
        for joint in mimic_differences(reference.description, model.model)
        if f"joint '{joint}'" not in told
    }
    wrong |= {f"{each}: no body or site" for each in lost}
    is_balanced = any(loss.what.startswith(BALANCED) for loss in build.losses)
    for title, make in judges:
        try:
            found = (
                differences(reference, model, POSITIONS)
                if make is None
                else apart(make, build.xml(), build.assets, reference)
            )
        except ImportError:
            continue
        except NotJudged as error:
            tally.add(f"5 not judged by {title}", name, str(error))
            continue
        except Exception as error:
            tally.add(f"5 {title} does not read it", name, str(error).replace("\n", " ")[:200])
            continue
        bad = {what: size for what, size in found.items() if not size <= TOLERANCE}
        faults = sorted(wrong)[:6] if title == "MuJoCo" else []
        detail = "; ".join([*(f"{what}={size:.1e}" for what, size in bad.items()), *faults])
        if is_balanced and not faults and bad and bad.keys() <= OF_INERTIA:
            tally.add(f"6 {title} differs by the inertia that is reported", name)
        elif detail:
            tally.add(f"9 {title} DIFFERS", name, detail)
        else:
            tally.add(f"4 {title} agrees", name)


def stand(name: str, path: Path, corpus: Path, tally: Tally) -> None:
    """Tell how a robot with position actuators holds its home position.

    The base is fixed of a robot that has nothing to stand on, or whose meshes are not there.
    """
    text = with_position_actuators(text_of(path, corpus))
    kind = "stands"
    try:
        build = written(path, text, repair_inertia=True)
        if "<freejoint" in build.xml() and not stands_on_something(build, text):
            kind = "holds with its base fixed, without meshes"
            build = written(path, text, repair_inertia=True, base="fixed")
    except yamaro.YamaroError:
        tally.add("0 not written", name)
        return
    if "<key " not in build.xml():
        tally.add("1 has no joint that moves", name)
        return
    file = re.search('include file="(.*?)"', build.assets["scene.xml"].decode())
    assert file is not None
    with tempfile.TemporaryDirectory() as folder:
        for each, content in {**build.assets, file[1]: build.xml().encode()}.items():
            (Path(folder) / each).parent.mkdir(exist_ok=True)
            (Path(folder) / each).write_bytes(content)
        found = Standing(mujoco.MjModel.from_xml_path(f"{folder}/scene.xml"))
    detail = f"{found.worst:.2%} {found.joint}, sinks {found.sank:.3f} m"
    if found.weak:
        detail += f", at their greatest effort: {', '.join(found.weak[:4])}"
    if found.warnings or not found.is_finite:
        tally.add("9 UNSTABLE", name, detail)
    elif found.worst > 0.05 and found.weak:
        tally.add("5 is too weak: a joint reaches its effort limit", name, detail)
    elif found.worst > 0.05:
        tally.add("5 moves by more than 5 %", name, detail)
    else:
        tally.add(f"2 {kind}", name, detail)


def stands_on_something(build: Any, text: str) -> bool:
    """Return whether a robot touches the floor with anything, and has all its meshes."""
    has_contacts = re.search(r'<geom name="[^"]*" class="[^"]*_collision"', build.xml())
    return bool(has_contacts) and ("<mesh " in build.xml() or "<mesh " not in text)


def ratio_of_times(path: Path, text: str) -> float:
    """Return how many times as long a robot takes as MJCF as as URDF."""
    least = {"urdf": math.inf, "mjcf": math.inf}
    for _ in range(RUNS):
        for format in least:
            target = format if format != "urdf" else None
            start = time.process_time()
            yamaro.build(
                path, text=text, target=target, meshes="none", repair_inertia=True, on_message=print
            ).xml()
            least[format] = min(least[format], time.process_time() - start)
    return least["mjcf"] / least["urdf"]


def compare_times(wanted: list[tuple[str, Path]], corpus: Path) -> None:
    ratios = []
    for _, path in wanted:
        try:
            ratios.append(ratio_of_times(path, text_of(path, corpus)))
        except yamaro.YamaroError:
            continue
    tenths = statistics.quantiles(ratios, n=10)
    print(
        f"{len(ratios)} robots: MJCF takes {statistics.median(ratios):.2f} times as long as URDF; "
        f"a tenth less than {tenths[0]:.2f}, a tenth more than {tenths[-1]:.2f}"
    )


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("corpus", nargs="?", type=Path, default=ROOT.parent / "shared" / "corpus")
    parser.add_argument("--only", default="")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--others", action="store_true")
    parser.add_argument("--stands", action="store_true")
    parser.add_argument("--repair-inertia", action="store_true")
    parser.add_argument("--times", action="store_true")
    given = parser.parse_args()
    corpus = given.corpus.resolve()
    judges: list[tuple[str, Any]] = [("MuJoCo", None)]
    if given.others:
        judges.append(("pinocchio", PinocchioMjcf))
        try:
            import pydrake.multibody.parsing
            import pydrake.multibody.plant  # noqa: F401 - once, for the processes that are forked

            judges.append(("Drake", DrakeMjcf))
        except ImportError:
            print("Drake is not installed")
    tally = Tally()
    wanted = [each for each in robots(corpus) if re.search(given.only, each[0])]
    if given.times:
        compare_times(wanted[:: given.every], corpus)
        return
    for name, path in wanted[:: given.every]:
        try:
            if given.stands:
                stand(name, path, corpus, tally)
            else:
                judge(name, path, corpus, tally, judges, repairs=given.repair_inertia)
        except Exception as error:
            tally.add("9 BROKEN", name, repr(error)[:300])
    print()
    tally.show()


if __name__ == "__main__":
    main()
