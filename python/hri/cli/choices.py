# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What ``hri train`` trains and ``hri evaluate`` measures: by flags, and what is chosen without them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import click

from hri.cli.recognizers import parse_options, recognizer_factory, with_embedding
from hri.core.errors import InvalidArgument
from hri.datasets import Dataset
from hri.evaluation.noise import check_noises
from hri.recognition import WordRecognizerOptions
from hri.training import choose_options

Decorator = Callable[[Any], Any]


def front_end_option(option: str = "--option") -> Decorator:
    """``--front-end``; the same as a field that `option` sets."""
    return click.option(
        "--front-end",
        type=click.Choice(["cepstra", "both", "embedding"]),
        help="Speech only: cepstra alone, both: with a pretrained speech embedding, which the extra embedding "
        "installs, or that embedding alone. The default is both where the extra is. The same as "
        f"{option} front_end=...",
    )


def network_option(option: str = "--option") -> Decorator:
    """``--network`` and ``--no-network``."""
    return click.option(
        "--network/--no-network",
        default=None,
        help="Speech only: whether a small network, trained on the same words, votes too. It takes minutes; the "
        "default is to do so from three speakers on with cepstra, and from ten on with the embedding. The same as "
        f"{option} use_network=true or false",
    )


def source_option(option: str = "--option") -> Decorator:
    """``--source``."""
    return click.option(
        "--source",
        type=click.Choice(["silhouettes", "landmarks"]),
        help="Gesture only: silhouettes of hands, or their joints, as the extra mediapipe finds them. The default is "
        f"landmarks where the extra is installed and finds the hands. The same as {option} source=...",
    )


def hands_option(option: str = "--option") -> Decorator:
    """``--hands``."""
    return click.option(
        "--hands",
        type=click.Choice(["one", "both"]),
        help="Gesture only: whether gestures are of one hand, the default, or of both. The same as "
        f"{option} num_hands=1 or 2",
    )


_OF_MODE = {"--front-end": "speech", "--embedding": "speech", "--network": "speech"}
_NAMES = {"--front-end": "front_end", "--network": "use_network", "--hands": "num_hands", "--source": "source"}


def names(options: tuple[str, ...], name: str) -> bool:
    """Whether ``--option`` gives this one."""
    return any(option.startswith(f"{name}=") for option in options)


def asked_options(
    mode: str,
    options: tuple[str, ...],
    *,
    front_end: str | None = None,
    embedding_path: str | None = None,
    network: bool | None = None,
    source: str | None = None,
    hands: str | None = None,
    faces: str | None = None,
    option: str = "--option",
) -> tuple[str, ...]:
    """`options`, which ``option`` gave, and behind them those that the flags stand for.

    Raises
    ------
    click.UsageError
        For a flag of the other mode, and one whose option is given, too.
    """
    flags = {"--front-end": front_end, "--network": network, "--hands": hands, "--source": source}
    for flag, given in (*flags.items(), ("--embedding", embedding_path)):
        if given is not None and mode != _OF_MODE.get(flag, "gesture"):
            raise click.UsageError(f"{flag} is for {_OF_MODE.get(flag, 'gesture')}")
        if given is not None and flag in _NAMES and names(options, _NAMES[flag]):
            raise click.UsageError(f"{flag} and {option} {_NAMES[flag]}=... exclude each other")
    values = {
        "front_end": front_end,
        "use_network": None if network is None else str(network).lower(),
        "num_hands": None if hands is None else 1 if hands == "one" else 2,
        "source": source,
    }
    options = (*options, *(f"{name}={value}" for name, value in values.items() if value is not None))
    if faces is not None:
        if mode != "gesture" or "source=landmarks" in options:
            raise click.UsageError("--faces is for gestures by silhouettes")
        if names(options, "use_faces"):
            raise click.UsageError(f"--faces and {option} use_faces=... exclude each other")
        options = (*options, f"use_faces={str(faces != 'never').lower()}")
        if not names(options, "source"):
            options = (*options, "source=silhouettes")
    return with_embedding(options, embedding_path)


def chosen_options(
    options: tuple[str, ...], dataset: Dataset, num_persons: int | None = None
) -> tuple[tuple[str, ...], str]:
    """`options`, and behind them what they leave open, as `choose_options` says; and why gestures are of this source.

    Parameters
    ----------
    options : tuple of str
        NAME=VALUE texts.
    dataset, num_persons
        As of `choose_options`.
    """
    recognizer_factory(dataset.kind, options, seed=0)  # says of what is wrong with them that --option gave it
    choice = choose_options(dataset, parse_options(options), num_persons=num_persons)
    return (*options, *(f"{name}={value}" for name, value in choice.options.items())), choice.why


def what_words_are_of(options: WordRecognizerOptions) -> list[str]:
    """Lines on what words are recognised by, and what else there is."""
    lines = ["front end: cepstra; --front-end both understands people better whom it has not met (extra embedding)"]
    if options.front_end != "cepstra":
        both = options.front_end == "both"
        parts = "both, cepstra and a speech embedding" if both else "embedding, a speech embedding alone"
        lines = [
            f"front end: {parts} (extra embedding); wherever a model is used it needs the extra too, or the weights "
            "(--embedding), or --front-end cepstra here"
        ]
    if options.use_network:
        lines.append("a network of the same words votes too; --no-network trains in a fraction of the time")
    return lines


def refuse_wrong_noises(noises: Sequence[str], parts: Sequence[str] = ("all",)) -> None:
    """`check_noises` of ``--noise``, before anything is read.

    Raises
    ------
    click.UsageError
        For a noise that is none, or silent.
    FormatError, IoError
        For a file that is no recording; names it.
    """
    try:
        check_noises(noises, parts)
    except InvalidArgument as error:
        raise click.UsageError(f"--{error}") from error
