"""Measures what tools keep of robots that they convert, and writes docs/scoreboard.md and .csv.

    scripts/scoreboard [--only REGEX] [--again]

`--only` takes robots and tools whose names it finds, and prints the result instead of writing the
page. Results are kept in build/scoreboard, those of each tool for its version and command, those
of Yamaro for its source; `--again` forgets them.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from . import judging, page, read_mjcf, read_sdf, read_urdf, read_usd
from .facts import Facts
from .robots import ROBOTS, Missing, Robot, Source, brought
from .tools import TOOLS, Route, Tool

ROOT = Path(__file__).parents[2]
CACHE = ROOT / "build" / "scoreboard"
ENVIRONMENTS = ROOT / ".venv-scoreboard" / "tools"
PAGE = ROOT / "docs" / "scoreboard.md"
SECONDS = 300
"""Of processor time, which a busy machine does not change; with 12 times as much on the clock."""
TOO_LONG = f"no result after {SECONDS} s"
READERS = {
    "urdf": read_urdf.read,
    "mjcf": read_mjcf.read,
    "sdf": read_sdf.read,
    "usd": read_usd.read,
}


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", default="", help="robots and tools with this regular expression")
    parser.add_argument("--again", action="store_true", help="measure what was measured before")
    options = parser.parse_args()
    wanted = re.compile(options.only)
    if options.again:
        shutil.rmtree(CACHE / "results", ignore_errors=True)
    chosen = [each for each in TOOLS if wanted.search(each.name)] or list(TOOLS)
    robots = [each for each in ROBOTS if wanted.search(each.name)] or list(ROBOTS)
    missing: dict[str, str] = {}
    for tool in chosen:
        fault = installed(tool)
        if fault:
            missing[tool.name] = fault
    rows: list[page.Row] = []
    for number, robot in enumerate(robots, 1):
        try:
            source = brought(robot, CACHE)
        except Missing as error:
            missing[robot.name] = str(error)
            continue
        say(f"[{number}/{len(robots)}] {robot.name}")
        rows += measured(source, [each for each in chosen if each.name not in missing])
    for name, why in missing.items():
        say(f"missing: {name}: {why}")
    if options.only:
        print(page.details(rows))
    elif missing:
        sys.exit("the page is not written, since it would be incomplete")
    else:
        PAGE.write_text(page.written(rows), encoding="utf-8")
        PAGE.with_suffix(".csv").write_text(page.listed(rows), encoding="utf-8")
        say(f"wrote {PAGE.relative_to(ROOT)}")


def say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def installed(tool: Tool) -> str:
    """Make the environment of a tool, if it is not there; return why it cannot be made, or ""."""
    if not tool.packages:
        program = tool.routes[0].command.split()[0]
        return "" if shutil.which(program) else f"no command '{program}' (scripts/setup-judges)"
    folder = ENVIRONMENTS / tool.name
    stamp = folder / "packages.txt"
    wanted = "\n".join((*tool.packages, tool.until))
    if stamp.exists() and stamp.read_text(encoding="utf-8") == wanted:
        return ""
    say(f"installing {tool.name} {tool.version}")
    python = f"{sys.version_info.major}.{sys.version_info.minor}"
    uv = shutil.which("uv") or str(Path(sys.executable).parent / "uv")
    for command in (
        [uv, "venv", "-q", "--clear", "--python", python, str(folder)],
        [uv, "pip", "install", "-q", "--python", str(folder / "bin" / "python"), *tool.packages],
    ):
        environment = {**os.environ, **({"UV_EXCLUDE_NEWER": tool.until} if tool.until else {})}
        done = subprocess.run(command, capture_output=True, text=True, env=environment)
        if done.returncode:
            return first_line(done.stderr, folder)
    stamp.write_text(wanted, encoding="utf-8")
    return ""


def measured(source: Source, tools: list[Tool]) -> Iterator[page.Row]:
    """Yield what each tool keeps of a robot."""
    robot = source.robot
    facts: Facts | None = None
    for tool in tools:
        for route in tool.routes:
            if not is_taken(robot, tool, route):
                continue
            file = CACHE / "results" / f"{key(source, tool, route)}.json"
            if not file.exists():
                facts = facts or READERS[robot.read_as](source.path)
                started = time.monotonic()
                result = tried(source, facts, tool, route)
                say(f"    {tool.name} → {route.makes}: {time.monotonic() - started:.0f} s")
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(json.dumps(result), encoding="utf-8")
            result = json.loads(file.read_text(encoding="utf-8"))
            shares = {name: judging.Share(*each) for name, each in result["shares"].items()}
            yield page.Row(robot, tool, route, shares, result["message"])


def is_taken(robot: Robot, tool: Tool, route: Route) -> bool:
    """Return whether a robot is converted so: xacro itself if a tool reads it, else expanded."""
    if robot.format == "xacro" and any(each.takes == "xacro" for each in tool.routes):
        return route.takes == "xacro"
    return route.takes == robot.read_as


def key(source: Source, tool: Tool, route: Route) -> str:
    """Return the name of what was measured: it changes with all that the result depends on."""
    digest = hashlib.sha256()
    for part in (source.robot, tool.name, tool.version, tool.packages, tool.until, route):
        digest.update(repr(part).encode())
    own = ("facts.py", "judging.py", "read_mjcf.py", "read_sdf.py", "read_urdf.py", "read_usd.py")
    files = [source.path, *(Path(__file__).parent / each for each in own)]
    if tool.name == "Yamaro":
        files += (ROOT / "src").rglob("*.py")
    for file in sorted(files):
        digest.update(file.read_bytes())
    return digest.hexdigest()[:32]


def tried(source: Source, facts: Facts, tool: Tool, route: Route) -> dict[str, Any]:
    """Convert a robot in a folder of its own, and judge what comes out, in another process."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary) / "work"
        shutil.copytree(source.folder, folder)
        message = converted(source, tool, route, folder, base_of(facts))
        found = sorted(folder.glob(route.result))
        if not found or message == TOO_LONG:
            return {"shares": {}, "message": message or "wrote nothing"}
        answer = apart(facts, route.makes, found[0])
        if "message" in answer:
            answer["message"] = shortened(f"{READER[route.makes]}: {answer['message']}", folder)
        return {"shares": {}, "message": "", **answer}


