# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Parameters of a type as the C structs that a builder takes."""

import ctypes as c
import os
from typing import Any, Dict, List, Mapping, NamedTuple

import numpy

from . import _library as lib
from . import _values as values
from .errors import UsageError

_NUMBER, _BOOLEAN, _STRING, _TABLE = 1, 3, 4, 5
_RANK_MAX = 3


class Packed(NamedTuple):
    """Arguments for C, which point to what is kept; and the values as a document has them."""

    array: Any
    size: int
    written: Dict[str, Any]
    kept: List[Any]


def pack(parameters: Mapping[str, Any]) -> Packed:
    """Numbers, strings, booleans, dicts of numbers, sequences and arrays."""
    kept: List[Any] = []
    written: Dict[str, Any] = {}
    made = [argument(name, value, kept, written) for name, value in parameters.items()]
    return Packed((lib.Argument * max(len(made), 1))(*made), len(made), written, kept)


def argument(name: str, value: Any, kept: List[Any], written: Dict[str, Any]) -> lib.Argument:
    """The value by pointer and extents; what it points to is put into `kept`."""
    a = lib.Argument(name=values.text("name of a parameter", name), rank=0, extent=(1, 1, 1))
    if type(value) is list and value and all(type(x) is float for x in value):
        _row(a, name, value, kept, written)
    elif isinstance(value, numpy.ndarray):
        _numbers(a, name, value, kept, written)
    elif isinstance(value, (bool, numpy.bool_)):
        a.kind, a.single = _BOOLEAN, float(value)
        written[name] = bool(value)
    elif isinstance(value, (str, os.PathLike)):
        text = os.fspath(value)
        a.kind, a.text = _STRING, values.text(name, text)
        written[name] = text
    elif isinstance(value, Mapping):
        _table(a, name, value, kept, written)
    elif isinstance(value, (list, tuple)) and value and all(isinstance(x, str) for x in value):
        texts = (c.c_char_p * len(value))(*(values.text(name, x) for x in value))
        kept.append(texts)
        a.kind, a.rank, a.extent[0] = _STRING, 1, len(value)
        a.string = c.cast(texts, c.POINTER(c.c_char_p))
        written[name] = list(value)
    else:
        _numbers(a, name, value, kept, written)
    return a


def _table(a: lib.Argument, name: str, value: Mapping[str, Any], kept: List[Any],
           written: Dict[str, Any]) -> None:
    table = {values.text(f"{name}: a key", key): values.number(f"{name}: {key}", number)
             for key, number in value.items()}
    texts = (c.c_char_p * len(table))(*table)
    numbers = (c.c_double * len(table))(*table.values())
    kept += [texts, numbers]
    a.kind, a.extent[0] = _TABLE, len(table)
    a.string, a.number = c.cast(texts, c.POINTER(c.c_char_p)), c.cast(numbers, c.POINTER(c.c_double))
    written[name] = {key.decode(): number for key, number in table.items()}


def _row(a: lib.Argument, name: str, value: List[float], kept: List[Any], written: Dict[str, Any]) -> None:
    """A list of floats, without an array: what maps of robots and mechanisms have most of."""
    row = (c.c_double * len(value))(*value)
    kept.append(row)
    a.kind, a.rank, a.extent[0], a.number = _NUMBER, 1, len(value), row
    written[name] = list(value)


def _numbers(a: lib.Argument, name: str, value: Any, kept: List[Any],
             written: Dict[str, Any]) -> None:
    array = values.array(name, value)
    if numpy.ndim(value) == 0:
        a.kind, a.single = _NUMBER, float(array.reshape(()))
        written[name] = a.single
        return
    if array.ndim > _RANK_MAX:
        raise UsageError(f"{name}: an array of {array.ndim} dimensions, allowed are {_RANK_MAX}")
    kept.append(array)
    a.kind, a.rank = _NUMBER, array.ndim
    for k, extent in enumerate(array.shape):
        a.extent[k] = extent
    a.number = array.ctypes.data_as(c.POINTER(c.c_double))
    written[name] = array.copy() if isinstance(value, numpy.ndarray) else array
