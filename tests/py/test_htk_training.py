# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Training of HTK's models from transcripts without times: against sums over all paths, and from words to strings."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from conftest import CommandResult
from hri.core.errors import InvalidArgument
from hri.htk import (
    EditScript,
    EmbeddedTrainer,
    EmbeddedTrainerOptions,
    FeatureExtractor,
    FlatStart,
    ModelSet,
    ParameterFile,
)
from hri.models import GaussianMixtureHmmOptions
from hri.synthetic.speech import make_speaker, speak

WORDS = ("one", "two", "three")
KIND = "MFCC_0_D_A"
DIM = 39


def model_text(name: str, means: NDArray[np.float64], transitions: NDArray[np.float64]) -> str:
    """A definition with variances of 1."""
    lines = [f'~h "{name}"\n<BEGINHMM>\n<NUMSTATES> {len(means) + 2}']
    for number, mean in enumerate(means, 2):
        lines.append(f"<STATE> {number}\n<MEAN> {len(mean)}\n {' '.join(map(repr, mean.tolist()))}")
        lines.append(f"<VARIANCE> {len(mean)}\n{' 1' * len(mean)}")
    lines.append(f"<TRANSP> {len(transitions)}")
    lines += [" ".join(map(repr, row)) for row in transitions.tolist()]
    return "\n".join([*lines, "<ENDHMM>\n"])


def left_right(num_states: int, skip: float = 0.0) -> NDArray[np.float64]:
    """A chain without jumps, which with probability `skip` is passed without a frame."""
    matrix = np.diag([0.0] + [0.6] * num_states + [0.0]) + np.diag([1.0] + [0.4] * num_states, 1)
    matrix[0, 1], matrix[0, -1] = 1 - skip, matrix[0, -1] + skip
    return matrix


def toy_models() -> tuple[ModelSet, dict[str, tuple[NDArray[np.float64], NDArray[np.float64]]]]:
    """Models a, b and sp of one value a frame; also their means and transitions."""
    jumping = np.array([[0, 0.8, 0.2, 0], [0, 0.5, 0.3, 0.2], [0, 0.1, 0.5, 0.4], [0, 0, 0, 0]])
    parts = {
        "a": (np.array([[0.0], [2.0]]), jumping),
        "b": (np.array([[1.0], [-1.0]]), left_right(2)),
        "sp": (np.array([[0.5]]), left_right(1, 0.3)),
    }
    models = ModelSet("USER")
    models.parse("".join(model_text(name, *part) for name, part in parts.items()), "models")
    return models, parts


Step = tuple[int, int, int]


def all_paths(matrices: Sequence[NDArray[np.float64]], num_frames: int) -> Iterator[tuple[list[Step], float]]:
    """Every way through the models in so many frames: steps (unit, from, to), and the product of their weights."""

    def onward(unit: int, state: int, left: int) -> Iterator[tuple[list[Step], float]]:
        matrix = matrices[unit]
        for to in np.flatnonzero(matrix[state]):
            step, weight = (unit, state, int(to)), float(matrix[state, to])
            if to < len(matrix) - 1:
                rest = onward(unit, int(to), left - 1) if left else iter(())
            elif unit + 1 < len(matrices):
                rest = onward(unit + 1, 0, left)
            else:
                rest = iter([([], 1.0)] if left == 0 else [])
            for steps, product in rest:
                yield [step, *steps], weight * product

    yield from onward(0, 0, num_frames)


