"""The runtime of safe code: its guards, names and modules, for one conversion.

code = runtime.bind(compile_safe(text, filename, "eval"))
eval(code, scope, scope)          # with runtime.names() among the names of the scope's file
"""

from __future__ import annotations

from ..syntax.names import FACTORS
from .builtins import BARE, permitted, refusal
from .guards import Guards
from .limits import SafeLimits, SafetyError, refused
from .modules import module
from .rewriter import RUNTIME
from .values import (
    CONTAINERS,
    LIST_ITERATOR,
    SCALARS,
    Function,
    Module,
    _leaves,
    function,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from types import CodeType
    from typing import Any

HELPER_STEPS = 1000
"""What a call of a helper such as `load_yaml` counts."""

PREDEFINED = (
    "pi tau e sin cos tan asin acos atan atan2 sqrt hypot radians degrees floor ceil fabs log exp"
).split()


class SafeRuntime(Guards):
    """Runs the code that `compile_safe` makes; one for each conversion."""

    def __init__(
        self, limits: SafeLimits | None = None, *, say: Callable[[str], None] | None = None
    ) -> None:
        """Begin with no steps taken.

        Args:
            limits: the usual ones if left out.
            say: takes what `print` prints; else it is discarded.
        """
        super().__init__(limits or SafeLimits())
        self._modules: dict[str, Module] = {}
        self._names = permitted(self, say or _say_nothing)
        self.lazy_functions = tuple(self._names[name] for name in ("all", "any", "next"))
        self._own = list(BARE)
        self.own = frozenset(map(id, self._own))
        mathematics = self.module("math").members
        self._names.update({name: mathematics[name] for name in PREDEFINED})
        self._names.update({"true": True, "false": False, "null": None, **FACTORS})
        self._names["env"] = self._names["__env__"] = refusal("env")
        self._names["cwd"] = refusal("cwd")

    def bind(self, code: CodeType) -> CodeType:
        """Return code of `compile_safe` with the guards in it."""
        constants = tuple(self._bound(constant) for constant in code.co_consts)
        return code.replace(co_consts=constants)

    def _bound(self, constant: Any) -> Any:
        if constant == RUNTIME:
            return self
        return self.bind(constant) if hasattr(constant, "co_consts") else constant

    def names(self, helpers: Mapping[str, Any] = {}) -> dict[str, Any]:
        """Return the names that code sees when no variable hides them: never Python's own builtins.

        Args:
            helpers: the functions of a file, which keep to their own rules of what may be read, and
                texts. What its key `find` is given is called by `$(find package)` too.
        """
        names = dict(self._names)
        for name, value in helpers.items():
            names[name] = self.helper(value, name) if callable(value) else self.admit(value)
        if "find" in names:
            names["__find__"] = names["find"]
        return names

    def helper(self, call: Callable[..., Any], name: str) -> Any:
        """Return one of Yamaro's functions as one that code may call, with plain arguments."""
        return function(self._help, f"<function {name}>", call)

    def _help(self, call: Callable[..., Any], /, *args: Any, **named: Any) -> Any:
        self.charge(HELPER_STEPS)
        for value in (*args, *named.values()):
            if type(value) not in SCALARS:
                raise TypeError("a text or a number is needed here")
        return self.admit(call(*args, **named))

    def module(self, name: str) -> Module:
        """Return the stand-in for a module in safe mode.

        Raises:
            SafetyError: it is not allowed.
        """
        if name not in self._modules:
            found = self._modules[name] = module(self, name)
            functions = [value for value in found.members.values() if _is_written_in_c(value)]
            if functions:
                self._own = [*getattr(self, "_own", ()), *functions]
                self.own = frozenset(map(id, self._own))
        return self._modules[name]

    def check_written(self, value: Any) -> None:
        """Refuse a value that is to be written, but is or holds something that has no text."""
        for item in _leaves(value) if type(value) in CONTAINERS else (value,):
            kind = type(item)
            if kind is LIST_ITERATOR:
                raise refused("the text of an iterator", hint="write list(…) around it")
            if kind is Function or id(item) in self.own:
                raise refused("the text of a function", hint="call it: name(…)")
            if kind is Module:
                raise refused("the text of a module", hint="write a name in it: math.pi")

    def refusal_of_module(self, name: str, why: str) -> SafetyError:
        """Return the error for a module that is not allowed."""
        return refused(f"the module `{name}`", why)


def _is_written_in_c(value: Any) -> bool:
    return type(value) is type(len)


def _say_nothing(text: str) -> None:
    pass
