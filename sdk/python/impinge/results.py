# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Answers, as plain objects. Lengths are in the scene's unit of length, times in its unit of time."""

import ctypes as c
from dataclasses import dataclass, field, fields
from typing import Any, Dict, Iterable, List, Literal, Optional, Tuple

import numpy
from numpy.typing import NDArray

from . import _library as lib
from ._values import Floats

Verdict = Literal["clear", "contact", "undecided"]
Requirement = Literal["holds", "violated", "undecided"]
Reason = Literal["no-time", "no-pairs", "pairs", "seconds", "memory", "cancelled", "resolution",
                 "running", "decided"]
Kind = Literal["touch", "inside"]
Vector = Tuple[float, float, float]
Bodies = Tuple[str, str]

_VERDICTS: Tuple[Verdict, ...] = ("clear", "contact", "undecided")
_REASONS: Tuple[Optional[Reason], ...] = (
    None, "no-time", "no-pairs", "pairs", "seconds", "memory", "cancelled", "resolution", "running",
    "decided")
_KINDS: Tuple[Kind, ...] = ("touch", "inside")
_REQUIREMENTS: Tuple[Optional[Requirement], ...] = (None, "holds", "violated", "undecided")


@dataclass(frozen=True)
class Side:
    """One point of a witness: where it is on its surface, and in the world. Of a solid body that something
    is inside of, `u` and `v` are NaN, and the point is the other side's."""

    body: str
    surface: int
    piece: int
    u: float
    v: float
    point: Vector


@dataclass(frozen=True)
class Stats:
    """What a search cost: regions made, the most pairs of regions that waited at once, and the most bytes of
    trees and waiting pairs."""

    seconds: float
    pairs: int
    nodes: int
    peak_heap: int
    witness_searches: int
    bytes: int


@dataclass(frozen=True)
class Result:
    """The earliest contact from `t_start` to `t_end`. Before `t_lower` no points of two bodies are nearer
    than `gamma_clear`: that is proved, whatever the verdict. `t`, `gap` (the distance of the two points),
    `a` and `b` are None unless the verdict is "contact"; `normal` points from a to b."""

    verdict: Verdict
    reason: Optional[Reason]
    t: Optional[float]
    t_lower: float
    gap: Optional[float]
    gamma: float
    gamma_clear: float
    a: Optional[Side]
    b: Optional[Side]
    normal: Optional[Vector]
    pairs: int
    seconds: float
    t_start: float
    t_end: float
    at_rest: bool = False  # contact of two surfaces that do not move: they overlap
    bodies: Optional[Bodies] = None  # of `solve_each`, or those that touch
    t_examined: Optional[Tuple[float, float]] = None  # when two surfaces that are tested are there
    stats: Optional[Stats] = field(default=None, compare=False)
    kind: Optional[Kind] = None  # of a contact; "inside": one is inside the other, which is solid
    parameters: Optional[Dict[str, float]] = None  # of a scene with parameters: values at which it happens
    proved: Optional[float] = None  # of a scene with parameters: the share of all values that is proved

    def time_left(self, t: float) -> float:
        """Time left from t until contact; negative when that is past, infinite when clear."""
        if self.verdict == "clear":
            return float("inf")
        return (self.t if self.t is not None else self.t_lower) - t


@dataclass(frozen=True)
class Progress:
    """How far a question has come: proved up to `t_lower`, or a bracket of the least distance."""

    t_lower: Optional[float]
    pairs: int
    seconds: float
    lower: Optional[float]
    upper: Optional[float]


