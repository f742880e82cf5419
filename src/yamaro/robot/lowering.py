"""What one run of lowering carries along: findings, caches, and names to resolve at the end."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..diagnostics import Diagnostic, Reporter, YamaroError
    from ..source import Span
    from ..xmltree import Element
    from .mesh import SolidMoments


class Lowering:
    """One run of `part.lower`.

    Attributes:
        has_capsule: whether the robot's URDF version knows capsules.
        numbers: the numbers in a text as words and values; most texts occur many times.
        moments: the volume integrals of the mesh files read so far, by path.
        near_keys: what a key in a place was found to be a misspelling of.
        parents: `<parent>` elements made here, whose link may yet be the name of a part.
        mimics: `<mimic>` elements made here, whose joint may yet be the name of a part.
        part_links: the link of each part, by the part's name.
        part_joints: the joint of each part, by the part's name.
    """

    __slots__ = (
        "_reported",
        "errors",
        "has_capsule",
        "mimics",
        "moments",
        "near_keys",
        "numbers",
        "parents",
        "part_joints",
        "part_links",
        "reporter",
        "resolve_mesh",
    )

    def __init__(
        self,
        reporter: Reporter,
        resolve_mesh: Callable[[str, Span], str | None],
        *,
        has_capsule: bool,
    ) -> None:
        """Start a run with nothing found."""
        self.reporter = reporter
        self.resolve_mesh = resolve_mesh
        self.has_capsule = has_capsule
        self.errors: list[Diagnostic] = []
        self.numbers: dict[str, tuple[tuple[str, ...], tuple[float, ...]]] = {}
        self.moments: dict[str, SolidMoments] = {}
        self.near_keys: dict[tuple[str, str], str | None] = {}
        self.parents: list[Element] = []
        self.mimics: list[Element] = []
        self.part_links: dict[str, str] = {}
        self.part_joints: dict[str, str] = {}
        self._reported: set[object] = set()

    def absorb(self, error: YamaroError) -> None:
        """Record the errors of an exception and go on; the same at the same place counts once."""
        for diagnostic in error.diagnostics:
            key = (diagnostic.code, diagnostic.message, diagnostic.span.key())
            if key not in self._reported:
                self._reported.add(key)
                self.errors.append(diagnostic)
