# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk parse``, ``hri htk sgen`` and ``hri htk build``: networks of words."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import click
import numpy as np

from hri.cli.htk.options import files_to_read, labelled_entries, load_configuration
from hri.cli.htk.standard import INPUT, HtkCommand, refused_options, standard_options
from hri.cli.output import OutputFile
from hri.core.display import count
from hri.core.errors import FormatError, InvalidArgument
from hri.core.files import make_folder, read_text
from hri.htk import (
    Dictionary,
    MasterLabelFile,
    Pronunciation,
    Transcription,
    WordLattice,
    draw_sentence,
    network_statistics,
    read_list,
    require_words,
)
from hri.htk.sentences import NULL
from hri.language import NGramModel, NGramOptions

HTK_ENDS = ("!ENTER", "!EXIT")
ARPA_ENDS = ("<s>", "</s>")
UNKNOWN = "<unk>"


@click.command(cls=HtkCommand)
@standard_options("ACDTV")
@click.option(
    "-d",
    "dictionary",
    type=OutputFile(),
    metavar="DICT",
    help="Also write a dictionary: every word, a model of its name.",
)
@click.option("-l", "weighted", is_flag=True, help="Log probabilities on arcs: those out of a node share 1.")
@refused_options(b=("networks are written as text", 0), c=("networks of HTK 1 are not read", 0))
@click.argument("grammar", type=INPUT)
@click.argument("lattice", type=OutputFile())
def parse(
    configs: tuple[str, ...], trace: int, dictionary: str | None, weighted: bool, grammar: str, lattice: str
) -> None:
    """Compile a grammar to a word network, as HParse.

    \b
    Example:
      hri htk parse grammar wdnet
    """
    load_configuration(configs)
    network = WordLattice.read_grammar(grammar)
    if weighted:
        network = _with_equal_weights(network)
    if dictionary is not None:
        words = dict.fromkeys(word for word in network.words if word != NULL)
        Dictionary([Pronunciation(word, [word]) for word in words]).write(dictionary)
    network.write(lattice)
    if trace:
        click.echo(f"{grammar}: {count(len(network.words), 'node')}, {count(len(network.arcs), 'arc')} -> {lattice}")


def _with_equal_weights(network: WordLattice) -> WordLattice:
    counts = np.bincount([start for start, _, _ in network.arcs], minlength=len(network.words))
    return WordLattice(network.words, [(start, end, -float(np.log(counts[start]))) for start, end, _ in network.arcs])


@click.command(cls=HtkCommand)
@standard_options("ACDTV")
@click.option("-n", "count", type=click.IntRange(1), default=100, show_default=True, help="How many sentences.")
@click.option("-l", "numbered", is_flag=True, help="Number them.")
@click.option("-q", "quiet", is_flag=True, help="Print no sentences.")
@click.option("-s", "statistics", is_flag=True, help="Print what the sentences say of the grammar.")
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Of what is drawn.")
@click.argument("lattice", type=INPUT)
@click.argument("dictionary", type=INPUT)
def sgen(
    configs: tuple[str, ...],
    trace: int,
    count: int,
    numbered: bool,
    quiet: bool,
    statistics: bool,
    seed: int,
    lattice: str,
    dictionary: str,
) -> None:
    """Print random sentences of a word network, as HSGen.

    \b
    Example:
      hri htk sgen -n 5 wdnet dict
    """
    load_configuration(configs)
    network = WordLattice.read(lattice)
    require_words(network, lattice, Dictionary.read(dictionary), dictionary)
    rng = np.random.default_rng(seed)
    sentences = []
    for number in range(1, count + 1):
        sentences.append(draw_sentence(network, rng))
        if not quiet:
            text = " ".join(sentences[-1].words)
            click.echo(f"{number}. {text}" if numbered else text)
    if statistics:
        for line in network_statistics(network, sentences):
            click.echo(line)


