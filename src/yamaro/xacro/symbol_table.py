"""The symbol table of xacro: who defines, reads and assigns a name, without running it.

Scopes are dynamic: a macro sees the names of its callers, and may set names for them. So what
is asked here is what is written in an element; who meets whom is for those who know all files.
"""

from __future__ import annotations

import ast
import re

from ..xml.values import format_value
from .faults import Fault
from .statements import Parameter, parse_parameters
from .templates import Expression, Substitution, parse_template

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Container, Iterator

    from ..xml.tree import Element

PROPERTY, BLOCK, ARGUMENT, MACRO = "property", "block", "argument", "macro"
"""The kinds of definitions; a property without a value is a block."""

# --- definitions ------------------------------------------------------------------------------


class Definition:
    """A name where it is defined.

    Attributes:
        name: as it is written, of a macro without `xacro:`.
        kind: PROPERTY, BLOCK, ARGUMENT or MACRO.
        element: the tag.
    """

    __slots__ = ("element", "kind", "name")

    def __init__(self, name: str, kind: str, element: Element) -> None:
        self.name = name
        self.kind = kind
        self.element = element

    @property
    def is_property(self) -> bool:
        """Return whether it is a property, of a value or a block."""
        return self.kind in (PROPERTY, BLOCK)

    @property
    def value(self) -> str:
        """Return the value of a property as it is written, empty if it has none."""
        return format_value(self.element.attributes.get("value"))

    @property
    def text(self) -> str:
        """Return what a property or an argument is made of: its value, or its default."""
        given = self.element.attributes
        return format_value(given.get("value", given.get("default", "")))

    @property
    def scope(self) -> str:
        """Return whom a property is set for: `parent`, `global`, or "" for where it stands."""
        return format_value(self.element.attributes.get("scope", ""))

    @property
    def is_of_argument(self) -> bool:
        """Return whether a property is the argument of its own name."""
        return is_argument(self.value, self.name)

    def parameters(self) -> list[Parameter]:
        """Return the parameters of a macro."""
        return parse_parameters(format_value(self.element.attributes.get("params", "")))


def definition_of(element: Element) -> Definition | None:
    """Return what a tag defines."""
    kind = _KINDS.get(element.name)
    if kind is None:
        return None
    given = element.attributes
    name = format_value(given.get("name", ""))
    if kind == MACRO:
        name = name.removeprefix("xacro:")
    elif kind == PROPERTY and not given.keys() & {"value", "default", "remove"}:
        kind = BLOCK
    return Definition(name, kind, element)


_KINDS = {"xacro:property": PROPERTY, "xacro:arg": ARGUMENT, "xacro:macro": MACRO}


def definitions_in(root: Element, without: Container[int] = ()) -> Iterator[Definition]:
    """Yield what an element defines, except in elements of some identities."""
    for element in root.iter(without):
        found = definition_of(element)
        if found is not None:
            yield found


def properties_in(root: Element, without: Container[int] = ()) -> Iterator[Definition]:
    """Yield the properties that an element defines, those in macros too."""
    return (each for each in definitions_in(root, without) if each.is_property)


def defined_in(root: Element, *, nested: bool = False) -> set[str]:
    """Return the properties defined in an element, those of macros in it only if `nested`."""
    without = () if nested else macros_inside(root)
    return {each.name for each in properties_in(root, without)}


def assigned_in(root: Element, *scopes: str) -> set[str]:
    """Return the properties that an element sets for others: for scopes, or for any of them."""
    return {
        each.name
        for each in properties_in(root)
        if (each.scope in scopes if scopes else "scope" in each.element.attributes)
    }


def macros_inside(root: Element) -> set[int]:
    """Return the identities of the macros that are defined in an element, without its own."""
    return {id(own) for own in root.iter() if own.name == "xacro:macro" and own is not root}


def given_in(root: Element) -> Iterator[tuple[Element, str, str]]:
    """Yield what gives a name a value, the name and the value's text.

    That are properties, arguments, the defaults of parameters, and what calls pass.
    """
    for element in root.iter():
        found = definition_of(element)
        if found is None:
            if element.name.startswith("xacro:"):
                for name, value in element.attributes.items():
                    yield element, name, format_value(value)
        elif found.kind == MACRO:
            for each in found.parameters():
                yield element, each.name, each.default or ""
        else:
            yield element, found.name, found.text


# --- calls ------------------------------------------------------------------------------------


def called_by(element: Element) -> str:
    """Return the name of the macro that a tag may call, without that of its namespace."""
    tag = element.name
    return tag.removeprefix("xacro:").rpartition(".")[2] if tag.startswith("xacro:") else ""


# --- names that texts read --------------------------------------------------------------------


_WORD = re.compile(r"[^\W\d]\w*")
_EXPRESSION = re.compile(r"\$\{([^}]*)\}")
_ARGUMENT = re.compile(r"""\$\(arg\s+([^()\s]+)\s*\)|\bxacro\.arg\(\s*['"]([^'"]+)['"]\s*\)""")
_READS_ARGUMENTS = re.compile(r"\$\(\s*(?:arg|eval)\b|\barg\s*\(")


