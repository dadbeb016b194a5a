# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Pairs of links over all positions of the joints between them."""

import math
import time
from dataclasses import dataclass, replace
from typing import Dict, List, Literal, Mapping, Optional, Sequence, Tuple

from .. import _document as document
from .._assembly import Stage, scene_of
from .._handle import Handle
from .._query import Settings, Wanted
from .._survey import State, Survey
from ..results import Result, result_of
from . import _seek
from ._course import Following, maps_of_hinge
from ._shapes import Pose
from ._urdf import Joint, Model

Ranges = Dict[str, Tuple[float, float]]
Verdict = Literal["never", "collides", "undecided"]

_FREE_JOINTS = 2  # of a pair; with more, fixing one makes the search little easier
_PARTS = 32  # of the limits of a joint
_PART_PAIRS = 300_000  # of regions, for one part; smaller ones may be easier

_LOOK_AFTER = 25  # looks at a survey (of 4 boxes) before positions that touch are sought by descent
_GAMMA = 1e-6  # what is no farther apart touches

_TURN = math.nextafter(math.pi, 4)  # half a turn, rounded up: a joint without limits goes all around


@dataclass(frozen=True)
class LinkPair:
    """Two links over all positions of the joints between them, which `joints` names with their limits
    (from -pi to pi where there are none). "never": proved never to touch; "collides": they touch where the
    joints are at `positions`, found by the proof or by descent, and elsewhere perhaps; "undecided": a limit
    came, or `why` says what stood in the way. `proved` is the share of all positions that is proved free.
    `reason` is the SRDF file's for not testing the pair, "" if it gives none; None: it has the pair tested.
    `free` tells of a pair that collides where it does not: ranges of one joint, wherever the other is, proved
    and cut at 32nds of its limits; None: more than two joints are between the links."""

    links: Tuple[str, str]
    reason: Optional[str]
    verdict: Verdict
    joints: Ranges
    positions: Optional[Dict[str, float]]
    proved: float
    pairs: int
    seconds: float
    why: Optional[str] = None
    free: Optional[Dict[str, List[Tuple[float, float]]]] = None


@dataclass(frozen=True)
class Limits:
    """What ends the search for each pair."""

    gamma: Optional[float]
    max_seconds: float
    max_pairs: Optional[int] = None

    def less(self, seconds: float) -> "Limits":
        """After so many seconds."""
        return replace(self, max_seconds=max(self.max_seconds - seconds, 1e-9))


class Links:
    """The links of a robot, and the joints that lead to them."""

    def __init__(self, model: Model, frames: Mapping[str, Pose], surfaces: Mapping[str, List[Stage]]):
        self._model, self._frames, self._surfaces = model, frames, surfaces
        self._above = {joint.child: joint for joint in model.joints.values()}

    def _joints_above(self, link: str) -> List[Joint]:
        """From the link up to the root."""
        joints = []
        while link in self._above:
            joints.append(self._above[link])
            link = self._above[link].parent
        return joints

    def between(self, a: str, b: str) -> Tuple[List[Joint], List[Joint]]:
        """The joints from each link up to the lowest link above both, which move one of them alone."""
        up_a, up_b = self._joints_above(a), self._joints_above(b)
        while up_a and up_b and up_a[-1] is up_b[-1]:
            up_a.pop()
            up_b.pop()
        return up_a, up_b

    def _leader(self, joint: Joint) -> Joint:
        """The joint whose position decides that of this one."""
        return joint if joint.mimic is None else self._model.joints[joint.mimic]

    def ranges(self, joints: Sequence[Joint]) -> Ranges:
        """The limits of the positions that move these joints, in the robot's order."""
        leading = {self._leader(joint).name for joint in joints if joint.kind != "fixed"}
        return {joint.name: (-_TURN, _TURN) if math.isinf(joint.lower) else (joint.lower, joint.upper)
                for joint in self._model.joints.values() if joint.name in leading and joint.kind != "fixed"}

    def unlimited(self, joints: Sequence[Joint]) -> Optional[str]:
        """A joint that moves without limits, or None."""
        return next((joint.name for joint in joints if joint.kind in ("planar", "floating")), None)

    def scene(self, pair: Tuple[str, str], ranges: Ranges) -> document.Document:
        """The two links, with the positions between them as parameters."""
        bodies: List[document.Document] = []
        for link, joints in zip(pair, self.between(*pair)):
            maps = [stage for joint in joints for stage in self._maps(joint)]
            bodies.append({"name": link, "surfaces": self._surfaces[link], "maps": maps})
        return {"time": [0.0, 0.0], "parameters": {name: list(ends) for name, ends in ranges.items()},
                "bodies": bodies, "ignore": []}

    def _maps(self, joint: Joint) -> List[Stage]:
        leader = self._leader(joint)
        if joint.kind == "fixed":
            return []
        follows = Following(leader.name) if joint is leader else \
            Following(leader.name, joint.factor, joint.offset)
        if leader.kind == "fixed":  # which stays at 0
            follows = Following("time", 0.0, joint.offset)
        return maps_of_hinge(joint, self._frames[joint.child], follows)


