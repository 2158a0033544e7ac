# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What happens in the demo: people who were not trained on say and show something, and it is decided."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.display import short_repr
from hri.demo.corpus import FULL, WORDS
from hri.evaluation import make_noise, mix_noise
from hri.fusion import RULES, FusedDecision, fuse
from hri.io import write_wav_pcm16
from hri.media import Audio
from hri.recognition import GestureRecognizer, WordRecognizer
from hri.synthetic.drawing.signer import make_signer
from hri.synthetic.signer import CLIP_FPS, draw_clip
from hri.synthetic.speech import make_speaker, speak

UNSEEN_VOICE = FULL.num_speakers
"""Number of the first voice of the scenes. Those of the corpus come before it; like them, these have plain throats."""
UNSEEN_SIGNER = 40
"""Number of the first signer of the scenes, far beyond those trained on."""
CLIP_SIZE_PX = (320, 240)
_NUM_FRAMES = 30
_SNR_DB = 20.0


@dataclass(frozen=True)
class Script:
    """What one scene shows.

    Attributes
    ----------
    title, text : str
        For the page, as plain text.
    word : str
        Label of the spoken word.
    language : str
        "en" or "hi".
    sign : str
        Label of the signed digit.
    noisy : bool
        White noise 20 dB below the voice.
    """

    title: str
    text: str
    word: str
    language: str
    sign: str
    noisy: bool = False


SCRIPTS = (
    Script(
        "Word and sign agree",
        "A voice says “saat”, Hindi for seven, while the signer shows 7.",
        *("7", "hi", "7"),
    ),
    Script(
        "Noise",
        "White noise lies 20 dB below the voice (SNR 20 dB).",
        *("3", "en", "3"),
        noisy=True,
    ),
    Script(
        "STOP wins",
        "The signer shows 5, the voice says “stop”. Whatever the other mode says, the robot does not move.",
        *("stop", "en", "5"),
    ),
)


@dataclass(frozen=True)
@short_repr
class Scene:
    """A script as played: what was heard and seen, and all decisions."""

    script: Script
    audio: Audio
    frames: list[NDArray[np.uint8]]
    fps: float
    decision: FusedDecision
    by_rule: dict[str, FusedDecision]

    @property
    def succeeded(self) -> bool:
        """Whether the decision is what the script asks for."""
        return self.decision.label == self.script.word

    def to_dict(self) -> dict[str, Any]:
        """As plain values that can be written as JSON."""
        return {
            "title": self.script.title,
            "said": self.script.word,
            "language": self.script.language,
            "signed": self.script.sign,
            "succeeded": self.succeeded,
            "noise": f"white, {_SNR_DB:g} dB" if self.script.noisy else None,
            "decision": self.decision.to_dict(),
            "other_rules": {name: {"label": d.label, "confidence": d.confidence} for name, d in self.by_rule.items()},
        }


def play(number: int, script: Script, words: WordRecognizer, signs: GestureRecognizer, seed: int) -> Scene:
    """Speak and draw `script` by people of its own, and decide."""
    voice, signer = make_speaker(UNSEEN_VOICE + number, seed), make_signer(UNSEEN_SIGNER + number, seed)
    audio = speak(WORDS[script.language][script.word], script.language, voice, seed=seed)
    if script.noisy:
        noise = make_noise("white", len(audio.samples), audio.sample_rate_hz, np.random.default_rng(seed))
        samples = mix_noise(audio.samples, noise, _SNR_DB, audio.sample_rate_hz)
        audio = Audio(samples / np.abs(samples).max(), audio.sample_rate_hz, audio.notes)
    frames = draw_clip(signer, script.sign, seed=seed, size_px=CLIP_SIZE_PX, num_frames=_NUM_FRAMES)
    heard = words.recognise(audio)
    seen = signs.recognise(frames)
    by_rule = {rule: fuse(heard, seen, rule=rule) for rule in RULES}
    return Scene(script, audio, frames, CLIP_FPS, by_rule[RULES[0]], by_rule)


def save(scene: Scene, directory: Path, number: int) -> None:
    """Write what was heard and seen, so that ``hri recognise`` can be tried on it."""
    from hri.media import write_video

    write_wav_pcm16(str(directory / f"scene{number + 1}.wav"), scene.audio.samples, scene.audio.sample_rate_hz)
    write_video(directory / f"scene{number + 1}.mp4", scene.frames, scene.fps)
