# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What happens in the demo: people who were not trained on say and show something, and it is decided."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.datasets.drawing.signer import make_signer
from hri.datasets.synthetic_signer import CLIP_FPS, draw_clip
from hri.datasets.synthetic_speech import make_speaker, speak
from hri.demo.corpus import WORDS
from hri.evaluation import make_noise, mix_noise
from hri.fusion import RULES, FusedDecision, fuse
from hri.media import Audio
from hri.recognition import GestureRecognizer, WordRecognizer
from hri.recognition.decision import UNKNOWN

UNSEEN_VOICE = 42
"""Number of the first scene's voice; these differ from those trained on in throat too, see `make_speaker`."""
UNSEEN_SIGNER = 40
CLIP_SIZE_PX = (480, 360)
_NUM_FRAMES = 30
_SNR_DB = 0.0


@dataclass(frozen=True)
class Script:
    """What one scene shows.

    Attributes
    ----------
    title, text : str
        For the page.
    word : str
        Label of the spoken word, or a word that was not learned.
    language : str
        "en" or "hi".
    sign : str or None
        Label of the signed digit; None without a camera.
    noisy : bool
        White noise as loud as the voice.
    """

    title: str
    text: str
    word: str
    language: str
    sign: str | None
    noisy: bool = False


SCRIPTS = (
    Script(
        "Word and sign agree",
        "A voice says <i>saat</i>, Hindi for seven, while the signer shows 7.",
        *("7", "hi", "7"),
    ),
    Script(
        "Noise",
        "White noise is as loud as the voice (SNR 0 dB). The sign is clear.",
        *("3", "en", "3"),
        noisy=True,
    ),
    Script(
        "STOP wins",
        "The signer shows 5, the voice says <i>ruko</i>, Hindi for stop. A <i>stop</i> that is recognised in either "
        "mode overrides the other.",
        *("stop", "hi", "5"),
    ),
    Script(
        "A word never learned",
        "The voice says <i>banana</i>, which is no command, and there is no camera. The right answer is none.",
        *("banana", "en", None),
    ),
)


@dataclass(frozen=True)
class Scene:
    """A script as played.

    Attributes
    ----------
    script : Script
    audio : Audio
    frames : list of ndarray
        BGR, `fps` a second; empty without a camera.
    fps : float
    features : ndarray of float32, shape (num_frames_with_hand, num_features)
    decision : FusedDecision
        By table 6.9.
    by_rule : dict
        The same by every rule.
    """

    script: Script
    audio: Audio
    frames: list[NDArray[np.uint8]]
    fps: float
    features: NDArray[np.float32]
    decision: FusedDecision
    by_rule: dict[str, FusedDecision]

    @property
    def right(self) -> bool:
        """Whether the command was understood, or what is none was rejected."""
        wanted = self.script.word if self.script.word in WORDS[self.script.language] else UNKNOWN
        return self.decision.label == wanted

    def to_dict(self) -> dict[str, Any]:
        """As plain values that can be written as JSON."""
        return {
            "title": self.script.title,
            "said": self.script.word,
            "language": self.script.language,
            "signed": self.script.sign,
            "noise": f"white, {_SNR_DB:g} dB" if self.script.noisy else None,
            "right": self.right,
            "decision": self.decision.to_dict(),
            "other_rules": {name: {"label": d.label, "confidence": d.confidence} for name, d in self.by_rule.items()},
        }


def play(number: int, script: Script, words: WordRecognizer, signs: GestureRecognizer, seed: int) -> Scene:
    """Speak and draw `script` by people of its own, and decide."""
    text = WORDS[script.language].get(script.word, script.word)
    audio = speak(text, script.language, make_speaker(UNSEEN_VOICE + number, seed), seed=seed)
    if script.noisy:
        noise = make_noise("white", len(audio.samples), audio.sample_rate_hz, np.random.default_rng(seed))
        samples = mix_noise(audio.samples, noise, _SNR_DB)
        audio = Audio(samples / np.abs(samples).max(), audio.sample_rate_hz, audio.notes)
    heard = words.recognise(audio.samples, audio.sample_rate_hz)
    frames: list[NDArray[np.uint8]] = []
    features, seen = np.empty((0, 0), dtype=np.float32), None
    if script.sign is not None:
        signer = make_signer(UNSEEN_SIGNER + number, seed)
        frames = draw_clip(signer, script.sign, seed=seed, size_px=CLIP_SIZE_PX, num_frames=_NUM_FRAMES)
        features = signs.features(frames)
        seen = signs.recognise_features(features)
    by_rule = {rule: fuse(heard, seen, rule=rule) for rule in RULES}
    return Scene(script, audio, frames, CLIP_FPS, features, by_rule[RULES[0]], by_rule)


def save(scene: Scene, directory: Path, number: int) -> None:
    """Write what was heard and seen, so that ``hri recognise`` can be tried on it."""
    from hri import _native
    from hri.media import write_video

    _native.write_wav_pcm16(str(directory / f"scene{number + 1}.wav"), scene.audio.samples, scene.audio.sample_rate_hz)
    if scene.frames:
        write_video(directory / f"scene{number + 1}.mp4", scene.frames, scene.fps)
