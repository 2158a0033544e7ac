# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""`hri.train` without a recogniser: what ``hri train`` makes of the same recordings."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import hri
from hri.training import choices, choose_options


@pytest.fixture
def untrained(monkeypatch: pytest.MonkeyPatch) -> None:
    """Training gives the recogniser back as it was."""
    monkeypatch.setattr(hri.WordRecognizer, "fit", lambda self, *_, **__: self)
    monkeypatch.setattr(hri.GestureRecognizer, "features", lambda *_: [])
    monkeypatch.setattr(hri.GestureRecognizer, "fit_features", lambda self, *_, **__: self)


@pytest.mark.usefixtures("untrained")
@pytest.mark.parametrize(("installed", "front_end", "network"), [(True, "both", False), (False, "cepstra", True)])
def test_words_are_of_what_is_installed(
    spoken: Path, monkeypatch: pytest.MonkeyPatch, installed: bool, front_end: str, network: bool
) -> None:
    monkeypatch.setattr(choices, "has_embedding", lambda: installed)
    options = hri.train(spoken).options
    assert (options.front_end, options.use_network) == (front_end, network), "three speakers"
    assert not hri.train(spoken, hri.WordRecognizer(front_end="cepstra")).options.use_network, "is taken as it is"


def test_what_is_given_stands(spoken: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(choices, "has_embedding", lambda: True)
    dataset = hri.Dataset.load(spoken)
    assert choose_options(dataset, {"front_end": "cepstra"}).options == {"use_network": True}
    assert choose_options(dataset, {"front_end": "cepstra"}, num_persons=2).options == {}
    assert choose_options(dataset, {"use_network": False}).options == {"front_end": "both"}
    assert choose_options(dataset, num_persons=10).options == {"front_end": "both", "use_network": True}


def test_a_pattern_that_takes_names_for_labels_replaces_no_model(
    hri: Any, spoken: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    quick = ("--no-fillers", "--front-end", "cepstra", "--no-network", "--option", "num_states=4")
    kept, wrong = tmp_path / "data" / "hri" / "speech.hri", ("--pattern", "{label}.wav")
    train = ("train", "speech", "--data", spoken, *quick)
    first = hri(*train)
    assert first.code == 0 and "replaces" not in first.err and "single recording" not in first.err
    before = kept.read_bytes()
    refused = hri(*train, *wrong)
    assert refused.code == 3 and kept.read_bytes() == before
    assert "each of the 18 labels has a single recording: 1_high_0" in refused.err and "name --out" in refused.err
    monkeypatch.setattr("hri.cli.train_checks.MOST_SINGLE", 18)
    monkeypatch.setattr("hri.cli.train.train_recognizer", lambda *_, **__: 1 / 0)
    warned = hri(*train, *wrong)
    assert "WARNING: each of the 18 labels" in warned.err and "and 13 more" in warned.err
    assert re.search(r"speech.hri: replaces the model of 20\d\d-.*, 2 labels: 1 2\n", warned.err)
    assert "replaces" not in hri(*train).err, "it has the same labels"


@pytest.mark.parametrize("given", [{"front_end": "mfcc"}, {"num_state": 3}])
def test_an_option_that_is_none_is_refused(spoken: Path, given: dict[str, Any]) -> None:
    with pytest.raises((hri.InvalidArgument, TypeError)):
        choose_options(hri.Dataset.load(spoken), given)


@pytest.mark.usefixtures("untrained")
def test_gestures_are_of_the_source_that_is_chosen(signed: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(choices, "choose_source", lambda _: ("silhouettes", "because"))
    trained = hri.train(signed)
    assert isinstance(trained, hri.GestureRecognizer) and trained.options.source == "silhouettes"
    dataset = hri.Dataset.load(signed)
    assert choose_options(dataset).why == "because"
    assert choose_options(dataset, {"source": "landmarks"}) == choices.Choice({})
