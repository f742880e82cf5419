"""Evaluates the templates of xacro files, and says where they fail."""

from __future__ import annotations

import builtins
import math
import os
import re
from keyword import iskeyword

from ..diagnostics import Frame, InputFault, YamaroError, did_you_mean, failure
from ..source import Span
from ..syntax.powers import compile_bounded
from ..xml.tree import Element
from ..yaml.reader import UNITS
from .faults import Fault, add_trace
from .places import XacroPlace
from .scope import Lazy, PredefinedNames, Scope
from .templates import Expression, Substitution, Template, guess_value, parse_template, substitute

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from types import CodeType
    from typing import Any, NoReturn, Protocol

    from ..diagnostics import Reporter
    from ..fixes import Fix
    from ..policy import Limits
    from .host import Host
    from .noted import Noted
    from .templates import EvalNames

    class Actions(Protocol):
        """What the functions of the namespace `xacro` do."""

        def load_yaml(self, filename: str) -> Any:
            """Return what a YAML file holds."""

        def abs_filename(self, filename: str) -> str:
            """Return a path that is relative to the file being read."""

        def argument(self, name: str) -> str:
            """Return an argument of the file."""

        def tell(self, kind: str, text: str) -> None:
            """Show a message, a warning or an error."""

        def tell_location(self) -> None:
            """Show which macros and files led here."""

        def give_up(self, text: str) -> Any:
            """Raise an error."""

        def tell_deprecated(self, name: str, replacement: str) -> None:
            """Warn of a name that is going out of use."""


MOST_NOTES = 6
"""How many uses of properties by other properties an error shows."""


class Arguments(dict[str, str]):
    """The arguments of a file, by name.

    Attributes:
        used: those that the file declares or reads.
    """

    __slots__ = ("used",)

    def __init__(self, given: Mapping[str, str]) -> None:
        super().__init__(given)
        self.used: set[str] = set()

    def __getitem__(self, name: str) -> str:
        """Return an argument; raise KeyError if it has no value."""
        self.used.add(name)
        return super().__getitem__(name)


