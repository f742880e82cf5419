"""One variant of a sweep, as it is evaluated."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ...result import Build


class Variant:
    """A variant that was built.

    Attributes:
        index: its number in the sweep, from 0.
        arguments: the values passed to the file, as the table has them: numbers in the unit of
            their argument.
        build: the result; its `outputs` has a build for each output format of the sweep, and
            `Evaluation.needs` is among them.
        folder: where relative paths of meshes in the outputs start.
    """

    __slots__ = ("arguments", "build", "folder", "index")

    def __init__(
        self, index: int, arguments: Mapping[str, object], build: Build, folder: str
    ) -> None:
        self.index = index
        self.arguments = arguments
        self.build = build
        self.folder = folder
