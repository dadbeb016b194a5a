# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Surfaces as triangles, for those who draw with other programs."""

import ctypes as c
from dataclasses import dataclass
from typing import List, Optional, Tuple

import numpy
from numpy.typing import NDArray

from . import _library as lib
from ._handle import Handle
from ._values import Floats
from .errors import check

_STEPS_MAX = 512  # in u, and in v
_FEW = 64  # pieces: so many may each be looked at closely
_PART = 1e-3  # of the body's size: the tolerance unless one is given


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles: rows of indices of `points`, which are rows of (x, y, z)."""

    points: Floats
    triangles: NDArray[numpy.int64]


class _Sampler:
    """Points of one body at one time."""

    def __init__(self, scene: Handle, body: int, t: float):
        self._scene, self._body, self._t = scene, body, t

    def pieces(self) -> List[lib.Place]:
        """Everything of the body that is there at that time."""
        address, found = self._scene.address, []
        for surface in range(lib.library.imp_scene_surface_count(address, self._body)):
            for piece in range(lib.library.imp_scene_piece_count(address, self._body, surface)):
                place = lib.Place(self._body, surface, piece)
                lo, hi = self.domain(place)
                if lo[2] <= self._t <= hi[2]:
                    found.append(place)
        return found

    def domain(self, place: lib.Place) -> Tuple["c.Array[c.c_double]", "c.Array[c.c_double]"]:
        """The ends of u, v and t."""
        lo, hi = (c.c_double * 3)(), (c.c_double * 3)()
        lib.library.imp_piece_domain(self._scene.address, place, lo, hi)
        return lo, hi

    def grid(self, place: lib.Place, steps: Tuple[int, int]) -> Floats:
        """Points [i, j] of steps + 1 equal parts of the domain of u and v."""
        lo, hi = self.domain(place)
        p = numpy.empty((steps[0] + 1, steps[1] + 1, 3))
        p[:, :, 0] = numpy.linspace(lo[0], hi[0], steps[0] + 1)[:, None]
        p[:, :, 1] = numpy.linspace(lo[1], hi[1], steps[1] + 1)[None, :]
        p[:, :, 2] = self._t
        x, error = numpy.empty_like(p), lib.Error()
        check(lib.library.imp_piece_eval(self._scene.address, place, p[:, :, 0].size, p.ctypes.data,
                                         x.ctypes.data, None, c.byref(error)), error)
        return x


def _bend(grid: Floats, axis: int, stride: int) -> float:
    """How far points lie at most from the lines through every `stride`th point along an axis."""
    x = numpy.moveaxis(grid, axis, 0)
    ends, worst = x[::stride], 0.0
    for k in range(1, stride):
        line = ends[:-1] + (ends[1:] - ends[:-1]) * (k / stride)
        worst = max(worst, float(numpy.abs(x[k::stride] - line).max()))
    return worst


def _finest(sampler: _Sampler, place: lib.Place, start: int, tolerance: float) -> Floats:
    """A grid that twice as wide would still be within the tolerance, or as fine as allowed."""
    steps = [start, start]
    while True:
        grid = sampler.grid(place, (steps[0], steps[1]))
        wanted = [axis for axis in (0, 1)
                  if steps[axis] < _STEPS_MAX and _bend(grid, axis, 2) > tolerance]
        if not wanted:
            return grid
        for axis in wanted:
            steps[axis] *= 2


def _thinned(grid: Floats, tolerance: float) -> Floats:
    """Without the lines that are not needed."""
    for axis in (0, 1):
        stride, steps = 1, grid.shape[axis] - 1
        while 2 * stride <= steps and _bend(grid, axis, 2 * stride) <= tolerance:
            stride *= 2
        grid = grid[::stride] if axis == 0 else grid[:, ::stride]
    return grid


def _cells(rows: int, columns: int) -> NDArray[numpy.int64]:
    """Two triangles for each cell of a grid."""
    k = numpy.arange(rows * columns).reshape(rows, columns)
    a, b, d, e = k[:-1, :-1], k[1:, :-1], k[:-1, 1:], k[1:, 1:]
    corners: NDArray[numpy.int64] = numpy.stack([a, b, e, a, e, d], axis=-1).reshape(-1, 3)
    return corners


def make(scene: Handle, body: int, t: float, tolerance: Optional[float]) -> Mesh:
    """The triangles of a body at time t; between their corners surfaces bend away by about `tolerance` at
    most, as far as points between them show."""
    sampler = _Sampler(scene, body, t)
    pieces = sampler.pieces()
    start = 8 if len(pieces) <= _FEW else 2
    first = [sampler.grid(place, (2, 2)) for place in pieces]
    if tolerance is None and first:
        all_points = numpy.concatenate([grid.reshape(-1, 3) for grid in first])
        tolerance = _PART * float(numpy.linalg.norm(numpy.ptp(all_points, axis=0)))
    points: List[Floats] = [numpy.zeros((0, 3))]
    triangles: List[NDArray[numpy.int64]] = [numpy.zeros((0, 3), numpy.int64)]
    count = 0
    for place, coarse in zip(pieces, first):
        bent = start > 2 or max(_bend(coarse, 0, 2), _bend(coarse, 1, 2)) > (tolerance or 0)
        grid = _thinned(_finest(sampler, place, start, tolerance or 0) if bent else coarse, tolerance or 0)
        triangles.append(_cells(grid.shape[0], grid.shape[1]) + count)
        points.append(grid.reshape(-1, 3))
        count += len(points[-1])
    return _without_slivers(numpy.concatenate(points), numpy.concatenate(triangles))


def _without_slivers(points: Floats, triangles: NDArray[numpy.int64]) -> Mesh:
    """Without triangles that have no area, as at poles."""
    a, b, d = (points[triangles[:, k]] for k in range(3))
    area = numpy.linalg.norm(numpy.cross(b - a, d - a), axis=1)
    return Mesh(points, triangles[area > 0])
