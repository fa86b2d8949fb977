"""Draws docs/figures/exp_log_accuracy.svg: errors of exp and log of motors against 50 digits, over angles from 1e-16 to pi.

    ./run shell python scripts/exp_log_accuracy.py             # draws, and prints the largest errors
    ./run shell python scripts/exp_log_accuracy.py --samples   # prints the samples as JSON, for scripts/exp_log_pygafro.py

The reference is that of the tests: sine, cosine and complex numbers of mpmath, themselves checked against power series. At each angle
the larger of the errors of rotation and translation counts, each by its own size, and the largest over several random axes is drawn.
"""

import json
import sys
from html import escape
from pathlib import Path

import numpy as np

from cga_runtime.exp_log import BIVECTORS, BLADES, exp, log
from cga_runtime.smooth import NUMPY

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "runtime" / "oracles"))
import exp_log_closed as closed  # noqa: E402  the tests' own reference

PEER = ROOT / "docs" / "data" / "exp_log_pygafro.json"
FIGURE = ROOT / "docs" / "figures" / "exp_log_accuracy.svg"
ANGLES = np.sort(np.concatenate([np.logspace(-16, np.log10(np.pi), 100)[:-1], np.linspace(2e-5, 4e-5, 21), [np.pi * (1 - 1e-12)]]))
AXES = 5
ROTATION, MOVED = "e12 e13 e23", "e1i e2i e3i e123i"
FLOOR = 1e-17
"""Where an error of zero, or a smaller one, is drawn."""

WIDTH, HEIGHT, LEFT, TOP, PANEL_WIDTH, PANEL_HEIGHT, GAP = 960, 456, 78, 78, 400, 290, 62
X_RANGE, Y_RANGE = (-16.0, 0.9), (-17.0, 1.0)
CURVES = {"split": "this package, chart “split”", "lie": "this package, chart “lie” (screw)", "peer": "pygafro {version} (split)"}
STYLE = """
  text { font: 13px system-ui, sans-serif; fill: #24292f; }
  .title { font-size: 15px; font-weight: 600; }
  .small { font-size: 12px; fill: #57606a; paint-order: stroke; stroke: #ffffff; stroke-width: 4px; stroke-linejoin: round; }
  .ground { fill: #ffffff; } .zone { fill: #fdecea; }
  path { fill: none; stroke-width: 1.8; stroke-linejoin: round; }
  .frame { stroke: #8c959f; stroke-width: 1; } .grid { stroke: #d0d7de; stroke-width: 1; }
  .epsilon { stroke: #57606a; stroke-width: 1.2; stroke-dasharray: 2 3; }
  .split { stroke: #0969da; } .lie { stroke: #1a7f37; stroke-dasharray: 7 3; } .peer { stroke: #cf222e; stroke-width: 2.6; }
  .zone ~ .inside { stroke: #fdecea; }
  @media (prefers-color-scheme: dark) {
    text { fill: #e6edf3; } .small { fill: #9da7b3; stroke: #0d1117; } .ground { fill: #0d1117; } .zone { fill: #2d1a1c; }
    .frame { stroke: #6e7681; } .grid { stroke: #30363d; } .epsilon { stroke: #9da7b3; }
    .split { stroke: #58a6ff; } .lie { stroke: #3fb950; } .peer { stroke: #ff7b72; } .zone ~ .inside { stroke: #2d1a1c; }
  }
"""


