"""Pictures of states by MuJoCo's renderer, without a window: by EGL, OSMesa, or what the system has."""

from __future__ import annotations

import os
import platform
from collections.abc import Iterator
from contextlib import contextmanager
from copy import copy
from ctypes.util import find_library
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import UsageError
from arthur_acausal.mujoco.dynamics import FloatArray
from arthur_acausal.mujoco.engine import MjData, MjModel, mujoco

Image = NDArray[np.uint8]
LIBRARIES = {"egl": "EGL", "osmesa": "OSMesa"}  # of Linux, in the order in which they are tried
DIRECTION = 125.0, -12.0  # azimuth and elevation of the camera that has no name [deg]
DISTANCE = 2.6  # of it, in the reach of what moves: with a field of view of 45 degrees all of it is seen
REMEDY = "install one (Debian: apt-get install libegl1 libgl1-mesa-dri, or libosmesa6), or render on another machine"


class Canvas:
    """Draws states of a model, seen by one of its cameras, or from the side where there is no name.

    Without a name the camera follows the first body that moves. Contact forces are drawn as arrows.
    """

    def __init__(self, model: MjModel, size: tuple[int, int], camera: str = "") -> None:
        self._m = mujoco()
        self._camera = _camera(model, camera)
        self._option = self._m.MjvOption()
        self._option.flags[self._m.mjtVisFlag.mjVIS_CONTACTFORCE] = True
        self._perturbation = self._m.MjvPerturb()
        self._scene = self._m.MjvScene(model, 10_000)
        self._scene.flags[self._m.mjtRndFlag.mjRND_SHADOW] = True
        self._view = self._m.MjrRect(0, 0, *size)
        self._model = model
        self._context = self._m.MjrContext(model, self._m.mjtFontScale.mjFONTSCALE_100)
        self._m.mjr_setBuffer(self._m.mjtFramebuffer.mjFB_OFFSCREEN, self._context)

    def draw(self, data: MjData) -> Image:
        """Return the picture of a state, (height, width, 3)."""
        if not self._camera.distance:
            centre = data.subtree_com[self._camera.trackbodyid]
            self._camera.distance = DISTANCE * _reach(self._model, data, centre)
        every = self._m.mjtCatBit.mjCAT_ALL
        self._m.mjv_updateScene(
            self._model, data, self._option, self._perturbation, self._camera, every, self._scene
        )
        self._m.mjr_render(self._view, self._scene, self._context)
        image = np.empty((self._view.height, self._view.width, 3), dtype=np.uint8)
        self._m.mjr_readPixels(image, None, self._view, self._context)
        return image[::-1].copy()

    def close(self) -> None:
        """Free what the graphics library holds."""
        self._context.free()


@contextmanager
def canvas(model: MjModel, size: tuple[int, int], camera: str = "") -> Iterator[Canvas]:
    """Give a canvas of ``size`` (width, height). Raises UsageError where this machine has no OpenGL off the screen."""
    seen = copy(model)
    view = seen.vis.global_
    view.offwidth, view.offheight = max(view.offwidth, size[0]), max(view.offheight, size[1])
    context = _opengl(seen, *size)
    try:
        drawing = Canvas(seen, size, camera)
        try:
            yield drawing
        finally:
            drawing.close()
    finally:
        context.free()


def _opengl(model: MjModel, width: int, height: int) -> Any:
    """Return an OpenGL context of the library that MUJOCO_GL names, or else the first one that is here."""
    where = os.environ.get("MUJOCO_GL", "").lower() or _found()
    try:
        name = f"mujoco.{where}" if where in LIBRARIES else "mujoco.gl_context"
        context = import_module(name).GLContext(width, height)
        context.make_current()
        mujoco().MjrContext(model, mujoco().mjtFontScale.mjFONTSCALE_50).free()  # some fail only here
    except Exception as error:  # each library raises its own
        cause = " ".join(str(error).split()) or type(error).__name__
        raise UsageError(
            f"cannot render: OpenGL off the screen does not work here{f', by {where}' if where else ''}",
            cause=cause,
            remedy=f"{REMEDY}; MUJOCO_GL=egl or osmesa chooses",
        ) from error
    return context


def _found() -> str:
    """Return which of LIBRARIES is here; elsewhere than on Linux the system has its own."""
    if platform.system() != "Linux":
        return ""
    for name, library in LIBRARIES.items():
        if find_library(library):
            return name
    raise UsageError(
        "cannot render: there is no OpenGL off the screen on this machine",
        cause="neither libEGL nor libOSMesa is installed",
        remedy=REMEDY,
    )


def _camera(model: MjModel, name: str) -> Any:
    camera = mujoco().MjvCamera()
    if name:
        names = [model.camera(k).name for k in range(model.ncam)]
        camera.distance = 1.0  # without effect
        if name not in names:
            raise UsageError(
                f"the model has no camera {name!r}",
                remedy=f"it has {', '.join(names) or 'none: leave it away'}",
            )
        camera.type, camera.fixedcamid = mujoco().mjtCamera.mjCAMERA_FIXED, names.index(name)
        return camera
    camera.type = mujoco().mjtCamera.mjCAMERA_TRACKING
    camera.trackbodyid = int(model.jnt_bodyid[0]) if model.njnt else 0
    camera.azimuth, camera.elevation, camera.distance = *DIRECTION, 0.0
    return camera


def _reach(model: MjModel, data: MjData, centre: FloatArray) -> float:
    """Return how far what moves extends from a point [m]; the model's own extent counts the floor."""
    moves = model.body_weldid[model.geom_bodyid] != 0
    far = np.linalg.norm(data.geom_xpos[moves] - centre, axis=1) + model.geom_rbound[moves]
    return float(far.max(initial=0.0)) or float(model.stat.extent)
