"""Older versions of SDFormat, brought to the form of newer ones as libsdformat converts them.

In 1.2 the outermost element is `<gazebo>`. Before 1.4 the file of a mesh can be `<filename>`. Up to
1.5 an IMU has one noise for its rates and one for its accelerations. All else that changed is read
in either form.

Source: the files `*.convert` of libsdformat, and its descriptions of the elements of 1.2.
"""

from __future__ import annotations

from ...model.values import child_named, content
from ...xml.tree import Element

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...xml.tree import Node

VERSIONS = tuple(f"1.{minor}" for minor in range(2, 13))
IN_MODEL_FRAME = ("1.2", "1.3", "1.4")
"""Versions in which axes are given in the frame of the model."""
HAS_ONE_NOISE = (*IN_MODEL_FRAME, "1.5")
NOISES = {"rate": "angular_velocity", "accel": "linear_acceleration"}


def convert(root: Element, version: str) -> None:
    """Bring a document of a version to the form of newer ones."""
    if version not in HAS_ONE_NOISE:
        return
    for element in list(root.iter()):
        if element.name == "mesh":
            file = child_named(element, "filename")
            if file is not None and child_named(element, "uri") is None:
                file.name = "uri"
        elif element.name == "imu":
            _split_noise(element)


def _split_noise(imu: Element) -> None:
    """Give each axis of an IMU the noise of its rate, or of its acceleration."""
    noise = child_named(imu, "noise")
    if noise is None:
        return
    kind = content(child_named(noise, "type"))
    given = {} if kind is None else {"type": kind}
    made: list[Node] = []
    for old, new in NOISES.items():
        of_all = child_named(noise, old)
        if of_all is not None:
            values: list[Node] = [each for each in of_all.elements() if not each.elements()]
            axes: list[Node] = [
                Element(axis, noise.span, {}, [Element("noise", of_all.span, {**given}, [*values])])
                for axis in "xyz"
            ]
            made.append(Element(new, of_all.span, {}, axes))
    imu.children = [*(each for each in imu.children if each is not noise), *made]
