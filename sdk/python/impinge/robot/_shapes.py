# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Collision shapes as the surfaces of a scene file."""

import math
from typing import Any, Dict, List, Sequence, Tuple

from ._urdf import Origin, Shape

Stage = Dict[str, Any]

_ROUND = 2 * math.pi


def stages_of(origin: Origin) -> List[Stage]:
    """The maps that bring something to a pose at rest; none for what stays."""
    maps: List[Stage] = []
    for axis, angle in zip(([1, 0, 0], [0, 1, 0], [0, 0, 1]), origin.rpy):
        if angle != 0:
            maps.append({"type": "rotate", "axis": axis, "angle": [angle]})
    if any(origin.xyz):
        maps.append({"type": "translate", "offset": [list(origin.xyz)]})
    return maps


def _box(sides: Sequence[float]) -> List[Stage]:
    """Six rectangles."""
    half = [0.5 * side for side in sides]
    faces = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for sign in (-1, 1):
            origin, edge_u, edge_v = [0.0] * 3, [0.0] * 3, [0.0] * 3
            origin[axis], origin[u], origin[v] = sign * half[axis], -half[u], -half[v]
            edge_u[u], edge_v[v] = sides[u], sides[v]
            faces.append({"type": "plane", "origin": origin, "edge_u": edge_u, "edge_v": edge_v})
    return faces


def _disc(radius: float, height: float) -> Stage:
    return {"type": "formula", "x": "u*cos(v)", "y": "u*sin(v)", "z": "h", "constants": {"h": height},
            "domain": [[0, radius], [0, _ROUND]]}


def _cylinder(sizes: Tuple[float, ...]) -> List[Stage]:
    radius, length = sizes
    return [{"type": "cylinder", "radius": radius, "height": length},
            _disc(radius, -0.5 * length), _disc(radius, 0.5 * length)]


def _capsule(sizes: Tuple[float, ...]) -> List[Stage]:
    radius, length = sizes
    ends = [{"type": "sphere", "radius": radius, "center": [0, 0, z]} for z in (-0.5 * length, 0.5 * length)]
    return [{"type": "cylinder", "radius": radius, "height": length}, *ends]


def _mesh(shape: Shape) -> List[Stage]:
    stage: Stage = {"type": "mesh", "file": shape.file}
    if shape.sizes != (1, 1, 1):
        stage["maps"] = [{"type": "scale", "factor": list(shape.sizes)}]
    return [stage]


def surfaces_of(shape: Shape) -> List[Stage]:
    """The shape's surfaces, at its pose in its link."""
    if shape.kind == "mesh":
        made = _mesh(shape)
    elif shape.kind == "sphere":
        made = [{"type": "sphere", "radius": shape.sizes[0]}]
    else:
        made = {"box": _box, "cylinder": _cylinder, "capsule": _capsule}[shape.kind](shape.sizes)
    maps = stages_of(shape.origin)
    for stage in made:
        if maps:
            stage["maps"] = [*stage.get("maps", []), *maps]
    return made
