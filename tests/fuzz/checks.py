"""What the targets ask of every error and warning."""

from __future__ import annotations

import re
from collections.abc import Iterable

from yamaro.diagnostics import Diagnostic, YamaroError
from yamaro.rendering import render

CODE = re.compile(r"[a-z0-9.]+(-[a-z0-9.]+)*")


def require_readable(error: YamaroError) -> str:
    """Require that an error says something at a place; return the code of its first one."""
    errors = [diagnostic for diagnostic in error.diagnostics if diagnostic.severity == "error"]
    assert errors, "an error without an error in it"
    require_sound(error.diagnostics)
    return errors[0].code


def require_sound(diagnostics: Iterable[Diagnostic]) -> None:
    """Require that each diagnostic has a code, a message of one line, and a place in its source."""
    for diagnostic in diagnostics:
        rendered = render(diagnostic)
        assert CODE.fullmatch(diagnostic.code)
        assert rendered.startswith(f"{diagnostic.severity}[{diagnostic.code}]: ")
        assert rendered == render(diagnostic), "it reads otherwise the second time"
        assert "Traceback" not in rendered
        assert diagnostic.message.strip()
        assert is_printable(rendered), "it steers the terminal"
        span = diagnostic.span
        assert 0 <= span.start <= span.end <= len(span.source.text) + 1  # the end of the file
        line, column = span.location()
        assert 1 <= line <= len(span.source.line_starts())
        assert column >= 1


def is_printable(text: str) -> bool:
    return all(char.isprintable() or char in "\n\t " for char in text)
