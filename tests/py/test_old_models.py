# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Model files that were written by earlier versions load, and give the answers that they gave then, to the bit.

The files, what they are asked (inputs.npz) and what they answered (expected.json) were made by make_models.py: those of
models_v1 at commit 7041db0, the last of format version 1. A format that changes again gets a folder of its own.
Some were written anew since, when they became the same bits on every machine: answers about pictures ("clip/"), when
square roots became exact, and of Gaussian mixtures one log-likelihood, in its ninth digit, when exponentials and
logarithms were no longer those of the C library.
What can no longer be read stands in REFUSED, and is refused by field.
"""

from __future__ import annotations

import json
import zlib
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hri
from hri import _native
from hri.core.errors import FormatError

FOLDERS = sorted(Path(__file__).parent.glob("models_v*"))
FULL_SCALE = 32768
PREFIX = "model."
"""Of the fields in a file that holds a single model and no recogniser."""

# Where the names of today stand: what the kinds of files are called now, and which method answers which question.
RECOGNIZERS: dict[str, Any] = {"word_recognizer": hri.WordRecognizer, "gesture_recognizer": hri.GestureRecognizer}
MODELS: dict[str, Any] = {
    "codebook": _native.Codebook,
    "multi_stream_codebook": _native.MultiStreamCodebook,
    "pca": _native.Pca,
    "lda": _native.Lda,
    "linear_svm": _native.LinearSvm,
    "rbf_classifier": _native.RbfClassifier,
    "gaussian_bayes": _native.GaussianBayes,
    "knn": _native.Knn,
    "distance_classifier": _native.DistanceClassifier,
    "possibility_classifier": _native.PossibilityClassifier,
    "markov_chain": _native.MarkovChain,
    "gaussian_mixture": _native.GaussianMixture,
    "gaussian_mixture_hmm": _native.GaussianMixtureHmm,
    "discrete_hmm": _native.DiscreteHmm,
    "possibilistic_hmm_set": _native.PossibilisticHmmSet,
    "possibilistic_gaussian_hmm_set": _native.PossibilisticGaussianHmmSet,
}
# Of every kind: a method and its arguments, each the name of an input or a number; without arguments, a property.
QUESTIONS: dict[str, list[tuple[Any, ...]]] = {
    "codebook": [("quantise", "rows"), ("distortion", "rows"), ("centroids",)],
    "multi_stream_codebook": [("quantise", "rows"), ("distortion", "rows")],
    "pca": [("transform", "rows"), ("mean",), ("components",), ("variances",)],
    "lda": [("transform", "rows"), ("mean",), ("components",), ("ratios",)],
    "linear_svm": [("decision_values", "rows"), ("weights",), ("biases",)],
    "rbf_classifier": [("decision_values", "rows"), ("num_rows",)],
    "gaussian_bayes": [("decision_values", "rows"), ("log_densities", "rows")],
    "knn": [("decision_values", "rows"), ("nearest_distance", "row")],
    "distance_classifier": [("decision_values", "rows")],
    "possibility_classifier": [("decision_values", "rows"), ("classify", "row")],
    "markov_chain": [("start",), ("transition",)],
    "gaussian_mixture": [("log_likelihood", "rows"), ("weights",), ("means",), ("variances",)],
    "gaussian_mixture_hmm": [
        ("log_likelihood", "rows"),
        ("log_likelihood_exact", "rows"),
        ("viterbi", "rows"),
        ("posterior", "rows"),
        ("weights",),
        ("means",),
        ("variances",),
    ],
    "discrete_hmm": [
        ("log_likelihood", "symbols"),
        ("log_likelihood_exact", "symbols"),
        ("viterbi", "symbols"),
        ("emission",),
    ],
    "possibilistic_hmm_set": [
        ("log_possibilities", "symbols"),
        ("log_possibilities_exact", "symbols"),
        ("classify", "symbols"),
        ("viterbi", 1, "symbols"),
        ("emission", 0),
    ],
    "possibilistic_gaussian_hmm_set": [("log_possibilities", "rows"), ("classify", "rows"), ("viterbi", 1, "rows")],
}


def load(kind: str, path: Path) -> Any:
    """What a file of this kind holds."""
    if kind in RECOGNIZERS:
        return RECOGNIZERS[kind].load(path)
    file = _native.ModelFile.read(str(path))
    assert file.kind == kind
    return MODELS[kind].read(file, PREFIX)


def as_stored(value: Any) -> Any:
    """As JSON holds it, floats with every bit."""
    if isinstance(value, np.ndarray):
        return as_stored(value.tolist())
    if isinstance(value, list | tuple):
        return [as_stored(entry) for entry in value]
    return value.hex() if isinstance(value, float) else value


def told_decision(decision: hri.Decision) -> dict[str, Any]:
    """A decision without its mode."""
    return {
        "label": decision.label,
        "status": decision.status,
        "confidence": decision.confidence.hex(),
        "evidence": decision.score.hex(),
        "nbest": [[entry.label, entry.probability.hex(), entry.log_score.hex()] for entry in decision.nbest],
        "notes": list(decision.notes),
    }


def word_answers(words: hri.WordRecognizer, inputs: dict[str, np.ndarray]) -> dict[str, Any]:
    """To every input that is called word/NAME/RATE."""
    found = {}
    for name, samples in inputs.items():
        if name.startswith("word/"):
            clip = (samples.astype(np.float32) / FULL_SCALE, int(name.rsplit("/", 1)[1]))
            found[name] = told_decision(words.recognise(*clip))
            if found[name]["nbest"]:
                found[name]["scores"] = as_stored(words.scores(*clip))
    return found | {"threshold": words.threshold.hex()}


def gesture_answers(gestures: hri.GestureRecognizer, inputs: dict[str, np.ndarray], name: str) -> dict[str, Any]:
    """To rows of features, called rows/FILE/NAME, and to clips, called clip/NAME, where the file knows silhouettes."""
    found: dict[str, Any] = {"starts_at_rest": gestures.starts_at_rest, "pauses": gestures.pauses}
    for key, array in inputs.items():
        if key.startswith(f"rows/{name}/"):
            found[key] = told_decision(gestures.recognise_features(array))
        elif key.startswith("clip/") and gestures.options.source == "silhouettes":
            rows = gestures.features(list(array))
            found[key] = told_decision(gestures.recognise(list(array))) | {"crc32_of_features": zlib.crc32(rows)}
    return found


def model_answers(kind: str, model: Any, inputs: dict[str, np.ndarray]) -> dict[str, Any]:
    """To the `QUESTIONS` of its kind."""
    found = {}
    for name, *arguments in QUESTIONS[kind]:
        values = [inputs[argument] if isinstance(argument, str) else argument for argument in arguments]
        found[name] = as_stored(getattr(model, name)(*values) if values else getattr(model, name))
    return found


def answers(kind: str, path: Path, inputs: dict[str, np.ndarray]) -> dict[str, Any]:
    """What the file at `path` says now."""
    model = load(kind, path)
    if kind == "word_recognizer":
        return word_answers(model, inputs)
    if kind == "gesture_recognizer":
        return gesture_answers(model, inputs, path.stem)
    return model_answers(kind, model, inputs)


# Names of options in version 1; those of "models" had a group of their own.
RENAMED = {
    "floor_db": "noise_floor_db",
    "num_warps": "num_vtlp_factors",
    "warp_step": "vtlp_step",
    "noise_copies": "num_noisy_copies",
    "noise_low_db": "min_snr_db",
    "noise_high_db": "max_snr_db",
}


@cache
def stored_inputs(folder: Path) -> dict[str, np.ndarray]:
    with np.load(folder / "inputs.npz", allow_pickle=False) as stored:
        return {name: stored[name] for name in stored.files}


@cache
def expected(folder: Path) -> dict[str, Any]:
    return json.loads((folder / "expected.json").read_text(encoding="utf-8"))["files"]


# Models of today need more than these hold; the error names the field.
REFUSED = {("models_v1", "gestures_rbf"): "verifier.weights"}
FILES = [
    (folder, name) for folder in FOLDERS for name in sorted(expected(folder)) if (folder.name, name) not in REFUSED
]
OF_RECOGNIZERS = [(folder, name) for folder, name in FILES if expected(folder)[name]["kind"] in RECOGNIZERS]


def names(entries: list[tuple[Path, str]]) -> list[str]:
    return [f"{folder.name}/{name}" for folder, name in entries]


def with_names_of_today(options: dict[str, Any]) -> dict[str, Any]:
    flat = {**options, **options.get("models", {})}
    if flat["model"] == "path":
        flat["model"] = "trajectory"
    return {RENAMED.get(name, name): value for name, value in flat.items() if name != "models"}


def is_part_of(options: Any, whole: Any) -> bool:
    """Whether every field is there with its value; fields that came later may be there too."""
    if isinstance(options, dict):
        return all(name in whole and is_part_of(value, whole[name]) for name, value in options.items())
    return bool(options == whole)


def test_every_file_is_asked() -> None:
    assert [folder.name for folder in FOLDERS] == ["models_v1", "models_v2"]
    for folder in FOLDERS:
        assert {path.stem for path in folder.glob("*.hri")} == set(expected(folder))
    assert {e["kind"] for e in expected(FOLDERS[0]).values()} == {*RECOGNIZERS, *MODELS}
    kinds = [e["kind"] for e in expected(FOLDERS[1]).values()]
    assert all(kinds.count(kind) >= 3 for kind in RECOGNIZERS)


@pytest.mark.parametrize(
    ("file", "field"), REFUSED.items(), ids=lambda value: "/".join(value) if isinstance(value, tuple) else value
)
def test_what_can_no_longer_be_read_is_refused_by_field(file: tuple[str, str], field: str) -> None:
    path = FOLDERS[0].parent / file[0] / f"{file[1]}.hri"
    with pytest.raises(FormatError, match=field):
        hri.GestureRecognizer.load(path)


@pytest.mark.parametrize(("folder", "name"), FILES, ids=names(FILES))
def test_answers_are_those_of_then(folder: Path, name: str) -> None:
    before = expected(folder)[name]
    now = answers(before["kind"], folder / f"{name}.hri", stored_inputs(folder))
    assert list(now) == list(before["answers"])
    for question, answer in before["answers"].items():
        assert now[question] == answer, question


@pytest.mark.parametrize(("folder", "name"), OF_RECOGNIZERS, ids=names(OF_RECOGNIZERS))
def test_options_are_those_of_then(folder: Path, name: str) -> None:
    before = expected(folder)[name]
    recognizer = load(before["kind"], folder / f"{name}.hri")
    assert list(recognizer.classes_) == before["labels"]
    options = json.loads(json.dumps(recognizer.options.as_dict()))
    assert is_part_of(with_names_of_today(before["options"]), options)


@pytest.mark.parametrize(("folder", "name"), OF_RECOGNIZERS, ids=names(OF_RECOGNIZERS))
def test_saved_anew_they_are_of_todays_format_and_answer_alike(folder: Path, name: str, tmp_path: Path) -> None:
    before = expected(folder)[name]
    load(before["kind"], folder / f"{name}.hri").save(tmp_path / f"{name}.hri")
    assert _native.ModelFile.read(str(tmp_path / f"{name}.hri")).metadata()["format_version"] == "2"
    assert answers(before["kind"], tmp_path / f"{name}.hri", stored_inputs(folder)) == before["answers"]


@pytest.mark.parametrize("kind", RECOGNIZERS)
def test_what_a_newer_version_added_is_refused_by_name(kind: str, tmp_path: Path) -> None:
    folder, name = next(e for e in OF_RECOGNIZERS if e[0] == FOLDERS[-1] and expected(e[0])[e[1]]["kind"] == kind)
    file = _native.ModelFile.read(str(folder / f"{name}.hri"))
    file.set_text("brightness", "high")
    file.write(str(tmp_path / "newer.hri"))
    with pytest.raises(FormatError, match=r"newer\.hri: field 'brightness' is unknown"):
        load(kind, tmp_path / "newer.hri")
