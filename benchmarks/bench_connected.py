# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Connected words: whole recordings to words, against PocketSphinx, real time, and PTBHMM against HMM."""

from __future__ import annotations

import os
import statistics
import tempfile
import time
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Literal

import numpy as np
from pocketsphinx import Config, Decoder

import timing
from hri import ConnectedWordRecognizer, read_audio
from hri.datasets import Dataset
from hri.language import Grammar, count_word_errors
from hri.signal import resample
from hri.synthetic.speech import make_speaker, make_speech_corpus, speak
from timing import Bench, Timed, medians

DIGITS = ["zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"]
_COMMANDS = """
stop start left right up down forward backward hello goodbye kitchen window table bottle robot follow carry open close
home red green blue yellow black white door chair lamp radio water coffee sugar butter apple orange lemon potato tomato
garden street river mountain island forest village city bridge station airport doctor teacher student mother father
sister brother baby morning evening monday tuesday friday sunday january april august october winter summer music
picture paper pencil letter number answer question minute hour engine machine camera battery button signal pocket finger
shoulder elbow
"""
SPEAKERS = 4
NEW_SPEAKERS = (4, 5, 6)
STRINGS = 10
LENGTH = 5
TAKES = 15
"""Of every digit by every speaker, of recordings."""
RATE_HZ = 16000
"""That of PocketSphinx's model."""
BUDGET = 0.02
FrontEndKind = Literal["cepstra", "both"]
Part = tuple[ConnectedWordRecognizer, list[np.ndarray], list[list[str]]]
"""A model, strings that it was not trained on, and their words."""
JSGF = f"#JSGF V1.0;\ngrammar digits;\npublic <digits> = ( {' | '.join(DIGITS)} )+;\n"


def _trained(vocabulary: list[str], **options: object) -> ConnectedWordRecognizer:
    with tempfile.TemporaryDirectory() as folder:
        samples = make_speech_corpus(folder, {"en": vocabulary}, num_speakers=SPEAKERS, takes=1).samples
        clips = [read_audio(sample.path) for sample in samples]
        return ConnectedWordRecognizer(**options).fit(
            clips, [sample.label for sample in samples], groups=[sample.person for sample in samples]
        )


@cache
def _strings(words: tuple[str, ...]) -> tuple[list[np.ndarray], list[list[str]], int]:
    """Strings of words by speakers who were not trained on, with pauses of 0.2 s and a little noise."""
    rng = np.random.default_rng(0)
    sounds: list[np.ndarray] = []
    labels: list[list[str]] = []
    for number in range(STRINGS):
        voice = make_speaker(NEW_SPEAKERS[number % len(NEW_SPEAKERS)])
        labels.append([str(word) for word in rng.choice(words, LENGTH)])
        clips = [speak(word, "en", voice) for word in labels[-1]]
        sounds.append(_joined([clip.samples for clip in clips], clips[0].sample_rate_hz, rng))
    return sounds, labels, RATE_HZ


