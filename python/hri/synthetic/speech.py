# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Spoken words by the espeak-ng synthesiser, for demos and tests where no recordings are at hand.

Synthetic speech varies far less than people do: figures measured on it say that a chain works, not
how well.
"""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.datasets.dataset import Dataset
from hri.datasets.manifest import Manifest, SampleRow
from hri.io import write_wav_pcm16
from hri.media import Audio, read_audio
from hri.signal import resample
from hri.synthetic.corpus import make_corpus

DIGIT_WORDS: dict[str, dict[str, str]] = {
    "en": dict(
        zip(
            "0123456789",
            ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"),
            strict=True,
        )
    ),
    "hi": dict(
        zip(
            "0123456789",
            ("शून्य", "एक", "दो", "तीन", "चार", "पाँच", "छह", "सात", "आठ", "नौ"),
            strict=True,
        )
    ),
}
"""The digits as spoken, by language and label; both languages share the labels "0" to "9"."""

_ACCENTS = {"en": ("en-gb", "en-us", "en-gb-scotland", "en-gb-x-rp", "en-029")}
_VOICE_VARIANTS = ("m1", "f2", "m3", "f1", "m7", "f4", "m4", "f3", "m2", "f5", "m6", "m5")
_MORE_VARIANTS = (
    *("adam", "Andrea", "Alex", "aunty", "Andy", "belinda", "benjamin", "Annie", "boris", "linda", "caleb", "grandma"),
    *("david", "steph", "Denis", "shelby", "ed", "anika", "gustave", "Alicia", "Hugo", "steph2", "john", "steph3"),
    *(
        "Marco",
        "Michael",
        "miguel",
        "norbert",
        "paul",
        "pedro",
        "quincy",
        "robert",
        "sandro",
        "travis",
        "victor",
        "zac",
    ),
)
_HIGH_VOICES = {"Andrea", "aunty", "belinda", "Annie", "linda", "grandma", "steph", "shelby", "anika", "Alicia"}
_HIGH_VOICES |= {"steph2", "steph3", "f1", "f2", "f3", "f4", "f5"}
_MARGIN_S = 0.1
_TIMEOUT_S = 60

Words = Mapping[str, Mapping[str, str] | Sequence[str]]


@dataclass(frozen=True)
class Speaker:
    """A made-up voice.

    Attributes
    ----------
    name : str
    variant : str
        Of espeak-ng: which throat.
    accent : int
        Which of a language's accents, counted round.
    pitch : int, 0..99
    rate : int
        Words a minute.
    noise_db : float
        Floor of the recording, relative to the loudest sample.
    tract : float
        Factor on the frequencies of the throat's resonances, 0.5..2: above 1 is a shorter vocal tract.
    """

    name: str
    variant: str
    accent: int
    pitch: int
    rate: int
    noise_db: float
    tract: float = 1.0


def make_speaker(index: int, seed: int = 0) -> Speaker:
    """The speaker with this number.

    The first 48 differ in throat, all in pitch and pace; from the thirteenth on also in the length of the vocal tract,
    as people do.
    """
    rng = np.random.default_rng((seed, 0x57EA, index))
    variants = _VOICE_VARIANTS + _MORE_VARIANTS
    variant = variants[index % len(variants)]
    low, high = (45, 75) if variant in _HIGH_VOICES else (25, 55)
    pitch, rate = int(rng.integers(low, high)), int(rng.integers(125, 185))
    noise_db = float(rng.uniform(-58.0, -42.0))
    tract = float(rng.uniform(0.88, 1.14)) if index >= len(_VOICE_VARIANTS) else 1.0
    return Speaker(f"voice{index + 1:02d}", variant, index, pitch, rate, noise_db, tract)


def speak(text: str, language: str = "en", speaker: Speaker | None = None, take: int = 0, seed: int = 0) -> Audio:
    """Say a word; the same arguments and the same espeak-ng give the same samples.

    Parameters
    ----------
    text : str
    language : str
        Code of an espeak-ng voice: "en", "hi", "de", ...
    speaker : Speaker, optional
        The first one by default.
    take : int
        Repetitions differ a little in pitch, pace, level and noise.
    seed : int

    Returns
    -------
    Audio
        The word with 0.1 s of noise floor on either side.

    Raises
    ------
    IoError
        When espeak-ng is not installed.
    InvalidArgument
        For a language it does not know, or a text that gives no sound.
    """
    speaker = speaker or make_speaker(0, seed)
    key = [seed, take, speaker.accent, *text.encode(), *language.encode()]
    rng = np.random.default_rng(key)
    accents = _ACCENTS.get(language, (language,))
    voice = f"{accents[speaker.accent % len(accents)]}+{speaker.variant}"
    pitch = int(np.clip(speaker.pitch + rng.integers(-5, 6), 0, 99))
    rate = int(np.clip(speaker.rate + rng.integers(-12, 13), 80, 400))
    # Resonances move by playing the word at another rate; pitch moves with them, the pace is made up for.
    audio = _synthesise(text, voice, pitch, round(rate / speaker.tract))
    word = _trimmed(audio.samples)
    if speaker.tract != 1.0:
        played_hz = round(audio.sample_rate_hz * speaker.tract)
        word = np.asarray(resample(word, played_hz, audio.sample_rate_hz))
    if word.size == 0:
        raise InvalidArgument(f"text {text!r} gives no sound in language {language!r}")
    margin = np.zeros(round(_MARGIN_S * audio.sample_rate_hz), dtype=np.float32)
    padded = np.concatenate([margin, word / np.abs(word).max(), margin])
    padded += 10.0 ** (speaker.noise_db / 20.0) * rng.standard_normal(padded.size)
    level = 10.0 ** (rng.uniform(-12.0, -3.0) / 20.0)
    samples = np.clip(level * padded, -1.0, 1.0).astype(np.float32)
    return Audio(samples, audio.sample_rate_hz, ["synthetic speech"])


def _synthesise(text: str, voice: str, pitch: int, rate: int) -> Audio:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "word.wav"
        command = ["espeak-ng", "-v", voice, "-p", str(pitch), "-s", str(rate), "-w", str(path)]
        try:
            done = subprocess.run(
                [*command, "--", text],
                capture_output=True,
                text=True,
                timeout=_TIMEOUT_S,
                check=False,
            )
        except FileNotFoundError as error:
            raise IoError(
                "synthetic speech needs the program espeak-ng: install the package espeak-ng "
                "(apt install espeak-ng, dnf install espeak-ng, brew install espeak-ng)"
            ) from error
        except subprocess.TimeoutExpired as error:
            raise IoError(f"espeak-ng did not finish {text!r} in {_TIMEOUT_S} s") from error
        except ValueError as error:  # a null character
            raise InvalidArgument(f"text {text!r} cannot be spoken: {error}") from error
        if done.returncode != 0:
            said = done.stderr.strip() or f"exit code {done.returncode}"
            raise InvalidArgument(f"espeak-ng refuses voice {voice!r}: {said}")
        try:
            return read_audio(path)
        except (FormatError, IoError) as error:
            raise InvalidArgument(f"espeak-ng gave no sound for {text!r}: {error}") from error


def _trimmed(samples: NDArray[np.float32]) -> NDArray[np.float32]:
    """Without the synthesiser's silence (below 1 % of the peak) at either end."""
    peak = float(np.abs(samples).max(initial=0.0))
    loud = np.flatnonzero(np.abs(samples) > 0.01 * peak)
    return samples[loud[0] : loud[-1] + 1] if loud.size else samples[:0]


