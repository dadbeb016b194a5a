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

    def begin(self, head: document.Document) -> None:
        """The times, and the parameters."""
        self.call(lib.library.imp_builder_time, *head["time"])
        for name, ends in head.get("parameters", {}).items():
            self.call(lib.library.imp_builder_parameter, values.text("parameters", name), *ends)

    def bodies(self, made: document.Document) -> None:
        """Its bodies without their parents, and who ignores whom."""
        for k, body in enumerate(made["bodies"]):
            self.body(k, body)
        for x, y in made["ignore"]:
            self.call(lib.library.imp_builder_ignore, values.text("ignore", x), values.text("ignore", y))

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
        assembly.begin(made)
        assembly.bodies(made)
        for k, parent in _parents(made["bodies"]):
            assembly.call(lib.library.imp_builder_parent, k, parent)
        return Scene._made(Handle(assembly.finish(), lambda: document.resolved(made, folder)))


def _parents(bodies: List[Mapping[str, Any]]) -> List[Tuple[int, int]]:
    """The numbers of bodies and of their parents."""
    index = {body["name"]: k for k, body in enumerate(bodies)}
    parents = []
    for k, body in enumerate(bodies):
        if "parent" in body:
            if body["parent"] not in index:
                raise values.refuse(f"{body['name']}: parent", body["parent"], "the name of a body")
            parents.append((k, index[body["parent"]]))
    return parents


class Template:
    """What many scenes have in common: a document's bodies and "ignore", without the maps of some bodies.
    A process makes a scene of it once, and begins others with that."""

    def __init__(self, bodies: List[Mapping[str, Any]], ignore: List[Any]):
        self._made: document.Document = {"time": [0.0, 0.0], "bodies": bodies, "ignore": ignore}
        self._names = tuple(body["name"] for body in bodies)
        self._is_plain = _is_plain(self._made)
        self._parents = _parents(bodies)
        self._begun: Optional[Tuple[int, Handle]] = None  # the process that made it

    def _handle(self) -> Handle:
        begun = self._begun
        if begun is None or begun[0] != os.getpid():  # a fork may have left it half-made
            with _Assembly() as assembly:
                assembly.bodies(self._made)
                begun = os.getpid(), Handle(assembly.finish(), lambda: self._made)
            self._begun = begun
        return begun[1]

    def _document(self, head: document.Document, maps: Mapping[int, List[Stage]]) -> document.Document:
        bodies = [{**body, "maps": maps[k]} if k in maps else body for k, body in enumerate(self._made["bodies"])]
        return {**head, "bodies": bodies, "ignore": self._made["ignore"]}

    def scene(self, head: document.Document, maps: Mapping[int, List[Stage]], name: str) -> Scene:
        """The scene with the head's "time" and "parameters", and maps of bodies that have none, by number."""
        if not self._is_plain or "parameters" in head:
            return scene_of(self._document(head, maps), name)
        folder, begun = os.getcwd(), self._handle()
        with _Assembly() as assembly:
            assembly.call(lib.library.imp_builder_bodies_of, begun.address)
            assembly.begin(head)
            for k, stages in maps.items():
                for stage in stages:
                    assembly.add(lib.library.imp_builder_map, stage, k)
            for k, parent in self._parents:
                assembly.call(lib.library.imp_builder_parent, k, parent)
            handle = Handle(assembly.finish(), lambda: document.resolved(self._document(head, maps), folder))
        return Scene._made(handle, self._names)


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
