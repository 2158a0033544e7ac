# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""`hri htk vite --live`: utterances of a stream are cut, coded as files are, and recognised by HTK's models."""

from __future__ import annotations

import _thread
import json
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from conftest import RATE_HZ, WAIT_S, tone_word
from hri.core.errors import FormatError, InvalidArgument
from hri.htk import (
    Configuration,
    Label,
    MasterLabelFile,
    ModelSet,
    Transcription,
    VqTable,
    WordLattice,
    code_file,
    observe_samples,
    observed,
    train_model,
)
from hri.io import write_wav_pcm16
from hri.live import ArraySource, UtteranceFinder
from hri.media import read_audio
from hri.recognition import ConnectedWordStreamOptions
from hri.signal import resample
from htk_toys import succeed

KIND = "MFCC_0_D"
CONFIG = f"""TARGETKIND = {KIND}
TARGETRATE = 100000.0
WINDOWSIZE = 250000.0
NUMCHANS = 26
SOURCERATE = 625.0
SOURCEKIND = HAUDIO
SOURCEFORMAT = HTK
USESILDET = T
"""
OF_FILES = CONFIG.replace("SOURCEKIND = HAUDIO\n", "").replace("USESILDET = T\n", "")
SLOPES = {"rise": (500.0, 800.0), "fall": (500.0, -350.0), "high": (1200.0, 0.0)}
SENTENCES = (("rise", "fall"), ("high", "rise", "rise"))
VITE = ("htk", "vite", "--live", "-C", "config", "-H", "models", "-w", "net")
LISTS = ("dict", "list")


def silence(duration_s: float) -> np.ndarray:
    return (0.001 * np.random.default_rng(1).standard_normal(round(duration_s * RATE_HZ))).astype(np.float32)


def sentence(words: tuple[str, ...], seed: int) -> np.ndarray:
    return np.concatenate([tone_word(*SLOPES[word], seed + number) for number, word in enumerate(words)])


def write_models(path: Path, kind: str) -> None:
    """Models of three words and of silence."""
    configuration = Configuration(live=True)
    configuration.parse(CONFIG.replace(KIND, kind), "config")
    models = ModelSet(kind)
    pauses = []
    for word, slope in SLOPES.items():
        clips = [observe_samples(tone_word(*slope, take), RATE_HZ, kind, configuration)[0] for take in range(4)]
        train_model(models, word, [clip[25:-25] for clip in clips], num_states=6, variance_floor=0.1)
        pauses += [clip[:20] for clip in clips]
    train_model(models, "sil", pauses, num_states=1, variance_floor=0.1)
    models.write(path)


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Models, a network of sentences, recordings of two of these, and a stream of both."""
    folder = tmp_path_factory.mktemp("live")
    write_models(folder / "models", KIND)
    (folder / "config").write_text(CONFIG)
    (folder / "dict").write_text("rise [RISE] rise\nfall [FALL] fall\nhigh [HIGH] high\nsil [] sil\n")
    (folder / "list").write_text("rise\nfall\nhigh\nsil\n")
    WordLattice.of_grammar("$word = rise | fall | high; ( sil < $word sil > )", "grammar").write(folder / "net")
    parts = [silence(1.0)]
    for number, words in enumerate(SENTENCES):
        clip = sentence(words, 20 + number)
        write_wav_pcm16(folder / f"said{number}.wav", clip, RATE_HZ)
        parts += [clip, silence(1.5)]
    write_wav_pcm16(folder / "stream.wav", np.concatenate(parts), RATE_HZ)
    return folder


@pytest.fixture
def live(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with these files, in which the test runs."""
    for path in made.iterdir():
        (tmp_path / path.name).write_bytes(path.read_bytes())
    monkeypatch.chdir(tmp_path)
    return tmp_path


def words_of(out: str) -> list[list[str]]:
    return [line.split("  ==  ")[0].split(" s  ")[1].split() for line in out.splitlines() if "==" in line]


