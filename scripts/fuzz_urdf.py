"""Feeds mutated robot files to the readers: no crash, no hang, every refusal named, every accepted model sound.

    ./run shell python scripts/fuzz_urdf.py                                # 10,000 URDFs of seed 1 in two processes
    ./run shell python scripts/fuzz_urdf.py --format mjcf --seed 2 --first 5000 --count 100 --jobs 1

A case is a function of (format, seed, index), see scripts/robot_mutations.py; each runs in a process that may die or be late. What is
accepted must survive JSON, have chains to its tips and finite forward kinematics, and agree with Pinocchio's own reading of the same
bytes (MJCF: MuJoCo's) wherever that reads them. What is refused must say why in one sentence that names the file, by a named error.
Anything else is a finding: saved in out/fuzz/, and the exit status is 1.
"""

import argparse
import contextlib
import json
import math
import multiprocessing
import os
import resource
import signal
import statistics
import sys
import tempfile
import time
from collections import defaultdict
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import Progress
from rich.table import Table
from robot_judgement import judge, load
from robot_mutations import Case, case

ROOT = Path(__file__).resolve().parents[1]
HANG = 10.0
"""Seconds of computing that a case may take, and as many again the comparison with another reader."""
ASLEEP = 60.0
"""Seconds after which a case that waits for something (or for a busy machine) is given up."""
MEMORY = 8 << 30
"""Bytes of address space that a process may take."""


# ---- a worker


def work(form: str, seed: int, folder: Path, pipe: Connection) -> None:
    """A worker's life: indices in; an outcome, its finding and its seconds out."""

    def accepted() -> None:
        signal.setitimer(signal.ITIMER_PROF, HANG)
        pipe.send("accepted")

    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    folder = Path(tempfile.mkdtemp(dir=folder))
    os.chdir(folder)
    with open("printed", "wb") as printed:
        os.dup2(printed.fileno(), 1)
        os.dup2(printed.fileno(), 2)
    load(form, "<robot><link name='a'/></robot>" if form == "urdf" else "<mujoco/>", Case(b"", False, "fixed", "follow", ()))
    pipe.send("ready")
    with contextlib.suppress(EOFError):
        while True:
            index = pipe.recv()
            started = time.perf_counter()
            signal.setitimer(signal.ITIMER_PROF, HANG)  # its signal ends the process, whatever it is in
            outcome, found = judge(form, seed, index, folder, accepted)
            signal.setitimer(signal.ITIMER_PROF, 0.0)
            pipe.send((outcome, found, time.perf_counter() - started))


# ---- in the parent: processes, deadlines, the table


@dataclass
class Worker:
    """A process at work on a case; `stage` is "accepted" once only the comparison is left."""

    form: str
    seed: int
    folder: Path
    index: int = -1
    since: float = math.inf
    stage: str = ""
    pipe: Connection = field(init=False)
    process: Any = field(init=False)

    def __post_init__(self) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, other = context.Pipe()
        self.process = context.Process(target=work, args=(self.form, self.seed, self.folder, other), daemon=True)
        self.process.start()
        other.close()

    def start(self, index: int) -> None:
        self.index, self.since, self.stage = index, time.monotonic(), ""
        self.pipe.send(index)

    def end(self) -> None:
        self.process.kill()
        self.process.join()
        self.pipe.close()


def outcomes(form: str, seed: int, indices: list[int], jobs: int, folder: Path) -> Any:
    """(index, outcome, finding, seconds) of each case, as they come."""
    waiting, workers = list(reversed(indices)), [Worker(form, seed, folder) for _ in range(jobs)]
    while workers:
        wait([worker.pipe for worker in workers], timeout=0.5)
        for worker in list(workers):
            late = time.monotonic() - worker.since > ASLEEP
            try:
                said = worker.pipe.recv() if worker.pipe.poll() else None
            except (EOFError, ConnectionResetError):
                said = "died"
            if said is None and not late:
                continue
            if said == "accepted":
                worker.since, worker.stage = time.monotonic(), said
                continue
            if isinstance(said, tuple):
                yield worker.index, *said
            elif said != "ready":
                worker.process.join(0.0 if said is None else 5.0)
                code = worker.process.exitcode
                how = f"the process died (exit code {code})" if code is not None else f"no answer after {ASLEEP:g} s"
                if code == -signal.SIGPROF:
                    how = f"{HANG:g} s of computing and no answer"
                worker.end()
                if worker.index < 0:
                    raise SystemExit(f"a worker could not start (exit code {code}); run the reader by hand")
                outcome = "finding"
                if worker.stage:
                    outcome, how = "accepted, the peer dies", ""
                yield worker.index, outcome, how, time.monotonic() - worker.since
                workers.remove(worker)
                if waiting:
                    workers.append(Worker(form, seed, folder))
                continue
            if waiting:
                worker.start(waiting.pop())
            else:
                worker.end()
                workers.remove(worker)


def main() -> int:
    parser = argparse.ArgumentParser(description="Feed mutated robot files to the readers.")
    parser.add_argument("--format", choices=["urdf", "mjcf"], default="urdf")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="index of the first case")
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--jobs", type=int, default=2, help="worker processes")
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "fuzz")
    given = parser.parse_args()
    seconds: dict[str, list[float]] = defaultdict(list)
    findings: list[tuple[int, str]] = []
    indices = list(range(given.first, given.first + given.count))
    with tempfile.TemporaryDirectory() as folder, Progress(console=Console(stderr=True)) as progress:
        bar = progress.add_task(f"{given.format}, seed {given.seed}", total=given.count)
        for index, outcome, found, took in outcomes(given.format, given.seed, indices, given.jobs, Path(folder)):
            seconds[outcome].append(took)
            progress.advance(bar)
            if found:
                findings.append((index, found))
                made = case(given.format, given.seed, index)
                given.out.mkdir(parents=True, exist_ok=True)
                saved = given.out / f"{given.seed}-{index}.{given.format}"
                saved.write_bytes(made.data)
                how = {"found": found, "made_by": made.made_by, "base": made.base, "mimic": made.mimic, "as_file": made.as_file}
                saved.with_suffix(".json").write_text(json.dumps(how, indent=1) + "\n")
                progress.console.print(f"{saved}: {found}", markup=False, highlight=False, soft_wrap=True)
    title = f"{given.format}, seed {given.seed}, cases {given.first} to {indices[-1]}"
    table = Table("outcome", "cases", "median ms", "longest ms", title=title)
    for outcome, times in sorted(seconds.items(), key=lambda item: -len(item[1])):
        table.add_row(outcome, str(len(times)), f"{1e3 * statistics.median(times):.1f}", f"{1e3 * max(times):.0f}")
    Console().print(table)
    print(f"{sum(map(len, seconds.values()))} cases, {len(findings)} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
