"""What holds while files are parsed, and what is gathered of one: errors, warnings, Python code."""

from __future__ import annotations

from ..diagnostics import Diagnostic, Reporter, YamaroError
from ..policy import Limits

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from types import CodeType
    from typing import ParamSpec, TypeVar

    from ..fixes import Fix
    from ..source import Span
    from .keys import PlainKey
    from .nodes import FunctionNode
    from .python import PythonCode

    P = ParamSpec("P")
    T = TypeVar("T")


class Rules:
    """What holds while files are read and parsed.

    Attributes:
        limits: how large they may be.
        compile: makes code of the text, the file name and the mode that Python's `compile` takes;
            raises what that raises, or an InputFault.
    """

    __slots__ = ("compile", "limits")

    def __init__(
        self,
        limits: Limits | None = None,
        compile: Callable[[str, str, str], CodeType] | None = None,
    ) -> None:
        """Set them; by default all of Python is allowed, within the limits of trusted files."""
        self.limits = limits or Limits()
        self.compile = compile or self._compile

    def _compile(self, text: str, filename: str, mode: str) -> CodeType:
        if "**" not in text and "<<" not in text:
            return compile(text, filename, mode, dont_inherit=True)
        from .powers import compile_bounded

        return compile_bounded(text, filename, mode, self.limits)


class ParseContext:
    """Gathers the findings of one parse, so that one error does not hide the next."""

    __slots__ = (
        "at_root",
        "bare_keys",
        "blocks",
        "codes",
        "errors",
        "functions",
        "plain_keys",
        "reporter",
        "rules",
    )

    def __init__(self, reporter: Reporter, rules: Rules | None = None) -> None:
        """Start with nothing gathered.

        Attributes:
            at_root: whether the statements being parsed stand at the root of the file.
            bare_keys: the names of elements that are written without attributes.
            blocks: names of the blocks of the functions around the place being parsed.
            codes: every expression and process block compiled.
            functions: those that were parsed.
            plain_keys: name and attributes of the elements' keys that came before, if nothing in
                them is evaluated and they came out clean.
            rules: what holds for the file.
        """
        self.reporter = reporter
        self.rules = rules or Rules()
        self.errors: list[Diagnostic] = []
        self.codes: list[PythonCode] = []
        self.blocks: tuple[str, ...] = ()
        self.functions: list[FunctionNode] = []
        self.bare_keys: set[str] = set()
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

    def report(
        self,
        code: str,
        message: str,
        span: Span,
        *,
        hint: str | None = None,
        fix: Fix | None = None,
    ) -> None:
        """Keep a finding that does not prevent a document."""
        self.reporter.report(code, message, span, hint=hint, fix=fix)
