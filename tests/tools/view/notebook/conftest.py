"""A browser that opens what a notebook shows, and notes all that the page asks for."""

from __future__ import annotations

import html
from collections.abc import Callable, Iterator
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

from tests import chromium
from tests.chromium import Chromium
from tests.consumers.oracles import missing


def html_of(result: Any) -> str:
    """Return what a notebook shows of a result."""
    shown: str | None = result._repr_html_()
    assert shown is not None
    return shown


class Frames(HTMLParser):
    """The tags of some HTML, and the pages in its frames."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.pages: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.pages += [value or "" for name, value in attrs if name == "srcdoc"]


class Browser(Chromium):
    """Opens HTML from files.

    Attributes:
        requests: the addresses that the page asked for.
    """

    folder: Path

    def __init__(self, program: str) -> None:
        self.requests: list[str] = []
        super().__init__(program, width=900, height=460)
        self.call("Network.enable")

    def _note(self, event: Any) -> None:
        super()._note(event)
        if event.get("method") == "Network.requestWillBeSent":
            self.requests.append(event["params"]["request"]["url"])

    def show(self, page: str) -> None:
        """Open a page, and wait until it shows its robot."""
        self.show_html(page)
        self.wait_for("Boolean(window.yamaro?.robot && document.getElementById('empty').hidden)")

    def show_html(self, text: str) -> None:
        path = self.folder / "page.html"
        path.write_text(text, encoding="utf-8")
        self.open(path.as_uri())

    def stage(self) -> Any:
        """Return the pixels of the robot's part of the page."""
        self.run("yamaro.stage.drawNow()")
        return self.picture((0, 40, 600, 360))


@pytest.fixture(scope="module")
def chromium_of_module() -> Iterator[Browser]:
    program = chromium.find()
    if program is None:
        missing("Chromium")
        raise AssertionError
    browser = Browser(program)
    yield browser
    browser.close()


@pytest.fixture
def browser(chromium_of_module: Browser, tmp_path: Path) -> Iterator[Browser]:
    """The browser; afterwards it must have had nothing to complain of, and asked for nothing."""
    browser = chromium_of_module
    browser.folder = tmp_path
    yield browser
    complaints = list(browser.complaints)
    browser.open("about:blank")
    asked = [url for url in browser.requests if not url.startswith(("file:", "about:", "data:"))]
    asked = [url for url in asked if not url.startswith("blob:")]
    browser.complaints.clear()
    browser.requests.clear()
    assert complaints == []
    assert asked == []


@pytest.fixture
def page_of() -> Callable[[Any], str]:
    """Return the page in the frame that shows a result."""

    def page(result: Any) -> str:
        found = Frames(html_of(result))
        assert found.tags == ["iframe"]
        assert html.unescape(found.pages[0]) != ""
        return found.pages[0]

    return page
