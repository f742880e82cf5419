"""The picture of a new robot, if one can be drawn here."""

from __future__ import annotations

import os

from ...api import build
from ...confined import Reader
from ...diagnostics import YamaroError
from ...files.loader import MemoryLoader
from ...policy import Policy
from ..picture.command import check_packages, draw
from ..picture.request import Request
from .files import PICTURE, files_of, main_file


def picture_of(name: str, folder: str) -> bytes | None:
    """Return the picture of a new package's robot, or None if nothing can be drawn here.

    Args:
        name: that of the package.
        folder: where it will be.
    """
    files = files_of(name, has_picture=False)
    texts = {os.path.join(folder, *path.split("/")): text for path, text in files.items()}
    path = os.path.join(folder, *main_file(name).split("/"))
    request = Request(PICTURE, {}, {})
    try:
        check_packages(path, request)
        robot = build(path, loader=MemoryLoader(texts))
        return draw(robot, path, request, Reader(Policy(), readable=[], name=path)).data
    except YamaroError:
        return None