def test_expectations_are_sums_over_all_paths():
    """Everything that one iteration estimates, by brute force, with a model that may be skipped in all places."""
    models, parts = toy_models()
    rng = np.random.default_rng(0)
    trainer = EmbeddedTrainer(models, EmbeddedTrainerOptions(min_examples=1))
    steps_of = {name: np.zeros_like(matrix) for name, (_, matrix) in parts.items()}
    frames_of: dict[tuple[str, int], list[tuple[float, float]]] = {}
    log_likelihood = 0.0
    for units, num_frames in (("a sp b sp", 6), ("sp a sp sp a", 5), ("b a", 7), ("sp", 2), ("b sp", 2)):
        names = units.split()
        frames = rng.normal(size=(num_frames, 1)).astype(np.float32)
        weighted = []
        for steps, product in all_paths([parts[name][1] for name in names], num_frames):
            states = [(names[u], to) for u, _, to in steps if to < len(parts[names[u]][1]) - 1]
            centres = np.array([parts[name][0][state - 1, 0] for name, state in states])
            x = frames[:, 0].astype(float)
            weighted.append((steps, states, product * np.prod(np.exp(-((x - centres) ** 2) / 2) / np.sqrt(2 * np.pi))))
        total = sum(weight for *_, weight in weighted)
        log_likelihood += np.log(total)
        for steps, states, weight in weighted:
            for unit, start, end in steps:
                steps_of[names[unit]][start, end] += weight / total
            for state, value in zip(states, frames[:, 0], strict=True):
                frames_of.setdefault(state, []).append((weight / total, float(value)))
        assert trainer.add(frames, names) == "added"
    assert trainer.log_likelihood == pytest.approx(log_likelihood, rel=1e-12)
    made = trainer.estimate()
    for name, counts in steps_of.items():
        expected = counts[:-1] / counts[:-1].sum(1, keepdims=True)
        np.testing.assert_allclose(made.transitions(name)[:-1], expected, rtol=1e-9, atol=1e-12)
        for state in range(1, len(counts) - 1):
            weights, values = np.array(frames_of[name, state]).T
            mean = np.average(values, weights=weights)
            hmm = made.hmm(name)
            assert hmm.means[state - 1, 0] == pytest.approx(mean, rel=1e-9, abs=1e-12)
            assert hmm.variances[state - 1, 0] == pytest.approx(
                np.average((values - mean) ** 2, weights=weights), rel=1e-9
            )
    for one in trainer.occupations():
        for state, frames_met in enumerate(one.states, 1):
            assert frames_met == pytest.approx(sum(w for w, _ in frames_of[one.name, state]), rel=1e-9)


def test_one_model_an_utterance_is_baum_welch_of_the_model():
    """Far from each other, states end where they must, whether the exit is part of the model or not."""
    rng = np.random.default_rng(1)
    models = ModelSet("USER")
    means = np.array([[0.0, 1.0], [8.0, -7.0], [20.0, 3.0]])
    models.parse(model_text("x", means, left_right(3)), "models")
    clips = [np.repeat(means, 4 + k, axis=0) + rng.normal(size=(3 * (4 + k), 2)) for k in range(5)]
    frames = [clip.astype(np.float32) for clip in clips]
    trainer = EmbeddedTrainer(models)
    for clip in frames:
        assert trainer.add(clip, ["x"]) == "added"
    made = trainer.estimate().hmm("x")
    once = models.hmm("x").retrain(frames, GaussianMixtureHmmOptions(max_iterations=1, variance_floor=1e-9))
    np.testing.assert_allclose(made.means, once.means, rtol=1e-9)
    np.testing.assert_allclose(made.variances, once.variances, rtol=1e-9)
    np.testing.assert_allclose(made.chain.transition[:2], once.chain.transition[:2], rtol=1e-9)
    stay = trainer.estimate().transitions("x")[3, 3]
    lengths = [4 + k for k in range(5)]
    assert stay == pytest.approx(1 - 1 / np.mean(lengths), rel=1e-9)


def test_flat_start_is_numpys_mean_and_variance():
    rng = np.random.default_rng(2)
    frames = [rng.normal([5, -3], [1, 4], size=(n, 2)).astype(np.float32) for n in (3, 40, 7)]
    start = FlatStart()
    for clip in frames:
        start.add(clip)
    together = np.concatenate(frames).astype(float)
    np.testing.assert_allclose(start.mean, together.mean(0), rtol=1e-12)
    np.testing.assert_allclose(start.variance, together.var(0), rtol=1e-9)
    models = ModelSet("USER")
    models.parse(model_text("x", np.zeros((2, 2)), left_right(2)), "models")
    np.testing.assert_array_equal(start.apply(models, True).hmm("x").means, np.tile(start.mean, (2, 1)))
    with pytest.raises(InvalidArgument, match="another number of columns"):
        start.add(np.zeros((2, 3), np.float32))


