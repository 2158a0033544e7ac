# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""`hri htk build`: networks of bigrams and loops, and recognition by them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from hri.htk import MasterLabelFile, ParameterFile, WordLattice, draw_sentence
from hri.language import NGramModel
from htk_toys import clip, model_text, succeed

SAID = ["go left", "go left", "go right", "stop", "go left", "stop go right"]
WORDS = ["go", "left", "right", "stop"]


@pytest.fixture
def said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Transcriptions, a list of words, and models of words, two of which are all but the same."""
    monkeypatch.chdir(tmp_path)
    entries = "".join(f'"*/{n}.lab"\n' + "\n".join(s.split()) + "\n.\n" for n, s in enumerate(SAID))
    Path("said.mlf").write_text(f"#!MLF!#\n{entries}")
    Path("words").write_text("\n".join(WORDS) + "\n")
    one = "0 1 0\n0 .5 .5\n0 0 0\n"
    means = {"go": 0.0, "left": 8.0, "right": 8.2, "stop": 20.0}
    text = "".join(model_text(word, (mean,), one) for word, mean in means.items())
    Path("models").write_text(f"~o <VECSIZE> 1 <USER>\n{text}")
    Path("dict").write_text("".join(f"{word} {word}\n" for word in WORDS))
    return tmp_path


def best_log_probability(network: WordLattice, sentence: list[str]) -> float:
    """Of the best path that says a sentence."""
    reached = {network.first: 0.0}
    following: dict[int, list[tuple[int, float]]] = {}
    for start, end, weight in network.arcs:
        following.setdefault(start, []).append((end, weight))
    for said in [*sentence, None]:
        here: dict[int, float] = {}
        open_nodes = list(reached.items())
        while open_nodes:
            node, score = open_nodes.pop()
            for end, weight in following.get(node, []):
                word = network.words[end]
                if word == "!NULL" and said is None and end == network.last:
                    here[end] = max(here.get(end, -np.inf), score + weight)
                elif word == "!NULL":
                    open_nodes.append((end, score + weight))
                elif word == said:
                    here[end] = max(here.get(end, -np.inf), score + weight)
        reached = here
    return reached[network.last]


def test_a_network_of_a_bigram_weighs_sentences_as_it_does(hri, said: Path):
    succeed(hri("htk", "build", "-I", "said.mlf", "--arpa", "bigram.arpa", "words", "net"))
    language = NGramModel.load("bigram.arpa")
    assert language.order == 2 and set(WORDS) < set(language.words)
    network = WordLattice.read("net")
    for sentence in (["go", "left"], ["go", "right"], ["stop"], ["stop", "go", "right"]):
        expected = language.fit_of([sentence]).log_probability
        assert best_log_probability(network, sentence) == pytest.approx(expected, abs=1e-4)
    # Bigrams that the model has not go over one node: fewer arcs than pairs.
    assert len(network.arcs) < len(WORDS) ** 2 + 2 * len(WORDS)
    succeed(hri("htk", "build", "-n", "bigram.arpa", "words", "again"))
    assert Path("again").read_text() == Path("net").read_text()


def test_label_files_train_and_smoothing_is_chosen(hri, said: Path):
    for number, sentence in enumerate(SAID):
        Path(f"{number}.lab").write_text(f"!ENTER\n{sentence.replace(' ', chr(10))}\n!EXIT\n")
    Path("labels.scp").write_text("".join(f"{number}.lab\n" for number in range(len(SAID))))
    succeed(hri("htk", "build", "-S", "labels.scp", "words", "net"))
    succeed(hri("htk", "build", "-I", "said.mlf", "words", "same"))
    assert Path("net").read_text() == Path("same").read_text()
    succeed(hri("htk", "build", "-I", "said.mlf", "--smoothing", "kneser_ney", "words", "other"))
    assert Path("net").read_text() != Path("other").read_text()


def test_vite_runs_by_a_bigram(hri, said: Path):
    """Words that sound alike differ in what was said before them."""
    succeed(hri("htk", "build", "-I", "said.mlf", "words", "net"))
    succeed(hri("htk", "build", "words", "loop"))
    ParameterFile(clip(1, 0.0, 8.11), "USER", 100000).write("a.usr")
    ParameterFile(clip(1, 20.0, 0.0, 8.09), "USER", 100000).write("b.usr")
    given = ("-H", "models", "-l", "*", "-p", -20, "-i", "f.mlf", "dict", "words", "a.usr", "b.usr")

    def found(*network: object) -> list[list[str]]:
        succeed(hri("htk", "vite", *network, *given))
        return [[label.name for label in one.labels] for _, one in MasterLabelFile.read("f.mlf").entries]

    assert found("-w", "net", "-s", 15) == [["go", "left"], ["stop", "go", "left"]]
    assert [words[0] for words in found("-w", "loop")] == ["go", "stop"]


def test_loops_markers_and_brackets(hri, said: Path):
    succeed(hri("htk", "build", "-t", "left", "right", "words", "loop"))
    network = WordLattice.read("loop")
    rng = np.random.default_rng(0)
    for _ in range(20):
        drawn = draw_sentence(network, rng)
        assert drawn.words[0] == "left" and drawn.words[-1] == "right" and len(drawn.words) > 2
        # Every word is one of four, and every end one of two.
        assert drawn.bits > 2 * (len(drawn.words) - 2)
    text = "\\data\\\nngram 1=4\nngram 2=1\n\n\\1-grams:\n-99 <s>\n-99 </s>\n-0.3 !ENTER 0\n-0.3 !EXIT\n"
    Path("no.arpa").write_text(text)
    assert hri("htk", "build", "-n", "no.arpa", "words", "no").code == 3
    arpa = (
        "\\data\\\nngram 1=7\nngram 2=1\n\n\\1-grams:\n-99 <s>\n-99 </s>\n-99 BEGIN -0.1\n-0.5 END\n-0.5 go\n"
        "-0.5 stop\n-1 <unk>\n\n\\2-grams:\n-0.2 BEGIN go\n\n\\end\\\n"
    )
    Path("other.arpa").write_text(arpa)
    unknown = hri("htk", "build", "-n", "other.arpa", "-s", "BEGIN", "END", "words", "net")
    assert unknown.code == 3 and "other.arpa: the language model does not know 'left'" in unknown.err
    succeed(hri("htk", "build", "-n", "other.arpa", "-s", "BEGIN", "END", "-u", "<unk>", "words", "net"))
    network = WordLattice.read("net")
    assert best_log_probability(network, ["go"]) == pytest.approx(np.log(10) * (-0.2 - 0.5), abs=1e-5)
    assert best_log_probability(network, ["left"]) == pytest.approx(np.log(10) * (-0.1 - 1 - 0.5), abs=1e-5)


def test_build_refuses(hri, said: Path):
    Path("few").write_text("go\nleft\n")
    refused = hri("htk", "build", "-I", "said.mlf", "few", "net")
    assert refused.code == 3 and "few: does not have 'right', a word of the transcriptions" in refused.err
    Path("three.arpa").write_text(
        "\\data\\\nngram 1=3\nngram 2=0\nngram 3=0\n\n\\1-grams:\n-99 <s>\n-1 </s>\n-1 go\n\n\\2-grams:\n\n"
        "\\3-grams:\n\n\\end\\\n"
    )
    Path("go").write_text("go\n")
    refused = hri("htk", "build", "-n", "three.arpa", "go", "net")
    assert refused.code == 3 and "three.arpa: a network takes language models of order 1 or 2" in refused.err
    for wrong in (
        ("-u", "X", "-n", "three.arpa"),
        ("-n", "three.arpa", "-I", "said.mlf"),
        ("--arpa", "x.arpa"),
        ("-t", "a", "b", "-I", "said.mlf"),
    ):
        assert hri("htk", "build", *wrong, "words", "net").code == 2
    assert not Path("net").exists()


def test_words_for_the_ends_may_be_said(hri, said: Path):
    """As HLStats writes a bigram, with the words of HTK, which are in the list of words."""
    arpa = (
        "\\data\\\nngram 1=6\nngram 2=3\n\n\\1-grams:\n-99 !ENTER -0.1\n-0.5 !EXIT\n-0.5 go -0.2\n-0.6 stop\n"
        "-0.7 left\n-0.8 right\n\n\\2-grams:\n-0.2 !ENTER go\n-0.3 go !EXIT\n-0.4 go left\n\n\\end\\\n"
    )
    Path("bg").write_text(arpa)
    succeed(hri("htk", "build", "-n", "bg", "words", "plain"))
    plain = WordLattice.read("plain")
    assert best_log_probability(plain, ["go"]) == pytest.approx(np.log(10) * -0.5, abs=1e-5)
    assert best_log_probability(plain, ["stop"]) == pytest.approx(np.log(10) * (-0.1 - 0.6 - 0.5), abs=1e-5)
    Path("ends").write_text(Path("words").read_text() + "!ENTER\n!EXIT\n")
    succeed(hri("htk", "build", "-n", "bg", "ends", "spoken"))
    spoken = WordLattice.read("spoken")
    assert spoken.words == ["!ENTER", *plain.words[1:-1], "!EXIT"] and spoken.arcs == plain.arcs
    Path("bg").write_text(arpa.replace("!ENTER", "BEGIN").replace("!EXIT", "END"))
    succeed(hri("htk", "build", "-n", "bg", "-s", "BEGIN", "END", "words", "other"))
    assert Path("other").read_text() == Path("plain").read_text()
    refused = hri("htk", "build", "-n", "bg", "words", "no")
    assert refused.code == 3 and "bg: " in refused.err and "<s>" in refused.err
