# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri train-fusion`` on synthetic words and signs: what it writes is what --fusion reads."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from hri.cli import train_fusion
from hri.core.errors import InvalidArgument
from hri.evaluation import EvaluationItem, EvaluationResult, FoldResult
from hri.fusion import LearnedFusion, pair_decisions
from hri.recognition.decision import Decision, NBest
from hri.training import choices

pytest.importorskip("cv2")


@pytest.fixture(scope="module")
def corpora(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with synthetic words and signs of four people each; words of one label more."""
    from hri.synthetic.signer import make_gesture_corpus
    from hri.synthetic.speech import make_speech_corpus

    folder = tmp_path_factory.mktemp("corpora")
    make_speech_corpus(folder / "spoken", {"en": {"1": "one", "2": "two", "stop": "stop"}}, num_speakers=4, takes=1)
    make_gesture_corpus(folder / "signed", ("1", "2", "5"), num_persons=4, takes=1)
    return folder


def test_a_fusion_is_trained_on_persons_held_out(hri: Any, corpora: Path, tmp_path: Path) -> None:
    out, report = tmp_path / "made" / "fusion.hri", tmp_path / "report.json"
    data = ("--speech-data", corpora / "spoken", "--gesture-data", corpora / "signed")
    quick = ("--folds", "2", "--front-end", "cepstra", "--no-network", "--source", "silhouettes", "--kind", "logistic")
    done = hri("train-fusion", *data, "--out", out, *quick, "--exposure", "0.4", "--json", report)
    assert done.code == 0, done.err
    assert done.out.strip() == str(out) and "labels: 1 2" in done.err
    assert "labels of one folder only, not learned from: 5 stop" in done.err
    found = json.loads(report.read_text())
    assert (found["kind"], found["labels"], found["num_pairs"], found["synthetic"]) == (
        "logistic",
        ["1", "2"],
        16,
        True,
    )
    assert found["held_out"].keys() == {"speech", "gesture", "product", "learned logistic"}
    assert all(0.0 <= share <= 1.0 for share in found["held_out"].values())
    learned = LearnedFusion.load(out)
    assert learned.kind == "logistic" and set(learned.reliability_) == {"speech", "gesture"}
    assert all(mode.prior != 0 for mode in learned.reliability_.values()), "the mean quality, of both modes"
    again = tmp_path / "again.hri"
    assert hri("train-fusion", *data, "--out", again, *quick, "--exposure", "0.4").code == 0
    assert again.read_bytes() == out.read_bytes()


def test_what_cannot_be_learned_from_is_said(hri: Any, corpora: Path, tmp_path: Path) -> None:
    from hri.synthetic.speech import make_speech_corpus

    make_speech_corpus(tmp_path / "alone", {"en": {"1": "one", "2": "two"}}, num_speakers=1, takes=1)
    make_speech_corpus(tmp_path / "others", {"en": {"a": "alpha", "b": "beta"}}, num_speakers=2, takes=1)
    signed, out = ("--gesture-data", corpora / "signed"), ("--out", tmp_path / "fusion.hri")
    spoken = ("--speech-data", corpora / "spoken")
    for arguments, code, message in (
        (("--speech-data", tmp_path / "alone", *signed, *out), 3, "two persons or more"),
        (("--speech-data", tmp_path / "others", *signed, *out), 3, "need two labels in common, and have 0"),
        ((*spoken, *signed, *out, "--noise", "pink"), 2, "--noise and --snr go together"),
        (
            (*spoken, *signed, *out, "--noise", "pnk", "--snr", 10),
            2,
            "--noise pnk is neither white nor pink",
        ),
        ((*spoken, *signed, *out, "--kind", "oracle"), 2, "oracle"),
        ((*spoken, *signed, *out, "--gesture-option", "colour=red"), 3, "--option"),
        ((*spoken, *signed), 2, "--out"),
        (
            (*spoken, *signed, *out, "--no-network", "--speech-option", "use_network=true"),
            2,
            "--network and --speech-option use_network=... exclude each other",
        ),
        ((*spoken, *signed, *out, "--source", "landmarks", "--gesture-option", "source=landmarks"), 2, "--source and"),
        ((*spoken, *signed, *out, "--speech-pattern", "{label}-{person}"), 3, "fits '{label}-{person}'"),
        ((*spoken, *signed, *out, "--gesture-pattern", "{label}-{person}"), 3, "fits '{label}-{person}'"),
    ):
        refused = hri("train-fusion", *arguments)
        assert refused.code == code and message in refused.err, (arguments, refused.err)
    assert not (tmp_path / "fusion.hri").exists()


def _decided(mode: str, label: str) -> Decision:
    other = "2" if label == "1" else "1"
    return Decision(mode, label, "recognised", 0.9, nbest=(NBest(label, 0.9, 0.0), NBest(other, 0.1, -2.0)))


@pytest.fixture
def validated(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """By mode the recogniser and the embedding that were to be trained; all of the first person's words are "1"."""
    asked: dict[str, Any] = {}

    def fake(dataset: Any, make: Any, *, embedding: Any = None, **_: Any) -> EvaluationResult:
        asked[dataset.kind] = (make().options, embedding)
        rows = ("11", "12") if dataset.kind == "speech" else ("12", "12")
        folds = [
            FoldResult(str(number), tuple(EvaluationItem(i, t, _decided(dataset.kind, t)) for i, t in enumerate(row)))
            for number, row in enumerate(rows)
        ]
        return EvaluationResult(dataset.labels, folds, {})

    monkeypatch.setattr(train_fusion, "cross_validate", fake)
    return asked


def test_it_learns_from_the_recognisers_that_train_makes(
    hri: Any, corpora: Path, tmp_path: Path, validated: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(choices, "has_embedding", lambda: False)
    monkeypatch.setattr(choices, "choose_source", lambda _: ("silhouettes", "source: silhouettes, because"))
    data = ("--speech-data", corpora / "spoken", "--gesture-data", corpora / "signed", "--out", tmp_path / "fusion.hri")
    done = hri("train-fusion", *data, "--json", "-")
    assert done.code == 0 and "source: silhouettes, because" in done.err and "a network" in done.err, done.err
    words, signs = validated["speech"][0], validated["gesture"][0]
    assert (words.front_end, words.use_network, signs.source) == ("cepstra", True, "silhouettes")
    assert json.loads(done.out)["options"] == {"speech": words.as_dict(), "gesture": signs.as_dict()}

    weights = tmp_path / "weights.onnx"
    weights.touch()
    monkeypatch.setattr(train_fusion, "embedding_for", lambda _, path: path)
    flags = ("--embedding", weights, "--no-network", "--source", "landmarks", "--hands", "both")
    assert hri("train-fusion", *data, *flags, "--gesture-option", "model=hmm").code == 0
    (words, embedding), (signs, none) = validated["speech"], validated["gesture"]
    assert (words.front_end, words.use_network, embedding, none) == ("both", False, str(weights), None)
    assert (signs.source, signs.num_hands) == ("landmarks", 2)


@pytest.mark.usefixtures("validated")
def test_a_fusion_that_cannot_be_measured_is_saved(hri: Any, corpora: Path, tmp_path: Path) -> None:
    out = tmp_path / "fusion.hri"
    data = ("--speech-data", corpora / "spoken", "--gesture-data", corpora / "signed", "--front-end", "cepstra")
    done = hri("train-fusion", *data, "--source", "silhouettes", "--out", out, "--json", "-")
    assert done.code == 0 and "cannot be measured" in done.err and "there are 1, and 1, 2" in done.err, done.err
    assert json.loads(done.out)["held_out"] is None and LearnedFusion.load(out).kind == "product"


def test_words_are_paired_with_signs_of_the_same_label() -> None:
    def decided(mode: str, label: str) -> Decision:
        return Decision(mode, label, "recognised", 0.9, nbest=(NBest(label, 0.9, 0.0),))

    said = [(label, decided("speech", label)) for label in ("1", "2", "stop", "1")]
    shown = [(label, decided("gesture", label)) for label in ("1", "2", "5")]
    pairs = pair_decisions(said, shown, signs_per_word=3)
    assert pairs.labels == ["1"] * 3 + ["2"] * 3 + ["1"] * 3
    assert [one.label for one in pairs.speech] == [one.label for one in pairs.gesture] == pairs.labels
    with pytest.raises(InvalidArgument, match="two labels in common; there are 1, 2, stop, and 5"):
        pair_decisions(said, shown[2:])
    with pytest.raises(InvalidArgument, match="signs_per_word"):
        pair_decisions(said, shown, signs_per_word=0)
