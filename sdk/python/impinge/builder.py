# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Scenes built without text."""

import ctypes as c
import os
import threading
import weakref
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

from numpy.typing import ArrayLike

from . import _arguments as arguments
from . import _document as document
from . import _library as lib
from . import _values as values
from ._handle import Handle
from ._registry import Registry
from .errors import check
from .scene import Scene

Value = Union[bool, str, "os.PathLike[str]", Mapping[str, float], Sequence[str], ArrayLike]
Stage = Tuple[str, Mapping[str, Value]]


class Body:
    """One body of a `Builder`, which makes it."""

    def __init__(self, builder: "Builder", index: int, name: str):
        self._builder, self.index, self.name = builder, index, name
        self._surfaces = 0

    def surface(self, type: str, *, maps: Iterable[Stage] = (), **parameters: Value) -> "Body":
        """Adds a surface, under maps of its own: pairs of a type and its parameters. Answers the body."""
        stages = [_stage(stage) for stage in maps]
        self._builder._add_surface(self.index, type, parameters)
        self._surfaces += 1
        for map_type, map_parameters in stages:
            self._builder._add_surface_map(self.index, self._surfaces - 1, map_type, map_parameters)
        return self

    def map(self, type: str, **parameters: Value) -> "Body":
        """Adds a map, after those there are. Answers the body."""
        self._builder._add_map(self.index, type, parameters)
        return self

    def __reduce__(self) -> Any:
        raise TypeError("a Body of a Builder cannot be copied or pickled")


def _stage(stage: Any) -> Tuple[str, Dict[str, Any]]:
    try:
        map_type, parameters = stage
        return map_type, dict(parameters)
    except (TypeError, ValueError):
        raise values.refuse("maps", stage, "pairs of a type and a dict of its parameters") from None


class Builder:
    """Builds a scene: bodies, their surfaces and maps, parents, groups, who ignores whom. Parameters
    are numbers, strings, booleans, dicts of numbers, sequences and NumPy arrays, which go by pointer. Names
    of files begin at the working directory. `parameters` are quantities beside time, with their ranges: a
    surface or a map with clock="NAME" has the value of one for its t. Without `time` a scene is examined for the span that its tables
    and keyframes share, from 0 to 1 if it has none. What is nearer than `gamma_clear` (half of gamma) is
    never missed. Several threads may use one builder, one after the other."""

    def __init__(self, *, time: Optional[Sequence[float]] = None, gamma: float = 1e-6,
                 gamma_clear: Optional[float] = None,
                 parameters: Optional[Mapping[str, Sequence[float]]] = None):
        self._lock = threading.RLock()
        self._handle = lib.library.imp_builder_new(Registry.handle())
        if not self._handle:
            raise MemoryError("out of memory")
        weakref.finalize(self, lib.library.imp_builder_free, self._handle).atexit = False
        gamma = values.number("gamma", gamma)
        clear = -1 if gamma_clear is None else values.number("gamma_clear", gamma_clear)
        if gamma_clear is not None and clear < 0:
            raise values.refuse("gamma_clear", gamma_clear, "a number from 0 to below gamma")
        self._document: document.Document = {"gamma": gamma, "bodies": []}
        if time is not None:
            start, end = values.interval("time", time)
            self._call(lib.library.imp_builder_time, start, end)
            self._document["time"] = [start, end]
        self._call(lib.library.imp_builder_gamma, gamma, clear)
        if gamma_clear is not None:
            self._document["gamma_clear"] = clear
        if parameters is not None and not isinstance(parameters, Mapping):
            raise values.refuse("parameters", parameters, "a dict from names to ranges")
        for name, ends in (parameters or {}).items():
            lo, hi = values.interval(f"parameters: {name}", ends)
            if not -float("inf") < lo <= hi < float("inf"):
                raise values.refuse(f"parameters: {name}", ends, "a range (lo, hi) of finite numbers, lo <= hi")
            self._call(lib.library.imp_builder_parameter, values.text("parameters: a name", name), lo, hi)
            self._document.setdefault("parameters", {})[name] = [lo, hi]

    def __reduce__(self) -> Any:
        raise TypeError("a Builder cannot be copied or pickled; its scene can: builder.build()")

    # --- To the library, and into the document ----------------------------------------------------

    def _call(self, function: Any, *given: Any) -> None:
        error = lib.Error()
        check(function(self._handle, *given, c.byref(error)), error)

    def _add(self, function: Any, where: Tuple[int, ...], type_name: str,
             parameters: Mapping[str, Any]) -> document.Document:
        """Adds a surface or a map; what a scene file would have for it."""
        packed = arguments.pack(parameters)
        self._call(function, *where, values.text("type", type_name), packed.array, packed.size)
        stage = {"type": type_name, **packed.written}
        document.resolve_stage(type_name, stage, os.getcwd())
        return stage

    def _add_surface(self, body: int, type_name: str, parameters: Mapping[str, Any]) -> None:
        with self._lock:
            stage = self._add(lib.library.imp_builder_surface, (body,), type_name, parameters)
            self._document["bodies"][body]["surfaces"].append(stage)

    def _add_map(self, body: int, type_name: str, parameters: Mapping[str, Any]) -> None:
        with self._lock:
            stage = self._add(lib.library.imp_builder_map, (body,), type_name, parameters)
            self._document["bodies"][body].setdefault("maps", []).append(stage)

    def _add_surface_map(self, body: int, surface: int, type_name: str,
                         parameters: Mapping[str, Any]) -> None:
        with self._lock:
            stage = self._add(lib.library.imp_builder_surface_map, (body, surface), type_name, parameters)
            self._document["bodies"][body]["surfaces"][surface].setdefault("maps", []).append(stage)

    # --- Bodies -------------------------------------------------------------------------------------

    def body(self, name: Optional[str] = None, *, parent: Optional[Body] = None,
             group: Union[str, Iterable[str]] = (), solid: bool = False) -> Body:
        """Begins a body; the maps of its parent come after its own. Who is inside a `solid` body when a
        question begins is in contact there."""
        if parent is not None and not (isinstance(parent, Body) and parent._builder is self):
            raise values.refuse("parent", parent, "a Body of this Builder")
        text = None if name is None else values.text("name", name)
        groups = [values.text("group", one) for one in ([group] if isinstance(group, str) else group)]
        with self._lock:
            index = c.c_size_t()
            self._call(lib.library.imp_builder_body, text, c.byref(index))
            body = Body(self, index.value, name if name is not None else f"body{index.value}")
            written: document.Document = {"name": body.name, "surfaces": []}
            self._document["bodies"].append(written)
            if parent is not None:
                self._call(lib.library.imp_builder_parent, index.value, parent.index)
                written["parent"] = parent.name
            if solid:
                self._call(lib.library.imp_builder_solid, index.value, True)
                written["solid"] = True
            for one in groups:
                self._call(lib.library.imp_builder_group, index.value, one)
                written.setdefault("group", []).append(one.decode())
        return body

    def ignore(self, x: str, y: str) -> None:
        """Bodies, or groups of them, that are never tested with each other."""
        with self._lock:
            self._call(lib.library.imp_builder_ignore, values.text("x", x), values.text("y", y))
            self._document.setdefault("ignore", []).append([x, y])

    def build(self) -> Scene:
        """The scene; the builder is done then."""
        error, made = lib.Error(), self._document
        with self._lock:
            address = lib.library.imp_builder_finish(self._handle, c.byref(error))
        if not address:
            check(error.code, error)
        return Scene._made(Handle(address, lambda: made))
