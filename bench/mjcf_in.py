"""Reads MJCF, writes it as MJCF again, and has MuJoCo judge whether it is still the same.

    python bench/mjcf_in.py FOLDER ... [--only REGEX] [--every N] [--show N] [--fields] [--jobs N]
                            [--seconds N] [--keep FOLDER] [--migrate | --urdf | --losses | --times]
                            [--table FILE]

Of every MJCF in the folders that MuJoCo compiles as it is, what Yamaro writes is compiled too, and
compared by name at 20 random states: the numbers of positions, velocities and controls, bodies'
inertia in a common frame, mass matrix, bias, passive and actuator forces, what sensors measure,
poses of sites. A model is `equal` if all differences are below 1e-9 of the greatest value; `told`
if it differs and something but notes on shapes was reported; `silent` if it differs and nothing
was; `fails` if nothing was written or MuJoCo refuses it. `--fields` also counts other values of
models that differ, such as friction of geoms. `--migrate` goes through `yamaro migrate` and a
build of the YAML. `--urdf` writes URDF instead, where it is fixed or free as the model is, and
compares what pinocchio makes of it: poses of links, mass matrix, inverse dynamics; what is reported
as lost makes a model `told`. `--losses` looks for each element of the model, and each value of a
joint that URDF has not, in the URDF or among what is reported at its line. `--times` compares how
long MuJoCo compiles each model, and how long Yamaro takes to read it and to write it as URDF: the
least processor time of five runs in turns, in one process, and as commands: `yamaro FILE -o OUT`
and a Python that imports mujoco and compiles. A model of 100 bodies of plain shapes is the first.
"""

from __future__ import annotations

import argparse
import os
import re
import resource
import subprocess
import sys
import tempfile
import time
import traceback
from collections import Counter, defaultdict
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from multiprocessing import Pipe, Process
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

import mujoco  # noqa: E402 - after the path

import yamaro  # noqa: E402
from tests.targets.mechanics import Mujoco, PinocchioUrdf, differences  # noqa: E402
from tests.targets.same_mjcf import Comparison  # noqa: E402

EQUAL, TOLD, SILENT, FAILS = "equal", "told", "silent", "fails"
HARMLESS = re.compile("hulls|colours of|textures|materials of meshes|meshes without triangles")
"""Losses that no number which is compared can show."""


class Verdict:
    """What was found for a model.

    Attributes:
        path: its file.
        kind: EQUAL, TOLD, SILENT or FAILS.
        why: what differs or failed.
        told: what was reported.
        fields: further values that differ.
    """

    def __init__(self, path: str, kind: str, why: str) -> None:
        self.path = path
        self.kind = kind
        self.why = why
        self.told: list[str] = []
        self.fields: dict[str, str] = {}


def models(folders: list[Path]) -> Iterator[Path]:
    """Yield the files of MJCF in folders."""
    for folder in folders:
        for path in [folder] if folder.is_file() else sorted(folder.rglob("*.xml")):
            if b"<mujoco" in path.read_bytes():
                yield path


def compiled(path: str) -> float | None:
    """Return how long MuJoCo compiles a file, or None if it does not."""
    start = time.process_time()
    try:
        mujoco.MjModel.from_xml_path(path)
    except (ValueError, RuntimeError):
        return None
    return time.process_time() - start


def judge(job: tuple[str, str, int, str]) -> Verdict | None:
    """Return what is found for a file; None if MuJoCo does not compile it as it is."""
    path, mode, _, keep = job
    try:
        return JUDGES[mode](path, keep) if compiled(path) is not None else None
    except Exception as error:  # of any kind: this is a report
        where = traceback.extract_tb(error.__traceback__)[-1]
        place = f"{Path(where.filename).name}:{where.lineno}"
        return Verdict(path, FAILS, f"traceback: {type(error).__name__}: {error} at {place}"[:300])


def judge_apart(job: tuple[str, str, int, str]) -> Verdict | None:
    """Return what is found for a file by a process of its own, which may hang or end."""
    path, _, seconds, _ = job
    mine, theirs = Pipe(duplex=False)
    process = Process(target=lambda: theirs.send(judge(job)))
    process.start()
    theirs.close()
    try:
        if mine.poll(seconds):
            return mine.recv()
        return Verdict(path, FAILS, f"takes more than {seconds} s")
    except EOFError:
        return Verdict(path, FAILS, "ends the process")
    finally:
        process.kill()
        process.join()


