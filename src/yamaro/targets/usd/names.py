"""Names of prims: letters, digits and underscores, with no digit at the start."""

from __future__ import annotations

import re

from ..output import RENAMED, Loss
from ..tags import unused

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...diagnostics import Frame as Step
    from ...source import Span

_OTHER = re.compile(r"[^0-9A-Za-z_]")


class Names:
    """The names that prims have, by the path of the prim around them.

    Attributes:
        losses: what is renamed.
    """

    __slots__ = ("_used", "losses")

    def __init__(self, losses: list[Loss]) -> None:
        self._used: dict[str, set[str]] = {}
        self.losses = losses

    def new(self, around: str, name: str) -> str:
        """Return the path of a new prim, with a name as near to this one as can be."""
        plain = _OTHER.sub("_", name) or "_"
        if plain[0].isdigit():
            plain = f"_{plain}"
        return f"{around}/{unused(plain, self._used.setdefault(around, set()))}"

    def told(self, around: str, kind: str, name: str, span: Span, trace: Step | None) -> str:
        """Return the path of a new prim, and note it if its name is another one.

        Args:
            around: the path of the prim around it.
            kind: what it is made of: `robot`, `link`, `frame`, `joint`, `sensor` or `material`.
            name: what that is called.
            span: where the name is written.
            trace: the calls and includes that led there.
        """
        path = self.new(around, name)
        found = path.rpartition("/")[2]
        if found != name:
            owner = f"{kind} '{name}'"
            self.losses.append(Loss(RENAMED, f"{kind}s", owner, span, trace=trace, how=found))
        return path
