# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Discrete models from recordings to results: `hri htk quant`, codewords in files, training and recognition."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from conftest import RATE_HZ, tone_word
from hri.core.errors import FormatError, InvalidArgument
from hri.htk import Configuration, MasterLabelFile, ModelSet, ParameterFile, VqTable, load_observations
from hri.io import write_wav_pcm16
from htk_toys import succeed

TONES = {"rise": (500.0, 800.0), "fall": (900.0, -350.0), "flat": (1300.0, 0.0)}
CODING = "TARGETKIND = {}\nTARGETRATE = 100000\nWINDOWSIZE = 250000\nNUMCHANS = 26\n"
SIZE = 16
STATES = 4


def prototype() -> str:
    """Left to right, with every codeword as likely."""
    log = round(2371.8 * np.log(SIZE))
    states = "".join(f"<STATE> {n + 2} <NUMMIXES> {SIZE} <DPROB> {log}*{SIZE}\n" for n in range(STATES))
    steps = np.diag([0.0, *[0.6] * STATES, 0.0]) + np.diag([1.0, *[0.4] * STATES], 1)
    rows = "\n".join(" ".join(map(str, row)) for row in steps)
    size = STATES + 2
    return (
        f"~o <DISCRETE> <STREAMINFO> 1 1\n~h proto <BEGINHMM> <NUMSTATES> {size}\n{states}"
        f"<TRANSP> {size}\n{rows}\n<ENDHMM>\n"
    )


