# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Make a folder of small model files of today's format, and what they answer: python make_models.py FOLDER [NAME ...].

models_v1 was made so before options were listed in one place, with the names of then; models_v2 holds three files of
each kind of recogniser. Files that are in the tree stay as they are. No person was recorded or filmed: words are
gliding tones, hands are drawn discs and bars, rows are random, all from fixed seeds. What the files are asked
is written down in test_old_models.py.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator, Sequence
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import hri
from hri import _native
from hri.recognition import FillerWord
from hri.vision.landmarks import landmark_features
from test_old_models import FULL_SCALE, PREFIX, RECOGNIZERS, answers, load

RATE_HZ = 8000
SIDE_PX = 96
NUM_PERSONS = 3
WORDS = {"fall": (-500.0, 0.0), "rise": (700.0, 0.0), "wave": (0.0, 180.0)}
OTHER_WORDS = {f"other{i}": (150.0 * i - 300.0, 60.0 * (i % 3)) for i in range(5)}
SHAPES = {"flat": (0.3, 0.05), "round": (0.17, 0.17), "tall": (0.05, 0.3)}
MOVEMENTS = {"down": (0.0, 0.3), "left": (-0.4, 0.0), "right": (0.4, 0.0)}
FANS = {"down": 0.7, "left": 0.9, "right": 1.1}

Rows = NDArray[np.float32]
Arrays = dict[str, NDArray[Any]]


def word(glide: tuple[float, float], person: int, take: int, rate_hz: int = RATE_HZ) -> NDArray[np.int16]:
    """A tone and an overtone between pauses: its slope in Hz/s, and the Hz by which it swings four times a second."""
    rng = np.random.default_rng([person, take, *(round(abs(g)) for g in glide)])
    length_s, slope, swing = rng.uniform(0.35, 0.55), glide[0] * rng.uniform(0.4, 1.4), glide[1] * rng.uniform(0.4, 1.2)
    time_s = np.arange(round(length_s * rate_hz)) / rate_hz
    pitch = rng.uniform(500.0, 750.0) + slope * (time_s - length_s / 2) + swing * np.sin(8 * np.pi * time_s)
    phase = 2 * np.pi * np.cumsum(pitch) / rate_hz
    tone = (0.3 * np.sin(phase) + 0.1 * np.sin(3 * phase)) * np.hanning(len(time_s)) ** 0.3
    pause = np.zeros(round(0.12 * rate_hz))
    clip = np.concatenate([pause, tone, pause])
    return np.round(FULL_SCALE * (clip + 0.005 * rng.standard_normal(len(clip)))).astype(np.int16)


