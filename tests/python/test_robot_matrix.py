# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""Pairs of links over all positions of the joints between them."""

import json

import numpy
import pytest
from impinge import errors as errors_module
from impinge import robot
from impinge.robot import __main__ as command
from impinge.robot import _check, _seek

from support import SOURCE

ARM = SOURCE / "tools" / "data" / "arm.urdf"
SRDF = SOURCE / "tools" / "data" / "arm.srdf"
SHELF = SOURCE / "tools" / "data" / "arm_shelf.yaml"


@pytest.fixture(scope="module")
def arm():
    return robot.load(ARM, SRDF)


@pytest.fixture(scope="module")
def checked(arm):
    return {pair.links: pair for pair in arm.check_matrix(max_seconds=60)}


def still(arm, positions):
    """The robot at these positions, with no pair left out that a joint does not connect."""
    rows = {name: [value, value] for name, value in positions.items()}
    return arm.scene([0, 1], rows, allowed=[])


def distance(arm, pair, positions):
    for answer in still(arm, positions).each(tolerance=0.5, time=(0, 0)):
        if set(answer.bodies) == set(pair):
            return answer.upper
    return None  # a joint connects them


def test_each_disabled_pair_has_a_verdict(checked):
    verdicts = {pair: one.verdict for pair, one in checked.items()}
    assert verdicts["base", "upper"] == verdicts["shoulder", "slide"] == "never"
    assert verdicts["shoulder", "upper"] == verdicts["upper", "fore"] == "collides"
    assert len(verdicts) == 9 and "undecided" not in verdicts.values()
    assert {one.reason for one in checked.values()} == {"Never", "Adjacent"}
    assert all(one.proved == 1 for one in checked.values() if one.verdict == "never")


def test_a_pair_depends_on_the_joints_between_its_links(checked):
    assert list(checked["base", "upper"].joints) == ["turn", "lift"]
    assert list(checked["shoulder", "slide"].joints) == ["lift", "bend", "extend"]
    assert checked["shoulder", "upper"].joints == {"lift": (-2.0, 2.0)}
    assert list(checked["left_finger", "right_finger"].joints) == ["grip"]  # one follows the other
    turn = checked["base", "shoulder"].joints["turn"]
    assert turn[0] <= -numpy.pi and turn[1] > numpy.pi and turn[1] - numpy.pi < 1e-15


def test_what_never_touches_is_apart_wherever_one_looks(arm, checked):
    random = numpy.random.default_rng(7)
    for pair, one in checked.items():
        if one.verdict != "never":
            continue
        for _ in range(12):
            positions = {name: random.uniform(max(lo, -numpy.pi), min(hi, numpy.pi))
                         for name, (lo, hi) in one.joints.items()}
            found = distance(arm, pair, positions)
            assert found is None or found > 0


def test_positions_that_touch_are_found_by_descent():
    ranges = {"a": (-3.0, 3.0), "b": (-2.0, 1.0)}

    def gap(at):
        assert all(lo <= x <= hi for x, (lo, hi) in zip(at, ranges.values()))
        return max(abs(at[0] - 0.3) + abs(at[1] + 2) - 0.001, 0)

    found = _seek.touching(ranges, gap, 1e-6)
    assert gap(list(found.values())) == 0 and list(found) == ["a", "b"]
    assert found == _seek.touching(ranges, gap, 1e-6)
    assert _seek.touching(ranges, lambda at: gap(at) + 0.1, 1e-6) is None


def test_links_that_a_survey_does_not_see_touching_are_sought(arm, monkeypatch):
    monkeypatch.setattr(_check, "_LOOK_AFTER", 1)
    monkeypatch.setattr(_check.Survey, "_values", lambda self: None)
    one = arm.check_pair("base", "slide", max_seconds=60)
    assert one.verdict == "collides"
    assert distance(arm, one.links, one.positions) <= 1e-6


def test_a_contact_is_where_forward_kinematics_puts_the_links(arm):
    one = arm.check_pair("base", "slide", max_seconds=60)
    assert one.free is None  # four joints are between them
    assert one.verdict == "collides" and one.reason is None
    for name, (lo, hi) in one.joints.items():
        assert lo <= one.positions[name] <= hi
    assert distance(arm, one.links, one.positions) <= 1e-6


def test_where_a_pair_is_free_is_told_and_true(arm, checked):
    one = checked["shoulder", "upper"]
    (lo, hi), = one.free["lift"]
    assert lo < -1.5 and hi > 1.5 and not lo <= one.positions["lift"] <= hi
    again = arm.check_pair("upper", "fore")
    (lo, hi), = again.free["bend"]
    assert lo == -2.5 and 0.9 < hi < again.positions["bend"]


def test_a_limit_leaves_the_share_that_is_proved(arm):
    one = arm.check_pair("base", "left_finger", max_seconds=1e-6)
    assert one.verdict == "undecided" and one.why == "seconds" and 0 <= one.proved < 1


