# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Scenes, and what they are asked."""

import ctypes as c
import os
import threading
import weakref
from collections import deque
from concurrent.futures import ThreadPoolExecutor
from numbers import Real
from typing import Any, Iterable, Iterator, List, Optional, Sequence, Tuple, Union

import numpy

from . import _library as lib
from .errors import UsageError, check
from .query import ProgressSink, Query
from .registry import Registry
from .results import Clearance, Profile, Result, clearance_of, result_of


class Scene:
    """Bodies in motion. Make one by `Scene.from_file`, `Scene.from_json`, `Scene.from_pair` or a
    `Builder`. Several threads may ask one scene at once; the interpreter's lock is released.

    All questions take `time=(start, end)`, budgets (`max_pairs`, `max_seconds`, `max_bytes`), which
    end them as "undecided", and `progress`: a function that is called with a `Progress` about ten
    times a second, and ends the question, as "undecided", by returning False. An exception that it
    raises, or Ctrl-C, ends the question."""

    def __init__(self, handle: int):
        self.handle = handle
        self._finalizer = weakref.finalize(self, lib.library.imp_scene_free, handle)
        count = lib.library.imp_scene_body_count(handle)
        self.bodies: Tuple[str, ...] = tuple(
            lib.library.imp_scene_body_name(handle, k).decode() for k in range(count))

    @classmethod
    def made(cls, handle: Optional[int], error: lib.Error) -> "Scene":
        """Of what the library answers; for the module itself."""
        if not handle:
            check(error.code, error)
        return cls(handle)

    @classmethod
    def from_file(cls, path: Union[str, os.PathLike]) -> "Scene":
        """A scene file."""
        error = lib.Error()
        handle = lib.library.imp_scene_from_file(Registry.handle(), os.fsencode(path),
                                                 c.byref(error))
        return cls.made(handle, error)

    @classmethod
    def from_json(cls, text: str, name: str = "scene") -> "Scene":
        """The text of a scene file; relative names of files begin at the folder of `name`."""
        data, error = text.encode(), lib.Error()
        handle = lib.library.imp_scene_from_json(Registry.handle(), data, len(data),
                                                 name.encode(), c.byref(error))
        return cls.made(handle, error)

    @classmethod
    def from_pair(cls, a: str, b: str) -> "Scene":
        """Two pipelines, "TYPE name=value ... ! MAP name=value ..."."""
        error = lib.Error()
        handle = lib.library.imp_scene_from_pair(Registry.handle(), a.encode(), b.encode(),
                                                 c.byref(error))
        return cls.made(handle, error)

    def __repr__(self) -> str:
        return f"Scene(bodies={self.bodies!r})"

    def eval(self, body: str, surface: int, points: Any) -> numpy.ndarray:
        """Points of one surface, its maps applied: from rows of (u, v, t) to rows of (x, y, z)."""
        if body not in self.bodies:
            raise UsageError(f"body: got {body!r}, must be one of {', '.join(self.bodies)}")
        p = numpy.ascontiguousarray(points, dtype=numpy.float64).reshape(-1, 3)
        x, error = numpy.empty_like(p), lib.Error()
        check(lib.library.imp_scene_eval(self.handle, self.bodies.index(body), surface, len(p),
                                         p.ctypes.data, x.ctypes.data, None, c.byref(error)), error)
        return x

    # --- The earliest contact ----------------------------------------------------------------

    def solve(self, *, time: Optional[Sequence[float]] = None, gamma: Optional[float] = None,
              clearance: Optional[float] = None, progress: Optional[ProgressSink] = None,
              **budgets: float) -> Result:
        """The earliest contact over the scene's time, or `time`."""
        with Query(self, time, progress, gamma=gamma, clearance=clearance, **budgets) as query:
            return result_of(self.bodies, query.step())

    def solve_each(self, *, time: Optional[Sequence[float]] = None, gamma: Optional[float] = None,
                   clearance: Optional[float] = None, progress: Optional[ProgressSink] = None,
                   **budgets: float) -> Iterator[Result]:
        """The first contact of each pair of bodies, in order of time, each as soon as it is proved; then
        a clear result for each pair that never touches. Where a budget ends the search the last result is
        "undecided", and has no `bodies`."""
        with Query(self, time, progress, gamma=gamma, clearance=clearance, **budgets) as query:
            answer = query.step()
            met = set()
            while answer.verdict == lib.CONTACT or answer.reason == lib.RESOLUTION:
                pair = (answer.a.body, answer.b.body)
                met.add(pair)
                yield result_of(self.bodies, answer, pair)
                query.go_on()
                answer = query.step()
            if answer.verdict != lib.CLEAR:
                yield result_of(self.bodies, answer)
                return
            for pair in self._pairs():
                if pair not in met:
                    yield result_of(self.bodies, answer, pair)

    def refine(self, gammas: Iterable[float], *, time: Optional[Sequence[float]] = None,
               progress: Optional[ProgressSink] = None, **budgets: float) -> Iterator[Result]:
        """The earliest contact at each gamma, the widest first, from one search."""
        widest_first = sorted(gammas, reverse=True)
        if not widest_first:
            return
        with Query(self, time, progress, gamma=widest_first[0], **budgets) as query:
            yield result_of(self.bodies, query.step())
            for gamma in widest_first[1:]:
                query.refine(gamma)
                yield result_of(self.bodies, query.step())

    def _pairs(self) -> Iterator[Tuple[int, int]]:
        for a in range(len(self.bodies)):
            for b in range(a + 1, len(self.bodies)):
                if not lib.library.imp_scene_ignores(self.handle, a, b):
                    yield a, b

    # --- Clearance ------------------------------------------------------------------------------

    def _clearances(self, asked: dict, time: Optional[Sequence[float]],
                    progress: Optional[ProgressSink], budgets: dict) -> List[Clearance]:
        required = asked.get("required")
        if required is not None and not (isinstance(required, Real) and required > 0):
            raise UsageError(f"required: got {required!r}, must be a number > 0")
        with Query(self, time, progress, asked=asked, **budgets) as query:
            query.step()
            return [clearance_of(self.bodies, answer) for answer in query.clearances()]

    def clearance(self, *, required: Optional[float] = None, tolerance: Optional[float] = None,
                  time: Optional[Sequence[float]] = None, progress: Optional[ProgressSink] = None,
                  **budgets: float) -> Clearance:
        """The minimum distance of all bodies over the interval; is the `required` one kept? With
        `required` and no `tolerance` the search ends as soon as that is known."""
        asked = {"required": required, "tolerance": tolerance, "decide": tolerance is None}
        return self._clearances(asked, time, progress, budgets)[0]

    def each(self, *, required: Optional[float] = None, tolerance: Optional[float] = None,
             time: Optional[Sequence[float]] = None, progress: Optional[ProgressSink] = None,
             **budgets: float) -> List[Clearance]:
        """The clearance of every two bodies that do not ignore each other, the tightest first."""
        asked = {"each": True, "required": required, "tolerance": tolerance,
                 "decide": tolerance is None}
        answers = self._clearances(asked, time, progress, budgets)
        return sorted(answers, key=lambda answer: answer.upper)

    def profile(self, slices: int, *, required: Optional[float] = None,
                tolerance: Optional[float] = None, time: Optional[Sequence[float]] = None,
                progress: Optional[ProgressSink] = None, **budgets: float) -> Profile:
        """The clearance in each of so many equal slices of time."""
        asked = {"slices": slices, "required": required, "tolerance": tolerance}
        answers = self._clearances(asked, time, progress, budgets)
        columns = ([getattr(answer, name) for answer in answers]
                   for name in ("t_start", "t_end", "lower", "upper"))
        return Profile(*(numpy.array(column) for column in columns),
                       tuple(answer.verdict for answer in answers))


def batch(scenes: Iterable[Scene], *, threads: Optional[int] = None,
          **options: Any) -> Iterator[Result]:
    """Solves scenes on so many threads (all processors); results in order, as they come. Of `scenes`
    only as many are taken ahead as keep the threads busy. Closing the iterator, or Ctrl-C, ends the
    questions that run."""
    count = threads or os.cpu_count() or 1
    ended = threading.Event()
    with ThreadPoolExecutor(max_workers=count) as pool:
        running: deque = deque()
        try:
            for scene in scenes:
                running.append(pool.submit(scene.solve, **options,
                                           progress=lambda _: not ended.is_set()))
                if len(running) > 2 * count:
                    yield running.popleft().result()
            while running:
                yield running.popleft().result()
        finally:
            ended.set()
            for one in running:
                one.cancel()
