# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Times of words that are known: from Python and by ``hri align``."""

from __future__ import annotations

import copy
import json
import shutil
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from conftest import RATE_HZ, tone_word
from hri.core.errors import FormatError, InvalidArgument, NotFittedError
from hri.datasets import Dataset
from hri.htk import MasterLabelFile
from hri.io import write_wav_pcm16
from hri.language import Grammar, NGramModel
from hri.media import Audio, read_audio
from hri.recognition import ConnectedWordRecognizer
from hri.signal import find_speech
from hri.synthetic.speech import make_speaker, speak, speak_words

WORDS = ["1", "2", "2", "1"]
QUICK = {"num_states": 5, "num_vtlp_factors": 1, "num_noisy_copies": 1, "min_snr_db": 10.0}


def _trained(spoken: Path, **options: str | int) -> ConnectedWordRecognizer:
    samples = Dataset.load(spoken).samples
    return ConnectedWordRecognizer(words={**QUICK, **options}, max_words=4).fit(
        [s.path for s in samples], [s.label for s in samples], groups=[s.person for s in samples]
    )


@pytest.fixture(scope="module")
def words(spoken: Path) -> ConnectedWordRecognizer:
    return _trained(spoken)


@pytest.fixture(scope="module")
def sentence() -> np.ndarray:
    """The words by a speaker who was not trained on, each in the second half second of 0.7 s."""
    clips = [tone_word(575, 800 if word == "1" else -350, 50 + i) for i, word in enumerate(WORDS)]
    middle = [clip[RATE_HZ // 10 : 4 * RATE_HZ // 5] for clip in clips]
    return np.concatenate([clips[0][: RATE_HZ // 5], *middle, clips[0][: RATE_HZ // 5]])


@pytest.fixture
def kept(words: ConnectedWordRecognizer, sentence: np.ndarray, tmp_path: Path) -> tuple[Path, Path]:
    """A model and a recording of the sentence, as files."""
    words.save(tmp_path / "words.hri")
    write_wav_pcm16(str(tmp_path / "number.wav"), sentence, RATE_HZ)
    return tmp_path / "words.hri", tmp_path / "number.wav"


@pytest.mark.parametrize("model", ["hmm", "ptbhmm"])
def test_words_that_would_be_found_have_the_same_times(spoken: Path, sentence: np.ndarray, model: str) -> None:
    recognizer = _trained(spoken, model=model)
    found = recognizer.recognise(sentence, RATE_HZ)
    assert list(found.labels) == WORDS
    assert recognizer.align(sentence, RATE_HZ, words=WORDS) == found


def test_every_form_of_a_recording_is_taken(words: ConnectedWordRecognizer, kept: tuple[Path, Path]) -> None:
    _, file = kept
    of_path = words.align(file, words=WORDS)
    assert list(of_path.labels) == WORDS and of_path.complete
    assert words.align(str(file), words=tuple(WORDS)) == of_path
    audio = read_audio(file)
    assert words.align(np.round(32768 * audio.samples).astype(np.int16), RATE_HZ, words=WORDS).words == of_path.words
    assert words.align(Audio(audio.samples, RATE_HZ), words=np.array(WORDS)).words == of_path.words


def test_what_the_model_holds_has_no_say(words: ConnectedWordRecognizer, sentence: np.ndarray) -> None:
    found = words.align(sentence, RATE_HZ, words=WORDS)
    held = copy.deepcopy(words)
    held.set_grammar(Grammar.parse("#JSGF V1.0;\ngrammar g;\npublic <s> = 2 2;", "g.jsgf"))
    assert held.align(sentence, RATE_HZ, words=WORDS) == found
    held.set_language(NGramModel.train([["2"]] * 1000, vocabulary=["1"])).set_decoder(language_scale=1e5)
    assert held.align(sentence, RATE_HZ, words=WORDS) == found


def test_other_words_than_were_said_are_aligned_with_little_confidence(
    words: ConnectedWordRecognizer, sentence: np.ndarray
) -> None:
    found = words.align(sentence, RATE_HZ, words=["1", "1", "2", "1"])
    assert found.labels == ("1", "1", "2", "1") and found.complete
    wrong, right = found.words[1], found.words[2]
    assert wrong.confidence is not None and right.confidence is not None
    assert wrong.confidence < 0.1 < 0.9 < right.confidence and not wrong.unknown
    assert wrong.first_s == pytest.approx(0.2 + 0.7 + 0.15, abs=0.05)  # between words that are right
    assert found.log_score < words.align(sentence, RATE_HZ, words=WORDS).log_score


def test_a_recording_without_room_for_its_words_is_not_complete(
    words: ConnectedWordRecognizer, sentence: np.ndarray
) -> None:
    short = words.align(sentence, RATE_HZ, words=["1"] * 200)
    assert not short.complete and len(short.words) < 200
    silent = words.align(np.zeros(RATE_HZ, np.float32), RATE_HZ, words=["1"])
    assert not silent.complete and silent.words == ()


def test_words_that_cannot_be_aligned_are_refused(words: ConnectedWordRecognizer, kept: tuple[Path, Path]) -> None:
    _, file = kept
    for wrong, message in (
        (["1", "9"], "words: there is no word '9'; the words are 1 2"),
        (["<unk>"], "there is no word '<unk>'"),
        ([], "words: there is none"),
        (["1"] * 1001, "more than 1000"),
        ("1 2", r"write \['1', '2'\]"),
    ):
        with pytest.raises(InvalidArgument, match=message):
            words.align(file, words=wrong)
    with pytest.raises(InvalidArgument, match="give sample_rate_hz"):
        words.align(np.zeros(RATE_HZ), words=WORDS)
    file.write_bytes(b"RIFF")
    with pytest.raises(FormatError, match=r"number\.wav"):
        words.align(file, words=WORDS)
    with pytest.raises(NotFittedError):
        ConnectedWordRecognizer().align(np.zeros(RATE_HZ), RATE_HZ, words=WORDS)


@pytest.mark.skipif(shutil.which("espeak-ng") is None, reason="espeak-ng is not installed")
@pytest.mark.parametrize("pause_s", [0.0, 0.3])
def test_words_of_another_voice_are_where_they_were_put(pause_s: float) -> None:
    texts = {"1": "one", "2": "two", "3": "three", "4": "four"}
    clips, labels, voices = speak_words({"en": texts}, num_speakers=4)
    model = ConnectedWordRecognizer(words={"num_states": 6}).fit(clips, labels, groups=voices)
    said = ["4", "1", "3", "1", "2"]
    parts: list[np.ndarray] = []
    expected = []
    now_s = 0.0
    for word in said:
        clip = speak(texts[word], "en", make_speaker(9))
        rate = clip.sample_rate_hz
        speech = find_speech(clip.samples, rate)
        assert speech is not None
        expected.append((now_s + speech[0] / rate, now_s + speech[1] / rate))
        parts += [clip.samples, np.zeros(round(pause_s * rate), np.float32)]
        now_s += sum(map(len, parts[-2:])) / rate
    found = model.align(np.concatenate(parts), rate, words=said)
    assert list(found.labels) == said and found.complete
    for word, (first_s, last_s) in zip(found.words, expected, strict=True):
        assert word.first_s == pytest.approx(first_s, abs=0.08)
        assert word.last_s == pytest.approx(last_s, abs=0.08)


def test_align_prints_times_as_transcribe_does(hri, kept: tuple[Path, Path], tmp_path: Path) -> None:
    model, file = kept
    done = hri("align", file, "--model", model, "--words", "1 2 2 1", "--mlf", tmp_path / "times.mlf")
    assert (done.code, done.err) == (0, "")
    assert done.out == hri("transcribe", file, "--model", model, "--times").out
    ((name, labels),) = MasterLabelFile.read(tmp_path / "times.mlf").entries
    assert name == str(file.with_suffix(".lab")) and [label.name for label in labels.labels] == WORDS
    first = done.out.split("\t")[0]
    assert labels.labels[0].first == pytest.approx(float(first) * 1e7, abs=1e4)
    report = json.loads(hri("align", file, "--model", model, "--words", "1 2 2 1", "--json", "-").out)
    assert report[str(file)]["text"] == "1 2 2 1" and report[str(file)]["words"][0]["confidence"] > 0.9
    (tmp_path / "list").write_text("1\n2\n")
    assert hri("transcribe", file, "--model", model, "--mlf", tmp_path / "found.mlf").code == 0
    counted = hri("htk", "results", "-I", tmp_path / "times.mlf", tmp_path / "list", tmp_path / "found.mlf")
    assert "[H=4, D=0, S=0, I=0, N=4]" in counted.out


@pytest.mark.parametrize(
    "table",
    ['#!MLF!#\n"*/number.lab"\n1\n2\n2\n1\n.\n"*/other.lab"\n1\n2\n1\n.\n', "1 2 2 1 (number)\n\n1 2 1 (other)\n"],
    ids=["mlf", "trn"],
)
def test_words_come_from_a_table(hri, kept: tuple[Path, Path], tmp_path: Path, table: str) -> None:
    model, file = kept
    other = tmp_path / "below" / "other.wav"
    other.parent.mkdir()
    shutil.copy(file, other)
    (tmp_path / "said.txt").write_text(table)
    read = ("--model", model, "--transcripts", tmp_path / "said.txt")
    every = hri("align", *read)
    assert every.code == 0
    lines = [line.split("\t") for line in every.out.splitlines()]
    assert [(line[0], line[3]) for line in lines] == [
        *((str(file), word) for word in WORDS),
        *((str(other), word) for word in ("1", "2", "1")),
    ]
    assert hri("align", other, *read).out.splitlines() == ["\t".join(line[1:]) for line in lines[4:]]
    shutil.copy(file, tmp_path / "below" / "number.wav")
    twice = hri("align", *read)
    assert twice.code == 3 and "is the name of 2 recordings" in twice.err
    assert [line.split("\t")[0] for line in twice.out.splitlines()] == [str(other)] * 3


def test_align_goes_on_behind_what_is_wrong(hri, kept: tuple[Path, Path], tmp_path: Path) -> None:
    model, file = kept
    for name in ("a", "b", "c", "d", "e", "f"):
        shutil.copy(file, tmp_path / f"{name}.wav")
    (tmp_path / "a.wav").write_bytes(b"RIFF")
    (tmp_path / "said.trn").write_text(
        f"1 2 2 1 (a)\n1 2 9 1 (b)\n(c)\n1 2 2 1 (d)\n1 2 2 1 (d)\n{'1 ' * 200}(e)\n1 2 2 1 (number)\n"
    )
    files = [tmp_path / f"{name}.wav" for name in ("a", "b", "c", "d", "e", "f", "number")]
    outputs = ("--json", tmp_path / "j", "--mlf", tmp_path / "times.mlf", "--textgrids", tmp_path / "grids")
    done = hri("--quiet", "align", *files, "--model", model, "--transcripts", tmp_path / "said.trn", *outputs)
    assert done.code == 3 and [line.split("\t")[0] for line in done.out.splitlines()] == [str(file)] * 4
    for line, message in zip(
        done.err.splitlines(),
        (
            "a.wav",
            "said.trn: row 2: '9' is no word of the model, whose words are 1 2",
            "said.trn: row 3: 'c' has no word",
            "said.trn: says 2 times what was said in",
            "e.wav: is too short for its 200 words",
            "said.trn: says 0 times what was said in",
        ),
        strict=True,
    ):
        assert line.startswith("hri: error: ") and message in line
    report = json.loads((tmp_path / "j").read_text())
    assert [list(report[str(file)]) == ["error"] for file in files] == [True] * 6 + [False]
    assert len(MasterLabelFile.read(tmp_path / "times.mlf").entries) == 1
    assert [path.name for path in (tmp_path / "grids").iterdir()] == ["number.TextGrid"]


def test_a_row_of_a_master_label_file_is_named(hri, kept: tuple[Path, Path], tmp_path: Path) -> None:
    model, _ = kept
    shutil.copy(kept[1], tmp_path / "silent.wav")
    (tmp_path / "said.mlf").write_text('#!MLF!#\n"*/number.lab"\n1\n9\n.\n"*/gone.lab"\n1\n.\n"*/silent.lab"\n.\n')
    done = hri("align", "--model", model, "--transcripts", tmp_path / "said.mlf")
    assert done.code == 3 and "said.mlf: row 4: '9' is no word of the model" in done.err
    assert "said.mlf: row 6: '*/gone.lab' is the name of 0 recordings" in done.err
    assert "said.mlf: row 9: '*/silent.lab' has no word" in done.err


@pytest.mark.parametrize("output", [(), ("--mlf",), ("--textgrids",)], ids=["", "mlf", "textgrids"])
def test_a_recording_that_stands_twice_is_named_and_the_others_are_aligned(
    hri, kept: tuple[Path, Path], tmp_path: Path, output: tuple[str, ...]
) -> None:
    model, file = kept
    shutil.copy(file, tmp_path / "twice.wav")
    (tmp_path / "said.trn").write_text("1 2 2 1 (twice)\n1 2 2 1 (number)\n2 (twice)\n1 (gone)\n2 (gone)\n")
    outputs = ("--json", tmp_path / "j", *(part for name in output for part in (name, tmp_path / "out")))
    done = hri("--quiet", "align", "--model", model, "--transcripts", tmp_path / "said.trn", *outputs)
    assert done.code == 3 and {line.split("\t")[0] for line in done.out.splitlines()} == {str(file)}
    twice = f"said.trn: says 2 times what was said in {tmp_path / 'twice.wav'}, not once: row 1, row 3"
    first, second = done.err.splitlines()
    assert twice in first and "said.trn: row 4: 'gone' is the name of 0 recordings" in second
    report = json.loads((tmp_path / "j").read_text())
    assert report[str(file)]["text"] == "1 2 2 1" and twice in report[str(tmp_path / "twice.wav")]["error"]


def test_an_empty_table_is_an_error(hri, kept: tuple[Path, Path], tmp_path: Path) -> None:
    (tmp_path / "said.trn").write_text("\n")
    refused = hri("align", "--model", kept[0], "--transcripts", tmp_path / "said.trn")
    assert refused.code == 3 and "said.trn: names no recording" in refused.err


def test_labels_with_spaces_are_quoted_in_messages(hri, spoken: Path, kept: tuple[Path, Path], tmp_path: Path) -> None:
    samples = Dataset.load(spoken).samples
    labels = ["go left" if s.label == "2" else s.label for s in samples]
    model = ConnectedWordRecognizer(words=QUICK, choose_penalty=False).fit([s.path for s in samples], labels)
    model.save(tmp_path / "spaced.hri")
    (tmp_path / "said.trn").write_text("go left (number)\n")
    for source in (("--words", "go left"), ("--transcripts", tmp_path / "said.trn")):
        refused = hri("align", kept[1], "--model", tmp_path / "spaced.hri", *source)
        assert refused.code == 3 and "'go' is no word of the model, whose words are 1 'go left'; those " in refused.err
        assert "with a space can be given in a master label file alone" in refused.err
    (tmp_path / "said.mlf").write_text('#!MLF!#\n"*/number.lab"\n1\n"go left"\ngo left\n.\n')
    read = ("align", kept[1], "--model", tmp_path / "spaced.hri", "--transcripts", tmp_path / "said.mlf")
    assert "row 5: 'go' is no word of the model, whose words are 1 'go left'\n" in hri(*read).err
    (tmp_path / "said.mlf").write_text('#!MLF!#\n"*/number.lab"\n1\n"go left"\n.\n')
    assert [line.split("\t")[2] for line in hri(*read).out.splitlines()] == ["1", "go left"]


def test_a_text_grid_covers_the_recording(hri, kept: tuple[Path, Path], tmp_path: Path) -> None:
    model, file = kept
    done = hri("align", file, "--model", model, "--words", "1 2 2 1", "--textgrids", tmp_path / "grids")
    assert done.code == 0
    lines = (tmp_path / "grids" / "number.TextGrid").read_text().splitlines()
    assert lines[:3] == ['File type = "ooTextFile"', 'Object class = "TextGrid"', ""]
    assert lines[7:9] == ['"IntervalTier"', '"words"']
    intervals = [tuple(lines[at : at + 3]) for at in range(12, len(lines), 3)]
    assert len(intervals) == int(lines[11])
    assert [text.strip('"') for _, _, text in intervals if text != '""'] == WORDS
    assert intervals[0][0] == "0.000000" and intervals[-1][1] == lines[4]
    assert all(before[1] == after[0] for before, after in pairwise(intervals))
    assert [line.split("\t")[0] for line in done.out.splitlines()] == [
        f"{float(first):.3f}" for first, _, text in intervals if text != '""'
    ]


def test_align_says_what_is_missing(hri, kept: tuple[Path, Path], tmp_path: Path) -> None:
    model, file = kept
    (tmp_path / "said.trn").write_text("1 2 2 1 (number)\n")
    table = ("--transcripts", tmp_path / "said.trn")
    (tmp_path / "below").mkdir()
    shutil.copy(file, tmp_path / "below" / "number.wav")
    both = (file, tmp_path / "below" / "number.wav")
    for arguments, message in (
        ((file,), "either by --words or by --transcripts"),
        ((file, "--words", "1", *table), "either by --words or by --transcripts"),
        (("--words", "1"), "name the recordings in which --words were said"),
        ((file, "--words", " "), "--words: there is no word"),
        ((*both, "--words", "1", "--textgrids", tmp_path / "g"), "--textgrids: the results of"),
    ):
        refused = hri("align", "--model", model, *arguments)
        assert refused.code == 2 and message in refused.err
    refused = hri("align", file, "--model", model, "--words", "1 9")
    assert refused.code == 3 and "--words: '9' is no word of the model, whose words are 1 2" in refused.err
    (tmp_path / "said.trn").write_text("1 2 2 1\n")
    refused = hri("align", file, "--model", model, *table)
    assert refused.code == 3 and "said.trn: row 1: is not words and the name" in refused.err
