"""Looks whether all that the pages of a site refer to is in it.

    python web/site/links.py FOLDER

Addresses of other servers are counted, not opened.
"""

from __future__ import annotations

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """What a page refers to, the names of its places, and its pictures without a description."""

    def __init__(self, path: Path) -> None:
        """Read a page."""
        super().__init__()
        self.references: list[str] = []
        self.places: set[str] = set()
        self.undescribed: list[str] = []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note what an element refers to."""
        found = {name: value or "" for name, value in attrs}
        self.references += [found[name] for name in ("href", "src") if found.get(name)]
        self.places.update(found[name] for name in ("id", "name") if found.get(name))
        if tag == "img" and not found.get("alt"):
            self.undescribed.append(found.get("src", ""))


def faults(folder: Path) -> tuple[list[str], int]:
    """Return what is wrong with the links of a site, and how many lead to other servers."""
    pages = {path: Page(path) for path in sorted(folder.rglob("*.html"))}
    wrong, outside = [], 0
    for path, page in pages.items():
        name = path.relative_to(folder)
        wrong += [f"{name}: the picture {one} has no description" for one in page.undescribed]
        for reference in page.references:
            parts = urlsplit(reference)
            if parts.scheme or parts.netloc:
                outside += parts.scheme in ("http", "https")
                continue
            target = path if not parts.path else _meant(path, unquote(parts.path), folder)
            if target is None:
                wrong.append(f"{name}: {reference} is not there")
            elif parts.fragment and target in pages and not _has(pages[target], parts.fragment):
                wrong.append(f"{name}: {reference} names no place of that page")
    return wrong, outside


def _has(page: Page, fragment: str) -> bool:
    return unquote(fragment) in page.places or fragment.startswith(("__", ":~:"))


def _meant(page: Path, reference: str, folder: Path) -> Path | None:
    start = folder if reference.startswith("/") else page.parent
    target = (start / reference.lstrip("/")).resolve()
    if target.is_dir():
        target /= "index.html"
    return target if target.is_file() else None


def main(folder: Path) -> int:
    """Print what is wrong; return the exit status."""
    wrong, outside = faults(folder)
    print(
        "\n".join(wrong) if wrong else f"all links lead somewhere; {outside} lead to other servers"
    )
    return 1 if wrong else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python web/site/links.py FOLDER")
    sys.exit(main(Path(sys.argv[1])))
