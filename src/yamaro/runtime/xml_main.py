"""A URDF or xacro file as the main file."""

from __future__ import annotations

from ..diagnostics import Reporter
from ..source import Source, Span
from .xacro_host import XacroHost
from .xml_includes import read_included, tidy_root, xacro_in_safe_mode

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..xml.tree import Element
    from .interpreter import Interpreter


def run_xml_main(
    source: Source,
    interpreter: Interpreter,
    arguments: Mapping[str, str],
    places: Mapping[str, Span],
    reporter: Reporter,
) -> tuple[Element, bool]:
    """Return the root of a URDF as it is, or of what xacro makes of it; and whether it is xacro's.

    Args:
        source: the main file.
        interpreter: gives files, packages, limits, and how far the file is trusted.
        arguments: what is set of the arguments of a xacro file, as it is written.
        places: where those are set that were set on the command line.
        reporter: takes the warnings.

    Raises:
        YamaroError: the input has errors, or a xacro file is not trusted, and there is no jail.
    """
    files, limits, safety = interpreter.files, interpreter.limits, interpreter.safety
    try:
        files.note(source.path or source.name)
        root, is_xacro = read_included(source, limits)
        if not is_xacro:
            return tidy_root(root), False
        if safety is not None and not interpreter.policy.is_confined:
            raise xacro_in_safe_mode(Span(source, root.span.start, root.span.end))
        from ..xacro.expansion import expand

        host = XacroHost(
            files, interpreter.messages, limits, main=source, has_environment=safety is None
        )
        return expand(source, host, arguments, reporter, root=root, places=places), True
    finally:
        interpreter.messages.close()
        files.close()
