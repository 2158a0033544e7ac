# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""SKIG as it is published: folders and names give persons, gestures and conditions."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from hri.core.errors import FormatError, InvalidArgument
from hri.datasets import Dataset, load_skig
from hri.media import write_video


def name(letter: str, person: int, background: int, illumination: int, pose: int, gesture: int) -> str:
    return (
        f"{letter}_person_{person}_backgroud_{background}_illumination_{illumination}"
        f"_pose_{pose}_actionType_{gesture}.avi"
    )


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """Two subjects of the six; names only, as loading opens no video."""
    for person in (1, 2):
        for folder, letter in (("rgb", "M"), ("dep", "K")):
            (tmp_path / f"subject{person}_{folder}").mkdir()
            for gesture in range(1, 11):
                for background, illumination, pose in ((1, 1, 1), (2, 2, 3), (3, 1, 2)):
                    video = name(letter, person, background, illumination, pose, gesture)
                    (tmp_path / f"subject{person}_{folder}" / video).touch()
            (tmp_path / f"subject{person}_{folder}" / "Thumbs.db").touch()
    return tmp_path


def test_names_tell_persons_gestures_and_conditions(root: Path) -> None:
    dataset = Dataset.load(root)
    assert (dataset.kind, len(dataset), dataset.persons) == ("gesture", 60, ["person1", "person2"])
    assert len(dataset.labels) == 10 and {"circle", "come-here", "pat"} <= set(dataset.labels)
    assert dataset.conditions == {
        "background": ["paper with characters", "white paper", "wooden board"],
        "illumination": ["dark", "light"],
        "pose": ["fist", "flat", "index"],
    }
    sample = next(s for s in dataset if s.path.name == name("M", 2, 2, 2, 3, 10))
    assert (sample.label, sample.person, sample.take) == ("pat", "person2", "background2_illumination2_pose3")
    assert sample.conditions == {"background": "white paper", "illumination": "dark", "pose": "flat"}
    assert len(dataset.ignored) == 60 and all("_dep" in str(path) for path in dataset.ignored)
    depth = load_skig(root, "dep")
    assert len(depth) == 60 and all(s.path.name.startswith("K_") for s in depth)
    assert {fold.name for fold in dataset.folds_by_person()} == {"person1", "person2"}


def test_conditions_are_held_out(root: Path) -> None:
    dataset = Dataset.load(root)
    folds = dataset.folds_by_condition("illumination")
    assert [fold.name for fold in folds] == ["dark", "light"]
    assert all(dataset.samples[i].conditions["illumination"] == "dark" for i in folds[0].test)
    assert sorted(folds[0].train + folds[0].test) == list(range(60)) and len(folds[0].test) == 20
    with pytest.raises(InvalidArgument, match=r"'weather'.*background"):
        dataset.folds_by_condition("weather")
    with pytest.raises(InvalidArgument, match="needs 2 values"):
        Dataset(root, "gesture", [s for s in dataset if s.conditions["pose"] == "fist"]).folds_by_condition("pose")


def test_the_spelling_without_the_slip_is_read_too(root: Path) -> None:
    for path in (root / "subject1_rgb").glob("*.avi"):
        path.rename(path.with_name(path.name.replace("backgroud", "background")))
    assert len(Dataset.load(root)) == 60


@pytest.mark.parametrize(
    ("video", "message"),
    [
        (name("M", 1, 1, 1, 1, 11), r"actionType is 11, must lie in 1\.\.10"),
        (name("M", 1, 4, 1, 1, 1), r"background is 4, must lie in 1\.\.3"),
        (name("M", 1, 1, 0, 1, 1), r"illumination is 0, must lie in 1\.\.2"),
        (name("M", 1, 1, 1, 99, 1), r"pose is 99"),
        (name("M", 3, 1, 1, 1, 1), "shows person 3, in the folder of subject 1"),
        (name("K", 1, 1, 1, 1, 1), "not named as SKIG"),
        (name("M", 1, 1, 1, 1, 1).replace("person", "Person"), "not named as SKIG"),
        (name("M", 1, 1, 1, 1, 1).replace("_1.avi", "_١.avi"), "not named as SKIG"),
        (name("M", 1, 1, 1, 1, 1).replace("_1.avi", "_0000000001.avi"), "not named as SKIG"),
        ("M_person_1\n.avi", "not named as SKIG"),
        (name("M", 1, 1, 1, 1, 1).replace("_1.avi", "_01.avi"), "says the same as"),
    ],
)
def test_a_name_that_does_not_follow_is_refused_with_the_file(root: Path, video: str, message: str) -> None:
    (root / "subject1_rgb" / video).touch()
    with pytest.raises(FormatError, match=message) as caught:
        Dataset.load(root)
    assert "subject1_rgb" in str(caught.value)


def test_a_stream_that_is_not_there_is_named(root: Path) -> None:
    with pytest.raises(InvalidArgument, match="'depth'"):
        load_skig(root, "depth")
    for path in list(root.rglob("*_rgb/*")):
        path.unlink()
    with pytest.raises(FormatError, match="subject1_rgb"):
        Dataset.load(root)


def test_training_and_evaluation_know_persons_and_conditions(hri: Any, tmp_path: Path) -> None:
    from test_watching_movements import FPS, clip

    for person in (1, 2):
        folder = tmp_path / f"subject{person}_rgb"
        folder.mkdir()
        for gesture, movement in ((3, "up"), (4, "right")):
            for illumination in (1, 2):
                video = name("M", person, 1, illumination, 3, gesture)
                write_video(folder / video, clip(movement, 10 * person + illumination), FPS)
    model = tmp_path / "skig.hri"
    trained = hri("train", "gesture", "--data", tmp_path, "--out", model)
    assert trained.code == 0, trained.err
    shown = tmp_path / "subject1_rgb" / name("M", 1, 1, 1, 3, 3)
    assert "up-down" in hri("recognise", "--gesture", shown, "--gesture-model", model).out
    evaluated = hri("evaluate", "gesture", "--data", tmp_path, "--leave-out", "illumination")
    assert evaluated.code == 0 and "dark" in evaluated.out and "light" in evaluated.out, evaluated.err
    assert "person1" in hri("evaluate", "gesture", "--data", tmp_path).out
    assert hri("evaluate", "gesture", "--data", tmp_path, "--leave-out", "weather").code != 0
    refused = hri("evaluate", "gesture", "--data", tmp_path, "--leave-out", "pose", "--folds", "2")
    assert "--leave-out goes without" in refused.err
