# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Signed sentences from Python and from the command line, on synthetic tracks."""

from __future__ import annotations

import copy
import json
import pickle
import shutil
from pathlib import Path

import numpy as np
import pytest

import hri as package
from hri.core.errors import FormatError, InvalidArgument, NotFittedError
from hri.datasets.asl_sentences import (
    HANDS_COLUMNS,
    SIGNERS_COLUMNS,
    WORDS_COLUMNS,
    SignedSentence,
    SignedWord,
)
from hri.features import TwoHandFeatureComputer, TwoHandFeatureOptions, hand_scale_px
from hri.recognition import SentenceRecognizer
from hri.studies import get_study, run_study
from hri.studies import sentences as sentence_studies

STROKES = {
    "BALL": [[(-40, 40), (40, 40)], [(-10, 60), (10, 60)]],
    "CAT": [[(-30, 120), (20, 10)], [(-30, 120), (60, 10)]],
    "DOG": [[(-30, 120), (50, 60)], [(-30, 120), (20, 110)]],
}
REST = [(-30, 120), (30, 120)]
OPTIONS = {"frames_per_state": 4, "choose_weights": False}
Sentence = tuple[np.ndarray, list[tuple[str, int, int]]]


def signed(words: list[str], seed: int) -> Sentence:
    """Tracks of shape (num_frames, 3, 2) in whole pixels, and the frames of the words."""
    rng = np.random.default_rng(seed)
    places, spans = [np.array(REST)] * 8, []
    for word in words:
        for stroke, frames in zip(STROKES[word], (5, 12), strict=True):
            before, first = places[-1], len(places)
            places += [before + (np.array(stroke) - before) * t / frames for t in range(1, frames + 1)]
        spans.append((word, first, len(places)))
    places += [np.array(REST)] * 8
    points = np.concatenate([np.array(places), np.zeros((len(places), 1, 2))], axis=1)
    return np.round(points + np.array([160, 60]) + rng.normal(size=points.shape)), spans


def make_sentences(count: int) -> list[Sentence]:
    rng = np.random.default_rng(3)
    return [signed([str(w) for w in rng.choice(list(STROKES), rng.integers(1, 5))], 100 + i) for i in range(count)]


@pytest.fixture(scope="module")
def sentences() -> list[Sentence]:
    return make_sentences(20)


@pytest.fixture(scope="module")
def signs(sentences: list[Sentence]) -> SentenceRecognizer:
    return SentenceRecognizer().fit([tracks for tracks, _ in sentences], [words for _, words in sentences])


def test_features_are_those_of_numpy() -> None:
    tracks, _ = signed(["BALL", "CAT"], 1)
    left, right, nose = np.moveaxis(tracks, 1, 0)
    scale = np.sqrt(np.mean(np.sum((np.stack([left, right]) - nose) ** 2, axis=2)))
    assert hand_scale_px(tracks.reshape(-1, 6)) == pytest.approx(scale, rel=1e-6)
    places = np.hstack([right - nose, left - nose]) / scale
    computer = TwoHandFeatureComputer(TwoHandFeatureOptions(delta_orders=1))
    features = computer.compute(tracks.reshape(-1, 6))
    assert features.shape == (len(tracks), computer.num_features) and features.dtype == np.float32
    np.testing.assert_allclose(features[:, :4], places, atol=1e-5)
    padded = np.pad(places, ((2, 2), (0, 0)), mode="edge")
    slopes = (padded[3:-1] - padded[1:-3] + 2 * (padded[4:] - padded[:-4])) / 10
    np.testing.assert_allclose(features[:, 4:], slopes, atol=1e-5)


