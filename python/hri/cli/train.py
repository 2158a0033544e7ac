# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri train``."""

from __future__ import annotations

from pathlib import Path

import click

from hri.cli.faces import faces_option
from hri.cli.groups import CheckedCommand, is_given
from hri.cli.hand_source import choose_source
from hri.cli.messages import note
from hri.cli.noisy_copies import check_noises, with_noisy_copies
from hri.cli.output import OutputFile, json_option, say, write_json
from hri.cli.progress import progress_bars
from hri.cli.recognizers import (
    default_model,
    embedding_for,
    embedding_option,
    load_dataset,
    mode_argument,
    options_option,
    pattern_option,
    recognizer_factory,
    with_embedding,
)
from hri.evaluation.training import fillers_of
from hri.evaluation.training import train as train_recognizer
from hri.recognition import FillerWord, GestureRecognizer, WordRecognizer, embedding_weights
from hri.vision.faces import face_finder

NETWORK_MIN_PERSONS = {"cepstra": 3, "both": 10, "embedding": 10}
"""By front end, from how many on a network is trained unless asked otherwise: beside cepstra it gains much in noise
even with three, beside the embedding little (`hri study fsdd-noise-network`); there it was measured again with
twenty only."""


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
@click.option(
    "--front-end",
    type=click.Choice(["cepstra", "both", "embedding"]),
    help="Speech only: cepstra alone, both: with a pretrained speech embedding, which the extra embedding installs, or "
    "that embedding alone. The default is both where the extra is. The same as --option front_end=...",
)
@embedding_option
@click.option(
    "--network/--no-network",
    default=None,
    help="Speech only: whether a small network, trained on the same words, votes too. It takes minutes; the default is "
    "to do so from three speakers on with cepstra, and from ten on with the embedding. The same as --option "
    "use_network=true or false",
)
@click.option(
    "--noise",
    "noises",
    multiple=True,
    metavar="white|pink|FILE",
    help="Speech only: train on a copy of every recording in noise too, 0 to 20 dB below the word, best in a recording "
    "of the place where the recogniser is used. With several, each copy takes one of them.",
)
@click.option(
    "--source",
    type=click.Choice(["silhouettes", "landmarks"]),
    help="Gesture only: silhouettes of hands, or their joints, as the extra mediapipe finds them. The default is "
    "landmarks where the extra is installed and finds the hands. The same as --option source=...",
)
@click.option(
    "--hands",
    type=click.Choice(["one", "both"]),
    help="Gesture only: whether gestures are of one hand, the default, or of both. The same as --option num_hands=1 or "
    "2",
)
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
      hri train gesture --data pairs/ --hands both
      hri train gesture --data room/ --faces auto
    """
    if mode != "speech" and (fillers or no_fillers):
        raise click.UsageError("--fillers and --no-fillers are for speech")
    if fillers and no_fillers:
        raise click.UsageError("--fillers and --no-fillers exclude each other")
    flags = {
        "--front-end": "front_end",
        "--network": "use_network",
        "--hands": "num_hands",
        "--source": "source",
        "--faces": "use_faces",
    }
    for flag, given in zip(flags, (front_end, network, hands, source, faces), strict=True):
        if given is not None and any(o.startswith(f"{flags[flag]}=") for o in options):
            raise click.UsageError(f"{flag} and --option {flags[flag]}=... exclude each other")
    if is_given("seed") and any(o.startswith("seed=") for o in options):
        raise click.UsageError("--seed and --option seed=... exclude each other")
    if front_end is not None:
        if mode != "speech":
            raise click.UsageError("--front-end is for speech")
        options = (*options, f"front_end={front_end}")
    if embedding_path is not None:
        if mode != "speech":
            raise click.UsageError("--embedding is for speech")
        options = with_embedding(options, embedding_path)
    elif mode == "speech" and _has_embedding() and not any(o.startswith("front_end=") for o in options):
        options = (*options, "front_end=both")
    if network is not None and mode != "speech":
        raise click.UsageError("--network is for speech")
    if noises and mode != "speech":
        raise click.UsageError("--noise is for speech")
    check_noises(noises)
    if hands is not None:
        if mode != "gesture":
            raise click.UsageError("--hands is for gesture")
        options = (*options, f"num_hands={1 if hands == 'one' else 2}")
    if source is not None:
        if mode != "gesture":
            raise click.UsageError("--source is for gesture")
        options = (*options, f"source={source}")
    if faces is not None:
        if mode != "gesture" or "source=landmarks" in options:
            raise click.UsageError("--faces is for gestures by silhouettes")
        options = (*options, f"use_faces={str(faces != 'never').lower()}")
        if source is None and not any(o.startswith("source=") for o in options):
            options = (*options, "source=silhouettes")
    dataset = load_dataset(data, mode, pattern)
    why_source = ""
    if mode == "gesture" and not any(o.startswith("source=") for o in options):
        chosen, why_source = choose_source(dataset)
        options = (*options, f"source={chosen}")
    asked = network is not None or any(o.startswith("use_network=") for o in options)
    if network is not None:
        options = (*options, f"use_network={str(network).lower()}")
    untrained = recognizer_factory(mode, options, seed)()
    if isinstance(untrained, WordRecognizer) and not asked and _trains_network(untrained, len(dataset.persons)):
        untrained = recognizer_factory(mode, (*options, "use_network=true"), seed)()
    embedding = embedding_for(untrained, embedding_path)
    others: list[FillerWord] | None = [] if no_fillers else None
    if fillers is not None:
        others = fillers_of(load_dataset(fillers, mode, None))
    path = default_model(mode) if out is None else Path(out)
    path.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(untrained, GestureRecognizer):
        untrained.faces = faces
        if faces not in (None, "never"):
            face_finder(faces, required=True)  # refused now, not after all recordings
    with progress_bars() as progress, with_noisy_copies(dataset, noises, seed, progress) as trained_on:
        recognizer = train_recognizer(trained_on, untrained, fillers=others, embedding=embedding, progress=progress)
    recognizer.save(path)
    say(str(path), json_path)
    persons = f", {len(dataset.persons)} persons" if dataset.persons else ""
    note(f"{len(dataset)} recordings{persons}, {len(dataset.labels)} labels: {' '.join(dataset.labels)}")
    if isinstance(recognizer, WordRecognizer):
        note(f"front end: {_front_end(recognizer.options.front_end)}")
        if recognizer.options.use_network:
            note("a network of the same words votes too; --no-network trains in a fraction of the time")
    if noises:
        note("trained on a copy of every recording in noise, too; what follows counts both")
    if why_source:
        note(why_source)
    if faces not in (None, "never"):
        note("hands: of the person whose face is seen; wherever the model is used something must find faces")
    report = recognizer.held_out if isinstance(recognizer, WordRecognizer) else None
    for line in report.lines() if report is not None else []:
        note(line)
    if report is not None and not dataset.persons:
        note("persons are not known: those held out may have been in training, too, and strangers will fare worse")
    if len(dataset.persons) < 2:
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
            "options": recognizer.options.as_dict(),
            "held_out": None if report is None else report.to_dict(),
        },
    )


def _trains_network(recognizer: WordRecognizer, num_persons: int) -> bool:
    return num_persons >= NETWORK_MIN_PERSONS[recognizer.options.front_end]


def _has_embedding() -> bool:
    try:
        embedding_weights()
    except ImportError:
        return False
    return True


def _front_end(name: str) -> str:
    """What a model was trained on, and what else there is."""
    if name != "cepstra":
        parts = "both, cepstra and a speech embedding" if name == "both" else "embedding, a speech embedding alone"
        return (
            f"{parts} (extra embedding); wherever the model is used it needs the extra too, or the weights "
            "(--embedding), or --front-end cepstra here"
        )
    return "cepstra; --front-end both understands people better whom it has not met (extra embedding)"
