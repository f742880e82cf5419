"""Python's garbage collector, asked to look less often while a conversion runs.

A conversion makes many objects that live to its end. The collector would go through them again
and again, and find nothing: that is more than half of the time of a large file.
"""

from __future__ import annotations

import _thread
import gc
import os

THRESHOLD = 4_000_000
"""New objects after which the collector runs anyway, since users' Python may leave cycles.

A robot of 150,000 lines makes 3 million, in 400 MB.
"""

_lock = _thread.allocate_lock()  # the thresholds are set for the whole process
if hasattr(os, "register_at_fork"):  # a thread that holds it is not in the forked process
    os.register_at_fork(after_in_child=_lock._at_fork_reinit)  # type: ignore[attr-defined]
_found: list[tuple[int, int, int]] = []  # the thresholds before each that runs


class RareCollection:
    """While any of these is entered, the collector looks seldom; they may nest, in any thread.

    A collector that is switched off stays off, and one that looks even less often is let be.
    """

    __slots__ = ()

    def __enter__(self) -> None:
        with _lock:
            _found.append(gc.get_threshold())
            if 0 < _found[-1][0] < THRESHOLD:
                gc.set_threshold(THRESHOLD)

    def __exit__(self, *raised: object) -> None:
        """Give back the thresholds that were found, once nothing runs that needs ours."""
        with _lock:
            before = _found.pop()  # at last, what the first one found
            if not _found and gc.get_threshold()[0] == THRESHOLD:
                gc.set_threshold(*before)