@dataclass(frozen=True)
class Clearance:
    """The minimum distance from `t_start` to `t_end`: proved to be at least `lower`, and evaluated to
    be at most `upper` at the witness `t`, `a`, `b` (None: nothing was evaluated). With a required
    distance, `verdict` tells whether it is kept; with `reason` "decided" the bracket is as it was when
    that was known. `bodies` are those of the witness, or those that were asked about. `t_violated` is the
    earliest violation, at the points `a_violated` and `b_violated`, which are `gap_violated` apart."""

    lower: float
    upper: float
    t: Optional[float]
    a: Optional[Side]
    b: Optional[Side]
    normal: Optional[Vector]
    verdict: Optional[Requirement]
    required: Optional[float]
    t_violated: Optional[float]
    t_start: float
    t_end: float
    bodies: Optional[Bodies]
    reason: Optional[Reason]
    pairs: int
    gap_violated: Optional[float] = None
    a_violated: Optional[Side] = None
    b_violated: Optional[Side] = None
    stats: Optional[Stats] = field(default=None, compare=False)
    kind: Optional[Kind] = None  # of the witness; "inside": one is inside the other, which is solid
    parameters: Optional[Dict[str, float]] = None  # of a scene with parameters: values of the witness
    proved: Optional[float] = None  # of a scene with parameters: the share of all values that is proved


@dataclass(frozen=True, eq=False)
class Profile:
    """Clearance over slices of time, one element for each slice: it begins at `t0` and ends at `t1`; the
    bracket `lower`, `upper`; the time `t` of the witness (NaN: none) and its two bodies (None: none); the
    verdict about a required distance. Where a limit ends the search the last element, with `lower` 0, is for
    all of the time that is left. Of a scene with parameters each slice is about all their values, and
    `parameters` are those of its witness; with `over`, slices are those of the range of this parameter, and
    each of them is there, whatever limit came."""

    t0: Floats
    t1: Floats
    lower: Floats
    upper: Floats
    t: Floats
    bodies: Tuple[Optional[Bodies], ...]
    verdict: Tuple[Optional[Requirement], ...]
    over: Optional[str] = None
    parameters: Tuple[Optional[Dict[str, float]], ...] = ()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Profile):
            return NotImplemented
        return all(_same(getattr(self, field.name), getattr(other, field.name))
                   for field in fields(self))

    __hash__ = None  # type: ignore[assignment]  # arrays can be changed

    def __len__(self) -> int:
        return len(self.t0)


def _same(x: object, y: object) -> bool:
    if isinstance(x, numpy.ndarray) and isinstance(y, numpy.ndarray):
        return numpy.array_equal(x, y, equal_nan=True)
    return bool(x == y)


# --- From the structs of C -------------------------------------------------------------------


def _number(x: float) -> Optional[float]:
    return None if x != x else x


def _vector(v: "c.Array[c.c_double]") -> Vector:
    return v[0], v[1], v[2]


def _side(names: Tuple[str, ...], side: lib.Side) -> Side:
    return Side(names[side.body], side.surface, side.piece, side.u, side.v, _vector(side.point))


def _stats(stats: lib.Stats) -> Stats:
    return Stats(*(getattr(stats, one.name) for one in fields(Stats)))


def progress_of(r: lib.Result, bracket: Optional[lib.Clearance]) -> Progress:
    """From the C structs; `bracket` of the least distance that is sought now, if one is."""
    if bracket is None:
        return Progress(r.t_lower, r.stats.pairs, r.stats.seconds, None, None)
    return Progress(None, r.stats.pairs, r.stats.seconds, bracket.lower, bracket.upper)


def result_of(names: Tuple[str, ...], r: lib.Result,
              pair: Optional[Tuple[int, int]] = None) -> Result:
    """From the C struct; `names` are those of the bodies."""
    contact = r.verdict == lib.CONTACT
    if pair is None and contact:
        pair = (r.a.body, r.b.body)
    return Result(
        verdict=_VERDICTS[r.verdict], reason=_REASONS[r.reason], t=_number(r.t),
        t_lower=r.t_lower, gap=_number(r.gap), gamma=r.gamma, gamma_clear=r.gamma_clear,
        a=_side(names, r.a) if contact else None, b=_side(names, r.b) if contact else None,
        normal=_vector(r.normal) if r.has_normal else None, pairs=r.stats.pairs,
        seconds=r.stats.seconds, t_start=r.t_start, t_end=r.t_end, at_rest=r.at_rest,
        bodies=(names[pair[0]], names[pair[1]]) if pair is not None else None,
        t_examined=None if r.t_examined[0] != r.t_examined[0] else (r.t_examined[0], r.t_examined[1]),
        stats=_stats(r.stats),
        kind=_KINDS[r.kind] if contact else None)


