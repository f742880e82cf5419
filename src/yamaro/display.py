"""What a notebook shows of a result, as HTML: made by a tool, which is imported when it is asked.

Results lie below the tools, and may not import one. So the one that shows them is named here.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

_TOOL = "yamaro.tools.notebook.page"


def html_of(result: object) -> str:
    """Return the HTML that shows a `Build` or `Robot`."""
    from importlib import import_module

    show: Callable[[object], str] = import_module(_TOOL).html_of
    return show(result)
