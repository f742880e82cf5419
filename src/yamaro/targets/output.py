"""What the writer of a format gives: the document, files beside it, and what it could not hold."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ..diagnostics import Frame as Step
    from ..source import Span
    from ..xml.tree import Element
    from .mesh_paths import MeshPaths

LOST, APPROXIMATED, RENAMED = "lost", "approximated", "renamed"


class Loss:
    """Something of a robot that a format cannot hold as it is.

    Losses of one `kind` and one `what` are reported as one, with a count.

    Attributes:
        kind: `LOST`, `APPROXIMATED` or `RENAMED`.
        what: what cannot be held, in the plural and the same words for all of it: "soft limits".
        owner: whose it is: "joint 'elbow_joint'".
        how: what is written in its place, or ""; the same words for all of one `what`, except for
            what is renamed, where it is the new name.
        hint: what to write instead, or "".
        span: where it is written.
        trace: the calls and includes that led there, innermost first.
    """

    __slots__ = ("hint", "how", "kind", "owner", "span", "trace", "what")

    def __init__(
        self,
        kind: str,
        what: str,
        owner: str,
        span: Span,
        *,
        trace: Step | None = None,
        how: str = "",
        hint: str = "",
    ) -> None:
        self.kind = kind
        self.what = what
        self.owner = owner
        self.span = span
        self.trace = trace
        self.how = how
        self.hint = hint


class Wanted:
    """What is asked for with a format.

    Attributes:
        format: `urdf`, `sdf`, `mjcf`, `srdf` or `usd`.
        name: of the robot, if it has none of its own.
        is_fixed: whether the root of the robot is fixed in the world.
        paths: finds the files of meshes and textures, and says how the document names them.
        has_meshes: whether shapes that are meshes are written.
        repairs_inertia: whether inertia that no body can have is balanced, and reported.
        version: of the format, or "" for the default.
    """

    __slots__ = (
        "format", "has_meshes", "is_fixed", "name", "paths", "repairs_inertia", "version",
    )  # fmt: skip

    def __init__(
        self,
        format: str,
        *,
        name: str,
        is_fixed: bool,
        paths: MeshPaths,
        has_meshes: bool = True,
        repairs_inertia: bool = False,
        version: str = "",
    ) -> None:
        self.format = format
        self.name = name
        self.is_fixed = is_fixed
        self.paths = paths
        self.has_meshes = has_meshes
        self.repairs_inertia = repairs_inertia
        self.version = version


class Output:
    """A robot in a format.

    A writer is a function `write(robot: Robot, wanted: Wanted) -> Output`. It raises YamaroError
    for what its consumers would refuse, with all the errors it finds.

    Attributes:
        root: the document, each element at the place of what it was made of.
        text: the document as text, where it is not the XML of `root`; or "".
        losses: what the format cannot hold as it is, in the order of the robot.
        files: what belongs beside the document, by paths relative to it.
    """

    __slots__ = ("files", "losses", "root", "text")

    def __init__(
        self,
        root: Element,
        losses: Sequence[Loss] = (),
        files: Mapping[str, bytes] | None = None,
        *,
        text: str = "",
    ) -> None:
        self.root = root
        self.text = text
        self.losses = losses
        self.files = files or {}
