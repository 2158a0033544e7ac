# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Connected words: trained on isolated ones, recognised in whole sentences."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Callable, Sequence
from typing import Unpack

import numpy as np

from hri import _native
from hri.core.errors import FormatError, InvalidArgument
from hri.core.labels import as_texts
from hri.io import ModelFile
from hri.language import ConfusionSlot, Grammar, Lattice, NGramModel, WordErrors, count_word_errors
from hri.media import naming_file, naming_files
from hri.recognition.inputs import AudioInput, as_audio, as_audios, as_labels, each_audio, require_sequence
from hri.recognition.keywords import ConnectedDecoderKeywords, ConnectedWordRecognizerKeywords
from hri.recognition.sentence.transcript import Transcript, transcript_of
from hri.recognition.silence import warn_of_silence
from hri.recognition.word.embedding import SpeechEmbedding
from hri.recognition.word.fillers import FillerWord, filler_words
from hri.recognition.word.with_embedding import RecognizerWithEmbedding

_log = logging.getLogger(__name__)

_LANGUAGE, _GRAMMAR = "language", "grammar"
"""Fields of the model file."""


_MOST = 1000
"""Words or alternatives that can be asked for."""


def _require_number(name: str, value: object, least: int) -> None:
    if isinstance(value, bool) or not isinstance(value, int | np.integer):
        raise InvalidArgument(f"{name} must be an integer, got {value!r}")
    if not least <= value <= _MOST:
        raise InvalidArgument(f"{name} is {value}, must lie in {least}..{_MOST}")


def _speakers_of(fillers: Sequence[FillerWord]) -> list[str]:
    """Take the n-th recording of every label as speaker n's."""
    count: Counter[str] = Counter()
    speakers = []
    for word in fillers:
        speakers.append(str(count[word.label]))
        count[word.label] += 1
    return speakers


