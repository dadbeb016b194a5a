# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""What mypy --strict says of programs that use the module. It is only checked, never run. Each line that
is wrong is marked with the error that mypy must find in it: a mark that is not needed is an error, too."""

import pathlib
from typing import List, Literal, Optional, Tuple

import impinge
import numpy


def answers(scene: impinge.Scene) -> Optional[float]:
    result: impinge.Result = scene.solve(gamma=1e-6, time=(0, 1), max_seconds=1)
    verdict: Literal["clear", "contact", "undecided"] = result.verdict
    if verdict == "contact" and result.a is not None:
        names: Tuple[str, int] = (result.a.body, result.a.surface)
        print(names)
    if result.verdict == "contacts":  # type: ignore[comparison-overlap]
        return None
    pairs: List[impinge.Clearance] = scene.each(required=0.1, threads=2)
    if pairs[0].verdict == "hold":  # type: ignore[comparison-overlap]
        return None
    scene.clearance(requierd=2)  # type: ignore[call-arg]
    scene.set_values("a", {"radius": 2}, surface=0, map=None)
    scene.set_values("a", {"radius": 2}, surfaces=0)  # type: ignore[call-arg]
    scene.solve(gamma=1e-3, proof=pathlib.Path("a.proof"))
    scene.clearance(proof=2)  # type: ignore[arg-type]
    scene.solve(max_pears=2)  # type: ignore[call-arg]
    scene.solve(max_pairs="2")  # type: ignore[arg-type]
    profile = scene.profile(10, progress=lambda progress: progress.pairs < 1000)
    return float(profile.lower.min())


def scenes() -> impinge.Scene:
    builder = impinge.Builder(time=(0, 2), gamma_clear=1e-8)
    body: impinge.Body = builder.body("a", group=["x"])
    body.surface("mesh", file=pathlib.Path("a.off")).map("rotate", axis=[0, 0, 1], rate=1)
    body.surface("bezier", degree=[1, 1], points=numpy.zeros((4, 3)), maps=[("rotate", {"rate": 2})])
    builder.body(5)  # type: ignore[arg-type]
    impinge.Scene(5)  # type: ignore[arg-type]
    return builder.build()


class Own(impinge.Scene):
    """A class of a user."""


def made() -> Own:
    return Own.from_json(Own("scene.json").to_json())
