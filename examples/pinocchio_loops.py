"""Closes the loops of a robot in pinocchio, from the file that Yamaro writes beside its URDF."""

import numpy as np
import pinocchio as pin
import yaml


def read_loops(model, path):
    """Return the constraints that close the loops of a model read from URDF."""
    with open(path, encoding="utf-8") as file:
        loops = yaml.safe_load(file)["loops"]
    constraints = []
    for loop in loops:
        first, second = (model.frames[model.getFrameId(name)] for name in loop["between"])
        points = [np.zeros(3)] + ([np.array(loop["axis"])] if loop["type"] == "revolute" else [])
        kind = pin.ContactType.CONTACT_6D if loop["type"] == "fixed" else pin.ContactType.CONTACT_3D
        for point in points:
            shift = pin.SE3(np.eye(3), point)
            constraints.append(
                pin.RigidConstraintModel(
                    kind,
                    model,
                    first.parentJoint,
                    first.placement * shift,
                    second.parentJoint,
                    second.placement * shift,
                    pin.ReferenceFrame.LOCAL,
                )
            )
    return constraints


def gap(model, constraints, q):
    """Return how far the loops are open, in metres, and radians for fixed ones."""
    data = model.createData()
    pin.forwardKinematics(model, data, q)
    errors = []
    for each in constraints:
        one = data.oMi[each.joint1_id] * each.joint1_placement
        other = data.oMi[each.joint2_id] * each.joint2_placement
        if each.type == pin.ContactType.CONTACT_6D:
            errors.append(pin.log6(one.actInv(other)).vector)
        else:
            errors.append(other.translation - one.translation)
    return np.concatenate(errors)


def close(model, constraints, q, passive):
    """Return q with its passive entries moved until the loops are closed."""
    q = q.copy()
    for _ in range(50):
        error = gap(model, constraints, q)
        if abs(error).max() < 1e-12:
            break
        steps = np.eye(model.nv)[passive] * 1e-7
        columns = [
            (gap(model, constraints, pin.integrate(model, q, d)) - error) / 1e-7 for d in steps
        ]
        change = np.zeros(model.nv)
        change[passive] = -np.linalg.lstsq(np.stack(columns, axis=1), error, rcond=1e-6)[0]
        q = pin.integrate(model, q, change)
    return q
