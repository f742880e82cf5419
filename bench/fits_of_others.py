"""Compares shapes that Yamaro works out from meshes with those of other tools, at equal count.

    python bench/fits_of_others.py [--foam FOLDER] [--count N] [--tools GLOB] MESH ...

One shape: scikit-robot's `fit_primitive_to_mesh` and trimesh's bounding primitive. N spheres: foam,
built in FOLDER. N convex pieces: coacd. At most 16 of them: onshape-to-robot, whose processor gets
a robot of one part, as it would come from Onshape. For each the table has the pieces, the greatest
distance between the surfaces, how far the mesh is outside, and the excess of volume, by
`bench/shapes.py`. Tools that are not installed are left out.
"""

from __future__ import annotations

import argparse
import io
import json
import os
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import redirect_stdout
from fnmatch import fnmatchcase
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from shapes import ON_MESH, Piece, measured

from yamaro.fitting.fit import Wanted, fitted
from yamaro.meshes.triangles import TriangleMesh
from yamaro.model.pose import rotation_from_rpy

PIECES = 16
"""What onshape-to-robot asks coacd for, at most."""
FOAM = {  # the values of scripts/generate_spheres.py
    "depth": 1, "method": "medial", "testerLevels": 2, "numCover": 5000, "minCover": 5,
    "initSpheres": 1000, "minSpheres": 200, "erFact": 2, "expand": True, "merge": True,
    "burst": False, "optimise": True, "maxOptLevel": 1, "balExcess": 0.05, "verify": True,
}  # fmt: skip


def ball(center: Any, radius: float) -> Piece:
    """Return a sphere."""
    mesh = trimesh.creation.icosphere(4, radius)
    mesh.apply_translation(center)
    return Piece(mesh, lambda points: radius - np.linalg.norm(points - np.asarray(center), axis=1))


def simple(kind: str, sizes: Any, place: Any) -> Piece:
    """Return a box, cylinder or capsule, or a sphere, at a place."""
    if kind == "sphere":
        return ball(place[:3, 3], float(sizes[0]))
    if kind == "box":
        mesh = trimesh.creation.box(sizes)
    elif kind == "cylinder":
        mesh = trimesh.creation.cylinder(sizes[0], sizes[1], sections=128)
    else:
        mesh = trimesh.creation.capsule(sizes[1], sizes[0], count=[64, 64])
        mesh.apply_translation(-mesh.bounds.mean(axis=0))
    mesh.apply_transform(place)
    return Piece(mesh)


def ours(mesh: Any, **wanted: Any) -> list[Piece]:
    """Return what `yamaro fit` makes."""
    own = TriangleMesh(
        [tuple(each) for each in mesh.vertices.tolist()],
        [tuple(each) for each in mesh.faces.tolist()],
    )
    found = []
    for piece in fitted(own, Wanted(**wanted)).pieces:
        if isinstance(piece, bytes):
            found.append(Piece(trimesh.load(io.BytesIO(piece), file_type="stl")))
        else:
            place = np.eye(4)
            place[:3, :3], place[:3, 3] = rotation_from_rpy(*piece.rpy), piece.xyz
            found.append(simple(piece.shape.kind, piece.shape.size, place))
    return found


def scikit_robot(mesh: Any) -> list[Piece]:
    """Return the primitive that scikit-robot chooses."""
    from skrobot.utils.primitive_fitting import create_primitive_mesh, fit_primitive_to_mesh

    found = fit_primitive_to_mesh(mesh)
    if found["type"] == "sphere":
        return [ball(found["center"], found["radius"])]
    return [Piece(create_primitive_mesh(found))]


def bounding(mesh: Any) -> list[Piece]:
    """Return the bounding primitive of trimesh."""
    found = mesh.bounding_primitive
    return [simple("sphere", [found.primitive.radius], found.primitive.transform)
            if isinstance(found, trimesh.primitives.Sphere)
            else Piece(found.to_mesh())]  # fmt: skip


def coacd(mesh: Any, count: int) -> list[Piece]:
    """Return the pieces of coacd."""
    import coacd as library

    library.set_log_level("error")
    parts = library.run_coacd(library.Mesh(mesh.vertices, mesh.faces), max_convex_hull=count)
    return [Piece(trimesh.Trimesh(*part)) for part in parts]


