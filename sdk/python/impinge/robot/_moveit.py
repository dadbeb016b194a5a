# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""MoveIt's planning scenes and motion plan requests, in YAML (which needs PyYAML)."""

import importlib
import math
import os
from dataclasses import dataclass
from typing import Any, Dict, FrozenSet, Iterable, Iterator, List, Mapping, Optional, Sequence, Tuple

from .. import _files
from .._assembly import Stage
from ..errors import SceneError
from ._shapes import Pose, surface_of
from ._urdf import Origin, Shape

_SIZES = {"box": 3, "sphere": 1, "cylinder": 2, "cone": 2}
_NUMBERED = {1: "box", 2: "sphere", 3: "cylinder", 4: "cone"}  # as shape_msgs/SolidPrimitive counts them

Pair = FrozenSet[str]


@dataclass(frozen=True)
class Matrix:
    """An allowed collision matrix: pairs that may touch, or may not, and what holds by default for names."""

    entries: Mapping[Pair, bool]
    defaults: Mapping[str, bool]

    def allowed(self, a: str, b: str) -> bool:
        """Whether the two may touch. An entry says so; else the defaults of those that have one, all of
        them."""
        entry = self.entries.get(frozenset((a, b)))
        if entry is not None:
            return entry
        found = [self.defaults[name] for name in (a, b) if name in self.defaults]
        return bool(found) and all(found)

    def pairs(self, names: Iterable[str]) -> List[Tuple[str, str]]:
        """All pairs of these names that may touch."""
        if any(self.defaults.values()):
            listed = list(names)
            return [(a, b) for k, a in enumerate(listed) for b in listed[k + 1:] if self.allowed(a, b)]
        known = set(names)
        found = (sorted(pair) for pair, may in self.entries.items() if may and len(pair) == 2 and pair <= known)
        return [(a, b) for a, b in found]


@dataclass(frozen=True, eq=False)
class World:
    """What a planning scene has around a robot: bodies as of a scene file; those that are attached name a
    link as their "parent". `touching` are pairs of an attached body and a link that may touch it. `allowed`
    replaces what an SRDF file disables; None: the scene has no matrix. It is not changed any more."""

    bodies: Sequence[Mapping[str, Any]] = ()
    allowed: Optional[Matrix] = None
    touching: Sequence[Tuple[str, str]] = ()


