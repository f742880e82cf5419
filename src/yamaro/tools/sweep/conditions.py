"""Conditions that variants have to meet: Python that only computes, about their arguments."""

from __future__ import annotations

from ...diagnostics import YamaroError
from ...policy import SAFE, Policy
from ...runtime.expressions import SafeEvaluator
from ...runtime.library import rules_of
from ...runtime.python_errors import Explainer
from ...runtime.scope import Home, Scope, SharedNames
from ...safe.limits import SafeLimits
from ...safe.runtime import SafeRuntime
from ...source import COMMAND_LINE, Source
from ...syntax.python import compile_expression
from ...yaml.nodes import PLAIN, ScalarNode

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ...syntax.python import PythonCode

_POLICY = Policy(SAFE)


class Condition:
    """A condition as it is written.

    Attributes:
        text: the Python expression.
        name: the file it is in, as messages name it, or `<command line>`.
        file: the text of that file.
        start: where in it the expression begins.
    """

    __slots__ = ("file", "name", "start", "text")

    def __init__(self, text: str, *, name: str = COMMAND_LINE, file: str = "", start: int = 0):
        self.text = text
        self.name = name
        self.file = file or text
        self.start = start

    def compiled(self) -> PythonCode:
        """Return the condition as code.

        Raises:
            YamaroError: it is not an expression, or does more than compute.
        """
        source = Source(self.file, name=self.name)
        node = ScalarNode(self.text, PLAIN, source, self.start, self.start + len(self.text))
        try:
            return compile_expression(self.text, node, 0, rules_of(_POLICY))
        except YamaroError as error:
            raise _only_computing(error) from None


class Conditions:
    """Says whether the arguments of a variant meet some conditions."""

    __slots__ = ("_codes", "_source")

    def __init__(self, conditions: list[Condition]) -> None:
        """Compile them; raise YamaroError if one of them is not an expression."""
        self._codes = [condition.compiled() for condition in conditions]
        self._source = Source("", name="sweep")

    def hold(self, arguments: Mapping[str, object]) -> bool:
        """Return whether all conditions hold.

        Raises:
            YamaroError: one cannot be evaluated.
        """
        if not self._codes:
            return True
        limits = _POLICY.limits
        runtime = SafeRuntime(SafeLimits.of(limits))
        home = Home(self._source, "", {**runtime.names(), **arguments}, None)
        scope = Scope(home, SharedNames(), closure=None, caller=None)
        explainer = Explainer({}, lambda name: [], limits)
        evaluator = SafeEvaluator(lambda: explainer, limits, runtime)
        try:
            return all(bool(evaluator.evaluate(code, scope)) for code in self._codes)
        except YamaroError as error:
            raise _only_computing(error) from None


def _only_computing(error: YamaroError) -> YamaroError:
    for diagnostic in error.diagnostics:
        if diagnostic.code == "unsafe-code":
            diagnostic.hint = "a condition can only compute"
    return error
