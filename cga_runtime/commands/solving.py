"""Commands that find joint positions: inverse kinematics, and reaching by IPOPT."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
import typer

from cga_runtime.commands.terminal import AsJson, numbers, show
from cga_runtime.errors import UnknownNameError, WrongSizeError
from cga_runtime.loading import load_robot


def reach(
    point: Annotated[str, typer.Argument(help="Target point x,y,z (m) in the robot's base frame.")],
    robot: Annotated[str, typer.Option(help="A bundled robot's name or a URDF file.")] = "nao",
    frame: Annotated[str, typer.Option(help="End frame of the arm.")] = "RHand",
    start: Annotated[str, typer.Option("--q", help="Start positions (rad). Default: mid-range.")] = "",
    json_: AsJson = False,
) -> None:
    """Joint positions that bring a frame's origin to a point, inside the limits; exit status 1 if none was found."""
    from cga_runtime.elements import Point
    from cga_runtime.solve.reaching import reach as solve

    arm = load_robot(robot).chain(frame)
    found = solve(arm, Point(numbers(point, "point")), np.array(numbers(start, "--q")) if start else None)
    result = {
        "success": bool(found.success),
        "status": found.status,
        "q": found.q.tolist(),
        "joint_names": list(arm.joint_names),
        "residual": float(found.residual),
        "iterations": int(found.iterations),
        "seconds": float(found.seconds),
    }
    show(result, json_)
    raise typer.Exit(0 if found.success else 1)


def ik(
    point: Annotated[str, typer.Argument(help="Position x,y,z (m) of the end frame in the robot's base frame.")],
    robot: Annotated[str, typer.Option(help="A bundled robot's name, or a URDF or MJCF file.")] = "panda",
    frame: Annotated[str, typer.Option(help="End frame of the arm. Default: panda_link8, or a robot's only tip.")] = "",
    rpy: Annotated[str, typer.Option(help="Orientation as roll,pitch,yaw (rad), as in URDF. Default: free.")] = "",
    start: Annotated[str, typer.Option("--q", help="Start positions (rad). Default: random, with a fixed seed.")] = "",
    method: Annotated[str, typer.Option(help="levenberg_marquardt or gauss_newton (paper B's).")] = "levenberg_marquardt",
    seed: Annotated[int, typer.Option(min=0, help="Seed of the random starts.")] = 0,
    json_: AsJson = False,
) -> None:
    """Joint positions that bring a frame to a position or a pose, inside the limits; exit status 1 if none was found."""
    from cga_runtime.elements import Point
    from cga_runtime.solve.inverse_kinematics import inverse_kinematics

    loaded = load_robot(robot)
    ends = ("panda_link8",) if robot == "panda" else loaded.tips
    if not frame and len(ends) != 1:
        raise UnknownNameError("frame", frame, ends, "Say which with --frame")
    arm = loaded.chain(frame or ends[0])
    position = numbers(point, "point")
    target = placed(position, numbers(rpy, "--rpy")) if rpy else Point(position)
    q0 = np.array(numbers(start, "--q")) if start else None
    found = inverse_kinematics(arm, target, q0, np.random.default_rng(seed), method=method)
    result = {
        "success": bool(found.success),
        "status": str(found.status),
        "q": found.q.tolist(),
        "joint_names": list(arm.joint_names),
        "residual": float(found.residual),
        "iterations": int(found.iterations),
        "starts": int(found.starts),
    }
    show(result, json_)
    raise typer.Exit(0 if found.success else 1)


def placed(position: list[float], rpy: list[float]) -> Any:
    """The 4x4 pose of a position and of URDF's roll, pitch, yaw: R = Rz(yaw) Ry(pitch) Rx(roll)."""
    if len(position) != 3 or len(rpy) != 3:
        raise WrongSizeError(f"point and --rpy: {len(position)} and {len(rpy)} numbers given, 3 and 3 needed")
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    pose = np.eye(4)
    pose[:3, :3] = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    pose[:3, 3] = position
    return pose
