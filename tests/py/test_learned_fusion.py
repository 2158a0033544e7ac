# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Learned fusion on made-up scores: oracles, invariants, files."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from sklearn.linear_model import LogisticRegression as ReferenceRegression
from sklearn.tree import DecisionTreeClassifier

from hri.core.errors import FormatError, InvalidArgument
from hri.fusion import KINDS, FusionOptions, LearnedFusion, fuse
from hri.fusion.anfis import Anfis
from hri.fusion.learned import MODES, _rows
from hri.fusion.logistic import LogisticStacking, comparisons
from hri.fusion.network import Network
from hri.fusion.reliability import Reliability
from hri.fusion.tree import DecisionTree
from hri.io import ModelFile
from hri.recognition import Decision, NBest

Scores = dict[str, NDArray[np.float64]]
LABELS = ("a", "b", "c", "d", "e")
BEST_QUALITY = {"speech": 30.0, "gesture": 1.0}


def made_up(num_samples: int, seed: int) -> tuple[Scores, Scores, NDArray[np.int64]]:
    """Probabilities that are the surer right the better the signal, by modes that are overconfident in bad ones."""
    rng = np.random.default_rng(seed)
    truth = rng.integers(len(LABELS), size=num_samples)
    scores, quality = {}, {}
    for mode in MODES:
        good = rng.random(num_samples)
        logits = 2 * rng.normal(size=(num_samples, len(LABELS)))
        logits[np.arange(num_samples), truth] += 8 * good
        scores[mode] = np.exp(logits) / np.exp(logits).sum(axis=1, keepdims=True)
        quality[mode] = BEST_QUALITY[mode] * good
    return scores, quality, truth


def decided(mode: str, probabilities: Any, quality: float | None, status: str = "recognised") -> Decision:
    """A decision with these probabilities, in the order of `LABELS`."""
    ranked = sorted(zip(LABELS, map(float, probabilities), strict=True), key=lambda item: -item[1])
    nbest = tuple(NBest(label, p, math.log(max(p, 1e-30))) for label, p in ranked)
    label = nbest[0].label if status == "recognised" else status
    return Decision(mode, label, status, nbest[0].probability, nbest=nbest, quality=quality)


def pairs_of(scores: Scores, quality: Scores) -> list[tuple[Decision, Decision]]:
    columns = [
        [decided(m, p, float(q)) for p, q in zip(scores[m], quality[m], strict=True)] for m in ("speech", "gesture")
    ]
    return list(zip(*columns, strict=True))


NONE = np.zeros(600, bool)
TRAIN, TEST = made_up(600, 1), made_up(300, 2)
FITTED = {kind: LearnedFusion(kind).fit(*TRAIN) for kind in KINDS}
kinds = pytest.mark.parametrize("kind", KINDS)


@kinds
def test_learned_fusion_is_better_than_either_mode_and_than_the_plain_product(kind: str) -> None:
    scores, quality, truth = TEST
    labels = [LABELS[c] for c in truth]
    pairs = pairs_of(scores, quality)

    def share(rule: Any) -> float:
        return float(np.mean([fuse(*p, rule=rule).label == t for p, t in zip(pairs, labels, strict=True)]))

    single = max(float(np.mean(scores[mode].argmax(axis=1) == truth)) for mode in MODES)
    assert share(FITTED[kind]) >= single + 0.1
    assert share(FITTED[kind]) >= share("product") - 0.01


@kinds
def test_a_bad_signal_is_believed_less_than_a_good_one(kind: str) -> None:
    """Both modes are as sure of another class: the one with the better signal is right."""
    says_a, says_b = (0.96, 0.01, 0.01, 0.01, 0.01), (0.01, 0.96, 0.01, 0.01, 0.01)
    for good, bad in (("speech", "gesture"), ("gesture", "speech")):
        modes = {
            good: decided(good, says_a, 0.95 * BEST_QUALITY[good]),
            bad: decided(bad, says_b, 0.05 * BEST_QUALITY[bad]),
        }
        assert FITTED[kind].fuse(**modes).label == "a"


