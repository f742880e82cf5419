"""The result of a conversion that leaves a jail."""

from __future__ import annotations

from ..diagnostics import ERROR

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ..diagnostics import Diagnostic
    from ..source import Reading
    from ..xml.tree import Element


class Document:
    """A document in one output format.

    Attributes:
        format: the format.
        file_name: what its file is called.
        text: the document.
        root: its tree, if it was asked for.
        losses: what the format cannot hold, as warnings.
        assets: what belongs beside the document by its path, or None if that is not known yet.
        robot: the tree of the robot as it was run for this format, if it was asked for and is not
            that of the outcome.
        notes: what comes with that tree.
        refusal: why there is no document, or "".
    """

    __slots__ = (
        "assets",
        "file_name",
        "format",
        "losses",
        "notes",
        "refusal",
        "robot",
        "root",
        "text",
    )

    def __init__(
        self,
        format: str,
        text: str,
        *,
        root: Element | None = None,
        losses: Sequence[Diagnostic] = (),
        assets: Mapping[str, bytes] | None = None,
        robot: Element | None = None,
        notes: Sequence[Element] = (),
        file_name: str = "",
        refusal: str = "",
    ) -> None:
        self.format = format
        self.file_name = file_name
        self.refusal = refusal
        self.text = text
        self.root = root
        self.losses = losses
        self.assets = assets
        self.robot = robot
        self.notes = notes


class Outcome:
    """The result of a conversion.

    Attributes:
        messages: what was printed, line by line.
        diagnostics: errors and warnings, in order.
        pieces: the document in UTF-8, in pieces; empty if there are errors.
        files: the files read.
        meshes: the meshes referred to.
        root: the finished tree, if it was asked for and there is one.
        notes: what comes with the tree of a robot, such as its sensors.
        documents: the documents in the output formats asked for, if there are any.
        noted: the values of names where they are declared, if they were asked for.
    """

    __slots__ = (
        "diagnostics",
        "documents",
        "files",
        "meshes",
        "messages",
        "noted",
        "notes",
        "pieces",
        "root",
    )

    def __init__(
        self,
        *,
        messages: Sequence[str] = (),
        diagnostics: Sequence[Diagnostic] = (),
        pieces: Sequence[str] = (),
        files: Sequence[str] = (),
        meshes: Sequence[str] = (),
        root: Element | None = None,
        notes: Sequence[Element] = (),
        documents: Sequence[Document] = (),
        noted: Sequence[Reading] = (),
    ) -> None:
        self.messages = list(messages)
        self.diagnostics = list(diagnostics)
        self.pieces = list(pieces)
        self.files = list(files)
        self.meshes = list(meshes)
        self.root = root
        self.notes = list(notes)
        self.documents = list(documents)
        self.noted = list(noted)

    @property
    def has_errors(self) -> bool:
        """Return whether the conversion has failed."""
        return any(diagnostic.severity == ERROR for diagnostic in self.diagnostics)
