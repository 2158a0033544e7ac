# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk compv`` and ``hri htk erest``: training of all models together, from transcripts without times."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from hri.cli.groups import CheckedCommand, FiniteRange
from hri.cli.htk.options import (
    INPUT,
    ModelFiles,
    References,
    all_arguments,
    config_option,
    label_folder_option,
    label_suffix_option,
    labels_option,
    load_configuration,
    models_option,
    script_option,
    trace_option,
)
from hri.cli.htk.training import NOTHING, label_option, segments
from hri.cli.messages import note
from hri.cli.output import OutputFile, write_text
from hri.core.errors import FormatError
from hri.core.files import make_folder
from hri.htk import (
    EmbeddedTrainer,
    EmbeddedTrainerOptions,
    FlatStart,
    ModelOccupation,
    load_observations,
    read_list,
)

FLAGS = {"t": "update_transitions", "m": "update_means", "v": "update_variances", "w": "update_weights"}
WHY = {
    "too_short": "has fewer frames than the models of its transcript take; left out",
    "impossible": "no path within the beam leads through the models of its transcript; left out",
}


@click.command(cls=CheckedCommand)
@config_option
@models_option
@labels_option
@label_folder_option
@label_suffix_option
@script_option
@trace_option
@label_option
@click.option("-M", "folder", default=".", show_default=True, metavar="DIR", help="Where the models go.")
@click.option("-m", "means", is_flag=True, help="Set the means, too.")
@click.option("-f", "share", type=FiniteRange(0, min_open=True), help="Write vFloors: this share of the variance.")
@click.option("-v", "min_variance", type=FiniteRange(0), default=0.0, help="Least variance.")
@click.option("-o", "name", metavar="NAME", help="Name of the model; that of the prototype else.")
@click.argument("prototype", type=INPUT)
@click.argument("files", nargs=-1)
def compv(
    configs: tuple[str, ...],
    macros: tuple[str, ...],
    masters: tuple[str, ...],
    label_folder: str | None,
    suffix: str,
    scripts: tuple[str, ...],
    trace: int,
    label: str | None,
    folder: str,
    means: bool,
    share: float | None,
    min_variance: float,
    name: str | None,
    prototype: str,
    files: tuple[str, ...],
) -> None:
    """Set all Gaussians of a prototype to the variance of all frames, with -m to their mean, as HCompV.

    \b
    Example:
      hri htk compv -m -f 0.01 -M hmm0 -S train.scp proto
    """
    sources = ModelFiles(macros)
    above = set(sources.models.hmm_names)
    sources.read(prototype)
    defined = [model for model in sources.models.hmm_names if model not in above]
    if len(defined) != 1:
        raise FormatError(f"{prototype}: defines {len(defined)} models, not one")
    start = FlatStart()
    references = References(masters, label_folder, suffix)
    for frames in segments(all_arguments(files, scripts), sources.models.kind, configs, references, label):
        start.add(frames)
    if not start.num_frames:
        raise click.UsageError(NOTHING)
    made = start.apply(sources.models, means, min_variance)
    floors = None if share is None else start.variance_floors(share)
    made.rename_hmm(defined[0], name or defined[0])
    target = sources.write(made, folder, {prototype: name or prototype})[-1]
    if floors is not None:
        floors.write(Path(make_folder(folder), "vFloors"))
    if trace:
        click.echo(f"{defined[0]}: {start.num_frames} frames -> {target}")


