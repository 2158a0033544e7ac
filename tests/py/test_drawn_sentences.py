# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Drawn people who sign the sentences of the thesis: their words, that signers differ, the data set, and the study."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hri.core.errors import InvalidArgument
from hri.datasets.asl_sentences import read_asl_sentences
from hri.studies import drawn_sentences, get_study, run_study
from hri.synthetic.sentences import (
    FPS,
    SENTENCES,
    draw_sentences,
    load_words,
    make_sentence_corpus,
    make_style,
    sign_sentence,
)


def test_the_tables_of_the_thesis_are_there() -> None:
    assert [len(sentences) for sentences in SENTENCES.values()] == [10, 20]
    words = [{word for text in table.values() for word in text.split()} for table in SENTENCES.values()]
    assert [len(one) for one in words] == [21, 36] and words[0] | words[1] == set(load_words())
    for name, places in load_words().items():
        assert places.ndim == 3 and places.shape[1:] == (2, 2) and len(places), name
        assert np.abs(places).max() < 3.2, "within reach"


def test_every_two_words_can_be_separated() -> None:
    """Places of one are a fifth of a hand and more from all of the other, or come in another order or number."""
    words = load_words()
    for first in words:
        for second in words:
            a, b = words[first], words[second]
            if first < second and len(a) == len(b):
                assert np.linalg.norm(a - b, axis=2).max() > 0.2, (first, second)


def test_words_are_where_their_frames_say() -> None:
    style = make_style(3)
    made = sign_sentence(style, ["you", "car", "not"], habit=0.0, jitter=0.0)
    assert [word.label for word in made.words] == ["you", "car", "not"]
    assert made.positions.shape == (len(made.positions), 3, 2) and (made.positions == np.rint(made.positions)).all()
    assert all(a.last < b.first for a, b in zip(made.words, made.words[1:], strict=False))
    left, right, head = np.moveaxis(made.positions, 1, 0)
    assert np.abs(head.mean(axis=0) - style.head_px).max() < 3 * style.drift_px
    assert (right[:, 0] < head[:, 0]).mean() > 0.8 and (left[:, 0] > head[:, 0]).mean() > 0.8, "as a camera sees them"
    you = load_words()["you"][0, 0] * style.reach * (-1, -1) * style.hand_px + style.head_px
    assert np.abs(right[made.words[0].first : made.words[0].last] - you).max() < 5 * style.drift_px
    hangs = left[made.words[0].first : made.words[0].last + 1, 1]
    assert (hangs > head[0, 1] + 2.8 * style.hand_px).all(), "a sign of one hand"
    assert made.words[0].first > 0.2 * FPS and len(left) - made.words[-1].last > 0.3 * FPS, "rest before and behind"


def test_signers_and_takes_differ_and_equal_arguments_do_not() -> None:
    words = ["i", "agree"]
    first = sign_sentence(make_style(1), words)
    np.testing.assert_array_equal(first.positions, sign_sentence(make_style(1), words).positions)
    for other in (
        sign_sentence(make_style(2), words),
        sign_sentence(make_style(1, seed=9), words),
        sign_sentence(make_style(1), words, take=1),
        sign_sentence(make_style(1), words, seed=1),
    ):
        assert other.positions.shape != first.positions.shape or (other.positions != first.positions).any()
    styles = [make_style(index) for index in range(10)]
    for field in ("hand_px", "tempo", "head_px", "reach", "drift_px"):
        assert len({getattr(style, field) for style in styles}) == 10, field


def test_what_cannot_be_signed_is_refused() -> None:
    with pytest.raises(InvalidArgument, match="'dance' cannot be signed; known are how, you"):
        sign_sentence(make_style(0), ["i", "dance"])
    with pytest.raises(InvalidArgument, match="words is empty"):
        sign_sentence(make_style(0), [])
    with pytest.raises(InvalidArgument, match=r"table is 'table 9', must be one of table 4\.3, table 5\.1"):
        draw_sentences("table 9")
    with pytest.raises(InvalidArgument, match="takes 0"):
        draw_sentences("table 4.3", takes=0)
    with pytest.raises(InvalidArgument, match="index is -1"):
        draw_sentences("table 4.3", first_signer=-1)


def test_a_data_set_is_written_and_trained_on(hri: Any, tmp_path: Path) -> None:
    written = make_sentence_corpus(tmp_path / "a", "table 4.3", num_signers=2, takes=1, first_signer=4)
    assert [s.signer for s in written] == ["signer05"] * 10 + ["signer06"] * 10
    for one, drawn in zip(written, draw_sentences("table 4.3", 2, 1, first_signer=4), strict=True):
        assert one.words == drawn.words and one.video == drawn.video
        np.testing.assert_array_equal(one.positions, drawn.positions)
    assert tomllib.loads((tmp_path / "a" / "synthetic.toml").read_text())["synthetic"] is True
    found = hri("corpus", "sentences", "--signers", "2", "--takes", "2", "--out", tmp_path / "b")
    assert found.code == 0 and found.out.startswith("40 synthetic sentences of 21 words by 2 drawn people")
    assert len(read_asl_sentences(tmp_path / "b")) == 40
    options = ("--option", "choose_weights=false", "--out", tmp_path / "m.hri")
    assert hri("train-sentences", "--data", tmp_path / "b", *options).code == 0
    read = hri("read-sentences", tmp_path / "b" / "hands.csv", "--model", tmp_path / "m.hri").out
    assert "signer01 how you 1\thow you\n" in read
    assert hri("corpus", "sentences", "--table", "table 4.4", "--out", tmp_path / "c").code == 2


def test_drawn_sentences_never_take_the_place_of_those_of_people(hri, tmp_path: Path) -> None:
    few = ("corpus", "sentences", "--signers", 1, "--takes", 1, "--out", tmp_path)
    assert hri(*few).code == 0 and hri(*few).code == 0
    other = hri(*few, "--seed", 1)
    assert other.code == 3 and "--replace" in other.err
    assert hri(*few, "--seed", 1, "--replace").code == 0
    assert "seed = 1" in (tmp_path / "synthetic.toml").read_text()
    for name, row in {"signers": "x,asha", "hands": "x,0,1,1,2,2,3,3", "words": "x,asha,go,0,0"}.items():
        with (tmp_path / f"{name}.csv").open("a") as file:
            file.write(f"{row}\n")
    before = (tmp_path / "signers.csv").read_text()
    refused = hri(*few, "--replace")
    assert refused.code == 3 and "'asha'" in refused.err
    (tmp_path / "synthetic.toml").unlink()
    assert "not empty" in hri(*few, "--replace").err
    assert (tmp_path / "signers.csv").read_text() == before


def test_the_study_tests_signers_that_were_not_trained_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drawn_sentences, "NUM_SIGNERS", 4)
    monkeypatch.setattr(drawn_sentences, "TAKES", 1)
    only = {"table": ("table 4.3",), "model": ("hmm",)}
    study = get_study("drawn-sentences")
    assert study.summary.startswith("SYNTHETIC")
    result = run_study(study, tmp_path, lambda *_: None, only)
    assert result["synthetic"] is True and [row["words"] for row in result["rows"]] == ["words alone", "bigram"]
    for row in result["rows"]:
        assert row["accuracy_mean"] > 0.3 and row["word_error_mean"] < 0.4
    each = result["by_sentence"]["table 4.3, bigram, hmm"]
    assert set(each) == set(SENTENCES["table 4.3"])
    assert np.mean(list(each.values())) == pytest.approx(result["rows"][1]["accuracy_mean"])
