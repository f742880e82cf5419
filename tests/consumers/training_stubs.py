"""Stand-ins for mjlab and Isaac Lab: configurations with the fields that their packages have.

The fields are those of mjlab 1.6.0, and of isaaclab 2.3.2 and 3.0.0. A configuration takes no other
names, and needs those without default. `bench/training.py` loads files in the real packages.
"""

from __future__ import annotations

import dataclasses
import re
import sys
from collections.abc import Iterable
from pathlib import Path
from types import ModuleType
from typing import Any, TypeVar

import pytest

Value = TypeVar("Value")

NEEDED = dataclasses.MISSING
"""The default of a field that has to be given."""
RESISTS = {"armature": None}

# --- mjlab.actuator -----------------------------------------------------------------------------

OF_ALL = {
    "target_names_expr": NEEDED, "transmission_type": "joint", **RESISTS, "frictionloss": None,
    "viscous_damping": None, "delay_min_lag": 0, "delay_max_lag": 0, "delay_hold_prob": 0.0,
    "delay_update_period": 0, "delay_per_env_phase": True,
}  # fmt: skip
SERVO = {**OF_ALL, "stiffness": NEEDED, "damping": NEEDED}
MJLAB_ACTUATORS: dict[str, dict[str, Any]] = {
    "BuiltinPositionActuatorCfg": {**SERVO, "effort_limit": None},
    "BuiltinVelocityActuatorCfg": {**OF_ALL, "damping": NEEDED, "effort_limit": None},
    "BuiltinMotorActuatorCfg": {**OF_ALL, "effort_limit": NEEDED, "gear": 1.0},
    "DcMotorActuatorCfg": {
        **SERVO, "effort_limit": float("inf"), "saturation_effort": NEEDED,
        "velocity_limit": NEEDED,
    },
}  # fmt: skip
MJLAB_START: dict[str, Any] = {
    "pos": (0.0, 0.0, 0.0), "rot": (1.0, 0.0, 0.0, 0.0), "lin_vel": (0.0, 0.0, 0.0),
    "ang_vel": (0.0, 0.0, 0.0), "joint_pos": {".*": 0.0}, "joint_vel": {".*": 0.0},
}  # fmt: skip
ENTITY: dict[str, Any] = {
    "init_state": None, "spec_fn": None, "articulation": None, "sort_actuators": False,
    "lights": (), "cameras": (), "textures": (), "materials": (), "meshes": (), "geoms": (),
    "collisions": (),
}  # fmt: skip
ARTICULATION = {"actuators": (), "soft_joint_pos_limit_factor": 1.0}

# --- isaaclab -----------------------------------------------------------------------------------

OF_BOTH = {
    "class_type": None, "joint_names_expr": NEEDED, "stiffness": NEEDED, "damping": NEEDED,
    **RESISTS, "friction": None, "dynamic_friction": None, "viscous_friction": None,
    "effort_limit_sim": None, "velocity_limit_sim": None, "effort_limit": None,
    "velocity_limit": None,
}  # fmt: skip
NEW_LIMITS = (
    *("joint_effort_limit", "joint_velocity_limit"),
    *("actuator_effort_limit", "actuator_velocity_limit"),
)
OLD_LIMITS = ("effort_limit_sim", "velocity_limit_sim", "effort_limit", "velocity_limit")
"""The same in 2.x, which 3.0 still takes, with a warning."""
ISAAC_START = {name: value for name, value in MJLAB_START.items() if name != "rot"}
SPAWNED: dict[str, Any] = {
    "usd_path": NEEDED, "activate_contact_sensors": False, "rigid_props": None, "scale": None,
}  # fmt: skip
ISAAC_ROBOT: dict[str, Any] = {
    "prim_path": None, "spawn": None, "init_state": None, "actuators": NEEDED,
    "soft_joint_pos_limit_factor": 1.0,
}  # fmt: skip


def config(name: str, fields: dict[str, Any]) -> type:
    """Return a class that takes these fields by name; its attributes are not those defaults."""

    def field(value: object) -> Any:
        if value is NEEDED:
            return dataclasses.field()
        return dataclasses.field(default_factory=lambda: value)

    given = [(each, Any, field(value)) for each, value in fields.items()]
    return dataclasses.make_dataclass(name, given, kw_only=True)


def modules(monkeypatch: pytest.MonkeyPatch, **found: dict[str, type]) -> None:
    """Have modules with these classes, by their names with `_` for a dot."""
    for name, classes in found.items():
        full = name.replace("_", ".")
        module = ModuleType(full)
        vars(module).update(classes)
        monkeypatch.setitem(sys.modules, full, module)


def have_mjlab(monkeypatch: pytest.MonkeyPatch) -> None:
    """Have mjlab."""
    actuators = {name: config(name, each) for name, each in MJLAB_ACTUATORS.items()}
    entity = config("EntityCfg", ENTITY)
    entity.InitialStateCfg = config("InitialStateCfg", MJLAB_START)  # type: ignore[attr-defined]
    articulation = config("EntityArticulationInfoCfg", ARTICULATION)
    entities = {"EntityCfg": entity, "EntityArticulationInfoCfg": articulation}
    modules(monkeypatch, mjlab={}, mjlab_actuator=actuators, mjlab_entity=entities)


def have_isaaclab(monkeypatch: pytest.MonkeyPatch, version: int) -> None:
    """Have Isaac Lab 2.3 or 3.0."""
    base = {**OF_BOTH, **dict.fromkeys(NEW_LIMITS)} if version == 3 else OF_BOTH
    delayed = {**base, "min_delay": 0, "max_delay": 0}
    kinds = {
        "ActuatorBaseCfg": base,
        "ImplicitActuatorCfg": base,
        "IdealPDActuatorCfg": base,
        "DelayedPDActuatorCfg": delayed,
        "DCMotorCfg": {**base, "saturation_effort": NEEDED},
    }
    actuators = {name: config(name, fields) for name, fields in kinds.items()}
    rot = (0.0, 0.0, 0.0, 1.0) if version == 3 else (1.0, 0.0, 0.0, 0.0)
    robot = config("ArticulationCfg", ISAAC_ROBOT)
    start = config("InitialStateCfg", {**ISAAC_START, "rot": rot})
    robot.InitialStateCfg = start  # type: ignore[attr-defined]
    spawned = {"UsdFileCfg": config("UsdFileCfg", SPAWNED)}
    modules(
        monkeypatch,
        isaaclab={},
        isaaclab_actuators=actuators,
        isaaclab_assets={"ArticulationCfg": robot},
        isaaclab_sim=spawned,
    )


def selected(expressions: Iterable[str], names: Iterable[str]) -> list[str]:
    """Return the names that regular expressions select in both packages: as a whole."""
    given = list(expressions)
    return [name for name in names if any(re.fullmatch(each, name) for each in given)]


def valued(values: dict[str, Value], names: Iterable[str]) -> dict[str, Value]:
    """Return the values of names, each by one expression alone, each of which selects one."""
    found: dict[str, Value] = {}
    known = list(names)
    for expression, value in values.items():
        (name,) = selected([expression], known)
        assert name not in found
        found[name] = value
    return found


def started(values: dict[str, float], names: Iterable[str]) -> dict[str, float]:
    """Return where joints start in mjlab, which matches the start of names, the first that fits."""
    return {
        name: next((value for each, value in values.items() if re.match(each, name)), 0.0)
        for name in names
    }


def run(path: Path) -> dict[str, Any]:
    """Return what a configuration defines."""
    import runpy

    return runpy.run_path(str(path))
