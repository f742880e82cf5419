"""One conversion as it was asked for: what every phase of the pipeline may need to know."""

from __future__ import annotations

from .files.mesh_files import RELATIVE

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from .diagnostics import Adjustment, Diagnostic, Reporter
    from .files.mesh_files import MeshFinder
    from .files.packages import PackageFinder
    from .source import Source, Span
    from .targets.assets import Assets
    from .targets.mesh_paths import MeshPaths
    from .xml.tree import Element


_OF_THIS_MACHINE = (
    "hidden-package", "large-mesh", "missing-extra", "missing-mesh-file", "unknown-package",
)  # fmt: skip
"""The codes of what depends on the files and packages that are installed."""


class Target:
    """An output format that was asked for, and how.

    Attributes:
        format: one of `FORMATS`.
        paths: how its document names meshes.
        has_meshes: whether shapes that are meshes are written.
        base: `fixed` or `free`, or None to do as the robot says.
        repairs_inertia: whether inertia that no body can have is balanced.
        version: of the format, or "" for the default.
        file_name: what the file of the document is called: "" on standard output, None to call it
            like the robot.
        progress: is called with how far long work is, or None.
    """

    __slots__ = (
        "base", "file_name", "format", "has_meshes", "paths", "progress", "repairs_inertia",
        "version",
    )  # fmt: skip

    def __init__(
        self,
        format: str,
        paths: MeshPaths,
        *,
        has_meshes: bool = True,
        base: str | None = None,
        repairs_inertia: bool = False,
        version: str = "",
        file_name: str | None = "",
        progress: Callable[[float], None] | None = None,
    ) -> None:
        self.format = format
        self.paths = paths
        self.has_meshes = has_meshes
        self.base = base
        self.repairs_inertia = repairs_inertia
        self.version = version
        self.file_name = file_name
        self.progress = progress


class RelativePaths:
    """Names meshes by paths relative to the folder of the output, if a robot has any.

    Attributes:
        finder: finds files and packages.
        assets: no copies.
    """

    __slots__ = ("_folder", "_is_cached", "_run", "finder")

    assets: Assets | None = None

    def __init__(
        self,
        folder: str,
        finder: MeshFinder,
        run: Callable[[Callable[[], bytes]], bytes],
        *,
        is_cached: bool,
    ) -> None:
        """Name files for an output in a folder; see `MeshPaths`."""
        self.finder = finder
        self._folder = folder
        self._run = run
        self._is_cached = is_cached

    def whole(self) -> MeshPaths:
        """Return what knows all of it."""
        from .targets.mesh_paths import MeshPaths

        return MeshPaths(
            RELATIVE, self._folder, self.finder, run=self._run, is_cached=self._is_cached
        )

    def applied_to(self, root: Element) -> Element:
        """Return a robot with these paths; `root` stays as it is."""
        return self.whole().applied_to(root)


class Request:
    """What is built, with which variables, and where messages go.

    Attributes:
        source: the main file, as it was read.
        stem: the name of the robot, if the file does not name it.
        variables: the variables passed, by name.
        places: where the name of each of them is written.
        packages: finds packages.
        paths: finds the files of meshes, and how they are named.
        reporter: takes the warnings.
        adjustment: which codes are allowed and denied.
        has_advice: whether all advice is wanted, and not only that of codes which are denied.
        has_gazebo: whether sensors and surfaces are written for Gazebo.
        records: whether places hold which variables were read there; see `RecordedSpan`.
        targets: the output formats asked for; none for URDF or other XML without a word about
            what it cannot hold.
        is_partial: whether formats that cannot be written are left out, and losses not reported.
    """

    __slots__ = (
        "adjustment",
        "has_advice",
        "has_gazebo",
        "is_partial",
        "packages",
        "paths",
        "places",
        "records",
        "reporter",
        "source",
        "stem",
        "targets",
        "variables",
    )

    def __init__(
        self,
        source: Source,
        *,
        stem: str,
        variables: dict[str, object],
        places: dict[str, Span],
        packages: PackageFinder,
        paths: MeshPaths | RelativePaths,
        reporter: Reporter,
        adjustment: Adjustment,
        has_advice: bool,
        has_gazebo: bool = False,
        records: bool = False,
        targets: Sequence[Target] = (),
    ) -> None:
        self.source = source
        self.stem = stem
        self.variables = variables
        self.places = places
        self.packages = packages
        self.paths = paths
        self.reporter = reporter
        self.adjustment = adjustment
        self.has_advice = has_advice
        self.has_gazebo = has_gazebo
        self.records = records
        self.targets = targets
        self.is_partial = False

    def allow(self, diagnostics: Sequence[Diagnostic]) -> None:
        """Turn what the command line allows into warnings, and mark what comments accept."""
        self.adjustment.allow(diagnostics)
        if diagnostics:
            from .allowances import accept

            accept(diagnostics)

    def looks_for(self, code: str) -> bool:
        """Return whether a finding with a code is reported here wherever there is one."""
        from .targets.writers import URDF_ONLY

        formats = [target.format for target in self.targets] or ["urdf"]
        if code in URDF_ONLY:
            return "urdf" in formats
        if code == "base-assumed":
            return not {"mjcf", "sdf", "usd"}.isdisjoint(formats)
        if code in _OF_THIS_MACHINE or ".srdf" in self.source.name.lower():
            return False
        return "-in-" not in code or code.partition("-in-")[2] in formats

    def wanted_advice(self) -> Callable[[str], bool] | None:
        """Return what decides which codes of advice to report, or None if no advice is wanted."""
        if self.has_advice:
            return lambda code: True
        return self.adjustment.denied.__contains__ if self.adjustment.denied else None
