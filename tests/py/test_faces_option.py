# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The option --faces of every command that looks for hands, and what is said where nothing finds faces."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import cv2
import pytest

import hri as library
from hri.cli import evaluate
from hri.media import write_video
from hri.vision import FaceFinder, FaceFinderOptions, faces
from test_person_streams import CASCADE, room

PATTERN = "{label}/{person}_{take}.png"


@pytest.fixture
def shown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Still signs of a hand on the left and on the right; synthetic. Few windows are looked at for a face."""
    few = FaceFinderOptions(min_side=0.25, scale_step=2.0)
    monkeypatch.setattr("hri.vision.faces._read_cascade", lambda path: FaceFinder(path, few))
    for label in ("left", "right"):
        for person in ("asha", "ravi"):
            for take in range(3):
                path = tmp_path / "shown" / label / f"{person}_{take}.png"
                path.parent.mkdir(parents=True, exist_ok=True)
                cv2.imwrite(str(path), room(60 + 2 * take + (150 if label == "right" else 0)))
    (tmp_path / "any.xml").write_text(CASCADE)
    return tmp_path / "shown"


@pytest.fixture
def train(hri: Any, shown: Path, tmp_path: Path) -> Any:
    def run(*options: Any) -> Any:
        return hri("train", "gesture", "--data", shown, "--pattern", PATTERN, "--out", tmp_path / "m.hri",
                   "--option", "min_quality=0", "--option", "model=svm", *options)  # fmt: skip

    return run


def test_training_keeps_whether_hands_are_those_of_the_face(train: Any, hri: Any, shown: Path, tmp_path: Path) -> None:
    done = train("--faces", tmp_path / "any.xml")
    assert done.code == 0 and "something must find faces" in done.err, done.err
    assert library.GestureRecognizer.load(tmp_path / "m.hri").options.use_faces
    assert train("--faces", "never").code == 0
    assert not library.GestureRecognizer.load(tmp_path / "m.hri").options.use_faces
    for wrong in (
        ("--source", "landmarks"),
        ("--option", "source=landmarks"),
        ("--option", "use_faces=true"),
    ):
        refused = train("--faces", "auto", *wrong)
        assert refused.code == 2 and "--faces" in refused.err, wrong
    absent = train("--faces", tmp_path / "none.xml")
    assert absent.code == 3 and "none.xml" in absent.err
    spoken = hri("train", "speech", "--data", shown, "--faces", "auto")
    assert spoken.code == 2 and "--faces" in spoken.err


def test_evaluation_finds_hands_as_training_does(
    hri: Any, shown: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made: list[library.GestureRecognizer] = []
    monkeypatch.setattr(evaluate, "cross_validate", lambda _, make, **__: made.append(make()) or 1 / 0)
    command = ("evaluate", "gesture", "--data", shown, "--pattern", PATTERN)
    hri(*command, "--faces", tmp_path / "any.xml")
    assert made[0].options.use_faces and made[0].faces == str(tmp_path / "any.xml")
    assert made[0].options.source == "silhouettes"
    refused = hri(*command, "--faces", "auto", "--source", "landmarks")
    assert refused.code == 2 and "--faces is for gestures by silhouettes" in refused.err
    absent = hri(*command, "--faces", tmp_path / "none.xml")
    assert absent.code == 3 and "none.xml" in absent.err and len(made) == 1


def test_every_command_that_looks_for_hands_finds_them_as_told(
    train: Any, hri: Any, shown: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    model, picture, video = tmp_path / "m.hri", shown / "left" / "asha_0.png", tmp_path / "v.avi"
    assert train("--faces", tmp_path / "any.xml").code == 0
    write_video(video, [room(60)] * 20, 10.0)
    monkeypatch.setattr("hri.vision.faces.find_cascade", lambda: None)
    commands = {
        "recognise": ("recognise", picture, "--gesture-model", model),
        "watch": ("watch", "--model", model, video),
        "session": ("session", "--gesture-model", model, "--backend", "none", "--json-lines", video),
    }
    for name, command in commands.items():
        without = hri(*command)  # the model uses faces, and nothing finds them
        assert without.code != 0 and "opencv-data" in without.err, name
        for choice in ("never", tmp_path / "any.xml"):
            found = hri(*command, "--faces", choice)
            assert found.code == 0 and "finds faces" not in found.err, (name, found.err)
        vars(faces).pop("__warningregistry__", None)  # it is said once a process
        warned = hri(*command, "--faces", "auto")
        assert warned.code == 0 and warned.err.count("nothing here finds faces") == 1, (name, warned.err)
    events = [json.loads(line) for line in hri(*commands["session"], "--faces", "never").out.splitlines()]
    assert any(str(event.get("model", "")).endswith(" faces never") for event in events)
    served = hri("serve", "--no-speech", "--gesture-model", model, "--backend", "none", "--faces", tmp_path / "no.xml")
    assert served.code != 0 and "no.xml" in served.err


def test_what_would_have_no_effect_is_refused(hri: Any, shown: Path, tmp_path: Path) -> None:
    def refused(*command: Any) -> None:
        result = hri(*command, "--faces", "never")
        assert result.code == 2 and "--faces" in result.err, command

    refused("recognise", "--speech", tmp_path / "any.xml")
    refused("session", "--no-gesture")
    refused("serve", "--no-gesture")
    joints = library.GestureRecognizer(source="landmarks")
    from click import UsageError

    from hri.cli.faces import look_for_faces

    with pytest.raises(UsageError, match="by their joints"):
        look_for_faces(joints, "auto")
    with pytest.raises(UsageError, match="the head"):
        look_for_faces(library.SentenceRecognizer(), "never")


def test_hands_are_shown_as_models_are_trained_on_them_without_faces(
    hri: Any, shown: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(faces.VARIABLE, str(tmp_path / "any.xml"))
    picture = shown / "left" / "asha_0.png"
    for command in (("hands", picture), ("features", picture, "--kind", "fourier")):
        found = {choice: hri(*command, "--faces", choice) for choice in ("never", "auto")}
        assert found["never"].code == 0 and found["auto"].out != found["never"].out, command
        assert hri(*command).out == found["never"].out, command
    (tmp_path / "a.wav").write_bytes(b"")
    refused = hri("features", tmp_path / "a.wav", "--faces", "never")
    assert refused.code == 2 and "--faces is of pictures and videos" in refused.err