def judge_mjcf(path: str, keep: str, *, migrates: bool = False) -> Verdict:
    """Return whether what is written as MJCF is the same model."""
    with tempfile.TemporaryDirectory() as folder:
        made = Path(keep or folder) / "made.xml"
        source = Path(path)
        if migrates:
            source = _migrated(source, Path(folder))
        try:
            build = yamaro.build(source, target="mjcf", output=made)
        except yamaro.YamaroError as error:
            first = error.diagnostics[0]
            return Verdict(path, FAILS, f"{first.code}: {first.message}")
        made.parent.mkdir(parents=True, exist_ok=True)
        made.write_text(build.xml(), encoding="utf-8")
        for name, data in build.assets.items():
            (made.parent / name).parent.mkdir(parents=True, exist_ok=True)
            (made.parent / name).write_bytes(data)
        try:
            comparison = Comparison(path, str(made))
        except ValueError as error:
            text = re.sub(r"\s+", " ", str(error))
            return Verdict(path, FAILS, f"MuJoCo refuses: {text}")
        told = [f"{each.kind} {each.what}" for each in build.losses]
        told += [f"{each.code}" for each in build.warnings if "-in-" not in each.code]
        kind = EQUAL
        if comparison.found:
            serious = [each for each in told if not HARMLESS.search(each)]
            kind = TOLD if serious else SILENT
        why = "; ".join(f"{what}: {how}" for what, how in comparison.found.items())
        verdict = Verdict(path, kind, why)
        verdict.told, verdict.fields = list(dict.fromkeys(told)), comparison.fields
        return verdict


def judge_urdf(path: str, _: str) -> Verdict:
    """Return whether what is written as URDF moves as what is written as MJCF does."""
    try:
        build = yamaro.build(path, target="urdf", meshes="keep")
        mjcf = yamaro.build(path, target="mjcf")
    except yamaro.YamaroError as error:
        first = error.diagnostics[0]
        return Verdict(path, FAILS, f"{first.code}: {first.message}")
    told = [f"{each.kind} {each.what}" for each in build.losses]
    base = mjcf.robot.base
    try:
        reference = PinocchioUrdf(build.xml(), is_fixed=base is None or base.type == "fixed")
        model = Mujoco(mjcf.xml(), dict(mjcf.assets), reference.joints)
        model.model.opt.gravity[:] = (0, 0, -9.81)
        found = differences(reference, model, 20)
    except Exception as error:  # of any kind: this is a report
        verdict = Verdict(path, TOLD if told else FAILS, f"{type(error).__name__}: {error}"[:200])
        verdict.told = list(dict.fromkeys(told))
        return verdict
    why = "; ".join(f"{what}: {off:.1e}" for what, off in found.items() if not off < 1e-9)
    verdict = Verdict(path, (TOLD if told else SILENT) if why else EQUAL, why)
    verdict.told = list(dict.fromkeys(told))
    return verdict


IN_URDF = {"body": "link", "site": "link", "joint": "joint"}
"""What elements become in URDF."""
ONLY_IN_MJCF = frozenset(
    "stiffness springref armature ref margin solreflimit solimplimit actuatorgravcomp".split()
)
"""Values of joints."""
REPORTED = frozenset(
    """
    actuator sensor tendon equality keyframe contact deformable custom light camera flexcomp
    """.split()
)
"""Sections, and elements in bodies, that URDF has nothing for."""


def judge_losses(path: str, _: str) -> Verdict:
    """Return whether what is in a model is in the URDF, or reported at its line."""
    from lxml import etree

    try:
        build = yamaro.build(path, target="urdf", meshes="keep")
    except yamaro.YamaroError as error:
        first = error.diagnostics[0]
        return Verdict(path, FAILS, f"{first.code}: {first.message}")
    made = etree.fromstring(build.xml().encode())
    names = {(each.tag, each.get("name")) for each in made}
    lines = {each.span.location()[0] for each in build.losses if each.span.source.path == path}
    silent = []
    told = 0
    for each in etree.parse(path).getroot().iter(etree.Element):
        around = [above.tag for above in each.iterancestors()]
        if "default" in around or "replicate" in around or not _is_lost(each, around, names):
            continue
        sections = [above for above in each.iterancestors() if above.tag in REPORTED]
        whole = (*each.iter(), *sections, *_together(each))
        its_own = {line for inner in whole for line in _lines(inner)}
        if lines.isdisjoint(its_own):
            silent.append(f"<{each.tag}> at line {each.sourceline}")
        else:
            told += 1
    verdict = Verdict(path, SILENT if silent else EQUAL, ", ".join(silent[:5]))
    verdict.told = [f"{told} elements"]
    return verdict


