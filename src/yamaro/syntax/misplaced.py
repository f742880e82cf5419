"""What stands where it cannot, and what reads like something else than it is."""

from __future__ import annotations

from ..diagnostics import failure, suggest
from ..yaml.nodes import MappingNode, ScalarNode, SequenceNode
from .context import ParseContext
from .names import ROBOT_SECTIONS, ROOT_STATEMENTS, STATEMENTS, head_of, is_function_name
from .values import is_empty

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ..diagnostics import Reporter
    from ..yaml.nodes import YamlNode
    from .document import Document
    from .nodes import FunctionNode


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


def warn_of_miscased_calls(
    documents: Sequence[Document], reporter: Reporter, *, is_known: Callable[[str], bool]
) -> None:
    """Warn of elements such as `leg: {side: left}` where there is a function `Leg`.

    Whatever has a capital first letter is a call, and all else an element. Which functions there
    are is known when all files of the program are. `is_known` says which elements robots have.
    """
    functions = {_letters(each.name): each for one in documents for each in one.functions}
    for document in documents if functions else ():
        for word, (key, node) in document.bare_keys.items():
            function = functions.get(_letters(word))
            if function is None or is_known(word) or not _reads_like_call(node, function):
                continue
            if any(each is function for each in document.functions):
                extent = document.extent_around(key.span())
                if extent is not None and extent.start > function.span.start:
                    continue  # the element that a function of its name makes
            from ..fixes import respelling

            reporter.warn(
                "misspelt-statement",
                f"'{word}' creates an XML element; did you mean the function `{function.name}`?",
                key.span(),
                hint=f"write {function.name}: to call it, or <{word}>: for the element",
                notes=(f"it is defined as {function.signature()} at {function.span.place()}",),
                fix=respelling(key.span(), word, function.name),
            )


def _letters(name: str) -> str:
    return name.replace("_", "").casefold()


def _reads_like_call(node: YamlNode, function: FunctionNode) -> bool:
    """Return whether what is in an element may be the arguments of a function."""
    names = {parameter.name for parameter in function.parameters}
    inside = _keys_inside(node)
    if inside:
        return not inside.isdisjoint(names)
    is_called_without = all(
        each.is_block or each.default is not None for each in function.parameters
    )
    return is_called_without if is_empty(node) else bool(names)


def _keys_inside(node: YamlNode) -> set[str]:
    mappings = node.items if isinstance(node, SequenceNode) else [node]
    return {key.text for item in mappings if isinstance(item, MappingNode) for key, _ in item}
