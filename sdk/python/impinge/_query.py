# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""One question to the library while it is answered."""

import ctypes as c
from time import monotonic
from typing import Any, Callable, Iterator, List, NamedTuple, Optional, Sequence, Tuple

import numpy
from numpy.typing import NDArray

from . import _library as lib
from . import _values as values
from ._crew import Crew
from ._handle import Handle
from .errors import check
from .results import Progress, progress_of

ProgressSink = Callable[[Progress], Optional[bool]]

_PAIRS = 1000  # tested between looks at signals: some milliseconds
_CHUNK = 4096  # answers read into one array: about 2 MB
SECONDS = 0.1  # between calls of a progress sink


class Settings(NamedTuple):
    """What every question takes; None: as the scene or the library says."""

    time: Optional[Sequence[float]] = None
    gamma: Optional[float] = None
    gamma_clear: Optional[float] = None
    max_pairs: Optional[int] = None
    max_seconds: Optional[float] = None
    max_bytes: Optional[int] = None
    audit: Optional[bool] = None
    progress: Optional[ProgressSink] = None
    threads: Optional[int] = None  # None: the caller's alone

    def write(self, options: lib.Options) -> None:
        """Checks them, and puts those that are given into the struct."""
        if self.time is not None:
            options.t_start, options.t_end = values.interval("time", self.time)
        for name in ("gamma", "gamma_clear", "max_seconds"):
            given = getattr(self, name)
            if given is not None:
                setattr(options, name, values.number(name, given))
        for name in ("max_pairs", "max_bytes"):
            given = getattr(self, name)
            if given is not None:
                setattr(options, name, values.count(name, given))
        if self.audit is not None:
            if not isinstance(self.audit, bool):
                raise values.refuse("audit", self.audit, "True or False")
            options.audit = self.audit
        if self.progress is not None and not callable(self.progress):
            raise values.refuse("progress", self.progress, "a function that takes a Progress")


class Wanted(NamedTuple):
    """What a question of clearance takes besides."""

    required: Optional[float] = None
    tolerance: Optional[float] = None
    slices: Optional[int] = None
    within: Optional[float] = None

    def write(self, options: lib.ClearanceOptions) -> None:
        """Checks it, and puts what is given into the struct. A verdict alone ends a search if neither a
        bracket nor slices are asked for."""
        for name in ("required", "within"):
            given = getattr(self, name)
            if given is not None:
                length = values.number(name, given, "a number > 0")
                if not 0 < length < float("inf"):
                    raise values.refuse(name, given, "a number > 0")
                setattr(options, name, length)
        if self.tolerance is not None:
            options.tolerance = values.number("tolerance", self.tolerance)
        if self.slices is not None:
            options.slices = values.count("slices", self.slices)
        options.decide = self.tolerance is None and self.slices is None


def options_of(scene: Handle, settings: Settings) -> Tuple[lib.Options, Optional[Crew]]:
    """The options of a query or a survey; the threads that it borrows must live as long as it does."""
    options, error, crew = lib.Options(struct_size=c.sizeof(lib.Options)), lib.Error(), None
    code = lib.library.imp_options_get_default(scene.address, c.byref(options), c.byref(error))
    if settings.time is None:
        check(code, error)
    settings.write(options)
    if settings.threads is not None:
        crew = Crew(values.threads(settings.threads))
        options.parallel = c.cast(crew.function, c.c_void_p)
    return options, crew


def certificate_of(scene: Handle, source: Optional[str], write: Callable[..., int], address: Any) -> bytes:
    """What `write` writes of a query or a survey. `source`: SHA-256 of the scene's file, if it is of one."""
    parts: List[bytes] = []
    error = lib.Error()
    types = lib.library.imp_scene_sources(scene.address, c.byref(error))
    if not types:
        check(error.code, error)
    stated = c.string_at(types)
    lib.free(types)
    if source is not None:
        stated = b"scene " + source.encode() + b"\n" + stated
    sink = lib.ProofSink(lambda _, data, size: parts.append(c.string_at(data, size)))
    check(write(address, stated, sink, None, c.byref(error)), error)
    return b"".join(parts)


