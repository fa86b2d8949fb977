"""Chains whose joint positions are their end points: three sliding joints each, along x, y and z of the world."""

import json

import numpy as np

import cga_runtime as cga
from cga_codegen.robots.model import Frame, Joint, Placement, RobotModel


def gantries():
    """Four chains a, b, c, d of one robot that share no joint."""
    axes = np.eye(3).tolist()
    joints = [
        Joint(f"{name}_{axis}", "prismatic", 3 * k + i - 1 if i else -1, Placement(), tuple(axes[i]), -2.0, 2.0, np.inf, np.inf)
        for k, name in enumerate("abcd")
        for i, axis in enumerate("xyz")
    ]
    frames = tuple(Frame(name, 3 * k + 2, Placement()) for k, name in enumerate("abcd"))
    robot = cga.Robot(json.dumps(RobotModel("gantries", tuple(joints), frames).to_json(), sort_keys=True))
    return [robot.chain(name) for name in "abcd"]
