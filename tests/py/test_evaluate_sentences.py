# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Word errors of signed sentences held out, from Python and from the command line."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from hri.core.errors import FormatError, InvalidArgument
from hri.datasets.asl_sentences import SignedSentence
from hri.evaluation import SentenceResult, cross_validate_sentences
from hri.language import WordErrors
from hri.recognition import SentenceRecognizer
from hri.synthetic.sentences import draw_sentences, make_sentence_corpus

PLAIN = ("--option", "choose_weights=false")


def plain() -> SentenceRecognizer:
    return SentenceRecognizer(choose_weights=False)


@pytest.fixture(scope="module")
def drawn() -> list[SignedSentence]:
    return draw_sentences("table 4.3", num_signers=2, takes=1)


def test_signers_are_held_out_and_their_errors_counted(drawn: list[SignedSentence]) -> None:
    folds = cross_validate_sentences(drawn, plain)
    for fold, name in zip(folds, ("signer01", "signer02"), strict=True):
        assert fold.name == name and {item.signer for item in fold.items} == {name} and len(fold.items) == 10
        train = [one for one in drawn if one.signer != name]
        spans = [[(word.label, word.first, word.last + 1) for word in one.words] for one in train]
        signs = plain().fit([one.positions for one in train], spans, groups=None)
        tested = [one for one in drawn if one.signer == name]
        assert [item.found for item in fold.items] == [signs.recognise(one.positions).labels for one in tested]
    total = SentenceResult.pooled(folds)
    assert total.errors == folds[0].errors + folds[1].errors and total.errors.num_words == 54
    right = [item.words == item.found for item in total.items]
    assert total.num_unknown == 0 and total.right == sum(right) / 20 and not all(right)


def test_words_that_cannot_be_known_and_videos_of_one_signer(drawn: list[SignedSentence]) -> None:
    alone = [replace(one, signer="ann") for one in drawn]
    word = replace(alone[0].words[0], label="never")
    alone[0] = replace(alone[0], words=(word, *alone[0].words[1:]))
    folds = cross_validate_sentences(alone, plain, num_folds=2)
    assert [fold.name for fold in folds] == ["part 1 of 2", "part 2 of 2"]
    assert sorted(item.video for fold in folds for item in fold.items) == sorted(one.video for one in drawn)
    assert all(fold.num_unknown >= 1 for fold in folds if fold.items[0].video == alone[0].video)
    with pytest.raises(InvalidArgument, match="two videos or more"):
        cross_validate_sentences(alone[:1], plain)
    blind = [replace(drawn[0], positions=np.full_like(drawn[0].positions, np.nan)), *drawn[1:]]
    with pytest.raises(FormatError, match=r"video 'signer01 how you 1': .*no frame shows"):
        cross_validate_sentences(blind, plain)


def test_the_words_of_every_item_are_compared() -> None:
    assert SentenceResult("x", (), 0).errors == WordErrors()


def test_command_line_measures_sentences(hri, tmp_path: Path) -> None:
    folder = tmp_path / "signed"
    make_sentence_corpus(folder, "table 4.3", num_signers=2, takes=1)
    done = hri("evaluate", "sentences", "--data", folder, *PLAIN, "--json", tmp_path / "found.json")
    assert done.code == 0
    header, *rows = (line.split("\t") for line in done.out.splitlines())
    assert header[:4] == ["held out", "sentences", "words", "word errors"]
    assert [row[:3] for row in rows] == [["signer01", "10", "27"], ["signer02", "10", "27"], ["all", "20", "54"]]
    found = json.loads((tmp_path / "found.json").read_text())
    assert (found["mode"], found["held_out"], found["num_words"]) == ("sentences", "signers", 54)
    assert rows[-1][3] == f"{100 * found['word_error_rate']:.1f} %"
    assert len(found["folds"][0]["items"]) == 10 and found["options"]["choose_weights"] is False
    for more, message in (
        (("--noise", "white", "--snr", "10"), "--noise is for speech and gesture"),
        (("--front-end", "cepstra"), "--front-end is for speech and gesture"),
    ):
        refused = hri("evaluate", "sentences", "--data", folder, *more)
        assert refused.code == 2 and message in refused.err
    assert hri("evaluate", "sentences").code == 2
    wrong = hri("evaluate", "sentences", "--data", folder, "--option", "stats=3")
    assert wrong.code == 3 and "--option" in wrong.err
    many = hri("evaluate", "sentences", "--data", folder, "--folds", 3)
    assert many.code == 3 and "2..2" in many.err
