"""An editor that edits at random: knows its text, and tells the server each change of it."""

from __future__ import annotations

import json
import random
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

from tests.tools.lsp.client import Client

PIECES = ["a", "🤖", "é", "\n", "\r\n", "  ", "- ", ": ", "$(", ")", "part:", "{", "}", "x y", "'"]
WORD = re.compile(r"\w+", re.ASCII)
OPTIONS = {"timeout": 60_000, "pause": 20, "trust": "jail"}
"""The settings with which a server reports what `yamaro check` does."""
SEVERITIES = {1: "error", 2: "warning"}


class Edit(NamedTuple):
    """A stretch of a text, and what replaces it."""

    start: int
    end: int
    new: str

    def applied(self, text: str) -> str:
        return text[: self.start] + self.new + text[self.end :]

    def inverse(self, text: str) -> Edit:
        """Return the edit that brings back the text this one was made of."""
        return Edit(self.start, self.start + len(self.new), text[self.start : self.end])

    def change(self, text: str) -> dict[str, Any]:
        """Return it as the protocol has it."""
        return {"range": range_in(text, self.start, self.end), "text": self.new}


def random_edit(chooser: random.Random, text: str) -> Edit:
    """Return an edit whose places an editor can name: not between \\r and \\n."""
    start = chooser.randrange(len(text) + 1)
    end = min(len(text), start + chooser.choice((0, 0, 0, 1, 2, 9, 40)))
    while text[start - 1 : start + 1] == "\r\n" and start:
        start -= 1
    while text[end - 1 : end + 1] == "\r\n":
        end += 1
    return Edit(start, end, "".join(chooser.choices(PIECES, k=chooser.randrange(3))))


def edit_of_word(chooser: random.Random, text: str) -> Edit:
    """Return an edit after which the text is mostly YAML, but means something else."""
    words = list(WORD.finditer(text))
    word, other = chooser.choice(words), chooser.choice(words)[0]
    misspelt = word[0][1:2] + word[0][:1] + word[0][2:]
    return Edit(word.start(), word.end(), chooser.choice((other, misspelt, "0", "")))


def range_in(text: str, start: int, end: int) -> dict[str, Any]:
    """Return a range as an editor counts it: in UTF-16."""

    def position(offset: int) -> dict[str, int]:
        before = text[:offset].replace("\r\n", "\n").replace("\r", "\n")
        line = before.rpartition("\n")[2]
        return {"line": before.count("\n"), "character": len(line.encode("utf-16-le")) // 2}

    return {"start": position(start), "end": position(end)}


class Finding(NamedTuple):
    """What is reported, without what the two forms of a report have no common words for."""

    file: str
    line: int
    column: int
    code: str
    severity: str
    message: str


def edit_at_random(folder: Path, main: Path, count: int, seed: int) -> int:
    """Edit a main file `count` times in one session; return how often its reports were compared.

    In rounds: some edits, of which in every other round most are taken back, so that a build gets
    to the faults of the others. At the end of each, the server's text is the editor's, and its
    diagnostics are those of the command `yamaro check`. Nothing may be logged.

    Args:
        folder: takes a copy of the folder of the main file.
        main: the file.
        count: how many edits to make.
        seed: of the random numbers.
    """
    chooser = random.Random(seed)
    folder = folder / main.parent.name
    shutil.copytree(main.parent, folder)
    path = folder / main.name
    original = text = path.read_bytes().decode()
    rounds = made = version = 0
    with Client(folder, options=OPTIONS) as client:
        uri = client.open(path, text, version=0)
        while made < count:
            rounds += 1
            text = original
            version += 1
            client.change(uri, version, [{"text": text}])
            undone: list[Edit] = []
            kept = chooser.randrange(1, 4) if rounds % 2 else count
            for number in range(min(chooser.choice((1, 20, 100, 300)), count - made)):
                is_word = number < kept < count
                edit = (edit_of_word if is_word else random_edit)(chooser, text)
                version += 1
                made += 1
                client.change(uri, version, [edit.change(text)])
                undone.append(edit.inverse(text))
                text = edit.applied(text)
            for edit in reversed(undone[kept:]):
                version += 1
                client.change(uri, version, [edit.change(text)])
                text = edit.applied(text)
            document = {"textDocument": {"uri": uri}}
            assert client.request("yamaro/viewFileText", document) == text.removeprefix("\ufeff")
            path.write_bytes(text.encode())
            wanted = checked(path)
            client.wait_for(
                lambda wanted=wanted, version=version, text=text: (
                    client.versions.get(uri) == version and shown(client, {uri: text}) == wanted
                )
            )
        assert client.logs == []
        assert client.close() == 0
    return rounds


def checked(path: Path) -> list[Finding]:
    """Return what the command `yamaro check` reports."""
    done = subprocess.run(
        [sys.executable, "-m", "yamaro", "check", "--format", "json", "--timeout", "60", str(path)],
        capture_output=True,
        check=False,
        cwd=path.parent,
    )
    assert done.returncode in (0, 1), done.stderr.decode()
    found = {
        Finding(
            str(path.parent / each["file"]) if each["file"] else str(path),
            each["line"] or 1,
            each["column"] or 1,
            each["code"],
            each["severity"],
            each["message"],
        )
        for each in json.loads(done.stdout)["diagnostics"]
    }
    return sorted(found)


def shown(client: Client, texts: dict[str, str]) -> list[Finding]:
    """Return what the server has published; `texts` are those that are not on the disk."""
    from yamaro.tools.lsp.protocol import path_of

    found = set()
    for uri, diagnostics in client.diagnostics.items():
        text = texts.get(uri) or Path(path_of(uri)).read_bytes().decode()
        lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
        for each in diagnostics:
            start = each["range"]["start"]
            units = lines[start["line"]].encode("utf-16-le")[: 2 * start["character"]]
            found.add(
                Finding(
                    path_of(uri),
                    start["line"] + 1,
                    len(units.decode("utf-16-le")) + 1,
                    each["code"],
                    SEVERITIES[each["severity"]],
                    each["message"].partition("\n")[0],
                )
            )
    return sorted(found)
