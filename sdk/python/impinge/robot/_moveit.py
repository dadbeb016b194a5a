# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""MoveIt's planning scenes and motion plan requests, in YAML (which needs PyYAML)."""

import importlib
import math
from typing import Any, Dict, List, Tuple

from .. import _files
from ..errors import SceneError
from ._shapes import Stage, surfaces_of
from ._urdf import Origin, Shape

_SIZES = {"box": 3, "sphere": 1, "cylinder": 2, "cone": 2}


def _load(path: str) -> Any:
    try:
        yaml: Any = importlib.import_module("yaml")
    except ImportError:
        raise SceneError(f"{path}: needs PyYAML (Debian: python3-yaml) to be read") from None
    try:
        return yaml.load(_files.read(path), Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    except (yaml.YAMLError, ValueError) as error:
        raise SceneError(f"{path}: {' '.join(str(error).split())}") from None


def _numbers(path: str, where: str, value: Any, count: int) -> List[float]:
    numbers = value if isinstance(value, list) else []
    if len(numbers) != count or not all(
            isinstance(x, (int, float)) and not isinstance(x, bool) and math.isfinite(x) for x in numbers):
        raise SceneError(f"{path}: {where}: got {value!r}, must be {count} finite numbers")
    return [float(x) for x in numbers]


def _pose(path: str, where: str, pose: Any) -> List[Stage]:
    """Turns by the quaternion (x, y, z, w), then shifts."""
    if not isinstance(pose, dict):
        raise SceneError(f"{path}: {where}: got {pose!r}, must be a position and an orientation")
    x, y, z, w = _numbers(path, where + ": orientation", pose.get("orientation", [0, 0, 0, 1]), 4)
    length, sine = math.hypot(x, y, z, w), math.hypot(x, y, z)
    if abs(length - 1) > 1e-3:
        raise SceneError(f"{path}: {where}: orientation: got length {length!r}, must be 1")
    maps: List[Stage] = []
    if sine > 0:
        maps.append({"type": "rotate", "axis": [x, y, z], "angle": [2 * math.atan2(sine, w)]})
    position = _numbers(path, where + ": position", pose.get("position", [0, 0, 0]), 3)
    maps.append({"type": "translate", "offset": [position]})
    return maps


def _primitive(path: str, where: str, primitive: Any) -> List[Stage]:
    kind = primitive.get("type") if isinstance(primitive, dict) else None
    if kind not in ("box", "sphere", "cylinder"):
        raise SceneError(f"{path}: {where}: got the primitive {kind!r}, must be box, sphere or cylinder")
    sizes = _numbers(path, f"{where}: dimensions", primitive.get("dimensions"), _SIZES[kind])
    if min(sizes) <= 0:
        raise SceneError(f"{path}: {where}: dimensions: got {min(sizes)!r}, must be > 0")
    if kind == "cylinder":
        sizes.reverse()  # the height stands first there
    return surfaces_of(Shape(kind, tuple(sizes), Origin()))


def read_world(path: str) -> List[Dict[str, Any]]:
    """The bodies of a planning scene: its collision objects of boxes, spheres and cylinders."""
    scene = _load(path)
    world = scene.get("world", {}) if isinstance(scene, dict) else None
    if not isinstance(world, dict):
        raise SceneError(f"{path}: must be a planning scene, with \"world\"")
    bodies = []
    for thing in world.get("collision_objects") or []:
        name = thing.get("id") if isinstance(thing, dict) else None
        if not isinstance(name, str) or not name:
            raise SceneError(f"{path}: a collision object has no id")
        for key in ("meshes", "planes", "octomap"):
            if thing.get(key):
                raise SceneError(f"{path}: {name}: has {key}, which are not understood; use boxes, spheres "
                                 "or cylinders")
        shapes, poses = thing.get("primitives") or [], thing.get("primitive_poses") or []
        if len(shapes) != len(poses) or not shapes:
            raise SceneError(f"{path}: {name}: has {len(shapes)} primitives and {len(poses)} poses, must be "
                             "as many, and at least 1")
        surfaces = []
        for shape, pose in zip(shapes, poses):
            maps = _pose(path, name, pose)
            surfaces += [{**stage, "maps": maps} for stage in _primitive(path, name, shape)]
        body: Dict[str, Any] = {"name": name, "surfaces": surfaces}
        if "pose" in thing:
            body["maps"] = _pose(path, name, thing["pose"])
        bodies.append(body)
    return bodies


def read_request(path: str) -> Tuple[Dict[str, float], Dict[str, float]]:
    """The start and the goal of a motion plan request, from names of joints to positions."""
    request = _load(path)
    try:
        state = request["start_state"]["joint_state"]
        start = dict(zip(state["name"], _numbers(path, "start_state", state["position"], len(state["name"]))))
        goal = {one["joint_name"]: _numbers(path, "goal_constraints", [one["position"]], 1)[0]
                for one in request["goal_constraints"][0]["joint_constraints"]}
    except (KeyError, IndexError, TypeError) as error:
        raise SceneError(f"{path}: must be a motion plan request with start_state/joint_state and joint "
                         f"constraints as its goal: {type(error).__name__}: {error}") from None
    return start, {**start, **goal}
