"""What the tests of inverse kinematics share: Pinocchio's NAO arm and its errors, and primitives through given points."""

import numpy as np
import pinocchio

import cga_runtime as cga
from cga_runtime.descriptions import bundled_file

ONE = np.zeros(1, dtype=np.intp)
EQUAL = (1.0, 1.0)


class Peer:
    """The NAO's right arm in Pinocchio."""

    def __init__(self) -> None:
        self.model = pinocchio.buildModelFromUrdf(str(bundled_file("nao")))
        self.data = self.model.createData()
        self.frame = self.model.getFrameId("RHand")

    def at(self, arm, q):
        """Pose of the hand, and its Jacobian in its own axes, rows v w."""
        full, places = pinocchio.neutral(self.model), [self.model.joints[self.model.getJointId(name)].idx_q for name in arm.joint_names]
        full[places] = q
        jacobian = pinocchio.computeFrameJacobian(self.model, self.data, full, self.frame, pinocchio.LOCAL)[:, places]
        pinocchio.framesForwardKinematics(self.model, self.data, full)
        return self.data.oMf[self.frame].homogeneous.copy(), jacobian


def split_error(target, pose):
    """Distance vector and rotation vector from target to pose, in the target's axes."""
    turn = target[:3, :3].T @ pose[:3, :3]
    return np.concatenate([target[:3, :3].T @ (pose - target)[:3, 3], pinocchio.log3(turn)]), turn


def primitives(x, rng):
    """Primitives through points x (m, 3), two of a pair's four points apart from them."""
    normal, other = rng.normal(size=(2, *x.shape))
    radius = rng.uniform(0.02, 0.5, len(x))
    unit = normal / np.linalg.norm(normal, axis=-1, keepdims=True)
    across = np.cross(unit, other)
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    return {
        "point": cga.Point(x),
        "line": cga.Line.from_point_direction(x, normal),
        "plane": cga.Plane.from_point_normal(x, normal),
        "sphere": cga.Sphere(x + radius[:, None] * unit, radius),
        "circle": cga.Circle(x + radius[:, None] * across, normal, radius),
    }


def single(target, k):
    """One of a batch of primitives."""
    kinds = {
        cga.Point: lambda: cga.Point(target.center[k]),
        cga.Line: lambda: cga.Line(target.center[k], target.direction[k]),
        cga.Plane: lambda: cga.Plane(target.normal[k], target.offset[k]),
        cga.Sphere: lambda: cga.Sphere(target.center[k], target.radius[k]),
        cga.Circle: lambda: cga.Circle(target.center[k], target.normal[k], target.radius[k]),
    }
    return kinds[type(target)]()


KINDS = ["point", "line", "plane", "sphere", "circle"]


def inside(arm, q):
    return bool(((arm.lower <= q) & (q <= arm.upper)).all())
