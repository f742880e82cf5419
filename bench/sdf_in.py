"""Reads SDF, writes it as SDF again, and has Drake judge whether it is still the same robot.

    python bench/sdf_in.py FOLDER ... [--only REGEX] [--states N] [--show N] [--keep FOLDER]
                           [--urdf] [--migrate] [--unread]

Of every model of SDF in the folders that Drake reads, what Yamaro writes is read by Drake too, and
compared by name: bodies, frames, joints, their limits and damping, poses at the start, and at
random states poses, mass matrix and inverse dynamics; shapes of bodies. Then each value of the file
is looked for in the text. A model is `equal` without a difference; `told` if it differs and
something was reported; `silent` if it differs and nothing was; `fails` if nothing was written or
Drake refuses it; `refused by both` if Drake refuses the file itself too. What Drake does not read
is compared as text only. With `--urdf`, what is written
as URDF is read by pinocchio, and poses and mass matrix are compared with Drake's; with `--migrate`,
the model goes through `yamaro migrate` and a build of the YAML.
"""

from __future__ import annotations

import argparse
import re
import sys
import tempfile
import traceback
from collections import Counter
from collections.abc import Iterator
from multiprocessing import Pipe, Process
from pathlib import Path
from xml.etree import ElementTree

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

import yamaro  # noqa: E402 - after the path
from tests.sources.sdf.same_sdf import (  # noqa: E402
    Loaded,
    RefusedError,
    Same,
    faults_of_urdf,
    lost_texts,
)

WANTS_REASON = False
HARMLESS = re.compile("a world says|has \\d+ models|of a nested model|no version|missing-mesh")
"""Warnings that no comparison can show."""


def models(folders: list[Path]) -> Iterator[Path]:
    """Yield the files of SDF in folders."""
    for folder in folders:
        for path in [folder] if folder.is_file() else sorted(folder.rglob("*")):
            if (
                path.suffix in (".sdf", ".world")
                and path.name[0] != "."
                and re.search(b"<(sdf|gazebo) +version", path.read_bytes())
            ):
                yield path


def first_model(path: Path) -> str | None:
    """Return the name of the model that is read of a file."""
    root = ElementTree.parse(path).getroot()
    for holder in (root, *root.iterfind("world")):
        for model in holder.iterfind("model"):
            return model.get("name")
    return None


def judged(
    path: Path, keep: Path, states: int, *, wants_urdf: bool = False, migrates: bool = False
) -> tuple[str, str, list[str]]:
    """Return what became of a model, why, and what was reported."""
    reported: list[str] = []
    try:
        source = migrated(path) if migrates else path
        build = yamaro.build(source, target="sdf", meshes="absolute", on_message=lambda _: None)
        text = build.xml()
    except yamaro.YamaroError as error:
        first = next(each for each in error.diagnostics if each.severity == "error")
        if first.code == "sdf-model":
            return "not a robot", first.message, reported
        try:
            Loaded(path, None, [path.parent, path.parent.parent], has_shapes=False)
        except RefusedError as refused:
            return "refused by both", f"{first.code}; Drake: {refused}", reported
        return "fails", f"{first.code}: {first.message[:90]}", reported
    except Exception:
        return "fails", "TRACEBACK " + traceback.format_exc().splitlines()[-1][:120], reported
    written = keep / f"{path.parent.name}_{path.stem}.sdf"
    written.write_text(text, encoding="utf-8")
    reported = [
        f"{each.code}: {each.message}" for each in build.warnings
        if not HARMLESS.search(f"{each.code}: {each.message}")
    ]  # fmt: skip
    try:
        model = first_model(path)
    except ElementTree.ParseError:
        model = None
    faults: list[str] = []
    unread = ""
    try:
        faults += Same(path, written, model=model, folders=[path.parent, path.parent.parent]).run(
            states
        )
    except RefusedError as error:
        try:
            Loaded(path, model, [path.parent, path.parent.parent], has_shapes=False)
            return "fails", f"Drake refuses what is written: {error}", reported
        except RefusedError as why:
            unread = "unread "
            if WANTS_REASON:
                print(f"    {path}: {why}")
    if wants_urdf and not unread:
        urdf = written.with_suffix(".urdf")
        made = yamaro.build(path, target="urdf", meshes="none", on_message=lambda _: None)
        urdf.write_text(made.xml())
        reported += [f"{each.code}: {each.message}" for each in made.warnings]
        drake = Loaded(path, model, [path.parent, path.parent.parent], has_shapes=False)
        faults += faults_of_urdf(drake, urdf, states)
    faults += lost_texts(path, written, model)
    if not faults:
        return f"{unread}equal", "", reported
    return f"{unread}{'told' if reported else 'silent'}", "; ".join(faults[:3]), reported


def migrated(path: Path) -> Path:
    """Return the YAML that a model is converted to, beside it."""
    from yamaro.commands.main import main as run

    made = path.with_name(f".{path.stem}-migrated.yaml")
    run(["migrate", "-q", "--trust", "--force", str(path), "-o", str(made)])
    return made


def apart(path: Path, keep: Path, states: int, **wanted: bool) -> tuple[str, str, list[str]]:
    """Judge a model in a process of its own, which Drake may end."""
    mine, theirs = Pipe(duplex=False)
    process = Process(target=lambda: theirs.send(judged(path, keep, states, **wanted)))
    process.start()
    theirs.close()
    try:
        return mine.recv() if mine.poll(120) else ("unjudged", "it takes too long", [])
    except EOFError:
        return "unjudged", "Drake ends the process", []
    finally:
        process.kill()
        process.join()


def main() -> None:
    """Judge the models that the command line names."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--states", type=int, default=20)
    parser.add_argument("--show", type=int, default=1000)
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--urdf", action="store_true")
    parser.add_argument("--migrate", action="store_true")
    parser.add_argument("--unread", action="store_true", help="print why Drake does not read")
    wanted = parser.parse_args()
    global WANTS_REASON
    WANTS_REASON = wanted.unread
    counts: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        keep = wanted.keep or Path(folder)
        keep.mkdir(exist_ok=True, parents=True)
        for path in models(wanted.folders):
            if not re.search(wanted.only, str(path)):
                continue
            kind, why, reported = apart(
                path, keep, wanted.states, wants_urdf=wanted.urdf, migrates=wanted.migrate
            )
            counts[kind] += 1
            if not kind.endswith("equal") and wanted.show > 0:
                wanted.show -= 1
                print(f"{path}: {kind}: {why}", flush=True)
                for line in reported[:4] if kind.endswith("told") else ():
                    print(f"    {line[:160]}")
    print("  ".join(f"{kind} {count}" for kind, count in counts.most_common()))


if __name__ == "__main__":
    main()
