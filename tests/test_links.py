"""Links between the documents lead to files and headings that exist."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[1]
DOCUMENTS = sorted(
    [
        *REPOSITORY.glob("*.md"),
        *(REPOSITORY / "docs").rglob("*.md"),
        *(REPOSITORY / "src").rglob("rules.md"),
    ]
)

LARGEST_PICTURE, LARGEST_FILM = 150_000, 1_000_000

LINK = re.compile(r"\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#{1,6} +(.+?) *$", re.MULTILINE)
FENCED = re.compile(r"^( *)(`{3,}|~{3,}).*?^ *\2`*$", re.MULTILINE | re.DOTALL)


def prose(path: Path) -> str:
    """Return the text of a document without its fenced blocks."""
    return FENCED.sub("", path.read_text(encoding="utf-8"))


def anchors(path: Path) -> set[str]:
    """Return the anchors that GitHub makes of the headings."""
    found: list[str] = []
    for heading in HEADING.findall(prose(path)):
        text = LINK.sub("]", heading).lower()
        anchor = "".join(c for c in text if c.isalnum() or c in " -_").replace(" ", "-")
        repeated = found.count(anchor)
        found.append(f"{anchor}-{repeated}" if repeated else anchor)
    return set(found)


def broken_links(path: Path) -> list[str]:
    broken = []
    for link in LINK.findall(prose(path)):
        if "://" in link or link.startswith("mailto:"):
            continue
        name, _, anchor = link.partition("#")
        target = (path.parent / name).resolve() if name else path
        if not target.exists() or (anchor and anchor not in anchors(target)):
            broken.append(link)
    return broken


@pytest.mark.parametrize(
    "path", DOCUMENTS, ids=lambda path: path.relative_to(REPOSITORY).as_posix()
)
def test_links_lead_somewhere(path: Path) -> None:
    assert broken_links(path) == []


def test_the_pictures_are_small_and_each_is_in_a_document() -> None:
    texts = map(prose, [*DOCUMENTS, REPOSITORY / "examples" / "README.md"])
    shown = {name for text in texts for name in re.findall(r"[\w-]+\.(?:png|gif)\b", text)}
    for kind, largest in (("png", LARGEST_PICTURE), ("gif", LARGEST_FILM)):
        pictures = [*(REPOSITORY / "docs").rglob(f"*.{kind}")]
        assert pictures
        assert sorted({path.name for path in pictures} - shown) == []
        assert [path.name for path in pictures if path.stat().st_size > largest] == []


def test_broken_links_are_found(tmp_path: Path) -> None:
    (tmp_path / "a.md").write_text(
        "# `if`, a b\n```\n# no heading\n[no](link.md)\n```\n"
        "[1](#if-a-b) [2](#no-heading) [3](b.md) [4](a.md#if-a-b) [5](https://example.org)\n"
    )
    assert broken_links(tmp_path / "a.md") == ["#no-heading", "b.md"]
