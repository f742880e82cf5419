"""The codes of diagnostics: which severity can be chosen, and what their pages say."""

from __future__ import annotations

from functools import cache

from .diagnostics import suggest
from .severities import SEVERITIES
from .terminal import shortened

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection
    from pathlib import Path

HOME = "https://pypi.org/project/yamaro/"
"""Where Yamaro is at home, with links to its documentation."""
ADJUSTABLE = frozenset(SEVERITIES)
"""What a document can be written with: the warnings, the advice, the errors of finished robots."""
LOSSES = frozenset(
    code for code in ADJUSTABLE if code.startswith(("lost-in-", "approximated-in-", "renamed-in-"))
)
"""What an output format cannot hold."""


def fault_of_codes(allowed: Collection[str], denied: Collection[str]) -> str | None:
    """Return what is wrong with codes to allow and codes to deny, or None."""
    for code in sorted({*allowed, *denied}):
        if code in ADJUSTABLE:
            continue
        near = suggest(code, ADJUSTABLE)
        hint = f"; did you mean '{near}'?" if near else ""
        return f"'{shortened(code)}' is not a code that can be allowed or denied{hint}"
    for code in sorted(allowed):
        if code in denied:
            return f"'{code}' cannot be both allowed and denied"
    return None


class Rule:
    """A code as the folder that reports it describes it, in a section of its `rules.md`.

    Attributes:
        code: the code, which is the heading of the section.
        chapter: the heading above it.
        severity: how severe it is, such as "warning; for a mesh advice"; "" if always an error.
        text: what it means and how to fix it, as Markdown.
        page: the file.
    """

    __slots__ = ("chapter", "code", "page", "severity", "text")

    def __init__(self, code: str, *, chapter: str, severity: str, text: str, page: Path) -> None:
        self.code = code
        self.chapter = chapter
        self.severity = severity
        self.text = text
        self.page = page

    @property
    def anchor(self) -> str:
        """The anchor of its heading."""
        return anchor_of(self.code)

    @property
    def summary(self) -> str:
        """Its meaning in a sentence, without links."""
        prose = without_links(" ".join(self.text.partition("\n\n")[0].split()))
        return prose.partition(". ")[0].rstrip(".:") + "."


@cache
def rules() -> dict[str, Rule]:
    """Return all codes with their sections, in the order of the files.

    The files are in the package, so they describe this version, and open without a network.
    """
    import re
    from pathlib import Path

    found: dict[str, Rule] = {}
    for page in sorted(Path(__file__).parent.glob("**/rules.md")):
        text = page.read_text(encoding="utf-8")
        for title, chapter in re.findall(r"^## (.*)\n((?:(?!## ).*\n?)*)", text, re.MULTILINE):
            _, *sections = re.split(r"^### `(.*)`\n", chapter, flags=re.MULTILINE)
            for code, section in zip(sections[::2], sections[1::2], strict=True):
                severity = re.match(r"\n\*Severity: (.*)\.\*\n", section)
                rest = section[severity.end() :] if severity else section
                found[code] = Rule(
                    code,
                    chapter=title,
                    severity=severity[1] if severity else "",
                    text=rest.strip() + "\n",
                    page=page,
                )
    return found


def help_uri(code: str) -> str | None:
    """Return the address of the heading on this machine that describes a code, None without one."""
    rule = rules().get(code)
    return f"{rule.page.as_uri()}#{rule.anchor}" if rule else None


def help_text(code: str) -> str | None:
    """Return what is known of a code, as Markdown without links; None if that is nothing."""
    rule = rules().get(code)
    if rule is None:
        return None
    severity = f"*Severity: {rule.severity}.*\n\n" if rule.severity else ""
    return severity + without_links(rule.text).strip()


def anchor_of(heading: str) -> str:
    """Return the anchor that GitHub, and the site, make of a heading."""
    kept = (char for char in heading.lower() if char.isalnum() or char in " -_")
    return "".join(kept).replace(" ", "-")


def without_links(text: str) -> str:
    """Return Markdown for a place from which its links lead nowhere: with their texts alone."""
    import re

    return re.sub(r"\[([^\]\n]+)\]\([^)\s]+\)", r"\1", text)
