"""Check of the files a robot refers to: meshes, textures, and the packages that hold them."""

from __future__ import annotations

from ..diagnostics import WARNING
from ..model.values import attribute_text, child_named
from ..xml.tree import Element
from .context import CheckContext, label

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from ..diagnostics import Reporter
    from ..files.installed import InstalledPackage
    from ..source import Span

    PackageFault = Callable[[str, Span], tuple[str, Sequence[str]] | None]

PACKAGE_SCHEME = "package://"
LOCAL_SCHEMES = (PACKAGE_SCHEME, "file://")


def check_files(
    context: CheckContext,
    *,
    resolve_mesh: Callable[[str, Span], str | None],
    package_fault: PackageFault | None,
    path_meant: Callable[[str, Span], str | None] | None = None,
) -> None:
    """Report each file that is not there and each unknown package once, where first used."""
    told: set[str] = set()
    for element, owner in _file_references(context.file_owners):
        filename = attribute_text(element, "filename")
        if filename is None or filename in told or not is_local(filename):
            continue
        told.add(filename)
        context.outermost = owner
        span = element.value_span("filename")
        what = f"the {element.name} '{filename}' of {label(owner)}"
        if not filename.strip():
            context.report(
                "missing-mesh-file",
                f"the {element.name} of {label(owner)} has an empty filename",
                element,
                attribute="filename",
                hint="write a path, or package://my_robot/meshes/arm.stl",
            )
            continue
        if resolve_mesh(filename, span) is not None:
            continue
        package = package_of(filename)
        fault = None
        if package is not None and package_fault is not None:
            fault = package_fault(package, span)
        if package is None or fault is None:
            path = path_meant(filename, span) if path_meant is not None else None
            context.report(
                "missing-mesh-file",
                f"{what} does not exist",
                element,
                attribute="filename",
                hint="a relative path starts at the folder of the file that contains it"
                if package is None
                else "the package exists, but does not contain this file; file names are "
                "case-sensitive",
                notes=() if path is None else [f"searched for {path}"],
            )
        elif package not in told:
            told.add(package)
            hint, places = fault
            looked = "; searched in " + ", ".join(places) if places else ""
            context.report(
                "unknown-package",
                f"the package '{package}', where {label(owner)} has its {element.name}, is not "
                "found",
                element,
                attribute="filename",
                hint=f"{hint}{looked}",
                severity=WARNING,
            )
    context.outermost = None


def _file_references(owners: list[Element]) -> Iterator[tuple[Element, Element]]:
    """Yield each mesh and texture element with the link or material that holds it."""
    for owner in owners:
        if owner.name == "material":
            texture = child_named(owner, "texture")
            if texture is not None:
                yield texture, owner
        elif owner.name == "link":
            for section in owner.children:
                if not isinstance(section, Element) or section.name not in ("visual", "collision"):
                    continue
                for holder_name, name in (("geometry", "mesh"), ("material", "texture")):
                    holder = child_named(section, holder_name)
                    element = child_named(holder, name) if holder is not None else None
                    if element is not None:
                        yield element, owner


def is_local(filename: str) -> bool:
    """Return whether a file can be looked up here: no http:// and no model:// of a simulator."""
    return "://" not in filename or filename.startswith(LOCAL_SCHEMES)


REMOTE = ("http", "https", "ftp")
SCHEMES = ("package", "file", "model", *REMOTE)
CAD = frozenset(
    ("step", "stp", "iges", "igs", "sldprt", "sldasm", "fcstd", "blend", "x_t", "ipt", "f3d", "skp")
)
"""Endings of files in which programs of design keep their work; no reader of URDF reads them."""


def advise_on_addresses(context: CheckContext, advice: CheckContext) -> None:
    """Report files at addresses, or of kinds, that readers of URDF do not read.

    Args:
        context: knows which links and materials refer to files.
        advice: takes what is found; a file is reported once.
    """
    seen: set[str] = set()
    for element, owner in _file_references(context.file_owners):
        filename = attribute_text(element, "filename") or ""
        scheme, separator, _ = filename.partition("://")
        if filename in seen or "$" in filename:
            continue
        seen.add(filename)
        advice.outermost = owner
        what = f"the {element.name} '{filename}' of {label(owner)}"
        if separator and scheme in REMOTE:
            advice.report(
                "remote-mesh",
                f"{what} is on the web, where only programs of ROS fetch it",
                element,
                attribute="filename",
                hint="download it, and write package://my_robot/meshes/arm.stl",
            )
        elif separator and scheme not in SCHEMES:
            hint, fix = advice.near(scheme, SCHEMES, element.value_span("filename"))
            advice.report(
                "bad-mesh-address",
                f"{what} has the scheme '{scheme}', which no reader of URDF knows",
                element,
                attribute="filename",
                hint=hint or "write package://my_robot/meshes/arm.stl",
                fix=fix,
            )
        elif "\\" in filename:
            advice.report(
                "bad-mesh-address",
                f"{what} has backslashes, which only Windows reads",
                element,
                attribute="filename",
                hint=f"write {filename.replace(chr(92), '/')}",
            )
        elif filename.rpartition(".")[2].lower() in CAD and element.name == "mesh":
            advice.report(
                "bad-mesh-address",
                f"{what} is a file of a design program, which no reader of URDF reads",
                element,
                attribute="filename",
                hint="export it as STL, OBJ, COLLADA or glTF",
            )
    advice.outermost = None


def package_of(filename: str) -> str | None:
    """Return the package of a package:// address."""
    if not filename.startswith(PACKAGE_SCHEME):
        return None
    return filename[len(PACKAGE_SCHEME) :].partition("/")[0]


# --- packages of ROS and of Python ------------------------------------------------------------


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
        reporter.report(
            "hidden-package",
            f"the ROS package '{package.name}' is used, not the Python package of that name",
            span or root.span,
            hint=f"to choose, set its folder: --package {package.name}:=FOLDER",
            notes=[
                f"the ROS package is {folder}",
                f"the Python package is {package.folder} ({origin})",
            ],
        )