@dataclass(frozen=True)
class _Saying:
    """One word by one voice, once."""

    speaker: Speaker
    label: str
    language: str
    text: str
    take: int


def _sayings(words: Words, num_speakers: int, takes: int, seed: int) -> list[_Saying]:
    """Every voice says every word; raises InvalidArgument for none."""
    if num_speakers < 1 or takes < 1:
        raise InvalidArgument(f"num_speakers is {num_speakers} and takes {takes}, both must be at least 1")
    spoken = [
        (label, language, text)
        for language, table in words.items()
        for label, text in (table if isinstance(table, Mapping) else {word: word for word in table}).items()
    ]
    if not spoken:
        raise InvalidArgument("words is empty")
    speakers = [make_speaker(index, seed) for index in range(num_speakers)]
    return [_Saying(speaker, *word, take) for speaker in speakers for word in spoken for take in range(takes)]


def _made(sayings: Sequence[_Saying], seed: int, progress: Callable[[int, int], None] | None) -> Iterator[Audio]:
    """The sound of each, in order."""

    def say(one: _Saying) -> Audio:
        return speak(one.text, one.language, one.speaker, one.take, seed)

    with ThreadPoolExecutor(os.cpu_count()) as executor:  # the synthesiser is a process of its own
        pending = [executor.submit(say, one) for one in sayings]
        try:
            for done, future in enumerate(pending, start=1):
                yield future.result()
                if progress is not None:
                    progress(done, len(pending))
        except BaseException:
            executor.shutdown(cancel_futures=True)
            raise


