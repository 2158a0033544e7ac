# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""HTK's files from Python against their layout in plain NumPy; its tools from recordings to word errors."""

from __future__ import annotations

import re
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from conftest import RATE_HZ, tone_word
from hri.core.errors import FormatError, InvalidArgument
from hri.htk import (
    Configuration,
    Dictionary,
    FeatureExtractor,
    Label,
    MasterLabelFile,
    ModelSet,
    ParameterFile,
    Recognizer,
    Results,
    Transcription,
    WordLattice,
    code_file,
    compare,
    load_observations,
    random_sentence,
    read_list,
    read_script,
    train_model,
)
from hri.io import write_wav_pcm16
from hri.language import count_word_errors

CONFIG = """# coding parameters
SOURCEFORMAT = WAV
TARGETKIND = MFCC_0_D
TARGETRATE = 100000.0
WINDOWSIZE = 250000.0
NUMCHANS = 26
SAVECOMPRESSED = T
"""
SLOPES = {"rise": 800.0, "fall": -350.0, "7": 0.0}
SENTENCES = [("rise", "fall"), ("7", "7", "rise"), ("fall", "7"), ("rise", "rise", "fall")]
PROTOTYPE = "~o <VECSIZE> 26 <MFCC_0_D>\n~h proto <BEGINHMM> <NUMSTATES> 8\n"


def read_plainly(path: Path) -> tuple[int, int, NDArray[np.float64]]:
    """Code, period and frames of a parameter file, by the HTK Book and NumPy alone."""
    data = path.read_bytes()
    count, period = np.frombuffer(data, ">i4", 2)
    width, code = np.frombuffer(data, ">u2", 2, 8)
    body = data[12 : -2 if code & 0o10000 else None]
    if code & 0o2000:
        columns = int(width) // 2
        scale, offset = np.frombuffer(body, ">f4", 2 * columns).reshape(2, columns).astype(float)
        integers = np.frombuffer(body, ">i2", (int(count) - 4) * columns, 8 * columns)
        return int(code), int(period), (integers.reshape(-1, columns) + offset) / scale
    return int(code), int(period), np.frombuffer(body, ">f4").reshape(count, -1).astype(float)