def test_words_and_their_frames_are_found(signs: SentenceRecognizer) -> None:
    tracks, words = signed(["DOG", "CAT", "CAT", "BALL"], 7)
    found = signs.recognise(tracks)
    assert found.text == "DOG CAT CAT BALL"
    for word, (_, first, last) in zip(found.words, words, strict=True):
        assert abs(word.first_frame - first) <= 3 and abs(word.last_frame - last) <= 3
    assert signs.recognise(tracks.reshape(-1, 6)) == found
    assert json.loads(json.dumps(found.to_dict()))["words"][0]["label"] == "DOG"
    spans = [(first, last) for _, first, last in words]
    for use_language in (True, False):
        known = signs.recognise_spans(tracks, spans, use_language=use_language)
        assert known.labels == found.labels
        assert [(w.first_frame, w.last_frame) for w in known.words] == spans
    scores = signs.score_spans(tracks, spans)
    assert scores.shape == (len(spans), len(signs.classes_))
    assert tuple(signs.classes_[scores.argmax(axis=1)]) == found.labels
    assert scores.max(axis=1) == pytest.approx([word.log_score for word in known.words])
    assert signs.count_errors([tracks], [["DOG", "CAT", "BALL"]]).insertions == 1


def test_a_model_goes_through_a_file_a_copy_and_a_pickle(signs: SentenceRecognizer, tmp_path: Path) -> None:
    tracks, _ = signed(["CAT", "DOG"], 8)
    found = signs.recognise(tracks)
    signs.save(tmp_path / "signs.hri")
    loaded = SentenceRecognizer.load(tmp_path / "signs.hri")
    for same in (loaded, copy.deepcopy(signs), pickle.loads(pickle.dumps(signs))):
        assert same.recognise(tracks) == found
        assert list(same.classes_) == ["BALL", "CAT", "DOG"]
    with pytest.raises(FormatError, match=r"is a recogniser of signed sentences, and a word recogniser is needed here"):
        package.WordRecognizer.load(tmp_path / "signs.hri")


def test_the_decoder_changes_after_training(signs: SentenceRecognizer) -> None:
    tracks, _ = signed(["CAT", "DOG"], 9)
    changed = copy.deepcopy(signs).set_decoder(insertion_penalty=-1e6)
    assert len(changed.recognise(tracks).words) < 2
    assert signs.trained_options.decoder.insertion_penalty in (-40, 0, 20, 40)


def test_what_cannot_be_done_is_refused(signs: SentenceRecognizer, sentences: list[Sentence]) -> None:
    tracks, words = sentences[0]
    with pytest.raises(NotFittedError):
        SentenceRecognizer().recognise(tracks)
    with pytest.raises(InvalidArgument, match="differ in length"):
        SentenceRecognizer().fit([tracks], [words, words])
    with pytest.raises(InvalidArgument, match=r"X\[0\] has shape"):
        SentenceRecognizer().fit([tracks[:, :2]], [words])
    with pytest.raises(InvalidArgument, match=r"X\[1\]: words: 0 has frames"):
        SentenceRecognizer().fit([tracks, tracks], [words, [("CAT", 5, 1000)]])
    unseen = np.full_like(tracks, np.nan)
    with pytest.raises(InvalidArgument, match="no frame shows the reference"):
        signs.recognise(unseen)
    with pytest.raises(InvalidArgument, match="must have at least one row"):
        signs.recognise(np.zeros((0, 6)))
    with pytest.raises(InvalidArgument, match="words: 1 has frames 2"):
        signs.recognise_spans(tracks, [(5, 9), (2, 12)])
    with pytest.raises(InvalidArgument, match="words: 0 has frames 5"):
        signs.score_spans(tracks, [(5, 5)])


def test_hands_that_vanish_for_a_second_leave_the_words(signs: SentenceRecognizer) -> None:
    tracks, words = signed(["DOG", "BALL", "CAT"], 10)
    after_first = words[0][2] + 1
    gone = np.full((30, 3, 2), np.nan)
    gone[:, 2] = tracks[after_first, 2]
    found = signs.recognise(np.concatenate([tracks[:after_first], gone, tracks[after_first:]]))
    assert found.text == "DOG BALL CAT"
    unseen = np.concatenate([tracks[:after_first], np.full((30, 3, 2), np.nan), tracks[after_first:]])
    assert signs.recognise(unseen).text == "DOG BALL CAT"


