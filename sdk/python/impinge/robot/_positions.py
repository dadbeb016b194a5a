# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Positions of a robot's joints: names, limits, and how they go over time."""

from typing import Any, Dict, List, Mapping, Optional, Tuple, Union

import numpy

from .. import _values as values
from ..errors import UsageError
from ._course import INTERPOLATIONS, Course
from ._urdf import Joint, Model

Positions = Union[Mapping[str, Any], Any]

_SLACK = 1e-6  # rad or length: so far beyond a limit a position may be, as written with few digits
_NEAR = 1e-3  # rad or length: so far a mimic joint may be from what it follows, where both are given


class Variables:
    """The positions that a robot takes: one or several of each joint that moves by itself."""

    def __init__(self, model: Model):
        self._model = model
        self.joints: Tuple[Joint, ...] = tuple(
            joint for joint in model.joints.values() if joint.kind != "fixed" and joint.mimic is None)
        self._joint_of = {name: joint for joint in self.joints for name in joint.variables}
        self.names: Tuple[str, ...] = tuple(self._joint_of)

    def rest(self, name: str) -> float:
        """The position of a joint of which nothing is said: 0, or the nearest limit."""
        joint = self._joint_of[name]
        return 1.0 if name.endswith("/rot_w") else min(max(0.0, joint.lower), joint.upper)

    def own(self, named: Mapping[str, float], where: str) -> Tuple[Dict[str, float], List[str]]:
        """Of positions as others write them those that a robot takes, and what was left out: fixed joints,
        which stay where they are, and joints that follow others, which must agree with them."""
        taken: Dict[str, float] = {}
        left: List[str] = []
        for name, position in named.items():
            joint = self._model.joints.get(name)
            if name in self._joint_of:
                taken[name] = position
            elif joint is None:
                raise values.refuse(where, name, f"a joint of the robot: {', '.join(self.names)}")
            elif joint.kind == "fixed" and position != 0:
                left.append(f"{where}: joint {name!r} is fixed: its position {position!r} changes nothing")
        for name, position in named.items():
            joint = self._model.joints.get(name)
            if joint is None or joint.mimic not in taken:
                continue
            must = joint.factor * taken[joint.mimic] + joint.offset
            if abs(position - must) > _NEAR:
                raise UsageError(f"{where}: {name}: got {position!r}, must be {must!r}, since it follows "
                                 f"{joint.mimic}; leave it out")
        return taken, left

    # --- Over time --------------------------------------------------------------------------------

    def courses(self, times: Any, positions: Positions, velocities: Optional[Positions],
                accelerations: Optional[Positions], interpolation: str) -> Dict[str, Course]:
        """How each position goes, those of mimic joints too; at rest where nothing is said."""
        at = values.array("times", times)
        if at.ndim != 1 or len(at) < 2 or not numpy.all(numpy.isfinite(at)) or numpy.any(at[1:] <= at[:-1]):
            raise values.refuse("times", times, "two or more increasing numbers")
        if interpolation not in INTERPOLATIONS:
            raise values.refuse("interpolation", interpolation, "'splines', 'linear' or 'cubic'")
        if accelerations is not None and velocities is None:
            raise UsageError("accelerations: given without velocities; give both")
        if interpolation != "splines":
            velocities = accelerations = None
        given = self._columns("positions", at, positions)
        slopes = {} if velocities is None else self._columns("velocities", at, velocities)
        bends = {} if accelerations is None else self._columns("accelerations", at, accelerations)
        made = {}
        for name in self.names:
            column = given.get(name, numpy.full_like(at, self.rest(name)))
            self._check(name, column)
            made[name] = Course(at, column, _other(name, slopes, given), _other(name, bends, given),
                                interpolation)
            if "/rot_" in name and made[name].velocities is not None:
                raise UsageError(f"velocities: {name}: a floating joint takes none; leave them out")
        self._follow(at, made)
        return made

    def _follow(self, at: values.Floats, made: Dict[str, Course]) -> None:
        """Adds the mimic joints."""
        rest = Course(at, numpy.zeros_like(at), None, None, "linear")  # of a fixed joint
        for joint in self._model.joints.values():
            if joint.mimic is not None:
                by, f = made.get(joint.mimic, rest), joint.factor
                made[joint.name] = Course(at, f * by.positions + joint.offset,
                                          None if by.velocities is None else f * by.velocities,
                                          None if by.accelerations is None else f * by.accelerations,
                                          by.interpolation)

    def _columns(self, what: str, at: values.Floats, given: Positions) -> Dict[str, values.Floats]:
        if not isinstance(given, Mapping):
            table = values.array(what, given)
            if table.shape != (len(at), len(self.names)):
                raise UsageError(f"{what}: got an array of shape {table.shape}, must be ({len(at)}, "
                                 f"{len(self.names)}): a row for each time, a column for each of "
                                 f"{', '.join(self.names)}")
            return {name: numpy.ascontiguousarray(table[:, k]) for k, name in enumerate(self.names)}
        columns = {}
        for name, numbers in given.items():
            if name not in self._joint_of:
                raise values.refuse(what, name, f"a joint that moves: {', '.join(self.names)}")
            column = values.array(f"{what}: {name}", numbers)
            if column.ndim > 1 or column.size not in (1, len(at)):
                raise values.refuse(f"{what}: {name}", numbers, f"{len(at)} numbers, or one")
            columns[name] = numpy.ascontiguousarray(numpy.broadcast_to(column, at.shape))
            if not numpy.all(numpy.isfinite(column)):
                raise values.refuse(f"{what}: {name}", numbers, "finite numbers")
        return columns

    def _check(self, name: str, column: values.Floats) -> None:
        joint = self._joint_of[name]
        wrong = ~((column >= joint.lower - _SLACK) & (column <= joint.upper + _SLACK) & numpy.isfinite(column))
        if numpy.any(wrong):
            raise UsageError(f"positions: {name}: got {float(column[wrong][0])!r}, must be from "
                             f"{joint.lower!r} to {joint.upper!r}")


def _other(name: str, columns: Mapping[str, values.Floats],
           given: Mapping[str, values.Floats]) -> Optional[values.Floats]:
    """The velocities or accelerations of one position; zeros where only others have some and it rests."""
    if not columns:
        return None
    found = columns.get(name)
    if found is None and name in given and numpy.any(given[name] != given[name][0]):
        raise UsageError(f"velocities: {name}: missing, but others have some; give them for all that move")
    return numpy.zeros_like(next(iter(columns.values()))) if found is None else found
