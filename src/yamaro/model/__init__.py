"""A robot as links, joints and shapes, each with the place where it is written.

The names of `__all__` are public; each is imported from its module when it is first asked for.
"""

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .compare import Difference as Difference
    from .extras import Actuator as Actuator
    from .extras import Base as Base
    from .extras import Camera as Camera
    from .extras import CollisionSettings as CollisionSettings
    from .extras import Control as Control
    from .extras import Group as Group
    from .extras import Lidar as Lidar
    from .extras import Loop as Loop
    from .extras import Ranger as Ranger
    from .extras import Sensor as Sensor
    from .extras import State as State
    from .extras import Surface as Surface
    from .joint import Calibration as Calibration
    from .joint import Dynamics as Dynamics
    from .joint import Joint as Joint
    from .joint import Limit as Limit
    from .joint import Mimic as Mimic
    from .joint import SafetyController as SafetyController
    from .link import Collision as Collision
    from .link import Inertial as Inertial
    from .link import Link as Link
    from .link import Material as Material
    from .link import Visual as Visual
    from .pose import Pose as Pose
    from .robot import Frame as Frame
    from .robot import Robot as Robot
    from .shapes import Box as Box
    from .shapes import Capsule as Capsule
    from .shapes import Cylinder as Cylinder
    from .shapes import Mesh as Mesh
    from .shapes import Shape as Shape
    from .shapes import Sphere as Sphere

__all__ = [
    "Actuator",
    "Base",
    "Box",
    "Calibration",
    "Camera",
    "Capsule",
    "Collision",
    "CollisionSettings",
    "Control",
    "Cylinder",
    "Difference",
    "Dynamics",
    "Frame",
    "Group",
    "Inertial",
    "Joint",
    "Lidar",
    "Limit",
    "Link",
    "Loop",
    "Material",
    "Mesh",
    "Mimic",
    "Pose",
    "Ranger",
    "Robot",
    "SafetyController",
    "Sensor",
    "Shape",
    "Sphere",
    "State",
    "Surface",
    "Visual",
]

_NAMES = {
    "compare": ("Difference",),
    "extras": (
        *("Actuator", "Base", "Camera", "CollisionSettings", "Control", "Group"),
        *("Lidar", "Loop", "Ranger", "Sensor", "State", "Surface"),
    ),
    "joint": ("Calibration", "Dynamics", "Joint", "Limit", "Mimic", "SafetyController"),
    "link": ("Collision", "Inertial", "Link", "Material", "Visual"),
    "pose": ("Pose",),
    "robot": ("Frame", "Robot"),
    "shapes": ("Box", "Capsule", "Cylinder", "Mesh", "Shape", "Sphere"),
}
_MODULES = {name: module for module, names in _NAMES.items() for name in names}


if not TYPE_CHECKING:  # for type checkers, only the names imported above are there

    def __getattr__(name: str) -> object:
        """Import a public name."""
        if name not in _MODULES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        from importlib import import_module

        value: object = getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return sorted([*__all__, *(name for name in globals() if name[:2] == name[-2:] == "__")])
