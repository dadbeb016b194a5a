# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Collision shapes and poses as the surfaces and maps of a scene file."""

import math
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Sequence, Tuple

from .._assembly import Stage
from ._urdf import Origin, Shape, Vector

Quaternion = Tuple[float, float, float, float]  # x, y, z, w


@dataclass(frozen=True)
class Pose:
    """Turned by a unit quaternion, then shifted."""

    xyz: Vector = (0.0, 0.0, 0.0)
    turn: Quaternion = (0.0, 0.0, 0.0, 1.0)

    def then(self, outer: "Pose") -> "Pose":
        """This pose, in a frame that has the outer pose."""
        x, y, z = rotated(outer.turn, self.xyz)
        return Pose((x + outer.xyz[0], y + outer.xyz[1], z + outer.xyz[2]), product(outer.turn, self.turn))

    def inverse(self) -> "Pose":
        """The pose that undoes this one."""
        a, b, c, d = self.turn
        x, y, z = rotated((-a, -b, -c, d), self.xyz)
        return Pose((-x, -y, -z), (-a, -b, -c, d))

    def maps(self) -> List[Stage]:
        """The maps that bring something to it; none for what stays."""
        x, y, z, w = self.turn
        made, sine = [], math.hypot(x, y, z)
        if sine > 0:
            made.append(Stage({"type": "rotate", "axis": [x, y, z], "angle": [2 * math.atan2(sine, w)]}))
        if any(self.xyz):
            made.append(Stage({"type": "translate", "offset": [list(self.xyz)]}))
        return made


def product(p: Quaternion, q: Quaternion) -> Quaternion:
    """The rotation q, then p."""
    a, b, c, d = p
    x, y, z, w = q
    return (d * x + w * a + b * z - c * y, d * y + w * b + c * x - a * z, d * z + w * c + a * y - b * x,
            d * w - a * x - b * y - c * z)


def rotated(q: Quaternion, v: Sequence[float]) -> Vector:
    """The vector v, turned by q."""
    x, y, z, _ = product(product(q, (v[0], v[1], v[2], 0.0)), (-q[0], -q[1], -q[2], q[3]))
    return x, y, z


def pose_of(origin: Origin) -> Pose:
    """The pose that an origin of a URDF file stands for."""
    turn: Quaternion = (0.0, 0.0, 0.0, 1.0)
    for axis, angle in enumerate(origin.rpy):
        half = [0.0, 0.0, 0.0, math.cos(0.5 * angle)]
        half[axis] = math.sin(0.5 * angle)
        turn = product((half[0], half[1], half[2], half[3]), turn)
    return Pose(origin.xyz, turn)


def _mesh(shape: Shape) -> Dict[str, Any]:
    scaled = {} if shape.sizes == (1, 1, 1) else {"scale": list(shape.sizes)}
    return {"type": "mesh", "file": shape.file, **scaled}


def _capsule(shape: Shape) -> Dict[str, Any]:
    radius, length = shape.sizes
    return {"type": "capsule", "radius": radius, "from": [0, 0, -0.5 * length], "to": [0, 0, 0.5 * length]}


_MADE: Dict[str, Callable[[Shape], Dict[str, Any]]] = {
    "box": lambda shape: {"type": "box", "size": list(shape.sizes)},
    "sphere": lambda shape: {"type": "sphere", "radius": shape.sizes[0]},
    "cylinder": lambda shape: {"type": "cylinder", "radius": shape.sizes[0], "height": shape.sizes[1],
                               "ends": True},
    "cone": lambda shape: {"type": "cone", "radius": shape.sizes[0], "height": shape.sizes[1], "ends": True,
                           "center": [0, 0, -0.5 * shape.sizes[1]]},
    "capsule": _capsule, "mesh": _mesh}


def surface_of(shape: Shape) -> Stage:
    """The shape as one surface, before it is brought to its origin. Centres are in the middle."""
    return Stage(_MADE[shape.kind](shape))


def surface_at(shape: Shape, frame: Pose) -> Stage:
    """The shape as one surface at its origin in a frame."""
    made, maps = surface_of(shape), pose_of(shape.origin).then(frame).maps()
    if maps:
        made["maps"] = maps
    return made
