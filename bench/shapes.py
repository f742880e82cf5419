"""Measures the shapes of `yamaro fit` by trimesh, and what they cost MuJoCo.

    python bench/shapes.py ROBOT.urdf [--links 'GLOB'] [WORDS ...]

ROBOT.urdf is a robot that collides with meshes, and each of WORDS an option of `yamaro fit` such as
`shape=hull`, `shape=best,cover`, `decompose=8` or `spheres=24`. For each link and each of them the
table has the number of pieces, the greatest distance between the surfaces and the excess of volume.
Then follow the time of `mj_collision` and the number of contacts at random positions, and steps in
a second, with the meshes, which MuJoCo takes as their hulls, and with the shapes. Needs trimesh,
rtree and mujoco.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
import time
from collections.abc import Callable
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import mujoco
import numpy as np
import trimesh
from scipy.spatial import cKDTree

from yamaro.commands.main import main as yamaro

WORDS = ("shape=best", "shape=hull", "decompose=8", "spheres=8")
ON_MESH, ON_PIECES, IN_BOX = 2000, 8000, 60_000
"""How many points are spread over the mesh and over the pieces, and in the box around both."""
POSITIONS, STEPS = 300, 500


class Piece:
    """A convex shape: a mesh, and whether points are in it.

    Attributes:
        mesh: its surface.
        depth: the depth of points below the surface, at least; negative outside.
    """

    def __init__(self, mesh: Any, depth: Callable[[Any], Any] | None = None) -> None:
        self.mesh = mesh
        hull = mesh.convex_hull
        normals, offsets = hull.face_normals, (hull.face_normals * hull.triangles[:, 0]).sum(axis=1)
        planes = np.unique(np.round(np.column_stack((normals, offsets)), 9), axis=0)
        self.depth = depth or (
            lambda points: -(points @ planes[:, :3].T - planes[:, 3]).max(axis=1)
        )


def pose_of(element: ElementTree.Element) -> Any:
    """Return the pose of the `<origin>` in an element of URDF."""
    origin = element.find("origin")
    place = np.eye(4)
    if origin is not None:
        rpy, xyz = ([*map(float, origin.get(n, "0 0 0").split())] for n in ("rpy", "xyz"))
        place = trimesh.transformations.euler_matrix(*rpy, "sxyz")
        place[:3, 3] = xyz
    return place


def pieces_of(link: ElementTree.Element, folder: Path) -> list[Piece]:
    """Return the collisions of a link in URDF, in its frame."""
    found = []
    for collision in link.iter("collision"):
        place = pose_of(collision)
        geometry = collision.find("geometry")
        assert geometry is not None
        shape, depth = geometry[0], None
        if shape.tag == "mesh":
            mesh = trimesh.load(folder / shape.attrib["filename"], force="mesh")
            mesh.apply_scale([float(each) for each in shape.get("scale", "1 1 1").split()])
            mesh.merge_vertices()
        elif shape.tag == "box":
            mesh = trimesh.creation.box([float(each) for each in shape.attrib["size"].split()])
        elif shape.tag == "cylinder":
            size = float(shape.attrib["radius"]), float(shape.attrib["length"])
            mesh = trimesh.creation.cylinder(*size, sections=128)
        else:
            radius, center = float(shape.attrib["radius"]), place[:3, 3].copy()
            mesh = trimesh.creation.icosphere(4, radius)

            def depth(points: Any, radius: float = radius, center: Any = center) -> Any:
                return radius - np.linalg.norm(points - center, axis=1)

        mesh.apply_transform(place)
        found.append(Piece(mesh, depth))
    return found


def measured(mesh: Any, pieces: list[Piece]) -> tuple[float, float]:
    """Return the greatest distance of the surfaces in metres, and the excess of volume.

    The excess is not a number if the mesh is not closed.
    """
    on_mesh = np.vstack((trimesh.sample.sample_surface(mesh, ON_MESH, seed=1)[0], mesh.vertices))
    areas = np.array([each.mesh.area for each in pieces])
    counts = np.ceil(ON_PIECES * areas / areas.sum()).astype(int)
    outer = []
    for number, (piece, count) in enumerate(zip(pieces, counts, strict=True)):
        points = trimesh.sample.sample_surface(piece.mesh, int(count), seed=1)[0]
        points = np.vstack((points, piece.mesh.vertices))
        for other in pieces[:number] + pieces[number + 1 :]:
            points = points[other.depth(points) < 1e-6]
        outer.append(points)
    union = np.vstack(outer)
    from_union = trimesh.proximity.closest_point(mesh, union)[1].max()
    from_mesh = cKDTree(union).query(on_mesh)[0]
    far = np.argsort(from_mesh)[-50:]  # exactly, where it counts
    outside = np.max([each.depth(on_mesh[far]) for each in pieces], axis=0) < 0
    exact = [trimesh.proximity.closest_point(each.mesh, on_mesh[far])[1] for each in pieces]
    distances = np.where(outside, np.min(exact, axis=0), from_mesh[far])
    distance = max(float(from_union), float(distances.max()))
    corners = np.array([each.mesh.bounds for each in pieces])
    lower, upper = corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)
    points = lower + np.random.default_rng(1).random((IN_BOX, 3)) * (upper - lower)
    inside = np.zeros(IN_BOX, dtype=bool)
    for each in pieces:
        inside |= each.depth(points) > 0
    volume = inside.mean() * float(np.prod(upper - lower))
    return distance, volume / mesh.volume - 1 if mesh.is_watertight else float("nan")


def cost(robot: Path, folder: Path) -> tuple[float, float, float]:
    """Return milliseconds of `mj_collision`, contacts at a position, and steps in a second."""
    document = folder / "robot.xml"
    assert yamaro(["-q", str(robot), "--to", "mjcf", "--base", "fixed", "-o", str(document)]) == 0
    model = mujoco.MjModel.from_xml_path(str(document))
    data = mujoco.MjData(model)
    random, seconds, found = np.random.default_rng(1), [], 0
    low, high = np.where(model.jnt_limited[:, None], model.jnt_range, (-np.pi, np.pi)).T
    for _ in range(POSITIONS):
        data.qpos[:] = low + random.random(model.nq) * (high - low)
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        begun = time.thread_time()
        mujoco.mj_collision(model, data)
        seconds.append(time.thread_time() - begun)
        found += data.ncon
    mujoco.mj_resetData(model, data)
    begun = time.thread_time()
    for _ in range(STEPS):
        mujoco.mj_step(model, data)
    return 1000 * float(np.median(seconds)), found / POSITIONS, STEPS / (time.thread_time() - begun)


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("robot", type=Path)
    parser.add_argument("words", nargs="*", default=WORDS)
    parser.add_argument("--links", default="*")
    options = parser.parse_intermixed_args()
    before = {
        link.attrib["name"]: pieces_of(link, options.robot.parent)
        for link in ElementTree.parse(options.robot).getroot().iter("link")
    }
    costs = []
    print("| link | triangles | word | pieces | distance | of size | excess of volume |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        costs.append(("meshes", 0.0, *cost(options.robot, folder)))
        for word in options.words:
            shutil.rmtree(folder / "fit", ignore_errors=True)
            fitted = folder / "fit" / "robot.urdf"
            arguments = [f"--{each}".replace("=", "\0").split("\0") for each in word.split(",")]
            begun = time.process_time()
            status = yamaro(
                ["fit", "-q", "--links", options.links, str(options.robot), "-o", str(fitted)]
                + [each for pair in arguments for each in pair]
            )
            seconds = time.process_time() - begun
            if status:
                sys.exit(status)
            for link in ElementTree.parse(fitted).getroot().iter("link"):
                meshes = before[link.attrib["name"]]
                if len(meshes) != 1 or not fnmatchcase(link.attrib["name"], options.links):
                    continue
                pieces = pieces_of(link, fitted.parent)
                mesh = meshes[0].mesh
                distance, excess = measured(mesh, pieces)
                more = "–" if np.isnan(excess) else f"{100 * excess:+.1f} %"
                print(
                    f"| `{link.attrib['name']}` | {len(mesh.faces)} | `{word}` | {len(pieces)} "
                    f"| {1000 * distance:.1f} mm | {100 * distance / mesh.extents.max():.1f} % "
                    f"| {more} |",
                    flush=True,
                )
            costs.append((word, seconds, *cost(fitted, folder)))
    print(
        "\n| shapes | worked out in | `mj_collision` | contacts | steps/s |\n|---|---|---|---|---|"
    )
    for word, seconds, milliseconds, count, steps in costs:
        print(f"| `{word}` | {seconds:.1f} s | {milliseconds:.3f} ms | {count:.1f} | {steps:.0f} |")


if __name__ == "__main__":
    main()
