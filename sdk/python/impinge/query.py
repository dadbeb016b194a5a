# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""One question to the library while it is answered."""

import ctypes as c
from time import monotonic
from typing import TYPE_CHECKING, Any, Callable, Iterator, Optional, Sequence

from . import _library as lib
from .errors import UsageError, check
from .results import Progress, progress_of

if TYPE_CHECKING:
    from .scene import Scene

ProgressSink = Callable[[Progress], Optional[bool]]

_PAIRS = 1000  # tested between looks at signals: some milliseconds
_SECONDS = 0.1  # between calls of a progress sink
_OPTIONS = ("gamma", "clearance", "max_pairs", "max_seconds", "max_bytes", "audit")


class Query:
    """A query of libimpinge, freed at the end of its `with`. With `asked` it is one of clearance."""

    def __init__(self, scene: "Scene", time: Optional[Sequence[float]],
                 progress: Optional[ProgressSink], asked: Optional[dict] = None, **given: Any):
        for name in given:
            if name not in _OPTIONS:
                raise TypeError(f"unknown argument {name!r}, must be one of {', '.join(_OPTIONS)}")
        self._scene, self._progress = scene, progress
        options, error = lib.Options(struct_size=c.sizeof(lib.Options)), lib.Error()
        check(lib.library.imp_options_read(scene.handle, c.byref(options), c.byref(error)), error)
        if time is not None:
            options.t_start, options.t_end = time
        _assign(options, given)
        self._handle = self._begin(options, asked, error)

    def _begin(self, options: lib.Options, asked: Optional[dict], error: lib.Error) -> int:
        if asked is None:
            handle = lib.library.imp_query_new(self._scene.handle, c.byref(options), c.byref(error))
        else:
            wanted = lib.ClearanceOptions(struct_size=c.sizeof(lib.ClearanceOptions))
            check(lib.library.imp_clearance_options_read(c.byref(wanted), c.byref(error)), error)
            _assign(wanted, asked)
            handle = lib.library.imp_clearance_new(self._scene.handle, c.byref(options),
                                                   c.byref(wanted), c.byref(error))
        if not handle:
            check(error.code, error)
        return handle

    def __enter__(self) -> "Query":
        return self

    def __exit__(self, *_: Any) -> None:
        lib.library.imp_query_free(self._handle)

    def _read(self) -> lib.Result:
        answer, error = lib.Result(struct_size=c.sizeof(lib.Result)), lib.Error()
        check(lib.library.imp_query_read(self._handle, c.byref(answer), c.byref(error)), error)
        return answer

    def _tell(self, answer: lib.Result) -> None:
        """Tells how far the search is; the sink may end it."""
        bracket = next((k for k in self.clearances() if k.reason == lib.RUNNING), None)
        if self._progress is not None and self._progress(progress_of(answer, bracket)) is False:
            lib.library.imp_query_cancel(self._handle)

    def step(self) -> lib.Result:
        """Goes on until there is an answer, with a look at signals and the clock now and then."""
        error, told = lib.Error(), monotonic()
        while True:
            check(lib.library.imp_query_step(self._handle, _PAIRS, c.byref(error)), error)
            answer = self._read()
            if answer.reason != lib.RUNNING:
                return answer
            if monotonic() - told >= _SECONDS:
                self._tell(answer)
                told = monotonic()

    def go_on(self) -> None:
        """Without the two bodies of the answer."""
        error = lib.Error()
        check(lib.library.imp_query_pass(self._handle, c.byref(error)), error)

    def refine(self, gamma: float) -> None:
        """At a smaller gamma."""
        error = lib.Error()
        check(lib.library.imp_query_refine(self._handle, gamma, -1, c.byref(error)), error)

    def clearances(self) -> Iterator[lib.Clearance]:
        """All answers of a question of clearance."""
        for k in range(lib.library.imp_clearance_count(self._handle)):
            answer, error = lib.Clearance(struct_size=c.sizeof(lib.Clearance)), lib.Error()
            check(lib.library.imp_clearance_read(self._handle, k, c.byref(answer), c.byref(error)),
                  error)
            yield answer


def _assign(to: c.Structure, given: dict) -> None:
    for name, value in given.items():
        if value is None:
            continue
        try:
            setattr(to, name, value)
        except TypeError:
            raise UsageError(f"{name}: got {value!r}, must be a number") from None
