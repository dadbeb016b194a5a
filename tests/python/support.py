# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""Scenes that several tests ask."""

import os
import pathlib

import impinge
import numpy

SOURCE = pathlib.Path(os.environ["top_srcdir"])
ARM = SOURCE / "tools" / "data" / "arm.json"


def flying(speed: float = -2) -> impinge.Builder:
    """Two balls that meet at t = 0.5."""
    builder = impinge.Builder(gamma=1e-6)
    builder.body("left").surface("sphere", radius=0.5)
    builder.body("right").surface("sphere", radius=0.5, center=numpy.array([2.0, 0, 0])).map(
        "translate", velocity=[speed, 0, 0])
    return builder


def crowd() -> impinge.Scene:
    """Three balls that meet a wall one after the other, one that never does, and two that ignore."""
    builder = impinge.Builder()
    builder.body("wall").surface("plane", origin=[-5, -5, 0], edge_u=[10, 0, 0], edge_v=[0, 10, 0])
    for k, height in enumerate((1.5, 1.25, 1.75, 4.5)):
        builder.body(f"ball{k}", group="balls").surface(
            "sphere", radius=0.5, center=[3 * k - 5, 0, height]).map(
            "translate", velocity=[0, 0, -2])
    builder.ignore("balls", "balls")
    return builder.build()


def endless() -> impinge.Scene:
    """A search that only a budget ends."""
    return impinge.Scene.from_pair("superellipsoid",
                                   "superellipsoid radii=1.000000002,1.000000002,1.000000002")
