# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The session behind the page, in a thread of its own: it outlives connections, and begins anew with a new word."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import ExitStack, closing
from typing import Any

from hri.core.errors import Error, InvalidArgument
from hri.core.phrases import phrase, phrase_of
from hri.fusion import LearnedFusion
from hri.language import Grammar, KnowledgeBase
from hri.live import AudioSource, Event, FrameSource
from hri.page import figure
from hri.recognition import (
    CommandRecognizer,
    ConnectedWordRecognizer,
    GestureRecognizer,
    SentenceRecognizer,
    WordRecognizer,
)
from hri.robot import Robot
from hri.serve.devices import PageCamera, PageMicrophone
from hri.serve.limits import ServeLimits
from hri.serve.messages import with_phrases
from hri.serve.recordings import Recording, Spoken, require_recordings_of
from hri.serve.seen import SeenHands
from hri.serve.voice import PageVoice
from hri.serve.welcome import known_by, learns_gestures, sentences_of
from hri.session import Session, SessionOptions, SessionRecorder, Voice
from hri.session.dialogue import ACTING, IDLE, STOPPED
from hri.session.live import PASSING
from hri.session.logic import BY_BUTTON, MOTION_END, MOTION_START, REST, SAY, SENTENCE, STOP
from hri.session.mover import Motion
from hri.vision.persons import Faces

_MOST_KEPT = 60
_CLOSE_S = 8.0
_LOGGED = frozenset(
    ("fused", "sentence", "say", "ignored", "stop", "rest", "resumed", "motion_start", "motion_end", "halt", "stall")
)

Publish = Callable[[dict[str, Any]], None]


