# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri train``."""

from __future__ import annotations

import click

from hri.cli.choices import (
    asked_options,
    chosen_options,
    front_end_option,
    hands_option,
    names,
    network_option,
    refuse_wrong_noises,
    source_option,
    what_words_are_of,
)
from hri.cli.faces import faces_option, require_faces
from hri.cli.groups import CheckedCommand, is_given
from hri.cli.messages import note
from hri.cli.output import OutputFile, json_option, say, write_json
from hri.cli.progress import progress_bars
from hri.cli.recognizers import (
    embedding_for,
    embedding_option,
    load_dataset,
    mode_argument,
    model_to_write,
    options_option,
    pattern_option,
    recognizer_factory,
)
from hri.cli.train_checks import check_recordings, summary_of
from hri.datasets import Dataset
from hri.recognition import FillerWord, GestureRecognizer, WordRecognizer
from hri.training import fillers_of
from hri.training import train as train_recognizer


@click.command(cls=CheckedCommand)
@mode_argument
@click.option("--data", required=True, type=click.Path(exists=True, file_okay=False), help="Folder of recordings.")
@pattern_option
@click.option("--out", type=OutputFile(), metavar="MODEL", help="Model file; the default is kept per user.")
@options_option("MODE", "num_states=8")
@click.option(
    "--fillers",
    type=click.Path(exists=True, file_okay=False),
    metavar="DIR",
    help="Speech only: a folder of words outside the vocabulary, for rejection, in place of the synthetic ones of hri.",
)
@click.option("--no-fillers", is_flag=True, help="Speech only: no filler words; training and recognition are faster.")
@front_end_option()
@embedding_option
@network_option()
@click.option(
    "--noise",
    "noises",
    multiple=True,
    metavar="white|pink|FILE",
    help="Speech only: train on a copy of every recording in noise too, 0 to 20 dB below the word, best in a recording "
    "of the place where the recogniser is used. With several, each copy takes one of them.",
)
@click.option(
    "--rooms",
    is_flag=True,
    help="Speech only: train on a copy of every recording as heard across a room too, 0.5 to 4 m away: for a "
    "microphone that is not close to the mouth.",
)
@source_option()
@hands_option()
@faces_option("never: an open palm may look like a face")
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Of everything random in training.")
@json_option
def train(
    mode: str,
    data: str,
    pattern: str | None,
    out: str | None,
    options: tuple[str, ...],
    fillers: str | None,
    no_fillers: bool,
    front_end: str | None,
    embedding_path: str | None,
    network: bool | None,
    noises: tuple[str, ...],
    rooms: bool,
    source: str | None,
    hands: str | None,
    faces: str | None,
    seed: int,
    json_path: str | None,
) -> None:
    """Train a recogniser of MODE on every recording in a folder, and print where the model is.

    \b
    Examples:
      hri train speech --data spoken/
      hri train gesture --data signed/ --pattern '{person}/{label}.jpg'
      hri train speech --data spoken/ --out digits.hri --option model=ptbhmm
      hri train speech --data spoken/ --front-end cepstra
      hri train speech --data spoken/ --embedding embedding_model.onnx
      hri train speech --data spoken/ --no-network
      hri train speech --data spoken/ --noise workshop.wav
      hri train speech --data spoken/ --rooms
      hri train gesture --data pairs/ --hands both
      hri train gesture --data room/ --faces auto
    """
    if mode != "speech" and (fillers or no_fillers):
        raise click.UsageError("--fillers and --no-fillers are for speech")
    if fillers and no_fillers:
        raise click.UsageError("--fillers and --no-fillers exclude each other")
    if is_given("seed") and names(options, "seed"):
        raise click.UsageError("--seed and --option seed=... exclude each other")
    if noises and mode != "speech":
        raise click.UsageError("--noise is for speech")
    if rooms and mode != "speech":
        raise click.UsageError("--rooms is for speech")
    refuse_wrong_noises(noises)
    options = asked_options(
        mode,
        options,
        front_end=front_end,
        embedding_path=embedding_path,
        network=network,
        source=source,
        hands=hands,
        faces=faces,
    )
    path = model_to_write(mode, out)
    dataset = load_dataset(data, mode, pattern)
    check_recordings(dataset, path if out is None else None)
    options, why_source = chosen_options(options, dataset)
    untrained = recognizer_factory(mode, options, seed)()
    embedding = embedding_for(untrained, embedding_path)
    others: list[FillerWord] | None = [] if no_fillers else None
    if fillers is not None:
        others = fillers_of(load_dataset(fillers, mode, None, None))
    path.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(untrained, GestureRecognizer):
        untrained.faces = faces
        require_faces(faces)
    # Said before training, which may take hours and shows nothing where there is no terminal.
    note(summary_of(dataset))
    if isinstance(untrained, WordRecognizer):
        for line in what_words_are_of(untrained.options):
            note(line)
    if why_source:
        note(why_source)
    with progress_bars() as progress:
        recognizer = train_recognizer(
            dataset, untrained, fillers=others, embedding=embedding, noises=noises, rooms=rooms, progress=progress
        )
    recognizer.save(path)
    say(str(path), json_path)
    if noises or rooms:
        copies = " and one ".join(how for how, asked in (("in noise", noises), ("across a room", rooms)) if asked)
        note(f"trained on a copy of every recording {copies}, too; what follows counts them all")
    if faces not in (None, "never"):
        note("hands: of the person whose face is seen; wherever the model is used something must find faces")
    report = recognizer.held_out
    for line in report.lines("word" if mode == "speech" else mode) if report is not None else []:
        note(line)
    if report is not None and _each_has_own_labels(dataset):
        note("every person alone recorded some label: recordings, not persons, were held out, and strangers fare worse")
    if report is not None and not dataset.persons:
        note("persons are not known: those held out may have been in training, too, and strangers will fare worse")
    if not recognizer.is_calibrated:
        note("no rejection: nothing could be held out, so that all input gets one of the labels, and confidences")
        note("say nothing; record every label at least twice, best by two persons or more")
    elif len(dataset.persons) < 2:
        note("confidences are calibrated best with two persons or more")
    write_json(
        json_path,
        {
            "model": str(path),
            "mode": mode,
            "labels": dataset.labels,
            "num_recordings": len(dataset),
            "persons": dataset.persons,
            "synthetic": dataset.synthetic,
            "noises": list(noises),
            "rooms": rooms,
            "options": recognizer.options.as_dict(),
            "held_out": None if report is None else report.to_dict(),
            "is_calibrated": recognizer.is_calibrated,
        },
    )


def _each_has_own_labels(dataset: Dataset) -> bool:
    """Whether no person can be held out without a label going missing."""
    by_label: dict[str, set[str | None]] = {}
    for sample in dataset.samples:
        by_label.setdefault(sample.label, set()).add(sample.person)
    alone = {next(iter(persons)) for persons in by_label.values() if len(persons) == 1}
    return len(dataset.persons) > 1 and alone.issuperset(dataset.persons)
