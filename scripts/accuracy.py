"""Compares every kernel with Pinocchio and MuJoCo on random states of many robots, and writes the table of docs/accuracy.md.

    ./run shell python scripts/accuracy.py                     the bundled robots, as compiled C
    ./run shell python scripts/accuracy.py --urdf FOLDER       also every URDF in a folder, as Python text (so that none is compiled)
    ./run shell python scripts/accuracy.py --write             afterwards: docs/accuracy.md from all that was measured

What is done is kept in out/accuracy.json, so that a run may be stopped and goes on where it was.
"""

import argparse
import json
import os
import warnings
from pathlib import Path

from rich.console import Console
from rich.progress import track

ROOT = Path(__file__).resolve().parents[1]
KEPT = ROOT / "out" / "accuracy.json"
KINEMATICS = ("frames", "pose", "Jacobian", "its derivative", "center of mass", "its Jacobian")
COLUMNS = (
    *("kinematics", "mass matrix", "inverse dynamics", "bias", "gravity", "Coriolis matrix", "d tau/dq", "d tau/dv"),
    *("forward dynamics", "condition"),
)
HEAD = """# How far the kernels are from Pinocchio and MuJoCo

Largest relative error over {states} random states a robot (joints anywhere within ±π, rates of size one), by `scripts/accuracy.py`
(Pinocchio {pinocchio}, MuJoCo {mujoco}). The error of a state is the largest difference over the largest entry of the peer's answer.
"Kinematics": poses of all frames, and of up to three tips the Jacobians in three frames, their time derivatives and motors; centre of mass
and its Jacobian. Forward dynamics amplify rounding by the condition of the mass matrix (last column), Pinocchio's own included: where
both differ most, 50 digits find ours 3e-16 and Pinocchio's 2e-13 off on the G1, 4e-7 and 6e-6 on the iCub. A dash: not compared, or it does
not exist (a joint that carries no inertia).

"""


def relative_folder(path: Path, folder: Path) -> str:
    return path.relative_to(folder).as_posix()


def measure(source: str, urdf: Path, base: str, states: int, chains: int) -> dict[str, object]:
    """One row: errors by quantity against Pinocchio, or the refusal."""
    import cga_runtime as cga
    from cga_runtime.experiments.accuracy import against_pinocchio

    try:
        robot = cga.load_robot(source, base=base)
        return {"joints": robot.nv, "errors": against_pinocchio(robot, urdf, states, chains=chains)}
    except cga.CgaError as error:
        return {"refused": f"{type(error).__name__}: {error}"}


def measure_mujoco(name: str, urdf: Path, states: int) -> dict[str, object]:
    import cga_runtime as cga
    from cga_runtime.experiments.accuracy import against_mujoco

    robot = cga.load_robot(name, mimic="independent")
    return {"joints": robot.nv, "errors": against_mujoco(robot, urdf, states)}


def table(rows: dict[str, dict[str, object]]) -> str:
    lines = ["| robot | joints | " + " | ".join(COLUMNS) + " |", "|---" * (len(COLUMNS) + 2) + "|"]
    for key, row in rows.items():
        name = key.split(":", 1)[1]
        if "refused" in row:
            lines.append(f"| {name} | | refused: {row['refused']} |" + " |" * (len(COLUMNS) - 1))
            continue
        errors = dict(row["errors"])
        errors["kinematics"] = max(errors.pop(k) for k in KINEMATICS if k in errors)
        cells = [f"{errors[c]:.0e}" if c in errors else "–" for c in COLUMNS]
        lines.append(f"| {name} | {row['joints']} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def write(kept: dict[str, dict[str, object]], states: int) -> None:
    import mujoco
    import pinocchio

    parts = {
        "bundled": "## Bundled robots, compiled C, against Pinocchio\n\n",
        "mujoco": "## Bundled robots, compiled C, against MuJoCo (fixed base, mimicking joints independent, as MuJoCo reads them)\n\n",
        "urdf": "## Other URDFs, Python text, against Pinocchio\n\nFrom the package example-robot-data 6.0.0.\n\n",
    }
    text = HEAD.format(states=states, pinocchio=pinocchio.__version__, mujoco=mujoco.__version__)
    for part, title in parts.items():
        rows = {key: row for key, row in kept.items() if key.startswith(part + ":")}
        if rows:
            text += title + table(rows) + "\n"
    (ROOT / "docs" / "accuracy.md").write_text(text.rstrip() + "\n", encoding="utf-8")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--urdf", type=Path, help="folder of URDFs")
    parser.add_argument("--states", type=int, default=1000)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    kept = json.loads(KEPT.read_text()) if KEPT.is_file() else {}
    if options.write:
        write(kept, options.states)
        return
    from cga_runtime.descriptions import bundled_files

    jobs = [(f"bundled:{name}{suffix}", name, path, base) for name, path in bundled_files().items()
            for base, suffix in (("fixed", ""), ("floating", ", floating base"))]  # fmt: skip
    if options.urdf:
        os.environ["CGA_NO_COMPILER"] = "1"
        files = sorted(options.urdf.rglob("*.urdf"))
        jobs = [(f"urdf:{relative_folder(path, options.urdf)}", str(path), path, "fixed") for path in files]
    else:
        jobs += [(f"mujoco:{name}", name, path, "mujoco") for name, path in bundled_files().items()]
    warnings.simplefilter("ignore")
    console = Console(stderr=True)
    KEPT.parent.mkdir(exist_ok=True)
    for key, source, path, base in track(jobs, "robots", console=console):
        if key in kept:
            continue
        kept[key] = measure_mujoco(source, path, options.states) if base == "mujoco" else measure(source, path, base, options.states, 3)
        KEPT.write_text(json.dumps(kept, indent=1))
        worst = max((x for name, x in kept[key].get("errors", {}).items() if name != "condition"), default=0.0)
        console.print(f"{key}: {kept[key].get('refused', f'{worst:.1e}')}", highlight=False)


if __name__ == "__main__":
    main()
