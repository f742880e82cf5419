"""Splits a long document of docs/ into pages of the site: a first page, and one a chapter.

On GitHub it stays one document, with the anchors that links name. The first page has the
introduction and lists all headings; `assets/site.js` leads from an anchor of the whole document to
the page that has it.
"""

from __future__ import annotations

import json
import re

HEADING = re.compile(r"^(#{1,6}) +(.+?) *$")
FENCE = re.compile(r"^ *(`{3,})")
CONTENTS = re.compile(r"\n- \[.*(?:\n(?:- | +).*)*\s*\Z")
"""A list of the chapters, which ends an introduction."""


class Chapter:
    """A chapter: its page, its title, and its headings with their anchors."""

    def __init__(self, page: str, title: str) -> None:
        self.page = page
        self.title = title
        self.lines: list[str] = []
        self.headings: list[tuple[str, str]] = []

    def text(self) -> str:
        """Return the page."""
        return f"# {self.title}\n" + "\n".join(self.lines) + "\n"

    def entry(self) -> str:
        """Return the line of the list of chapters, and the headings below it."""
        entry = f"- [{self.title}]({self.page}#{anchor(self.title)})"
        links = (f"[{text}]({self.page}#{place})" for text, place in self.headings)
        return f"{entry}\n    - {' · '.join(links)}" if self.headings else entry


class Book:
    """A document as pages: `chapters`, and a first page."""

    def __init__(self, name: str, text: str) -> None:
        """Split a document at its headings of the second level."""
        self.name = name
        self.title = name
        self.chapters: list[Chapter] = []
        self._introduction: list[str] = []
        fence = ""
        for line in text.splitlines():
            opens = FENCE.match(line)
            if fence:
                fence = "" if line.strip() == fence else fence
            elif opens:
                fence = opens[1]
            elif (found := HEADING.match(line)) is not None:
                line = self._heading(len(found[1]), found[2])
                if not line:
                    continue
            lines = self.chapters[-1].lines if self.chapters else self._introduction
            lines.append(line)

    def _heading(self, level: int, title: str) -> str:
        """Take a heading; return its line in the page of its chapter, or "" if it begins one."""
        if level == 1:
            self.title = title
            return f"# {title}"
        if level == 2:
            page = f"{self.name.removesuffix('.md')}-{anchor(title)}.md"
            self.chapters.append(Chapter(page, title))
            return ""
        self.chapters[-1].headings.append((title, anchor(title)))
        return f"{'#' * (level - 1)} {title}"

    def places(self) -> dict[str, str]:
        """Return the page that each anchor of the document is in."""
        return {
            place: chapter.page
            for chapter in self.chapters
            for place in (anchor(chapter.title), *(place for _, place in chapter.headings))
        }

    def pages(self) -> dict[str, str]:
        """Return the text of each page."""
        introduction = CONTENTS.sub("", "\n".join(self._introduction).rstrip())
        entries = "\n".join(chapter.entry() for chapter in self.chapters)
        first = f'{introduction}\n\n<div class="chapters" markdown>\n\n{entries}\n\n</div>\n'
        return {self.name: first, **{each.page: each.text() for each in self.chapters}}

    def menu(self, line: re.Match[str]) -> str:
        """Return the lines of the menu for that of the document, whose indent is a group."""
        lines = [f"- {json.dumps(self.title)}:", f"    - {self.name}"]
        for chapter in self.chapters:
            title = json.dumps(chapter.title.replace("`", ""), ensure_ascii=False)
            lines.append(f"    - {title}: {chapter.page}")
        return "\n".join(line[1] + each for each in lines)


def anchor(title: str) -> str:
    """Return the anchor that GitHub, and the site, make of a heading."""
    return "".join(c for c in title.lower() if c.isalnum() or c in " -_").replace(" ", "-")
