# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk erest``: training of all models together, from transcripts without times."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from hri.cli.groups import FiniteRange
from hri.cli.htk.data import DataFile, check_headers, data_files, load_frames
from hri.cli.htk.options import (
    ModelFiles,
    References,
    files_to_read,
    folder_option,
    listed_models_options,
    load_configuration,
    models_option,
    new_suffix_option,
    recording_options,
)
from hri.cli.htk.standard import (
    ADAPTATION,
    BINARY,
    INPUT,
    HtkCommand,
    NumbersOption,
    is_number,
    refused_options,
)
from hri.cli.htk.training import NOTHING, updates_option, weight_floor_option
from hri.cli.messages import note
from hri.cli.output import OutputFile, write_text
from hri.core.display import count
from hri.core.errors import FormatError, InvalidArgument
from hri.core.files import make_folder
from hri.htk import Configuration, EmbeddedTrainer, EmbeddedTrainerOptions, ModelOccupation, ModelSet, read_list

WHY = {
    "too_short": "has fewer frames than the models of its transcript take; left out",
    "impossible": "no path within the beam leads through the models of its transcript; left out",
}


def _beams(ctx: click.Context, param: click.Parameter, value: str) -> tuple[float, ...]:
    parts = value.split()
    if len(parts) not in (1, 3) or not all(map(is_number, parts)):
        raise click.BadParameter("takes one number, or three")
    return tuple(map(float, parts))


_TWO_KINDS = "a single pass over two kinds of parameters (HERest -r) is not made"


@click.command(cls=HtkCommand)
@recording_options
@models_option
@listed_models_options
@folder_option
@new_suffix_option
@click.option("-c", "pruning", type=FiniteRange(0), help="Not needed: all Gaussians are summed.")
@click.option("-m", "min_examples", type=click.IntRange(0), default=3, help="Leave models that occur less often.")
@click.option(
    "-p",
    "part",
    type=click.IntRange(0),
    metavar="N",
    help="Write the sums of these recordings alone, to HERN.acc; 0: FILES are such sums of all parts.",
)
@click.option("-s", "statistics", type=OutputFile(), metavar="FILE", help="Write how often states were met.")
@click.option(
    "-t",
    "beams",
    cls=NumbersOption,
    most=3,
    default="0",
    callback=_beams,
    metavar="F [I L]",
    help="Beam; added in steps of I up to L; 0: none.",
)
@updates_option
@click.option("-v", "min_variance", type=FiniteRange(0), default=0.0, help="Least variance.")
@weight_floor_option
@refused_options(
    a=("there are no transforms of models", 0),
    h=("there are no speakers in training", 1),
    k=("there are no transforms of models", 1),
    l=("there are no speakers in training", 1),
    r=(_TWO_KINDS, 0),
    z=("there are no transforms of models", 1),
    **BINARY,
    **ADAPTATION,
)
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
    model_suffix: str | None,
    folder: str | None,
    new_suffix: str | None,
    pruning: float | None,
    min_examples: int,
    part: int | None,
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
      hri htk erest -H hmm0/models -M hmm1 -p 1 -I words.mlf -S half1.scp list
      hri htk erest -H hmm0/models -M hmm1 -p 0 list hmm1/HER1.acc hmm1/HER2.acc
    """
    configuration = load_configuration(configs)
    names = read_list(model_list)
    sources = ModelFiles(macros)
    listed = sources.add_listed(names.values(), model_folder, model_suffix)
    beam, step, limit = (*beams, 0.0, 0.0)[:3]
    options = EmbeddedTrainerOptions(
        beam=beam,
        beam_step=step,
        beam_limit=limit,
        min_examples=min_examples,
        min_variance=min_variance,
        weight_floor=weight_floor,
        **updates,
    )
    try:
        trainer = EmbeddedTrainer(sources.models, options)
    except InvalidArgument as error:
        raise FormatError(f"{' '.join(sources.paths)}: {error}") from error
    if part == 0:
        sums = files_to_read(files, scripts)
        if not sums:
            raise click.UsageError(NOTHING)
        for path in sums:
            trainer.add_sums(path)
    else:
        recordings = data_files(files, scripts, NOTHING)
        references = References(masters, label_folder, suffix)
        utterances = [(file, _units(file.name, references, names)) for file in recordings]
        check_headers(recordings, sources.models, configuration)
        _add_all(trainer, utterances, sources.models, configuration, trace)
    if not trainer.num_frames:
        raise FormatError("no recording fits its transcript; nothing was trained")
    if part:
        target = Path(make_folder(folder or "."), f"HER{part}.acc")
        trainer.write_sums(target)
        if trace:
            click.echo(f"{count(trainer.num_frames, 'frame')} -> {target}")
        return
    occupations = [one for one in trainer.occupations() if one.name in names.values()]
    for one in occupations:
        if one.num_examples < min_examples:
            note(f"{one.name}: occurs {count(one.num_examples, 'time')}, fewer than {min_examples}; not trained")
    renamed = {} if new_suffix is None else {path: str(Path(path).with_suffix(f".{new_suffix}")) for path in listed}
    sources.write(trainer.estimate(), folder, renamed)
    if statistics is not None:
        write_text(Path(statistics), _statistics(occupations))
    click.echo(
        "Reestimation complete - average log prob per frame = "
        f"{trainer.log_likelihood / trainer.num_frames:.6e}\n"
        f"     - total frames seen          = {trainer.num_frames:.6e}"
    )


def _add_all(
    trainer: EmbeddedTrainer,
    utterances: Sequence[tuple[DataFile, list[str]]],
    models: ModelSet,
    configuration: Configuration,
    trace: int,
) -> None:
    """Add recordings with the models of their transcripts; those that do not fit are named."""
    for file, units in utterances:
        frames = load_frames(file, models, configuration)
        before = trainer.log_likelihood
        outcome = trainer.add(frames, units)
        if outcome != "added":
            note(f"{file.name}: {WHY[outcome]}")
        elif trace:
            gained = (trainer.log_likelihood - before) / len(frames)
            click.echo(f"{file.name}: {count(len(frames), 'frame')}, {gained:.4f} a frame")


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