READER = {"urdf": "pinocchio", "mjcf": "MuJoCo", "sdf": "Drake", "usd": "OpenUSD"}


def base_of(facts: Facts) -> str:
    """Return the first link that is not the world, which some tools want to be told."""
    return next((name for name in facts.frames if name != "world"), facts.root)


def converted(source: Source, tool: Tool, route: Route, folder: Path, base: str) -> str:
    """Run a tool; return its message if it failed."""
    original = route.takes == "xacro"
    packages = source.packages.items() if original else ()
    command = route.command.format(
        base=base,
        file=source.original if original else source.path.name,
        arguments=shlex.join(f"{name}:={each}" for name, each in source.robot.arguments.items()),
        packages=shlex.join(a for n, at in packages for a in ("--package", f"{n}:={at}")),
        paths=shlex.join(a for n, at in packages for a in ("-p", f"{n}:={at}")),
    )
    own = ENVIRONMENTS / tool.name / "bin" if tool.packages else Path(sys.executable).parent
    environment = {
        **os.environ,
        "PATH": f"{own}{os.pathsep}{os.environ['PATH']}",
        "HOME": str(folder.parent),
        "ROS_VERSION": "2",
        "ROS_DISTRO": "humble",
    }
    try:
        done = subprocess.run(
            ["sh", "-c", f"ulimit -t {SECONDS}; {command}"],
            cwd=folder, env=environment, timeout=12 * SECONDS,
            capture_output=True, text=True, errors="replace", stdin=subprocess.DEVNULL,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return TOO_LONG
    if done.returncode == 0:
        return ""
    if abs(done.returncode) % 128 in (signal.SIGXCPU, signal.SIGKILL):
        return TOO_LONG
    return first_line(done.stderr or done.stdout, folder) or f"exit status {done.returncode}"


def first_line(text: str, folder: Path) -> str:
    """Return the line of a program's errors that says what is wrong."""
    lines = [re.sub(r"\x1b\[[0-9;]*m", "", line).strip() for line in text.splitlines()]
    lines = [line for line in lines if line and not line.startswith("= hint")]
    errors = [
        line for line in lines if re.match(r"error\[|\[?(\w+\.)*\w*(Error|Exception)\b", line)
    ]
    return shortened((errors or lines or [""])[-1], folder)


def shortened(text: str, folder: Path) -> str:
    """Return a message on one line, without the folders of this machine."""
    text = " ".join(text.replace(f"{folder}/", "").replace(str(folder), ".").split())
    text = re.sub(r"(/[\w.@+-]+){2,}/(?=[\w.@+-]+)", "…/", text)
    return text if len(text) <= 160 else f"{text[:157]}…"


def apart(facts: Facts, format: str, result: Path) -> dict[str, Any]:
    """Read and judge a result in another process: some readers end theirs on what they refuse."""
    reader, writer = os.pipe()
    sys.stdout.flush()
    child = os.fork()
    if not child:
        try:
            os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # what urdfdom says
            os.chdir(result.parent)
            answer: dict[str, Any] = {"shares": judging.compared(facts, READERS[format](result))}
        except Exception as error:
            lines = str(error).strip().splitlines() or [repr(error)]
            answer = {"message": " ".join(lines[:3])}
        os.write(writer, json.dumps(answer).encode())
        os._exit(0)
    os.close(writer)
    with open(reader, "rb") as file:
        data = file.read()
    os.waitpid(child, 0)
    answer = json.loads(data) if data else {"message": "ended the process that reads it"}
    return dict(answer)


if __name__ == "__main__":
    main()
