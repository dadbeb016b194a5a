# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""One question about all values of a scene's parameters, while it is answered."""

import ctypes as c
from time import monotonic
from typing import Any, Callable, Dict, NamedTuple, Optional, Sequence, Tuple

from . import _library as lib
from ._handle import Handle
from ._query import SECONDS, Settings, Wanted, certificate_of, options_of
from .errors import check
from .results import Progress

Ranges = Sequence[Tuple[float, float]]

_BOXES = 4  # asked about between looks at signals: some milliseconds


def parameters_of(handle: Handle) -> Dict[str, Tuple[float, float]]:
    """The parameters of a scene and their ranges, in its order."""
    found: Dict[str, Tuple[float, float]] = {}
    info, index = lib.SceneParameter(), 0
    while lib.library.imp_scene_parameter(handle.address, index, c.byref(info)):
        found[info.name.decode()] = (info.lo, info.hi)
        index += 1
    return found


def times_of(handle: Handle, settings: Settings) -> Tuple[float, float]:
    """The times that the settings, or else the scene, ask about."""
    options, error = lib.Options(struct_size=c.sizeof(lib.Options)), lib.Error()
    code = lib.library.imp_options_get_default(handle.address, c.byref(options), c.byref(error))
    if settings.time is None:
        check(code, error)
    settings.write(options)
    return options.t_start, options.t_end


class State(NamedTuple):
    """How far a survey has come: the share of all values and times that is proved; boxes asked about, and
    left; the values at which something was found."""

    proved: float
    boxes: int
    waiting: int
    values: Optional[Dict[str, float]]


class Survey:
    """A survey of libimpinge, freed at the end of its `with`. With `wanted` it is one of clearance; `any` ends
    it with any contact or violation, though another may be earlier; `bodies` and `ranges` of all parameters
    ask about these alone."""

    def __init__(self, scene: Handle, settings: Settings, wanted: Optional[Wanted] = None, *, any: bool = False,
                 bodies: Optional[Tuple[int, int]] = None, ranges: Optional[Ranges] = None):
        self._scene, self._progress, self._is_clearance = scene, settings.progress, wanted is not None
        self._names = tuple(parameters_of(scene))
        options, self._crew = options_of(scene, settings)
        error = lib.Error()
        how = lib.SurveyOptions(struct_size=c.sizeof(lib.SurveyOptions))
        check(lib.library.imp_survey_options_get_default(c.byref(how), c.byref(error)), error)
        how.any = any
        if bodies is not None:
            how.body = bodies
        if ranges is not None:
            ends = [(c.c_double * len(ranges))(*(one[side] for one in ranges)) for side in range(2)]
            how.lo, how.hi = (c.cast(one, c.c_void_p) for one in ends)
        asked = None
        if wanted is not None:
            asked = lib.ClearanceOptions(struct_size=c.sizeof(lib.ClearanceOptions))
            check(lib.library.imp_clearance_options_get_default(c.byref(asked), c.byref(error)), error)
            wanted.write(asked)
        self._address = lib.library.imp_survey_new(scene.address, c.byref(options),
                                                   None if asked is None else c.byref(asked), c.byref(how),
                                                   c.byref(error))
        if not self._address:
            check(error.code, error)
        scene.users.add(self)

    _address: Optional[int] = None

    def close(self) -> None:
        """Frees it; nothing may be asked then."""
        address, self._address = self._address, None
        if address is not None:
            self._scene.users.discard(self)
            lib.library.imp_survey_free(address)

    def __enter__(self) -> "Survey":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __del__(self) -> None:
        self.close()

    def refine(self, gamma: float) -> None:
        """At a smaller gamma."""
        error = lib.Error()
        check(lib.library.imp_survey_refine(self._address, gamma, -1, c.byref(error)), error)

    def keep_proof(self) -> None:
        """Before the first step: keeps what its certificate needs."""
        error = lib.Error()
        check(lib.library.imp_survey_keep_proof(self._address, c.byref(error)), error)

    def certificate(self, source: Optional[str]) -> bytes:
        """The certificate of its answer. `source`: SHA-256 of the scene's file, if it is of one."""
        return certificate_of(self._scene, source, lib.library.imp_survey_write_proof, self._address)

    def run(self, is_over: Callable[[], bool] = lambda: False) -> State:
        """Goes on until there is an answer, with a look at signals and at `is_over` now and then."""
        error, told = lib.Error(), monotonic()
        while True:
            check(lib.library.imp_survey_step(self._address, _BOXES, c.byref(error)), error)
            state = self._state()
            if state.reason != lib.RUNNING:
                break
            if is_over():
                lib.library.imp_survey_cancel(self._address)
            if self._progress is None or monotonic() - told < SECONDS:
                continue
            told = monotonic()
            if self._progress(self._how_far()) is False:
                lib.library.imp_survey_cancel(self._address)
        return State(state.proved, state.boxes, state.waiting, self._values())

    def _state(self) -> lib.SurveyState:
        state, error = lib.SurveyState(struct_size=c.sizeof(lib.SurveyState)), lib.Error()
        check(lib.library.imp_survey_get_state(self._address, c.byref(state), c.byref(error)), error)
        return state

    def _values(self) -> Optional[Dict[str, float]]:
        found = (c.c_double * max(len(self._names), 1))()
        if not lib.library.imp_survey_values(self._address, found):
            return None
        return dict(zip(self._names, found))

    def _how_far(self) -> Progress:
        if self._is_clearance:
            bracket = self.clearance()
            return Progress(None, bracket.stats.pairs, bracket.stats.seconds, bracket.lower, bracket.upper)
        answer = self.result()
        return Progress(answer.t_lower, answer.stats.pairs, answer.stats.seconds, None, None)

    def result(self) -> lib.Result:
        """The earliest contact over all values, as far as it is known."""
        answer, error = lib.Result(struct_size=c.sizeof(lib.Result)), lib.Error()
        check(lib.library.imp_survey_get_result(self._address, c.byref(answer), c.byref(error)), error)
        return answer

    def clearance(self) -> lib.Clearance:
        """The least distance over all values, as far as it is known."""
        answer, error = lib.Clearance(struct_size=c.sizeof(lib.Clearance)), lib.Error()
        check(lib.library.imp_survey_get_clearance(self._address, c.byref(answer), c.byref(error)), error)
        return answer
