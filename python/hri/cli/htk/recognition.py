# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk vite``."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray

from hri.cli.groups import FiniteRange
from hri.cli.htk.data import DataFile, check_headers, data_files, load_frames
from hri.cli.htk.formatting import LabelFormat
from hri.cli.htk.options import (
    ModelFiles,
    References,
    listed_models_options,
    load_configuration,
    models_option,
    recording_options,
)
from hri.cli.htk.standard import (
    ADAPTATION,
    BINARY,
    INPUT,
    HtkCommand,
    NumbersOption,
    is_number,
    only_format,
    refused_options,
)
from hri.cli.htk.vocabulary import Vocabulary, transcripts_of
from hri.cli.messages import note
from hri.cli.output import OutputFile
from hri.core.errors import FormatError, InvalidArgument
from hri.core.files import make_folder
from hri.htk import (
    MasterLabelFile,
    RecognisedSentence,
    Recognizer,
    Transcription,
    WordLattice,
    read_list,
    require_words,
)
from hri.htk.sentences import NULL
from hri.language import ConnectedDecoderOptions, LatticeOptions

NO_BEAM = 1e12
MOST_SENTENCES = 1000
LATTICE_BEAMS = (1000.0, 4000.0, 16000.0, 64000.0)
"""The next one where sentences are too few."""
UNIT_S = 1e-7
"""Of times in HTK's files."""
NOTHING = "there is nothing to recognise"
_NO_AUDIO = "recordings come from files"


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


def _beams(context: click.Context, option: click.Parameter, value: str) -> list[float]:
    """All beams of ``-t F [I L]``, the narrowest first; no beam for 0."""
    parts = value.split()
    if len(parts) not in (1, 3) or not all(map(is_number, parts)):
        raise click.BadParameter("takes one number, or three")
    first, step, limit = (float(part) for part in (*parts, "0", "0")[:3])
    if not (0 <= first < NO_BEAM and 0 <= step < NO_BEAM and 0 <= limit < NO_BEAM):
        raise click.BadParameter("numbers must not be negative")
    beams = [first or NO_BEAM]
    while first and step and beams[-1] + step <= limit and len(beams) < 1000:
        beams.append(beams[-1] + step)
    return beams


