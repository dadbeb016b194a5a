# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Scenes, and what they are asked."""

import ctypes as c
import os
from dataclasses import replace
from hashlib import sha256
from typing import (Any, Callable, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence, Tuple, Type, TypeVar, Union,
                    cast)

import numpy

from . import _arguments as arguments
from . import _document as document
from . import _files
from . import _library as lib
from . import _mesh
from . import _values as values
from ._handle import Handle, from_text
from ._parts import Parts
from ._query import ProgressSink, Query, Settings, Wanted
from ._registry import Registry
from . import _surveys
from ._survey import Survey, parameters_of
from ._surveys import Surveys
from .errors import UsageError, check
from .pictures import Format, Picture, draw
from .results import Clearance, Profile, Result, clearance_of, profile_of, result_of

AnyScene = TypeVar("AnyScene", bound="Scene")
AnyAnswer = TypeVar("AnyAnswer")


class Scene:
    """Bodies in motion: of a scene file, `Scene(path)`, or made by `Scene.from_json`, `Scene.from_pair` or
    a `Builder`. Several threads may ask one scene at once; the interpreter's lock is released. Copies share
    what they know; pickle writes the scene's text.

    All questions take `time=(start, end)`, budgets (`max_pairs`, `max_seconds`, `max_bytes`), which
    end them as "undecided", `audit=True`, which holds what plugins claim against points of them, and
    `progress`: a function that is called with a `Progress` about ten times a second, and ends the
    question, as "undecided", by returning False. An exception that it raises, or Ctrl-C, ends the
    question. Wrong arguments are a `UsageError`, which names them.

    `proof=PATH` writes a certificate of the answer, which `impinge-verify PATH [SCENE]` proves again from
    the surfaces' formulas alone; the search keeps a part of what lies between `gamma_clear` and `gamma` as
    room for it. The file appears whole or not at all. There is none of solid bodies, nor over parameters.

    Of a scene with `parameters` (their ranges, by name) every question is about all values at once, and
    answers name the values of what they found; `at` makes the scene at values."""

    bodies: Tuple[str, ...]
    parameters: Dict[str, Tuple[float, float]]
    _posed: Optional[Tuple["Scene", Tuple[float, ...]]] = None  # of whom it is `at` these values
    _source: Optional[str] = None  # SHA-256 of the file that it is as it is

    def __init__(self, path: values.Path):
        name = values.path("path", path)
        data = _files.read(name)
        self._begin_text(data, name)
        self._source = sha256(data).hexdigest()

    def _begin(self, handle: Handle, names: Optional[Tuple[str, ...]] = None) -> None:
        """`names`: of a scene without parameters, where they are known."""
        self._handle = handle
        self.bodies = handle.names() if names is None else names
        self.parameters = parameters_of(handle) if names is None else {}

    def _begin_text(self, data: bytes, name: str) -> None:
        """As the text says; relative names of files begin at the folder of `name`."""
        folder = os.path.dirname(os.path.abspath(name))
        address = from_text(data, os.fsencode(name))
        self._begin(Handle(address, lambda: document.from_text(data, folder)))

    @classmethod
    def _made(cls: Type[AnyScene], handle: Handle, names: Optional[Tuple[str, ...]] = None) -> AnyScene:
        scene = cls.__new__(cls)
        scene._begin(handle, names)
        return scene

    @classmethod
    def from_file(cls: Type[AnyScene], path: values.Path) -> AnyScene:
        """A scene file, as by `Scene(path)`."""
        name = values.path("path", path)
        data = _files.read(name)
        scene = cls._from_text(data, name)
        scene._source = sha256(data).hexdigest()
        return scene

    @classmethod
    def _from_text(cls: Type[AnyScene], data: bytes, name: str) -> AnyScene:
        scene = cls.__new__(cls)
        scene._begin_text(data, name)
        return scene

    @classmethod
    def from_json(cls: Type[AnyScene], text: str, name: str = "scene") -> AnyScene:
        """The text of a scene file. `name` stands for it in errors; relative names of files begin at its
        folder."""
        return cls._from_text(values.text("text", text), values.path("name", name))

    @classmethod
    def from_pair(cls: Type[AnyScene], a: str, b: str) -> AnyScene:
        """Bodies "a" and "b" of two pipelines, "TYPE name=value ... ! MAP name=value ..."."""
        lines, error, folder = (values.text("a", a), values.text("b", b)), lib.Error(), os.getcwd()
        address = lib.library.imp_scene_from_pair(Registry.handle(), *lines, c.byref(error))
        if not address:
            check(error.code, error)
        return cls._made(Handle(address, lambda: _pair_document(lines, folder)))

    # --- Copies and texts ---------------------------------------------------------------------

    def to_json(self) -> str:
        """The text of a scene file, on one line, that makes this scene wherever it is read: names of files
        in it are absolute."""
        return self._handle.text()

    def save(self, path: values.Path) -> None:
        """Writes a scene file that makes this scene: lines for people, names of files absolute."""
        _files.write(values.path("path", path), document.to_pretty_text(self._handle.document()).encode())

    def __repr__(self) -> str:
        return f"Scene(bodies={self.bodies!r})"

    def __copy__(self: AnyScene) -> AnyScene:
        copied = type(self).__new__(type(self))
        copied.__dict__.update(self.__dict__)
        return copied

    def __getstate__(self) -> Dict[str, Any]:
        return {**self.__dict__, "_source": None, "_handle": None if self._posed is not None else self.to_json()}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__dict__.update(state)
        if self._posed is not None:
            whole, chosen = self._posed
            self.__dict__.update(whole.at(dict(zip(whole.parameters, chosen))).__dict__)
            return
        self._begin_text(cast(str, state["_handle"]).encode(), "pickled scene")

    def __deepcopy__(self: AnyScene, memo: Any) -> AnyScene:
        return self.__copy__()

    # --- Values of its parameters ---------------------------------------------------------------

    def at(self: AnyScene, given: Mapping[str, float]) -> AnyScene:
        """The scene at these values of its parameters, a scene without them; what is not given is in the
        middle of its range. It shares what their surfaces were made of."""
        if not isinstance(given, Mapping):
            raise values.refuse("given", given, "a dict from names to values")
        for name in given:
            if name not in self.parameters:
                raise values.refuse("at", name, f"a parameter: {', '.join(self.parameters) or 'none'}")
        chosen = tuple(values.number(f"at: {name}", given[name]) if name in given else 0.5 * lo + 0.5 * hi
                       for name, (lo, hi) in self.parameters.items())
        if not chosen:
            return self.__copy__()
        scene = type(self).__new__(type(self))
        scene._begin(Handle(self._address_at(chosen), lambda: self._document_at(chosen),
                            lambda: self._address_at(chosen)))
        scene._posed = self, chosen
        return scene

    def _address_at(self, chosen: Tuple[float, ...]) -> int:
        error = lib.Error()
        address = lib.library.imp_scene_at(self._handle.address, (c.c_double * len(chosen))(*chosen),
                                           c.byref(error))
        if not address:
            check(error.code, error)
        return int(address)

    def _document_at(self, chosen: Tuple[float, ...]) -> document.Document:
        """The parameters with ranges of one value."""
        ranges = {name: [value, value] for name, value in zip(self.parameters, chosen)}
        return {**self._handle.document(), "parameters": ranges}

    # --- Numbers that change --------------------------------------------------------------------

    def set_values(self, body: str, parameters: Mapping[str, Any], *, surface: Optional[int] = None,
                   map: Optional[int] = None) -> None:
        """Gives a surface of a body, one of that surface's own maps (`surface` and `map`) or a map of the
        body (`map` alone), counted from 0, new parameters, for a loop that asks again and again: all of
        them, in the type's units; those not given are as if absent, and names of files begin at the working
        directory. The scene then answers like one that is built so, and keeps what it knows of all other
        surfaces. Copies of the scene change with it. Wrong parameters, and those of a scene that is being
        asked by another thread or has `parameters` of its own, are an error, and change nothing."""
        index = self._index(body)
        if not isinstance(parameters, Mapping):
            raise values.refuse("parameters", parameters, "a dict from names to values")
        numbers = [None if n is None else values.count(name, n) for name, n in (("surface", surface), ("map", map))]
        packed, error = arguments.pack(parameters), lib.Error()
        none = c.c_size_t(-1).value
        check(lib.library.imp_scene_set_values(self._handle.address, index,
                                               *(none if n is None else n for n in numbers),
                                               packed.array, packed.size, c.byref(error)), error)
        where = document.Where(index, numbers[0], numbers[1])
        self._handle.changes[where] = document.Change(packed.written, os.getcwd())

    # --- Points -----------------------------------------------------------------------------------

    def _index(self, body: str) -> int:
        if not isinstance(body, str) or body not in self.bodies:
            raise values.refuse("body", body, f"one of {', '.join(self.bodies)}")
        return self.bodies.index(body)

    def eval(self, body: str, surface: int, points: Any) -> values.Floats:
        """Points of one surface, its maps applied: from rows of (u, v, t) to rows of (x, y, z)."""
        index = self._index(body)
        count = lib.library.imp_scene_surface_count(self._handle.address, index)
        if values.count("surface", surface) >= count:
            raise UsageError(f"surface: got {surface}, body {body!r} has {count}, counted from 0")
        p = values.rows("points", points, ("u", "v", "t"))
        x, error = numpy.empty_like(p), lib.Error()
        check(lib.library.imp_scene_eval(self._handle.address, index, int(surface), len(p),
                                         p.ctypes.data, x.ctypes.data, None, c.byref(error)), error)
        return x

    def mesh(self, body: str, t: Optional[float] = None, *,
             tolerance: Optional[float] = None) -> _mesh.Mesh:
        """A body at time t (the scene's first) as triangles, for matplotlib and others: surfaces bend away
        from them by about `tolerance` (a thousandth of the body's size). What does not exist then is left
        out."""
        index = self._index(body)
        if t is None:
            options, error = lib.Options(struct_size=c.sizeof(lib.Options)), lib.Error()
            check(lib.library.imp_options_get_default(self._handle.address, c.byref(options), c.byref(error)),
                  error)
            t = options.t_start
        if tolerance is not None and not values.number("tolerance", tolerance) > 0:
            raise values.refuse("tolerance", tolerance, "a length > 0")
        return _mesh.make(self._handle, index, values.number("t", t), tolerance)

    def formulas(self, body: str, surface: int = 0, piece: int = 0) -> List[Tuple[str, Optional[str]]]:
        """What a surface, or one of its pieces, is: its type and then its maps, those of its parents last,
        each with its formula as text (`sdk/README`, "Formulas as text") whose numbers are exact; None where a
        type has none."""
        place = lib.Place(self._index(body), values.count("surface", surface), values.count("piece", piece))
        count = lib.library.imp_piece_stage_count(self._handle.address, place)
        if count == 0:
            raise UsageError(f"surface {surface}, piece {piece}: body {body!r} has none of these numbers")
        return [self._stage(place, k) for k in range(count)]

    def _stage(self, place: lib.Place, k: int) -> Tuple[str, Optional[str]]:
        stage, text, error = lib.Stage(), c.c_void_p(), lib.Error()
        address = self._handle.address
        check(lib.library.imp_piece_stage(address, place, k, c.byref(stage), c.byref(error)), error)
        check(lib.library.imp_piece_formula(address, place, k, c.byref(text), c.byref(error)), error)
        try:
            return stage.type.decode(), c.string_at(text.value).decode() if text.value else None
        finally:
            lib.free(text)

    def view(self, path: Optional[values.Path] = None, *, format: Format = "png",
             width: Optional[int] = None, height: Optional[int] = None,
             azimuth: Optional[float] = None, elevation: Optional[float] = None,
             zoom: Optional[float] = None, at: Optional[float] = None,
             tolerance: Optional[float] = None, frames: Optional[int] = None,
             time: Optional[Sequence[float]] = None, gamma: Optional[float] = None,
             max_seconds: Optional[float] = None) -> Optional[Picture]:
        """Draws the scene by the command `impinge view`, whose options these are: a `Picture`, which
        notebooks show, or the file `path` (.png, .svg, .html, .glb, .obj, .vtu, .pvd), and None."""
        return draw("view", self.to_json(), path, format,
                    {"width": width, "height": height, "azimuth": azimuth, "elevation": elevation,
                     "zoom": zoom, "at": at, "tolerance": tolerance, "frames": frames, "time": time,
                     "gamma": gamma, "max_seconds": max_seconds})

    def plot(self, path: Optional[values.Path] = None, *, format: Format = "png",
             slices: Optional[int] = None, time: Optional[Sequence[float]] = None,
             gamma: Optional[float] = None, max_seconds: Optional[float] = None) -> Optional[Picture]:
        """Plots the least distance over time by the command `impinge plot`: a `Picture`, or the file `path`
        (.png, .svg), and None."""
        return draw("plot", self.to_json(), path, format,
                    {"slices": slices, "time": time, "gamma": gamma, "max_seconds": max_seconds})

    # --- The earliest contact ----------------------------------------------------------------

    def solve(self, *, time: Optional[Sequence[float]] = None, gamma: Optional[float] = None,
              gamma_clear: Optional[float] = None, max_pairs: Optional[int] = None,
              max_seconds: Optional[float] = None, max_bytes: Optional[int] = None,
              audit: Optional[bool] = None, progress: Optional[ProgressSink] = None,
              threads: Optional[int] = None, proof: Optional[values.Path] = None) -> Result:
        """The earliest contact over the scene's time, or `time`: two points no farther apart than `gamma`.
        Nothing nearer than `gamma_clear` is missed. Trees of surfaces are built, and bodies sorted out, by
        so many threads (one); the answer is the same. `proof`: where a certificate is written."""
        settings = Settings(time, gamma, gamma_clear, max_pairs, max_seconds, max_bytes, audit, progress,
                            threads)
        wanted = self._proof_path(proof)
        if self.parameters:
            with Survey(self._handle, settings) as survey:
                state = self._answer(survey, survey.run, wanted)
                return replace(result_of(self.bodies, survey.result()), parameters=state.values,
                               proved=state.proved)
        with Query(self._handle, settings) as query:
            return result_of(self.bodies, self._answer(query, query.step, wanted))

    def _proof_path(self, proof: Optional[values.Path]) -> Optional[str]:
        return None if proof is None else values.path("proof", proof)

    def _answer(self, search: Union[Query, Survey], run: Callable[[], AnyAnswer], proof: Optional[str]) -> AnyAnswer:
        """Runs the search, and writes its certificate there."""
        if proof is not None:
            search.keep_proof()
        answer = run()
        if proof is not None:
            _files.write(proof, search.certificate(None if self._handle.changes else self._source))
        return answer

    def solve_each(self, *, time: Optional[Sequence[float]] = None, gamma: Optional[float] = None,
                   gamma_clear: Optional[float] = None, max_pairs: Optional[int] = None,
                   max_seconds: Optional[float] = None, max_bytes: Optional[int] = None,
                   audit: Optional[bool] = None,
                   progress: Optional[ProgressSink] = None) -> Iterator[Result]:
        """The first contact of each pair of bodies, in order of time, each as soon as it is proved; then
        a clear result for each pair that never touches. Where a budget ends the search the last result is
        "undecided", and has no `bodies`."""
        settings = Settings(time, gamma, gamma_clear, max_pairs, max_seconds, max_bytes, audit, progress)
        if self.parameters:
            return _surveys.solve_each(Surveys(self._handle, self.bodies, settings), list(self._pairs()))
        return self._solve_each(Query(self._handle, settings))

    def _solve_each(self, opened: Query) -> Iterator[Result]:
        with opened as query:
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
               max_pairs: Optional[int] = None, max_seconds: Optional[float] = None,
               max_bytes: Optional[int] = None, audit: Optional[bool] = None,
               progress: Optional[ProgressSink] = None) -> Iterator[Result]:
        """The earliest contact at each gamma, the widest first, from one search."""
        widest_first = sorted((values.number("gammas", gamma) for gamma in gammas), reverse=True)
        if not widest_first:
            return iter(())
        settings = Settings(time, widest_first[0], None, max_pairs, max_seconds, max_bytes, audit,
                            progress)
        if self.parameters:
            return self._refine_all(Survey(self._handle, settings), widest_first[1:])
        return self._refine(Query(self._handle, settings), widest_first[1:])

    def _refine_all(self, opened: Survey, finer: List[float]) -> Iterator[Result]:
        with opened as survey:
            for gamma in [None, *finer]:
                if gamma is not None:
                    survey.refine(gamma)
                state = survey.run()
                yield replace(result_of(self.bodies, survey.result()), parameters=state.values,
                              proved=state.proved)

    def _refine(self, opened: Query, finer: List[float]) -> Iterator[Result]:
        with opened as query:
            yield result_of(self.bodies, query.step())
            for gamma in finer:
                query.refine(gamma)
                yield result_of(self.bodies, query.step())

    def _pairs(self) -> Iterator[Tuple[int, int]]:
        for a in range(len(self.bodies)):
            for b in range(a + 1, len(self.bodies)):
                if not lib.library.imp_scene_ignores(self._handle.address, a, b):
                    yield a, b

    # --- Clearance ------------------------------------------------------------------------------

    def clearance(self, *, required: Optional[float] = None, tolerance: Optional[float] = None,
                  time: Optional[Sequence[float]] = None, gamma: Optional[float] = None,
                  max_pairs: Optional[int] = None, max_seconds: Optional[float] = None,
                  max_bytes: Optional[int] = None, audit: Optional[bool] = None,
                  progress: Optional[ProgressSink] = None,
                  threads: Optional[int] = None, proof: Optional[values.Path] = None) -> Clearance:
        """The minimum distance of all bodies over the interval; is the `required` one kept? With
        `required` and no `tolerance` the search ends as soon as that is known. Without, it ends when
        upper - lower is at most `tolerance` (1e-3) times upper. At `gamma` bodies touch. Trees of
        surfaces are built, and bodies sorted out, by so many threads (one); the answer is the same.
        `proof`: where a certificate is written."""
        settings = Settings(time, gamma, None, max_pairs, max_seconds, max_bytes, audit, progress,
                            threads)
        path = self._proof_path(proof)
        if self.parameters:
            with Survey(self._handle, settings, Wanted(required, tolerance)) as survey:
                state = self._answer(survey, survey.run, path)
                return replace(clearance_of(self.bodies, survey.clearance()), parameters=state.values,
                               proved=state.proved)
        with Query(self._handle, settings, Wanted(required, tolerance)) as query:
            self._answer(query, query.step, path)
            return clearance_of(self.bodies, query.clearance(0))

    def each(self, *, required: Optional[float] = None, tolerance: Optional[float] = None,
             time: Optional[Sequence[float]] = None, gamma: Optional[float] = None,
             max_pairs: Optional[int] = None, max_seconds: Optional[float] = None,
             max_bytes: Optional[int] = None, audit: Optional[bool] = None,
             progress: Optional[ProgressSink] = None,
             threads: Optional[int] = None, within: Optional[float] = None) -> List[Clearance]:
        """The clearance of every two bodies that do not ignore each other, the least `lower` first, found
        by so many threads (all processors); the answers are the same for any number. With `within`, bodies
        that never come nearer than this length are left out, and cost next to nothing. `max_pairs` and
        `max_bytes` hold for each pair of bodies, `max_seconds` for all; where a limit or the progress sink
        ends the search, a last answer whose `bodies` are None stands for the pairs that were not
        examined."""
        settings = Settings(time, gamma, None, max_pairs, max_seconds, max_bytes, audit, progress)
        if self.parameters:
            return _surveys.each(Surveys(self._handle, self.bodies, settings), list(self._pairs()),
                                 Wanted(required, tolerance), within, values.threads(threads))
        with Query(self._handle, settings, Wanted(required, tolerance, None, within)) as query:
            parts = Parts(query, self.bodies, required, within, progress)
            return parts.answers(self._pairs(), values.threads(threads))

    def profile(self, slices: int, *, required: Optional[float] = None,
                tolerance: Optional[float] = None, time: Optional[Sequence[float]] = None,
                gamma: Optional[float] = None, max_pairs: Optional[int] = None,
                max_seconds: Optional[float] = None, max_bytes: Optional[int] = None,
                audit: Optional[bool] = None, progress: Optional[ProgressSink] = None,
                over: Optional[str] = None) -> Profile:
        """The clearance in each of so many equal slices of time or, with `over`, of the range of this parameter
        of the scene; where a limit ends the search, one last element is for all that were not begun. With
        parameters each slice is one question, for which `max_pairs` holds, and none is left out."""
        settings = Settings(time, gamma, None, max_pairs, max_seconds, max_bytes, audit, progress)
        if self.parameters or over is not None:
            return _surveys.profile(Surveys(self._handle, self.bodies, settings), self._handle, settings,
                                    Wanted(required, tolerance, slices), over)
        with Query(self._handle, settings, Wanted(required, tolerance, slices)) as query:
            query.step()
            return profile_of(self.bodies, query.chunks())


def _pair_document(lines: Tuple[bytes, bytes], folder: str) -> document.Document:
    error = lib.Error()
    made = lib.library.imp_pair_to_json(Registry.handle(), *lines, c.byref(error))
    if not made:
        check(error.code, error)
    try:
        return document.from_text(c.string_at(made), folder)
    finally:
        lib.free(made)
