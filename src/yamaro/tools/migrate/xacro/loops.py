"""Macros of xacro that call themselves to repeat something, as loops.

xacro has no loops; a macro whose content is one condition, with some work and a call of itself in
it, does for one. Where it is certain that a loop does the same for all arguments, it becomes one:

- counting: `${i < n}` and a call with `${i + 1}`, in any direction, with a step and a bound that
  stay the same;
- a list: `${items}` and a call with `${items[1:]}`, or with what `${items.pop(0)}` left.

The call may come after the work, or before it, which does the work from the end to the beginning.
What the call changes besides is assigned at the end of the loop's body.
"""

from __future__ import annotations

import ast
import re

from ....syntax.names import is_identifier
from ....xacro.symbol_table import assigned_in, properties_in, used_in
from ....xacro.templates import guess_value
from ....xml.tree import Comment, Element, Text
from ....xml.values import format_value
from ..document import Body, Entry
from ..elements import has_text, name_of, tidy_text
from .python import CannotMigrate

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ....xml.tree import Node
    from .program import Macro, XacroProgram
    from .python import Translator


# --- conditions that count, and what they become as ranges ------------------------------------


_COMPARED: dict[type[ast.cmpop], str] = {
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
    ast.Eq: "==",
    ast.NotEq: "!=",
}
_MIRRORED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "==", "!=": "!="}
_NEW_LISTS = ("list", "sorted", "split", "copy")
"""Functions and methods whose list nobody else has."""


class NoLoop(Exception):
    """A macro is not a loop, or not for certain."""


def require(holds: bool) -> None:
    """Raise NoLoop unless a condition holds."""
    if not holds:
        raise NoLoop


def parsed_python(python: str) -> ast.expr:
    """Return the tree of an expression; raise NoLoop if it is not one."""
    try:
        return ast.parse(python, mode="eval").body
    except (SyntaxError, ValueError):
        raise NoLoop from None


def source_of(python: str, node: ast.expr) -> str:
    """Return the text of a node of an expression."""
    return ast.get_source_segment(python, node) or ast.unparse(node)


def step_of(python: str, name: str) -> int:
    """Return what an expression adds to a name; 0 if it does anything else."""
    match parsed_python(python) if python else None:
        case ast.BinOp(ast.Name(own), ast.Add() | ast.Sub() as op, ast.Constant(int(step))):
            pass
        case ast.BinOp(ast.Constant(int(step)), ast.Add() as op, ast.Name(own)):
            pass
        case _:
            return 0
    return 0 if own != name else step if isinstance(op, ast.Add) else -step


def comparison_in(condition: ast.expr, steps: dict[str, int]) -> tuple[str, str, ast.expr | None]:
    """Return which counted name is compared, how, and with what; None is for zero."""
    match condition:
        case ast.Name(name):
            found: tuple[str, str, ast.expr | None] = name, "!=", None
        case ast.Compare(ast.Name(name), [op], [bound]) if steps.get(name):
            found = name, _COMPARED.get(type(op), ""), bound
        case ast.Compare(bound, [op], [ast.Name(name)]):
            found = name, _MIRRORED.get(_COMPARED.get(type(op), ""), ""), bound
        case _:
            raise NoLoop
    require(bool(steps.get(found[0]) and found[1]))
    return found


def moved_bound(source: str, bound: ast.expr, amount: int) -> str:
    """Return a bound plus or minus one."""
    match bound:
        case ast.Constant(int(value)):
            return str(value + amount)
        case ast.BinOp(_, ast.Sub() | ast.Add() as op, ast.Constant(1)):
            if isinstance(op, ast.Sub) == (amount == 1):
                return source.rpartition("-" if amount == 1 else "+")[0].strip()
    return f"{source} {'+' if amount == 1 else '-'} 1"


def range_of(name: str, stop: str, step: int, is_backwards: bool) -> str:
    """Return what counts from a name to `stop`, which is left out; or the other way round."""
    pieces = [name, stop] if step == 1 else [name, stop, str(step)]
    if is_backwards and step not in (1, -1):
        return f"reversed(range({', '.join(pieces)}))"
    if is_backwards:
        first = moved_bound(stop, parsed_python(stop), -step)
        pieces = [first, f"{name} + 1"] if step == -1 else [first, f"{name} - 1", "-1"]
    return f"range({', '.join(pieces)})"


