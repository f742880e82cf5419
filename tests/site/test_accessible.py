"""The pages can be read and used by all: contrast, names, order, keyboard, small screens."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.built_site import ROOT
from tests.consumers.oracles import missing
from tests.site.conftest import Site

pytestmark = pytest.mark.slow

AXE = ROOT / "web" / "site" / "node_modules" / "axe-core" / "axe.min.js"
PAGES = ("index.html", "tutorial.html", "api.html", "gallery.html", "diagnostics.html")
LOOKS = ((1280, "light"), (390, "dark"))
VIOLATIONS = """axe.run({resultTypes: ['violations']}).then(({violations}) => violations.flatMap(
  ({id, nodes}) => nodes.slice(0, 5).map(({target, failureSummary}) =>
    `${id}: ${target.join(' ')}: ${failureSummary.slice(0, 300)}`)))"""
# Examples look alike, and judging all of them takes minutes.
FEW_EXAMPLES = "document.querySelectorAll('.highlight').forEach((e, n) => n > 9 && e.remove())"
READY = "Boolean(window.playground?.built) && playground.isReady"
# What Tab should come to, apart from the other buttons of a group of radio buttons.
REACHABLE = """[...document.querySelectorAll(
  'a[href], button, input, select, textarea, summary, iframe, [tabindex], [contenteditable=true]')]
  .filter(e => e.tabIndex >= 0 && !e.disabled && e.type !== 'radio' && e.checkVisibility(
    {visibilityProperty: true, opacityProperty: true}) && e.getClientRects().length)"""
# Where the focus is, and whether that is seen.
FOCUS = """(() => { const e = document.activeElement;
  if (e === document.body) return [-1, true, ''];
  const isSeen = [e, ...(e.labels ?? []), e.nextElementSibling].filter(Boolean).some((one) => {
    const {outlineStyle, outlineWidth, boxShadow} = getComputedStyle(one);
    const after = getComputedStyle(one, '::after');
    const isMarked = after.content !== 'none' && !/, 0\\)$/.test(after.backgroundColor);
    const isOutlined = outlineStyle !== 'none' && parseFloat(outlineWidth) > 0;
    return isOutlined || boxShadow !== 'none' || isMarked; });
  return [window.reachable.indexOf(e), isSeen, e.outerHTML.slice(0, 120)]; })()"""


@pytest.fixture
def violations(site: Site) -> Callable[[], list[str]]:
    """Return what is wrong with the page that is shown, as axe finds it."""
    if not AXE.exists():
        missing("axe-core")

    def find() -> list[str]:
        site.run(f"{AXE.read_text(encoding='utf-8')};0")
        found: list[str] = site.run(VIOLATIONS)
        return found

    return find


@pytest.fixture
def view(tmp_path: Path) -> Iterator[str]:
    """Return the address of a robot in `yamaro view`."""
    conftest = pytest.importorskip("tests.tools.view.conftest", reason="without view")
    text = (ROOT / "examples" / "quadruped" / "quadruped.yaml").read_text(encoding="utf-8")
    path = tmp_path / "quadruped.yaml"
    path.write_text(text, encoding="utf-8")
    viewer = conftest.Viewer(path)
    yield viewer.url
    viewer.close()


@pytest.mark.parametrize(("width", "scheme"), LOOKS)
def test_pages_have_contrast_names_and_order(
    site: Site, violations: Callable[[], list[str]], width: int, scheme: str
) -> None:
    for page in PAGES:
        site.show(page, width, scheme)
        site.wait_for("!document.querySelector('.md-typeset th:empty')")  # site.js has run
        assert site.run("document.documentElement.scrollWidth") <= width, page
        site.run(FEW_EXAMPLES)
        assert violations() == [], page


@pytest.mark.parametrize(("width", "scheme"), LOOKS)
def test_the_playground_has_contrast_names_and_order(
    site: Site, violations: Callable[[], list[str]], width: int, scheme: str
) -> None:
    site.show("playground/index.html", width, scheme)
    site.wait_for(READY)
    assert site.run("document.documentElement.scrollWidth") <= width
    assert violations() == []
    site.run("playground.showPane('mjcf')")
    site.wait_for("document.querySelector('#output .cm-content').innerText.includes('mujoco')")
    assert violations() == []


@pytest.mark.parametrize(("width", "scheme"), LOOKS)
def test_the_page_of_view_has_contrast_names_and_order(
    site: Site, violations: Callable[[], list[str]], view: str, width: int, scheme: str
) -> None:
    site.show(view, width, scheme)
    site.wait_for("Boolean(window.yamaro && yamaro.version > 0)")
    assert site.run("document.documentElement.scrollWidth") <= width
    assert violations() == []


def tab_through(site: Site, *, most: int, leave: str = "") -> tuple[list[int], list[str]]:
    """Press Tab until it comes around.

    Returns:
        Which elements of `REACHABLE` had the focus, in order; those in which that is not seen.
    """
    count = site.run(f"(window.reachable = {REACHABLE}).length")
    assert 0 < count < most
    order: list[int] = []
    unseen: list[str] = []
    for _ in range(most):
        if leave and site.run(f"document.activeElement.matches({leave!r})"):
            site.press_key("Escape", 27)
        site.press_key("Tab", 9)
        place, is_seen, text = site.run(FOCUS)
        if len(order) > 1 and place == order[0]:  # the page's body has the focus in between
            break
        if not is_seen:
            unseen.append(text)
        if place >= 0 and place not in order:
            order.append(place)
    return order, unseen


def unreached(site: Site, order: list[int]) -> Any:
    left = f"window.reachable.filter((e, n) => !{order}.includes(n))"
    return site.run(f"{left}.map(e => e.outerHTML.slice(0, 150))")


def test_tab_reaches_all_of_the_home_page_in_order(site: Site) -> None:
    site.show("index.html", 1280, "light")
    order, unseen = tab_through(site, most=150)
    assert unreached(site, order) == []
    assert order == sorted(order)
    assert unseen == []


def test_tab_reaches_all_of_the_playground_and_leaves_the_editor(site: Site) -> None:
    site.show("playground/index.html", 1280, "light")
    site.wait_for(READY)
    order, unseen = tab_through(site, most=250, leave=".cm-content")
    assert unreached(site, order) == []
    assert order == sorted(order)
    # The editor has a cursor, and the focus is in the page of the frame.
    assert [each for each in unseen if not re.search("contenteditable|<iframe", each)] == []
    assert "Tab" in site.run("document.querySelector('.keys').innerText")


def test_tab_reaches_all_of_the_page_of_view(site: Site, view: str) -> None:
    site.show(view, 1280, "light")
    site.wait_for("Boolean(window.yamaro && yamaro.version > 0)")
    order, unseen = tab_through(site, most=250)
    assert unreached(site, order) == []
    assert order == sorted(order)
    assert unseen == []


def test_the_links_are_one_stop_of_tab_and_arrows_go_through_them(site: Site, view: str) -> None:
    site.show(view, 1280, "light")
    site.wait_for("Boolean(window.yamaro && yamaro.version > 0)")
    rows = "[...document.querySelectorAll('#tree .row')]"
    assert site.run(f"{rows}.filter(row => row.tabIndex === 0).length") == 1
    names = site.run(f"{rows}.map(row => row.dataset.link)")
    site.run(f"{rows}[0].focus()")
    for key, code, place in (("ArrowDown", 40, 1), ("End", 35, -1), ("ArrowUp", 38, -2)):
        site.press_key(key, code)
        assert site.run("document.activeElement.dataset.link") == names[place]
    assert site.run(f"{rows}.filter(row => row.tabIndex === 0).length") == 1
