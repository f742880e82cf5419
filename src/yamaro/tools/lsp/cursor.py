"""Where in the YAML an offset is: the keys around it, and the scalar it is in."""

from __future__ import annotations

from ...yaml.nodes import MappingNode, ScalarNode, SequenceNode

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...yaml.nodes import YamlNode


class Cursor:
    """An offset in the tree of a file.

    Attributes:
        keys: the keys around it, outermost first; with `is_key` without the scalar itself.
        nodes: the value under each of `keys`.
        mapping: the innermost mapping around it, or None.
        scalar: the scalar it is in, or None.
        is_key: whether that is a key.
        value: what is under the key, if it is one.
    """

    __slots__ = ("is_key", "keys", "mapping", "nodes", "scalar", "value")

    def __init__(self) -> None:
        self.keys: list[ScalarNode] = []
        self.nodes: list[YamlNode] = []
        self.mapping: MappingNode | None = None
        self.scalar: ScalarNode | None = None
        self.value: YamlNode | None = None
        self.is_key = False

    def words(self) -> list[str]:
        """Return the keys around it without their attributes, `<name>` as `name`."""
        return [word_of(key.text) for key in self.keys]

    def parent(self) -> str:
        """Return the innermost of these words, "" at the root."""
        return word_of(self.keys[-1].text) if self.keys else ""


def word_of(key: str) -> str:
    """Return the name in a key `name/attribute=value`, or the statement of a short head."""
    word = key.partition("/")[0].strip().strip("<>")
    for head in ("if", "elif", "for"):
        if word.startswith((f"{head} ", f"{head}(")):
            return head
    return word


def cursor_at(root: YamlNode | None, offset: int) -> Cursor:
    """Return where an offset is; the end of a scalar belongs to it."""
    cursor = Cursor()
    node = root
    while node is not None and not isinstance(node, ScalarNode):
        if isinstance(node, SequenceNode):
            node = next((item for item in node.items if _holds(item, offset)), None)
            continue
        cursor.mapping = node
        key, value = _pair_at(node, offset)
        if key is None or value is None:
            return cursor
        if key.start <= offset <= key.end:
            cursor.scalar, cursor.is_key, cursor.value = key, True, value
            return cursor
        cursor.keys.append(key)
        cursor.nodes.append(value)
        node = value
    cursor.scalar = node
    return cursor


def _holds(node: YamlNode, offset: int) -> bool:
    return node.start <= offset <= node.end


def _pair_at(node: MappingNode, offset: int) -> tuple[ScalarNode | None, YamlNode | None]:
    """Return the last pair that begins at or before an offset and reaches it."""
    for key, value in node.pairs:
        if key.start <= offset <= key.end:
            return key, value
    for key, value in node.pairs:
        if key.start <= offset <= max(key.end, value.end) and _holds(value, offset):
            return key, value
    return None, None