def onshape_to_robot(mesh: Any) -> list[Piece]:
    """Return the pieces of onshape-to-robot, without what it keeps from earlier runs."""
    from onshape_to_robot.config import Config
    from onshape_to_robot.geometry import Mesh
    from onshape_to_robot.processor_convex_decomposition import ProcessorConvexDecomposition
    from onshape_to_robot.robot import Link, Part, Robot

    with tempfile.TemporaryDirectory() as name:
        file, settings = Path(name) / "mesh.stl", Path(name) / "config.json"
        mesh.export(file)
        asked = {"document_id": "none", "output_format": "urdf", "processors": []}
        settings.write_text(json.dumps({**asked, "convex_decomposition": True}))
        part = Part("mesh", np.eye(4), 1.0, np.zeros(3), np.eye(3), [Mesh(str(file))])
        robot, link = Robot("robot"), Link("link")
        link.parts.append(part)
        robot.links.append(link)
        home, os.environ["HOME"] = os.environ.get("HOME", ""), name
        try:
            ProcessorConvexDecomposition(Config(name)).process(robot)
        finally:
            os.environ["HOME"] = home
        return [Piece(trimesh.load(each.filename)) for each in part.meshes if each.collision]


def foam(mesh: Any, count: int) -> list[Piece]:
    """Return the spheres of foam."""
    from foam import spherize_mesh

    found = spherize_mesh(
        "mesh",
        mesh,
        spherization_kwargs={**FOAM, "branch": count},
        process_kwargs={"manifold_leaves": 1000, "ratio": 0.2},
    )
    return [ball(each.origin, float(each.radius)) for each in found[1].spheres]


def main() -> None:
    """Print a row for each mesh and tool."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("meshes", nargs="+", type=Path)
    parser.add_argument("--foam", type=Path)
    parser.add_argument("--count", type=int, default=8)
    parser.add_argument("--tools", default="*", help="only these rows")
    options = parser.parse_args()
    if options.foam is not None:
        sys.path.append(str(options.foam))

    def tools() -> Iterator[tuple[str, Callable[[Any], list[Piece]]]]:
        count = options.count
        yield "`fit: best`", lambda mesh: ours(mesh, word="fit", kind="best")
        if find_spec("skrobot"):
            yield "scikit-robot", scikit_robot
        yield (
            "`fit: best, cover: true`",
            lambda mesh: ours(mesh, word="fit", kind="best", covers=True),
        )
        yield "trimesh, bounding", bounding
        yield f"`spheres: {count}`", lambda mesh: ours(mesh, word="spheres", count=count)
        yield (
            f"`spheres: {count}, cover: true`",
            lambda mesh: ours(mesh, word="spheres", count=count, covers=True),
        )
        if options.foam is not None:
            yield f"foam, {count} spheres", lambda mesh: foam(mesh, count)
        yield f"`decompose: {count}`", lambda mesh: ours(mesh, word="decompose", count=count)
        if find_spec("coacd"):
            yield f"coacd, {count} pieces", lambda mesh: coacd(mesh, count)
        yield f"`decompose: {PIECES}`", lambda mesh: ours(mesh, word="decompose", count=PIECES)
        if find_spec("onshape_to_robot"):
            yield "onshape-to-robot", onshape_to_robot

    print("| mesh | shapes of | pieces | distance | outside | excess of volume | CPU |")
    print("|---|---|--:|--:|--:|--:|--:|")
    for path in options.meshes:
        mesh = trimesh.load(path, force="mesh")
        mesh.merge_vertices()
        points = trimesh.sample.sample_surface(mesh, 5 * ON_MESH, seed=1)[0]
        for name, tool in tools():
            if not fnmatchcase(name, options.tools):
                continue
            begun = os.times()
            try:
                with redirect_stdout(sys.stderr):
                    pieces = tool(mesh.copy())
            except Exception as error:
                print(f"| {path.stem} | {name} | {type(error).__name__} | | | | |", flush=True)
                continue
            ended = os.times()
            seconds = ended.user - begun.user + ended.children_user - begun.children_user
            distance, excess = measured(mesh, pieces)
            out = -min(0.0, float(np.max([p.depth(points) for p in pieces], axis=0).min()))
            more = "–" if np.isnan(excess) else f"{100 * excess:+.0f} %"
            print(
                f"| {path.stem} | {name} | {len(pieces)} | {1000 * distance:.1f} mm "
                f"| {1000 * out:.1f} mm | {more} | {seconds:.0f} s |",
                flush=True,
            )


if __name__ == "__main__":
    main()
