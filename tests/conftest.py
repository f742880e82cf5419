"""What all tests share: a clean environment, hypothesis profiles and --update-cases."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, settings

# Tests give the same result on every machine and every run; `--hypothesis-seed` explores further.
settings.register_profile(
    "steady", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("steady")

# Variables that change what Yamaro finds or how it writes.
_OUTSIDE_INFLUENCES = (
    "AMENT_PREFIX_PATH",
    "CLICOLOR_FORCE",
    "FORCE_COLOR",
    "NO_COLOR",
    "PYTHONWARNINGS",
    "ROS_PACKAGE_PATH",
)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--update-cases",
        action="store_true",
        help="rewrite the expected output in tests/cases; each case rewritten fails once",
    )


@pytest.fixture(autouse=True)
def _no_outside_influence(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in _OUTSIDE_INFLUENCES:
        if name in os.environ:
            monkeypatch.delenv(name)


@pytest.fixture
def untraced() -> Iterator[None]:
    """Keep coverage out: an exception in the midst of it could leave its lock taken."""
    tracer = sys.gettrace()
    sys.settrace(None)
    yield
    sys.settrace(tracer)
