"""Commands on two arms that hold one object: mobility, singularities, actuation schemes."""

from __future__ import annotations

from typing import Annotated, Any

import typer
from rich.table import Table

from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.commands.terminal import AsJson, RobotName, numbers, progress_bar, show
from cga_runtime.errors import WrongSizeError
from cga_runtime.loading import load_robot
from cga_runtime.robot import Robot

Frames = Annotated[str, typer.Option("--frames", help="End frames of the two arms: right,left.")]
Position = Annotated[str, typer.Option("--q", help="Joint positions (rad), comma-separated: right arm, then left. Default: mid-range.")]


def joint_numbers(text: str) -> list[int]:
    """Comma-separated joint numbers; WrongSizeError for anything that is not whole."""
    values = numbers(text, "--scheme")
    if not all(value.is_integer() for value in values):  # which NaN and infinity are not
        raise WrongSizeError(f"--scheme: {text!r} given, joint numbers separated by commas needed")
    return [int(value) for value in values]


def two_arms(robot: Robot, frames: str) -> ClosedChain:
    """The closed chain of two end frames, given as "right,left"."""
    names = [name.strip() for name in frames.split(",")]
    if len(names) != 2:
        raise WrongSizeError(f"--frames: {frames!r} given, two frame names separated by a comma needed")
    return ClosedChain(robot.chain(names[0]), robot.chain(names[1]))


def configuration(loop: ClosedChain, q: str) -> Any:
    """Positions from the command line, default mid-range."""
    return loop.check(numbers(q, "--q")) if q else 0.5 * (loop.lower + loop.upper)


def mobility(robot: RobotName = "nao", q: Position = "", frames: Frames = "RHand,LHand", json_: AsJson = False) -> None:
    """Mobility and motion type of two arms that hold one object."""
    found = (loop := two_arms(load_robot(robot), frames)).mobility(configuration(loop, q))
    result = {
        "joint_mobility": found.joint_mobility,
        "object_dof": found.object_dof,
        "motion": found.motion,
        "limb_ranks": list(found.limb_ranks),
        "constraint_rank": found.constraint_rank,
        "constraint_wrenches": found.constraint_wrenches.tolist(),
    }
    show(result, json_)


def singularities(
    robot: RobotName = "nao",
    q: Position = "",
    kind: Annotated[str, typer.Option(help="limb, constraint or actuation.")] = "limb",
    scheme: Annotated[str, typer.Option(help="Actuated joints of kind actuation, e.g. 1,3,7,8.")] = "",
    within_limits: Annotated[bool, typer.Option(help="Search inside the joint limits only.")] = False,
    frames: Frames = "RHand,LHand",
    json_: AsJson = False,
) -> None:
    """The nearest singularity of a kind; exit status 1 if none was found."""
    loop = two_arms(load_robot(robot), frames)
    actuated = joint_numbers(scheme) if scheme else None
    found = loop.nearest_singularity(configuration(loop, q), kind, actuated, within_limits=within_limits)
    show(found.to_json(), json_)
    raise typer.Exit(0 if found.success else 1)


def schemes(
    robot: RobotName = "nao",
    samples: Annotated[int, typer.Option(min=1, help="Poses sampled for the statistics of mu.")] = 3000,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the sample.")] = 0,
    frames: Frames = "RHand,LHand",
    json_: AsJson = False,
) -> None:
    """The atlas of actuation schemes: class, reason, orbit, exact certificate, conditioning."""
    from cga_runtime.analysis.schemes import atlas, summary

    loop = two_arms(load_robot(robot), frames)
    with progress_bar("schemes") as bar:
        rows = atlas(loop, samples, seed, bar)

    def table() -> Table:
        view = Table("actuated", "class", "mu median", "mu 5 %", "reason")
        for row in sorted(rows, key=lambda r: -r["mu_median"]):
            view.add_row(str(row["actuated"]), row["class"], f"{row['mu_median']:.3f}", f"{row['mu_p05']:.3f}", row["reason"])
        return view

    show({**summary(rows), "table": rows}, json_, table)
