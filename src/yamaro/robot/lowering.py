"""What one run of lowering carries along: findings, caches, and names to resolve at the end."""

from __future__ import annotations

from ..diagnostics import settle
from ..xml.tree import Element
from ..xml.values import format_value
from .fields import with_attributes

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ..diagnostics import Diagnostic, Frame, Reporter, YamaroError
    from ..fitting.fit import Fit
    from ..fixes import Fix
    from ..model.inertia import SolidMoments
    from ..model.shapes import Inertia
    from ..source import Source, Span
    from ..xml.forms import Form
    from ..xml.tree import RobotNote, RobotWord
    from ..xml.values import Numbers
    from .control import PendingControl
    from .controllers import PendingController
    from .formed import Pattern
    from .mirror import Mirror
    from .naming import Naming

    PackageFault = Callable[[str, Span], tuple[str, Sequence[str]] | None]
    """Gives how to get a package that is not found, and where it was looked for; None if it is."""

    Outside = tuple[
        list[Element],
        list[Element],
        list[Mirror],
        list[tuple[RobotNote, str]],
        list[PendingControl | PendingController],
        list[RobotWord],
        dict[str, str],
        dict[str, str],
    ]
    Entered = tuple[Frame | None, int, int]
    """The trace in which a part was entered, and how many errors and warnings there were."""


class Fitter:
    """What the fitting of shapes to meshes needs of the build.

    Attributes:
        make_mesh: takes the name and the bytes of an STL that is made, and returns its `filename`.
        is_cached: whether results are kept on the disk from one run to the next.
        known: what was worked out in this build so far.
        on_work: is called with how far the work is, from 0 to 1.
        total: how many shapes are asked for, once the first one is worked out.
        is_for_urdf: whether the robot is written as URDF, where older versions have no capsules.
        differs_in_urdf: whether there is a capsule, which URDF holds as a cylinder and two spheres.
    """

    __slots__ = (
        "differs_in_urdf", "is_cached", "is_for_urdf", "known", "make_mesh", "on_work",
        "total",
    )  # fmt: skip

    def __init__(
        self,
        *,
        make_mesh: Callable[[str, bytes], str] | None = None,
        is_cached: bool = False,
        is_for_urdf: bool = False,
        known: dict[bytes, Fit] | None = None,
        on_work: Callable[[float], None] | None = None,
    ) -> None:
        """Hold it; see the class."""
        self.make_mesh = make_mesh
        self.is_cached = is_cached
        self.is_for_urdf = is_for_urdf
        self.known: dict[bytes, Fit] = {} if known is None else known
        self.on_work = on_work
        self.total = 0
        self.differs_in_urdf = False


