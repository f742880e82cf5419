"""Makes a corpus for bench/robots.py out of a folder of repositories.

    python bench/fresh.py FOLDER
    python bench/robots.py FOLDER

FOLDER/src holds the repositories, one folder each. Written are FOLDER/xacro.tsv, FOLDER/urdf.tsv
(empty) and FOLDER/expected, in the form of the corpus that bench/robots.py reads.

How a fair set comes about, so that nobody chooses what suits us: paths that many repositories have
are looked up in an index of public repositories. Each answer, in the order of the names, is divided
into eight equal parts, and at most one repository of each part is taken, one of each owner, none
that is in the other corpus or in robot_descriptions.py, whatever is in it. Paths are those of

- whole robots: `urdf/robot.urdf.xacro`, `robot_description/urdf/robot.urdf.xacro`,
  `urdf/ur.urdf.xacro`;
- pieces: `urdf/arm.urdf.xacro`, `urdf/gripper.xacro`, `urdf/leg.xacro`, `urdf/wheel.xacro`,
  `urdf/ros2_control.xacro`, `urdf/sensors/imu.urdf.xacro`, `urdf/inc/ur_macro.xacro`;
- helpers, which robots of several files have: `urdf/macros.xacro`, `urdf/common.xacro`,
  `urdf/common_properties.xacro`, `urdf/accessories.urdf.xacro`, `urdf/utils.xacro`.

A robot is every xacro file of theirs that

- xacro expands without arguments, or with a value for each argument that has no default: the
  empty text;
- has a name and at least a link then;
- makes no robot that another one of the set is already, and is one of the first twelve of its
  repository.

Packages are looked up in the repository and then in the others; a package that none has is taken
to be in a folder that does not exist.
"""

from __future__ import annotations

import argparse
import contextlib
import csv
import hashlib
import io
import os
import re
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

import xacro
import xacro.substitution_args as substitution
from robots import UNKNOWN

MOST = 12
"""How many robots of a repository are taken."""
COLUMNS = ("path", "args", "expected", "links", "joints", "packages")


class Expansion:
    """What xacro makes of a file, and the packages that it has asked for."""

    def __init__(self, folder: Path, packages: dict[str, dict[str, Path]], path: Path) -> None:
        """Expand the file; raise what xacro raises.

        Args:
            folder: that of all repositories.
            packages: the packages of each repository.
            path: the file.
        """
        self.packages: dict[str, str] = {}
        own = path.relative_to(folder).parts[0]

        def find(name: str) -> str:
            each = (packages[own], *(packages[other] for other in sorted(packages)))
            found = next((there[name] for there in each if name in there), None)
            self.packages[name] = str(found.relative_to(folder)) if found else ""
            return str(found or f"{UNKNOWN}/{name}")

        substitution._eval_find = substitution._eval_dict["find"] = find
        os.chdir(path.parent)
        self.arguments: dict[str, str] = {}
        while True:
            try:
                with silence():
                    self.document = xacro.process_file(str(path), mappings=dict(self.arguments))
                return
            except Exception as error:
                missing = re.search(r"Undefined substitution argument (\w+)", str(error))
                if missing is None or missing[1] in self.arguments:
                    raise
                self.arguments[missing[1]] = ""


@contextlib.contextmanager
def silence() -> Iterator[None]:
    """Keep what xacro prints."""
    with contextlib.redirect_stderr(io.StringIO()), contextlib.redirect_stdout(io.StringIO()):
        yield


def packages_of(repository: Path) -> dict[str, Path]:
    """Return the folders of the packages in a repository."""
    found: dict[str, Path] = {}
    for manifest in sorted(repository.rglob("package.xml")):
        with contextlib.suppress(ElementTree.ParseError):
            name = (ElementTree.parse(manifest).findtext("name") or "").strip()
            found.setdefault(name, manifest.parent)
    return found


def rows(folder: Path) -> Iterator[dict[str, object]]:
    """Expand the robots in a folder of repositories, and write down what comes of each."""
    source = folder / "src"
    repositories = sorted(each for each in source.iterdir() if each.is_dir())
    packages = {each.name: packages_of(each) for each in repositories}
    seen: set[str] = set()
    for repository in repositories:
        taken = 0
        for path in sorted(repository.rglob("*.xacro")):
            if taken == MOST:
                break
            try:
                made = Expansion(source, packages, path)
            except Exception:  # whatever xacro and the Python of a file raise
                continue
            root = made.document.documentElement
            kinds = [node.nodeName for node in root.childNodes]
            text = made.document.toxml()
            bare = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
            key = hashlib.sha256(bare.encode()).hexdigest()
            if not root.getAttribute("name") or "link" not in kinds or key in seen:
                continue
            seen.add(key)
            taken += 1
            at = path.relative_to(source)
            expected = folder / "expected" / f"{at}.urdf"
            expected.parent.mkdir(parents=True, exist_ok=True)
            for place, name in ((folder, "@CORPUS@"), (UNKNOWN, "@UNKNOWN@")):
                text = text.replace(f"{place}/", f"{name}/")
            expected.write_text(text, encoding="utf-8")
            yield {
                "path": at,
                "args": " ".join(f"{name}:={value}" for name, value in made.arguments.items()),
                "expected": expected.relative_to(folder),
                "links": kinds.count("link"),
                "joints": kinds.count("joint"),
                "packages": ";".join(f"{name}={at}" for name, at in sorted(made.packages.items())),
            }


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path)
    folder = parser.parse_args().folder.resolve()
    os.environ.update(ROS_VERSION="2", ROS_DISTRO="humble")
    found = list(rows(folder))
    with (folder / "xacro.tsv").open("w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, delimiter="\t", quoting=csv.QUOTE_NONE)
        table.writeheader()
        table.writerows(found)
    (folder / "urdf.tsv").write_text("path\n", encoding="utf-8")
    repositories = {str(row["path"]).split("/")[0] for row in found}
    print(f"{len(found)} robots of {len(repositories)} repositories")


if __name__ == "__main__":
    main()
