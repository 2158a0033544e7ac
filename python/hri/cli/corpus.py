# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri corpus``."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import click

from hri.cli.groups import FiniteRange, SuggestingGroup
from hri.cli.progress import progress_bars
from hri.core.display import count
from hri.synthetic.drawing.options import BACKGROUNDS, LIGHTS, RANGES, SKINS, SLEEVES, SignerOptions
from hri.synthetic.sentences import SENTENCES, make_sentence_corpus
from hri.synthetic.signer import SIGNS, make_gesture_corpus
from hri.synthetic.speech import DIGIT_WORDS, make_speech_corpus

_out = click.option(
    "--out", required=True, type=click.Path(file_okay=False), metavar="DIR", help="Folder to write, new or empty."
)
_replace = click.option(
    "--replace", is_flag=True, help="What this command made in the folder with other options gives way; nothing else."
)


@click.group(cls=SuggestingGroup)
def corpus() -> None:
    """Make a data set where there are no recordings yet; it says of itself that it is synthetic.

    The folder must be empty, or hold what the same command made; with --replace, what it made with other options gives
    way. Recordings of people, and anything else, are never replaced.

    \b
    Example:
      hri corpus speech go stop left right --out commands/
      hri corpus gesture 1 2 3 --out signs/
      hri corpus sentences --out signed/
    """


@corpus.command()
@click.argument("words", nargs=-1, metavar="[WORD|LABEL=TEXT]...")
@click.option("--language", default="en", show_default=True, help="An espeak-ng voice: en, hi, de, ...")
@_out
@_replace
@click.option("--speakers", default=24, show_default=True, type=click.IntRange(1, 1000), help="Made-up voices.")
@click.option("--takes", default=2, show_default=True, type=click.IntRange(1, 1000), help="Repetitions by each voice.")
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Equal seeds give equal recordings.")
def speech(
    words: tuple[str, ...], out: str, replace: bool, language: str, speakers: int, takes: int, seed: int
) -> None:
    """Words spoken by espeak-ng in many voices, pitches and paces; without words, the digits.

    A word is its own label unless one is given. Synthetic voices vary less than people: record people where you can.

    \b
    Examples:
      hri corpus speech go stop left right --out commands/
      hri corpus speech go=चलो stop=रुको --language hi --out commands_hi/
      hri corpus speech --language hi --out digits/
    """
    if not words and language not in DIGIT_WORDS:
        raise click.UsageError(f"give words: there are digits only for {', '.join(DIGIT_WORDS)}")
    table = dict(_split(word) for word in words) or DIGIT_WORDS[language]
    if words and len(table) < len(words):
        raise click.UsageError("two words have the same label")
    with progress_bars() as progress:
        dataset = make_speech_corpus(
            out,
            {language: table},
            speakers,
            takes,
            seed,
            lambda done, total: progress("speaking", done, total),
            replace,
        )
    recordings = count(len(dataset), "synthetic recording")
    click.echo(f"{recordings} of {count(len(dataset.labels), 'word')} by {count(speakers, 'voice')}: {out}")


def _number(name: str, text: str) -> Callable[[Any], Any]:
    low, high = RANGES[name]
    default = getattr(SignerOptions, name)
    option = "--" + name.replace("_", "-")
    return click.option(option, name, type=FiniteRange(low, high), default=default, show_default=True, help=text)


def _three(option: str, text: str) -> Callable[[Any], Any]:
    return click.option(option, type=(float, float, float), metavar="BLUE GREEN RED", help=text)


