# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Spoken digits of unseen speakers in noise, trained on clean speech and with noise added.

White and pink noise are synthetic signals, dishes and a running tap are recorded; all four are files.

"clean" is trained on the recordings as they are, "random" on copies with random noise too, as the recogniser makes them
by default, "noisy" on copies with other parts of these noises beside that.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

from hri.evaluation import AddNoise, adapting
from hri.evaluation.conditions import Condition
from hri.recognition import WordRecognizer
from hri.studies.front_ends import EMBEDDING, FRONT_ENDS, PLAIN
from hri.studies.registry import WORD_SOURCES, Layout, Progress, Study
from hri.studies.sweeps import result_of, sweep
from hri.studies.tables import Row

NOISES = {
    "white": "white_noise.wav",
    "pink": "pink_noise.wav",
    "dishes": "doing_the_dishes.wav",
    "tap": "running_tap.wav",
}
SNRS_DB = (20, 10, 5, 0)
TRAINING_SNRS_DB = (20.0, 15.0, 10.0, 5.0, 0.0)
TRAINING = ("clean", "random", "noisy")
TRAINING_BOTH = ("random", "noisy")
WITH_NETWORK = {"cepstra": PLAIN, "both": EMBEDDING}
"""What a network is measured beside, as `sweep` calls it."""
OPTIONS = {"clean": {"num_noisy_copies": 0}}
LISTENING = ("alone", "adapting")
TARGETS = {"clean": 0.78, "noisy": 0.85}
"""White noise at 10 dB, by what was trained on, while adapting to speaker and noise."""
TARGETS_ALONE = {20: 0.90, 10: 0.78, 5: 0.65, 0: 0.45}
"""White noise, by dB, trained with noise, each clip alone."""
TARGETS_BOTH = {20: 0.96, 10: 0.91, 5: 0.84, 0: 0.65}
"""The same with both front ends."""
CLEAN = "clean"


def noise_paths(data_dir: Path) -> dict[str, str]:
    """The files of noise by name; white and pink are computed signals, the others are recorded."""
    return {name: str(data_dir / "noise" / file) for name, file in NOISES.items()}


def _run(
    data_dir: Path,
    progress: Progress,
    *,
    front_end: Sequence[str] = tuple(FRONT_ENDS),
    training: Sequence[str] = TRAINING,
    noise: Sequence[str] = tuple(NOISES),
    takes: int | None = None,
    folds: int | None = None,
    network: bool = False,
) -> dict[str, Any]:
    paths = noise_paths(data_dir)
    tests: dict[str, Condition | None] = {CLEAN: None}
    for name in noise:
        tests |= {f"{name} {snr_db} dB": AddNoise([paths[name]], [snr_db], "second") for snr_db in SNRS_DB}
    added = {"clean": [], "random": [], "noisy": [AddNoise(list(paths.values()), TRAINING_SNRS_DB, "first")]}
    trainings = {name: added[name] for name in training}
    options = {name: {**OPTIONS.get(name, {}), **({"use_network": True} if network else {})} for name in training}
    found = sweep(
        data_dir, "fsdd", tests, trainings, progress, front_end, takes, options=options, adapt=True, folds=folds
    )
    rows = []
    for (variant, trained), measured in found.items():
        for name, listening in product(noise, LISTENING):
            place = {"front_end": variant, "training": trained, "listening": listening, "noise": name}
            under = adapting if listening == "adapting" else str
            rows.append({**place, "snr_db": CLEAN, **measured[under(CLEAN)]})
            rows += [{**place, "snr_db": snr_db, **measured[under(f"{name} {snr_db} dB")]} for snr_db in SNRS_DB]
    met = {
        row["training"]: row["accuracy_mean"] >= TARGETS[row["training"]]
        for row in rows
        if (row["front_end"], row["listening"], row["noise"], row["snr_db"]) == (PLAIN, "adapting", "white", 10)
        and row["training"] in TARGETS
    }
    alone = _met(rows, PLAIN, TARGETS_ALONE)
    verdict = all((*met.values(), *alone.values())) if met or alone else None
    return result_of(rows, verdict, passed_by_training=met, passed_by_snr_db=alone, training_snrs_db=TRAINING_SNRS_DB)


def _met(rows: Sequence[Row], front_end: str, targets: Mapping[int, float]) -> dict[int, bool]:
    """By dB, which of the `targets` in white noise, trained with noise and each clip alone, are met."""
    place = (front_end, "noisy", "alone", "white")
    return {
        row["snr_db"]: row["accuracy_mean"] >= targets[row["snr_db"]]
        for row in rows
        if (row["front_end"], row["training"], row["listening"], row["noise"]) == place and row["snr_db"] in targets
    }


