# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Speed against named peers: the same process, the same input, one thread, medians of runs in turns.

ratio is the peer's time over ours: above 1 we are faster. A bench whose recordings or extra are absent is skipped.
"""

from __future__ import annotations

import timing  # isort: skip  # first: it sets thread pools to one

import argparse
import json
import platform
import sys
from pathlib import Path

import bench_cepstra
import bench_classifiers
import bench_codebook
import bench_connected
import bench_hmm
import bench_latency
import bench_person
import bench_possibility
import bench_robot
import bench_signal
import bench_training
import bench_vision
import bench_wavelets
from hri.core.files import write_text
from hri.studies.provenance import date_of_commit, describe_code, hash_benches, source_root

MODULES = (
    bench_wavelets,
    bench_signal,
    bench_cepstra,
    bench_hmm,
    bench_possibility,
    bench_codebook,
    bench_classifiers,
    bench_vision,
    bench_person,
    bench_latency,
    bench_training,
    bench_connected,
    bench_robot,
)
ALL = {bench.name: bench for module in MODULES for bench in module.BENCHES}


def measure(bench: timing.Bench) -> dict[str, object]:
    """One entry of the report."""
    ours, peer, *details = bench.run()
    return {
        "name": bench.name,
        "what": bench.what,
        "ours": ours,
        "peer": peer,
        "unit": "s",
        "peer_name": bench.peer_name,
        "ratio": peer / ours,
        "details": details[0] if details else {},
    }


def processor() -> str:
    """The name that the processor gives itself."""
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.partition(":")[2].strip()
    return platform.machine()


def describe() -> dict[str, object]:
    """The code that is measured: its commit and day, and hashes by which a later change to it is seen."""
    root = source_root()
    measured = describe_code(root)
    if root is None:
        return {"measured": measured}
    return {"measured": {**measured, "date": date_of_commit(root)}, "sources": hash_benches(root)}


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(prog="./run bench", description=__doc__)
    parser.add_argument("--only", nargs="+", choices=ALL, metavar="NAME", help="run these only")
    parser.add_argument(
        "--quick", action="store_true", help="time each once only: checks the answers, measures no speed"
    )
    parser.add_argument("--list", action="store_true", help="list the benches and end")
    parser.add_argument("--json", metavar="FILE", type=Path, help="also write the entries as JSON")
    arguments = parser.parse_args()
    if arguments.list:
        for bench in ALL.values():
            print(f"{bench.name}\t{bench.peer_name}\t{bench.what}")
        return
    if arguments.quick:
        timing.most_repeats = 1
    code = describe()
    entries = []
    print(f"{'bench':22} {'ours':>12} {'peer':>12}  {'ratio':>7}  peer")
    for name in arguments.only or ALL:
        if sys.stderr.isatty():
            print(f"{name} ...", end="\r", file=sys.stderr)
        try:
            entry = measure(ALL[name])
        except timing.Skipped as why:
            print(f"{name:22} skipped: {why}", flush=True)
            continue
        entries.append(entry)
        print(
            f"{name:22} {1e3 * entry['ours']:9.3f} ms {1e3 * entry['peer']:9.3f} ms  {entry['ratio']:6.2f}x  "
            f"{entry['peer_name']}",
            flush=True,
        )
        for what, value in entry["details"].items():
            values = " ".join(f"{v:.4g}" for v in (value if isinstance(value, list) else [value]))
            print(f"{'':22} {what}: {values}", flush=True)
    if arguments.json:
        report = {**code, "machine": processor(), "benches": entries}
        write_text(arguments.json, json.dumps(report, indent=2) + "\n")


if __name__ == "__main__":
    main()
