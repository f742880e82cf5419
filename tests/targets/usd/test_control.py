"""Drives of USD, and the actuators of Newton in their place."""

from __future__ import annotations

from math import degrees
from pathlib import Path
from typing import Any

import pytest

import yamaro
from tests.consumers import oracles
from tests.targets.usd.test_usd import ARM, stage_of

LINE = "stall_torque: 8, no_load_speed: 4"
JOINT, MOTOR = "/my_arm/joints/rod_joint", "/my_arm/actuators/rod_joint"


@pytest.fixture(autouse=True)
def _judge() -> None:
    oracles.require_module("pxr")


def arm(written: str) -> str:
    """Return the arm with these entries of its actuator."""
    return ARM.replace("kp: 50, kd: 2", written)


def both(written: str, tmp_path: Path) -> tuple[Any, Any, yamaro.Build]:
    """Return the arm on two stages: as it opens, and with actuators in place of drives."""
    from pxr import Sdf, Usd

    stage, build = stage_of(arm(written), tmp_path)
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.TransferContent(stage.GetRootLayer())
    other = Usd.Stage.Open(layer)
    variants = other.GetDefaultPrim().GetVariantSet("Newton")
    assert variants.GetVariantNames() == ["Disabled", "Enabled"]
    assert variants.GetVariantSelection() == "Disabled"
    variants.SetVariantSelection("Enabled")
    return stage, other, build


def gains(stage: Any) -> list[float]:
    """Return the gains of the drive, per radian."""
    names = (f"drive:angular:physics:{name}" for name in ("stiffness", "damping"))
    return [stage.GetPrimAtPath(JOINT).GetAttribute(name).Get() * degrees(1) for name in names]


def values(stage: Any) -> dict[str, Any]:
    """Return the values of the actuator."""
    prim = stage.GetPrimAtPath(MOTOR)
    found = prim.GetAuthoredPropertiesInNamespace("newton")
    return {each.GetBaseName(): each.Get() for each in found if hasattr(each, "Get")}


def test_a_line_of_a_motor_is_in_the_drive_for_physx_and_in_an_actuator_for_newton(
    tmp_path: Path,
) -> None:
    drives, actuators, build = both(f"kp: 50, kd: 2, {LINE}", tmp_path)
    assert gains(drives) == pytest.approx([50, 2])
    assert not drives.GetPrimAtPath(MOTOR)
    prim = drives.GetPrimAtPath(JOINT)
    envelope = "physxDrivePerformanceEnvelope:angular"
    fastest = prim.GetAttribute(f"{envelope}:maxActuatorVelocity").Get()
    slope = prim.GetAttribute(f"{envelope}:speedEffortGradient").Get()
    for part in (0, 0.3, 1):  # the speed that is left at a part of the stall torque
        assert fastest - slope * part * 8 == pytest.approx(degrees(4 * (1 - part)), abs=1e-4)
    assert gains(actuators) == [0, 0]
    assert values(actuators) == pytest.approx(
        {"kp": 50, "kd": 2, "saturationEffort": 8, "velocityLimit": 4, "maxMotorEffort": 8}
    )
    motor = actuators.GetPrimAtPath(MOTOR)
    assert motor.GetTypeName() == "NewtonActuator"
    assert motor.GetRelationship("newton:targets").GetTargets() == [prim.GetPath()]
    schemas = motor.GetPrimTypeInfo().GetAppliedAPISchemas()
    assert set(schemas) == {"NewtonPDControlAPI", "NewtonDCMotorClampingAPI"}
    assert not [loss for loss in build.losses if "motors" in loss.what]


def test_the_file_says_where_the_variant_is(tmp_path: Path) -> None:
    """Source: RV.006 of SimReady."""
    stage, *_ = both(f"kp: 50, kd: 2, {LINE}", tmp_path)
    data = stage.GetRootLayer().customLayerData["SimReady_Metadata"]
    assert data["Variants"]["Physics"]["Newton"] == {
        "prim": "/my_arm",
        "variantSetName": "Newton",
        "activateOption": "Enabled",
    }


