# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""python3 -m impinge.robot: its words, files of motions, text, JSON and exit statuses."""

import json
import subprocess
import sys

import pytest
from impinge.robot import __main__ as command

from support import SOURCE

ARM = SOURCE / "tools" / "data" / "arm.urdf"
WORLD = """
world:
  collision_objects:
    - id: box
      primitive_poses: [{position: [0.3, 0, 0.8], orientation: [0, 0, 0, 1]}]
      primitives: [{type: box, dimensions: [0.1, 0.5, 0.1]}]
"""
SRDF = """<robot name="arm"><group name="arm"><joint name="lift"/><joint name="bend"/></group>
  <group_state name="home" group="arm"><joint name="lift" value="-1"/><joint name="bend" value="0"/></group_state></robot>"""


@pytest.fixture
def ask(tmp_path, capsys):
    """Runs a command line in a folder with files; its status, text and complaints."""
    (tmp_path / "world.yaml").write_text(WORLD)
    (tmp_path / "arm.srdf").write_text(SRDF)

    def run(*words):
        status = command.main([str(ARM), *map(str, words)])
        printed = capsys.readouterr()
        return status, printed.out, printed.err

    run.folder = tmp_path
    return run


def hit(ask, *words):
    pytest.importorskip("yaml")
    return ask("--start=0,-1,0,0,0", "--goal", "0,1,0,0,0", "--world", ask.folder / "world.yaml", *words)


def test_a_motion_is_clear_or_not(ask):
    status, text, _ = ask("--start", "0,0,1,0,0", "--goal", "1,0,1,0,0")
    assert (status, text) == (0, "clear: nothing touches from t = 0 to 1, proved\n")
    status, text, _ = hit(ask)
    assert status == 1 and text.startswith("contact: ") and " touches box at t = 0." in text


def test_a_distance_is_kept_or_not(ask):
    status, text, _ = hit(ask, "--require", "0.005")
    assert status == 1 and text.startswith("violated: ") and " comes within 5 mm of box at t = 0." in text
    assert "; first contact at t = 0." in text
    status, text, _ = ask("--start", "0,-1,1,0,0", "--goal", "1,-1,1,0,0", "--require", "0.002")
    assert (status, text) == (0, "holds: nothing comes within 2 mm from t = 0 to 1, proved\n")


def test_json_is_an_object_as_of_solve_and_of_clearance(ask):
    status, text, _ = hit(ask, "--json")
    solved = json.loads(text)
    assert status == 1 and solved["verdict"] == "contact" and solved["t"] == solved["t_lower"] and "box" in solved["bodies"]
    assert {"reason", "time", "t_examined", "gap", "gamma", "gamma_clear", "a", "b", "normal", "stats", "text"} < set(solved)
    assert {solved["a"]["body"], solved["b"]["body"]} == set(solved["bodies"]) and solved["stats"]["nodes"] > 0
    status, text, _ = hit(ask, "--json", "--require", "0.005")
    asked = json.loads(text)
    assert status == 1 and asked["verdict"] == "violated" and asked["required"] == 0.005
    assert asked["t_violated"] < asked["contact"]["t"] == solved["t"] and asked["contact"]["bodies"] == solved["bodies"]
    assert abs(asked["gap_violated"] - 0.005) < 1e-5 and asked["bodies"][1] == asked["b_violated"]["body"]
    assert {"lower", "upper", "t", "a", "b", "normal", "stats"} < set(asked)


def test_a_limit_leaves_it_undecided(ask):
    status, text, _ = hit(ask, "--json", "--max-seconds", "1e-9")
    assert status == 3 and json.loads(text)["verdict"] == "undecided" and json.loads(text)["reason"] == "max-seconds"
    status, text, _ = hit(ask, "--require", "0.01", "--max-seconds", "1e-9")
    assert status == 3 and text.startswith("undecided (seconds)")


def test_poses_have_names(ask):
    srdf = ["--srdf", ask.folder / "arm.srdf"]
    rows = [ask(*srdf, *words, "--json") for words in (
        ["--start=0,-1,0,0,0", "--goal=0,-0.5,0.5,0,0"], ["--start", "home", "--goal", "lift=-0.5,bend=0.5"],
        ["--start", "arm/home", "--goal=-0.5,0.5", "--group", "arm"])]
    answers = [json.loads(text) for _, text, _ in rows]
    for answer in answers:
        del answer["stats"]
    assert answers[0] == answers[1] == answers[2] and answers[0]["verdict"] == "clear"


def test_samples_miss_what_is_proved(ask):
    status, text, _ = hit(ask, "--compare-samples", "2")
    assert status == 1 and text.splitlines()[1] == "sampling 2 poses: none of them shows it"
    status, text, _ = hit(ask, "--compare-samples", "21", "--json")
    answer = json.loads(text)
    samples = answer["samples"]
    assert samples["poses"] == 21 and samples["touching"] > 0 and answer["t"] <= samples["first"]
    status, text, _ = hit(ask, "--compare-samples", "3", "--require", "0.3")
    assert "sampling 3 poses: " in text and "are too near, the first at t = " in text
    assert ask("--goal", "0.1,0,1,0,0", "--compare-samples", "2")[1].endswith("sampling 2 poses: none of them touch\n")


