# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a recogniser may be given: files, what was read of them, arrays; and what it says of anything else."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from copy import copy
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from sklearn.model_selection import cross_val_score

import hri
from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.io import write_wav_pcm16
from hri.media import Audio, read_audio, read_frames, read_image
from hri.recognition import inputs
from hri.recognition.inputs import as_audio, as_frames


@pytest.fixture(scope="module")
def words(spoken: Path) -> hri.WordRecognizer:
    paths = sorted(spoken.glob("*.wav"))
    return hri.WordRecognizer(num_noisy_copies=0, num_vtlp_factors=1).fit(paths, [p.name[0] for p in paths], fillers=[])


@pytest.fixture(scope="module")
def signs(signed: Path) -> hri.GestureRecognizer:
    paths = sorted(signed.glob("*/*"))
    return hri.GestureRecognizer().fit(paths, [p.parent.name for p in paths])


def test_a_word_is_recognised_from_whatever_holds_it(words: hri.WordRecognizer, spoken: Path) -> None:
    path = spoken / "1_low_0.wav"
    audio = read_audio(path)
    expected = words.recognise(audio.samples, audio.sample_rate_hz)
    assert expected.nbest[0].label == "1"
    for given in (path, str(path), audio):
        assert words.recognise(given) == expected
    assert words.recognise(list(audio.samples), audio.sample_rate_hz) == expected
    pcm16 = words.recognise(np.round(audio.samples * 32768).astype(np.int16), audio.sample_rate_hz)
    assert pcm16.nbest == expected.nbest and pcm16.notes == ("converted from 16-bit integers",)
    np.testing.assert_array_equal(words.scores(path), words.scores(audio))
    assert list(words.predict([path, audio])) == ["1", "1"]