@click.command(cls=HtkCommand)
@recording_options
@models_option
@only_format("-P", "results")
@click.option("-w", "network", type=INPUT, metavar="SLF", help="Recognise by this word network.")
@click.option("-a", "align", is_flag=True, help="Align the transcriptions of the recordings.")
@click.option("-b", "boundary", metavar="WORD", help="With -a: the word before and after every transcription.")
@click.option("-c", "mixture_pruning", type=FiniteRange(0), help="Not needed: all Gaussians are summed.")
@listed_models_options
@click.option("-f", "states", is_flag=True, help="A label for every state.")
@click.option("-m", "models", is_flag=True, help="A label for every model.")
@click.option("-i", "master", type=OutputFile(), metavar="MLF", help="Write results to one master label file.")
@click.option("-l", "folder", metavar="DIR", help="Folder of the results; '*': any, in a master label file.")
@click.option("-y", "out_suffix", default="rec", show_default=True, help="Suffix of the results.")
@click.option(
    "-n",
    "num_sentences",
    cls=NumbersOption,
    most=2,
    callback=_num_sentences,
    metavar="I [N]",
    help="The N best sentences, 1 if not said; from a lattice, which makes I, HVite's tokens a state, needless.",
)
@click.option(
    "-o", "letters", default="", metavar="FLAGS", help="N scores a frame; leave out S T W M; X strip contexts."
)
@click.option("-p", "penalty", type=float, default=0.0, help="Added to the log score at every word.")
@click.option("-s", "scale", type=float, default=1.0, help="Factor on the log weights of the network.")
@click.option("-r", "pronunciation_scale", type=FiniteRange(0, 1e6), default=1.0, help="The same for pronunciations.")
@click.option(
    "-t",
    "beams",
    cls=NumbersOption,
    most=3,
    default="0",
    callback=_beams,
    metavar="F [I L]",
    help="Beam; where no sentence is left, again with I more, up to L; 0: none.",
)
@click.option("-u", "max_models", type=click.IntRange(0), help="Not needed: the beam of -t alone drops anything.")
@click.option("-v", "word_beam", type=FiniteRange(0), help="Not needed: the beam of -t alone drops anything.")
@click.option(
    "-q", "lattice_letters", default="tal", metavar="FLAGS", help="What lattices hold: tal, and nothing else."
)
@click.option(
    "-z", "lattice_suffix", metavar="EXT", help="With -n: write lattices with this suffix beside the results."
)
@refused_options(
    e=(_NO_AUDIO, 0),
    g=(_NO_AUDIO, 0),
    h=("there are no transforms of models", 1),
    j=("there are no transforms of models", 1),
    k=("there are no transforms of models", 0),
    **BINARY,
    **ADAPTATION,
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
    mixture_pruning: float | None,
    model_folder: str | None,
    model_suffix: str | None,
    states: bool,
    models: bool,
    master: str | None,
    folder: str | None,
    out_suffix: str,
    num_sentences: int,
    letters: str,
    penalty: float,
    scale: float,
    pronunciation_scale: float,
    beams: list[float],
    max_models: int | None,
    word_beam: float | None,
    lattice_letters: str,
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
      hri htk vite -H models -a -m -o SW -I words.mlf -S train.scp -i phones.mlf dict list
    """
    if align == (network is not None):
        raise click.UsageError("either -w SLF or -a")
    if lattice_suffix is not None and (num_sentences == 0 or folder == "*"):
        raise click.UsageError("-z goes with -n, and not with -l '*'")
    if set(lattice_letters) != set("tal"):
        raise click.UsageError("-q takes tal: lattices have times, acoustic and language scores, and words on nodes")
    form = LabelFormat(letters, models, states)
    configuration = load_configuration(configs)
    recordings = data_files(files, scripts, NOTHING)
    vocabulary = Vocabulary(dictionary, read_list(model_list), model_list, pronunciation_scale)
    sources = ModelFiles(macros)
    if network is not None:
        lattice = WordLattice.read(network)
        require_words(lattice, network, vocabulary.dictionary, dictionary)
        words = [word for word in lattice.words if word != NULL]
        lattice_of: Callable[[DataFile], WordLattice] = lambda _: lattice  # noqa: E731
    else:
        edge = [] if boundary is None else [boundary]
        if boundary is not None and not vocabulary.has(boundary):
            raise FormatError(f"{dictionary}: does not have the word {boundary!r}, of -b")
        references = References(masters, label_folder, suffix)
        said = transcripts_of([file.name for file in recordings], references, vocabulary)
        words = [*edge, *(label.name for labels in said.values() for label in labels)]
        lattice_of = lambda file: WordLattice.of_words(  # noqa: E731
            [*edge, *(label.name for label in said[file.name]), *edge]
        )
    selected = vocabulary.select(words, sources, model_folder, model_suffix)
    period = check_headers(recordings, sources.models, configuration)

    def recognizer_of(file: DataFile, beam: float) -> Recognizer:
        options = ConnectedDecoderOptions(beam=beam, language_scale=scale, insertion_penalty=penalty)
        try:
            return Recognizer(sources.models, selected, lattice_of(file), options)
        except InvalidArgument as error:
            raise FormatError(f"{network or file.name}: {error}") from error

    shared = None if network is None else [recognizer_of(recordings[0], beam) for beam in beams]
    entries = []
    for file in recordings:
        frames = load_frames(file, sources.models, configuration)
        path = Path(file.name).with_suffix(f".{out_suffix}")
        target = path if folder is None else Path(folder, path.name)
        lattice_path = None if lattice_suffix is None else target.with_suffix(f".{lattice_suffix}")
        recognizers = iter(shared) if shared is not None else (recognizer_of(file, beam) for beam in beams)
        recognizer, sentences = _first_found(recognizers, frames, num_sentences, lattice_path, period)
        if not sentences:
            note(f"{file.name}: no sentence of the network ends with the recording")
            continue
        all_labels = []
        for one in sentences:
            aligned = recognizer.align(frames, one) if form.is_aligned else []
            names = [vocabulary.logical(word.pronunciation) for word in one.words]
            all_labels.append(form.labels(one, aligned, names, period))
        first, *others = all_labels
        found = Transcription(first, others)
        entries.append((str(target), found))
        if trace:
            spoken = " ".join(word.output for word in sentences[0].words if word.output)
            score = sentences[0].log_score / len(frames)
            click.echo(f"File: {file.name}\n{spoken}  ==  [{len(frames)} frames] {score:.4f}")
        if master is None:
            make_folder(target.parent)
            found.write(target)
    if master is not None:
        make_folder(Path(master).parent)
        MasterLabelFile(entries).write(master)


def _first_found(
    recognizers: Iterator[Recognizer],
    frames: NDArray[np.float32],
    num_sentences: int,
    lattice_path: Path | None,
    period: int,
) -> tuple[Recognizer, list[RecognisedSentence]]:
    """Sentences by the first of the recognisers, whose beams grow, that finds any; and that one, or the last."""
    for recognizer in recognizers:
        found = _recognised(recognizer, frames, num_sentences, lattice_path, period)
        if found:
            break
    return recognizer, found


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
        weighed = (recognizer.options.language_scale, recognizer.options.insertion_penalty)
        WordLattice.of_lattice(lattice, recognizer.words, 0.0, period * UNIT_S, *weighed).write(lattice_path)
    return found
