# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Positions over time, and the maps of joints that follow them."""

import csv
import math
from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Union

import numpy

from .. import _files
from .. import _values as values
from .._assembly import Stage
from ..errors import SceneError
from ._shapes import Pose, rotated
from ._urdf import Joint

INTERPOLATIONS = ("splines", "linear", "cubic")


class Table(NamedTuple):
    """Times, and by name of a position its numbers, their velocities and accelerations at these times."""

    times: List[float]
    positions: Dict[str, List[float]]
    velocities: Dict[str, List[float]]
    accelerations: Dict[str, List[float]]


def read_table(path: str) -> Table:
    """A CSV file. Its head names the times, then positions, NAME.velocity and NAME.acceleration."""
    try:
        rows = list(csv.reader(_files.read(path).decode("utf-8-sig").splitlines()))
    except (UnicodeDecodeError, csv.Error) as error:
        raise SceneError(f"{path}: {error}; must be CSV in UTF-8") from None
    head = [name.strip() for name in rows[0]] if rows else []
    columns: List[List[float]] = [[] for _ in head]
    for number, row in enumerate(rows[1:], 2):
        if row and len(row) != len(head):
            raise SceneError(f"{path}:{number}: got {len(row)} cells, must be {len(head)} as in the head")
        for column, cell in zip(columns, row):
            try:
                column.append(float(cell))
            except ValueError:
                raise SceneError(f"{path}:{number}: got {cell!r}, must be a number") from None
            if not math.isfinite(column[-1]):
                raise SceneError(f"{path}:{number}: got {cell!r}, must be a finite number")
        if row and len(columns[0]) > 1 and columns[0][-1] <= columns[0][-2]:
            raise SceneError(f"{path}:{number}: got the time {columns[0][-1]!r} after {columns[0][-2]!r}, must increase; "
                             "leave out rows that stand twice")
    if len(head) < 2 or len(columns[0]) < 2:
        raise SceneError(f"{path}: must have a head (time, joints by name) and two rows or more")
    if len(set(head)) != len(head):
        raise SceneError(f"{path}:1: a name stands twice in the head")
    table = Table(columns[0], {}, {}, {})
    for name, column in zip(head[1:], columns[1:]):
        stem, _, ending = name.rpartition(".")
        if stem and ending == "velocity":
            table.velocities[stem] = column
        elif stem and ending == "acceleration":
            table.accelerations[stem] = column
        else:
            table.positions[name] = column
    return table


@dataclass(frozen=True)
class Course:
    """How one position goes: through `positions` at `times`; with velocities there, and
    accelerations, if they are known."""

    times: values.Floats
    positions: values.Floats
    velocities: Optional[values.Floats]
    accelerations: Optional[values.Floats]
    interpolation: str

    @property
    def rests(self) -> bool:
        """Whether it never moves."""
        return bool(numpy.all(self.positions == self.positions[0])) and all(
            x is None or not numpy.any(x) for x in (self.velocities, self.accelerations))

    def table(self, name: str, along: Optional[Sequence[float]] = None) -> Dict[str, Any]:
        """The parameters of a map whose values have that name: numbers, or vectors along a direction."""
        def column(x: values.Floats) -> values.Floats:
            return x if along is None else numpy.array(numpy.outer(x, along), dtype=float)

        made: Dict[str, Any] = {"times": self.times, name: column(self.positions)}
        if self.interpolation == "cubic":
            made["interpolation"] = "cubic"
        for key, x in (("velocities", self.velocities), ("accelerations", self.accelerations)):
            if x is not None:
                made[key] = column(x)
        return made

    def line(self) -> Optional[List[float]]:
        """The coefficients of 1, t, if it rests or goes straight from t = 0 to one other time: what is
        cheaper than a table."""
        if self.rests:
            return [float(self.positions[0])]
        if len(self.times) > 2 or self.times[0] != 0 or self.velocities is not None:
            return None
        return [float(self.positions[0]), float((self.positions[1] - self.positions[0]) / self.times[1])]

    def turned(self, axis: Sequence[float], center: Sequence[float] = (0, 0, 0)) -> List[Stage]:
        """The maps of a joint that turns about an axis through a centre."""
        line = self.line()
        if line == [0.0]:
            return []
        about: Dict[str, Any] = {"type": "rotate", "axis": list(axis), "center": list(center)}
        about.update(self.table("angles") if line is None else {"angle": line})
        return [Stage(about)]

    def shifted(self, axis: Sequence[float]) -> List[Stage]:
        """The maps of a joint that slides along an axis."""
        length, line = math.hypot(*axis), self.line()
        along = [x / length for x in axis]
        if line is None:
            return [Stage({"type": "translate", **self.table("positions", along)})]
        return [] if line == [0.0] else [Stage({"type": "translate", "offset": [[x * c for x in along] for c in line]})]


