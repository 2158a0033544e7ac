# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Connected words from Python and from the command line."""

from __future__ import annotations

import copy
import json
import pickle
import shutil
from pathlib import Path

import numpy as np
import pytest

import hri as package
from conftest import RATE_HZ, tone_word
from hri.core.errors import FormatError, InvalidArgument, NotFittedError
from hri.datasets import Dataset
from hri.htk import WordLattice
from hri.io import SpokenWords, write_wav_pcm16
from hri.language import Grammar, NGramModel, NGramOptions
from hri.recognition import ConnectedWordRecognizer, ConnectedWordStream, FillerWord
from hri.synthetic.speech import make_speaker, speak

WORDS = ["1", "2", "2", "1"]
GRAMMAR = """#JSGF V1.0;
grammar tones;
public <tones> = 1 <twos> {count} 1 {gesture=wave} | <twos>;
<twos> = 2+;
"""
OPTIONS = {
    "words": {"num_states": 5, "num_vtlp_factors": 1, "num_noisy_copies": 1, "min_snr_db": 10.0},
    "max_words": 4,
}


@pytest.fixture(scope="module")
def words(spoken: Path) -> ConnectedWordRecognizer:
    samples = Dataset.load(spoken).samples
    return ConnectedWordRecognizer(**OPTIONS).fit(
        [s.path for s in samples], [s.label for s in samples], groups=[s.person for s in samples]
    )


