"""The words of the language and the spelling of names: XML's, Python's and Yamaro's own."""

from __future__ import annotations

STATEMENTS = (
    "part",
    "if",
    "elif",
    "else",
    "for",
    "include",
    "variables",
    "functions",
    "print",
    "process",
)
ROOT_STATEMENTS = ("variables", "functions", "print", "process", "if", "elif", "else", "for")
SECTIONS = (
    "robot",
    "import",
    "variables",
    "functions",
    "model",
    "print",
    "process",
    "if",
    "for",
)
ARGUMENTS = "arguments"
"""Another section. Words like it are not misspelt sections: `fragment:` may be a root element."""
ROBOT_STATEMENTS = ("attach", "mirror", "loop")
"""Statements where a part may stand, and elements elsewhere."""
RAW_BLOCKS = ("urdf", "sdf", "mjcf")
"""Blocks for one output format, directly in a model, a part, or its joint or link."""
ROBOT_SECTIONS = (*("control", "controllers", "states", "groups", "collisions", "naming", "base"),)
"""Sections of a file that describes a robot."""
FACTORS = {
    "deg": 0.017453292519943295,
    "mm": 1e-3,
    "cm": 1e-2,
    "inch": 0.0254,
    "gram": 1e-3,
    "lb": 0.45359237,
    "rpm": 0.10471975511965977,
    "Nm": 1,
}
"""Units that have a name in expressions, where it is their factor to SI: `350 * mm`.

The table of all units is in `units.py`, which is loaded only where a unit is read.
"""
_KEYWORDS = frozenset(
    """False None True and as assert async await break class continue def del elif else except
    finally for from global if import in is lambda nonlocal not or pass raise return try while
    with yield""".split()
)


def is_identifier(text: str) -> bool:
    """Return whether a text can name a variable: a Python identifier, no keyword, and not __this__.

    Names in double underscores are Python's own: one of them is where code finds its builtins.
    """
    return text.isidentifier() and text not in _KEYWORDS and not is_dunder(text)


def is_dunder(text: str) -> bool:
    """Return whether a name begins and ends with two underscores, as Python spells it."""
    name = python_name(text)
    return name[:2] == "__" == name[-2:]


def python_name(identifier: str) -> str:
    """Return an identifier as Python reads it: `µ` of a keyboard and Greek `μ` are one name."""
    if identifier.isascii():
        return identifier
    from unicodedata import normalize

    return normalize("NFKC", identifier)


def is_keyword(text: str) -> bool:
    """Return whether a text is a Python keyword."""
    return text in _KEYWORDS


def bad_variable_name(name: str) -> str:
    """Return what is wrong with the name of a variable."""
    if is_keyword(name):
        return f"'{name}' is a Python keyword and cannot be the name of a variable"
    if is_dunder(name):
        return (
            f"'{name}' cannot be the name of a variable: names in "
            "double underscores are reserved by Python"
        )
    return f"'{name}' cannot be the name of a variable"


def name_hint(name: str) -> str:
    """Return how to spell a name that is not an identifier."""
    fixed = "".join(char if char.isalnum() or char == "_" else "_" for char in name)
    if fixed and fixed[0].isdigit():
        fixed = f"_{fixed}"
    if is_keyword(fixed):
        fixed = f"{fixed}_"
    elif is_dunder(fixed) and fixed.strip("_"):
        fixed = fixed.strip("_")
        return f"write {fixed}"
    if fixed == f"{name}_":
        return f"write {fixed}"
    if is_identifier(fixed) and fixed.strip("_"):
        return f"write {fixed}: names are letters, digits and _, and do not begin with a digit"
    return "names are letters, digits and _, and do not begin with a digit"


def is_function_name(text: str) -> bool:
    """Return whether a bare key calls a function: `Name` or `ns.Name`, with a capital N."""
    namespace, dot, name = text.rpartition(".")
    if not name.isidentifier() or not name[0].isupper() or name in _KEYWORDS:
        return False
    return not dot or all(part.isidentifier() for part in namespace.split("."))


def head_of(text: str) -> str | None:
    """Return the statement that a key is a short head of: `if`, `elif`, `for`, or None."""
    if text[:1] not in ("i", "e", "f"):
        return None
    for word in ("if", "elif", "for"):
        if text.startswith(word) and text[len(word) : len(word) + 1] in (" ", "\t", "\n", "("):
            return word
    return None
