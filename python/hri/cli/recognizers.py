# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Recognisers as the command line names them: their mode, their options, where their models are kept."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click

from hri.cli.in_commands import of_patterns
from hri.cli.messages import note
from hri.cli.output import why_not_writable
from hri.core.errors import FormatError, InvalidArgument
from hri.core.files import parse_toml
from hri.datasets import Dataset
from hri.io import ModelFile
from hri.language import KnowledgeBase
from hri.recognition import GestureRecognizer, SentenceRecognizer, SpeechEmbedding, WordRecognizer

_MOST_NAMED = 10
_CHOSEN = {
    "choose_penalty": ("decoder.insertion_penalty", "confidence_scale", "unknown_lead"),
    "choose_weights": ("decoder.insertion_penalty", "decoder.language_scale", "known_language_scale"),
}
"""By the option that has them chosen in training: of connected words, and of signed sentences."""

CLASSES: dict[str, type[WordRecognizer] | type[GestureRecognizer]] = {
    "speech": WordRecognizer,
    "gesture": GestureRecognizer,
}

mode_argument = click.argument("mode", type=click.Choice(list(CLASSES)))

pattern_option = click.option(
    "--pattern",
    help="How paths under DIR name label, person and take, such as '{label}_{person}_{take}.wav'. Without it, the "
    "folder's dataset.toml is read, or common patterns are tried.",
)


def options_option(kind: str, example: str) -> Callable[[Any], Any]:
    """The option ``--option`` of a command that trains what ``hri options KIND`` lists the options of."""
    return click.option(
        "--option",
        "options",
        multiple=True,
        metavar="NAME=VALUE",
        help=f"An option of the recogniser, such as {example}; may be given several times. 'hri options {kind}' lists "
        "them all.",
    )


embedding_option = click.option(
    "--embedding",
    "embedding_path",
    type=click.Path(exists=True, dir_okay=False),
    metavar="FILE",
    help="Weights of the speech embedding (ONNX), for words of the front ends both and embedding; by default those "
    "that the extra embedding installs.",
)


def load_embedding(path: str | Path | None) -> SpeechEmbedding | None:
    """The embedding of the weights that ``--embedding`` names; None where it names none."""
    return None if path is None else SpeechEmbedding(path)


def with_embedding(options: tuple[str, ...], path: str | None) -> tuple[str, ...]:
    """Options of words; ``--embedding`` asks for the front end both where they name none."""
    named = any(option.startswith("front_end=") for option in options)
    return options if path is None or named else (*options, "front_end=both")


def embedding_for(recognizer: WordRecognizer | GestureRecognizer, path: str | None) -> SpeechEmbedding | None:
    """What training takes: None where the front end has no embedding.

    Raises
    ------
    click.UsageError
        For ``--embedding`` where the options ask for another front end.
    ImportError
        For a front end with an embedding where neither the extra nor ``--embedding`` gives weights: before recordings
        are read.
    """
    if not isinstance(recognizer, WordRecognizer) or recognizer.options.front_end == "cepstra":
        if path is not None:
            raise click.UsageError("--embedding is for words of the front ends both and embedding, not of cepstra")
        return None
    return SpeechEmbedding(path)


def default_model(mode: str) -> Path:
    """Where ``hri train`` puts a model, and ``hri recognise`` looks for it, by default."""
    from platformdirs import user_data_path

    return user_data_path("hri") / f"{mode}.hri"


def model_to_write(mode: str, out: str | None) -> Path:
    """The file that a command which trains writes: `out`, or the one kept per user.

    Raises
    ------
    click.UsageError
        Where that cannot be written, as is said of `out` when it is parsed: before the work begins.
    """
    if out is not None:
        return Path(out)
    path = default_model(mode)
    fault = why_not_writable(path)
    if fault is not None:
        raise click.UsageError(f"'{path}', where models are kept, cannot be written: {fault}; name a file with --out")
    return path


def kept_model(mode: str) -> Path:
    """The model kept per user. Raises InvalidArgument that says how to make it when there is none."""
    path = default_model(mode)
    if not path.is_file():
        raise InvalidArgument(f"there is no {mode} model yet: run 'hri train {mode} --data DIR', or name a model file")
    return path


def load_signs(path: Path) -> GestureRecognizer | SentenceRecognizer:
    """A recogniser of single gestures, or of signed sentences, as the file says.

    Raises
    ------
    FormatError
        For a file that holds neither.
    InvalidArgument
        For one of sentences that were given as rows of features.
    """
    try:
        of_sentences = ModelFile.read(str(path)).kind == "sentence_recognizer"
    except FormatError:
        of_sentences = False  # GestureRecognizer.load says what is wrong
    if not of_sentences:
        return GestureRecognizer.load(path)
    signs = SentenceRecognizer.load(path)
    if signs.options.input == "rows":
        raise InvalidArgument(
            f"{path} was trained on rows of features, and does not say which: Session and SignWatcher in Python take it"
        )
    return signs


