# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Drawn people who sign the sentences of the thesis: tracks of both hands and the head, with the frames of the words.

Drawn signers vary far less than people, and their hands are always seen: figures measured on them say that a chain
works, not how well.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.core.files import parse_toml, read_text, write_text
from hri.datasets.asl_sentences import (
    HANDS_COLUMNS,
    SIGNERS_COLUMNS,
    WORDS_COLUMNS,
    SignedSentence,
    SignedWord,
    read_asl_sentences,
)
from hri.synthetic.corpus import files_in, new_content, require_made_up, to_replace

SENTENCES: dict[str, dict[str, str]] = {
    "table 4.3": {
        "How are you?": "how you",
        "I am agree.": "i agree",
        "Are you coming?": "you coming",
        "I am studying.": "i studying",
        "It is closed today.": "it today closed",
        "Are you hearing?": "you hearing",
        "You do not have a car?": "you car not",
        "Your home is big or small?": "your home big small",
        "Why are you sad?": "you sad why",
        "Is this your own room?": "your this room own",
    },
    "table 5.1": {
        "How are you?": "how you",
        "I am agree.": "i agree",
        "I am studying.": "i studying",
        "This is your own room?": "your this room own",
        "It is closed today.": "it today closed",
        "Are you coming?": "you coming",
        "Why are you sad?": "you sad why",
        "You do not have a car?": "you car not",
        "I am very lucky today.": "i very lucky today",
        "Are you hearing?": "you hearing",
        "Is the child studying?": "child studying",
        "What are those?": "those what",
        "We miss you very much.": "we miss you very",
        "What do you do?": "you do what",
        "I have finished my work.": "i work finished",
        "Just a minute.": "minute",
        "The child is very weak.": "child very weak",
        "May god bless you.": "god bless you",
        "Come in please.": "coming please",
        "Please switch off the light.": "please light switch off",
    },
}
"""What is said, and the words that are signed for it. Those of table 4.3 are in figure 4.6 of the thesis; which its
table 5.1 has it does not say: these have the 36 words that it counts."""

FPS = 25.0
_WORDS = "signed_words.toml"
_ABOUT = "synthetic.toml"
_REST = np.array([[1.15, -3.1], [1.15, -3.1]])
"""Right hand, left hand."""
_MIRROR = np.array([[-1.0, -1.0], [1.0, -1.0]])
"""From lengths to the picture, whose y grows downwards: the signer's right hand is on its left side."""
_REST_S, _HOLD_S, _LAST_HOLD_S = 0.5, 0.04, 0.2
_MOVE_S, _MOVE_S_PER_LENGTH = 0.12, 0.16

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class SigningStyle:
    """How one made-up person signs.

    Attributes
    ----------
    name : str
    hand_px : float
        Length of a hand in the picture: how near the camera is.
    head_px : (float, float)
        Where the head is.
    tempo : float
        2 is twice as fast as 1.
    reach : (float, float)
        How far signs go to the side and up, as factors.
    drift_px : float
        Standard deviation of where hands and head are found, in pixels.
    habits : int
        Seed of what is this person's own in every word.
    """

    name: str
    hand_px: float
    head_px: tuple[float, float]
    tempo: float
    reach: tuple[float, float]
    drift_px: float
    habits: int


def make_style(index: int, seed: int = 0) -> SigningStyle:
    """The signer with this number, at least 0; equal arguments give an equal one."""
    if index < 0:
        raise InvalidArgument(f"index is {index}, must be at least 0")
    rng = np.random.default_rng((seed, 0x5169, index))
    return SigningStyle(
        name=f"signer{index + 1:02d}",
        hand_px=float(rng.uniform(22.0, 42.0)),
        head_px=(float(rng.uniform(130.0, 190.0)), float(rng.uniform(45.0, 75.0))),
        tempo=float(rng.uniform(0.75, 1.35)),
        reach=(float(rng.uniform(0.85, 1.15)), float(rng.uniform(0.85, 1.15))),
        drift_px=float(rng.uniform(0.5, 2.5)),
        habits=int(rng.integers(2**31)),
    )


