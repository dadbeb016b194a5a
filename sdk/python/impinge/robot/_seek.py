# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Positions at which two links touch, sought by descent on their distance."""

import random
from typing import Callable, Dict, List, Mapping, Optional, Sequence, Tuple

Ranges = Mapping[str, Tuple[float, float]]
Distance = Callable[[Sequence[float]], float]

_SAMPLES = 200  # random positions at first, of which
_STARTS = 4  # the nearest are improved,
_STEPS = 100  # each by so many tries,
_WIDEST = 0.1  # normal steps of this part of a range at first, and
_SHRINK = 0.93  # of this part of the last after a try that is no nearer


def _step(source: random.Random, at: Sequence[float], ranges: Sequence[Tuple[float, float]],
          part: float) -> List[float]:
    return [min(max(x + source.gauss(0, part * (hi - lo)), lo), hi) for x, (lo, hi) in zip(at, ranges)]


def touching(ranges: Ranges, distance: Distance, gamma: float) -> Optional[Dict[str, float]]:
    """Positions at which the distance is at most gamma, or None where no try finds any: that proves nothing.
    The tries are the same in every run."""
    source, ends = random.Random(0), list(ranges.values())
    samples = [[source.uniform(lo, hi) for lo, hi in ends] for _ in range(_SAMPLES)]
    for length, at in sorted((distance(one), one) for one in samples)[:_STARTS]:
        part = _WIDEST
        for _ in range(_STEPS):
            if length <= gamma:
                return dict(zip(ranges, at))
            other = _step(source, at, ends, part)
            nearer = distance(other)
            if nearer < length:
                length, at = nearer, other
            else:
                part *= _SHRINK
    return None
