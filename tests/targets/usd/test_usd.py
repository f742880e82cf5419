"""Robots in USD, as OpenUSD reads them."""

from __future__ import annotations

from math import degrees, pi, radians
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

import yamaro
from tests.consumers import oracles, usd_judges
from tests.tools_there import needs

FOLDER = Path(__file__).parents[3] / "examples"
EXAMPLES = [
    FOLDER / name
    for name in (
        "arm/arm.yaml", "diff_drive/diff_drive.yaml", "drone/drone.yaml", "hand/hand.yaml",
        "dual_arm_cell/dual_arm_cell.yaml", "hexapod/hexapod.yaml", "humanoid/humanoid.yaml",
        "mobile_manipulator/mobile_manipulator.yaml",
        "leg_robot/robot.yaml", "pan_tilt/pan_tilt.yaml", "quadruped/quadruped.yaml",
    )
]  # fmt: skip
ARM = """
robot: my arm
model:
- part:
    name: base
    link: {geometry: box, size: 0.2 0.2 0.1, mass: 4, visual: {color: 1 0 0 0.5}, collision: null}
- part:
    name: rod
    joint:
      type: revolute
      parent: base
      axis: 0.6 0.8 0
      limit: {lower: -1, upper: 2, effort: 10, velocity: 3}
      dynamics: {damping: 0.5, friction: 0.1}
      actuator: {kp: 50, kd: 2}
    link:
      geometry: cylinder
      radius: 0.02
      length: 0.5
      mass: 1
      xyz: 0 0 0.25
      collision: {surface: {friction: 0.8, restitution: 0.1}}
      frame/name=tip: {xyz: 0 0 0.5}
      sensor/name=eye: {type: camera, size: 640 480, fov: 1, clip: 0.1 10}
      sensor/name=imu: {type: imu}
"""


@pytest.fixture(autouse=True)
def _judge() -> None:
    oracles.require_module("pxr")


def stage_of(text: str, tmp_path: Path, **given: Any) -> tuple[Any, yamaro.Build]:
    from pxr import Usd

    path = tmp_path / "robot.yaml"
    path.write_text(text)
    build = yamaro.build(path, target="usd", **given)
    usd = tmp_path / f"{given.get('base', 'robot')}.usda"  # OpenUSD keeps what it has read
    usd.write_text(build.xml())
    for name, data in build.assets.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(data)
    assert usd_judges.complaints_of(usd) == []
    return Usd.Stage.Open(str(usd)), build


def test_limits_and_gains_are_in_degrees(tmp_path: Path) -> None:
    stage, _ = stage_of(ARM, tmp_path)
    joint = stage.GetPrimAtPath("/my_arm/joints/rod_joint")

    def value(name: str) -> Any:
        return joint.GetAttribute(f"physics:{name}").Get()

    assert value("lowerLimit") == pytest.approx(degrees(-1))
    assert value("upperLimit") == pytest.approx(degrees(2))
    drive = "drive:angular:physics"
    gains = [joint.GetAttribute(f"{drive}:{name}").Get() for name in ("stiffness", "damping")]
    assert gains == pytest.approx([50 / degrees(1), 2 / degrees(1)])  # damping is not its drive's
    assert joint.GetAttribute(f"{drive}:maxForce").Get() == 10


@pytest.mark.parametrize(
    ("written", "command"),
    [("command: position", "position"), ("kp: 50", "position"), ("command: velocity", "velocity")],
)
def test_gains_that_are_not_given_are_those_of_mjcf(
    written: str, command: str, tmp_path: Path
) -> None:
    """MuJoCo works out the damping itself, from its own inertia."""
    oracles.require_module("mujoco")
    import mujoco

    text = ARM.replace("kp: 50, kd: 2", written).replace("damping: 0.5, ", "")
    assert written in text
    stage, build = stage_of(text, tmp_path, base="fixed")
    drive = stage.GetPrimAtPath("/my_arm/joints/rod_joint")
    stiffness, damping = (
        drive.GetAttribute(f"drive:angular:physics:{name}").Get() * degrees(1)
        for name in ("stiffness", "damping")
    )
    mjcf = yamaro.build(tmp_path / "robot.yaml", target="mjcf", base="fixed").xml()
    model = mujoco.MjModel.from_xml_string(mjcf)
    _, minus_kp, minus_kd = model.actuator_biasprm[0][:3]
    assert stiffness == pytest.approx(-minus_kp)
    assert damping == pytest.approx(-minus_kd, rel=0.05)  # ours has two digits
    assert damping > 0
    assert (stiffness > 0) == (command == "position")
    assert "actuator" not in "".join(loss.what for loss in build.losses)


