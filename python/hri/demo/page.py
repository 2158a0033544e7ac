# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""One HTML page that holds everything, and explains it."""

from __future__ import annotations

import base64
import html
import io
import json
import shlex
import wave
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Any

import numpy as np

from hri import __version__
from hri.core.files import read_bytes
from hri.demo.conversation import shown
from hri.demo.film import Answer, robot_moves
from hri.demo.plots import plot_confusions, plot_scene
from hri.demo.scenes import Scene
from hri.demo.training import Trained
from hri.fusion import RULES
from hri.media import Audio
from hri.page import component, in_one_file
from hri.robot import gesture_trajectory


def make_page(
    scenes: list[Scene], answers: list[Answer], trained: Trained, film: Path, facts: dict[str, Any], progress: Any
) -> str:
    """The page as text; film, plots, sounds, style and scripts stand in it, so that the file can be passed on alone."""
    sections = []
    for number, scene in enumerate(scenes):
        sections.append(_section(number, scene, _embedded("image/png", plot_scene(scene))))
        progress("drawing plots", number + 1, len(scenes) + 1)
    words, signs = trained.words_result, trained.signs_result
    confusions = _embedded("image/png", plot_confusions(words, signs))
    progress("drawing plots", len(scenes) + 1, len(scenes) + 1)
    right = sum(scene.succeeded for scene in scenes)
    texts = {
        "summary": f"{right} of {len(scenes)} commands were understood.",
        "words_accuracy": f"{100 * words.mean:.0f}",
        "words_tested": len(words.items),
        "words_persons": words.folds[0].name,
        "signs_accuracy": f"{100 * signs.mean:.0f}",
        "signs_tested": len(signs.items),
        "signs_persons": signs.folds[0].name,
        "word_model": trained.words.get_params()["model"],
        "sign_model": trained.signs.get_params()["model"],
        "commands": _commands(film.parent),
        "version": __version__,
        **facts,
    }
    return _template("page.html").substitute(
        {name: html.escape(str(value)) for name, value in texts.items()},
        style=component("page.css").decode("utf-8"),
        film=_embedded("video/webm", read_bytes(film)),
        scenes="".join(sections),
        confusions=confusions,
        data=_data([shown(*both) for both in zip(scenes, answers, strict=True)]),
        script=in_one_file(_own("page.js")),
    )


def _own(name: str) -> str:
    return files("hri.demo").joinpath(name).read_text(encoding="utf-8")


def _template(name: str) -> Template:
    return Template(_own(name))


def _data(value: Any) -> str:
    """As JSON that ends no element of the page."""
    return json.dumps(value, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")


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
    rules = [f"{name}: {_decided(one)}" for name, one in scene.by_rule.items() if name != RULES[0]]
    rows = {
        "heard": _decided(decision.speech),
        "seen": _decided(decision.gesture),
        "other rules": ", ".join(rules),
        "robot": _robot(scene),
    }
    texts = {
        "index": number,
        "number": number + 1,
        "title": scene.script.title,
        "text": scene.script.text,
        "decided": _decided(decision),
        "rule": decision.rule,
    }
    return _template("scene.html").substitute(
        {name: html.escape(str(value)) for name, value in texts.items()},
        rows="".join(
            f"<tr><th scope='row'>{name}</th><td>{html.escape(text)}</td></tr>" for name, text in rows.items()
        ),
        sound=_embedded("audio/wav", _wav(scene.audio)),
        plot=plot,
    )


def _decided(decision: Any) -> str:
    if decision is None:
        return "nothing"
    return f"{decision.label} ({100 * decision.confidence:.1f} %)"


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
