"""The result of a build: the document, the files it names, and the tree it was written from."""

from __future__ import annotations

from .source import Public, html_of
from .xml.tree import unshared

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from .diagnostics import Diagnostic
    from .files.mesh_files import MeshFinder
    from .model.robot import Robot
    from .source import Reading
    from .targets.assets import Assets
    from .targets.losses import Loss
    from .xml.tree import Element

PIECES_IN_CHUNK = 10_000
"""Pieces of text, of some dozens of characters each, that are written at a time."""


class Build(Public):
    """A finished robot or other document.

    Attributes:
        accepted: what was found and is accepted by comments in the files.
        beside: what belongs beside the document, without meshes in URDF.
        files: the absolute path of every file read, in order.
        file_name: what its file is called; "" if it was built for no file.
        format: the output format: `urdf` (also for other XML), `sdf`, `mjcf`, `srdf` or `usd`.
        losses: what the format cannot hold as it is, if a format was asked for, or
            MJCF or SDF is written as URDF.
        refused: why formats that were asked for are not in `outputs`, by their names.
        outputs: the builds of all formats that were asked for together, this one among them.
        finder: finds the files of meshes and textures.
        notes: what the robot has that is not an element of the document, such as sensors.
        noted: if that was asked for, the values of names where they are declared.
        pieces: the document, in pieces.
        warnings: the warnings, in order.
    """

    __slots__ = (
        "_copies",
        "_document",
        "_find_meshes",
        "_finished",
        "_robot",
        "_root",
        "accepted",
        "beside",
        "file_name",
        "files",
        "finder",
        "format",
        "losses",
        "noted",
        "notes",
        "outputs",
        "pieces",
        "refused",
        "warnings",
    )
    _internal = frozenset((
        "beside", "encoded", "finder", "noted", "notes", "pieces", "refused", "robot_tree",
        "root_name",
    ))  # fmt: skip

    def __init__(
        self,
        find_meshes: Callable[[], list[str]],
        *,
        finder: MeshFinder,
        finished: Element | None,
        pieces: list[str],
        warnings: list[Diagnostic],
        files: list[str],
        notes: Sequence[Element] = (),
        noted: Sequence[Reading] = (),
        format: str = "urdf",
        file_name: str = "",
        document: Element | None = None,
        losses: Sequence[Loss] = (),
        assets: Mapping[str, bytes] | None = None,
        copies: Assets | None = None,
    ) -> None:
        """Hold the results of a build.

        Args:
            find_meshes: gives the meshes referred to.
            finder: finds the files of meshes and textures.
            finished: the finished tree, in which an element may be in several places; None if
                it stayed in a jail.
            pieces: the document, in pieces.
            warnings: what was noticed, in order.
            files: the absolute path of every file read, in order.
            notes: what the robot has that is not an element of the document.
            noted: the values of names where they are declared.
            format: the output format.
            file_name: what its file is called.
            document: the root of the document, if it is not the finished tree.
            losses: what the format cannot hold as it is.
            assets: what belongs beside the document; of URDF without copies of meshes.
            copies: makes these of the meshes referred to.
        """
        self._find_meshes = find_meshes
        self._root: Element | None = None
        self._finished = finished
        self._document = document
        self.beside = assets or {}
        self._robot: Robot | None = None
        self.pieces = pieces
        self._copies = copies
        self.finder = finder
        self.warnings = warnings
        self.accepted: Sequence[Diagnostic] = ()
        self.files = files
        self.notes = notes
        self.noted = noted
        self.format = format
        self.file_name = file_name
        self.losses = losses
        self.outputs: dict[str, Build] = {}
        self.refused: dict[str, str] = {}

    @property
    def meshes(self) -> list[str]:
        """Return the meshes referred to: absolute paths, or as written if not found."""
        return self._find_meshes()

    @property
    def assets(self) -> dict[str, bytes]:
        """Return what belongs beside the output, by paths relative to it.

        That are meshes that were made of others, such as convex pieces; for URDF with
        `meshes="copy"` the copies of all meshes, and with loops `robot.loops.yaml`; and files such
        as `scene.xml`.

        Raises:
            OSError: a mesh cannot be read any more.
        """
        files = dict(self.beside)
        if self.format == "urdf":
            meshes = self.meshes
            files |= self.finder.made_among(meshes)
            files |= self._copies.of(meshes) if self._copies else {}
        return files

    @property
    def root(self) -> Element:
        """Return the root element; every element knows where in the YAML it was made.

        Raises:
            ValueError: it stayed in a jail; see `has_root` of `yamaro.build`.
        """
        if self._root is None:
            self._root = unshared(self._document or self._tree())
        return self._root

    def robot_tree(self) -> Element:
        """Return the tree that the document was written from, in which no element is twice."""
        return unshared(self._tree())

    @property
    def root_name(self) -> str:
        """Return the name of the root element, such as `robot`."""
        return (self._document or self._tree()).name

    @property
    def robot(self) -> Robot:
        """Return the robot: its links and joints, with the place where each is written.

        Raises:
            YamaroError: the document is not a `<robot>`.
            ValueError: its tree stayed in a jail; see `has_root` of `yamaro.build`.
        """
        if self._robot is None:
            from .model.reading import read_robot
            from .sandbox.process import RareCollection

            with RareCollection():
                self._robot = read_robot(self._tree(), notes=self.notes, whole=True)
            self._robot.finder = self.finder
        return self._robot

    def __repr__(self) -> str:
        source = f" of {self.files[0]}" if self.files else ""
        count = len(self.warnings)
        warnings = f", {count} warning{'' if count == 1 else 's'}" if count else ""
        return f"<Build{source}: {self.format}{warnings}>"

    def _repr_html_(self) -> str | None:
        """Return what a notebook shows: the robot in 3D, or the text of another document."""
        return html_of(self)

    def _tree(self) -> Element:
        if self._finished is None:
            raise ValueError(
                "the tree of this build stayed in its jail: build with has_root=True to have it"
            )
        return self._finished

    def xml(self) -> str:
        """Return the document as text."""
        if len(self.pieces) > 1:
            self.pieces = ["".join(self.pieces)]
        return self.pieces[0]

    def encoded(self) -> Iterator[bytes]:
        """Give the document in UTF-8, chunk by chunk: a long one is never in memory as a whole."""
        for start in range(0, len(self.pieces), PIECES_IN_CHUNK):
            yield "".join(self.pieces[start : start + PIECES_IN_CHUNK]).encode()
