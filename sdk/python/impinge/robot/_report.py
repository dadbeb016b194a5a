# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Answers about a robot's motion, for people and as JSON."""

import dataclasses
import math
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

import numpy

from ..results import Clearance, Result
from ..scene import Scene

_REASONS = {"pairs": "max-pairs", "seconds": "max-seconds", "memory": "max-bytes"}  # as the command calls them


class Samples(NamedTuple):
    """What poses at so many times, evenly from the first to the last, show: how many are in contact, or too
    near, and the first of these."""

    poses: int
    touching: int
    first: Optional[float]


class Answer(NamedTuple):
    """The answer about a motion. With a required distance `clearance` is that, and `contact` the search for
    a contact that followed a violation."""

    contact: Optional[Result]
    clearance: Optional[Clearance]
    samples: Optional[Samples]
    notes: List[str]  # what was left out of the input
    robust: Optional[Tuple[float, float]] = None  # how far joints, and bodies, may be off: an angle, a length

    @property
    def verdict(self) -> str:
        """clear, contact, holds, violated or undecided."""
        if self.clearance is not None:
            return self.clearance.verdict or "undecided"
        return self.contact.verdict if self.contact is not None else "undecided"


def sample(scene: Scene, span: Tuple[float, float], count: int, required: Optional[float],
           gamma: Optional[float]) -> Samples:
    """Asks about single poses, one after the other, as those do who sample."""
    first, touching = None, 0
    for t in map(float, numpy.linspace(span[0], span[1], count)):
        if required is None:
            hit = scene.solve(time=(t, t), gamma=gamma).verdict == "contact"
        else:
            hit = scene.clearance(time=(t, t), gamma=gamma, required=required).verdict == "violated"
        touching += hit
        first = t if hit and first is None else first
    return Samples(count, touching, first)


# --- JSON ---------------------------------------------------------------------------------------------


def _plain(value: Any) -> Any:
    """For JSON, which has no infinite numbers."""
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if isinstance(value, dict):
        return {key: _plain(one) for key, one in value.items()}
    return [_plain(one) for one in value] if isinstance(value, (list, tuple)) else value


def _keys(answer: Any, *names: str) -> Dict[str, Any]:
    """These members, under the names that the command gives them."""
    found = dataclasses.asdict(answer)
    head = {"verdict": found["verdict"], "reason": _REASONS.get(found["reason"], found["reason"]),
            "time": [found["t_start"], found["t_end"]]}
    return {**head, **{name: found[name] for name in (*names, "stats")}}


def _solved(answer: Result) -> Dict[str, Any]:
    made = _keys(answer, "t", "t_lower", "t_examined", "gap", "gamma", "gamma_clear", "a", "b", "normal")
    if answer.bodies is not None:
        made["bodies"] = answer.bodies
    return made


def _measured(answer: Clearance) -> Dict[str, Any]:
    made = _keys(answer, "required", "lower", "upper", "t", "a", "b", "normal")
    if answer.bodies is not None:
        made["bodies"] = answer.bodies
    if answer.verdict == "violated":
        made.update({name: getattr(answer, name) for name in ("t_violated", "gap_violated")})
        for name in ("a_violated", "b_violated"):
            side = getattr(answer, name)
            made[name] = None if side is None else dataclasses.asdict(side)
        if answer.a_violated is not None and answer.b_violated is not None:
            made["bodies"] = [answer.a_violated.body, answer.b_violated.body]
    return made


def as_json(answer: Answer) -> Dict[str, Any]:
    """The object as of `impinge solve --json`, or of `impinge clearance --json`."""
    if answer.clearance is None:
        made = _solved(answer.contact) if answer.contact is not None else {}
    else:
        made = _measured(answer.clearance)
        if answer.contact is not None:
            made["contact"] = _solved(answer.contact)
    if answer.samples is not None:
        made["samples"] = answer.samples._asdict()
    if answer.notes:
        made["notes"] = answer.notes
    if answer.robust is not None and answer.clearance is not None:
        made["robust"] = {"angle": answer.robust[0], "length": answer.robust[1]}
        made.update(parameters=answer.clearance.parameters, proved=answer.clearance.proved)
    plain: Dict[str, Any] = _plain({**made, "text": as_text(answer)})
    return plain


# --- Text -------------------------------------------------------------------------------------------


def _time(t: float) -> str:
    return f"{t:.6g}"


