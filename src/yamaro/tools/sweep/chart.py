"""Draws the scatter matrix of a sweep with matplotlib: arguments across, results up."""

from __future__ import annotations

import io
from collections.abc import Mapping
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from .plot import BEST, MEDIAN, NO_VALUE, WORST, Column, Plotted
from .table import FAILED, OK, REJECTED

TYPE_CHECKING = False
if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    Floats = NDArray[np.floating[Any]]
    Image = NDArray[np.uint8]

DOTS_PER_INCH = 144
MOST_TICKS = 6
CELL = (2.35, 1.65)
"""Width and height of a plot, in inches."""
LEFT, RIGHT, BOTTOM, TOP = 0.95, 0.2, 0.62, 0.62
"""Room around the plots, in inches."""
GAP = 0.16
BAR = 0.95
"""Room for the scale of colours."""
LONGEST_BAR = 3.4
PICTURE = 1.7
"""Height of the pictures of robots."""
CAPTION = 0.62
"""Room for the text below them."""
INK, FAINT, LINE = "#1f2933", "#7b8794", "#cbd2d9"
DOT = "#2f6db5"
COLOR_OF = {BEST: "#1a7f37", MEDIAN: "#bf8700", WORST: "#cf222e"}
MARKER_OF = {BEST: "^", MEDIAN: "D", WORST: "v"}
ABSENT = {REJECTED: "#9aa5b1", NO_VALUE: "#e07b00", FAILED: "#cf222e"}
"""Colours of the marks along the lower border for rows that have no place in a plot."""
LANES = {FAILED: 0.02, NO_VALUE: 0.055, REJECTED: 0.09}
"""How high the marks are, as parts of a plot."""
BINS = 14
"""Stretches of a line of medians, and the fewest values along each axis for one."""
LEAST_FOR_TREND = 40
JITTER = 0.28
ACROSS, UP = 0.7548776662466927, 0.5698402909980532
"""Steps of a sequence that fills a square evenly: see `_spread`."""
STYLE: Any = {
    "font.size": 8,
    "font.family": "DejaVu Sans",
    "axes.edgecolor": LINE,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.8,
    "xtick.color": FAINT,
    "ytick.color": FAINT,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "text.color": INK,
    "svg.hashsalt": "yamaro",
}


def chart(plotted: Plotted, robots: Mapping[str, Image], ending: str) -> bytes:
    """Return the picture of a sweep as the bytes of a file.

    Args:
        plotted: what to plot.
        robots: pictures of variants, by their rank.
        ending: of the file: png, svg or pdf.
    """
    with mpl.rc_context(STYLE):
        figure = _Chart(plotted, robots).figure
        file = io.BytesIO()
        date = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(ending)
        figure.savefig(file, format=ending, dpi=DOTS_PER_INCH, facecolor="white", metadata=date)
    return file.getvalue()


