"""What `yamaro migrate` does with one file."""

from __future__ import annotations

import os

from ...files.loader import FileLoader, LoadError, check_size
from ...options import UsageError
from ...program import Program
from ...request import refusal_of_main
from ...source import STANDARD_INPUT, STANDARD_INPUT_NAME
from ...xml.reader import decode_xml, read_xml
from .refused import build_allowing, options_to_allow
from .urdf import Migration, migrate_urdf

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...policy import Limits, Policy
    from ...source import Source
    from ...xml.tree import Element
    from .xacro.sources import XacroMigration


def read_file(path: str, limits: Limits, data: bytes | None = None) -> Source:
    """Return an XML file.

    Args:
        path: the file, or `-`.
        limits: how large it may be.
        data: its content, read from `path` if it is None.

    Raises:
        YamaroError: it is not in the encoding that it says.
        UsageError: it cannot be read.
    """
    if not path:
        raise UsageError("the file name is empty")
    absolute = "" if path == STANDARD_INPUT else os.path.abspath(path)
    try:
        if data is None:
            data = FileLoader(limits).read(absolute)
        check_size(len(data), limits)
    except LoadError as error:
        if error.hint is not None:
            raise refusal_of_main(path, error) from None
        raise UsageError(f"cannot read '{path}': {error}") from None
    name = STANDARD_INPUT_NAME if path == STANDARD_INPUT else path
    return decode_xml(data, name=name, path=absolute)


def migrate_file(
    path: str, limits: Limits, data: bytes | None = None, *, exact: bool = False
) -> Migration:
    """Return the Yamaro source of a URDF, or of any other XML; raises what `read_file` does.

    Raises:
        YamaroError: it is not XML.
    """
    return migrate_source(read_file(path, limits, data), limits, exact=exact)


def migrate_source(
    source: Source, limits: Limits, *, policy: Policy | None = None, exact: bool = False
) -> Migration:
    """Return the Yamaro source of an XML file that was read; raise YamaroError if it is not XML.

    With `exact`, poses that the file leaves out are left out of what the source makes.
    """
    stem = os.path.splitext(source.path)[0] or "robot"

    allowed: list[str] = []

    def build(text: str) -> Element:
        built, allowed[:] = build_allowing(
            lambda codes: Program(f"{stem}.yaml", text=text, policy=policy, allow=codes).build(
                on_message=ignore, meshes="keep"
            )
        )
        return built.root

    migration = migrate_urdf(read_xml(source, limits), build, exact=exact)
    migration.allowed = allowed
    return migration


def report(migration: Migration | XacroMigration) -> str:
    """Return what is said of a migration: how large the robot is, or in what it differs."""
    if migration.differences:
        return "\n".join([f"different: {difference}" for difference in migration.differences])
    if migration.root.name != "robot":
        return "identical"
    children = migration.root.elements()
    links = sum(child.name == "link" for child in children)
    joints = sum(child.name == "joint" for child in children)
    counts = f"{_counted(links, 'link')}, {_counted(joints, 'joint')}"
    if migration.defaults:
        counts += f"; {_counted(migration.defaults, 'default')} written out"
    if migration.allowed:
        counts += f"; parsers refuse it: build it with {options_to_allow(migration.allowed)}"
    return f"identical: {counts}"


def _counted(count: int, what: str) -> str:
    return f"{count:,} {what}{'' if count == 1 else 's'}"


def ignore(message: str) -> None:
    """Take a message of a build."""
