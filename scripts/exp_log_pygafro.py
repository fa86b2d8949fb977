"""Evaluates pygafro's exponential and logarithm of motors at given samples, for scripts/exp_log_accuracy.py.

Only this needs pygafro, and nobody needs to run it: what it found is kept in docs/data/exp_log_pygafro.json. In an environment with it:

    ./run shell python scripts/exp_log_accuracy.py --samples > samples.json
    python scripts/exp_log_pygafro.py < samples.json > docs/data/exp_log_pygafro.json
"""

import datetime
import importlib.metadata
import json
import platform
import sys


def main() -> None:
    """Reads samples (lists of bivectors and motors, blades in ascending order), prints what pygafro makes of them, and versions."""
    import numpy as np
    import pygafro

    given = json.load(sys.stdin)
    exp = [pygafro.MotorExponential(pygafro.MotorGenerator(np.array(b))).evaluate().vector().ravel().tolist() for b in given["bivectors"]]
    log = [pygafro.MotorLogarithm(pygafro.Motor(np.array(m))).evaluate().vector().ravel().tolist() for m in given["motors"]]
    origin = {
        "package": "pygafro",
        "version": importlib.metadata.version("pygafro"),
        "date": datetime.date.today().isoformat(),
        "python": platform.python_version(),
        "machine": platform.machine(),
    }
    json.dump({"origin": origin, "exp": exp, "log": log}, sys.stdout)


if __name__ == "__main__":
    main()
