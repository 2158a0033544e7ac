# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Studies as commands: what they write, and each of them whole on a small made-up data folder."""

from __future__ import annotations

import csv
import json
import shutil
from pathlib import Path

import cv2
import numpy as np
import pytest

from conftest import RATE_HZ
from hri import studies
from hri.core.errors import InvalidArgument
from hri.evaluation import EvaluationItem, EvaluationResult, FoldResult
from hri.io import write_wav_pcm16
from hri.recognition import Decision, NBest
from hri.studies import (
    commands,
    distance,
    htk_thesis,
    new_words,
    noise,
    rendering,
    robot_commands,
    synthetic_speakers,
    tables,
    tempo,
    training_size,
    word_trimming,
)
from hri.studies.registry import Layout
from hri.studies.sweeps import measured
from hri.studies.word_classifiers import CLASSIFIERS
from hri.studies.word_features import FEATURES, approximation, denoised, load_words, read_words

pytestmark = pytest.mark.usefixtures("few_fillers", "few_copies")


@pytest.fixture(scope="module")
def data_dir(tmp_path_factory: pytest.TempPathFactory, spoken: Path) -> Path:
    """The layout of the recordings: tones for words, and noises."""
    folder = tmp_path_factory.mktemp("data")
    (folder / "fsdd").mkdir()
    (folder / "fsdd" / "recordings").symlink_to(spoken)
    (folder / "commands").symlink_to(spoken)
    (folder / "hindi_words").mkdir()
    for part in ("digits", "words"):
        (folder / "hindi_words" / part).symlink_to(spoken)
    (folder / "noise").mkdir()
    rng = np.random.default_rng(0)
    for file in noise.NOISES.values():
        hiss = (0.1 * rng.standard_normal(3 * RATE_HZ)).astype("f4")
        write_wav_pcm16(str(folder / "noise" / file), hiss, RATE_HZ)
    return folder


ROWS = [
    {"features": "mfcc", "snr_db": snr_db, **tables.statistics({"ann": 0.5 + snr_db / 100, "bob": 0.7})}
    for snr_db in (20, 10)
] + [{"features": "hfcc", "snr_db": 10, **tables.statistics({"ann": 1.0, "bob": 0.8})}]
RESULT = {"study": "made-up", "target": "to be shown", "passed": True, "rows": ROWS}


def test_statistics_are_over_persons() -> None:
    found = tables.statistics({"ann": 0.5, "bob": 0.7, "cem": 0.9})
    assert found["accuracy_mean"] == pytest.approx(0.7)
    assert found["accuracy_std"] == pytest.approx(np.std([0.5, 0.7, 0.9]))
    assert found["per_fold"] == {"ann": 0.5, "bob": 0.7, "cem": 0.9}


def test_a_single_fold_has_no_spread() -> None:
    for per_fold, shown in (({"ann": 0.5}, "50.0"), ({"ann": 0.5, "bob": 0.5}, "50.0 ± 0.0")):
        assert rendering.show(tables.statistics(per_fold), Layout()) == shown


def test_a_table_spreads_one_axis_over_its_columns() -> None:
    assert rendering.table(RESULT, Layout(columns="snr_db")) == [
        ["features", "snr_db 10", "snr_db 20"],
        ["mfcc", "65.0 ± 5.0", "70.0 ± 0.0"],
        ["hfcc", "90.0 ± 10.0", ""],
    ]
    text = rendering.markdown(RESULT, Layout(columns="snr_db"))
    assert "target: to be shown (met)" in text and "| mfcc | 65.0 ± 5.0 | 70.0 ± 0.0 |" in text


def test_the_csv_holds_every_fold_in_full() -> None:
    rows = list(csv.DictReader(rendering.csv_text(RESULT, Layout()).splitlines()))
    assert [row["features"] for row in rows] == ["mfcc", "mfcc", "hfcc"]
    assert float(rows[1]["per_fold: ann"]) == 0.6 and float(rows[1]["accuracy_mean"]) == pytest.approx(0.65)


