"""The values that arguments, names and expressions of a robot in xacro may have.

An argument that is true or false may be the other; one that is compared with texts may be each of
them; and where the name of a file is made of it, the files that are there show it.
"""

from __future__ import annotations

import ast
import os
import re

from ....diagnostics import YamaroError
from ....xacro.faults import Fault
from ....xacro.symbol_table import given_in
from ....xacro.templates import Expression, Substitution, guess_value, parse_template
from ....xml.tree import Element
from ....xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from ....source import Span
    from ....xacro.host import Host
    from ....xacro.templates import Template

MOST_FILES = 40
"""How many files a computed name may mean to be looked at."""
MOST_STEPS = 3
"""Through how many names it is followed what the name of a file is made of."""
MOST_SPELLINGS = 400
"""How many names of files, or patterns for them, a computed name may be."""
MOST_PAIRS = 12
"""How many sets of arguments are tried that name a file only together."""
ARGUMENT = re.compile(
    r"""(['"]?)\$\(arg\s+([^()\s]+)\s*\)\1|\b(?:xacro\.)?arg\(\s*['"]([^'"]+)['"]\s*\)"""
)
_FILES = (".xacro", ".urdf", ".xml", ".yaml", ".yml")
_TRUTHS = {"true": "false", "false": "true", "True": "False", "False": "True"}
MARK = "argument_"


