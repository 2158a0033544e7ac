# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Files of ours before readers that were not written here: sclite, KenLM, arpa, and Julius where it is installed."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

from foreign_programs import JULIUS, SCLITE, sclite_counts
from hri.htk import Dictionary, MasterLabelFile, ModelSet, ParameterFile, Recognizer, WordLattice
from hri.language import NGramModel, NGramOptions
from htk_toys import make_words, make_work, succeed

SENTENCES = [text.split() for text in ("go left", "go left now", "stop", "go right now", "left left", "stop now")]
PROBES = [text.split() for text in ("go left", "right go", "now now stop", "left", "stop go right now")]


@pytest.mark.skipif(SCLITE is None, reason="sclite (Debian: sctk) is not installed")
def test_sclite_counts_the_errors_of_the_same_files(hri, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Master label files as `results -n` scores them, against sclite on the words that they hold."""
    monkeypatch.chdir(tmp_path)
    rng = np.random.default_rng(8)
    references, hypotheses = (
        [[*(str(word) for word in rng.choice(["one", "two", "six"], rng.integers(0, 8))), "end"] for _ in range(120)]
        for _ in range(2)
    )
    for name, suffix, lists in (("said", "lab", references), ("found", "rec", hypotheses)):
        entries = "".join(f'"*/{n}.{suffix}"\n' + "\n".join(words) + "\n.\n" for n, words in enumerate(lists))
        Path(f"{name}.mlf").write_text(f"#!MLF!#\n{entries}")
    Path("list").write_text("one\ntwo\nsix\nend\n")
    ours = succeed(hri("htk", "results", "-n", "-I", "said.mlf", "list", "found.mlf"))
    row = re.search(r"H=(\d+), D=(\d+), S=(\d+), I=(\d+), N=(\d+)", ours.split("WORD:")[1])
    assert row is not None
    hits, deleted, substituted, inserted, words = map(int, row.groups())
    read = [
        [[label.name for label in one.labels] for _, one in MasterLabelFile.read(f"{name}.mlf").entries]
        for name in ("said", "found")
    ]
    expected = [120, words, hits, substituted, deleted, inserted, substituted + deleted + inserted]
    assert sclite_counts(tmp_path, *read) == expected


@pytest.mark.parametrize("smoothing", ["witten_bell", "kneser_ney"])
@pytest.mark.parametrize("order", [2, 3])  # KenLM takes no unigram models
def test_kenlm_gives_the_same_probabilities(tmp_path: Path, order: int, smoothing: str):
    kenlm = pytest.importorskip("kenlm")
    ours = NGramModel.train(SENTENCES, NGramOptions(order=order, smoothing=smoothing))
    ours.save(tmp_path / "words.arpa")
    theirs = kenlm.Model(str(tmp_path / "words.arpa"))
    assert theirs.order == order
    for sentence in [*SENTENCES, *PROBES]:
        expected = ours.fit_of([sentence]).log_probability / np.log(10)
        assert theirs.score(" ".join(sentence)) == pytest.approx(expected, abs=1e-5)


def test_arpa_gives_the_same_probabilities(tmp_path: Path):
    arpa = pytest.importorskip("arpa")
    ours = NGramModel.train(SENTENCES, NGramOptions(order=3))
    ours.save(tmp_path / "words.arpa")
    [theirs] = arpa.loadf(str(tmp_path / "words.arpa"))
    for sentence in [*SENTENCES, *PROBES]:
        expected = ours.fit_of([sentence]).log_probability / np.log(10)
        assert theirs.log_s(" ".join(sentence)) == pytest.approx(expected, abs=1e-9)


def test_htk_io_reads_the_levels_of_an_alignment(hri, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """States, models and words of `vite -m -f` as that package, which is of HTS, understands label files."""
    alignment = pytest.importorskip("htk_io.alignment")
    monkeypatch.chdir(tmp_path)
    make_work(tmp_path)
    make_words(tmp_path)
    given = ("-w", "net", "-m", "-f", "-o", "S", "dict", "list", "v.usr")
    succeed(hri("htk", "vite", "-H", "models", *given))
    read = alignment.AlignmentIo(framePeriod=0.01).readLines(Path("v.rec").read_text().splitlines())

    def model(name: str, first: int) -> tuple[int, int, str, list[tuple[int, int, str, None]]]:
        return first, first + 5, name, [(first, first + 5, "s2", None)]

    assert read == [
        (0, 15, "up", [model("low", 0), model("hi", 5), model("sp", 10)]),
        (15, 25, "down", [model("hi", 15), model("low", 20)]),
    ]


@pytest.mark.skipif(JULIUS is None, reason="julius is not installed")
def test_julius_recognises_the_same_words(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Models and parameter files of ours, by the recipe of docs/htk.md; scores within 1.5e-3 of ours."""
    assert JULIUS is not None
    monkeypatch.chdir(tmp_path)
    rng = np.random.default_rng(3)
    dim, text = 3, "~o <STREAMINFO> 1 3 <VECSIZE> 3<NULLD><MFCC_0><DIAGC>\n"
    centres = {name: rng.normal(scale=6, size=(3, dim)) for name in ("sil", "one", "two")}
    for name, means in centres.items():
        states = "".join(
            f"<STATE> {n}\n<MEAN> {dim}\n{' '.join(f'{v:.6f}' for v in mean)}\n<VARIANCE> {dim}\n1 1 1\n"
            for n, mean in enumerate(means, 2)
        )
        steps = "0 1 0 0 0\n0 .6 .4 0 0\n0 0 .6 .4 0\n0 0 0 .6 .4\n0 0 0 0 0\n"
        text += f'~h "{name}"\n<BEGINHMM>\n<NUMSTATES> 5\n{states}<TRANSP> 5\n{steps}<ENDHMM>\n'
    models = ModelSet()
    models.parse(text, "text")
    models.write("hmmdefs")
    Path("words.dict").write_text("0 [<s>] sil\n1 [one] one\n1 [two] two\n2 [</s>] sil\n")
    Path("words.dfa").write_text("0 2 1 0 0\n1 1 2 0 0\n2 0 3 0 0\n3 -1 -1 1 0\n")
    Path("julius.jconf").write_text(
        "-h hmmdefs\n-gram words\n-input htkparam\n-filelist files\n-no_ccd\n-b 0\n-gprune none\n"
    )
    expected = []
    dictionary = Dictionary.parse("<s> [] sil\none one\ntwo two\n</s> [] sil\n", "dict")
    network = WordLattice.of_grammar("( <s> ( one | two ) </s> )".replace("<", r"\<").replace(">", r"\>"), "grammar")
    for number, word in enumerate(["one", "two", "two"]):
        means = np.concatenate([centres[name] for name in ("sil", word, "sil")]).repeat(5, axis=0)
        frames = (means + rng.normal(size=means.shape)).astype(np.float32)
        ParameterFile(frames, "MFCC_0", 100000).write(f"{number}.mfc")
        found = Recognizer(models, dictionary, network).recognise(frames)
        expected.append((word, found.log_score))
    Path("files").write_text("".join(f"{number}.mfc\n" for number in range(3)))
    # It waits for ever where parameters are of another kind than the models.
    done = subprocess.run([JULIUS, "-C", "julius.jconf"], capture_output=True, text=True, timeout=60, check=True)
    words = re.findall(r"(?m)^sentence1:.*\b(one|two)\b", done.stdout)
    scores = [float(score) for score in re.findall(r"(?m)^score1: (\S+)", done.stdout)]
    assert words == [word for word, _ in expected]
    np.testing.assert_allclose(scores, [score for _, score in expected], rtol=1.5e-3)
