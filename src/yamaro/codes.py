"""The codes of diagnostics: whose severity can be chosen, and how they are described."""

from __future__ import annotations

from functools import cache

from .diagnostics import suggest
from .terminal import shortened

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection

HOME = "https://pypi.org/project/yamaro/"
"""Where Yamaro is at home, with links to its documentation."""
LOSSES = frozenset(
    """
    lost-in-urdf approximated-in-urdf lost-in-srdf
    lost-in-sdf approximated-in-sdf renamed-in-sdf
    lost-in-mjcf approximated-in-mjcf renamed-in-mjcf
    lost-in-usd approximated-in-usd renamed-in-usd
    """.split()
)
"""What an output format cannot hold."""
ADJUSTABLE = (
    frozenset(
        """
    ambiguous-parent anchored-expression angle-too-large assumed-limit axis-not-unit bad-color
    bad-inertia bad-mass bad-mesh bad-name bad-size bad-version base-assumed
    capsule-needs-urdf-1.1
    comment-entry dollar-in-string doubled-ending duplicate-joint duplicate-link
    duplicate-material far-center
    fixed-mimic function-replaced gimbal-rpy hidden-package hidden-value ignored-limit joint-cycle
    large-mesh leftover-expression limit-order long-chain massless-moving mimic-cycle
    mirror-axis mirror-raw misplaced-key misplaced-part missing-attribute
    missing-axis missing-element
    missing-extra missing-limit missing-mesh-file misspelt-statement needs-version open-loop
    negative-value no-link no-range not-a-number not-urdf odd-density odd-inertia odd-mass
    prefix-not-passed quaternion-not-unit repeated-element root-inertia several-roots
    several-shapes several-surfaces slash-in-name soft-limit-outside state-outside-limit two-parents
    two-rotations unknown-attribute unknown-child unknown-element unknown-joint
    unknown-joint-type unknown-key unknown-material unknown-mimic unknown-package unknown-parent
    unknown-reference unknown-variable unused-allow unused-geometry wrong-count xacro-deprecated
    xacro-ignored xacro-lost xacro-message xacro-name xacro-no-files xacro-prefix
    xacro-redefined xacro-scope xacro-syntax xacro-unknown-attribute zero-axis zero-limit
    zero-outside-limits
    """.split()
    )
    | frozenset(
        """
    bad-mesh-address bad-value fixed-joint mimic-command mimic-type out-of-range remote-mesh
    repeated-name reversed-chain unknown-type
    """.split()
    )
    | LOSSES
)
"""What a document can be written with: the warnings, the advice, the errors of finished robots."""


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


@cache
def _page() -> tuple[str, dict[str, str]]:
    """Return the address of the page that describes the codes, and its section of each.

    The page is in the wheel; in a working copy, it is the one in `docs/`. It lies on this machine,
    so that it describes this version, and opens without a network.
    """
    import re
    from pathlib import Path

    package = Path(__file__).parent
    for path in (package / "diagnostics.md", package.parents[1] / "docs" / "diagnostics.md"):
        try:
            text = path.read_text(encoding="utf-8")
        except OSError:
            continue
        parts = re.split(r"^### `([a-z0-9.-]+)`\n|^## .*\n", text, flags=re.MULTILINE)
        sections = {code: part for code, part in zip(parts[1::2], parts[2::2], strict=True) if code}
        return path.as_uri(), sections
    return "", {}


def help_uri(code: str) -> str | None:
    """Return the address of the heading on this machine that describes a code, None without one."""
    address, sections = _page()
    return f"{address}#{code}" if code in sections else None


def help_text(code: str) -> str | None:
    """Return what the page says of a code, as Markdown without links; None if it says nothing."""
    import re

    # Links lead from the page to its neighbours, and nowhere from where the text is shown alone.
    return re.sub(r"\[([^\]\n]+)\]\([^)\s]+\)", r"\1", _page()[1].get(code, "")).strip() or None