@needs("why")
def test_gains_lead_to_where_they_are_written(tmp_path: Path) -> None:
    from yamaro.tools.why.answers import answer

    _, build = stage_of(ARM, tmp_path)
    for name, written in (("stiffness", "50"), ("damping", "2"), ("maxForce", "10")):
        found = answer(build.root, f"rod_joint@{name}", format="usd")
        assert found.span.written() == written


def test_a_joint_with_commanded_efforts_has_no_gains(tmp_path: Path) -> None:
    text = ARM.replace("kp: 50, kd: 2", "command: effort").replace("damping: 0.5, ", "")
    stage, build = stage_of(text, tmp_path)
    drive = stage.GetPrimAtPath("/my_arm/joints/rod_joint")
    found = [
        drive.GetAttribute(f"drive:angular:physics:{name}").Get()
        for name in ("stiffness", "damping", "maxForce")
    ]
    assert found == [0, 0, 10]
    assert [loss for loss in build.losses if "actuators" in loss.what] == []
    motor = stage.GetPrimAtPath("/my_arm/actuators/rod_joint")
    assert motor.GetTypeName() == "NewtonActuator"
    assert motor.GetRelationship("newton:targets").GetTargets() == [drive.GetPath()]
    assert motor.GetAttribute("newton:maxEffort").Get() == 10


FOLLOWERS = """
robot: hand
model:
- part: {name: palm, link: {geometry: box, size: 0.1 0.1 0.02, mass: 1}}
- part:
    name: finger
    joint:
      type: revolute
      parent: palm
      axis: y
      limit: {lower: 0, upper: 1, effort: 10, velocity: 3}
      mimic: {joint: thumb_joint, multiplier: -0.5, offset: 0.1}
    link: {geometry: box, size: 0.02 0.02 0.1, mass: 0.1}
- part:
    name: thumb
    joint:
      type: revolute
      parent: palm
      axis: y
      limit: {lower: 0, upper: 1, effort: 10, velocity: 3}
      dynamics: {damping: 0.5, friction: 0.1}
      actuator: {kp: 50, kd: 2, armature: 0.02}
    link: {geometry: box, size: 0.02 0.02 0.1, mass: 0.1, xyz: 0.01 0 0, rpy: 0.1 0.2 0.3}
- part:
    name: lock
    joint:
      type: prismatic
      parent: palm
      axis: x
      limit: {lower: 0, upper: 1, effort: 10, velocity: 3}
      dynamics: {damping: 5}
      mimic: {joint: thumb_joint}
    link:
      geometry: sphere
      radius: 0.01
      mass: 0.1
      collision: {surface: {stiffness: 1000, damping: 3}}
"""


def values_of(stage: Any, path: str, namespace: str) -> dict[str, Any]:
    """Return the values of a prim in a namespace, by the rest of their names."""
    prim = stage.GetPrimAtPath(path)
    found = prim.GetAuthoredPropertiesInNamespace(namespace)
    return {
        each.GetName().removeprefix(f"{namespace}:"): each.Get()
        for each in found
        if hasattr(each, "Get")
    }


