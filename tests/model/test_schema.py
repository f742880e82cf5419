"""The schema of a robot, and what loops over its rows: one changed value is seen everywhere."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from tests.model import full_robot
from tests.model.full_robot import ROWS, changed
from yamaro import Build, build
from yamaro.model import extras
from yamaro.model import joint as joints
from yamaro.model.quantities import BY_JOINT, DIMENSIONS, unit_of
from yamaro.model.schema import ELEMENTS, KEPT, NEGATED, SENSORS, TEXT, WORDS
from yamaro.robot.mirror import reverse
from yamaro.xml.tree import Element

THINGS = {**ELEMENTS, **WORDS, **SENSORS}
PNG = bytes.fromhex(
    "89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c4"
    "890000000d49444154789c6360606060000000050001a5f645400000000049454e44ae426082"
)


def tetrahedron(size: float) -> str:
    """Return a mesh in STL."""
    corners = [(0, 0, 0), (size, 0, 0), (0, size, 0), (0, 0, size)]
    facets = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    text = "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join("vertex {} {} {}\n".format(*corners[corner]) for corner in facet)
        + "endloop\nendfacet\n"
        for facet in facets
    )
    return f"solid s\n{text}endsolid s\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with the meshes and textures of the full robot."""
    path = tmp_path_factory.mktemp("full")
    for name, size in (("tool.stl", 0.1), ("other.stl", 0.2)):
        (path / name).write_text(tetrahedron(size))
    for name in ("paint.png", "varnish.png"):
        (path / name).write_bytes(PNG)
    return path


@cache
def built(folder: Path, row: tuple[str, str] | None) -> Build:
    """Return the full robot, with the value of a row changed."""
    path = folder / "full.yaml"
    path.write_text(full_robot.text({} if row is None else {row: changed(row)}))
    return build(path, allow=["lost-in-urdf"])


@pytest.mark.parametrize("row", ROWS, ids=".".join)
def test_a_changed_value_is_a_difference(folder: Path, row: tuple[str, str]) -> None:
    before, after = built(folder, None).robot, built(folder, row).robot
    assert list(before.changes(after)), f"{row} is compared by nothing"


def test_the_full_robot_is_the_same_as_itself(folder: Path) -> None:
    again = build(folder / "full.yaml", allow=["lost-in-urdf"])
    assert not list(again.robot.changes(again.robot))


def test_objects_of_the_model_have_the_fields_of_the_schema() -> None:
    for name, kind in (
        ("limit", joints.Limit),
        ("mimic", joints.Mimic),
        ("dynamics", joints.Dynamics),
        ("safety_controller", joints.SafetyController),
        ("calibration", joints.Calibration),
        ("actuator", extras.Actuator),
        ("surface", extras.Surface),
    ):
        assert set(kind.__annotations__) == set(THINGS[name].fields)


def test_each_kind_of_number_has_a_dimension_and_each_field_help() -> None:
    for thing in THINGS.values():
        for field in thing.fields.values():
            assert field.kind in {**DIMENSIONS, **BY_JOINT}
            assert field.help
            assert field.count == TEXT or field.example or field.default is not None


def test_units_are_those_of_the_field() -> None:
    # Source: the units of the URDF specification, http://wiki.ros.org/urdf/XML/joint.
    units = {
        "position": ("rad", "m"),
        "effort": ("N·m", "N"),
        "velocity": ("rad/s", "m/s"),
        "acceleration of a joint": ("rad/s²", "m/s²"),
        "jerk": ("rad/s³", "m/s³"),
        "damping": ("N·m·s/rad", "N·s/m"),
        "stiffness": ("N·m/rad", "N/m"),
        "armature": ("kg·m²", "kg"),
    }
    for kind, (turning, sliding) in units.items():
        assert (unit_of(kind, "revolute"), unit_of(kind, "prismatic")) == (turning, sliding)
    assert (unit_of("number"), unit_of("inertia"), unit_of("pixels")) == ("", "kg·m²", "pixels")


def test_positions_of_a_joint_change_their_sign_where_it_counts_the_other_way() -> None:
    for name in ("limit", "safety_controller", "calibration"):
        for field in ELEMENTS[name].fields.values():
            assert (field.reversal != KEPT) == (field.kind == "position"), field


@pytest.mark.parametrize("name", ["limit", "safety_controller", "calibration"])
def test_a_joint_that_is_reversed_twice_is_as_it_was(folder: Path, name: str) -> None:
    fields = ELEMENTS[name].fields
    values: dict[str, object] = {each: str(n) for n, each in enumerate(fields, 1)}
    part = Element(name, build(folder / "full.yaml", allow=["lost-in-urdf"]).root.span, {**values})
    joint = Element("joint", part.span, {}, [part])
    reverse(joint)
    for field in fields.values():
        if field.reversal == NEGATED:
            assert float(str(part.attributes[field.name])) == -float(str(values[field.name]))
        elif field.reversal != KEPT:
            assert float(str(part.attributes[field.name])) == -float(str(values[field.reversal]))
    reverse(joint)
    assert part.attributes == values


def test_examples_are_values_of_their_fields() -> None:
    for thing in THINGS.values():
        for field in thing.fields.values():
            if field.count != TEXT and field.example:
                assert len([float(word) for word in field.example.split()]) == field.count
