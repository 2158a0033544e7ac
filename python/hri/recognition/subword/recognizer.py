# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Isolated words made of sub-word units: a word can be added by its spelling, without a recording."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from os import PathLike
from typing import Any, Unpack

import numpy as np
from numpy.typing import NDArray

from hri import _native
from hri.core.errors import InvalidArgument
from hri.core.labels import as_text
from hri.core.suggest import did_you_mean
from hri.htk import Dictionary, Pronunciation
from hri.language import closest_phone, pronounce
from hri.media import naming_file, naming_files
from hri.recognition.base import Recognizer
from hri.recognition.decision import Decision
from hri.recognition.inputs import AudioInput, as_audio, as_audios, as_labels, each_audio
from hri.recognition.keywords import SubwordRecognizerKeywords
from hri.recognition.loading import load_native
from hri.recognition.quality import speech_snr_db
from hri.recognition.silence import warn_of_silence

_log = logging.getLogger(__name__)

_SILENCE = "sil"


class SubwordRecognizer(Recognizer):
    """Recognise one spoken word at a time, by models put together of phones.

    The phones are trained on recordings of any words by embedded Baum-Welch: no times are needed, only how each word is
    pronounced, which the program espeak-ng says of its spelling. A word that was never recorded is then added by its
    spelling.

    Parameters
    ----------
    **options
        Fields of ``hri.SubwordRecognizerOptions``; ``words`` takes those of ``hri.WordRecognizerOptions``.

    Attributes
    ----------
    classes_ : ndarray of str
        The labels, sorted; set by `fit` and `load`.

    Examples
    --------
    >>> words = SubwordRecognizer().fit(clips, labels, language="en", sample_rate_hz=16000)
    >>> replaced = words.add_word("sideways")
    >>> "sideways" in words.classes_
    True
    """

    mode = "speech"
    _native_class = _native.SubwordRecognizer
    _options_class = _native.SubwordRecognizerOptions
    options: _native.SubwordRecognizerOptions

    def __init__(self, **options: Unpack[SubwordRecognizerKeywords]) -> None:
        super().__init__(**options)

    def fit(
        self,
        X: Sequence[AudioInput],
        y: Sequence[str],
        *,
        language: str = "en",
        spellings: Mapping[str, str] | None = None,
        dictionary: Dictionary | None = None,
        sample_rate_hz: int | Sequence[int] | None = None,
        groups: Sequence[str] | None = None,
        progress: Callable[[int, int], None] | None = None,
    ) -> SubwordRecognizer:
        """Train units on recordings of words; these words are the vocabulary.

        Parameters
        ----------
        X : sequence of paths, Audio, or arrays of shape (num_samples,)
            Each as `recognise` takes it.
        y : sequence of str
            The word spoken in each clip.
        language : str
            Code of an espeak-ng voice that knows how the words are pronounced.
        spellings : mapping of str to str, optional
            By label, how the word is written in the script of the language; the label itself by default.
        dictionary : hri.htk.Dictionary, optional
            Pronunciations of words, which come before those of espeak-ng. Without ``sil``, which is silence.
        sample_rate_hz : int or sequence of int, optional
            Of arrays: one rate for all, or one for each.
        groups : sequence of str, optional
            The speaker of each clip; confidences come from whole speakers held out.
        progress : callable, optional
            Called with (done, total) training steps.

        Raises
        ------
        InvalidArgument
            For lengths that differ, a clip that is not finite or too short, a label without speech, a spelling without
            sound, a dictionary that has none of the labels, and names of units that cannot be.
        IoError
            For labels that the dictionary has not, where espeak-ng is not installed.
        Interrupted
            When Ctrl-C is pressed; the recogniser is left as it was.

        Notes
        -----
        Recordings without speech are left out; a warning of the log names them.
        """
        labels, speakers = as_labels(X, y, groups)
        clips = as_audios(X, sample_rate_hz)
        warn_of_silence(clips, self.options.words)
        lexicon = _lexicon(sorted(set(labels)), language, spellings or {}, dictionary)
        _log.info("training on %d utterances of %d words", len(clips), len(lexicon.entries))
        with naming_files([clip.path for clip in clips], "X"):
            self._native = self._native_class.train(
                [clip.samples for clip in clips],
                [clip.sample_rate_hz for clip in clips],
                labels,
                speakers,
                lexicon,
                self.options,
                progress,
            )
        return self

    def add_word(
        self,
        label: str,
        spelling: str | None = None,
        *,
        language: str = "en",
        pronunciations: Sequence[Sequence[str]] | None = None,
        clips: Sequence[AudioInput] = (),
        sample_rate_hz: int | Sequence[int] | None = None,
    ) -> dict[str, str]:
        """Add a word by its spelling. The models of the other words stay as they are, and so does the threshold.

        Parameters
        ----------
        label : str
            A word that is not in the vocabulary.
        spelling : str, optional
            How it is written in the script of the language; the label by default.
        language : str
            Code of an espeak-ng voice that knows how it is pronounced.
        pronunciations : sequence of sequences of str, optional
            Units of the word instead, one sequence or several.
        clips : sequence of paths, Audio, or arrays of shape (num_samples,)
            Recordings, if there are any: the units of this word then move towards them.
        sample_rate_hz : int or sequence of int, optional
            Of arrays: one rate for all, or one for each.

        Returns
        -------
        dict of str to str
            Phones that no recording in training had, and the most similar phones that stand for them.

        Raises
        ------
        InvalidArgument
            For a label that is in the vocabulary already, a spelling without sound, a clip without speech (names it),
            and units that no model is like; the recogniser is left as it was.
        IoError
            Where espeak-ng is needed and not installed.
        """
        label = as_text(label, "label")
        words = self._trained
        said = [pronounce(spelling or label, language)] if pronunciations is None else pronunciations
        known = self.units
        replaced = {unit: closest_phone(unit, known) for units in said for unit in units if unit not in known}
        read = as_audios(clips, sample_rate_hz, "clips") if len(clips) else []
        with naming_files([clip.path for clip in read], "clips"):
            self._native = words.with_word(
                label,
                [[replaced.get(unit, unit) for unit in units] for units in said],
                [clip.samples for clip in read],
                [clip.sample_rate_hz for clip in read],
            )
        return replaced

    def remove_word(self, label: str) -> SubwordRecognizer:
        """Remove a word. Raises InvalidArgument for one outside the vocabulary, or if fewer than two would remain."""
        label = as_text(label, "label")
        if label not in self.classes_:
            raise InvalidArgument(f"no word {label!r}; {did_you_mean(label, self.classes_, 'it has')}")
        self._native = self._trained.without_word(label)
        return self

    @property
    def units(self) -> tuple[str, ...]:
        """The units that words can be made of; silence and those of single words are not among them."""
        return tuple(name for name in self._trained.units if name != _SILENCE and "/" not in name)

    @property
    def lexicon(self) -> Dictionary:
        """How the words are pronounced, in order; a word added with recordings has units of its own."""
        found: Dictionary = self._trained.lexicon
        return found

    @property
    def threshold(self) -> float:
        """Score from which a word is recognised."""
        return float(self._trained.threshold)

    @property
    def is_calibrated(self) -> bool:
        """Whether training could hold anything out. If not, nothing is rejected, and confidences say nothing."""
        return bool(self._trained.is_calibrated)

    def recognise(self, audio: AudioInput, sample_rate_hz: int | None = None) -> Decision:
        """Recognise one word.

        Parameters
        ----------
        audio : path, Audio, or array of shape (num_samples,)
        sample_rate_hz : int, optional
            Of an array. Audio of another rate than the model's is resampled.

        Raises
        ------
        InvalidArgument
            For an array without a rate, of several channels, or not finite.
        FormatError, IoError
            For a file that is no recording.
        """
        clip = as_audio(audio, sample_rate_hz)
        words = self._trained
        with naming_file(clip.path):
            decision = Decision.from_native(self.mode, words.recognise(clip.samples, clip.sample_rate_hz))
        quality = speech_snr_db(clip.samples, clip.sample_rate_hz)
        return replace(decision, notes=(*clip.notes, *decision.notes), quality=quality)

    def scores(self, audio: AudioInput, sample_rate_hz: int | None = None) -> NDArray[np.float32]:
        """Log scores a frame of every class, shape (num_classes,), in the order of `classes_`; empty without speech."""
        clip = as_audio(audio, sample_rate_hz)
        words = self._trained
        with naming_file(clip.path):
            return np.asarray(words.scores(clip.samples, clip.sample_rate_hz))

    def decide(self, X: Sequence[AudioInput], sample_rate_hz: int | Sequence[int] | None = None) -> list[Decision]:
        """The decision for every item of `X`, each as `recognise` takes it."""
        return [self.recognise(audio) for audio in each_audio(X, sample_rate_hz)]

    @classmethod
    def load(cls, path: str | PathLike[str]) -> SubwordRecognizer:
        """Read a model that `save` wrote, in Python or C++. Raises FormatError for anything else."""
        return cls._wrap(load_native(_native.SubwordRecognizer.from_model_file, path, "subword_recognizer"))


