# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Chains of HTK's commands with the options of the HTK Book's tutorial, on synthetic words; no option left out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from conftest import RATE_HZ, CommandResult, tone_word
from hri.htk import MasterLabelFile, ModelSet, read_list
from hri.io import write_wav_pcm16

CODING = """TARGETKIND = MFCC_0_D_A
TARGETRATE = 100000.0
SAVECOMPRESSED = T
SAVEWITHCRC = T
WINDOWSIZE = 250000.0
USEHAMMING = T
PREEMCOEF = 0.97
NUMCHANS = 26
CEPLIFTER = 22
NUMCEPS = 12
ENORMALISE = F
"""
UNITS = {"hi": (1200.0, 0.0), "lo": (450.0, 0.0), "up": (600.0, 900.0)}
WORDS = {"RISE": ["up"], "CALL": ["hi", "lo"], "BACK": ["lo", "hi"]}
PHONES = [*UNITS, "sil"]
DIM = 39


def succeed(result: CommandResult) -> str:
    assert result.code == 0, result.err
    return result.out


def state_text(number: int) -> str:
    return f"<State> {number}\n<Mean> {DIM}\n{' 0.0' * DIM}\n<Variance> {DIM}\n{' 1.0' * DIM}\n"


def prototype() -> str:
    steps = ["0 1 0 0 0", "0 0.6 0.4 0 0", "0 0 0.6 0.4 0", "0 0 0 0.7 0.3", "0 0 0 0 0"]
    return (
        f'~o <VecSize> {DIM} <MFCC_0_D_A>\n~h "proto"\n<BeginHMM>\n<NumStates> 5\n'
        + "".join(map(state_text, (2, 3, 4)))
        + "<TransP> 5\n"
        + "\n".join(steps)
        + "\n<EndHMM>\n"
    )


