"""The table of targets: the output formats, and what all of Yamaro has to know of each.

The command line, Python, the docs and the tools read it. A target is a package of its name, whose
module `writer` has the function `write`.
"""

from __future__ import annotations

from ..diagnostics import WARNING, Diagnostic, YamaroError, failure
from .output import FOLDER, is_file_stem

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence

    from ..model.robot import Robot
    from ..source import Span
    from .output import Output, Wanted

    Write = Callable[[Robot, Wanted], Output]

BASES = ("fixed", "free")
OLDEST_MUJOCO = (3, 3)
"""The oldest release of MuJoCo that MJCF is written for."""


class Target:
    """An output format.

    Attributes:
        name: what `--to` calls it, and its package.
        title: what messages call it.
        ending: the end of the name of its file, or of its folder if it is one.
        comment: how a comment is written, or "" if the format has none: then the writer says itself
            that the document was generated, with `MARK`.
        is_folder: whether it is a folder of files, without a document.
        is_simulator: whether it says whether the root is fixed in the world.
        is_whole: whether it describes all of a robot, so that what it has no place for is lost.
        has_places: whether each element of its document knows where in the file it comes from, and
            is quick to write: `yamaro why` looks at these.
        run: the format for which the file is run: another one that it belongs to, or its own.
        versions: those that can be asked for, the default first; none if they are not listed.
        version_option: the option of a build that asks for one, or "".
        beside: the names of files beside the document that are not in `FOLDER`, `*` for that of the
            document; in a folder, those that begin with a dot.
        library: what it needs that is not always installed.
        extra: the extra that has it, by default the one of its name.
        endings: those of file names that promise this format.
        refused: those of them that it cannot be written to; with `conversion`, how to get there.
        conversion: for a file name without ending.
        own_codes: the codes of what concerns a robot only in this format.
    """

    __slots__ = (
        "beside", "comment", "conversion", "ending", "endings", "extra", "has_places", "is_folder",
        "is_simulator", "is_whole", "library", "name", "own_codes", "refused", "run", "title",
        "version_option", "versions",
    )  # fmt: skip

    def __init__(
        self,
        name: str,
        title: str,
        ending: str,
        *,
        comment: str = "<!-- {} -->",
        is_folder: bool = False,
        is_simulator: bool = False,
        is_whole: bool = False,
        has_places: bool = False,
        run: str = "",
        versions: tuple[str, ...] = (),
        version_option: str = "",
        beside: tuple[str, ...] = (),
        library: str = "",
        extra: str = "",
        endings: tuple[str, ...] = (),
        refused: tuple[str, ...] = (),
        conversion: str = "",
        own_codes: Collection[str] = (),
    ) -> None:
        self.name = name
        self.title = title
        self.ending = ending
        self.comment = comment
        self.is_folder = is_folder
        self.is_simulator = is_simulator
        self.is_whole = is_whole
        self.has_places = has_places
        self.run = run or name
        self.versions = versions
        self.version_option = version_option
        self.beside = beside
        self.library = library
        self.extra = extra or name
        self.endings = endings or (ending,)
        self.refused = refused
        self.conversion = conversion
        self.own_codes = frozenset(own_codes)

    @property
    def is_xml(self) -> bool:
        """Whether its document is XML."""
        return self.comment.startswith("<!--") and not self.is_folder

    def may_hold(self, name: str) -> bool:
        """Return whether a file beside a document, or in the folder of this format, can be it."""
        if self.is_folder:
            return name in self.beside or all(map(is_file_stem, name.split("/")))
        return name.startswith(f"{FOLDER}/") or any(
            name == each if each[0] != "*" else is_file_stem(name) and name.endswith(each[1:])
            for each in self.beside
        )

    def missing(self, span: Span) -> YamaroError:
        """Return the error that the library it needs is not installed."""
        return failure(
            "missing-extra",
            f"{self.title} needs {self.library}",
            span,
            hint=f"pip install 'yamaro[{self.extra}]'",
        )