def is_whole(text: str) -> bool:
    """Return whether a text is a whole number."""
    return not isinstance(guess_value(text), float)


def is_new_list(node: ast.expr) -> bool:
    """Return whether an expression makes a list of its own."""
    match node:
        case ast.List() | ast.ListComp() | ast.Subscript(_, ast.Slice()):
            return True
        case ast.Call(ast.Name(name) | ast.Attribute(_, name)):
            return name in _NEW_LISTS
        case ast.BinOp(left, ast.Add() | ast.Mult(), right):
            return is_new_list(left) or is_new_list(right)
    return False


# --- loops ------------------------------------------------------------------------------------


_CONDITIONS = ("xacro:if", "xacro:unless")
_NOT_IN_LOOPS = ("xacro:call", "xacro:macro", "xacro:include")
_INVERTED = {"<": ">=", "<=": ">", ">": "<=", ">=": "<", "==": "!=", "!=": "=="}
_FUNCTIONS = ("len", "int", "min", "max", "abs")
"""What a bound may call: it has no effect, and gives the same each time."""


class Loop:
    """A loop in the place of a macro's content.

    Attributes:
        iterator: the name it gives its item or number.
        over: what it runs over, as Python.
        work: what is done each time.
        changes: the texts that parameters are given before the next time, in order.
        last: what is done once when nothing is left.
        comments: above the loop, and above its iterator.
    """

    def __init__(self, iterator: str, over: str, work: list[Node]) -> None:
        self.iterator = iterator
        self.over = over
        self.work = work
        self.changes: list[tuple[str, str]] = []
        self.last: list[Node] = []
        self.comments = ("", "")

    def body(self, statements: Callable[[list[Node]], Body], value: Callable[[str], str]) -> Body:
        """Return it as statements; the two functions write what it is made of."""
        work = statements(self.work)
        if self.changes:
            work.add("variables", Body([Entry(name, value(text)) for name, text in self.changes]))
        body = Body()
        above, at_iterator = self.comments
        body.note(above)
        loop = [Entry("iterator", self.iterator, at_iterator), Entry("in", self.over)]
        body.add("for", Body([*loop, Entry("body", work or None)]))
        body.extend(statements(self.last))
        return body


def find_loop(macro: Macro, program: XacroProgram, translator: Translator) -> Loop | None:
    """Return the loop that a macro is, or None if that is not certain."""
    if not any(inner.name == f"xacro:{macro.name}" for inner in macro.element.iter()):
        return None
    try:
        return _Reader(macro, program, translator).loop()
    except (NoLoop, CannotMigrate):
        return None


