# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Connected words: whole recordings to words, against PocketSphinx, real time, and PTBHMM against HMM."""

from __future__ import annotations

import statistics
import tempfile
import time
from functools import cache

import numpy as np
from pocketsphinx import Config, Decoder

from hri import ConnectedWordRecognizer, read_audio
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
RATE_HZ = 16000
"""That of PocketSphinx's model."""
BUDGET = 0.02
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
        rate = clips[0].sample_rate_hz
        pause = np.zeros(rate // 5, np.float32)
        sound = np.concatenate([pause, *(part for clip in clips for part in (clip.samples, pause))])
        sound = (sound + 1e-3 * rng.standard_normal(len(sound))).astype(np.float32)
        sounds.append(resample(sound, rate, RATE_HZ))
    return sounds, labels, RATE_HZ


def connected_digits() -> Timed:
    """10 strings of 5 English digits by 3 synthetic voices, any number of digits, by the same grammar.

    PocketSphinx has its own US English model, which has met no synthetic voice; ours is trained on 4 other synthetic
    voices. Both begin with the samples.
    """
    sounds, labels, rate = _strings(tuple(DIGITS))
    ours = _trained(DIGITS).set_grammar(Grammar.parse(JSGF, "digits"))
    peer = Decoder(Config(lm=None, loglevel="FATAL"))
    peer.add_jsgf_string("digits", JSGF)
    peer.activate_search("digits")
    pulses = [(32767 * np.clip(sound, -1, 1)).astype(np.int16).tobytes() for sound in sounds]

    def by_ours() -> list[list[str]]:
        return [list(ours.recognise(sound, rate).labels) for sound in sounds]

    def by_peer() -> list[list[str]]:
        found = []
        for raw in pulses:
            peer.start_utt()
            peer.process_raw(raw, full_utt=True)
            peer.end_utt()
            found.append(peer.hyp().hypstr.split() if peer.hyp() else [])
        return found

    errors = [count_word_errors(labels, run()).rate for run in (by_ours, by_peer)]
    seconds = sum(len(sound) for sound in sounds) / rate
    timed = medians(by_ours, by_peer, 5)
    details = {
        "word_error_rate": errors[0],
        "peer_word_error_rate": errors[1],
        "real_time_factor": timed[0] / seconds,
        "peer_real_time_factor": timed[1] / seconds,
    }
    return *timed, details


def loop_of_100_words() -> Timed:
    """10 strings of 5 of 100 English words by 3 synthetic voices, any word behind any; with confidences.

    The peer is the budget, 0.02 of real time.
    """
    words = [*DIGITS, *_COMMANDS.split()][:100]
    assert len(set(words)) == 100
    sounds, labels, rate = _strings(tuple(words))
    recognizer = _trained(words, choose_penalty=False, decoder={"insertion_penalty": -50.0})
    seconds = sum(len(sound) for sound in sounds) / rate
    took, found = [], []
    for _ in range(5):
        start = time.perf_counter()
        found = [list(recognizer.recognise(sound, rate).labels) for sound in sounds]
        took.append(time.perf_counter() - start)
    details = {
        "word_error_rate": count_word_errors(labels, found).rate,
        "real_time_factor": statistics.median(took) / seconds,
    }
    return statistics.median(took), BUDGET * seconds, details


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
    Bench("connected_ptbhmm", connected_ptbhmm, "own HMMs"),
    Bench("loop_of_100_words", loop_of_100_words, "0.02 of real time"),
)
