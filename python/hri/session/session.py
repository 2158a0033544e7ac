# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A live session: sources, recognisers, the dialogue and a robot joined."""

from __future__ import annotations

import math
import threading
import time
from collections import deque
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import ExitStack, closing, contextmanager
from dataclasses import asdict, replace
from numbers import Real
from typing import Any

from hri.core.errors import Error, InvalidArgument
from hri.fusion import LearnedFusion
from hri.language import KnowledgeBase
from hri.live import AudioSource, Event, FrameSource, HandFrames
from hri.recognition import (
    CommandRecognizer,
    GestureRecognizer,
    GestureSegmenterOptions,
    SentenceRecognizer,
    SentenceStreamOptions,
    WordRecognizer,
)
from hri.robot import Robot, Trajectory
from hri.session.feeds import Arrival, Clock, Feed, SessionRecorder, closing_unread_if_refused, merge
from hri.session.hearing import listener_of, pausing_endpointer_of
from hri.session.imitation import ImitatingTap, Imitator
from hri.session.live import EventQueue, LiveFeeds
from hri.session.logic import ASKED, IMITATE, ONLY_STOP, REST, STOP, TICK, Body, NoRobot, SessionLogic, session_event
from hri.session.motions import prepared_motions, vocabulary_of
from hri.session.mover import Guided, Motion, Mover
from hri.session.options import SessionOptions
from hri.session.voice import Voice, aloud
from hri.session.watching import OnResult, watcher_of
from hri.signal import EndpointerOptions
from hri.vision.persons import Faces

SoundSource = AudioSource | Callable[[], AudioSource]
PictureSource = FrameSource | Callable[[], FrameSource]

_POLL_S = 0.02
_TICK_S = 1.0
_CLOSE_S = 5.0


