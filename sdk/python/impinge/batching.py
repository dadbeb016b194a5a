# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Many scenes, on all processors."""

import threading
from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Callable, Deque, Iterable, Iterator, Optional, Sequence

from . import _values as values
from .results import Progress, Result
from .scene import Scene


def batch(scenes: Iterable[Scene], *, threads: Optional[int] = None,
          time: Optional[Sequence[float]] = None, gamma: Optional[float] = None,
          gamma_clear: Optional[float] = None, max_pairs: Optional[int] = None,
          max_seconds: Optional[float] = None, max_bytes: Optional[int] = None,
          audit: Optional[bool] = None) -> Iterator[Result]:
    """Solves scenes on so many threads (all processors); results in order, as they come. Of `scenes`
    only as many are taken ahead as keep the threads busy. Closing the iterator, or Ctrl-C, ends the
    questions that run. The options are those of `Scene.solve`, for each scene."""
    ended = threading.Event()

    def go_on(_: Progress) -> bool:
        return not ended.is_set()

    def solve(scene: Scene) -> Result:
        return scene.solve(time=time, gamma=gamma, gamma_clear=gamma_clear, max_pairs=max_pairs,
                           max_seconds=max_seconds, max_bytes=max_bytes, audit=audit, progress=go_on)

    count = values.threads(threads)
    return _results(scenes, count, solve, ended)


def _results(scenes: Iterable[Scene], count: int, solve: Callable[[Scene], Result],
             ended: threading.Event) -> Iterator[Result]:
    with ThreadPoolExecutor(max_workers=count) as pool:
        running: Deque["Future[Result]"] = deque()
        try:
            for scene in scenes:
                if not isinstance(scene, Scene):
                    raise values.refuse("scenes", scene, "scenes")
                running.append(pool.submit(solve, scene))
                if len(running) > 2 * count:
                    yield running.popleft().result()
            while running:
                yield running.popleft().result()
        finally:
            ended.set()
            for one in running:
                one.cancel()