def test_a_result_without_rows_is_shown_by_its_parts() -> None:
    result = {"accuracy_mean": 0.5, "accuracy_std": 0.1, "dark": {"hmm": {"accuracy_mean": 0.25, "folds": [1]}}}
    assert rendering.table(result, Layout()) == [["part", "accuracy %"], ["all", "50.0 ± 10.0"], ["dark / hmm", "25.0"]]


@pytest.mark.parametrize("layout", [Layout(x="snr_db"), Layout(panel="features"), Layout(x="features", panel="snr_db")])
def test_pictures_are_drawn(tmp_path: Path, layout: Layout) -> None:
    studies.draw(RESULT, layout, tmp_path / "picture.png")
    picture = cv2.imread(str(tmp_path / "picture.png"))
    assert picture is not None and picture.std() > 5


def test_a_study_writes_table_picture_and_json(hri, data_dir: Path, tmp_path: Path) -> None:
    out = tmp_path / "results"
    only = ("--only", "front_end=plain", "--only", "noise=white,tap")
    result = hri("study", "fsdd-noise", "--data", data_dir, "--out", out, *only)
    assert result.code in (0, 1)
    assert sorted(path.name for path in out.iterdir()) == [f"fsdd-noise.{end}" for end in ("csv", "json", "md", "png")]
    found = json.loads((out / "fsdd-noise.json").read_text())
    assert len(found["rows"]) == 3 * 2 * 2 * 5 and found["passed"] is (result.code == 0)
    assert "| plain | noisy | adapting | tap |" in (out / "fsdd-noise.md").read_text()
    clean = [row for row in found["rows"] if row["snr_db"] == "clean"]
    assert min(row["accuracy_mean"] for row in clean) >= 0.9
    white = {
        row["training"]: row["accuracy_mean"]
        for row in found["rows"]
        if (row["listening"], row["noise"], row["snr_db"]) == ("adapting", "white", 10)
    }
    assert found["passed_by_training"] == {name: white[name] >= target for name, target in noise.TARGETS.items()}
    alone = {
        str(row["snr_db"]): row["accuracy_mean"]
        for row in found["rows"]
        if (row["training"], row["listening"], row["noise"]) == ("noisy", "alone", "white")
    }
    assert found["passed_by_snr_db"] == {str(db): alone[str(db)] >= t for db, t in noise.TARGETS_ALONE.items()}
    assert found["passed"] is all((*found["passed_by_training"].values(), *found["passed_by_snr_db"].values()))
    for row in found["rows"]:  # at every level of noise
        assert row["right_mean"] <= row["recognised_mean"] and 0 <= row["calibration_error_mean"] <= 1


def test_a_part_of_a_study_without_its_target_is_no_miss(data_dir: Path) -> None:
    study = studies.get_study("fsdd-noise")
    only = {"front_end": ["plain"], "training": ["clean"], "noise": ["pink"]}
    first, second = (studies.run_study(study, data_dir, lambda *progress: None, only) for _ in range(2))
    assert first["passed"] is None and first == second
    with pytest.raises(InvalidArgument, match="no axis 'speaker'; there are: front_end, training, noise"):
        studies.run_study(study, data_dir, lambda *progress: None, {"speaker": ["theo"]})


def test_targets_in_noise_are_judged_level_by_level() -> None:
    place = {"front_end": "plain", "training": "noisy", "listening": "alone", "noise": "white"}
    rows = [{**place, "snr_db": db, "accuracy_mean": 0.7} for db in (noise.CLEAN, 20, 10, 5, 0)]
    rows += [{**row, "noise": "pink", "accuracy_mean": 0.0} for row in rows]
    assert noise._met(rows, "plain", noise.TARGETS_ALONE) == {20: False, 10: False, 5: True, 0: True}
    assert noise._met(rows, "both", noise.TARGETS_BOTH) == {}
    assert "20, 10, 5, 0 dB: >= 90, 78, 65, 45 %" in studies.get_study("fsdd-noise").target


