# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk vite``."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import click

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
from hri.language import ConnectedDecoderOptions

NO_BEAM = 1e12


@click.command()
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
    "-o", "leave_out", default="", metavar="LETTERS", help="Leave out S: scores, T: times. N: scores a frame."
)
@click.option("-p", "penalty", type=float, default=0.0, help="Added to the log score at every word.")
@click.option("-s", "scale", type=float, default=1.0, help="Factor on the log weights of the network.")
@click.option("-t", "beam", type=float, default=0.0, help="Beam; 0: none.")
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
    leave_out: str,
    penalty: float,
    scale: float,
    beam: float,
    dictionary: str,
    model_list: str,
    files: tuple[str, ...],
) -> None:
    """Recognise parameter files by a word network, or align their transcriptions, as HVite.

    \b
    Example:
      hri htk vite -H models -w wdnet -S test.scp -i found.mlf dict list
    """
    if align == (network is not None):
        raise click.UsageError("either -w SLF or -a")
    if set(leave_out) - set("STN"):
        raise click.UsageError("-o takes letters of STN")
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
        sentence = recognizer_of(name).recognise(frames)
        if not sentence.complete:
            note(f"{name}: no sentence of the network ends with the recording")
            continue
        path = Path(name).with_suffix(f".{out_suffix}")
        target = path if folder is None else Path(folder, path.name)
        found = Transcription(_labels(sentence, period, leave_out))
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