class Choices:
    """Knows where the values of arguments go, and what they are compared with.

    Attributes:
        host: gives other files and packages.
        data: the texts in the data that was loaded.
        texts: what names are given, wherever that is; those of arguments begin with a mark.
        folder_of_main: where the main file is.
    """

    def __init__(self, roots: Mapping[str, Element], host: Host, data: Iterable[str] = ()) -> None:
        """Look at all files.

        Args:
            roots: their root elements, by path; the main file is the first.
            host: gives other files and packages.
            data: the texts in the data that was loaded.
        """
        self.host = host
        self.data = [text for text in data if text and not re.search(r"[$\n*?\[]", text)]
        self.folder_of_main = os.path.dirname(next(iter(roots)))
        self.texts: dict[str, list[str]] = {}
        self._compared: dict[str, dict[str, None]] = {}
        self._conditions: set[str] = set()
        self._file_names: list[tuple[str, Span]] = []
        self._literal_names: dict[str, None] = {}
        """The names of files in Python, such as the values of a dict."""
        for root in roots.values():
            for element, name, text in given_in(root):
                marked = MARK + name if element.name == "xacro:arg" else name
                if text or element.name != "xacro:macro":  # not of parameters without a default
                    self.texts.setdefault(marked, []).append(text)
            for element in root.iter():
                given = {name: format_value(value) for name, value in element.attributes.items()}
                texts = [
                    (text, element.value_span(name)) for name, text in given.items() if "$" in text
                ]
                own = element.text()
                if "$" in own:
                    texts.append((own, element.span))
                for text, span in texts:
                    for expression, is_eval in _expressions_in(text):
                        names = re.findall(r"'([^'$]+)'", expression)
                        self._literal_names |= dict.fromkeys(n for n in names if n.endswith(_FILES))
                        self._look_at_expression(expression, is_eval=is_eval)
                    if "\n" not in text:
                        self._file_names += [(name, span) for name in _names_of_files(text)]
                if element.name in ("xacro:if", "xacro:unless"):
                    name = name_alone(given.get("value", ""))
                    if name:
                        self._conditions.add(name)

    # --- what the files say ---------------------------------------------------------------------

    def _look_at_expression(self, text: str, *, is_eval: bool) -> None:
        try:
            tree = ast.parse(text.strip(), mode="eval")
        except (SyntaxError, ValueError):
            return
        for node in ast.walk(tree):
            if isinstance(node, ast.Compare):
                sides = [node.left, *node.comparators]
                literals = [literal for side in sides for literal in _literals_in(side)]
                for side in sides:
                    name = _name_in(side)
                    for own in {name, MARK + name.removeprefix(MARK) if is_eval else name}:
                        self._compared.setdefault(own, {}).update(dict.fromkeys(literals))

    # --- what follows ---------------------------------------------------------------------------

    def alternatives(self, values: Mapping[str, str]) -> dict[str, list[str]]:
        """Return other values that arguments may have, by their names.

        Args:
            values: what they are.
        """
        found: dict[str, list[str]] = {}
        by_files = self._named_by_files(values)
        for name, value in values.items():
            aliases = self.aliases(MARK + name)
            others: dict[str, None] = {}
            if value in _TRUTHS:
                others[_TRUTHS[value]] = None
            elif aliases & self._conditions:
                is_number = isinstance(guess_value(value), (int, float))
                others |= dict.fromkeys(("0", "1") if is_number else ("true", "false"))
            for alias in sorted(aliases):
                others |= self._compared.get(alias, {})
                others |= dict.fromkeys(by_files.get(alias, ()))
            others.pop(value, None)
            if value in _TRUTHS:  # what it is compared with is spelled in several ways
                others = {other: None for other in others if other.lower() != value.lower()}
            found[name] = list(others)
        return {name: others for name, others in found.items() if others}

    def aliases(self, name: str) -> set[str]:
        """Return the names that are given the value of one, and that itself."""
        aliases = {name}
        while True:
            more = {
                other
                for other, texts in self.texts.items()
                if any(name_alone(text) in aliases for text in texts)
            }
            if more <= aliases:
                return aliases
            aliases |= more

    def pairs(self, values: Mapping[str, str]) -> list[dict[str, str]]:
        """Return values of several arguments that name a file only together."""
        arguments: dict[str, set[str]] = {}
        for name in values:
            for alias in self.aliases(MARK + name):
                arguments.setdefault(alias, set()).add(name)
        found: list[dict[str, str]] = []
        for text, span in [pair for own in self._file_names for pair in self._with_given(*own)]:
            for _, bound in self._files(text, span):
                changed = {
                    argument: value
                    for name, value in bound
                    for argument in sorted(arguments.get(name, ()))
                    if values[argument] != value
                }
                is_known = all(name in arguments for name, _ in bound)
                if is_known and len(changed) > 1 and changed not in found:
                    found.append(changed)
        return found[:MOST_PAIRS]

    def _named_by_files(self, values: Mapping[str, str]) -> dict[str, list[str]]:
        """Return what names may be so that the files are there whose names are made of them."""
        found: dict[str, set[str]] = {}
        for text, span in [pair for own in self._file_names for pair in self._with_given(*own)]:
            for _, bound in self._files(text, span):
                for name in {name for name, _ in bound}:
                    own = {value for other, value in bound if other == name}
                    rest = [(other, value) for other, value in bound if other != name]
                    is_as_now = all(
                        values.get(other.removeprefix(MARK), value) == value
                        for other, value in rest
                    )
                    if len(own) == 1 and is_as_now:
                        found.setdefault(name, set()).update(own)
        return {name: sorted(own)[:MOST_FILES] for name, own in found.items()}

    def _with_given(
        self, text: str, span: Span, known: frozenset[str] = frozenset()
    ) -> Iterator[tuple[str, Span]]:
        """Return a name of a file, also with what names in it are given, if that is computed."""
        yield text, span
        if len(known) == MOST_STEPS:
            return
        for name in sorted({*re.findall(r"\$\{(\w+)\}", text)} - known):
            for given in self.texts.get(name, ())[:MOST_FILES]:
                if "$" in given and not name_alone(given).startswith(MARK):
                    whole = text.replace(f"${{{name}}}", given)
                    yield from self._with_given(whole, span, known | {name})
        yield from ((own, span) for own in self._with_data(text))

    def _with_data(self, text: str) -> list[str]:
        """Return a name of a file with each text of the data where that is looked up."""
        template = parsed(text)
        parts = (
            [part for part in template.parts if isinstance(part, Expression)] if template else []
        )
        looked_up = [part for part in parts if self.is_lookup(part.text)]
        texts = [text]
        for part in reversed(looked_up):
            texts = [
                own[: part.start] + value + own[part.end :] for own in texts for value in self.data
            ]
            if len(texts) > MOST_SPELLINGS:
                return []
        return texts if looked_up else []

    def is_lookup(self, expression: str) -> bool:
        """Return whether an expression is a value of the data that was loaded."""
        node = tree_of(expression)
        if node is None:
            return False
        while not isinstance(node, ast.Name):
            match node:
                case ast.Subscript(inner, _) | ast.Attribute(inner, _):
                    node = inner
                case ast.Call(ast.Attribute(inner, "get"), _):
                    node = inner
                case ast.Call(ast.Name("load_yaml") | ast.Attribute(_, "load_yaml"), _):
                    return True
                case _:
                    return False
        return self._is_data(node.id, frozenset())

    def _is_data(self, name: str, known: frozenset[str]) -> bool:
        """Return whether a name may be data that was loaded, or a value in it."""
        for text in self.texts.get(name, ()):
            own = text.strip()
            if name not in known and own.startswith("${") and own.endswith("}"):
                inner = re.match(r"\w+", own[2:].strip())
                if "load_yaml(" in own:
                    return True
                if inner and self._is_data(inner[0], known | {name}):
                    return True
        return False

    def _files(self, text: str, span: Span) -> Iterator[tuple[str, list[tuple[str, str]]]]:
        """Return the files that there are for a computed name, with what the names in it are."""
        pieces = self._pieces(text, span) or []
        if len(pieces) < 2 or all(kind == "text" for kind, _ in pieces):
            return
        shell = "".join("*" if kind == "name" else escaped(own) for kind, own in pieces)
        pattern = "".join("([^/]+)" if kind == "name" else re.escape(own) for kind, own in pieces)
        names = [own for kind, own in pieces if kind == "name"]
        for start in dict.fromkeys((os.path.dirname(span.source.path), self.folder_of_main)):
            for path in sorted(self.host.glob(os.path.join(start, shell))):
                written = path if os.path.isabs(shell) else path.removeprefix(f"{start}/")
                match = re.fullmatch(pattern, written)
                if match is not None and path != span.source.path:
                    yield path, list(zip(names, match.groups(), strict=True))

    def _pieces(self, text: str, span: Span) -> list[tuple[str, str]] | None:
        """Return a name of a file in pieces, `("text", …)` and `("name", …)`; None if unknown.

        Python has no name; of a file named by it, something must be known, as in `arm_${…}.xacro`.
        """
        template = parsed(text)
        if template is None:
            return None
        pieces: list[tuple[str, str]] = []
        for part in template.parts:
            if isinstance(part, str):
                pieces.append(("text", part))
                continue
            name = name_alone(text[part.start : part.end])
            if name:
                pieces.append(("name", name))
                continue
            folder = self.folder(part, span)
            if folder is None and not isinstance(part, Expression):
                return None
            pieces.append(("name", "") if folder is None else ("text", folder))
        own = "".join(own for kind, own in pieces if kind == "text")
        stem = os.path.basename(own)[: os.path.basename(own).rfind(".")]
        if ("name", "") in pieces and not any(char.isalnum() for char in stem):
            return None
        return pieces

    def folder(self, part: Expression | Substitution, span: Span) -> str | None:
        """Return the folder that `$(find …)` or `$(cwd)` means; None for anything else."""
        if isinstance(part, Substitution) and part.text == "cwd":
            return self.host.folder()
        if isinstance(part, Expression) or "$" in part.text or part.text[:5] != "find ":
            return None
        return self.package(part.text[5:].strip(), span)

    def package(self, name: str, span: Span) -> str | None:
        """Return the folder of a package, None if there is none."""
        try:
            return self.host.find_package(name, span)
        except YamaroError:
            return None

    def files_named(self, text: str, span: Span, base: str, *, by_pattern: bool) -> dict[str, str]:
        """Return the files that a computed name may mean, by what it may be.

        Args:
            text: the name.
            span: where it is written.
            base: the folder that it is relative to.
            by_pattern: whether the names in it may be anything for which there is a file.
        """
        found = {}
        from_data = {
            own for given, _ in self._with_given(text, span) for own in self._with_data(given)
        }
        plain = {name for own in from_data for name in self._possible(own, span, 4)}
        known = sorted(self._possible(text, span, 4) | plain)
        if not known and not by_pattern:
            known = list(self._literal_names)
        for name in known:
            path = os.path.normpath(os.path.join(base, name))
            if os.path.isfile(path) and path != span.source.path:
                found[name] = path
        for own, _ in self._with_given(text, span):
            is_all = (by_pattern and own == text) or own in from_data
            for path, bound in self._files(own, span):
                if is_all or any(not name for name, _ in bound):
                    is_relative = not own.startswith(("/", "$(find", "$(cwd"))
                    found[os.path.relpath(path, base) if is_relative else path] = path
        return dict(list(found.items())[:MOST_FILES])

    def _possible(self, text: str, span: Span, depth: int) -> set[str]:
        """Return what a text may mean; nothing if that is not known."""
        template = parsed(text)
        if template is None or depth == 0:
            return set()
        results = {""}
        for part in template.parts:
            if isinstance(part, str):
                own = {part}
            else:
                name = name_alone(text[part.start : part.end])
                folder = self.folder(part, span) if not name else None
                own = {folder} if folder else self._values(name, span, depth - 1)
            results = {before + after for before in results for after in own}
            if len(results) > MOST_FILES:
                return set()
        return results

    def _values(self, name: str, span: Span, depth: int) -> set[str]:
        if not name:
            return set()
        found = {
            value
            for text in self.texts.get(name, ())
            for value in self._possible(text, span, depth)
        }
        for alias in self.aliases(name):
            found |= self._compared.get(alias, {}).keys()
        return {value.strip("'") for value in found}