@pytest.fixture(scope="module")
def sentence() -> np.ndarray:
    """The words by a speaker who was not trained on, each in the second half second of 0.7 s."""
    clips = [tone_word(575, 800 if word == "1" else -350, 50 + i) for i, word in enumerate(WORDS)]
    middle = [clip[RATE_HZ // 10 : 4 * RATE_HZ // 5] for clip in clips]
    return np.concatenate([clips[0][: RATE_HZ // 5], *middle, clips[0][: RATE_HZ // 5]])


def test_words_and_their_times_are_found(words: ConnectedWordRecognizer, sentence: np.ndarray) -> None:
    found = words.recognise(sentence, RATE_HZ)
    assert list(found.labels) == WORDS and found.text == "1 2 2 1" and found.complete
    for number, word in enumerate(found.words):
        assert word.first_s == pytest.approx(0.2 + 0.7 * number + 0.15, abs=0.05)
        assert word.last_s == pytest.approx(0.2 + 0.7 * number + 0.65, abs=0.05)
    assert words.recognise(sentence, RATE_HZ, num_words=4).labels == found.labels
    assert len(words.recognise(sentence, RATE_HZ, num_words=2).words) == 2
    assert words.count_errors([sentence], [["1", "2", "1", "1"]], RATE_HZ).substitutions == 1
    assert words.count_errors([sentence], [[1, 2, 2, 1]], RATE_HZ).rate == 0
    for wrong, message in (([["1"], ["2"]], "X and y differ in length"), ([["1", None]], r"y\[0\]\[1\] must be text")):
        with pytest.raises(InvalidArgument, match=message):
            words.count_errors(["no such file.wav"], wrong)
    assert json.loads(json.dumps(found.to_dict()))["words"][0]["label"] == "1"
    assert words.recognise(np.zeros(RATE_HZ, np.float32), RATE_HZ).words == ()


def test_times_reach_what_hisses_beside_a_pause(words: ConnectedWordRecognizer, sentence: np.ndarray) -> None:
    """Sounds that no word was trained with, before the first tone and behind the last, are of these words."""
    rng = np.random.default_rng(4)
    audio = np.concatenate([sentence, (0.001 * rng.standard_normal(RATE_HZ // 2)).astype(np.float32)])
    first_s, last_s = 0.35, 0.2 + 0.7 * 3 + 0.65
    for begins_s, ends_s in ((first_s - 0.12, first_s), (last_s, last_s + 0.12)):
        part = slice(round(begins_s * RATE_HZ), round(ends_s * RATE_HZ))
        audio[part] += (0.02 * rng.standard_normal(part.stop - part.start)).astype(np.float32)
    found = words.recognise(audio, RATE_HZ).words
    assert [word.label for word in found] == WORDS
    assert found[0].first_s == pytest.approx(first_s - 0.12, abs=0.04)
    assert found[-1].last_s == pytest.approx(last_s + 0.12, abs=0.04)
    assert found[1].first_s == pytest.approx(0.2 + 0.7 + 0.15, abs=0.05)


def test_a_model_goes_through_a_file_a_copy_and_a_pickle(
    words: ConnectedWordRecognizer, sentence: np.ndarray, tmp_path: Path
) -> None:
    found = words.recognise(sentence, RATE_HZ)
    words.save(tmp_path / "words.hri")
    loaded = ConnectedWordRecognizer.load(tmp_path / "words.hri")
    for same in (loaded, copy.deepcopy(words), pickle.loads(pickle.dumps(words))):
        assert same.recognise(sentence, RATE_HZ) == found
        assert list(same.classes_) == ["1", "2"]
    with pytest.raises(FormatError, match=r"is a recogniser of connected words, and a word recogniser is needed here"):
        package.WordRecognizer.load(tmp_path / "words.hri")


def test_language_and_decoder_change_after_training(words: ConnectedWordRecognizer, sentence: np.ndarray) -> None:
    changed = copy.deepcopy(words)
    changed.set_language(NGramModel.train([["2"]] * 1000, vocabulary=["1"]))
    assert changed.recognise(sentence, RATE_HZ).text == "1 2 2 1"
    changed.set_decoder(language_scale=1e5)
    assert changed.recognise(sentence, RATE_HZ).text == "2"
    assert changed.recognise(sentence, RATE_HZ, num_words=4).text == "1 2 2 1"
    with pytest.raises(InvalidArgument, match="does not know '1'"):
        changed.set_language(NGramModel.train([["2"]]))
    with pytest.raises(InvalidArgument, match="beam"):
        changed.set_decoder(beam=-1)


def test_other_sentences_their_words_and_places(
    words: ConnectedWordRecognizer, sentence: np.ndarray, tmp_path: Path
) -> None:
    found = words.recognise(sentence, RATE_HZ, num_alternatives=3)
    assert all(word.confidence is not None and 0.5 < word.confidence <= 1 for word in found.words)
    assert found.alternatives[0].text == found.text and len({a.text for a in found.alternatives}) == len(
        found.alternatives
    )
    lattice, first_s, frame_s = words.lattice(sentence, RATE_HZ)
    assert [word.model for word in lattice.best().words if word.model < 2] == [int(label) - 1 for label in WORDS]
    slots = words.confusion_network(sentence, RATE_HZ)
    assert [slot.entries[0][0] for slot in slots if slot.entries[0][0] >= 0] == [int(label) - 1 for label in WORDS]
    assert all(sum(p for _, p in slot.entries) == pytest.approx(1) for slot in slots)
    labels = ["1", "2", "<sil>"]
    written = WordLattice.of_lattice(lattice, labels, first_s, frame_s)
    back = WordLattice.parse(written.to_text(), "file").to_lattice(labels, ["<sil>"], first_s, frame_s)
    assert back.best().log_score == pytest.approx(lattice.best().log_score)
    np.testing.assert_allclose(np.sort(back.posteriors(0.1)), np.sort(lattice.posteriors(0.1)), atol=1e-9)


def test_a_grammar_fills_slots(words: ConnectedWordRecognizer, sentence: np.ndarray) -> None:
    follows = copy.deepcopy(words).set_grammar(Grammar.parse(GRAMMAR, "tones.jsgf"))
    found = follows.recognise(sentence, RATE_HZ)
    assert found.text == "1 2 2 1" and found.slots == {"gesture": "wave", "count": "2 2"}
    assert found.to_dict()["slots"] == found.slots
    with pytest.raises(InvalidArgument, match="the grammar has the word '3', which is no label"):
        words.set_grammar(Grammar.parse("#JSGF V1.0;\ngrammar g;\npublic <s> = 3;", "g"))


def test_unknown_words_are_found_by_fillers(spoken: Path, tmp_path: Path) -> None:
    samples = Dataset.load(spoken).samples
    clips, labels = [s.path for s in samples], [s.label for s in samples]
    fillers = [
        FillerWord(tone_word(base_hz + 10 * take, 20, 300 + take), RATE_HZ, str(base_hz))
        for base_hz in (1500, 2000, 2500, 3000)
        for take in range(3)
    ]
    fillers.append(FillerWord(np.zeros(10, np.float32), RATE_HZ, "1"))  # a label is no filler
    model = ConnectedWordRecognizer(**OPTIONS, unknown_words=True, unknown_margin=0.5)
    model.fit(clips, labels, groups=[s.person for s in samples], fillers=fillers)
    said = [tone_word(575, 800, 60), tone_word(2240, 30, 61), tone_word(575, -350, 62)]
    audio = np.concatenate([clip[RATE_HZ // 10 : 4 * RATE_HZ // 5] for clip in said])
    found = model.recognise(audio, RATE_HZ)
    assert found.labels == ("1", "<unk>", "2") and found.words[1].unknown
    model.save(tmp_path / "m.hri")
    assert ConnectedWordRecognizer.load(tmp_path / "m.hri").recognise(audio, RATE_HZ) == found
    stream = ConnectedWordStream(model, RATE_HZ)
    assert [r.transcript.labels for r in (*stream.process(audio), *stream.finish()) if r.is_final] == [found.labels]
    silence = FillerWord(np.zeros(RATE_HZ, np.float32), RATE_HZ, "quiet")
    with pytest.raises(InvalidArgument, match="no recording of the label 'quiet' has speech in it"):
        model.fit(clips, labels, fillers=[silence])


def test_a_stream_gives_what_it_has_and_ends_as_the_file_does(
    words: ConnectedWordRecognizer, sentence: np.ndarray
) -> None:
    rng = np.random.default_rng(0)
    quiet = (0.001 * rng.standard_normal(2 * RATE_HZ)).astype(np.float32)
    stream = ConnectedWordStream(words, RATE_HZ)
    audio = np.concatenate([quiet, sentence, quiet, sentence, quiet])
    results = [result for at in range(0, len(audio), 320) for result in stream.process(audio[at : at + 320])]
    results += stream.finish()
    final = [result for result in results if result.is_final]
    assert [result.transcript.text for result in final] == ["1 2 2 1"] * 2
    assert final[0].transcript.words[0].first_s == pytest.approx(2.35, abs=0.05)
    stable = [result.num_stable for result in results[: results.index(final[0])]]
    assert stable == sorted(stable) and stable[-1] >= 1
    with pytest.raises(InvalidArgument, match="wake_word is 'robot', which is no label"):
        ConnectedWordStream(words, RATE_HZ, wake_word="robot")


def test_what_cannot_be_done_is_refused(words: ConnectedWordRecognizer, sentence: np.ndarray) -> None:
    with pytest.raises(NotFittedError):
        ConnectedWordRecognizer().recognise(sentence, RATE_HZ)
    for name, value, message in (
        ("num_words", 0, r"is 0, must lie in 1\.\.1000"),
        ("num_words", 2**70, r"is \d+, must lie in 1\.\.1000"),
        ("num_words", 1.5, r"must be an integer, got 1\.5"),
        ("num_words", True, "must be an integer, got True"),
        ("num_alternatives", -1, r"is -1, must lie in 0\.\.1000"),
        ("num_alternatives", "2", "must be an integer, got '2'"),
    ):
        with pytest.raises(InvalidArgument, match=f"{name} {message}"):
            words.recognise(sentence, RATE_HZ, **{name: value})
    assert len(words.recognise(sentence, RATE_HZ, num_words=np.int64(2)).words) == 2
    with pytest.raises(InvalidArgument, match=r"num_words must be an integer, got 1\.5"):
        words.lattice(sentence, RATE_HZ, num_words=1.5)
    with pytest.raises(InvalidArgument, match="differ in length"):
        ConnectedWordRecognizer().fit([sentence], ["1", "2"], sample_rate_hz=RATE_HZ)
    with pytest.raises(InvalidArgument, match=r"words\.use_network must be false"):
        ConnectedWordRecognizer(words={"use_network": True})


def test_command_line_trains_and_transcribes(hri, spoken: Path, sentence: np.ndarray, tmp_path: Path) -> None:
    NGramModel.train([["1", "2", "2", "1"]]).save(tmp_path / "digits.arpa")
    options = [f"words.{name}={value}" for name, value in OPTIONS["words"].items()]
    arguments = [word for option in options for word in ("--option", option)]
    trained = hri("train-connected", "--data", spoken, "--language", tmp_path / "digits.arpa", *arguments)
    assert (trained.code, trained.out) == (0, f"{tmp_path / 'data' / 'hri' / 'connected.hri'}\n")
    assert "insertion penalty: " in trained.err
    file = tmp_path / "number.wav"
    write_wav_pcm16(str(file), sentence, RATE_HZ)
    assert hri("transcribe", file).out == "1 2 2 1\n"
    assert hri("transcribe", file, "--words", 3).out.split()[0] in ("1", "2")
    lines = hri("transcribe", file, "--times").out.splitlines()
    assert [line.split("\t")[2] for line in lines] == WORDS
    found = json.loads(hri("transcribe", file, "--json", "-").out)
    assert found[str(file)]["text"] == "1 2 2 1"
    (tmp_path / "tones.jsgf").write_text(GRAMMAR)
    assert hri("transcribe", file, "--grammar", tmp_path / "tones.jsgf").out == "1 2 2 1\tcount=2 2\tgesture=wave\n"
    assert hri("transcribe", file, "--alternatives", 2).out.splitlines()[0].endswith("\t1 2 2 1")
    hri("transcribe", file, "--lattices", tmp_path / "lattices")
    assert WordLattice.read(tmp_path / "lattices" / "number.slf").times_s
    streamed = [json.loads(line) for line in hri("transcribe", "--stream", file).out.splitlines()]
    assert streamed[-1]["event"] == "final" and streamed[-1]["text"] == "1 2 2 1"
    refused = hri("transcribe", file, "--grammar", tmp_path / "tones.jsgf", "--robot", tmp_path / "wave.mp4")
    assert refused.code == 3 and "the slot 'count' says nothing about a gesture" in refused.err
    (tmp_path / "tones.jsgf").write_text(GRAMMAR.replace("{count}", "{times=2}"))
    film = hri("transcribe", file, "--grammar", tmp_path / "tones.jsgf", "--robot", tmp_path / "wave.mp4")
    assert film.code == 0 and (tmp_path / "wave.mp4").stat().st_size > 10000
    assert hri("transcribe").code == 2 and hri("transcribe", file, "--robot", "a.mp4").code == 2
    assert hri("transcribe", file, "--words", 1000).err.count("too short for 1000 words") == 1


@pytest.mark.skipif(shutil.which("espeak-ng") is None, reason="espeak-ng is not installed")
def test_a_word_that_nobody_recorded_is_added_by_its_spelling(hri, spoken: Path, tmp_path: Path) -> None:
    options = [f"words.{name}={value}" for name, value in OPTIONS["words"].items()]
    arguments = ["--data", spoken, "--out", tmp_path / "words.hri", "--voices", 3]
    arguments += [word for option in options for word in ("--option", option)]
    trained = hri("train-connected", *arguments, "--add", "रुको", "--add", "go=come here", "--json", "-")
    report = json.loads(trained.out)
    assert report["labels"] == ["1", "2", "go", "रुको"] and report["synthetic_labels"] == ["रुको", "go"]
    assert "not recorded, said by 3 synthetic voices: रुको go" in trained.err
    assert SpokenWords.read_beside(tmp_path / "words.hri") == SpokenWords("en", {"रुको": "रुको", "go": "come here"}, 3)
    said = speak("come here", "en", make_speaker(5))  # another voice
    model = ConnectedWordRecognizer.load(tmp_path / "words.hri")
    assert model.recognise(said).labels == ("go",)
    for wrong in ("1", "go=", "=go"):
        refused = hri("train-connected", *arguments, "--add", "go", "--add", wrong)
        assert refused.code == 2 and f"--add {wrong!r}" in refused.err
    refused = hri("train-connected", *arguments, "--add", "go", "--voice", "../en")
    assert refused.code == 3 and "'../en' is no name of a language" in refused.err
    assert hri("train-connected", *arguments).code == 0
    assert SpokenWords.read_beside(tmp_path / "words.hri") is None  # it has no such words any more


def test_command_line_says_what_is_missing(hri, spoken: Path, tmp_path: Path) -> None:
    file = next(spoken.glob("*.wav"))
    refused = hri("transcribe", file)
    assert refused.code == 3 and "run 'hri train-connected --data DIR'" in refused.err
    wrong = hri("train-connected", "--data", spoken, "--option", "word=1")
    assert wrong.code == 3 and "ConnectedWordRecognizerOptions has no field 'word'" in wrong.err
    (tmp_path / "bad.arpa").write_text("\\data\\\n")
    damaged = hri("train-connected", "--data", spoken, "--language", tmp_path / "bad.arpa")
    assert damaged.code == 3 and "bad.arpa: line 1: has no counts of n-grams" in damaged.err


def test_command_line_refuses_what_training_chooses(hri, spoken: Path) -> None:
    for option in ("decoder.insertion_penalty=-30", "confidence_scale=0.1", "unknown_lead=0"):
        refused = hri("train-connected", "--data", spoken, "--option", option)
        name = option.partition("=")[0]
        assert refused.code == 2 and f"--option {name} is chosen in training: with --option choose_penalty=false" in (
            refused.err
        )


@pytest.fixture
def kept(words: ConnectedWordRecognizer, sentence: np.ndarray, tmp_path: Path) -> tuple[Path, Path]:
    """A model and a recording of the sentence, as files."""
    words.save(tmp_path / "words.hri")
    write_wav_pcm16(str(tmp_path / "number.wav"), sentence, RATE_HZ)
    return tmp_path / "words.hri", tmp_path / "number.wav"


def test_transcribe_refuses_what_would_have_no_effect(hri, kept: tuple[Path, Path], tmp_path: Path) -> None:
    model, file = kept
    (tmp_path / "tones.jsgf").write_text(GRAMMAR)
    NGramModel.train([WORDS]).save(tmp_path / "digits.arpa")
    grammar, language = ("--grammar", tmp_path / "tones.jsgf"), ("--language", tmp_path / "digits.arpa")
    for arguments, message in (
        (("--stream", "--words", 2), "--words is for whole recordings"),
        (("--stream", "--alternatives", 3), "--alternatives is for whole recordings"),
        (("--stream", "--lattices", tmp_path), "--lattices is for whole recordings"),
        (("--stream", "--mlf", tmp_path / "a.mlf"), "--mlf is for whole recordings"),
        (("--stream", "--json", "-"), "--json goes without --stream"),
        ((*grammar, "--words", 2), "--grammar and --words exclude each other"),
        ((*language, "--words", 2), "--language and --words exclude each other"),
        ((*language, *grammar), "and --grammar exclude each other"),
        (("--no-language", *language), "and --language exclude each other"),
    ):
        refused = hri("transcribe", file, "--model", model, *arguments)
        assert refused.code == 2 and message in refused.err
    for arguments in (("--no-grammar",), ("--no-language",), ("--language-scale", 3)):
        refused = hri("transcribe", file, "--model", model, *arguments)
        assert refused.code == 3 and arguments[0] in refused.err
    streamed = hri("transcribe", file, "--model", model, "--stream", "--times")
    assert [line.split("\t")[2] for line in streamed.out.splitlines()] == WORDS


def test_transcribe_goes_on_behind_a_bad_recording(hri, kept: tuple[Path, Path], tmp_path: Path) -> None:
    model, file = kept
    (tmp_path / "empty.wav").write_bytes(b"RIFF")
    other = tmp_path / "other.wav"
    shutil.copy(file, other)
    done = hri("--quiet", "transcribe", file, tmp_path / "empty.wav", other, "--model", model, "--json", tmp_path / "j")
    assert done.code == 3 and done.err.count("hri: error: ") == 1 and "empty.wav" in done.err
    assert done.out == f"{file}\t1 2 2 1\n{other}\t1 2 2 1\n"
    found = json.loads((tmp_path / "j").read_text())
    assert found[str(other)]["text"] == "1 2 2 1" and list(found[str(tmp_path / "empty.wav")]) == ["error"]
    lines = hri("transcribe", file, other, "--model", model, "--times").out.splitlines()
    assert [line.split("\t")[0] for line in lines] == [str(file)] * 4 + [str(other)] * 4


def test_a_grammar_with_another_word_is_named(hri, kept: tuple[Path, Path], tmp_path: Path) -> None:
    model, file = kept
    path = tmp_path / "three.jsgf"
    path.write_text("#JSGF V1.0;\ngrammar g;\npublic <s> = 1 3;\n")
    refused = hri("transcribe", file, "--model", model, "--grammar", path)
    assert refused.code == 3 and f"{path}: the grammar has the word '3', which is no label" in refused.err


def test_words_of_no_sentence_of_the_grammar_are_no_result(hri, kept: tuple[Path, Path], tmp_path: Path) -> None:
    model, file = kept
    (tmp_path / "long.jsgf").write_text(
        f"#JSGF V1.0;\ngrammar g;\n<w> = 1 | 2;\npublic <s> = {' '.join(100 * ['<w>'])};\n"
    )
    done = hri("transcribe", file, "--model", model, "--grammar", tmp_path / "long.jsgf")
    assert (done.code, done.out) == (0, "\n") and "no sentence of the grammar fits" in done.err
    report = hri("transcribe", file, "--model", model, "--grammar", tmp_path / "long.jsgf", "--json", "-").out
    (found,) = json.loads(report).values()
    assert not found["complete"] and found["words"] == [] and found["notes"] == ["no sentence of the grammar fits"]


def test_lattices_stand_apart_and_say_scale_and_penalty(
    hri, words: ConnectedWordRecognizer, kept: tuple[Path, Path], tmp_path: Path
) -> None:
    model, file = kept
    (tmp_path / "a").mkdir()
    shutil.copy(file, tmp_path / "a" / "number.wav")
    refused = hri("transcribe", file, tmp_path / "a" / "number.wav", "--model", model, "--lattices", tmp_path / "l")
    assert refused.code == 2 and "would both be" in refused.err and not (tmp_path / "l").exists()
    assert hri("transcribe", file, "--model", model, "--lattices", tmp_path / "l", "--words", 3).code == 0
    written = WordLattice.read(tmp_path / "l" / "number.slf")
    assert written.insertion_penalty == words.insertion_penalty and written.language_scale == 1
    assert {weight for _, _, weight in written.arcs} == {0.0}  # words in any order have no weight
    lattice, first_s, frame_s = words.lattice(file, num_words=3)
    back = written.to_lattice(["1", "2", "<sil>", "<unk>"], ["<sil>"], first_s, frame_s)
    assert len([word for word in back.best().words if word.model < 2]) == 3
    assert back.best().log_score == pytest.approx(lattice.best().log_score)
    with pytest.raises(InvalidArgument, match="num_words is 0"):
        words.lattice(file, num_words=0)


def test_a_language_model_or_grammar_is_set_and_dropped(
    hri, words: ConnectedWordRecognizer, kept: tuple[Path, Path], tmp_path: Path
) -> None:
    model, file = kept
    plain = words.to_model_file().to_bytes()
    changed = copy.deepcopy(words).set_grammar(Grammar.parse("#JSGF V1.0;\ngrammar g;\npublic <s> = 1 2;", "g"))
    assert changed.grammar is not None and changed.grammar.words == ["1", "2"] and changed.language is None
    changed.save(tmp_path / "grammar.hri")
    assert changed.set_grammar(None).grammar is None and changed.to_model_file().to_bytes() == plain
    language = NGramModel.train([["2"]] * 1000, vocabulary=["1"])
    changed.set_language(language).save(tmp_path / "language.hri")
    assert changed.language is not None and changed.language.to_arpa() == language.to_arpa()
    assert changed.set_language(None).language is None and changed.to_model_file().to_bytes() == plain
    lines = hri("info", tmp_path / "grammar.hri").out.splitlines()
    assert "grammar words\t1 2" in lines and any(line.startswith("grammar nodes\t") for line in lines)
    assert {"language order\t2", "language ngrams\t4 2"} <= set(hri("info", tmp_path / "language.hri").out.splitlines())
    assert hri("transcribe", file, "--model", tmp_path / "grammar.hri").out == "1 2\n"
    assert hri("transcribe", file, "--model", tmp_path / "grammar.hri", "--no-grammar").out == "1 2 2 1\n"
    language.save(tmp_path / "twos.arpa")
    free = ("--model", model, "--language", tmp_path / "twos.arpa")
    assert hri("transcribe", file, *free, "--language-scale", 1e5).out == "2\n"
    counted = hri("transcribe", file, "--model", tmp_path / "language.hri", "--words", 4)
    assert counted.out == "1 2 2 1\n" and "the language model of the model has no say" in counted.err


def test_training_checks_the_language_model_before_it_begins(hri, spoken: Path, tmp_path: Path) -> None:
    options = [f"words.{name}={value}" for name, value in OPTIONS["words"].items()]
    arguments = ["--data", spoken, *(word for option in options for word in ("--option", option))]
    (tmp_path / "1.arpa").write_text("\\data\\\nngram 1=3\n\n\\1-grams:\n-1 </s>\n-99 <s>\n-1 1\n\n\\end\\\n")
    refused = hri("train-connected", *arguments, "--language", tmp_path / "1.arpa")
    assert refused.code == 3 and "1.arpa: does not have these labels, and no <unk>: 2" in refused.err
    NGramModel.train([WORDS], NGramOptions(order=3)).save(tmp_path / "3.arpa")
    refused = hri("train-connected", *arguments, "--language", tmp_path / "3.arpa")
    assert refused.code == 3 and "3.arpa: has order 3" in refused.err
    assert not (tmp_path / "data").exists()
    (tmp_path / "1.arpa").write_text("\\data\\\nngram 1=4\n\n\\1-grams:\n-1 </s>\n-99 <s>\n-1 <unk>\n-1 1\n\n\\end\\\n")
    for extra, scale in (((), 10), (("--language-scale", 7), 7), (("--option", "decoder.language_scale=1"), 1)):
        trained = hri("train-connected", *arguments, "--language", tmp_path / "1.arpa", *extra)
        assert trained.code == 0 and "<unk> stands for each: 2\n" in trained.err
        assert ConnectedWordRecognizer.load(trained.out.strip()).language_scale == scale
    both = ("--language", tmp_path / "1.arpa", "--option", "decoder.language_scale=1", "--language-scale", 2)
    assert hri("train-connected", *arguments, *both).code == 2
    assert "goes with --language" in hri("train-connected", *arguments, "--language-scale", 2).err


def test_htk_counts_errors_of_what_was_transcribed(hri, kept: tuple[Path, Path], tmp_path: Path) -> None:
    model, file = kept
    assert hri("transcribe", file, "--model", model, "--mlf", tmp_path / "found.mlf").code == 0
    (tmp_path / "said.mlf").write_text('#!MLF!#\n"*/number.lab"\n1\n2\n1\n.\n')
    (tmp_path / "list").write_text("1\n2\n")
    counted = hri("htk", "results", "-I", tmp_path / "said.mlf", tmp_path / "list", tmp_path / "found.mlf")
    assert "[H=3, D=0, S=0, I=1, N=3]" in counted.out


def test_word_errors_are_measured_with_speakers_held_out(
    hri, spoken: Path, sentence: np.ndarray, tmp_path: Path
) -> None:
    (tmp_path / "numbers").mkdir()
    for name in ("a_low.wav", "b.wav"):
        write_wav_pcm16(str(tmp_path / "numbers" / name), sentence, RATE_HZ)
    said = tmp_path / "numbers" / "said.mlf"
    said.write_text('#!MLF!#\n"*/a_low.lab"\n1\n2\n2\n1\n.\n"*/b.lab"\n1\n2\n3\n.\n')
    quick = ("words.num_states=5", "words.num_vtlp_factors=1", "words.num_noisy_copies=0", "choose_penalty=false")
    arguments = ("--data", spoken, "--transcripts", said, *(f"--option={option}" for option in quick))
    measured = hri("evaluate", "connected", *arguments, "--json", tmp_path / "found.json")
    assert measured.code == 0 and "name no person" in measured.err and "wherever they stand: 3" in measured.err
    rows = [line.split("\t") for line in measured.out.splitlines()]
    assert [row[0] for row in rows] == ["held out", "low", "others", "all"]
    assert rows[1][1:] == ["1", "4", "0", "0", "0", "0.0 %", "100.0 %"] and rows[2][3:6] == ["1", "0", "1"]
    found = json.loads((tmp_path / "found.json").read_text())
    assert found["word_error_rate"] == 2 / 7 and found["folds"][0]["items"][0]["found"] == WORDS
    said.write_text("1 2 2 1 (a_low)\n1 2 2 (c)\n")
    refused = hri("evaluate", "connected", *arguments)
    assert refused.code == 3 and "'c' is the name of 0 recordings" in refused.err
    said.write_text("1 2 2 1 (b)\n1 2 2 1 (b)\n")
    refused = hri("evaluate", "connected", *arguments)
    assert (
        refused.code == 3 and "said.mlf: says 2 times what was said in" in refused.err and "row 1, row 2" in refused.err
    )
    said.write_text("1 2 2 1\n")
    assert "row 1: is not words and the name" in hri("evaluate", "connected", *arguments).err
    for wrong in (("--folds", 2), ("--noise", "white"), ("--network",)):
        refused = hri("evaluate", "connected", *arguments, *wrong)
        assert refused.code == 2 and f"{wrong[0]} is for speech and gesture" in refused.err
    assert "--transcripts is for connected" in hri("evaluate", "speech", *arguments).err
    assert "connected takes --data DIR" in hri("evaluate", "connected", "--data", spoken).err
