"""Builds that leave a jail: as they are sent from there, and as they are made again here."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from .confined import failure_of_jail
from .policy import Policy
from .request import Request
from .result import Build
from .sandbox.deep_stack import run_on_deep_stack
from .sandbox.jail import JailAnswerBroken, JailError
from .sandbox.transfer import Document, Outcome
from .xml.tree import unshared
from .xml.writer import write_pieces


def outcome_of_build(build: Build, *, has_root: bool) -> Outcome:
    """Return what leaves the jail of a build; with `has_root` the tree does too."""
    return Outcome(
        diagnostics=[*build.warnings, *build.accepted],
        pieces=() if build.outputs else build.pieces,
        files=build.files,
        meshes=build.meshes,
        made={
            **build.finder.made_among(build.meshes),
            **({} if build.outputs else build.beside),
        },
        noted=build.noted,
        root=build.robot_tree() if has_root else None,
        notes=[unshared(note) for note in build.notes] if has_root else (),
        documents=[
            *(_document_of(each, build, has_root=has_root) for each in build.outputs.values()),
            *(Document(format, "", refusal=reason) for format, reason in build.refused.items()),
        ],
    )


def _document_of(build: Build, first: Build, *, has_root: bool) -> Document:
    """Return what leaves the jail of a build in a format; `first` is that of the first format."""
    from .targets.losses import packed

    has_own = has_root and build.notes is not first.notes
    return Document(
        build.format,
        build.xml(),
        root=build.root if has_root and build.format != "urdf" else None,
        losses=packed(build.losses, build.format),
        assets=build.beside,
        robot=build.robot_tree() if has_own else None,
        file_name=build.file_name,
        notes=[unshared(note) for note in build.notes] if has_own else (),
    )


def build_of_outcome(outcome: Outcome, request: Request, policy: Policy) -> Build:
    """Return the build that left a jail; meshes are named here, as only here the output is known.

    Raises:
        YamaroError: the document is longer than the limits allow, or the formats are not those
            asked for.
    """
    formats = request.options.target
    beside: dict[str, bytes] = {}
    try:
        if outcome.made:
            from .targets.output import FOLDER

            made = {name: outcome.made[name] for name in outcome.made if name.startswith(FOLDER)}
            beside = {name: outcome.made[name] for name in outcome.made if name not in made}
            _check_beside("urdf", beside)
            if made:
                request.finder.made.adopt(made)
    except JailError as error:
        raise failure_of_jail(error, policy, request.source.name) from None
    except ValueError as error:
        broken = JailAnswerBroken(f"its answer is malformed: {error}")
        raise failure_of_jail(broken, policy, request.source.name) from None
    if formats is not None:
        try:
            return _first_output(outcome, formats, request)
        except JailError as error:
            raise failure_of_jail(error, policy, request.source.name) from None
    root = outcome.root
    if root is not None and root.name == "robot":  # as it was written
        outcome.pieces = run_on_deep_stack(
            lambda: write_pieces(request.paths.applied_to(root), policy.limits)
        )

    return Build(
        lambda: outcome.meshes,
        finder=request.finder,
        copies=request.copies,
        finished=outcome.root,
        pieces=outcome.pieces,
        warnings=outcome.diagnostics,
        files=outcome.files,
        notes=outcome.notes,
        noted=outcome.noted,
        assets=beside,
    )


def _check_beside(format: str, names: Iterable[str]) -> None:
    """Raise JailAnswerBroken unless all of these can be names of files beside a document."""
    from .targets.table import TARGETS

    if not all(map(TARGETS[format].may_hold, names)):
        raise JailAnswerBroken("the answer holds a file of another name")


def _first_output(outcome: Outcome, formats: Sequence[str], request: Request) -> Build:
    """Return the build of the first format that left a jail, with those of all in its `outputs`."""
    found = {each.format: each for each in outcome.documents}
    if found.keys() != set(formats) or len(found) < len(outcome.documents):
        raise JailAnswerBroken("the answer holds other formats than were asked for")
    builds = {
        format: _build_of_document(found[format], outcome, request)
        for format in formats
        if not found[format].refusal
    }
    if not builds:
        raise JailAnswerBroken("the answer holds no document")
    first = next(iter(builds.values()))
    first.outputs = builds
    first.refused = {each.format: each.refusal for each in outcome.documents if each.refusal}
    return first


def _build_of_document(document: Document, outcome: Outcome, request: Request) -> Build:
    from .targets.losses import unpacked
    from .targets.output import is_file_stem
    from .targets.table import TARGETS

    target = TARGETS[document.format]
    has_own = document.robot is not None
    try:
        losses = unpacked(document.losses)
    except ValueError as error:
        raise JailAnswerBroken(f"its answer is malformed: {error}") from None
    file_name = request.file_name
    if file_name is None:
        file_name = document.file_name
        stem = file_name.removesuffix(target.ending)
        if stem == file_name or not is_file_stem(stem):
            raise JailAnswerBroken("the answer does not name its file")
    _check_beside(document.format, document.assets or ())
    return Build(
        lambda: outcome.meshes,
        finder=request.finder,
        copies=request.copies,
        finished=document.robot if has_own else outcome.root,
        pieces=[document.text],
        warnings=outcome.diagnostics,
        files=outcome.files,
        notes=document.notes if has_own else outcome.notes,
        noted=outcome.noted,
        format=document.format,
        file_name=file_name,
        document=document.root,
        losses=losses,
        assets=document.assets,
    )
