"""Records what the vendors of the robots in `robots/` say, and writes what follows from it.

`scripts/shelf` starts it. Repositories are read from build/shelf/OWNER+NAME, a clone of each;
what is not there is cloned from GitHub.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any

import yaml

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "src"), str(ROOT)]

from tests import shelf  # noqa: E402
from yamaro import build  # noqa: E402
from yamaro.commands.main import main as yamaro  # noqa: E402
from yamaro.tools.new.package import files_around  # noqa: E402

CLONES = ROOT / "build" / "shelf"
COMMAND = re.compile(r"^yamaro picture urdf/(.*)$", re.MULTILINE)
"""The command that makes the picture, in the README of each robot."""


def main() -> None:
    parser = argparse.ArgumentParser(prog="scripts/shelf", description=__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    command = commands.add_parser("record", help="write vendor.json")
    command.add_argument("name")
    command.add_argument("file", nargs="?", help="OWNER/REPOSITORY/PATH; default: as recorded")
    command.add_argument("arguments", nargs="*", metavar="a:=b", help="arguments of the xacro")
    command.add_argument("--license", help="that of the file, as SPDX spells it")
    command.add_argument("--with", nargs="*", default=[], dest="others", metavar="OWNER/REPOSITORY")
    command.add_argument("--call", default="", help="XML after the file's, such as <xacro:a200/>")
    command.add_argument("--model", default="", help="one of several: writes vendor_MODEL.json")
    command.add_argument("--set", nargs="*", default=[], metavar="a=b", help="of our own robot")
    command.set_defaults(run=record)
    command = commands.add_parser("differences", help="print what differs and is not listed")
    command.add_argument("name")
    command.set_defaults(run=print_differences)
    command = commands.add_parser("package", help="write the files for pip and colcon")
    command.add_argument("name")
    command.set_defaults(run=write_package)
    command = commands.add_parser("pictures", help="draw picture.png")
    command.add_argument("names", nargs="*")
    command.set_defaults(run=draw)
    command = commands.add_parser("table", help="write robots/README.md")
    command.set_defaults(
        run=lambda _: (shelf.ROBOTS / "README.md").write_text(table(), encoding="utf-8")
    )
    options = parser.parse_args()
    options.run(options)


# --- what vendors say -------------------------------------------------------------------------


def record(options: argparse.Namespace) -> None:
    """Write what a vendor's description says; without a file, again as it was recorded."""
    suffix = f"_{options.model}" if options.model else ""
    path = shelf.ROBOTS / options.name / f"vendor{suffix}.json"
    if options.file is None:
        known = json.loads(path.read_text(encoding="utf-8"))
        source = known["source"]
        repository = source["repository"].removeprefix("https://github.com/")
        others = [each["repository"].removeprefix("https://github.com/") for each in source["with"]]
        file, arguments, licence = source["file"], source["arguments"], source["license"]
        chosen, call = known["set"], source.get("call", "")
    else:
        owner, name, file = options.file.split("/", 2)
        repository, others, arguments = f"{owner}/{name}", options.others, options.arguments
        licence, call = options.license, options.call
        words = (word.split("=", 1) for word in options.set)
        chosen = {key: yaml.safe_load(value) for key, value in words}
        if not licence:
            raise SystemExit("--license is missing: read that of the repository")
    clone = cloned(repository)
    if Path(file).suffix == ".xml":
        reader, found = "mujoco", shelf.read_mjcf(clone / file)
        read = [clone / file]
    else:
        text, read = expanded(clone / file, arguments, [clone, *map(cloned, others)], call)
        reader, found = "yourdfpy", shelf.read_urdf(text)
        compare_with_pinocchio(text, found)
    source = {
        **at_commit(repository),
        "file": file,
        "arguments": arguments,
        **({"call": call} if call else {}),
        "with": [at_commit(other) for other in others],
        "license": licence,
        "lines": sum(shelf.lines_of(one.read_text("utf-8"), is_xml=is_xml(one)) for one in read),
        "reader": reader,
    }
    path.parent.mkdir(parents=True, exist_ok=True)
    whole = {"source": source, "set": chosen, **found}
    path.write_text(as_json(whole), encoding="utf-8")
    print(f"{path.relative_to(ROOT)}: {len(found['links'])} links, {len(found['joints'])} joints")


def is_xml(path: Path) -> bool:
    return path.suffix not in (".yaml", ".yml")


