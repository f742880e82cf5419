"""Makes wheels of robots by hand, and installs them as pip does, but in no time."""

from __future__ import annotations

import zipfile
from pathlib import Path

EXPLODES = "raise SystemExit('this module was imported')\n"
"""What is in the modules of a package that nobody may import."""


def make_wheel(
    folder: Path,
    distribution: str,
    files: dict[str, str],
    *,
    entry_points: str | None = None,
    version: str = "1.0",
) -> Path:
    """Return a wheel with these files, and its entry points of the group `yamaro.packages`."""
    stem = f"{distribution.replace('-', '_')}-{version}"
    info = f"{stem}.dist-info"
    written = {
        **files,
        f"{info}/METADATA": f"Metadata-Version: 2.1\nName: {distribution}\nVersion: {version}\n",
        f"{info}/WHEEL": "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
    }
    if entry_points is not None:
        written[f"{info}/entry_points.txt"] = f"[yamaro.packages]\n{entry_points}\n"
    record = f"{info}/RECORD"
    written[record] = "".join(f"{name},,\n" for name in [*written, record])
    path = folder / f"{stem}-py3-none-any.whl"
    folder.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in written.items():
            archive.writestr(name, text)
    return path


def install(site: Path, distribution: str, files: dict[str, str], **options: str) -> None:
    """Put what a wheel holds into a folder of Python packages."""
    with zipfile.ZipFile(make_wheel(site.parent / "wheels", distribution, files, **options)) as it:
        it.extractall(site)