def _is_lost(element: Any, around: list[str], names: set[tuple[str, str | None]]) -> bool:
    """Return whether URDF has nothing for an element of MJCF, or does not have it."""
    if "worldbody" in around:
        kind, name = IN_URDF.get(element.tag), element.get("name")
        is_missing = kind is not None and name is not None and (kind, name) not in names
        has_more = element.tag == "joint" and not ONLY_IN_MJCF.isdisjoint(element.attrib)
        return is_missing or has_more or element.tag in REPORTED
    if len(around) != 2 or around[0] not in REPORTED:
        return False
    return around[0] != "equality" or element.tag != "joint"  # which is a mimic joint


def _together(element: Any) -> list[Any]:
    """Return the elements that are one thing of the model with another, reported at one of them.

    An actuator has the armature of its joint; an accelerometer and a gyro at a site are one sensor.
    """
    name, site = element.get("name"), element.get("site")
    root = element.getroottree().getroot()
    if element.tag == "joint" and name is not None and "armature" in element.attrib:
        return [each for each in root.iterfind("actuator/*") if each.get("joint") == name]
    if site is not None and element.getparent().tag == "sensor":
        return [each for each in root.iterfind("sensor/*") if each.get("site") == site]
    return []


def _lines(element: Any) -> range:
    """Return the lines of the start of an element; lxml knows the last one."""
    most = len(element.attrib) + sum(value.count("  ") for value in element.attrib.values())
    return range(element.sourceline - most, element.sourceline + 1)


def judge_time(path: str, _: str) -> Verdict:
    """Return how long a model takes."""
    own: list[float] = []
    ours: list[float] = []
    compiling = [sys.executable, "-c", COMPILING, path]
    building = [sys.executable, "-m", "yamaro", path, "-q", "-o", os.devnull, "--meshes", "keep"]
    commands = [(_time_of(compiling), _time_of(building)) for _ in range(5)]
    for _run in range(5):
        own.append(compiled(path) or 0.0)
        start = time.process_time()
        yamaro.build(path, target="urdf", meshes="keep").xml()
        ours.append(time.process_time() - start)
    bodies = mujoco.MjModel.from_xml_path(path).nbody
    ratio = min(ours) / max(min(own), 1e-6)
    theirs, whole = (min(each) for each in zip(*commands, strict=True))
    how = f"{bodies} bodies: {1e3 * min(own):.1f} ms, {1e3 * min(ours):.1f} ms, ratio {ratio:.2f}"
    how += f"; as commands {1e3 * theirs:.0f} ms, {1e3 * whole:.0f} ms, ratio {whole / theirs:.2f}"
    return Verdict(path, EQUAL if whole <= 3 * theirs else TOLD, how)


COMPILING = "import sys, mujoco; mujoco.MjModel.from_xml_path(sys.argv[1])"