def test_a_joint_without_limits_is_told(tmp_path):
    text = ARM.read_text().replace('name="turn" type="continuous"', 'name="turn" type="floating"')
    (tmp_path / "arm.urdf").write_text(text)
    one = robot.load(tmp_path / "arm.urdf").check_pair("base", "upper")
    assert one.verdict == "undecided" and "turn" in one.why


def test_unknown_links_are_refused(arm):
    with pytest.raises(errors_module.UsageError, match="link: got 'uper', must be one of base"):
        arm.check_pair("base", "uper")


def ask(capsys, *words):
    status = command.main([str(ARM), *words])
    return status, capsys.readouterr()


def test_the_command_lists_what_is_disabled(capsys):
    status, said = ask(capsys, "--srdf", str(SRDF), "--check-matrix")
    lines = said.out.splitlines()
    assert status == 1 and len(lines) == 11
    assert lines[1] == "never      base and upper (Never)"
    assert lines[2].startswith("collides   shoulder and upper (Never) at lift = ")
    assert "; never where lift is -1.875 to 1.875" in lines[2]
    assert lines[-2].startswith("9 pairs: ") and lines[-1] == "disabled, but they collide: shoulder and upper"


def test_the_command_prints_one_object(capsys):
    status, said = ask(capsys, "--check-matrix", "--all", "--max-seconds", "0.2", "--json")
    made = json.loads(said.out)
    assert status == 0 and len(made["pairs"]) == 21  # nothing is claimed without an SRDF file
    assert made["never"] + made["collides"] + made["undecided"] == 21 and made["never"] >= 10
    assert {one["reason"] for one in made["pairs"]} == {None}


@pytest.mark.parametrize("words, text", [
    (["--check-matrix"], "no pair of links is disabled"),
    (["--all", "--goal", "lift=1"], "--all: belongs to --check-matrix"),
    (["--check-matrix", "--all", "--goal", "lift=1"], "--goal: is of no use with --check-matrix")])
def test_what_does_not_go_together_is_refused(capsys, words, text):
    status, said = ask(capsys, *words)
    assert status == 2 and text in said.err


# --- Motions that are not exact -------------------------------------------------------------------


def edge(arm, goal, **more):
    return arm.scene([0, 1], {"lift": [-1, goal], "turn": [0, 0.5]}, world=SHELF, **more)


def test_errors_of_joints_are_parameters(arm):
    scene = edge(arm, -0.4, errors=(0.01, 0.002))
    assert scene.parameters == {"turn.error": (-0.01, 0.01), "lift.error": (-0.01, 0.01),
                                "bend.error": (-0.01, 0.01), "extend.error": (-0.002, 0.002),
                                "grip.error": (-0.002, 0.002)}
    assert edge(arm, -0.4, errors=(0, 0.002)).parameters.keys() == {"extend.error", "grip.error"}
    exact = scene.at({}).mesh("right_finger", 0.5).points
    off = scene.at({"lift.error": 0.01}).mesh("right_finger", 0.5).points
    other = arm.scene([0, 1], {"lift": [-0.99, -0.39], "turn": [0, 0.5]}).mesh("right_finger", 0.5).points
    assert numpy.abs(off - other).max() < 1e-12 and numpy.abs(off - exact).max() > 1e-4


def test_a_distance_that_is_kept_by_all_motions_is_kept_by_each(arm):
    scene, random = edge(arm, -0.1, errors=(0.02, 0.001)), numpy.random.default_rng(3)
    found = scene.clearance(tolerance=0.5, max_seconds=2)
    for _ in range(6):
        one = scene.at({name: random.uniform(lo, hi) for name, (lo, hi) in scene.parameters.items()})
        assert one.clearance(tolerance=0.1).upper >= found.lower


@pytest.mark.parametrize("errors", [(-1, 0), (0.1,), "wide", (0, numpy.inf)])
def test_wrong_errors_are_named(arm, errors):
    with pytest.raises(errors_module.UsageError, match="errors: got"):
        edge(arm, 0, errors=errors)


def test_the_command_answers_for_every_motion_within_errors(capsys):
    motion = ["--srdf", str(SRDF), "--start", "lift=-1", "--world", str(SHELF), "--robust", "0.01745,0.0005"]
    status, said = ask(capsys, *motion, "--goal", "lift=-0.4,turn=0.5")
    assert status == 0 and said.out == (
        "holds: nothing comes within 0.001 mm from t = 0 to 1, proved, with joints off by up to 0.01745 rad or "
        "0.5 mm and each body by up to 0.5 mm\n")
    status, said = ask(capsys, *motion, "--goal", "lift=1,turn=0.5", "--require", "0.002", "--json")
    made = json.loads(said.out)
    assert status == 1 and made["verdict"] == "violated" and made["required"] == 0.003
    assert made["robust"] == {"angle": 0.01745, "length": 0.0005} and "lift.error" in made["parameters"]
    status, said = ask(capsys, "--goal", "lift=1", "--robust", "1")
    assert status == 2 and "--robust: got 1, must be ANGLE,LENGTH" in said.err