class Lowering:
    """One run of `part.lower`.

    Attributes:
        has_words: whether there is anything that `finish.py` has to do.
        root: the robot, as it was evaluated.
        fits: what was worked out from the meshes of sections, by the identity of the key, with it.
        fitter: takes the meshes that are made.
        has_armatures: whether a `dynamics` has an armature, which is to be taken out of it.
        has_capsule: whether the robot's URDF version knows capsules.
        moments: the volume integrals of the mesh files read so far, by path.
        near_keys: what a key in a place was found to be a misspelling of.
        namings: what the joints and links of parts are called in a file, where it says so.
        numbers: the numbers in the texts read so far.
        quantities: the rows of numbers with units read so far, by the text and what fits there.
        inertias: the moments of inertia computed so far, as they are written.
        patterns: how to lower the parts of a form, or None where that has no pattern.
        parents: the joints whose first child is a `<parent>` made here, of which the link may yet
            be the name of a part.
        mimics: the joints with a `<mimic>` made here, of which the joint may yet be the name of a
            part.
        link_name: the name of the link that is being lowered.
        colors: the names of the materials that were made of a `color`, by its numbers.
        joint_type: the type of the joint that is being lowered, or None where it is missing.
        is_bound_to_joint: whether what is being lowered depends on that type, so that it is not the
            same wherever it is.
        reports: how often something was reported so far.
        trace: the calls and includes that led to the part that is being lowered.
        controls: controls and controllers whose joints are not chosen yet.
        references: notes with the attribute that may yet be the name of a part.
        overlays: overlays of included files, which change what those made once names are resolved.
        advice: what there is to say of overlays to who asks for advice.
        pending: the mirrors whose image is made once names are resolved, inner ones first.
        part_links: the link of each part, by the part's name.
        part_joints: the joint of each part, by the part's name.
    """

    __slots__ = (
        "_reported",
        "advice",
        "colors",
        "controls",
        "errors",
        "fits",
        "fitter",
        "has_armatures",
        "has_capsule",
        "has_words",
        "inertias",
        "is_bound_to_joint",
        "joint_type",
        "link_name",
        "may_read",
        "mimics",
        "moments",
        "namings",
        "near_keys",
        "numbers",
        "overlays",
        "package_fault",
        "parents",
        "part_joints",
        "part_links",
        "patterns",
        "pending",
        "quantities",
        "references",
        "reporter",
        "reports",
        "resolve_mesh",
        "root",
        "trace",
    )

    def __init__(
        self,
        reporter: Reporter,
        resolve_mesh: Callable[[str, Span], str | None],
        *,
        may_read: Callable[[str], bool] | None,
        has_capsule: bool,
        fitter: Fitter | None = None,
        root: Element | None = None,
        package_fault: PackageFault | None = None,
    ) -> None:
        """Start a run with nothing found."""
        self.root = root
        self.fitter = fitter or Fitter()
        self.fits: dict[int, tuple[Element, RobotNote]] = {}
        self.reporter = reporter
        self.resolve_mesh = resolve_mesh
        self.may_read = may_read
        self.package_fault = package_fault
        self.has_capsule = has_capsule
        self.has_words = self.has_armatures = False
        self.errors: list[Diagnostic] = []
        self.namings: dict[Source, Naming] = {}
        self.numbers: dict[str, Numbers] = {}
        self.quantities: dict[tuple[str, object], Numbers] = {}
        self.inertias: dict[Inertia, tuple[Numbers, ...]] = {}
        self.moments: dict[str, SolidMoments] = {}
        self.near_keys: dict[tuple[str, str], str | None] = {}
        self.patterns: dict[Form, Pattern | None] = {}
        self.parents: list[Element] = []
        self.mimics: list[Element] = []
        self.part_links: dict[str, str] = {}
        self.part_joints: dict[str, str] = {}
        self.pending: list[Mirror] = []
        self.references: list[tuple[RobotNote, str]] = []
        self.controls: list[PendingControl | PendingController] = []
        self.overlays: list[RobotWord] = []
        self.advice: list[Diagnostic] = []
        self.link_name = ""
        self.colors: dict[tuple[float, ...], str] = {}
        self.joint_type: str | None = None
        self.is_bound_to_joint = False
        self._reported: set[object] = set()
        self.reports = 0
        self.trace: Frame | None = None

    def enter(self, element: Element) -> Entered:
        """Begin with a part, or with another child of the root: what is in it may inherit from it.

        Returns:
            What to give `leave`.
        """
        before = self.trace, len(self.errors), len(self.reporter.diagnostics)
        self.trace = element.trace_within(self.trace)
        return before

    def leave(self, entered: Entered) -> None:
        """End what `enter` has begun: what was reported since then is given its trace."""
        before, errors, warnings = entered
        if self.reports:
            settle(self.errors[errors:], self.trace)
            settle(self.reporter.diagnostics[warnings:], self.trace)
        self.trace = before

    def give_trace(self, element: Element) -> None:
        """Give a new element the trace of the part, if it is to inherit that: it is put outside."""
        element.trace = element.trace_within(self.trace)

    def outermost(self, element: Element) -> Element:
        """Return an element for a place under the root, where it cannot inherit from the part."""
        return element.settled(self.trace)

    def begin_robot(self) -> Outside:
        """Begin with a robot in which the names of parts mean its own.

        Returns:
            What to give `end_robot`.
        """
        outside = (
            self.parents,
            self.mimics,
            self.pending,
            self.references,
            self.controls,
            self.overlays,
            self.part_links,
            self.part_joints,
        )
        self.parents, self.mimics, self.pending, self.references = [], [], [], []
        self.controls, self.overlays = [], []
        self.part_links, self.part_joints = {}, {}
        return outside

    def end_robot(self, outside: Outside) -> tuple[dict[str, str], dict[str, str]]:
        """End what `begin_robot` has begun.

        Returns:
            The link and the joint of each part in that robot.
        """
        own = self.part_links, self.part_joints
        self.parents, self.mimics, self.pending, self.references, self.controls = outside[:5]
        self.overlays, self.part_links, self.part_joints = outside[5:]
        return own

    def absorb(self, error: YamaroError) -> None:
        """Record the errors of an exception and go on; the same at the same place counts once."""
        self.reports += 1
        for diagnostic in error.diagnostics:
            key = (diagnostic.code, diagnostic.message, diagnostic.span.key())
            if key not in self._reported:
                self._reported.add(key)
                self.errors.append(diagnostic)

    def report(
        self,
        code: str,
        message: str,
        span: Span,
        *,
        hint: str | None,
        trace: Frame | None,
        fix: Fix | None = None,
    ) -> None:
        """Report what does not prevent a document; see `Diagnostic`."""
        self.reports += 1
        self.reporter.report(code, message, span, hint=hint, trace=trace, fix=fix)

    def once(
        self,
        key: Element,
        lower: Callable[[Lowering, Element], Element],
        *,
        own: int | None = None,
    ) -> Element:
        """Return what `lower` makes of a key: where the key has a memo, the same in every place.

        What had something reported is lowered again in each place, so that it is reported again.

        Args:
            key: the key; what comes out must depend on it and on the run alone.
            lower: makes an element of the key, which nobody changes later.
            own: see `Memo`.
        """
        memo = key.memo
        if memo is None:
            return lower(self, key)
        made: Element | None = memo.lowered
        if made is None:
            reported, self.is_bound_to_joint = self.reports, False
            made = lower(self, key)
            if reported == self.reports and not self.is_bound_to_joint:
                memo.lowered = made.share(own)
        return made


def names_of(robot: Element, kind: str) -> set[str]:
    """Return the names of the robot's links or joints, whether from parts or plain XML."""
    names = set()
    for child in robot.children:
        if isinstance(child, Element) and child.name == kind:
            name = child.attributes.get("name")
            names.add(name if type(name) is str else format_value(name))
    return names


def refer(joint: Element, reference: Element, attribute: str, name: str) -> None:
    """Let a reference in a joint bear another name; one of several places is replaced."""
    memo = reference.memo
    if memo is None:
        reference.attributes[attribute] = name
        return
    if memo.resolved is None:
        memo.resolved = with_attributes(reference, {**reference.attributes, attribute: name})
        memo.resolved.share()
    joint.children[joint.children.index(reference)] = memo.resolved