@pytest.fixture(scope="module")
def coded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Recordings of single words and of sentences, and a configuration."""
    folder = tmp_path_factory.mktemp("htk")
    (folder / "config").write_text(CONFIG)
    for take in range(3):
        for word, slope in SLOPES.items():
            base = 1200.0 if word == "7" else 500.0
            write_wav_pcm16(folder / f"{word}_{take}.wav", tone_word(base, slope, take), RATE_HZ)
    for number, sentence in enumerate(SENTENCES):
        clips = [tone_word(1200.0 if w == "7" else 500.0, SLOPES[w], 10 + number) for w in sentence]
        write_wav_pcm16(folder / f"sentence{number}.wav", np.concatenate(clips), RATE_HZ)
    return folder


def prototype() -> str:
    text = PROTOTYPE
    for state in range(2, 8):
        text += f"<STATE> {state} <MEAN> 26 {'0 ' * 26} <VARIANCE> 26 {'1 ' * 26}\n"
    rows = np.diag([0] + [0.6] * 6 + [0]) + np.diag([1] + [0.4] * 6, 1)
    return text + "<TRANSP> 8\n" + "\n".join(" ".join(f"{v:g}" for v in row) for row in rows) + "\n<ENDHMM>\n"


def test_tools_lead_from_recordings_to_word_errors(hri, coded: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    names = [path.stem for path in sorted(coded.glob("*.wav"))]
    Path("copy.scp").write_text("".join(f"{coded}/{name}.wav {name}.mfc\n" for name in names))
    copied = hri("htk", "copy", "-T", 1, "-C", coded / "config", "-S", "copy.scp")
    assert (copied.code, copied.err) == (0, "")
    assert copied.out.count(" -> ") == len(names) == 13

    listed = hri("htk", "list", "-h", "-e", 0, "rise_0.mfc").out
    assert "Sample Kind:   MFCC_D_C_K_0" in listed and "Sample Period: 10000.0 us" in listed
    assert listed.count("\n0:") == 1 and "\n1:" not in listed

    Path("proto").write_text(prototype())
    for word in SLOPES:
        files = [f"{word}_{take}.mfc" for take in range(3)]
        assert hri("htk", "init", "-M", "hmm0", "-o", word, "proto", *files).code == 0
        assert hri("htk", "rest", "-M", "hmm1", f"hmm0/{word}", *files).code == 0

    Path("grammar").write_text("$word = rise | fall | 7;\n( < $word > )\n")
    Path("dict").write_text('rise rise\nfall fall\n"7" [seven] "7"\n')
    Path("list").write_text("rise\nfall\n7\nseven\n")
    assert hri("htk", "parse", "grammar", "wdnet").code == 0
    drawn = hri("htk", "sgen", "-n", 20, "wdnet", "dict").out.split()
    assert set(drawn) == set(SLOPES)

    tests = [f"sentence{number}.mfc" for number in range(len(SENTENCES))]
    macros = [argument for word in SLOPES for argument in ("-H", f"hmm1/{word}")]
    found = hri("htk", "vite", *macros, "-w", "wdnet", "-l", "*", "-i", "found.mlf", "dict", "list", *tests)
    assert (found.code, found.err) == (0, "")
    said = {f"*/sentence{n}.lab": [w.replace("7", "seven") for w in s] for n, s in enumerate(SENTENCES)}
    MasterLabelFile([(p, Transcription([Label(w) for w in s])) for p, s in said.items()]).write("said.mlf")
    scored = hri("htk", "results", "-f", "-I", "said.mlf", "list", "found.mlf")
    assert "SENT: %Correct=100.00 [H=4, S=0, N=4]" in scored.out
    assert "WORD: %Corr=100.00, Acc=100.00 [H=10, D=0, S=0, I=0, N=10]" in scored.out
    assert scored.out.count("[H=   ") == 4

    # Every word takes its second: 0.25 s of pause on each side of half a second, in which a boundary may lie.
    for entry, sentence in zip(MasterLabelFile.read("found.mlf").entries, SENTENCES, strict=True):
        for number, label in enumerate(entry[1].labels):
            assert abs(label.first / 1e7 - number) <= 0.25 and len(sentence) * 1e7 >= label.last

    # The three best sentences, the best of which is the one above, and the lattice that they come from.
    arguments = ("-n", 4, 3, "-z", "lat", "-l", "lattices", "-i", "best.mlf", "dict", "list", *tests)
    assert hri("htk", "vite", *macros, "-w", "wdnet", *arguments).code == 0
    pairs = zip(MasterLabelFile.read("best.mlf").entries, MasterLabelFile.read("found.mlf").entries, strict=True)
    for (path, best), (_, one) in pairs:
        sentences = [[label.name for label in labels] for labels in best.alternatives]
        assert sentences[0] == [label.name for label in one.labels] and len({tuple(s) for s in sentences}) == 3
        scores = [sum(label.score for label in labels) for labels in best.alternatives]
        assert scores == sorted(scores, reverse=True)
        assert scores[0] == pytest.approx(sum(label.score for label in one.labels), abs=1e-3)
        lattice = WordLattice.read(str(Path(path).with_suffix(".lat")))
        assert len(lattice.times_s) == len(lattice.words) > len(sentences[0])
    one_best = hri("htk", "vite", *macros, "-w", "wdnet", "-n", 2, "-l", "*", "-i", "one.mlf", "dict", "list", *tests)
    assert one_best.code == 0 and len(MasterLabelFile.read("one.mlf").entries[0][1].alternatives) == 1
    for wrong in (("-n", 0), ("-n", 2, 1001), ("-z", "lat"), ("-n", 2, "-z", "lat", "-l", "*")):
        assert hri("htk", "vite", *macros, "-w", "wdnet", *wrong, "dict", "list", tests[0]).code == 2

    # Alignment of what was said gives the same scores.
    Path("words.mlf").write_text('#!MLF!#\n"*/sentence1.lab"\n"7"\n"7"\nrise\n.\n')
    aligned = hri(
        "htk", "vite", *macros, "-a", "-I", "words.mlf", "-l", "*", "-i", "again.mlf", "dict", "list", tests[1]
    )
    assert aligned.code == 0
    again = MasterLabelFile.read("again.mlf").entries[0]
    assert again[1].to_text() == MasterLabelFile.read("found.mlf").entries[1][1].to_text()


def test_recordings_are_read_without_files_between(hri, coded: Path, tmp_path: Path):
    configuration = Configuration()
    configuration.read(coded / "config")
    configuration.parse("SAVECOMPRESSED = F", "more")
    code_file(coded / "rise_0.wav", configuration).write(tmp_path / "a.mfc")
    direct, period = load_observations(coded / "rise_0.wav", "MFCC_0_D_N", configuration)
    stored, _ = load_observations(tmp_path / "a.mfc", "MFCC_0_D_N", Configuration())
    assert period == 100000 and direct.shape[1] == 25
    np.testing.assert_array_equal(direct, stored)


@pytest.mark.parametrize("kind", ["MFCC_0_D", "MFCC_E_K", "FBANK_C", "MFCC_E_0_D_A_C_K"])
def test_files_are_laid_out_as_the_book_says(tmp_path: Path, kind: str):
    extractor = FeatureExtractor(kind, RATE_HZ)
    frames = extractor.compute(tone_word(500, 300, 1))
    ParameterFile(frames, kind, extractor.sample_period).write(tmp_path / "a")
    code, period, plain = read_plainly(tmp_path / "a")
    assert period == 100000
    assert bool(code & 0o2000) == ("_C" in kind) and bool(code & 0o10000) == ("_K" in kind)
    steps = np.ptp(frames, axis=0) / 65534
    np.testing.assert_allclose(plain, frames, rtol=0, atol=0.51 * steps.max() if "_C" in kind else 0)
    np.testing.assert_allclose(ParameterFile.read(tmp_path / "a").values, plain, rtol=1e-5, atol=1e-5)
    again = ParameterFile.read(tmp_path / "a")
    assert again.serialise() == (tmp_path / "a").read_bytes()


def test_waveforms_become_parameters(tmp_path: Path, coded: Path):
    """A WAVEFORM file is coded as the WAV file that it was made of."""
    configuration = Configuration()
    configuration.parse("SOURCEFORMAT = WAV\nTARGETKIND = WAVEFORM", "config")
    code_file(coded / "fall_0.wav", configuration).write(tmp_path / "fall.wf")
    assert ParameterFile.read(tmp_path / "fall.wf").sample_period == 625
    coding = Configuration()
    coding.parse(CONFIG.replace("SOURCEFORMAT = WAV", ""), "config")
    direct = Configuration()
    direct.read(coded / "config")
    assert code_file(tmp_path / "fall.wf", coding).serialise() == code_file(coded / "fall_0.wav", direct).serialise()


def test_missing_settings_and_wrong_kinds_are_refused(hri, tmp_path: Path, coded: Path):
    (tmp_path / "config").write_text("SOURCEFORMAT = WAV\nTARGETKIND = MFCC\n")
    result = hri("htk", "copy", "-C", tmp_path / "config", coded / "rise_0.wav", tmp_path / "a.mfc")
    assert result.code == 3 and "rise_0.wav: TARGETRATE is not set" in result.err
    assert not (tmp_path / "a.mfc").exists()
    (tmp_path / "config").write_text("SOURCEFORMAT = WAV\nTARGETKIND = MFCC\nTARGETRATE = 1e5\nNUMCEPS = 40\n")
    assert hri("htk", "copy", "-C", tmp_path / "config", coded / "rise_0.wav", tmp_path / "a.mfc").code == 3
    assert hri("htk", "copy", "a", "b", "c").code == 2
    assert hri("htk", "list", coded / "config").code == 3


def test_models_recognise_with_the_scores_that_hvite_adds_up():
    rng = np.random.default_rng(1)
    models = ModelSet("USER")
    means = {"low": [0.0, 2.0], "high": [6.0, 9.0]}
    for name, centres in means.items():
        clips = [np.repeat(centres, 8)[:, np.newaxis] + rng.normal(size=(16, 1)) for _ in range(4)]
        train_model(models, name, [clip.astype(np.float32) for clip in clips], 2)
    again = ModelSet()
    again.parse(models.to_text(), "models")
    words = Dictionary.parse("low low\nhigh high\n", "dict")
    lattice = WordLattice.of_grammar("( { low | high } )", "grammar")
    frames = (np.repeat([0.0, 2, 6, 9, 6, 9], 8)[:, np.newaxis] + rng.normal(size=(48, 1))).astype(np.float32)
    for one in (models, again):
        found = Recognizer(one, words, lattice).recognise(frames)
        assert [w.output for w in found.words] == ["low", "high", "high"]
        assert sum(w.log_score for w in found.words) == pytest.approx(found.log_score, abs=1e-3)
        first = found.words[0]
        path, _ = one.hmm("low").viterbi(frames[: first.last_frame])
        leave = np.log(one.transitions("low")[-2, -1])
        stay = np.log(one.transitions("low")[-2, -2])
        states = np.asarray(one.hmm("low").viterbi(frames[: first.last_frame])[1])
        expected = path + leave + stay * (np.count_nonzero(states == 1) - 1)
        assert first.log_score == pytest.approx(expected, abs=1e-3)


def brute_force(said: tuple[str, ...], found: tuple[str, ...]) -> int:
    """The least cost of an alignment, by all of them."""
    if not said or not found:
        return 7 * (len(said) + len(found))
    both = 0 if said[0] == found[0] else 10
    return min(
        both + brute_force(said[1:], found[1:]), 7 + brute_force(said[1:], found), 7 + brute_force(said, found[1:])
    )


def test_words_are_aligned_at_htks_costs():
    for said, found in product(product("ab", repeat=3), product("abc", repeat=4)):
        errors, _ = compare(said, found)
        cost = 10 * errors.substitutions + 7 * (errors.deletions + errors.insertions)
        assert cost == brute_force(said, found)
    errors, pairs = compare(["one", "two"], ["two", "three"])
    assert (errors.substitutions, errors.deletions, errors.insertions) == (0, 1, 1)
    assert len(pairs) == 3


def test_words_are_aligned_at_nists_costs_as_sclite_does():
    """`count_word_errors` is compared with sclite itself, where that is installed."""
    rng = np.random.default_rng(3)
    for _ in range(200):
        said, found = (["abcd"[i] for i in rng.integers(0, 4, rng.integers(0, 9))] for _ in range(2))
        assert compare(said, found, (4, 3, 3))[0] == count_word_errors([said], [found])


def test_results_are_printed_as_hresults_does():
    results = Results()
    results.add(compare(["a", "b", "c"], ["a", "c", "c", "d"])[0])
    results.add(compare(["a"], ["a"])[0])
    assert results.lines() == [
        "SENT: %Correct=50.00 [H=1, S=1, N=2]",
        "WORD: %Corr=75.00, Acc=50.00 [H=3, D=0, S=1, I=1, N=4]",
    ]


def test_results_count_equal_labels_and_show_alignments(hri, tmp_path: Path):
    (tmp_path / "list").write_text("a\nb\nsil\n")
    (tmp_path / "x.lab").write_text("sil\na\nb\n")
    (tmp_path / "x.rec").write_text("0 100 a -5.0\n100 200 sil\n200 300 a\n")
    plain = hri("htk", "results", "-t", tmp_path / "list", tmp_path / "x.rec")
    assert "[H=1, D=1, S=1, I=1, N=3]" in plain.out or "[H=2, D=1, S=0, I=1, N=3]" in plain.out
    assert f"Aligned transcription: {tmp_path}/x.lab vs {tmp_path}/x.rec\n LAB: " in plain.out
    equal = hri("htk", "results", "-e", "???", "sil", "-e", "a", "b", tmp_path / "list", tmp_path / "x.rec")
    assert "[H=2, D=0, S=0, I=0, N=2]" in equal.out
    (tmp_path / "list").write_text("a\n")
    refused = hri("htk", "results", "-p", tmp_path / "list", tmp_path / "x.rec")
    assert refused.code == 3 and "does not have 'sil'" in refused.err


def test_vite_refuses_before_anything_is_decoded(hri, tmp_path: Path):
    (tmp_path / "models").write_text(prototype().replace("proto", "a"))
    (tmp_path / "list").write_text("a\nb\n")
    (tmp_path / "net").write_text("N=3 L=2\nI=0\nI=1 W=one\nI=2\nJ=0 S=0 E=1\nJ=1 S=1 E=2\n")
    for text, message in (
        ("two a\n", "net: line 3: the dictionary {0}/dict does not have the word 'one'"),
        ("one b\n", "dict: line 1: there is no model 'b', of the word 'one': neither a -H nor a file b"),
        ("one c\n", "dict: line 1: the list of models {0}/list does not have 'c', of the word 'one'"),
    ):
        (tmp_path / "dict").write_text(text)
        files = (tmp_path / "dict", tmp_path / "list", "missing.mfc")
        result = hri("htk", "vite", "-H", tmp_path / "models", "-w", tmp_path / "net", *files)
        assert result.code == 3 and message.format(tmp_path) in result.err
    assert hri("htk", "vite", tmp_path / "dict", tmp_path / "list").code == 2


def test_lists_and_scripts_are_read(tmp_path: Path):
    path = tmp_path / "script"
    path.write_text("a b\n\n'c d' \"e\"\n")
    assert read_script(path) == ["a", "b", "c d", "e"]
    path.write_text("a b\nc 'd\n")
    with pytest.raises(FormatError, match=re.escape(f"{path}: line 2: a quotation does not end")):
        read_script(path)
    path.write_text("don't a\\b 'it''s'\n")
    assert read_script(path) == ["don't", "a\\b", "it", "s"]
    path.write_text("a\nb c\n")
    assert read_list(path) == {"a": "a", "b": "c"}
    path.write_text("don't\n\\303\\251t \\'t\n'\\'' \"a b\"\n")
    assert read_list(path) == {"don't": "don't", "ét": "'t", "'": "a b"}
    for text, line in (("a\na\n", 2), ("a b c\n", 1), ("a\n\\303\n", 2), ("a\\\n", 1), ("a 'b\n", 1)):
        path.write_text(text)
        with pytest.raises(FormatError, match=f"line {line}: "):
            read_list(path)


def test_random_sentences_follow_the_weights():
    lattice = WordLattice(
        ["!NULL", "often", "seldom", "!NULL"], [(0, 1, np.log(0.9)), (0, 2, np.log(0.1)), (1, 3, 0), (2, 3, 0)]
    )
    rng = np.random.default_rng(0)
    drawn = [random_sentence(lattice, rng)[0] for _ in range(500)]
    assert 0.85 < drawn.count("often") / 500 < 0.95
    with pytest.raises(InvalidArgument, match="not exactly one node"):
        WordLattice(["a", "b"], [])
