# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words that are added at the page while a grammar of commands is in use."""

from __future__ import annotations

import io
import shutil
import zipfile
from collections import Counter
from collections.abc import Iterator
from copy import copy
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("serving")

from conftest import RATE_HZ
from hri import CommandRecognizer
from hri.core.errors import InvalidArgument
from hri.datasets import Dataset
from hri.io import SpokenWords
from hri.language import Grammar
from hri.media import Audio
from hri.recognition import ConnectedWordRecognizer
from hri.robot import Robot
from hri.serve import PageServer, Stage
from hri.serve.command_teacher import CommandWordTeacher
from hri.serve.samples import samples_zip
from hri.session import SessionOptions
from page_people import connected, request
from serving import LIMITS, answer, own_origin
from test_commands import GRAMMAR, OPTIONS, tones

pytest_plugins = ("serving",)
pytestmark = pytest.mark.usefixtures("few_fillers")

HUM = "#JSGF V1.0;\ngrammar hum;\npublic <command> = hum {gesture=up} {side=left} | 2 1 {gesture=up} {side=right};\n"


@pytest.fixture(scope="module")
def recordings(spoken: Path) -> Dataset:
    return Dataset.load(spoken)


def trained(recordings: Dataset, **options: Any) -> ConnectedWordRecognizer:
    samples = recordings.samples
    return ConnectedWordRecognizer(**OPTIONS, **options).fit(
        [s.path for s in samples], [s.label for s in samples], groups=[s.person for s in samples]
    )


@pytest.fixture(scope="module")
def model(recordings: Dataset) -> ConnectedWordRecognizer:
    return trained(recordings, unknown_words=True)


@pytest.fixture
def stage(model: ConnectedWordRecognizer, recordings: Dataset, robot: Robot) -> Iterator[Stage]:
    commands = CommandRecognizer(model, Grammar.parse(GRAMMAR, "tones"))
    options = SessionOptions(confirm_below=0.0, retry_s=0.2)
    made = Stage(commands, None, robot, options, limits=LIMITS, recordings=recordings.samples)
    yield made
    made.close()


