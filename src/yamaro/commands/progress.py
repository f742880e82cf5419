"""A bar on a terminal for work that takes more than a second."""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic

from ..streams import Streams

WIDTH = 30
PATIENCE, INTERVAL = 1.0, 0.1
"""Seconds before the bar appears, and between its changes."""


def progress_on(streams: Streams) -> Callable[[float], None] | None:
    """Return what takes how far long work is, from 0 to 1; None where nobody would see it."""
    bar = bar_on(streams)
    return None if bar is None else bar.show


def bar_on(streams: Streams) -> Bar | None:
    """Return a bar; None where nobody would see it."""
    return Bar(streams) if streams.is_terminal() and not streams.quiet else None


class Bar:
    """A bar in one line of a terminal, which is cleared at the end."""

    def __init__(self, streams: Streams) -> None:
        self._streams = streams
        self._began = self._shown = monotonic()
        self._is_there = False

    def show(self, part: float) -> None:
        """Show how far the work is."""
        left = (monotonic() - self._began) * (1 - part) / max(part, 0.01)
        self.show_text(part, f"{max(left, 1):.0f} s left")

    def show_text(self, part: float, text: str) -> None:
        """Show how far the work is, and a text after it."""
        now = monotonic()
        if part >= 1:
            if self._is_there:
                self._streams.put_in_line("")
                self._is_there = False
        elif now - self._began > PATIENCE and now - self._shown > INTERVAL:
            self._shown = now
            self._is_there = True
            done = round(part * WIDTH)
            bar = "#" * done + "." * (WIDTH - done)
            self._streams.put_in_line(f"[{bar}] {part:4.0%}, {text}")
