"""Feeds the targets for a while, and shows what came of it.

    scripts/fuzz                              each target 15 seconds
    scripts/fuzz --seconds 600 reader keys    these targets, 10 minutes each
    scripts/fuzz --seconds 0 --reached        only shows what they begin with reaches
    scripts/fuzz --missing                    shows the lines that are not reached, too
    scripts/fuzz --keep                       lets the corpora have what is found
    scripts/fuzz --plain                      with random inputs, as where there is no atheris

With faults the exit status is 1, and the folder that is named holds the inputs.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from .corpus import ROOT, read_corpus, to_bytes

NAMES = ("reader", "keys", "template", "pipeline")
PACKAGE = "/yamaro/"


def main(arguments: list[str]) -> int:
    options = read_options(arguments)
    folder = Path(tempfile.mkdtemp(prefix="yamaro-fuzz-"))
    is_guided = not options.plain and has_atheris()
    print(f"fuzzing on Python {platform.python_version()}, {how(is_guided)}", flush=True)
    names = options.targets or NAMES
    for name in names:
        (folder / name).mkdir()
    faults = []
    if options.seconds:
        with ThreadPoolExecutor(os.cpu_count()) as pool:  # each waits for a process of its own
            for told, found in pool.map(
                lambda name: feed(name, folder / name, options, is_guided=is_guided), names
            ):
                print(told, flush=True)
                faults += found
    for name in names:
        if options.keep and is_guided:
            keep(name, folder / name)
    for name in names:
        if options.reached or options.missing:
            faults += show_reached(name, folder / name, is_detailed=options.missing)
    if faults:
        (folder / "faults.txt").write_text("\n\n".join(faults), "utf-8", "backslashreplace")
        print("\n\n".join(faults))
        print(f"\n{len(faults)} faults, in {folder}/faults.txt")
    return 1 if faults else 0


def read_options(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        "scripts/fuzz", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("targets", nargs="*", choices=[*NAMES, []], metavar="TARGET")
    parser.add_argument("--seconds", type=float, default=15, help="for each target")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--plain", action="store_true")
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("--reached", action="store_true")
    parser.add_argument("--missing", action="store_true")
    return parser.parse_args(arguments)


def has_atheris() -> bool:
    from importlib.util import find_spec

    return find_spec("atheris") is not None


def how(is_guided: bool) -> str:
    return "guided by coverage (atheris)" if is_guided else "with random inputs, not guided"


def run(module: str, *arguments: object, log: Path, **variables: str) -> None:
    """Run a module of this folder; show what it said if it fails."""
    command = [sys.executable, "-m", f"tests.fuzz.{module}", *map(str, arguments)]
    with log.open("w") as file:
        done = subprocess.run(
            command, cwd=ROOT, stdout=file, stderr=file, env={**os.environ, **variables}
        )
    if done.returncode:
        sys.exit(f"{log.read_text(errors='replace')[-4000:]}\n{' '.join(command)} failed")


def feed(
    name: str, folder: Path, options: argparse.Namespace, *, is_guided: bool
) -> tuple[str, list[str]]:
    """Feed a target; return what came of it, and its faults."""
    module = "guided" if is_guided else "plain"
    run(module, name, options.seconds, options.seed, folder, log=folder / "log.txt")
    found = json.loads((folder / "session.json").read_text())
    inputs = sum(found["counts"].values())
    most = sorted(found["counts"].items(), key=lambda item: -item[1])
    shown = ", ".join(f"{word} {count:,}" for word, count in most[:8])
    told = (
        f"{name:9} {inputs:9,} inputs in {found['seconds']:.0f} s, {len(found['faults'])} faults; "
        f"{len(most)} outcomes: {shown}"
    )
    return told, [
        f"=== {name}: {place}\n{trace}\ninput: {text!r}"
        for place, (text, trace) in found["faults"].items()
    ]


def keep(name: str, folder: Path) -> None:
    """Let the corpus of a target have what was found, without what it does not need."""
    known, merged = folder / "known", folder / "merged"
    for path in (known, merged, folder / "corpus"):
        path.mkdir(exist_ok=True)
    for number, text in enumerate(read_corpus(name)):
        (known / str(number)).write_bytes(to_bytes(text))
    control = folder / "control.txt"
    options = ("-merge=1", f"-merge_control_file={control}")
    folders = (merged, known, folder / "corpus")
    run("minimise", *options, *folders, log=folder / "merge.txt", YAMARO_FUZZ_TARGET=name)
    run("keep", name, control, log=folder / "keep.txt")


def show_reached(name: str, folder: Path, *, is_detailed: bool) -> list[str]:
    """Show what of its modules a target reaches to begin with; return the faults of that."""
    report = folder / "reached.json"
    run("replay", name, report, log=folder / "replay.txt")
    found = json.loads(report.read_text())
    print(f"\n{name}: the {found['inputs']:,} inputs that it begins with reach")
    for path, file in sorted(found["files"].items()):
        print(line_of(path.rpartition(PACKAGE)[2], file["summary"]))
        if is_detailed:
            print(f"      lines {file['missing_lines']}, branches {file['missing_branches']}")
    print(line_of("in all", found["totals"]), flush=True)
    return [f"=== {name}, to begin with\n{found['faults']}"] if found["faults"] else []


def line_of(path: str, summary: dict[str, Any]) -> str:
    branches = f"{summary['covered_branches']:5,} of {summary['num_branches']:5,} branches"
    lines = f"{summary['covered_lines']:5,} of {summary['num_statements']:5,} lines"
    return f"  {path:28} {summary['percent_covered']:5.1f}%  {branches}, {lines}"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
