# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""What `--check-matrix` prints, for people and as JSON."""

import dataclasses
from typing import Any, Dict, Iterable, List, Sequence, Tuple

from ._check import LinkPair

EXPECTED = ("Adjacent", "Default")  # reasons of pairs that may touch, and are not tested all the same


def is_claimed(pair: LinkPair) -> bool:
    """Whether the SRDF file says that the two never touch, or gives no reason."""
    return pair.reason is not None and pair.reason not in EXPECTED


def _range(ends: Tuple[float, float]) -> str:
    return f"{ends[0]:.4g} to {ends[1]:.4g}"


def _places(pair: LinkPair) -> str:
    """Where they touch, and where they do not."""
    text = ", ".join(f"{name} = {value:.6g}" for name, value in (pair.positions or {}).items())
    text = f" at {text}" if text else ", which no joint moves"
    for name, ranges in (pair.free or {}).items():
        text += f"; never where {name} is {' or '.join(map(_range, ranges))}"
    return text


def line_of(pair: LinkPair) -> str:
    """One line about a pair."""
    what = f"{pair.verdict:<10} {' and '.join(pair.links)}"
    if pair.reason is not None:
        what += f" ({pair.reason or 'no reason'})"
    if pair.verdict == "collides":
        return what + _places(pair)
    if pair.verdict == "never":
        return what
    return f"{what}: {100 * pair.proved:.4g} % of the positions proved free ({pair.why})"


def status_of(pairs: Sequence[LinkPair]) -> int:
    """0: all that the SRDF file claims to be apart is; 1: some pair of that collides; 3: some is undecided."""
    claimed = {pair.verdict for pair in pairs if is_claimed(pair)}
    return 1 if "collides" in claimed else 3 if "undecided" in claimed else 0


def summary_of(pairs: Sequence[LinkPair]) -> List[str]:
    """Lines at the end: how many of each verdict, and what the SRDF file could disable, or should not."""
    counts = {verdict: sum(pair.verdict == verdict for pair in pairs)
              for verdict in ("never", "collides", "undecided")}
    lines = [f"{len(pairs)} pairs: {', '.join(f'{count} {verdict}' for verdict, count in counts.items())}"]
    wrong = [pair for pair in pairs if is_claimed(pair) and pair.verdict == "collides"]
    more = [pair for pair in pairs if pair.reason is None and pair.verdict == "never"]
    if wrong:
        lines.append(f"disabled, but they collide: {_listed(wrong)}")
    if more:
        lines.append(f"may be disabled, proved: {_listed(more)}")
    return lines


def _listed(pairs: Iterable[LinkPair]) -> str:
    return "; ".join(" and ".join(pair.links) for pair in pairs)


def as_json(pairs: Sequence[LinkPair]) -> Dict[str, Any]:
    """One object about all."""
    return {"pairs": [dataclasses.asdict(pair) for pair in pairs],
            **{verdict: sum(pair.verdict == verdict for pair in pairs)
               for verdict in ("never", "collides", "undecided")}}