@dataclass(frozen=True)
class Following:
    """How a joint goes with a parameter of the scene: at `factor` times it plus `offset`."""

    parameter: str
    factor: float = 1.0
    offset: float = 0.0

    def turned(self, axis: Sequence[float], center: Sequence[float] = (0, 0, 0)) -> List[Stage]:
        """The maps of a joint that turns about an axis through a centre."""
        return [Stage({"type": "rotate", "axis": list(axis), "center": list(center),
                       "angle": [self.offset, self.factor], "clock": self.parameter})]

    def shifted(self, axis: Sequence[float]) -> List[Stage]:
        """The maps of a joint that slides along an axis."""
        length = math.hypot(*axis)
        return [Stage({"type": "translate", "clock": self.parameter,
                       "offset": [[x / length * c for x in axis] for c in (self.offset, self.factor)]})]


def _floating(joint: Joint, courses: Mapping[str, Course]) -> List[Stage]:
    """The maps of a joint that moves and turns freely: at constant speed and spin from key to key."""
    columns = [courses[name] for name in joint.variables]
    keys = numpy.stack([course.positions for course in columns], axis=1)
    first = columns[0]
    turns = keys[:, 3:] / numpy.linalg.norm(keys[:, 3:], axis=1)[:, None]
    if all(course.rests for course in columns):
        x, y, z, a, b, c, d = map(float, [*keys[0, :3], *turns[0]])
        return Pose((x, y, z), (a, b, c, d)).maps()
    rotations = turns[:, [3, 0, 1, 2]]
    if first.interpolation == "cubic":
        return [Stage({"type": "keyframes", "times": first.times, "positions": keys[:, :3], "rotations": rotations})]
    return [Stage({"type": "trajectory", "times": first.times, "positions": keys[:, :3], "rotations": rotations,
                   "spins": _spins(first.times, rotations)})]


def _spins(times: values.Floats, rotations: values.Floats) -> values.Floats:
    """The angular velocities that lead from each quaternion (w, x, y, z) to the next the shorter way."""
    spins = []
    steps: Any = numpy.diff(times).tolist()
    turns: Any = rotations.tolist()
    for h, (w, x, y, z), (d, a, b, c) in zip(steps, turns, turns[1:]):
        real = d * w + a * x + b * y + c * z
        way = numpy.array([a * w - d * x + b * -z + c * y, b * w - d * y + c * -x + a * z,
                           c * w - d * z + a * -y + b * x])
        way, real = (-way, -real) if real < 0 else (way, real)
        sine = float(numpy.linalg.norm(way))
        angle = 2 * math.atan2(sine, real)
        spins.append(way * (angle / sine / h) if sine > 0 else way)
    return numpy.array(spins)


def maps_of_hinge(joint: Joint, frame: Pose, course: Union[Course, Following]) -> List[Stage]:
    """The maps of a joint that turns or slides, where its frame is at rest."""
    axis = rotated(frame.turn, joint.axis)
    return course.shifted(axis) if joint.kind == "prismatic" else course.turned(axis, frame.xyz)


def maps_of_joint(joint: Joint, frame: Pose, courses: Mapping[str, Course]) -> List[Stage]:
    """The maps by which a joint moves what is below it, where its frame is at rest; none where it stays at
    0. With the axes of the robot at rest (the product of exponentials) a joint is one map."""
    if joint.kind == "fixed":
        return []
    if joint.kind == "floating":
        own = _floating(joint, courses)
        return [*frame.inverse().maps(), *own, *frame.maps()] if own else []
    if joint.kind == "planar":
        x, y, theta = (courses[name] for name in joint.variables)
        across = [rotated(frame.turn, axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
        return [*theta.turned(across[2], frame.xyz), *x.shifted(across[0]), *y.shifted(across[1])]
    return maps_of_hinge(joint, frame, courses[joint.name])