class _Reader:
    """Reads a macro that calls itself.

    Attributes:
        guard: the condition with the work and the call.
        call: of itself.
        before, after: the work on either side of the call.
        changed: the texts that the call gives to parameters, without those that stay the same.
    """

    def __init__(self, macro: Macro, program: XacroProgram, translator: Translator) -> None:
        """Take the macro to pieces."""
        self._macro = macro
        self._program = program
        self._translator = translator
        tag = f"xacro:{macro.name}"
        inside = [own for own in macro.element.iter() if own is not macro.element]
        elements = macro.element.elements()
        guards = [own for own in elements if any(e.name == tag for e in own.elements())]
        require(len(guards) == 1 and guards[0].name in _CONDITIONS)
        require(not has_text(macro.element))
        require([own.name for own in inside].count(tag) == 1)
        require(not any(own.name in _NOT_IN_LOOPS for own in inside))
        require(sum(own.name == macro.name for own in program.definitions.values()) == 1)
        self.guard = guards[0]
        self._last = [own for own in elements if own is not self.guard]
        require(all(_is_opposite(own, self.guard) for own in self._last) and len(self._last) < 2)
        nodes = self.guard.children
        position = next(at for at, node in enumerate(nodes) if _is_named(node, tag))
        (self.call,) = (
            node for node in nodes[position : position + 1] if isinstance(node, Element)
        )
        self.before, self.after = nodes[:position], nodes[position + 1 :]
        self._properties = [own for own in inside if own.name == "xacro:property"]
        self._defined = {name_of(own) for own in self._properties}
        self._outside = set().union(*map(assigned_in, program.roots.values()))
        # what is defined in the macro has to be its own, and its parameters to stay
        for own in self._properties:
            require(set(own.attributes) <= {"name", "value", "lazy_eval"})
            require("value" in own.attributes)
        require(all(own.isidentifier() for own in (*self._defined, *macro.values())))
        require(not (self._defined | self._outside) & set(macro.values()))
        given = {name: format_value(value) for name, value in self.call.attributes.items()}
        require(set(given) <= set(macro.values()))
        self.changed: dict[str, str] = {}
        for parameter in macro.parameters:
            name = parameter.name
            if name in given and self._python(given[name]) != name:
                self.changed[name] = given[name]
            require(name in given or parameter.is_forwarded or parameter.is_block)
        # blocks have to be handed on as they are
        blocks, handed = macro.blocks(), self.call.elements()
        require(len(handed) == len(blocks))
        for block, element in zip(blocks, handed, strict=True):
            require(block[1:] == element.attributes.get("name") and block[1] != "*")
            require(element.name == "xacro:insert_block")

    # --- the pieces -----------------------------------------------------------------------------

    def _python(self, text: str) -> str:
        """Return the expression that is all of a text, as Python; an empty text if none is."""
        text = text.strip()
        if not text.startswith("${") or text.find("}") != len(text) - 1:
            return ""
        return self._translator.expression(text[2:-1])

    def _condition(self) -> tuple[str, ast.expr, bool]:
        """Return the condition as Python, and whether it is turned round."""
        python = self._translator.condition(format_value(self.guard.attributes.get("value")))
        return python, parsed_python(python), self.guard.name == "xacro:unless"

    def loop(self) -> Loop:
        """Return the loop.

        Raises:
            NoLoop: it is not a loop.
            CannotMigrate: an expression cannot be carried over.
        """
        is_backwards = any(isinstance(node, Element) for node in self.after)
        if is_backwards:
            # hold that the work after the call makes use of nothing but the call's own names
            require(not any(isinstance(node, Element) for node in self.before))
            require(not self._last and len(self.changed) <= 1)
            require(not self._program.handed_to(self._macro.element))
            require(not self._defined & self._program.inherited)
            direct = [own for own in self.after if _is_named(own, "xacro:property")]
            require(len(direct) == len(self._properties) == len(self._defined))
            defined: set[str] = set()
            for node in self.after:
                if isinstance(node, Element):
                    require(not used_in(node) & (self._defined - defined))
                    if node in direct:
                        defined.add(name_of(node))
        above, here = _comments(self._macro.element.children), ""
        name = self._list_name()
        if name:
            loop, here = self._over_list(name, is_backwards)
        else:
            loop = self._counting(is_backwards)
        loop.comments = above, here
        require(not {loop.iterator, name, *self.changed} & self._program.inherited)
        loop.last = [node for own in self._last for node in own.children]
        require(not any(self._reads(loop.last, own) for own in (loop.iterator, name)))
        return loop

    def _reads(self, nodes: list[Node], name: str) -> bool:
        """Return whether a name is read in statements, or by the macros that they call."""
        for node in nodes:
            if not isinstance(node, Element):
                if name in used_in(Element("", self.call.span, {}, [node])):
                    return True
            elif name in used_in(node) or name in self._program.forwarded_in(node):
                return True
        return False

    def _ordered(self, changes: dict[str, str]) -> list[tuple[str, str]]:
        """Return changes in an order in which none reads what another has changed."""
        pending = dict(changes)
        ordered: list[tuple[str, str]] = []
        while pending:
            reads = {
                name: used_in(Element("", self.call.span, {"text": text}))
                for name, text in pending.items()
            }
            free = [
                name
                for name in pending
                if not any(name in reads[other] for other in pending if other != name)
            ]
            require(bool(free))
            ordered.append((free[0], pending.pop(free[0])))
        return ordered

    # --- counting -------------------------------------------------------------------------------

    def _counting(self, is_backwards: bool) -> Loop:
        """Return a loop whose condition compares a parameter that is counted up or down."""
        python, condition, is_inverted = self._condition()
        steps = {name: step_of(self._python(text), name) for name, text in self.changed.items()}
        while isinstance(condition, ast.UnaryOp) and isinstance(condition.op, ast.Not):
            condition, is_inverted = condition.operand, not is_inverted
        name, relation, bound = comparison_in(condition, steps)
        if is_inverted:
            relation = _INVERTED[relation]
        step = steps[name]
        changed = {other: text for other, text in self.changed.items() if other != name}
        source = "0" if bound is None else source_of(python, bound)
        bound = bound or ast.Constant(0)
        # hold that the bound is the same each time, and that only whole numbers were counted, as
        # far as can be seen
        texts = [self.changed[name]]
        moving = {name, *changed} | self._defined | self._outside
        for node in ast.walk(bound):
            if isinstance(node, ast.Name):
                require(node.id not in moving)
                # what it may be as an argument, a parameter or a property
                texts += [f"${{{node.id}}}", self._program.values_of_arguments.get(node.id, "")]
                texts += [format_value(own.attributes.get(node.id)) for own in self._calls()]
                for root in self._program.roots.values():
                    texts += [own.value for own in properties_in(root) if own.name == node.id]
            elif isinstance(node, ast.Call):
                require(isinstance(node.func, ast.Name) and node.func.id in _FUNCTIONS)
            else:
                is_float = isinstance(node, ast.Constant) and isinstance(node.value, float)
                require(isinstance(node, _PLAIN_NODES) and not is_float)
        for called in self._calls():
            texts.append(format_value(called.attributes.get(name, "")))
        for own in self._macro.parameters:
            if own.name == name:
                texts.append(own.default or "")
        floats = self._program.floats
        for text in texts:
            require(text.strip()[2:-1].strip() not in floats if "$" in text else is_whole(text))
        if relation in ("<=", ">="):
            require((relation == "<=") == (step > 0))
            source = moved_bound(source, bound, 1 if step > 0 else -1)
        elif relation == "!=":
            require(abs(step) == 1)
        else:
            require(relation == ("<" if step > 0 else ">"))
        require("range" not in self._all_names())
        work = self.after if is_backwards else self.before
        loop = Loop(
            name, range_of(name, source, step, is_backwards), _without_loose_end(work, changed)
        )
        loop.changes = self._ordered(changed)
        return loop

    def _calls(self) -> list[Element]:
        """Return the calls of the macro except its own."""
        tag = f"xacro:{self._macro.name}"
        roots = self._program.roots.values()
        return [
            own for root in roots for own in root.iter() if own.name == tag and own is not self.call
        ]

    # --- lists ----------------------------------------------------------------------------------

    def _list_name(self) -> str:
        """Return the name of the list that the condition asks about, or an empty text."""
        _, condition, is_inverted = self._condition()
        asked = ast.unparse(condition)
        for name in self._macro.values():
            held = (name, f"len({name})", f"len({name}) > 0", f"len({name}) != 0", f"{name} != []")
            empty = (f"not {name}", f"len({name}) == 0", f"{name} == []", f"len({name}) < 1")
            if asked in (empty if is_inverted else held):
                rest = self._python(self.changed.get(name, ""))
                if rest in (f"{name}[1:]", f"{name}[:-1]") or name not in self.changed:
                    return name
        return ""

    def _over_list(self, name: str, is_backwards: bool) -> tuple[Loop, str]:
        """Return a loop over a list, and the comment above its iterator."""
        work = list(self.after if is_backwards else self.before)
        rest = self._python(self.changed.get(name, ""))
        is_popped = name not in self.changed
        if is_popped:
            # all calls have to give a list that only they have, so that none sees it shrink
            given = [self._python(format_value(own.attributes.get(name))) for own in self._calls()]
            require(not is_backwards and bool(given))
            require(all(text and is_new_list(parsed_python(text)) for text in given))
            firsts = [f"{name}.pop(0)", f"{name}.pop()"]
        else:
            firsts = [f"{name}[0]" if rest == f"{name}[1:]" else f"{name}[-1]"]
        iterator, first, here = self._take_item(firsts, work)
        kind = self._program.numbers.get(first)
        if is_popped:
            require(any(_is_surely_read(node, iterator) for node in work))
        first = first or firsts[0]
        if not iterator:  # a name that nothing else has
            taken = self._all_names() | self._program.read | self._defined
            candidates = (name.removesuffix("s"), "item", f"{name}_item")
            free = [own for own in candidates if own not in taken and is_identifier(own)]
            require(bool(free))
            iterator = free[0]
        others = {other: text for other, text in self.changed.items() if other != name}
        if not is_popped:
            rewrite = Rewriting(first, iterator, self._program)
            work = [rewrite.node(node) for node in work]
            others = {other: rewrite.text(text) for other, text in others.items()}
        texts = [Text(text, self.call.span) for text in others.values()]
        require(not self._reads([*work, *texts], name))
        is_reversed = first.endswith(("[-1]", ".pop()")) != is_backwards
        items = f"{name}[::-1]" if is_reversed else name
        items = f"map({kind}, {items})" if kind else items
        loop = Loop(iterator, items, _without_loose_end(work, others))
        loop.changes = self._ordered(others)
        return loop, here

    def _take_item(self, firsts: list[str], work: list[Node]) -> tuple[str, str, str]:
        """Take the property that is the list's first item out of the work.

        Returns:
            its name, its value and the comment above it; empty texts if there is none.
        """
        for position, node in enumerate(work):
            if not isinstance(node, Element):
                continue
            own = name_of(node)
            value = format_value(node.attributes.get("value", "")).strip()[2:-1].strip()
            if node.name == "xacro:property" and value in firsts:
                names = [name_of(e) for e in self._properties]
                require(names.count(own) == 1 and own not in self._outside)
                require(not self._reads(work[:position], own))
                start = position
                while start and not isinstance(work[start - 1], Element):
                    start -= 1
                comment = _comments(work[start:position])
                del work[start : position + 1]
                return own, value, comment
        return "", "", ""

    def _all_names(self) -> set[str]:
        """Return the names of all properties, arguments and parameters."""
        program = self._program
        parameters = (own.values() for own in program.definitions.values())
        return {*program.at_top, *program.arguments, *program.properties}.union(*parameters)


