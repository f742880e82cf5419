"""Lets libFuzzer choose the inputs that are needed for all that is reached: its `-merge=1`.

    YAMARO_FUZZ_TARGET=… python -m tests.fuzz.minimise -merge=1 OUT FOLDER…

Copies to OUT those inputs of the folders that reach something the smaller ones do not. libFuzzer
starts itself anew for that, with arguments of its own; so the name of the target is no argument.
"""

from __future__ import annotations

import os
import sys

import atheris  # type: ignore

with atheris.instrument_imports(include=["yamaro"]):
    from .session import Session
    from .targets import TARGETS

from .corpus import to_text


def main(arguments: list[str]) -> None:
    session = Session(TARGETS[os.environ["YAMARO_FUZZ_TARGET"]])

    def feed(data: bytes) -> None:
        session.feed(to_text(data))

    program = f"'{sys.executable}' -m tests.fuzz.minimise"
    options = [f"-max_len={session.target.longest}", "-timeout=0", "-rss_limit_mb=4096"]
    options.append("-report_slow_units=1000000")
    atheris.Setup([program, *options, *arguments], feed)
    atheris.Fuzz()


if __name__ == "__main__":
    main(sys.argv[1:])