@pytest.fixture(scope="module")
def strings(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Strings of synthetic words, as parameter files, and what was said in them, without times."""
    folder = tmp_path_factory.mktemp("strings")
    rng = np.random.default_rng(3)
    clips = {(word, take): speak(word, "en", make_speaker(3), take) for word in WORDS for take in range(4)}
    for number in range(24):
        said = [WORDS[i] for i in rng.integers(0, len(WORDS), rng.integers(2, 5))]
        parts = [clips[word, int(rng.integers(0, 4))] for word in said]
        rate_hz = parts[0].sample_rate_hz
        extractor = FeatureExtractor(KIND, rate_hz)
        frames = extractor.compute(np.concatenate([part.samples for part in parts]))
        ParameterFile(frames, KIND, extractor.sample_period).write(folder / f"s{number:02d}.mfc")
        units = [unit for word in said for unit in (word, "sp")][:-1]
        (folder / f"s{number:02d}.lab").write_text("\n".join(["sil", *units, "sil"]) + "\n")
    return folder


def succeed(result: CommandResult) -> str:
    assert (result.code, result.err) == (0, "")
    return result.out


def average(out: str) -> float:
    return float(re.search(r"average log prob per frame = (\S+)\n", out)[1])


def test_strings_without_times_train_models_that_recognise_strings(
    hri, strings: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """From a flat start, 18 strings to train on and 6 others to recognise, of one synthetic speaker."""
    monkeypatch.chdir(tmp_path)
    names = sorted(strings.glob("*.mfc"))
    Path("train.scp").write_text("".join(f"{name}\n" for name in names[:18]))
    for model, num_states, skip in (*((word, 8, 0.0) for word in WORDS), ("sil", 3, 0.0), ("sp", 1, 0.3)):
        header = f"~o <VECSIZE> {DIM} <{KIND}>\n"
        Path("proto").write_text(
            header + model_text("proto", np.zeros((num_states, DIM)), left_right(num_states, skip))
        )
        succeed(hri("htk", "compv", "-m", "-f", 0.01, "-M", "hmm0", "-o", model, "-S", "train.scp", "proto"))
    Path("list").write_text("\n".join([*WORDS, "sil", "sp"]) + "\n")
    assert Path("hmm0/vFloors").read_text().startswith('~v "varFloor1"\n<VARIANCE> 39\n')

    averages = []
    for number in range(12):
        old, new = f"hmm{number}", f"hmm{number + 1}"
        passed = hri(
            "htk", "erest", "-t", 250, 150, 1000, "-H", "hmm0/vFloors", "-d", old, "-M", new, "-S", "train.scp", "list"
        )
        averages.append(average(succeed(passed)))
    # Floors hold some variances up, so that the last steps may lose a little.
    assert np.all(np.diff(averages) > -0.01) and averages[-1] > averages[0] + 1

    Path("grammar").write_text(f"$word = {' | '.join(WORDS)};\n( SIL < $word > SIL )\n")
    Path("dict").write_text("".join(f"{word} {word} sp\n" for word in WORDS) + "SIL [] sil\n")
    succeed(hri("htk", "parse", "grammar", "wdnet"))
    macros = [argument for model in (*WORDS, "sil", "sp") for argument in ("-H", f"hmm12/{model}")]
    tests = [str(name) for name in names[18:]]
    succeed(hri("htk", "vite", *macros, "-w", "wdnet", "-l", "*", "-i", "found.mlf", "dict", "list", *tests))
    scored = succeed(hri("htk", "results", "-L", strings, "-e", "???", "sil", "-e", "???", "sp", "list", "found.mlf"))
    assert "Acc=100.00" in scored


def test_embedded_training_reads_and_writes_files_as_herest(hri, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    models, _ = toy_models()
    models.write("models")
    Path("list").write_text("a\nb\nsp\nlogical a\n")
    rng = np.random.default_rng(4)
    for number in range(4):
        frames = rng.normal(size=(9, 1)).astype(np.float32)
        ParameterFile(frames, "USER", 100000).write(f"u{number}.usr")
    entries = [f'"*/u{number}.lab"\nlogical\nsp\nb\n.\n' for number in range(4)]
    Path("said.mlf").write_text("#!MLF!#\n" + "".join(entries))
    files = [f"u{number}.usr" for number in range(4)]
    given = ("-H", "models", "-I", "said.mlf")
    succeed(hri("htk", "erest", *given, "-M", "out", "-s", "stats", "list", *files))
    made = ModelSet()
    made.read("out/models")
    trainer = EmbeddedTrainer(models)
    for file in files:
        trainer.add(ParameterFile.read(file).values, ["a", "sp", "b"])
    assert made.to_text() == trainer.estimate().to_text() == Path("out/models").read_text()
    rows = [line.split() for line in Path("stats").read_text().splitlines()]
    assert [row[:3] for row in rows] == [["1", '"a"', "4"], ["2", '"b"', "4"], ["3", '"sp"', "4"]]
    assert sum(float(cell) for row in rows for cell in row[3:]) == pytest.approx(36, abs=1e-4)

    # Flags: what is not named stays.
    succeed(hri("htk", "erest", *given, "-M", "kept", "-u", "t", "list", *files))
    kept = ModelSet()
    kept.read("kept/models")
    np.testing.assert_array_equal(kept.hmm("a").means, models.hmm("a").means)
    np.testing.assert_allclose(kept.transitions("a"), made.transitions("a"))

    # Two files of models keep what is theirs; without -M they are written where they were.
    text = Path("models").read_text()
    at = text.index('~h "sp"')
    Path("first").write_text(text[:at])
    Path("second").write_text("~o <VECSIZE> 1 <USER>\n" + text[at:])
    succeed(hri("htk", "erest", "-H", "first", "-H", "second", "-I", "said.mlf", "list", *files))
    assert Path("first").read_text() == made.to_text()[: made.to_text().index('~h "sp"')]
    assert Path("second").read_text().endswith(made.to_text()[made.to_text().index('~h "sp"') :])


def test_embedded_training_says_what_it_leaves_out_and_refuses(hri, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    toy_models()[0].write("models")
    Path("list").write_text("a\nb\nsp\n")
    rng = np.random.default_rng(5)
    for name, length in (("short", 3), ("long", 12)):
        ParameterFile(rng.normal(size=(length, 1)).astype(np.float32), "USER", 100000).write(f"{name}.usr")
        Path(f"{name}.lab").write_text("b\nb\n")
    given = ("htk", "erest", "-H", "models", "-M", "out")
    left = hri(*given, "-m", 2, "list", "short.usr", "long.usr")
    assert left.code == 0 and "short.usr: has fewer frames than the models of its transcript take" in left.err
    assert "a: occurs 0 times, fewer than 2; not trained" in left.err and "\nb: occurs" not in left.err
    nothing = hri(*given, "list", "short.usr")
    assert nothing.code == 3 and "no recording fits its transcript" in nothing.err
    Path("out/models").unlink()

    Path("long.lab").write_text("\n\nb\nc\n")
    unknown = hri(*given, "list", "short.usr", "long.usr")
    assert unknown.code == 3 and "long.lab: line 4: the list of models does not have 'c'" in unknown.err
    Path("said.mlf").write_text('#!MLF!#\n"*/short.lab"\nb\n.\n"*/long.lab"\nb\nd\n.\n')
    unknown = hri(*given, "-I", "said.mlf", "list", "short.usr", "long.usr")
    assert unknown.code == 3 and "said.mlf: line 7: the list of models does not have 'd'" in unknown.err
    Path("long.lab").write_text("")
    assert "the transcript of long.usr is empty" in hri(*given, "list", "long.usr").err
    Path("list").write_text("a\nb\nx\n")
    missing = hri(*given, "list", "short.usr")
    assert missing.code == 3 and "no -H defines the model 'x'" in missing.err
    assert hri(*given, "-u", "q", "list", "short.usr").code == 2
    assert hri(*given, "-t", "x", "list", "short.usr").code == 2
    assert hri(*given, "list").code != 0
    assert not Path("out/models").exists()


def test_hed_splits_ties_and_names_file_and_line(hri, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    models, _ = toy_models()
    models.write("models")
    Path("list").write_text("a\nb\nsp\n")
    Path("split.hed").write_text("MU 2 {*.state[2-3].mix}\nTI steps {(a,b).transP}\nAT 1 3 0.2 {sp.transP}\n")
    done = succeed(hri("htk", "hed", "-T", 1, "-H", "models", "-M", "out", "split.hed", "list"))
    assert done == "split.hed: 3 commands -> out/models\n"
    made = ModelSet()
    made.read("out/models")
    for name in ("a", "b", "sp"):
        before, after = models.hmm(name), made.hmm(name)
        np.testing.assert_array_equal(after.weights, np.full((before.num_states, 2), 0.5))
        shifts = np.tile([[0.2], [-0.2]], (before.num_states, 1))
        np.testing.assert_allclose(after.means, np.repeat(before.means, 2, axis=0) + shifts)
        np.testing.assert_array_equal(after.variances, np.repeat(before.variances, 2, axis=0))
    np.testing.assert_array_equal(made.transitions("b"), models.transitions("a"))
    assert made.transitions("sp")[0].tolist() == [0, 0.8, 0.2]
    assert Path("out/models").read_text().count('~t "steps"') == 3

    Path("wrong.hed").write_text("MU 2 {*.state[2].mix}\nMU 2 {c.state[2].mix}\n")
    refused = hri("htk", "hed", "-H", "models", "-M", "other", "wrong.hed", "list")
    assert refused.code == 3 and "wrong.hed: line 2: no model has what the items name" in refused.err
    assert not Path("other").exists()
    made.write("second")
    assert hri("htk", "hed", "-H", "models", "-d", "out", "split.hed", "list").code == 0
    Path("list").write_text("a\nb\nsp\nc\n")
    assert "no -H defines the model 'c'" in hri("htk", "hed", "-H", "models", "split.hed", "list").err


def test_more_gaussians_fit_two_clusters_better():
    """A state whose frames lie in two heaps: split, it finds both."""
    rng = np.random.default_rng(6)
    models = ModelSet("USER")
    models.parse(model_text("x", np.zeros((1, 1)), left_right(1)), "models")
    heaps = [rng.choice([-4.0, 4.0], size=(60, 1)) + rng.normal(size=(60, 1)) for _ in range(4)]
    likelihoods = []
    for number_of_gaussians in (1, 2):
        models = EditScript.parse(f"MU {number_of_gaussians} {{x.state[2].mix}}", "script").apply(models)
        for _ in range(60):
            trainer = EmbeddedTrainer(models)
            for frames in heaps:
                trainer.add(frames.astype(np.float32), ["x"])
            models = trainer.estimate()
            likelihoods.append(trainer.log_likelihood)
    assert np.all(np.diff(likelihoods[:60]) >= -1e-9) and np.all(np.diff(likelihoods[60:]) >= -1e-9)
    assert likelihoods[-1] > likelihoods[59] + 100
    np.testing.assert_allclose(np.sort(models.hmm("x").means[:, 0]), [-4, 4], atol=0.3)


def test_tied_mixtures_are_trained_together(hri, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """States that share all Gaussians differ in their weights; what erest writes is such a file again."""
    monkeypatch.chdir(tmp_path)
    text = "~o <VECSIZE> 1 <USER>\n"
    for number, mean in enumerate((0.0, 6.0, 12.0), 1):
        text += f'~m "mix{number}"\n<MEAN> 1\n{mean}\n<VARIANCE> 1\n1\n'
    for name in ("a", "b"):
        text += f'~h "{name}"\n<BEGINHMM>\n<NUMSTATES> 3\n<STATE> 2\n<NUMMIXES> 3\n<TMIX> mix 0.4 0.3*2\n'
        text += "<TRANSP> 3\n0 1 0\n0 .9 .1\n0 0 0\n<ENDHMM>\n"
    Path("models").write_text(text)
    Path("list").write_text("a\nb\n")
    rng = np.random.default_rng(0)
    heaps = {"a": ([0.0, 6.0], [0.75, 0.25]), "b": ([6.0, 12.0], [0.5, 0.5])}
    for name, (means, shares) in heaps.items():
        frames = rng.choice(means, size=(400, 1), p=shares) + rng.normal(size=(400, 1)) + 0.5
        ParameterFile(frames.astype(np.float32), "USER", 100000).write(f"{name}.usr")
        Path(f"{name}.lab").write_text(f"{name}\n")
    for number in range(8):
        given = ("-H", f"{number}/models" if number else "models", "-M", str(number + 1), "-m", 1)
        succeed(hri("htk", "erest", *given, "list", "a.usr", "b.usr"))
    made = ModelSet()
    made.read("8/models")
    assert Path("8/models").read_text().count('<TMIX> "mix"') == 2
    np.testing.assert_allclose(made.hmm("a").weights, [[0.75, 0.25, 0]], atol=0.06)
    np.testing.assert_allclose(made.hmm("b").weights, [[0, 0.5, 0.5]], atol=0.06)
    np.testing.assert_array_equal(made.hmm("a").means, made.hmm("b").means)
    np.testing.assert_allclose(made.hmm("a").means[:, 0], [0.5, 6.5, 12.5], atol=0.2)
