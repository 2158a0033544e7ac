# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""One HTML page that holds everything, and explains it."""

from __future__ import annotations

import base64
import html
import io
import shlex
import wave
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Any

import numpy as np

from hri import __version__
from hri.core.files import read_bytes
from hri.demo.film import robot_moves
from hri.demo.plots import plot_confusions, plot_scene
from hri.demo.scenes import Scene
from hri.demo.training import Trained
from hri.media import Audio
from hri.robot import gesture_trajectory


def make_page(scenes: list[Scene], trained: Trained, film: Path, facts: dict[str, Any], progress: Any) -> str:
    """The page as text; film, plots and sounds are embedded, so that the file can be passed on alone."""
    sections = []
    for number, scene in enumerate(scenes):
        sections.append(_section(number, scene, _embedded("image/png", plot_scene(scene))))
        progress("drawing plots", number + 1, len(scenes) + 1)
    words, signs = trained.words_result, trained.signs_result
    confusions = _embedded("image/png", plot_confusions(words, signs))
    progress("drawing plots", len(scenes) + 1, len(scenes) + 1)
    right = sum(scene.succeeded for scene in scenes)
    template = Template(files("hri.demo").joinpath("page.html").read_text(encoding="utf-8"))
    return template.substitute(
        film=_embedded("video/webm", read_bytes(film)),
        scenes="\n".join(sections),
        confusions=confusions,
        summary=f"{right} of {len(scenes)} commands were understood.",
        words_accuracy=f"{100 * words.mean:.0f}",
        words_tested=len(words.items),
        words_persons=words.folds[0].name,
        signs_accuracy=f"{100 * signs.mean:.0f}",
        signs_tested=len(signs.items),
        signs_persons=signs.folds[0].name,
        word_model=html.escape(str(trained.words.get_params()["model"])),
        sign_model=html.escape(str(trained.signs.get_params()["model"])),
        commands=html.escape(_commands(film.parent)),
        version=__version__,
        **facts,
    )


def _commands(directory: Path) -> str:
    scene, models = directory / "scenes" / "scene2", directory / "models"
    return " \\\n    ".join(
        (
            f"hri recognise --speech {shlex.quote(f'{scene}.wav')} --gesture {shlex.quote(f'{scene}.mp4')}",
            f"--speech-model {shlex.quote(str(models / 'speech.hri'))}",
            f"--gesture-model {shlex.quote(str(models / 'gesture.hri'))} --rule product --robot answer.webm",
        )
    )


def _section(number: int, scene: Scene, plot: str) -> str:
    decision = scene.decision
    rows = [
        ("heard", _decided(decision.speech)),
        ("seen", _decided(decision.gesture)),
        ("rule", html.escape(decision.rule)),
        (
            "other rules",
            ", ".join(f"{name}: {_decided(d)}" for name, d in scene.by_rule.items() if name != "table_6_9"),
        ),
        ("robot", _robot(scene)),
    ]
    table = "".join(f"<tr><th>{name}</th><td>{text}</td></tr>" for name, text in rows)
    return (
        f"<h2>{number + 1}. {html.escape(scene.script.title)}</h2>"
        f'<p>{scene.script.text} <audio controls src="{_embedded("audio/wav", _wav(scene.audio))}"></audio></p>'
        f'<p class="answer">Decided: {_decided(decision)}</p><div class="scroll"><table>{table}</table></div>'
        f'<figure><img alt="what was heard and seen, and the candidates" src="{plot}"></figure>'
    )


def _decided(decision: Any) -> str:
    if decision is None:
        return "nothing"
    return f"{html.escape(decision.label)} ({100 * decision.confidence:.1f} %)"


def _robot(scene: Scene) -> str:
    if not robot_moves(scene.decision):
        return "rests"
    trajectory = gesture_trajectory(scene.decision.label)
    rows, joints = trajectory.positions_rad.shape
    return f"{rows} rows of {joints} joints checked without errors, then {trajectory.duration_s:.1f} s of motion"


def _wav(audio: Audio) -> bytes:
    buffer = io.BytesIO()
    with wave.open(buffer, "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(audio.sample_rate_hz)
        file.writeframes((np.clip(audio.samples, -1, 1) * 32767).astype("<i2").tobytes())
    return buffer.getvalue()


def _embedded(kind: str, content: bytes) -> str:
    return f"data:{kind};base64,{base64.b64encode(content).decode('ascii')}"
