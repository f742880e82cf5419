"""Compares the tables that different engines give for the same sweep of the quadruped.

One process here, four of them, and a cluster of dask with two worker processes that are reached
over TCP; it is left out if its package is not installed. The files of the tables have to be equal
byte for byte.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import sys
import tempfile
import time
from importlib.util import find_spec
from pathlib import Path

from sweeps import AXES, QUADRUPED

import yamaro

ENGINES = ("local:1", "local:4", "dask:2")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=2000, help="variants (default: 2,000)")
    parser.add_argument("--chunk", type=int, default=100, help="variants of a chunk")
    options = parser.parse_args()
    digests = {}
    for engine in ENGINES:
        if engine.startswith("dask") and find_spec("distributed") is None:
            print(f"{engine:<8} left out: distributed is not installed")
            continue
        with tempfile.TemporaryDirectory() as folder:
            began = time.monotonic()
            yamaro.sweep(
                QUADRUPED, folder, vary=AXES, samples=options.samples, chunk=options.chunk,
                engine=engine, metrics=["mass", "bounding_box"], keep="thigh_length > 0.16",
            )  # fmt: skip
            seconds = time.monotonic() - began
            parts = sorted(Path(folder, "table").iterdir())
            digest = hashlib.sha256(b"".join(path.read_bytes() for path in parts)).hexdigest()
        digests[engine] = digest
        rate = options.samples / seconds
        print(f"{engine:<8} {digest[:16]} {len(parts)} files {seconds:6.1f} s {rate:6.1f}/s")
    print(f"load {os.getloadavg()[0]:.1f}")
    if len(set(digests.values())) > 1:
        sys.exit("the tables differ")


if __name__ == "__main__":
    main()
