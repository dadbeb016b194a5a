# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""The Python module, over the library and plugins of the build tree."""

import os
import pathlib
import threading

import impinge
import numpy
import pytest

ARM = pathlib.Path(os.environ["top_srcdir"]) / "tools" / "data" / "arm.json"


def flying(speed: float = -2) -> impinge.Builder:
    builder = impinge.Builder(gamma=1e-6)
    builder.body("left").surface("sphere", radius=0.5)
    builder.body("right").surface("sphere", radius=0.5, center=numpy.array([2.0, 0, 0])).map(
        "translate", velocity=[speed, 0, 0])
    return builder


def test_a_scene_is_built_and_solved():
    result = flying().build().solve()
    assert result.verdict == "contact" and 0.4999 < result.t <= 0.5
    assert result.a.body == "left" and result.b.body == "right"
    assert result.gap <= 1e-6 and result.t == result.t_lower
    assert result.time_left(0.25) == result.t - 0.25
    assert "contact" in repr(result) and result.normal[0] > 0.99


def test_text_and_builder_give_the_same_bits():
    pair = impinge.Scene.from_pair("sphere radius=0.5",
                                   "sphere radius=0.5 center=2,0,0 ! translate velocity=-2,0,0")
    assert pair.solve().t == flying().build().solve().t


def test_control_points_go_in_and_points_come_out_as_arrays():
    u, v = numpy.meshgrid(numpy.linspace(-1, 1, 4), numpy.linspace(-1, 1, 4), indexing="ij")
    points = numpy.stack([u, v, 0 * u], axis=-1).reshape(-1, 3)
    builder = impinge.Builder()
    builder.body("sheet").surface("bezier", degree=[3, 3], points=points)
    scene = builder.build()
    x = scene.eval("sheet", 0, [[0, 0, 0], [1, 1, 0], [0.5, 0.5, 0]])
    assert numpy.allclose(x, [[-1, -1, 0], [1, 1, 0], [0, 0, 0]], atol=1e-15)


def test_clearance_is_a_bracket_and_a_profile_is_arrays():
    scene = impinge.Scene.from_pair("sphere", "sphere center=4,0,0 ! translate velocity=-1,0,0")
    clearance = scene.clearance(required=0.9)
    assert clearance.verdict == "holds"
    clearance = scene.clearance()
    assert clearance.lower <= 1 <= clearance.upper * (1 + 1e-9)
    assert clearance.upper - clearance.lower <= 1e-3 * clearance.upper
    profile = scene.profile(4)
    assert profile.lower.shape == (4,) and numpy.all(profile.lower <= profile.upper)
    assert numpy.all(numpy.abs(profile.upper - [1.75, 1.5, 1.25, 1]) < 2e-3)
    violated = scene.clearance(required=1.5)
    assert violated.verdict == "violated" and abs(violated.t_violated - 0.5) < 1e-3


def test_each_is_sorted_by_tightness():
    builder = impinge.Builder()
    for k, x in enumerate((0, 3, 9)):
        builder.body(f"b{k}").surface("sphere", center=[x, 0, 0])
    pairs = builder.build().each()
    assert [pair.bodies for pair in pairs] == [("b0", "b1"), ("b1", "b2"), ("b0", "b2")]


def test_a_batch_keeps_its_order_on_any_number_of_threads():
    speeds = [-2 - 0.125 * k for k in range(12)]
    times = [[r.t for r in impinge.batch((flying(s).build() for s in speeds), threads=n)]
             for n in (1, 4)]
    assert times[0] == times[1] and times[0] == sorted(times[0], reverse=True)


def test_one_scene_may_be_asked_by_many_threads():
    scene, found = flying().build(), []
    threads = [threading.Thread(target=lambda: found.append(scene.solve().t)) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 8 and len(set(found)) == 1


def test_errors_name_body_and_parameter():
    body = impinge.Builder().body("pot")
    with pytest.raises(impinge.SceneError, match="body 'pot': surface 0: radius: .*-1"):
        body.surface("sphere", radius=-1)
    with pytest.raises(impinge.SceneError, match="center: .*an array of 2"):
        body.surface("sphere", center=[1, 2])
    with pytest.raises(impinge.SceneError, match="center: extent 0 is 0"):
        body.surface("sphere", center=[])
    with pytest.raises(impinge.SceneError, match="nan"):
        body.surface("sphere", center=[1, 2, float("nan")])
    with pytest.raises(impinge.SceneError, match="did you mean 'sphere'"):
        body.surface("spere")
    with pytest.raises(impinge.UsageError, match="4 dimensions"):
        body.surface("bezier", points=numpy.zeros((1, 1, 1, 1)))
    with pytest.raises(impinge.FileError, match="cannot be read"):
        impinge.Scene.from_file("nowhere.json")
    with pytest.raises(impinge.UsageError, match="required"):
        flying().build().clearance(required=0)
    with pytest.raises(impinge.UsageError, match="gamma"):
        flying().build().solve(gamma=-1)


def test_a_builder_that_is_done_is_refused():
    builder = flying()
    builder.build()
    with pytest.raises(impinge.UsageError, match="has made its scene already"):
        builder.body("late")


def test_parents_groups_and_files_make_an_arm():
    scene = impinge.Scene.from_file(ARM)
    clearance = scene.clearance(required=2)
    assert clearance.verdict == "holds" and clearance.lower >= 2 * (1 - 1e-6)
    assert {clearance.a.body, clearance.b.body} == {"link5", "fixture"}
