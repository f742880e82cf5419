"""Asks the language server about all names in the xacro robots of a corpus, and checks its answers.

    python bench/lsp_xacro.py [CORPUS] [--only REGEX] [--each]

CORPUS is a folder with `xacro.tsv`, as bench/robots.py reads it. Each robot is built as an editor
has it built. Then, in all its files:

- the macro of each call has a definition, and what that place holds is the tag of the macro;
- the values of each `${…}` are among those that xacro itself evaluated, and those of each property
  outside of macros are those that xacro has at its end;
- every name gets an answer to hover and references, each file an outline, links and folds.

Packages are found as in an editor whose folder is the repository: by their package.xml.
"""

from __future__ import annotations

import argparse
import csv
import os
import re
import sys
import time
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import xacro
from xacro import substitution_args

from yamaro.tools.lsp.builds import Job
from yamaro.tools.lsp.findings import settled
from yamaro.tools.lsp.hover import hover
from yamaro.tools.lsp.navigation import definition, document_links, references
from yamaro.tools.lsp.outline import document_symbols, folding_ranges
from yamaro.tools.lsp.protocol import position_at
from yamaro.tools.lsp.robot_xml import values_of
from yamaro.tools.lsp.workspace import Settings, Text, Workspace, packages_in, scan
from yamaro.xacro.symbol_table import MACRO, PROPERTY

ROOT = Path(__file__).parents[1]
UNKNOWN = "/opt/ros/unknown/share"
MOST_HOVERS = 150
"""Names of one file that are asked about, evenly spread over it."""


class Judge:
    """What xacro evaluates in one robot."""

    def __init__(self) -> None:
        self.expressions: dict[str, set[str]] = defaultdict(set)
        self.properties: dict[str, str] = {}

    def run(self, path: Path, arguments: dict[str, str], packages: dict[str, str]) -> None:
        """Expand a robot with xacro, and note each expression and the properties at the end."""

        def find(name: str) -> str:
            return packages.get(name) or f"{UNKNOWN}/{name}"

        evaluate, table = xacro.safe_eval, xacro.Table
        made: list[Any] = []

        class Noting(table):  # type: ignore[misc, valid-type]
            def __init__(self, parent: Any = None) -> None:
                super().__init__(parent)
                if parent is xacro._global_symbols:
                    made.append(self)

        def noting(expression: str, *others: Any, **more: Any) -> Any:
            value = evaluate(expression, *others, **more)
            self.expressions[expression.strip()].add(str(value))
            return value

        xacro.safe_eval, xacro.Table = noting, Noting
        substitution_args._eval_find = find
        substitution_args._eval_dict["find"] = find
        sys.stderr = open(os.devnull, "w")  # noqa: SIM115
        try:
            xacro.filestack = []
            xacro.process_file(str(path), mappings=dict(arguments))
            for symbols in made[:1]:
                for name in list(symbols):
                    try:
                        self.properties[name] = str(symbols[name])
                    except Exception:  # it has no value that way
                        continue
        finally:
            sys.stderr.close()
            sys.stderr = sys.__stderr__
            xacro.safe_eval, xacro.Table = evaluate, table


class Tally:
    def __init__(self) -> None:
        self.counts: Counter[str] = Counter()
        self.wrong: list[str] = []
        self.seconds: dict[str, list[float]] = defaultdict(list)
        self.codes: Counter[str] = Counter()

    def check(self, kind: str, is_right: bool, about: str) -> None:
        self.counts[kind] += 1
        if not is_right:
            self.wrong.append(f"{kind}: {about}")


def asked(text: Text, offset: int, workspace: Workspace) -> dict[str, Any]:
    return {
        "textDocument": {"uri": workspace.uri(text.path)},
        "position": position_at(text.source, offset, workspace.encoding),
    }


def timed(tally: Tally, kind: str, function: Any, *arguments: Any) -> Any:
    started = time.perf_counter()
    result = function(*arguments)
    tally.seconds[kind].append(time.perf_counter() - started)
    return result


