# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""Scenes with parameters: one answer about all values."""

import math
import pickle

import impinge
import pytest


def arm(radius=0.25, reach=(0.0, 0.5), **shape):
    """A ball at the end of an arm of length 2 that turns by `a` and slides outward by `s`, and one that
    rests at (3, 0, 0): at a and s their centres are sqrt(9 + (2+s)^2 - 6 (2+s) cos a) apart."""
    builder = impinge.Builder(time=(0, 1), parameters={"a": (0.25, 1.5), "s": reach})
    shape = shape or {"type": "sphere", "radius": radius}
    builder.body("rest").surface(center=[3, 0, 0], **shape)
    moved = builder.body("hand").surface(center=[2, 0, 0], **shape)
    moved.map("translate", velocity=[1, 0, 0], clock="s").map("rotate", axis=[0, 0, 1], rate=1, clock="a")
    return builder.build()


def apart(a, s):
    return math.sqrt(9 + (2 + s) ** 2 - 6 * (2 + s) * math.cos(a))


def test_the_least_distance_over_all_values_is_that_of_the_law_of_cosines():
    scene, best = arm(), apart(0.25, 0.5) - 0.5
    found = scene.clearance(tolerance=1e-3)
    assert scene.parameters == {"a": (0.25, 1.5), "s": (0.0, 0.5)}
    assert found.lower <= best <= found.upper and found.lower >= (1 - 1e-3) * found.upper * (1 - 1e-15)
    assert apart(**found.parameters) - 0.5 <= found.upper * (1 + 1e-9)
    assert scene.clearance(required=0.99 * best).verdict == "holds"
    broken = scene.clearance(required=1.05 * best)
    assert broken.verdict == "violated" and apart(**broken.parameters) - 0.5 <= 1.05 * best


def test_a_tolerance_is_parameters_of_its_own():
    builder = impinge.Builder(gamma=1e-3)
    builder.body("part").surface("sphere", radius=1).map("tolerance", offset=0.25)
    builder.body("wall").surface("sphere", radius=1, center=[3.5, 0, 0])
    scene = builder.build()
    assert scene.parameters == {f"tolerance#{k}": (-0.25, 0.25) for k in (1, 2, 3)}
    found = scene.clearance(tolerance=0.05)
    assert found.lower <= 1.25 <= found.upper * (1 + 1e-9) and found.lower > 1.15
    assert found.parameters["tolerance#1"] > 0.15
    assert scene.clearance(required=1.2).verdict == "holds"
    assert scene.clearance(required=1.4).verdict == "violated"
    with pytest.raises(impinge.SceneError, match="clocks of its own"):
        impinge.Builder().body("part").surface("sphere").map("tolerance", offset=1, clock="a")


def test_a_contact_names_values_where_it_is():
    scene = arm(radius=0.5)
    found = scene.solve()
    assert found.verdict == "contact" and apart(**found.parameters) <= 1 + 1e-5
    assert found.bodies == ("rest", "hand")
    clear = arm().solve()
    assert clear.verdict == "clear" and clear.proved == 1 and clear.parameters is None


def test_a_scene_at_values_is_a_scene_without_parameters():
    scene = arm()
    one = scene.at({"a": 1.0, "s": 0.25})
    assert one.parameters == {} and one.clearance(tolerance=1e-9).upper == pytest.approx(apart(1.0, 0.25) - 0.5)
    assert scene.at({"a": 1.0}).clearance() == one.clearance()  # the middle of s
    assert pickle.loads(pickle.dumps(one)).clearance() == one.clearance()
    again = impinge.Scene.from_json(one.to_json())
    assert again.parameters == {"a": (1.0, 1.0), "s": (0.25, 0.25)}
    assert again.clearance(tolerance=1e-6).upper == pytest.approx(apart(1.0, 0.25) - 0.5, rel=1e-5)


def test_a_scene_with_parameters_is_written_and_read():
    scene = arm()
    for again in (impinge.Scene.from_json(scene.to_json()), pickle.loads(pickle.dumps(scene))):
        assert again.parameters == scene.parameters
        assert again.solve().verdict == "clear"


def test_a_limit_and_a_sink_leave_it_undecided():
    scene = arm(type="ellipsoid", radii=[0.4, 0.4, 0.4])  # balls take too few pairs
    assert scene.clearance(tolerance=1e-8, max_pairs=200).reason == "pairs"
    assert lasting().clearance(tolerance=1e-9, progress=lambda p: False).reason == "cancelled"


@pytest.mark.parametrize("ends", [(1, 0), (0, math.inf), (math.nan, 1), 3])
def test_wrong_ranges_are_named(ends):
    with pytest.raises(impinge.UsageError, match="parameters: a: got"):
        impinge.Builder(parameters={"a": ends})


