"""The site as it is built, once for all tests, and a browser that opens it."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests import chromium
from tests.built_site import SITE, build_site
from tests.chromium import Chromium
from tests.consumers.oracles import missing
from tests.serving import served

ALONE = "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1"


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> str:
    """Build the site; return what the script printed."""
    return build_site(tmp_path_factory)


class Site(Chromium):
    """The site in a browser."""

    address = ""

    def show(self, page: str, width: int, scheme: str) -> None:
        """Open a page at a width, in light or dark."""
        feature = {"name": "prefers-color-scheme", "value": scheme}
        self.call("Emulation.setEmulatedMedia", features=[feature])
        self.resize(width, 900)
        self.open("about:blank")
        self.open(page if "://" in page else f"{self.address}/{page}")
        self.wait_for("location.href != 'about:blank' && document.readyState == 'complete'")

    def press_key(self, name: str, code: int) -> None:
        """Press a key."""
        for kind in ("rawKeyDown", "keyUp"):
            self.call(
                "Input.dispatchKeyEvent", type=kind, key=name, code=name, windowsVirtualKeyCode=code
            )


@pytest.fixture(scope="session")
def site(built: str) -> Iterator[Site]:
    program = chromium.find()
    if program is None:
        missing("Chromium")
        raise AssertionError
    with served(SITE) as address:
        browser = Site(program, ALONE, width=1280, height=900)
        browser.address = address.rstrip("/")
        yield browser
        browser.close()