def hand(shape: str, x: float, y: float, rng: np.random.Generator, odd: float = 0.0) -> NDArray[np.uint8]:
    """A disc and a bar before a wall, a pattern that packs well as noise; sizes vary by the share `odd`."""
    v, u = np.mgrid[:SIDE_PX, :SIDE_PX] / SIDE_PX
    wide, high = np.array(SHAPES[shape]) * rng.uniform(1 - odd, 1 + odd, 2) + rng.uniform(0, 0.2 * odd, 2)
    frame = np.full((SIDE_PX, SIDE_PX, 3), 120)
    bar = (abs(u - x) < wide) & (abs(v - y) < high)
    frame[bar | ((u - x) ** 2 + (v - y) ** 2 < 0.11**2)] = (110, 150, 210)
    tile = rng.integers(-4, 5, (12, 12, 3))
    return (frame + np.tile(tile, (SIDE_PX // 12, SIDE_PX // 12, 1))).clip(0, 255).astype(np.uint8)


def still(shape: str, person: int, take: int) -> NDArray[np.uint8]:
    """A sign held before the camera, as a clip of one frame."""
    rng = np.random.default_rng([1, person, take, *shape.encode()])
    return hand(shape, *rng.uniform(0.4, 0.6, 2), rng, 0.5)[None]


def movement(name: str, person: int, take: int) -> NDArray[np.uint8]:
    """A hand that rests, moves, pauses, and moves on."""
    rng = np.random.default_rng([2, person, take, *name.encode()])
    first, second = np.linspace(0.0, 0.4, 5), np.linspace(0.4, rng.uniform(0.8, 1.0), int(rng.integers(5, 8)))
    way = [*[0.0] * 8, *first, *[0.4] * 4, *second]
    start = 0.5 - 0.5 * np.array(MOVEMENTS[name]) + rng.normal(0, 0.02, 2)
    tile_seed = int(rng.integers(1000))
    places = [start + share * np.array(MOVEMENTS[name]) for share in way]
    return np.stack([hand("tall", x, y, np.random.default_rng(tile_seed)) for x, y in places])


def joints(name: str, person: int, take: int) -> Rows:
    """Landmarks of a movement as rows of features: five fingers like a fan that closes while the hand goes its way."""
    rng = np.random.default_rng([3, person, take, *name.encode()])
    frames = []
    for share in np.concatenate([np.zeros(4), np.linspace(0, 1, 8)]):
        fan = np.linspace(-1, 1, 5) * FANS[name] * (1 - 0.5 * share) + 0.1 * person
        lengths = np.array([0.4, 0.6, 0.8, 1.0])[:, None]
        fingers = np.stack([np.sin(fan) * lengths, -np.cos(fan) * lengths], axis=2).transpose(1, 0, 2).reshape(20, 2)
        centre = np.array([160.0, 120.0]) + 200.0 * (share - 0.5) * np.array(MOVEMENTS[name])
        points = centre + 40.0 * np.vstack([np.zeros((1, 2)), fingers]) + rng.normal(0, 2.0, (21, 2))
        frames.append(points.astype(np.float32))
    return landmark_features(frames, (320, 240))


def taken(make: Callable[..., Any], names: Sequence[str], takes: int) -> tuple[list[Any], list[str], list[str]]:
    """What `make` gives for every name, person and take: the items, their names, and who it was."""
    all_of = [(name, person, take) for name in names for person in range(NUM_PERSONS) for take in range(takes)]
    return [make(*one) for one in all_of], [n for n, _, _ in all_of], [str(p) for _, p, _ in all_of]


def word_recognizers() -> Iterator[tuple[str, hri.WordRecognizer]]:
    """Every model of words; options that no other file has differ from the defaults in one of them."""

    def sample(name: str, person: int, take: int) -> NDArray[np.float32]:
        return word((WORDS | OTHER_WORDS)[name], person, take).astype(np.float32) / FULL_SCALE

    clips, labels, persons = taken(sample, list(WORDS), 3)
    others = [FillerWord(sample(name, p, 0), RATE_HZ, name) for name in OTHER_WORDS for p in range(2)]

    def fitted(fillers: Sequence[FillerWord] = (), **options: Any) -> hri.WordRecognizer:
        recognizer = hri.WordRecognizer(**options)
        return recognizer.fit(clips, labels, sample_rate_hz=RATE_HZ, groups=persons, fillers=fillers)

    yield "words_hmm", fitted()
    small = {"num_states": 2, "garbage_mixtures": 3, "max_iterations": 5, "seed": 7}
    with_background = fitted(others, **small, false_reject_rate=0.1)
    yield "words_background", with_background
    yield (
        "words_one_stream",
        fitted(
            cepstra={
                **{"frame_length_ms": 32.0, "frame_shift_ms": 12.0, "padding": "centred", "sample_scale": 32768.0},
                **{"remove_dc": True, "pre_emphasis": 0.9, "frame_pre_emphasis": True, "window": "povey"},
                **{"fft_size": 512, "filter_bank": "hfcc", "num_filters": 20, "low_hz": 80.0, "high_hz": 3800.0},
                **{"erb_factor": 1.5, "warp": 1.02, "use_power": False, "energy_floor": 1e-8, "num_cepstra": 10},
                **{"use_energy": True, "lifter": 0.0, "rasta_pole": 0.9, "normalisation": "mean_variance"},
                **{"delta_orders": 1, "delta_window": 3},
            },
            activity={"frame_ms": 30.0, "shift_ms": 12.0, "silence_dbfs": -65.0, "margin_db": 5.0, "padding_ms": 40.0},
            **{"num_states": 4, "garbage_mixtures": 8, "max_iterations": 6},
            **{
                "trim": False,
                "noise_floor_db": 50.0,
                "level_stream": False,
                "num_vtlp_factors": 1,
                "num_noisy_copies": 0,
            },
        ),
    )
    yield (
        "words_linear_prediction",
        fitted(
            cepstra={
                **{"kind": "linear_prediction", "lpc_order": 10, "num_cepstra": 9},
                **{"normalisation": "running_mean", "running_s": 1.0},
            },
            **{"num_states": 3, "num_mixtures": 2, "garbage_mixtures": 4},
            **{"num_vtlp_factors": 5, "vtlp_step": 0.05, "num_noisy_copies": 1, "min_snr_db": 15.0, "max_snr_db": 30.0},
        ),
    )
    labels = [{"rise": "उठो", "fall": "fall", "wave": "wave"}[label] for label in labels]
    slaney = {"mel_scale": "slaney", "unit_area": True, "decibels": True, "top_db": 70.0}
    warped = {"warp_low_hz": 200.0, "warp_high_hz": 3500.0, "filter_axis": "mel", "htk_c0": True, "num_cepstra": 9}
    ptbhmm = fitted(cepstra=slaney | warped, model="ptbhmm", num_states=4, num_codewords=24)
    yield "words_ptbhmm", ptbhmm
    adapter = hri.SpeakerAdapter(with_background, words_per_label=1.0)
    for name in WORDS:
        for take in range(2):
            adapter.learn(sample(name, 5, take), name, RATE_HZ)
    adapter.update()
    yield "words_adapted", adapter.recognizer
    yield "words_added", ptbhmm.add_word("zig", [sample("other4", p, 0) for p in range(3)], RATE_HZ)


def gesture_recognizers() -> Iterator[tuple[str, hri.GestureRecognizer]]:
    """Every model of gestures, by silhouettes and by landmarks."""
    stills, moves = taken(still, list(SHAPES), 7), taken(movement, list(MOVEMENTS), 2)
    landmarks = taken(joints, list(MOVEMENTS), 2)

    def fitted(training: tuple[list[Any], list[str], list[str]], **options: Any) -> hri.GestureRecognizer:
        recognizer = hri.GestureRecognizer(**options)
        items, labels, persons = training
        if options.get("source") == "landmarks":
            return recognizer.fit_features(items, labels, groups=persons)
        return recognizer.fit(items, labels, groups=persons)

    coarse = {"crop_px": 32, "histogram": {"num_cells": 2, "num_bins": 6}}
    outline = {
        **{"crop_px": 48, "histogram": {"num_cells": 2, "num_bins": 5}, "use_grey": False, "use_cepstrum": False},
        **{"use_fourier": True, "fourier": {"num_points": 64, "num_harmonics": 6, "use_phase": True}},
        **{"use_chain_code": True, "chain_code": {"num_parts": 2, "use_turns": True}, "use_moments": True},
        **{"use_wavelet": True, "wavelet": {"num_scales": 3, "num_frequencies": 3}, "descriptor_weight": 0.7},
    }
    sparse = {
        **{"use_silhouette": False, "histogram": {"num_cells": 3, "num_bins": 5}, "cepstrum_weight": 0.2},
        "cepstrum": {"wavelet": "haar", "num_levels": 2, "mask_px": 128, "num_filters": 16, "num_cepstra": 8},
    }
    contour = {"wavelet": {"source": "contour"}, "use_wavelet": True, "histogram": {"num_cells": 2, "num_bins": 4}}
    yield "gestures_path", fitted(moves, features=coarse)
    yield "gestures_rbf", fitted(stills, features=coarse, false_reject_rate=0.05)
    yield "gestures_svm", fitted(taken(still, ["flat", "tall"], 4), model="svm")
    yield "gestures_bayes", fitted(stills, model="bayes", features=outline, num_components=6)
    yield "gestures_knn", fitted(stills, model="knn", features=sparse, num_components=5, num_neighbours=3)
    small = {"num_components": 5, "num_states": 3, "max_iterations": 6, "seed": 3}
    yield "gestures_hmm", fitted(moves, model="hmm", features=contour, **small)
    yield "gestures_ptbhmm", fitted(moves, model="ptbhmm", features=sparse, num_codewords=12, **small)
    yield "landmarks_path", fitted(landmarks, source="landmarks", svm_cost=0.5)
    single = ([rows[-1:] for rows in landmarks[0]], *landmarks[1:])
    yield "landmarks_rbf", fitted(single, source="landmarks", rbf_cost=5.0, rbf_sharpness=1.0)


def random_rows(seed: int, count: int = 12) -> tuple[Rows, NDArray[np.int32]]:
    """Rows of four numbers in three classes, and the classes."""
    rng = np.random.default_rng([4, seed])
    classes = np.arange(count, dtype=np.int32) % 3
    means = np.array([[0.0, 1.0, 2.0, 0.0], [2.0, 0.0, 0.5, 1.0], [1.0, 2.0, 0.0, 2.0]])
    return (means[classes] + rng.normal(0, 0.5, (count, 4))).astype(np.float32), classes


def vector_models() -> Iterator[tuple[str, str, Any]]:
    """Codebooks, projections and classifiers: name of the file, kind, model."""
    rows, classes = random_rows(0, 60)
    labelled = (rows, classes, 3)
    yield "codebook", "codebook", _native.Codebook.train_lbg(rows, _native.CodebookOptions(num_codewords=6))
    codebooks = _native.MultiStreamCodebook.train_lbg(rows, [3, 1], _native.CodebookOptions(num_codewords=4))
    yield "multi_stream_codebook", "multi_stream_codebook", codebooks
    yield "pca", "pca", _native.Pca.train(rows, 3)
    yield "lda", "lda", _native.Lda.train(*labelled, _native.LdaOptions(shrinkage=0.1))
    yield "linear_svm", "linear_svm", _native.LinearSvm.train(*labelled)
    yield "rbf_classifier", "rbf_classifier", _native.RbfClassifier.train(*labelled)
    for covariance in ("shared", "full", "diagonal"):
        options = _native.GaussianBayesOptions(covariance=covariance)
        yield f"gaussian_bayes_{covariance}", "gaussian_bayes", _native.GaussianBayes.train(*labelled, options)
    yield "knn", "knn", _native.Knn.train(*labelled, _native.KnnOptions(num_neighbours=3))
    for metric in ("euclidean", "manhattan", "mahalanobis", "bhattacharyya"):
        options = _native.DistanceClassifierOptions(metric=metric)
        yield f"distance_{metric}", "distance_classifier", _native.DistanceClassifier.train(*labelled, options)
    full = _native.GaussianBayesOptions(covariance="full")
    yield "possibility_classifier", "possibility_classifier", _native.PossibilityClassifier.train(*labelled, full)
    mixture = _native.GaussianMixture.train(rows, _native.GaussianMixtureOptions(num_mixtures=3, wide_weight=0.01))
    yield "gaussian_mixture", "gaussian_mixture", mixture


def sequence_models() -> Iterator[tuple[str, str, Any]]:
    """Chains and hidden Markov models, of every topology and conjunction: name of the file, kind, model."""
    sequences = [random_rows(seed, 15)[0] for seed in range(1, 7)]
    codebook = _native.Codebook.train_lbg(np.concatenate(sequences), _native.CodebookOptions(num_codewords=6))
    symbols = [codebook.quantise(rows) for rows in sequences]
    kinds = {"left_right": 1, "banded": 2, "ergodic": 1, "rank_one_plus_band": 1}
    for kind, max_jump in kinds.items():
        topology = _native.Topology(kind=kind, num_states=4, max_jump=max_jump)
        options = _native.DiscreteHmmOptions(topology=topology, num_symbols=6, max_iterations=5)
        hmm = _native.DiscreteHmm.train(symbols, options)
        yield f"markov_chain_{kind}", "markov_chain", hmm.chain
        yield f"discrete_hmm_{kind}", "discrete_hmm", hmm
    banded = _native.Topology(kind="banded", num_states=3, max_jump=2)
    for tied in (False, True):
        options = _native.GaussianMixtureHmmOptions(
            topology=banded, num_mixtures=2, max_iterations=5, tied_variance=tied
        )
        hmm = _native.GaussianMixtureHmm.train(sequences, options)
        yield f"gaussian_mixture_hmm{'_tied' if tied else ''}", "gaussian_mixture_hmm", hmm
    per_class = [symbols[i::3] for i in range(3)]
    for number, conjunction in enumerate(("product", "min", "max")):
        rule = _native.PossibilisticRule(conjunction=conjunction, conditioned=number != 1, concentration=1.2)
        ways = {"training": "best_path" if number == 1 else "all_paths", "max_iterations": 4}
        options = _native.PossibilisticHmmOptions(topology=banded, num_symbols=6, rule=rule, **ways)
        models = _native.PossibilisticHmmSet.train(per_class, options)
        yield f"possibilistic_hmm_set_{conjunction}", "possibilistic_hmm_set", models
    options = _native.GaussianMixtureHmmOptions(topology=banded, num_mixtures=2, max_iterations=4)
    models = _native.PossibilisticGaussianHmmSet.train([sequences[i::3] for i in range(3)], options)
    yield "possibilistic_gaussian_hmm_set", "possibilistic_gaussian_hmm_set", models


def asked() -> Arrays:
    """What no model was trained on, stored so that no later numpy can change it."""
    rows = random_rows(99)[0]
    inputs: Arrays = {"rows": rows, "row": rows[0]}
    inputs["symbols"] = np.random.default_rng(5).integers(0, 6, 14).astype(np.int32)
    for name, glide in WORDS.items():
        inputs[f"word/{name}/{RATE_HZ}"] = word(glide, 4, 9)
    inputs[f"word/other/{RATE_HZ}"] = word(OTHER_WORDS["other4"], 4, 9)
    noise = np.random.default_rng(6).normal(0, 0.1, 3000) * np.hanning(3000)
    inputs[f"word/noise/{RATE_HZ}"] = np.round(FULL_SCALE * np.pad(noise, 800)).astype(np.int16)
    inputs[f"word/silence/{RATE_HZ}"] = np.zeros(4000, np.int16)
    inputs["word/rise/11025"] = word(WORDS["rise"], 4, 10, 11025)
    for shape in SHAPES:
        inputs[f"clip/{shape}"] = still(shape, 4, 9)
    for name in MOVEMENTS:
        inputs[f"clip/{name}"] = movement(name, 4, 9)
    inputs["clip/wall"] = np.full((1, SIDE_PX, SIDE_PX, 3), 120, np.uint8)
    return inputs


def asked_rows(name: str, recognizer: hri.GestureRecognizer, inputs: Arrays) -> Arrays:
    """Rows of features for one model of gestures, as it computed them from the clips."""
    if name.startswith("landmarks"):
        last = slice(-1, None) if name.endswith("rbf") else slice(None)
        return {f"rows/{name}/{m}": joints(m, 4, 9)[last] for m in MOVEMENTS}
    fitting = MOVEMENTS if recognizer.is_dynamic else SHAPES
    return {f"rows/{name}/{clip}": recognizer.features(list(inputs[f"clip/{clip}"])) for clip in fitting}


def main() -> None:
    """Writes a folder anew, all files or those named."""
    folder, wanted = Path(sys.argv[1]), set(sys.argv[2:])
    folder.mkdir(exist_ok=True)
    inputs, kinds = asked(), {}
    for name, recognizer in chain(word_recognizers(), gesture_recognizers()):
        if not wanted or name in wanted:
            recognizer.save(folder / f"{name}.hri")
            kinds[name] = f"{'word' if recognizer.mode == 'speech' else 'gesture'}_recognizer"
            if isinstance(recognizer, hri.GestureRecognizer):
                inputs |= asked_rows(name, recognizer, inputs)
    for name, kind, model in chain(vector_models(), sequence_models()):
        if not wanted or name in wanted:
            file = _native.ModelFile()
            file.kind = kinds[name] = kind
            model.write(file, PREFIX)
            file.write(str(folder / f"{name}.hri"))
    np.savez_compressed(folder / "inputs.npz", **inputs)
    files: dict[str, dict[str, Any]] = {}
    for name, kind in kinds.items():
        path = folder / f"{name}.hri"
        files[name] = {"kind": kind, "answers": answers(kind, path, inputs)}
        if kind in RECOGNIZERS:
            recognizer = load(kind, path)
            files[name] |= {"labels": recognizer.classes_.tolist(), "options": recognizer.options.as_dict()}
    made = {"hri": hri.__version__, "files": files}
    (folder / "expected.json").write_text(json.dumps(made, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