@kinds
def test_fused_probabilities_sum_to_one_and_the_rule_is_named(kind: str) -> None:
    for speech, gesture in pairs_of(TEST[0], TEST[1])[:20]:
        fused = FITTED[kind].fuse(speech, gesture)
        found = [entry.probability for entry in fused.nbest]
        assert sum(found) == pytest.approx(1) and found == sorted(found, reverse=True)
        assert fused.rule == f"learned {kind.replace('_', ' ')} of both score vectors"
        assert fused == fuse(speech, gesture, rule=FITTED[kind])


@kinds
def test_training_knows_neither_the_order_of_classes_nor_of_modes(kind: str) -> None:
    scores, quality, truth = TRAIN
    order = np.random.default_rng(0).permutation(len(LABELS))
    place = np.argsort(order)
    shuffled = LearnedFusion(kind).fit(
        {mode: scores[mode][:, order] for mode in reversed(MODES)}, dict(reversed(quality.items())), place[truth]
    )
    for pair in pairs_of(TEST[0], TEST[1])[:50]:
        expected = {entry.label: entry.probability for entry in FITTED[kind].fuse(*pair).nbest}
        assert {e.label: e.probability for e in shuffled.fuse(*pair).nbest} == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("kind", ["product", "dempster_shafer", "logistic"])
def test_modes_exchanged_in_training_and_use_give_the_same(kind: str) -> None:
    scores, quality, truth = TRAIN
    names = dict(zip(MODES, reversed(MODES), strict=True))
    exchanged = LearnedFusion(kind).fit(
        {names[m]: s for m, s in scores.items()}, {names[m]: q for m, q in quality.items()}, truth
    )
    for speech, gesture in pairs_of(TEST[0], TEST[1])[:50]:
        expected = {entry.label: entry.probability for entry in FITTED[kind].fuse(speech, gesture).nbest}
        other = exchanged.fuse(replace(gesture, mode="speech"), replace(speech, mode="gesture"))
        assert {e.label: e.probability for e in other.nbest} == pytest.approx(expected, abs=1e-6)


def training_rows() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """What learners get of `TRAIN`."""
    scores, quality, truth = TRAIN
    reliability = FITTED["logistic"].reliability_
    rows = _rows(*(scores[m] for m in MODES), *(reliability[m].of(quality[m], NONE) for m in MODES))
    return rows, (np.arange(len(LABELS)) == truth[:, None]).ravel().astype(float)


def test_margins_by_hand() -> None:
    table = np.array([[0.6, 0.3, 0.1]])
    rows = _rows(table, np.array([[0.0, 0.5, 0.5]]), np.array([0.9]), np.array([0.4]))
    unit = math.log(1e4)
    assert rows[:, 0] == pytest.approx(np.log([2, 1 / 2, 1 / 6]) / unit)
    assert rows[:, 1] == pytest.approx([math.log(1e-4 / 0.5) / unit, 0, 0])
    assert rows[:, 2].tolist() == [0.9] * 3 and rows[:, 3].tolist() == [0.4] * 3


def test_logistic_stacking_is_that_of_scikit_learn() -> None:
    rows, yes = training_rows()
    columns, first = comparisons(rows, yes, len(LABELS))
    assert columns.shape == (2 * 600 * 4, 4) and columns[first] == pytest.approx(-columns[~first])
    deviation = columns.std(axis=0)
    reference = ReferenceRegression(C=1.0, tol=1e-10, max_iter=1000).fit(columns / deviation, first)
    expected = reference.coef_ / deviation
    assert reference.intercept_ == pytest.approx(0, abs=1e-6)
    assert FITTED["logistic"]._learner.weights == pytest.approx(expected, rel=1e-3)


def test_logistic_stacking_is_a_product_with_exponents_linear_in_the_reliabilities() -> None:
    speech, gesture = np.array([[0.6, 0.3, 0.1]]), np.array([[0.2, 0.5, 0.3]])
    model = LogisticStacking(np.array([[0.5, 0.1, 2.0, 3.0]]) * math.log(1e4))
    found = model.scores(_rows(speech, gesture, np.array([0.9]), np.array([0.4])))
    expected = (speech ** (0.5 + 2.0 * 0.9) * gesture ** (0.1 + 3.0 * 0.4))[0]
    assert found / found.sum() == pytest.approx(expected / expected.sum())


