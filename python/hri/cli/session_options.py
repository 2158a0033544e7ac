# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Options that `hri session` and `hri serve` have in common, and what they choose."""

from __future__ import annotations

import functools
import hashlib
from collections.abc import Callable
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from hri.cli.connected import connected_model
from hri.cli.faces import faces_option, look_for_faces
from hri.cli.groups import FiniteRange, is_given, refuse_given
from hri.cli.messages import note
from hri.cli.motions import robot_option
from hri.cli.recognizers import embedding_option, kept_model, load_embedding, load_signs, warn_of_stored
from hri.core.errors import InvalidArgument
from hri.core.files import MAX_MODEL_BYTES, read_bytes
from hri.fusion import RULES, FusionOptions, LearnedFusion
from hri.language import Grammar, KnowledgeBase
from hri.language.knowledge import MAX_DISTANCE
from hri.recognition import (
    CommandRecognizer,
    ConnectedWordRecognizer,
    GestureRecognizer,
    SentenceRecognizer,
    WordRecognizer,
)
from hri.recognition.sentence.commands import MIN_CONFIDENCE
from hri.robot import BACKENDS, JointTable, NaoqiRobot, Robot, open_robot
from hri.session import LabelMotions, Session, SessionOptions, read_motions
from hri.vision.faces import face_finder

if TYPE_CHECKING:
    from hri.vision import FaceFinder

model_file = click.Path(exists=True, dir_okay=False, path_type=Path)
_NO_ROBOT = "none"
_GO_WITH = {
    "min_confidence": ("--min-confidence", "grammar_path", "--grammar"),
    "max_distance": ("--max-distance", "knowledge_path", "--knowledge"),
    "language": ("--language", "knowledge_path", "--knowledge"),
}
"""Options without effect unless another one is given."""

_OPTIONS = (
    click.option(
        "--speech-model", type=model_file, help="From 'hri train speech'; the default is the one kept per user."
    ),
    embedding_option,
    click.option(
        "--grammar",
        "grammar_path",
        type=model_file,
        metavar="JSGF",
        help="Commands of several words with slots; --speech-model is then from 'hri train-connected'.",
    ),
    click.option(
        "--min-confidence",
        type=FiniteRange(0, 1),
        default=MIN_CONFIDENCE,
        show_default=True,
        metavar="P",
        help="With --grammar: less sure commands are unknown.",
    ),
    click.option(
        "--gesture-model",
        type=model_file,
        help="The same for gestures; or from 'hri train-sentences': signs then follow on one another in sentences.",
    ),
    faces_option("as the model was trained"),
    click.option("--no-speech", is_flag=True, help="Signs only: use no microphone."),
    click.option("--no-gesture", is_flag=True, help="Words only: use no camera."),
    click.option("--wake", multiple=True, metavar="LABEL", help="Take commands only after this word or sign."),
    click.option("--stop", "stops", multiple=True, default=("stop",), show_default=True, help="A label that stops."),
    click.option(
        "--stop-threshold", type=float, metavar="P", help="Confidence from which STOP is sure; else the model's."
    ),
    click.option(
        "--stop-at-rest",
        type=FiniteRange(0, 1),
        default=SessionOptions.stop_at_rest,
        show_default=True,
        metavar="P",
        help="While nothing moves, a spoken STOP less sure than this is asked about; 0.99 in talk, by cepstra.",
    ),
    click.option(
        "--imitate",
        multiple=True,
        metavar="LABEL",
        help="From this word or sign on the arms move as yours do, until no or STOP.",
    ),
    click.option("--resume", multiple=True, metavar="LABEL", help="A word or sign that ends STOP."),
    click.option(
        "--sentence-begin", multiple=True, metavar="LABEL", help="From this word or sign on comes a sentence."
    ),
    click.option("--sentence-end", multiple=True, metavar="LABEL", help="It ends with this one, and is said."),
    click.option(
        "--knowledge",
        "knowledge_path",
        type=model_file,
        metavar="CSV",
        help="Stored sentences, of which the nearest is said: columns signs, en, hi, ..., and answer: gestures in "
        "return.",
    ),
    click.option(
        "--max-distance",
        type=FiniteRange(0, 1),
        default=MAX_DISTANCE,
        show_default=True,
        help="Words farther from every stored sentence are none of them.",
    ),
    click.option(
        "--language", default="en", show_default=True, help="Of what stored sentences say, and of a voice that speaks."
    ),
    click.option(
        "--confirm-below", type=float, default=0.5, show_default=True, help="Ask for what is less sure; 1: always."
    ),
    click.option(
        "--window", "window_s", type=float, default=1.25, show_default=True, help="Seconds between word and sign."
    ),
    click.option("--rule", type=click.Choice(RULES), default=RULES[0], show_default=True, help="How both are fused."),
    click.option(
        "--fusion", "fusion_path", type=model_file, metavar="FILE", help="A learned fusion, in place of --rule."
    ),
    click.option(
        "--backend",
        type=click.Choice((*BACKENDS, _NO_ROBOT)),
        default="pybullet",
        show_default=True,
        help="The robot with physics, without, or no robot.",
    ),
    click.option(
        "--motions",
        "motions_path",
        type=model_file,
        metavar="TOML",
        help='What the robot does for labels that are no gestures: a line each, as in pinch = "small".',
    ),
    click.option("--stand", is_flag=True, help="The robot stands on its feet and can walk (pybullet)."),
    robot_option,
)


