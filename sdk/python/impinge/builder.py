# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Scenes built without text."""

import ctypes as c
import os
import weakref
from typing import Any, Iterable, List, Optional, Sequence, Tuple, Union

import numpy

from . import _library as lib
from .errors import UsageError, check
from .registry import Registry
from .scene import Scene

_NUMBER, _BOOLEAN, _STRING, _TABLE = 1, 3, 4, 5


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
        self._handle = lib.library.imp_builder_new(Registry.handle())
        if not self._handle:
            raise MemoryError("out of memory")
        self._finalizer = weakref.finalize(self, lib.library.imp_builder_free, self._handle)
        self._call(lib.library.imp_builder_time, *map(float, time))
        self._call(lib.library.imp_builder_gamma, gamma, clearance)

    def _call(self, function: Any, *arguments: Any) -> None:
        error = lib.Error()
        check(function(self._handle, *arguments, c.byref(error)), error)

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
        return Scene.made(lib.library.imp_builder_finish(self._handle, c.byref(error)), error)
