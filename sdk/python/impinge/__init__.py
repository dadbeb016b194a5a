# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""The guaranteed earliest contact, and the clearance, of moving and deforming surfaces.

    import impinge
    scene = impinge.Scene.from_pair("torus ! rotate axis=1,0,0 rate=2",
                                    "sphere center=5,0,0 ! translate velocity=-3,0,0")
    print(scene.solve(gamma=1e-6))
"""

try:
    import numpy as _numpy  # noqa: F401 # asked first, so that the cure is named
except ModuleNotFoundError as missing:
    raise ModuleNotFoundError("impinge needs numpy: pip install numpy, or apt-get install python3-numpy",
                              name=missing.name) from None

from . import _library
from .batching import batch
from ._mesh import Mesh
from .builder import Body, Builder
from .errors import FileError, ImpingeError, PluginError, SceneError, UsageError
from .motions import Motion, simulate
from .pictures import Picture
from .results import Clearance, Profile, Progress, Result, Side
from .scene import Scene

__version__ = "0.1.0"

__all__ = ["Body", "Builder", "Clearance", "FileError", "ImpingeError", "Mesh", "Motion", "Picture",
           "PluginError", "Profile", "Progress", "Result", "Scene", "SceneError", "Side", "UsageError",
           "__version__", "batch", "simulate", "version"]


def version() -> str:
    """ "libimpinge x.y.z" of the library that runs; `__version__` is that of this module."""
    return str(_library.library.imp_version().decode())
