"""`yamaro sweep plot`: the columns, rows and variants of a sweep that a plot of it shows."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from typing import Any

from ...diagnostics import did_you_mean, failure_of_all
from ...options import UsageError
from ...policy import Policy
from ...terminal import shortened
from .folder import read_plan_data, show
from .table import FAILED, OK, OWN, REJECTED, read_columns, results_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Image = NDArray[np.uint8]

MOST_POINTS = 20_000
"""Rows that are drawn; of more, some at equal distances."""
MOST_STEPS, LEAST_IN_STEPS = 12, 40
"""Different numbers of an argument between which there is room for dots side by side, and how many
values there are then at least."""
NO_VALUE = "no value"
BEST, MEDIAN, WORST = "best", "median", "worst"
RANKS = (BEST, MEDIAN, WORST)


class Column:
    """A column of the table.

    Attributes:
        name: its name.
        label: the same with its unit.
        values: its values, in the order of the rows; None where there is none.
        steps: the few numbers that an argument has, in order; empty if they are many.
        is_log: whether it varies by factors.
        categories: the texts of its values, if they are not numbers.
    """

    def __init__(
        self,
        name: str,
        values: list[Any],
        unit: str = "",
        *,
        is_argument: bool = False,
        is_log: bool = False,
    ) -> None:
        self.name = name
        self._unit = unit
        self.label = f"{name} ({unit})" if unit else name
        self.values = values
        self.is_log = is_log
        known = [value for value in values if value is not None]
        self.categories: list[str] = []
        if any(isinstance(value, (bool, str)) for value in known):
            self.values = [None if value is None else _text(value) for value in values]
            self.categories = sorted({value for value in self.values if value is not None})
        numbers = [] if self.categories else sorted(set(known))
        is_stepped = is_argument and 1 < len(numbers) <= MOST_STEPS and len(known) >= LEAST_IN_STEPS
        self.steps: list[float] = numbers if is_stepped else []

    @property
    def is_constant(self) -> bool:
        """Return whether it has one value only, or none."""
        return len({value for value in self.values if value is not None}) < 2

    def shown(self, row: int) -> str:
        """Return the value in a row as a short text, with its unit."""
        value = self.values[row]
        text = f"{value:.3g}" if isinstance(value, float) else str(value)
        return f"{text} {self._unit}" if self._unit else text

    def named(self, row: int) -> str:
        """Return the same after the name of the column."""
        return f"{self.name} {self.shown(row)}"


def _text(value: object) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return str(value)


class Plotted:
    """The contents of a plot: columns, rows, and variants that stand out.

    Attributes:
        counts: how many rows have which status, and how many that are ok have no value.
        ids: the numbers of the variants.
        statuses: of the rows.
        axes: the columns of the arguments that vary.
        across: the columns along x.
        up: the columns along y.
        metric: the column by which variants are best or worst, or None.
        ranked: the rows that are best, median and worst by it.
        remarks: what is left out.
        total: how many rows the table has.
    """

    def __init__(
        self,
        folder: str,
        *,
        across: Sequence[str] = (),
        up: Sequence[str] = (),
        metric: str | None = None,
        minimize: bool = False,
    ) -> None:
        """Read the table of a sweep.

        Args:
            folder: that of the sweep.
            across: the columns along x; by default the arguments that vary.
            up: the columns along y; by default the results.
            metric: the column by which variants are best or worst.
            minimize: whether the least is the best.

        Raises:
            UsageError: there is no sweep, or nothing to plot in it, or not such a column.
            YamaroError: it cannot be read.
        """
        plan = read_plan_data(folder, folder)
        table = read_columns(folder)
        if not table.get("id"):
            raise UsageError(f"the sweep in '{folder}' has no variants yet")
        self.total = len(table["id"])
        self.remarks: list[str] = []
        self._table = table
        self._plan: dict[str, Any] = plan["axes"]
        self._units: dict[str, str] = plan["units"]
        arguments = [name for name in self._plan if name in table]
        results = results_in(list(table))
        self.axes = [self._column(name) for name in arguments]
        self.across = [self._column(name) for name in across] or self.axes
        self.up = self._results(up, results)
        self.metric = self._column(metric) if metric is not None else None
        if self.metric is not None and self.metric.categories:
            raise UsageError(f"'{metric}' is not a number, so no variant is the best")
        self.ids: list[int] = table["id"]
        self.statuses: list[str] = table["status"]
        self.counts = {name: self.statuses.count(name) for name in (OK, REJECTED, FAILED)}
        self.ranked = self._ranks(minimize) if self.metric is not None else {}
        self.rows = list(range(0, self.total, -(-self.total // MOST_POINTS)))

    def _results(self, names: Sequence[str], known: Sequence[str]) -> list[Column]:
        """Return the columns along y: those named, or all results that vary."""
        found = [self._column(name) for name in names or known]
        if not found:
            raise UsageError("the sweep has no results: run it with --metrics or --evaluate")
        if names:
            return found
        kept = [column for column in found if not column.is_constant]
        for column in found:
            if column.is_constant:
                value = next((each for each in column.values if each is not None), "empty")
                self.remarks.append(f"'{column.name}' is {value} for all, and is not shown")
        return kept or found

    def _column(self, name: str) -> Column:
        if name not in self._table:
            about_run = ("sha256_", "offset_", "size_")
            names = [each for each in self._table if not each.startswith(about_run)]
            names = [each for each in names if each not in OWN]
            hint = did_you_mean(name, names) or f"there are {', '.join(names)}"
            raise UsageError(f"the table has no column '{name}'; {hint}")
        is_log = bool(self._plan.get(name, {}).get("is_log"))
        return Column(
            name, self._table[name], self._units.get(name, ""),
            is_argument=name in self._plan, is_log=is_log,
        )  # fmt: skip

    def _ranks(self, minimize: bool) -> dict[str, int]:
        """Return the rows that are best, median and worst."""
        assert self.metric is not None
        values = self.metric.values
        rows = [
            row
            for row, status in enumerate(self.statuses)
            if status == OK and values[row] is not None
        ]
        if not rows:
            raise UsageError(f"no variant has a value of '{self.metric.name}'")
        rows.sort(key=lambda row: (values[row] if minimize else -values[row], row))
        return dict(zip(RANKS, (rows[0], rows[(len(rows) - 1) // 2], rows[-1]), strict=True))


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
    for module in ("numpy", "matplotlib"):
        if find_spec(module) is None:
            message = f"a plot needs yamaro[plot]: the Python package '{module}' is missing"
            raise failure_of_all("missing-extra", message, folder, HINT)
    plotted = Plotted(folder, across=across, up=up, metric=metric, minimize=minimize)
    robots = {}
    if plotted.ranked:
        indices = {rank: plotted.ids[row] for rank, row in plotted.ranked.items()}
        robots = pictures(folder, indices, policy)
    from .chart import chart

    return Plot(chart(plotted, robots, ending), plotted.remarks)


SIZE = "640x480"


def pictures(folder: str, indices: Mapping[str, int], policy: Policy) -> dict[str, Image]:
    """Return pictures of variants at home and at one scale, height×width×4, by the same names.

    Args:
        folder: that of the sweep.
        indices: the numbers of the variants, by any names.
        policy: how far the robot's files are trusted.

    Raises:
        YamaroError: a package is missing, a variant or a mesh of it cannot be built or drawn, or
            nothing can be drawn on this system.
    """
    from ...picture.command import check_packages
    from ...picture.request import Request

    request = Request("robot.png", {"size": SIZE, "transparent": ""}, {})
    check_packages(folder)
    import numpy as np

    from ...confined import Reader
    from ...picture.draw import Drawing
    from ...picture.stage import NoOpenGLError, fitted

    drawings, cameras = {}, {}
    try:
        for name, index in indices.items():
            build = show(folder, index, policy, has_root=True).build
            file = build.files[0] if build.files else "sweep"
            reader = Reader(policy, readable=build.finder.roots, name=file)
            drawing = drawings[name] = Drawing(build, request, reader)
            shape = request.width / request.height
            cameras[name] = fitted(request.views[0], drawing.outline(), shape)
        ways = {name: camera.position - camera.target for name, camera in cameras.items()}
        farthest = max(np.linalg.norm(way) for way in ways.values())
        for name, camera in cameras.items():
            way = ways[name]
            camera.position = camera.target + way * (farthest / np.linalg.norm(way))
        return {name: drawing.shot(cameras[name]) for name, drawing in drawings.items()}
    except NoOpenGLError as error:
        message = "the variants cannot be drawn here: OpenGL is missing, which needs no display"
        raise failure_of_all("no-opengl", message, folder, str(error)) from None