def cloned(repository: str) -> Path:
    """Return the folder of a repository's clone."""
    folder = CLONES / repository.replace("/", "+")
    if not folder.exists():
        url = f"https://github.com/{repository}"
        subprocess.run(["git", "clone", "--quiet", "--depth=1", url, folder], check=True)
    return folder


def at_commit(repository: str) -> dict[str, str]:
    command = ["git", "-C", str(cloned(repository)), "rev-parse", "HEAD"]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return {"repository": f"https://github.com/{repository}", "commit": done.stdout.strip()}


CALLER = """\
<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="caller">
<xacro:include filename="{path}"/>
{call}
</robot>
"""


def expanded(
    path: Path, arguments: list[str], clones: list[Path], call: str
) -> tuple[str, list[Path]]:
    """Return what xacro makes of a file, and the files that it read.

    Args:
        path: the file.
        arguments: what is passed to it, as name:=value.
        clones: where packages are found.
        call: what follows it in a robot, where the file has only macros.
    """
    import xacro
    from xacro import substitution_args

    packages = {}
    for manifest in (found for clone in clones for found in sorted(clone.rglob("package.xml"))):
        name = re.search(r"<name>\s*(\S+?)\s*</name>", manifest.read_text(encoding="utf-8"))
        if name is not None:
            packages.setdefault(name[1], str(manifest.parent))

    def find(package: str) -> str:
        if package not in packages:
            raise SystemExit(f"no package '{package}' in {clones}: add its repository, --with")
        return packages[package]

    substitution_args._eval_find = find
    substitution_args._eval_dict["find"] = find
    os.environ.setdefault("ROS_VERSION", "2")
    os.environ.setdefault("ROS_DISTRO", "jazzy")
    os.chdir(path.parent)
    mappings = dict(word.split(":=", 1) for word in arguments)
    start = path
    if call:
        start = CLONES / "caller.xacro"
        start.write_text(CALLER.format(path=path, call=call), encoding="utf-8")
    document = xacro.process_file(str(start), mappings=mappings)
    read = [path, *(Path(name).resolve() for name in xacro.all_includes)]
    return document.toprettyxml(indent="  "), list(dict.fromkeys(read))


def compare_with_pinocchio(urdf: str, found: shelf.Record) -> None:
    """Raise unless a record puts the links where pinocchio puts those of the URDF itself."""
    read, recorded = shelf.Placing(urdf), shelf.Placing(shelf.urdf_of(found))
    for positions in shelf.random_positions(found, 20):
        expected, poses = read(positions), recorded(positions)
        assert expected.keys() == poses.keys()
        for link, pose in expected.items():
            assert abs(pose - poses[link]).max() < shelf.POSE, link