@corpus.command()
@click.argument("labels", nargs=-1, metavar="[LABEL]...")
@_out
@_replace
@click.option(
    "--kind",
    type=click.Choice(["still", "clip"]),
    default="still",
    show_default=True,
    help="Close-ups of the hand, or clips of the whole person who raises it.",
)
@click.option("--persons", default=8, show_default=True, type=click.IntRange(1, 1000), help="Made-up people.")
@click.option("--first-person", default=0, show_default=True, type=click.IntRange(0), help="Number of the first one.")
@click.option(
    "--takes", default=1, show_default=True, type=click.IntRange(1, 1000), help="Repetitions by each of them."
)
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Equal seeds give equal pictures.")
@click.option("--skin", type=click.Choice(list(SKINS)), help="Tone of everybody's skin.")
@click.option("--sleeve", type=click.Choice(list(SLEEVES)), help="Where everybody's sleeve ends.")
@click.option("--light", type=click.Choice(list(LIGHTS)), help="Where the light comes from, and how hard it is.")
@click.option("--background", type=click.Choice(BACKGROUNDS), help="What is behind everybody.")
@_three("--wall", "Colour of the wall, 0..255 each.")
@_three("--cast", "Factors of the colours, 0..2 each: coloured light.")
@_number("exposure", "Factor on all light.")
@_number("noise", "Of the camera, in grey levels.")
@_number("vignette", "How much darker the corners are.")
@_number("blur_px", "Of a lens out of focus, in pixels.")
@_number("zoom", "Of the camera.")
@_number("shift_x", "How far the picture moves right, in shares of its width.")
@_number("shift_y", "How far it moves down, in shares of its height.")
@_number("roll_deg", "How far it turns clockwise.")
@_number("fps", "Frames a second of clips.")
@_number("tempo", "How fast people move in clips; 2 is twice as fast.")
def gesture(
    labels: tuple[str, ...],
    out: str,
    replace: bool,
    kind: str,
    persons: int,
    first_person: int,
    takes: int,
    seed: int,
    **asked: Any,
) -> None:
    """Drawn people who show digits with one hand; without labels, all ten.

    What is not asked for differs from person to person. Drawn signs vary less than filmed ones: record people where you
    can. The manifest says that the pictures are synthetic, and holds the options.

    \b
    Examples:
      hri corpus gesture 1 2 3 --persons 20 --out signs/
      hri corpus gesture --kind clip --fps 30 --tempo 1.5 --out clips/
      hri corpus gesture --skin dark --sleeve short --light left --cast 1.3 1 0.7 --noise 12 --out hard/
    """
    options = SignerOptions(**asked)
    with progress_bars() as progress:
        dataset = make_gesture_corpus(
            out,
            labels or SIGNS,
            persons,
            takes,
            kind,
            seed,
            lambda done, total: progress("drawing", done, total),
            options,
            first_person,
            replace,
        )
    pictures = count(len(dataset), "synthetic picture" if kind == "still" else "synthetic clip")
    people = count(persons, "drawn person", "drawn people")
    click.echo(f"{pictures} of {count(len(dataset.labels), 'sign')} by {people}: {out}")


@corpus.command("sentences")
@_out
@_replace
@click.option(
    "--table",
    type=click.Choice(list(SENTENCES)),
    default=next(iter(SENTENCES)),
    show_default=True,
    help="Of the thesis: 10 or 20 sentences.",
)
@click.option("--signers", default=10, show_default=True, type=click.IntRange(1, 1000), help="Made-up people.")
@click.option("--first-signer", default=0, show_default=True, type=click.IntRange(0), help="Number of the first one.")
@click.option("--takes", default=3, show_default=True, type=click.IntRange(1, 100), help="Repetitions by each of them.")
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Equal seeds give equal tracks.")
def signed_sentences(
    out: str, replace: bool, table: str, signers: int, first_signer: int, takes: int, seed: int
) -> None:
    """Drawn people who sign sentences: tracks of both hands and the head, and the frames of the words.

    For 'hri train-sentences' and 'hri read-sentences'. A file synthetic.toml says that no one was filmed.

    \b
    Examples:
      hri corpus sentences --out signed/
      hri corpus sentences --table 'table 5.1' --signers 4 --first-signer 10 --out others/
    """
    with progress_bars() as progress:
        written = make_sentence_corpus(
            out,
            table,
            signers,
            takes,
            seed,
            first_signer,
            lambda done, total: progress("signing", done, total),
            replace,
        )
    num_words = len({word.label for sentence in written for word in sentence.words})
    people = count(signers, "drawn person", "drawn people")
    click.echo(f"{count(len(written), 'synthetic sentence')} of {count(num_words, 'word')} by {people}: {out}")


def _split(word: str) -> tuple[str, str]:
    label, equals, text = word.partition("=")
    return (label, text) if equals else (word, word)