def _time_of(command: list[str]) -> float:
    """Return the processor time that a command takes, in s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=False, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def judge_migrated(path: str, keep: str) -> Verdict:
    """Return whether YAML that is made of a model gives the same model."""
    return judge_mjcf(path, keep, migrates=True)


JUDGES = {
    "mjcf": judge_mjcf,
    "urdf": judge_urdf,
    "losses": judge_losses,
    "times": judge_time,
    "migrate": judge_migrated,
}


def _migrated(source: Path, folder: Path) -> Path:
    from yamaro.commands.main import main

    made = folder / f"{source.stem}.yaml"
    code = main(["migrate", "--trust", str(source), "-o", str(made)])
    if code not in (0, None):
        raise RuntimeError(f"migrate ended with {code}")
    return made


def hundred_bodies() -> str:
    """Return a model of 100 bodies of plain shapes, in ten limbs with a servo for most joints."""
    parts = ['<mujoco model="hundred"><default><joint damping="0.1"/><default class="seen">']
    parts.append('<geom contype="0" conaffinity="0" group="2"/></default></default><worldbody>')
    for limb in range(10):
        parts.append(f'<body name="limb{limb}" pos="{limb / 2} 0 1">')
        parts.append(f'<joint name="r{limb}" axis="0 0 1" range="-90 90"/>')
        parts.append(f'<geom name="g{limb}" type="box" size="0.05 0.04 0.03"/>')
        for number in range(9):
            name = f"{limb}_{number}"
            parts.append(f'<body name="l{name}" pos="0 0 0.1" euler="0 {number} 0">')
            parts.append(f'<joint name="j{name}" axis="0 1 0" range="-60 {60 + number}"/>')
            parts.append(f'<geom name="a{name}" type="capsule" size="0.02" fromto="0 0 0 0 0 .1"/>')
            parts.append('<geom class="seen" type="cylinder" size="0.03 0.02" pos="0 0 0.05"/>')
        parts.append("</body>" * 10)
    names = [f"j{limb}_{number}" for limb in range(10) for number in range(9)]
    servos = [f'<position joint="{each}" kp="50" ctrlrange="-1 1"/>' for each in names]
    return "\n".join([*parts, "</worldbody><actuator>", *servos, "</actuator></mujoco>"])


def show(verdicts: list[Verdict], options: argparse.Namespace) -> None:
    """Print the table of folders, then the causes, most frequent first."""
    table: dict[str, Counter[str]] = defaultdict(Counter)
    roots = [str(each) for each in options.folders]
    for each in verdicts:
        root = next(root for root in roots if each.path.startswith(root))
        inner = Path(each.path).relative_to(root).parts
        table[f"{Path(root).name}/{inner[0]}" if len(inner) > 1 else Path(root).name][
            each.kind
        ] += 1
    kinds = (EQUAL, TOLD, SILENT, FAILS)
    print(f"{'':40}{'models':>8}" + "".join(f"{kind:>8}" for kind in kinds))
    total: Counter[str] = Counter()
    for name, counts in table.items():
        print(f"{name:40}{counts.total():8}" + "".join(f"{counts[kind]:8}" for kind in kinds))
        total += counts
    print(f"{'all':40}{total.total():8}" + "".join(f"{total[kind]:8}" for kind in kinds))
    for kind in (FAILS, SILENT, TOLD):
        causes: dict[str, list[Verdict]] = defaultdict(list)
        for each in verdicts:
            if each.kind == kind:
                causes[_cause(each)].append(each)
        for cause, group in sorted(causes.items(), key=lambda item: -len(item[1])):
            print(f"\n{kind}, {len(group)}: {cause}")
            for each in group[: options.show]:
                print(f"    {each.path}: {each.why[:300]}")
                if kind == TOLD:
                    print(f"        told: {', '.join(each.told)[:300]}")
    if options.fields:
        found: dict[str, list[tuple[str, str]]] = defaultdict(list)
        for each in verdicts:
            for name, how in each.fields.items():
                found[name].append((each.path, how))
        print("\nother values that differ:")
        for name, cases in sorted(found.items(), key=lambda item: -len(item[1])):
            print(f"  {name} in {len(cases)} models, such as {cases[0][0]}: {cases[0][1]}")


def _last_number(text: str) -> float:
    found = re.findall(r"[0-9.]+$", text)
    return float(found[0]) if found else 0.0


def _cause(verdict: Verdict) -> str:
    if verdict.kind == FAILS:
        return re.sub(r"'[^']*'|[\d.e-]+", "…", verdict.why)[:100]
    return ", ".join(part.split(":")[0] for part in verdict.why.split("; "))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--show", type=int, default=3)
    parser.add_argument("--fields", action="store_true")
    modes = parser.add_mutually_exclusive_group()
    for mode in ("migrate", "urdf", "losses", "times"):
        modes.add_argument(
            f"--{mode}", dest="mode", action="store_const", const=mode, default="mjcf"
        )
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--keep", default="", help="where what is written of one model stays")
    parser.add_argument("--table", type=Path, help="a file for one line a model")
    options = parser.parse_args()
    paths = [str(each) for each in models(options.folders) if re.search(options.only, str(each))]
    if options.mode == "times":
        plain = Path(tempfile.mkdtemp()) / "hundred_bodies.xml"
        plain.write_text(hundred_bodies(), encoding="utf-8")
        paths = [str(plain), *paths]
    jobs = [(path, options.mode, options.seconds, options.keep) for path in paths[:: options.every]]
    verdicts = []
    with (
        ThreadPoolExecutor(options.jobs) as pool,
        open(options.table or os.devnull, "w", encoding="utf-8") as table,
    ):
        for each in pool.map(judge_apart, jobs):
            if each is not None:
                verdicts.append(each)
                line = (each.path, each.kind, each.why, ", ".join(each.told))
                print(*line, sep="\t", file=table, flush=True)
    if options.mode == "times":
        for each in sorted(verdicts, key=lambda each: (each.kind == FAILS, _last_number(each.why))):
            print(f"{each.path}: {each.why}")
        return
    show(verdicts, options)


if __name__ == "__main__":
    main()
