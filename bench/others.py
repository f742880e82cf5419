"""Which other arguments a robot in xacro may be built with, and what came of that.

What is looked for is independent of how `yamaro migrate` does it: regular expressions on the text
of the files. Tried are, one at a time, for each argument of a robot:

- the opposite, where it is true or false;
- each text and number that it, or a property or parameter that is given it, is compared with;
- what it has to be for each file that is there, where the name of a file is computed of it;
- other numbers where it is numbers, and another text where it is a text.

What xacro makes of the robot then is what has to come out. Arguments it has an error with are left
out.
"""

from __future__ import annotations

import contextlib
import glob
import io
import os
import re
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

_DECLARED = re.compile(r"<xacro:arg\s[^>]*?>")
_ATTRIBUTE = re.compile(r"""([\w:.-]+)\s*=\s*("[^"]*"|'[^']*')""")
_TAG = re.compile(r"<(xacro:[\w.-]+)([^<>]*)>")
_LITERAL = r"""(?:'([^']*)'|"([^"]*)"|(\d+))"""
_SIDE = r"""['"]?(?:\$\(arg\s+([\w-]+)\s*\)|([A-Za-z_]\w*))['"]?"""
_COMPARED = re.compile(rf"{_SIDE}\s*[!=]=\s*{_LITERAL}")
_LISTED = re.compile(rf"{_SIDE}\s+(?:not\s+)?in\s*[\[(]([^\])]*)[\])]")
_OPPOSITES = {"true": "false", "false": "true", "True": "False", "False": "True"}
MOST = 30
"""How many sets of arguments of a robot are tried."""


class Arguments:
    """What the files of a robot tell of its arguments."""

    def __init__(
        self, files: Iterable[str], given: Mapping[str, str], packages: Mapping[str, str]
    ) -> None:
        """Read the files."""
        self._given = given
        self._packages = packages
        self.values: dict[str, str] = {}
        self._compared: dict[str, set[str]] = {}
        self._aliases: dict[str, set[str]] = {}
        self._names: list[tuple[str, str]] = []
        for file in files:
            text = Path(file).read_text(encoding="utf-8", errors="replace")
            self._read(file, re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL))

    def _read(self, file: str, text: str) -> None:
        for tag in _DECLARED.findall(text):
            given = _attributes(tag)
            name = given.get("name", "")
            self.values.setdefault(name, self._given.get(name, given.get("default", "")))
        for tag, rest in _TAG.findall(text):
            given = _attributes(rest)
            pairs = {given.get("name", ""): given.get("value", "")}
            for name, value in (pairs if tag == "xacro:property" else given).items():
                found = re.fullmatch(r"'?\$\(arg\s+([\w-]+)\s*\)'?|\$\{(\w+)\}", value.strip())
                if found:
                    self._aliases.setdefault(found[1] or found[2], set()).add(name)
            if tag == "xacro:include":
                self._names.append((file, given.get("filename", "")))
        for argument, name, *literals in _COMPARED.findall(text):
            self._compared.setdefault(argument or name, set()).add("".join(literals))
        for argument, name, inside in _LISTED.findall(text):
            items = re.findall(_LITERAL, inside)
            self._compared.setdefault(argument or name, set()).update(map("".join, items))

    def others(self) -> list[tuple[str, str]]:
        """Return arguments with another value each."""
        found: list[tuple[str, str]] = []
        for name, value in self.values.items():
            values: set[str] = set()
            names = self._all_aliases(name)
            if value in _OPPOSITES:
                values.add(_OPPOSITES[value])
            else:
                values |= set().union(*(self._compared.get(own, set()) for own in names))
                values |= set().union(*(self._named(own, value) for own in names))
                values.add(_another(value))
            found += [(name, other) for other in sorted(values - {value})]
        return found[:MOST]

    def _all_aliases(self, name: str) -> set[str]:
        names, pending = set(), [name]
        while pending:
            own = pending.pop()
            if own not in names:
                names.add(own)
                pending += self._aliases.get(own, ())
        return names

    def _named(self, name: str, value: str) -> set[str]:
        """Return what a name may be so that an included file is there."""
        found = set()
        hole = rf"\$\(arg\s+{re.escape(name)}\s*\)|\$\{{\s*{re.escape(name)}\s*\}}"
        for file, text in self._names:
            if not re.search(hole, text):
                continue
            start = re.sub(
                r"\$\(find\s+([\w-]+)\)", lambda m: self._packages.get(m[1], "/nowhere"), text
            )
            pattern = re.sub(hole, "\0", start)
            if "$" in pattern or pattern.count("\0") != 1 or pattern == "\0":
                continue
            pattern = os.path.normpath(os.path.join(os.path.dirname(file), pattern))
            before, after = pattern.split("\0")
            for path in glob.glob(f"{glob.escape(before)}*{glob.escape(after)}"):
                found.add(path[len(before) : len(path) - len(after)])
        return found


def _another(value: str) -> str:
    """Return a value of the same kind that no file has thought of."""
    try:
        return " ".join(repr(float(number) + 0.125) for number in value.split()) or "other"
    except ValueError:
        return "other" if "$" in value else f"{value}_other"


def _attributes(tag: str) -> dict[str, str]:
    return {name: value[1:-1].replace("&quot;", '"') for name, value in _ATTRIBUTE.findall(tag)}


def expanded(path: Path, arguments: Mapping[str, str], find: Callable[[str], str]) -> str | None:
    """Return what xacro makes of a robot; None if it has an error."""
    import xacro
    import xacro.substitution_args as substitution

    substitution._eval_find = substitution._eval_dict["find"] = find
    try:
        with contextlib.redirect_stderr(io.StringIO()), contextlib.redirect_stdout(io.StringIO()):
            text = xacro.process_file(str(path), mappings=dict(arguments)).toxml()
    except Exception:
        return None
    return str(text)


class Others:
    """What came of building robots with other arguments."""

    def __init__(self) -> None:
        """Begin with none."""
        self.robots = 0
        self.tried = 0
        self.same = 0
        self.told = 0
        self.silent: list[str] = []
        self.differing: list[str] = []

    def add(self, robot: str, argument: str, result: str) -> None:
        """Count a set of arguments, which was `same`, `told` or `silent`."""
        self.tried += 1
        if result == "same":
            self.same += 1
        elif result == "told":
            self.told += 1
            self.differing.append(f"{robot} {argument}")
        else:
            self.silent.append(f"{robot} {argument}")

    def table(self) -> str:
        """Return the numbers as a table."""
        return (
            "| with other arguments | robots | sets of arguments | same | told | silent |\n"
            "|---|--:|--:|--:|--:|--:|\n"
            f"| xacro migrated | {self.robots} | {self.tried} | {self.same} | {self.told} "
            f"| {len(self.silent)} |"
        )