def test_tree_splits_as_scikit_learn_does() -> None:
    """On values so few that every threshold is tried."""
    rng = np.random.default_rng(0)
    rows = rng.integers(0, 8, (500, 3)).astype(float)
    yes = ((rows[:, 0] > 3) ^ (rows[:, 2] > 5) ^ (rng.random(500) < 0.1)).astype(float)
    tree = DecisionTree.fit(rows, yes, 2, 0)
    reference = DecisionTreeClassifier(max_depth=6, min_samples_leaf=20).fit(rows, yes)
    agree = (tree.scores(rows) > 0.5) == (reference.predict(rows) > 0.5)
    assert agree.mean() > 0.97
    assert abs(((tree.scores(rows) > 0.5) == yes).mean() - reference.score(rows, yes)) < 0.02


def test_network_descends_by_its_true_gradient() -> None:
    rows, yes = training_rows()
    rows, yes = np.column_stack([rows, np.ones(len(rows))])[:200], yes[:200]
    model = Network(*(np.random.default_rng(0).normal(size=shape) for shape in ((8, 5), (1, 8))))

    def loss(hidden: Any, output: Any) -> float:
        p = Network(hidden, output)._forward(rows)[1].reshape(-1, 5)
        decay = 1e-4 * (np.square(hidden).sum() + np.square(output).sum()) / 2
        return float(-np.mean(np.log(p / p.sum(axis=1, keepdims=True))[yes.reshape(-1, 5) > 0]) + decay)

    slope = model._gradient(rows, yes, 5)[0]
    step = np.zeros_like(model.hidden)
    step[2, 1] = 1e-6
    numeric = (loss(model.hidden + step, model.output) - loss(model.hidden - step, model.output)) / 2e-6
    assert slope[2, 1] == pytest.approx(numeric, rel=1e-4)


def test_anfis_learns_what_neither_a_line_nor_least_squares_alone_can() -> None:
    rng = np.random.default_rng(0)
    rows = rng.uniform(-1, 1, (800, 2))
    yes = (rows[:, 0] * rows[:, 1] > 0).astype(float)
    model = Anfis.fit(rows, yes, 2, 0)
    found = model.scores(rows)
    assert ((found > 0.5) == (yes > 0.5)).mean() > 0.95 and found.min() >= 0 and found.max() <= 1
    strengths = model._strengths(rows)
    assert strengths.shape == (800, 4) and strengths.sum(axis=1) == pytest.approx(1)


def test_anfis_moves_its_sets_down_the_error() -> None:
    rng = np.random.default_rng(0)
    rows = rng.uniform(-1, 1, (300, 2))
    yes = (np.hypot(*rows.T) < 0.5).astype(float)
    model = Anfis(np.array([[-0.9, 0.9]] * 2), np.full((2, 2), 0.4), rng.normal(size=(4, 3)))
    before = np.mean(np.square(model._output(rows) - yes))
    model.centres, model.widths = model._moved(rows, yes)
    assert np.mean(np.square(model._output(rows) - yes)) < before


def test_reliability_is_how_often_a_mode_is_right() -> None:
    scores, quality, truth = TRAIN
    right = scores["speech"].argmax(axis=1) == truth
    found = Reliability.fit(quality["speech"], NONE, right)
    assert (np.diff(found.of(np.array([0.0, 10.0, 20.0, 30.0]), NONE[:4])) > 0).all() and found.rejection == 0
    for low, high in ((0.0, 10.0), (20.0, 30.0)):
        of = (quality["speech"] >= low) & (quality["speech"] <= high)
        assert found.of(quality["speech"][of], NONE[of]).mean() == pytest.approx(right[of].mean(), abs=0.1)
    unknown, mean = found.of(np.array([np.nan, found.prior]), NONE[:2])
    assert unknown == mean and found.prior == pytest.approx(quality["speech"].mean())


