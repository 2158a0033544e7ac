# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri info``."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.util import find_spec
from platform import python_version
from typing import Any

import click

from hri import __version__, vision
from hri.cli.groups import CheckedCommand, refuse_given
from hri.cli.messages import note
from hri.cli.options import KINDS
from hri.cli.output import json_option, say, write_json
from hri.cli.recognizers import default_model, embedding_option, load_embedding
from hri.core.errors import Error
from hri.io import ModelFile
from hri.media import natural_key
from hri.recognition import (
    ConnectedWordRecognizer,
    GestureRecognizer,
    SentenceRecognizer,
    SpeechEmbedding,
    WordRecognizer,
    load,
)

_OF_SINGLE = ("word_recognizer", "subword_recognizer", "gesture_recognizer")
_OF_SEVERAL = {"connected_word_recognizer": "connected", "sentence_recognizer": "sentences"}
EXTRAS = {
    "audio": ("soundfile",),
    "cli": ("click", "rich", "platformdirs"),
    "embedding": ("livekit.wakeword",),
    "live": ("sounddevice",),
    "mcap": ("mcap", "mcap_ros2"),
    "mediapipe": ("mediapipe",),
    "nao": ("qi",),
    "plots": ("matplotlib",),
    "robot": ("pybullet",),
    "studies": ("pyroomacoustics", "audiotsm"),
    "video": ("cv2",),
    "web": ("starlette", "uvicorn", "websockets"),
}


@click.command(cls=CheckedCommand)
@click.argument("model", required=False, type=click.Path(exists=True, dir_okay=False))
@embedding_option
@json_option
def info(model: str | None, embedding_path: str | None, json_path: str | None) -> None:
    """Show what is installed; with MODEL, what that model file holds.

    \b
    Examples:
      hri info
      hri info digits.hri
    """
    if model is None:
        refuse_given(("embedding_path",), "goes with MODEL")
    found = _installation() if model is None else _model(model, embedding_path)
    for line in _lines(found):
        say(line, json_path)
    write_json(json_path, found)


def _installation() -> dict[str, Any]:
    return {
        "version": __version__,
        "python": python_version(),
        "native": {"core": True, "vision": _has_vision()},
        "extras": {name: all(map(_is_there, modules)) for name, modules in EXTRAS.items()},
        "models": {mode: str(default_model(mode)) for mode in KINDS if default_model(mode).is_file()},
    }


def _is_there(module: str) -> bool:
    try:
        return find_spec(module) is not None
    except ModuleNotFoundError:  # of the package around it
        return False


def _has_vision() -> bool:
    try:
        return vision.HandFinder is not None
    except ImportError:
        return False


def _model(path: str, embedding_path: str | None) -> dict[str, Any]:
    file = _read(path)
    if file is not None and file.kind not in _OF_SINGLE:
        if file.kind != "connected_word_recognizer":
            refuse_given(("embedding_path",), "is for models of words")
        if file.kind not in _OF_SEVERAL:
            return {"kind": file.kind, "metadata": dict(file.metadata())}
    kind = None if file is None else _OF_SEVERAL.get(file.kind)
    recognizer = _load(path, kind, load_embedding(embedding_path))
    labels = sorted((str(label) for label in recognizer.classes_), key=natural_key)
    found: dict[str, Any] = {"mode": kind or recognizer.mode, "labels": labels}
    if isinstance(recognizer, WordRecognizer | GestureRecognizer) and recognizer.held_out is not None:
        found["held_out"] = {**recognizer.held_out.to_dict(), "labels": list(recognizer.held_out.labels)}
    if isinstance(recognizer, ConnectedWordRecognizer):
        found |= _sentences(recognizer)
    if kind is None:
        found["is_calibrated"] = recognizer.is_calibrated
        if not recognizer.is_calibrated:
            note(
                "no rejection: training could hold nothing out; record every label at least twice, best by two persons"
            )
    trained = recognizer.trained_options if isinstance(recognizer, SentenceRecognizer) else recognizer.options
    return {**found, "options": trained.as_dict()}


def _load(path: str, kind: str | None, embedding: SpeechEmbedding | None) -> Any:
    """The recogniser in a file: of single words or gestures where `kind` is None."""
    if kind is None:
        return load(path, embedding=embedding)
    if kind == "connected":
        return ConnectedWordRecognizer.load(path, embedding=embedding)
    return KINDS[kind].load(path)


def _sentences(recognizer: ConnectedWordRecognizer) -> dict[str, Any]:
    """The language model or the grammar that a model of connected words holds."""
    language, grammar = recognizer.language, recognizer.grammar
    if language is not None:
        numbers = [language.num_ngrams(order) for order in range(1, language.order + 1)]
        return {"language": {"order": language.order, "ngrams": numbers, "scale": recognizer.language_scale}}
    if grammar is not None:
        nodes = len(grammar.network([str(label) for label in recognizer.classes_]).models)
        return {"grammar": {"words": grammar.words, "nodes": nodes}}
    return {}


def _read(path: str) -> ModelFile | None:
    """None for what is no model: `load` says what is wrong with it."""
    try:
        return ModelFile.read(path)
    except Error:
        return None


def _lines(found: dict[str, Any]) -> list[str]:
    """Tab-separated; the options of a model as ``--option`` takes them."""
    lines = []
    for key, entry in found.items():
        if key == "options":
            lines += [f"option\t{name}={_text(value)}" for name, value in _flat(entry)]
        elif key == "extras":
            hints = {name: "yes" if there else f"no: pip install libhri[{name}]" for name, there in entry.items()}
            lines += [f"extra {name}\t{hint}" for name, hint in hints.items()]
        elif key == "held_out":
            lines += [f"{key} {name}\t{_share(value)}" for name, value in entry.items() if not isinstance(value, list)]
            pairs = entry["confused_pairs"]
            lines += [f"{key} confused\t{pair['first']} {pair['second']} {_share(pair['rate'])}" for pair in pairs]
            since = [label for label in found["labels"] if label not in entry["labels"]]
            if since:
                lines.append(f"{key} is of training, without what was added since\t{' '.join(since)}")
        elif isinstance(entry, dict):
            texts = {name: _joined(value) if isinstance(value, list) else _text(value) for name, value in entry.items()}
            lines += [f"{key} {name}\t{text}" for name, text in texts.items()]
        else:
            lines.append(f"{key}\t{_joined(entry) if isinstance(entry, list) else _text(entry)}")
    return lines


def _joined(values: list[Any]) -> str:
    return " ".join(map(str, values))


def _flat(options: dict[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    for name, value in options.items():
        if isinstance(value, dict):
            yield from _flat(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", value


def _share(value: Any) -> str:
    if value is None:
        return "not measured"
    return f"{100 * value:.1f} %" if isinstance(value, float) else str(value)


def _text(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
