"""Whether surfaces cross, as coal says it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from trimesh import creation, transformations

from yamaro.fitting.crossing import are_crossing


def judged(one: Any, other: Any) -> bool:
    """Return whether coal finds two meshes, N×3×3, in collision."""
    coal = pytest.importorskip("coal")
    models = []
    for each in (one, other):
        model = coal.BVHModelOBBRSS()
        model.beginModel(len(each), 3 * len(each))
        model.addVertices(each.reshape(-1, 3))
        model.addTriangles(np.arange(3 * len(each)).reshape(-1, 3))
        model.endModel()
        models.append(model)
    place, result = coal.Transform3s.Identity(), coal.CollisionResult()
    return bool(coal.collide(models[0], place, models[1], place, coal.CollisionRequest(), result))


def test_meshes_cross_where_coal_says_so() -> None:
    random = np.random.default_rng(5)
    answers = []
    for number in range(60):
        shapes = [
            creation.torus(1.0, 0.15, 24, 12),
            creation.icosphere(3, 0.8 + 0.04 * (number % 5)),
        ]
        one = shapes[number % 2].triangles
        turned = shapes[0].apply_transform(transformations.random_rotation_matrix(random.random(3)))
        other = turned.triangles + random.uniform(-1.2, 1.2, 3)
        answers.append(are_crossing(one, other))
        assert answers[-1] == judged(one, other), number
    assert 10 < sum(answers) < 50


def test_a_mesh_inside_of_another_does_not_cross_it_and_one_that_touches_a_side_does() -> None:
    box = creation.box((1, 1, 1)).triangles
    assert not are_crossing(box, 0.9 * box)
    assert are_crossing(box, box + np.array([1.0, 0.25, 0.25]))
    assert not are_crossing(box, box + np.array([1.001, 0.25, 0.25]))