def hum(take: float, rest_s: float = 0.25, base_hz: float = 1500) -> np.ndarray:
    """A tone that is higher than those of the words 1 and 2."""
    rng = np.random.default_rng(round(10 * take))
    time_s = np.arange(RATE_HZ // 2) / RATE_HZ
    quiet = np.zeros(round(rest_s * RATE_HZ))
    said = np.concatenate([quiet, 0.2 * np.sin(2 * np.pi * (base_hz + 20 * take) * time_s), quiet])
    return (said + 0.001 * rng.standard_normal(len(said))).astype("f4")


def test_a_word_is_added_written_into_the_commands_and_undone(
    server: PageServer, cookie: str, stage: Stage, model: ConnectedWordRecognizer, tmp_path: Path
) -> None:
    def use(grammar: str) -> None:
        assert request(server, "/grammar", cookie, "POST", grammar.encode(), Origin=own_origin(server))[0] == 200

    with connected(server, cookie) as page:
        welcome = page.messages[0]
        assert welcome["teach"] == ["speech"] and welcome["made_of"] == ["1", "2"]
        page.say(type="teach", label="2", mode="speech")
        answer(page, "“2” is a word already")
        page.say(type="teach", label="hum", mode="speech")
        answer(page, "3 times")
        for take in range(3):
            page.say(type="sample", mode="speech")
            answer(page, "Speak now")
            page.perform(hum(take, 1.0))
            answer(page, f"Sample {take + 1} of 3." if take < 2 else "step 1 of 4")
        added = answer(page, "“hum” is added.")
        assert added["text"].endswith("Write it into the commands to use it.") and added["confused"] == []
        renewed = [m for m in page.messages if m["type"] == "welcome"][-1]
        assert renewed["made_of"] == ["1", "2", "hum"] and renewed["words"] == welcome["words"]
        use(HUM)
        page.say(type="undo", mode="speech")
        answer(page, "not trained on: hum")  # while the commands have it
        assert page.command("fused", hum(0.7, 1.5), final="hum")["slots"] == {"gesture": "up", "side": "left"}
        page.await_event("motion_start", label="hum")
        page.await_event("motion_end", label="hum")
        (tmp_path / "words.hri").write_bytes(request(server, "/words.hri", cookie)[2])
        archive = request(server, "/samples.zip", cookie)
        kept = ConnectedWordRecognizer.load(tmp_path / "words.hri")
        assert list(kept.classes_) == ["1", "2", "hum"] and kept.insertion_penalty == model.insertion_penalty
        assert renewed["has_samples"] and not welcome["has_samples"] and archive[0] == 200
        use(GRAMMAR)
        page.say(type="undo", mode="speech")
        answer(page, "“hum” is removed")
    assert isinstance(stage.words, CommandRecognizer) and list(stage.words.words.classes_) == ["1", "2"]
    assert stage.words.recognise(tones("2 1"), RATE_HZ).label == "2 1"
    assert request(server, "/samples.zip", cookie)[0] == 404 and request(server, "/samples.zip", "")[0] == 403
    with zipfile.ZipFile(io.BytesIO(archive[2])) as packed:
        packed.extractall(tmp_path / "samples")
    more = Dataset.load(tmp_path / "samples", "speech").samples
    assert [(s.label, s.person, s.take) for s in more] == [("hum", "page", str(take)) for take in (1, 2, 3)]
    commands = CommandRecognizer(kept, Grammar.parse(HUM, "hum"))  # to which words may be added again
    Stage(commands, limits=LIMITS, recordings=[*stage.recordings, *more]).close()


def test_words_that_are_alike_are_named_both_ways(stage: Stage) -> None:
    messages: list[dict[str, Any]] = []
    stage.publish = messages.append
    teacher = CommandWordTeacher(stage)
    for label in ("hum", "buzz"):
        teacher.obey({"type": "teach", "label": label})
        for take in range(3):
            teacher._keep(Audio(hum(take), RATE_HZ))
    first, second = (m for m in messages if "is added" in m.get("text", ""))
    assert first["confused"] == [] and second["added"] == ["hum", "buzz"]
    assert "may be confused with “hum”" in second["text"]
    (found,) = second["confused"]
    assert found["label"] == "hum" and found["samples"] + found["samples_of_other"] >= 3


def test_voices_say_an_added_word_as_others_do(stage: Stage) -> None:
    asked: list[str] = []

    def speak(word: str) -> tuple[list[Audio], list[str], list[str]]:
        asked.append(word)
        clips = [Audio(hum(take, base_hz=900), RATE_HZ) for take in range(4)]
        return clips, [word] * 4, [f"voice{take}" for take in range(4)]

    found = []
    for stage.speak in (None, speak):
        teacher = CommandWordTeacher(stage)
        teacher.obey({"type": "teach", "label": "hum"})
        for take in range(3):
            teacher._keep(Audio(hum(take), RATE_HZ))
        assert isinstance(stage.words, CommandRecognizer)
        found.append([stage.words.words.recognise(hum(7, base_hz=hz), RATE_HZ, num_words=1).text for hz in (1500, 900)])
        teacher._undo()
    assert found == [["hum", found[0][1]], ["hum", "hum"]] and found[0][1] != "hum"
    assert asked == ["hum"]  # once for all trainings


def test_words_of_synthetic_voices_are_said_again_in_training(recordings: Dataset, robot: Robot) -> None:
    asked: list[int] = []

    def say_again() -> tuple[list[Audio], list[str], list[str]]:
        asked.append(1)
        return [Audio(hum(take, base_hz=3000), RATE_HZ) for take in range(4)], ["beep"] * 4, list("abcd")

    clips, labels, voices = say_again()
    samples = recordings.samples
    words = ConnectedWordRecognizer(**OPTIONS, unknown_words=True).fit(
        [*(s.path for s in samples), *clips],
        [*(s.label for s in samples), *labels],
        groups=[*(s.person for s in samples), *voices],
    )
    commands = CommandRecognizer(words, Grammar.parse(GRAMMAR, "tones"))
    with pytest.raises(InvalidArgument, match="no recordings are there of words that the model knows: beep"):
        Stage(commands, recordings=samples)
    with pytest.raises(InvalidArgument, match="words that the model does not know: high"):
        Stage(commands, recordings=samples, spoken=say_again, spoken_labels=["beep", "high"])
    with pytest.raises(InvalidArgument, match="spoken words go with recordings"):
        Stage(commands, spoken=say_again, spoken_labels=["beep"])
    asked.clear()
    stage = Stage(commands, None, robot, limits=LIMITS, recordings=samples, spoken=say_again, spoken_labels=["beep"])
    try:
        teacher = CommandWordTeacher(stage)
        for label, base_hz in (("hum", 1500.0), ("whistle", 2200.0)):
            teacher.obey({"type": "teach", "label": label})
            for take in range(3):
                teacher._keep(Audio(hum(take, base_hz=base_hz), RATE_HZ))
        assert isinstance(stage.words, CommandRecognizer)
        more = stage.words.words
        assert [str(label) for label in more.classes_] == ["1", "2", "beep", "hum", "whistle"]
        assert more.recognise(hum(5, base_hz=3000), RATE_HZ, num_words=1).text == "beep"
        assert more.recognise(hum(5), RATE_HZ, num_words=1).text == "hum"
        assert len(asked) == 1  # once for all trainings
        kept = Counter((label, person) for _, label, person in teacher.samples())
        assert kept["hum", "page"] == kept["whistle", "page"] == 3 and kept["beep", "synthetic-a"] == 1
        assert len(zipfile.ZipFile(io.BytesIO(samples_zip(teacher.samples()))).namelist()) == 11  # and the manifest
    finally:
        stage.close()


def test_samples_of_any_label_are_downloaded(tmp_path: Path) -> None:
    labels = ["ready?", "ready*", "12:30", "C*", "../up", "a/b", ".hidden", "...", "con “x”", "नमस्ते", "Ready_", "a\\b"]
    packed = samples_zip([(Audio(hum(0), RATE_HZ), label, "page") for label in labels for _ in range(2)])
    with zipfile.ZipFile(io.BytesIO(packed)) as archive:
        names = archive.namelist()
        archive.extractall(tmp_path)
    assert not [name for name in names if set(name) & set('\\:*?"<>|') or name.startswith(".") or name.count("/") > 1]
    assert len({name.casefold() for name in names}) == len(names) == 2 * len(labels) + 1
    kept = Dataset.load(tmp_path, "speech").samples
    assert Counter((s.label, s.person) for s in kept) == {(label, "page"): 2 for label in labels}


def test_what_adding_words_needs_is_said(
    hri: Any, model: Any, recordings: Dataset, spoken: Path, words: Any, tmp_path: Path
) -> None:
    grammar = Grammar.parse(GRAMMAR, "tones")
    with pytest.raises(InvalidArgument, match="only to add words to commands"):
        Stage(words, recordings=recordings.samples)
    with pytest.raises(InvalidArgument, match="unknown_words=true"):
        Stage(CommandRecognizer(trained(recordings, choose_penalty=False), grammar), recordings=recordings.samples)
    commands = CommandRecognizer(model, grammar)
    ones = [sample for sample in recordings.samples if sample.label == "1"]
    with pytest.raises(InvalidArgument, match="no recordings are there of words that the model knows: 2"):
        Stage(commands, recordings=ones)
    threes = [replace(sample, label="3") for sample in ones]
    with pytest.raises(InvalidArgument, match="words that the model does not know: 3"):
        Stage(commands, recordings=[*recordings.samples, *threes])
    model.save(tmp_path / "words.hri")
    (tmp_path / "g.jsgf").write_text(GRAMMAR)
    given = ("--no-gesture", "--backend", "none", "--speech-model", tmp_path / "words.hri")
    sideways = SpokenWords("en", {"sideways": "sideways"}, 2)
    sideways.write_beside(tmp_path / "words.hri")
    result = hri("serve", *given, "--grammar", tmp_path / "g.jsgf", "--speech-data", spoken)
    assert result.code == 3 and "does not know: sideways" in result.err
    copy(model).set_decoder(insertion_penalty=-3.0).save(tmp_path / "words.hri")  # another model of the same name
    result = hri("serve", *given, "--grammar", tmp_path / "g.jsgf", "--speech-data", spoken)
    assert result.code == 3 and "words.hri.spoken.json: belongs to another model" in result.err
    SpokenWords.remove_beside(tmp_path / "words.hri")
    for more, code, message in (
        (("--speech-data", spoken), 2, "--speech-data goes with --grammar"),
        (("--grammar", tmp_path / "g.jsgf", "--voice", "en"), 2, "--voice goes with --speech-data"),
        (("--grammar", tmp_path / "g.jsgf", "--speech-data", tmp_path), 3, "no speech recordings"),
        (("--grammar", tmp_path / "g.jsgf", "--speech-data", tmp_path / "gone"), 2, "gone"),
    ):
        result = hri("serve", *given, *more)
        assert result.code == code and message in result.err, result.err


@pytest.mark.skipif(shutil.which("espeak-ng") is None, reason="espeak-ng is not installed")
def test_a_voice_that_is_not_there_is_refused_at_the_start(
    hri: Any, model: Any, spoken: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(PageServer, "run", lambda self: None)
    model.save(tmp_path / "words.hri")
    (tmp_path / "g.jsgf").write_text(GRAMMAR)
    given = ("--no-gesture", "--backend", "none", "--port", "0", "--speech-model", tmp_path / "words.hri")
    given += ("--grammar", tmp_path / "g.jsgf", "--speech-data", spoken)
    result = hri("serve", *given, "--voice", "xx")
    assert result.code == 3 and "espeak-ng refuses voice 'xx" in result.err
    assert hri("serve", *given, "--voice", "hi").code == 0
