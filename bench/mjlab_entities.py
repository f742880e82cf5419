"""Tells what mjlab makes of configurations: run it with the Python of an environment that has it.

It reads paths on standard input, a line each, and answers each with a line of JSON.
"""

from __future__ import annotations

import json
import runpy
import sys
import warnings
from importlib import import_module
from typing import Any

SPEEDS = (-40.0, -3.0, 0.0, 0.5, 7.0)
"""At which the efforts of motors with a torque-speed line are asked for, with targets far away."""


def entity(path: str) -> dict[str, object]:
    """Return what the robot of a configuration is in mjlab."""
    actuators = import_module("mjlab.actuator")
    made = runpy.run_path(path)
    built = import_module("mjlab.entity").Entity(made["robot_cfg"]())
    model = built.spec.compile()
    joints: dict[str, dict[str, Any]] = {}
    full = {each.rpartition("/")[2]: each for each in map(_name_of, built.spec.joints)}
    for name in built.joint_names:
        joint = model.joint(full[name])
        dof = joint.dofadr[0]
        joints[name] = {
            "home": float(model.key("init_state").qpos[joint.qposadr[0]]),
            "armature": float(model.dof_armature[dof]),
            "friction": float(model.dof_frictionloss[dof]),
            "damping": float(model.dof_damping[dof]),
        }
    driving = (model.actuator(i) for i in range(model.nu))
    joined = (model.joint(each.trnid[0]) for each in driving if int(each.trntype[0]) == 0)
    commanded = [_name_of(each).rpartition("/")[2] for each in joined]
    for group in built.actuators:
        for name in group.target_names:
            joints[name]["class"] = type(group).__name__
            actuator = model.actuator(full[name])
            joints[name]["gain"] = [float(each) for each in actuator.gainprm[:3]]
            joints[name]["bias"] = [float(each) for each in actuator.biasprm[:3]]
            joints[name]["force"] = [float(each) for each in actuator.forcerange]
            joints[name]["delay"] = [group.cfg.delay_min_lag, group.cfg.delay_max_lag]
            if isinstance(group, actuators.DcMotorActuator):
                joints[name]["motor"] = motor(group)
    scale = scales(made["ACTION_SCALE"], list(built.joint_names))
    first = [] if built.is_fixed_base else model.key("init_state").qpos[:7].tolist()
    return {"joints": joints, "commanded": commanded, "scale": scale, "base": first}


def _name_of(joint: Any) -> str:
    return str(joint.name)


def motor(group: Any) -> list[float]:
    """Return the gains of a motor, and its efforts at several speeds and two targets."""
    torch, command = import_module("torch"), import_module("mjlab.actuator").ActuatorCmd
    cfg = group.cfg
    values = {
        "stiffness": cfg.stiffness,
        "damping": cfg.damping,
        "force_limit": cfg.effort_limit,
        "saturation_effort": cfg.saturation_effort,
        "velocity_limit_motor": cfg.velocity_limit,
    }
    given = {name: torch.tensor(each, dtype=torch.float64) for name, each in values.items()}
    found = [cfg.stiffness, cfg.damping]
    zero = torch.zeros((), dtype=torch.float64)
    for speed in SPEEDS:
        for target in (-1e3, 1e3):
            asked = command(
                position_target=zero,
                velocity_target=zero,
                effort_target=zero + target,
                pos=zero,
                vel=zero + speed,
            )
            limited = {**given, "stiffness": zero, "damping": zero}
            found.append(float(type(group).control_law(limited, asked)))
    return found


def scales(given: dict[str, float], names: list[str]) -> dict[str, float]:
    """Return the action scale of each joint as an action of mjlab reads it."""
    if not given:
        return {}
    resolve = import_module("mjlab.utils.lab_api.string").resolve_matching_names_values
    _, found, values = resolve(given, names)
    return dict(zip(found, values, strict=True))


def main() -> None:
    warnings.simplefilter("ignore")
    answers, sys.stdout = sys.stdout, sys.stderr
    for line in sys.stdin:
        try:
            answer: object = entity(line.strip())
        except Exception as error:
            answer = {"error": f"{type(error).__name__}: {str(error).splitlines()[0][:200]}"}
        print(json.dumps(answer), file=answers, flush=True)


if __name__ == "__main__":
    main()