def reason_of(r: lib.Result) -> Optional[Reason]:
    """Why the query that the C struct is of has ended."""
    reason: Optional[Reason] = _REASONS[r.reason]
    return reason


def clearance_of(names: Tuple[str, ...], k: lib.Clearance) -> Clearance:
    """From the C struct; `names` are those of the bodies."""
    violated = k.t_violated == k.t_violated
    pair = (k.a.body, k.b.body) if k.has_witness else (k.body[0], k.body[1])
    known = pair[0] < len(names) and pair[1] < len(names)
    return Clearance(
        lower=k.lower, upper=k.upper, t=_number(k.t),
        a=_side(names, k.a) if k.has_witness else None,
        b=_side(names, k.b) if k.has_witness else None,
        normal=_vector(k.normal) if k.has_normal else None, verdict=_REQUIREMENTS[k.verdict],
        required=k.required if k.required > 0 else None, t_violated=_number(k.t_violated),
        t_start=k.t_start, t_end=k.t_end,
        bodies=(names[pair[0]], names[pair[1]]) if known else None, reason=_REASONS[k.reason],
        pairs=k.stats.pairs, gap_violated=_number(k.gap_violated) if violated else None,
        a_violated=_side(names, k.a_violated) if violated else None,
        b_violated=_side(names, k.b_violated) if violated else None, stats=_stats(k.stats),
        kind=_KINDS[k.kind] if k.has_witness else None)


_COLUMNS = ("t_start", "t_end", "lower", "upper", "t")


def _listed(column: Any) -> List[Any]:
    """A column of a structured array, whose kind NumPy's types do not tell."""
    return list(column.tolist())


def _bodies_of(names: Tuple[str, ...], chunk: "NDArray[numpy.void]") -> List[Optional[Bodies]]:
    """The two bodies of each witness, in tuples that slices share."""
    pairs = list(zip(_listed(chunk["has_witness"]), _listed(chunk["a"]["body"]),
                     _listed(chunk["b"]["body"])))
    shared = {pair: (names[pair[1]], names[pair[2]]) if pair[0] else None for pair in set(pairs)}
    return [shared[pair] for pair in pairs]


def profile_of(names: Tuple[str, ...], chunks: Iterable["NDArray[numpy.void]"]) -> Profile:
    """From the C structs of its slices, as structured arrays."""
    columns: List[List[Floats]] = [[] for _ in _COLUMNS]
    bodies: List[Optional[Bodies]] = []
    verdicts: List[Optional[Requirement]] = []
    for chunk in chunks:
        for column, name in zip(columns, _COLUMNS):
            column.append(chunk[name].copy())
        bodies += _bodies_of(names, chunk)
        verdicts += (_REQUIREMENTS[verdict] for verdict in _listed(chunk["verdict"]))
    t0, t1, lower, upper, t = (numpy.concatenate(column) for column in columns)
    return Profile(t0, t1, lower, upper, t, tuple(bodies), tuple(verdicts))


def clearance_without_part(names: Tuple[str, ...], whole: lib.Result, pair: Optional[Tuple[int, int]],
                           required: Optional[float], ended: Optional[Reason] = None) -> Clearance:
    """Of two bodies that are never both there; or, `ended` by a limit, of all pairs of bodies that were not
    examined. `whole` is what is known of the divided question."""
    verdict: Requirement = "holds" if ended is None else "undecided"
    return Clearance(
        lower=float("inf") if ended is None else 0.0, upper=float("inf"), t=None, a=None, b=None, normal=None,
        verdict=verdict if required is not None else None, required=required,
        t_violated=None, t_start=whole.t_start, t_end=whole.t_end,
        bodies=(names[pair[0]], names[pair[1]]) if pair is not None else None,
        reason="no-time" if ended is None else ended, pairs=0)