def test_a_stream_gives_the_words_of_its_files(hri, live: Path):
    said = [[word.upper() for word in words] for words in SENTENCES]
    ran = hri(*VITE, *LISTS, "stream.wav")
    assert words_of(succeed(ran)) == said
    assert len(ran.out.splitlines()) == 2 and "listening to stream.wav at 16000 Hz" in ran.err
    Path("files").write_text(OF_FILES)
    files = hri("htk", "vite", "-C", "files", "-F", "WAV", *VITE[5:], "-i", "f.mlf", *LISTS, "said0.wav", "said1.wav")
    succeed(files)
    assert [[one.name for one in entry.labels] for _, entry in MasterLabelFile.read("f.mlf").entries] == said


@pytest.mark.parametrize("kind", [KIND, "MFCC_E_D_Z", "FBANK_D_A", "LPCEPSTRA_E"])
def test_an_utterance_is_coded_as_a_file_of_it(hri, live: Path, kind: str):
    """The same labels and scores, later by when its samples begin."""
    Path("config").write_text(CONFIG.replace(KIND, kind) + "RECOUTPREFIX = 's'\nRECOUTSUFFIX = 'x'\n")
    Path("files").write_text(OF_FILES.replace(KIND, kind))
    write_models(Path("models"), kind)
    succeed(hri(*VITE, "-e", "-l", "out", "-m", *LISTS, "stream.wav", "said0.wav"))
    assert sorted(path.name for path in Path("out").iterdir()) == ["s0001x.rec", "s0002x.rec", "s0003x.rec"]
    stream = read_audio("stream.wav")
    finder = UtteranceFinder(ConnectedWordStreamOptions().endpointer)
    found = [(event, cut) for event, cut in finder.process(ArraySource(stream.samples, RATE_HZ)) if cut is not None]
    assert len(found) == 2
    for number, (event, cut) in enumerate(found, 1):
        begin = round((event.time - len(cut) / RATE_HZ) * 1e7)
        assert np.array_equal(cut, stream.samples[round(begin * RATE_HZ / 1e7) :][: len(cut)])
        write_wav_pcm16("cut.wav", cut, RATE_HZ)
        succeed(hri("htk", "vite", "-C", "files", "-F", "WAV", *VITE[5:], "-m", *LISTS, "cut.wav"))
        later = [
            Label(one.name, one.first + begin, one.last + begin, one.score, one.others)
            for one in Transcription.read("cut.rec").labels
        ]
        assert Transcription(later).to_text() == Transcription.read(f"out/s{number:04}x.rec").to_text()


def test_frames_become_codewords_for_discrete_models(hri, live: Path):
    configuration = Configuration(live=True)
    configuration.parse(CONFIG, "config")
    frames = observe_samples(tone_word(*SLOPES["high"], 1), RATE_HZ, KIND, configuration)[0]
    VqTable([frames[:20].mean(axis=0), frames[40:60].mean(axis=0)], KIND).write("codebook")
    Path("config").write_text(CONFIG.replace(KIND, f"{KIND}_V") + "VQTABLE = codebook\n")
    steps = "<TRANSP> 3\n0 1 0\n0 .9 .1\n0 0 0\n<ENDHMM>\n"
    text = "~o <DISCRETE> <STREAMINFO> 1 1\n"
    for name, logs in (("sil", "50 9000"), ("high", "9000 50")):
        text += f'~h "{name}" <BEGINHMM> <NUMSTATES> 3 <STATE> 2 <NUMMIXES> 2 <DPROB> {logs}\n{steps}'
    Path("models").write_text(text)
    WordLattice.of_grammar("( sil < high sil > )", "grammar").write("net")
    # A tone of one pitch has none of a voice: the end pointer takes one that glides with it.
    write_wav_pcm16("high.wav", sentence(("high", "rise"), 5), RATE_HZ)
    assert words_of(succeed(hri(*VITE, *LISTS, "high.wav")))[0][0] == "HIGH"
    VqTable(np.stack([frames[0], frames[50], frames[55]]), KIND).write("codebook")
    refused = hri(*VITE, *LISTS, "high.wav")
    assert (
        refused.code == 3
        and "s on: frame " in refused.err
        and "has the codeword 3, and the models have 1 to 2" in (refused.err)
    )