class ConnectedWordRecognizer(RecognizerWithEmbedding):
    """Recognise words that follow one another, with pauses between them or without.

    Training joins isolated recordings of each speaker to strings whose word boundaries are known, and trains one HMM a
    word and one of silence on these: cepstra are normalised over the utterance, in training as in recognition.

    Parameters
    ----------
    **options
        Fields of ``hri.ConnectedWordRecognizerOptions``; ``words`` takes those of ``hri.WordRecognizerOptions``.

    Attributes
    ----------
    classes_ : ndarray of str
        The labels, sorted; set by `fit` and `load`.

    Examples
    --------
    >>> digits = ConnectedWordRecognizer(max_words=3).fit(clips, labels, sample_rate_hz=16000)
    >>> digits.recognise(samples, 16000, num_words=1).text
    'seven'
    """

    _native_class = _native.ConnectedWordRecognizer
    _options_class = _native.ConnectedWordRecognizerOptions
    _kind = "connected_word_recognizer"
    _front_end_field = "words.front_end"
    options: _native.ConnectedWordRecognizerOptions

    def __init__(self, **options: Unpack[ConnectedWordRecognizerKeywords]) -> None:
        super().__init__(**options)

    def fit(
        self,
        X: Sequence[AudioInput],
        y: Sequence[str],
        *,
        sample_rate_hz: int | Sequence[int] | None = None,
        groups: Sequence[str] | None = None,
        progress: Callable[[int, int], None] | None = None,
        fillers: Sequence[FillerWord] | None = None,
        embedding: SpeechEmbedding | None = None,
    ) -> ConnectedWordRecognizer:
        """Train on isolated words.

        Parameters
        ----------
        X : sequence of paths, Audio, or arrays of shape (num_samples,)
            A recording of one word each.
        y : sequence of str
            The word spoken in each.
        sample_rate_hz : int or sequence of int, optional
            Of arrays: one rate for all, or one for each.
        groups : sequence of str, optional
            The speaker of each recording: strings are joined within a speaker, and the insertion penalty is chosen on
            speakers held out.
        progress : callable, optional
            Called with (done, total) training steps.
        fillers : sequence of FillerWord, optional
            With ``unknown_words``: words outside the vocabulary, whose sounds unknown words may have; by default those
            that come with the package (`filler_words`). Words that are labels are left out. With an empty sequence
            unknown words are hardly found. The n-th recordings of all labels count as one speaker's.
        embedding : SpeechEmbedding, optional
            For ``words={"front_end": "both"}``; by default of the weights that the extra `embedding` installs.

        Raises
        ------
        ImportError
            For the front end "both" without weights; names the extra.
        InvalidArgument
            For lengths that differ, a recording that is not finite or too short, or a label without speech.
        Interrupted
            When Ctrl-C is pressed; the recogniser is left as it was.

        Notes
        -----
        Recordings without speech are left out; a warning of the log names them.
        """
        labels, speakers = as_labels(X, y, groups)
        native_embedding = self._native_embedding(embedding)
        clips = as_audios(X, sample_rate_hz)
        _log.info("training on %d recordings of %d words", len(clips), len(set(labels)))
        warn_of_silence(clips, self.options.words)
        others: list[FillerWord] = []
        if self.options.unknown_words:
            given = filler_words() if fillers is None else fillers
            others = [word for word in given if word.label not in set(labels)]
        with naming_files([clip.path for clip in clips], "X"):
            self._native = self._native_class.train(
                [clip.samples for clip in clips],
                [clip.sample_rate_hz for clip in clips],
                labels,
                speakers,
                self.options,
                progress,
                [np.ascontiguousarray(word.samples, dtype=np.float32) for word in others],
                [word.sample_rate_hz for word in others],
                [word.label for word in others],
                _speakers_of(others),
                native_embedding,
            )
        self._embedding = embedding
        return self

    def set_language(self, language: NGramModel | None) -> ConnectedWordRecognizer:
        """Weigh sequences of words by a language model of order 1 or 2, which is saved with the model.

        A grammar is dropped. With None the language model is dropped: words in any order.

        Raises
        ------
        InvalidArgument
            For another order, and a label that the language model does not know.
        """
        trained = self._trained
        self._native = self._without(_LANGUAGE) if language is None else trained.with_language(language)
        return self

    def set_grammar(self, grammar: Grammar | None) -> ConnectedWordRecognizer:
        """Find sentences of a grammar alone, which is saved with the model.

        A language model is dropped. With None the grammar is dropped: words in any order.

        Raises
        ------
        InvalidArgument
            For a word of the grammar that is no label.
        """
        trained = self._trained
        self._native = self._without(_GRAMMAR) if grammar is None else trained.with_grammar(grammar)
        return self

    @property
    def language(self) -> NGramModel | None:
        """The language model that sequences of words are weighed by."""
        file = self.to_model_file()
        return NGramModel.parse(file.text(_LANGUAGE), _LANGUAGE) if file.has(_LANGUAGE) else None

    @property
    def grammar(self) -> Grammar | None:
        """The grammar whose sentences are found."""
        file = self.to_model_file()
        return Grammar.parse(file.text(_GRAMMAR), _GRAMMAR) if file.has(_GRAMMAR) else None

    def _without(self, field: str) -> _native.ConnectedWordRecognizer:
        """The trained model without a field of its file."""
        file = self.to_model_file()
        kept = ModelFile()
        for name, text in file.metadata().items():
            if name != field:
                kept.set_text(name, text)
        for name in file.tensor_shapes():
            try:
                kept.set_matrix_d(name, file.matrix_d(name))
            except FormatError:  # it is of float32
                kept.set_matrix_f(name, file.matrix_f(name))
        return self._from_model_file(kept)

    def set_decoder(self, **options: Unpack[ConnectedDecoderKeywords]) -> ConnectedWordRecognizer:
        """Change options of the decoder after training, such as ``insertion_penalty`` or ``language_scale``."""
        current = self._trained.options.decoder.as_dict()
        self._native = self._trained.with_decoder(_native.ConnectedDecoderOptions(**{**current, **options}))
        return self

    @property
    def trained_options(self) -> _native.ConnectedWordRecognizerOptions:
        """The options with what training chose; `options` are those that were given."""
        return self._trained.options

    @property
    def insertion_penalty(self) -> float:
        """Added to the log score at every word; by default chosen in training."""
        return float(self._trained.options.decoder.insertion_penalty)

    @property
    def language_scale(self) -> float:
        """Factor on the log probabilities of language model and grammar."""
        return float(self._trained.options.decoder.language_scale)

    def recognise(
        self,
        audio: AudioInput,
        sample_rate_hz: int | None = None,
        *,
        num_words: int | None = None,
        num_alternatives: int = 0,
    ) -> Transcript:
        """Recognise the words of a recording.

        Parameters
        ----------
        audio : path, Audio, or array of shape (num_samples,)
        sample_rate_hz : int, optional
            Of an array.
        num_words : int, optional
            How many words there are, where that is known; language model and grammar then have no say.
        num_alternatives : int
            How many sentences to give, the best and others that differ in their words.

        Raises
        ------
        InvalidArgument
            For an array without a rate, of several channels, not finite or shorter than one frame, and for a number of
            words outside 1..1000 or of alternatives outside 0..1000.
        FormatError, IoError
            For a file that is no recording.
        """
        if num_words is not None:
            _require_number("num_words", num_words, 1)
        _require_number("num_alternatives", num_alternatives, 0)
        clip = as_audio(audio, sample_rate_hz)
        words = self._trained
        with naming_file(clip.path):
            found = words.recognise(clip.samples, clip.sample_rate_hz, num_words or 0, num_alternatives)
        return transcript_of(found, clip.notes)

    def align(self, audio: AudioInput, sample_rate_hz: int | None = None, *, words: Sequence[str]) -> Transcript:
        """When each of the words that are known to be in a recording was spoken: forced alignment.

        Pauses may lie before, between and after the words. Language model and grammar have no say.

        Parameters
        ----------
        audio, sample_rate_hz
            As `recognise` takes them.
        words : sequence of str
            What was said, in its order: labels, and with ``unknown_words`` also ``<unk>`` for any sound.

        Returns
        -------
        Transcript
            Of these words, with their times as `recognise` gives them. ``confidence`` is what the word has among all
            sentences of words in any order: near 0 where another word was said; it marks no word ``unknown``, only
            ``<unk>`` itself is. Not ``complete`` without speech, and where the recording is too short for so many
            words: the words are then those of the best beginning.

        Raises
        ------
        InvalidArgument, FormatError, IoError
            As `recognise` does; InvalidArgument for no word, more than 1000, and one that is no label, which it names.
        """
        if isinstance(words, str):
            raise InvalidArgument(f"words must be a sequence of words, got a text: write {words.split()!r}")
        clip = as_audio(audio, sample_rate_hz)
        model = self._trained
        with naming_file(clip.path):
            scored = model.score(clip.samples, clip.sample_rate_hz)
        return transcript_of(model.align(scored, as_texts(words, "words")), clip.notes)

    def lattice(
        self, audio: AudioInput, sample_rate_hz: int | None = None, *, num_words: int | None = None
    ) -> tuple[Lattice, float, float]:
        """All sentences that come near the best, with their times.

        Parameters
        ----------
        audio, sample_rate_hz, num_words
            As `recognise` takes them.

        Returns
        -------
        lattice : hri.language.Lattice
            Model ``i`` is ``classes_[i]``, then silence and the unknown word; empty without speech.
        first_s, frame_s : float
            Frame ``n`` begins at ``first_s + n * frame_s``.

        Raises
        ------
        InvalidArgument, FormatError, IoError
            As `recognise` does, and for a recording too long for a lattice.
        """
        if num_words is not None:
            _require_number("num_words", num_words, 1)
        clip = as_audio(audio, sample_rate_hz)
        words = self._trained
        with naming_file(clip.path):
            scored = words.score(clip.samples, clip.sample_rate_hz)
            return words.lattice(scored, num_words or 0), scored.first_s, scored.frame_s

    def confusion_network(self, audio: AudioInput, sample_rate_hz: int | None = None) -> list[ConfusionSlot]:
        """What may have been said instead, word by word; models are numbered as those of `lattice`."""
        found, _, _ = self.lattice(audio, sample_rate_hz)
        return found.confusion_network(self._trained.options.confidence_scale)

    def count_errors(
        self, X: Sequence[AudioInput], y: Sequence[Sequence[str]], sample_rate_hz: int | Sequence[int] | None = None
    ) -> WordErrors:
        """Word errors over recordings whose words are known.

        Parameters
        ----------
        X, sample_rate_hz
            As of `fit`, but of sentences.
        y : sequence of sequences of str
            The words of each; integers count as their digits, as in `fit`.

        Raises
        ------
        InvalidArgument
            For lengths that differ and words that are no text, before anything is recognised; then as `recognise` does.
        """
        require_sequence(y, "y")
        words = [as_texts(sentence, f"y[{i}]") for i, sentence in enumerate(y)]
        clips = each_audio(X, sample_rate_hz)
        if len(X) != len(words):
            raise InvalidArgument(f"X and y differ in length: {len(X)}, {len(words)}")
        found = [self.recognise(clip).labels for clip in clips]
        return count_word_errors(words, found)