class XacroEvaluator:
    """Evaluates templates in scopes, and answers what expressions ask.

    Attributes:
        arguments: those of the main file.
        place: what is being evaluated.
        files: the paths of the files being read, the innermost last.
        names: those that are predefined.
        noted: notes the values of names and expressions, or None.
        is_quiet: whether nothing is shown or reported that an expression wants shown.
    """

    def __init__(
        self, host: Host, reporter: Reporter, python: Python, arguments: Mapping[str, str]
    ) -> None:
        self.host = host
        self.reporter = reporter
        self.arguments = Arguments(arguments)
        self.files: list[str] = []
        self.place: XacroPlace
        self.names = predefined(self)
        self.noted: Noted | None = None
        self.is_quiet = False
        self._python = python
        self._templates: dict[str, Template] = {}
        self._span: Span | None = None  # of the substitution being replaced

    def value(self, text: str, scope: Scope, place: XacroPlace) -> Any:
        """Return the value of a text: of any type if one `${…}` is all of it, else a text.

        Raises:
            YamaroError: it cannot be evaluated.
        """
        if "$" not in text:
            return text
        self.place = place
        try:
            template = self._templates.get(text)
            if template is None:
                template = self._templates[text] = parse_template(text)
            return self._join(template, scope)
        except YamaroError as error:
            add_trace(error, place.trace)
            raise
        except Fault as fault:
            raise failure(
                fault.code,
                fault.message,
                place.span(fault.start, fault.end),
                hint=fault.hint,
                trace=place.trace,
            ) from None

    def text(self, text: str, scope: Scope, place: XacroPlace) -> str:
        """Return the value of a text as a text."""
        if "$" not in text:
            return text
        value = self.value(text, scope, place)
        if type(value) is str:
            return value
        try:
            return str(value)
        except Exception as error:
            raise failure(
                "xacro-python", _described(error), place.span(), trace=place.trace
            ) from None

    def resolve(self, scope: Scope, name: str, lazy: Lazy) -> Any:
        """Return the value of a property that is needed for the first time, and keep it."""
        user = getattr(self, "place", lazy.place)
        if name in scope.resolving:
            way = " → ".join([*scope.resolving[scope.resolving.index(name) :], name])
            raise failure(
                "xacro-cycle",
                f"the property '{name}' needs itself: {way}",
                lazy.place.span(),
                hint='to give a property a value made of its old one, write lazy_eval="false"',
                trace=lazy.place.trace,
            )
        scope.resolving.append(name)
        try:
            value = guess_value(self.value(lazy.text, scope, lazy.place))
        except YamaroError as error:
            told = error.diagnostics[0]
            if len(told.notes) < MOST_NOTES:
                told.notes += (f"'{name}' is used at {user.span().place()}",)
            raise
        finally:
            scope.resolving.pop()
            self.place = user
        scope.put(name, value)
        if self.noted is not None and isinstance(lazy.place.node, Element):
            self.noted.take_name(lazy.place.node, name, value)
        return value

    def resolve_all(self, scope: Scope) -> None:
        """Work out the properties of a scope that nothing has read, as far as they have values."""
        self.is_quiet = True
        for name, lazy in list(scope.lazy.items()):
            try:
                self.resolve(scope, name, lazy)
            except (YamaroError, RecursionError):
                continue
        self.is_quiet = False

    # --- templates --------------------------------------------------------------------------

    def _join(self, template: Template, scope: Scope) -> Any:
        parts = template.parts
        if len(parts) == 1:
            return self._part(parts[0], scope)
        return "".join([p if type(p) is str else str(self._part(p, scope)) for p in parts])

    def _part(self, part: str | Expression | Substitution, scope: Scope) -> Any:
        value = self._value_of(part, scope)
        if self.noted is not None and not isinstance(part, str):
            self.noted.take_expression(self.place, part.start, part.end, value)
        return value

    def _value_of(self, part: str | Expression | Substitution, scope: Scope) -> Any:
        if type(part) is Expression:
            text = part.text if part.inner is None else str(self._join(part.inner, scope))
            try:
                return self._python.evaluate(text, scope)
            except YamaroError:
                raise
            except Exception as error:
                self._explain(error, text, part, scope)
        if type(part) is Substitution:
            text = part.text if part.inner is None else str(self._join(part.inner, scope))
            return self._substituted(text, part, scope)
        return part

    def _substituted(self, text: str, part: Substitution, scope: Scope) -> str:
        self._span = self.place.span(part.start, part.end)
        try:
            return substitute(text, self, self.arguments, self._python.evaluate_in)
        except YamaroError:
            raise
        except Exception as error:
            self._explain(error, text, part, scope)
        finally:
            self._span = None

    def _explain(
        self, error: Exception, text: str, part: Expression | Substitution, scope: Scope
    ) -> NoReturn:
        """Raise a Fault for an exception in a part."""
        start, end = part.start, part.end
        offset = start + 2 if part.inner is None else None  # of the text, if it is as written
        if isinstance(error, (Fault, InputFault)):
            if isinstance(error, Fault) and error.end is not None and offset is not None:
                start, end = offset + error.start, offset + error.end
            raise Fault(error.code, error.message, error.hint, start=start, end=end) from None
        hint = None
        code, message = "xacro-python", _described(error)
        if isinstance(error, NameError):
            name = error.name or ""
            code, message = "xacro-undefined", f"name '{name}' is not defined" if name else message
            found = re.search(rf"(?<![\w.]){re.escape(name)}\b", text) if name else None
            if found and offset is not None:
                start, end = offset + found.start(), offset + found.end()
            hint = did_you_mean(name, scope.own_names())
            hint = did_you_mean(name, scope.root()) if hint is None and len(name) > 3 else hint
        elif isinstance(error, SyntaxError):
            message = "there is no expression between the braces"
            if text.strip():
                message = f"this is not a Python expression: {error.msg}"
                column = _column(error, text)
                if column is not None and offset is not None:
                    start, end = offset + column, offset + column + 1
        elif isinstance(error, RecursionError):
            code, message = "too-deep", "this calls itself endlessly"
        elif isinstance(error, KeyError) and type(part) is Substitution:
            code, message = "xacro-undefined", f"there is no argument {error}"
        raise Fault(code, message, hint, start=start, end=end) from None

    # --- what substitutions and expressions ask -----------------------------------------------

    def _here(self) -> Span:
        return self._span or self.place.span()

    def find(self, name: str) -> str:
        """Return the folder of a package."""
        return self.host.find_package(name, self._here())

    def env(self, name: str) -> str:
        """Return a variable of the environment."""
        value = self.host.environment(name)
        if value is None:
            raise Fault(
                "unset-environment",
                f"the environment variable '{name}' is not set",
                f"$(optenv {name} …) takes a default for when it is not set",
            )
        return value

    def optenv(self, name: str, default: str = "") -> str:
        """Return a variable of the environment, or the default."""
        value = self.host.environment(name)
        return default if value is None else value

    def arg(self, name: str) -> str:
        """Return an argument of the main file."""
        if name not in self.arguments:
            raise Fault(
                "xacro-undefined",
                f"the argument '{name}' is not declared before this place",
                did_you_mean(name, self.arguments)
                or f'give it, or declare it above: <xacro:arg name="{name}" default="…"/>',
            )
        return self.arguments[name]

    argument = arg

    def cwd(self) -> str:
        """Return the current folder."""
        return self.host.folder()

    def abs_filename(self, filename: str) -> str:
        """Return a path that is relative to the file being read."""
        if os.path.isabs(filename):
            return filename
        current = self.files[-1]
        return os.path.join(os.path.dirname(current) if current else ".", filename)

    def load_yaml(self, filename: str) -> Any:
        """Return what a YAML file holds."""
        from yaml import YAMLError

        path = self.abs_filename(filename)
        source = self.host.read(path, self._here())
        try:
            return parse_yaml(source.text, lambda text: self._python.evaluate(text, self.names))
        except YAMLError as error:
            mark = getattr(error, "problem_mark", None)
            start = min(mark.index if mark is not None else 0, len(source.text))
            raise failure(
                "xacro-yaml",
                f"this is not valid YAML: {getattr(error, 'problem', None) or error}",
                Span(source, start, min(start + 1, len(source.text))),
                trace=Frame("read", source.name, self._here(), parent=self.place.trace),
            ) from None
        except SyntaxError as error:
            raise Fault(
                "xacro-yaml", f"a number with a unit in '{source.name}' is not Python: {error.msg}"
            ) from None

    def tell(self, kind: str, text: str) -> None:
        """Show a message, a warning or an error."""
        if self.is_quiet:
            return
        if kind == "message":
            self.host.say(text, self._here())
        else:
            self.report("xacro-message", text)

    def tell_location(self) -> None:
        """Show which macros and files led here."""
        if self.is_quiet:
            return
        frame = self.place.trace
        lines = [f"at {self._here().place()}"]
        while isinstance(frame, Frame):
            lines.append(f"in {frame.name}, {frame.kind} at {frame.span.place()}")
            frame = frame.parent
        self.host.say("\n".join(lines), self._here())

    def give_up(self, text: str) -> NoReturn:
        """Raise an error that the file asks for."""
        raise Fault("xacro-fatal", text)

    def tell_deprecated(self, name: str, replacement: str) -> None:
        """Warn of a name that is going out of use."""
        from ..fixes import respelling

        self.report(
            "xacro-deprecated",
            f"{name}() is going out of use",
            hint=f"write {replacement}()",
            fix=respelling(self._here(), name, replacement),
        )

    def report(
        self, code: str, message: str, hint: str | None = None, fix: Fix | None = None
    ) -> None:
        """Report at the place being evaluated what does not prevent a document."""
        if self.is_quiet:
            return
        self.reporter.report(
            code, message, self._here(), hint=hint, trace=self.place.trace, fix=fix
        )