def test_a_rejection_lowers_the_reliability() -> None:
    right = np.arange(100) < 80
    rejected = ~right ^ (np.arange(100) % 10 == 0)
    found = Reliability.fit(np.full(100, np.nan), rejected, right)
    taken, refused = found.of(np.full(2, np.nan), np.array([False, True]))
    assert taken == pytest.approx(right[~rejected].mean(), abs=0.05)
    assert refused == pytest.approx(right[rejected].mean(), abs=0.05)


def test_what_speaks_against_sense_is_not_learned() -> None:
    """A mode that is right the more often the worse its signal, or when it rejects."""
    scores, quality, truth = TRAIN
    right = scores["speech"].argmax(axis=1) == truth
    found = Reliability.fit(-quality["speech"], right, right)
    assert (found.slope, found.rejection) == (0, 0)
    assert found.of(np.array([-5.0]), NONE[:1])[0] == pytest.approx(right.mean(), abs=0.01)
    assert Reliability.fit(quality["speech"], NONE, ~NONE).of(np.array([3.0]), NONE[:1])[0] == 0.98


def test_a_mode_that_was_always_right_or_never_follows_laplace() -> None:
    """10 of 10 right are odds of 11 to 1: no more than that is known of so few."""
    quality = np.linspace(1.0, 3.0, 10)
    for right, expected in ((~NONE[:10], 11 / 12), (NONE[:10], 1 / 12)):
        found = Reliability.fit(quality, NONE[:10], right)
        assert (found.slope, found.rejection, found.prior) == (0, 0, pytest.approx(2.0))
        assert found.of(np.array([0.0, 9.0, np.nan]), NONE[:3]) == pytest.approx([expected] * 3)


@kinds
def test_a_rejection_lets_the_other_mode_win(kind: str) -> None:
    """Speech and gesture say different labels, speech a little surer, on signals of the same quality."""
    scores, quality, truth = TRAIN
    wrong = {mode: scores[mode].argmax(axis=1) != truth for mode in MODES}
    fusion = LearnedFusion(kind).fit(scores, quality, truth, wrong)
    speech = decided("speech", (0.9, 0.04, 0.03, 0.02, 0.01), 0.6 * BEST_QUALITY["speech"])
    gesture = decided("gesture", (0.04, 0.88, 0.04, 0.03, 0.01), 0.6 * BEST_QUALITY["gesture"])
    assert fusion.fuse(replace(speech, status="unknown", label="unknown"), gesture).label == "b"
    assert fusion.fuse(speech, replace(gesture, status="unknown", label="unknown")).label == "a"


def test_of_classes_that_a_tree_scores_alike_the_product_decides() -> None:
    """A tree of one leaf scores all alike; of equal classes the first of the alphabet would come first."""
    fusion = LearnedFusion.from_model_file(changed("tree", "learner.nodes", np.array([[-1.0, 0, 0, 0, 0.3]])))
    speech, gesture = (decided(mode, (0.1, 0.2, 0.1, 0.4, 0.2), 0.5) for mode in MODES)
    assert [entry.label for entry in fusion.fuse(speech, gesture).nbest[:2]] == ["d", "b"]


@kinds
def test_stop_missing_modes_and_rejections_are_those_of_every_rule(kind: str) -> None:
    fusion = FITTED[kind]
    speech, gesture = (decided(mode, (0.6, 0.1, 0.1, 0.1, 0.1), 0.5) for mode in ("speech", "gesture"))
    assert fusion.fuse(speech, None).rule.startswith("speech alone") and fusion.fuse(None, gesture).label == "a"
    assert fusion.fuse(None, None).status == "no_input"
    rejected = [replace(one, status="unknown", label="unknown") for one in (speech, gesture)]
    assert fusion.fuse(*rejected).status == "unknown"
    assert fusion.fuse(rejected[0], gesture).label == "a"
    assert fusion.fuse(speech, gesture, FusionOptions(stop_labels=("a",))).rule.startswith("stop")