def test_newton_and_physx_have_what_usd_physics_has_no_place_for(tmp_path: Path) -> None:
    """Per degree, as both schemas say of their angular values."""
    stage, build = stage_of(FOLLOWERS, tmp_path)
    thumb, lock = "/hand/joints/thumb_joint", "/hand/joints/lock_joint"
    newton = {
        "armature": 0.02, "damping": 0.5 / degrees(1), "friction": 0.1, "velocityLimit": degrees(3)
    }  # fmt: skip
    assert values_of(stage, thumb, "newton") == pytest.approx(newton)
    physx = {
        "armature": 0.02,
        "viscousFrictionCoefficient": 0.5 / degrees(1),
        "staticFrictionEffort": 0.1,
        "dynamicFrictionEffort": 0.1,
        "maxJointVelocity": degrees(3),
    }
    assert values_of(stage, thumb, "physxJointAxis:angular") == pytest.approx(physx)
    assert values_of(stage, lock, "newton") == {"damping": 5, "velocityLimit": 3}
    assert {"NewtonJointAPI", "PhysxJointAxisAPI:angular"} <= set(
        stage.GetPrimAtPath(thumb).GetPrimTypeInfo().GetAppliedAPISchemas()
    )
    contact = {"contactStiffness": 1000, "contactDamping": 3}
    assert values_of(stage, "/hand/materials/surface", "newton") == contact
    assert stage.GetRootLayer().customLayerData["newton-usd-schemas"]
    assert {loss.what for loss in build.losses} == {"joints that follow one of another unit"}


def test_a_joint_follows_another_in_degrees(tmp_path: Path) -> None:
    stage, build = stage_of(FOLLOWERS, tmp_path)
    finger = stage.GetPrimAtPath("/hand/joints/finger_joint")
    leader = finger.GetRelationship("newton:mimicJoint").GetTargets()
    assert leader == [stage.GetPrimAtPath("/hand/joints/thumb_joint").GetPath()]
    found = values_of(stage, "/hand/joints/finger_joint", "newton")
    assert found["mimicCoef0"] == pytest.approx(degrees(0.1))
    assert found["mimicCoef1"] == -0.5
    assert "MjcEqualityJointAPI" in finger.GetPrimTypeInfo().GetAppliedAPISchemas()
    mjcf = yamaro.build(tmp_path / "robot.yaml", target="mjcf", base="fixed").xml()
    equality = ElementTree.fromstring(mjcf).find("default/default/equality")
    assert equality is not None
    solref = [float(number) for number in equality.get("solref", "").split()]
    assert list(finger.GetAttribute("mjc:solref").Get()) == solref
    assert [loss.owner for loss in build.losses] == ["joint 'lock_joint'"]


def test_newton_gets_the_inertia_of_urdf_exactly(tmp_path: Path) -> None:
    """About the centre of mass and along the axes of the link, as newton:inertia is defined."""
    stage, build = stage_of(FOLLOWERS, tmp_path)
    for name, link in build.robot.links.items():
        assert link.inertial is not None
        turn = np.array(link.inertial.pose.rotation)
        xx, xy, xz, yy, yz, zz = link.inertial.inertia
        tensor = turn @ [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]] @ turn.T
        found = stage.GetPrimAtPath(f"/hand/{name}").GetAttribute("newton:inertia").Get()
        rows, columns = [0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]
        assert list(found) == pytest.approx(tensor[rows, columns].tolist(), abs=1e-15)


def test_frames_are_sites(tmp_path: Path) -> None:
    stage, _ = stage_of(ARM, tmp_path)
    site = stage.GetPrimAtPath("/my_arm/rod_link/tip/site")
    assert site.GetTypeName() == "Sphere"
    assert site.GetPrimTypeInfo().GetAppliedAPISchemas() == ["NewtonSiteAPI"]