class _Chart:
    """The figure while it is drawn."""

    def __init__(self, plotted: Plotted, robots: Mapping[str, Image]) -> None:
        self._plotted = plotted
        columns, rows = len(plotted.across), len(plotted.up)
        self._bottom = BOTTOM + (PICTURE + CAPTION + 0.2 if robots else 0.0)
        width = LEFT + columns * CELL[0] + (columns - 1) * GAP + RIGHT
        width += BAR if plotted.metric is not None else 0.0
        self._size = (
            max(width, 5.2),
            self._bottom + rows * CELL[1] + (rows - 1) * GAP + TOP,
        )
        self.figure = Figure(figsize=self._size)
        FigureCanvasAgg(self.figure)
        self._colors, self._norm = self._color_scale()
        for row, up in enumerate(plotted.up):
            for column, across in enumerate(plotted.across):
                self._cell(row, column, across, up)
        self._head()
        if plotted.metric is not None:
            metric = self._plotted.metric
            assert metric is not None
            height = min(len(self._plotted.up) * (CELL[1] + GAP) - GAP, LONGEST_BAR)
            top = self._size[1] - TOP
            left = LEFT + len(self._plotted.across) * (CELL[0] + GAP)
            axes = self._axes(left, top - height, 0.13, height)
            mappable = mpl.cm.ScalarMappable(self._norm, "viridis")
            bar = self.figure.colorbar(mappable, cax=axes, extend="both")
            bar.outline.set_visible(False)
            bar.set_label(metric.label, fontsize=9)
            axes.tick_params(length=2.5, width=0.8)
        if robots:
            self._robots(robots)

    # --- the plots ---

    def _cell(self, row: int, column: int, across: Column, up: Column) -> None:
        count = len(self._plotted.up)
        left = LEFT + column * (CELL[0] + GAP)
        bottom = self._bottom + (count - 1 - row) * (CELL[1] + GAP)
        axes = self._axes(left, bottom, *CELL)
        axes.grid(color="#eef1f4", linewidth=0.8)
        axes.set_axisbelow(True)
        axes.spines[["top", "right"]].set_visible(False)
        axes.tick_params(length=2.5, width=0.8)
        _prepare(axes, across, up)
        self._dots(axes, across, up)
        if row == count - 1:
            axes.set_xlabel(across.label, fontsize=9)
        else:
            axes.tick_params(labelbottom=False)
        if column == 0:
            axes.set_ylabel(up.label, fontsize=9)
            axes.yaxis.set_label_coords(-0.66 / CELL[0], 0.5)
        else:
            axes.tick_params(labelleft=False)

    def _dots(self, axes: Axes, across: Column, up: Column) -> None:
        plotted = self._plotted
        rows = np.array(plotted.rows)
        x, y = _numbers(across, rows), _numbers(up, rows)
        there = np.isfinite(x) & np.isfinite(y)
        size = float(np.clip(14 * (500 / max(there.sum(), 1)) ** 0.5, 1.5, 14))
        colors: dict[str, Any] = {"color": DOT}
        if self._colors is not None:
            values = self._colors[rows]
            there &= np.isfinite(values)
            colors = {"c": values[there], "cmap": "viridis", "norm": self._norm}
        axes.scatter(
            _spread(across, x, ACROSS)[there], _spread(up, y, UP)[there], s=size, alpha=0.75,
            linewidths=0, rasterized=len(rows) > 2000, zorder=2, **colors,
        )  # fmt: skip
        if not across.categories and not up.categories:
            _trend(axes, x[there], y[there])
        self._absent(axes, across, rows, x, np.isfinite(y))
        for rank, number in plotted.ranked.items():
            spot = np.array([number])
            axes.plot(
                _numbers(across, spot), _numbers(up, spot), MARKER_OF[rank], markersize=7,
                color=COLOR_OF[rank], markeredgecolor="white", markeredgewidth=1, zorder=5,
                clip_on=False,
            )  # fmt: skip

    def _absent(self, axes: Axes, across: Column, rows: Any, x: Floats, has_value: Any) -> None:
        """Mark rows without a value along the lower border."""
        statuses = np.array(self._plotted.statuses)[rows]
        groups = {
            REJECTED: statuses == REJECTED,
            NO_VALUE: (statuses == OK) & ~has_value,
            FAILED: statuses == FAILED,
        }
        places = _spread(across, x, ACROSS)
        for name, chosen in groups.items():
            chosen = chosen & np.isfinite(places)
            if not chosen.any():
                continue
            axes.plot(
                places[chosen], np.full(chosen.sum(), LANES[name]), "|", color=ABSENT[name],
                markersize=3.5, markeredgewidth=0.8, alpha=0.8, zorder=3, clip_on=False,
                transform=axes.get_xaxis_transform(),
            )  # fmt: skip

    # --- around them ---

    def _head(self) -> None:
        plotted = self._plotted
        shown = f", {len(plotted.rows):,} shown" if len(plotted.rows) < plotted.total else ""
        names = {OK: "ok", REJECTED: "rejected", FAILED: "failed"}
        handles = [_handle("o", DOT, f"{plotted.counts[OK]:,} {names[OK]}")]
        if plotted.metric is not None:
            handles[0].set_color("#31688e")
        values = [column.values for column in plotted.up]
        lacks = sum(
            status == OK and any(column[row] is None for column in values)
            for row, status in enumerate(plotted.statuses)
        )
        for name, count in ((NO_VALUE, lacks), *list(plotted.counts.items())[1:]):
            if count:
                handles.append(_handle("|", ABSENT[name], f"{count:,} {names.get(name, name)}"))
        y = 1 - 0.2 / self._size[1]
        title = f"{plotted.total:,} variants{shown}"
        self.figure.text(
            LEFT / self._size[0], y, title, ha="left", va="center", fontsize=11, weight="bold"
        )
        self.figure.legend(
            handles=handles, loc="center right", ncols=len(handles), frameon=False, fontsize=8,
            bbox_to_anchor=(1 - 0.1 / self._size[0], y), handletextpad=0.1, columnspacing=1.0,
        )  # fmt: skip

    def _color_scale(self) -> tuple[Floats | None, Normalize | None]:
        """Return the number of each row that its colour says, and how."""
        metric = self._plotted.metric
        if metric is None:
            return None, None
        values = np.array([np.nan if value is None else value for value in metric.values], float)
        low, high = np.nanquantile(values, [0.02, 0.98])
        if low == high:
            high = low + 1.0
        is_wide = low > 0 and high > 20 * low
        return values, LogNorm(low, high) if is_wide else Normalize(low, high)

    def _robots(self, robots: Mapping[str, Image]) -> None:
        """Draw the variants that stand out, below the plots."""
        plotted = self._plotted
        assert plotted.metric is not None
        room = (self._size[0] - RIGHT) / len(robots)
        for place, (rank, image) in enumerate(robots.items()):
            row = plotted.ranked[rank]
            shape = image.shape[0] / image.shape[1]
            width = min(room, PICTURE / shape)
            left = place * room + (room - width) / 2 + RIGHT / 2
            axes = self._axes(left, CAPTION, width, width * shape)
            axes.imshow(image)
            axes.set_axis_off()
            value = f"{rank}: {plotted.metric.shown(row)}"
            axes.set_title(value, fontsize=9, weight="bold", color=COLOR_OF[rank], pad=3)
            words = [f"variant {plotted.ids[row]}", *(each.named(row) for each in plotted.axes[:2])]
            self.figure.text(
                (left + width / 2) / self._size[0], (CAPTION - 0.04) / self._size[1],
                "\n".join(words), ha="center", va="top", fontsize=7.5, color=FAINT,
                linespacing=1.25,
            )  # fmt: skip

    def _axes(self, left: float, bottom: float, width: float, height: float) -> Axes:
        """Return axes at a place in inches."""
        w, h = self._size
        return self.figure.add_axes((left / w, bottom / h, width / w, height / h))