def _run_both(
    data_dir: Path,
    progress: Progress,
    *,
    training: Sequence[str] = TRAINING_BOTH,
    noise: Sequence[str] = tuple(NOISES),
    takes: int | None = None,
    folds: int | None = None,
) -> dict[str, Any]:
    result = _run(data_dir, progress, front_end=[EMBEDDING], training=training, noise=noise, takes=takes, folds=folds)
    met = _met(result["rows"], EMBEDDING, TARGETS_BOTH)
    options = WordRecognizer(front_end="both").options.as_dict()
    return result | {"options": options, "passed_by_snr_db": met, "passed": all(met.values()) if met else None}


def _run_network(
    data_dir: Path,
    progress: Progress,
    *,
    front_end: Sequence[str] = tuple(WITH_NETWORK),
    training: Sequence[str] = TRAINING_BOTH,
    noise: Sequence[str] = tuple(NOISES),
    takes: int | None = None,
    folds: int | None = None,
) -> dict[str, Any]:
    measure = partial(_run, data_dir, progress, training=training, noise=noise, takes=takes, folds=folds, network=True)
    result: dict[str, Any] = {}
    rows: list[Row] = []
    met = {}
    for name in front_end:
        result = measure(front_end=[WITH_NETWORK[name]])
        met[name] = _met(result["rows"], WITH_NETWORK[name], TARGETS_ALONE if name == "cepstra" else TARGETS_BOTH)
        rows += [{**row, "front_end": name} for row in result["rows"]]
    options = WordRecognizer(use_network=True).options.as_dict()
    judged = [one for by_db in met.values() for one in by_db.values()]
    passed = all(judged) if judged else None
    return {"seed": result["seed"], "options": options, "rows": rows, "passed_by_snr_db": met, "passed": passed}


def _listed(targets: Mapping[int, float]) -> str:
    """Such as "20, 10 dB: >= 96, 91 %"."""
    levels = ", ".join(f"{snr_db}" for snr_db in targets)
    return f"{levels} dB: >= {', '.join(f'{100 * share:.0f}' for share in targets.values())} %"


STUDIES = (
    Study(
        "fsdd-noise",
        "English digits in noise, leave one of 4 speakers out; trained clean and with other parts of the "
        "noises added, with and without HFCC-E and wavelet shrinkage",
        ("fsdd/recordings", "noise"),
        f"white noise at 10 dB: >= {100 * TARGETS['clean']:.0f} % trained clean, "
        f">= {100 * TARGETS['noisy']:.0f} % with noise, while adapting to speaker and noise; "
        f"at {_listed(TARGETS_ALONE)} with noise, alone",
        _run,
        layout=Layout(columns="snr_db", x="snr_db", panel="noise"),
        axes={"front_end": tuple(FRONT_ENDS), "training": TRAINING, "noise": tuple(NOISES)},
        thins=True,
        sources=WORD_SOURCES,
        folds=True,
        quick={"front_end": ("plain",), "training": ("clean",), "noise": ("white",)},
    ),
    Study(
        "fsdd-noise-both",
        "English digits in noise, leave one of 4 speakers out, by cepstra and a pretrained speech embedding "
        "(extra embedding)",
        ("fsdd/recordings", "noise"),
        f"white noise at {_listed(TARGETS_BOTH)}, trained with noise, alone",
        _run_both,
        layout=Layout(columns="snr_db", x="snr_db", panel="noise"),
        axes={"training": TRAINING_BOTH, "noise": tuple(NOISES)},
        thins=True,
        sources=WORD_SOURCES,
        folds=True,
        quick={"training": ("noisy",), "noise": ("white",)},
    ),
    Study(
        "fsdd-noise-network",
        "English digits in noise, leave one of 4 speakers out, with a network trained on the same words: "
        "beside cepstra, and beside cepstra and the embedding",
        ("fsdd/recordings", "noise"),
        f"white noise at {_listed(TARGETS_ALONE)} (cepstra) and {_listed(TARGETS_BOTH)} (both), trained with noise, "
        "alone",
        _run_network,
        layout=Layout(columns="snr_db", x="snr_db", panel="noise"),
        axes={"front_end": tuple(WITH_NETWORK), "training": TRAINING_BOTH, "noise": tuple(NOISES)},
        thins=True,
        sources=WORD_SOURCES,
        folds=True,
        quick={"front_end": ("cepstra",), "training": ("noisy",), "noise": ("white",)},
    ),
)
