# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""A question about each pair of bodies, answered by several threads."""

import itertools
import threading
from time import monotonic
from typing import Dict, Iterable, List, Optional, Tuple

from . import _library as lib
from ._query import ProgressSink, Query
from .results import Clearance, Progress, Reason, clearance_of, clearance_without_part, reason_of

_WAIT = 0.1  # seconds between calls of a progress sink

Pair = Tuple[int, int]


class Parts:
    """The parts of a question of clearance, one for each pair of bodies that are ever both there. What is
    answered of a part does not depend on the others, and so not on the number of threads."""

    def __init__(self, whole: Query, names: Tuple[str, ...], required: Optional[float],
                 within: Optional[float], progress: Optional[ProgressSink]):
        self._whole, self._names, self._progress = whole, names, progress
        self._required, self._within = required, within
        self._found: Dict[Pair, Clearance] = {}
        self._cancelled = False  # parts that are begun end as undecided, others are not begun
        self._ended: Optional[Reason] = None  # why parts were not begun
        self._failure: Optional[BaseException] = None  # the parts that are left are dropped

    def answers(self, pairs: Iterable[Pair], threads: int) -> List[Clearance]:
        """One for each of `pairs`, but for those beyond `within`, by `lower`, then in their order. Where not
        all were examined, the last one is for the others."""
        self._run(self._whole.divide(), threads)
        whole = self._whole.result()
        ended = reason_of(whole) if whole.verdict == lib.UNDECIDED else self._ended
        if ended is None and self._within is None:
            found = [self._found.get(pair) or
                     clearance_without_part(self._names, whole, pair, self._required) for pair in pairs]
        else:
            found = [answer for _, answer in sorted(self._found.items())
                     if self._within is None or answer.lower < self._within]
        found.sort(key=lambda answer: answer.lower)
        if ended is not None:
            found.append(clearance_without_part(self._names, whole, None, self._required, ended))
        return found

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
                if self._cancelled or monotonic() >= self._whole.until:
                    self._ended = "cancelled" if self._cancelled else "seconds"
                    return
                self._answer(index)
        except BaseException as failure:
            self._failure = self._failure or failure

    def _answer(self, index: int) -> None:
        with self._whole.part(index) as part:
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