class Session:
    """A person commands by word and sign, the robot answers.

    Parameters
    ----------
    words : WordRecognizer or CommandRecognizer, optional
        Trained or loaded; needed for sound.
    signs : GestureRecognizer or SentenceRecognizer, optional
        Trained or loaded; needed for pictures. Of a `SentenceRecognizer` each signed sentence is decided on as one.
    robot : Robot, optional
        Moved by `run`, and left open. Without one nothing moves, and every command counts as carried out.
    options : SessionOptions, optional
    motions : mapping of str to Trajectory or Guided, optional
        What the robot does for a label; by default what the slots of a command say (`hri.robot.command_trajectory`), or
        the gesture of the same name; `LabelMotions` are of their labels only, and the others have that. Those that the
        robot cannot make are left out, and `refused` says why.
    endpointer : EndpointerOptions, optional
        When a word begins and ends, and after which pause in it STOP counts; see `hri.live.Listener`.
    segmenter : GestureSegmenterOptions or SentenceStreamOptions, optional
    hands : HandFrames, optional
        When a gesture, or a signed sentence, begins and ends, and what a `SentenceRecognizer` gets of the pictures; see
        `hri.live.Watcher` and `SignWatcher`.
    on_result : callable, optional
        Gets every `FrameResult` in the thread that watches, as that of `hri.live.Watcher` does; it must not wait.
    on_say : callable of str, optional
        Gets what the robot says, in the thread that decides; it must not wait.
    voice : Voice, optional
        Says it, STOP in other words, and is left open. While it speaks in a live session nothing spoken counts but a
        sure STOP, and while the robot moves any STOP.
    model_ids : mapping of mode to str, optional
        Which models decide, which learned fusion ("fusion") and stored sentences ("knowledge"); passed on with
        decisions.
    fusion : LearnedFusion, optional
        Fuses words and signs in place of ``options.rule``.
    faces : FaceFinder, optional
        Finds who is imitated, or whose hands make tracks for a `SentenceRecognizer`; by default OpenCV's cascade.
    knowledge : KnowledgeBase, optional
        What the robot says at the end of a sentence (signed, or by ``options.sentence_end_labels``) and answers with.

    Attributes
    ----------
    refused : dict of str to str
        Labels of the vocabulary, and of answers, that the robot has no motion for, and why.

    Raises
    ------
    InvalidArgument
        Without any recogniser, for a label of the options that neither knows, for stored sentences where no label
        begins one and none are signed, for options of another kind of signs, and as of `SignWatcher`.
    NotFittedError
        For a recogniser or a fusion that is not trained.
    """

    def __init__(
        self,
        words: WordRecognizer | CommandRecognizer | None = None,
        signs: GestureRecognizer | SentenceRecognizer | None = None,
        robot: Robot | None = None,
        options: SessionOptions | None = None,
        *,
        motions: Mapping[str, Motion] | None = None,
        endpointer: EndpointerOptions | None = None,
        segmenter: GestureSegmenterOptions | SentenceStreamOptions | None = None,
        hands: HandFrames | None = None,
        on_say: Callable[[str], None] | None = None,
        on_result: OnResult | None = None,
        voice: Voice | None = None,
        model_ids: Mapping[str, str] | None = None,
        fusion: LearnedFusion | None = None,
        faces: Faces | None = None,
        knowledge: KnowledgeBase | None = None,
    ) -> None:
        if words is None and signs is None:
            raise InvalidArgument("a session needs a recogniser of words or of gestures")
        self.options = options or SessionOptions()
        self._robot = robot
        self._on_say, self._voice, self._segmenter = on_say, voice, segmenter
        self._labels = vocabulary_of(words, signs)
        # Words of a signed sentence are no commands.
        self._command_labels = vocabulary_of(words, None if isinstance(signs, SentenceRecognizer) else signs)
        chosen = self.options
        for label in (*chosen.wake_labels, *chosen.resume_labels, *chosen.imitate_labels, *chosen.sentence_labels):
            if label not in self._labels:
                raise InvalidArgument(f"{label!r} is in no vocabulary: {', '.join(sorted(self._labels))}")
        self._heard_stops = vocabulary_of(words).intersection(chosen.fusion.stop_labels)
        self._fusion = fusion
        self._model_ids = ids = dict(model_ids or {})
        if fusion is not None:
            _ = fusion.reliability_  # refuses one that is not trained now
            ids.setdefault("fusion", fusion.kind)
        self._knowledge = knowledge
        if knowledge is not None:
            if not (chosen.sentence_begin_labels or isinstance(signs, SentenceRecognizer)):
                raise InvalidArgument("knowledge: stored sentences need labels that begin and end one")
            ids.setdefault("knowledge", f"{len(knowledge.sentences)} sentences")
        self._slots = words.commands_ if isinstance(words, CommandRecognizer) else {}
        self._listener, self._endpointer = None, endpointer
        if words is not None:
            self._endpointer = endpointer or pausing_endpointer_of(words)
            self._listener = listener_of(words, self._endpointer, chosen, ids.get("speech", ""))
        self._whole_sentences = isinstance(signs, SentenceRecognizer)
        parts = (segmenter, hands, faces, ids.get("gesture", ""), on_result)
        self._watcher = None if signs is None else watcher_of(signs, *parts)
        self._imitator: Imitator | None = None
        if self.options.imitate_labels and robot is not None:
            if signs is None:
                raise InvalidArgument("imitation needs pictures, and with them a recogniser of gestures")
            self._imitator = Imitator(robot.table, faces)
        self.refused: dict[str, str] = {}
        self._motions = self._prepared(motions)
        self._inbox: EventQueue | deque[Event] = deque(maxlen=64)
        self._asking = threading.RLock()  # a signal may ask while its thread does
        self._running = threading.Lock()

    @property
    def motions(self) -> dict[str, Motion]:
        """What the robot does for each label."""
        return dict(self._motions)

    def run(
        self,
        sound: SoundSource | None = None,
        pictures: PictureSource | None = None,
        *,
        live: bool = False,
        recorder: SessionRecorder | None = None,
    ) -> Iterator[Event]:
        """Events until all sources end; sources and threads are closed then, and also when the caller stops early.

        Parameters
        ----------
        sound, pictures : source, or callable that opens one
            One that vanishes leaves the other mode working. It comes back if a callable opens it again.
        live : bool
            The sources are devices: each has a thread, and a caller that is slow misses events and makes nothing wait.
            Otherwise time is that of samples and pictures, and the same recordings give the same events.
        recorder : SessionRecorder, optional

        Raises
        ------
        InvalidArgument
            Without a source, for a source without a recogniser, and for a robot that is stopped; from the first event,
            when this session, its robot or its recorder is in use.
        IoError
            When a recording cannot be opened.
        """
        self._feeds(sound, pictures, None, recorder)  # refuses what is missing now
        with self._asking:
            if not self._running.locked():
                self._inbox = deque(maxlen=64)  # without what was asked for before; STOP from now on is not lost
        if self._robot is not None and self._robot.stopped:
            raise InvalidArgument("the robot is stopped: call its resume() first")
        return self._run_live(sound, pictures, recorder) if live else self._run(sound, pictures, recorder)

    def stop(self) -> None:
        """STOP, as by a button: at once, from any thread."""
        if self._robot is not None:
            self._robot.stop()
        self._ask(STOP)

    def resume(self) -> None:
        """End STOP; from any thread."""
        self._ask("resume")

    def only_stop(self, for_s: float) -> None:
        """Ignore what begins within so long from now, except STOP; the last call counts; from any thread.

        Raises InvalidArgument for a time that is negative or not finite.
        """
        given: object = for_s
        if not isinstance(given, Real) or not (math.isfinite(for_s) and for_s >= 0):
            raise InvalidArgument(f"for_s must be 0 or more and finite, got {for_s!r}")
        self._ask(ONLY_STOP, for_s=for_s)

    def imitate(self) -> None:
        """Begin to imitate, as after the first of ``options.imitate_labels``, unless stopped; from any thread."""
        self._ask(IMITATE)

    def rest(self) -> None:
        """End the motion under way, as "no" does; from any thread."""
        self._ask(REST)

    def _ask(self, command: str, **fields: float) -> None:
        self._put(session_event(0.0, ASKED, command=command, **fields))

    def voiced(self, kind: str, text: str, message: str = "") -> None:
        """A voice begins or ends ("voice_start", "voice_end") to say a text, as `Voice.attach` has it; from any thread.

        For voices other than `voice`, such as a page's. Their texts should be as `aloud` gives them.
        """
        self._put(session_event(0.0, kind, text=text, message=message))

    def aloud(self, text: str) -> str:
        """What a voice is to say of what the robot says: no word of it is one that stops the robot when it is heard."""
        return aloud(text, self._heard_stops)

    def _put(self, event: Event) -> None:
        with self._asking:
            if isinstance(self._inbox, EventQueue):
                self._inbox.put(event)
            else:
                self._inbox.append(event)

    def _deliver_to(self, queue: EventQueue) -> None:
        """Put what was asked for since `run`, and what is from now on, in this queue."""
        with self._asking:
            waiting, self._inbox = self._inbox, queue
            assert isinstance(waiting, deque)
            for event in waiting:
                queue.put(event)

    def _feeds(
        self,
        sound: SoundSource | None,
        pictures: PictureSource | None,
        clock: Clock | None,
        recorder: SessionRecorder | None,
    ) -> list[Feed[Any]]:
        if sound is None and pictures is None:
            raise InvalidArgument("a session needs a source of sound or of pictures")
        feeds: list[Feed[Any]] = []
        if sound is not None:
            if self._listener is None:
                raise InvalidArgument("sound needs a recogniser of words")
            feeds.append(Feed("speech", sound, self._listener.listen, clock, recorder))
        if pictures is not None:
            if self._watcher is None:
                raise InvalidArgument("pictures need a recogniser of gestures")
            tap = recorder if self._imitator is None else ImitatingTap(self._imitator, recorder)
            feeds.append(Feed("gesture", pictures, self._watcher.watch, clock, tap))
        return feeds

    def _prepared(self, motions: Mapping[str, Motion] | None) -> dict[str, Motion]:
        if self._robot is None:
            return {}
        guided: dict[str, Motion] = {}
        if self._imitator is not None:
            one = Guided(self._imitator.joint_names, self._imitator.target_at)
            guided = dict.fromkeys(self.options.imitate_labels, one)
        led = {*self.options.control_labels, *self.options.fusion.stop_labels, *guided}
        labels = (self._command_labels - led) | self._answers()
        found, self.refused = prepared_motions(self._robot, labels, motions, self._slots)
        return guided | found

    def _answers(self) -> set[str]:
        """Gestures that stored sentences are answered with."""
        stored = () if self._knowledge is None else self._knowledge.sentences
        return {label for sentence in stored for label in sentence.answer}

    def _about(self) -> dict[str, Any]:
        given = {"endpointer": self._endpointer, "segmenter": self._segmenter}
        return {
            "options": asdict(self.options),
            "labels": sorted(self._commands()),
            "models": self._model_ids,
            **{name: None if options is None else options.as_dict() for name, options in given.items()},
        }

    def _commands(self) -> Collection[str]:
        return self._command_labels | self._answers() if self._robot is None else self._motions.keys()

    def _logic(self, body: Body) -> SessionLogic:
        return SessionLogic(
            self.options, body, self._commands(), self._say, self._fusion, self._knowledge, self._whole_sentences
        )

    def _say(self, text: str) -> None:
        if self._on_say is not None:
            self._on_say(text)
        if self._voice is not None:
            self._voice.say(self.aloud(text))

    @contextmanager
    def _begun(self, clock: Clock | None, recorder: SessionRecorder | None, *sources: Any) -> Iterator[Body]:
        """What moves, while the session runs; where it cannot begin, its sources are closed."""
        with ExitStack() as stack:
            with closing_unread_if_refused(*sources):
                body = self._body(stack, clock, recorder)
            yield body

    def _body(self, stack: ExitStack, clock: Clock | None, recorder: SessionRecorder | None) -> Body:
        if not self._running.acquire(blocking=False):
            raise InvalidArgument("the session is running already")
        stack.callback(self._running.release)
        if self._imitator is not None:
            self._imitator.reset()
        if recorder is not None:
            recorder.begin(self._about())
            stack.callback(recorder.end)
        if self._robot is None:
            return NoRobot()
        body = Mover(self._robot, self._motions, clock, None if recorder is None else recorder.joints)
        stack.callback(body.close)
        return body

    def _run(
        self, sound: SoundSource | None, pictures: PictureSource | None, recorder: SessionRecorder | None
    ) -> Iterator[Event]:
        with self._begun(None, recorder, sound, pictures) as body:
            feeds = self._feeds(sound, pictures, None, recorder)
            logic = self._logic(body)
            time_s = 0.0
            with closing(merge(feeds, self.options.retry_s)) as arrivals:
                for arrival in arrivals:
                    time_s = arrival.event.time
                    yield from self._kept(self._answered(logic, time_s), recorder)
                    yield from self._kept(logic.process(arrival), recorder)
            yield from self._kept(self._answered(logic, time_s), recorder)
            yield from self._kept(logic.passed(math.inf), recorder)

    def _answered(self, logic: SessionLogic, time_s: float) -> Iterator[Event]:
        """What follows from what the caller asked for."""
        assert isinstance(self._inbox, deque)
        while self._inbox:
            asked = replace(self._inbox.popleft(), time=time_s)
            yield from logic.process(Arrival(asked, time.perf_counter()))

    def _run_live(
        self, sound: SoundSource | None, pictures: PictureSource | None, recorder: SessionRecorder | None
    ) -> Iterator[Event]:
        begun_s = time.monotonic()

        def clock() -> float:
            return time.monotonic() - begun_s

        output = EventQueue()
        failure: list[BaseException] = []
        with self._begun(clock, recorder, sound, pictures) as body, ExitStack() as stack:
            logic = self._logic(body)
            live = LiveFeeds(self._feeds(sound, pictures, clock, recorder), self.options.retry_s)
            stack.callback(live.close)
            self._deliver_to(live.queue)  # a STOP of before the first word stops what that word asks for
            if self._voice is not None:  # over files it is not heard
                self._voice.attach(self.voiced)
                stack.callback(self._voice.detach)
            live.start()

            def decide() -> None:
                try:
                    self._decide(logic, live.queue, body, clock, output, recorder)
                except BaseException as error:  # reported in the caller's thread
                    failure.append(error)
                finally:
                    output.close()

            def end() -> None:
                with self._asking:
                    self._inbox = deque(maxlen=64)
                live.queue.close()
                if not output.over and isinstance(body, Mover):  # the caller has left, and no one watches what moves
                    body.close()
                thread.join(_CLOSE_S)

            thread = threading.Thread(target=decide, daemon=True, name="hri-session")
            stack.callback(end)
            thread.start()
            while not output.over:
                arrival = output.get(_POLL_S)
                if arrival is not None:
                    yield arrival.event
            if failure:
                raise Error(f"the session ended: {failure[0]}") from failure[0]

    def _decide(
        self,
        logic: SessionLogic,
        queue: EventQueue,
        body: Body,
        clock: Clock,
        output: EventQueue,
        recorder: SessionRecorder | None,
    ) -> None:
        """Heed events as they come until all sources have ended and the robot rests."""
        last_s = 0.0
        while not (queue.over and not (isinstance(body, Mover) and body.busy)):
            arrival = queue.get(_POLL_S)
            if arrival is None and clock() - last_s < _TICK_S:
                happened = logic.passed(clock())
            else:
                last_s = clock()
                if arrival is None:
                    arrival = Arrival(session_event(last_s, TICK), time.perf_counter())
                elif arrival.event.mode == "session":  # when it was asked for: this thread may be late
                    asked_s = max(0.0, last_s - (time.perf_counter() - arrival.at_s))
                    arrival = replace(arrival, event=replace(arrival.event, time=asked_s))
                happened = logic.process(arrival)
            for event in self._kept(happened, recorder):
                output.put(event)
        for event in self._kept(logic.passed(clock()), recorder):
            output.put(event)

    def _kept(self, events: Iterable[Event], recorder: SessionRecorder | None) -> Iterator[Event]:
        for event in events:
            if recorder is not None:
                recorder.event(event)
                motion = self._motions.get(event.fields["label"]) if event.event == "motion_start" else None
                if isinstance(motion, Trajectory):
                    recorder.motion(event.time, event.fields["label"], motion)
            yield event
