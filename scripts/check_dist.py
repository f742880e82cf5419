"""Checks what twine and check-wheel-contents do not: no native parts, nothing left out.

check_dist.py WHEEL SDIST
"""

import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
NATIVE = (".so", ".pyd", ".dll", ".dylib", ".a", ".o", ".pyc", ".c", ".pyx")


def main() -> None:
    """Report the first fault, or nothing."""
    wheel, sdist = sys.argv[1:]
    with zipfile.ZipFile(wheel) as archive:
        packed = set(archive.namelist())
        info = next(name for name in packed if name.endswith(".dist-info/WHEEL"))
        if b"Root-Is-Purelib: true" not in archive.read(info):
            sys.exit("the wheel is not pure")
    native = sorted(name for name in packed if name.endswith(NATIVE))
    if native:
        sys.exit(f"the wheel has native parts: {native}")
    listed = subprocess.run(
        ["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True
    )
    tracked = set(listed.stdout.splitlines())
    missing = {f"yamaro/{name[11:]}" for name in tracked if name.startswith("src/yamaro/")} - packed
    if missing:
        sys.exit(f"the wheel lacks {sorted(missing)}")
    with tarfile.open(sdist) as archive:
        sources = {name.partition("/")[2] for name in archive.getnames()}
    missing = {name for name in tracked if (ROOT / name).exists()} - sources
    if missing:
        sys.exit(f"the source archive lacks {sorted(missing)[:10]}")


if __name__ == "__main__":
    main()
