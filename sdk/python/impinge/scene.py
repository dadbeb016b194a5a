# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Scenes: read, built, and asked."""

import ctypes as c
import os
import threading
import weakref
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Iterable, Iterator, List, Optional, Sequence, Tuple, Union

import numpy

from . import _library as lib
from .results import Clearance, Profile, Result, clearance_of, result_of

_NUMBER, _BOOLEAN, _STRING, _TABLE = 1, 3, 4, 5
_USAGE, _SCENE, _PLUGIN, _FILE, _MEMORY = range(1, 6)


class ImpingeError(Exception):
    """What the library complains of: where, what was given, what is allowed."""


class UsageError(ImpingeError, ValueError):
    """An argument is out of its range."""


class SceneError(ImpingeError, ValueError):
    """A scene, a type or a parameter is wrong."""


class PluginError(ImpingeError):
    """A plugin broke its promises."""


class FileError(ImpingeError, OSError):
    """A file cannot be read."""


_ERRORS = {_USAGE: UsageError, _SCENE: SceneError, _PLUGIN: PluginError, _FILE: FileError}


def _check(code: int, error: lib.Error) -> None:
    if code == _MEMORY:
        raise MemoryError(error.text.decode())
    if code != 0:
        raise _ERRORS.get(code, ImpingeError)(error.text.decode("utf-8", "replace"))


class _Registry:
    """The types at hand, found once for the whole process."""

    _lock = threading.Lock()
    _handle: Optional[int] = None

    @classmethod
    def handle(cls) -> int:
        with cls._lock:
            if cls._handle is None:
                cls._handle = lib.library.imp_registry_new(None)
                if cls._handle is None:
                    raise MemoryError("out of memory")
            return cls._handle


def _argument(name: str, value: Any, kept: List[Any]) -> lib.Argument:
    """The value by pointer and extents; what it points to is put into `kept`."""
    a = lib.Argument(name=name.encode(), rank=0, extent=(1, 1, 1))
    if isinstance(value, (bool, numpy.bool_)):
        a.kind, a.single = _BOOLEAN, float(value)
    elif isinstance(value, (str, os.PathLike)):
        a.kind, a.text = _STRING, os.fspath(value).encode()
    elif isinstance(value, dict):
        texts = (c.c_char_p * len(value))(*(key.encode() for key in value))
        numbers = (c.c_double * len(value))(*value.values())
        kept += [texts, numbers]
        a.kind, a.extent[0] = _TABLE, len(value)
        a.string, a.number = c.cast(texts, c.POINTER(c.c_char_p)), c.cast(numbers, c.POINTER(c.c_double))
    elif isinstance(value, (list, tuple)) and value and all(isinstance(x, str) for x in value):
        texts = (c.c_char_p * len(value))(*(x.encode() for x in value))
        kept.append(texts)
        a.kind, a.rank, a.extent[0] = _STRING, 1, len(value)
        a.string = c.cast(texts, c.POINTER(c.c_char_p))
    else:
        array = numpy.ascontiguousarray(value, dtype=numpy.float64)
        if numpy.ndim(value) == 0:
            a.kind, a.single = _NUMBER, float(array.reshape(()))
        elif array.ndim > 3:
            raise UsageError(f"{name}: an array of {array.ndim} dimensions, allowed are 3")
        else:
            kept.append(array)
            a.kind, a.rank = _NUMBER, array.ndim
            for k, extent in enumerate(array.shape):
                a.extent[k] = extent
            a.number = array.ctypes.data_as(c.POINTER(c.c_double))
    return a