def test_words_are_measured_rejected_or_not() -> None:
    def decision(label: str, best: str | None, confidence: float, status: str) -> Decision:
        nbest = () if best is None else (NBest(best, confidence, 0.0),)
        return Decision("speech", label, status, confidence, nbest=nbest)

    heard = [
        decision("a", "a", 1.0, "recognised"),
        decision("unknown", "a", 0.5, "unknown"),
        decision("b", "b", 0.8, "recognised"),
        decision("no_input", None, 0.0, "no_input"),
    ]
    folds = [FoldResult("ann", tuple(EvaluationItem(i, "a", one) for i, one in enumerate(heard)))]
    row = measured(EvaluationResult(["a", "b"], folds))
    assert (row["accuracy_mean"], row["recognised_mean"], row["right_mean"]) == (0.5, 0.5, 0.25)
    assert row["no_input_mean"] == 0.25 and row["calibration_error_mean"] == pytest.approx((0.0 + 0.5 + 0.8) / 3)
    silent = EvaluationResult(["a"], [FoldResult("ann", (EvaluationItem(0, "a", heard[-1]),))])
    assert "calibration_error_mean" not in measured(silent)


def run(name: str, data_dir: Path, **only: list[str]) -> dict:
    return studies.run_study(studies.get_study(name), data_dir, lambda *progress: None, only)


def test_every_classifier_tells_tones_of_unseen_speakers_apart(data_dir: Path) -> None:
    result = run("speech-classifiers", data_dir, data=["fsdd"])
    assert {(row["features"], row["classifier"]) for row in result["rows"]} == {
        (features, classifier) for features in FEATURES for classifier in CLASSIFIERS
    }
    for row in result["rows"]:
        assert set(row["per_fold"]) == {"low", "middle", "high"} and row["accuracy_mean"] >= 0.8, row
    again = run("speech-classifiers", data_dir, data=["fsdd"], classifier=["ptbhmm"], features=["mfcc"])
    assert again["rows"] == [r for r in result["rows"] if (r["classifier"], r["features"]) == ("ptbhmm", "mfcc")]


