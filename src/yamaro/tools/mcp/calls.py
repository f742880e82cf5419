"""The tools that programs call: what each takes, and the command line that it is."""

from __future__ import annotations

import json

from ...targets.table import TARGETS
from .folder import Refused

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from typing import Any

    from .folder import Folder

    Schema = dict[str, Any]

FILE: Schema = {
    "type": "string",
    "description": "the robot: a path from the folder of this server, to YAML, URDF, xacro, MJCF "
    "or SDF",
}
TEXT: Schema = {
    "type": "string",
    "description": "the robot in YAML, instead of a file",
}
ARGUMENTS: Schema = {
    "type": "object",
    "description": 'values for arguments of the robot, such as {"legs": 6, "reach": "0.9 m"}',
}
DEFAULT_FORMAT = "urdf"


class Call:
    """A call of a tool.

    Attributes:
        values: its parameters by name.
        text: what the command reads from its standard input, or None.
    """

    __slots__ = ("_folder", "text", "values")

    def __init__(self, values: Mapping[str, Any], folder: Folder) -> None:
        self.values = values
        self.text: str | None = None
        self._folder = folder

    def robot(self) -> str:
        """Return the word for the robot: a file, or the dash of a pipe.

        Raises:
            Refused: there is neither a file nor a text, or both.
        """
        if ("file" in self.values) == ("text" in self.values):
            raise Refused("give either 'file', a path from the folder, or 'text', a robot in YAML")
        if "text" in self.values:
            self.text = self.values["text"]
            return "-"
        return self._folder.file(self.values["file"])

    def file(self, name: str) -> str:
        """Return the file of a parameter, as a path from the folder."""
        return self._folder.file(self.values[name])

    def output(self, endings: tuple[str, ...] = ()) -> list[str]:
        """Return the words for the file to write, if one is asked for; see `Folder.new_file`."""
        if "output" not in self.values:
            return []
        return [f"--output={self._folder.new_file(self.values['output'], endings)}"]

    def assignments(self) -> list[str]:
        """Return the words that set arguments of the robot.

        Raises:
            Refused: the name of one cannot be that of an argument.
        """
        given = self.values.get("arguments", {})
        for name in given:
            if not name.isidentifier():
                raise Refused(f"'{name}' cannot be the name of an argument; `args` lists them")
        return [f"{name}:={json.dumps(value)}" for name, value in given.items()]

    def options(self, *names: str) -> list[str]:
        """Return the words for those of these options that are given."""
        words = []
        for name in names:
            value = self.values.get(name)
            for each in value if isinstance(value, list) else [value]:
                if each is True:
                    words.append(f"--{name}")
                elif each is not None and each is not False:
                    words.append(f"--{name}={each}")
        return words


def _build(call: Call) -> list[str]:
    form = call.values.get("format", DEFAULT_FORMAT)
    endings = TARGETS[form].endings if form in TARGETS else ()
    words = [call.robot(), f"--to={form}", *call.output(endings), *call.options("meshes", "base")]
    return [*words, *call.assignments()]


def _check(call: Call) -> list[str]:
    if call.values.get("fix") and "text" in call.values:
        raise Refused("'fix' changes files: give 'file' instead of 'text'")
    words = ["check", *call.options("fix", "strict"), call.robot()]
    return [*words, *[f"--to={each}" for each in call.values.get("formats", [])],
            *call.assignments()]  # fmt: skip


def _why(call: Call) -> list[str]:
    address = call.values["address"]
    if address.startswith("-"):
        raise Refused("an address begins with a name: elbow_joint/limit@upper")
    return ["why", call.robot(), address, *call.assignments()]


def _picture(call: Call) -> list[str]:
    joints = [f"--joints={name}={at}" for name, at in call.values.get("joints", {}).items()]
    words = call.options("view", "size", "state", "show")
    return ["picture", call.robot(), "--output=-", *words, *joints, *call.assignments()]


def _migrate(call: Call) -> list[str]:
    return ["migrate", call.file("file"), *call.output()]