@click.command(cls=HtkCommand)
@standard_options("ACDTV")
@click.option(
    "-n", "arpa", type=INPUT, metavar="ARPA", help="A language model of order 1 or 2; without it, a loop of words."
)
@click.option(
    "-I", "masters", multiple=True, type=INPUT, metavar="MLF", help="Train the model on these transcriptions."
)
@click.option(
    "-S", "scripts", multiple=True, type=INPUT, metavar="SCRIPT", help="Train it on the label files named here."
)
@click.option(
    "--smoothing",
    type=click.Choice(["witten_bell", "kneser_ney"]),
    default="witten_bell",
    show_default=True,
    help="Of a model that is trained.",
)
@click.option("--arpa", "save", type=OutputFile(), metavar="ARPA", help="Also write the model that was trained.")
@click.option(
    "-s",
    "markers",
    nargs=2,
    metavar="START END",
    help="The model's words for the ends of sentences.  [default: !ENTER !EXIT, or <s> </s>]",
)
@click.option("-t", "brackets", nargs=2, metavar="FIRST LAST", help="Words that stand before and after the loop.")
@click.option("-u", "unknown", metavar="WORD", help="<unk>: what words that the model does not know count as.")
@refused_options(
    z=("-u says what unknown words count as", 0),
    m=("matrices of bigrams are not read; -n takes ARPA files", 1),
    w=("pairs of words are not read", 1),
    x=("lattices in lattices are not read", 1),
    b=("networks are written as text", 0),
)
@click.argument("word_list", type=INPUT)
@click.argument("lattice", type=OutputFile())
def build(
    configs: tuple[str, ...],
    trace: int,
    arpa: str | None,
    masters: tuple[str, ...],
    scripts: tuple[str, ...],
    smoothing: Literal["witten_bell", "kneser_ney"],
    save: str | None,
    markers: tuple[str, str] | None,
    brackets: tuple[str, str] | None,
    unknown: str | None,
    word_list: str,
    lattice: str,
) -> None:
    """Make a word network of a bigram, or a loop of the words in a list, as HBuild; HLStats' bigram with -I or -S.

    Where WORD_LIST has the words for the ends of sentences, they are words of the network, which the dictionary may
    pronounce as silence; else nothing is said there.

    \b
    Example:
      hri htk build -n bigram.arpa words wdnet
      hri htk build -I words.mlf words wdnet
      hri htk build words loopnet
    """
    load_configuration(configs)
    if unknown not in (None, UNKNOWN):
        raise click.UsageError(f"-u {unknown} is not supported: language models have {UNKNOWN} for unknown words")
    sentences = _sentences(masters, scripts)
    if arpa is not None and sentences is not None:
        raise click.UsageError("either -n or transcriptions to train on")
    if save is not None and sentences is None:
        raise click.UsageError("--arpa goes with -I or -S")
    words = list(read_list(word_list))
    if arpa is None and sentences is None:
        network = _loop(words, brackets)
    else:
        if brackets is not None:
            raise click.UsageError("-t goes with a loop, not with a language model")
        language = _language(arpa, sentences, smoothing, words, word_list, markers or HTK_ENDS)
        if save is not None:
            make_folder(Path(save).parent)
            language.save(save)
        network = _bigram(language, words, markers, unknown, arpa or word_list)
    network.write(lattice)
    if trace:
        click.echo(f"{word_list}: {count(len(words), 'word')}, {count(len(network.arcs), 'arc')} -> {lattice}")


def _sentences(masters: tuple[str, ...], scripts: tuple[str, ...]) -> list[list[str]] | None:
    """Words of all transcriptions; None where none were named."""
    if not masters and not scripts:
        return None
    found = [one for path in masters for _, one in labelled_entries(MasterLabelFile.read(path), path)]
    found += [Transcription.read(path) for path in files_to_read((), scripts)]
    return [[label.name for label in one.labels] for one in found]


def _language(
    arpa: str | None,
    sentences: list[list[str]] | None,
    smoothing: Literal["witten_bell", "kneser_ney"],
    words: list[str],
    word_list: str,
    ends: tuple[str, str],
) -> NGramModel:
    if sentences is None:
        assert arpa is not None
        return NGramModel.parse(_with_arpa_ends(read_text(arpa), ends), arpa)
    known = set(words)
    for sentence in sentences:
        for word in sentence:
            if word not in known and word not in ends:
                raise FormatError(f"{word_list}: does not have {word!r}, a word of the transcriptions")
    inner = [[word for word in sentence if word not in ends] for sentence in sentences]
    vocabulary = [word for word in words if word not in ends]
    return NGramModel.train(inner, NGramOptions(order=2, smoothing=smoothing), vocabulary)


def _with_arpa_ends(text: str, ends: tuple[str, str]) -> str:
    """A language model with <s> and </s>, where it has only other words for the ends, as HLStats writes it."""
    lines = text.split("\n")
    rows = [line.split() for line in lines]
    if any(len(row) > 1 and row[1] in ARPA_ENDS for row in rows):
        return text
    renamed = dict(zip(ends, ARPA_ENDS, strict=True))
    return "\n".join(
        " ".join([row[0], *(renamed.get(word, word) for word in row[1:])])
        if len(row) > 1 and row[0] != "ngram"
        else line
        for line, row in zip(lines, rows, strict=True)
    )


def _bigram(
    language: NGramModel, words: list[str], markers: tuple[str, str] | None, unknown: str | None, source: str
) -> WordLattice:
    known = set(language.words)
    said = markers or HTK_ENDS
    ends = said if set(said) <= known else ARPA_ENDS
    inner = [word for word in words if word not in (*said, *ends)]
    for word in (*ends, *inner):
        if word not in known and (unknown is None or unknown not in known):
            raise FormatError(f"{source}: the language model does not know {word!r}")
    try:
        network = WordLattice.of_bigram(language, inner, *ends)
    except InvalidArgument as error:
        raise FormatError(f"{source}: {error}") from error
    nodes = network.words
    for node, word in zip((0, -1), said, strict=True):
        if word in words:
            nodes[node] = word
    return WordLattice(nodes, network.arcs)


def _loop(words: list[str], brackets: tuple[str, str] | None) -> WordLattice:
    """Any number of the words, one at least."""
    before, after = brackets or (NULL, NULL)
    nodes = [before, NULL, *words, NULL, after]
    last = len(nodes) - 1
    arcs = [(0, 1, 0.0), (last - 1, 1, 0.0), (last - 1, last, 0.0)]
    for node in range(2, last - 1):
        arcs += [(1, node, -float(np.log(len(words)))), (node, last - 1, 0.0)]
    return WordLattice(nodes, arcs)
