# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Word errors of signed sentences by signers, or videos, that are not in the training data."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from hri.core.display import short_repr
from hri.core.errors import FormatError, InvalidArgument
from hri.datasets.asl_sentences import SignedSentence
from hri.datasets.folds import Fold, split_by_person, split_stratified
from hri.language import WordErrors, count_word_errors
from hri.recognition import SentenceRecognizer

NUM_FOLDS = 5
"""Parts of the videos of one signer."""


@dataclass(frozen=True)
class SentenceItem:
    """A sentence that was tested: its words, and those that were recognised."""

    video: str
    signer: str
    words: tuple[str, ...]
    found: tuple[str, ...]

    @property
    def right(self) -> bool:
        """Whether every word is right, and none is too many."""
        return self.words == self.found


@dataclass(frozen=True)
@short_repr
class SentenceResult:
    """What a fold, or all folds together, found.

    Attributes
    ----------
    name : str
        Who is held out; "all".
    items : tuple of SentenceItem
    num_unknown : int
        Words of the items that stand in no sentence trained on, and cannot be recognised.
    """

    name: str
    items: tuple[SentenceItem, ...]
    num_unknown: int

    @classmethod
    def pooled(cls, results: Sequence[SentenceResult]) -> SentenceResult:
        """All folds together."""
        items = tuple(item for result in results for item in result.items)
        return cls("all", items, sum(result.num_unknown for result in results))

    @property
    def errors(self) -> WordErrors:
        """Word errors over all items, by alignment as NIST's sclite counts them."""
        return count_word_errors([item.words for item in self.items], [item.found for item in self.items])

    @property
    def right(self) -> float:
        """Share of sentences that are right as a whole, 0..1."""
        return sum(item.right for item in self.items) / len(self.items)

    def to_dict(self) -> dict[str, Any]:
        """As plain values that can be written as JSON."""
        errors = self.errors
        return {
            "name": self.name,
            "num_sentences": len(self.items),
            **asdict(errors),
            "word_error_rate": errors.rate if errors.num_words else None,
            "sentences_right": self.right,
            "num_unknown": self.num_unknown,
            "items": [asdict(item) for item in self.items],
        }


def signers_of(sentences: Sequence[SignedSentence]) -> list[str] | None:
    """The signer of each sentence, the ``groups`` to train with; None where there is one signer alone."""
    signers = [sentence.signer for sentence in sentences]
    return signers if len(set(signers)) > 1 else None


def fit_sentences(
    recognizer: SentenceRecognizer,
    sentences: Sequence[SignedSentence],
    progress: Callable[[int, int], None] | None = None,
) -> SentenceRecognizer:
    """Train as `hri train-sentences` does: weights are chosen on signers held out where there are two or more.

    Parameters
    ----------
    recognizer : SentenceRecognizer
        Untrained.
    sentences : sequence of SignedSentence
    progress : callable, optional
        Called with (done, total) training steps.

    Raises
    ------
    InvalidArgument
        As of `SentenceRecognizer.fit`.
    """
    return recognizer.fit(
        [sentence.positions for sentence in sentences],
        [[(word.label, word.first, word.last + 1) for word in sentence.words] for sentence in sentences],
        groups=signers_of(sentences),
        progress=progress,
    )


def cross_validate_sentences(
    sentences: Sequence[SignedSentence],
    make: Callable[[], SentenceRecognizer],
    *,
    num_folds: int | None = None,
    seed: int = 0,
    progress: Callable[[str, int, int], None] | None = None,
) -> list[SentenceResult]:
    """Train on all signers but some, and recognise the sentences of these.

    Parameters
    ----------
    sentences : sequence of SignedSentence
        From `read_asl_sentences`.
    make : callable
        Makes an untrained recogniser.
    num_folds : int, optional
        By default each signer is held out in turn; of one signer alone, a fifth of the videos.
    seed : int
        Deals signers, or videos, into folds.
    progress : callable, optional
        Called with (fold, done, total).

    Returns
    -------
    list of SentenceResult
        One a fold; `SentenceResult.pooled` puts them together.

    Raises
    ------
    InvalidArgument
        For too few signers or videos, and as of `SentenceRecognizer.fit`, with the fold.
    FormatError
        Names a video that cannot be recognised, such as one without a hand.
    """
    return [_fold_result(sentences, fold, make, progress) for fold in _folds(sentences, num_folds, seed)]


def _folds(sentences: Sequence[SignedSentence], num_folds: int | None, seed: int) -> list[Fold]:
    signers = signers_of(sentences)
    if signers is not None:
        return split_by_person(signers, num_folds, seed)
    if len(sentences) < 2:
        raise InvalidArgument("to hold sentences out needs two videos or more")
    return split_stratified([""] * len(sentences), num_folds or min(NUM_FOLDS, len(sentences)), seed)


def _fold_result(
    sentences: Sequence[SignedSentence],
    fold: Fold,
    make: Callable[[], SentenceRecognizer],
    progress: Callable[[str, int, int], None] | None,
) -> SentenceResult:
    def report(done: int, total: int) -> None:
        if progress is not None:
            progress(fold.name, done, total)

    train = [sentences[index] for index in fold.train]
    try:
        recognizer = fit_sentences(make(), train, report)
    except InvalidArgument as error:
        raise InvalidArgument(f"without {fold.name}: {error}") from error
    known = set(map(str, recognizer.classes_))
    items = []
    for sentence in (sentences[index] for index in fold.test):
        try:
            found = recognizer.recognise(sentence.positions).labels
        except InvalidArgument as error:
            raise FormatError(f"video {sentence.video!r}: {error}") from error
        items.append(SentenceItem(sentence.video, sentence.signer, tuple(w.label for w in sentence.words), found))
    return SentenceResult(fold.name, tuple(items), sum(word not in known for item in items for word in item.words))