def tree_of(expression: str) -> ast.expr | None:
    """Return an expression in Python, in which arguments are marked names; or None."""
    marked = ARGUMENT.sub(lambda found: MARK + (found[2] or found[3]), expression)
    try:
        return ast.parse(marked.strip(), mode="eval").body
    except (SyntaxError, ValueError):
        return None


def _names_of_files(text: str) -> list[str]:
    """Return the computed names of files in a text: all of it, or texts of Python in it."""
    names = [text] if text.endswith(_FILES) else []
    for part in re.findall(r"\$\{([^}]*)\}", text):
        names += [name for name in re.findall(r"'([^']*)'", part) if name.endswith(_FILES)]
        for before, name, after in re.findall(r"'([^']*)'\s*\+\s*(\w+)\s*\+\s*'([^']*)'", part):
            names.append(f"{before}${{{name}}}{after}")
    return [name for name in names if "$" in name and name.endswith(_FILES)]


def parsed(text: str) -> Template | None:
    """Return a text in parts; None if it is malformed."""
    try:
        return parse_template(text)
    except Fault:
        return None


def _expressions_in(text: str) -> Iterable[tuple[str, bool]]:
    """Return the Python in a text, in which arguments are names, and if it is in `$(eval …)`."""
    template = parsed(ARGUMENT.sub(lambda found: MARK + (found[2] or found[3]), text))
    if template is None:
        return
    for part in template.parts:
        if isinstance(part, Expression):
            yield part.text, False
        elif isinstance(part, Substitution) and part.text.startswith("eval"):
            yield part.text[4:], True


