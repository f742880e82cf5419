"""The server: each call of a tool is a run of the command, confined to the folder.

A process of its own for each call keeps the server alive whatever a robot does, and gives what the
command gives to people.
"""

from __future__ import annotations

import base64
import os
import sys
from difflib import get_close_matches
from functools import partial

import anyio
from jsonschema import Draft202012Validator
from mcp.server import Server
from mcp.server.stdio import stdio_server
from mcp.types import (
    CallToolResult,
    ImageContent,
    ListResourcesResult,
    ListToolsResult,
    ReadResourceResult,
    Resource,
    TextContent,
    TextResourceContents,
    ToolAnnotations,
)
from mcp.types import (
    Tool as ToolDescription,
)

from ... import __version__
from .calls import TOOLS, Call, Tool
from .folder import Folder, Refused

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping
    from subprocess import CompletedProcess
    from typing import Any

GUIDE = "yamaro://guide"
"""The address of the guide, as a resource."""
LONGEST = 40_000
"""Characters of an answer; what is longer is cut, and the answer says so."""
SLACK = 60.0
"""Seconds that a command has beyond its own time-out, before it is ended."""
COMMAND = (
    "import os, sys; sys.path[:] = [path for path in sys.path if path not in ('', os.getcwd())]; "
    "from yamaro.commands.main import main; sys.exit(main())"
)
"""Runs the command in a folder from which nothing is imported."""
INSTRUCTIONS = (
    "Yamaro compiles robots, in YAML, URDF, xacro, MJCF or SDF, to the formats of simulators and "
    "planners. Call `guide` before you write a robot in YAML. Then `check` what you wrote: each "
    "message has a line and says what to write instead. `picture` shows the robot."
)


class Commands:
    """Runs the command in a folder.

    Attributes:
        folder: the folder.
    """

    __slots__ = ("_options", "folder")

    def __init__(self, folder: str, options: list[str]) -> None:
        """Take the folder and the options that confine each run to it."""
        self.folder = Folder(folder)
        self._options = options

    async def call(self, tool: Tool, values: Mapping[str, Any]) -> CallToolResult:
        """Return the answer to a call."""
        try:
            known = tool.schema["properties"]
            for name in values:
                if name not in known:
                    near = get_close_matches(name, known, 1)
                    hint = f"did you mean '{near[0]}'?" if near else f"it takes {', '.join(known)}"
                    raise Refused(f"'{tool.name}' has no parameter '{name}': {hint}")
            for name in tool.schema["required"]:
                if name not in values:
                    raise Refused(f"'{tool.name}' needs '{name}': {known[name]['description']}")
            for error in Draft202012Validator(tool.schema).iter_errors(dict(values)):
                name = str(error.path[0]) if error.path else tool.name
                raise Refused(f"'{name}': {error.message}")
            call = Call(values, self.folder)
            words = tool.words(call)
        except Refused as error:
            return _answer([TextContent(text=str(error))], is_error=True)
        done = await self.run(words, call.text)
        said = done.stderr.decode("utf-8", "replace")
        is_error = done.returncode not in tool.answers
        if tool.draws and not is_error:
            picture = base64.b64encode(done.stdout).decode("ascii")
            shown: list[TextContent | ImageContent] = [
                ImageContent(data=picture, mime_type="image/png")
            ]
            return _answer([*shown, *([TextContent(text=said)] if said else [])])
        text = said + _shortened(done.stdout.decode("utf-8", "replace"))
        if "output" in values and not is_error:
            text += f"{values['output']} is written\n"
        return _answer([TextContent(text=text or "nothing to report")], is_error=is_error)

    async def run(self, words: list[str], text: str | None = None) -> CompletedProcess[bytes]:
        """Run the command with these words, and with a text on its standard input."""
        takes_options = words[0] not in ("guide",)
        options = self._options if takes_options else []
        if words[0] == "args":  # which reads, and runs nothing
            options = [each for each in options if each not in ("--safe", "--jail")]
        command = [sys.executable, "-c", COMMAND, *words, *options]
        return await anyio.run_process(
            command,
            input=(text or "").encode(),
            check=False,
            cwd=self.folder.path,
            env={**os.environ, "PYTHONIOENCODING": "utf-8", "PYTHONUTF8": "1"},
        )


def _answer(
    content: list[TextContent | ImageContent] | list[TextContent], *, is_error: bool = False
) -> CallToolResult:
    return CallToolResult(content=list(content), is_error=is_error)


def _shortened(text: str) -> str:
    """Return a text, or its beginning with a note of what is missing."""
    if len(text) <= LONGEST:
        return text
    cut = text.rfind("\n", 0, LONGEST) + 1 or LONGEST
    return (
        f"{text[:cut]}… {len(text) - cut:,} more characters are left out here; give 'output' to "
        "write all to a file\n"
    )


def serve(folder: str, options: list[str], descriptor: int) -> int:
    """Serve the folder on standard input and a descriptor until that is closed."""
    server = make_server(Commands(folder, options))
    anyio.run(partial(_serve, server, descriptor))
    return 0


def make_server(commands: Commands) -> Server[Any]:
    """Return the server of a folder."""

    async def list_tools(context: object, params: object) -> ListToolsResult:
        return ListToolsResult(
            tools=[
                ToolDescription(
                    name=tool.name,
                    description=tool.about,
                    input_schema=tool.schema,
                    annotations=ToolAnnotations(
                        read_only_hint=not tool.writes, open_world_hint=False
                    ),
                )
                for tool in TOOLS.values()
            ]
        )

    async def call_tool(context: object, params: Any) -> CallToolResult:
        tool = TOOLS.get(params.name)
        if tool is None:
            text = f"there is no tool '{params.name}'; there are {', '.join(TOOLS)}"
            return _answer([TextContent(text=text)], is_error=True)
        return await commands.call(tool, params.arguments or {})

    async def list_resources(context: object, params: object) -> ListResourcesResult:
        guide = Resource(
            name="guide", uri=GUIDE, description=TOOLS["guide"].about, mime_type="text/markdown"
        )
        return ListResourcesResult(resources=[guide])

    async def read_resource(context: object, params: Any) -> ReadResourceResult:
        if str(params.uri) != GUIDE:
            raise ValueError(f"there is no resource {params.uri}; there is {GUIDE}")
        text = (await commands.run(["guide"])).stdout.decode()
        content = TextResourceContents(uri=GUIDE, mime_type="text/markdown", text=text)
        return ReadResourceResult(contents=[content])

    return Server(
        "yamaro",
        version=__version__,
        instructions=INSTRUCTIONS,
        on_list_tools=list_tools,
        on_call_tool=call_tool,
        on_list_resources=list_resources,
        on_read_resource=read_resource,
    )


async def _serve(server: Server[Any], descriptor: int) -> None:
    reader = os.fdopen(os.dup(sys.__stdin__.fileno() if sys.__stdin__ else 0), encoding="utf-8")
    writer = os.fdopen(os.dup(descriptor), "w", encoding="utf-8", newline="\n")
    async with stdio_server(anyio.wrap_file(reader), anyio.wrap_file(writer)) as (
        incoming,
        outgoing,
    ):
        await server.run(incoming, outgoing, server.create_initialization_options())