def samples() -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Bivectors (angles, axes, 6), and for each chart the motors that are their exponentials, rounded once, (angles, axes, 8)."""
    rng = np.random.default_rng(6)
    axis, v = rng.normal(size=(2, len(ANGLES), AXES, 3))
    axis *= ANGLES[:, None, None] / np.linalg.norm(axis, axis=-1, keepdims=True)
    bivectors = np.concatenate([axis, v], axis=-1)
    flat = bivectors.reshape(-1, 6)
    motors = {chart: np.array([[float(x) for x in closed.exp("motor", b, chart)] for b in flat]) for chart in ("split", "lie")}
    return bivectors, {chart: m.reshape(len(ANGLES), AXES, 8) for chart, m in motors.items()}


def exp_errors(bivectors: np.ndarray, found: np.ndarray, chart: str) -> np.ndarray:
    """Largest relative errors over the axes, (angles,)."""
    rows = []
    for at, values in zip(bivectors, found, strict=True):
        sizes = ({"1": 1.0, ROTATION: None, MOVED: 0.5 * np.linalg.norm(b[3:])} for b in at)
        rows.append(
            max(closed.error(v, closed.exp("motor", b, chart), BLADES["motor"], s) for b, v, s in zip(at, values, sizes, strict=True))
        )
    return np.array(rows)


def log_errors(motors: np.ndarray, found: np.ndarray, chart: str) -> np.ndarray:
    """Largest relative errors over the axes, (angles,)."""
    parts = {ROTATION: None, MOVED: None}
    return np.array(
        [
            max(closed.error(b, closed.log("motor", m, chart), BIVECTORS["motor"], parts) for m, b in zip(at, values, strict=True))
            for at, values in zip(motors, found, strict=True)
        ]
    )


def measured() -> tuple[dict[str, dict[str, np.ndarray]], str]:
    """Errors by panel ("exp", "log") and curve, and the peer's version."""
    bivectors, motors = samples()
    errors: dict[str, dict[str, np.ndarray]] = {"exp": {}, "log": {}}
    for chart in ("split", "lie"):
        made = np.stack(exp(NUMPY, "motor", np.moveaxis(bivectors, -1, 0), chart), axis=-1)
        errors["exp"][chart] = exp_errors(bivectors, made, chart)
        found = np.stack(log(NUMPY, "motor", np.moveaxis(motors[chart], -1, 0), chart), axis=-1)
        errors["log"][chart] = log_errors(motors[chart], found, chart)
    peer = json.loads(PEER.read_text(encoding="utf-8"))
    shape = bivectors.shape[:2]
    errors["exp"]["peer"] = exp_errors(bivectors, np.array(peer["exp"]).reshape(*shape, 8), "split")
    errors["log"]["peer"] = log_errors(motors["split"], np.array(peer["log"]).reshape(*shape, 6), "split")
    return errors, peer["origin"]["version"]


def svg(errors: dict[str, dict[str, np.ndarray]], version: str) -> str:
    """The picture: two panels, logarithmic axes, colours for light and dark."""
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="Accuracy of exp and log of motors">'
    ]
    parts += [f"<style>{STYLE}</style>", f'<rect class="ground" width="{WIDTH}" height="{HEIGHT}"/>']
    for k, (curve, words) in enumerate(CURVES.items()):
        x = LEFT + (0, 232, 520)[k]
        parts.append(f'<path class="{curve}" d="M{x} 24h34"/>' + _text(x + 42, 28, words.format(version=version)))
    for k, (name, title) in enumerate((("exp", "motor = exp(bivector)"), ("log", "bivector = log(motor)"))):
        parts += _panel(LEFT + k * (PANEL_WIDTH + GAP), name, title, errors[name])
    parts.append(_text(22, TOP + PANEL_HEIGHT / 2, "largest relative error", turn=True))
    note = (
        f"Against 50 digits; the larger error of rotation and translation over {AXES} random axes, |v| about 1 m. Zero is drawn at 10⁻¹⁷."
    )
    parts.append(_text(LEFT, HEIGHT - 14, note, "small"))
    return "\n".join([*parts, "</svg>", ""])


