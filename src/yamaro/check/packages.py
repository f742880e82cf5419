"""Reports packages that are there twice: from ROS, and from a Python package."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..diagnostics import Reporter
    from ..files.installed import InstalledPackage
    from ..source import Span
    from ..xml.tree import Element


def warn_of_clashes(
    clashes: Sequence[tuple[InstalledPackage, str, Span | None]], root: Element, reporter: Reporter
) -> None:
    """Report each Python package that a ROS package of the same name hides.

    Args:
        clashes: the Python package, the folder of the ROS package, and where the name is written.
        root: the robot, where it is not known in which place the name is written.
        reporter: takes the warnings.
    """
    for package, folder, span in clashes:
        origin = f"{package.distribution} {package.version}"
        reporter.warn(
            "hidden-package",
            f"the ROS package '{package.name}' is used, not the Python package of that name",
            span or root.span,
            hint=f"to choose, set its folder: --package {package.name}:=FOLDER",
            notes=[
                f"the ROS package is {folder}",
                f"the Python package is {package.folder} ({origin})",
            ],
        )
