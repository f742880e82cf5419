"""Prims as elements, at the places of what they are made of: what `yamaro why` looks up."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..tags import Tag, text_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pxr import Usd

    from ...diagnostics import Frame as Step
    from ...source import Span


def tag_of(
    prim: Usd.Prim, span: Span, trace: Step | None, places: Mapping[str, Span] | None = None
) -> Tag:
    """Return an element with the name, the path and the values of a prim that are one word.

    They are called as in their schema: `upperLimit` is `physics:upperLimit` in the prim.

    Args:
        prim: the prim.
        span: where it is written what it is made of.
        trace: the calls and includes that led there.
        places: where its values are written, if not there.
    """
    values = {each.GetBaseName(): each.Get() for each in prim.GetAuthoredAttributes()}
    words = {
        name: text_of(value)
        for name, value in values.items()
        if isinstance(value, (str, float, int))
    }
    path = str(prim.GetPath())
    name = prim.GetName()
    tag = Tag(prim.GetTypeName(), span=span, trace=trace, name=name, path=path, **words)
    tag.places = places
    return tag
