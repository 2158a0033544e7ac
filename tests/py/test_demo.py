# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The demo from end to end, and what it must not do."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from hri.cli.demo import MADE, MARKER, _prepare
from hri.cli.main import main
from hri.datasets import Dataset
from hri.demo.scenes import SCRIPTS
from hri.media import read_frames


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a quick demo."""
    folder = tmp_path_factory.mktemp("demo") / "out"
    assert main(["demo", "--quick", "--backend", "kinematic", "--out", str(folder)]) == 0
    return folder


@pytest.mark.slow
def test_page_holds_everything_and_links_nowhere(made: Path) -> None:
    page = (made / "index.html").read_text()
    assert re.findall(r'(?:src|href)="(?!data:)', page) == []
    assert re.findall(r"\$[a-z]\w*", re.sub(r"base64,[^\"]*", "", page)) == []  # a place that was not filled
    for kind, count in (("video/webm", 1), ("image/png", len(SCRIPTS) + 1), ("audio/wav", len(SCRIPTS))):
        assert page.count(f"data:{kind};base64,") == count
    assert "synthetic" in page


@pytest.mark.slow
def test_film_shows_every_scene(made: Path) -> None:
    clip = read_frames(made / "signer_and_robot.webm")
    assert len(clip.frames) > 60 * len(SCRIPTS)
    assert clip.frames[0].shape == (396, 800, 3)
    right = [frame[40:340, 400:].astype(float) for frame in clip.frames]
    assert max(abs(image - right[0]).mean() for image in right) > 1  # the robot has moved


@pytest.mark.slow
def test_result_tells_decisions_and_stop_wins(made: Path) -> None:
    result = json.loads((made / "result.json").read_text())
    assert result["synthetic"] is True
    assert [scene["title"] for scene in result["scenes"]] == [script.title for script in SCRIPTS]
    stop = result["scenes"][2]
    assert stop["title"] == "STOP wins" and stop["signed"] == "5"
    assert stop["succeeded"] and stop["decision"]["rule"] == "stop: recognised in speech"
    assert result["words"]["accuracy_mean"] >= 0.7 and result["signs"]["accuracy_mean"] >= 0.7
    for name, kind in (("spoken", "speech"), ("signed", "gesture")):
        dataset = Dataset.load(made / "corpus" / name, kind)
        assert dataset.synthetic and len(dataset.persons) >= 3


@pytest.mark.slow
def test_scenes_can_be_recognised_from_their_files(made: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene, models = made / "scenes" / "scene1", made / "models"
    arguments = ["recognise", "--speech", f"{scene}.wav", "--gesture", f"{scene}.mp4", "--json", "-"]
    arguments += ["--speech-model", str(models / "speech.hri"), "--gesture-model", str(models / "gesture.hri")]
    capsys.readouterr()
    assert main(arguments) == 0
    reported = json.loads(capsys.readouterr().out)
    played = json.loads((made / "result.json").read_text())["scenes"][0]["decision"]
    assert reported["speech"]["label"] == played["speech"]["label"]


@pytest.mark.slow
def test_second_demo_replaces_the_first(made: Path) -> None:
    (made / "scenes" / "old.txt").touch()
    assert main(["demo", "--quick", "--backend", "kinematic", "--seed", "1", "--out", str(made)]) == 0
    assert not (made / "scenes" / "old.txt").exists()
    assert json.loads((made / "result.json").read_text())["seed"] == 1


def test_a_folder_of_somebody_else_is_left_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "thesis.txt").write_text("mine")
    assert main(["demo", "--out", str(tmp_path)]) == 3
    assert "not made by the demo" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.txt"]
    assert MARKER.startswith(".")


def test_only_what_the_demo_made_is_removed(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    _prepare(folder)
    for name in MADE:
        (folder / name).mkdir() if "." not in name else (folder / name).touch()
    (folder / "corpus" / "old.wav").touch()
    (folder / "notes.txt").write_text("mine")
    _prepare(folder)
    assert sorted(path.name for path in folder.iterdir()) == [MARKER, "notes.txt"]


def test_what_is_missing_is_said_before_the_work(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))  # without espeak-ng
    assert main(["demo", "--out", str(tmp_path / "out")]) == 3
    assert "install the package espeak-ng" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