def test_a_joint_with_commanded_efforts_has_the_line_of_its_motor(tmp_path: Path) -> None:
    line = "command: effort, stall_torque: 8, no_load_speed: 60 rpm"
    stage, build = stage_of(ARM.replace("kp: 50, kd: 2", line), tmp_path)
    assert [loss for loss in build.losses if "motors" in loss.what] == []
    motor = stage.GetPrimAtPath("/my_arm/actuators/rod_joint")
    assert "NewtonDCMotorClampingAPI" in motor.GetPrimTypeInfo().GetAppliedAPISchemas()
    values = {
        name: motor.GetAttribute(f"newton:{name}").Get()
        for name in ("saturationEffort", "velocityLimit", "maxMotorEffort")
    }
    # In radians, and no more than the motor stalls at.
    expected = {"saturationEffort": 8, "velocityLimit": 2 * pi, "maxMotorEffort": 8}
    assert values == pytest.approx(expected, rel=1e-6)
    drive = stage.GetPrimAtPath("/my_arm/joints/rod_joint")
    assert drive.GetAttribute("drive:angular:physics:maxForce").Get() == 8


def test_a_position_actuator_without_gains_is_exact(tmp_path: Path) -> None:
    text = ARM.replace("kp: 50, kd: 2", "command: position, kp: 0, kd: 0")
    _, build = stage_of(text, tmp_path)
    assert [loss for loss in build.losses if "actuators" in loss.what] == []


def test_what_usd_cannot_hold_is_reported(tmp_path: Path) -> None:
    _, build = stage_of(ARM.replace("clip: 0.1 10", "clip: 0.1 10, topic: image"), tmp_path)
    found = {(loss.kind, loss.what, loss.owner) for loss in build.losses}
    assert found == {
        ("renamed", "robots", "robot 'my arm'"),
        ("lost", "topics of sensors", "sensor 'eye'"),
    }


def test_a_camera_looks_along_x_with_z_up(tmp_path: Path) -> None:
    from pxr import Gf, UsdGeom

    stage, _ = stage_of(ARM, tmp_path)
    prim = stage.GetPrimAtPath("/my_arm/rod_link/eye/eye")
    view = UsdGeom.XformCache().GetLocalToWorldTransform(prim)
    assert view.TransformDir(Gf.Vec3d(0, 0, -1)) == pytest.approx((1, 0, 0), abs=1e-9)
    assert view.TransformDir(Gf.Vec3d(0, 1, 0)) == pytest.approx((0, 0, 1), abs=1e-9)
    camera = UsdGeom.Camera(prim).GetCamera()
    assert camera.GetFieldOfView(Gf.Camera.FOVHorizontal) == pytest.approx(degrees(1), abs=1e-3)


def test_a_base_is_fixed_where_that_is_asked(tmp_path: Path) -> None:
    free, _ = stage_of(ARM, tmp_path, base="free")
    assert not free.GetPrimAtPath("/my_arm/joints/base_link_world")
    fixed, _ = stage_of(ARM, tmp_path, base="fixed")
    assert (
        fixed.GetPrimAtPath("/my_arm/joints/base_link_world").GetTypeName() == "PhysicsFixedJoint"
    )


def test_a_root_without_mass_has_1_g(tmp_path: Path) -> None:
    text = ARM.replace(", mass: 4, visual: {color: 1 0 0 0.5}, collision: null", ", visual: null")
    stage, build = stage_of(text, tmp_path)
    mass = stage.GetPrimAtPath("/my_arm/base_link").GetAttribute("physics:mass").Get()
    assert mass == pytest.approx(1e-3)
    assert ("approximated", "links without mass") in {
        (each.kind, each.what) for each in build.losses
    }


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_examples_move_as_in_urdf(path: Path, tmp_path: Path) -> None:
    oracles.require_module("pinocchio")
    build = yamaro.build(path, on_message=lambda line: None)
    usd = tmp_path / "robot.usda"
    usd.write_text(yamaro.build(path, target="usd", on_message=lambda line: None).xml())
    assert usd_judges.complaints_of(usd) == []
    assert usd_judges.disagreement(build.xml(), usd, build.robot, positions=20) == ""


# --- meshes and materials -----------------------------------------------------------------------