@pytest.fixture
def work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Recordings of three words, six of each, and their configurations."""
    monkeypatch.chdir(tmp_path)
    for take in range(6):
        for word, tone in TONES.items():
            write_wav_pcm16(tmp_path / f"{word}_{take}.wav", tone_word(*tone, take), RATE_HZ)
    names = [f"{word}_{take}" for word in TONES for take in range(6)]
    Path("wav").write_text("SOURCEFORMAT = WAV\n" + CODING.format("MFCC_0"))
    Path("copy.scp").write_text("".join(f"{name}.wav {name}.mfc\n" for name in names))
    Path("vq").write_text(CODING.format("MFCC_0_V") + "VQTABLE = codebook\n")
    Path("vq_copy").write_text(Path("vq").read_text() + "SAVEASVQ = T\n")
    Path("vq.scp").write_text("".join(f"{name}.mfc {name}.vq\n" for name in names))
    Path("train.scp").write_text("".join(f"{name}.mfc\n" for name in names if name[-1] in "0123"))
    Path("test.scp").write_text("".join(f"{name}.mfc\n" for name in names if name[-1] in "45"))
    Path("proto").write_text(prototype())
    Path("list").write_text("".join(f"{word}\n" for word in TONES))
    Path("dict").write_text("".join(f"{word} {word}\n" for word in TONES))
    Path("gram").write_text(f"( {' | '.join(TONES)} )\n")
    return tmp_path


def found_words(path: str) -> list[tuple[str, list[str]]]:
    return [(name, [label.name for label in one.labels]) for name, one in MasterLabelFile.read(path).entries]


@pytest.mark.parametrize("distance", [(), ("-d",)])
def test_words_are_recognised_by_codewords(hri, work: Path, distance: tuple[str, ...]):
    """The chain of docs/htk.md, with training on files of codewords and recognition of both kinds of files."""
    succeed(hri("htk", "copy", "-C", "wav", "-S", "copy.scp"))
    shown = succeed(hri("htk", "quant", *distance, "-T", 1, "-n", 1, SIZE, "-S", "train.scp", "codebook"))
    assert f"-> {SIZE} codewords" in shown
    table = VqTable.read("codebook")
    assert (table.num_codewords, table.dim, table.kind) == (SIZE, 13, "MFCC_0")
    succeed(hri("htk", "copy", "-C", "vq_copy", "-S", "vq.scp"))
    file = ParameterFile.read("rise_0.vq")
    assert file.kind == "DISCRETE_K"
    frames = ParameterFile.read("rise_0.mfc").values
    np.testing.assert_array_equal(file.values[:, 0], table.quantise(frames))

    for word in TONES:
        files = [f"{word}_{take}.vq" for take in range(4)]
        succeed(hri("htk", "init", "-w", 1, "-M", "hmm0", "-o", word, "proto", *files))
        succeed(hri("htk", "rest", "-w", 1, "-M", "hmm1", f"hmm0/{word}", *files))
    models = ModelSet()
    for word in TONES:
        models.read(f"hmm1/{word}")
    np.testing.assert_allclose(models.discrete("rise").sum(axis=1), 1, atol=2e-3)
    assert models.discrete("rise").min() >= 0.99e-5
    assert models.to_text().count("<DPROB>") == len(TONES) * STATES
    Path("models").write_text(models.to_text())

    succeed(hri("htk", "parse", "gram", "net"))
    common = ("-H", "models", "-w", "net", "-l", "*")
    succeed(hri("htk", "vite", *common, "-C", "vq", "-S", "test.scp", "-i", "a.mlf", "dict", "list"))
    files = [f"{word}_{take}.vq" for word in TONES for take in "45"]
    succeed(hri("htk", "vite", *common, "-i", "b.mlf", "dict", "list", *files))
    expected = [(f"*/{word}_{take}.rec", [word]) for word in TONES for take in "45"]
    assert found_words("a.mlf") == found_words("b.mlf") == expected

    labels = "".join(f'"*/{word}_{take}.lab"\n{word}\n.\n' for word in TONES for take in range(4))
    Path("words.mlf").write_text(f"#!MLF!#\n{labels}")
    train = ("-C", "vq", "-w", 1, "-I", "words.mlf", "-S", "train.scp", "list")
    first = succeed(hri("htk", "erest", "-H", "models", "-M", "hmm2", *train))
    again = succeed(hri("htk", "erest", "-H", "hmm2/models", "-M", "hmm3", *train))
    score = [float(out.split("average log prob per frame = ")[1].split()[0]) for out in (first, again)]
    assert score[1] >= score[0] - 1e-3


def test_files_and_frames_that_do_not_fit_are_refused_by_name(hri, work: Path):
    succeed(hri("htk", "copy", "-C", "wav", "-S", "copy.scp"))
    succeed(hri("htk", "quant", "-n", 1, SIZE, "-S", "train.scp", "codebook"))
    train = ("htk", "init", "-M", "hmm0", "-o", "rise", "proto")
    cases = {
        # Frames, and nothing says how they become codewords.
        ("rise_0.mfc",): "rise_0.mfc: its frames are MFCC_K_0, and the models take DISCRETE",
        ("-C", "none", "rise_0.mfc"): "rise_0.mfc: VQTABLE is not set",
        ("-C", "missing", "rise_0.mfc"): "nowhere",
        ("-C", "other", "rise_0.mfc"): "rise_0.mfc: its frames are MFCC_0, and the table other.vq is of FBANK",
        ("-C", "narrow", "rise_0.mfc"): "rise_0.mfc: frames of 13 columns, and the table narrow.vq is of 1",
        ("-C", "damaged", "rise_0.mfc"): "damaged.vq: line 2: 'x' is no number that can stand here",
        ("large.vq",): "large.vq: frame 1 has the codeword 17, and the models have 1 to 16",
    }
    Path("none").write_text(CODING.format("MFCC_0_V"))
    tables = {
        "other": "7 0 5 1 1 13\n1 1 1 0 0\n" + "0 " * 13,
        "narrow": "0 0 5 1 1 1\n1 1 1 0 0\n0",
        "damaged": "6\nx",
    }
    for name, text in tables.items():
        Path(f"{name}.vq").write_text(text)
        Path(name).write_text(CODING.format("MFCC_0_V") + f"VQTABLE = {name}.vq\n")
    Path("missing").write_text(CODING.format("MFCC_0_V") + "VQTABLE = nowhere\n")
    ParameterFile(np.array([[1], [17], [2], [3], [4]], np.float32), "DISCRETE").write("large.vq")
    for given, message in cases.items():
        refused = hri(*train, "-m", 1, *given)
        assert refused.code == 3, given
        assert message in refused.err, refused.err
        assert not Path("hmm0").exists()


def test_codewords_are_written_only_where_asked_for(hri, work: Path):
    succeed(hri("htk", "copy", "-C", "wav", "-S", "copy.scp"))
    succeed(hri("htk", "quant", "-n", 1, 4, "-S", "train.scp", "codebook"))
    refused = hri("htk", "copy", "-C", "vq", "rise_0.mfc", "a.vq")
    assert refused.code == 3 and "both _V in TARGETKIND and SAVEASVQ = T" in refused.err
    assert not Path("a.vq").exists()
    # What is codewords already stays so; WAV files become codewords in one step.
    succeed(hri("htk", "copy", "-C", "vq_copy", "rise_0.mfc", "a.vq"))
    succeed(hri("htk", "copy", "-C", "vq_copy", "a.vq", "b.vq"))
    succeed(hri("htk", "copy", "-C", "vq_copy", "-F", "WAV", "rise_0.wav", "c.vq"))
    assert Path("a.vq").read_bytes() == Path("b.vq").read_bytes() == Path("c.vq").read_bytes()
    configuration = Configuration()
    configuration.read("vq")
    assert (configuration.target, configuration.has_codewords, configuration.vq_table) == ("MFCC_0", True, "codebook")
    seen, period = load_observations("rise_0.mfc", "DISCRETE", configuration)
    assert seen.shape[1] == 1 and period == 100000
    # Models of Gaussians do not see codewords.
    assert load_observations("rise_0.mfc", "MFCC_0", configuration)[0].shape[1] == 13


def test_quant_takes_its_options(hri, work: Path):
    succeed(hri("htk", "copy", "-C", "wav", "-S", "copy.scp"))
    Path("labels").mkdir()
    Path("labels/rise_0.lab").write_text("0 1000000 begin\n1000000 2000000 end\n")
    succeed(hri("htk", "quant", "-L", "labels", "-l", "begin", "-n", 1, 2, "part", "rise_0.mfc"))
    frames = ParameterFile.read("rise_0.mfc").values
    whole = VqTable.read("part").quantise(frames[:10])
    assert set(whole) == {1, 2}
    nothing = hri("htk", "quant", "-L", "labels", "-l", "other", "none", "rise_0.mfc")
    assert nothing.code == 3 and "no recording has a label 'other'" in nothing.err
    for wrong in (("-n", 2, 4), ("-n", 1, 0), ("-n", 1, 5000), ("-n", 1), ("-t",), ("-s", 2), ("-f",)):
        assert hri("htk", "quant", *wrong, "none", "rise_0.mfc").code == 2, wrong
    assert not Path("none").exists()


def test_tables_of_arrays():
    table = VqTable([[0.0, 0.0], [4.0, 1.0]], "USER", [2.0, 0.5])
    assert VqTable.parse(table.to_text(), "again").to_text() == table.to_text()
    codewords = table.quantise(np.array([[1.0, 0.0], [9.0, 0.4]], np.float32))
    assert codewords.dtype == np.int32 and codewords.tolist() == [1, 2]
    with pytest.raises(InvalidArgument, match="another number of columns"):
        table.quantise(np.zeros((2, 3), np.float32))
    with pytest.raises(InvalidArgument, match="a deviation is not above 0"):
        VqTable([[0.0]], "USER", [0.0])
    with pytest.raises(FormatError, match="table: line 2: several streams are not read"):
        VqTable.parse("6 0 5 1 1 1\n2 1 1 0 0 0", "table")


def test_models_say_what_they_are():
    models = ModelSet()
    models.parse(prototype(), "proto")
    assert models.num_codewords == SIZE and models.vector_size == 1 and models.kind == "DISCRETE"
    assert models.discrete("proto").shape == (STATES, SIZE)
    with pytest.raises(InvalidArgument, match="a discrete model has no Gaussians"):
        models.hmm("proto")
    with pytest.raises(InvalidArgument, match="there is no model 'x'"):
        models.discrete("x")
