# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a command reads it never writes over, and an option that would have no effect is refused: exit code 2, first."""

from __future__ import annotations

import json
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

from conftest import RATE_HZ, tone_word
from hri import _native
from session_people import train_words


@pytest.fixture
def said(tmp_path: Path) -> Path:
    path = tmp_path / "said.wav"
    _native.write_wav_pcm16(str(path), tone_word(180.0, 800.0, 1), RATE_HZ)
    return path


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("model") / "words.hri"
    train_words().save(path)
    return path


@pytest.mark.parametrize(
    "arguments",
    [
        ("recognise", "--speech-model", "MODEL", "SAID", "--json", "SAID"),
        ("recognise", "--speech-model", "MODEL", "SAID", "--json", "MODEL"),
        ("recognise", "--speech-model", "MODEL", "--speech", "SAID", "--json", "LINK"),
        ("denoise", "SAID", "SAID"),
        ("train", "speech", "--data", "FOLDER", "--out", "SAID"),
        ("train-connected", "--data", "FOLDER", "--out", "SAID"),
        ("adapt", "--model", "MODEL", "-o", "SAID", "SAID"),
        ("add-word", "--model", "MODEL", "--label", "new", "SAID", "-o", "SAID"),
        ("recognise", "--speech-model", "MODEL", "SAID", "--json", "a.png", "--robot", "a.png"),
    ],
    ids=" ".join,
)
def test_what_is_read_is_not_written_over(hri, arguments: tuple[str, ...], said: Path, model: Path) -> None:
    link = said.parent / "link.json"
    link.symlink_to(said)
    places = {"SAID": said, "MODEL": model, "FOLDER": said.parent, "LINK": link, "a.png": said.parent / "a.png"}
    before = said.read_bytes(), model.read_bytes()
    done = hri(*(places.get(argument, argument) for argument in arguments))
    assert done.code == 2, done.err
    assert any(why in done.err for why in ("would be written over", "which is read", "are both")), done.err
    assert (said.read_bytes(), model.read_bytes()) == before


def test_a_motion_is_not_written_over_itself_and_a_log_is_no_motion(hri, tmp_path: Path) -> None:
    path = tmp_path / "wave.csv"
    assert hri("robot", "convert", "wave", path).code == 0
    before = path.read_bytes()
    for arguments in (("convert", path, path), ("check", path, "--repair", path), ("play", "wave", "--log", path)):
        assert hri("robot", *arguments).code == 2
    assert path.read_bytes() == before


def test_a_model_may_be_written_anew(hri, model: Path, said: Path) -> None:
    kept = said.parent / "kept.hri"
    kept.write_bytes(model.read_bytes())
    done = hri("add-word", "--model", kept, "-o", kept, "--label", "new", said)
    assert done.code == 0 and " labels: " in done.err
    assert kept.read_bytes() != model.read_bytes()


def test_a_model_that_is_adapted_stays(hri, model: Path, said: Path) -> None:
    kept = said.parent / "data" / "hri" / "speech.hri"  # which is the default, too
    kept.parent.mkdir(parents=True)
    kept.write_bytes(model.read_bytes())
    for given in (("--model", kept), ()):
        done = hri("adapt", *given, "-o", kept, "--label", "flat", said)
        assert done.code == 2 and f"{kept} is" in done.err
    assert kept.read_bytes() == model.read_bytes()


def test_a_text_that_no_file_could_have_as_its_name_is_none(hri, model: Path, said: Path) -> None:
    kept = said.parent / "kept.hri"
    kept.write_bytes(model.read_bytes())
    done = hri("add-word", "--model", kept, "-o", kept, "--label", "long" * 200, said)
    assert done.code == 0, done.err