def name_alone(text: str) -> str:
    """Return the name that is all of a text, or "": `${name}`, `$(arg name)`, `'$(arg name)'`."""
    text = ARGUMENT.sub(lambda found: MARK + (found[2] or found[3]), text.strip())
    if text.startswith("${") and text.endswith("}"):
        text = text[2:-1].strip()
    elif not text.startswith(MARK):
        return ""
    return text if text.isidentifier() else ""


def _name_in(node: ast.expr) -> str:
    """Return the name whose value a side of a comparison is, also as a text."""
    match node:
        case ast.Name(name):
            return name
        case ast.Call(ast.Name("str"), [ast.Name(name)]):
            return name
        case ast.Call(ast.Attribute(ast.Name(name), "lower" | "upper" | "strip"), []):
            return name
    return ""


def _literals_in(node: ast.expr) -> list[str]:
    match node:
        case ast.Constant(value) if isinstance(value, (str, int, float)):
            return [str(value)]
        case ast.List(items) | ast.Tuple(items) | ast.Set(items):
            return [literal for item in items for literal in _literals_in(item)]
    return []


def escaped(text: str) -> str:
    """Return a text as a pattern of the shell that matches only that."""
    return re.sub(r"([*?[])", r"[\1]", text)


# --- files that a computed name could mean at most --------------------------------------------
# A name becomes patterns of the shell: what is known of it stays, and the rest is `*`.


