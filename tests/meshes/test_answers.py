"""What comes out of a jail is checked, whoever wrote it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.later import Later
from yamaro.meshes.formats import MeshFileError, MissingLibraryError
from yamaro.meshes.surfaces import Surface, _packed, read_packed, unpacked
from yamaro.sandbox.jail.protocol import JailAnswerBroken

if TYPE_CHECKING:
    import trimesh
else:
    trimesh = Later("trimesh")


def square() -> Surface:
    surface = Surface(np.eye(3), np.array([[0, 1, 2]]))
    surface.color = (1.0, 0.5, 0.0, 1.0)
    surface.point_colors = np.zeros((3, 4), np.uint8)
    surface.texture = np.zeros((4, 2, 3), np.uint8)
    surface.texture_points = np.zeros((3, 2))
    surface.normals = np.eye(3)
    return surface


def sent(surface: Surface) -> list[Surface]:
    from yamaro.sandbox.jail.protocol import pack

    return unpacked(pack([b"s", b"", _packed(surface)]))


def test_a_surface_comes_through_whole() -> None:
    before = square()
    (after,) = sent(before)
    assert after.color == before.color
    for name in ("points", "triangles", "point_colors", "texture", "texture_points", "normals"):
        assert (getattr(after, name) == getattr(before, name)).all(), name


LIES: dict[str, Any] = {
    "points": [np.full((3, 3), np.nan), np.full((3, 3), 1e300), np.eye(2), np.zeros((0, 3))],
    "triangles": [np.array([[0, 1, 3]]), np.array([[0, 1, -1]]), np.array([[0, 1]]), np.zeros(3)],
    "color": [(1.0, 2.0, 0.0, 1.0), (1.0,), (float("nan"),) * 4],
    "point_colors": [np.zeros((2, 4)), np.zeros((3, 3))],
    "texture": [np.zeros((4, 2)), np.zeros((0, 2, 3)), np.zeros((1, 5000, 3)), np.zeros((2, 2, 4))],
    "texture_points": [np.zeros((2, 2)), np.full((3, 2), np.inf)],
    "normals": [np.zeros((4, 3)), np.full((3, 3), np.nan)],
}


@pytest.mark.parametrize(
    ("name", "number"), [(name, i) for name, lies in LIES.items() for i in range(len(lies))]
)
def test_a_surface_that_lies_is_refused(name: str, number: int) -> None:
    surface = square()
    setattr(surface, name, LIES[name][number])
    with pytest.raises((MeshFileError, JailAnswerBroken)):
        sent(surface)


@given(st.binary(max_size=200))
def test_any_bytes_are_surfaces_or_refused(data: bytes) -> None:
    with pytest.raises((MeshFileError, MissingLibraryError, JailAnswerBroken)):
        unpacked(data)


@given(place=st.integers(0, 100_000), value=st.integers(0, 255))
def test_a_changed_byte_does_no_harm(answer: bytes, place: int, value: int) -> None:
    changed = bytearray(answer)
    changed[place % len(changed)] = value
    try:
        (surface,) = unpacked(bytes(changed))
    except (MeshFileError, MissingLibraryError, JailAnswerBroken):
        return
    assert np.isfinite(surface.points).all()
    assert surface.triangles.min() >= 0 and surface.triangles.max() < len(surface.points)


@pytest.fixture(scope="module")
def answer(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path: Path = tmp_path_factory.mktemp("mesh") / "box.stl"
    trimesh.creation.box().export(path)
    return read_packed(str(path), None)
