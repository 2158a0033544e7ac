# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk vite``."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial

import click

from hri.cli.groups import FiniteRange, is_given, refuse_given
from hri.cli.htk.data import DataFile, check_headers, data_files, load_frames
from hri.cli.htk.decoding import ResultFiles, SentenceFinder
from hri.cli.htk.formatting import LabelFormat
from hri.cli.htk.live import BUFFER_S, LiveRecognition
from hri.cli.htk.options import (
    ModelFiles,
    References,
    all_arguments,
    listed_models_options,
    load_configuration,
    models_option,
    recording_options,
    stacked,
)
from hri.cli.htk.standard import (
    ADAPTATION,
    BINARY,
    INPUT,
    HtkCommand,
    NumbersOption,
    given_format,
    is_number,
    only_format,
    refused_options,
)
from hri.cli.htk.vocabulary import Vocabulary, transcripts_of
from hri.cli.live_screen import device_option, microphone, recording, stall_option
from hri.cli.messages import note
from hri.cli.output import OutputFile
from hri.core.errors import FormatError, InvalidArgument
from hri.htk import Recognizer, WordLattice, read_list, require_words
from hri.htk.sentences import NULL
from hri.language import ConnectedDecoderOptions
from hri.live import AudioSource

NO_BEAM = 1e12
MOST_SENTENCES = 1000
NOTHING = "there is nothing to recognise: name recordings, or add --live for the microphone"
live_options = stacked(
    click.option(
        "--live", is_flag=True, help="Recognise live sound: of the microphone, or of FILES that are played as a stream."
    ),
    device_option,
    stall_option,
    click.option("--paced", is_flag=True, help="With --live: play recordings as fast as they were spoken."),
    click.option("--json-lines", "as_json", is_flag=True, help="With --live: a line of JSON for every event."),
    click.option("-e", "saves", is_flag=True, help="With --live: write a label file for every utterance."),
)


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
@live_options
@refused_options(
    g=("utterances are not played again", 0),
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
    live: bool,
    device: str | None,
    stall_s: float,
    paced: bool,
    as_json: bool,
    saves: bool,
    dictionary: str,
    model_list: str,
    files: tuple[str, ...],
) -> None:
    """Recognise parameter files by a word network, or align their transcriptions, as HVite.

    With --live, utterances are cut at silence, coded as TARGETKIND says, and recognised until Ctrl-C.

    \b
    Examples:
      hri htk vite -H models -w wdnet -S test.scp -i found.mlf dict list
      hri htk vite -H models -w wdnet -n 4 20 -z lat -S test.scp -l lattices dict list
      hri htk vite -H models -a -m -o SW -I words.mlf -S train.scp -i phones.mlf dict list
      hri htk vite --live -C config -H models -w wdnet dict list
    """
    if live and (align or network is None):
        raise click.UsageError("--live takes -w SLF: live sound is recognised, not aligned")
    if align == (network is not None):
        raise click.UsageError("either -w SLF or -a")
    if lattice_suffix is not None and (num_sentences == 0 or folder == "*"):
        raise click.UsageError("-z goes with -n, and not with -l '*'")
    if set(lattice_letters) != set("tal"):
        raise click.UsageError("-q takes tal: lattices have times, acoustic and language scores, and words on nodes")
    form = LabelFormat(letters, models, states)
    played = all_arguments(files, scripts) if live else []
    _check_source(live, played)
    configuration = load_configuration(configs, live)
    recordings = [] if live else data_files(files, scripts, NOTHING)
    vocabulary = Vocabulary(dictionary, read_list(model_list), model_list, pronunciation_scale)
    sources = ModelFiles(macros)
    if network is not None:
        lattice = WordLattice.read(network)
        require_words(lattice, network, vocabulary.dictionary, dictionary)
        words = [word for word in lattice.words if word != NULL]
    else:
        edge = [] if boundary is None else [boundary]
        if boundary is not None and not vocabulary.has(boundary):
            raise FormatError(f"{dictionary}: does not have the word {boundary!r}, of -b")
        references = References(masters, label_folder, suffix)
        said = transcripts_of([file.name for file in recordings], references, vocabulary)
        words = [*edge, *(label.name for labels in said.values() for label in labels)]
    selected = vocabulary.select(words, sources, model_folder, model_suffix)

    def recognizers_by(lattice: WordLattice, name: str) -> Iterator[Recognizer]:
        for beam in beams:
            options = ConnectedDecoderOptions(beam=beam, language_scale=scale, insertion_penalty=penalty)
            try:
                yield Recognizer(sources.models, selected, lattice, options)
            except InvalidArgument as error:
                raise FormatError(f"{name}: {error}") from error

    finder = SentenceFinder(vocabulary, form, num_sentences)
    results = ResultFiles(folder, out_suffix, master, lattice_suffix)
    if live and network is not None:
        find = partial(finder.find, list(recognizers_by(lattice, network)))
        recognition = LiveRecognition(sources.models, configuration, find, results, saves or master is not None)
        if not played:
            recognition.require_rate()
        recognition.run(_streams(played, paced, device, stall_s), as_json, with_labels=trace > 0)
        return
    results.require_apart(recordings)
    period = check_headers(recordings, sources.models, configuration)
    recognizers_of: Callable[[DataFile], Iterable[Recognizer]]
    if network is not None:
        shared = list(recognizers_by(lattice, network))
        recognizers_of = lambda _: shared  # noqa: E731
    else:
        recognizers_of = lambda file: recognizers_by(  # noqa: E731
            WordLattice.of_words([*edge, *(label.name for label in said[file.name]), *edge]), file.name
        )
    for file in recordings:
        frames = load_frames(file, sources.models, configuration)
        found = finder.find(recognizers_of(file), frames, period, results.lattice_path(file.name))
        if found is None:
            note(f"{file.name}: no sentence of the network ends with the recording")
            continue
        if trace:
            click.echo(f"File: {file.name}\n{found.line}")
        results.add(file.name, found.transcription)
    results.finish()


def _check_source(live: bool, played: Sequence[str]) -> None:
    """Refuse options that would have no effect."""
    if not live:
        refuse_given(("device", "stall_s", "paced", "as_json", "saves"), "goes with --live")
        return
    if given_format() is not None:
        raise click.UsageError("-F is of recordings that are read, and --live takes sound")
    if played:
        refuse_given(("device", "stall_s"), "is of a microphone, and FILES take its place")
    else:
        refuse_given(("paced",), "is of recordings: name FILES")
    if not is_given("saves", "master", "lattice_suffix"):
        refuse_given(("folder", "out_suffix"), "is of files, which with --live -e, -i and -z write")
    if not is_given("saves", "master", "trace", "as_json"):
        refuse_given(
            ("models", "states", "letters"), "is of labels, which with --live -T 1, -e, -i and --json-lines show"
        )


def _streams(played: Sequence[str], paced: bool, device: str | None, stall_s: float) -> Iterator[AudioSource]:
    """Recordings, each opened when its turn comes; without any the microphone."""
    for path in played:
        yield recording(path, paced)
    if not played:
        yield microphone(device, stall_s, BUFFER_S)