def speak_words(
    words: Words,
    num_speakers: int = 24,
    takes: int = 1,
    seed: int = 0,
    progress: Callable[[int, int], None] | None = None,
) -> tuple[list[Audio], list[str], list[str]]:
    """Say words without recordings, to train on beside recordings of others.

    Parameters
    ----------
    words, num_speakers, takes, seed, progress
        As of `make_speech_corpus`.

    Returns
    -------
    clips : list of Audio
    labels, persons : list of str
        What each says, and the name of its voice: ``fit(X + clips, y + labels, groups=groups + persons)``.

    Raises
    ------
    InvalidArgument, IoError
        As of `make_speech_corpus`.
    """
    sayings = _sayings(words, num_speakers, takes, seed)
    clips = list(_made(sayings, seed, progress))
    return clips, [one.label for one in sayings], [one.speaker.name for one in sayings]


def make_speech_corpus(
    directory: str | PathLike[str],
    words: Words | None = None,
    num_speakers: int = 8,
    takes: int = 2,
    seed: int = 0,
    progress: Callable[[int, int], None] | None = None,
    replace: bool = False,
) -> Dataset:
    """Write spoken words, ``{label}/{person}_{take}.wav``, and a manifest that says so.

    Parameters
    ----------
    directory : path-like
        Made if needed. One that is not empty must hold what an equal call made, see `replace`.
    words : mapping, optional
        Language to words: a list (the label is the word) or a mapping from label to spoken text.
        By default the ten digits in English and Hindi under common labels, `DIGIT_WORDS`.
    num_speakers : int
        At least 1; each speaks every language.
    takes : int
        Repetitions of each word by each speaker and language, at least 1.
    seed : int
    progress : callable, optional
        Called with (done, total) after every recording.
    replace : bool
        Whether spoken words that another call made there give way. Nothing else ever does, as recordings of people.

    Raises
    ------
    InvalidArgument
        For no words, counts below 1, a label that is no folder name, a language espeak-ng does not know, or a folder
        that holds something else.
    IoError
        When espeak-ng is not installed or a file cannot be written.
    """
    sayings = _sayings(DIGIT_WORDS if words is None else words, num_speakers, takes, seed)
    rows = []
    for one in sayings:
        take = f"{one.language}{one.take + 1}"
        name = f"{one.label}/{one.speaker.name}_{take}.wav"
        rows.append(SampleRow(name, one.label, one.speaker.name, take))
    manifest = Manifest(
        "speech",
        "synthetic words",
        "Words spoken by the espeak-ng synthesiser with synthetic voices; no recordings of people.",
        synthetic=True,
        made_by={
            "program": "hri.synthetic.speech",
            "seed": seed,
            "num_speakers": num_speakers,
            "takes": takes,
            "texts": list(dict.fromkeys(f"{one.language} {one.label}={one.text}" for one in sayings)),
        },
        rows=rows,
    )
    return make_corpus(
        directory, manifest, replace, (partial(_write, audio) for audio in _made(sayings, seed, progress))
    )


def _write(audio: Audio, path: Path) -> None:
    write_wav_pcm16(str(path), audio.samples, audio.sample_rate_hz)
