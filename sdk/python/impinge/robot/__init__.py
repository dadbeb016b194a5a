# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Robots from URDF: motions of all joints as scenes.

    from impinge import robot
    arm = robot.load("arm.urdf", srdf="arm.srdf", packages={"arm_description": "/path/to/it"})
    scene = arm.scene([0, 1], [[0, 0, 0], [1, 0.5, 0]])
    print(scene.solve(), scene.each(required=0.002)[0])

Every link with a collision geometry is a body of its name. Bodies are surfaces: what is inside of another
body from the start on touches nothing."""

from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy

from .. import _document as document
from .. import _values as values
from ..errors import SceneError, UsageError
from ..scene import Scene
from ._shapes import Stage, stages_of, surfaces_of
from ._urdf import Joint, Model, Shape, read_srdf, read_urdf

__all__ = ["Joint", "Robot", "Shape", "load"]

_SLACK = 1e-6  # rad or length: so far beyond a limit a position may be, as written with few digits

Positions = Union[Mapping[str, Any], Any]


class Robot:
    """A robot that `load` read. `links` are the names of all links, `joints` those joints that move by
    themselves, in the order in which `scene` takes positions: parents before children."""

    def __init__(self, model: Model, disabled: Iterable[Tuple[str, str]]):
        self._model = model
        self.name = model.name
        self.links: Tuple[str, ...] = tuple(model.links)
        self.joints: Tuple[Joint, ...] = tuple(
            joint for joint in model.joints.values() if joint.kind != "fixed" and joint.mimic is None)
        self._joint_of = {joint.child: joint for joint in model.joints.values()}
        self._disabled = list(disabled)
        if not any(model.links.values()):
            raise SceneError(f"{model.file}: no link has a <collision>; there is nothing to test")

    def __repr__(self) -> str:
        return f"Robot({self.name!r}, {len(self.links)} links, {len(self.joints)} joints)"

    def scene(self, times: Any, positions: Positions, *, world: Sequence[Mapping[str, Any]] = (),
              interpolation: str = "linear") -> Scene:
        """The motion through `positions` at `times` (two or more, increasing): rows of one number for each
        of `joints`, or a dict from names to columns, where joints that are not named stay at 0, or at the
        nearest limit. Between them joints move linearly, or by a cubic spline ("cubic"). `world` are bodies
        as of scene files, each with a name, which are not tested with each other."""
        at = self._times(times)
        if interpolation not in ("linear", "cubic"):
            raise values.refuse("interpolation", interpolation, "'linear' or 'cubic'")
        courses, apart = self._courses(at, positions), _all_pairs(world)
        bodies = [self._body(link, at, courses, interpolation)
                  for link, shapes in self._model.links.items() if shapes]
        made: document.Document = {"time": [float(at[0]), float(at[-1])],
                                   "bodies": [*bodies, *({**body} for body in world)], "ignore": self._ignored() + apart}
        return Scene.from_json(document.to_text(made), name=self.name or "robot")

    # --- Positions ----------------------------------------------------------------------------

    def _times(self, times: Any) -> values.Floats:
        at = values.array("times", times)
        if at.ndim != 1 or len(at) < 2 or not numpy.all(numpy.isfinite(at)) or numpy.any(at[1:] <= at[:-1]):
            raise values.refuse("times", times, "two or more increasing numbers")
        return at

    def _courses(self, at: values.Floats, positions: Positions) -> Dict[str, values.Floats]:
        """The positions of every joint that moves, mimic joints too."""
        if isinstance(positions, Mapping):
            columns = self._named_columns(at, positions)
        else:
            table = values.array("positions", positions)
            if table.shape != (len(at), len(self.joints)):
                raise UsageError(f"positions: got an array of shape {table.shape}, must be "
                                 f"({len(at)}, {len(self.joints)}): a row for each time, a column for each "
                                 f"of {', '.join(joint.name for joint in self.joints)}")
            columns = {joint.name: table[:, k] for k, joint in enumerate(self.joints)}
        for joint in self.joints:
            self._check_limits(joint, columns[joint.name])
        for joint in self._model.joints.values():
            if joint.mimic is not None:
                followed = columns.get(joint.mimic, numpy.zeros_like(at))  # zeros: of a fixed joint
                columns[joint.name] = joint.factor * followed + joint.offset
        return columns

    def _named_columns(self, at: values.Floats, positions: Mapping[str, Any]) -> Dict[str, values.Floats]:
        known = {joint.name for joint in self.joints}
        for name in positions:
            if name not in known:
                raise values.refuse("positions", name, f"a joint that moves: {', '.join(sorted(known))}")
        columns = {}
        for joint in self.joints:
            given = positions.get(joint.name, min(max(0.0, joint.lower), joint.upper))
            column = values.array(f"positions: {joint.name}", given)
            if column.ndim > 1 or len(column) not in (1, len(at)):
                raise values.refuse(f"positions: {joint.name}", given, f"{len(at)} numbers, or one")
            columns[joint.name] = numpy.broadcast_to(column, at.shape)
        return columns

    def _check_limits(self, joint: Joint, column: values.Floats) -> None:
        wrong = ~((column >= joint.lower - _SLACK) & (column <= joint.upper + _SLACK)
                  & numpy.isfinite(column))
        if numpy.any(wrong):
            raise UsageError(f"positions: {joint.name}: got {float(column[wrong][0])!r}, must be from "
                             f"{joint.lower!r} to {joint.upper!r}")

    # --- Bodies -----------------------------------------------------------------------------------

    def _ancestor(self, link: str) -> Optional[str]:
        """The nearest link above that is a body; None: there is none."""
        joint = self._joint_of.get(link)
        while joint is not None and not self._model.links[joint.parent]:
            joint = self._joint_of.get(joint.parent)
        return None if joint is None else joint.parent

    def _body(self, link: str, at: values.Floats, courses: Mapping[str, values.Floats],
              interpolation: str) -> Dict[str, Any]:
        """A link as a body whose parent is the nearest link that is one: links without a geometry, between
        them, only move it."""
        body: Dict[str, Any] = {"name": link, "surfaces": [
            surface for shape in self._model.links[link] for surface in surfaces_of(shape)]}
        maps: List[Stage] = []
        joint, parent = self._joint_of.get(link), self._ancestor(link)
        while joint is not None:
            maps += _motion(joint, at, courses.get(joint.name), interpolation)
            maps += stages_of(joint.origin)
            joint = None if joint.parent == parent else self._joint_of.get(joint.parent)
        if maps:
            body["maps"] = maps
        if parent is not None:
            body["parent"] = parent
        return body

    def _ignored(self) -> List[List[str]]:
        """Links that a joint connects, and the pairs that the SRDF disables."""
        pairs = {(link, parent) for link, shapes in self._model.links.items() if shapes
                 for parent in [self._ancestor(link)] if parent is not None}
        pairs |= {(a, b) for a, b in self._disabled
                  if a != b and self._model.links[a] and self._model.links[b]}
        return [list(pair) for pair in sorted(pairs)]


def _all_pairs(world: Sequence[Mapping[str, Any]]) -> List[List[str]]:
    """Names of bodies, two by two."""
    names = []
    for body in world:
        if not isinstance(body, Mapping) or not isinstance(body.get("name"), str):
            raise values.refuse("world", body, "bodies as of scene files, each with a name")
        names.append(body["name"])
    return [[a, b] for k, a in enumerate(names) for b in names[k + 1:]]


def _motion(joint: Joint, at: values.Floats, course: Optional[values.Floats],
            interpolation: str) -> List[Stage]:
    """The map of one joint; none where it stays at 0."""
    if course is None or not numpy.any(course):
        return []
    rests = bool(numpy.all(course == course[0]))
    if joint.kind == "prismatic":
        along = numpy.array(joint.axis) / numpy.linalg.norm(joint.axis)
        if rests:
            return [{"type": "translate", "offset": [(along * course[0]).tolist()]}]
        return [{"type": "translate", "times": at, "positions": numpy.outer(course, along),
                 "interpolation": interpolation}]
    if rests:
        return [{"type": "rotate", "axis": list(joint.axis), "angle": [float(course[0])]}]
    return [{"type": "rotate", "axis": list(joint.axis), "times": at, "angles": course,
             "interpolation": interpolation}]


def load(urdf: values.Path, srdf: Optional[values.Path] = None,
         packages: Optional[Mapping[str, str]] = None) -> Robot:
    """The robot of a URDF file. `packages` tells where the packages of its meshes are; the pairs of links
    that the SRDF file disables are never tested with each other, nor are links that a joint connects."""
    model = read_urdf(values.path("urdf", urdf), dict(packages or {}))
    return Robot(model, [] if srdf is None else read_srdf(values.path("srdf", srdf), model))
