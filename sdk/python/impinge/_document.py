# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Scenes as JSON: what `to_json`, `save` and pickle write, and what the command is given.

A document is the object of a scene file whose names of files are absolute, so that it means the same
wherever it is read."""

import copy
import json
import os
from typing import Any, Dict, List, Mapping, NamedTuple, Optional

import numpy

from ._registry import Registry

Document = Dict[str, Any]


class Where(NamedTuple):
    """A surface of a body (no map), one of its own maps, or a map of the body (no surface), by number."""

    body: int
    surface: Optional[int]
    map: Optional[int]


class Change(NamedTuple):
    """New parameters of a surface or a map; relative names of files begin at the folder."""

    parameters: Dict[str, Any]
    folder: str


_WIDTH = 100  # of a line, where that can be kept


def from_text(data: bytes, folder: str) -> Document:
    """The document of a text that the library has taken; relative names of files begin at `folder`."""
    document: Document = json.loads(data.decode("utf-8-sig"))
    _resolve(document, folder)
    return document


def resolved(document: Document, folder: str) -> Document:
    """A copy of plain lists and numbers whose names of files are absolute; relative ones begin at `folder`."""
    copied: Document = _plain(document)
    _resolve(copied, folder)
    return copied


def _resolve(value: Any, folder: str) -> None:
    """Makes the names of files in it absolute, in place."""
    if isinstance(value, list):
        for element in value:
            _resolve(element, folder)
    elif isinstance(value, dict):
        type_name = value.get("type")
        if isinstance(type_name, str):
            resolve_stage(type_name, value, folder)
        for element in value.values():
            if isinstance(element, (list, dict)):
                _resolve(element, folder)


def resolve_stage(type_name: str, parameters: Dict[str, Any], folder: str) -> None:
    """Makes the names of files among a type's parameters absolute, in place."""
    for name in Registry.files_of(type_name):
        if isinstance(parameters.get(name), str):
            parameters[name] = os.path.join(folder, parameters[name])
    for value in parameters.values():  # an array of numbers in a file, {"file": NAME}, perhaps with "array": NAME
        if isinstance(value, dict) and set(value) | {"array"} == {"file", "array"} and isinstance(value["file"], str):
            value["file"] = os.path.join(folder, value["file"])


def changed(document: Document, changes: Mapping[Where, Change]) -> Document:
    """A copy in which these surfaces and maps have other parameters."""
    made = copy.deepcopy(document)
    for where, change in changes.items():
        stage: Document = made["bodies"][where.body]
        if where.surface is not None:
            stage = _stage_of(made, stage, "surfaces", where.surface)
        if where.map is not None:
            stage = _stage_of(made, stage, "maps", where.map)
        kept = {name: stage[name] for name in ("type", "maps") if name in stage}
        stage.clear()
        stage.update(kept, **change.parameters)
        resolve_stage(stage["type"], stage, change.folder)
    return made


def _stage_of(made: Document, owner: Document, key: str, index: int) -> Document:
    """A surface or a map of a list, in which definitions are replaced by what they stand for."""
    owner[key] = _written_out(made, owner.get(key, []))
    stage: Document = owner[key][index]
    return stage


def _written_out(made: Document, stages: List[Any]) -> List[Any]:
    out: List[Any] = []
    for stage in stages:
        out += _written_out(made, made["define"][stage]) if isinstance(stage, str) else [copy.deepcopy(stage)]
    return out


def _plain(value: Any) -> Any:
    """The value with lists for arrays, and whole numbers without a fraction; -0.0 stays one."""
    if isinstance(value, numpy.ndarray):
        return _plain(value.tolist())
    if isinstance(value, (list, tuple)):
        return [_plain(element) for element in value]
    if isinstance(value, dict):
        return {key: _plain(element) for key, element in value.items()}
    if isinstance(value, float) and value.is_integer() and abs(value) < 2**53 and str(value) != "-0.0":
        return int(value)
    return value


def to_text(document: Document) -> str:
    """One line."""
    return json.dumps(_plain(document), ensure_ascii=False, allow_nan=False, separators=(",", ":"))


def to_pretty_text(document: Document) -> str:
    """Lines for people: what fits into one stands in one."""
    lines: List[str] = []
    _write(_plain(document), "", "", "", lines)
    return "\n".join(lines) + "\n"


def _write(value: Any, head: str, tail: str, indent: str, lines: List[str]) -> None:
    """Adds `head`, the value and `tail`: one line if it fits, or else a line for each element."""
    text = json.dumps(value, ensure_ascii=False, allow_nan=False)
    if len(indent) + len(head) + len(text) <= _WIDTH or not isinstance(value, (list, dict)) or not value:
        lines.append(indent + head + text + tail)
        return
    if isinstance(value, list):
        elements = [("", element) for element in value]
    else:
        elements = [(json.dumps(key, ensure_ascii=False) + ": ", value[key]) for key in value]
    brackets = "[]" if isinstance(value, list) else "{}"
    lines.append(indent + head + brackets[0])
    for k, (element_head, element) in enumerate(elements):
        _write(element, element_head, "," if k + 1 < len(elements) else "", indent + "  ", lines)
    lines.append(indent + brackets[1] + tail)