class Stage:
    """A session that is fed by a page.

    Parameters
    ----------
    words : WordRecognizer or CommandRecognizer, optional
        To words of a `WordRecognizer` the page may add others; of a `CommandRecognizer` it may change the grammar, and
        add words with `recordings`.
    signs : GestureRecognizer or SentenceRecognizer, optional
        To the gestures of a `GestureRecognizer` the page may add others.
    robot : Robot, optional
        Left open.
    options : SessionOptions, optional
    motions : mapping of str to Trajectory or Guided, optional
        As of `Session`.
    limits : ServeLimits, optional
    model_ids : mapping of mode to str, optional
    fusion : LearnedFusion, optional
    knowledge : KnowledgeBase, optional
    faces : FaceFinder, optional
        As of `Session`, all three.
    recordings : sequence of Recording, optional
        What the words of a `CommandRecognizer` were trained on, as ``hri.datasets.Dataset.samples``, with
        `unknown_words`: the page may add words then.
    spoken : callable without arguments, optional
        Says the words again that synthetic voices said in training, and gives what `speak` gives; called once, when it
        is needed.
    spoken_labels : collection of str
        The words that `spoken` says.
    speak : callable of str, optional
        Has synthetic voices say a word that is added so: clips, labels and names of voices, as
        `hri.synthetic.speech.speak_words` gives them. Others than who added the word are understood then, too.
    hear, see : callable that opens a source, optional
        In place of the page's microphone and camera, as NAO's; the page's are then used to add words and gestures only.
    voice : Voice, optional
        As of `Session`.
    record : callable without arguments, optional
        Gives a recorder for each session; the page begins a new one with a word that is added, and after an error.

    Raises
    ------
    InvalidArgument
        As `Session`; for recordings of other words than the model's, and of a model without `unknown_words`.

    Attributes
    ----------
    publish : callable
        Gets messages for the page, by several threads; it must not wait.
    on_stop : callable
        Called on STOP by whatever way, by several threads; it must not wait.
    teaching_state : callable
        Gives how far words and gestures are that are being added, by mode.
    page_voice : PageVoice
        What the page says aloud.
    """

    def __init__(
        self,
        words: WordRecognizer | CommandRecognizer | None = None,
        signs: GestureRecognizer | SentenceRecognizer | None = None,
        robot: Robot | None = None,
        options: SessionOptions | None = None,
        *,
        motions: Mapping[str, Motion] | None = None,
        limits: ServeLimits | None = None,
        model_ids: Mapping[str, str] | None = None,
        fusion: LearnedFusion | None = None,
        knowledge: KnowledgeBase | None = None,
        faces: Faces | None = None,
        recordings: Sequence[Recording] | None = None,
        spoken: Callable[[], Spoken] | None = None,
        spoken_labels: Collection[str] = (),
        speak: Callable[[str], Spoken] | None = None,
        hear: Callable[[], AudioSource] | None = None,
        see: Callable[[], FrameSource] | None = None,
        voice: Voice | None = None,
        record: Callable[[], SessionRecorder] | None = None,
    ) -> None:
        self.words, self.signs = words, signs
        self.recordings, self.say_again, self.speak = recordings, spoken, speak
        self._first_vocabulary = self.vocabulary
        if recordings is not None:
            require_recordings_of(words, recordings, spoken_labels)
        elif spoken is not None:
            raise InvalidArgument("spoken words go with recordings of the others")
        self.limits = limits or ServeLimits()
        self.microphone = PageMicrophone(self.limits.stall_s)
        self.camera = PageCamera(self.limits.stall_s, self._refused)
        self.page_voice = PageVoice(self.limits.voice_s)
        self.publish: Publish = lambda message: None
        self.on_stop: Callable[[], None] = lambda: None
        self.teaching_state: Callable[[], dict[str, Any]] = dict
        self._robot = robot
        self._options = options or SessionOptions(retry_s=0.2)
        self._model_ids = dict(model_ids or {})
        self._motions, self._fusion, self._knowledge, self._faces = motions, fusion, knowledge, faces
        self._hear, self._see, self._page_sees = hear or self.microphone.stream, see or self.camera.stream, see is None
        self._voice, self._record = voice, record
        self._session = self._made()
        self._log: deque[dict[str, Any]] = deque(maxlen=_MOST_KEPT)
        self._num_logged = time.time_ns() // 1_000_000  # above all numbers of a server before this one
        self._logging = threading.Lock()
        self._state = IDLE
        self._imitating = False
        self._begun_s = 0.0
        self._only_stop_until_s = 0.0
        self._joints: dict[str, float] = {}
        self._figure: dict[str, Any] | None = None
        self._paused = self._held = False
        self._num_resumed = 0
        self._num_pressed = self._num_heeded = 0
        self._asking = threading.Lock()
        self._heard: Session | None = None
        self._imitate_first = False
        self._closed = threading.Event()
        self._wanted = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True, name="hri-stage")
        self._thread.start()

    @property
    def session(self) -> Session:
        """The session that runs, or the next one."""
        return self._session

    @property
    def moving(self) -> bool:
        """Whether the robot carries out a command."""
        return self._state == ACTING

    def arrive(self) -> None:
        """A page takes its place: what was stopped only because there was none goes on."""
        if self._paused and not self._held:
            self.resume()
        self._wanted.set()

    def leave(self) -> None:
        """The page is gone: nothing moves without one. A motion that this ended keeps the robot stopped."""
        self.microphone.lose()
        self.camera.lose()
        if self.moving:
            self.stop()
            self._report(phrase("gone_in_motion"))
        else:
            self._paused = True
            self._session.stop()

    def stop(self) -> None:
        """STOP, at once, until a person ends it; by any thread."""
        self._held = True
        self._num_pressed += 1
        self._session.stop()
        self.on_stop()

    def only_stop(self, for_s: float) -> None:
        """Nothing but STOP counts for so long, also in a session that begins meanwhile; the last call counts."""
        self._only_stop_until_s = time.monotonic() + for_s
        self._session.only_stop(for_s)

    def imitate(self) -> None:
        """Begin to imitate unless stopped, also where the session is about to begin; by any thread."""
        with self._asking:
            if self._heard is self._session:
                self._session.imitate()
            else:
                self._imitate_first = self._wanted.is_set() and not self._held

    def resume(self) -> None:
        """End STOP; by any thread."""
        self._held = self._paused = self._imitate_first = False
        self._num_resumed += 1
        if not self._wanted.is_set():  # no session runs that could
            self._free()
        self._session.resume()
        self._wanted.set()

    def close(self) -> None:
        """The robot rests, and the session ends; returns in bounded time."""
        self._closed.set()
        self._session.stop()
        self.microphone.lose()
        self.camera.lose()
        self._wanted.set()
        self._thread.join(_CLOSE_S)

    @property
    def spoken(self) -> WordRecognizer | None:
        """What recognises words one by one; None where there is nothing, or commands of several words."""
        return self.words if isinstance(self.words, WordRecognizer) else None

    @property
    def vocabulary(self) -> WordRecognizer | ConnectedWordRecognizer | None:
        """What knows the words, and to which the page may add others; None where it may not."""
        if isinstance(self.words, CommandRecognizer):
            return None if self.recordings is None else self.words.words
        return self.words

    @property
    def grammar(self) -> Grammar | None:
        """Whose sentences are the commands, where they are of several words."""
        return self.words.grammar if isinstance(self.words, CommandRecognizer) else None

    @property
    def gestures(self) -> GestureRecognizer | None:
        """What recognises single gestures, where signs are not of sentences."""
        return self.signs if isinstance(self.signs, GestureRecognizer) else None

    def welcome(self) -> dict[str, Any]:
        """What a page that comes needs to know."""
        return {
            "type": "welcome",
            "state": self._state,
            "has_samples": self.recordings is not None and self.vocabulary is not self._first_vocabulary,
            **known_by(self.words, self.signs),
            "teach": [
                *(["speech"] if self.vocabulary is not None else []),
                *(["gesture"] if learns_gestures(self.gestures) else []),
            ],
            "teaching": self.teaching_state(),
            "sentences": sentences_of(self._options, self.signs, self._knowledge),
            "imitate": list(self._imitated),
            "imitating": self._imitating,
            "robot": self._robot.table.name if self._robot is not None else "",
            "motions": sorted(self._session.motions),
            "refused": self._session.refused,
            "log": [with_phrases(message) for message in self._log.copy()],
        }

    @property
    def _imitated(self) -> tuple[str, ...]:
        """Labels from which on the robot imitates."""
        return self._options.imitate_labels if self._robot is not None else ()

    def figure(self) -> dict[str, Any] | None:
        """The robot as a page draws it, the same object while it rests; None without one."""
        if self._robot is None:
            return None
        joints = self._robot.known_positions_rad()  # a real one that does not answer must not keep the page waiting
        if self._figure is None or joints != self._joints:
            self._joints, self._figure = joints, {"type": "robot", **figure(joints, self._robot.table)}
        return self._figure

    def command_by(self, grammar: Grammar) -> None:
        """Take the sentences of another grammar as commands.

        Raises
        ------
        InvalidArgument
            For a grammar that `CommandRecognizer` refuses, where there are no commands of several words, for a label of
            the options that would be none any more, and while the robot moves. The commands are as before then.
        """
        before = self.words
        if not isinstance(before, CommandRecognizer):
            raise InvalidArgument("there are no commands of several words")
        self.words = CommandRecognizer(before.words, grammar, min_confidence=before.min_confidence)
        try:
            self.renew()
        except Error:
            self.words = before
            raise

    def renew(self) -> None:
        """Begin a new session, as the vocabulary has changed.

        Raises
        ------
        InvalidArgument
            While the robot moves.
        """
        if self.moving:
            raise InvalidArgument(phrase("wait_for_rest"))
        self._session = self._made()
        self.publish(self.welcome())

    def _made(self) -> Session:
        return Session(
            self.words,
            self.signs,
            self._robot,
            self._options,
            motions=self._motions,
            model_ids=self._model_ids,
            fusion=self._fusion,
            knowledge=self._knowledge,
            faces=self._faces,
            on_result=SeenHands(lambda message: self.publish(message)).heed,
            voice=self._voice,
        )

    def _refused(self, text: str) -> None:
        self.publish({"type": "error", "text": text})

    def _report(self, text: str) -> None:
        self.publish(self._logged({"type": "note", "text": text}))

    def _logged(self, message: dict[str, Any]) -> dict[str, Any]:
        """Keep a message for pages that come; by its running number they know what they have."""
        with self._logging:
            self._num_logged += 1
            message["log_number"] = self._num_logged
            self._log.append(message)
        return message

    def _report_failure(self, recorder: SessionRecorder | None) -> None:
        """Why a session was not recorded, if so."""
        failure = getattr(recorder, "failure", "")
        if failure:
            self._report(phrase("not_recorded", detail=failure))

    def _free(self) -> None:
        """Let the robot move again; STOP wins when both come at once."""
        if self._robot is not None:
            self._robot.resume()
            if self._held or self._paused:
                self._robot.stop()
        self.publish({"type": "event", "event": "resumed"})

    def _run(self) -> None:
        while not self._closed.is_set():
            self._wanted.wait()
            if self._closed.is_set():
                return
            session, num_resumed, self._heard = self._session, self._num_resumed, None
            try:
                self._play(session)
            except Error as error:
                if self._closed.is_set():
                    return
                self._wanted.clear()
                stopped = self._robot is not None and self._robot.stopped
                refused = isinstance(error, InvalidArgument) and stopped
                if refused and self._num_resumed != num_resumed and not (self._held or self._paused):
                    self._free()  # stopped and resumed while the session was about to begin
                    self._wanted.set()
                    continue
                if not refused:
                    self.stop()
                    self._report(phrase("session_ended", detail=phrase_of(error)))
                self._show_state(STOPPED)

    def _play(self, session: Session) -> None:
        self.microphone.expect()
        self.camera.expect()
        hear: Any = self._hear if self.words is not None else None
        see: Any = self._see if self.signs is not None else None
        recorder = None if self._record is None else self._record()
        self._num_heeded = self._num_pressed  # those of before are not the session's
        run = session.run(hear, see, live=True, recorder=recorder)
        with ExitStack() as stack:
            stack.callback(self._report_failure, recorder)  # once it has ended
            events = stack.enter_context(closing(run))  # type: ignore[type-var]
            self._begun_s = time.monotonic()
            with self._asking:  # what a session was asked for before it runs is lost
                self._heard = session
                self.page_voice.attach(session)
                if self._imitate_first and not (self._held or self._paused):
                    session.imitate()
                self._imitate_first = False
            if self._only_stop_until_s > self._begun_s:
                session.only_stop(self._only_stop_until_s - self._begun_s)
            self._show_state(IDLE)
            for event in events:
                self._heed(event)
                if self._closed.is_set() or session is not self._session:
                    return

    def _show_state(self, state: str) -> None:
        self._state = state
        self._show_imitation(False)
        self.publish({"type": "event", "event": "state", "state": state})

    def _show_imitation(self, on: bool) -> None:
        if on != self._imitating:
            self._imitating = on
            self.publish({"type": "imitation", "on": on})

    def _heed(self, event: Event) -> None:
        message = {"type": "event", "passing": event.event in PASSING, **event.to_dict()}
        if event.event == "state":
            self._state = event.fields["state"]
        elif event.event == "stop" and event.fields["reason"] != BY_BUTTON:  # said, shown, or a fault
            self._held = True
            self.on_stop()
        elif event.event == "stop":
            self._num_heeded = min(self._num_heeded + 1, self._num_pressed)
        elif event.event == "resumed" and self._num_heeded == self._num_pressed:  # else STOP was pressed again since
            self._held = self._paused = False
        if event.event in (MOTION_START, MOTION_END, STOP, REST):  # at STOP it is over, though the arms still brake
            self._show_imitation(event.event == MOTION_START and event.fields["label"] in self._imitated)
        if event.mode == "gesture" and "nbest" in event.fields and self._page_sees:
            sent_ms = self.camera.sent_ms(self._begun_s + event.time)
            if sent_ms is not None:
                message["sent_ms"] = sent_ms
        if event.event == SAY:
            message["aloud"] = self._session.aloud(event.fields["text"])
        if event.event == SENTENCE and self._knowledge is not None:
            message["max_distance"] = self._knowledge.max_distance
        self.publish(self._logged(message) if event.event in _LOGGED else message)
