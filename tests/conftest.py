"""What all tests share: a clean environment, hypothesis profiles, a forecast, --update-cases."""

from __future__ import annotations

import gc
import importlib
import os
import pkgutil
import signal
import sys
from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, settings

import yamaro
from tests import effort
from tests.forecast import Forecast

# Tests give the same result on every machine and every run; `--hypothesis-seed` explores further.
for name, examples in effort.PROFILES.items():
    settings.register_profile(
        name,
        max_examples=examples,
        derandomize=True,
        deadline=None,
        suppress_health_check=[HealthCheck.too_slow],
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

FEW = 100
"""Tests for which it does not pay to load all of Yamaro."""
# Modules that load simulators and renderers, and those that run when they are imported.
_LARGE = ("__main__", "fitting", "isaaclab", "picture", "srdf", "tools", "usd")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--update-cases",
        action="store_true",
        help="rewrite the expected output in tests/cases; each case rewritten fails once",
    )


def pytest_configure(config: pytest.Config) -> None:
    # A shell lets what it starts with `&` ignore Ctrl-C, and nohup a hang-up. Programs that tests
    # start would do the same, and never end.
    for name in ("SIGINT", "SIGHUP"):
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) == signal.SIG_IGN:
            is_interrupt = number == signal.SIGINT
            signal.signal(number, signal.default_int_handler if is_interrupt else signal.SIG_DFL)
    is_parallel = config.getoption("numprocesses", None) and not hasattr(config, "workerinput")
    if is_parallel:
        config.pluginmanager.register(Forecast(config))


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    # These load simulators and renderers, and a large process forks slowly, as for each jail.
    items.sort(key=lambda item: item.path.parent.name in ("consumers", "picture", "scene", "view"))


def pytest_collection_finish(session: pytest.Session) -> None:
    # What is loaded before a jail is begun is not loaded in each jail again, of which there are
    # thousands. Those that processes of their own begin are without it.
    if len(session.items) > FEW:
        for module in pkgutil.walk_packages(yamaro.__path__, "yamaro."):
            if not any(f".{name}" in module.name for name in _LARGE):
                importlib.import_module(module.name)
        gc.collect()
        gc.freeze()  # a hundred thousand objects of tests, which would be looked at again and again


@pytest.fixture(autouse=True)
def _no_outside_influence(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in _OUTSIDE_INFLUENCES:
        if name in os.environ:
            monkeypatch.delenv(name)
    monkeypatch.setenv("YAMARO_CACHE", "off")


@pytest.fixture
def untraced() -> Iterator[None]:
    """Keep coverage out: an exception in the midst of it could leave its lock taken."""
    tracer = sys.gettrace()
    sys.settrace(None)
    yield
    sys.settrace(tracer)
