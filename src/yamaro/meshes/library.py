"""Meshes through trimesh, which is given bytes, and of other files only those that may be read.

What libraries log or warn of would go to the terminal with words of the file in it, so that is
turned off while they read. Images are only opened in the formats of `formats.py`: Pillow would
start other programs for some.
"""

from __future__ import annotations

import os
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np

from ..files.regular import read_start
from .bounds import MOST_PLACED, check_bounds, path_of
from .formats import (
    GLB,
    GLTF,
    IMAGE_FORMATS,
    LARGEST_FILE,
    OBJ,
    MeshFileError,
    MissingLibraryError,
    image_format,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    Floats = NDArray[np.floating[Any]]
    Whole = NDArray[np.integer[Any]]

MOST_PIXELS = 64 << 20
"""Pixels of an image that is decoded."""
MOST_TRIANGLES = 20_000_000
MOST_REFUSED = 8
"""Textures that are named when they are left out."""
OWN_IMAGE = "of the file"
"""Marks an image that was read: trimesh invents one where a material is missing."""
_LOGGERS = ("trimesh", "collada", "PIL")
_SILENT = 1000


class Body:
    """A body of a file where it is placed.

    Attributes:
        points: corners, N×3, in metres.
        triangles: indices of corners, M×3, counterclockwise seen from outside.
        mesh: the mesh as trimesh read it, before it is placed.
        T_file_body: where it is in the file, 4×4.
    """

    __slots__ = ("T_file_body", "mesh", "points", "triangles")

    def __init__(self, mesh: Any, T_file_body: Floats, factor: float) -> None:
        """Place a body; the factor makes metres of the file's unit."""
        self.mesh = mesh
        self.T_file_body = T_file_body
        corners = np.asarray(mesh.vertices, float)
        self.points: Floats = (corners @ T_file_body[:3, :3].T + T_file_body[:3, 3]) * factor
        self.triangles: Whole = np.asarray(mesh.faces)
        if np.linalg.det(T_file_body[:3, :3]) < 0:
            self.triangles = self.triangles[:, ::-1]


def read_bodies(
    data: bytes,
    kind: str,
    path: str,
    allows: Callable[[str], bool] | None,
    *,
    has_colors: bool = False,
    refused: list[str] | None = None,
) -> list[Body]:
    """Return the bodies in the bytes of a mesh file.

    Args:
        data: the bytes.
        kind: their format.
        path: the file, beside which the others lie that it names.
        allows: whether another file may be read; None allows all.
        has_colors: whether materials and textures are read too.
        refused: takes a clause for each texture that is left out.

    Raises:
        MeshFileError: it cannot be read, or is out of bounds.
        MissingLibraryError: a library is not installed.
    """
    companions = Companions(path, allows)
    with quiet_libraries(companions):
        try:
            import trimesh  # noqa: F401 - that it is missing comes first

            check_bounds(data, kind)
            bodies = _read(data, kind, companions, has_colors)
            if refused is not None:
                refused += companions.refused
            return bodies
        except ImportError as error:
            raise MissingLibraryError(error.name or str(error)) from error
        except (MeshFileError, OSError, MemoryError):
            raise
        except Exception as error:
            reason = str(error) or type(error).__name__
            if isinstance(error, AttributeError):  # it looked for what is not there
                reason = "a part of it is missing, such as its scene"
            raise MeshFileError(f"trimesh cannot read it: {reason}") from error


def _read(data: bytes, kind: str, companions: Companions, has_colors: bool) -> list[Body]:
    from io import BytesIO

    import trimesh

    skips = {} if has_colors or kind not in (GLTF, GLB, OBJ) else {"skip_materials": True}
    scene: Any = trimesh.load_scene(
        BytesIO(data), file_type=kind, process=False, resolver=companions.resolver(), **skips
    )
    factor = _metres(scene)
    bodies: list[Body] = []
    triangles = 0
    for T_file_body, name in _placed(scene.graph):
        mesh = scene.geometry[name]
        if not isinstance(mesh, trimesh.Trimesh):
            continue
        triangles += len(mesh.faces)
        if len(bodies) >= MOST_PLACED:
            raise MeshFileError(f"it places more than {MOST_PLACED:,} bodies")
        if triangles > MOST_TRIANGLES:
            raise MeshFileError(f"it has more than {MOST_TRIANGLES:,} triangles")
        body = Body(mesh, T_file_body, factor)
        check_corners(body.triangles, len(body.points))
        bodies.append(body)
    return bodies


def _placed(graph: Any) -> Iterator[tuple[Floats, str]]:
    """Yield where geometries are in the file, each with its name.

    As `SceneGraph.get` does, which walks up to the root for each: that is quadratic in a chain.
    """
    parents = graph.transforms.parents
    known: dict[Any, Floats] = {graph.base_frame: np.eye(4)}
    for node in graph.nodes_geometry:
        way = []
        at = node
        while at not in known:
            way.append(at)
            at = parents[at]
        for each in reversed(way):
            T_parent_each, _ = graph.get(each, parents[each])
            known[each] = known[parents[each]] @ T_parent_each
        yield known[node], graph.transforms.node_data[node]["geometry"]


def check_corners(triangles: Whole, count: int) -> None:
    """Raise MeshFileError if a triangle has a corner beyond the number of points."""
    if triangles.size and not (triangles.min() >= 0 and triangles.max() < count):
        raise MeshFileError("a triangle has a corner that is not there")


def _metres(scene: Any) -> float:
    """Return the length of the file's unit: COLLADA names its own, others are in metres."""
    units = getattr(scene, "units", None)
    if not units:
        return 1.0
    from trimesh.units import unit_conversion

    return float(unit_conversion(units, "meters"))


class Companions:
    """The other files that a mesh names: beside it, or wherever it may read.

    Attributes:
        refused: a clause for each texture that is left out.
    """

    def __init__(self, path: str, allows: Callable[[str], bool] | None) -> None:
        """Look beside the file at `path`; of files that `allows` refuses none is opened."""
        self._folder = os.path.dirname(path)
        self._allows = allows
        self._last = ("", b"")
        self.refused: list[str] = []

    def read(self, name: str) -> bytes:
        """Return the bytes of another file; raise MeshFileError if it cannot be read."""
        for spelling in dict.fromkeys((name.strip(), name.split()[-1] if name.split() else "")):
            target = path_of(self._folder, spelling)
            if spelling and os.path.isfile(target):
                if self._allows is not None and not self._allows(target):
                    break
                try:
                    self._last = (spelling, read_start(target, LARGEST_FILE))
                    return self._last[1]
                except OSError:
                    break
        name = name if len(name) <= 80 else f"{name[:80]}…"
        raise MeshFileError(f"the file '{name}' that it names is not there, or may not be read")

    def note_refused(self, image: bytes, reason: str) -> None:
        """Note why an image is left out, with its name if it was the last file read."""
        name, data = self._last
        texture = f"the texture '{name[:80]}'" if name and data == image else "a texture"
        if len(self.refused) < MOST_REFUSED:
            self.refused.append(f"{texture} {reason}")

    def resolver(self) -> Any:
        """Return this as what trimesh asks for other files."""
        from trimesh.resolvers import Resolver

        outer = self

        class Lookup(Resolver):  # type: ignore[misc]
            """Gives files, and writes none."""

            def __init__(self) -> None:
                pass

            def get(self, name: str) -> bytes:
                return outer.read(name)

            def keys(self) -> tuple[str, ...]:
                return ()

            def write(self, name: str, data: object) -> None:
                raise PermissionError(1, "nothing is written", name)

            def namespaced(self, namespace: str) -> Lookup:
                return self

        return Lookup()


# --- what libraries must not do -----------------------------------------------------------------


@contextmanager
def quiet_libraries(companions: Companions) -> Iterator[None]:
    """Let libraries log and warn of nothing, and open no images but of known formats."""
    import logging
    import warnings

    loggers = [logging.getLogger(name) for name in _LOGGERS]
    levels = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(_SILENT)
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"), _known_images(companions):
            warnings.simplefilter("ignore")
            yield
    finally:
        for logger, level in zip(loggers, levels, strict=True):
            logger.setLevel(level)


@contextmanager
def _known_images(companions: Companions) -> Iterator[None]:
    try:
        import PIL.Image
    except ImportError:
        yield
        return
    module: Any = PIL.Image
    usual = module.open

    def open_known(file: Any, *_: object, **__: object) -> Any:
        data = file.read()
        try:
            return open_image(data, usual)
        except MeshFileError as error:
            companions.note_refused(data, str(error))
            raise
        except Exception:
            companions.note_refused(data, "is broken")
            raise

    module.open = open_known
    try:
        yield
    finally:
        module.open = usual


def open_image(data: bytes, usual: Callable[..., Any]) -> Any:
    """Return an image of one of the formats, which is not yet decoded.

    Raises:
        MeshFileError: it has another format, or too many pixels.
    """
    from io import BytesIO

    kind = image_format(data[:64])
    if kind not in IMAGE_FORMATS:
        raise MeshFileError("has no format that is read")
    image = usual(BytesIO(data), formats=[kind.upper()])
    width, height = image.size
    if not 0 < width * height <= MOST_PIXELS:
        raise MeshFileError("has too many pixels")
    image.info[OWN_IMAGE] = True
    return image
