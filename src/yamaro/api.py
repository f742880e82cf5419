"""The functions that the package offers: `build`, `convert` and `load`."""

from __future__ import annotations

from .arguments import UsageError, explains_variables, merged_variables
from .files.mesh_files import RELATIVE
from .policy import Policy
from .program import Program, as_built_in, converted

TYPE_CHECKING = False
if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from .files.loader import Loader
    from .result import Build


@explains_variables("variables={{'{name}': {value}}}")
def build(
    path: str | os.PathLike[str],
    *,
    command_line: Sequence[str] = (),
    variables: Mapping[str, object] | None = None,
    text: str | None = None,
    strict: bool = False,
    advice: bool = False,
    on_message: Callable[[str], None] | None = None,
    loader: Loader | None = None,
    policy: Policy | None = None,
    packages: Mapping[str, str] | None = None,
    has_root: bool = True,
    output: str | os.PathLike[str] | None = None,
    meshes: str = RELATIVE,
    gazebo: bool = False,
    allow: Iterable[str] = (),
    deny: Iterable[str] = (),
    records: bool = False,
    target: str | Sequence[str] | None = None,
    base: str | None = None,
    repair_inertia: bool = False,
    sdf_version: str | None = None,
    on_progress: Callable[[float], None] | None = None,
    partial: bool = False,
) -> Build:
    """Compile a file.

    Args:
        path: the main file: YAML, or by its ending a URDF, a robot in xacro or other XML; "-" with
            `text` for a text that is in no file.
        command_line: variables as `name:=value`, the value in YAML.
        variables: variables as Python objects.
        text: what to compile in place of the content of `path`.
        strict: raise warnings as errors.
        advice: also warn of what is legal but seldom meant.
        on_message: takes each line that `print` and `process` print; standard error by default.
        loader: gives the text of files; the disk by default.
        policy: how far the file is trusted; in full by default.
        packages: folders of ROS packages by name, before those that are found.
        has_root: without, a build that is made in a jail has no tree, `Build.root`, and no
            `Build.robot`: it takes time to bring them out.
        output: where the XML is to be written; relative paths of meshes start at its folder. By
            default at that of the main file. A name that ends in a slash is that of a folder, in
            which the file is called as `Build.file_name` says.
        meshes: how the XML names meshes and textures that are there: "relative", "keep" (as they
            are written), "absolute", "copy" (the files of `Build.assets`, which are not written),
            "package://NAME", "package://" (in the package that each is in; others by `file://`), or
            "none", without shapes that are meshes.
        gazebo: also write the sensors and the surfaces of collisions for Gazebo.
        allow: codes of diagnostics that are warnings, also with `strict`.
        deny: codes of diagnostics that are errors.
        records: let the places in the tree hold which variables were read there, for
            `yamaro why`; slower.
        target: the output format: "urdf", "sdf", "mjcf", "srdf" or "usd"; what it cannot hold is
            in `Build.losses`, and a warning. With several, the result is the build of the first,
            and `Build.outputs` has all. By default URDF or other XML, without such warnings.
        base: whether the root is "fixed" in the world or "free", in a format that says so; by
            default as the robot says.
        repair_inertia: balance inertia that no body can have, instead of refusing it.
        sdf_version: "1.11" (the default), "1.9" or "1.12".
        on_progress: is called with how far the work is, from 0 to 1, where a format takes long.
        partial: leave out formats that cannot be written, which `Build.refused` then explains, and
            do not warn of losses.

    Raises:
        YamaroError: the input has errors; it holds them, and the warnings found before.
        UsageError: the main file cannot be read, a `name:=value` or the value of another argument
            is malformed, or a code of `allow` or `deny` is unknown or always an error.
    """
    program = Program(
        path, text=text, loader=loader, policy=policy, packages=packages, allow=allow, deny=deny
    )
    return program.build(
        command_line=command_line, variables=variables, strict=strict, advice=advice,
        on_message=on_message, has_root=has_root, output=output, meshes=meshes, gazebo=gazebo,
        records=records, target=target, base=base, repair_inertia=repair_inertia,
        sdf_version=sdf_version, on_progress=on_progress, partial=partial,
    )  # fmt: skip


def convert(
    path: str | os.PathLike[str],
    /,
    *assignments: str,
    variables: Mapping[str, object] | None = None,
    allow: Iterable[str] = (),
    deny: Iterable[str] = (),
    **named: object,
) -> str:
    """Compile a file and return the XML.

    What the file prints goes to standard error; warnings are issued as `YamaroWarning`.

    Args:
        path: the main file: YAML, a URDF or a robot in xacro.
        assignments: variables of the main file, or arguments of xacro, as on the command line:
            `"length:=2"`.
        variables: the same as Python objects, as `build` takes them: `{"width": 0.3}`.
        allow: codes of diagnostics that are warnings.
        deny: codes of diagnostics that are errors.
        named: the same, one by one: `width=0.3`.

    Raises:
        YamaroError: the input has errors.
        OSError: the main file cannot be read.
        ValueError: an assignment is malformed.
    """
    if isinstance(named.get("policy"), Policy):
        raise TypeError("convert() takes no policy: write load(path, policy=policy).convert(…)")
    try:
        program = Program(path, allow=allow, deny=deny)
    except UsageError as error:
        raise as_built_in(error) from None
    return converted(program, assignments, merged_variables(variables, named))


@explains_variables("load(path).convert({name}={value})")
def load(
    path: str | os.PathLike[str],
    *,
    loader: Loader | None = None,
    policy: Policy | None = None,
    packages: Mapping[str, str] | None = None,
    allow: Iterable[str] = (),
    deny: Iterable[str] = (),
) -> Program:
    """Return a program that converts a file again and again.

    Args:
        path: the main file.
        loader: gives the text of files; the disk by default.
        policy: how far the file is trusted; in full by default.
        packages: folders of ROS packages by name, before those that are found.
        allow: codes of diagnostics that are warnings in all conversions.
        deny: codes of diagnostics that are errors in all conversions.

    Raises:
        YamaroError: the main file has errors, which are found without running it.
        OSError: the main file cannot be read.
        ValueError: a code of `allow` or `deny` is unknown or always an error.
    """
    import threading  # noqa: F401 - lets `deep_stack` keep its thread for the next conversion

    try:
        program = Program(
            path, loader=loader, policy=policy, packages=packages, allow=allow, deny=deny
        )
        program.parse()
    except UsageError as error:
        raise as_built_in(error) from None
    return program