def test_lines_of_json_say_words_times_and_how_long_it_took(hri, live: Path):
    out = succeed(hri(*VITE, "--json-lines", "-n", 2, 3, "-z", "lat", "-i", "found.mlf", *LISTS, "stream.wav"))
    events = [json.loads(line) for line in out.splitlines()]
    assert [event["event"] for event in events if event["event"] not in ("level", "sentence")] == [
        "listening",
        *(["speech_start", "speech_end"] * 2),
        "ended",
        "summary",
    ]
    found = [event for event in events if event["event"] == "sentence"]
    assert [event["words"] for event in found] == [[word.upper() for word in words] for words in SENTENCES]
    first = found[0]
    assert [label["name"] for label in first["labels"]] == first["words"] and len(first["alternatives"]) == 2
    # 1.25 s of silence, then a tone of half a second.
    assert first["labels"][0]["first_s"] == pytest.approx(1.25, abs=0.06)
    assert first["labels"][0]["last_s"] == pytest.approx(1.75, abs=0.06)
    assert first["wait_ms"] == pytest.approx(700, abs=100) and first["compute_ms"] > 0
    assert events[-1]["num_utterances"] == 2
    for name in ("wait_ms", "compute_ms"):
        assert events[-1][f"mean_{name}"] == pytest.approx(np.mean([event[name] for event in found]), abs=0.01)
    entries = MasterLabelFile.read("found.mlf").entries
    assert [path for path, _ in entries] == ["0001.rec", "0002.rec"]
    assert entries[1][1].labels[0].first == round(found[1]["labels"][0]["first_s"] * 1e7)
    lattice = WordLattice.read("0002.lat")
    assert min(lattice.times_s) == pytest.approx(entries[1][1].labels[0].first / 1e7, abs=1.0)


def test_sound_of_another_rate_is_resampled_as_it_is_said(hri, live: Path):
    stream = read_audio("stream.wav").samples
    for rate_hz, text in (
        (44100, "stream.wav: resampled from 44100 to 16000 Hz, as SOURCERATE says\n"),
        (8000, "stream.wav: resampled from 8000 to 16000 Hz, as SOURCERATE says, with nothing above 4000 Hz\n"),
    ):
        write_wav_pcm16("stream.wav", np.clip(np.asarray(resample(stream, RATE_HZ, rate_hz)), -1, 1), rate_hz)
        ran = hri(*VITE, *LISTS, "stream.wav")
        assert ran.code == 0 and text in ran.err
    assert words_of(ran.out) and len(words_of(ran.out)) == 2
    write_wav_pcm16("stream.wav", np.asarray(resample(stream, RATE_HZ, 44100)), 44100)
    assert words_of(succeed(hri(*VITE, *LISTS, "stream.wav"))) == [[w.upper() for w in words] for words in SENTENCES]
    Path("config").write_text(CONFIG.replace("SOURCERATE = 625.0\n", ""))
    own = hri(*VITE, *LISTS, "stream.wav")
    assert own.code == 0 and "resampled" not in own.err


def test_utterances_end_after_as_much_silence_as_is_said(hri, live: Path):
    """SILSEQCOUNT: two seconds of silence lie between the sentences, half a second between words."""
    for frames, counts in ((30, [1] * 5), (250, [5])):
        Path("config").write_text(CONFIG + f"SILSEQCOUNT = {frames}\n")
        lines = succeed(hri(*VITE, "--json-lines", *LISTS, "stream.wav")).splitlines()
        found = [event for event in map(json.loads, lines) if event["event"] == "sentence"]
        # The tone that does not glide is no speech by itself.
        assert [len(event["words"]) for event in found] in (counts, counts[1:])
        assert all(event["wait_ms"] == pytest.approx(10 * frames, abs=100) for event in found[:-1])


