"""Any URDF, however odd, comes out of its migrated source as it was."""

from __future__ import annotations

from xml.sax.saxutils import escape, quoteattr

from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.effort import examples
from tests.same_robot import is_same_robot
from yamaro import build
from yamaro.codes import ADJUSTABLE
from yamaro.source import Source
from yamaro.tools.migrate.urdf import migrate_urdf
from yamaro.xml.reader import read_xml
from yamaro.xml.tree import Element

odd = st.sampled_from(
    """a b_link base wheel_joint ${x} $(y) $${z} it's "quoted" 'both"' a,b a=b a/b # #x :x x: a:b
    - ? ! !tag &a *a | > % @ ` ~ null true 1.0 007 0x1f 1e3 .5 -.5 +1 nan inf [a] {a} <b> a&b
    package://arm/meshes/a.stl ../meshes/b.dae é 机 none part if for model end\\ \\n \\ ''
    xacro:x --- ... =x ,""".split()
)
texts = st.one_of(
    odd,
    st.lists(odd, max_size=4).map(" ".join),
    st.sampled_from(
        ["", " ", "a  b", " a ", "x: y", "x #y", "a\nb", "\n  a\n    b\n  c\n", "a\tb"]
    ),
)
names = st.one_of(st.sampled_from(["base", "base_link", "arm_link", "arm", "a b", "", "x.y"]), odd)
number = st.one_of(
    st.sampled_from(["0", "1", "1.0", "-0.0", "1e-3", ".5", "+2", "1.", "0.10"]),
    st.floats(-10, 10).map(repr),
)


def rows(count: int) -> st.SearchStrategy[str]:
    good = st.lists(number, min_size=count, max_size=count).map(" ".join)
    return st.one_of(good, good, good, st.sampled_from(["0  0 0", "", "a b c", "0 0", " 1 2 3 "]))


def tag(name: str, attributes: dict[str, str], content: str = "") -> str:
    written = "".join(f" {key}={quoteattr(value)}" for key, value in attributes.items())
    return f"<{name}{written}>{content}</{name}>" if content else f"<{name}{written}/>"


@st.composite
def some(draw: st.DrawFn, *pieces: st.SearchStrategy[str]) -> str:
    """Draw each piece, or not, or twice, in any order."""
    chosen = [piece for piece in pieces for _ in range(draw(st.sampled_from([1, 1, 1, 1, 0, 2])))]
    drawn = [draw(piece) for piece in chosen]
    return "".join(draw(st.permutations(drawn)))


def simple(name: str, **attributes: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    full = st.fixed_dictionaries(attributes)
    part = st.fixed_dictionaries({}, optional={**attributes, "odd": texts})
    return st.one_of(full, full, full, part).map(lambda values: tag(name, values))


comment = st.sampled_from(["<!-- a note -->", "<!--\n  two\n  lines\n-->", "<!---->", " ", "\n"])
vendor = st.recursive(
    st.builds(
        lambda name, attributes, text: tag(name, attributes, escape(text)),
        st.sampled_from(["gazebo", "mu1", "Kp", "D", "part", "if", "include", "pose", "limit"]),
        st.dictionaries(st.sampled_from(["name", "reference", "x"]), texts, max_size=2),
        texts,
    ),
    lambda inner: st.builds(
        lambda name, content: tag(name, {}, "".join(content)),
        st.sampled_from(["gazebo", "sensor", "plugin", "Group"]),
        st.lists(st.one_of(inner, comment, texts.map(escape)), max_size=3),
    ),
    max_leaves=4,
)
origin = simple("origin", xyz=rows(3), rpy=rows(3))
shape = st.one_of(
    simple("box", size=rows(3)),
    simple("cylinder", radius=number, length=number),
    simple("sphere", radius=number),
    simple("mesh", filename=texts),
    simple("mesh", filename=st.just("package://arm/meshes/a.stl"), scale=rows(3)),
)
geometry = some(shape).map(lambda content: tag("geometry", {}, content))
material = st.builds(
    lambda name, content: tag("material", {"name": name}, content),
    names,
    some(simple("color", rgba=rows(4)), simple("texture", filename=texts)),
)
visual = some(origin, geometry, material, comment).map(lambda content: tag("visual", {}, content))
collision = some(origin, geometry, vendor).map(lambda content: tag("collision", {}, content))
moments = dict.fromkeys(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), number)
inertial = some(origin, simple("mass", value=number), simple("inertia", **moments)).map(
    lambda content: tag("inertial", {}, content)
)
link = st.builds(
    lambda name, content: tag("link", {"name": name}, content),
    names,
    some(visual, collision, inertial, comment),
)
joint = st.builds(
    lambda name, kind, content: tag("joint", {"name": name, "type": kind}, content),
    names,
    st.sampled_from(["fixed", "revolute", "prismatic", "continuous", "floating", "odd"]),
    some(
        origin,
        simple("parent", link=names),
        simple("child", link=names),
        simple("axis", xyz=rows(3)),
        simple("limit", lower=number, upper=number, effort=number, velocity=number),
        simple("mimic", joint=names, multiplier=number),
        comment,
    ),
)
robots = st.builds(
    lambda name, content: tag("robot", {"name": name}, "".join(content)),
    names,
    st.lists(st.one_of(link, joint, link, joint, vendor, material, comment), max_size=6),
)


def tree_of(text: str) -> Element:
    root = build("robot.yaml", text=text, on_message=lambda line: None, allow=ADJUSTABLE).root
    assert root is not None
    return root


SAME_LOOK = (
    '<robot name="arm"><material name="red"><color/><texture filename="a"/></material>'
    '<material name="red"><texture filename="a"/><color/></material></robot>'
)


@settings(max_examples=examples(300))
@example(SAME_LOOK)
@given(robots)
def test_a_robot_comes_back_as_it_was(urdf: str) -> None:
    migration = migrate_urdf(read_xml(Source(urdf, name="robot.urdf")), tree_of)
    made = build(
        "robot.yaml", text=migration.text, on_message=lambda line: None, allow=ADJUSTABLE
    ).xml()
    assert migration.differences == []
    assert is_same_robot(urdf.encode(), made.encode()), migration.text