def _prepare(axes: Axes, across: Column, up: Column) -> None:
    """Set the scales, with room for the marks at the lower border."""
    for column, axis in ((across, axes.xaxis), (up, axes.yaxis)):
        if column.categories:
            axis.set_ticks(range(len(column.categories)), column.categories)
            continue
        steps = column.steps
        if 0 < len(steps) <= MOST_TICKS:
            axis.set_ticks(steps)
        elif not column.is_log:
            axis.set_major_locator(MaxNLocator(5 if column is across else 4))
    low, high = _span(across)
    if across.is_log and low > 0:
        axes.set_xscale("log")
        margin = (high / low) ** 0.04
        axes.set_xlim(low / margin, high * margin)
    else:
        axes.set_xlim(low - 0.04 * (high - low), high + 0.04 * (high - low))
    low, high = _span(up)
    axes.set_ylim(low - 0.18 * (high - low), high + 0.06 * (high - low))


def _span(column: Column) -> tuple[float, float]:
    """Return the lowest and the highest place of a column."""
    if column.categories:
        return -0.4, len(column.categories) - 0.6
    steps = column.steps
    if steps:
        return steps[0] - 0.4 * (steps[1] - steps[0]), steps[-1] + 0.4 * (steps[-1] - steps[-2])
    known = [value for value in column.values if value is not None] or [0.0]
    low, high = min(known), max(known)
    return (low, high) if high > low else (low - 0.5, high + 0.5)


def _numbers(column: Column, rows: Any) -> Floats:
    """Return the values of rows as numbers, of categories their places; NaN where there is none."""
    values = column.values
    if column.categories:
        place = {name: index for index, name in enumerate(column.categories)}
        return np.array(
            [np.nan if values[row] is None else place[values[row]] for row in rows], float
        )
    return np.array([np.nan if values[row] is None else values[row] for row in rows], float)


def _spread(column: Column, numbers: Floats, step: float) -> Floats:
    """Return categories, or few numbers of an argument, moved a little to both sides.

    So dots do not cover each other. The moves are those of a quasirandom sequence: even, and always
    the same (M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018).
    """
    room = 1.0
    if not column.categories:
        if not column.steps:
            return numbers
        room = float(np.diff(column.steps).min())
    return numbers + JITTER * room * (2 * (np.arange(len(numbers)) * step % 1) - 1)


def _trend(axes: Axes, x: Floats, y: Floats) -> None:
    """Draw the medians of stretches with equally many dots."""
    if len(x) < LEAST_FOR_TREND or min(len(np.unique(x)), len(np.unique(y))) < BINS:
        return
    order = np.argsort(x, kind="stable")
    count = min(BINS, len(x) // 8)
    parts = np.array_split(order, count)
    middle = [np.median(x[part]) for part in parts]
    median = [np.median(y[part]) for part in parts]
    axes.plot(middle, median, color="white", linewidth=3, zorder=3, alpha=0.8)
    axes.plot(middle, median, color=INK, linewidth=1.2, zorder=4, alpha=0.85)


def _handle(marker: str, color: str, label: str) -> Line2D:
    return Line2D([], [], marker=marker, color=color, linestyle="", markersize=5, label=label)
