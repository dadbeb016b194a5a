# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Scenes of documents, without text: arrays go by pointer, and what many scenes have in common is made into
arguments once."""

import ctypes as c
import os
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Tuple

from . import _arguments as arguments
from . import _document as document
from . import _library as lib
from . import _values as values
from ._handle import Handle
from ._registry import Registry
from .errors import check
from .scene import Scene

_BODY_KEYS = {"name", "surfaces", "maps", "parent", "group"}


class Source(NamedTuple):
    """A surface of a scene that this process has made."""

    handle: Handle
    process: int
    body: int
    surface: int


class Stage(Dict[str, Any]):
    """A surface or a map of a document that may be in many documents, and is not changed any more. What the
    library takes for it is made once; a surface with a source is that one of another scene, shared."""

    packed: Optional[Tuple[bytes, arguments.Packed]] = None
    source: Optional[Source] = None

    def __reduce__(self) -> Any:
        return Stage, (dict(self),)


def _packed(stage: Mapping[str, Any]) -> Tuple[bytes, arguments.Packed]:
    if isinstance(stage, Stage) and stage.packed is not None:
        return stage.packed
    parameters = {name: value for name, value in stage.items() if name not in ("type", "maps")}
    made = values.text("type", stage["type"]), arguments.pack(parameters)
    if isinstance(stage, Stage):
        stage.packed = made
    return made


class _Assembly:
    """A builder of the library, freed at the end of its `with`."""

    def __init__(self) -> None:
        self._error = lib.Error()
        self._error_at = c.byref(self._error)
        self._builder = lib.library.imp_builder_new(Registry.handle())
        if not self._builder:
            raise MemoryError("out of memory")

    def __enter__(self) -> "_Assembly":
        return self

    def __exit__(self, *_: Any) -> None:
        lib.library.imp_builder_free(self._builder)

    def call(self, function: Any, *given: Any) -> None:
        code = function(self._builder, *given, self._error_at)
        if code != 0:
            check(code, self._error)

    def add(self, function: Any, stage: Mapping[str, Any], *where: int) -> None:
        name, packed = _packed(stage)
        self.call(function, *where, name, packed.array, packed.size)

    def surface(self, index: int, surface: Mapping[str, Any]) -> None:
        source = surface.source if isinstance(surface, Stage) else None
        if source is None or source.process != os.getpid():  # a fork may have left it half-made
            self.add(lib.library.imp_builder_surface, surface, index)
        else:
            self.call(lib.library.imp_builder_surface_of, index, source.handle.address, source.body,
                      source.surface)

    def body(self, index: int, body: Mapping[str, Any]) -> None:
        self.call(lib.library.imp_builder_body, values.text("name", body["name"]), None)
        for k, surface in enumerate(body.get("surfaces", ())):
            self.surface(index, surface)
            for stage in surface.get("maps", ()):
                self.add(lib.library.imp_builder_surface_map, stage, index, k)
        for stage in body.get("maps", ()):
            self.add(lib.library.imp_builder_map, stage, index)
        for group in body.get("group", ()):
            self.call(lib.library.imp_builder_group, index, values.text("group", group))

    def finish(self) -> int:
        address = lib.library.imp_builder_finish(self._builder, c.byref(self._error))
        if not address:
            check(self._error.code, self._error)
        return int(address)


def _is_plain(made: document.Document) -> bool:
    """Whether the builder knows everything in it; stages are objects with a type."""
    for body in made["bodies"]:
        stages = [*body.get("surfaces", ()), *body.get("maps", ())]
        stages += [one for surface in body.get("surfaces", ())
                   if isinstance(surface, dict) for one in surface.get("maps", ())]
        if not _BODY_KEYS.issuperset(body) or isinstance(body.get("group"), str) or not all(
                type(stage) is Stage or (isinstance(stage, dict) and isinstance(stage.get("type"), str))
                for stage in stages):
            return False
    return True


def scene_of(made: document.Document, name: str) -> Scene:
    """The scene of a document with "time", "bodies" and "ignore", which is not changed any more. Relative
    names of files begin at the working directory. `name` stands for it in errors."""
    if not _is_plain(made):
        return Scene.from_json(document.to_text(made), name=name)
    folder = os.getcwd()
    with _Assembly() as assembly:
        assembly.call(lib.library.imp_builder_time, *made["time"])
        for name, ends in made.get("parameters", {}).items():
            assembly.call(lib.library.imp_builder_parameter, values.text("parameters", name), *ends)
        index = {}
        for k, body in enumerate(made["bodies"]):
            assembly.body(k, body)
            index[body["name"]] = k
        for k, body in enumerate(made["bodies"]):
            if "parent" in body:
                if body["parent"] not in index:
                    raise values.refuse(f"{body['name']}: parent", body["parent"], "the name of a body")
                assembly.call(lib.library.imp_builder_parent, k, index[body["parent"]])
        for x, y in made["ignore"]:
            assembly.call(lib.library.imp_builder_ignore, values.text("ignore", x), values.text("ignore", y))
        return Scene._made(Handle(assembly.finish(), lambda: document.resolved(made, folder)))


def share(surfaces: Iterable[Stage]) -> None:
    """Makes these surfaces once for all scenes of this process: what their files hold is read, and what
    queries find out about all of their pieces is kept, as long as they live."""
    listed: List[Stage] = list(surfaces)
    with _Assembly() as assembly:
        assembly.call(lib.library.imp_builder_time, 0.0, 1.0)
        assembly.call(lib.library.imp_builder_body, None, None)
        for surface in listed:
            assembly.add(lib.library.imp_builder_surface, surface, 0)
        made: document.Document = {"bodies": [{"surfaces": listed}]}
        handle = Handle(assembly.finish(), lambda: made)
    for k, surface in enumerate(listed):
        surface.source = Source(handle, os.getpid(), 0, k)