def test_labels_and_means_are_printed_with_trace(hri, live: Path):
    Path("net").write_text("N=3 L=2\nI=0\nI=1 W=rise\nI=2\nJ=0 S=0 E=1\nJ=1 S=1 E=2\n")
    lines = succeed(hri(*VITE, "-T", 1, "-o", "S", *LISTS, "said0.wav", "said1.wav")).splitlines()
    assert words_of("\n".join(lines)) == [["RISE"]] * 2
    assert lines[1].split()[2] == "RISE" and len(lines[1].split()) == 3
    assert lines[-1].startswith("2 utterances; on average their end was found after ")
    write_wav_pcm16("quiet.wav", silence(2.0), RATE_HZ)
    assert succeed(hri(*VITE, "-T", 1, *LISTS, "quiet.wav")) == "no utterance\n"
    # A chain of more states than there are frames: nothing fits.
    chain = " ".join(["rise"] * 60)
    WordLattice.of_words(chain.split()).write("net")
    assert "no sentence of the network ends with the utterance" in succeed(hri(*VITE, *LISTS, "said0.wav"))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ((f"TARGETKIND = {KIND}\n", ""), "TARGETKIND is not set in any configuration file (-C): it says what sound "
         "becomes, which is MFCC_D_0 for these models"),
        (("TARGETRATE = 100000.0\n", ""), "TARGETRATE is not set in any configuration file (-C)"),
        ((KIND, "PLP_0_D"), "sound of 16000 Hz cannot become PLP_D_0, as TARGETKIND says: parameters of kind PLP"),
        ((KIND, "USER"), "sound of 16000 Hz cannot become USER"),
        ((KIND, "WAVEFORM"), "sound of 16000 Hz cannot become WAVEFORM"),
        ((KIND, "LPC_D"), "live sound: its frames are LPC_D, and the models take MFCC_D_0"),
        (("NUMCHANS", "NUMCEPS = 10\nNUMCHANS"), "live sound: 22 columns as MFCC_D_0, and the models take"),
        (("SOURCERATE = 625.0", "SOURCERATE = 16000"), "config: line 5: SOURCERATE = 16000 is no sample period"),
        (("USESILDET = T", "USESILDET = F"), "config: line 8: USESILDET = F: live sound is cut at silence"),
        (("USESILDET = T", "SILSEQCOUNT = 2"), "SILSEQCOUNT = 2, frames of silence: Endpointer"),
    ],
)  # fmt: skip
def test_configurations_that_do_not_fit_are_refused(hri, live: Path, change: tuple[str, str], message: str):
    assert change[0] in CONFIG
    Path("config").write_text(CONFIG.replace(*change))
    Path("old.mlf").write_text("kept")
    refused = hri(*VITE, "-i", "old.mlf", *LISTS, "stream.wav")
    assert refused.code == 3 and message in refused.err, refused.err
    assert refused.out == "" and Path("old.mlf").read_text() == "kept"


def test_options_without_an_effect_are_refused(hri, live: Path):
    for given, message in (
        (("-F", "WAV", *LISTS), "-F is of recordings that are read"),
        (("--paced", *LISTS), "--paced is of recordings: name FILES"),
        (("--device", "1", *LISTS, "stream.wav"), "--device is of a microphone"),
        (("-l", "out", *LISTS, "stream.wav"), "-l is of files, which with --live -e, -i and -z write"),
        (("-m", *LISTS, "stream.wav"), "-m is of labels"),
        (("-a", *LISTS, "stream.wav"), "--live takes -w SLF"),
    ):
        refused = hri(*VITE, *given)
        assert refused.code == 2 and message in refused.err, refused.err
    for option in ("-e", "--paced", "--json-lines"):
        refused = hri("htk", "vite", option, "-H", "models", "-w", "net", *LISTS, "said0.wav")
        assert refused.code == 2 and f"{option} goes with --live" in refused.err
    none = hri("htk", "vite", "-H", "models", "-w", "net", *LISTS)
    assert none.code == 2 and "name recordings, or add --live for the microphone" in none.err
    plain = hri("htk", "vite", "-C", "config", "-H", "models", "-w", "net", *LISTS, "said0.wav")
    assert plain.code == 3 and "config: line 6: SOURCEKIND = HAUDIO is of live sound" in plain.err
    Path("noise.wav").write_bytes(b"RIFF\0\0")
    assert hri(*VITE, *LISTS, "noise.wav").code == 3


class Played:
    """A stream of PortAudio that gives these samples, and then is Ctrl-C."""

    def __init__(self, samples: np.ndarray, settings: dict[str, Any]) -> None:
        self.samples, self.settings = samples, settings
        self.stopped = threading.Event()
        self.thread = threading.Thread(target=self._run, daemon=True)

    def _run(self) -> None:
        count = self.settings["blocksize"]
        for at in range(0, len(self.samples) - count, count):
            if self.stopped.is_set():
                return
            self.settings["callback"](self.samples[at : at + count, np.newaxis], count, None, None)
            time.sleep(0.0005)
        time.sleep(0.2)
        while not self.stopped.is_set():
            self.settings["callback"](np.zeros((count, 1), "f4"), count, None, None)
            time.sleep(0.02)

    def start(self) -> None:
        self.thread.start()

    def abort(self) -> None:
        self.stopped.set()

    def close(self) -> None:
        self.stopped.set()


