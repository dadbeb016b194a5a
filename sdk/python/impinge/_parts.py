# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""A question about each pair of bodies, answered by several threads."""

import itertools
import threading
from time import monotonic
from typing import Dict, Iterable, List, Optional, Tuple

from . import _library as lib
from ._query import ProgressSink, Query
from .results import Clearance, Progress, clearance_of, clearance_without_part

_WAIT = 0.1  # seconds between calls of a progress sink

Pair = Tuple[int, int]


class Parts:
    """The parts of a question of clearance, one for each pair of bodies that are ever both there. What is
    answered of a part does not depend on the others, and so not on the number of threads."""

    def __init__(self, whole: Query, names: Tuple[str, ...], required: Optional[float],
                 progress: Optional[ProgressSink]):
        self._whole, self._names, self._progress = whole, names, progress
        self._required = required
        self._found: Dict[Pair, Clearance] = {}
        self._cancelled = False  # the parts that are left end as undecided
        self._failure: Optional[BaseException] = None  # the parts that are left are dropped

    def answers(self, pairs: Iterable[Pair], threads: int) -> List[Clearance]:
        """One for each pair of bodies, in the order of `pairs`."""
        self._run(self._whole.divide(), threads)
        whole = self._whole.result()
        return [self._found.get(pair) or clearance_without_part(self._names, whole, pair, self._required)
                for pair in pairs]

    def _run(self, count: int, threads: int) -> None:
        start, indices = monotonic(), itertools.count()
        members = [threading.Thread(target=self._work, args=(indices, count), daemon=True)
                   for _ in range(min(threads, count))]
        started: List[threading.Thread] = []
        try:
            for member in members:
                member.start()
                started.append(member)
            for member in started:
                while member.is_alive():
                    member.join(_WAIT)
                    self._tell(monotonic() - start)
        except BaseException as failure:
            self._failure = failure
        for member in started:
            member.join()
        if self._failure is not None:
            raise self._failure

    def _work(self, indices: "itertools.count[int]", count: int) -> None:
        try:
            for index in indices:
                if index >= count or self._failure is not None:
                    return
                self._answer(index)
        except BaseException as failure:
            self._failure = self._failure or failure

    def _answer(self, index: int) -> None:
        with self._whole.part(index) as part:
            if self._cancelled:
                part.cancel()
            while part.step_once().reason == lib.RUNNING and self._failure is None:
                if self._cancelled:
                    part.cancel()
            answer = part.clearance(0)
            self._found[answer.body[0], answer.body[1]] = clearance_of(self._names, answer)

    def _tell(self, seconds: float) -> None:
        """Tells what is found; the sink may end the search."""
        if self._progress is None:
            return
        found = list(self._found.values())
        upper = min((answer.upper for answer in found), default=None)
        pairs = sum(answer.pairs for answer in found)
        if self._progress(Progress(None, pairs, seconds, None, upper)) is False:
            self._cancelled = True