class Scene:
    """Bodies in motion. Make one by `Scene.from_file`, `Scene.from_json`, `Scene.from_pair` or a
    `Builder`. Several threads may ask the same scene: their questions wait for each other."""

    def __init__(self, handle: int):
        self._handle = handle
        self._lock = threading.Lock()
        self._finalizer = weakref.finalize(self, lib.library.imp_scene_free, handle)
        count = lib.library.imp_scene_body_count(handle)
        self.bodies: Tuple[str, ...] = tuple(
            lib.library.imp_scene_body_name(handle, k).decode() for k in range(count))

    @classmethod
    def _made(cls, handle: Optional[int], error: lib.Error) -> "Scene":
        if not handle:
            _check(error.code, error)
        return cls(handle)

    @classmethod
    def from_file(cls, path: Union[str, os.PathLike]) -> "Scene":
        """A scene file."""
        error = lib.Error()
        handle = lib.library.imp_scene_from_file(_Registry.handle(), os.fsencode(path),
                                                 c.byref(error))
        return cls._made(handle, error)

    @classmethod
    def from_json(cls, text: str, name: str = "scene") -> "Scene":
        """The text of a scene file; relative names of files begin at the folder of `name`."""
        data, error = text.encode(), lib.Error()
        handle = lib.library.imp_scene_from_json(_Registry.handle(), data, len(data),
                                                 name.encode(), c.byref(error))
        return cls._made(handle, error)

    @classmethod
    def from_pair(cls, a: str, b: str) -> "Scene":
        """Two pipelines, "TYPE name=value ... ! MAP name=value ..."."""
        error = lib.Error()
        handle = lib.library.imp_scene_from_pair(_Registry.handle(), a.encode(), b.encode(),
                                                 c.byref(error))
        return cls._made(handle, error)

    def __repr__(self) -> str:
        return f"Scene(bodies={self.bodies!r})"

    def eval(self, body: str, surface: int, points: Any) -> numpy.ndarray:
        """Points of one surface, its maps applied: from rows of (u, v, t) to rows of (x, y, z)."""
        p = numpy.ascontiguousarray(points, dtype=numpy.float64).reshape(-1, 3)
        x, error = numpy.empty_like(p), lib.Error()
        with self._lock:
            code = lib.library.imp_scene_eval(self._handle, self.bodies.index(body), surface,
                                              len(p), p.ctypes.data, x.ctypes.data, None,
                                              c.byref(error))
        _check(code, error)
        return x

    def _options(self, time: Optional[Sequence[float]], **given: Any) -> lib.Options:
        options, error = lib.Options(struct_size=c.sizeof(lib.Options)), lib.Error()
        _check(lib.library.imp_options_read(self._handle, c.byref(options), c.byref(error)), error)
        if time is not None:
            options.t_start, options.t_end = time
        for name, value in given.items():
            if value is not None:
                setattr(options, name, value)
        return options

    def solve(self, *, time: Optional[Sequence[float]] = None, gamma: Optional[float] = None,
              clearance: Optional[float] = None, max_pairs: Optional[int] = None,
              max_seconds: Optional[float] = None, max_bytes: Optional[int] = None) -> Result:
        """The earliest contact of any two bodies. The interpreter runs on meanwhile."""
        options = self._options(time, gamma=gamma, clearance=clearance, max_pairs=max_pairs,
                                max_seconds=max_seconds, max_bytes=max_bytes)
        result, error = lib.Result(struct_size=c.sizeof(lib.Result)), lib.Error()
        with self._lock:
            code = lib.library.imp_scene_solve(self._handle, c.byref(options), c.byref(result),
                                               c.byref(error))
        _check(code, error)
        return result_of(self.bodies, result)

    def _clearances(self, options: lib.Options, **asked: Any) -> List[Clearance]:
        wanted, error = lib.ClearanceOptions(struct_size=c.sizeof(lib.ClearanceOptions)), lib.Error()
        _check(lib.library.imp_clearance_options_read(c.byref(wanted), c.byref(error)), error)
        for name, value in asked.items():
            if value is not None:
                setattr(wanted, name, value)
        with self._lock:
            query = lib.library.imp_clearance_new(self._handle, c.byref(options), c.byref(wanted),
                                                  c.byref(error))
            if not query:
                _check(error.code, error)
            try:
                _check(lib.library.imp_query_step(query, 0, c.byref(error)), error)
                return [self._clearance(query, k)
                        for k in range(lib.library.imp_clearance_count(query))]
            finally:
                lib.library.imp_query_free(query)

    def _clearance(self, query: int, index: int) -> Clearance:
        answer, error = lib.Clearance(struct_size=c.sizeof(lib.Clearance)), lib.Error()
        _check(lib.library.imp_clearance_read(query, index, c.byref(answer), c.byref(error)), error)
        return clearance_of(self.bodies, answer)

    def clearance(self, *, required: Optional[float] = None, tolerance: Optional[float] = None,
                  time: Optional[Sequence[float]] = None, max_pairs: Optional[int] = None,
                  max_seconds: Optional[float] = None) -> Clearance:
        """The least distance of all bodies over the interval; is the `required` one kept?"""
        if required is not None and not required > 0:
            raise UsageError(f"required: got {required!r}, must be > 0")
        options = self._options(time, max_pairs=max_pairs, max_seconds=max_seconds)
        return self._clearances(options, required=required, tolerance=tolerance)[0]

    def each(self, *, required: Optional[float] = None, tolerance: Optional[float] = None,
             time: Optional[Sequence[float]] = None) -> List[Clearance]:
        """The clearance of every two bodies that do not ignore each other, the tightest first."""
        answers = self._clearances(self._options(time), each=True, required=required,
                                   tolerance=tolerance)
        return sorted(answers, key=lambda answer: answer.upper)

    def profile(self, slices: int, *, required: Optional[float] = None,
                tolerance: Optional[float] = None,
                time: Optional[Sequence[float]] = None) -> Profile:
        """The clearance in each of so many equal slices of time."""
        answers = self._clearances(self._options(time), slices=slices, required=required,
                                   tolerance=tolerance)
        columns = ([getattr(answer, name) for answer in answers]
                   for name in ("t_start", "t_end", "lower", "upper"))
        return Profile(*(numpy.array(column) for column in columns),
                       tuple(answer.verdict for answer in answers))