def _panel(left: float, name: str, title: str, curves: dict[str, np.ndarray]) -> list[str]:
    def x(angle: float) -> float:
        return left + PANEL_WIDTH * (np.log10(angle) - X_RANGE[0]) / (X_RANGE[1] - X_RANGE[0])

    def y(error: float) -> float:
        return TOP + PANEL_HEIGHT * (Y_RANGE[1] - np.log10(max(error, FLOOR))) / (Y_RANGE[1] - Y_RANGE[0])

    bottom = TOP + PANEL_HEIGHT
    parts = [_text(left, TOP - 14, title, "title")]
    dead = ANGLES[curves["peer"] > 0.5]
    if name == "log" and len(dead):
        parts.append(f'<rect class="zone" x="{left:.1f}" y="{TOP}" width="{x(dead[-1]) - left:.1f}" height="{PANEL_HEIGHT}"/>')
    for power in range(-16, 1, 4):
        parts.append(f'<path class="grid" d="M{x(10.0**power):.1f} {TOP}V{bottom}"/>')
        parts.append(_text(x(10.0**power), bottom + 19, _power(power), anchor="middle"))
        parts.append(f'<path class="grid" d="M{left} {y(10.0**power):.1f}h{PANEL_WIDTH}"/>')
        parts.append(_text(left - 8, y(10.0**power) + 4, _power(power), anchor="end"))
    epsilon = y(float(np.finfo(float).eps))
    parts.append(f'<path class="epsilon" d="M{left} {epsilon:.1f}h{PANEL_WIDTH}"/>')
    parts.append(_text(left + PANEL_WIDTH - 6, epsilon - 7, "2⁻⁵², spacing of floats at 1", "small", anchor="end"))
    if name == "log" and len(dead):
        middle = 0.5 * (left + x(dead[-1]))
        for k, words in enumerate(("dead zone: pygafro’s log returns", f"no rotation up to {dead[-1]:.1e} rad")):
            parts.append(_text(middle, y(1e-6) + 18 * k, words, "small inside", anchor="middle"))
    parts.append(f'<path class="frame" d="M{left} {TOP}h{PANEL_WIDTH}v{PANEL_HEIGHT}h{-PANEL_WIDTH}z"/>')
    for curve in ("peer", "split", "lie"):
        points = "L".join(f"{x(a):.1f} {y(e):.1f}" for a, e in zip(ANGLES, curves[curve], strict=True))
        parts.append(f'<path class="{curve}" d="M{points}"/>')
    parts.append(_text(x(np.pi), bottom + 19, "π", anchor="middle"))
    return [*parts, _text(left + PANEL_WIDTH / 2, bottom + 44, "rotation angle (rad)", anchor="middle")]


def _power(power: int) -> str:
    return "1" if power == 0 else f"10{str(power).translate(str.maketrans('-0123456789', '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'))}"


def _text(x: float, y: float, words: str, kind: str = "", anchor: str = "start", turn: bool = False) -> str:
    options = (f' class="{kind}"' if kind else "") + (
        f' transform="rotate(-90 {x:.1f} {y:.1f})" text-anchor="middle"' if turn else f' text-anchor="{anchor}"'
    )
    return f'<text x="{x:.1f}" y="{y:.1f}"{options}>{escape(words)}</text>'


def main() -> None:
    """Prints samples, or measures, draws, and prints the largest errors."""
    if "--samples" in sys.argv:
        bivectors, motors = samples()
        json.dump({"bivectors": bivectors.reshape(-1, 6).tolist(), "motors": motors["split"].reshape(-1, 8).tolist()}, sys.stdout)
        return
    errors, version = measured()
    FIGURE.parent.mkdir(parents=True, exist_ok=True)
    FIGURE.write_text(svg(errors, version), encoding="utf-8")
    for name, curves in errors.items():
        for curve, values in curves.items():
            where = f"{values.max():.1e} at {ANGLES[values.argmax()]:.1e} rad"
            print(f"{name} {CURVES[curve].format(version=version)}: largest relative error {where}")
    dead = ANGLES[errors["log"]["peer"] > 0.5]
    print(f"pygafro's log returns no rotation up to {dead.max():.2e} rad")


if __name__ == "__main__":
    main()