CORNERS = [(0, 0, 0), (0.1, 0, 0), (0, 0.2, 0), (0, 0, 0.3)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
WEDGES = """
robot: wedges
base: free
model:
- part: {name: base, link: {geometry: box, size: 0.2 0.2 0.1, mass: 1}}
- for i, scale in [(0, '1 1 1'), (1, '1 1 1'), (2, '2 1 1'), (3, '1 -1 1')]:
  - part:
      name: w$(i)
      joint: {type: fixed, parent: base, xyz: $(i) 0 0}
      link: {geometry: wedge.stl, scale: $(scale), mass: 0.2, visual: , collision: }
"""


def test_shapes_of_one_mesh_and_scale_share_its_triangles(tmp_path: Path) -> None:
    from pxr import Usd, UsdGeom, UsdPhysics

    facets = "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join(f"vertex {x} {y} {z}\n" for x, y, z in (CORNERS[each] for each in face))
        + "endloop\nendfacet\n"
        for face in FACES
    )
    (tmp_path / "wedge.stl").write_text(f"solid wedge\n{facets}endsolid wedge\n")
    (tmp_path / "robot.yaml").write_text(WEDGES)
    stage, build = stage_of(WEDGES, tmp_path)
    assert build.xml().count("point3f[] points") == 3
    scales = {"w0": (1, 1, 1), "w1": (1, 1, 1), "w2": (2, 1, 1), "w3": (1, -1, 1)}
    found = 0
    kinds: dict[Any, set[str]] = {}
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        if not prim.IsA(UsdGeom.Mesh):
            continue
        found += 1
        instance = prim.GetParent()
        kinds.setdefault(instance.GetPrototype().GetPath(), set()).add(instance.GetName())
        mesh, scale = UsdGeom.Mesh(prim), np.array(scales[instance.GetName()[:2]])
        points = np.array(mesh.GetPointsAttr().Get())
        expected = {tuple(np.round(np.array(corner) * scale, 6)) for corner in CORNERS}
        assert {tuple(np.round(point.astype(float), 6)) for point in points} == expected
        assert len(points) == 4
        corners = points[np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)]
        volume = np.linalg.det(corners).sum() / 6  # positive if all faces look outwards
        assert volume == pytest.approx(0.1 * 0.2 * 0.3 / 6 * scale[0], rel=1e-5)
        normals = np.array(mesh.GetNormalsAttr().Get())
        edges = corners[:, 1:] - corners[:, :1]
        assert np.abs(np.einsum("ijk,ik->ij", edges, normals)).max() < 1e-6
        assert np.einsum("ij,ij->i", np.cross(*edges.swapaxes(0, 1)), normals).min() > 0
        assert prim.HasAPI(UsdPhysics.CollisionAPI) == ("collision" in instance.GetName())
    assert found == 8
    assert sorted(map(len, kinds.values())) == [1, 1, 1, 1, 2, 2]  # w0 and w1 are of one kind


def test_materials_keep_their_names(tmp_path: Path) -> None:
    from pxr import UsdShade

    text = """
robot: colours
model:
- part: {name: base, link: {geometry: box, size: 1 1 1, mass: 1, visual: {material: {name: carbon_black, color: 0.1 0.1 0.1 1}}}}
- part: {name: top, joint: {type: fixed, parent: base}, link: {geometry: box, size: 1 1 1, mass: 1, visual: {material: carbon_black}}}
- part: {name: lid, joint: {type: fixed, parent: base}, link: {geometry: box, size: 1 1 1, mass: 1, visual: {material: {name: Signal red, color: 1 0 0 0.5}}}}
"""  # noqa: E501
    stage, build = stage_of(text, tmp_path)
    names = [each.GetName() for each in stage.Traverse() if each.IsA(UsdShade.Material)]
    assert names == ["carbon_black", "Signal_red"]
    renamed = [(each.owner, each.how) for each in build.losses if each.kind == "renamed"]
    assert renamed == [("material 'Signal red'", "Signal_red")]
    for link, name in (("base", "carbon_black"), ("top", "carbon_black"), ("lid", "Signal_red")):
        visual = stage.GetPrimAtPath(f"/colours/{link}_link/{link}_link_visual")
        bound = UsdShade.MaterialBindingAPI(visual).GetDirectBinding().GetMaterial()
        assert bound.GetPrim().GetName() == name


