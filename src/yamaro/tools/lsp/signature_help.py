"""The parameters of a function while a call of it is written."""

from __future__ import annotations

from ...syntax.nodes import FunctionNode
from ...yaml.brackets import find_close
from .bindings import Program
from .comments import comment_on
from .contexts import place_of
from .cursor import cursor_at

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .texts import Text
    from .wire import Json
    from .workspace import Workspace


def answer(workspace: Workspace, parameters: Json) -> Json:
    """Return the signature, with the parameter that is being written."""
    text = workspace.text_at(parameters)
    offset = workspace.offset_in(text, parameters)
    if not text.is_yaml:
        return None
    name, index, given = _call_at(text, offset)
    if not name:
        return None
    program = Program(workspace, text.path)
    context = text.names.context_at(offset)
    signatures: list[Json] = []
    for place in program.functions(text, name, context):
        node = place.declaration.node if place.declaration is not None else None
        if isinstance(node, FunctionNode):
            names = [each.name for each in node.parameters]
            active = names.index(given) if given in names else index
            signature: Json = {
                "label": f"{node.name}({', '.join(each.text for each in node.parameters)})",
                "parameters": [{"label": each.text} for each in node.parameters],
                "activeParameter": active,
            }
            comment = comment_on(place.text, place.span)
            if comment:
                signature["documentation"] = comment
            signatures.append(signature)
    if not signatures:
        return None
    active = signatures[0]["activeParameter"]
    return {"signatures": signatures, "activeSignature": 0, "activeParameter": active}


def _call_at(text: Text, offset: int) -> tuple[str, int, str]:
    """Return the function called at an offset, the number of the argument, and its name."""
    start = max(text.text.rfind("\n", 0, offset), text.text.rfind("\r", 0, offset)) + 1
    line = text.text[start:offset]
    key, colon, rest = line.lstrip(" -").partition(":")
    if colon and key[:1].isupper() and key.replace(".", "").isidentifier():
        pieces = _split(rest)
        name, sign, _ = pieces[-1].partition("=")
        return key, len(pieces) - 1, name.strip() if sign else ""
    cursor = cursor_at(text.root, offset)
    for depth in range(len(cursor.keys), 0, -1):
        place = place_of(cursor.keys[:depth])
        if place.name == "call":
            inner = cursor.keys[depth:]
            scalar = cursor.scalar
            given = inner[0].text if inner else scalar.text if scalar is not None else ""
            return place.call, 0, given
    return "", 0, ""


def _split(text: str) -> list[str]:
    """Return the arguments of a short call that is being written."""
    pieces, depth, at, start = [], 0, 0, 0
    while at < len(text):
        if text.startswith("$(", at):
            close = find_close(text, at + 2)
            at = close if close >= 0 else len(text)
        elif text[at : at + 1] in "[{":
            depth += 1
        elif text[at : at + 1] in "]}":
            depth -= 1
        elif text[at : at + 1] == "," and depth <= 0:
            pieces.append(text[start:at])
            start = at + 1
        at += 1
    return [*pieces, text[start:]]