@kinds
def test_a_class_that_training_had_not_and_one_mode_has_not(kind: str) -> None:
    more = Decision("speech", "z", "recognised", 0.9, nbest=(NBest("z", 0.9, 0.0), NBest("a", 0.1, 0.0)))
    fused = FITTED[kind].fuse(more, decided("gesture", (0.3, 0.2, 0.2, 0.2, 0.1), 0.1))
    assert {e.label for e in fused.nbest} == {*LABELS, "z"} and sum(
        e.probability for e in fused.nbest
    ) == pytest.approx(1)
    alone = Decision("speech", "z", "recognised", 1.0, nbest=(NBest("z", 1.0, 0.0),))
    assert FITTED[kind].fuse(alone, replace(alone, mode="gesture")).label == "z"


def test_decisions_are_what_their_scores_are() -> None:
    scores, quality, truth = TRAIN
    speech, gesture = zip(*pairs_of(scores, quality), strict=True)
    nothing = Decision("gesture", "no_input", "no_input", 0.0)
    labels = [LABELS[c] for c in truth]
    found = LearnedFusion("logistic").fit_decisions([*speech, speech[0]], [*gesture, nothing], [*labels, "a"])
    assert np.allclose(found._learner.weights, FITTED["logistic"]._learner.weights)
    with pytest.raises(InvalidArgument, match="label 'z' is known to neither mode: a, b"):
        LearnedFusion().fit_decisions(speech, gesture, ["z"] * len(labels))
    with pytest.raises(InvalidArgument, match="differ in length: 600, 600, 1"):
        LearnedFusion().fit_decisions(speech, gesture, ["a"])
    with pytest.raises(InvalidArgument, match="no pair of decisions with input in both"):
        LearnedFusion().fit_decisions([speech[0]], [nothing], ["a"])