def _column(error: SyntaxError, text: str) -> int | None:
    """Return where in a text of one line Python stopped reading it."""
    stripped = text.strip()
    if error.lineno != 1 or not error.offset or error.offset > len(stripped):
        return None
    return text.index(stripped) + error.offset - 1


def _described(error: Exception) -> str:
    """Return what an exception of Python says, with its kind."""
    try:
        text = " ".join(str(error).split())
    except Exception:
        text = ""
    kind = type(error).__name__
    return f"{text} ({kind})" if text else kind


# --- evaluates Python in xacro files: the only module that calls `eval` for them --------------


_TRUTHS = ("True", "False")  # words of Python and predefined names alike


class Python:
    """Evaluates expressions, each of which is compiled once."""

    __slots__ = ("_codes", "_limits")

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._codes: dict[str, str | CodeType] = {}

    def evaluate(self, text: str, names: dict[str, Any]) -> Any:
        """Return the value of an expression; `names` has no `__builtins__` but its own.

        Raises:
            Fault: the text uses names that begin with `__`.
            Exception: whatever Python raises.
        """
        code = self._codes.get(text)
        if code is None:
            code = self._codes[text] = self._compile(text)
        if type(code) is str:
            try:
                return names[code]
            except KeyError:
                raise NameError(f"name '{code}' is not defined", name=code) from None
        return eval(code, names)

    def evaluate_in(self, text: str, names: EvalNames) -> Any:
        """Return the value of what follows `$(eval`; raises what `evaluate` raises."""
        if "__" in text:
            at = text.find("__")
            raise Fault(
                "xacro-unsafe",
                "what follows $(eval must not have '__' in it",
                start=at,
                end=at + 2,
            )
        code = compile_bounded(text, "<expression>", "eval", self._limits)
        return eval(code, {"__builtins__": {}}, names)  # type: ignore[arg-type]

    def _compile(self, text: str) -> str | CodeType:
        """Return code, or the name that is all of the expression."""
        stripped = text.strip()
        if is_plain_name(stripped):
            return stripped
        code = compile_bounded(stripped, "<expression>", "eval", self._limits)
        for name in _names_in(code):
            if name.startswith("__"):
                start = max(text.find(name), 0)
                raise Fault(
                    "xacro-unsafe",
                    f"'{name}' begins with '__', which xacro does not allow",
                    start=start,
                    end=start + len(name),
                )
        return code