@lru_cache(maxsize=1)
def load_words() -> dict[str, Floats]:
    """Of every word the places of the right and the left hand, shape (places, 2, 2); see signed_words.toml."""
    text = resources.files("hri.synthetic").joinpath(_WORDS).read_text(encoding="utf-8")
    words = {}
    for name, places in parse_toml(text, _WORDS).items():
        rest = _REST[1].tolist()
        words[name] = np.array([place if len(place) == 4 else [*place, *rest] for place in places]).reshape(-1, 2, 2)
    return words


def sign_sentence(
    style: SigningStyle, words: Sequence[str], take: int = 0, seed: int = 0, habit: float = 0.12, jitter: float = 0.06
) -> SignedSentence:
    """Tracks of a signed sentence, with rest before and behind it; equal arguments give equal numbers.

    Parameters
    ----------
    style : SigningStyle
        From `make_style`.
    words : sequence of str
        One or more of `load_words`.
    take : int
        Repetitions differ in place and pace.
    seed : int
    habit, jitter : float
        Standard deviations of a place, in lengths of a hand: from signer to signer in every word, and from take to
        take.

    Returns
    -------
    SignedSentence
        Whole pixels, at `FPS` frames a second.

    Raises
    ------
    InvalidArgument
        For no words, and for a word that has no places.
    """
    known = load_words()
    for word in words:
        if word not in known:
            raise InvalidArgument(f"word {word!r} cannot be signed; known are {', '.join(known)}")
    if not words:
        raise InvalidArgument("words is empty: a sentence has one or more")
    video = f"{style.name} {' '.join(words)} {take + 1}"
    rng = np.random.default_rng([seed, take, style.habits, *" ".join(words).encode()])
    places: list[Floats] = [np.repeat(_REST[None], _frames(_REST_S, style, rng), axis=0)]
    spans = []
    num_frames = len(places[0])
    for word in words:
        own = np.random.default_rng([style.habits, *word.encode()])
        keys = known[word] * style.reach
        moved = keys + habit * own.normal(size=keys.shape) + jitter * rng.normal(size=keys.shape)
        hangs = np.all(known[word] == _REST[1], axis=2, keepdims=True)
        first = num_frames
        for number, key in enumerate(np.where(hangs, _REST[1], moved)):
            way = _way(places[-1][-1], key, style, rng)
            hold_s = _LAST_HOLD_S if number == len(keys) - 1 else _HOLD_S
            places += [way, np.repeat(key[None], _frames(hold_s, style, rng), axis=0)]
            if number == 0:
                first = num_frames + len(way) - 1
            num_frames += len(places[-2]) + len(places[-1])
        spans.append(SignedWord(word, first, num_frames - 1))
    places.append(_way(places[-1][-1], _REST, style, rng))
    places.append(np.repeat(_REST[None], _frames(_REST_S, style, rng), axis=0))
    hands = np.concatenate(places)
    # Columns of a track: left hand, right hand, head.
    points = np.concatenate([hands[:, ::-1] * _MIRROR[::-1], np.zeros((len(hands), 1, 2))], axis=1)
    pixels = style.hand_px * points + style.head_px + style.drift_px * rng.normal(size=points.shape)
    return SignedSentence(video, style.name, np.rint(pixels).astype(np.float32), tuple(spans))


def draw_sentences(
    table: str, num_signers: int = 10, takes: int = 3, seed: int = 0, first_signer: int = 0
) -> list[SignedSentence]:
    """All sentences of a table, by several signers, several times each.

    Raises
    ------
    InvalidArgument
        For a table that `SENTENCES` has not, counts below 1 and a first signer below 0.
    """
    if table not in SENTENCES:
        raise InvalidArgument(f"table is {table!r}, must be one of {', '.join(SENTENCES)}")
    if num_signers < 1 or takes < 1:
        raise InvalidArgument(f"num_signers is {num_signers}, takes {takes}; need at least one each")
    styles = [make_style(index, seed) for index in range(first_signer, first_signer + num_signers)]
    return [
        sign_sentence(style, words.split(), take, seed)
        for style in styles
        for words in SENTENCES[table].values()
        for take in range(takes)
    ]