@dataclass
class ChosenSession:
    """Values of the common options; `model_ids` are the names and hashes of the files that were loaded."""

    speech_model: Path | None
    embedding_path: str | None
    grammar_path: Path | None
    min_confidence: float
    gesture_model: Path | None
    faces: str | None
    no_speech: bool
    no_gesture: bool
    wake: tuple[str, ...]
    stops: tuple[str, ...]
    stop_threshold: float | None
    stop_at_rest: float
    imitate: tuple[str, ...]
    resume: tuple[str, ...]
    sentence_begin: tuple[str, ...]
    sentence_end: tuple[str, ...]
    knowledge_path: Path | None
    max_distance: float
    language: str
    confirm_below: float
    window_s: float
    rule: str
    fusion_path: Path | None
    backend: str
    motions_path: Path | None
    stand: bool
    table: JointTable
    model_ids: dict[str, str] = field(default_factory=dict, init=False)

    def session_options(self, **more: Any) -> SessionOptions:
        """Of the session; `more` are fields of it that are not common."""
        return SessionOptions(
            self.window_s,
            rule=self.rule,
            fusion=FusionOptions(stop_labels=self.stops, stop_threshold=self.stop_threshold),
            stop_at_rest=self.stop_at_rest,
            wake_labels=self.wake,
            resume_labels=self.resume,
            imitate_labels=self.imitate,
            sentence_begin_labels=self.sentence_begin,
            sentence_end_labels=self.sentence_end,
            language=self.language,
            confirm_below=self.confirm_below,
            **more,
        )

    def warn_of_stop(self, *recognizers: Any) -> None:
        """Warn of a --stop that nothing can say or show, and where nothing at all stops the robot."""
        labels = {str(label) for one in recognizers if one is not None for label in one.classes_}
        unknown = [label for label in self.stops if label not in labels]
        named, there_are = " or ".join(unknown), f"there are {', '.join(sorted(labels))}"
        if len(unknown) == len(self.stops):
            note(f"WARNING: no word or sign stops the robot: none is {named}; choose by --stop, {there_are}")
        elif unknown:
            note(f"WARNING: no word or sign is {named}, as --stop asks; {there_are}")

    def load_words(self) -> WordRecognizer | CommandRecognizer:
        """What recognises words, or commands of several words by a grammar, whose name and hash are part of the id."""
        embedding = load_embedding(self.embedding_path)
        if self.grammar_path is None:
            return WordRecognizer.load(self._named("speech", self.speech_model), embedding=embedding)
        grammar = Grammar.load(self.grammar_path)
        named = self._named("speech", self.speech_model or connected_model())
        words = ConnectedWordRecognizer.load(named, embedding=embedding)
        try:
            commands = CommandRecognizer(words, grammar, min_confidence=self.min_confidence)
        except InvalidArgument as error:
            raise InvalidArgument(f"{self.grammar_path}: {error}") from error
        self.model_ids["speech"] += f" {_name_and_hash(self.grammar_path)} from {self.min_confidence:g}"
        return commands

    def load_signs(self) -> GestureRecognizer | SentenceRecognizer:
        """What recognises gestures, or signed sentences."""
        signs = load_signs(self._named("gesture", self.gesture_model))
        look_for_faces(signs, self.faces)
        if self.faces is not None:
            cascade = self.faces if self.faces in ("auto", "never") else _name_and_hash(Path(self.faces))
            self.model_ids["gesture"] += f" faces {cascade}"
        return signs

    def person_finder(self) -> FaceFinder | None:
        """What finds the person who is imitated or signs sentences; None for what a session takes by default."""
        if self.faces == "never" and self.imitate:
            raise click.UsageError("--faces never: --imitate needs the face of the person")
        found: FaceFinder | None = None if self.faces in (None, "auto", "never") else face_finder(self.faces)
        return found

    def load_fusion(self) -> LearnedFusion | None:
        """The learned fusion, if any."""
        return None if self.fusion_path is None else self._load(LearnedFusion, "fusion", self.fusion_path)

    def load_knowledge(self, words: Any, signs: Any) -> KnowledgeBase | None:
        """Stored sentences, if any; how near words must be to them is part of the id.

        Warns of words that neither recogniser knows.
        """
        if self.knowledge_path is None:
            return None
        self.model_ids["knowledge"] = f"{_name_and_hash(self.knowledge_path)} within {self.max_distance:g}"
        stored = KnowledgeBase.read(self.knowledge_path, self.max_distance)
        warn_of_stored(stored, (words, signs), self.knowledge_path)
        return stored

    def require_sentences(self, signs: Any) -> None:
        """Refuse --knowledge where no sentence can begin."""
        if self.knowledge_path is not None and not (self.sentence_begin or isinstance(signs, SentenceRecognizer)):
            raise click.UsageError(
                "--knowledge needs --sentence-begin and --sentence-end, or a --gesture-model by 'hri train-sentences'"
            )

    def load_motions(self) -> LabelMotions | None:
        """What the robot does for labels that are named in a file, if any."""
        return None if self.motions_path is None else read_motions(self.motions_path, self.table)

    def note_motions(self, session: Session, motions: LabelMotions | None) -> None:
        """Say for which labels the robot has no motion, and which of `motions` it never makes."""
        for label, why in session.refused.items():
            note(f"no motion for {label}: {why}")
        idle = [label for label in motions or () if label not in session.motions and label not in session.refused]
        own = {*session.options.control_labels, *session.options.fusion.stop_labels}
        unknown = [label for label in idle if label not in own]
        if unknown:
            note(f"WARNING: {self.motions_path}: no word or sign is {' or '.join(unknown)}")
        for label in (label for label in idle if label in own):
            note(f"WARNING: {self.motions_path}: {label} moves nothing: the dialogue has a use of its own for it")

    def open_robot(self, gui: bool = False, url: str | None = None) -> Robot | None:
        """The real NAO at `url`, or the simulated robot, to be closed; None where there is to be none."""
        if url is not None:
            return NaoqiRobot(url)
        if self.backend == _NO_ROBOT:
            return None
        return open_robot(self.backend, gui=gui, fixed_base=not self.stand, table=self.table)

    def _load(self, kind: type[Any], mode: str, path: Path | None) -> Any:
        """The recogniser or fusion in a model file."""
        return kind.load(self._named(mode, path))

    def _named(self, mode: str, path: Path | None) -> Path:
        """The model file, whose name and hash are kept."""
        chosen = path or kept_model(mode)
        self.model_ids[mode] = _name_and_hash(chosen)
        return chosen