def test_where_nothing_is_learned_no_model_is_written(hri, model: Path, tmp_path: Path) -> None:
    silence = tmp_path / "silence.wav"
    _native.write_wav_pcm16(str(silence), np.zeros(RATE_HZ, np.float32), RATE_HZ)
    done = hri("adapt", "--model", model, "-o", tmp_path / "mine.hri", silence)
    assert done.code == 3 and "silence.wav: there is no word to learn from" in done.err
    assert not (tmp_path / "mine.hri").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("listen", "SAID", "--stall", "3"), "--stall is of a microphone"),
        (("listen", "SAID", "--device", "3"), "--device is of a microphone"),
        (("listen", "SAID", "--always", "stop"), "--always goes with --wake"),
        (("listen", "--paced"), "--paced is of recordings"),
        (
            ("record", "word", "a", "--person", "p", "--out", "FOLDER", "--from", "SAID", "--device", "9"),
            "--device is of a microphone",
        ),
        (
            ("record", "word", "a", "--person", "p", "--out", "FOLDER", "--from", "SAID", "--stall", "3"),
            "--stall is of a microphone",
        ),
        (
            ("record", "gesture", "a", "--person", "p", "--out", "FOLDER", "--from", "SAID", "--device", "9"),
            "--device is of a camera",
        ),
        (
            ("record", "gesture", "a", "--person", "p", "--out", "FOLDER", "--from", "SAID", "--stall", "3"),
            "--stall is of a camera",
        ),
        (("watch", "SAID", "--reconnect", "3"), "--reconnect is of a camera"),
        (("transcribe", "SAID", "--wake", "stop"), "--wake goes with --stream"),
        (("transcribe", "SAID", "--times", "--alternatives", "2"), "exclude each other"),
        (("read-sentences", "SAID", "--max-distance", "0.1"), "--max-distance goes with --knowledge"),
        (("denoise", "SAID", "a.wav", "--approximation", "1", "--shape", "hard"), "--shape is of shrinkage"),
        (("robot", "convert", "wave", "a.tsv", "--short"), "--short is a form of .csv"),
        (("robot", "render", "wave", "a.png"), "say of which moment by --still"),
        (("robot", "render", "wave", "a.mp4", "--fps", "nan"), "nan is not a finite number"),
        (("recognise", "--gesture", "SAID", "--speech-model", "SAID"), "--speech-model is of speech"),
        (("recognise", "SAID", "--gesture-model", "SAID"), "--gesture-model is of signs"),
        (("recognise", "SAID", "--rule", "product"), "--rule is for a word and a sign together"),
        (("recognise", "SAID", "--fusion", "SAID"), "--fusion is for a word and a sign together"),
        (
            ("recognise", "SAID", "--gesture", "SAID", "--fusion", "SAID", "--rule", "product"),
            "--rule and --fusion exclude each other",
        ),
        (("recognise", "SAID", "--backend", "kinematic"), "--backend goes with --robot or --gui"),
        (("features", "sign.jpg", "--preset", "kaldi"), "--preset is of sound"),
        (("add-word", "--model", "MODEL", "--label", "a", "--language", "hi", "SAID"), "--language is for models from"),
        (("corpus", "speech", "--out", "made", "--seed", "-1"), "--seed"),
        (("corpus", "gesture", "--out", "made", "--seed", "-1"), "--seed"),
        (("corpus", "sentences", "--out", "made", "--seed", "-1"), "--seed"),
        (("--threads", "9999999999", "info"), "--threads"),
        (("add-word", "--label", "a\nb", "SAID"), "break lines"),
        (("add-word", "--label", "a", "--spelling", " "), "--spelling is empty"),
        (
            ("train", "speech", "--data", "FOLDER", "--front-end", "both", "--option", "front_end=cepstra"),
            "--front-end and --option front_end=... exclude each other",
        ),
        (
            ("train", "speech", "--data", "FOLDER", "--seed", "3", "--option", "seed=5"),
            "--seed and --option seed=... exclude each other",
        ),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else "",
)
def test_what_has_no_effect_is_refused(hri, arguments: tuple[str, ...], message: str, said: Path, model: Path) -> None:
    picture = said.parent / "sign.jpg"
    picture.touch()
    places = {"SAID": said, "FOLDER": said.parent, "MODEL": model, "sign.jpg": picture}
    done = hri(*(places.get(argument, argument) for argument in arguments))
    assert done.code == 2 and message in done.err, done.err


