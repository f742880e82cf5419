"""Texts to feed: files of the project with a few slips of the hand in them, and random ones."""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Sequence

PIECES = (
    "# )\n", "#", " #", "'''", '"""', "')'", '"("', "'it\\'s)'", "r'\\)'", "\\\n", "'''\\n)'''",
    "f'{x}('", "lambda: 0", "$(", "$$(", "$${", "${", ")", "x if y else z", "find a", "optenv A b",
    " == ", "[x for x in y]", ": ", " - ", "%", "&a ", "*a", "<<: *a", "\n...\n", "\n---\n",
    "\\u00e9",
)  # fmt: skip
"""Python, YAML and their signs, where they mean something to each other."""

Lines = list[str]
Mutation = Callable[[str, int, random.Random], str]

WORD = re.compile(r"[A-Za-z_]\w+")
SIGNS = "{}[]()'\"$:#,&*!|>%@`/\\-=<?~.+\t\r\n\x00\x07\x85é\u2028\ufeff\ud800😀 "
VALUES = (
    " ", " null", " 1e400", " .nan", " -1", " $(1/0)", " $(x", " [1, 2]", " {a: 1}", " [{a: 1}]",
    " $([1, 2])", " $(None)", " ''", " a b c", " 1 2", " $(lambda: 1)", " *x", " &x y", " !t z",
    " |", " $(print)", " $('é')", " 0x1F", " package://nowhere/x.stl", " true", " []", " {}", " >-",
    " $(True)", " $(b'x')", " $({1, 2})", " $(object())", " $(print('x'))", " $(exit(1))", " $()",
    " $(chr(0))", " $('\\ud800')", " ${x}", " $(find nowhere)", " $(env('NO'))", " $$(x)", " -.inf",
    " $(float('nan'))", " 1:30", " ./missing.yaml", " .", " \"\\x00\"", " '$(1)'", " 0 0 1",
    " cube.stl", " cube.obj",
    " $((1, 'a'))", " $(e)", " $(type)", " $(int)", " $(next(n for n in []))", " x=1", " x=1, x=2",
)  # fmt: skip
KEYS = (
    "part", "if", "elif", "else", "for", "include", "variables", "functions", "print", "model",
    "robot", "name", "joint", "link", "Call", "ns.Call", "$(x)", "$('part')", "a/b=1", "a/b", "<a>",
    "<#text>", "'#comment'", "condition", "body", "iterator", "range", "in", "path", "namespace",
    "geometry", "scale", "mass", "density", "inertial", "inertia", "collision", "visual", "xyz",
    "rpy", "pivot", "axis", "limit", "mimic", "type", "parent", "material", "input", "<<", "",
    "process", "import", "sdf/version='1.11'", "$('')", "$(None)", "a/$('b')=1", "a/b=$(1", "'a b'",
    "? [a]", "x/global", "x/parent", "x/child", "x/bridge", "Make/global", "origin/xyz=1",
    "Block", "$('if')", "$('Make')", "robot/a=1", "link/name=$(x)", "a:b", "xmlns:a/b=1",
)  # fmt: skip


def indent_of(line: str) -> int:
    return len(line) - len(line.lstrip(" "))


def end_of_block(lines: Lines, row: int) -> int:
    """Return the row behind the lines that stand deeper than line `row`."""
    end = row + 1
    while end < len(lines) and (
        not lines[end].strip() or indent_of(lines[end]) > indent_of(lines[row])
    ):
        end += 1
    return end


def insert_sign(text: str, at: int, rng: random.Random) -> str:
    return text[:at] + rng.choice(SIGNS) + text[at:]


def insert_piece(text: str, at: int, rng: random.Random) -> str:
    return text[:at] + rng.choice(PIECES) + text[at:]


def delete_some(text: str, at: int, rng: random.Random) -> str:
    return text[:at] + text[at + rng.randint(1, 3) :]


def cut_off(text: str, at: int, rng: random.Random) -> str:
    return text[:at]


def swap_words(text: str, at: int, rng: random.Random) -> str:
    words = text.split(" ")
    i, j = rng.randrange(len(words)), rng.randrange(len(words))
    words[i], words[j] = words[j], words[i]
    return " ".join(words)


def misspell_word(text: str, at: int, rng: random.Random) -> str:
    found = WORD.search(text, at)
    if found is None:
        return text
    i = rng.randrange(found.start(), found.end() - 1)
    return text[:i] + text[i + 1] + text[i] + text[i + 2 :]


def replace_word(text: str, at: int, rng: random.Random) -> str:
    words = list(WORD.finditer(text))
    if not words:
        return text
    found = rng.choice(words)
    return text[: found.start()] + rng.choice(words).group() + text[found.end() :]


def compute_word(text: str, at: int, rng: random.Random) -> str:
    found = WORD.search(text, at)
    if found is None:
        return text
    computed = rng.choice((f"$({found.group()})", f"$('{found.group()}')", f"'{found.group()}'"))
    return text[: found.start()] + computed + text[found.end() :]


def end_lines_otherwise(text: str, at: int, rng: random.Random) -> str:
    return text.replace("\n", rng.choice(("\r\n", "\r", "\n\n")))


