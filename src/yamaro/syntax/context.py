"""What is gathered while one file is parsed: errors, warnings and compiled Python."""

from __future__ import annotations

from ..diagnostics import Diagnostic, Reporter, YamaroError
from .rules import Rules

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import ParamSpec, TypeVar

    from ..fixes import Fix
    from ..source import Span
    from .keys import PlainKey
    from .python import PythonCode

    P = ParamSpec("P")
    T = TypeVar("T")


class ParseContext:
    """Gathers the findings of one parse, so that one error does not hide the next."""

    __slots__ = (
        "at_root",
        "blocks",
        "codes",
        "declarations",
        "errors",
        "extents",
        "plain_keys",
        "reporter",
        "rules",
    )

    def __init__(self, reporter: Reporter, rules: Rules | None = None) -> None:
        """Start with nothing gathered.

        Attributes:
            at_root: whether the statements being parsed stand at the root of the file.
            blocks: names of the blocks of the functions around the place being parsed.
            codes: every expression and process block compiled.
            declarations: name, scope and place of everything that declares a name.
            extents: the place of each function or block with its body; inner ones come first.
            plain_keys: name and attributes of the elements' keys that came before, if nothing in
                them is evaluated and they came out clean.
            rules: what holds for the file.
        """
        self.reporter = reporter
        self.rules = rules or Rules()
        self.errors: list[Diagnostic] = []
        self.codes: list[PythonCode] = []
        self.blocks: tuple[str, ...] = ()
        self.declarations: list[tuple[str, str, Span]] = []
        self.extents: list[Span] = []
        self.plain_keys: dict[str, PlainKey] = {}
        self.at_root = False

    def attempt(self, parse: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T | None:
        """Return what `parse` returns, or keep its errors and return None."""
        try:
            return parse(*args, **kwargs)
        except YamaroError as error:
            self.keep(error)
            return None

    def keep(self, error: YamaroError) -> None:
        """Keep the diagnostics of an error."""
        self.errors.extend(error.diagnostics)

    def warn(
        self,
        code: str,
        message: str,
        span: Span,
        *,
        hint: str | None = None,
        fix: Fix | None = None,
    ) -> None:
        """Keep a warning."""
        self.reporter.warn(code, message, span, hint=hint, fix=fix)
