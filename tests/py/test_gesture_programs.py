# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""C++ programs of a few lines, video in and decision out, against Python, to the bit."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

import hri
import hri.studies
from hri.live import VideoSource, Watcher
from hri.media import read_frames, write_video
from test_watching_movements import FAR, FPS, clip

ROOT = Path(__file__).resolve().parents[2]
BUILD = os.environ.get("HRI_BUILD_DIR")

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not BUILD, reason="HRI_BUILD_DIR names no CMake build; ./run test --all sets it"),
]


def run(*command: object) -> str:
    """Standard output of a command that has to succeed."""
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The example project, built against an installed libhri."""
    prefix, build = tmp_path_factory.mktemp("installed"), tmp_path_factory.mktemp("gestures")
    run("cmake", "--install", BUILD, "--component", "development", "--prefix", prefix)
    source = ROOT / "examples" / "gestures"
    run("cmake", "-S", source, "-B", build, "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", build)
    return build


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Gestures that begin at rest, drawn."""
    path = tmp_path_factory.mktemp("model") / "gestures.hri"
    named = [(label, take) for label in FAR for take in range(4)]
    hri.GestureRecognizer().fit([clip(*one) for one in named], [label for label, _ in named]).save(path)
    return path


@pytest.mark.parametrize("label", list(FAR))
def test_a_program_of_a_few_lines_gives_the_decision_of_python(
    programs: Path, model: Path, tmp_path: Path, label: str
) -> None:
    video = tmp_path / "clip.avi"
    write_video(video, clip(label, 9), FPS)  # pictures of their own: every decoder gives the same
    decision = hri.GestureRecognizer.load(model).recognise(read_frames(video).frames)
    first, *nbest = (line.split("\t") for line in run(programs / "recognise_gesture", model, video).splitlines())
    assert first[0] == decision.label and nbest[0][0] == label
    assert [float.fromhex(text) for text in first[1:]] == [decision.confidence, decision.score]
    assert [(name, float.fromhex(p), float.fromhex(s)) for name, p, s in nbest] == [
        (entry.label, entry.probability, entry.log_score) for entry in decision.nbest
    ]


def test_a_program_watches_as_python_does(programs: Path, model: Path, tmp_path: Path) -> None:
    video = tmp_path / "stream.avi"
    write_video(video, [frame for label in FAR for frame in clip(label, 8)], FPS)
    recognizer = hri.GestureRecognizer.load(model)
    events = [e for e in Watcher(recognizer).watch(VideoSource(video)) if e.event in ("preliminary", "decision")]
    assert len(events) >= len(FAR)
    lines = [line.split("\t") for line in run(programs / "watch_video", model, video).splitlines()]
    assert [(kind, label, float.fromhex(score)) for kind, _, _, label, score in lines] == [
        (e.event, e.decision.label, e.decision.score) for e in events if e.decision is not None
    ]


@pytest.mark.data
def test_a_clip_of_a_codec_that_reorders_frames_is_read_whole(programs: Path, model: Path) -> None:
    """Debian's OpenCV gives no time for the last frames of such a clip."""
    video = Path(os.environ["HRI_DATA"]) / "webcam_gestures" / "pinch" / "t1.m4v"
    decision = hri.GestureRecognizer.load(model).recognise(read_frames(video))
    line = run(programs / "recognise_gesture", model, video).splitlines()[0].split("\t")
    assert line[0] == decision.label and abs(float.fromhex(line[2]) - decision.score) < 1e-3
    run(programs / "watch_video", model, video)


def test_the_study_of_parity_runs_whole(programs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for label in ("left", "down"):
        folder = tmp_path / "webcam_gestures" / label
        folder.mkdir(parents=True)
        for take in range(4):
            write_video(folder / f"t{take}.m4v", clip(label, take), FPS)
    study = hri.studies.get_study("cpp-parity")
    monkeypatch.setenv("HRI_PROGRAMS", str(tmp_path))
    with pytest.raises(ValueError, match="HRI_PROGRAMS must name the folder of recognise_gesture, watch_video"):
        hri.studies.run_study(study, tmp_path, lambda *_: None, folds=1)
    monkeypatch.setenv("HRI_PROGRAMS", str(programs))
    result = hri.studies.run_study(study, tmp_path, lambda *_: None, folds=1)
    equal = {(row["program"], row["pictures"]): row["equal_mean"] for row in result["rows"]}
    assert result["passed"] and len(equal) == 4
    assert equal["recognise_gesture", "motion jpeg"] == equal["watch_video", "motion jpeg"] == 1


def test_what_is_no_video_is_refused_with_its_name(programs: Path, model: Path, tmp_path: Path) -> None:
    (tmp_path / "broken.avi").write_bytes(b"no video")
    for name, message in (("broken.avi", "not a video"), ("missing.avi", "cannot open")):
        done = subprocess.run(
            [str(programs / "recognise_gesture"), str(model), str(tmp_path / name)], capture_output=True, text=True
        )
        assert done.returncode == 3 and name in done.stderr and message in done.stderr