def as_json(whole: dict[str, Any]) -> str:
    """Return a record as JSON, a line for each joint and link."""
    parts = [
        f'"source": {json.dumps(whole["source"], indent=1)}',
        f'"set": {json.dumps(whole["set"])}',
    ]
    for kind in ("joints", "links"):
        rows = (f" {json.dumps(name)}: {json.dumps(one)}" for name, one in whole[kind].items())
        parts.append(f'"{kind}": {{\n' + ",\n".join(rows) + "\n}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def print_differences(options: argparse.Namespace) -> None:
    """Print what differs and is not listed, as differences.yaml spells it."""
    for vendor in shelf.vendor_files(options.name):
        there = json.loads(vendor.read_text(encoding="utf-8"))
        built = build(str(shelf.main_file(options.name)), variables=there["set"])
        here = shelf.read_urdf(built.xml())
        known = shelf.listed(options.name, vendor)
        found = shelf.differences(there, here)
        new = {
            path: sides
            for path, sides in found.items()
            if path not in known or not shelf.are_same(path, known[path], sides)
        }
        print(f"# {vendor.name}: {len(new)} to list")
        for path, sides in new.items():
            print(f"    {path}: {json.dumps(sides)}".replace('"', ""))
        for path in known.keys() - found.keys():
            print(f"# is listed, but is the same: {path}")


# --- what follows -----------------------------------------------------------------------------


def draw(options: argparse.Namespace) -> None:
    """Draw the pictures by the command in the README of each robot."""
    for name in options.names or shelf.names():
        readme = shelf.ROBOTS / name / "README.md"
        found = COMMAND.search(readme.read_text(encoding="utf-8"))
        if found is None:
            raise SystemExit(f"no line 'yamaro picture urdf/{name}.yaml …' in {readme}")
        os.chdir(shelf.ROBOTS / name)
        if yamaro(["picture", "-q", *shlex.split(f"urdf/{found[1]}")]):
            raise SystemExit(1)
        shrink(shelf.ROBOTS / name / "picture.png")


def shrink(path: Path) -> None:
    """Write a picture again with 128 colours, which are enough and take a fifth of the space."""
    from PIL import Image

    image = Image.open(path).convert("RGB")
    image.quantize(128, dither=Image.Dither.NONE).save(path, optimize=True)


HEAD = """\
# Robots

Known robots, each in YAML as a maintainer would write it. Links, joints and frames have the names
of the vendor, so that controllers and planners fit. Each folder is a package for pip and for ROS.

```console
$ yamaro view turtlebot3/urdf/turtlebot3.yaml
$ yamaro turtlebot3/urdf/turtlebot3.yaml model:=waffle_pi -o waffle_pi.urdf
$ yamaro turtlebot3/urdf/turtlebot3.yaml --to mjcf,sdf,usd -o turtlebot3/
```

The shapes are simple ones. With `meshes:=true` they are the meshes of the vendor's package, which
has to be there.

`vendor.json` has the joints, limits, masses and inertias of the vendor's description, as other
programs read them. At 20 random positions, all links are where the vendor's are, to 1e-9.
`differences.yaml` lists each value that differs, with the reason. In CI, all formats are built, and
read by other programs. Lines are those that are neither blank nor only a comment, in all files that
the robot is read from.

| robot | source | lines: here, there | differences |
|---|---|---|---|
"""
FOOT = """
The names of the robots are those of their vendors, who have no part in this. `scripts/shelf` writes
this page, and records what the vendors say.
"""


def table() -> str:
    """Return the page with all robots."""
    vendors = [
        (name, path)
        for name in shelf.names()
        if not shelf.parts_of(name)
        for path in shelf.vendor_files(name)
    ]
    there = sum(json.loads(path.read_text("utf-8"))["source"]["lines"] for _, path in vendors)
    here = sum(shelf.own_lines(name) for name in {name for name, _ in vendors})
    total = f"""
Without those that are put together of others, and those without a vendor's description, it is
{here:,} lines here and {there:,} there.
"""
    return HEAD + "".join(map(row, shelf.names())) + total + FOOT


def row(name: str) -> str:
    """Return the row of a robot."""
    readme = (shelf.ROBOTS / name / "README.md").read_text(encoding="utf-8")
    title = readme.splitlines()[0].removeprefix("# ")
    records = [json.loads(one.read_text(encoding="utf-8")) for one in shelf.vendor_files(name)]
    sources = [record["source"] for record in records]
    links = dict.fromkeys(
        f"[{one['repository'].removeprefix('https://github.com/')}]"
        f"({one['repository']}/tree/{one['commit']})"
        for source in sources
        for one in (source, *source["with"])
    )
    path = shelf.ROBOTS / name / "differences.yaml"
    listed = yaml.safe_load(path.read_text(encoding="utf-8")) if path.exists() else []
    reasons = "<br>".join(dict.fromkeys(one["why"].strip() for one in listed or [])) or "none"
    licences = ", ".join(dict.fromkeys(source["license"] for source in sources))
    source = f"{title}: {', '.join(links)}; {licences}"
    lines = f"{shelf.own_lines(name)}, {sum(one['lines'] for one in sources)}"
    if not records:
        source, lines = f"{title}: [published numbers]({name}/)", f"{shelf.own_lines(name)}, –"
        reasons = "there is no description to compare with"
    picture = f'<img src="{name}/picture.png" width="220" alt="{title}">'
    return f"| [{name}]({name}/)<br>{picture} | {source} | {lines} | {reasons} |\n"


def package(name: str) -> dict[str, str]:
    """Return the files that make a robot's folder a package, as `yamaro new` has them."""
    readme = (shelf.ROBOTS / name / "README.md").read_text(encoding="utf-8")
    values = {"TITLE": readme.splitlines()[0].removeprefix("# "), "LICENSE": "GPL-3.0-or-later"}
    others = sorted(f"yamaro_{part}" for part in shelf.parts_of(name))
    files = files_around(
        f"yamaro_{name}",
        name,
        values,
        requirements=["yamaro", *(other.replace("_", "-") for other in others)],
        packages=others,
    )
    return {path: files[path] for path in ("pyproject.toml", "package.xml", "CMakeLists.txt")}


def write_package(options: argparse.Namespace) -> None:
    """Write the files that make a robot's folder a package for pip and for colcon."""
    for path, text in package(options.name).items():
        (shelf.ROBOTS / options.name / path).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
