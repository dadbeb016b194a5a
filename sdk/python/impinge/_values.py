# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Arguments of Python as the values that libimpinge takes, or a UsageError that names the argument.

ctypes would wrap -1 and 2**64 to counts, cut a text at its first NUL, and tell of "argument 3"."""

import operator
import os
from typing import Any, Sequence, Tuple, Union

import numpy
from numpy.typing import NDArray

from .errors import UsageError

COUNT_MAX = 2**64 - 1
THREADS_MAX = 1024
Floats = NDArray[numpy.float64]
Path = Union[str, "os.PathLike[str]"]


def shown(value: object) -> str:
    """The value as error messages show it: short, and never an exception."""
    try:
        text = repr(value)
    except Exception:
        text = f"an object of type {type(value).__name__}"
    return text if len(text) <= 60 else text[:57] + "..."


def refuse(name: str, value: object, allowed: str) -> UsageError:
    """The error for a value that is not allowed."""
    return UsageError(f"{name}: got {shown(value)}, must be {allowed}")


def _is_number(value: object) -> bool:
    if isinstance(value, (bool, numpy.bool_, str, bytes, bytearray, complex, numpy.complexfloating)):
        return False
    if isinstance(value, numpy.ndarray):
        is_plain = not isinstance(value, numpy.ma.MaskedArray)
        return is_plain and value.ndim == 0 and value.dtype.kind in "iuf"
    return hasattr(value, "__float__") or hasattr(value, "__index__")


def number(name: str, value: Any, allowed: str = "a number") -> float:
    """A number that is not NaN; infinite ones are the library's to judge."""
    if not _is_number(value):
        raise refuse(name, value, allowed)
    try:
        result = float(value)
    except (TypeError, ValueError, OverflowError):
        raise refuse(name, value, allowed) from None
    if result != result:
        raise refuse(name, value, allowed)
    return result


def count(name: str, value: Any, most: int = COUNT_MAX) -> int:
    """A whole number from 0 to `most`."""
    allowed = f"a whole number from 0 to {most}"
    if isinstance(value, (bool, numpy.bool_)):
        raise refuse(name, value, allowed)
    try:
        result = operator.index(value)
    except TypeError:
        raise refuse(name, value, allowed) from None
    if not 0 <= result <= most:
        raise refuse(name, value, allowed)
    return result


def threads(value: Any) -> int:
    """How many threads; None: as many as processors that this process may use."""
    if value is None:
        return len(os.sched_getaffinity(0))
    result = count("threads", value, THREADS_MAX)
    if result == 0:
        raise refuse("threads", value, f"a whole number from 1 to {THREADS_MAX}")
    return result


def text(name: str, value: Any) -> bytes:
    """A text that C can take: UTF-8 without a NUL."""
    if not isinstance(value, str):
        raise refuse(name, value, "a text (str)")
    if "\0" in value:
        raise refuse(name, value, "a text without NUL characters")
    try:
        return value.encode()
    except UnicodeEncodeError:
        raise refuse(name, value, "a text that can be written as UTF-8") from None


def path(name: str, value: Any) -> str:
    """A path as a text, without a NUL."""
    try:
        result = os.fsdecode(os.fsencode(value))
    except (TypeError, UnicodeError):
        raise refuse(name, value, "a path (str or os.PathLike)") from None
    if not result or "\0" in result:
        raise refuse(name, value, "a path: not empty, without NUL characters")
    return result


def interval(name: str, value: Any) -> Tuple[float, float]:
    """Two numbers: start and end."""
    allowed = "two numbers (start, end)"
    try:
        start, end = value
    except (TypeError, ValueError):
        raise refuse(name, value, allowed) from None
    return number(name, start, allowed), number(name, end, allowed)


def array(name: str, value: Any) -> Floats:
    """Numbers as a contiguous array of doubles, which is the value itself where it is one already."""
    if isinstance(value, numpy.ma.MaskedArray):
        raise UsageError(f"{name}: got a masked array, must be numbers; fill in what is masked")
    try:
        found = numpy.asarray(value)
    except (TypeError, ValueError, OverflowError):
        raise refuse(name, value, "numbers in rows of equal length") from None
    if found.dtype.kind not in "iuf":
        raise UsageError(f"{name}: got {shown(value)}, an array of {found.dtype}, must be numbers")
    return numpy.ascontiguousarray(found, dtype=numpy.float64)


def rows(name: str, value: Any, columns: Sequence[str]) -> Floats:
    """Numbers as rows with these columns; a single row may stand without its brackets."""
    found = array(name, value)
    if found.ndim not in (1, 2) or found.shape[-1] != len(columns):
        raise UsageError(f"{name}: got an array of shape {found.shape}, must be rows of "
                         f"({', '.join(columns)})")
    return found.reshape(-1, len(columns))
