"""Measures how long one variant takes when a program is converted again with other arguments.

The hexapod is loaded once, and converted with many lengths and loads. Each result is compared
first with what a conversion from the files gives. The limit is no ratio, so the time of the core is
measured, which depends less on what else the machine does.
"""

from __future__ import annotations

import os
import sys
import time
import warnings
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

from measuring import Figure, Setting, main, take_turns, timed

import yamaro

HEXAPOD = Path(__file__).parent.parent / "examples" / "hexapod" / "hexapod.yaml"


def variants(count: int) -> list[dict[str, float]]:
    """Return the variables of each variant; no two are alike."""
    return [
        {"tibia_length": 0.1 + i / 1000, "payload": i / 100, "body_length": 0.2 + i / 500}
        for i in range(count)
    ]


def convert_all(convert: Callable[..., str], designs: list[dict[str, float]]) -> float:
    """Return the seconds of a core that it takes to convert all variants."""
    return timed(lambda: [convert(**design) for design in designs], time.process_time)


def measure(setting: Setting) -> Iterator[Figure]:
    if hasattr(os, "sched_setaffinity"):  # one core, as where each has a sweep of its own
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    designs = variants(setting.sized(50, 2))
    program = yamaro.load(HEXAPOD)
    for design in designs:
        if program.convert(**design) != yamaro.convert(HEXAPOD, **design):
            sys.exit(f"the variant {design} differs from what its files give")

    works = {
        "loaded": lambda: convert_all(program.convert, designs),
        "from files": lambda: convert_all(partial(yamaro.convert, HEXAPOD), designs),
    }
    found = take_turns(works, setting)
    each = {name: seconds / len(designs) * 1e3 for name, seconds in found.items()}
    yield Figure("a variant of the hexapod, loaded once", each["loaded"], " ms", most=3)
    yield Figure("a variant of the hexapod, from its files", each["from files"], " ms")


if __name__ == "__main__":
    warnings.simplefilter("ignore", yamaro.YamaroWarning)
    main(measure, __doc__)