@pytest.mark.parametrize(("delay", "steps"), [("10 ms", 5), ("5 ms", 2), ("0.1 ms", 1)])
def test_a_delay_is_steps_of_the_actuator(delay: str, steps: int, tmp_path: Path) -> None:
    drives, actuators, build = both(f"kp: 50, kd: 2, delay: {delay}", tmp_path)
    assert gains(drives) == pytest.approx([50, 2])
    assert gains(actuators) == [0, 0]
    found = {"kp": 50, "kd": 2, "maxEffort": 10, "delaySteps": steps}
    assert values(actuators) == pytest.approx(found)
    (loss,) = [loss for loss in build.losses if "actuators" in loss.what]
    assert (loss.kind, loss.how) == ("approximated", f"{steps} steps of 2 ms, for Newton")


def test_an_effort_is_delayed_without_a_variant(tmp_path: Path) -> None:
    stage, build = stage_of(arm("command: effort, delay: 10 ms"), tmp_path)
    assert not stage.GetDefaultPrim().HasVariantSets()
    assert values(stage) == {"maxEffort": 10, "delaySteps": 5}
    (loss,) = [loss for loss in build.losses if "actuators" in loss.what]
    assert loss.what == "delays of actuators"


def test_gains_of_an_effort_are_those_of_its_actuator(tmp_path: Path) -> None:
    """By default it adds the effort alone, as a motor of MuJoCo does."""
    drives, actuators, build = both("command: effort, kp: 50, kd: 2", tmp_path)
    assert gains(drives) == gains(actuators) == [0, 0]
    assert values(drives) == {"maxEffort": 10}
    assert values(actuators) == {"maxEffort": 10, "kp": 50, "kd": 2}
    assert not [loss for loss in build.losses if "actuators" in loss.what]


def test_a_second_gain_of_a_velocity_is_that_of_its_position(tmp_path: Path) -> None:
    drives, actuators, build = both("command: velocity, kp: 50, kd: 2", tmp_path)
    assert gains(drives) == pytest.approx([0, 2])
    assert gains(actuators) == [0, 0]
    assert values(actuators) == {"maxEffort": 10, "kp": 50, "kd": 2}
    assert not [loss for loss in build.losses if "actuators" in loss.what]


@pytest.mark.parametrize("written", ["kp: 50, kd: 2", "stall_torque: 8", "command: effort"])
def test_a_robot_whose_drives_say_everything_has_no_variants(written: str, tmp_path: Path) -> None:
    stage, build = stage_of(arm(written), tmp_path)
    assert not stage.GetDefaultPrim().HasVariantSets()
    assert not [loss for loss in build.losses if "actuators" in loss.what or "motor" in loss.what]


def test_a_no_load_speed_alone_bounds_the_drive_of_physx(tmp_path: Path) -> None:
    stage, build = stage_of(arm("kp: 50, kd: 2, no_load_speed: 4"), tmp_path)
    envelope = "physxDrivePerformanceEnvelope:angular"
    prim = stage.GetPrimAtPath(JOINT)
    fastest = prim.GetAttribute(f"{envelope}:maxActuatorVelocity").Get()
    assert fastest == pytest.approx(degrees(4))
    assert not prim.HasAttribute(f"{envelope}:speedEffortGradient")
    (loss,) = [loss for loss in build.losses if "motors" in loss.what]
    assert loss.kind == "approximated"


@pytest.mark.parametrize(
    ("commands", "lost"),
    [
        ("[position, velocity, effort]", 0),  # a drive has both targets, and adds an effort
        ("[velocity, effort]", 0),
        ("[velocity, position]", 1),
        ("[effort, velocity]", 1),
        ("[effort, velocity], kd: 2", 0),
        ("[effort, velocity], kd: 0", 1),
    ],
)
def test_what_a_joint_takes_besides_its_first_command(
    commands: str, lost: int, tmp_path: Path
) -> None:
    _, build = stage_of(arm(f"command: {commands}"), tmp_path)
    found = [loss for loss in build.losses if loss.what == "further commands of actuators"]
    assert len(found) == lost


def test_gains_in_both_variants_lead_to_where_they_are_written(tmp_path: Path) -> None:
    from yamaro.tools.why.answers import answer

    _, build = stage_of(arm(f"kp: 50, kd: 2, {LINE}"), tmp_path)
    for address, written in (
        ("rod_joint@stiffness", "50"),
        ("rod_joint@damping", "2"),
        ("rod_joint/NewtonActuator@kd", "2"),
        ("rod_joint/NewtonActuator@velocityLimit", "4"),
    ):
        assert answer(build.root, address, format="usd").span.written() == written
