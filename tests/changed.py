"""Says which tests a change can break: `python -m tests.changed [COMMIT]` prints their paths.

The change is what differs from COMMIT, uncommitted and new files included. Without COMMIT it is
what is not committed, or else the last commit.

By rooms: a module of `src/yamaro` asks for the tests of its own room, of the rooms whose modules
import it directly, and for test files that import it themselves. Outside of tools, it asks for
`CORE` as well: what every conversion passes through. So a change that reaches a tool only through
a conversion is judged by the conversion's tests; `scripts/test` runs all.
"""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]
TESTS = ROOT / "tests"
CORE = (
    "tests/check",
    "tests/consumers",
    "tests/model",
    "tests/robot",
    "tests/runtime",
    "tests/targets",
    "tests/test_api.py",
    "tests/test_cases.py",
    "tests/test_diagnostics.py",
    "tests/test_docs.py",
    "tests/test_examples.py",
    "tests/test_fixes.py",
)
ALWAYS = ("tests/test_architecture.py", "tests/test_diagnostics_listed.py", "tests/test_names.py")
IMPORT = re.compile(
    r"^[ \t]*(?:from[ ]+(\.*)([\w.]*)[ ]+)?import[ ]+(\([^)]*\)|[^\n#;]+)", re.MULTILINE
)
"""Reads a thousand files in a tenth of the time that their syntax trees take."""
HARNESS = re.compile(r"pyproject\.toml|tests/(conftest|effort)\.py|scripts/(test|lib\.sh)")
ELSEWHERE = {
    "README.md": ("tests/test_readme.py", "tests/test_links.py", "tests/test_docs.py"),
    "ARCHITECTURE.md": ("tests/test_architecture.py", "tests/test_links.py"),
    "CHANGELOG.md": ("tests/test_release.py",),
    "action.yml": ("tests/test_action.py",),
    "bench/": ("tests/test_bench.py",),
    "docs/": ("tests/test_docs.py", "tests/test_links.py", "tests/test_prose.py"),
    "editors/": ("tests/editors",),
    "examples/": ("tests/test_examples.py", "tests/consumers", "tests/examples"),
    "robots/": ("tests/test_shelf.py", "tests/test_links.py", "tests/site"),
    "ros/": ("tests/ros", "tests/tools/new"),
    "scripts/": ("tests/test_release.py",),
    "scripts/shelf": ("tests/test_shelf.py",),
    "src/yamaro/tools/new/template/": ("tests/tools/new",),
    "tests/cases/": ("tests/test_cases.py", "tests/test_fixes.py", "tests/test_allowances.py"),
    "tests/hostile/": ("tests/test_hostile.py", "tests/test_hostile_escapes.py"),
    "web/playground/": ("tests/playground",),
    "web/site/": ("tests/site",),
    "web/src/": ("tests/tools/view",),
}


def changed_files(commit: str | None) -> list[str]:
    """Return the files that differ from a commit, from the root of the repository."""
    new = _git("ls-files", "--others", "--exclude-standard")
    if commit is None:
        commit = "HEAD" if new or _git("diff", "--name-only", "HEAD") else "HEAD~1"
    return sorted({*_git("diff", "--name-only", commit), *new})


def _git(*arguments: str) -> list[str]:
    done = subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=True)
    return done.stdout.splitlines()


def paths_for(files: list[str]) -> list[str]:
    """Return the test files and folders to run for changed files: `["tests"]` means all."""
    found: set[str] = set()
    for file in files:
        if HARNESS.fullmatch(file):
            return ["tests"]
        if file.startswith("src/yamaro/") and file.endswith(".py"):
            found |= _tests_of_module(file)
        elif file.startswith("tests/") and file.endswith(".py"):
            found |= _tests_of_test(file)
        else:
            found.update(*(to_run for start, to_run in ELSEWHERE.items() if file.startswith(start)))
    found.update(ALWAYS)
    there = sorted(path for path in found if (ROOT / path).exists())
    return [path for path in there if not any(path.startswith(f"{one}/") for one in there)]


def _tests_of_module(file: str) -> set[str]:
    module = ".".join(Path(file).relative_to("src").with_suffix("").parts)
    module = module.removesuffix(".__init__")
    imported = _imports()
    users = [one for one, others in imported.items() if module in others]
    rooms = {_room(module), *(_room(one) for one in users if not one.endswith(".entry"))}
    found = {path for room in rooms for path in _tests_of_room(room)}
    found |= {path for path, others in _imports_of_tests().items() if module in others}
    if module.endswith(".entry"):  # the command of a tool, which nothing imports by name
        found |= {"tests/commands", f"tests/{module.split('.')[-2]}"}
    if not module.startswith(("yamaro.tools.", "yamaro.commands", "yamaro.picture")):
        found.update(CORE)
    return found


def _tests_of_test(file: str) -> set[str]:
    """Return a test file; for what tests share, those that import it."""
    if Path(file).name.startswith("test_"):
        return {file}
    if Path(file).name == "conftest.py":
        return {str(Path(file).parent)}
    module = ".".join(Path(file).with_suffix("").parts)
    return {path for path, others in _imports_of_tests().items() if module in others}


def _room(module: str) -> str:
    """Return the folder of `src/yamaro`, or of its `tools`, that a module is in, or its name."""
    parts = module.split(".")[1:]
    return "/".join(parts[: 2 if parts and parts[0] == "tools" else 1])


def _tests_of_room(room: str) -> tuple[str, ...]:
    folder, _, name = room.rpartition("/")
    here = f"tests/{folder}/" if folder else "tests/"
    return (f"tests/{room}", f"{here}test_{name}.py") if room else ()


@cache
def _imports() -> dict[str, set[str]]:
    """Return what each module of the package imports, within functions too."""
    package = ROOT / "src" / "yamaro"
    return {
        name: set(_imported(path, name))
        for path in package.rglob("*.py")
        if (name := ".".join(path.relative_to(ROOT / "src").with_suffix("").parts))
    }


@cache
def _imports_of_tests() -> dict[str, set[str]]:
    """Return what each test file imports, itself or by what tests share."""
    direct = {
        str(path.relative_to(ROOT)): set(_imported(path, ""))
        for path in TESTS.rglob("*.py")
        if "cases" not in path.parts
    }
    shared = {
        ".".join(Path(file).with_suffix("").parts): others
        for file, others in direct.items()
        if not Path(file).name.startswith("test_")
    }
    return {
        file: others.union(*(shared[one] for one in others if one in shared))
        for file, others in direct.items()
        if Path(file).name.startswith("test_")
    }


def _imported(path: Path, name: str) -> Iterator[str]:
    """Give the modules that a file imports, and `module.name` for what may be one."""
    parts = name.split(".")
    for dots, module, names in IMPORT.findall(path.read_text(encoding="utf-8")):
        imported = [one.split()[0] for one in names.strip("()").split(",") if one.strip()]
        if dots or module:
            above = parts[: len(parts) - len(dots) + (path.stem == "__init__")]
            base = ".".join([*(above if dots else ()), *filter(None, [module])])
            yield base
            yield from (f"{base}.{one}" for one in imported)
        else:
            yield from imported


if __name__ == "__main__":
    print("\n".join(paths_for(changed_files(sys.argv[1] if len(sys.argv) > 1 else None))))