def warn_of_stored(stored: KnowledgeBase, recognizers: Iterable[Any], path: str | Path) -> None:
    """Warn of words of stored sentences that nothing recognises."""
    labels = {str(label) for one in recognizers if one is not None for label in one.classes_}
    unknown = stored.unknown_words(labels)
    if unknown:
        named = [word if other is None else f"{word} (there is {other})" for word, other in unknown.items()]
        more = f" and {len(named) - _MOST_NAMED} more" if len(named) > _MOST_NAMED else ""
        note(f"WARNING: {path}: words that no recogniser knows: {', '.join(named[:_MOST_NAMED])}{more}")


def load_dataset(directory: str, mode: str, pattern: str | None, option: str | None = "--pattern") -> Dataset:
    """`Dataset.load`; recordings that do not fit the pattern are reported on standard error.

    Parameters
    ----------
    directory, mode, pattern
        As of `Dataset.load`.
    option : str or None
        By which the pattern is given; None: the command has none.
    """
    try:
        dataset = Dataset.load(directory, mode, pattern)
    except FormatError as error:
        raise FormatError(of_patterns(str(error), option)) from error
    for sample in dataset:
        fault = fault_of_label(sample.label)
        if fault is not None:
            raise InvalidArgument(f"{sample.path}: its label {fault}")
    if dataset.ignored:
        example = dataset.ignored[0].relative_to(dataset.root)
        do = "recording does" if len(dataset.ignored) == 1 else "recordings do"
        note(f"{len(dataset.ignored)} {do} not fit the pattern, such as {example}")
    return dataset


def recognizer_factory(
    mode: str, options: tuple[str, ...], seed: int
) -> Callable[[], WordRecognizer | GestureRecognizer]:
    """Makes untrained recognisers; NAME=VALUE options are checked here and now, and go before the seed."""
    fields = parse_options((f"seed={seed}", *options))
    recognizer_class = CLASSES[mode]

    def make() -> WordRecognizer | GestureRecognizer:
        return recognizer_class(**fields)

    try:
        make()
    except (TypeError, ValueError) as error:  # an unknown name, or a value of another type
        raise InvalidArgument(f"--option: {error}") from error
    return make


def fault_of_label(label: str) -> str | None:
    """Why lines of a table, cells between tabs, cannot name this label; None where they can."""
    if any(unicodedata.category(character) in ("Cc", "Zl", "Zp") for character in label):
        return f"{label!r} has characters that break lines and columns"
    return None if label.strip() else f"{label!r} is blank"


@contextmanager
def naming_options() -> Iterator[None]:
    """An unknown name, or a value of another type, is said to come from --option."""
    try:
        yield
    except (TypeError, ValueError) as error:
        raise InvalidArgument(f"--option: {error}") from error


def parse_options(options: tuple[str, ...]) -> dict[str, Any]:
    """NAME=VALUE texts as nested keywords: "cepstra.num_filters=30" is {"cepstra": {"num_filters": 30}}.

    Values are TOML values; what is none is taken as text.

    Raises
    ------
    InvalidArgument
        For text without "=", or a name that is both an option and a group of options.
    """
    fields: dict[str, Any] = {}
    for option in options:
        name, equals, text = option.partition("=")
        if not equals or not name:
            raise InvalidArgument(f"--option {option!r} is not NAME=VALUE")
        *groups, last = name.split(".")
        place = fields
        for group in groups:
            place = place.setdefault(group, {})
            if not isinstance(place, dict):
                raise InvalidArgument(f"--option {name}: {group} has a value already")
        place[last] = _value(text)
    return fields


def refuse_chosen(fields: dict[str, Any], switch: str) -> None:
    """Refuse options that training chooses unless the option `switch` is false.

    Raises
    ------
    click.UsageError
        Names the option, and how to keep what it was given.
    """
    if not fields.get(switch, True):
        return
    for name in _CHOSEN[switch]:
        value: Any = fields
        for part in name.split("."):
            value = value.get(part) if isinstance(value, dict) else None
        if value is not None:
            raise click.UsageError(f"--option {name} is chosen in training: with --option {switch}=false yours stays")


def _value(text: str) -> Any:
    if text in ("True", "False"):  # as Python prints them
        return text == "True"
    try:
        return parse_toml(f"value = {text}", "value")["value"]
    except (FormatError, KeyError):
        return text
