"""Runs the fenced examples of a Markdown file, top to bottom, in one folder.

CONTRIBUTING.md tells writers the convention; this module is what it means.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from tests.waiting import PATIENCE

REPOSITORY = Path(__file__).parents[1]

DEFAULT_FILE = "robot.yaml"
YAML_WORDS = {"continued", "error", "fragment", "included", "not-run", "quiet", "whole"}
RUN_LANGUAGES = {"yaml", "xml", "text", "python", "console", "sh", "bash"}
# Commands that examples may run; the others, such as pip or ros2, are only shown.
COMMANDS = {"cat", "check_urdf", "cp", "diff", "echo", "grep", "head", "ls", "mkdir", "python"}
COMMANDS |= {"wc", "yamaro"}

ELISION = re.compile(r"\s*(?:…|\.\.\.|<!-- (?:…|\.\.\.) -->)\s*")
PART = re.compile(r"^[ -]*part\b", re.MULTILINE)
FENCE = re.compile(r"^(?P<indent> *)(?P<fence>`{3,}|~{3,})(?P<info>[^`\n]*)$")

# Compiles with the command's arguments; gives exit status, standard output, standard error.
Compile = Callable[[list[str]], tuple[int, str, str]]


class WrongExampleError(Exception):
    """An example that breaks the convention, or that does not do what it says."""


class Block:
    """One fenced block."""

    def __init__(self, info: str, text: str, line: int) -> None:
        words = shlex.split(info)
        self.language = words[0] if words else ""
        self.words = {word for word in words[1:] if "=" not in word}
        self.arguments = [word for word in words[1:] if ":=" in word]
        self.settings = dict(w.split("=", 1) for w in words[1:] if "=" in w and ":=" not in w)
        self.text = text
        self.line = line

    def is_run(self) -> bool:
        # What xacro makes of its blocks is for tests/test_coming_from_xacro.py.
        if "xacro" in self.words or self.settings.get("gives") == "xacro":
            return False
        return self.language in RUN_LANGUAGES and "not-run" not in self.words


def read_blocks(markdown: str) -> list[Block]:
    """Return the fenced blocks in order; fences may be indented, as in lists."""
    blocks = []
    lines = iter(enumerate(markdown.splitlines(), start=1))
    for number, line in lines:
        opening = FENCE.match(line)
        if not opening:
            continue
        indent = len(opening["indent"])
        content = []
        for _, inner in lines:
            if inner.strip().startswith(opening["fence"]) and not inner.strip("`~ "):
                break
            content.append(inner[min(indent, len(inner) - len(inner.lstrip(" "))) :] + "\n")
        blocks.append(Block(opening["info"].strip(), "".join(content), number))
    return blocks


def matches(expected: str, actual: str) -> bool:
    """Tell whether the texts agree; a line of `…` in `expected` stands for any lines."""
    pieces: list[list[str]] = [[]]
    for line in expected.splitlines():
        if ELISION.fullmatch(line):
            pieces.append([])
        else:
            pieces[-1].append(line.rstrip())
    rest = [line.rstrip() for line in actual.splitlines()]
    if len(pieces) == 1:
        return rest == pieces[0]
    first, *middle, last = pieces
    if rest[: len(first)] != first:
        return False
    rest = rest[len(first) :]
    for piece in middle:
        starts = range(len(rest) - len(piece) + 1)
        at = next((i for i in starts if rest[i : i + len(piece)] == piece), None)
        if at is None:
            return False
        rest = rest[at + len(piece) :]
    return len(rest) >= len(last) and rest[len(rest) - len(last) :] == last


def wrap(fragment: str, links: list[str]) -> str:
    """Return a whole file: a robot of the links and the fragment, or, without part, other XML."""
    written = [line for line in fragment.splitlines() if line.strip() and line.lstrip()[0] != "#"]
    dash = "- " if written and written[0].startswith("- ") else ""
    head = "".join(f"{dash}link/name={link}:\n" for link in links)
    body = "".join(
        f"  {line}" if line.strip() else line for line in (head + fragment).splitlines(True)
    )
    is_robot = links or PART.search(fragment)
    return f"robot: example\nmodel:\n{body}" if is_robot else f"fragment:\n{body}"


def content_of(xml: str, links: list[str]) -> str:
    """Return what stands inside the root element, without the leading links."""
    lines = [line[2:] for line in xml.splitlines()[2:-1]]
    return "".join(f"{line}\n" for line in lines[len(links) :])


class Document:
    """Runs the blocks of one document; `failures` tells what went wrong, with line numbers."""

    def __init__(self, path: Path, folder: Path, compile_: Compile) -> None:
        self.name = path.name
        self.folder = folder
        self.compile = compile_
        self.failures: list[str] = []
        markdown = path.read_text(encoding="utf-8")
        self.blocks = [block for block in read_blocks(markdown) if block.is_run()]
        self.last_text: dict[str, str] = {}
        if "examples/" in markdown:
            shutil.copytree(REPOSITORY / "examples", folder / "examples")

    def run(self) -> None:
        """Run every block; go on after a failure."""
        blocks = iter(self.blocks)
        pending = next(blocks, None)
        while pending is not None:
            block = pending
            expected: dict[str, Block] = {}
            pending = next(blocks, None)
            while (
                pending
                and self.is_expected_of(block, pending)
                and not expected.get(pending.language)
            ):
                expected[pending.language] = pending
                pending = next(blocks, None)
            try:
                self.run_block(block, expected)
            except WrongExampleError as wrong:
                self.failures.append(f"{self.name}:{block.line}: {wrong}")

    @staticmethod
    def is_expected_of(block: Block, following: Block) -> bool:
        """Tell whether `following` says what `block` gives."""
        if following.settings.get("file"):
            return False
        if block.language == "yaml":
            return following.language in ("xml", "text")
        return block.language == "python" and following.language == "text"

    def run_block(self, block: Block, expected: dict[str, Block]) -> None:
        file = block.settings.get("file")
        if block.language == "yaml":
            self.run_yaml(block, expected)
        elif file:
            self.save(file, block.text)
        elif block.language == "python":
            self.run_python(block, expected.get("text"))
        elif block.language == "console":
            for command, output in read_session(block.text):
                self.run_command(command, output)
        elif block.language in ("sh", "bash"):
            for command in read_script(block.text):
                self.run_command(command, None)
        else:
            raise WrongExampleError(
                f"no example before this {block.language} block gives it; if so, say 'not-run'"
            )

    def save(self, name: str, text: str) -> None:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    # --- yaml ---------------------------------------------------------------------------------

    def run_yaml(self, block: Block, expected: dict[str, Block]) -> None:
        unknown = sorted(block.words - YAML_WORDS | block.settings.keys() - {"file", "links"})
        if unknown:
            raise WrongExampleError(f"unknown words after yaml: {unknown}")
        name = block.settings.get("file", DEFAULT_FILE)
        if "whole" in block.words:
            self.compare(block.text, self.last_text.get(name, ""), f"what is in {name} by now")
            return
        text = block.text
        if "continued" in block.words:
            text = self.last_text.get(name, "") + text
        self.last_text[name] = text
        links = block.settings.get("links", "").split(",") if "links" in block.settings else []
        if "fragment" in block.words:
            text = wrap(text, links)
        self.save(name, text)
        if "included" in block.words:
            return
        quiet = ["-q"] if "quiet" in block.words else []
        status, xml, messages = self.compile([name, *block.arguments, *quiet])
        wanted_status = 1 if "error" in block.words else 0
        wanted_messages = expected["text"].text if "text" in expected else ""
        if "error" in block.words and "text" not in expected:
            raise WrongExampleError("an error has to be shown: a text block must follow")
        if status != wanted_status:
            raise WrongExampleError(f"exit status {status}, not {wanted_status}:\n{messages}")
        self.compare(wanted_messages, messages, "standard error")
        if "xml" in expected:
            if "fragment" in block.words:
                self.compare_xml(expected["xml"].text, xml, content_of(xml, links))
            else:
                self.compare_xml(expected["xml"].text, xml, xml.split("\n", 1)[1])

    def compare_xml(self, expected: str, whole: str, part: str) -> None:
        """Compare with the whole document if the example shows it whole, or with a part."""
        shows_whole = expected.lstrip().startswith(("<?xml", '<robot name="example"'))
        if shows_whole and not expected.lstrip().startswith("<?xml"):
            whole = whole.split("\n", 1)[1]
        self.compare(expected, whole if shows_whole else part, "XML")

    def compare(self, expected: str, actual: str, what: str) -> None:
        if not matches(expected, actual):
            raise WrongExampleError(f"{what} differs; expected:\n{expected}actual:\n{actual}")

    # --- programs -----------------------------------------------------------------------------

    def run_python(self, block: Block, expected: Block | None) -> None:
        run = self.start([sys.executable, "-c", block.text])
        if run.returncode != 0:
            raise WrongExampleError(f"exit status {run.returncode}:\n{run.stdout}")
        if expected is not None:
            self.compare(expected.text, run.stdout, "output")

    def run_command(self, command: str, expected: str | None) -> None:
        """Run one shell command if examples may; without `expected` it must succeed."""
        program = command.split()[0]
        if program not in COMMANDS or (program == "check_urdf" and not shutil.which(program)):
            return
        run = self.start(["sh", "-c", command])
        if expected is not None:
            self.compare(expected, run.stdout, f"output of '{command}'")
        elif run.returncode != 0:
            raise WrongExampleError(f"'{command}' gave {run.returncode}:\n{run.stdout}")

    def start(self, command: list[str]) -> subprocess.CompletedProcess[str]:
        path = os.pathsep.join([os.path.dirname(sys.executable), os.environ["PATH"]])
        return subprocess.run(
            command,
            cwd=self.folder,
            env={**os.environ, "PATH": path},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            encoding="utf-8",
            timeout=PATIENCE,
            check=False,
        )


def read_session(text: str) -> Iterator[tuple[str, str]]:
    """Return each command of a terminal session, `$ …`, with the output shown below it."""
    for part in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        command, _, output = re.sub(r"\\\n> ?", "", part).partition("\n")
        yield command, output


def read_script(text: str) -> Iterator[str]:
    """Return the commands of a shell script, one a line."""
    for line in text.replace("\\\n", " ").splitlines():
        if line.strip() and not line.startswith("#"):
            yield line
