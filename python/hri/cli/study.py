# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri study``."""

from __future__ import annotations

from pathlib import Path

import click

from hri.cli.groups import CheckedCommand
from hri.cli.messages import note
from hri.cli.output import json_option, say, write_json, write_text
from hri.cli.progress import progress_bars
from hri.core.optional import import_optional
from hri.studies import STUDIES, Study, draw, get_study
from hri.studies.kept import measure, read_kept, verify
from hri.studies.rendering import csv_text, markdown, table


@click.command(cls=CheckedCommand)
@click.argument("name", metavar="list|NAME")
@click.option(
    "--data",
    type=click.Path(exists=True, file_okay=False),
    help="Folder of recordings; otherwise what HRI_DATA names.",
)
@click.option(
    "--out",
    type=click.Path(file_okay=False),
    metavar="DIR",
    help="Write NAME.md and NAME.csv (tables), NAME.png (plot) and NAME.json (everything) into this folder.",
)
@click.option(
    "--only",
    multiple=True,
    metavar="AXIS=VALUE[,VALUE]",
    help="Run a part of the study, such as noise=white,pink; 'hri study list' names the axes. May be given several "
    "times.",
)
@click.option(
    "--takes",
    type=click.IntRange(1),
    metavar="N",
    help="Only the first N recordings of every word by every person, where the study allows it.",
)
@click.option("--folds", type=click.IntRange(1), metavar="N", help="Only the first N folds, where the study has folds.")
@click.option(
    "--verify",
    "kept_path",
    type=click.Path(exists=True, dir_okay=False),
    metavar="FILE",
    help="Measure a part of the kept result in FILE anew; if it is the same, stamp FILE with the present code.",
)
@json_option
def study(
    name: str,
    data: str | None,
    out: str | None,
    only: tuple[str, ...],
    takes: int | None,
    folds: int | None,
    kept_path: str | None,
    json_path: str | None,
) -> int:
    """Repeat a published measurement; exit code 1 if its target is not met.

    \b
    Examples:
      hri study list
      hri study fsdd --data recordings/ --out results/
      hri study fsdd-noise --data recordings/ --only noise=white --takes 10
      HRI_DATA=recordings/ hri study fusion-digits --json fusion.json
      hri study fsdd --data recordings/ --verify docs/results/fsdd.json
    """
    if name == "list":
        _say_list(json_path)
        return 0
    chosen = _parse_only(only)
    found = get_study(name)
    if kept_path is not None:
        if only or takes or folds or out or json_path:
            raise click.UsageError("--verify takes the arguments of the study from FILE")
        _verify(found, Path(kept_path), data)
        return 0
    if out is not None:
        import_optional("matplotlib", "plots", "to draw the results of studies")
        Path(out).mkdir(parents=True, exist_ok=True)
    with progress_bars() as progress:
        result = measure(found, data, progress, chosen, takes, folds)
    for line in _summary(result):
        say(line, json_path)
    if "rows" in result:
        for cells in table(result, found.layout):
            say("\t".join(cells), json_path)
    write_json(json_path, result)
    if out is not None:
        place = Path(out) / name
        write_text(place.with_suffix(".md"), markdown(result, found.layout))
        write_text(place.with_suffix(".csv"), csv_text(result, found.layout))
        write_json(str(place.with_suffix(".json")), result)
        draw(result, found.layout, place.with_suffix(".png"))
        note(f"results: {place}.md .csv .json .png")
    if result["passed"] is False:
        click.echo(f"hri: study {name} did not meet its target: {result['target']}", err=True)
        return 1
    return 0


def _verify(found: Study, path: Path, data: str | None) -> None:
    kept = read_kept(path)
    if kept["study"] != found.name:
        raise click.UsageError(f"{path} is of the study {kept['study']}, not of {found.name}")
    with progress_bars() as progress:
        stamped = verify(found, kept, data, progress)
    write_json(str(path), stamped)
    click.echo(f"{found.name}\tthe same as measured at {kept['measured'].get('commit', kept['measured']['version'])}")


def _say_list(json_path: str | None) -> None:
    for entry in STUDIES.values():
        axes = "".join(f"\t{axis}: {', '.join(values)}" for axis, values in entry.axes.items())
        say(f"{entry.name}\t{entry.summary}\ttarget: {entry.target}{axes}", json_path)
    write_json(
        json_path,
        [
            {"name": s.name, "summary": s.summary, "target": s.target, "data": s.data, "axes": dict(s.axes)}
            for s in STUDIES.values()
        ],
    )


def _parse_only(only: tuple[str, ...]) -> dict[str, list[str]]:
    chosen: dict[str, list[str]] = {}
    for text in only:
        axis, equals, values = text.partition("=")
        if not equals or not axis or not values:
            raise click.UsageError(f"--only {text!r} is not AXIS=VALUE")
        chosen.setdefault(axis, []).extend(values.split(","))
    return chosen


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
    if {"median", "95 %", "most"} <= result.keys():
        lines.append(f"{indent}median\t{result['median']:.4g}, 95 % {result['95 %']:.4g}, most {result['most']:.4g}")
    if "substitutions" in result:
        counted = ("substitutions", "deletions", "insertions")
        lines.append(f"{indent}of {result['num_words']} words\t{', '.join(f'{result[k]} {k}' for k in counted)}")
    for key in ("target", "passed"):
        value = result.get(key)
        if value is not None:
            lines.append(f"{indent}{key}\t{('no', 'yes')[value] if isinstance(value, bool) else value}")
    for key, value in result.items():
        if isinstance(value, dict) and (inner := _summary(value, indent + "  ")):
            lines += [f"{indent}{key}", *inner]
    return lines