def check_pair(links: Links, pair: Tuple[str, str], reason: Optional[str], limits: Limits) -> LinkPair:
    """Searches for a contact of two links over all positions, and if there is one for where there is none."""
    up_a, up_b = links.between(*pair)
    unlimited = links.unlimited([*up_a, *up_b])
    if unlimited is not None:
        return LinkPair(pair, reason, "undecided", {}, None, 0.0, 0, 0.0, f"joint {unlimited} has no limits")
    started, ranges = time.monotonic(), links.ranges([*up_a, *up_b])
    state, found = _ask(links, pair, ranges, limits, seeks=True)
    verdict = _verdict(found, state.values)
    free = None
    if verdict == "collides" and state.values is not None and 0 < len(ranges) <= _FREE_JOINTS:
        free = _free_ranges(links, pair, ranges, limits.less(time.monotonic() - started), [state.values])
    return LinkPair(pair, reason, verdict, ranges, state.values, state.proved, found.pairs,
                    time.monotonic() - started, found.reason if verdict == "undecided" else None, free)


class _Seeker:
    """Looks for positions that touch once a survey has taken some boxes; it is over when some are found."""

    def __init__(self, scene: Handle, ranges: Ranges, settings: Settings):
        self._scene, self._ranges, self._settings, self._looks = scene, ranges, settings, 0
        self.found: Optional[Dict[str, float]] = None

    def __call__(self) -> bool:
        self._looks += 1
        if self._looks == _LOOK_AFTER:
            gamma = _GAMMA if self._settings.gamma is None else self._settings.gamma
            self.found = _seek.touching(self._ranges, self._distance, gamma)
        return self.found is not None

    def _distance(self, positions: Sequence[float]) -> float:
        """An upper bound at these positions, of a rough bracket."""
        with Survey(self._scene, self._settings, Wanted(tolerance=0.1),
                    ranges=[(x, x) for x in positions]) as survey:
            survey.run()
            return float(survey.clearance().upper)


def _ask(links: Links, pair: Tuple[str, str], ranges: Ranges, limits: Limits,
         seeks: bool = False) -> Tuple[State, Result]:
    scene = scene_of(links.scene(pair, ranges), f"{pair[0]} and {pair[1]}")
    settings = Settings(gamma=limits.gamma, max_seconds=limits.max_seconds, max_pairs=limits.max_pairs)
    with Survey(scene._handle, settings, any=True) as survey:
        seeker = _Seeker(scene._handle, ranges, settings)
        state = survey.run(seeker) if seeks else survey.run()
        if state.values is None and seeker.found is not None:
            state = state._replace(values=seeker.found)
        return state, result_of(scene.bodies, survey.result())


def _verdict(found: Result, positions: Optional[Mapping[str, float]]) -> Verdict:
    if found.verdict == "clear":
        return "never"
    return "collides" if found.verdict == "contact" or positions is not None else "undecided"


def _free_ranges(links: Links, pair: Tuple[str, str], ranges: Ranges, limits: Limits,
                 met: List[Dict[str, float]]) -> Dict[str, List[Tuple[float, float]]]:
    """Halves the range of each joint until a part is free, or small. `met` are positions where the links
    touch: a part that holds one is not asked about, and those that are found are added."""
    until = time.monotonic() + limits.max_seconds
    found = {}
    for name, (lo, hi) in ranges.items():
        ends = [lo + (hi - lo) * k / _PARTS for k in range(_PARTS)] + [hi]
        free: List[Tuple[float, float]] = []
        waiting = [(0, _PARTS)]
        while waiting and time.monotonic() < until:
            first, last = waiting.pop()
            part = ends[first], ends[last]
            if not any(part[0] <= positions[name] <= part[1] for positions in met):
                left = Limits(limits.gamma, max(until - time.monotonic(), 1e-9), _PART_PAIRS)
                state, answer = _ask(links, pair, {**ranges, name: part}, left)
                if _verdict(answer, state.values) == "never":
                    free[-1:] = [(free[-1][0], part[1])] if free and free[-1][1] == part[0] else [*free[-1:], part]
                    continue
                met += [state.values] if state.values is not None else []
            if last - first > 1:
                middle = (first + last) // 2
                waiting += [(middle, last), (first, middle)]
        if free:
            found[name] = free
    return found
