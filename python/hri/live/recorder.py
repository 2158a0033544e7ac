# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A data set of words, made from a microphone: asks for one word after the other and keeps what is said."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import closing
from pathlib import Path

import numpy as np

from hri import _native
from hri.datasets.manifest import MANIFEST_NAME, Manifest, read_manifest, write_manifest
from hri.errors import InvalidArgument, IoError
from hri.live import events
from hri.live.events import Event
from hri.live.sources import AudioSource
from hri.live.utterances import Samples, UtteranceFinder
from hri.recognition.decision import NO_INPUT, UNKNOWN

PATTERN = "{label}/{person}_{take}.wav"
CLIPPED = 0.999
"""Of full scale: what reaches it may have been louder."""
MAX_CLIPPED = 3
"""Samples of an utterance that may."""
_BAD_IN_NAMES = set('/\\:*?"<>|')


class WordRecorder:
    """Records words, label by label, into a data set that `hri.Dataset.load` reads.

    Every label is asked for once, then every label again, as words said in a row sound alike. What is there already
    stays as it is and is not asked for again: a recorder of the same folder, person and labels goes on where the last
    one stopped, and a recording that was deleted is made anew.

    Parameters
    ----------
    folder : path-like
        Made if it is not there. A manifest in it must have the recorder's pattern.
    labels : sequence of str
        The words, in the order in which they are asked for.
    person : str
        Who speaks; no "_" in it, which ends the person in a file's name.
    takes : int
        Recordings of every word by this person.
    options : EndpointerOptions, optional
        When a word begins and ends; by default as `Listener` has it for a recogniser's default options.
    level_interval_s : float
        How often the level is told.

    Raises
    ------
    InvalidArgument
        For labels or a person that cannot be names of files, labels that are there twice or reserved ("unknown",
        "no_input"), takes below 1, or a folder that holds another kind of data set.
    """

    def __init__(
        self,
        folder: str | os.PathLike[str],
        labels: Sequence[str],
        person: str,
        takes: int = 5,
        options: _native.EndpointerOptions | None = None,
        *,
        level_interval_s: float = 0.1,
    ) -> None:
        if takes < 1:
            raise InvalidArgument(f"takes must be at least 1, got {takes}")
        if not labels:
            raise InvalidArgument("labels: there is no word to record")
        for label in labels:
            _require_name("label", label)
            if label in (UNKNOWN, NO_INPUT):
                raise InvalidArgument(f"label '{label}' is what recognisers answer when no word was said")
            if list(labels).count(label) > 1:
                raise InvalidArgument(f"label '{label}' is there twice")
        _require_name("person", person)
        if "_" in person:
            raise InvalidArgument(f"person '{person}' has a '_', which ends the person in the name of a file")
        self._folder = Path(folder)
        self._labels = list(labels)
        self._person = person
        self._takes = takes
        chosen = options or _native.EndpointerOptions(activity=_native.WordRecognizerOptions().activity)
        self._finder = UtteranceFinder(chosen, level_interval_s)
        manifest = self._folder / MANIFEST_NAME
        if manifest.exists():
            found = read_manifest(manifest)
            if (found.kind, found.pattern, found.synthetic) != ("speech", PATTERN, False):
                raise InvalidArgument(f"{self._folder} holds another data set: {manifest} has not pattern '{PATTERN}'")
            for label in labels if found.labels else ():
                if label not in found.labels:
                    raise InvalidArgument(f"label '{label}' is not among the labels of {manifest}")

    @property
    def num_takes(self) -> int:
        """Recordings that are wanted in all."""
        return self._takes * len(self._labels)

    def missing(self) -> list[tuple[str, int]]:
        """Label and take of every recording that is not there yet, in the order in which they are asked for."""
        wanted = [(label, take) for take in range(1, self._takes + 1) for label in self._labels]
        return [place for place in wanted if not self._path(*place).exists()]

    def record(self, source: AudioSource) -> Iterator[Event]:
        """Ask, listen and keep until nothing is missing or the source ends, which is closed then.

        Beside what a listener tells of a stream, "prompt" says what to say next, "recorded" where it was kept, and
        "refused" why it was not; then the prompt comes again.

        Raises
        ------
        Stalled
            When the source gives no more samples.
        IoError
            When a recording cannot be written, or somebody else wrote it meanwhile.
        """
        missing = self.missing()
        if not missing:
            source.close()
            return
        self._write_manifest()
        num_lost = source.num_lost
        with closing(self._finder.hear(source, folder=str(self._folder))) as heard:
            for event, utterance in heard:
                yield event
                if event.event == events.LISTENING:
                    yield self._prompt(0.0, missing)
                if utterance is None:
                    continue
                lost, num_lost = source.num_lost - num_lost, source.num_lost
                reason = _fault(utterance, bool(event.fields["cut"]), lost)
                told = {"label": missing[0][0], "take": missing[0][1]}
                if reason:
                    yield Event(event.time, events.REFUSED, {**told, "reason": reason})
                else:
                    path = self._path(*missing.pop(0))
                    _keep(path, utterance, source.sample_rate_hz)
                    measured = {
                        "duration_s": round(len(utterance) / source.sample_rate_hz, 4),
                        "peak_db": round(20 * float(np.log10(max(1e-6, np.abs(utterance).max()))), 1),
                    }
                    yield Event(event.time, events.RECORDED, {**told, "path": str(path), **measured})
                if not missing:
                    return
                yield self._prompt(event.time, missing)

    def _prompt(self, time_s: float, missing: Sequence[tuple[str, int]]) -> Event:
        label, take = missing[0]
        done = self.num_takes - len(missing)
        return Event(time_s, events.PROMPT, {"label": label, "take": take, "done": done, "total": self.num_takes})

    def _path(self, label: str, take: int) -> Path:
        return self._folder / PATTERN.format(label=label, person=self._person, take=take)

    def _write_manifest(self) -> None:
        manifest = self._folder / MANIFEST_NAME
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise IoError(f"{self._folder}: {error.strerror or error}") from error
        if not manifest.exists():
            write_manifest(manifest, Manifest("speech", name=self._folder.absolute().name, pattern=PATTERN))


def _require_name(what: str, text: str) -> None:
    """A name that files may have on every system, and that is read back as it was written."""
    if not text or text != text.strip() or text.startswith(".") or text.endswith("."):
        raise InvalidArgument(f"{what} '{text}' cannot be the name of a file")
    for character in text:
        if character in _BAD_IN_NAMES or not character.isprintable():
            raise InvalidArgument(f"{what} '{text}' cannot be the name of a file: {character!r} is in it")


def _fault(utterance: Samples, cut: bool, num_lost: int) -> str:
    """What is wrong with a recording; "" if nothing."""
    if cut:
        return "too long for a word"
    if num_lost:
        return f"{num_lost} samples were lost: this computer is too busy"
    if int((np.abs(utterance) >= CLIPPED).sum()) > MAX_CLIPPED:
        return "too loud: speak farther away or turn the microphone down"
    return ""


def _keep(path: Path, utterance: Samples, sample_rate_hz: int) -> None:
    """Write a recording whole or not at all, and never over another one."""
    part = path.with_name(f".{path.name}")
    try:
        path.parent.mkdir(exist_ok=True)
        _native.write_wav_pcm16(str(part), utterance, sample_rate_hz)
        os.link(part, path)  # which, other than renaming, replaces nothing
    except IoError:
        raise
    except OSError as error:
        raise IoError(f"{path}: {error.strerror or error}") from error
    finally:
        part.unlink(missing_ok=True)