def test_more_training_is_measured_step_by_step(data_dir: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(training_size, "SPEAKERS", (1, 2))
    monkeypatch.setitem(training_size.SAMPLES, "fsdd", (1, 3))
    result = run("training-samples", data_dir, data=["fsdd"], classifier=["euclidean"])
    assert [(row["speakers"], row["samples"]) for row in result["rows"]] == [(1, 1), (1, 3), (2, 1), (2, 3)]
    words = read_words(data_dir, "fsdd", lambda *progress: None)
    train = [i for i, word in enumerate(words) if word.person != "low"]
    drawn = training_size.drawn(words, train, ["high"], 2, 0)
    assert len(drawn) == 4 and {(words[i].person, words[i].label) for i in drawn} == {("high", "1"), ("high", "2")}
    assert (
        drawn == training_size.drawn(words, train, ["high"], 2, 0) != training_size.drawn(words, train, ["high"], 2, 1)
    )


def test_levels_of_a_wavelet_start_from_none(data_dir: Path) -> None:
    result = run("wavelet-levels", data_dir, data=["fsdd"], wavelet=["haar", "db6"], classifier=["bayes"])
    none = [row for row in result["rows"] if row["level"] == 0 and row["noise"] == "clean"]
    assert none[0]["per_fold"] == none[1]["per_fold"] and none[0]["accuracy_mean"] == 1.0
    assert {row["level"] for row in result["rows"]} == {0, 1, 2, 3, 4}


def test_an_approximation_keeps_the_lower_band_at_its_level() -> None:
    time_s = np.arange(RATE_HZ) / RATE_HZ
    low, high = (np.sin(2 * np.pi * hz * time_s).astype("f4") for hz in (300.0, 3000.0))
    assert np.std(approximation(low)) == pytest.approx(np.std(low), rel=0.02)
    hiss = 0.1 * np.random.default_rng(0).standard_normal(RATE_HZ).astype("f4")
    assert np.mean((denoised(low + hiss, level=3) - low) ** 2) < 0.3 * np.mean(hiss**2)
    assert np.std(approximation(high)) < 0.05 and len(approximation(high)) == RATE_HZ // 8


def test_noise_taken_out_is_measured(data_dir: Path) -> None:
    result = run("denoise", data_dir, threshold=["bayes"], noise=["white"])
    gains = {(row["threshold"], row["shape"], row["estimate"]): row["gain_db_mean"] for row in result["rows"]}
    assert len(gains) == len(result["rows"]) == 3 * 3 + 3
    # Tones with pauses in white noise.
    assert gains["bayes", "soft", "quietest"] > 3.0
    assert set(result["rows"][0]["per_fold"]) == {"low", "middle", "high"}


def test_slow_and_fast_words_are_measured(data_dir: Path) -> None:
    pytest.importorskip("audiotsm")
    result = run("speech-tempo", data_dir, data=["hindi-words"], training=["natural"])
    found = {row["tempo"]: row["accuracy_mean"] for row in result["rows"]}
    assert list(found) == list(tempo.FACTORS) and found[1.0] >= 0.9
    assert all(0 <= row["no_input_mean"] <= 1 for row in result["rows"])


def test_words_from_across_a_room_are_measured(data_dir: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pyroomacoustics")
    monkeypatch.setattr(distance, "DISTANCES_M", (0.5, 3.0))
    monkeypatch.setattr(distance, "NUM_PLACES", 2)
    (data_dir / "room").mkdir(exist_ok=True)
    click = np.zeros(2000, "f4")
    click[[10, 700]] = 0.5, 0.2
    write_wav_pcm16(str(data_dir / distance.RECORDED_RESPONSE), click, RATE_HZ)
    result = run("speech-distance", data_dir, data=["fsdd"])
    places = [(row["training"], row["ambience"], row["distance"]) for row in result["rows"]]
    assert len(set(places)) == len(places) == 2 * 2 * 4
    assert [place[2] for place in places[:4]] == ["close", "0.5 m", "3 m", "recorded room"]
    assert result["rows"][0]["accuracy_mean"] >= 0.9

    assert result["passed"] is distance._passed(result["rows"]) is not None
    assert run("speech-distance", data_dir, data=["fsdd"], training=["close"], ambience=["silent"])["passed"] is None


def test_distance_is_judged_row_by_row() -> None:
    rows = [
        {"training": training, "distance": place, "accuracy_mean": share}
        for training, place, share in (
            ("with rooms", "4 m", 0.93),
            ("with rooms", distance.RECORDED, 0.70),
            ("with rooms", "3 m", 0.1),
            ("close", "4 m", 0.1),
        )
    ]
    assert distance._passed(rows) is True
    assert distance._passed([*rows, {**rows[1], "accuracy_mean": 0.69}]) is False


def test_commands_of_groups_of_speakers(data_dir: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(commands, "NUM_FOLDS", 3)
    result = run("commands", data_dir, front_end=["cepstra"])
    quiet, noisy = result["rows"]
    assert (quiet["test"], noisy["test"]) == (commands.QUIET, commands.NOISY) and len(quiet["per_fold"]) == 3
    for measure in ("recognised", "right", "no_input", "calibration_error"):
        assert set(quiet[f"{measure}_per_fold"]) == set(quiet["per_fold"]), measure
    for row in result["rows"]:
        assert row["right_mean"] <= min(row["recognised_mean"], row["accuracy_mean"])
        assert 0 <= row["calibration_error_mean"] <= 1


def test_what_every_speaker_loses_by_trimming(data_dir: Path) -> None:
    result = run("word-trimming", data_dir, data=["fsdd"], front_end=["cepstra"])
    rows = {(row["test"], row["clips"]): row for row in result["rows"]}
    assert len(rows) == len(result["rows"]) == 3 * 2
    for test in (commands.QUIET, commands.NOISY, word_trimming.QUIETER):
        whole, trimmed = (rows[test, clips]["per_fold"] for clips in (word_trimming.WHOLE, word_trimming.TRIMMED))
        lost = result["lost_by_speaker"][f"fsdd, cepstra, {test}"]
        assert lost == pytest.approx({speaker: whole[speaker] - trimmed[speaker] for speaker in whole})
    assert result["passed"] is all(lost <= 0.01 for of in result["lost_by_speaker"].values() for lost in of.values())


def test_a_quieter_clip_is_one_of_16_bits() -> None:
    clip = np.array([0.5, -0.25, 1 / 32768], np.float32)
    quieter = word_trimming.quieter(clip, RATE_HZ, np.random.default_rng(0))
    np.testing.assert_array_equal(quieter, np.array([1638, -819, 0], np.float32) / 32768)


def test_fewer_takes_are_done_sooner_and_said(hri, data_dir: Path, tmp_path: Path) -> None:
    words = load_words(data_dir, "fsdd", 2)
    assert len(words) == 12 and {sample.take for sample in words.samples} == {"0", "1"}
    only = ("--only", "data=fsdd", "--only", "classifier=knn", "--only", "features=mfcc")
    result = hri("study", "speech-classifiers", "--data", data_dir, "--takes", 2, "--out", tmp_path, *only)
    assert result.code == 0
    assert json.loads((tmp_path / "speech-classifiers.json").read_text())["takes"] == 2
    assert "the first 2 recordings" in (tmp_path / "speech-classifiers.md").read_text()
    assert hri("study", "fsdd", "--data", data_dir, "--takes", 2).code == 3


@pytest.mark.skipif(shutil.which("espeak-ng") is None, reason="no espeak-ng")
def test_synthetic_voices_are_added_to_people(data_dir: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(synthetic_speakers, "TAKES", 1)
    result = run("synthetic-speakers", data_dir, data=["fsdd"], real=["0", "2"], synthetic=["0", "8"])
    found = {(row["real"], row["synthetic"]): row for row in result["rows"]}
    assert set(found) == {(0, 8), (2, 0), (2, 8)}, "no training without persons"
    assert found[2, 0]["accuracy_mean"] >= 0.9 and set(found[2, 0]["per_fold"]) == {"low", "middle", "high"}
    with pytest.raises(InvalidArgument, match="axis real has no '9'"):
        run("synthetic-speakers", data_dir, real=["9"])


def test_no_study_takes_the_hindi_sets_for_each_others_people(data_dir: Path) -> None:
    """Who is called speaker2 in one of them is not the speaker2 of the other."""
    hindi = {"hindi-digits", "hindi-words"}
    for name in hindi:
        assert new_words._other_clips(data_dir, name) == ([], {})
    folders = [folder for folder in htk_thesis.FOLDERS.values() if "hindi" in folder]
    assert len(set(folders)) == 2


def test_bounds_of_commands_are_chosen_without_who_is_tested(data_dir: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each person of the part left out has the bound of decisions by people, and on people, of the other parts."""
    corpus = robot_commands.Corpus(("fsdd/recordings",), "#JSGF V1.0;\ngrammar g;\npublic <g> = 1 | 2;\n", num_parts=3)
    people = ("high", "low", "middle")
    seen: list[tuple[set[str], str, bool]] = []

    def heard(self: object, met: set[str], person: str, conditions: tuple[str, ...] = ()) -> list[object]:
        seen.append((met, person, conditions == [robot_commands.QUIET]))
        sure = {"high": 0.991, "low": 0.96, "middle": 0.85}[person]
        return [
            robot_commands.Heard(person, condition, "stop", "stop", sure) for condition in robot_commands.CONDITIONS
        ]

    monkeypatch.setattr(robot_commands._Study, "trained", lambda self, met, progress: met)
    monkeypatch.setattr(robot_commands._Study, "heard", heard)
    found = robot_commands._run(data_dir, lambda *_: None, corpus=corpus, front_end="cepstra")
    assert all(person not in met for met, person, _ in seen)
    inner = sorted((*met, person) for met, person, is_inner in seen if is_inner)
    assert inner == sorted((one, other) for one in people for other in people if one != other)
    assert found["chosen_min_confidence"] == [0.8, 0.8, 0.95]
    row = next(r for r in found["rows"] if (r["min_confidence"], r["condition"]) == ("chosen", robot_commands.QUIET))
    assert row["per_fold"] == {"high": 1.0, "low": 1.0, "middle": 0.0}
