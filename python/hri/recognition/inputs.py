# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a recogniser may be given: a file, what `hri.media` read of one, or arrays."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hri.core.errors import InvalidArgument
from hri.core.labels import as_texts
from hri.media import Audio, Clip, read_audio, read_frames

Samples = NDArray[np.float32]
Frame = NDArray[np.uint8]


class _HasPath(Protocol):
    @property
    def path(self) -> Path: ...


AudioInput = str | PathLike[str] | _HasPath | Audio | ArrayLike
"""One utterance: a path, a `Sample` of a data set, an `hri.media.Audio`, or samples whose rate is given beside them."""
ClipInput = str | PathLike[str] | _HasPath | Clip | Frame | Iterable[Frame]
"""One sign: a path (picture, video, folder of pictures), a `Sample` of a data set, an `hri.media.Clip`, a picture or a
sequence of pictures."""

_PCM16_FULL_SCALE = 32768.0


def as_audio(value: AudioInput, sample_rate_hz: int | None, name: str = "audio") -> Audio:
    """One utterance as `Audio`.

    Parameters
    ----------
    value : path, Audio or array of shape (num_samples,)
        Floats in -1..1, or the int16 samples of a PCM file.
    sample_rate_hz : int or None
        For arrays; a file and an Audio know theirs.
    name : str
        The argument, as the caller knows it.

    Raises
    ------
    InvalidArgument
        For an array without a rate, a rate beside a file, several channels; names the argument, and says what would
        work.
    FormatError, IoError
        As `read_audio`.
    """
    if isinstance(value, Audio):
        require_rate(value.sample_rate_hz, f"the rate of {name}")
        if sample_rate_hz not in (None, value.sample_rate_hz):
            raise InvalidArgument(f"sample_rate_hz is {sample_rate_hz}, but {name} has {value.sample_rate_hz} Hz")
        return value
    path = _path_of(value)
    if path is not None:
        if sample_rate_hz is not None:
            raise InvalidArgument(f"sample_rate_hz is for arrays: {name} is a file, which knows its own")
        return read_audio(path)
    samples, notes = _as_samples(value, name)
    if sample_rate_hz is None:
        raise InvalidArgument(f"{name} is an array, whose rate is not known: give sample_rate_hz, such as 16000")
    return Audio(samples, require_rate(sample_rate_hz), notes)


def require_rate(rate: object, name: str = "sample_rate_hz") -> int:
    """A sample rate as an int. Raises InvalidArgument for anything else than an integer that 32 bits hold."""
    if isinstance(rate, bool) or not isinstance(rate, int | np.integer):
        raise InvalidArgument(f"{name} must be an integer, got {rate!r}")
    if not 0 < rate <= np.iinfo(np.int32).max:
        raise InvalidArgument(f"{name} is {rate}, which is no rate")
    return int(rate)


def as_audios(values: Sequence[AudioInput], sample_rate_hz: int | Sequence[int] | None, name: str = "X") -> list[Audio]:
    """Several utterances, all of them at once; parameters and errors as of `each_audio`."""
    return list(each_audio(values, sample_rate_hz, name))


def each_audio(
    values: Sequence[AudioInput], sample_rate_hz: int | Sequence[int] | None, name: str = "X"
) -> Iterator[Audio]:
    """Several utterances, each read when its turn comes; `sample_rate_hz` is one rate for all, one for each, or None.

    Raises
    ------
    InvalidArgument
        At once for one utterance in place of several, or rates that are more or fewer; as `as_audio`, naming the item,
        when its turn comes.
    """
    given: object = values  # whatever the annotation says
    if isinstance(given, str | PathLike | Audio) or _num_dimensions(given) == 1:
        raise InvalidArgument(f"{name} must be a sequence of utterances, got one: write [{name}], or call recognise")
    require_sequence(values, name)
    if sample_rate_hz is None or np.ndim(sample_rate_hz) == 0:
        rates: list[Any] = [sample_rate_hz] * len(values)
    else:
        rates = list(sample_rate_hz)  # type: ignore[arg-type]
    if len(rates) != len(values):
        raise InvalidArgument(f"{name} and sample_rate_hz differ in length: {len(values)}, {len(rates)}")
    return (as_audio(value, rate, f"{name}[{i}]") for i, (value, rate) in enumerate(zip(values, rates, strict=True)))