def session_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add the common options to a command, which gets them as `chosen`."""
    names = [one.name for one in fields(ChosenSession) if one.init]

    @functools.wraps(command)
    def collected(**given: Any) -> None:
        for name, (option, needed, needed_option) in _GO_WITH.items():
            speaks = name == "language" and given.get("speak", False)
            if is_given(name) and given[needed] is None and not speaks:
                raise click.UsageError(f"{option} goes with {needed_option}")
        if bool(given["sentence_begin"]) != bool(given["sentence_end"]):
            raise click.UsageError("--sentence-begin and --sentence-end go together")
        if given["no_speech"]:
            refuse_given(("embedding_path",), "is for words, which --no-speech leaves out")
        if given["faces"] is not None and given["no_gesture"]:
            raise click.UsageError("--faces and --no-gesture exclude each other")
        if given["fusion_path"] is not None:
            refuse_given(("rule",), "has no effect: --fusion takes its place")
        if given["backend"] == _NO_ROBOT and given.get("url") is None:
            robots = ("motions_path", "stand", "gui", "table", "imitate")
            refuse_given(robots, "has no effect without a robot, as --backend none has it")
        command(chosen=ChosenSession(**{name: given.pop(name) for name in names}), **given)

    for option in reversed(_OPTIONS):
        collected = option(collected)
    return collected


def refuse_unused(with_speech: bool, with_gesture: bool) -> None:
    """Refuse options of words where nothing is heard, and of signs where nothing is seen."""
    if not with_speech:
        names = ("speech_model", "embedding_path", "grammar_path", "microphone_name")
        refuse_given(names, "is of words, and nothing is heard")
    if not with_gesture:
        refuse_given(("gesture_model", "faces", "camera_name"), "is of signs, and nothing is seen")
        refuse_given(("imitate",), "is of the arms of a person who is seen, and nothing is seen")


def _name_and_hash(path: Path) -> str:
    return f"{path.name}:{hashlib.sha256(read_bytes(path, MAX_MODEL_BYTES)).hexdigest()[:12]}"
