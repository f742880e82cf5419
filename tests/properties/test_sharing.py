"""Sharing elements between places changes nothing: neither the XML nor a letter of a message.

Random programs are run as always, where an element may stand wherever it would be built again, and
by the plain way, which builds each element for its place. They repeat themselves in loops, calls,
blocks and includes, with values that Python takes for equal, and have the faults that people make.
"""

from __future__ import annotations

import os
import random

import pytest

from tests.effort import examples
from tests.unshared import unsharing
from yamaro import YamaroError, api, pipeline
from yamaro.codes import ADJUSTABLE
from yamaro.files.loader import MemoryLoader
from yamaro.rendering import render

COUNT = int(os.environ.get("YAMARO_SHARING_EXAMPLES", examples(400)))
SEED = int(os.environ.get("YAMARO_FUZZ_SEED", "0"))

# Pairs of values that Python takes for equal, and that are written in different ways.
NUMBERS = ("0.5", "1", "1.0", "2", "2.0", "0.25", "0.25")
ODD = ("0", "0.0", "-0.0", "true", "'1'", "[1, 1, 2]", "null", "x", "-1")
EXPRESSIONS = ("v", "v", "w", "w", "v + w", "v / 4", "i + 1", "float(v)")
CALLS = {
    "Around": ("Limb", "Limb", "Pair"),
    "Pair": ("Limb",),
    "Limb": ("Shape", "Plain"),
    "Plain": ("Shape",),
    "Shape": (),
    "": ("Around", "Limb", "Pair"),
}
"""What each function may call; the last one is the main file."""


SKIN = """\
  Skin:
    input: v
    body:
      - visual: {xyz: $(v) 0 0, <extra>: {<deep>: $(v)}}
      - Coat: $(v)
      - collision:
          if: {condition: v == 1, body: {scale: 1 2 3}}
          Plate: $(v)
      - density: $(v)
  Coat:
    input: v
    body: {visual: {geometry: sphere, scale: $(v), material: {name: m, color: 1 1 $(v) 1}}}
  Plate:
    input: v
    body: {geometry: box, if: {condition: v == 2, body: {scale: 1 $(v) 1}}}
  Bounds:
    input: v
    body: {limit: {lower: -$(v), upper: $(v)}, dynamics: {damping: 1, frction: $(v)}}
""".splitlines()
"""Functions that are called in parts."""