def test_wrong_values_and_clocks_are_named():
    with pytest.raises(impinge.SceneError, match="time"):
        impinge.Builder(parameters={"time": (0, 1)})
    with pytest.raises(impinge.UsageError, match="at: got 'b', must be a parameter: a, s"):
        arm().at({"b": 1})
    with pytest.raises(impinge.ImpingeError):
        arm().at({"a": 9})
    builder = impinge.Builder(parameters={"a": (0, 1)})
    with pytest.raises(impinge.SceneError, match="clock"):
        builder.body("ball").surface("sphere").map("rotate", rate=1, clock="b")


def three(radius=0.25):
    """`arm` with a body that is far from both."""
    builder = impinge.Builder(time=(0, 1), parameters={"a": (0.25, 1.5), "s": (0, 0.5)})
    builder.body("rest").surface("sphere", radius=radius, center=[3, 0, 0])
    moved = builder.body("hand").surface("sphere", radius=radius, center=[2, 0, 0])
    moved.map("translate", velocity=[1, 0, 0], clock="s").map("rotate", axis=[0, 0, 1], rate=1, clock="a")
    builder.body("far").surface("sphere", center=[0, 0, 50])
    return builder.build()


def test_each_pair_is_answered_for_all_values():
    found = list(three(0.5).solve_each())
    assert [one.verdict for one in found] == ["contact", "clear", "clear"]
    assert found[0].bodies == ("rest", "hand") and apart(**found[0].parameters) <= 1 + 1e-5
    best = apart(0.25, 0.5) - 0.5
    answers = three().each(tolerance=1e-2)
    assert [one.bodies for one in answers][0] == ("rest", "hand") and len(answers) == 3
    assert answers[0].lower <= best <= answers[0].upper and answers[1].lower > 40
    assert answers == three().each(tolerance=1e-2, threads=1)
    near = three().each(tolerance=1e-2, within=1)
    assert [one.bodies for one in near] == [("rest", "hand")] and near[0].lower == answers[0].lower
    assert three().each(within=0.9 * best) == []
    with pytest.raises(impinge.UsageError, match="within: got 0.1"):
        three().each(within=0.1, required=0.2)


def lasting():
    """Two bodies whose distance, exactly, takes a long search."""
    builder = impinge.Builder(time=(0, 1), parameters={"a": (0.25, 1.5), "b": (0.25, 1.5), "s": (0, 0.5)})
    builder.body("rest").surface("ellipsoid", radii=[0.25, 0.3, 0.4], center=[3, 0, 0])
    moved = builder.body("hand").surface("ellipsoid", radii=[0.25, 0.3, 0.4], center=[2, 0, 0])
    moved.map("rotate", axis=[1, 1, 0], rate=1, clock="b").map("translate", velocity=[1, 0, 0], clock="s")
    moved.map("rotate", axis=[0, 0, 1], rate=1, clock="a")
    return builder.build()


def test_each_ends_at_a_limit_as_undecided():
    assert {one.verdict for one in three().each(required=0.3, max_seconds=1e-9)} == {"undecided"}
    assert {one.verdict for one in three(0.5).solve_each(max_seconds=1e-9)} == {"undecided"}
    told = []
    ended = lasting().each(tolerance=1e-9, threads=1, progress=lambda p: told.append(p) or False)
    assert len(told) == 1 and "cancelled" in {one.reason for one in ended}
    with pytest.raises(ZeroDivisionError):
        lasting().each(tolerance=1e-9, progress=lambda p: 1 / 0)


def test_a_profile_slices_time_or_a_parameter():
    scene = arm()
    over = scene.profile(4, over="s", tolerance=1e-2)
    assert over.over == "s" and list(over.t0) == [0, 0.125, 0.25, 0.375] and over.t1[-1] == 0.5
    for k in range(4):
        best = min(apart(0.25, over.t0[k]), apart(0.25, over.t1[k])) - 0.5
        assert over.lower[k] <= best * (1 + 1e-12) and over.upper[k] >= best * (1 - 1e-12)
        assert over.t0[k] <= over.parameters[k]["s"] <= over.t1[k]
    times = scene.profile(2, required=0.01, tolerance=1e-2)
    assert times.over is None and times.verdict == ("holds", "holds") and times.t1[-1] == 1
    assert len(scene.profile(3, over="a", max_seconds=1e-9)) == 3
    with pytest.raises(impinge.UsageError, match="over: got 'b'"):
        scene.profile(2, over="b")
    with pytest.raises(impinge.UsageError, match="slices"):
        scene.profile(0, over="a")


def test_refine_answers_at_each_gamma_for_all_values():
    found = list(arm(radius=0.5).refine([1e-3, 1e-1, 1e-2]))
    assert [one.gamma for one in found] == [1e-1, 1e-2, 1e-3]
    assert all(one.verdict == "contact" and one.gap <= one.gamma for one in found)
    assert all(apart(**one.parameters) - 1 <= one.gamma * (1 + 1e-9) for one in found)