@pytest.fixture
def work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Recordings of sentences of words that are made of units, and a folder to work in."""
    monkeypatch.chdir(tmp_path)
    rng = np.random.default_rng(5)
    said = []
    for number in range(10):
        words = [list(WORDS)[i] for i in rng.integers(0, len(WORDS), 2 + number % 2)]
        clips = [tone_word(*UNITS[unit], 10 * number + at) for at, w in enumerate(words) for unit in WORDS[w]]
        quiet = rng.normal(scale=1e-3, size=RATE_HZ // 4)
        samples = np.concatenate([quiet, *[clip[2000:-2000] for clip in clips], quiet])
        write_wav_pcm16(tmp_path / f"S{number}.wav", samples, RATE_HZ)
        said.append(words)
    Path("config0").write_text(f"SOURCEFORMAT = WAV\n{CODING}")
    Path("config").write_text(CODING)
    Path("codetr.scp").write_text("".join(f"S{n}.wav train/S{n}.mfc\n" for n in range(10)))
    Path("train.scp").write_text("".join(f"train/S{n}.mfc\n" for n in range(10)))
    words = "".join(f'"*/S{n}.lab"\n' + "".join(f"{w}\n" for w in s) + ".\n" for n, s in enumerate(said))
    Path("words.mlf").write_text(f"#!MLF!#\n{words}")
    phones = ""
    for number, sentence in enumerate(said):
        units = "".join(f"{unit}\n" for word in sentence for unit in WORDS[word])
        phones += f'"*/S{number}.lab"\nsil\n{units}sil\n.\n'
    Path("phones0.mlf").write_text(f"#!MLF!#\n{phones}")
    Path("monophones0").write_text("".join(f"{phone}\n" for phone in PHONES))
    Path("monophones1").write_text("".join(f"{phone}\n" for phone in [*PHONES, "sp"]))
    Path("proto").write_text(prototype())
    return tmp_path


def test_the_tutorial_of_the_book_runs_as_written(hri, work: Path):
    """Steps 1 to 11 of chapter 3: from a grammar to scores of a recogniser of units in context."""
    Path("gram").write_text("$word = RISE | CALL | BACK;\n( SENT-START < $word > SENT-END )\n".replace("\n(", "\n\n("))
    succeed(hri("htk", "parse", "gram", "wdnet"))
    dictionary = "".join(f"{word:<12} {' '.join(units)} sp\n" for word, units in sorted(WORDS.items()))
    Path("dict").write_text(f"{dictionary}SENT-END     [] sil\nSENT-START   [] sil\nsilence sil\n")
    drawn = succeed(hri("htk", "sgen", "-l", "-n", 200, "wdnet", "dict")).splitlines()
    assert len(drawn) == 200 and drawn[0].startswith("1. SENT-START ") and drawn[-1].startswith("200. ")

    succeed(hri("htk", "copy", "-T", 1, "-C", "config0", "-S", "codetr.scp"))
    succeed(hri("htk", "compv", "-C", "config", "-f", 0.01, "-m", "-S", "train.scp", "-M", "hmm0", "proto"))
    header, body = Path("hmm0/proto").read_text().split('~h "proto"\n')
    Path("hmm0/macros").write_text(header + Path("hmm0/vFloors").read_text())
    Path("hmm0/hmmdefs").write_text("".join(f'~h "{phone}"\n{body}' for phone in PHONES))
    common = ("-C", "config", "-t", 250.0, 150.0, 1000.0, "-S", "train.scp")

    def train(number: int, labels: str, phones: str) -> None:
        macros = ("-H", f"hmm{number}/macros", "-H", f"hmm{number}/hmmdefs", "-M", f"hmm{number + 1}")
        succeed(hri("htk", "erest", "-I", labels, *common, *macros, phones))

    for number in range(3):
        train(number, "phones0.mlf", "monophones0")
    # sp: the middle state of sil.
    Path("hmm4").mkdir()
    Path("hmm4/macros").write_text(Path("hmm3/macros").read_text())
    definitions = Path("hmm3/hmmdefs").read_text()
    middle = definitions[definitions.index('~h "sil"') :].split("<STATE> 3\n")[1].split("<STATE> 4")[0]
    sp = f'~h "sp"\n<BEGINHMM>\n<NUMSTATES> 3\n<STATE> 2\n{middle}<TRANSP> 3\n0 1 0\n0 0.9 0.1\n0 0 0\n<ENDHMM>\n'
    Path("hmm4/hmmdefs").write_text(definitions + sp)
    Path("sil.hed").write_text(
        "AT 2 4 0.2 {sil.transP}\nAT 4 2 0.2 {sil.transP}\nAT 1 3 0.3 {sp.transP}\n"
        "TI silst {sil.state[3],sp.state[2]}\n"
    )
    macros4 = ("-H", "hmm4/macros", "-H", "hmm4/hmmdefs")
    succeed(hri("htk", "hed", *macros4, "-M", "hmm5", "sil.hed", "monophones1"))
    assert Path("hmm5/hmmdefs").read_text().count('~s "silst"') == 3
    tied = ModelSet()
    tied.read("hmm5/macros")
    tied.read("hmm5/hmmdefs")
    assert tied.transitions("sp")[0, 2] == pytest.approx(0.3)

    Path("phones1.mlf").write_text(Path("phones0.mlf").read_text().replace("up\n", "up\nsp\n"))
    train(5, "phones1.mlf", "monophones1")
    train(6, "phones1.mlf", "monophones1")
    align = ("-l", "*", "-o", "SWT", "-b", "silence", "-C", "config", "-a", "-H", "hmm7/macros", "-H", "hmm7/hmmdefs")
    more = ("-i", "aligned.mlf", "-m", "-t", 250.0, "-y", "lab", "-I", "words.mlf", "-S", "train.scp")
    succeed(hri("htk", "vite", *align, *more, "dict", "monophones1"))
    aligned = MasterLabelFile.read("aligned.mlf").entries
    assert aligned[0][0] == "*/S0.lab" and len(aligned) == 10
    for _, transcription in aligned:
        names = [label.name for label in transcription.labels]
        assert names[0] == names[-1] == "sil" and "sp" in names
        assert all(label.first is None and label.score is None and not label.others for label in transcription.labels)
    train(7, "aligned.mlf", "monophones1")
    train(8, "aligned.mlf", "monophones1")

    recognise = ("-H", "hmm9/macros", "-H", "hmm9/hmmdefs", "-S", "train.scp", "-C", "config", "-l", "*")
    more = ("-i", "recout.mlf", "-w", "wdnet", "-p", 0.0, "-s", 5.0)
    succeed(hri("htk", "vite", *recognise, *more, "dict", "monophones1"))
    Path("wordlist").write_text("\n".join(WORDS) + "\n")
    out = succeed(hri("htk", "results", "-e", "???", "SENT-START", "-I", "words.mlf", "wordlist", "recout.mlf"))
    assert "WORD: %Corr=100.00, Acc=100.00" in out

    # Step 9: models of units in context, which share transitions.
    triphones = ["hi+lo", "hi-lo", "lo+hi", "lo-hi", "up", "sil", "sp"]
    Path("triphones1").write_text("\n".join(triphones) + "\n")
    ties = "".join(f"TI T_{unit} {{(*-{unit}+*,{unit}+*,*-{unit}).transP}}\n" for unit in ("hi", "lo"))
    Path("mktri.hed").write_text(f"CL triphones1\n{ties}")
    macros9 = ("-H", "hmm9/macros", "-H", "hmm9/hmmdefs")
    succeed(hri("htk", "hed", *macros9, "-M", "hmm10", "mktri.hed", "monophones1"))
    made = ModelSet()
    made.read("hmm10/macros")
    made.read("hmm10/hmmdefs")
    assert made.hmm_names == triphones
    assert Path("hmm10/hmmdefs").read_text().count('~t "T_hi"') == 3
    words = {"CALL": "hi+lo\nhi-lo\n", "BACK": "lo+hi\nlo-hi\n", "RISE": "up\nsp\n"}
    text = Path("words.mlf").read_text()
    for word, units in words.items():
        text = text.replace(f"{word}\n", units)
    Path("wintri.mlf").write_text(text.replace('.lab"\n', '.lab"\nsil\n').replace("\n.\n", "\nsil\n.\n"))
    macros = ("-H", "hmm10/macros", "-H", "hmm10/hmmdefs", "-M", "hmm11", "-s", "stats")
    succeed(hri("htk", "erest", "-I", "wintri.mlf", *common, *macros, "triphones1"))
    assert len(Path("stats").read_text().splitlines()) == len(triphones)

    # Step 10: states that are alike are tied by questions, and units of words never said follow them.
    states = "".join(
        f'TB 0.1 "{unit}_s{n}_" {{({unit},*-{unit},{unit}+*,*-{unit}+*).state[{n}]}}\n'
        for unit in ("hi", "lo", "up")
        for n in (2, 3, 4)
    )
    unseen = ["up-hi+lo", "lo-up", "hi-lo+hi"]
    Path("fulllist").write_text("\n".join([*triphones, *unseen]) + "\n")
    Path("tree.hed").write_text(
        'RO 1.0 stats\nTR 0\nQS "L_hi" { hi-* }\nQS "L_lo" { lo-* }\nQS "R_lo" { *+lo }\nQS "R_hi" { *+hi }\n'
        f'TR 2\n{states}TR 1\nAU "fulllist"\nCO "tiedlist"\nST "trees"\n'
    )
    macros = ("-H", "hmm11/macros", "-H", "hmm11/hmmdefs")
    succeed(hri("htk", "hed", *macros, "-M", "hmm12", "tree.hed", "triphones1"))
    tied = ModelSet()
    tied.read("hmm12/macros")
    tied.read("hmm12/hmmdefs")
    physical = read_list("tiedlist")
    assert set(physical) == {*triphones, *unseen} and set(physical.values()) == set(tied.hmm_names)
    states_of_hi = {name for kind, name in tied.definitions if kind == "s" and name.startswith("hi_s2_")}
    assert states_of_hi == {"hi_s2_1", "hi_s2_2"}
    assert Path("trees").read_text().startswith("QS 'L_hi' { \"hi-*\" }\n")
    for number in (12, 13):
        macros = ("-H", f"hmm{number}/macros", "-H", f"hmm{number}/hmmdefs", "-M", f"hmm{number + 1}")
        succeed(hri("htk", "erest", "-I", "wintri.mlf", *common, *macros, "tiedlist"))

    # Step 11 with the new units, one of which is of a word that training never had.
    words = {"CALL": "hi+lo hi-lo sp", "BACK": "lo+hi lo-hi sp", "RISE": "up sp", "NEVER": "lo-up up-hi+lo hi-lo+hi sp"}
    marks = "SENT-END [] sil\nSENT-START [] sil\n"
    Path("dict3").write_text("".join(f"{word} {units}\n" for word, units in words.items()) + marks)
    Path("gram3").write_text(f"$word = {' | '.join(words)};\n( SENT-START < $word > SENT-END )\n")
    succeed(hri("htk", "parse", "gram3", "wdnet3"))
    recognise = ("-H", "hmm14/macros", "-H", "hmm14/hmmdefs", "-S", "train.scp", "-C", "config", "-l", "*")
    succeed(hri("htk", "vite", *recognise, "-i", "rec3.mlf", "-w", "wdnet3", "-s", 5.0, "dict3", "tiedlist"))
    out = succeed(hri("htk", "results", "-e", "???", "SENT-START", "-I", "words.mlf", "wordlist", "rec3.mlf"))
    assert "WORD: %Corr=100.00, Acc=100.00" in out


def test_whole_words_as_in_the_thesis(hri, work: Path):
    """HCopy, HCompV, HInit, HRest, HParse, HSGen, HVite and HResults, one model a word, floors among them."""
    for word, units in WORDS.items():
        for take in range(4):
            clips = [tone_word(*UNITS[unit], 50 + 10 * take + at) for at, unit in enumerate(units)]
            write_wav_pcm16(work / f"{word}_{take}.wav", np.concatenate(clips), RATE_HZ)
    names = [f"{word}_{take}" for word in WORDS for take in range(4)]
    Path("targetlist.txt").write_text("".join(f"{name}.wav {name}.mfc\n" for name in names))
    Path("trainlist.txt").write_text("".join(f"{name}.mfc\n" for name in names))
    succeed(hri("htk", "copy", "-A", "-D", "-C", "config0", "-S", "targetlist.txt"))
    flags = ("-A", "-D", "-T", 1)
    succeed(hri("htk", "compv", *flags, "-f", 0.01, "-S", "trainlist.txt", "-M", "hmm0flat", "-H", "proto", "proto"))
    for word in WORDS:
        files = [f"{word}_{take}.mfc" for take in range(4)]
        succeed(hri("htk", "init", *flags, "-M", "hmm0", "-H", "hmm0flat/vFloors", "-o", word, "proto", *files))
        shown = succeed(hri("htk", "rest", *flags, "-M", "hmm1", "-H", "hmm0flat/vFloors", f"hmm0/{word}", *files))
        assert shown.startswith("hri htk rest -A -D -T 1 -M hmm1") and "pass 1: " in shown
    Path("gram.txt").write_text("( RISE | CALL | BACK )\n")
    Path("dict.txt").write_text("".join(f"{word} {word}\n" for word in WORDS))
    Path("hmmlist.txt").write_text("".join(f"{word}\n" for word in WORDS))
    definitions = "".join(Path("hmm1", word).read_text() for word in WORDS)
    Path("hmmsdef.mmf").write_text(definitions)
    succeed(hri("htk", "parse", "-A", "-D", "-T", 1, "gram.txt", "net.slf"))
    vite = ("-A", "-D", "-T", 1, "-H", "hmmsdef.mmf", "-i", "rec.mlf", "-w", "net.slf", "dict.txt", "hmmlist.txt")
    out = succeed(hri("htk", "vite", *vite, "-S", "trainlist.txt"))
    assert "File: RISE_0.mfc\nRISE  ==  [" in out
    labels = "".join(f'"*/{name}.lab"\n{name.split("_")[0]}\n.\n' for name in names)
    Path("ref.mlf").write_text(f"#!MLF!#\n{labels}")
    scored = succeed(
        hri("htk", "results", "-A", "-D", "-T", 1, "-e", "???", "sil", "-I", "ref.mlf", "hmmlist.txt", "rec.mlf")
    )
    assert "SENT: %Correct=100.00 [H=12, S=0, N=12]" in scored