@cache
def _recorded(
    front_end: FrontEndKind,
) -> list[tuple[ConnectedWordRecognizer, list[np.ndarray], list[list[str]]]] | None:
    """Of each speaker of fsdd/recordings in HRI_DATA: a model of the others, and strings of the speaker's digits.

    None where there are no recordings.
    """
    folder = Path(os.environ.get("HRI_DATA", ".")) / "fsdd" / "recordings"
    if not folder.is_dir():
        return None
    samples = [sample for sample in Dataset.load(folder, "speech").samples if int(sample.take) < TAKES]
    clips = [(read_audio(sample.path), DIGITS[int(sample.label)], sample.person) for sample in samples]
    rng = np.random.default_rng(0)
    found = []
    for speaker in sorted({person for _, _, person in clips}):
        train = [clip for clip in clips if clip[2] != speaker]
        sounds, words, persons = zip(*train, strict=True)
        model = ConnectedWordRecognizer(words={"front_end": front_end}).fit(
            list(sounds), list(words), groups=list(persons)
        )
        labels = [[str(word) for word in rng.choice(DIGITS, LENGTH)] for _ in range(STRINGS // 2)]
        strings = []
        for string in labels:
            takes = [[clip for clip, word, who in clips if (word, who) == (label, speaker)] for label in string]
            said = [some[rng.integers(len(some))] for some in takes]
            strings.append(_joined([clip.samples for clip in said], said[0].sample_rate_hz, rng))
        found.append((model, strings, labels))
    return found


def _joined(clips: Sequence[np.ndarray], rate: int, rng: np.random.Generator) -> np.ndarray:
    """Words with pauses of 0.2 s around them and a little noise, at the rate of PocketSphinx's model."""
    pause = np.zeros(rate // 5, np.float32)
    sound = np.concatenate([pause, *(part for clip in clips for part in (clip, pause))])
    return resample((sound + 1e-3 * rng.standard_normal(len(sound))).astype(np.float32), rate, RATE_HZ)


def connected_digits() -> Timed:
    """Strings of 5 English digits, any number of digits, by the same grammar; both begin with the samples.

    With fsdd/recordings in HRI_DATA: 5 strings by each of its speakers, recognised by what was trained on the others.
    Else 10 by 3 synthetic voices, ours trained on 4 other ones. PocketSphinx has its own US English model, which has
    met no synthetic voice, nor speech of 8 kHz, which the recordings are.
    """
    return _beside_pocketsphinx("cepstra")


def connected_embedding() -> Timed:
    """The same by cepstra and the pretrained speech embedding, which names the words anew (extra embedding)."""
    timing.need_embedding()
    return _beside_pocketsphinx("both")


def _beside_pocketsphinx(front_end: FrontEndKind) -> Timed:
    recorded = _recorded(front_end)
    if recorded is None:
        sounds, labels, _ = _strings(tuple(DIGITS))
        parts = [(_trained(DIGITS, words={"front_end": front_end}), sounds, labels)]
    else:
        parts = recorded
    for model, _, _ in parts:
        model.set_grammar(Grammar.parse(JSGF, "digits"))
    peer = Decoder(Config(lm=None, loglevel="FATAL"))
    peer.add_jsgf_string("digits", JSGF)
    peer.activate_search("digits")
    sounds = [sound for _, some, _ in parts for sound in some]
    labels = [string for _, _, some in parts for string in some]
    pulses = [(32767 * np.clip(sound, -1, 1)).astype(np.int16).tobytes() for sound in sounds]

    def by_ours() -> list[list[str]]:
        return [list(model.recognise(sound, RATE_HZ).labels) for model, some, _ in parts for sound in some]

    def by_peer() -> list[list[str]]:
        found = []
        for raw in pulses:
            peer.start_utt()
            peer.process_raw(raw, full_utt=True)
            peer.end_utt()
            found.append(peer.hyp().hypstr.split() if peer.hyp() else [])
        return found

    errors = [count_word_errors(labels, run()).rate for run in (by_ours, by_peer)]
    assert errors[0] <= errors[1], f"word errors: ours {errors[0]}, PocketSphinx {errors[1]}"
    seconds = sum(len(sound) for sound in sounds) / RATE_HZ
    timed = medians(by_ours, by_peer, 5)
    details = {
        "recorded_speakers": 0 if recorded is None else len(recorded),
        "word_error_rate": errors[0],
        "peer_word_error_rate": errors[1],
        "real_time_factor": timed[0] / seconds,
        "peer_real_time_factor": timed[1] / seconds,
    }
    return *timed, details


def loop_of_100_words() -> Timed:
    """10 strings of 5 of 100 English words by 3 synthetic voices, any word behind any; with confidences.

    The peer is the budget, 0.02 of real time. The same sounds are decoded by a loop of the first 50 words, too: what
    grows with the words is that part of the time which features do not take.
    """
    words = [*DIGITS, *_COMMANDS.split()][:100]
    assert len(set(words)) == 100
    sounds, labels, rate = _strings(tuple(words))
    seconds = sum(len(sound) for sound in sounds) / rate
    took: dict[int, float] = {}
    errors = 0.0
    for count in (50, 100):
        recognizer = _trained(words[:count], choose_penalty=False, decoder={"insertion_penalty": -50.0})
        times, found = [], []
        for _ in range(5 if timing.most_repeats is None else 1):
            start = time.perf_counter()
            found = [list(recognizer.recognise(sound, rate).labels) for sound in sounds]
            times.append(time.perf_counter() - start)
        took[count] = statistics.median(times)
        errors = count_word_errors(labels, found).rate
    details = {
        "word_error_rate": errors,
        "real_time_factor": took[100] / seconds,
        "real_time_factor_of_50_words": took[50] / seconds,
    }
    return took[100], BUDGET * seconds, details


def connected_ptbhmm() -> Timed:
    """A frame of 10 strings of 5 English digits, from samples to words, by PTBHMMs; the peer is HMMs.

    Both are trained on the same synthetic voices, decode the same strings, and give confidences.
    """
    sounds, labels, rate = _strings(tuple(DIGITS))
    models = [_trained(DIGITS, words={"model": kind}) for kind in ("ptbhmm", "hmm")]

    def by(model: ConnectedWordRecognizer) -> list[list[str]]:
        return [list(model.recognise(sound, rate).labels) for sound in sounds]

    errors = [count_word_errors(labels, by(model)).rate for model in models]
    frame_s = models[0].options.words.cepstra.frame_shift_ms / 1000
    frames = sum(len(sound) for sound in sounds) / rate / frame_s
    ours, peer = medians(lambda: by(models[0]), lambda: by(models[1]), 5)
    return ours / frames, peer / frames, {"word_error_rate": errors[0], "peer_word_error_rate": errors[1]}


BENCHES = (
    Bench("connected_digits", connected_digits, "PocketSphinx"),
    Bench("connected_embedding", connected_embedding, "PocketSphinx"),
    Bench("connected_ptbhmm", connected_ptbhmm, "own HMMs"),
    Bench("loop_of_100_words", loop_of_100_words, "0.02 of real time"),
)
