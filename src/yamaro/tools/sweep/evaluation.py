"""What is worked out for each variant: metrics, and the results of a function of the user's."""

from __future__ import annotations

from ...diagnostics import failure
from .hook import Hook
from .metrics.words import Metric, metrics_of, span_of_word

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any

    from ...source import Span
    from .hook import Number
    from .variant import Variant


class Evaluation:
    """What is worked out for each variant.

    Results depend on the variant alone. It can be sent to other processes.

    Attributes:
        needs: the output formats that it is worked out from.
        packages: the Python packages that have an influence on the results.
        units: the units of the columns that are known before, by their names; "" for none.
    """

    __slots__ = ("_hook", "_metrics", "needs", "packages", "units")

    def __init__(self, metrics: Sequence[Metric], hook: Hook | None) -> None:
        """Take metrics and a function as they were read; see `parse`."""
        self._metrics = tuple(metrics)
        self._hook = hook
        needs = [metric.needs for metric in metrics if metric.needs]
        self.needs = tuple(dict.fromkeys([*needs, *(hook.needs if hook else ())]))
        packages = [package for metric in metrics for package in metric.packages]
        packages += hook.packages if hook else ()
        self.packages = tuple(dict.fromkeys(packages))
        self.units: dict[str, str] = {}
        for metric in metrics:
            self.units.update(metric.units)
        if hook is not None:
            self.units.update(hook.units)

    @classmethod
    def parse(
        cls,
        metrics: Sequence[str],
        hook: str | None,
        folder: str,
        *,
        spans: Sequence[Span] | None = None,
        hook_span: Span | None = None,
    ) -> Evaluation:
        """Read what is to be worked out.

        Args:
            metrics: words such as `mass` and `stable(5)`.
            hook: `FILE.py:FUNCTION`, or None.
            folder: where the path of that file starts.
            spans: where the metrics are written, one for each.
            hook_span: where the function is.

        Raises:
            YamaroError: there is no such metric, file or function, or the file cannot be loaded.
        """
        found = metrics_of(metrics, spans or [span_of_word(word) for word in metrics])
        return cls(found, Hook(hook, folder, hook_span) if hook is not None else None)

    def described(self, folder: str) -> dict[str, Any]:
        """Return what decides about the results, as data; paths start at `folder`."""
        return {
            "metrics": [metric.word for metric in self._metrics],
            "evaluate": self._hook.described(folder) if self._hook is not None else None,
        }

    def __call__(self, variant: Variant) -> dict[str, Number | None]:
        """Return the results for a variant by the names of their columns; None for no value.

        Raises:
            YamaroError: a metric has no value for it, or the function fails.
        """
        found: dict[str, Number | None] = {}
        for metric in self._metrics:
            found.update(metric.values(variant))
        if self._hook is not None:
            results = self._hook.values(variant)
            twice = sorted(found.keys() & results.keys())
            if twice:
                message = f"the function returned '{twice[0]}', which is the name of a metric"
                raise failure("evaluate-result", message, self._hook.place, hint="rename one")
            found.update(results)
        return found
