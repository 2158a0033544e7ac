# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Small synthetic corpora that several test files use."""

from __future__ import annotations

import os
import re
import signal
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from hri.io import write_wav_pcm16
from hri.recognition import FillerWord, GestureRecognizer, WordRecognizer
from hri.recognition.sentence import recognizer as sentence_recognizer
from hri.recognition.word import embedding_filler_words, filler_words, recognizer
from hri.synthetic.signer import make_gesture_corpus
from hri.training import train

pytest.register_assert_rewrite("serving", "browsing")  # plugins of some test files, which import them, too

RATE_HZ = 16000
WAIT_S = 60.0
"""For what another thread does: also on a machine that is much slower than usual, where any thread may be late."""
NO_SKIPS = "HRI_NO_SKIPS"
"""Set where all that `./run test` installs is there: what is skipped for want of it fails, or it would go unseen."""
MUST_BE_THERE = re.compile(
    r"could not import '(?!qi')|no pybullet|espeak-ng|chromium|sclite|ros-core|liburdfdom-tools|mypy|no CMake build"
)
"""Reasons to skip that then fail: Python packages, but for the one without wheels everywhere, programs and builds."""
PERSONS = {"low": 500.0, "middle": 550.0, "high": 600.0}


def until(holds: Callable[[], Any]) -> None:
    """Wait for what another thread does."""
    until_s = time.monotonic() + WAIT_S
    while not holds():
        assert time.monotonic() < until_s, "it did not come"
        time.sleep(0.01)


def tone_word(base_hz: float, slope_hz_per_s: float, seed: int) -> NDArray[np.float32]:
    """A gliding tone between pauses, with a little noise: the shortest thing that is recognised as a word."""
    rng = np.random.default_rng(seed)
    time_s = np.arange(RATE_HZ // 2) / RATE_HZ
    tone = 0.3 * np.sin(2 * np.pi * (base_hz * time_s + 0.5 * slope_hz_per_s * time_s**2))
    pause = np.zeros(RATE_HZ // 4)
    clip = np.concatenate([pause, tone, pause])
    return (clip + 0.001 * rng.standard_normal(len(clip))).astype(np.float32)


@pytest.fixture(autouse=True)
def ctrl_c_interrupts() -> Iterator[None]:
    """Python's own handler, also where the tests were started in the background and SIGINT is ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="session")
def spoken(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of tones that stand for the words 1 (rising) and 2 (falling), three persons, three takes."""
    folder = tmp_path_factory.mktemp("spoken")
    for number, (person, base_hz) in enumerate(PERSONS.items()):
        for take in range(3):
            for label, slope in (("1", 800.0), ("2", -350.0)):
                path = folder / f"{label}_{person}_{take}.wav"
                write_wav_pcm16(str(path), tone_word(base_hz, slope, 10 * number + take), RATE_HZ)
    return folder


@pytest.fixture(scope="session")
def word_model(spoken: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A recogniser of `spoken` by cepstra and without filler words, for those who only use one."""
    path = tmp_path_factory.mktemp("model") / "words.hri"
    train(spoken, WordRecognizer(num_vtlp_factors=1, num_noisy_copies=1), fillers=()).save(path)
    return path


@pytest.fixture(scope="session")
def sign_model(signed: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A recogniser of `signed`."""
    path = tmp_path_factory.mktemp("model") / "signs.hri"
    train(signed, GestureRecognizer()).save(path)
    return path


@pytest.fixture(scope="session")
def signed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of drawn stills of the signs 1 and 2 by four persons."""
    folder = tmp_path_factory.mktemp("signed")
    make_gesture_corpus(folder, labels=("1", "2"), num_persons=4, seed=1)
    return folder


class CommandResult:
    """What a run of the command line gave."""

    def __init__(self, code: int, out: str, err: str) -> None:
        self.code, self.out, self.err = code, out, err


QUICK = ("--front-end", "cepstra", "--no-fillers", "--no-network")
"""For ``hri train speech``: a twentieth of the time, where how well words are recognised does not matter."""


@pytest.fixture
def hri(capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    """Runs the command line in this process; the user's data folder is a temporary one."""
    from hri.cli.main import main

    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.delenv("HRI_DATA", raising=False)

    def run(*arguments: object) -> CommandResult:
        capfd.readouterr()
        code = main([str(argument) for argument in arguments])
        out, err = capfd.readouterr()
        assert "Traceback" not in err
        return CommandResult(code, out, err)

    return run


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Tests marked `data` need the folder of recordings that HRI_DATA names."""
    if os.environ.get("HRI_DATA"):
        return
    for item in items:
        if item.get_closest_marker("data"):
            item.add_marker(pytest.mark.skip(reason="HRI_DATA names no folder of recordings"))


def no_skip(report: pytest.CollectReport | pytest.TestReport) -> None:
    """What is skipped for want of something that must be there fails, where `NO_SKIPS` is set."""
    if not os.environ.get(NO_SKIPS) or not report.skipped or hasattr(report, "wasxfail"):
        return
    reason = report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr)
    if MUST_BE_THERE.search(reason):
        report.outcome = "failed"
        report.longrepr = f"{report.nodeid}: {NO_SKIPS} is set. {reason}"


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport() -> Iterator[None]:
    outcome = yield
    no_skip(outcome.get_result())


@pytest.hookimpl(hookwrapper=True)
def pytest_make_collect_report() -> Iterator[None]:
    outcome = yield
    no_skip(outcome.get_result())


def robot_data(name: str) -> Path:
    """A factory motion in the folder that HRI_ROBOT_DATA names; without it the test is skipped."""
    folder = os.environ.get("HRI_ROBOT_DATA")
    if not folder:
        pytest.skip("HRI_ROBOT_DATA names no folder of factory motions")
    return Path(folder) / name


def three_fillers() -> tuple[FillerWord, ...]:
    """All takes of three of the words that stand for those outside a vocabulary."""
    labels = sorted({word.label for word in filler_words()})[:3]
    return tuple(word for word in filler_words() if word.label in labels)


@pytest.fixture(scope="module")
def few_fillers() -> Iterator[None]:
    """Training with three filler words, and three for an embedding: more take most of its time where words are few."""
    with pytest.MonkeyPatch.context() as patch:
        few = three_fillers()
        patch.setattr(recognizer, "filler_words", lambda: few)
        patch.setattr(sentence_recognizer, "filler_words", lambda: few)
        patch.setattr(recognizer, "embedding_filler_words", lambda: embedding_filler_words()[:3])
        yield


@pytest.fixture(scope="module")
def few_copies() -> Iterator[None]:
    """Training with one copy of every word, where no number is asked for: it takes half the time."""
    make = WordRecognizer.__init__

    def made(self: WordRecognizer, **options: Any) -> None:
        make(self, **{"num_noisy_copies": 1, "num_embedding_copies": 1, "num_vtlp_factors": 1, **options})

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(WordRecognizer, "__init__", made)
        yield
