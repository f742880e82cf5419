"""What the checks of a robot share: reporting at the very value, and reading numbers once."""

from __future__ import annotations

from math import radians

from ..diagnostics import ACCEPTED, ERROR, WARNING, Diagnostic, suggest
from ..model.values import NumberReader, attribute_text
from ..xml.tree import Element

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence
    from typing import TypeVar

    from ..diagnostics import Frame, Reporter
    from ..fixes import Fix
    from ..model.schema import Field
    from ..source import Span

    T = TypeVar("T")
    Children = dict[str, Element]
    """The first child element of each name; parsers of URDF read no other where one is meant."""

SUGGESTION_BUDGET = 200_000
"""Names compared in one run to find the one meant; keeps a robot full of faults linear."""

NAMED_OWNERS = ("link", "joint", "material")


SCHEMA, TREE, LINKS, JOINTS, MATERIALS, COLORS, USES, REFERENCES, FILES = range(9)
"""The stages of the check, in the order in which findings are reported.

One walk over the elements finds what belongs to several stages.
"""


class Finding:
    """A diagnostic, how often the same came up, and in which lines of its file."""

    __slots__ = ("count", "diagnostic", "lines")

    def __init__(self) -> None:
        """Start with nothing found."""
        self.count = 0
        self.diagnostic: Diagnostic | None = None
        self.lines: dict[int, None] = {}


MOST_LINES = 12
"""Lines that a note lists."""
KEY_CODES = ("unknown-key", "misplaced-key")
STRAY_CODES = ("unknown-element", "unknown-attribute")
"""What a stray key of a part becomes; where the key is reported, this is not reported again."""


