"""The site: every page is in it, every link leads somewhere, and it can be read on a phone."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "web" / "site"))
import links  # noqa: E402
import stage  # noqa: E402

from tests.site.conftest import Site  # noqa: E402
from tests.test_links import anchors  # noqa: E402
from yamaro.codes import anchor_of, rules  # noqa: E402


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site") / "pages"
    stage.main(folder)
    return folder


def test_every_page_is_in_the_menu_once(pages: Path) -> None:
    menu = (pages.parent / "mkdocs.yml").read_text(encoding="utf-8").partition("\nnav:")[2]
    named = re.findall(r"^ *- (?:\"[^\"]+\": )?(\S+\.md)$", menu, re.MULTILINE)
    assert sorted([*named, "architecture.md"]) == sorted(path.name for path in pages.glob("*.md"))


@pytest.mark.parametrize("name", stage.SPLIT)
def test_each_anchor_of_a_document_leads_to_the_chapter_that_has_it(pages: Path, name: str) -> None:
    first = (pages / name).read_text(encoding="utf-8")
    listed = re.findall(r"\]\(([\w-]+\.md)#([\w-]+)\)", first.partition('class="chapters"')[2])
    wanted = anchors(ROOT / "docs" / name)
    assert {anchor for _, anchor in listed} == wanted - anchors(pages / name)
    assert len(listed) == len(wanted) - 1  # no two headings have one anchor; the title has none
    for page, anchor in listed:
        assert anchor in anchors(pages / page)


@pytest.mark.parametrize("name", stage.SPLIT)
def test_chapters_hold_all_that_the_document_has(pages: Path, name: str) -> None:
    def plain(text: str) -> list[str]:
        return [line.lstrip("# ") for line in text.splitlines() if line and "](" not in line]

    whole = plain(stage.Stage(pages).converted(ROOT / "docs" / name))
    parts = [pages / name, *pages.glob(f"{Path(name).stem}-*.md")]
    found = [line for part in parts for line in plain(part.read_text(encoding="utf-8"))]
    assert set(whole) - set(found) == set()
    assert len(parts) > 10


def page_of(chapter: str) -> str:
    return f"diagnostics-{anchor_of(chapter)}"


def test_each_code_has_its_heading_in_the_page_of_its_chapter(pages: Path) -> None:
    chapters = {rule.chapter for rule in rules().values()}
    headings = {each: anchors(pages / f"{page_of(each)}.md") for each in chapters}
    for rule in rules().values():
        assert rule.anchor in headings[rule.chapter]


def test_links_to_a_chapter_name_its_page(tmp_path: Path) -> None:
    page = ROOT / "docs" / "language.md"
    place = stage.Stage(tmp_path)
    for path, link, expected in (
        (page, "#shapes", "language-part-a-joint-and-a-link.md#shapes"),
        (page, "cli.md#trust", "cli.md#trust"),
        (ROOT / "docs" / "cli.md", "diagnostics.md#advice", "diagnostics-advice.md#advice"),
        (
            ROOT / "CHANGELOG.md",
            "docs/language.md#poses",
            "language-part-a-joint-and-a-link.md#poses",
        ),
        (ROOT / "docs" / "cli.md", "language.md", "language.md"),
        (ROOT / "docs" / "cli.md", "#trust", "#trust"),
    ):
        found = stage.LINK.search(f"[x]({link})")
        assert found is not None
        assert place._link(path, found) == expected


def test_links_lead_to_pages_of_the_site_or_to_files_that_are_brought_along(pages: Path) -> None:
    for page in pages.glob("*.md"):
        text = page.read_text(encoding="utf-8")
        assert "](../" not in text, page.name
        for name in re.findall(r"\]\((files/[^)#]+)", text):
            assert (pages / name).read_bytes() == (ROOT / name.removeprefix("files/")).read_bytes()


def test_fences_name_their_language_and_their_file(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(
        "```yaml error file=r.yaml\na: [x](../y)\n```\n```console\n$ yamaro\n```\n", "utf-8"
    )
    assert stage.Stage(tmp_path).converted(page) == (
        '```yaml title="r.yaml"\na: [x](../y)\n```\n```console\n$ yamaro\n```\n'
    )


@pytest.mark.parametrize(("name", "page"), [("examples", "gallery.md"), ("robots", "robots.md")])
def test_a_page_holds_all_files_of_all_robots(name: str, page: str, pages: Path) -> None:
    text = (pages / page).read_text(encoding="utf-8")
    folders = [path for path in (ROOT / name).iterdir() if path.is_dir()]
    for folder in folders:
        for path in [*folder.rglob("*.yaml"), *folder.rglob("*.py")]:
            assert f'??? example "{path.relative_to(folder).as_posix()}"' in text


def test_a_link_that_leads_nowhere_is_found(tmp_path: Path) -> None:
    (tmp_path / "a.html").write_text(
        '<a href="b.html#there">1</a><a href="b.html#gone">2</a><a href="c.html">3</a>'
        '<img src="b.html"><img src="b.html" alt="a page"><a href="https://example.org">4</a>',
        "utf-8",
    )
    (tmp_path / "b.html").write_text('<p id="there">', "utf-8")
    wrong, outside = links.faults(tmp_path)
    assert wrong == [
        "a.html: the picture b.html has no description",
        "a.html: b.html#gone names no place of that page",
        "a.html: c.html is not there",
    ]
    assert outside == 1


@pytest.mark.slow
def test_the_site_is_built_strictly(built: str) -> None:
    assert "all links lead somewhere" in built
    assert (ROOT / "build" / "site" / "playground" / "pyodide" / "pyodide.asm.wasm").exists()
    for rule in rules().values():
        page = (ROOT / "build" / "site" / f"{page_of(rule.chapter)}.html").read_text("utf-8")
        assert f' id="{rule.anchor}"' in page


@pytest.mark.slow
@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("language.html#shapes", "language-part-a-joint-and-a-link.html#shapes"),
        (
            "diagnostics.html#undefined-name",
            "diagnostics-expressions-and-python.html#undefined-name",
        ),
        ("sweep-metrics.html#built-in-metrics", "sweeps.html#built-in-metrics"),
    ],
)
def test_an_old_anchor_leads_on(site: Site, old: str, new: str) -> None:
    site.show(old, 1280, "light")
    site.wait_for(f"location.href.endsWith('/{new}')")
    anchor = new.partition("#")[2]
    site.wait_for(f"document.getElementById('{anchor}')?.getBoundingClientRect().top < 200")