class Body:
    """One body of a `Builder`."""

    def __init__(self, builder: "Builder", index: int, name: str):
        self._builder, self.index, self.name = builder, index, name

    def surface(self, type: str, *, maps: Iterable[Tuple[str, dict]] = (), **parameters: Any) -> "Body":
        """Adds a surface, under maps of its own: pairs of a type and its parameters."""
        self._builder._add(lib.library.imp_builder_surface, (self.index,), type, parameters)
        for map_type, map_parameters in maps:
            self._builder._add(lib.library.imp_builder_surface_map,
                               (self.index, self._surfaces), map_type, map_parameters)
        self._surfaces += 1
        return self

    _surfaces = 0

    def map(self, type: str, **parameters: Any) -> "Body":
        """Adds a map, after those there are."""
        self._builder._add(lib.library.imp_builder_map, (self.index,), type, parameters)
        return self


class Builder:
    """Builds a scene: bodies, their surfaces and maps, parents, groups, who ignores whom. Parameters
    are numbers, strings, booleans, dicts, sequences and NumPy arrays, which go by pointer."""

    def __init__(self, *, time: Sequence[float] = (0, 1), gamma: float = 1e-6,
                 clearance: float = -1):
        self._handle = lib.library.imp_builder_new(_Registry.handle())
        if not self._handle:
            raise MemoryError("out of memory")
        self._finalizer = weakref.finalize(self, lib.library.imp_builder_free, self._handle)
        self._call(lib.library.imp_builder_time, *map(float, time))
        self._call(lib.library.imp_builder_gamma, gamma, clearance)

    def _call(self, function: Any, *arguments: Any) -> None:
        error = lib.Error()
        _check(function(self._handle, *arguments, c.byref(error)), error)

    def _add(self, function: Any, where: Tuple[int, ...], type: str, parameters: dict) -> None:
        kept: List[Any] = []
        arguments = [_argument(name, value, kept) for name, value in parameters.items()]
        array = (lib.Argument * max(len(arguments), 1))(*arguments)
        self._call(function, *where, type.encode(), array, len(arguments))

    def body(self, name: Optional[str] = None, *, parent: Optional[Body] = None,
             group: Union[str, Iterable[str]] = ()) -> Body:
        """Begins a body; the maps of its parent come after its own."""
        index = c.c_size_t()
        self._call(lib.library.imp_builder_body, name.encode() if name is not None else None,
                   c.byref(index))
        if parent is not None:
            self._call(lib.library.imp_builder_parent, index.value, parent.index)
        for one in (group,) if isinstance(group, str) else group:
            self._call(lib.library.imp_builder_group, index.value, one.encode())
        return Body(self, index.value, name if name is not None else f"body{index.value}")

    def ignore(self, x: str, y: str) -> None:
        """Bodies, or groups of them, that are never tested with each other."""
        self._call(lib.library.imp_builder_ignore, x.encode(), y.encode())

    def build(self) -> Scene:
        """The scene; the builder is done then."""
        error = lib.Error()
        return Scene._made(lib.library.imp_builder_finish(self._handle, c.byref(error)), error)


def batch(scenes: Iterable[Scene], *, threads: Optional[int] = None,
          **options: Any) -> Iterator[Result]:
    """Solves many scenes on so many threads (all processors); results in order, as they come."""
    with ThreadPoolExecutor(max_workers=threads or os.cpu_count()) as pool:
        yield from pool.map(lambda scene: scene.solve(**options), scenes)