def is_plain_name(text: str) -> bool:
    """Return whether an expression is a name, and no word of Python."""
    if not text.isidentifier() or not text.isascii() or text.startswith("__"):
        return False
    return text in _TRUTHS or not iskeyword(text)


def _names_in(code: CodeType) -> Iterator[str]:
    """Return the names that code uses, with that of the functions in it."""
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, type(code)):
            yield from _names_in(constant)


# --- the names that every expression of a xacro file sees -------------------------------------


_EVERYWHERE = (
    "list dict map len str float int bool True False min max round".split()  # in xacro's order
)
_IN_PYTHON = (
    "abs all any complex divmod enumerate filter frozenset hash isinstance issubclass ord repr "
    "reversed slice set sum tuple type vars zip sorted range"
).split()
_DEPRECATED = ("sorted", "range")


def predefined(actions: Actions) -> dict[str, Any]:
    """Return the names, most of them in the namespaces math, python and xacro as well."""
    mathematics = {name: value for name, value in vars(math).items() if name[0] != "_"}
    python: dict[str, Any] = {
        name: getattr(builtins, name, None) for name in _EVERYWHERE + _IN_PYTHON
    }
    python["True"], python["False"] = True, False
    own = _functions(actions)
    names: dict[str, Any] = {"__builtins__": {}}
    names.update({name: python[name] for name in _EVERYWHERE})
    names.update(mathematics)
    for name in _DEPRECATED:
        names[name] = _deprecated(python[name], name, f"python.{name}", actions)
    for name in ("load_yaml", "abs_filename", "dotify"):
        names[name] = _deprecated(own[name], name, f"xacro.{name}", actions)
    names.update(
        math=PredefinedNames(mathematics),
        python=PredefinedNames(python),
        xacro=PredefinedNames(own),
    )
    return names