def test_possibility_theory_models_read_the_same_words(sentences: list[Sentence], tmp_path: Path) -> None:
    signs = SentenceRecognizer(model="ptbhmm").fit(
        [tracks for tracks, _ in sentences], [words for _, words in sentences]
    )
    signs.save(tmp_path / "signs.hri")
    loaded = SentenceRecognizer.load(tmp_path / "signs.hri")
    assert (loaded.options.model, loaded.options.num_codewords) == ("ptbhmm", 64)
    for seed, words in enumerate((["CAT", "DOG"], ["BALL", "BALL", "DOG", "CAT"]), 20):
        tracks, spans = signed(words, seed)
        assert list(loaded.recognise(tracks).labels) == words
        assert loaded.recognise(tracks) == signs.recognise(tracks)
        frames = [(first, last) for _, first, last in spans]
        assert list(loaded.recognise_spans(tracks, frames, use_language=False).labels) == words


def test_rows_of_features_take_the_place_of_tracks(sentences: list[Sentence]) -> None:
    def rows(tracks: np.ndarray) -> np.ndarray:
        return (tracks[:, 1] - tracks[:, 2]) / 100

    signs = SentenceRecognizer(input="rows", **OPTIONS)
    signs.fit([rows(tracks) for tracks, _ in sentences], [words for _, words in sentences])
    tracks, _ = signed(["DOG", "CAT"], 31)
    assert signs.recognise(rows(tracks)).text == "DOG CAT"
    with pytest.raises(InvalidArgument, match="tracks has shape"):
        signs.recognise(tracks)
    with pytest.raises(InvalidArgument, match="as many columns as those that were trained on"):
        signs.recognise(tracks[:, 0, :1])
    with pytest.raises(InvalidArgument, match="no frame shows a hand"):
        signs.recognise(np.full((9, 2), np.nan))
    with pytest.raises(InvalidArgument, match="at least one row"):
        signs.recognise(np.zeros((0, 2)))
    half = rows(tracks)
    half[4, 1] = np.nan
    with pytest.raises(InvalidArgument, match="column 1 of frame 4 is nan"):
        signs.recognise(half)
    with pytest.raises(InvalidArgument, match="rows have none"):
        signs.recognise(rows(tracks), scale_px=10)


def write_folder(folder: Path, sentences: list[Sentence]) -> None:
    hands, words, signers = [HANDS_COLUMNS], [WORDS_COLUMNS], [SIGNERS_COLUMNS]
    for number, (tracks, spans) in enumerate(sentences):
        signers.append((str(number), "ann"))
        for frame, row in enumerate(tracks.reshape(-1, 6).astype(int)):
            hands.append((str(number), str(frame), *map(str, row)))
        words += [(str(number), "ann", label, str(first), str(last - 1)) for label, first, last in spans]
    folder.mkdir()
    for name, rows in {"hands.csv": hands, "words.csv": words, "signers.csv": signers}.items():
        (folder / name).write_text("".join(",".join(row) + "\n" for row in rows))


def test_command_line_trains_and_reads(hri, sentences: list[Sentence], tmp_path: Path) -> None:
    write_folder(tmp_path / "signed", sentences)
    options = [word for name, value in OPTIONS.items() for word in ("--option", f"{name}={str(value).lower()}")]
    trained = hri("train-sentences", "--data", tmp_path / "signed", *options)
    assert (trained.code, trained.out) == (0, f"{tmp_path / 'data' / 'hri' / 'sentences.hri'}\n")
    assert "20 sentences, 3 words: BALL CAT DOG" in trained.err
    write_folder(tmp_path / "new", [signed(["CAT", "DOG"], 55), signed(["BALL"], 56)])
    file = tmp_path / "new" / "hands.csv"
    assert hri("read-sentences", file).out == "0\tCAT DOG\n1\tBALL\n"
    lines = hri("read-sentences", file, "--frames").out.splitlines()
    assert [line.split("\t")[3] for line in lines] == ["CAT", "DOG", "BALL"]
    found = json.loads(hri("read-sentences", file, "--json", "-").out)
    assert found[str(file)]["1"]["text"] == "BALL"