def labels_without_entry(labels: Sequence[str], dictionary: Dictionary) -> list[str]:
    """The labels that a dictionary does not have, which espeak-ng pronounces.

    Raises
    ------
    InvalidArgument
        Where it has none of them: it would have no effect.
    """
    words = {entry.word for entry in dictionary.entries}
    missing = [label for label in labels if label not in words]
    if len(missing) < len(labels):
        return missing
    folded = {word.casefold(): word for word in words}
    alike = [f"{folded[label.casefold()]} for {label}" for label in labels if label.casefold() in folded]
    hint = f"; capital and small letters differ in {', '.join(alike)}" if alike else ""
    raise InvalidArgument(f"the dictionary has none of the labels {' '.join(labels)}{hint}")


def _lexicon(
    labels: Sequence[str], language: str, spellings: Mapping[str, str], dictionary: Dictionary | None
) -> Dictionary:
    """Of the dictionary where it has them, else by espeak-ng."""
    if dictionary is not None:
        labels_without_entry(labels, dictionary)
    entries: dict[str, list[Any]] = {}
    for entry in [] if dictionary is None else dictionary.entries:
        entries.setdefault(entry.word, []).append(entry)
    chosen: list[Any] = []
    for label in labels:
        chosen += entries.get(label) or [Pronunciation(label, pronounce(spellings.get(label, label), language))]
    return Dictionary(chosen)