def test_a_trajectory_follows_its_table(ask):
    table = ask.folder / "q.csv"
    table.write_text("time,turn,bend\n0,0,1\n1,1,1\n2,2,1\n\n")
    status, text, _ = ask("--trajectory", table, "--require", "0.001", "--json")
    assert status == 0 and json.loads(text)["verdict"] == "holds" and json.loads(text)["time"] == [0, 2]
    for content, message in [
            ("time,turn\n0,0\n", "two rows or more"), ("time,turn\n0,0\n1\n", "q.csv:3: got 1 cells, must be 2"),
            ("time,turn\n0,0\n1,x\n", "q.csv:3: got 'x', must be a number"),
            ("time,turn\n0,nan\n1,0\n", "q.csv:2: got 'nan', must be a finite number"),
            ("time,turn\n0,0\n1,0\n1,0\n", "q.csv:4: got the time 1.0 after 1.0, must increase"),
            ("time,turn,turn\n0,0,0\n1,1,1\n", "q.csv:1: a name stands twice"), ("", "must have a head"),
            ("time,\xe4\n".encode("latin-1"), "must be CSV in UTF-8")]:
        table.write_bytes(content if isinstance(content, bytes) else content.encode())
        status, _, complaint = ask("--trajectory", table)
        assert status == 4 and message in complaint, complaint
    for content in "time,tilt\n0,0\n1,1\n", "time,lift\n0,0\n1,99\n", "time,turn,bend,turn.velocity\n0,0,0,0\n1,1,1,0\n":
        table.write_text(content)
        status, _, complaint = ask("--trajectory", table)
        assert status == 2 and "q.csv: " in complaint, complaint


REQUEST = """
start_state: {{joint_state: {{name: [turn, lift, grip, grip_right, to_elbow], position: {start}}}}}
goal_constraints: [{{joint_constraints: [{{joint_name: lift, position: {goal}}}]{more}}}]
"""


def test_a_request_has_a_start_and_a_goal(ask):
    pytest.importorskip("yaml")
    path = ask.folder / "request.yaml"

    def request(start="[0, -1, 0.01, -0.01, 0.5]", goal="-0.5", more=""):
        path.write_text(REQUEST.format(start=start, goal=goal, more=more))
        return ask("--request", path, "--json")

    status, text, complaint = request()
    assert status == 0 and json.loads(text)["notes"] == [complaint.split("warning: ")[1].strip()]
    assert "joint 'to_elbow' is fixed: its position 0.5 changes nothing" in complaint
    for words, status, message in [
            ({"start": "[0, -1, 0.01, 0.01, 0]"}, 2, "grip_right: got 0.01, must be -0.01, since it follows grip"),
            ({"start": "[0, 1]"}, 4, "start_state: position: got [0, 1], must be 5 finite numbers"),
            ({"start": "[0, -1, 0.01, -0.01, .nan]"}, 4, "must be 5 finite numbers"), ({"goal": "9"}, 2, "lift: got 9.0"),
            ({"more": ", orientation_constraints: [{}]"}, 4, "has orientation_constraints, which is not understood"),
            ({"more": "}, {}, {"}, 4, "goal_constraints: got 3 of them, must be 1")]:
        answer = request(**words)
        assert answer[0] == status and message in answer[2] and message in json.loads(answer[1])["error"], answer
    path.write_text("start_state: {}\ngoal_constraints: [{}]")
    assert "has no joint_constraints" in ask("--request", path)[2]


def test_wrong_words_are_named(ask):
    for words, status, message in [
            (["--goal", "1,2"], 2, "--goal: got '1,2', must be 5 numbers: turn, lift"), ([], 2, "got no motion, must be one"),
            (["--goal", "1,2", "--trajectory", "x"], 2, "got --trajectory and --goal, must be one of"),
            (["--goal", "home"], 2, "got 'home', which is no state of the SRDF file (its states: none)"),
            (["--goal", "1,x,0,0,0"], 2, "got 'x' in '1,x,0,0,0', must be a number"),
            (["--goal", "lift=x"], 2, "must be JOINT=Q"), (["--goal", "tilt=1"], 2, "got 'tilt', must be a joint of the robot"),
            (["--goal", "1", "--group", "legs"], 2, "--group: got 'legs', must be one of none"),
            (["--goal", "0,9,0,0,0"], 2, "lift: got 9.0"), (["--goal", "0,0,0,0,0", "--require", "0"], 2, "must be a number > 0"),
            (["--goal", "0,0,0,0,0", "--compare-samples", "1"], 2, "must be 2 or more"),
            (["--goal", "0,0,0,0,0", "--package", "x"], 2, "--package: got 'x', must be NAME=FOLDER"),
            (["--gaol", "0"], 2, "--help lists the options"), (["--trajectory", "none.csv"], 4, "cannot be read"),
            (["--start", "lift=1", "--trajectory", "none.csv"], 2, "--start: is of no use with --trajectory"),
            (["--goal", "lift=1", "--world", "none.yaml"], 4, "none.yaml"),
            (["--goal", "lift=1", "--srdf", "none.srdf"], 4, "none.srdf: cannot be read")]:
        found, text, complaint = ask(*words, "--json")
        assert found == status and message in complaint and message in json.loads(text)["error"], (words, text)


def test_it_is_a_program(tmp_path):
    done = subprocess.run([sys.executable, "-m", "impinge.robot", str(ARM), "--goal", "lift=0.1"], capture_output=True,
                          text=True)
    assert done.returncode == 0 and done.stdout.startswith("clear"), done


def test_it_ends_quietly_where_nobody_reads_on():
    asked = subprocess.Popen([sys.executable, "-m", "impinge.robot", str(ARM), "--goal", "lift=0.1"],
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    asked.stdout.close()
    assert asked.stderr.read() == "" and asked.wait() == -13  # SIGPIPE
    asked.stderr.close()
