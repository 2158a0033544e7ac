# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk vite``."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray

from hri.cli.htk.options import (
    INPUT,
    References,
    all_arguments,
    config_option,
    label_folder_option,
    label_suffix_option,
    labels_option,
    load_configuration,
    load_models,
    models_option,
    script_option,
    trace_option,
)
from hri.cli.messages import note
from hri.cli.output import OutputFile
from hri.core.errors import FormatError
from hri.core.files import make_folder
from hri.htk import (
    Dictionary,
    Label,
    MasterLabelFile,
    Pronunciation,
    RecognisedSentence,
    Recognizer,
    Transcription,
    WordLattice,
    load_observations,
    read_list,
)
from hri.language import ConnectedDecoderOptions, LatticeOptions

NO_BEAM = 1e12
MOST_SENTENCES = 1000
LATTICE_BEAMS = (1000.0, 4000.0, 16000.0, 64000.0)
"""The next one where sentences are too few."""
UNIT_S = 1e-7
"""Of times in HTK's files."""


class _Command(click.Command):
    """HVite's ``-n I [N]`` takes one number or two."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        given = list(args)
        if "-n" in given:
            at = given.index("-n") + 1
            numbers = given[at : at + 2]
            if len(numbers) == 2 and all(number.isdecimal() for number in numbers):
                given[at : at + 2] = [" ".join(numbers)]
        return super().parse_args(ctx, given)


def _num_sentences(context: click.Context, option: click.Parameter, value: str | None) -> int:
    """N of ``-n I [N]``; 0 without the option."""
    if value is None:
        return 0
    numbers = value.split()
    if len(numbers) not in (1, 2) or not all(number.isdecimal() and len(number) < 6 for number in numbers):
        raise click.BadParameter(f"{value!r} is not 'I [N]': one whole number, or two")
    tokens, sentences = int(numbers[0]), int(numbers[1]) if len(numbers) == 2 else 1
    if tokens < 1 or not 1 <= sentences <= MOST_SENTENCES:
        raise click.BadParameter(f"I must be at least 1, and N lie in 1..{MOST_SENTENCES}")
    return sentences


@click.command(cls=_Command)
@config_option
@models_option
@labels_option
@label_folder_option
@label_suffix_option
@script_option
@trace_option
@click.option("-w", "network", type=INPUT, metavar="SLF", help="The word network.")
@click.option("-a", "align", is_flag=True, help="Align the transcription of each file instead.")
@click.option("-b", "boundary", metavar="WORD", help="With -a: a word before and after each transcription.")
@click.option("-i", "master", type=OutputFile(), metavar="MLF", help="Write all results to one master label file.")
@click.option("-l", "folder", metavar="DIR", help="Folder of the results; '*' in a master label file: any.")
@click.option("-y", "out_suffix", default="rec", show_default=True, help="Suffix of the results.")
@click.option(
    "-n",
    "num_sentences",
    callback=_num_sentences,
    metavar="I [N]",
    help="The N best sentences, 1 where it is left out; exact whatever I is, HVite's tokens a state.",
)
@click.option(
    "-o", "leave_out", default="", metavar="LETTERS", help="Leave out S: scores, T: times. N: scores a frame."
)
@click.option("-p", "penalty", type=float, default=0.0, help="Added to the log score at every word.")
@click.option("-s", "scale", type=float, default=1.0, help="Factor on the log weights of the network.")
@click.option("-t", "beam", type=float, default=0.0, help="Beam; 0: none.")
@click.option(
    "-z", "lattice_suffix", metavar="EXT", help="With -n: write lattices with this suffix beside the results."
)
@click.argument("dictionary", type=INPUT)
@click.argument("model_list", type=INPUT)
@click.argument("files", nargs=-1)
def vite(
    configs: tuple[str, ...],
    macros: tuple[str, ...],
    masters: tuple[str, ...],
    label_folder: str | None,
    suffix: str,
    scripts: tuple[str, ...],
    trace: int,
    network: str | None,
    align: bool,
    boundary: str | None,
    master: str | None,
    folder: str | None,
    out_suffix: str,
    num_sentences: int,
    leave_out: str,
    penalty: float,
    scale: float,
    beam: float,
    lattice_suffix: str | None,
    dictionary: str,
    model_list: str,
    files: tuple[str, ...],
) -> None:
    """Recognise parameter files by a word network, or align their transcriptions, as HVite.

    \b
    Example:
      hri htk vite -H models -w wdnet -S test.scp -i found.mlf dict list
      hri htk vite -H models -w wdnet -n 4 20 -z lat -S test.scp -l lattices dict list
    """
    if align == (network is not None):
        raise click.UsageError("either -w SLF or -a")
    if set(leave_out) - set("STN"):
        raise click.UsageError("-o takes letters of STN")
    if lattice_suffix is not None and (num_sentences == 0 or folder == "*"):
        raise click.UsageError("-z goes with -n, and not with -l '*'")
    configuration = load_configuration(configs)
    models = load_models(macros)
    words = _physical(Dictionary.read(dictionary), read_list(model_list))
    options = ConnectedDecoderOptions(beam=beam or NO_BEAM, language_scale=scale, insertion_penalty=penalty)
    references = References(masters, label_folder, suffix)

    def aligner(name: str) -> Recognizer:
        edge = [] if boundary is None else [boundary]
        said = [label.name for label in references.find(name).labels]
        return Recognizer(models, words, WordLattice.of_words([*edge, *said, *edge]), options)

    recognizer_of: Callable[[str], Recognizer] = aligner
    if network is not None:
        recognizer = Recognizer(models, words, WordLattice.read(network), options)
        recognizer_of = lambda _: recognizer  # noqa: E731
    entries = []
    for name in all_arguments(files, scripts):
        frames, period = load_observations(name, models.kind, configuration)
        path = Path(name).with_suffix(f".{out_suffix}")
        target = path if folder is None else Path(folder, path.name)
        lattice_path = None if lattice_suffix is None else target.with_suffix(f".{lattice_suffix}")
        sentences = _recognised(recognizer_of(name), frames, num_sentences, lattice_path, period)
        if not sentences:
            note(f"{name}: no sentence of the network ends with the recording")
            continue
        sentence = sentences[0]
        first, *others = (_labels(one, period, leave_out) for one in sentences)
        found = Transcription(first, others)
        entries.append((str(target), found))
        if trace:
            said = " ".join(label.name for label in found.labels)
            click.echo(f"File: {name}\n{said}  ==  [{len(frames)} frames] {sentence.log_score / len(frames):.4f}")
        if master is None:
            make_folder(target.parent)
            found.write(target)
    if master is not None:
        make_folder(Path(master).parent)
        MasterLabelFile(entries).write(master)


def _recognised(
    recognizer: Recognizer, frames: NDArray[np.float32], num_sentences: int, lattice_path: Path | None, period: int
) -> list[RecognisedSentence]:
    """The best sentences, one without a number; none where none is complete."""
    if num_sentences == 0:
        sentence = recognizer.recognise(frames)
        return [sentence] if sentence.complete else []
    for beam in LATTICE_BEAMS:
        lattice = recognizer.lattice(frames, LatticeOptions(beam=beam))
        found = recognizer.n_best(lattice, num_sentences)
        if len(found) >= num_sentences:
            break
    if lattice_path is not None and not lattice.empty:
        make_folder(lattice_path.parent)
        WordLattice.of_lattice(lattice, recognizer.words, 0.0, period * UNIT_S).write(lattice_path)
    return found


def _physical(dictionary: Dictionary, names: dict[str, str]) -> Dictionary:
    """The dictionary with physical models for the logical ones of the list."""
    entries = []
    for entry in dictionary.entries:
        for model in entry.models:
            if model not in names:
                raise FormatError(f"the list of models does not have {model!r}, of the word {entry.word!r}")
        entries.append(Pronunciation(entry.word, [names[m] for m in entry.models], entry.output, entry.probability))
    return Dictionary(entries)


def _labels(sentence: RecognisedSentence, period: int, leave_out: str) -> list[Label]:
    labels = []
    for word in sentence.words:
        if not word.output:
            continue
        frames = word.last_frame - word.first_frame
        score = word.log_score / frames if "N" in leave_out else word.log_score
        first, last = word.first_frame * period, word.last_frame * period
        label = Label(
            word.output,
            None if "T" in leave_out else first,
            None if "T" in leave_out else last,
            None if "S" in leave_out else round(score, 6),
        )
        labels.append(label)
    return labels