_ENDINGS = (".xacro", ".urdf", ".xml")
_ANYTHING = ["*"]


class Spellings:
    """Finds the patterns for one name."""

    def __init__(self, choices: Choices, span: Span) -> None:
        """Take what is known of the files, and where the name is written."""
        self._choices = choices
        self._span = span

    def files(self, text: str) -> list[str]:
        """Return all files that match."""
        found: dict[str, None] = {}
        folders = (os.path.dirname(self._span.source.path), self._choices.folder_of_main)
        for pattern in self._of_text(text, frozenset()):
            for folder in dict.fromkeys(folders):
                paths = self._choices.host.glob(os.path.join(folder, pattern))
                found |= dict.fromkeys(os.path.normpath(path) for path in sorted(paths))
        return [path for path in found if path.endswith(_ENDINGS)]

    def items(self, text: str, base: str) -> dict[str, str]:
        """Return the files that a name out of a dict or list in the sources may mean, by the name.

        Args:
            text: the name.
            base: the folder that it is relative to.
        """
        found = {}
        for pattern in self._of_text(text, frozenset()) if "[" in text or ".get(" in text else ():
            name = pattern.replace("[*]", "*").replace("[?]", "?").replace("[[]", "[")
            path = os.path.normpath(os.path.join(base, name))
            is_file = "*" not in pattern and path.endswith(_ENDINGS) and os.path.isfile(path)
            if is_file and path != self._span.source.path:
                found[name] = path
        return found

    def is_constant(self, text: str) -> bool:
        """Return whether a text is the same whatever the arguments are."""
        patterns = {pattern.replace("[*]", "") for pattern in self._of_text(text, frozenset())}
        return len(patterns) == 1 and "*" not in patterns.pop()

    def _of_text(self, text: str, known: frozenset[str]) -> list[str]:
        """Return patterns for a text; `known` are the names that it was reached through."""
        template = parsed(text)
        if template is None:
            return _ANYTHING
        return _joined(
            [escaped(part)]
            if isinstance(part, str)
            else self._of_part(part, name_alone(text[part.start : part.end]), known)
            for part in template.parts
        )

    def _of_part(
        self, part: Expression | Substitution, name: str, known: frozenset[str]
    ) -> list[str]:
        if name:
            return self._of_name(name, known)
        folder = self._choices.folder(part, self._span)
        if folder is not None:
            return [escaped(folder)]
        if isinstance(part, Substitution):
            command, _, rest = part.text.partition(" ")
            if command == "find":
                # the folders of the packages that a text may name; any other is an error
                text = rest.strip()
                names = self._of_text(text, known)
                folders = [
                    self._choices.package(name, self._span) for name in names if "*" not in name
                ]
                found = [escaped(folder) for folder in dict.fromkeys(folders) if folder is not None]
                return found if found and "*" not in names else [*found, *_ANYTHING]
            words = part.text.split()
            value = None
            if len(words) > 1 and words[0] in ("env", "optenv"):
                value = self._choices.host.environment(words[1])
            return [*_ANYTHING, *([escaped(value)] if value else [])]
        if self._choices.is_lookup(part.text):
            return [escaped(own) for own in self._choices.data]
        tree = tree_of(part.text)
        return _ANYTHING if tree is None else self._of_python(tree, known)

    def _of_name(self, name: str, known: frozenset[str]) -> list[str]:
        if name in known:
            return []
        if name.startswith(MARK) or name not in self._choices.texts:
            return _ANYTHING
        given = self._choices.texts[name]
        return [own for text in given for own in self._of_text(text, known | {name})]

    def _of_python(self, node: ast.expr, known: frozenset[str]) -> list[str]:
        match node:
            case ast.Constant(value):
                return [escaped(str(value))]
            case ast.Name(name):
                return self._of_name(name, known)
            case ast.IfExp(_, one, other):
                return self._of_python(one, known) + self._of_python(other, known)
            case ast.BoolOp(_, values):
                return [own for each in values for own in self._of_python(each, known)]
            case ast.BinOp(one, ast.Add(), other):
                return _joined(self._of_python(each, known) for each in (one, other))
            case ast.Call(ast.Name("str"), [inner]):
                return self._of_python(inner, known)
            case ast.Subscript(inner, _) | ast.Call(ast.Attribute(inner, "get"), _):
                # patterns for what a dict or a list holds
                items = self._items(inner, known)
                if items is None:
                    return _ANYTHING
                return [own for each in items for own in self._of_python(each, known)]
        return _ANYTHING

    def _items(self, node: ast.expr, known: frozenset[str]) -> list[ast.expr] | None:
        """Return what a dict or a list holds, or None if that is not known."""
        match node:
            case ast.Dict(_, items) | ast.List(items) | ast.Tuple(items):
                return items
            case ast.Call(ast.Name("dict"), [], keywords):
                return [each.value for each in keywords]
            case ast.Subscript(inner, _) | ast.Call(ast.Attribute(inner, "get"), _):
                several = [self._items(each, known) for each in self._items(inner, known) or ()]
            case ast.Name(name) if name in self._choices.texts and name not in known:
                own = known | {name}
                trees = [
                    (tree_of(text.strip()[2:-1]) if text.startswith("${") else None)
                    for text in self._choices.texts[name]
                ]
                several = [None if tree is None else self._items(tree, own) for tree in trees]
            case _:
                return None
        found = [items for items in several if items is not None]
        return [each for items in found for each in items] if len(found) == len(several) else None


