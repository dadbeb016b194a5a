# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Several questions about all values of a scene's parameters: about each pair of bodies, or each slice."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from time import monotonic
from typing import Callable, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple, TypeVar

import numpy

from . import _values as values
from ._handle import Handle
from ._query import ProgressSink, Settings, Wanted
from ._survey import Ranges, Survey, parameters_of, times_of
from .errors import UsageError
from .results import Clearance, Profile, Progress, Requirement, Result, clearance_of, result_of

Answer = TypeVar("Answer")
Pair = Tuple[int, int]

_NO_TIME = 1e-300  # seconds: a limit that ends a survey at once; 0 would be none


class Part(NamedTuple):
    """What one question is about; None: all."""

    bodies: Optional[Pair] = None
    time: Optional[Sequence[float]] = None
    ranges: Optional[Ranges] = None


class Surveys:
    """Each question is a survey of its own, whose answer does not depend on the others; `max_seconds` holds
    for all of them together."""

    def __init__(self, scene: Handle, names: Tuple[str, ...], settings: Settings):
        self._scene, self._names, self._settings = scene, names, settings
        limit = values.number("max_seconds", settings.max_seconds) if settings.max_seconds is not None else 0.0
        self._until = monotonic() + limit if limit > 0 else None
        self._ended = False  # by an exception or by the progress sink
        if callable(settings.progress):
            self._settings = settings._replace(progress=self._telling(settings.progress))

    def _telling(self, sink: ProgressSink) -> ProgressSink:
        """The sink ends all questions, not only the one that calls it."""
        def tell(progress: Progress) -> Optional[bool]:
            self._ended = self._ended or sink(progress) is False
            return not self._ended

        return tell

    def _limited(self, part: Part) -> Settings:
        settings = self._settings
        if part.time is not None:
            settings = settings._replace(time=part.time)
        if self._until is not None:
            settings = settings._replace(max_seconds=max(self._until - monotonic(), _NO_TIME))
        return settings

    def contact(self, part: Part) -> Result:
        """The earliest contact of a part, over all values."""
        with Survey(self._scene, self._limited(part), bodies=part.bodies, ranges=part.ranges) as survey:
            state = survey.run(self._is_ended)
            return replace(result_of(self._names, survey.result(), part.bodies), parameters=state.values,
                           proved=state.proved)

    def clearance(self, part: Part, wanted: Wanted) -> Clearance:
        """The least distance of a part, over all values."""
        with Survey(self._scene, self._limited(part), wanted, bodies=part.bodies,
                    ranges=part.ranges) as survey:
            state = survey.run(self._is_ended)
            return replace(clearance_of(self._names, survey.clearance()), parameters=state.values,
                           proved=state.proved)

    def clearance_within(self, part: Part, wanted: Wanted, within: float) -> Optional[Clearance]:
        """None where the bodies never come so near: first that is decided, of a distance so much larger that
        what a requirement may be answered either way about lies above `within`."""
        near = self.clearance(part, Wanted(required=within * (1 + 1e-5)))
        if near.verdict == "violated":
            return self.clearance(part, wanted)
        return None if near.verdict == "holds" else replace(
            near, required=wanted.required, verdict=None if wanted.required is None else "undecided")

    def _is_ended(self) -> bool:
        return self._ended

    def all(self, parts: Sequence[Part], ask: Callable[[Part], Answer], threads: int) -> List[Answer]:
        """The answers in the order of the parts. An exception, Ctrl-C too, ends those that run."""
        with ThreadPoolExecutor(max_workers=threads) as pool:
            waiting = [pool.submit(ask, part) for part in parts]
            try:
                return [one.result() for one in waiting]
            except BaseException:
                self._ended = True
                for one in waiting:
                    one.cancel()
                raise


def solve_each(surveys: Surveys, pairs: Sequence[Pair]) -> Iterator[Result]:
    """The first contact of each pair, in order of time, then those that stay clear."""
    found = [surveys.contact(Part(bodies=pair)) for pair in pairs]
    found.sort(key=lambda answer: answer.t_lower if answer.verdict != "clear" else float("inf"))
    return iter(found)


def each(surveys: Surveys, pairs: Sequence[Pair], wanted: Wanted, within: Optional[float],
         threads: int) -> List[Clearance]:
    """The clearance of each pair, the least `lower` first, but for those that stay beyond `within`."""
    if within is not None and wanted.required is not None and within < wanted.required:
        raise UsageError(f"within: got {within}, must be at least what is required, {wanted.required}")

    def ask(part: Part) -> Optional[Clearance]:
        if within is None:
            return surveys.clearance(part, wanted)
        return surveys.clearance_within(part, wanted, within)

    answers = surveys.all([Part(bodies=pair) for pair in pairs], ask, threads)
    found = [answer for answer in answers if answer is not None]
    found.sort(key=lambda answer: answer.lower)
    return found


def _slices(span: Tuple[float, float], count: int) -> List[Tuple[float, float]]:
    lo, hi = span
    ends = [lo + (hi - lo) * (k / count) for k in range(count)] + [hi]
    return list(zip(ends, ends[1:]))


def profile(surveys: Surveys, scene: Handle, settings: Settings, wanted: Wanted, over: Optional[str]) -> Profile:
    """The clearance in each slice of time, or of the range of a parameter."""
    count = values.count("slices", wanted.slices)
    if not 1 <= count <= 1000000:
        raise UsageError(f"slices: got {count}, must be from 1 to 1000000")
    known = parameters_of(scene)
    if over is not None and over not in known:
        raise values.refuse("over", over, f"a parameter: {', '.join(known) or 'none'}")
    ends = _slices(times_of(scene, settings) if over is None else known[over], count)
    parts = [Part(time=one) if over is None else
             Part(ranges=tuple(one if name == over else span for name, span in known.items())) for one in ends]
    asked = wanted._replace(slices=None, tolerance=1e-3 if wanted.tolerance is None else wanted.tolerance)
    answers = [surveys.clearance(part, asked) for part in parts]
    verdicts: List[Optional[Requirement]] = [answer.verdict for answer in answers]
    witnesses: List[Optional[Dict[str, float]]] = [answer.parameters for answer in answers]
    column = numpy.array
    return Profile(
        column([one[0] for one in ends]), column([one[1] for one in ends]),
        column([answer.lower for answer in answers]), column([answer.upper for answer in answers]),
        column([float("nan") if answer.t is None else answer.t for answer in answers]),
        tuple(answer.bodies if answer.a is not None else None for answer in answers), tuple(verdicts),
        over, tuple(witnesses))
