"""What tests of cooperative inverse kinematics share: free points as a robot, Pandas in Pinocchio, primitives by elementary geometry."""

import json

import numpy as np
import pinocchio

import cga_runtime as cga
from cga_codegen.robots.model import Frame, Joint, Placement, RobotModel
from cga_runtime.descriptions import bundled_file
from cga_runtime.elements.charts import direction_of

COUNTS = {"point": 1, "point_pair": 2, "line": 2, "circle": 3, "plane": 3, "sphere": 4}
ROUND = ("point_pair", "circle", "sphere")
DIRECTED = ("point_pair", "line", "circle", "plane")


def free_points():
    """Chains to four points that three sliding joints each put anywhere: q is the points."""
    axes = np.eye(3).tolist()
    joints = [
        Joint(f"{name}_{axis}", "prismatic", 3 * k + i - 1 if i else -1, Placement(), tuple(axes[i]), -2.0, 2.0, np.inf, np.inf)
        for k, name in enumerate("abcd")
        for i, axis in enumerate("xyz")
    ]
    frames = tuple(Frame(name, 3 * k + 2, Placement()) for k, name in enumerate("abcd"))
    robot = cga.Robot(json.dumps(RobotModel("gantries", tuple(joints), frames).to_json(), sort_keys=True))
    return [robot.chain(name) for name in "abcd"]


def plane_of_slides():
    """A chain of two sliding joints, along x and y."""
    axes = np.eye(3).tolist()
    joints = [Joint(f"slide_{k}", "prismatic", k - 1, Placement(), tuple(axes[k]), -2.0, 2.0, np.inf, np.inf) for k in range(2)]
    model = RobotModel("slides", tuple(joints), (Frame("end", 1, Placement()),))
    return cga.Robot(json.dumps(model.to_json(), sort_keys=True)).chain("end")


class Flanges:
    """Pinocchio's Pandas at placements."""

    def __init__(self, placements):
        self.model = pinocchio.buildModelFromUrdf(str(bundled_file("panda")))
        self.data, self.frame = self.model.createData(), self.model.getFrameId("panda_link8")
        self.places = [self.model.joints[self.model.getJointId(f"panda_joint{k}")].idx_q for k in range(1, 8)]
        self.placements = placements

    def points(self, q):
        """(k, 3) at q (7 k,)."""
        found = []
        for k, pose in enumerate(self.placements):
            full = pinocchio.neutral(self.model)
            full[self.places] = q[7 * k : 7 * k + 7]
            pinocchio.framesForwardKinematics(self.model, self.data, full)
            found.append(pose[:3, :3] @ self.data.oMf[self.frame].translation + pose[:3, 3])
        return np.array(found)


def standing(kind, x):
    """Centre, direction, radius of the primitive through points x (k, 3), None where there is none: y = centre - x1 is the shortest vector
    with e.y = |e|^2/2 for all edges e from x1."""
    edges = x[1:] - x[0]
    y = np.linalg.pinv(edges) @ (0.5 * (edges * edges).sum(axis=1)) if len(edges) else np.zeros(3)
    n = None
    if kind in DIRECTED:
        n = edges[0] if COUNTS[kind] == 2 else np.cross(edges[0], edges[1])
        n = n / np.linalg.norm(n)
    return x[0] + y, n, np.linalg.norm(y)


def error(kind, x, target, k):
    """Length (m) and angle (rad) between the primitive through x and the k-th of a batch of targets."""
    center, n, radius = standing(kind, x)
    wanted = direction_of(target)[k] if kind in DIRECTED else None
    if kind == "line":
        length = np.linalg.norm(np.cross(x.mean(axis=0) - target.center[k], wanted))
    elif kind == "plane":
        length = abs(x.mean(axis=0) @ wanted - target.offset[k])
    else:
        length = np.linalg.norm(center - target.center[k])
        if kind in ROUND:
            length = np.hypot(length, radius - target.radius[k])
    angle = 0.0 if n is None else 2.0 * np.arctan2(np.linalg.norm(n - wanted), np.linalg.norm(n + wanted))
    return length, angle


def row(element, k):
    """The k-th of a batch of elements, without leading dimensions."""
    return type(element)(*(getattr(element, name)[k] for name in element.__dataclass_fields__))
