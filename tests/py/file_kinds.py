# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Every writer and every reader of files that hri has, by name, for tests that ask the same of all of them."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import hri
from hri.cli.output import write_json
from hri.core import files
from hri.core.plotting import new_axes, save_figure
from hri.datasets.asl_sentences import HANDS_COLUMNS, SIGNERS_COLUMNS, WORDS_COLUMNS, read_asl_sentences
from hri.datasets.manifest import Manifest, SampleRow, read_manifest, write_manifest
from hri.fusion import LearnedFusion
from hri.htk import (
    Configuration,
    Dictionary,
    Label,
    MasterLabelFile,
    ModelSet,
    ParameterFile,
    Pronunciation,
    Transcription,
    WordLattice,
    read_list,
    read_script,
)
from hri.io import ModelFile, read_wav, write_wav_pcm16
from hri.language import NGramModel
from hri.media import frame_rate, iterate_frames, read_audio, read_frames, read_image, write_image, write_video
from hri.models import Codebook
from hri.robot import Trajectory, gesture_trajectory, read_joint_trajectory, read_pulse_csv, read_short_csv
from hri.robot.control.state import MotionLog, RobotState
from hri.robot.imitation.tracks import read_hand_tracks
from hri.robot.motion.joint_trajectory import write_joint_trajectory
from hri.robot.motion.pulse_csv import parse_pulse_csv, write_pulse_csv
from hri.robot.motion.repair import repair_pulse_csv
from hri.robot.motion.short_csv import check_short_csv, is_short_csv, write_short_csv
from hri.session import read_recording
from hri.studies.kept import read_kept
from hri.studies.webcam import read_conditions

HERE = Path(__file__).parent
PICTURE = (np.random.default_rng(1).random((60, 80, 3)) * 255).astype(np.uint8)
SAMPLES = np.sin(np.arange(4000, dtype=np.float32))
ROWS = np.random.default_rng(2).normal(size=(200, 4))


def motion() -> Trajectory:
    return gesture_trajectory("wave")


def write_model(path: Any) -> None:
    file = ModelFile()
    file.kind = "test"
    file.set_matrix_d("rows", ROWS)
    file.write(path)


def write_log(path: Any) -> None:
    log = MotionLog()
    log.states = [RobotState(i / 100, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), {"head": 0.1}) for i in range(100)]
    log.write(path)


def write_repaired(path: Any) -> None:
    source = Path(path).with_name("odd.csv")
    if not source.exists():
        write_pulse_csv(source, motion())
    repair_pulse_csv(source, path)


def write_figure(path: Any) -> None:
    axes = new_axes((3.0, 2.0))
    axes.plot(SAMPLES[:100])
    save_figure(axes.figure, path)


def write_htk_models(path: Any) -> None:
    models = ModelSet()
    models.parse(f"~u mean <MEAN> 400 {'0.5 ' * 400}", "models")
    models.write(path)


LABELS = Transcription([Label(f"word {i}", i * 100) for i in range(200)])


def write_fusion(path: Any) -> None:
    """A learned fusion: the nodes of a tree."""
    rng = np.random.default_rng(0)
    truth = rng.integers(5, size=2000)
    scores = {mode: rng.dirichlet(np.ones(5), 2000) for mode in ("speech", "gesture")}
    quality = {mode: rng.random(2000) for mode in scores}
    LearnedFusion("tree").fit(scores, quality, truth).save(path)


WRITERS: dict[str, Callable[[Any], object]] = {
    "text.txt": lambda path: files.write_text(path, "text " * 2000),
    "bytes.bin": lambda path: files.write_bytes(path, bytes(8000)),
    "report.json": lambda path: write_json(str(path), {"rows": ROWS.tolist()}),
    "pulses.csv": lambda path: write_pulse_csv(path, motion()),
    "degrees.csv": lambda path: write_short_csv(path, motion()),
    "trajectory.json": lambda path: write_joint_trajectory(path, motion()),
    "trajectory.mcap": lambda path: write_joint_trajectory(path, motion()),
    "table.tsv": lambda path: motion().write_tsv(path),
    "repaired.csv": write_repaired,
    "log.json": write_log,
    "dataset.toml": lambda path: write_manifest(
        Path(path), Manifest("speech", rows=[SampleRow(f"{i}.wav", "a") for i in range(500)])
    ),
    "picture.png": lambda path: write_image(path, PICTURE),
    "picture.jpg": lambda path: write_image(path, PICTURE),
    "clip.avi": lambda path: write_video(path, [PICTURE] * 8, 10.0),
    "clip.mp4": lambda path: write_video(path, [PICTURE, PICTURE[::-1].copy()] * 4, 10.0),
    "clip.webm": lambda path: write_video(path, [PICTURE, PICTURE[::-1].copy()] * 4, 10.0),
    "clip.mkv": lambda path: write_video(path, [PICTURE] * 8, 10.0),
    "sound.wav": lambda path: write_wav_pcm16(path, SAMPLES, 8000),
    "model.hri": write_model,
    "language.arpa": lambda path: NGramModel.train([["go", f"{i}"] for i in range(200)]).save(path),
    "frames.mfc": lambda path: ParameterFile(ROWS, "USER").write(path),
    "labels.lab": LABELS.write,
    "labels.mlf": MasterLabelFile([("*/a.lab", LABELS)]).write,
    "words.dict": Dictionary([Pronunciation(f"word{i}", ["w", "d"]) for i in range(200)]).write,
    "words.slf": WordLattice.of_words([f"word{i}" for i in range(200)]).write,
    "models.mmf": write_htk_models,
    "estimator.hri": lambda path: Codebook(num_codewords=64).fit(ROWS).save(path),
    "fusion.hri": write_fusion,
    "figure.png": write_figure,
    "figure.svg": write_figure,
}