def as_frames(value: ClipInput, name: str = "clip") -> list[Frame]:
    """One sign as its BGR frames.

    Parameters
    ----------
    value : path, Clip, picture of shape (height, width, 3), or pictures
        An array of shape (num_frames, height, width, 3) is a sequence of pictures, too.
    name : str
        The argument, as the caller knows it.

    Raises
    ------
    InvalidArgument
        For pictures that are no uint8 arrays of three colours; names the argument, and says what would work.
    FormatError, IoError
        As `read_frames` and `read_pictures`.
    """
    if isinstance(value, Clip):
        return value.frames
    path = _path_of(value)
    if path is not None:
        return read_frames(path).frames
    if isinstance(value, np.ndarray) and value.ndim in (2, 3):
        return [_as_frame(value, name)]
    if not isinstance(value, Iterable):
        raise InvalidArgument(f"{name} must be a path, a Clip, a picture or a sequence of them, got {_kind(value)}")
    return [_as_frame(frame, f"{name}[{i}]") for i, frame in enumerate(value)]


def each_clip(values: Sequence[ClipInput], name: str = "X") -> Iterator[list[Frame]]:
    """Several signs, each read when its turn comes, as all videos together may not fit in memory.

    Raises
    ------
    InvalidArgument
        At once for one sign in place of several; as `as_frames`, naming the item, when its turn comes.
    """
    given: object = values  # whatever the annotation says
    if isinstance(given, str | PathLike | Clip) or _num_dimensions(given) in (0, 1, 2, 3):
        raise InvalidArgument(f"{name} must be a sequence of signs, got one: write [{name}], or call recognise")
    require_sequence(values, name)
    return (as_frames(value, f"{name}[{i}]") for i, value in enumerate(values))


def as_labels(X: Sequence[Any], y: Iterable[object], groups: Iterable[object] | None) -> tuple[list[str], list[str]]:
    """Labels and persons of what is learned from, both as texts; persons are "" where `groups` is None.

    Raises
    ------
    InvalidArgument
        As `as_texts`, and for lengths that differ.
    """
    require_sequence(X, "X")
    labels = as_texts(y, "y")
    persons = [""] * len(X) if groups is None else as_texts(groups, "groups")
    if not len(X) == len(labels) == len(persons):
        raise InvalidArgument(f"X, y and groups differ in length: {len(X)}, {len(labels)}, {len(persons)}")
    return labels, persons


def require_sequence(values: object, name: str) -> None:
    """Raise InvalidArgument for what has no length or no items, such as a generator or None."""
    if not (hasattr(values, "__len__") and hasattr(values, "__iter__")):
        more = f": write list({name})" if isinstance(values, Iterable) else ""
        raise InvalidArgument(f"{name} must be a sequence, got {_kind(values)}{more}")


def _num_dimensions(value: object) -> int | None:
    """Of an array of samples or pictures; None for all else, such as an array of paths, which is what a list is."""
    return value.ndim if isinstance(value, np.ndarray) and value.dtype.kind not in "OU" else None


def _path_of(value: object) -> Path | None:
    """The file that `value` names, or that a `Sample` of a data set is about."""
    path = getattr(value, "path", None) if not isinstance(value, Audio | Clip) else None
    if isinstance(value, str | PathLike):
        path = value
    return None if path is None else Path(path)


def _as_samples(value: Any, name: str) -> tuple[Samples, list[str]]:
    try:
        array = np.asarray(value)
    except ValueError as error:  # lists of different lengths
        raise InvalidArgument(f"{name} must be a path, an Audio or an array of samples: {error}") from error
    if array.dtype.kind not in "fiu" or (array.dtype.kind in "iu" and array.dtype != np.int16 and array.size):
        raise InvalidArgument(
            f"{name} must be a path, an Audio, or an array of floats in -1..1 or of int16, got {_kind(value)}"
        )
    if array.ndim != 1:
        channels = ": average its channels first" if array.ndim == 2 else ""
        raise InvalidArgument(f"{name} must be one-dimensional (mono), got shape {array.shape}{channels}")
    if array.dtype == np.int16:
        return (array / _PCM16_FULL_SCALE).astype(np.float32), ["converted from 16-bit integers"]
    return np.ascontiguousarray(array, dtype=np.float32), []


def _as_frame(value: Any, name: str) -> Frame:
    if not isinstance(value, np.ndarray):
        hint = ": recognise takes one at a time, predict takes several" if isinstance(value, str | PathLike) else ""
        raise InvalidArgument(f"{name} must be a picture, a uint8 array (height, width, 3), got {_kind(value)}{hint}")
    if value.ndim != 3 or value.shape[2] != 3:
        hint = ": a grey picture has no colours to find skin by" if value.ndim == 2 else ""
        raise InvalidArgument(f"{name} must have shape (height, width, 3), BGR, got {value.shape}{hint}")
    if value.dtype != np.uint8:
        raise InvalidArgument(f"{name} must be uint8, 0..255, got {value.dtype}")
    return value


def _kind(value: object) -> str:
    if isinstance(value, np.ndarray):
        return f"ndarray of {value.dtype}"
    other = {Audio: ": a WordRecognizer recognises it", Clip: ": a GestureRecognizer recognises it"}
    return f"{type(value).__name__}{other.get(type(value), '')}"
