"""What the README and scripts/ show runs, and says what it should."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def run(*arguments: str) -> str:
    done = subprocess.run([sys.executable, *arguments], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_readme_example_runs():
    (example,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), re.DOTALL)
    assert run("-c", example) == "True (1000, 8)\n"


def test_the_example_of_cooperative_arms_runs():
    (example,) = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / "cooperative.md").read_text(encoding="utf-8"), re.DOTALL)
    assert run("-c", example + "print(found.success, v.shape)") == "True (21,)\n"


def test_the_tour_of_two_arms():
    text = run(str(ROOT / "scripts" / "two_arms.py"))
    assert "joint mobility 4; the object has 4 degrees of freedom: 1T3R\n" in text
    assert "motors (1, 2, 3, 7): mu = 0.000\nmotors (1, 2, 6, 7): mu = 0.000\n" in text
    assert "fails here because of its factor sin(q1 - q6)\n" in text
    assert "inside the joint limits: " in text and "lifting the object by 4 cm: reached" in text