def _length(length: float) -> str:
    """A length in m as people write it."""
    return f"{length * 1000:.4g} mm" if length < 0.1 else f"{length:.4g} m"


def _names(bodies: Optional[Tuple[str, str]], verb: str) -> str:
    a, b = bodies or ("something", "something")
    return f"{a} {verb} {b}"


def _contact_words(found: Result, bodies: Optional[Tuple[str, str]]) -> str:
    """The end of a line about a violation between these bodies."""
    if found.verdict == "contact" and found.t is not None:
        between = "" if found.bodies is None or bodies is None or set(found.bodies) == set(bodies) \
            else f", {_names(found.bodies, 'and')}"
        return f"first contact at t = {_time(found.t)}{between}"
    if found.verdict == "clear":
        return "no contact, proved"
    return f"contact undecided ({found.reason}), proved clear before t = {_time(found.t_lower)}"


def _robust_words(answer: Clearance, robust: Tuple[float, float]) -> str:
    """The end of a line about a motion that is not exact."""
    words = f", with joints off by up to {robust[0]:.4g} rad or {_length(robust[1])}"
    if robust[1] > 0:
        words += f" and each body by up to {_length(robust[1])}"
    off = {name: value for name, value in (answer.parameters or {}).items() if value != 0}
    if answer.verdict == "violated" and off:
        words += f": {', '.join(f'{name} = {value:.4g}' for name, value in off.items())}"
    return words


def _clearance_text(answer: Clearance, contact: Optional[Result], off: float = 0) -> str:
    """`off`: so much of what was required is for bodies that are not where they should be."""
    span = f"from t = {_time(answer.t_start)} to {_time(answer.t_end)}"
    distance = _length((answer.required or 0) - off)
    if answer.verdict == "holds":
        return f"holds: nothing comes within {distance} {span}, proved"
    if answer.verdict != "violated":
        return f"undecided ({answer.reason}): whether anything comes within {distance} {span}"
    sides = answer.a_violated, answer.b_violated
    bodies = answer.bodies if sides[0] is None or sides[1] is None else (sides[0].body, sides[1].body)
    when = "" if answer.t_violated is None else f" at t = {_time(answer.t_violated)}"
    if answer.t_violated == answer.t_start:
        line = f"violated: {_names(bodies, 'is within ' + distance + ' of')} from the start"
    else:
        line = f"violated: {_names(bodies, 'comes within ' + distance + ' of')}{when}"
    return line if contact is None else f"{line}; {_contact_words(contact, bodies)}"


def _contact_text(answer: Result) -> str:
    if answer.verdict == "contact" and answer.t is not None:
        when = "from the start" if answer.t == answer.t_start else f"at t = {_time(answer.t)}"
        return f"contact: {_names(answer.bodies, 'touches')} {when}; nothing touches before, proved"
    span = f"from t = {_time(answer.t_start)} to {_time(answer.t_end)}"
    if answer.verdict == "clear":
        return f"clear: nothing touches {span}, proved"
    return f"undecided ({answer.reason}): nothing touches before t = {_time(answer.t_lower)}, proved"


def _first_of(answer: Answer) -> Optional[float]:
    if answer.clearance is not None:
        return answer.clearance.t_violated if answer.clearance.verdict == "violated" else None
    return answer.contact.t if answer.contact is not None else None


def _samples_text(answer: Answer, samples: Samples) -> str:
    what = "touch" if answer.clearance is None else "are too near"
    line = f"sampling {samples.poses} poses: "
    first = _first_of(answer)
    if samples.first is None:
        return line + ("none of them shows it" if first is not None else f"none of them {what}")
    line += f"{samples.touching} {what}, the first at t = {_time(samples.first)}"
    return line if first is None else f"{line}, {_time(samples.first - first)} late"


def as_text(answer: Answer) -> str:
    """One line; a second one about samples."""
    if answer.clearance is not None and answer.robust is not None:
        line = _clearance_text(answer.clearance, None, 2 * answer.robust[1])
        line += _robust_words(answer.clearance, answer.robust)
    elif answer.clearance is not None:
        line = _clearance_text(answer.clearance, answer.contact)
    else:
        line = _contact_text(answer.contact) if answer.contact is not None else "undecided"
    return line if answer.samples is None else f"{line}\n{_samples_text(answer, answer.samples)}"