def write_sentences(folder: Path) -> None:
    tables = {
        "hands.csv": [HANDS_COLUMNS, *((1, frame, 1, 2, 3, 4, 5, 6) for frame in range(3))],
        "words.csv": [WORDS_COLUMNS, (1, "ann", "GO", 0, 1)],
        "signers.csv": [SIGNERS_COLUMNS, (1, "ann")],
    }
    for name, rows in tables.items():
        (folder / name).write_text("".join(",".join(map(str, row)) + "\n" for row in rows))


def read_session(path: Any) -> None:
    recording = read_recording(path)
    for messages in (recording.events(), recording.sound(), recording.pictures()):
        list(messages)


TRACK = "left-x,left-y,right-x,right-y,nose-x,nose-y\n" + "1,2,3,4,5,6\n" * 4
KEPT = '{"study": "noise", "arguments": {}, "data": {}, "rows": []}'
CONDITIONS = '[[condition]]\nname = "dark"\nclips = ["a"]\n'

READERS: dict[str, Callable[[Any], object]] = {
    "sound.wav": read_audio,
    "sound of C++.wav": read_wav,
    "sound.flac": read_audio,
    "picture.png": read_image,
    "picture.jpg": read_frames,
    "clip.avi": read_frames,
    "clip.mp4": lambda path: list(iterate_frames(path)),
    "rate.webm": frame_rate,
    "model.hri": ModelFile.read,
    "any.hri": hri.load,
    "words.hri": hri.WordRecognizer.load,
    "signs.hri": hri.GestureRecognizer.load,
    "connected.hri": hri.ConnectedWordRecognizer.load,
    "sentences.hri": hri.SentenceRecognizer.load,
    "language.arpa": NGramModel.load,
    "frames.mfc": ParameterFile.read,
    "labels.lab": Transcription.read,
    "labels.mlf": MasterLabelFile.read,
    "words.dict": Dictionary.read,
    "words.slf": WordLattice.read,
    "words.grammar": WordLattice.read_grammar,
    "models.mmf": lambda path: ModelSet().read(path),
    "coding.config": lambda path: Configuration().read(path),
    "copy.scp": read_script,
    "models.list": read_list,
    "estimator.hri": Codebook.load,
    "fusion.hri": LearnedFusion.load,
    "dataset.toml": lambda path: read_manifest(Path(path)),
    "signers.csv": lambda path: read_asl_sentences(Path(path).parent),
    "track.csv": read_hand_tracks,
    "pulses.csv": read_pulse_csv,
    "cells.csv": parse_pulse_csv,
    "odd.csv": lambda path: repair_pulse_csv(path, Path(path).with_name("repaired.csv")),
    "degrees.csv": read_short_csv,
    "form.csv": is_short_csv,
    "trajectory.json": read_joint_trajectory,
    "trajectory.mcap": read_joint_trajectory,
    "session.mcap": read_session,
    "checked.csv": check_short_csv,
    "kept.json": lambda path: read_kept(Path(path)),
    "conditions.toml": lambda path: read_conditions(["a"], Path(path)),
}


def run_python(script: str, *arguments: str | bytes | Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """A script in a process of its own that finds `file_kinds`."""
    before = {name: value for name, value in os.environ.items() if not name.startswith(("LC_", "LANG"))}
    search = os.pathsep.join(filter(None, [str(HERE), os.environ.get("PYTHONPATH")]))
    return subprocess.run(
        [sys.executable, "-c", script, *arguments],
        capture_output=True,
        encoding="utf-8",
        errors="surrogateescape",
        check=False,
        timeout=120,
        env={**before, "PYTHONPATH": search, **environment},
    )