def on_lines(change: Callable[[Lines, int, random.Random], None]) -> Mutation:
    """Return the mutation of a text that `change` makes on its lines, at a random one."""

    def mutation(text: str, at: int, rng: random.Random) -> str:
        lines = text.split("\n")
        change(lines, rng.randrange(len(lines)), rng)
        return "\n".join(lines)

    return mutation


def repeat_line(lines: Lines, row: int, rng: random.Random) -> None:
    lines.insert(row, rng.choice(lines))


def delete_line(lines: Lines, row: int, rng: random.Random) -> None:
    del lines[row]


def swap_lines(lines: Lines, row: int, rng: random.Random) -> None:
    other = rng.randrange(len(lines))
    lines[row], lines[other] = lines[other], lines[row]


def indent_line(lines: Lines, row: int, rng: random.Random) -> None:
    lines[row] = " " * rng.randint(0, 8) + lines[row].lstrip()


def give_value(lines: Lines, row: int, rng: random.Random) -> None:
    key, colon, _ = lines[row].partition(":")
    lines[row] = key + colon + rng.choice(VALUES)


def give_key(lines: Lines, row: int, rng: random.Random) -> None:
    _, colon, value = lines[row].partition(":")
    lines[row] = " " * indent_of(lines[row]) + rng.choice(KEYS) + (colon or ":") + value


def make_item(lines: Lines, row: int, rng: random.Random) -> None:
    indent = indent_of(lines[row])
    lines[row] = " " * indent + "- " + lines[row][indent:]


def delete_block(lines: Lines, row: int, rng: random.Random) -> None:
    del lines[row : end_of_block(lines, row)]


def move_block(lines: Lines, row: int, rng: random.Random) -> None:
    """Move or copy a line with what stands under it below another line, indented to fit."""
    end = end_of_block(lines, row)
    block = lines[row:end]
    if rng.random() < 0.5:
        del lines[row:end]
    target = rng.randrange(len(lines) + 1)
    indent = indent_of(lines[target - 1]) + rng.choice((0, 2)) if target else 0
    shift = indent - indent_of(block[0])
    lines[target:target] = [
        " " * max(indent_of(line) + shift, 0) + line.lstrip(" ") for line in block
    ]


MUTATIONS: list[Mutation] = [
    insert_sign, insert_piece, insert_piece, delete_some, cut_off, swap_words, misspell_word,
    replace_word, compute_word, end_lines_otherwise,
    *map(on_lines, (
        repeat_line, delete_line, swap_lines, indent_line, give_value, give_key, make_item,
        delete_block, move_block,
    )),
]  # fmt: skip


class Mutator:
    """Makes texts out of seeds."""

    def __init__(self, seeds: Sequence[str]) -> None:
        self.seeds = seeds

    def mutate(self, text: str, rng: random.Random) -> str:
        """Return the text with a few random changes, of the kinds a slip of the hand makes."""
        for _ in range(rng.randint(1, 4)):
            roll = rng.random()
            if not text:
                return self.make(rng)
            if roll < 0.9:
                text = rng.choice(MUTATIONS)(text, rng.randrange(len(text) + 1), rng)
            else:
                text = self.borrow_lines(text, rng)
        return text

    def borrow_lines(self, text: str, rng: random.Random) -> str:
        """Put a block of another seed into the text."""
        lines, other = text.split("\n"), rng.choice(self.seeds).split("\n")
        row, start = rng.randrange(len(lines)), rng.randrange(len(other))
        lines[row:row] = other[start : end_of_block(other, start)][:12]
        return "\n".join(lines)

    def make(self, rng: random.Random) -> str:
        """Return a text: eight in ten are seeds with changes."""
        roll = rng.random()
        if roll < 0.8:
            return self.mutate(rng.choice(self.seeds) or " ", rng)
        return random_tree(rng) if roll < 0.9 else random_text(rng)


# --- out of nothing ---------------------------------------------------------------------------


def random_text(rng: random.Random) -> str:
    """Return characters, half of them of those that mean something somewhere."""
    return "".join(
        rng.choice(SIGNS) if rng.random() < 0.5 else random_character(rng)
        for _ in range(rng.randint(0, 60))
    )


def random_character(rng: random.Random) -> str:
    return chr(rng.choice((rng.randrange(32, 127), rng.randrange(0x250), rng.randrange(0x11000))))


def random_tree(rng: random.Random) -> str:
    """Return lists and mappings of the language's words as YAML, not always rightly quoted."""
    sections = [(rng.choice(("model", "variables", "functions", random_key(rng))), 3)]
    sections += [(random_key(rng), 2)] * rng.randint(0, 2)
    return "".join(f"\n{key}:{random_body(rng, depth, 1)}" for key, depth in sections)


def random_key(rng: random.Random) -> str:
    return rng.choice(KEYS) if rng.random() < 0.8 else random_text(rng)[:8]


def random_body(rng: random.Random, depth: int, indent: int) -> str:
    roll = rng.random()
    if depth == 0 or roll < 0.3:
        return rng.choice(VALUES) if rng.random() < 0.8 else f" {random_text(rng)[:12]}"
    pad = "  " * indent
    if roll < 0.8:
        keys = [random_key(rng) for _ in range(rng.randint(1, 5))]
        return "".join(f"\n{pad}{key}:{random_body(rng, depth - 1, indent + 1)}" for key in keys)
    items = range(rng.randint(1, 3))
    return "".join(f"\n{pad}-{random_body(rng, depth - 1, indent + 1)}" for _ in items)
