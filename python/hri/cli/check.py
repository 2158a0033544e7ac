# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri robot check``."""

from __future__ import annotations

import re
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

import click

from hri.cli.groups import CheckedCommand
from hri.cli.messages import note
from hri.cli.motions import findings_of, is_file, is_message, robot_option
from hri.cli.output import OutputFile, json_option, say, write_json
from hri.core.display import count
from hri.robot.model.joints import JointTable
from hri.robot.motion.reading import require_pulses
from hri.robot.motion.repair import repair_pulse_csv
from hri.robot.motion.short_csv import is_short_csv
from hri.robot.motion.trajectory import Finding

EXIT_BAD_DATA = 3
MOST_OF_A_KIND = 3
"""Findings of one joint that say the same and are printed."""
_VALUES = re.compile(r"'[^']*'|[-+]?[0-9][0-9.]*(?:e[-+]?[0-9]+)?")


@click.command(cls=CheckedCommand, short_help="Look over motions; exit code 3 for errors.")
@click.argument("motions", nargs=-1, required=True, metavar="MOTION...")
@click.option(
    "--repair", "repaired", type=OutputFile((".csv",), path_type=Path), help="Write a repaired pulse CSV file."
)
@robot_option
@json_option
def check(motions: tuple[str, ...], repaired: Path | None, table: JointTable, json_path: str | None) -> None:
    """Look over every MOTION: the name of a gesture, or a file of pulses, of the short form, of degrees (.tsv) or with
    a JointTrajectory of ROS 2 (.json, .mcap). Tab-separated findings go to stdout, exit code 3 for errors.

    Of findings that say the same of one joint the first three are printed, and how many more there are; --json has them
    all. Of several motions the first column is the motion.

    With --repair, cells that hold no count are taken from their neighbours and counts beyond a limit become the limit
    in a new file; every change is reported on stderr, and the findings are those of the new file.

    \b
    Example:
      hri robot check motion.csv
      hri robot check wave namaste --robot nao
      hri robot check motion.csv --repair repaired.csv
    """
    if repaired is not None:
        _repair(motions, repaired, table)
        motions = (str(repaired),)
    found = []
    for motion in motions:
        findings = findings_of(motion, table)
        for row in _rows(findings):
            say("\t".join(row if len(motions) == 1 else (motion, *row)), json_path)
        errors = sum(finding.severity == "error" for finding in findings)
        note(f"{motion}: {count(errors, 'error')}, {count(len(findings) - errors, 'warning')}")
        found.append({"motion": motion, "errors": errors, "findings": [asdict(finding) for finding in findings]})
    write_json(json_path, {"robot": table.name, "motions": found})
    if any(one["errors"] for one in found):
        sys.exit(EXIT_BAD_DATA)


def _repair(motions: tuple[str, ...], repaired: Path, table: JointTable) -> None:
    if len(motions) > 1 or not is_file(motions[0]) or is_message(motions[0]):
        raise click.UsageError("--repair is of one file of pulses")
    if not is_short_csv(motions[0]):
        require_pulses(motions[0], table)
    for change in repair_pulse_csv(motions[0], repaired):
        where = f"row {change.row}, column {change.column} ({change.joint})"
        note(f"{where}: {change.before!r} is now {change.after}: {change.reason}")


def _rows(findings: list[Finding]) -> Iterator[tuple[str, ...]]:
    """Severity, row, column, joint and message; where many say the same, after the last of them how many more."""
    kinds = [(one.severity, one.joint, _VALUES.sub("", one.message)) for one in findings]
    total, seen = Counter(kinds), Counter[tuple[str, str, str]]()
    for finding, kind in zip(findings, kinds, strict=True):
        seen[kind] += 1
        if seen[kind] <= MOST_OF_A_KIND:
            yield finding.severity, str(finding.row), finding.column, finding.joint, finding.message
        if seen[kind] == MOST_OF_A_KIND < total[kind]:
            yield finding.severity, "", "", finding.joint, f"and {total[kind] - MOST_OF_A_KIND} more like this one"