def check_file(text: Text, workspace: Workspace, judge: Judge, tally: Tally) -> None:
    document = {"textDocument": {"uri": workspace.uri(text.path)}}
    for function in (document_symbols, folding_ranges, document_links):
        timed(tally, function.__name__, function, workspace, document)
    names = text.robot_names
    for span in names.computed:
        written = span.written()
        values = values_of(workspace, text, span, written)
        if values and written.startswith("${") and "$" not in written[1:]:
            known = judge.expressions.get(written[2:-1].strip())
            if known is None:  # xacro does not evaluate what nothing reads
                continue
            is_right = all(value in known or len(value) >= 2000 for value in values)
            tally.check("expression", is_right, f"{span} {list(values)} {sorted(known)}")
    for name in names.found:
        place = asked(text, name.span.start + 1, workspace)
        if name.kind == MACRO and not name.is_definition:
            found = timed(tally, "definition", definition, workspace, place)
            tally.check("macro", bool(found) and leads_to_macro(found, name.name), f"{name}")
    step = max(1, len(names.found) // MOST_HOVERS)
    for name in names.found[::step]:
        place = asked(text, name.span.start + (len(name.span.written()) > 1), workspace)
        timed(tally, "hover", hover, workspace, place)
        timed(tally, "references", references, workspace, place)


def leads_to_macro(found: list[Any], name: str) -> bool:
    from yamaro.tools.lsp.protocol import path_of

    for each in found:
        lines = Path(path_of(each["uri"])).read_text("utf-8-sig").splitlines()
        start = each["range"]["start"]
        above = " ".join(lines[max(0, start["line"] - 3) : start["line"] + 1])
        if "xacro:macro" not in above or name not in lines[start["line"]]:
            return False
    return True


def check_properties(workspace: Workspace, main: str, judge: Judge, tally: Tally) -> None:
    """Compare the properties that are defined once, outside of macros, with those of xacro."""
    found = defaultdict(list)
    for text in workspace.program_of(main):
        for name in text.robot_names.found if not text.is_yaml else ():
            if name.kind == PROPERTY and name.is_definition:
                found[name.name].append((text, name))
    for name, places in found.items():
        text, first = places[0]
        if len(places) > 1 or first.macro is not None or name not in judge.properties:
            continue
        values = list(values_of(workspace, text, first.span, name))
        if not values:  # a block, or in a branch that is not taken
            tally.counts["property without a value"] += 1
            continue
        wanted = judge.properties[name]
        is_right = values == [wanted] or (len(wanted) > 2000 and values[0] == wanted[:2000])
        tally.check("property", is_right, f"{first} {values} {wanted!r}")


def robots(corpus: Path, only: str) -> Iterator[tuple[Path, dict[str, str], dict[str, str]]]:
    with open(corpus / "xacro.tsv", encoding="utf-8") as file:
        for row in csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE):
            path = corpus / "src" / row["path"]
            given = row["args"].replace("@CORPUS@/", f"{corpus}/")
            given = given.replace("@UNKNOWN@/", f"{UNKNOWN}/")
            arguments = dict(re.findall(r"(\S+?):=(.*?)(?=\s\S+?:=|$)", given))
            pairs = (item.split("=", 1) for item in row["packages"].split(";") if item)
            packages = {name: f"{corpus}/src/{folder}" for name, folder in pairs if folder}
            if re.search(only, row["path"]):
                yield path, arguments, packages


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("corpus", nargs="?", type=Path, default=ROOT.parent / "shared" / "corpus")
    parser.add_argument("--only", default="", help="robots whose paths match")
    parser.add_argument("--each", action="store_true", help="print what is wrong")
    wanted = parser.parse_args()
    os.environ.update(ROS_VERSION="2", ROS_DISTRO="humble")
    tally, built, unbuilt = Tally(), 0, []
    found: dict[Path, tuple[dict[str, str], dict[str, frozenset[str]]]] = {}
    for path, arguments, packages in robots(wanted.corpus, wanted.only):
        repository = wanted.corpus / "src" / path.relative_to(wanted.corpus / "src").parts[0]
        workspace = Workspace()
        texts = [f"{name}:={value}" for name, value in arguments.items()]
        options = {"timeout": 60_000, "arguments": {str(path): texts}, "packages": packages}
        workspace.settings = Settings(options)
        if repository not in found:
            includes = timed(tally, "scan", scan, [str(repository)], workspace.settings)
            found[repository] = (packages_in([str(repository)]), includes)
        workspace.settings.found, includes = found[repository]
        for each, files in includes.items():
            workspace.note_includes(each, files)
        os.chdir(path.parent)
        workspace.add(path.as_uri(), 1, path.read_bytes().decode("utf-8-sig", "replace"))
        result = timed(tally, "build", Job(str(path), workspace.texts()).run, workspace.settings)
        assert result is not None
        tally.codes.update(each.code for each in settled(result))
        workspace.results[str(path)] = result
        if result.root is None:
            unbuilt.append(f"{path}: {[each.message for each in result.diagnostics][:1]}")
            continue
        workspace.good[str(path)] = result
        built += 1
        timed(tally, "values", lambda result=result: (result.values, result.robot))
        judge = Judge()
        judge.run(path, arguments, packages)
        for text in workspace.program_of(str(path)):
            if text.path.endswith((".xacro", ".urdf", ".xml")) and text.path in result.files:
                check_file(text, workspace, judge, tally)
        check_properties(workspace, str(path), judge, tally)
    print(f"{built} robots built, {len(unbuilt)} not; right: ", end="")
    wrong = Counter(each.partition(":")[0] for each in tally.wrong)
    kinds = ("macro", "expression", "property")
    print(", ".join(f"{tally.counts[k] - wrong[k]} of {tally.counts[k]} {k}" for k in kinds))
    print(f"properties without a value: {tally.counts['property without a value']}")
    for kind, seconds in sorted(tally.seconds.items()):
        ordered = sorted(seconds)
        middle, late = ordered[len(ordered) // 2], ordered[int(len(ordered) * 0.99)]
        print(
            f"{kind:16} median {middle * 1e3:7.1f} ms, 99 % {late * 1e3:7.1f} ms, "
            f"slowest {ordered[-1] * 1e3:7.1f} ms of {len(ordered):,}"
        )
    if wanted.each:
        print(*unbuilt, *tally.wrong, tally.codes.most_common(40), sep="\n")


if __name__ == "__main__":
    main()