def test_one_recording_is_in_memory_at_a_time(
    words: hri.WordRecognizer, signs: hri.GestureRecognizer, spoken: Path, signed: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    events: list[str] = []

    def noted(owner: Any, name: str, event: str) -> None:
        plain = getattr(owner, name)
        monkeypatch.setattr(owner, name, lambda *args, **rest: (events.append(event), plain(*args, **rest))[1])

    noted(inputs, "read_audio", "read")
    noted(inputs, "read_frames", "read")
    noted(hri.WordRecognizer, "recognise", "done")
    noted(hri.GestureRecognizer, "recognise", "done")
    noted(hri.GestureRecognizer, "_features", "done")
    clips = sorted(signed.glob("*/*"))[:3]
    labels = ["a", "b", "b"]
    for run in (
        lambda: words.predict(sorted(spoken.glob("*.wav"))[:3]),
        lambda: signs.score(clips, labels),
        lambda: hri.GestureRecognizer(model="svm").fit(clips, labels),
        lambda: hri.GestureRecognizer(model="knn").fit(clips, labels).add_gesture("c", clips),
    ):
        events.clear()
        run()
        assert len(events) in (6, 12) and events == ["read", "done"] * (len(events) // 2)


def test_training_takes_files_and_arrays_alike(spoken: Path) -> None:
    paths = sorted(spoken.glob("*.wav"))
    labels = [path.name[0] for path in paths]
    audios = [read_audio(path) for path in paths]

    def fitted(clips: list[Any], **rate: int) -> hri.WordRecognizer:
        return hri.WordRecognizer(num_noisy_copies=0, num_vtlp_factors=1).fit(clips, labels, fillers=[], **rate)

    by_path = fitted(list(paths))
    by_array = fitted([audio.samples for audio in audios], sample_rate_hz=audios[0].sample_rate_hz)
    np.testing.assert_array_equal(by_path.scores(paths[0]), by_array.scores(paths[0]))


def test_notes_of_the_file_reach_the_decision(words: hri.WordRecognizer, spoken: Path) -> None:
    audio = read_audio(spoken / "1_low_0.wav")
    noted = Audio(audio.samples, audio.sample_rate_hz, ["averaged 2 channels to mono"])
    assert words.recognise(noted).notes == ("averaged 2 channels to mono",)


def test_a_sign_is_recognised_from_whatever_holds_it(
    signs: hri.GestureRecognizer, signed: Path, tmp_path: Path
) -> None:
    path = sorted((signed / "2").iterdir())[0]
    picture = read_image(path)
    expected = signs.recognise([picture])
    shutil.copy(path, tmp_path / path.name)
    for given in (path, str(path), read_frames(path), picture, picture[np.newaxis], tmp_path, iter([picture])):
        assert signs.recognise(given) == expected


@pytest.mark.parametrize(
    ("make", "error", "message"),
    [
        (lambda p: as_audio(np.zeros(800, np.float32), None), InvalidArgument, "^audio is an array.* sample_rate_hz"),
        (
            lambda p: as_audio(p / "1_low_0.wav", 16000),
            InvalidArgument,
            "is for arrays: audio is a file",
        ),
        (lambda p: as_audio(np.zeros((800, 2), np.float32), 16000), InvalidArgument, "mono.*average its channels"),
        (
            lambda p: as_audio(np.zeros(800, np.int64), 16000),
            InvalidArgument,
            "^audio must be .* got ndarray of int64",
        ),
        (lambda p: as_audio(None, 16000), InvalidArgument, "^audio must be a path, an Audio"),
        (lambda p: as_audio(np.zeros(800, np.float32), "16000"), InvalidArgument, "^sample_rate_hz must be an integer"),
        (
            lambda p: as_audio(p.parent / "sign.jpg", None),
            FormatError,
            "sign.jpg is a picture, and a sound file is needed",
        ),
        (
            lambda p: as_audio(p.parent / "words.hri", None),
            FormatError,
            "words.hri is a model, and a sound file is needed",
        ),
        (lambda p: as_audio(p / "none.wav", None), IoError, "none.wav"),
        (lambda p: as_audio(Audio(np.zeros(8, np.float32), 8000), 16000), InvalidArgument, "audio has 8000 Hz"),
    ],
)
def test_what_is_no_utterance_is_refused_by_name(
    spoken: Path, make: Callable[[Path], Any], error: type[Exception], message: str
) -> None:
    for name in ("sign.jpg", "words.hri"):
        (spoken.parent / name).touch()
    with pytest.raises(error, match=message):
        make(spoken)


@pytest.mark.parametrize(
    ("given", "error", "message"),
    [
        (np.zeros((4, 4), np.uint8), InvalidArgument, r"^clip must have shape \(height, width, 3\).*grey"),
        (np.zeros((4, 4, 3), np.float32), InvalidArgument, "^clip must be uint8, 0..255, got float32"),
        (
            [np.zeros((4, 4, 3), np.uint8), np.zeros((4, 4, 4), np.uint8)],
            InvalidArgument,
            r"^clip\[1\] must have",
        ),
        (["a.jpg", "b.jpg"], InvalidArgument, r"^clip\[0\] must be a picture.*predict takes several"),
        (7, InvalidArgument, "^clip must be a path, a Clip, a picture or a sequence of them, got int"),
        ("word.wav", FormatError, "word.wav is a sound file, and a picture or video is needed"),
        ("nowhere.jpg", IoError, "nowhere.jpg: cannot open: No such file"),
    ],
)
def test_what_is_no_sign_is_refused_by_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, given: Any, error: type[Exception], message: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("word.wav").touch()
    with pytest.raises(error, match=message):
        as_frames(given)


def test_one_utterance_in_place_of_several_is_refused(words: hri.WordRecognizer, spoken: Path) -> None:
    for one in (str(spoken / "1_low_0.wav"), read_audio(spoken / "1_low_0.wav"), np.zeros(800, np.float32)):
        with pytest.raises(InvalidArgument, match="X must be a sequence of utterances, got one"):
            words.predict(one)
    with pytest.raises(InvalidArgument, match=r"^X\[1\] is an array"):
        words.predict([spoken / "1_low_0.wav", np.zeros(800, np.float32)])
    with pytest.raises(InvalidArgument, match="differ in length: 2, 1"):
        words.predict([np.zeros(800, np.float32)] * 2, sample_rate_hz=[16000])


def test_an_array_of_paths_is_a_sequence(
    words: hri.WordRecognizer, signs: hri.GestureRecognizer, spoken: Path, signed: Path
) -> None:
    clips = sorted(map(str, spoken.glob("*.wav")))
    assert list(words.predict(np.array(clips))) == list(words.predict(clips))
    pictures = [sample.path for sample in hri.Dataset.load(signed, "gesture")]
    assert list(signs.predict(np.array(pictures, object))) == list(signs.predict(pictures))
    scores = cross_val_score(words, np.array(clips), [Path(clip).name[0] for clip in clips], cv=2, error_score="raise")
    assert scores.shape == (2,)


@pytest.mark.parametrize("label", [None, float("nan"), 1.0, True, b"1", ["1"]])
def test_what_is_no_label_is_refused_by_name(spoken: Path, label: object) -> None:
    clips = sorted(spoken.glob("*.wav"))[:2]
    with pytest.raises(InvalidArgument, match=r"^y\[1\] must be text, got"):
        hri.WordRecognizer().fit(clips, ["1", label])  # type: ignore[list-item]
    with pytest.raises(InvalidArgument, match=r"^groups\[0\] must be text, got"):
        hri.ConnectedWordRecognizer().fit(clips, ["1", "2"], groups=[label, "low"])  # type: ignore[list-item]
    with pytest.raises(InvalidArgument, match=r"^y\[1\] must be text, got"):
        hri.GestureRecognizer().fit([np.zeros((9, 9, 3), np.uint8)] * 2, ["1", label])  # type: ignore[list-item]


def test_labels_may_be_integers(words: hri.WordRecognizer, spoken: Path) -> None:
    clips = sorted(spoken.glob("*.wav"))
    numbers = [int(clip.name[0]) for clip in clips]
    trained = words.untrained().fit(clips, numbers)  # type: ignore[arg-type]
    assert list(trained.classes_) == sorted({str(number) for number in numbers})
    assert trained.score(clips, numbers) == words.score(clips, [str(number) for number in numbers])  # type: ignore[arg-type]


def test_labels_that_fit_refuses_are_not_scored(
    words: hri.WordRecognizer, signs: hri.GestureRecognizer, spoken: Path, signed: Path
) -> None:
    clips = sorted(spoken.glob("*.wav"))[:2]
    pictures = [sample.path for sample in hri.Dataset.load(signed, "gesture")][:2]
    for recognizer, given in ((words, clips), (signs, pictures)):
        with pytest.raises(InvalidArgument, match=r"^y\[0\] must be text, got 1\.0"):
            recognizer.score(given, [1.0, 2.0])  # type: ignore[list-item]
        with pytest.raises(InvalidArgument, match="X and y differ in length: 2, 1"):
            recognizer.score(given, ["1"])


def test_a_word_may_be_added_and_removed_by_its_number(words: hri.WordRecognizer, spoken: Path) -> None:
    more = copy(words).add_word(7, sorted(spoken.glob("1_*.wav"))[:3])  # type: ignore[arg-type]
    assert set(more.classes_) - set(words.classes_) == {"7"}
    assert list(more.remove_word(7).classes_) == list(words.classes_)  # type: ignore[arg-type]
    with pytest.raises(InvalidArgument, match=r"^label must be text, got None"):
        more.add_word(None, [])  # type: ignore[arg-type]
    with pytest.raises(InvalidArgument, match="no word '9'"):
        hri.SpeakerAdapter(words).learn(sorted(spoken.glob("*.wav"))[0], 9)  # type: ignore[arg-type]


def test_what_is_no_sequence_is_said_to_be_none(words: hri.WordRecognizer, spoken: Path) -> None:
    clips = sorted(spoken.glob("*.wav"))[:2]
    for X, y, groups, message in (
        (iter(clips), ["1", "2"], None, r"^X must be a sequence, got .*: write list\(X\)"),
        (clips, None, None, "^y must be a sequence of texts, got None$"),
        (clips, ["1", "2"], 1, "^groups must be a sequence of texts, got 1$"),
        (clips, "12", None, "^y must be a sequence of texts, got one"),
    ):
        with pytest.raises(InvalidArgument, match=message):
            words.untrained().fit(X, y, groups=groups)  # type: ignore[arg-type]
    with pytest.raises(InvalidArgument, match=r"^X must be a sequence, got"):
        words.predict(iter(clips))  # type: ignore[arg-type]


@pytest.mark.parametrize("rate", [16000.0, True, 0, -1, 2**40])
def test_what_is_no_rate_is_refused(words: hri.WordRecognizer, rate: Any) -> None:
    samples = np.zeros(800, np.float32)
    for run in (
        lambda: words.recognise(samples, rate),
        lambda: words.predict([samples], rate),
        lambda: words.recognise(Audio(samples, rate)),
    ):
        with pytest.raises(InvalidArgument, match=r"must be an integer|is no rate"):
            run()


def test_a_model_is_of_a_known_mode(tmp_path: Path, words: hri.WordRecognizer) -> None:
    words.save(tmp_path / "words.hri")
    with pytest.raises(InvalidArgument, match=r"mode must be .speech., .gesture. or None, got 'word'"):
        hri.load(tmp_path / "words.hri", "word")  # type: ignore[call-overload]


def test_samples_of_a_data_set_and_several_signs(
    words: hri.WordRecognizer, signs: hri.GestureRecognizer, spoken: Path, signed: Path
) -> None:
    dataset = hri.Dataset.load(spoken, "speech")
    assert words.recognise(dataset.samples[0]) == words.recognise(dataset.samples[0].path)
    assert words.score(dataset, [sample.label for sample in dataset]) == 1.0
    stills = hri.Dataset.load(signed, "gesture")
    assert list(signs.predict(stills)) == list(signs.predict([sample.path for sample in stills]))
    for one in (stills.samples[0].path, read_frames(stills.samples[0].path), read_image(stills.samples[0].path)):
        with pytest.raises(InvalidArgument, match="X must be a sequence of signs, got one"):
            signs.predict(one)
    with pytest.raises(InvalidArgument, match="got Clip: a GestureRecognizer recognises it"):
        words.recognise(read_frames(stills.samples[0].path))
    with pytest.raises(InvalidArgument, match="got Audio: a WordRecognizer recognises it"):
        signs.recognise(read_audio(dataset.samples[0].path))


def test_training_and_evaluation_take_what_says_enough(signed: Path) -> None:
    trained = hri.train(signed)
    assert isinstance(trained, hri.GestureRecognizer)
    assert repr(trained).startswith("GestureRecognizer(2 labels: 1 2")
    stills = hri.Dataset.load(signed, "gesture")
    by_class = hri.cross_validate(stills, hri.GestureRecognizer)
    assert hri.cross_validate(stills, hri.GestureRecognizer()).to_dict() == by_class.to_dict()


def test_unfitted_recognisers_show_what_differs_from_the_defaults() -> None:
    assert repr(hri.GestureRecognizer()) == "GestureRecognizer(not trained)"
    assert repr(hri.WordRecognizer(num_vtlp_factors=1)) == "WordRecognizer(not trained, num_vtlp_factors=1)"


def test_a_misspelt_name_of_the_package_is_answered() -> None:
    with pytest.raises(AttributeError, match="no attribute 'WordRecogniser'; did you mean 'WordRecognizer'"):
        _ = hri.WordRecogniser
    with pytest.raises(InvalidArgument, match="no rule 'produkt'; did you mean 'product'"):
        hri.fuse(None, None, rule="produkt")


def test_a_model_of_the_other_kind_is_said_to_be_one(
    words: hri.WordRecognizer, signs: hri.GestureRecognizer, spoken: Path, tmp_path: Path
) -> None:
    words.save(tmp_path / "words.hri")
    signs.save(tmp_path / "signs.hri")
    with pytest.raises(FormatError, match=r"words\.hri is a word recogniser, and a gesture recogniser is needed"):
        hri.GestureRecognizer.load(tmp_path / "words.hri")
    with pytest.raises(FormatError, match=r"signs\.hri is a gesture recogniser, and a word recogniser is needed"):
        hri.WordRecognizer.load(tmp_path / "signs.hri")
    with pytest.raises(FormatError, match=r"1_low_0\.wav is a sound file, and a word recogniser is needed"):
        hri.WordRecognizer.load(spoken / "1_low_0.wav")


def test_connected_words_name_the_file_that_is_bad(spoken: Path, tmp_path: Path) -> None:
    clips = sorted(spoken.glob("*.wav"))
    labels = [path.name[0] for path in clips]
    write_wav_pcm16(str(tmp_path / "click.wav"), np.zeros(1, np.float32), 16000)
    with pytest.raises(FormatError, match=r"click\.wav: audio is too short"):
        hri.ConnectedWordRecognizer().fit([*clips, tmp_path / "click.wav"], [*labels, "1"])
    broken = np.where(np.arange(16000) == 5, np.nan, 0.1).astype(np.float32)
    with pytest.raises(InvalidArgument, match=r"X\[1\]: audio is not finite at sample 5"):
        hri.ConnectedWordRecognizer().fit([np.zeros(16000), broken], ["1", "2"], sample_rate_hz=16000)
    for label in ("<unk>", "<sil>"):
        with pytest.raises(InvalidArgument, match=f"'{label}' stands for no word"):
            hri.ConnectedWordRecognizer().fit(clips, [label, *labels[1:]])


def test_class_thresholds_are_saved_with_the_model(words: hri.WordRecognizer, spoken: Path, tmp_path: Path) -> None:
    words.save(tmp_path / "words.hri")
    path = spoken / "1_low_0.wav"
    decision = hri.WordRecognizer.load(tmp_path / "words.hri").recognise(path)
    assert decision == words.recognise(path)
    assert 0.5 <= decision.class_threshold <= 1.0