class Programs:
    """Writes random programs as YAML."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.faults = self.random.choice((0.0, 0.0, 0.02, 0.2))
        self.inside = ""

    def pick(self, *choices: str) -> str:
        return self.random.choice(choices)

    def is_faulty(self) -> bool:
        return self.random.random() < self.faults

    def value(self) -> str:
        return self.pick(*ODD) if self.is_faulty() else self.pick(*NUMBERS)

    def number(self) -> str:
        if self.is_faulty():
            return self.pick("nan", "ten", "$(name)", "-1", "0", "$(-0.0)", "")
        return self.pick(f"$({self.pick(*EXPRESSIONS)})", self.pick(*NUMBERS))

    def row(self, *, has_zeros: bool = True) -> str:
        if self.is_faulty():
            return self.pick("1 2", "a b c", "$(name)", "1 2 nan")
        zero = (self.pick("0", "0.0", "$(0)", "$(0.0)", "$(-0.0)"),) if has_zeros else ()
        return " ".join(self.pick(self.number(), *zero) for _ in range(3))

    def files(self) -> dict[str, str]:
        main = ["robot: shared", "variables: {v: 1, w: 0.5, name: n, i: 0}", "functions:"]
        for name in ("Shape", "Plain", "Limb", "Pair", "Around"):
            main += self.function(name)
        main += SKIN
        self.inside = ""
        main += ["model:", *indented(self.body("robot", 3))]
        self.inside = "Plain"
        inner = ["variables: {v: 2, w: 0.25, name: m, i: 1}", "functions:"]
        inner += self.function("Shape")
        inner += SKIN
        self.inside = "Plain"
        inner += ["model:", *indented(self.body("robot", 2))]
        return {"robot.yaml": "\n".join(main) + "\n", "inner.yaml": "\n".join(inner) + "\n"}

    def function(self, name: str) -> list[str]:
        self.inside = name
        lines = [f"  {name}:", "    input: v=0.5, w=1, name=n, i=1, **Block", "    body:"]
        body = self.body("link" if name in ("Shape", "Plain") else "robot", 2)
        if self.random.random() < 0.5:
            body.append("- Block:")
        return lines + indented(body, 4)

    def body(self, place: str, depth: int) -> list[str]:
        lines: list[str] = []
        for _ in range(self.random.randint(1, 3)):
            lines += self.statement(place, depth)
        return lines

    def statement(self, place: str, depth: int) -> list[str]:
        roll = self.random.random()
        if depth <= 0 or roll < 0.35:
            return self.element(place, depth)
        if roll < 0.6:
            values = ", ".join(self.value() for _ in range(self.random.randint(2, 4)))
            iterator, over = self.pick("v", "w", "i"), f"in: [{values}]"
            if self.random.random() < 0.4:
                over = f"range: {self.random.randint(1, 3)}"
            head = ["- for:", f"    iterator: {iterator}", f"    {over}", "    body:"]
            return head + indented(self.body(place, depth - 1), 4)
        if roll < 0.7:
            head = ["- if:", f"    condition: {self.pick('v == 1', 'w', 'i > 0')}", "    body:"]
            return head + indented(self.body(place, depth - 1), 4)
        if roll < 0.75 and place == "robot" and self.inside in ("", "Pair"):
            return ["- include:", "    path: inner.yaml", f"    v: {self.value()}"]
        return self.call(place, depth)

    def call(self, place: str, depth: int) -> list[str]:
        of_link = ("Shape", "Plain")
        names = [n for n in CALLS[self.inside] if (n in of_link) == (place == "link")]
        if place == "link" and self.inside not in of_link:
            names = list(of_link)
        if not names:
            return self.element(place, depth)
        lines = [f"- {self.pick(*names)}:"]
        for variable in ("v", "w", "i"):
            value = self.pick(self.value(), "$(v)", "$(w)", "$(i)")
            lines += [f"    {variable}: {value}"][: self.random.randint(0, 1)]
        if self.random.random() < 0.4:
            lines += ["    Block:", *indented(self.body(place, depth - 1), 4)]
        return lines

    def element(self, place: str, depth: int) -> list[str]:
        if place == "robot":
            makers = (self.part, self.part, self.link, self.joint)
            return self.random.choice(makers)(depth)
        return self.random.choice((self.section, self.section, self.odd))(depth)

    def name(self) -> str:
        return self.pick("a", "b", "l_$(i)", "l_$(v)", "$(name)_$(i)", "$(name)_$(v)_$(w)")

    def part(self, depth: int) -> list[str]:
        lines = [f"- name: {self.name()}"]
        if self.random.random() < 0.7:
            lines += ["- joint:", f"    parent: {self.name()}", f"    xyz: {self.row()}"]
            lines.append(f"    type: {self.pick('fixed', 'revolute', 'revolute')}")
            if self.random.random() < 0.6:
                limit = f"{{lower: -1, upper: {self.pick('1', '-2')}, effort: 1, velocity: 1}}"
                lines.append(f"    limit: {limit}")
            if self.random.random() < 0.3:
                lines.append(f"    rpy: {self.row()}")
            if self.random.random() < 0.3:
                lines.append(f"    Bounds: {self.number()}")
        lines += ["- link:", f"    geometry: {'bx' if self.is_faulty() else 'box'}"]
        lines += [f"    scale: {self.row(has_zeros=False)}", f"    mass: {self.number()}"]
        if self.random.random() < 0.5:
            lines.append(f"    xyz: {self.row()}")
        lines += [
            f"    {section}:"
            for section, chance in (("visual", 0.5), ("collision", 0.5), ("unknown", self.faults))
            if self.random.random() < chance
        ]
        if self.random.random() < 0.4:
            lines += [f"    Skin: {self.value()}"]
        if self.random.random() < 0.2:
            lines += self.body("robot", depth - 1)
        return ["- part:", *indented(lines)]

    def link(self, depth: int) -> list[str]:
        return [f"- link/name={self.name()}:", *indented(self.body("link", depth - 1), 4)]

    def joint(self, depth: int) -> list[str]:
        kind = "hinge" if self.is_faulty() else self.pick("fixed", "continuous")
        return [
            f"- joint/name={self.name()}, type={kind}:",
            f"    parent/link={self.name()}:",
            f"    child/link={self.name()}:",
            f"    origin/xyz={self.row()}, rpy=0 0 0:",
            self.pick("    axis/xyz=0 0 1:", f"    axis/xyz={self.row()}:"),
        ]

    def section(self, depth: int) -> list[str]:
        return [
            f"- {self.pick('visual', 'collision', 'visual/name=$(name)')}:",
            f"    origin/xyz={self.row()}:",
            "    geometry:",
            self.pick(
                "      box/size=1 1 1:",
                "      box/size=1 1 $(v):",
                f"      sphere/radius={'-1' if self.is_faulty() else '$(w)'}:",
                f"      {'bx' if self.is_faulty() else 'box'}/size=1 1 1:",
            ),
            *self.random.choice(([], ["    material/name=$(name):"], ["    material/name=grey:"])),
        ]

    def odd(self, depth: int) -> list[str]:
        if self.is_faulty():
            return [
                self.pick(
                    "- mass/value=$(v):",
                    "- gz:color: red",
                    '- extra/a="$(chr(7) if i else 1)":',
                    "- extra: $(1 / i)",
                    "- $(v)_made/a=1:",
                    "- extra/a=1, $(name)=2:",
                    "- part: {name: inner}",
                )
            ]
        return [
            self.pick(
                "- <#comment>: $(name)",
                "- <#comment>: plain",
                "- extra/a=$(v), b=1: $(w)",
                "- extra: <&>",
                "- $(name)_made/a=1:",
                "- gazebo: {a: {b: $(v), c: 1}, d/e=$(w): [f: 1]}",
            )
        ]


def indented(lines: list[str], by: int = 2) -> list[str]:
    return [" " * by + line for line in lines]


def result_of(files: dict[str, str]) -> tuple[str, list[str]]:
    """Return the XML, and all there is to tell."""
    folder = os.path.abspath("robots")
    loader = MemoryLoader({os.path.join(folder, name): text for name, text in files.items()})
    try:
        build = api.build(
            os.path.join(folder, "robot.yaml"), loader=loader, advice=True, allow=ADJUSTABLE
        )
    except YamaroError as error:
        return "", [render(diagnostic) for diagnostic in error.diagnostics]
    return build.xml(), [render(diagnostic) for diagnostic in build.warnings]


def test_sharing_changes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    made = warned = refused = 0
    for seed in range(SEED, SEED + COUNT):
        files = Programs(seed).files()
        with monkeypatch.context() as patch:
            patch.setattr(pipeline, "Interpreter", unsharing)
            expected = result_of(files)
        found = result_of(files)
        assert found == expected, f"seed {seed}:\n{files['robot.yaml']}\n{files['inner.yaml']}"
        refused += not found[0]
        made += bool(found[0])
        warned += bool(found[0] and found[1])
    assert made > COUNT / 10, "the programs are too often wrong to show anything"
    assert warned > COUNT / 20
    assert refused > COUNT / 20