class _Reader:
    """Reads what YAML gave; errors name the file and the place."""

    def __init__(self, path: str):
        self.path = path

    def fail(self, where: str, what: str) -> SceneError:
        return SceneError(f"{self.path}: {where}: {what}")

    def load(self, what: str) -> Dict[str, Any]:
        try:
            yaml: Any = importlib.import_module("yaml")
        except ImportError:
            raise SceneError(f"{self.path}: needs PyYAML to be read; install it: pip install pyyaml, or Debian's "
                             "python3-yaml") from None
        try:
            loaded = yaml.load(_files.read(self.path), Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
        except (yaml.YAMLError, ValueError, RecursionError) as error:
            raise SceneError(f"{self.path}: {' '.join(str(error).split())}; must be YAML") from None
        if not isinstance(loaded, dict):
            raise SceneError(f"{self.path}: got {type(loaded).__name__}, must be {what}")
        return loaded

    def table(self, owner: Dict[str, Any], key: str, where: str) -> Dict[str, Any]:
        """A member that is an object; {} where it is missing."""
        found = owner.get(key)
        if found is not None and not isinstance(found, dict):
            raise self.fail(where, f"{key}: got {found!r:.60}, must be an object")
        return found or {}

    def rows(self, owner: Dict[str, Any], key: str, where: str) -> List[Any]:
        """A member that is a list; [] where it is missing."""
        found = owner.get(key)
        if found is not None and not isinstance(found, list):
            raise self.fail(where, f"{key}: got {found!r:.60}, must be a list")
        return found or []

    def objects(self, owner: Dict[str, Any], key: str, where: str) -> Iterator[Dict[str, Any]]:
        """The elements of a list of objects."""
        for element in self.rows(owner, key, where):
            if not isinstance(element, dict):
                raise self.fail(where, f"{key}: got {element!r:.60}, must be an object")
            yield element

    def names(self, owner: Dict[str, Any], key: str, where: str) -> List[str]:
        found = self.rows(owner, key, where)
        if not all(isinstance(name, str) for name in found):
            raise self.fail(where, f"{key}: got {found!r:.60}, must be names")
        return found

    def numbers(self, value: Any, count: int, where: str, keys: str = "") -> List[float]:
        """A list, or an object with these keys."""
        if isinstance(value, dict) and set(keys) == set(value):
            value = [value[key] for key in keys]
        if not isinstance(value, list) or len(value) != count or not all(
                isinstance(x, (int, float)) and not isinstance(x, bool) and math.isfinite(x) for x in value):
            raise self.fail(where, f"got {value!r:.60}, must be {count} finite number{'s' if count > 1 else ''}")
        return [float(x) for x in value]

    def pose(self, owner: Dict[str, Any], where: str, position: str = "position",
             orientation: str = "orientation") -> Pose:
        """A position and a quaternion (x, y, z, w)."""
        x, y, z = self.numbers(owner.get(position, [0, 0, 0]), 3, f"{where}: {position}", "xyz")
        turn = self.numbers(owner.get(orientation, [0, 0, 0, 1]), 4, f"{where}: {orientation}", "xyzw")
        length = math.hypot(*turn)
        if abs(length - 1) > 1e-3:
            raise self.fail(where, f"{orientation}: got a quaternion of length {length!r}, must be 1")
        a, b, c, d = (one / length for one in turn)
        return Pose((x, y, z), (a, b, c, d))

    def no_more(self, owner: Dict[str, Any], keys: Iterable[str], where: str, cure: str) -> None:
        """Refuses members that would change the answer and are not understood."""
        for key in keys:
            if owner.get(key):
                raise self.fail(where, f"has {key}, which is not understood; {cure}")


class _Scene(_Reader):
    """Reads a planning scene. `roots` are names of the frame in which the robot's root link rests."""

    def __init__(self, path: str, roots: Iterable[str]):
        super().__init__(path)
        self._frames: Dict[str, Pose] = {name: Pose() for name in roots}

    def read(self) -> World:
        scene = self.load("a planning scene, with \"world\"")
        if not {"world", "robot_state", "allowed_collision_matrix"} & set(scene):
            raise SceneError(f"{self.path}: must be a planning scene, with \"world\"")
        world, state = self.table(scene, "world", "scene"), self.table(scene, "robot_state", "scene")
        self.no_more(self.table(self.table(world, "octomap", "world"), "octomap", "octomap"), ["data"], "octomap",
                     "let its cells be boxes of a collision object")
        self._check_robot(scene, state)
        for one in self.objects(scene, "fixed_frame_transforms", "scene"):
            self._frames[str(one.get("child_frame_id"))] = self.pose(
                self.table(one, "transform", "transform"), "fixed_frame_transforms", "translation", "rotation")
        bodies = [self._body(one, "collision_objects") for one in self.objects(world, "collision_objects", "world")]
        touching = []
        for one in self.objects(state, "attached_collision_objects", "robot_state"):
            link, thing = one.get("link_name"), self.table(one, "object", "attached_collision_objects")
            if not isinstance(link, str):
                raise self.fail("attached_collision_objects", "link_name: must be the name of a link")
            bodies.append({**self._body(thing, "attached_collision_objects", link), "parent": link})
            touching += [(bodies[-1]["name"], name)
                         for name in {link, *self.names(one, "touch_links", "attached_collision_objects")}]
        return World(bodies, self._matrix(self.table(scene, "allowed_collision_matrix", "scene")), touching)

    def _check_robot(self, scene: Dict[str, Any], state: Dict[str, Any]) -> None:
        """The robot stands at the root of the scene, as large as it is."""
        for one in self.objects(scene, "link_padding", "scene"):
            self.no_more(one, ["padding"], "link_padding", "leave it out, and ask for --require DISTANCE")
        for one in self.objects(scene, "link_scale", "scene"):
            if one.get("scale", 1) != 1:
                raise self.fail("link_scale", f"got {one['scale']!r}, must be 1; scale the meshes of the URDF file")
        joints = self.table(state, "multi_dof_joint_state", "robot_state")
        for one in self.objects(joints, "transforms", "multi_dof_joint_state"):
            pose = self.pose(one, "multi_dof_joint_state", "translation", "rotation")
            if any(pose.xyz) or abs(pose.turn[3]) < 1 - 1e-12:
                raise self.fail("multi_dof_joint_state", "moves the robot's base, which is not understood; give the "
                                                         "URDF file a root link and a joint for that")

    def _frame(self, thing: Dict[str, Any], where: str, link: str) -> Pose:
        frame = self.table(thing, "header", where).get("frame_id", "")
        if isinstance(frame, str) and frame in ("", link):
            return Pose()
        if not isinstance(frame, str) or frame not in self._frames:
            raise self.fail(where, f"got the frame {frame!r}, known are {', '.join(sorted(self._frames))}; give "
                                   "poses in one of them")
        return self._frames[frame]

    def _body(self, thing: Dict[str, Any], where: str, link: str = "") -> Dict[str, Any]:
        name = thing.get("id")
        if not isinstance(name, str) or not name:
            raise self.fail(where, "an object has no id")
        self.no_more(thing, ["planes"], name, "let a large box stand for a plane")
        outer = self.pose(self.table(thing, "pose", name), name).then(self._frame(thing, name, link))
        surfaces = []
        for kind, read in (("primitive", self._primitive), ("mesh", self._mesh)):
            shapes = list(self.objects(thing, "meshes" if kind == "mesh" else "primitives", name))
            poses = list(self.objects(thing, f"{kind}_poses", name))
            if len(shapes) != len(poses) and not (len(shapes) == 1 and not poses):
                raise self.fail(name, f"has {len(shapes)} of {kind} and {len(poses)} {kind}_poses, must be as many")
            for shape, pose in zip(shapes, poses or [{}]):
                made = read(shape, name)
                maps = self.pose(pose, name).then(outer).maps()
                surfaces.append(Stage({**made, "maps": maps}) if maps else made)
        if not surfaces:
            raise self.fail(name, "has no primitives and no meshes; leave it out")
        return {"name": name, "surfaces": surfaces}

    def _primitive(self, primitive: Dict[str, Any], where: str) -> Stage:
        kind = primitive.get("type")
        kind = _NUMBERED.get(kind, str(kind)) if isinstance(kind, int) else str(kind).lower()
        if kind not in _SIZES:
            raise self.fail(where, f"got the primitive {kind!r}, must be box, sphere, cylinder or cone")
        sizes = self.numbers(primitive.get("dimensions"), _SIZES[kind], f"{where}: dimensions")
        if min(sizes) <= 0:
            raise self.fail(where, f"dimensions: got {min(sizes)!r}, must be > 0")
        if kind in ("cylinder", "cone"):
            sizes.reverse()  # the height stands first there
        return surface_of(Shape(kind, tuple(sizes), Origin()))

    def _mesh(self, mesh: Dict[str, Any], where: str) -> Stage:
        """Vertices and triangles, or the name of a file with a scale, as robowflex writes it."""
        if "resource" in mesh:
            path = str(mesh["resource"])
            path = path[len("file://"):] if path.startswith("file://") else path
            path = os.path.join(os.path.dirname(os.path.abspath(self.path)), path)
            if not os.path.isfile(path):
                raise self.fail(where, f"the mesh {path} is not there")
            scale = self.numbers(mesh.get("dimensions", [1, 1, 1]), 3, f"{where}: dimensions")
            if 0 in scale:
                raise self.fail(where, f"dimensions: got {scale}, must not be 0")
            return surface_of(Shape("mesh", tuple(scale), Origin(), path))
        points = [self.numbers(one, 3, f"{where}: vertices", "xyz") for one in self.rows(mesh, "vertices", where)]
        faces = []
        for one in self.objects(mesh, "triangles", where):
            corners = self.rows(one, "vertex_indices", where)
            if len(corners) != 3 or not all(type(k) is int and 0 <= k < len(points) for k in corners):
                raise self.fail(where, f"vertex_indices: got {corners!r:.60}, must be 3 numbers of vertices, below "
                                       f"{len(points)}")
            faces.append(corners)
        if not faces:
            raise self.fail(where, "a mesh has no triangles")
        return Stage({"type": "mesh", "points": points, "faces": faces})

    def _matrix(self, matrix: Dict[str, Any]) -> Optional[Matrix]:
        """None: the scene has none, or an empty one."""
        where = "allowed_collision_matrix"
        names, rows = self.names(matrix, "entry_names", where), self.rows(matrix, "entry_values", where)
        # A row is a list, or an object with the list "enabled", as in the message.
        rows = [row.get("enabled") if isinstance(row, dict) else row for row in rows]
        if len(rows) != len(names) or not all(
                isinstance(row, list) and len(row) == len(names) and all(type(x) is bool for x in row)
                for row in rows):
            raise self.fail(where, f"entry_values: must be {len(names)} rows of as many booleans, as entry_names")
        for k, row in enumerate(rows):
            for j in range(k):
                if row[j] != rows[j][k]:
                    raise self.fail(where, f"{names[k]} and {names[j]}: got both true and false")
        others = self.names(matrix, "default_entry_names", where)
        defaults = self.rows(matrix, "default_entry_values", where)
        if len(others) != len(defaults) or not all(type(x) is bool for x in defaults):
            raise self.fail(where, f"default_entry_values: must be {len(others)} booleans, as default_entry_names")
        if not names and not others:
            return None
        return Matrix({frozenset((a, b)): row[j] for a, row in zip(names, rows) for j, b in enumerate(names)},
                      dict(zip(others, defaults)))


def read_world(path: str, roots: Iterable[str]) -> World:
    """What a planning scene has around a robot; `roots` are names of the frame in which its root link
    rests."""
    return _Scene(path, roots).read()


def read_request(path: str) -> Tuple[Dict[str, float], Dict[str, float]]:
    """The start and the goal of a motion plan request, from names of positions to numbers."""
    reader = _Reader(path)
    request = reader.load("a motion plan request, with \"start_state\" and \"goal_constraints\"")
    state = reader.table(reader.table(request, "start_state", "request"), "joint_state", "start_state")
    names = reader.names(state, "name", "start_state")
    start = dict(zip(names, reader.numbers(state.get("position", []), len(names), "start_state: position")))
    goals = list(reader.objects(request, "goal_constraints", "request"))
    if len(goals) != 1:
        raise reader.fail("goal_constraints", f"got {len(goals)} of them, must be 1")
    reader.no_more(goals[0], ["position_constraints", "orientation_constraints", "visibility_constraints"],
                   "goal_constraints", "give the goal as joint_constraints")
    goal = {}
    for one in reader.objects(goals[0], "joint_constraints", "goal_constraints"):
        name = one.get("joint_name")
        if not isinstance(name, str):
            raise reader.fail("goal_constraints", "joint_name: must be the name of a joint")
        goal[name], = reader.numbers([one.get("position")], 1, f"goal_constraints: {name}: position")
    if not goal:
        raise reader.fail("goal_constraints", "has no joint_constraints; must have one for each joint that moves")
    return start, goal
