# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri study``."""

from __future__ import annotations

import click

from hri.cli.output import json_option, say, write_json
from hri.cli.progress import progress_bars
from hri.studies import STUDIES, get_study, run_study


@click.command()
@click.argument("name", metavar="list|NAME")
@click.option(
    "--data",
    type=click.Path(exists=True, file_okay=False),
    help="Folder of recordings; otherwise what HRI_DATA names.",
)
@json_option
def study(name: str, data: str | None, json_path: str | None) -> int:
    """Repeat a measured claim of the project; exit code 1 if its target was missed.

    \b
    Examples:
      hri study list
      hri study fsdd --data recordings/
      HRI_DATA=recordings/ hri study fusion-digits --json fusion.json
    """
    if name == "list":
        for entry in STUDIES.values():
            say(f"{entry.name}\t{entry.summary}\ttarget: {entry.target}", json_path)
        write_json(
            json_path,
            [{"name": s.name, "summary": s.summary, "target": s.target, "data": s.data} for s in STUDIES.values()],
        )
        return 0
    with progress_bars() as progress:
        result = run_study(get_study(name), data, progress)
    for line in _summary(result):
        say(line, json_path)
    write_json(json_path, result)
    if not result["passed"]:
        click.echo(f"hri: study {name} missed its target: {result['target']}", err=True)
        return 1
    return 0


def _summary(result: dict[str, object], indent: str = "") -> list[str]:
    """The numbers of a result, without its long lists."""
    lines = []
    if "accuracy_mean" in result:
        mean, std = float(str(result["accuracy_mean"])), float(str(result["accuracy_std"]))
        lines.append(f"{indent}accuracy\t{100 * mean:.1f} % ± {100 * std:.1f}")
    if "same_decision_16_bit" in result:
        lines.append(f"{indent}16 bits\t{100 * float(str(result['same_decision_16_bit'])):.2f} % of decisions the same")
    if "difference_to_hmm" in result:
        lines.append(f"{indent}difference\t{100 * float(str(result['difference_to_hmm'])):+.2f} points to the HMM")
    for key in ("target", "passed"):
        if key in result:
            value = result[key]
            lines.append(f"{indent}{key}\t{('no', 'yes')[value] if isinstance(value, bool) else value}")
    for key, value in result.items():
        if isinstance(value, dict) and (inner := _summary(value, indent + "  ")):
            lines += [f"{indent}{key}", *inner]
    return lines