class Tool:
    """A tool.

    Attributes:
        name: what it is called.
        about: what it does, as programs read it.
        schema: of its parameters, in JSON Schema.
        words: gives the command line of a call.
        answers: the exit statuses that are answers; others are errors.
        draws: whether it answers with a picture.
        writes: whether it can change files.
    """

    __slots__ = ("about", "answers", "draws", "name", "schema", "words", "writes")

    def __init__(
        self,
        name: str,
        about: str,
        properties: dict[str, Schema],
        words: Callable[[Call], list[str]],
        *,
        required: tuple[str, ...] = (),
        answers: tuple[int, ...] = (0,),
        draws: bool = False,
        writes: bool = False,
    ) -> None:
        self.name = name
        self.about = about
        self.schema: Schema = {
            "type": "object",
            "properties": properties,
            "required": list(required),
            "additionalProperties": False,
        }
        self.words = words
        self.answers = answers
        self.draws = draws
        self.writes = writes


def _text(about: str, **others: Any) -> Schema:
    return {"type": "string", "description": about, **others}


def _texts(about: str) -> Schema:
    return {"type": "array", "items": {"type": "string"}, "description": about}


ROBOT = {"file": FILE, "text": TEXT}
TOOLS = {
    tool.name: tool
    for tool in (
        Tool(
            "guide",
            "The language of robots on one page, with examples, and how to work with these tools. "
            "Read it before you write a robot.",
            {},
            lambda call: ["guide"],
        ),
        Tool(
            "build",
            "Compile a robot to URDF or another format. Gives the document, or writes it to a file "
            "of the folder with `output`; errors have a line, and say what to write instead.",
            {
                **ROBOT,
                "format": _text(f"{', '.join(TARGETS)}; {DEFAULT_FORMAT} is the default"),
                "output": _text("a file to write, as a path from the folder; moveit: a folder"),
                "meshes": _text("how meshes are named: relative (default), keep, copy or none"),
                "base": _text("'fixed' in the world, or 'free'", enum=["fixed", "free"]),
                "arguments": ARGUMENTS,
            },
            _build,
            writes=True,
        ),
        Tool(
            "check",
            "Errors, warnings and advice about a robot, each with its line and a hint. With `fix`, "
            "what can be corrected safely is corrected in the file.",
            {
                **ROBOT,
                "fix": {"type": "boolean", "description": "apply the safe fixes to the file"},
                "strict": {"type": "boolean", "description": "count warnings as errors"},
                "formats": _texts("also say what these output formats cannot hold: mjcf, sdf, …"),
                "arguments": ARGUMENTS,
            },
            _check,
            answers=(0, 1),
            writes=True,
        ),
        Tool(
            "args",
            "What can be set in a robot: its arguments with types, ranges and defaults.",
            ROBOT,
            lambda call: ["args", call.robot()],
        ),
        Tool(
            "why",
            "Where a value of the finished robot comes from: the lines of the source, and the "
            "variables in it.",
            {
                **ROBOT,
                "address": _text("elbow_joint/limit@upper, arm_link/inertial/mass@value, …"),
                "arguments": ARGUMENTS,
            },
            _why,
            required=("address",),
        ),
        Tool(
            "tree",
            "Links, joints and masses of a robot as a tree.",
            {**ROBOT, "arguments": ARGUMENTS},
            lambda call: ["tree", call.robot(), *call.assignments()],
        ),
        Tool(
            "picture",
            "A picture of a robot.",
            {
                **ROBOT,
                "view": _texts(
                    "iso (the default), front, back, left, right, top, bottom, or '30,20'"
                ),
                "size": _text("800x600 by default"),
                "state": _text("a named state of the robot"),
                "joints": {
                    "type": "object",
                    "description": 'positions by joint: {"elbow": "45deg"}',
                },
                "show": _texts("visual (the default), collision, inertia, frames, grid"),
                "arguments": ARGUMENTS,
            },
            _picture,
            draws=True,
        ),
        Tool(
            "diff",
            "What changed from one robot to another, by meaning; they can be in different formats.",
            {"first": FILE, "second": FILE},
            lambda call: ["diff", call.file("first"), call.file("second")],
            required=("first", "second"),
            answers=(0, 1),
        ),
        Tool(
            "migrate",
            "A robot in URDF, MJCF or SDF as YAML, compared with the original; a xacro robot needs "
            "`output`, a folder.",
            {"file": FILE, "output": _text("a file to write; for xacro a folder: robot/")},
            _migrate,
            required=("file",),
            writes=True,
        ),
    )
}
