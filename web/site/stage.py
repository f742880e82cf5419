"""Puts the pages of the site into a folder: those of docs/, the examples and the known robots.

    python web/site/stage.py FOLDER

Pages stay as they are, but for what the site spells in another way: links that lead out of docs/,
and the words behind the language of a fenced example, which are for the tests. The longest get a
page for each chapter. The configuration of the site is put beside the folder, with their menu.
"""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path

from chapters import Book

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
PAGES = {
    "docs/README.md": "contents.md",
    "examples/README.md": "gallery.md",
    "examples/quadruped/study/README.md": "sweep-a-quadruped.md",
    "robots/README.md": "robots.md",
    "README.md": "index.md",
    "CHANGELOG.md": "changelog.md",
    "CONTRIBUTING.md": "contributing.md",
    "SECURITY.md": "security.md",
    "ARCHITECTURE.md": "architecture.md",
}
"""Pages that have another name on the site than in the repository."""
LISTS = ("examples/README.md", "robots/README.md")
"""Pages of a folder of robots, below which the site shows their files."""
MOVED = {
    "sweep-metrics.html": "sweeps.html",
    "mesh-in-millimetres.html": "from-cad-exports.html",
    "performance.html": "faq.html",
    "two-arms-on-a-table.html": "put-a-gripper-on-an-arm.html",
}
"""Pages that there were, and what has their headings now."""
SPLIT = ("language.md", "diagnostics.md")
"""Documents with a page for each chapter."""
REDIRECT = """\
<!DOCTYPE html>
<html lang="en">
<title>Moved to {page}</title>
<script>location.replace("{page}" + location.hash);</script>
<a href="{page}">This page has moved.</a>
</html>
"""
LINK = re.compile(r"""(?:(?<=\]\()|(?<=src="))([^)"\s#]+)?(#[^)"\s]*)?(?=[)"])""")
FENCE = re.compile(r"^(?P<indent> *)(?P<fence>`{3,})(?P<info>[^`\n]*)$")
FILE = re.compile(r"\bfile=(\S+)")


def main(target: Path) -> None:
    """Write all pages and what they show."""
    shutil.rmtree(target, ignore_errors=True)
    target.mkdir(parents=True)
    shutil.copytree(DOCS / "pictures", target / "pictures")
    for page in DOCS.iterdir():
        if page.suffix in (".gif", ".png", ".svg", ".json", ".csv"):
            shutil.copy(page, target / page.name)
    stage = Stage(target)
    menu = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    menu = menu.replace("build/site-pages", target.name).replace("build/site", "site")
    for page in sorted(DOCS.glob("*.md")):
        name = PAGES.get(f"docs/{page.name}", page.name)
        text = stage.converted(page)
        if name not in SPLIT:
            stage.write(name, text)
            continue
        book = Book(name, text)
        for part, text in book.pages().items():
            stage.write(part, text)
        menu = re.sub(rf"^( *)- {name}$", book.menu, menu, flags=re.M)
    for old, new in MOVED.items():
        stage.write(old, REDIRECT.format(page=new))
    (target.parent / "mkdocs.yml").write_text(menu, encoding="utf-8")
    for name in PAGES:
        if not name.startswith("docs/") and name != "README.md" and name not in LISTS:
            stage.write(PAGES[name], stage.converted(ROOT / name))
    for name in LISTS:
        page = ROOT / name
        stage.write(PAGES[name], stage.converted(page) + files_below(page.parent.name))
    shutil.copytree(ROOT / "web" / "site" / "assets", target / "assets")


class Stage:
    """The folder of the site's pages."""

    def __init__(self, target: Path) -> None:
        self._target = target
        self._chapters = {
            DOCS / name: Book(name, (DOCS / name).read_text(encoding="utf-8")).places()
            for name in SPLIT
        }

    def write(self, name: str, text: str) -> None:
        """Write a page."""
        (self._target / name).write_text(text, encoding="utf-8")

    def converted(self, page: Path) -> str:
        """Return a page as the site spells it."""
        lines: list[str] = []
        closing = ""
        for line in page.read_text(encoding="utf-8").splitlines():
            fence = FENCE.match(line)
            if closing:
                closing = "" if line.strip() == closing else closing
                lines.append(line)
            elif fence:
                closing = fence["fence"]
                lines.append(f"{fence['indent']}{closing}{_info(fence['info'])}")
            else:
                lines.append(LINK.sub(lambda found: self._link(page, found), line))
        return "\n".join(lines) + "\n"

    def _link(self, page: Path, found: re.Match[str]) -> str:
        path, anchor = found[1] or "", found[2] or ""
        if "://" in path or path.startswith("mailto:"):
            return f"{path}{anchor}"
        meant = (page.parent / path).resolve() if path else page
        chapter = self._chapters.get(meant, {}).get(anchor[1:])
        if chapter is not None:
            return f"{chapter}{anchor}"
        if not path:
            return anchor
        if not meant.exists():  # made when the site is built
            return f"{path}{anchor}"
        name = meant.relative_to(ROOT).as_posix()
        if name in PAGES:
            return f"{PAGES[name]}{anchor}"
        if meant.is_relative_to(DOCS):
            return f"{meant.relative_to(DOCS).as_posix()}{anchor}"
        if name.startswith(("examples/", "robots/")) and meant.is_dir():
            folder, robot = Path(name).parts[:2]
            return f"{PAGES[f'{folder}/README.md']}#{robot}"
        if meant.is_dir():
            return "contents.md"
        return f"{self._copied(name)}{anchor}"

    def _copied(self, name: str) -> str:
        """Have a file of the repository beside the pages, and return its name there."""
        path = self._target / "files" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        # A page of the site is what ends in .md; other files are given as they are.
        shutil.copy(ROOT / name, path)
        return f"files/{name}"


def _info(info: str) -> str:
    words = info.split()
    if not words:
        return ""
    file = FILE.search(info)
    language = {"console": "console", "sh": "bash"}.get(words[0], words[0])
    return f'{language} title="{file[1]}"' if file else language


def files_below(folder: str) -> str:
    """Return the files of all robots in a folder, each folded, below a picture."""
    parts = []
    for robot in sorted(path for path in (ROOT / folder).iterdir() if path.is_dir()):
        parts.append(f"\n## {robot.name}\n")
        if (DOCS / "pictures" / f"{robot.name}.png").exists() and folder == "examples":
            parts.append(f"![{robot.name}](pictures/{robot.name}.png)\n")
        for path in sorted(robot.rglob("*"), key=lambda one: (one.parent, one.name)):
            if path.suffix in (".yaml", ".py"):
                name = path.relative_to(robot).as_posix()
                text = path.read_text(encoding="utf-8")
                body = "".join(f"    {line}\n" if line else "\n" for line in text.splitlines())
                language = path.suffix[1:]
                parts.append(f'??? example "{name}"\n\n    ```{language}\n{body}    ```\n')
    return "\n".join(parts)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python web/site/stage.py FOLDER")
    main(Path(sys.argv[1]))