def test_command_line_reads_stored_sentences_and_speaks(hri, signs: SentenceRecognizer, tmp_path: Path) -> None:
    signs.save(tmp_path / "signs.hri")
    write_folder(tmp_path / "new", [signed(["CAT", "DOG"], 55), signed(["BALL"], 56)])
    stored = tmp_path / "stored.csv"
    stored.write_text("signs,en,hi\nCAT CAT DOG,The cat sees the dog,बिल्ली कुत्ते को देखती है\n", "utf-8")
    read = "read-sentences", tmp_path / "new" / "hands.csv", "--model", tmp_path / "signs.hri", "--knowledge", stored
    english = hri(*read)
    assert english.out == "0\tThe cat sees the dog\n1\tBALL\n"
    assert "1: none of the stored sentences" in english.err and "WARNING" not in english.err
    assert hri(*read, "--language", "hi").out.startswith("0\tबिल्ली कुत्ते को देखती है\n")
    assert hri(*read, "--max-distance", "0").out == "0\tCAT DOG\n1\tBALL\n"
    found = json.loads(hri(*read, "--json", "-").out)[str(read[1])]
    assert found["0"]["stored"]["words"] == ["CAT", "CAT", "DOG"] and found["1"]["stored"] is None
    best = signs.recognise_n_best(signed(["CAT", "DOG"], 55)[0], 20)
    named = json.loads(hri(*read, "--max-distance", "0", "--alternatives", "20", "--json", "-").out)[str(read[1])]
    assert [one["text"] for one in named["0"]["alternatives"]] == [one.text for one in best]
    # What is stored is among the others, and so at no distance.
    assert "CAT CAT DOG" in [one.text for one in best[1:]] and named["0"]["stored"]["distance"] == 0
    assert "alternatives" not in found["0"] and named["1"]["stored"] is None
    printed = hri(*read[:-2], "--alternatives", "20").out.splitlines()
    assert [line for line in printed if line[0] == "0"] == [f"0\t{one.log_score:.1f}\t{one.text}" for one in best]
    assert hri(*read, "--frames", "--alternatives", "2").code == 2
    if shutil.which("espeak-ng") is not None:
        hri(*read, "--language", "hi", "--speak", tmp_path / "voice")
        audio = package.read_audio(tmp_path / "voice" / "001.wav")
        assert len(audio.samples) > audio.sample_rate_hz and np.abs(audio.samples).max() > 0.1
        assert (tmp_path / "voice" / "002.wav").exists()
    stored.write_text("signs,en\nCAT dog,A\nCOW,B\n", "utf-8")
    assert "words that no recogniser knows: dog (there is DOG), COW" in hri(*read).err
    refused = hri(*read, "--language", "de")
    assert refused.code == 3 and "no stored sentence has a text in 'de'" in refused.err
    (tmp_path / "bad.csv").write_text("words\nCAT\n")
    bad = hri(*read[:-1], tmp_path / "bad.csv")
    assert bad.code == 3 and "bad.csv: row 1: the columns must be 'signs'" in bad.err


def test_command_line_refuses_what_training_chooses(hri, tmp_path: Path) -> None:
    write_folder(tmp_path / "signed", [signed(["CAT"], 57)])
    for command in (("train-sentences",), ("evaluate", "sentences")):
        for name in ("decoder.insertion_penalty", "decoder.language_scale", "known_language_scale"):
            refused = hri(*command, "--data", tmp_path / "signed", "--option", f"{name}=3")
            assert refused.code == 2 and f"--option {name} is chosen in training" in refused.err
            assert "with --option choose_weights=false yours stays" in refused.err


def test_command_line_says_what_is_missing(hri, signs: SentenceRecognizer, tmp_path: Path) -> None:
    write_folder(tmp_path / "new", [signed(["CAT"], 57)])
    file = tmp_path / "new" / "hands.csv"
    refused = hri("read-sentences", file)
    assert refused.code == 3 and "run 'hri train-sentences --data DIR'" in refused.err
    signs.save(tmp_path / "signs.hri")
    (tmp_path / "empty.csv").write_text("left-x,left-y,right-x,right-y,nose-x,nose-y\n,,,,1,2\n")
    blind = hri("read-sentences", tmp_path / "empty.csv", "--model", tmp_path / "signs.hri")
    assert blind.code == 3 and "empty: tracks: no frame shows a hand" in blind.err


