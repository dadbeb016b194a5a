# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Answers, as plain objects."""

from dataclasses import dataclass
from typing import Optional, Tuple

import numpy

from . import _library as lib

_VERDICTS = ("clear", "contact", "undecided")
_REASONS = (None, "no-time", "no-pairs", "pairs", "seconds", "memory", "cancelled", "resolution",
            "running", "decided")
_REQUIREMENTS = (None, "holds", "violated", "undecided")


@dataclass(frozen=True)
class Side:
    """One point of a witness."""

    body: str
    surface: int
    piece: int
    u: float
    v: float
    point: Tuple[float, float, float]


@dataclass(frozen=True)
class Result:
    """The earliest contact. Before `t_lower` no points of two bodies are nearer than `gamma_clear`:
    that is proved, whatever the verdict ("contact", "clear" or "undecided")."""

    verdict: str
    reason: Optional[str]
    t: Optional[float]
    t_lower: float
    gap: Optional[float]
    gamma: float
    gamma_clear: float
    a: Optional[Side]
    b: Optional[Side]
    normal: Optional[Tuple[float, float, float]]
    pairs: int
    seconds: float
    at_rest: bool = False  # contact of two surfaces that do not move: they overlap
    bodies: Optional[Tuple[str, str]] = None  # of `solve_each`

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
    be at most `upper` at the witness `t`, `a`, `b`. With a required distance, `verdict` is "holds",
    "violated" or "undecided"; with `reason` "decided" the bracket is as it was when that was
    known."""

    lower: float
    upper: float
    t: Optional[float]
    a: Optional[Side]
    b: Optional[Side]
    normal: Optional[Tuple[float, float, float]]
    verdict: Optional[str]
    required: Optional[float]
    t_violated: Optional[float]
    t_start: float
    t_end: float
    bodies: Optional[Tuple[str, str]]
    reason: Optional[str]
    pairs: int


@dataclass(frozen=True)
class Profile:
    """Clearance over slices of time, as arrays of one number for each slice."""

    t0: numpy.ndarray
    t1: numpy.ndarray
    lower: numpy.ndarray
    upper: numpy.ndarray
    verdict: Tuple[Optional[str], ...]


def _number(x: float) -> Optional[float]:
    return None if x != x else x


def _side(names: Tuple[str, ...], side: lib.Side) -> Side:
    return Side(names[side.body], side.surface, side.piece, side.u, side.v, tuple(side.point))


def progress_of(r: lib.Result, bracket: Optional[lib.Clearance]) -> Progress:
    """From the C structs; `bracket` of the least distance that is sought now, if one is."""
    if bracket is None:
        return Progress(r.t_lower, r.stats.pairs, r.stats.seconds, None, None)
    return Progress(None, r.stats.pairs, r.stats.seconds, bracket.lower, bracket.upper)


def result_of(names: Tuple[str, ...], r: lib.Result,
              pair: Optional[Tuple[int, int]] = None) -> Result:
    """From the C struct; `names` are those of the bodies."""
    contact = _VERDICTS[r.verdict] == "contact"
    return Result(
        verdict=_VERDICTS[r.verdict], reason=_REASONS[r.reason], t=_number(r.t),
        t_lower=r.t_lower, gap=_number(r.gap), gamma=r.gamma, gamma_clear=r.gamma_clear,
        a=_side(names, r.a) if contact else None, b=_side(names, r.b) if contact else None,
        normal=tuple(r.normal) if r.has_normal else None, pairs=r.stats.pairs,
        seconds=r.stats.seconds, at_rest=r.at_rest,
        bodies=(names[pair[0]], names[pair[1]]) if pair is not None else None)


def clearance_of(names: Tuple[str, ...], k: lib.Clearance) -> Clearance:
    """From the C struct; `names` are those of the bodies."""
    pair = k.body[0] < len(names) and k.body[1] < len(names)
    return Clearance(
        lower=k.lower, upper=k.upper, t=_number(k.t),
        a=_side(names, k.a) if k.has_witness else None,
        b=_side(names, k.b) if k.has_witness else None,
        normal=tuple(k.normal) if k.has_normal else None, verdict=_REQUIREMENTS[k.verdict],
        required=k.required if k.required > 0 else None, t_violated=_number(k.t_violated),
        t_start=k.t_start, t_end=k.t_end,
        bodies=(names[k.body[0]], names[k.body[1]]) if pair else None, reason=_REASONS[k.reason],
        pairs=k.stats.pairs)