def _deprecated(
    function: Callable[..., Any], name: str, replacement: str, actions: Actions
) -> Callable[..., Any]:
    def call(*args: Any, **keywords: Any) -> Any:
        actions.tell_deprecated(name, replacement)
        return function(*args, **keywords)

    return call


def _functions(actions: Actions) -> dict[str, Any]:
    def teller(kind: str, with_location: bool) -> Callable[..., str]:
        def tell(*args: Any, print_location: bool = with_location, **_style: Any) -> str:
            actions.tell(kind, " ".join(map(str, args)))
            if print_location:
                actions.tell_location()
            return ""

        return tell

    def print_location() -> str:
        actions.tell_location()
        return ""

    def fatal(*args: Any) -> Any:
        return actions.give_up(" ".join(map(str, args)))

    return {
        "load_yaml": actions.load_yaml,
        "abs_filename": actions.abs_filename,
        "arg": actions.argument,
        "dotify": YamlDict,
        "tokenize": tokenize,
        "message": teller("message", False),
        "warning": teller("warning", True),
        "error": teller("error", True),
        "print_location": print_location,
        "fatal": fatal,
    }


def tokenize(s: str, sep: str = ",; ", skip_empty: bool = True) -> list[str]:
    """Return a text split at each of the characters `sep`; the names are those of xacro."""
    import re

    words = re.split(f"[{sep}]", s)
    return [word for word in words if word] if skip_empty else words


# --- yaml values ------------------------------------------------------------------------------


class YamlList(list["Any"]):
    """A list that gives out lists and dicts as `with_dots` returns them."""

    __slots__ = ()

    def __getitem__(self, index: Any) -> Any:
        return with_dots(list.__getitem__(self, index))

    def __iter__(self) -> Iterator[Any]:
        return map(with_dots, list.__iter__(self))


class YamlDict(dict["Any", "Any"]):
    """A dict whose values can be read as attributes."""

    __slots__ = ()

    def __getattr__(self, key: str) -> Any:
        return self[key]

    def __getitem__(self, key: Any) -> Any:
        try:
            return with_dots(dict.__getitem__(self, key))
        except KeyError:
            raise AttributeError(f"the YAML dictionary has no key '{key}'") from None


def with_dots(value: Any) -> Any:
    """Return a list or dict as one that can be read with dots; all else as it is."""
    if isinstance(value, dict):
        return YamlDict(value)
    if isinstance(value, list):
        return YamlList(value)
    return value


def parse_yaml(text: str, evaluate: Callable[[str], Any]) -> Any:
    """Return what a YAML file holds.

    Args:
        text: its content.
        evaluate: returns the value of an expression, for numbers with a unit.

    Raises:
        yaml.YAMLError: the text is not YAML.
        Exception: whatever `evaluate` raises.
    """
    import yaml

    quick: Any = getattr(yaml, "CSafeLoader", None)
    if quick is not None:
        try:
            return with_dots(_load(text, quick, evaluate))
        except yaml.YAMLError:
            pass  # what libyaml does not read, or says worse
    return with_dots(_load(text, yaml.SafeLoader, evaluate))


def _load(text: str, base: Any, evaluate: Callable[[str], Any]) -> Any:
    def convert(loader: Any, node: Any) -> float:
        return float(evaluate(loader.construct_scalar(node))) * UNITS[node.tag]

    class Loader(base):  # type: ignore[misc]  # constructors are kept by class
        pass

    for tag in UNITS:
        Loader.add_constructor(tag, convert)
    loader = Loader(text)
    try:
        return loader.get_single_data()
    finally:
        loader.dispose()
