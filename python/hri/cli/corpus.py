# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri corpus``."""

from __future__ import annotations

import click

from hri.cli.progress import progress_bars
from hri.datasets.synthetic_speech import DIGIT_WORDS, make_speech_corpus


@click.group()
def corpus() -> None:
    """Make a data set where there are no recordings yet; it says of itself that it is synthetic.

    \b
    Example:
      hri corpus speech go stop left right --out commands/
    """


@corpus.command()
@click.argument("words", nargs=-1, metavar="[WORD|LABEL=TEXT]...")
@click.option("--language", default="en", show_default=True, help="An espeak-ng voice: en, hi, de, ...")
@click.option("--out", required=True, type=click.Path(file_okay=False), metavar="DIR", help="Folder to write.")
@click.option("--speakers", default=24, show_default=True, type=click.IntRange(1, 1000), help="Made-up voices.")
@click.option("--takes", default=2, show_default=True, type=click.IntRange(1, 1000), help="Repetitions by each voice.")
@click.option("--seed", default=0, show_default=True, help="Equal seeds give equal recordings.")
def speech(words: tuple[str, ...], language: str, out: str, speakers: int, takes: int, seed: int) -> None:
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
            out, {language: table}, speakers, takes, seed, lambda done, total: progress("speaking", done, total)
        )
    click.echo(f"{len(dataset)} synthetic recordings of {len(dataset.labels)} words by {speakers} voices: {out}")


def _split(word: str) -> tuple[str, str]:
    label, equals, text = word.partition("=")
    return (label, text) if equals else (word, word)