def texts_of(element: Element) -> list[str]:
    """Return the values of an element's attributes, and its text."""
    return [*map(format_value, element.attributes.values()), element.text()]


def texts_in(root: Element, without: Container[int] = ()) -> Iterator[str]:
    """Yield the values of attributes in an element, and its texts."""
    for element in root.iter(without):
        yield from texts_of(element)


def trees_in(text: str) -> Iterator[ast.expr]:
    """Yield the expressions in a text, those that are Python."""
    for expression in _EXPRESSION.findall(text):
        try:
            yield ast.parse(re.sub(r"\$\([^)]*\)", "0", expression).strip(), mode="eval").body
        except (SyntaxError, ValueError):
            continue


def names_in(text: str) -> set[str]:
    """Return the names that the expressions of a text read."""
    names: set[str] = set()
    for tree in trees_in(text):
        found = [node for node in ast.walk(tree) if isinstance(node, ast.Name)]
        bound = {node.id for node in found if isinstance(node.ctx, ast.Store)}
        bound |= {node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)}
        names |= {node.id for node in found} - bound
    return names


def used_in(root: Element, without: Container[int] = ()) -> set[str]:
    """Return the names in the expressions of an element, except elements of some identities."""
    return set().union(*map(names_in, texts_in(root, without)))


def words_read(text: str) -> set[str]:
    """Return the names that a text may read: more than it does where that is not known."""
    try:
        parts = parse_template(text).parts
    except Fault:
        return set(_WORD.findall(text))
    names: set[str] = set()
    for part in parts:
        if isinstance(part, Expression):
            names |= _words_of(part.text)
        elif isinstance(part, Substitution) and ("$" in part.text or part.text[:4] != "find"):
            names |= set(_WORD.findall(part.text))
    return names


def _words_of(expression: str) -> set[str]:
    if "$" in expression or _READS_ARGUMENTS.search(expression):
        return set(_WORD.findall(expression))
    try:
        tree = ast.parse(expression.strip(), mode="eval")
    except (SyntaxError, ValueError):
        return set(_WORD.findall(expression))
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    in_namespaces = {node.attr for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    return names | in_namespaces


def words_in(root: Element) -> set[str]:
    """Return all words of the texts in an element that are computed."""
    return {word for text in texts_in(root) if "$" in text for word in _WORD.findall(text)}


def words_of_arguments(text: str) -> set[str]:
    """Return the words of a text that may be arguments; none if it reads no arguments."""
    return set(_WORD.findall(text)) if _READS_ARGUMENTS.search(text) else set()


def outside_expressions(text: str) -> str:
    """Return what of a text is not Python: without `${…}`, but with the texts in it."""
    return _EXPRESSION.sub(
        lambda found: " ".join(re.findall(r"'[^']*'|\"[^\"]*\"", found[1])), text
    )


def computed_with(root: Element) -> set[str]:
    """Return the names that conditions are made of, or that expressions take for more than texts.

    A name that stands alone in an expression, or is compared with a text, is not.
    """
    names: set[str] = set()
    for element in root.iter():
        is_condition = element.name in ("xacro:if", "xacro:unless")
        for text in texts_of(element):
            if is_condition:
                names.update(re.findall(r"\$\(arg\s+([\w-]+)\s*\)", text))
            for tree in trees_in(text):
                if is_condition or not isinstance(tree, ast.Name):
                    names |= _names_computed_with(tree)
    return names


def _names_computed_with(node: ast.AST) -> set[str]:
    if isinstance(node, ast.Name):
        return {node.id}
    if isinstance(node, ast.Compare):
        sides = [node.left, *node.comparators]
        if any(isinstance(own, ast.Constant) and isinstance(own.value, str) for own in sides):
            return set()
    return set().union(*map(_names_computed_with, ast.iter_child_nodes(node)))


# --- arguments, which have names of their own -------------------------------------------------


def is_argument(text: str, name: str) -> bool:
    """Return whether a value is the argument of a name and nothing else."""
    return text.strip() == f"$(arg {name})"


def arguments_of(text: str) -> set[str]:
    """Return the arguments that a text reads."""
    return {one or other for one, other in _ARGUMENT.findall(text)}


def arguments_in(root: Element, *, with_own: bool = False) -> set[str]:
    """Return the arguments that an element reads.

    Args:
        root: the element.
        with_own: whether a property that is made of the argument of its name reads that.
    """
    names: set[str] = set()
    for element in root.iter():
        given = [value for name, value in element.attributes.items() if name != "params"]
        found = set().union(*map(arguments_of, (*map(format_value, given), element.text())))
        definition = definition_of(element)
        if definition is not None and definition.is_property and not with_own:
            found.discard(definition.name)
        names |= found
    return names