def test_a_video_or_a_file_that_cannot_be_read_leaves_the_others(
    hri, signs: SentenceRecognizer, tmp_path: Path
) -> None:
    signs.save(tmp_path / "signs.hri")
    write_folder(tmp_path / "new", [signed(["CAT"], 57), signed(["DOG"], 58)])
    good, blind, bad = tmp_path / "new" / "hands.csv", tmp_path / "blind.csv", tmp_path / "bad.csv"
    header, *lines = good.read_text().splitlines()
    unseen = [line.split(",")[1] for line in lines if line.startswith("1,")]
    kept = [line for line in lines if line.startswith("0,")]
    blind.write_text("\n".join([header, *(f"9,{frame},,,,,," for frame in unseen), *kept]) + "\n")
    bad.write_text("words\nCAT\n")
    done = hri(
        "--quiet", "read-sentences", bad, blind, good, "--model", tmp_path / "signs.hri", "--json", tmp_path / "o"
    )
    assert done.code == 3 and done.out == "0\tCAT\n0\tCAT\n1\tDOG\n"
    assert "bad.csv: row 1: no column" in done.err and "blind.csv: 9: tracks: no frame shows" in done.err
    found = json.loads((tmp_path / "o").read_text())
    assert "no column" in found[str(bad)]["error"] and "no frame shows" in found[str(blind)]["9"]["error"]
    assert found[str(blind)]["0"]["text"] == "CAT" and found[str(good)]["1"]["text"] == "DOG"


def test_a_hand_out_of_view_decides_nothing(sentences: list[Sentence], tmp_path: Path) -> None:
    def right_alone(one: Sentence) -> Sentence:
        tracks = one[0].copy()
        tracks[:, 0] = np.nan
        return tracks, one[1]

    def train(some: list[Sentence]) -> SentenceRecognizer:
        return SentenceRecognizer(**OPTIONS).fit([t for t, _ in some], [w for _, w in some])

    words = ["DOG", "CAT", "BALL"]
    whole = signed(words, 77)
    for some in (sentences, [right_alone(s) if i % 2 else s for i, s in enumerate(sentences)]):
        trained = train(some)
        trained.save(tmp_path / "signs.hri")
        for signs in (trained, SentenceRecognizer.load(tmp_path / "signs.hri")):
            for tracks, _ in (whole, right_alone(whole)):
                assert signs.recognise(tracks).labels == tuple(words)
    alone = train([right_alone(s) for s in sentences])
    assert alone.trained_options.features.use_left is False and alone.recognise(whole[0]).labels == tuple(words)
    with pytest.raises(InvalidArgument, match="right hand"):
        train([(right_alone(s)[0][:, [1, 0, 2]], s[1]) for s in sentences])


def test_weights_are_chosen_on_signers_held_out_where_there_are_two(
    hri, sentences: list[Sentence], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = []
    fit = SentenceRecognizer.fit
    monkeypatch.setattr(
        SentenceRecognizer, "fit", lambda self, X, y, **more: seen.append(more["groups"]) or fit(self, X, y, **more)
    )
    write_folder(tmp_path / "one", sentences[:6])
    write_folder(tmp_path / "two", sentences[:6])
    for name in ("signers.csv", "words.csv"):
        path = tmp_path / "two" / name
        path.write_text(path.read_text().replace("5,ann", "5,ben"))
    for folder in ("one", "two"):
        done = hri("train-sentences", "--data", tmp_path / folder, "--option", "choose_weights=false")
        assert done.code == 0, done.err
    assert seen == [None, ["ann"] * 5 + ["ben"]]


def test_the_studies_hold_sentences_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sentence_studies, "NUM_GROUPS", 2)
    write_folder(tmp_path / "asl_sentences", make_sentences(8))
    result = run_study(get_study("asl-sentences"), tmp_path, lambda *_: None, {})
    rows = {(row["held_out"], row["hands"], row["frames"], row["words"]): row for row in result["rows"]}
    assert len(rows) == 12 and result["unseen_words"] == {"recordings": 0.0, "texts": 0.0}
    assert rows["recordings", "both hands", "known", "words alone"]["word_error_mean"] == 0
    assert result["passed"] == (max(result["more_than_known_frames"].values()) <= 0.1)
    kept = result["counts"]["texts, both hands, found, bigram"]
    errors = kept["substitutions"] + kept["deletions"] + kept["insertions"]
    assert errors / kept["num_words"] <= 0.5