class CheckContext:
    """One run of the checks: where findings go, and what has been worked out so far."""

    __slots__ = (
        "_around",
        "_found",
        "_is_advice",
        "_suggestion_budget",
        "count",
        "file_owners",
        "has_extensions",
        "material_uses",
        "materials_inside",
        "numbers",
        "outermost",
        "reporter",
        "root",
        "sound",
        "sound_values",
        "stage",
        "version",
    )

    def __init__(
        self,
        root: Element,
        reporter: Reporter,
        *,
        version: str = "1.0",
        numbers: NumberReader | None = None,
        is_advice: bool = False,
    ) -> None:
        """Report to `reporter`.

        Args:
            root: the robot.
            reporter: takes the findings.
            version: the URDF version of the robot.
            numbers: reads numbers in attributes; by default a new one.
            is_advice: whether only `yamaro check` reports what is found, never as an error.

        Attributes:
            count: how often something was found.
            outermost: the child of the root that is being looked at, if it is one alone.
            stage: the stage that findings belong to.
            sound: what else has been found right: what was asked, and the texts of the values.
            sound_values: by attributes, the texts that were found right.
            material_uses: the first link and visual's material of each name that visuals use.
            materials_inside: the names of the materials that are defined in visuals.
            has_extensions: whether there are other elements than URDF's in the root.
            file_owners: the links and materials that may refer to files, each in turn.
        """
        self.root = root
        self.outermost: Element | None = None
        self._around: dict[int, Element] | None = None
        self._is_advice = is_advice
        self.reporter = reporter
        self.version = version
        self.numbers = numbers or NumberReader()
        self.stage = SCHEMA
        self.count = 0
        self.sound: set[tuple[object, ...]] = set()
        self.sound_values: dict[Field, dict[str, bool]] = {}
        self.material_uses: dict[str, tuple[Element, Element]] = {}
        self.materials_inside: set[str] = set()
        self.has_extensions = False
        self.file_owners: list[Element] = []
        self._suggestion_budget = SUGGESTION_BUDGET
        self._found: list[dict[object, Finding]] = [{} for _ in range(FILES + 1)]

    def report(
        self,
        code: str,
        message: str,
        element: Element,
        *,
        attribute: str | None = None,
        is_of_name: bool = False,
        span: Span | None = None,
        missing: str | None = None,
        hint: str | None = None,
        notes: Sequence[str] = (),
        among: Sequence[Element] = (),
        fix: Fix | None = None,
        alike: str | None = None,
        severity: str | None = None,
    ) -> None:
        """Note a finding at an attribute's value, or at the element when none is named.

        A line in a loop or a function makes many elements; what is wrong with them for the same
        reason is reported once.

        Args:
            code: what is wrong.
            message: the same in a sentence.
            element: where it is.
            attribute: at whose value it is.
            is_of_name: whether it is at the attribute's name instead.
            span: the text that is meant, if that is neither.
            missing: names what is not there, where that is the fault.
            hint: what to write instead.
            notes: further facts.
            fix: what the hint describes.
            among: the links and joints that are at odds, where there are several: one XML file may
                be so in itself, but what two includes of it make together was made by YAML.
            alike: in a file of XML that is taken as it is, all that has the same is reported once.
            severity: if it is not that of the code. What is an error where YAML made the robot is
                a warning in URDF and xacro that are taken as they are.
        """
        from ..severities import SEVERITIES

        if span is None and attribute is not None and is_of_name:
            span = element.name_span(attribute)
        is_error = (severity or SEVERITIES[code]) == ERROR and not self._is_advice
        if is_error and _are_taken_as_they_are(among or (element,)):
            is_error = False
        self._note(
            Diagnostic(
                code,
                message,
                span or place_of(element, attribute),
                hint=hint,
                notes=notes,
                severity=ERROR if is_error else WARNING,
                trace=self._trace_of(element),
                fix=fix,
            ),
            (attribute, missing),
            alike=alike,
        )

    def apart(
        self, code: str, found: Sequence[T], place: Callable[[T], tuple[Element, str | None]]
    ) -> list[list[T]]:
        """Return what has one fault in the groups to report: what comments accept stands alone.

        Args:
            code: the code of the fault.
            found: what has it.
            place: gives the element and the attribute that it is reported at.
        """
        groups: list[list[T]] = []
        rest = []
        for each in found:
            element, attribute = place(each)
            if self._is_accepted(code, place_of(element, attribute), self._trace_of(element)):
                groups.append([each])
            else:
                rest.append(each)
        return [*groups, rest] if rest else groups

    @staticmethod
    def _is_accepted(code: str, span: Span, trace: Frame | None) -> bool:
        """Return whether a comment in a file accepts a finding; see `allowances.py`."""
        if not span.source.has_remarks and trace is None:
            return False
        from ..allowances import is_accepted

        return is_accepted(code, span, trace)

    def _trace_of(self, element: Element) -> Frame | None:
        """Return the calls and includes that led to an element at the place that is looked at."""
        if not element.inherits_trace():
            return element.trace
        if self.outermost is None and self._around is None:
            self._around = {}
            for child in self.root.elements():
                for inner in child.iter(without=self._around):
                    self._around.setdefault(id(inner), child)
        outermost = self.outermost or (self._around or {}).get(id(element), self.root)
        return outermost.trace_within(None)

    def _note(
        self,
        diagnostic: Diagnostic,
        about: tuple[str | None, str | None],
        *,
        alike: str | None = None,
    ) -> None:
        """Note a finding; what is wrong at the same place for the same reason counts as one."""
        self.count += 1
        key: tuple[object, ...] = (diagnostic.code, diagnostic.span.key(), *about)
        is_one = alike is not None and diagnostic.span.source.is_xml
        if is_one:
            key = (diagnostic.code, diagnostic.span.source.path, alike)
        if self._is_accepted(diagnostic.code, diagnostic.span, diagnostic.trace):
            diagnostic.severity = ACCEPTED
            key = (*key, diagnostic.trace)
        found = self._found[self.stage].setdefault(key, Finding())
        found.count += 1
        if is_one:
            found.lines[diagnostic.span.location()[0]] = None
        if found.diagnostic is None:
            found.diagnostic = diagnostic
        elif diagnostic.severity == ERROR:
            found.diagnostic.severity = ERROR

    def flush(self) -> None:
        """Report what was found, stage by stage, in the order it was found."""
        told = {d.span.key() for d in self.reporter.diagnostics if d.code in KEY_CODES}
        all_found: dict[object, Finding] = {}
        for stage in self._found:
            for key, found in stage.items():
                if key in all_found:  # reported in the first of its stages
                    all_found[key].count += found.count
                else:
                    all_found[key] = found
        for found in all_found.values():
            diagnostic = found.diagnostic
            if diagnostic is None:
                continue
            if diagnostic.code in STRAY_CODES and diagnostic.span.key() in told:
                continue
            if len(found.lines) > 1:
                _, *others = map(str, found.lines)
                listed = ", ".join(others[:MOST_LINES]) + (
                    ", …" if len(others) > MOST_LINES else ""
                )
                line = "line" if len(others) == 1 else "lines"
                diagnostic.notes += (f"{len(others)} more like this: {line} {listed}",)
            elif found.count > 1:
                diagnostic.notes += (f"{found.count} elements made here have this fault",)
            self.reporter.add(diagnostic)

    def near(
        self, word: str, candidates: Collection[str], span: Span
    ) -> tuple[str | None, Fix | None]:
        """Return hint and fix for a name that is written at a span, see `suggestions.meant`."""
        near = self.near_word(word, candidates)
        if near is None:
            return None, None
        from ..fixes import respelling

        return f"did you mean '{near}'?", respelling(span, word, near)

    def near_word(self, word: str, candidates: Collection[str]) -> str | None:
        """Return the candidate that `word` is a misspelling of, or None."""
        if self._suggestion_budget < len(candidates):
            return None
        self._suggestion_budget -= len(candidates)
        return suggest(word, candidates)


