"""Says at the start of a parallel run how many tests it has and about how long they take.

The time a test takes on average is that of the last such run on this machine, which pytest's cache
remembers; before the first run it is assumed.
"""

from __future__ import annotations

import time
from typing import Any

import pytest

ASSUMED_SECONDS = 0.02
"""What a test takes on average, on two cores, without coverage and without the slow ones."""
ASSUMED_FACTOR = 4
"""How much longer it takes with these two."""


class Forecast:
    """The plugin, for the process that distributes the tests."""

    def __init__(self, config: pytest.Config) -> None:
        self._config = config
        marks, is_measured = config.option.markexpr, bool(config.getoption("cov_source", None))
        self._key = f"forecast/{marks or 'all'}{' with coverage' if is_measured else ''}"
        self._assumed = ASSUMED_SECONDS if marks else ASSUMED_SECONDS * ASSUMED_FACTOR
        self._count = 0
        self._start = 0.0

    @pytest.hookimpl(optionalhook=True)
    def pytest_xdist_node_collection_finished(self, ids: list[str]) -> None:
        """Tell, when the first process knows all tests."""
        if self._count:
            return
        self._count, self._start = len(ids), time.monotonic()
        cache = getattr(self._config, "cache", None)  # there is none with -p no:cacheprovider
        seconds = self._count * float(
            cache.get(self._key, self._assumed) if cache else self._assumed
        )
        reporter: Any = self._config.pluginmanager.get_plugin("terminalreporter")
        reporter.write_line(f"{self._count:,} tests, {in_words(seconds)}")

    def pytest_sessionfinish(self, exitstatus: int) -> None:
        """Remember the time, if all tests were run."""
        has_run_all = exitstatus in (pytest.ExitCode.OK, pytest.ExitCode.TESTS_FAILED)
        cache = getattr(self._config, "cache", None)
        if has_run_all and self._count and cache and not self._config.option.maxfail:
            cache.set(self._key, (time.monotonic() - self._start) / self._count)


def in_words(seconds: float) -> str:
    """Return a time as one would say it."""
    if seconds < 90:
        return f"about {max(round(seconds / 10), 1) * 10} seconds"
    return f"about {round(seconds / 60)} minutes"