def _joined(several: Iterable[list[str]]) -> list[str]:
    """Return patterns for what is made of parts, from those for each."""
    results = [""]
    for own in several:
        results = list(dict.fromkeys(before + after for before in results for after in own))
        if len(results) > MOST_SPELLINGS:
            return _ANYTHING
    return results


# --- truth values, where no run has shown them ------------------------------------------------
# In a text, xacro writes such a value as Python does, `True`, and the language as XML does, `true`.


_FLAG = re.compile(r"\$\(optenv\s+\w+\s+(?:0|1|true|false|True|False)\s*\)")


class Truths:
    """Knows the names that may have a truth value, anywhere in a robot.

    Attributes:
        names: those of properties and parameters.
        flags: those of them that the environment may set, where another number is usual.
    """

    def __init__(self, roots: Iterable[Element], arguments: Iterable[str]) -> None:
        """Look at all that gives a name a value; `arguments` are those that are true or false."""
        self._arguments = {f"$(arg {name})" for name in arguments}
        self.names: set[str] = set()
        self.flags: set[str] = set()
        given = [
            (name, text)
            for root in roots
            for element, name, text in given_in(root)
            if element.name != "xacro:arg"
        ]
        count = -1
        while len(self.names) > count:
            count = len(self.names)
            given = [(name, text) for name, text in given if not self._note(name, text)]

    def _note(self, name: str, text: str) -> bool:
        text = text.strip()
        is_truth = isinstance(guess_value(text), bool) or text in self._arguments
        if not is_truth and text.startswith("${") and text.find("}") == len(text) - 1:
            is_truth = self.may_give(text[2:-1])
        if _FLAG.fullmatch(text) or (text[:2] == "${" and text[2:-1].strip() in self.flags):
            self.flags.add(name)
            is_truth = True
        if is_truth:
            self.names.add(name)
        return is_truth

    def may_give(self, expression: str) -> bool:
        """Return whether an expression may give a truth value."""
        try:
            return self._may_be(ast.parse(expression.strip(), mode="eval").body)
        except (SyntaxError, ValueError):
            return False

    def _may_be(self, node: ast.expr) -> bool:
        match node:
            case ast.Name(name):
                return name in self.names
            case ast.Constant(value):
                return isinstance(value, bool)
            case ast.Compare() | ast.UnaryOp(ast.Not()):
                return True
            case ast.BoolOp(_, values):
                return any(map(self._may_be, values))
            case ast.IfExp(_, first, second):
                return self._may_be(first) or self._may_be(second)
        return False
