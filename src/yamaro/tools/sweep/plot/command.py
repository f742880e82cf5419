"""What `yamaro sweep plot` does with the folder of a sweep."""

from __future__ import annotations

import os

from ....diagnostics import failure_of_all
from ....options import UsageError
from ....terminal import shortened
from .data import Plotted

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any

    from ....policy import Policy

ENDINGS = ("png", "svg", "pdf")
HINT = "pip install 'yamaro[plot]'"


class Plot:
    """A plot as the bytes of its file, with remarks."""

    __slots__ = ("data", "remarks")

    def __init__(self, data: bytes, remarks: list[str]) -> None:
        self.data = data
        self.remarks = remarks


def plot(
    folder: str,
    output: str,
    *,
    across: Sequence[str] = (),
    up: Sequence[str] = (),
    metric: str | None = None,
    minimize: bool = False,
    policy: Policy,
) -> Plot:
    """Return the plot of the sweep in a folder.

    Args:
        folder: that of the sweep.
        output: the file to write, whose ending says the format.
        across: the columns along x; by default the arguments that vary.
        up: the columns along y; by default the results.
        metric: the column by which variants are best or worst; these are drawn below the plots.
        minimize: whether the least is the best.
        policy: how far the robot's files are trusted.

    Raises:
        UsageError: there is no sweep, or not such a column.
        YamaroError: a package is missing, or a variant cannot be drawn.
    """
    ending = os.path.splitext(output)[1][1:].lower()
    if ending not in ENDINGS:
        known = ", ".join(f".{each}" for each in ENDINGS)
        raise UsageError(f"the ending of '{shortened(output)}' names no kind of plot: {known}")
    _check_packages(folder)
    plotted = Plotted(folder, across=across, up=up, metric=metric, minimize=minimize)
    robots = {}
    if plotted.ranked:
        robots = _robots(folder, plotted, policy)
    from .chart import chart

    return Plot(chart(plotted, robots, ending), plotted.remarks)


def _robots(folder: str, plotted: Plotted, policy: Policy) -> dict[str, Any]:
    """Return the pictures of the variants that stand out."""
    from ...picture.command import check_packages
    from ...picture.request import Request

    check_packages(folder, Request("robot.png", {}, {}))
    from ...picture.window import NoOpenGLError
    from .robots import pictures

    indices = {rank: plotted.ids[row] for rank, row in plotted.ranked.items()}
    try:
        return pictures(folder, indices, policy)
    except NoOpenGLError as error:
        message = "the variants cannot be drawn here: OpenGL is missing, which needs no display"
        raise failure_of_all("no-opengl", message, folder, str(error)) from None


def _check_packages(folder: str) -> None:
    from importlib.util import find_spec

    for module in ("numpy", "matplotlib"):
        if find_spec(module) is None:
            message = f"a plot needs yamaro[plot]: the Python package '{module}' is missing"
            raise failure_of_all("missing-extra", message, folder, HINT)