def test_the_studies_of_models_and_of_knowledge(tmp_path: Path) -> None:
    write_folder(tmp_path / "asl_sentences", make_sentences(15))
    models = run_study(get_study("asl-ptbhmm"), tmp_path, lambda *_: None, {}, folds=1)
    assert {row["model"]: row["word_error_mean"] for row in models["rows"]} == {"hmm": 0, "ptbhmm": 0}
    assert models["passed"] and set(models["ms_a_frame"]) == {"hmm", "ptbhmm"}
    hidden = run_study(get_study("asl-one-hand"), tmp_path, lambda *_: None, {}, folds=1)
    assert {row["view"] for row in hidden["rows"]} == {"both hands", "right hand alone"} and len(hidden["rows"]) == 12
    errors = {(row["model"], row["words"], row["view"]): row["word_error_mean"] for row in hidden["rows"]}
    assert max(errors.values()) <= 0.5 and hidden["passed"] == (max(hidden["costs"].values()) <= 0.15)
    knowledge = run_study(get_study("asl-knowledge"), tmp_path, lambda *_: None, {}, folds=1)
    share = {(r["signed"], r["meaning"], r["outcome"]): r["share_mean"] for r in knowledge["rows"]}
    within = "nearest within the distance"
    assert share["stored", within, "right"] == share["stored", "nearest", "right"] == 1
    assert share["not stored", "nearest", "wrong"] == 1 and share["not stored", within, "none"] > 0.5
    for signed_as in ("stored", "not stored"):
        for way in ("words as recognised", "nearest", within):
            right, wrong = share[signed_as, way, "right"], share[signed_as, way, "wrong"]
            assert right + wrong == pytest.approx(1) and right == pytest.approx(1 - wrong)


def test_groups_hold_out_every_recording_of_a_text() -> None:
    words = [SignedWord("GO", 0, 1)], [SignedWord("STOP", 0, 1)], [SignedWord("GO", 0, 1), SignedWord("STOP", 0, 1)]
    sentences = [SignedSentence(str(i), "ann", np.zeros((3, 3, 2), np.float32), tuple(words[i % 3])) for i in range(30)]
    texts = sentence_studies.groups_of(sentences, "texts")
    assert all(len({texts[i] for i in range(first, 30, 3)}) == 1 for first in range(3))
    recordings = sentence_studies.groups_of(sentences, "recordings")
    assert sorted(np.bincount(recordings)) == [6] * 5
    assert set(sentence_studies.groups_of(sentences, "signers")) == {0}
    others = [SignedSentence(s.video, "abe", s.positions, s.words) for s in sentences[:3]]
    assert sentence_studies.groups_of([*sentences[3:], *others], "signers") == [1] * 27 + [0] * 3


def test_other_sentences_may_have_been_meant(signs: SentenceRecognizer) -> None:
    tracks, _ = signed(["CAT", "BALL"], 5)
    best, *others = signs.recognise_n_best(tracks, 4)
    assert best.text == signs.recognise(tracks).text == "CAT BALL"
    assert others
    assert len({best.text, *(one.text for one in others)}) == 1 + len(others)
    assert all(one.log_score <= best.log_score for one in others)
    with pytest.raises(InvalidArgument, match="count must lie in"):
        signs.recognise_n_best(tracks, 0)