class _PruningCommand(click.Command):
    """HTK's -t takes one number, or three."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        given = list(args)
        if "-t" in given:
            at = given.index("-t") + 1
            numbers = given[at : at + 3]
            if len(numbers) == 3 and all(map(_is_number, numbers)):
                given[at : at + 3] = [" ".join(numbers)]
        return super().parse_args(ctx, given)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _beams(ctx: click.Context, param: click.Parameter, value: str) -> tuple[float, ...]:
    parts = value.split()
    if len(parts) not in (1, 3) or not all(map(_is_number, parts)):
        raise click.BadParameter("takes one number, or three")
    return tuple(map(float, parts))


def _updates(ctx: click.Context, param: click.Parameter, value: str) -> dict[str, bool]:
    if set(value) - set(FLAGS):
        raise click.BadParameter(f"takes letters of {''.join(FLAGS)}")
    return {field: flag in value for flag, field in FLAGS.items()}


@click.command(cls=_PruningCommand)
@config_option
@models_option
@labels_option
@label_folder_option
@label_suffix_option
@script_option
@trace_option
@click.option("-d", "model_folder", metavar="DIR", help="Folder of models that no -H defines, a file for each.")
@click.option("-M", "folder", metavar="DIR", help="Where the models go; over those that were read else.")
@click.option("-m", "min_examples", type=click.IntRange(0), default=3, help="Leave models that occur less often.")
@click.option("-s", "statistics", type=OutputFile(), metavar="FILE", help="Write how often states were met.")
@click.option(
    "-t", "beams", default="0", callback=_beams, metavar="F [I L]", help="Beam; added in steps of I up to L; 0: none."
)
@click.option("-u", "updates", default="tmvw", callback=_updates, metavar="FLAGS", help="What to estimate: tmvw.")
@click.option("-v", "min_variance", type=FiniteRange(0), default=0.0, help="Least variance.")
@click.option("-w", "weight_floor", type=FiniteRange(0), default=0.0, help="Least mixture weight, times 1e-5.")
@click.argument("model_list", type=INPUT)
@click.argument("files", nargs=-1)
def erest(
    configs: tuple[str, ...],
    macros: tuple[str, ...],
    masters: tuple[str, ...],
    label_folder: str | None,
    suffix: str,
    scripts: tuple[str, ...],
    trace: int,
    model_folder: str | None,
    folder: str | None,
    min_examples: int,
    statistics: str | None,
    beams: tuple[float, ...],
    updates: dict[str, bool],
    min_variance: float,
    weight_floor: float,
    model_list: str,
    files: tuple[str, ...],
) -> None:
    """Train all models of the list by one pass of embedded Baum-Welch, as HERest.

    \b
    Example:
      hri htk erest -H hmm0/models -M hmm1 -I words.mlf -S train.scp list
    """
    names = read_list(model_list)
    sources = models_of(names, macros, model_folder)
    beam, step, limit = (*beams, 0.0, 0.0)[:3]
    options = EmbeddedTrainerOptions(
        beam=beam,
        beam_step=step,
        beam_limit=limit,
        min_examples=min_examples,
        min_variance=min_variance,
        weight_floor=weight_floor,
        update_transitions=updates["update_transitions"],
        update_means=updates["update_means"],
        update_variances=updates["update_variances"],
        update_weights=updates["update_weights"],
    )
    trainer = EmbeddedTrainer(sources.models, options)
    references = References(masters, label_folder, suffix)
    utterances = [(file, _units(file, references, names)) for file in all_arguments(files, scripts)]
    if not utterances:
        raise click.UsageError(NOTHING)
    configuration = load_configuration(configs)
    for file, units in utterances:
        frames, _ = load_observations(file, sources.models.kind, configuration)
        before = trainer.log_likelihood
        outcome = trainer.add(frames, units)
        if outcome != "added":
            note(f"{file}: {WHY[outcome]}")
        elif trace:
            click.echo(f"{file}: {len(frames)} frames, {(trainer.log_likelihood - before) / len(frames):.4f} a frame")
    if not trainer.num_frames:
        raise FormatError("no recording fits its transcript; nothing was trained")
    occupations = [one for one in trainer.occupations() if one.name in names.values()]
    for one in occupations:
        if one.num_examples < min_examples:
            note(f"{one.name}: occurs {one.num_examples} times, fewer than {min_examples}; not trained")
    sources.write(trainer.estimate(), folder)
    if statistics is not None:
        write_text(Path(statistics), _statistics(occupations))
    click.echo(
        "Reestimation complete - average log prob per frame = "
        f"{trainer.log_likelihood / trainer.num_frames:.6e}\n"
        f"     - total frames seen          = {trainer.num_frames:.6e}"
    )


def models_of(names: dict[str, str], macros: Sequence[str], folder: str | None) -> ModelFiles:
    """The files of all physical models of a list: those given, and for others one each in `folder`.

    Raises
    ------
    FormatError
        For a model that is defined nowhere.
    """
    sources = ModelFiles(macros)
    for model in dict.fromkeys(names.values()):
        if model in sources.models.hmm_names:
            continue
        path = Path(folder or ".", model)
        if not path.is_file():
            raise FormatError(f"{path}: there is no such file, and no -H defines the model {model!r}")
        sources.read(str(path))
        if model not in sources.models.hmm_names:
            raise FormatError(f"{path}: does not define the model {model!r}")
    return sources


def _units(file: str, references: References, names: dict[str, str]) -> list[str]:
    """The physical models of a transcript, all of which are in the list."""
    transcription, source = references.locate(file)
    for label in transcription.labels:
        if label.name not in names:
            raise FormatError(f"{source}: line {label.line}: the list of models does not have {label.name!r}")
    if not transcription.labels:
        raise FormatError(f"{source}: the transcript of {file} is empty")
    return [names[label.name] for label in transcription.labels]


def _statistics(occupations: Sequence[ModelOccupation]) -> str:
    """A line of each model: number, name, occurrences, and expected frames of its states."""
    width = max(len(one.name) for one in occupations) + 2
    lines = []
    for number, one in enumerate(occupations, 1):
        quoted = f'"{one.name}"'
        states = " ".join(f"{frames:10f}" for frames in one.states)
        lines.append(f"{number:4d} {quoted:>{width}} {one.num_examples:4d} {states}\n")
    return "".join(lines)
