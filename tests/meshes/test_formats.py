"""Formats are told by bytes: the name of a file does not count."""

from __future__ import annotations

import io
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import PIL.Image
import pytest

from tests.later import Later
from yamaro.meshes.formats import MeshFileError, image_format, mesh_format
from yamaro.meshes.triangles import read_mesh

if TYPE_CHECKING:
    import trimesh
else:
    trimesh = Later("trimesh")

KINDS = ["stl", "stl_ascii", "obj", "dae", "glb", "ply"]


@cache
def ball() -> trimesh.Trimesh:
    return trimesh.creation.icosphere(subdivisions=1)


@pytest.mark.parametrize("kind", KINDS)
def test_a_mesh_is_known_by_its_bytes_under_any_name(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "ball.png"
    ball().export(path, file_type=kind)
    assert mesh_format(path.read_bytes()) == kind.removesuffix("_ascii")
    assert len(read_mesh(str(path)).triangles) == len(ball().faces)


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "GIF", "WEBP", "BMP", "TIFF", "TGA"])
def test_an_image_is_known_by_its_bytes(kind: str) -> None:
    data = io.BytesIO()
    PIL.Image.new("RGB", (3, 5), (1, 2, 3)).save(data, kind)
    assert image_format(data.getvalue()[:64]) == kind.lower()


@pytest.mark.parametrize(
    "start",
    [
        b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 16 16\n",
        b"\xc5\xd0\xd3\xc6" + bytes(60),  # EPS with a preview
        b"%PDF-1.7\n" + bytes(60),
        b"\x00\x00\x01\x00\x01\x00\x10\x10" + bytes(60),  # ICO
        b"8BPS\0\1" + bytes(60),
        b"P6 100000 100000 255\n",
        b"gimp xcf v011\0",
        b"\x00\x00\x00\x0cjP  \r\n\x87\n" + bytes(60),  # JPEG 2000
        b"",
        b"\0" * 64,
    ],
)
def test_no_other_image_is_opened(start: bytes) -> None:
    assert image_format(start) is None


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\0" * 200,
        b"solid"[:3],
        b"#VRML V2.0 utf8\nv 1 2 3\n",
        b"#usda 1.0\n",
        b"ISO-10303-21;\n",
        b"Kaydara FBX Binary  \0",
        b"%!PS-Adobe-3.0\n",
        b"import os\n",
    ],
)
def test_no_other_file_is_a_mesh(data: bytes, tmp_path: Path) -> None:
    assert mesh_format(data) is None
    path = tmp_path / "a.obj"
    path.write_bytes(data)
    with pytest.raises(MeshFileError, match="it is not a valid OBJ file"):
        read_mesh(str(path))
