"""Commands on any robot: ik, and generate with options; what they print, their exit status, and their refusals."""

import json

import numpy as np
import pytest

import cga_runtime as cga
from cga_runtime import cli

FLANGE = ["--robot", "tm5_700", "--frame", "flange"]


@pytest.fixture
def command(monkeypatch, capsys):
    """Runs `cga` with these words: exit status, standard output, standard error."""

    def run(*words):
        monkeypatch.setattr("sys.argv", ["cga", *map(str, words)])
        with pytest.raises(SystemExit) as end:
            cli.main()
        out, err = capsys.readouterr()
        return end.value.code or 0, out, err

    return run


def rotation(roll, pitch, yaw):
    """Elementary rotations multiplied out, as URDF defines rpy."""

    def about(axis, angle):
        i, j = [k for k in range(3) if k != axis]
        turn = np.eye(3)
        turn[[i, j], [i, j]], turn[i, j], turn[j, i] = np.cos(angle), -np.sin(angle), np.sin(angle)
        return turn if axis != 1 else turn.T

    return about(2, yaw) @ about(1, pitch) @ about(0, roll)


def test_a_pose(command):
    status, out, _ = command("ik", "-0.3,0.2,0.5", *FLANGE, "--rpy", "0.3,-0.5,1.2", "--json")
    found = json.loads(out)
    arm = cga.load_robot("tm5_700").chain("flange")
    q = np.array(found["q"])
    assert status == 0 and found["success"] is True and found["status"] == "reached" and found["joint_names"] == list(arm.joint_names)
    assert (arm.lower <= q).all() and (q <= arm.upper).all()
    assert np.abs(arm.pose(q)[:3, 3] - [-0.3, 0.2, 0.5]).max() < 1e-6
    assert np.abs(arm.pose(q)[:3, :3] - rotation(0.3, -0.5, 1.2)).max() < 2e-6


def test_a_position_and_its_seed(command):
    answers = [command("ik", "0.3,0.2,0.5", *FLANGE, "--seed", seed, "--json")[1] for seed in (1, 1, 2)]
    first, again, other = (json.loads(out)["q"] for out in answers)
    assert first == again != other
    assert np.abs(cga.load_robot("tm5_700").chain("flange").point(first) - [0.3, 0.2, 0.5]).max() < 1e-6


def test_out_of_reach_is_status_1(command):
    status, out, _ = command("ik", "3,0,0", *FLANGE, "--json")
    assert status == 1 and json.loads(out)["status"] == "least_squares" and json.loads(out)["residual"] > 1.0


REFUSED = [
    (["0.1,0.2"], "WrongSizeError: "),
    (["0.1,0.2,nan"], "NotFiniteError: "),
    (["0.1,0.2,0.3", "--rpy", "1,2"], "WrongSizeError: point and --rpy: 3 and 2 numbers given, 3 and 3 needed"),
    (["0.1,0.2,0.3", "--method", "magic"], "UnknownNameError: unknown method 'magic'"),
    (["0.1,0.2,0.3", "--frame", "hand"], "UnknownNameError: unknown frame 'hand'"),
]


@pytest.mark.parametrize(("words", "sentence"), REFUSED)
def test_mistakes_are_one_sentence(command, words, sentence):
    status, out, err = command("ik", words[0], *FLANGE, *words[1:], "--json")
    assert status == 2 and not out and err.strip().splitlines()[-1].startswith(sentence) and "Traceback" not in err


def test_the_end_frame_may_be_left_out_where_there_is_one(command):
    assert command("ik", "0.3,0.2,0.5", "--robot", "tm5_700", "--json")[0] == 0
    status, out, err = command("ik", "0.1,0.1,0.1", "--robot", "nao", "--json")
    assert (status, out) == (2, "")
    assert err.strip() == "UnknownNameError: unknown frame ''; known: l_gripper, r_gripper. Say which with --frame"


def test_generate_for_a_bundled_robot_with_locked_joints(command, tmp_path):
    status, out, _ = command("generate", "tm5_700", "-o", tmp_path / "short", "--lock", "joint_6=0.5", "--lock", "joint_5=-0.2", "--json")
    assert status == 0 and "robots/tm5_700/tree_mass_matrix" in json.loads(out)["units"]
    short, whole = cga.load_robot("tm5_700", folder=tmp_path / "short"), cga.load_robot("tm5_700")
    q = np.array([0.3, -0.4, 0.5, -0.6])
    assert short.nv == 4
    assert np.abs(short.chain("flange").pose(q) - whole.chain("flange").pose([*q, -0.2, 0.5])).max() < 1e-14
    assert np.abs(short.mass_matrix(q) - whole.mass_matrix([*q, -0.2, 0.5])[:4, :4]).max() < 1e-14


def test_generate_prints_fewer_instructions_than_adam(command, tmp_path):
    """For the panda adam 0.5.0 makes 492 instructions for the pose and 1089 for the Jacobian; sines and cosines are on top of ours."""
    status, out, _ = command("generate", "panda", "-o", tmp_path / "panda", "--frame", "panda_link8", "--lock", "panda_finger_joint1=0")
    assert status == 0
    rows = {line.split("│")[1].strip(): line.split("│")[3].strip() for line in out.splitlines() if line.count("│") >= 4}
    assert int(rows["pose"]) + 14 < 492
    assert max(int(rows[f"jacobian_{frame}"]) for frame in ("local", "world", "local_world_aligned")) + 14 < 1089


def test_a_lock_that_says_nothing_is_refused(command, tmp_path):
    for text in ("joint_6", "joint_6=", "=1", "joint_6=half"):
        status, out, err = command("generate", "tm5_700", "-o", tmp_path / "new", "--lock", text)
        assert status == 2 and not out and f"WrongSizeError: --lock: {text!r} given, JOINT=VALUE (rad or m) needed" in err
    status, _, err = command("generate", "tm5_700", "-o", tmp_path / "new", "--lock", "joint_9=1")
    assert status == 2 and "has no joint 'joint_9' to lock" in err