_PLAIN_NODES = (
    *(ast.Constant, ast.Attribute, ast.Subscript, ast.BinOp, ast.UnaryOp, ast.USub),
    *(ast.Add, ast.Sub, ast.Mult, ast.FloorDiv, ast.Mod, ast.expr_context),
)


def _is_named(node: Node, tag: str) -> bool:
    return isinstance(node, Element) and node.name == tag


def _is_opposite(one: Element, other: Element) -> bool:
    """Return whether of two conditions exactly one holds."""
    values = {format_value(own.attributes.get("value")).strip() for own in (one, other)}
    return {one.name, other.name} == set(_CONDITIONS) and len(values) == 1


def _comments(nodes: list[Node]) -> str:
    return "\n".join(tidy_text(node.text) for node in nodes if isinstance(node, Comment))


def _without_loose_end(work: list[Node], changes: dict[str, str]) -> list[Node]:
    """Return the work without comments at its end, which describe the call, if that is gone."""
    end = len(work)
    while end and not changes and not isinstance(work[end - 1], Element):
        end -= 1
    for own in work[end:]:
        if not isinstance(own, Comment) and (
            not isinstance(own, Text) or format_value(own.value).strip()
        ):
            return work
    return work[:end]


def _is_surely_read(node: Node, name: str) -> bool:
    """Return whether a name is read whatever the conditions in a piece of work give."""
    if isinstance(node, (Text, Comment)):
        return isinstance(node, Text) and name in used_in(Element("", node.span, {}, [node]))
    if node.name in ("xacro:property", "xacro:arg"):
        return False
    if name in used_in(node.with_children([])):
        return True
    if node.name in _CONDITIONS:
        return False
    return any(_is_surely_read(child, name) for child in node.children)