TARGETS = {
    each.name: each
    for each in (
        Target(
            "urdf",
            "URDF",
            ".urdf",
            is_whole=True,
            has_places=True,
            beside=("*.loops.yaml",),
            own_codes=("capsule-needs-urdf-1.1", "lost-in-urdf", "needs-version"),
        ),
        Target(
            "sdf",
            "SDF",
            ".sdf",
            is_simulator=True,
            is_whole=True,
            has_places=True,
            versions=("1.11", "1.9", "1.12"),
            version_option="sdf_version",
        ),
        Target(
            "mjcf",
            "MJCF",
            ".xml",
            is_simulator=True,
            is_whole=True,
            has_places=True,
            version_option="mujoco_version",
            beside=("scene.xml",),
            endings=(".mjcf",),
        ),
        Target(
            "srdf",
            "SRDF",
            ".srdf",
            run="urdf",
            library="pinocchio and coal, which find the links that never touch",
        ),
        Target(
            "usd",
            "USD",
            ".usda",
            comment="# {}",
            is_simulator=True,
            is_whole=True,
            library="the library usd-core",
            endings=(".usda", ".usd", ".usdc", ".usdz"),
            refused=(".usdc", ".usdz"),
            conversion="OpenUSD converts it: Usd.Stage.Open('{0}.usda').Export('{0}.usdc')",
        ),
        Target(
            "interface",
            "the interface",
            ".interface.json",
            comment="",
            is_simulator=True,
            run="urdf",
            endings=(".json",),
        ),
        Target("mjlab", "mjlab", "_mjlab.py", comment="# {}", is_simulator=True, run="mjcf"),
        Target(
            "isaaclab",
            "Isaac Lab",
            "_isaaclab.py",
            comment="# {}",
            is_simulator=True,
            run="usd",
            library="the library usd-core",
            extra="usd",
        ),
        Target(
            "controllers",
            "the file of controllers",
            "_controllers.yaml",
            comment="# {}",
            run="urdf",
        ),
        Target(
            "moveit",
            "a MoveIt configuration",
            "_moveit_config",
            is_folder=True,
            run="urdf",
            beside=(".setup_assistant",),
            library="pinocchio and coal, which find the links that never touch",
            extra="srdf",
        ),
        Target(
            "curobo",
            "cuRobo's configuration",
            "_curobo.yml",
            comment="# {}",
            run="urdf",
            library="pinocchio and coal, which find the links that never touch",
            extra="srdf",
        ),
    )
}
"""The output formats by their names."""


def release(version: str) -> tuple[int, int]:
    """Return the release that a version such as "3.12" or "3.3.7" is of, to compare it.

    Raises:
        ValueError: it is not a version.
    """
    numbers = version.split(".")
    if len(numbers) not in (2, 3) or not all(
        each.isascii() and each.isdigit() and len(each) < 5 for each in numbers
    ):
        raise ValueError(version)
    return int(numbers[0]), int(numbers[1])


def write_target(robot: Robot, wanted: Wanted) -> Output:
    """Return a robot in a format.

    Raises:
        YamaroError: the format cannot hold it.
    """
    from importlib import import_module

    target = TARGETS[wanted.format]
    name = f"{__package__}.{target.name}"
    try:
        write: Write = import_module(f"{name}.writer").write
    except ImportError as error:
        if error.name in (name, f"{name}.writer"):
            raise failure(
                "missing-extra",
                f"this version cannot write {target.title}",
                robot.span,
                hint="update Yamaro",
            ) from None
        if not target.library:
            raise
        raise target.missing(robot.span) from None
    output = write(robot, wanted)
    if target.run == target.name and any(raw.format != target.name for raw in robot.raw()):
        from .foreign_xml import lost_blocks

        output.losses = [*output.losses, *lost_blocks(robot, target.name)]
    return output


def found_for(format: str, diagnostics: Sequence[Diagnostic]) -> list[Diagnostic]:
    """Return copies of what was found, except for what concerns other formats alone."""
    others = [each.own_codes for each in TARGETS.values() if each.name != format]
    left_out = frozenset().union(*others)
    return [each.copy() for each in diagnostics if each.code not in left_out]


def assumed_base(robot: Robot, asked: str | None) -> list[Diagnostic]:
    """Return a warning if nothing says whether the root is fixed; else nothing."""
    from ..model.kinematics import base_of

    base, reason = base_of(robot, asked)
    if not reason:
        return []
    return [
        Diagnostic(
            "base-assumed",
            f"the base is assumed to be {base}, since {reason}",
            robot.span,
            hint="pass --base fixed or --base free; a root link 'world' is fixed as well"
            if robot.span.source.is_xml
            else "write 'base: fixed' or 'base: free' in the main file, or pass --base",
            severity=WARNING,
        )
    ]


def file_name_for(name: str, format: str, stem: str) -> str:
    """Return what a robot's file in a folder is called: by its name, or else as its source is."""
    if not is_file_stem(name):
        name = stem if is_file_stem(stem) else "robot"
    target = TARGETS[format]
    if target.ending.endswith(".py"):
        name = module_stem(name)
    if name.casefold() + target.ending in target.beside:
        name += "_robot"
    return name + target.ending


def module_stem(name: str) -> str:
    """Return a name as the start of the name of a Python module: with nothing but letters."""
    plain = "".join(each if f"_{each}".isidentifier() else "_" for each in name)
    return plain if plain.isidentifier() else f"robot_{plain}"