def fake_sounddevice(samples: np.ndarray, rate_hz: int) -> SimpleNamespace:
    def query_devices(device: Any = None, kind: str | None = None) -> Any:
        if device not in (None, 0):
            raise RuntimeError("Error querying device -1")
        return {"name": "microphone", "max_input_channels": 1, "default_samplerate": float(rate_hz)}

    return SimpleNamespace(
        PortAudioError=RuntimeError,
        query_devices=query_devices,
        InputStream=lambda **settings: Played(samples, settings),
    )


def test_the_microphone_is_recognised_until_ctrl_c(hri, live: Path, monkeypatch: pytest.MonkeyPatch):
    """Labels so far are written then, and the mean times printed."""
    from hri.cli.htk.live import LiveRecognition

    played = np.asarray(resample(read_audio("stream.wav").samples, RATE_HZ, 48000))
    monkeypatch.setitem(sys.modules, "sounddevice", fake_sounddevice(played, 48000))
    recognise, seen = LiveRecognition._recognise, []

    def then_interrupt(self: LiveRecognition, *given: Any) -> Any:
        seen.append(recognise(self, *given))
        if len(seen) == len(SENTENCES):
            threading.Timer(0.3, _thread.interrupt_main).start()
        return seen[-1]

    monkeypatch.setattr(LiveRecognition, "_recognise", then_interrupt)
    begun = time.monotonic()
    ran = hri(*VITE, "-T", 1, "-i", "found.mlf", *LISTS)
    assert time.monotonic() - begun < WAIT_S
    assert ran.code == 130 and "listening to microphone at 48000 Hz; Ctrl-C ends" in ran.err
    assert "microphone: resampled from 48000 to 16000 Hz, as SOURCERATE says" in ran.err
    said = [[word.upper() for word in words] for words in SENTENCES]
    assert words_of(ran.out) == said and ran.out.splitlines()[-1].startswith("2 utterances; ")
    assert [[one.name for one in entry.labels] for _, entry in MasterLabelFile.read("found.mlf").entries] == said


def test_microphones_that_cannot_be_used_say_what_to_do(hri, live: Path, monkeypatch: pytest.MonkeyPatch):
    Path("unknown").write_text(CONFIG.replace("SOURCERATE = 625.0\n", ""))
    refused = hri(*VITE[:4], "unknown", *VITE[5:], *LISTS)
    assert refused.code == 3 and "SOURCERATE = 625 is 16000 Hz" in refused.err
    monkeypatch.setitem(sys.modules, "sounddevice", fake_sounddevice(silence(1), RATE_HZ))
    refused = hri(*VITE, "--device", 7, *LISTS)
    assert refused.code == 3 and "no microphone can be opened" in refused.err
    monkeypatch.setitem(sys.modules, "sounddevice", None)
    refused = hri(*VITE, *LISTS)
    assert refused.code == 3 and "libhri[live]" in refused.err


def test_samples_are_observed_as_a_file_of_them(made: Path):
    configuration = Configuration()
    configuration.parse("TARGETKIND = MFCC_E_D\nTARGETRATE = 100000\nSOURCEFORMAT = WAV\n", "config")
    file = code_file(made / "said0.wav", configuration)
    frames, period = observe_samples(read_audio(made / "said0.wav").samples, RATE_HZ, "MFCC_E_D_N", configuration)
    assert period == 100000 and np.array_equal(frames, observed(file, "MFCC_E_D_N", configuration, "said0.wav"))
    with pytest.raises(InvalidArgument):
        observe_samples(np.zeros(10, np.float32), RATE_HZ, "MFCC_E_D", configuration)
    unset = Configuration()
    unset.parse("TARGETKIND = MFCC_E_D", "config")
    with pytest.raises(FormatError, match="samples: TARGETRATE is not set"):
        observe_samples(np.zeros(16000, np.float32), RATE_HZ, "MFCC_E_D", unset)
