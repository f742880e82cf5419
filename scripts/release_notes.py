"""Prints the notes of a release: what CHANGELOG.md says of its version.

release_notes.py VERSION                the notes of that version
release_notes.py --version              the version in src/yamaro/__init__.py
release_notes.py --next-steps VERSION   what the owner has to do, from scripts/next_steps.md
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
HEADING = re.compile(r"^## \[([^\]]+)\](?: - (\d{4}-\d{2}-\d{2}))?$", re.MULTILINE)


def version() -> str:
    """Return the version that the package has."""
    text = (ROOT / "src" / "yamaro" / "__init__.py").read_text(encoding="utf-8")
    found = re.search(r'^__version__ = "([^"]+)"$', text, re.MULTILINE)
    if found is None:
        sys.exit("src/yamaro/__init__.py has no __version__")
    return found.group(1)


def notes(changelog: str, wanted: str) -> str:
    """Return what a changelog says of a version, with the words of its links.

    Raises:
        ValueError: the version is not there, has no date, or nothing is said of it.
    """
    headings = list(HEADING.finditer(changelog))
    for heading, after in zip(headings, [*headings[1:], None], strict=True):
        if heading.group(1) != wanted:
            continue
        if heading.group(2) is None:
            raise ValueError(f"the heading of {wanted} has no date: ## [{wanted}] - YYYY-MM-DD")
        body = changelog[heading.end() : after.start() if after else len(changelog)].strip()
        if not body:
            raise ValueError(f"nothing is said of {wanted}")
        return re.sub(r"\[([^\]]+)\]\((?!https?:)[^)]*\)", r"\1", body) + "\n"
    raise ValueError(f"there is no heading '## [{wanted}] - YYYY-MM-DD'")


def main() -> None:
    """Print what is asked for."""
    if sys.argv[1:] == ["--version"]:
        print(version())
        return
    if sys.argv[1:2] == ["--next-steps"]:
        steps = (ROOT / "scripts" / "next_steps.md").read_text(encoding="utf-8")
        plain = re.match(r"[\d.]+", sys.argv[2])
        assert plain is not None
        sys.stdout.write(steps.replace("{version}", sys.argv[2]).replace("{plain}", plain[0]))
        return
    (wanted,) = sys.argv[1:]
    try:
        sys.stdout.write(notes((ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), wanted))
    except ValueError as error:
        sys.exit(f"CHANGELOG.md: {error}")


if __name__ == "__main__":
    main()
