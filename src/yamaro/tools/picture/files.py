"""Pictures as the bytes of a file: PNG, JPEG, GIF, MP4."""

from __future__ import annotations

from fractions import Fraction
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np
import PIL.Image

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    Image = NDArray[np.uint8]

PALETTE_FRAMES = 8
"""Frames of a GIF that its colours are taken from."""

NEARLY_WHITE = 248

COLORS = 255
"""Colours of a GIF; one more is for what is clear."""


def still(image: Image, ending: str) -> bytes:
    """Return a picture, height×width×4, as a PNG or JPEG."""
    file = BytesIO()
    picture = PIL.Image.fromarray(image)
    is_opaque = bool((image[..., 3] == 255).all())
    if ending == ".png":
        (picture.convert("RGB") if is_opaque else picture).save(file, "PNG", optimize=True)
    else:
        picture.convert("RGB").save(file, "JPEG", quality=92, subsampling=0)
    return file.getvalue()


def gif(frames: Iterable[Image], rate: float) -> bytes:
    """Return pictures as a GIF that repeats; half-transparent pixels become opaque or clear."""
    images = [PIL.Image.fromarray(frame) for frame in frames]
    chosen = images[:: max(len(images) // PALETTE_FRAMES, 1)]
    width, height = images[0].size
    all_chosen = PIL.Image.new("RGB", (width, height * len(chosen)))
    for number, image in enumerate(chosen):
        all_chosen.paste(image.convert("RGB"), (0, number * height))
    palette = _with_white(all_chosen.quantize(COLORS, PIL.Image.Quantize.MEDIANCUT))
    pages = [_page(image, palette) for image in images]
    file = BytesIO()
    pages[0].save(
        file,
        "GIF",
        save_all=True,
        append_images=pages[1:],
        # A GIF counts in hundredths of a second; viewers slow down what is faster than two.
        duration=max(round(100 / rate), 2) * 10,
        loop=0,
        disposal=2 if pages[0].info.get("transparency") is not None else 1,
        optimize=False,
    )
    return file.getvalue()


def _with_white(image: PIL.Image.Image) -> PIL.Image.Image:
    """Make the brightest colours of a palette white, as the background of pictures is.

    Pillow takes colours for the same that differ by less than four.
    """
    colors = np.array(image.getpalette()).reshape(-1, 3)
    colors[colors.sum(axis=1).argmax()] = 255
    colors[colors.min(axis=1) >= NEARLY_WHITE] = 255
    image.putpalette(colors.ravel().tolist())
    image.load()  # which is when Pillow takes the palette over
    return image


def _page(image: PIL.Image.Image, palette: PIL.Image.Image) -> PIL.Image.Image:
    page = image.convert("RGB").quantize(palette=palette, dither=PIL.Image.Dither.NONE)
    alpha = image.getchannel("A")
    if alpha.getextrema()[0] == 255:
        return page
    page.paste(COLORS, mask=alpha.point([255] * 128 + [0] * 128))
    page.info["transparency"] = COLORS
    return page


def mp4(frames: Iterable[Image], rate: float) -> bytes:
    """Return pictures as an MP4 with H.264, which every browser plays; sides are made even."""
    import av

    file = BytesIO()
    container: Any = av.open(file, "w", format="mp4")
    stream: Any = None
    for frame in frames:
        height, width = (side - side % 2 for side in frame.shape[:2])
        if stream is None:
            stream = container.add_stream("libx264", rate=Fraction(rate).limit_denominator(1000))
            stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
            stream.options = {"crf": "18", "preset": "slow"}
        pixels = np.ascontiguousarray(frame[:height, :width, :3])
        container.mux(stream.encode(av.VideoFrame.from_ndarray(pixels, format="rgb24")))
    container.mux(stream.encode())
    container.close()
    return file.getvalue()