def make_sentence_corpus(
    directory: str | PathLike[str],
    table: str,
    num_signers: int = 10,
    takes: int = 3,
    seed: int = 0,
    first_signer: int = 0,
    progress: Callable[[int, int], None] | None = None,
    replace: bool = False,
) -> list[SignedSentence]:
    """Write drawn sentences as `read_asl_sentences` reads them, and a file ``synthetic.toml`` that says what they are.

    Parameters
    ----------
    directory : path-like
        Made if needed. One that is not empty must hold what an equal call made, see `replace`.
    table, num_signers, takes, seed, first_signer
        As of `draw_sentences`.
    progress : callable, optional
        Called with (done, total) sentences.
    replace : bool
        Whether drawn sentences that another call made there give way. Nothing else ever does, as those of people.

    Raises
    ------
    InvalidArgument
        As of `draw_sentences`; for a folder that holds something else.
    IoError
        When a file cannot be written.
    """
    sentences = draw_sentences(table, num_signers, takes, seed, first_signer)
    hands, words, signers = [[",".join(names)] for names in (HANDS_COLUMNS, WORDS_COLUMNS, SIGNERS_COLUMNS)]
    for done, one in enumerate(sentences, start=1):
        signers.append(f"{one.video},{one.signer}")
        rows = one.positions.reshape(-1, 6).astype(int).tolist()
        hands += [f"{one.video},{frame},{','.join(map(str, row))}" for frame, row in enumerate(rows)]
        words += [f"{one.video},{one.signer},{word.label},{word.first},{word.last}" for word in one.words]
        if progress is not None:
            progress(done, len(sentences))
    made_by = {"num_signers": num_signers, "takes": takes, "seed": seed, "first_signer": first_signer}
    about = [
        'description = "Drawn people who sign sentences; no recordings of people."',
        "synthetic = true",
        f'table = "{table}"',
        *(f"{name} = {value}" for name, value in made_by.items()),
    ]
    files = {_ABOUT: about, "signers.csv": signers, "hands.csv": hands, "words.csv": words}
    texts = {name: "\n".join(lines) + "\n" for name, lines in files.items()}
    root = Path(directory)
    with new_content(root, _giving_way(root, texts, replace)) as folder:
        for name, text in texts.items():
            write_text(folder / name, text)
    return read_asl_sentences(root)


def _giving_way(root: Path, texts: dict[str, str], replace: bool) -> list[Path]:
    """The files in `root` in whose place new ones come; InvalidArgument where that would lose anything."""
    there = files_in(root)
    if not there:
        return []
    if not (root / _ABOUT).is_file():
        raise InvalidArgument(f"{root} is not empty, there is {there[0]}: choose another folder")
    signers = [signed.signer for signed in read_asl_sentences(root)]
    require_made_up(root, signers, [path for path in there if str(path) not in texts])
    if not replace and any(read_text(root / name) != text for name, text in texts.items()):
        raise InvalidArgument(to_replace(root))
    return there


def _frames(seconds: float, style: SigningStyle, rng: np.random.Generator) -> int:
    return max(1, round(FPS * seconds * float(rng.uniform(0.8, 1.25)) / style.tempo))


def _way(before: Floats, key: Floats, style: SigningStyle, rng: np.random.Generator) -> Floats:
    """From where the hands are to a key, by minimum jerk."""
    length = float(np.linalg.norm(key - before, axis=1).max())
    count = _frames(_MOVE_S + _MOVE_S_PER_LENGTH * length, style, rng)
    part = (np.arange(1, count + 1) / count)[:, None, None]
    blend = part**3 * (10.0 - 15.0 * part + 6.0 * part**2)
    return np.asarray(before + blend * (key - before))