# --- the first item of a list under another name ----------------------------------------------


class Rewriting:
    """Puts a name in the place of a list's first item."""

    def __init__(self, first: str, name: str, program: XacroProgram) -> None:
        """Take the item's expression, as `items[0]`, and its new name."""
        listed, _, index = first[:-1].partition("[")
        self._first = re.compile(rf"(?<![\w.]){listed}\s*\[\s*{index}\s*\]")
        self._name = name
        self._program = program

    def node(self, node: Node) -> Node:
        """Return an element with the name in all its expressions."""
        if isinstance(node, Text):
            return Text(self.text(format_value(node.value)), node.span)
        if isinstance(node, Comment):
            return node
        children = [self.node(child) for child in node.children]
        changed = node.with_children(children)
        changed.attributes = {
            name: self.text(format_value(value)) for name, value in node.attributes.items()
        }
        return changed

    def text(self, text: str) -> str:
        """Return a text with the name in its expressions."""
        return re.sub(r"\$\{([^}]*)\}", self._replaced, text)

    def _replaced(self, found: re.Match[str]) -> str:
        inner = found[1]
        changed = self._first.sub(self._name, inner)
        known = self._program.truths, self._program.numbers
        require(changed == inner or not any(inner.strip() in kinds for kinds in known))
        return f"${{{changed}}}"
