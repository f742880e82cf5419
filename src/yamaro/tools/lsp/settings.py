"""The settings of a user's editor, which come with the `initialize` request and nowhere else.

A workspace cannot change them: what decides how far files are trusted is never read from a folder.
"""

from __future__ import annotations

import math
import os

from ...policy import SAFE, Policy

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from .wire import Json

PAUSE = 0.15
"""Seconds without an edit after which a file is built."""
SECONDS = 2.0
"""The time that a build may take."""
LONGEST = 3600.0


class Settings:
    """What a user has set.

    Attributes:
        may_jail: whether code that safe mode refuses is run in a jail.
        pause: seconds to wait for another edit before a build.
        timeout: seconds that a build may take.
        has_hints: whether to show inlay hints.
        packages: folders of ROS packages by their names.
        arguments: for names of files, what is passed to them: `name:=value`.
    """

    __slots__ = ("arguments", "has_hints", "may_jail", "packages", "pause", "timeout")

    def __init__(self, options: Json = None) -> None:
        """Read the `initializationOptions`; what makes no sense keeps its default."""
        options = options if isinstance(options, dict) else {}
        self.may_jail = options.get("trust") == "jail"
        self.pause = _seconds(options.get("pause"), PAUSE)
        self.timeout = max(_seconds(options.get("timeout"), SECONDS), 0.01)
        self.has_hints = options.get("inlayHints") is True
        packages = options.get("packages")
        self.packages = {
            str(name): os.path.expanduser(folder)
            for name, folder in (packages.items() if isinstance(packages, dict) else ())
            if isinstance(folder, str)
        }
        arguments = options.get("arguments")
        self.arguments = {
            str(name): [text for text in texts if isinstance(text, str)]
            for name, texts in (arguments.items() if isinstance(arguments, dict) else ())
            if isinstance(texts, list)
        }

    def policy(self, is_abandoned: Callable[[], bool]) -> Policy:
        """Return the policy for a build that is given up as soon as `is_abandoned` says so."""
        if not self.may_jail:
            policy = Policy(SAFE, timeout=self.timeout)
        else:
            policy = Policy.looking(timeout=self.timeout)
            assert policy.fallback is not None
            policy.fallback.is_abandoned = is_abandoned
        policy.is_abandoned = is_abandoned
        return policy

    def arguments_of(self, path: str) -> list[str]:
        """Return what is passed to a main file."""
        for name, texts in self.arguments.items():
            if path == name or path.endswith(os.sep + name.replace("/", os.sep)):
                return texts
        return []


def _seconds(value: Json, default: float) -> float:
    """Return a number of milliseconds in seconds, or the default, which is in seconds."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return default
    return min(value / 1000, LONGEST) if math.isfinite(value) and value >= 0 else default
