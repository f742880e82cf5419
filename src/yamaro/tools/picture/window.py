"""A window of OpenGL that is on no screen, or the reason why there can be none."""

from __future__ import annotations

import ctypes
import os
import sys
from typing import Any

DEBIAN_PACKAGES = "libegl1 libgl1-mesa-dri"
EGL_LIBRARY = "libEGL.so.1"
SOFTWARE_LIBRARIES = ("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so")
DEVICE_PLATFORM = 0x313F
"""EGL_PLATFORM_DEVICE_EXT."""
MOST_DEVICES = 8


class NoOpenGLError(Exception):
    """Nothing can be drawn on this system; the text says what to install."""


def make_window() -> Any:
    """Return VTK's window for pictures.

    On Linux that is one of EGL, which needs neither a display nor a graphics card, or else one of
    OSMesa. Without its libraries VTK would end the process, so they are looked for first.

    Raises:
        NoOpenGLError: neither is there.
    """
    if sys.platform != "linux":
        import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 - registers the window of the system
        from vtkmodules.vtkRenderingCore import vtkRenderWindow

        window: Any = vtkRenderWindow()
    else:
        from vtkmodules import vtkRenderingOpenGL2

        if _has_egl():
            window = vtkRenderingOpenGL2.vtkEGLRenderWindow()
        elif any(map(_loads, SOFTWARE_LIBRARIES)):
            window = vtkRenderingOpenGL2.vtkOSOpenGLRenderWindow()
        else:
            raise NoOpenGLError(f"on Debian and Ubuntu: apt install {DEBIAN_PACKAGES}")
    window.SetOffScreenRendering(True)
    return window


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def _has_egl() -> bool:
    """Return whether EGL has a device to draw with: the library may be there without a driver.

    Source: the extensions EGL_EXT_device_enumeration and EGL_EXT_platform_device.
    """
    os.environ.setdefault("EGL_LOG_LEVEL", "fatal")  # else it reports each driver it lacks
    try:
        egl = ctypes.CDLL(EGL_LIBRARY)
    except OSError:
        return False
    find = egl.eglGetProcAddress
    find.restype, find.argtypes = ctypes.c_void_p, [ctypes.c_char_p]
    query, get_display = find(b"eglQueryDevicesEXT"), find(b"eglGetPlatformDisplayEXT")
    if not query or not get_display:
        return False
    pointer, integer = ctypes.c_void_p, ctypes.c_int
    devices, count = (pointer * MOST_DEVICES)(), integer(0)
    ask = ctypes.CFUNCTYPE(integer, integer, pointer, pointer)(query)
    if not ask(MOST_DEVICES, devices, ctypes.byref(count)) or not count.value:
        return False
    display_of = ctypes.CFUNCTYPE(pointer, integer, pointer, pointer)(get_display)
    egl.eglInitialize.argtypes = [pointer, pointer, pointer]
    return any(
        egl.eglInitialize(display_of(DEVICE_PLATFORM, device, None), None, None)
        for device in devices[: count.value]
    )
