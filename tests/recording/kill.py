#!/usr/bin/env python3
"""Kills a run at random moments; each time rerun must open what it had recorded, and accept it after `rerun rrd optimize`.

    python3 -m venv venv && venv/bin/pip install rerun-sdk==0.36.3
    venv/bin/python tests/recording/kill.py target/release/cpdmp scenarios/pick_and_place.toml [TIMES]

Ends with 0 when every recording was accepted, with 1 otherwise. The moments are spread evenly over the time that the run takes, with a
random shift.
"""
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

RERUN = str(Path(sys.executable).with_name("rerun"))


def quiet(*command: str) -> subprocess.CompletedProcess:
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def killed(program: str, scenario: str, folder: Path, after_s: float) -> bool:
    """Runs and kills; whether the run was still going."""
    run = subprocess.Popen([program, "run", scenario, "-q", "--out", str(folder / "run")], stdout=subprocess.DEVNULL)
    try:
        run.wait(after_s)
    except subprocess.TimeoutExpired:
        run.kill()
        run.wait()
        return True
    return False


def accepted(recording: Path, mended: Path) -> str:
    """What rerun has against it; nothing if it accepts it."""
    for command in (["rrd", "stats", str(recording)], ["rrd", "optimize", str(recording), "-o", str(mended)], ["rrd", "verify", str(mended)]):
        done = quiet(RERUN, *command)
        if done.returncode != 0:
            return f"rerun {' '.join(command[:2])}: {done.stdout.strip()[-300:]}"
    return ""


def main(program: str, scenario: str, times: int) -> int:
    random.seed(0)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        started = time.monotonic()
        killed(program, scenario, folder, 3600)
        whole_s = time.monotonic() - started
        wrong = 0
        for number in range(times):
            after_s = (number + random.random()) / times * whole_s
            alive = killed(program, scenario, folder, after_s)
            found = sorted(folder.glob(".run.partial/*.rrd")) if alive else [folder / "run/recording.rrd"]
            if not found:
                print(f"{number}: killed after {after_s:.2f} s: nothing was recorded yet", flush=True)
            for recording in found:
                fault = accepted(recording, folder / "mended.rrd")
                wrong += bool(fault)
                print(f"{number}: {'killed' if alive else 'over'} after {after_s:.2f} s: {recording.name}, {recording.stat().st_size} bytes: {fault or 'accepted'}", flush=True)
    return int(wrong > 0)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2], int(sys.argv[3]) if len(sys.argv) == 4 else 20))
