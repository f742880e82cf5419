"""The HTML that a notebook shows of a `Build` or `Robot`.

A robot is a page of its own in a frame. All that comes from the robot is in it as base64, and the
page makes text of it, never markup. The frame has no origin and may load nothing, so even a fault
of the page would not let a robot act on the notebook, which can run code.
"""

from __future__ import annotations

import html
import json
import os

from ...diagnostics import YamaroError
from ...result import Build
from ...xml.tree import unshared
from ...xml.writer import write
from .. import view
from .description import describe, summary
from .files import PageFiles, packed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.robot import Robot

MOST_CHARACTERS = 8_000_000
"""Of a page, which the file of the notebook holds as long as it has that output."""
MOST_TEXT = 100_000
"""Characters of a document that is shown as text."""
HEIGHT = 420
"""Pixels of the frame; it is as wide as the notebook."""


def html_of(result: Build | Robot) -> str:
    """Return what a notebook shows of a `Build` or `Robot`; nothing is raised."""
    try:
        return _html_of(result)
    except Exception as error:  # a notebook would show a traceback in place of the result
        return _note(f"This cannot be shown: {type(error).__name__}: {error}")


def _html_of(result: Build | Robot) -> str:
    if isinstance(result, Build):
        try:
            robot = result.robot
        except (YamaroError, ValueError):  # another document, or its tree stayed in a jail
            return _text(result.xml())
    else:
        robot = result
    page = _page(robot)
    if page is None:
        return _note(
            f"The robot '{robot.name}' is too large for a notebook: {summary(robot)}. "
            "The command `yamaro view` shows it."
        )
    title = html.escape(f"Robot {robot.name}".strip())
    style = f"display: block; width: 100%; height: {HEIGHT}px; border: 0"
    frame = f'<iframe title="{title}" sandbox="allow-scripts" style="{style}" srcdoc="'
    return f'{frame}{html.escape(page)}"></iframe>'


def _page(robot: Robot) -> str | None:
    """Return the page of a robot, or None if that would be too large."""
    page = _static("notebook.html").replace("/*STYLE*/", _static("notebook.css").strip())
    page = page.replace(">CODE<", f">{packed(_static('view.js').encode())}<")
    urdf = write(unshared(robot.element))
    room = MOST_CHARACTERS - len(page) - len(packed(urdf.encode()))
    if room < 0:
        return None
    files = PageFiles(robot, room)
    data = json.dumps({**describe(robot, files), "urdf": urdf})
    page = page.replace(">FILES<", f">{json.dumps(files.packed)}<")
    return page.replace(">ROBOT<", f">{packed(data.encode())}<")


def _static(name: str) -> str:
    """Return a file of the page."""
    path = os.path.join(os.path.dirname(view.__file__), "static", name)
    with open(path, encoding="utf-8") as file:
        return file.read()


def _text(text: str) -> str:
    """Return a document that is not a robot, as text."""
    shown = html.escape(text[:MOST_TEXT])
    style = f"max-height: {HEIGHT}px; overflow: auto; white-space: pre; margin: 0"
    more = len(text) - MOST_TEXT
    note = _note(f"{more:,} more characters are not shown.") if more > 0 else ""
    return f'<pre style="{style}">{shown}</pre>{note}'


def _note(text: str) -> str:
    return f"<p>{html.escape(text)}</p>"