def test_the_robot_lists_its_links_and_joints_and_keeps_names(tmp_path: Path) -> None:
    text = ARM.replace("name: rod", "name: 2-rod")
    stage, _ = stage_of(text, tmp_path, base="fixed")
    root = stage.GetDefaultPrim()
    assert root.GetDisplayName() == "my arm"
    listed = {
        word: [
            str(path) for path in root.GetRelationship(f"isaac:physics:robot{word}").GetTargets()
        ]
        for word in ("Links", "Joints")
    }
    assert listed == {
        "Links": ["/my_arm/base_link", "/my_arm/_2_rod_link"],
        "Joints": ["/my_arm/joints/base_link_world", "/my_arm/joints/_2_rod_joint"],
    }
    for path, name in (
        ("/my_arm/_2_rod_link", "2-rod_link"),
        ("/my_arm/joints/_2_rod_joint", "2-rod_joint"),
    ):
        prim = stage.GetPrimAtPath(path)
        assert prim.GetDisplayName() == name
        assert prim.GetAttribute("isaac:nameOverride").Get() == name


def test_the_file_has_the_metadata_that_follow_from_the_robot(tmp_path: Path) -> None:
    """Source: SR.004 of SimReady."""
    from pxr import Usd

    stage, _ = stage_of(ARM, tmp_path)
    data = stage.GetRootLayer().customLayerData["SimReady_Metadata"]
    assert data["rigid_body_count"] == 2
    assert data["mass"] == 5
    assert data["asset_name"] == "my arm"
    # Only the base is seen: a box.
    assert list(data["asset_extents"]) == pytest.approx([0.2, 0.2, 0.1])
    assert Usd.ModelAPI(stage.GetDefaultPrim()).GetKind() == "component"


SENSORS = """
robot: seer
base: free
model:
- part:
    name: base
    link:
      geometry: box
      size: 0.2 0.2 0.1
      mass: 4
      collision:
      sensor/name=imu: {type: imu, rate: 200 Hz, noise: 0.01}
      sensor/name=scan: {type: lidar, rays: 3, rows: 2, angle: 90deg, tilt: 20deg, range: 0.2 12}
      sensor/name=near: {type: range, range: 0.03 2, fov: 5deg}
      sensor/name=bump: {type: contact}
      sensor/name=eye: {type: camera, size: 320 240, rate: 30 Hz}
      sensor/name=depth: {type: depth_camera, size: 64 48}
      sensor/name=fix: {type: gps}
"""


def test_sensors_are_those_of_isaac_sim(tmp_path: Path) -> None:
    stage, build = stage_of(SENSORS, tmp_path)

    def prim(name: str) -> Any:
        return stage.GetPrimAtPath(f"/seer/base_link/{name}/{name}")

    assert prim("imu").GetTypeName() == "IsaacImuSensor"
    assert prim("imu").GetAttribute("sensorPeriod").Get() == pytest.approx(0.005)
    assert prim("bump").GetTypeName() == "IsaacContactSensor"
    body = stage.GetPrimAtPath("/seer/base_link").GetPrimTypeInfo().GetAppliedAPISchemas()
    assert "PhysxContactReportAPI" in body
    scan = prim("scan")
    assert scan.GetTypeName() == "IsaacRaycastSensor"
    assert scan.GetAttribute("numRays").Get() == 6
    limits = [scan.GetAttribute(f"{name}Range").Get() for name in ("min", "max")]
    assert limits == pytest.approx([0.2, 12])
    ways = np.array(scan.GetAttribute("rayDirections").Get(), float)
    assert len(scan.GetAttribute("rayOrigins").Get()) == 6
    around = np.degrees(np.arctan2(ways[:, 1], ways[:, 0]))
    above = np.degrees(np.arcsin(ways[:, 2]))
    assert around == pytest.approx([-45, 0, 45] * 2, abs=1e-4)
    assert above == pytest.approx([-10] * 3 + [10] * 3, abs=1e-4)
    assert [tuple(way) for way in prim("near").GetAttribute("rayDirections").Get()] == [(1, 0, 0)]
    told = {(loss.kind, loss.what, loss.owner) for loss in build.losses}
    assert told == {
        ("lost", "noise of sensors", "sensor 'imu'"),
        ("approximated", "cones of range sensors", "sensor 'near'"),
        ("approximated", "contact sensors", "sensor 'bump'"),
        ("lost", "gps sensors", "sensor 'fix'"),
    }


