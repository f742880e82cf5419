"""The page in the package is what its sources in web/ give."""

from __future__ import annotations

import hashlib
import re
import subprocess

import pytest

from tests.tools.view.conftest import ROOT
from tests.waiting import PATIENCE

WEB = ROOT / "web"
STATIC = ROOT / "src" / "yamaro" / "tools" / "view" / "static"
CANNOT_BE_TOLD = 3


def test_the_bundle_was_made_after_the_last_change_of_its_sources() -> None:
    others = ("build.mjs", "colours.css", "icon.svg", "index.html", "notebook.css", "notebook.html",
              "package-lock.json", "view.css")  # fmt: skip
    names = sorted([f"src/{path.name}" for path in (WEB / "src").iterdir()] + list(others))
    digest = hashlib.sha256()
    for name in names:
        digest.update(name.encode() + b"\0" + (WEB / name).read_bytes())
    told = re.search(r"Sources: (\w+)", (STATIC / "view.js").read_text(encoding="utf-8")[:300])
    assert told is not None and told[1] == digest.hexdigest(), "run scripts/web"


def test_the_bundle_is_what_its_sources_give() -> None:
    run = subprocess.run(
        ["scripts/web", "--check"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    if run.returncode == CANNOT_BE_TOLD:
        pytest.skip(run.stderr.strip())
    assert run.returncode == 0, run.stderr


def test_the_packages_in_the_bundle_are_named_with_their_licences() -> None:
    text = (STATIC / "THIRD-PARTY.txt").read_text(encoding="utf-8")
    for words in ("three 0.", "(MIT)", "The MIT License", "urdf-loader 0.", "(Apache-2.0)",
                  "California Institute of Technology", "Version 2.0, January 2004"):  # fmt: skip
        assert words in text
    assert text.count("-" * 78) == 2  # one for each package


def test_versions_are_pinned_and_no_registry_is_named() -> None:
    assert '"^' not in (WEB / "package.json").read_text(encoding="utf-8")
    assert "resolved" not in (WEB / "package-lock.json").read_text(encoding="utf-8")