class Query:
    """A query of libimpinge, freed at the end of its `with`. With `wanted` it is one of clearance."""

    def __init__(self, scene: Handle, settings: Settings, wanted: Optional[Wanted] = None):
        options, self._crew = options_of(scene, settings)
        error = lib.Error()
        limit = options.max_seconds
        self.until = monotonic() + limit if limit > 0 else float("inf")  # when its time is over
        if wanted is None:
            made = lib.library.imp_query_new(scene.address, c.byref(options), c.byref(error))
        else:
            asked = lib.ClearanceOptions(struct_size=c.sizeof(lib.ClearanceOptions))
            check(lib.library.imp_clearance_options_get_default(c.byref(asked), c.byref(error)), error)
            wanted.write(asked)
            made = lib.library.imp_clearance_new(scene.address, c.byref(options), c.byref(asked),
                                                 c.byref(error))
        self._begin(scene, made, error, settings.progress)

    def _begin(self, scene: Handle, made: Optional[int], error: lib.Error,
               progress: Optional[ProgressSink]) -> None:
        if not made:
            check(error.code, error)
        self._address, self._scene, self._progress = made, scene, progress
        self._answered = 0  # answers of clearance before this one are there
        scene.users.add(self)

    def close(self) -> None:
        """Frees it; nothing may be asked then."""
        address, self._address = self._address, None
        if address is not None:
            self._scene.users.discard(self)
            lib.library.imp_query_free(address)

    _address: Optional[int] = None

    def __enter__(self) -> "Query":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __del__(self) -> None:
        self.close()

    # --- Search -------------------------------------------------------------------------------

    def result(self) -> lib.Result:
        """How far it has come."""
        answer, error = lib.Result(struct_size=c.sizeof(lib.Result)), lib.Error()
        check(lib.library.imp_query_get_result(self._address, c.byref(answer), c.byref(error)), error)
        return answer

    def _running(self) -> Optional[lib.Clearance]:
        """The clearance that is sought now; they are found in order."""
        count = lib.library.imp_clearance_count(self._address)
        while self._answered < count:
            answer = self.clearance(self._answered)
            if answer.reason == lib.RUNNING:
                return answer
            self._answered += 1
        return None

    def _tell(self, answer: lib.Result) -> None:
        """Tells how far the search is; the sink may end it."""
        if self._progress is not None and self._progress(progress_of(answer, self._running())) is False:
            self.cancel()

    def cancel(self) -> None:
        """Ends the next step as undecided."""
        lib.library.imp_query_cancel(self._address)

    def step(self) -> lib.Result:
        """Goes on until there is an answer, with a look at signals and the clock now and then."""
        told = monotonic()
        while True:
            answer = self.step_once()
            if answer.reason != lib.RUNNING:
                return answer
            if monotonic() - told >= SECONDS:
                self._tell(answer)
                told = monotonic()

    def step_once(self) -> lib.Result:
        """Goes on for some milliseconds."""
        error = lib.Error()
        check(lib.library.imp_query_step(self._address, _PAIRS, c.byref(error)), error)
        return self.result()

    def go_on(self) -> None:
        """Without the two bodies of the answer."""
        error = lib.Error()
        check(lib.library.imp_query_exclude_pair(self._address, c.byref(error)), error)

    def refine(self, gamma: float) -> None:
        """At a smaller gamma."""
        error = lib.Error()
        check(lib.library.imp_query_refine(self._address, gamma, -1, c.byref(error)), error)

    # --- Proof ----------------------------------------------------------------------------------

    def keep_proof(self) -> None:
        """Before the first step: keeps what its certificate needs."""
        error = lib.Error()
        check(lib.library.imp_query_keep_proof(self._address, c.byref(error)), error)

    def certificate(self, source: Optional[str]) -> bytes:
        """The certificate of its answer. `source`: SHA-256 of the scene's file, if it is of one."""
        return certificate_of(self._scene, source, lib.library.imp_query_write_proof, self._address)

    # --- Clearance ------------------------------------------------------------------------------

    def clearance(self, index: int) -> lib.Clearance:
        """One answer to a question of clearance."""
        answer, error = lib.Clearance(struct_size=c.sizeof(lib.Clearance)), lib.Error()
        check(lib.library.imp_clearance_get(self._address, index, c.byref(answer), c.byref(error)),
              error)
        return answer

    def chunks(self) -> Iterator["NDArray[numpy.void]"]:
        """All answers to a question of clearance, as structured arrays of some thousands each. Where a
        limit came the last one stands for all that were not begun."""
        count = lib.library.imp_clearance_count(self._address)
        read, size, error = lib.library.imp_clearance_get, c.sizeof(lib.Clearance), lib.Error()
        for first in range(0, count, _CHUNK):
            if first > 0 and monotonic() >= self.until:
                yield self._rest(first, count)
                return
            answers = (lib.Clearance * min(_CHUNK, count - first))()
            chunk = numpy.frombuffer(answers, dtype=lib.Clearance)
            chunk["struct_size"] = size
            for k in range(len(answers)):  # there may be a million
                place = c.byref(answers, k * size)
                check(read(self._address, first + k, place, c.byref(error)), error)
            left = numpy.isin(chunk["reason"], lib.LIMITS)
            left &= (chunk["stats"]["pairs"] == 0) & (chunk["lower"] == 0)
            begun = int(numpy.argmax(left)) if left.any() else len(chunk)
            yield chunk[:begun]
            if begun < len(chunk):
                yield self._rest(first + begun, count)
                return

    def _rest(self, index: int, count: int) -> "NDArray[numpy.void]":
        """One answer for all slices from `index` on, of which nothing is known."""
        rest = self.clearance(index)
        rest.t_end = self.clearance(count - 1).t_end
        rest.lower, rest.upper, rest.t, rest.has_witness = 0.0, float("inf"), float("nan"), False
        rest.verdict = lib.REQUIREMENT_UNDECIDED if rest.required > 0 else lib.REQUIREMENT_NONE
        chunk: "NDArray[numpy.void]" = numpy.frombuffer(bytes(rest), dtype=lib.Clearance)
        return chunk

    def divide(self) -> int:
        """Divides a question of clearance into parts, one for each pair of bodies; how many."""
        count, error = c.c_size_t(), lib.Error()
        check(lib.library.imp_query_divide(self._address, c.byref(count), c.byref(error)), error)
        return count.value

    def part(self, index: int) -> "Query":
        """One of its parts; it belongs to one thread at a time."""
        error = lib.Error()
        made = lib.library.imp_query_part(self._address, index, c.byref(error))
        part = Query.__new__(Query)
        part._begin(self._scene, made, error, None)
        return part
