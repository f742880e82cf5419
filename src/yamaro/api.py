"""The functions that the package offers: `build`, `convert` and `load`."""

from __future__ import annotations

import sys

from .options import DEFAULTS, OF_FILES, UsageError, explains_variables, merged_variables
from .policy import Policy
from .program import Program, as_built_in, converted

TYPE_CHECKING = False
if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Mapping

    from typing_extensions import Unpack

    from .options import AllOptions
    from .result import Build


@explains_variables("variables={{'{name}': {value}}}")
def build(path: str | os.PathLike[str], **options: Unpack[AllOptions]) -> Build:
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
        gazebo: also write the sensors and the surfaces of collisions for Gazebo, and into SDF the
            systems that drive joints.
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
        mujoco_version: the version of MuJoCo that reads MJCF, such as "3.3", which is the oldest;
            by default the newest.
        model: the name of the model to read, of an MJCF or SDF file that has several; by default
            the first.
        overlay: what changes values of the robot: the path of an overlay or calibration, the same
            as a mapping, or several of them, of which later ones win.
        on_progress: is called with how far the work is, from 0 to 1, where a format takes long.
        refitting: what to work out from the meshes that links collide with, as `yamaro fit` does.
        partial: leave out formats that cannot be written, which `Build.refused` then explains, and
            do not warn of losses.
        alone: nothing is taken of the build but its document, so that a loop, which URDF has in a
            file beside it, is an error.

    Raises:
        YamaroError: the input has errors; it holds them, and the warnings found before.
        UsageError: the main file cannot be read, a `name:=value` or the value of another argument
            is malformed, or a code of `allow` or `deny` is unknown or always an error.
    """
    return Program(path, **options).build()


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
def load(path: str | os.PathLike[str], **options: Unpack[AllOptions]) -> Program:
    """Return a program that converts a file again and again.

    Args:
        path: the main file.
        options: as `build` takes them, for all conversions. Except for `text`, `loader`, `policy`
            and `packages`, each can have others.

    Raises:
        YamaroError: the main file has errors, which are found without running it.
        OSError: the main file cannot be read.
        ValueError: an option makes no sense, such as a code that cannot be allowed or denied.
    """
    import threading  # noqa: F401 - lets `deep_stack` keep its thread for the next conversion

    try:
        program = Program(path, **options)
        program.parse()
    except UsageError as error:
        raise as_built_in(error) from None
    return program


if "inspect" in sys.modules:  # as in a notebook, which completes the keywords that it finds there
    from inspect import Parameter, signature

    for _function, _left_out in ((build, ()), (load, ()), (Program.build, OF_FILES)):
        _first, _ = signature(_function).parameters.values()
        _keywords = [
            Parameter(_name, Parameter.KEYWORD_ONLY, default=_default)
            for _name, _default in DEFAULTS.items()
            if _name not in _left_out
        ]
        _own = signature(_function).replace(parameters=[_first, *_keywords])
        setattr(_function, "__signature__", _own)  # noqa: B010 - functions are not typed to have it