def test_cameras_render_images_of_their_size(tmp_path: Path) -> None:
    from pxr import UsdRender

    stage, _ = stage_of(SENSORS, tmp_path)
    eye = stage.GetPrimAtPath("/seer/base_link/eye/eye")
    assert eye.GetAttribute("omni:sensor:tickRate").Get() == 30
    assert "OmniSensorAPI" in eye.GetPrimTypeInfo().GetAppliedAPISchemas()
    for name, size, data in (("eye", (320, 240), "color3f"), ("depth", (64, 48), "float")):
        product = UsdRender.Product(stage.GetPrimAtPath(f"/seer/renders/{name}"))
        assert product.GetResolutionAttr().Get() == size
        (camera,) = product.GetCameraRel().GetTargets()
        assert stage.GetPrimAtPath(camera).GetTypeName() == "Camera"
        (image,) = product.GetOrderedVarsRel().GetTargets()
        assert UsdRender.Var(stage.GetPrimAtPath(image)).GetDataTypeAttr().Get() == data


STATES = """
robot: reach
base: fixed
states:
  home: {shoulder: 30deg, slide: 0.1}
  away: {slide: 0.2}
model:
- part: {name: base, link: {geometry: box, size: 0.2 0.2 0.1, mass: 4}}
- part:
    name: shoulder
    joint: {type: revolute, parent: base, xyz: 0 0 0.1, axis: y, limit: {lower: -1, upper: 2, effort: 10, velocity: 3}}
    link: {geometry: sphere, radius: 0.1, mass: 1}
- part:
    name: slide
    joint: {type: prismatic, parent: shoulder, xyz: 0 0 0.3, axis: z, limit: {lower: 0, upper: 1, effort: 10, velocity: 3}}
    link: {geometry: sphere, radius: 0.1, mass: 1}
"""  # noqa: E501


def test_states_are_named_poses(tmp_path: Path) -> None:
    """In degrees and metres, with the place of the last link, as Isaac Sim's robot schema says."""
    stage, build = stage_of(STATES, tmp_path)
    (home, _) = stage.GetDefaultPrim().GetRelationship("isaac:robot:namedPoses").GetTargets()
    prim = stage.GetPrimAtPath(home)
    assert (str(home), prim.GetTypeName()) == ("/reach/Named_Poses/home", "IsaacNamedPose")

    def targets(word: str) -> list[str]:
        found = prim.GetRelationship(f"isaac:robot:pose:{word}").GetTargets()
        return [path.name for path in found]

    assert targets("joints") == ["shoulder_joint", "slide_joint"]
    assert (targets("startLink"), targets("endLink")) == (["base_link"], ["slide_link"])
    values = prim.GetAttribute("isaac:robot:pose:jointValues").Get()
    assert list(values) == pytest.approx([30, 0.1])
    # 0.3 + 0.1 m along an axis that leans by 30° about y, 0.1 m above the base.
    x, z = 0.4 * np.sin(radians(30)), 0.1 + 0.4 * np.cos(radians(30))
    assert list(prim.GetAttribute("xformOp:translate").Get()) == pytest.approx([x, 0, z])
    turn = prim.GetAttribute("xformOp:orient").Get()
    assert turn.GetReal() == pytest.approx(np.cos(radians(15)))
    assert list(turn.GetImaginary()) == pytest.approx([0, np.sin(radians(15)), 0])
    assert not build.losses