@kinds
def test_files_give_the_same_to_the_bit(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "fusion.hri"
    FITTED[kind].save(path)
    again = LearnedFusion.load(path)
    assert again.kind == kind and again.reliability_ == FITTED[kind].reliability_
    for pair in pairs_of(TEST[0], TEST[1])[:50]:
        assert again.fuse(*pair) == FITTED[kind].fuse(*pair)


def changed(kind: str, name: str, value: Any) -> ModelFile:
    """The file of a fusion with another value of one field."""
    source, file = FITTED[kind].to_model_file(), ModelFile()
    for key, text in source.metadata().items():
        file.set_text(key, text)
    for key in source.tensor_shapes():
        file.set_matrix_d(key, source.matrix_d(key))
    if isinstance(value, str):
        file.set_text(name, value)
    else:
        file.set_matrix_d(name, value)
    return file


NODES = DecisionTree.fit(*training_rows(), 5, 0).nodes


def with_cell(row: int, column: int, value: float) -> NDArray[np.float64]:
    nodes = NODES.copy()
    nodes[row, column] = value
    return nodes


@pytest.mark.parametrize(
    ("kind", "name", "value", "message"),
    [
        ("logistic", "kind", "word_recognizer", "kind: the file holds 'word_recognizer'"),
        ("logistic", "rule", "majority", "rule: no kind of learned fusion 'majority'"),
        ("product", "rule", "tree", "learner.nodes"),
        ("logistic", "rule", "product", "learner.weights"),
        ("logistic", "speech.slope", "-1", "speech.slope is -1.0"),
        ("logistic", "gesture.rejection", "2", "gesture.rejection is 2.0"),
        ("logistic", "gesture.prior", "nan", "gesture.prior"),
        ("logistic", "surplus", "1", "surplus"),
        ("logistic", "learner.weights", np.zeros((1, 3)), r"learner.weights has shape \(1, 3\)"),
        ("network", "learner.hidden", np.zeros((8, 4)), "learner.hidden has shape"),
        ("network", "learner.output", np.zeros((1, 3)), "learner.output has shape"),
        ("anfis", "learner.centres", np.zeros((3, 2)), "learner.centres has shape"),
        ("anfis", "learner.widths", np.zeros((4, 2)), "learner.widths must be"),
        ("tree", "learner.nodes", np.zeros((2, 4)), "learner.nodes has shape"),
        ("tree", "learner.nodes", with_cell(0, 0, 4), "learner.nodes: inputs must lie in -1..3"),
        ("tree", "learner.nodes", with_cell(0, 0, 0.5), "learner.nodes: inputs must lie in -1..3"),
        ("tree", "learner.nodes", with_cell(0, 2, 0), "learner.nodes: a child that is no later node"),
        ("tree", "learner.nodes", with_cell(0, 3, len(NODES)), "learner.nodes: a child that is no later node"),
        ("tree", "learner.nodes", with_cell(0, 4, 1.5), r"learner\.nodes: .* share outside"),
    ],
)
def test_hostile_files_are_refused_by_file_and_field(
    kind: str, name: str, value: Any, message: str, tmp_path: Path
) -> None:
    path = tmp_path / "hostile.hri"
    changed(kind, name, value).write(path)
    with pytest.raises(FormatError, match=message) as refusal:
        LearnedFusion.load(path)
    assert str(refusal.value).startswith(f"{path}: ") and str(refusal.value).count(str(path)) == 1
    for given in (str(path), str(path).encode()):
        with pytest.raises(FormatError) as again:
            LearnedFusion.load(given)  # type: ignore[arg-type]
        assert str(again.value) == str(refusal.value)
    # What was not read from a file names the field alone.
    with pytest.raises(FormatError, match=message) as of_bytes:
        LearnedFusion.from_model_file(ModelFile.from_bytes(path.read_bytes(), "memory"))
    assert str(path) not in str(of_bytes.value)


@pytest.mark.parametrize("kind", ["logistic", "tree"])
def test_cut_and_damaged_files_are_refused(kind: str, tmp_path: Path) -> None:
    data = FITTED[kind].to_model_file().to_bytes()
    path = tmp_path / "damaged.hri"
    for size in (0, 7, 100, len(data) - 1):
        path.write_bytes(data[:size])
        with pytest.raises(FormatError, match=r"damaged\.hri"):
            LearnedFusion.load(path)
    path.write_bytes(data[:-3] + bytes([data[-3] ^ 1]) + data[-2:])
    with pytest.raises(FormatError, match=r"damaged\.hri"):
        LearnedFusion.load(path)


SCORES, QUALITY = ({mode: values[:20] for mode, values in part.items()} for part in TRAIN[:2])
TRUTH = TRAIN[2][:20]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"scores": {"speech": SCORES["speech"]}}, "scores of gesture are missing: there are speech"),
        ({"quality": {}}, "quality of speech are missing: there are none"),
        ({"scores": SCORES | {"gesture": SCORES["gesture"][:5]}}, "differ in shape"),
        ({"scores": SCORES | {"gesture": SCORES["gesture"] + 1}}, "gesture must be probabilities"),
        ({"scores": SCORES | {"gesture": SCORES["gesture"] * math.nan}}, "gesture must be probabilities"),
        ({"scores": {m: s[:, :1] for m, s in SCORES.items()}}, "must have shape"),
        ({"scores": SCORES | {"speech": "ab"}}, "scores of speech are no numbers"),
        ({"quality": QUALITY | {"speech": [1.0]}}, "quality of speech must be 20 numbers"),
        ({"quality": QUALITY | {"speech": [math.inf] * 20}}, "quality of speech must be 20 numbers"),
        ({"labels": TRUTH[:3]}, "differ in shape"),
        ({"labels": TRUTH + 5}, "labels must be integers, 0..4"),
        ({"labels": TRUTH * 1.0}, "labels must be integers"),
    ],
)
def test_bad_input_is_refused_by_name(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(InvalidArgument, match=message):
        LearnedFusion().fit(**({"scores": SCORES, "quality": QUALITY, "labels": TRUTH} | changes))


def test_unknown_kinds_and_untrained_fusions_are_refused() -> None:
    with pytest.raises(InvalidArgument, match="no kind of learned fusion 'logistics'; did you mean 'logistic'"):
        LearnedFusion("logistics")
    speech, gesture = pairs_of(TEST[0], TEST[1])[0]
    with pytest.raises(ValueError, match="not trained: call fit or load"):
        LearnedFusion().fuse(speech, gesture)
    with pytest.raises(TypeError, match="rule must be a name or a LearnedFusion, got int"):
        fuse(speech, gesture, rule=3)
