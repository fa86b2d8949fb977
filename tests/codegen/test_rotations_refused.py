"""What is given as a rotation and is none: every reader that takes matrices or quaternions refuses it, and names the place."""

import numpy as np
import pinocchio
import pytest

from cga_codegen.robots.from_dh import load_table
from cga_codegen.robots.from_mjcf import load_mjcf
from cga_codegen.robots.from_pinocchio import load_pinocchio
from cga_codegen.robots.model import ModelError

MIRROR = -np.eye(3)
STRETCHED = np.diag([1.1, 1.0, 1.0])
SHEARED = np.array([[1.0, 1e-6, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
NOT_FINITE = np.full((3, 3), np.nan)


def pose(rotation):
    m = np.eye(4)
    m[:3, :3] = rotation
    return m.tolist()


def of_joint(rotation):
    model = pinocchio.Model()
    model.addJoint(0, pinocchio.JointModelRX(), pinocchio.SE3(rotation, np.zeros(3)), "j")
    return model


def of_frame(rotation):
    model = of_joint(np.eye(3))
    model.addFrame(
        pinocchio.Frame("f", 1, 0, pinocchio.SE3(rotation, np.zeros(3)), pinocchio.FrameType.OP_FRAME), False
    )  # its inertia is not added
    return model


@pytest.mark.parametrize("rotation", [MIRROR, STRETCHED, SHEARED, NOT_FINITE], ids=["mirror", "stretched", "sheared", "nan"])
def test_matrices(rotation):
    table = {"name": "arm", "convention": "modified", "rows": [{"name": "a"}]}
    load_table({**table, "base": pose(np.eye(3))})
    with pytest.raises(ModelError, match="DH table: base: "):
        load_table({**table, "base": pose(rotation)})
    load_pinocchio(of_frame(np.eye(3)))
    with pytest.raises(ModelError, match="joint 'j'.* rotation"):
        load_pinocchio(of_joint(rotation))
    with pytest.raises(ModelError, match="frame 'f'.* rotation"):
        load_pinocchio(of_frame(rotation))


@pytest.mark.parametrize(
    ("turn", "said"),
    [
        ('quat="0 0 0 0"', "zero quaternion is not allowed"),
        ('quat="nan 0 0 0"', "a number is given as nan; finite numbers are needed"),
        ('axisangle="0 0 0 1"', "axisangle too small"),
        ('zaxis="0 0 0"', "zaxis too small"),
        ('xyaxes="1 0 0 2 0 0"', "yaxis too small"),
    ],
)
def test_turns_of_mjcf(turn, said):
    """MuJoCo scales quaternions and axes to unit length, as its format says; what has no direction it refuses, and so do we, by name."""
    text = '<mujoco><worldbody><body name="b" {}><joint name="j"/><geom size="1"/></body></worldbody></mujoco>'
    (joint,) = load_mjcf(text.format('quat="2 0 0 2"')).joints
    np.testing.assert_allclose(joint.placement.rotation, [[0, -1, 0], [1, 0, 0], [0, 0, 1]], atol=1e-15)
    with pytest.raises(ModelError) as caught:
        load_mjcf(text.format(turn))
    assert type(caught.value) is not ModelError
    assert str(caught.value).startswith("MJCF text: ") and said in str(caught.value)
