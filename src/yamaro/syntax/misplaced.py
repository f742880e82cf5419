"""What stands where it cannot, and what reads like something else than it is."""

from __future__ import annotations

from ..diagnostics import failure, suggest
from ..yaml.nodes import MappingNode, ScalarNode, SequenceNode
from .context import ParseContext
from .names import ROBOT_SECTIONS, ROOT_STATEMENTS, STATEMENTS, head_of, is_function_name

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..yaml.nodes import YamlNode


def refuse_at_root(key: ScalarNode) -> None:
    """Raise YamaroError if a statement may not stand at the root of a file."""
    word = key.text
    if word in ROOT_STATEMENTS or word in ROBOT_SECTIONS or head_of(word):
        return
    if word in STATEMENTS or is_function_name(word):
        what = f"`{word}`" if word in STATEMENTS else f"the call `{word}`"
        raise failure(
            "misplaced-statement",
            f"{what} is not allowed at the root of a file",
            key.span(),
            hint="move it under `model:` or into the body of a function",
        )
    from ..suggestions import meant_word

    hint, fix = meant_word(word, ROOT_STATEMENTS, key.span())
    raise failure(
        "misplaced-statement",
        f"'{word}' is not allowed in an `if` or `for` at the root of a file",
        key.span(),
        hint=hint or "put elements under `model:`, and also an `if` that contains them",
        fix=fix,
    )


# Elements of URDF, SDF, MJCF and others that are near a statement's name.
_LOOK_MISSPELT = frozenset(
    "dart exclude far farm fog force fov friction included pair parent park parts path pin point "
    "points port pos ros sort".split()
)


def warn_of_misspelt_statement(key: ScalarNode, node: YamlNode, context: ParseContext) -> None:
    """Warn of an element that reads like a misspelt statement, such as `inlcude: leg.yaml`."""
    word = key.text
    if word in _LOOK_MISSPELT:
        return
    if word == "import":
        context.warn(
            "misspelt-statement",
            "'import' creates an XML element here; modules are imported at the root of the file",
            key.span(),
            hint="move it to the root of the file, or write <import>: for the element",
        )
        return
    near = suggest(word, STATEMENTS) if 2 <= len(word) <= 10 else None
    if near is None:
        return
    inside = _keys_inside(node)
    telling = {"condition", "body", "iterator", "range", "in", "path", "name", "joint", "link"}
    if near in ("include", "variables", "functions", "process") or inside & telling:
        from ..fixes import respelling

        context.warn(
            "misspelt-statement",
            f"'{word}' creates an XML element; did you mean the statement `{near}`?",
            key.span(),
            hint=f"write {near}: for the statement, or <{word}>: for the element",
            fix=respelling(key.span(), word, near),
        )


def _keys_inside(node: YamlNode) -> set[str]:
    mappings = node.items if isinstance(node, SequenceNode) else [node]
    return {key.text for item in mappings if isinstance(item, MappingNode) for key, _ in item}
