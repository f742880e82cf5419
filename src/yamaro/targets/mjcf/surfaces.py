"""Surfaces of collisions: friction, and how contacts give way."""

from __future__ import annotations

from math import log, pi, sqrt

from ..gains import TIME_STEP
from ..output import APPROXIMATED, LOST
from .writing import Writing, number, row

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.extras import Surface
    from ...model.link import Link

TORSIONAL, ROLLING = 0.005, 0.0001
"""MuJoCo's default coefficients of the friction that stops turning and rolling, in metres."""
TIME_CONSTANT = 0.02
"""MuJoCo's default time constant of contacts, in seconds."""
STIFFEST = (0.5 / TIME_STEP) ** 2
"""The greatest stiffness by mass, in 1/s², that MuJoCo's default time step can follow."""


def surface_attributes(writing: Writing, link: Link, surface: Surface) -> dict[str, str | None]:
    """Return the attributes of a geom that a surface gives, and report what it does not give."""
    attributes: dict[str, str | None] = {}
    friction = surface.friction
    if friction is not None:
        attributes["friction"] = row((friction, TORSIONAL, ROLLING))
    if surface.friction2 != friction:
        _lose(writing, link, surface, LOST, "second coefficients of friction", "friction2")
    if surface.stiffness is not None or surface.damping is not None:
        how = "accelerations by depth and speed, for the mass of the link"
        for name in ("stiffness", "damping"):
            if getattr(surface, name) is not None:
                _lose(writing, link, surface, APPROXIMATED, f"{name} of contacts", name, how)
        attributes["solref"] = _stiff(writing, link, surface)
        if surface.restitution is not None:
            what = "restitutions of surfaces that are stiff"
            _lose(writing, link, surface, LOST, what, "restitution")
    elif surface.restitution is not None:
        how = "damping of contacts"
        _lose(writing, link, surface, APPROXIMATED, "restitutions of surfaces", "restitution", how)
        ratio = damping_ratio(surface.restitution)
        attributes["solref"] = None if ratio == 1 else row((TIME_CONSTANT, ratio))
    return attributes


def damping_ratio(restitution: float) -> float:
    """Return the damping ratio of a spring that gives back this part of the speed, at most 1.

    Source: the half period of a damped oscillator, e = exp(−π·ζ/√(1 − ζ²)), solved for ζ; see
    https://en.wikipedia.org/wiki/Logarithmic_decrement.
    """
    if restitution <= 0:
        return 1.0
    if restitution >= 1:
        return 1e-3  # MuJoCo takes none that is 0
    decrement = log(restitution)
    return -decrement / sqrt(pi * pi + decrement * decrement)


def _stiff(writing: Writing, link: Link, surface: Surface) -> str | None:
    """Return `solref` for a stiffness in N/m and a damping in N·s/m; None for MuJoCo's default.

    MuJoCo counts both by mass. What is missing gives critical damping. A surface that is stiffer
    than the time step can follow is as stiff as MuJoCo's default.
    """
    mass = link.mass or writing.robot.mass or 1.0
    stiffness = surface.stiffness / mass if surface.stiffness else None
    damping = surface.damping / mass if surface.damping else None
    if stiffness is None:
        if damping is None:
            return None
        stiffness = damping * damping / 4
    elif damping is None:
        damping = 2 * sqrt(stiffness)
    if stiffness > STIFFEST:
        return None
    return f"-{number(stiffness)} -{number(damping)}"


def _lose(
    writing: Writing,
    link: Link,
    surface: Surface,
    kind: str,
    what: str,
    attribute: str,
    how: str = "",
) -> None:
    owner, span = f"link '{link.name}'", surface.span_of(attribute)
    writing.lose(kind, what, owner, span, trace=surface.trace, how=how)
