# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Words that a person adds at the page while a grammar of commands is in use."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from hri.core.phrases import Phrase, phrase
from hri.media import Audio
from hri.recognition import CommandRecognizer, ConnectedWordRecognizer, Decision
from hri.serve.stage import Stage
from hri.serve.teacher import NUM_SAMPLES
from hri.serve.word_teacher import SpokenTeacher
from hri.signal import ActivityOptions

_SPEAKER = "added at the page"


class CommandWordTeacher(SpokenTeacher):
    """Adds words to those of which the commands of a stage are made, by training all of them anew.

    Connected words are models of whole strings and take no word by itself, so the recordings that they were trained on
    (``Stage.recordings``) are needed again; of words without recordings synthetic voices say them once more
    (``Stage.say_again``). With ``Stage.speak`` synthetic voices say the word in training, too. What
    was chosen in training, as the insertion penalty, stays. The grammar stays, too: a person writes the new word into
    it.

    Parameters
    ----------
    stage : Stage
    """

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._before: list[ConnectedWordRecognizer] = []
        self._counted: Counter[str] = Counter()
        self._spoken: dict[str, list[tuple[Audio, str, str]]] = {}
        self._again: list[tuple[Audio, str, str]] | None = None

    @property
    def _commands(self) -> CommandRecognizer:
        assert isinstance(self._stage.words, CommandRecognizer)
        return self._stage.words

    def _labels(self) -> list[str] | None:
        return [str(label) for label in self._commands.words.classes_]

    def _activity(self) -> ActivityOptions:
        return self._commands.words.options.words.activity

    def _decide(self, clip: Audio) -> Decision:
        return self._commands.recognise(clip)

    def _keep_clip(self, clip: Audio, decision: Decision) -> None:
        # Of the decision only STOP counts: by a grammar a word alone is like whatever sentence is the nearest.
        self._keep_sample(clip)

    def _advice(self) -> list[Phrase]:
        return [phrase("write_into_commands")]

    def _mistaken(self, label: str, samples: list[Any]) -> Counter[str]:
        return self._counted  # by the trainings of `_add`

    def _add(self, label: str, samples: list[Any]) -> None:
        """Train with a sample of every added word left out, each in its turn, and then with all."""
        words = self._commands.words
        added: dict[str, list[Audio]] = {**self._added, label: samples}
        self._counted = Counter()
        for step in range(NUM_SAMPLES + 1):
            self._answer(
                phrase("learning_step", label=label, step=step + 1, steps=NUM_SAMPLES + 1),
                progress=step / (NUM_SAMPLES + 1),
            )
            more = self._trained(
                words, {one: [clip for i, clip in enumerate(clips) if i != step] for one, clips in added.items()}
            )
            if step < NUM_SAMPLES:
                self._try(more, {one: clips[step] for one, clips in added.items()}, label)
        self._stage.words = self._commands_of(more)
        self._before.append(words)

    def _commands_of(self, words: ConnectedWordRecognizer) -> CommandRecognizer:
        """By the grammar in use, which may be another one by now."""
        now = self._commands
        return CommandRecognizer(words, now.grammar, min_confidence=now.min_confidence)

    def _try(self, words: ConnectedWordRecognizer, left_out: Mapping[str, Audio], label: str) -> None:
        """Count what the new word is mistaken for, and which others are mistaken for it."""
        for one, clip in left_out.items():
            best = words.recognise(clip, num_words=1).text
            if one == label and best != label:
                self._alike[best] += 1
            elif one != label and best == label:
                self._counted[one] += 1

    def _trained(self, words: ConnectedWordRecognizer, added: Mapping[str, Sequence[Audio]]) -> ConnectedWordRecognizer:
        """Another model with the options of `words`, of the stage's recordings and these."""
        assert self._stage.recordings is not None
        rows: list[tuple[Any, str, str]] = [(s.path, s.label, s.person) for s in self._stage.recordings]
        rows += [(clip, label, _SPEAKER) for label, clips in added.items() for clip in clips]
        rows += self._said_again()
        rows += [row for label in added for row in self._voices(label)]
        clips, labels, speakers = map(list, zip(*rows, strict=True))
        options = {**words.trained_options.as_dict(), "choose_penalty": False}
        return ConnectedWordRecognizer(**options).fit(clips, labels, groups=speakers, embedding=words.embedding)

    def samples(self) -> list[tuple[Audio, str, str]]:
        """What the words in use were trained on beside ``Stage.recordings``: clip, word, and who or what said it.

        Empty while no word is added here.
        """
        rows = [(clip, label, "page") for label, clips in self._added.items() for clip in clips]
        said = [row for label in self._added for row in self._voices(label)] + (self._again or [])
        return rows + [(clip, label, f"synthetic-{voice}") for clip, label, voice in said if rows]

    def _said_again(self) -> list[tuple[Audio, str, str]]:
        """What synthetic voices said in the first training, said once more."""
        if self._again is None:
            say_again = self._stage.say_again
            self._again = [] if say_again is None else list(zip(*say_again(), strict=True))
        return self._again

    def _voices(self, label: str) -> list[tuple[Audio, str, str]]:
        """What synthetic voices make of a word, and their names; nothing where there are none."""
        if self._stage.speak is None:
            return []
        if label not in self._spoken:
            self._spoken[label] = list(zip(*self._stage.speak(label), strict=True))
        return self._spoken[label]

    def _remove(self, label: str) -> None:
        before = self._commands_of(self._before[-1])  # refused while the grammar has the word
        self._before.pop()
        self._stage.words = before