@pytest.mark.parametrize("name", ["-", "/dev/stdout", "/dev/fd/1", "LINK"])
def test_standard_output_is_written_on_where_it_is_a_file(name: str, tmp_path: Path) -> None:
    """A file that took the place of what the shell has opened would lose what stands before and comes after."""
    (tmp_path / "LINK").symlink_to("/dev/stdout")
    hri = (sys.executable, "-m", "hri", "options", "speech", "--json", name)
    with (tmp_path / "log").open("wb") as log:
        log.write(b"first\n")
        log.flush()
        subprocess.run(hri, stdout=log, check=True, cwd=tmp_path)
        subprocess.run(("echo", "last"), stdout=log, check=True)
    text = (tmp_path / "log").read_text()
    assert text.startswith("first\n") and text.endswith("\nlast\n")
    assert json.loads(text.removeprefix("first\n").removesuffix("last\n"))["kind"] == "speech"


@pytest.mark.parametrize("name", ["/dev/stderr", "/dev/fd/2", "/proc/self/fd/2", "/proc/thread-self/fd/2"])
def test_other_streams_are_no_files(name: str, tmp_path: Path) -> None:
    hri = (sys.executable, "-m", "hri", "options", "speech", "--json", name)
    with (tmp_path / "log").open("wb") as log:
        done = subprocess.run(hri, stdout=subprocess.DEVNULL, stderr=log, check=False)
    assert done.returncode == 2
    assert f"'{name}' cannot be written: it is a stream; name a file, or - for" in (tmp_path / "log").read_text()


def test_a_model_is_no_stream(hri, said: Path, model: Path) -> None:
    done = hri("adapt", "--model", model, "-o", "/dev/stdout", "--label", "new", said)
    assert done.code == 2 and "'/dev/stdout' cannot be written: it is a stream; name a file (see" in done.err


def test_without_standard_error_there_are_no_bars(
    hri, said: Path, model: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from hri.cli.progress import progress_bars

    monkeypatch.setattr(sys, "stderr", None)
    with progress_bars() as progress:
        progress("training", 1, 2)


@pytest.mark.parametrize("kind", ["connected", "units", "sentences"])
def test_options_of_every_recogniser_are_listed(hri, kind: str) -> None:
    done = hri("options", kind)
    assert done.code == 0 and len(done.out.splitlines()) > 10


def test_a_header_is_not_named_by_a_word_of_the_language(hri, model: Path, tmp_path: Path) -> None:
    done = hri("export", model, "-o", tmp_path / "class.hpp")
    assert done.code == 0 and "class_model()" in (tmp_path / "class.hpp").read_text()
    assert hri("export", model, "-o", tmp_path / "a.hpp", "--name", "new").code == 2


def test_a_plot_takes_names_in_hindi_and_names_that_are_no_text(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    pytest.importorskip("matplotlib")
    from hri.core.plotting import new_axes, save_figure

    axes = new_axes((3.0, 2.0))
    axes.set_title("घर")
    axes.set_xlabel("bad\udcff name")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        save_figure(axes.figure, tmp_path / "a.png")
    assert (tmp_path / "a.png").stat().st_size > 1000
    assert axes.get_xlabel() == "bad\ufffd name"
    families = axes.title.get_fontfamily()
    assert len(families) > 1 or "no font for Devanagari" in caplog.text


def test_a_data_set_that_cannot_be_made_leaves_no_folder(hri, tmp_path: Path) -> None:
    failed = hri("corpus", "speech", "go", "--language", "zz", "--out", tmp_path / "none")
    assert failed.code == 3 and not (tmp_path / "none").exists()


def test_a_film_of_what_is_watched_may_be_in_a_folder_that_is_new(tmp_path: Path) -> None:
    pytest.importorskip("cv2")
    from hri.cli.result_screen import ResultScreen

    with ResultScreen(str(tmp_path / "new" / "folder" / "seen.mp4"), 15.0, False, 3):
        assert (tmp_path / "new" / "folder").is_dir()