def _are_taken_as_they_are(elements: Sequence[Element]) -> bool:
    """Return whether elements are all of XML, the main file or one include of it."""
    if not all(element.span.source.is_xml for element in elements):
        return False
    if len(elements) == 1:
        return True
    return len({id(_inclusion(element.trace)) for element in elements}) == 1


def _inclusion(trace: Frame | None) -> Frame | None:
    """Return the step from YAML into XML on the way to an element of XML, if there is one."""
    while trace is not None and trace.span.source.is_xml:
        trace = trace.parent
    return trace


def place_of(element: Element, attribute: str | None = None) -> Span:
    """Return where an attribute's value is written, or the element."""
    return element.span if attribute is None else element.value_span(attribute)


def label(owner: Element) -> str:
    """Return how to speak of a link, joint or material: link 'arm'."""
    if owner.name not in NAMED_OWNERS:
        return "the robot" if owner.name == "robot" else f"'{owner.name}'"
    name = attribute_text(owner, "name")
    return f"{owner.name} '{name}'" if name else f"a {owner.name} without a name"


def listed(names: Sequence[str], *, limit: int = 5) -> str:
    """Return names quoted and joined for a sentence, long lists cut."""
    quoted = [f"'{name}'" for name in names[:limit]]
    if len(names) > limit:
        return ", ".join(quoted) + f" and {len(names) - limit} more"
    return " and ".join([", ".join(quoted[:-1]), quoted[-1]] if len(quoted) > 1 else quoted)


def counted(names: Sequence[str], kind: str, what: str) -> tuple[str, ...]:
    """Return a note of how many more have a fault that is reported once, and which; or none.

    Args:
        names: the names of the others.
        kind: what they are, such as `joint`.
        what: the fault as it is said of one: it begins with "has" or "is".
    """
    if not names:
        return ()
    if len(names) == 1:
        return (f"1 more {kind} {what}: {listed(names)}",)
    verb, _, rest = what.partition(" ")
    plural = {"has": "have", "is": "are", "goes": "go"}[verb]
    return (f"{len(names)} more {kind}s {plural} {rest}: {listed(names, limit=10)}",)


def is_attribute(span: Span) -> bool:
    """Return whether a value is an attribute, in XML or in a key such as `limit/lower=1`.

    Where it is not, it follows a key of a part, which takes units and short forms.
    """
    source = span.source
    return source.is_xml or source.text[span.start - 1 : span.start] == "="


def degrees_hint(angle: float, span: Span) -> str:
    """Return how to write degrees where an angle in radians is too large to be meant."""
    if not is_attribute(span):
        meant = f"for degrees write `{shown(angle)}deg`"
    elif not span.source.is_xml:
        meant = f"for degrees write `$(radians({shown(angle)}))`"
    elif "xmlns:xacro" in span.source.text:
        meant = f"for degrees write `${{radians({shown(angle)})}}`"
    else:
        meant = f"{shown(angle)} degrees are {shown(radians(angle))}"
    return f"angles are in radians; {meant}"


def shown(number: float) -> str:
    """Return a number short enough to read in a sentence."""
    return f"{number:.6g}"
