#!/usr/bin/env python3
"""Reads a run's recording with rerun's own Python library and compares it with the run's step log, bit for bit.

    python3 -m venv venv && venv/bin/pip install rerun-sdk==0.36.3
    venv/bin/python tests/recording/read_back.py runs/pick_and_place-0

Ends with 0 when every number of every compared series is the same, with 1 otherwise.
"""
import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet
from rerun.experimental import RrdReader

AXES = ["x", "y", "z"]
# Entity of the recording and column of the step log.
SERIES = (
    [(f"/plots/motion/{a}/tool", f"tool_{a}_m") for a in AXES]
    + [(f"/plots/force/{a}/measured", f"force_{a}_n") for a in AXES]
    + [(f"/plots/force/{a}/expected", f"expected_force_{a}_n") for a in AXES]
    + [(f"/plots/force/{a}/person", f"human_force_{a}_n") for a in AXES]
    + [(f"/plots/torque/{a}", f"torque_{a}_nm") for a in AXES]
    + [(f"/plots/coupling/{a}", f"coupling_{a}_m") for a in AXES]
    + [("/plots/compliance/beta", "beta"), ("/plots/compliance/activation", "activation")]
    + [("/plots/gripper/commanded", "gripper_command"), ("/plots/gripper/measured", "gripper_opening")]
)


def series(recording: Path, timeline: str, component: str) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Times (ns) and values of every entity with that component."""
    parts: dict[str, list[tuple[np.ndarray, np.ndarray]]] = {}
    for chunk in RrdReader(str(recording)).stream():
        batch = chunk.to_record_batch()
        # Outlines have several values per row, and no column of the log.
        compared = any(chunk.entity_path == entity for entity, _ in SERIES)
        if not compared or chunk.is_static or not {timeline, component} <= set(batch.schema.names):
            continue
        times = np.array(batch.column(timeline).cast("int64"))
        values = np.array(batch.column(component).flatten())
        assert len(times) == len(values), f"{chunk.entity_path}: not one value per row"
        parts.setdefault(chunk.entity_path, []).append((times, values))
    joined = {}
    for entity, pieces in parts.items():
        times, values = (np.concatenate([piece[i] for piece in pieces]) for i in range(2))
        order = np.argsort(times, kind="stable")
        joined[entity] = times[order], values[order]
    return joined


def main(run: Path) -> int:
    log = pyarrow.parquet.read_table(run / "steps.parquet")
    columns = {name: log.column(name).to_numpy() for name in log.column_names}
    recorded = series(run / "recording.rrd", "sim_time", "Scalars:scalars")
    steps = np.rint(columns["time_s"] * 1e9).astype(np.int64)
    wrong = 0
    for entity, column in SERIES:
        if entity not in recorded:
            if log.column(column).null_count == len(log) or not np.any(columns[column]):
                continue  # A skill without a force model expects nothing, and where nobody helps nobody pushes.
            print(f"{entity}: not in the recording")
            wrong += 1
            continue
        times, values = recorded[entity]
        same = np.array_equal(times, steps) and np.array_equal(values.view(np.int64), columns[column].view(np.int64))
        wrong += not same
        print(f"{entity} = {column}: {len(values)} values, {'the same bits' if same else 'DIFFERENT'}")
    return int(wrong > 0)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(Path(sys.argv[1])))
