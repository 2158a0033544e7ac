# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Commands of several words with slots: decided on, and carried out in a session."""

from __future__ import annotations

import copy
import json
import pickle
from pathlib import Path

import numpy as np
import pytest

from conftest import PERSONS, RATE_HZ, tone_word
from hri import CommandRecognizer, Decision, Session
from hri.core.errors import FormatError, InvalidArgument
from hri.datasets import Dataset
from hri.fusion import FusionOptions
from hri.io import write_wav_pcm16
from hri.language import Grammar
from hri.live import ArraySource, Attention, Event, Listener
from hri.recognition import ConnectedWordRecognizer
from hri.robot import open_robot
from hri.session import SessionOptions
from hri.signal import EndpointerOptions
from hri.synthetic.speech import make_speaker, make_speech_corpus, speak

ROOT = Path(__file__).parents[2]
GRAMMAR = """#JSGF V1.0;
grammar tones;
public <command> = ( 1 {side=left} | 2 {side=right} ) 1 {gesture=up} [ 2 {times=2} ]
                 | ( 2 2 {walk=forward} | 2 2 2 {walk=forward} ) {steps=2} | 1;
"""
OPTIONS = {
    "words": {"num_states": 5, "num_vtlp_factors": 1, "num_noisy_copies": 1, "min_snr_db": 10.0},
    "max_words": 3,
}


def tones(words: str) -> np.ndarray:
    """Words by a speaker who was not trained on, with quiet before and behind."""
    clips = [tone_word(575, 800 if word == "1" else -350, 50 + i) for i, word in enumerate(words.split())]
    quiet = np.resize(clips[0][: RATE_HZ // 5], 3 * RATE_HZ // 2)
    return np.concatenate([quiet, *(clip[RATE_HZ // 10 : 4 * RATE_HZ // 5] for clip in clips), quiet])


def between_words() -> np.ndarray:
    """What is nearer to "1" than to "2", but not much."""
    around = tones("1")
    return np.concatenate([around[: RATE_HZ * 3 // 2], tone_word(575, 60, 3)[RATE_HZ // 10 :], around[-RATE_HZ:]])


def tone_rows() -> tuple[list[np.ndarray], list[str]]:
    """Recordings of the words by three speakers, and their labels."""
    slopes = {"1": 800.0, "2": -350.0}
    rows = [
        (tone_word(base_hz, slope, 10 * number + take), label)
        for number, base_hz in enumerate(PERSONS.values())
        for take in range(3)
        for label, slope in slopes.items()
    ]
    return [clip for clip, _ in rows], [label for _, label in rows]


@pytest.fixture(scope="module")
def words(spoken: Path) -> ConnectedWordRecognizer:
    samples = Dataset.load(spoken).samples
    return ConnectedWordRecognizer(**OPTIONS).fit(
        [s.path for s in samples], [s.label for s in samples], groups=[s.person for s in samples]
    )


@pytest.fixture(scope="module")
def unscaled_words() -> ConnectedWordRecognizer:
    """Its `confidence_scale` is the default: chosen on so clear words, it would make everything sure."""
    clips, labels = tone_rows()
    return ConnectedWordRecognizer(**OPTIONS, choose_penalty=False).fit(clips, labels, sample_rate_hz=RATE_HZ)


@pytest.fixture(scope="module")
def commands(words: ConnectedWordRecognizer) -> CommandRecognizer:
    return CommandRecognizer(words, Grammar.parse(GRAMMAR, "tones.jsgf"))


def test_a_decision_carries_the_slots_of_its_command(commands: CommandRecognizer) -> None:
    assert list(commands.classes_) == ["1", "1 1", "1 1 2", "2 1", "2 1 2", "2 2"]
    assert commands.commands_["2 2"] == {"walk": "forward", "steps": "2"}  # and "2 2 2" is the same command
    found = commands.recognise(tones("2 1 2"), RATE_HZ)
    assert (found.label, found.status) == ("2 1 2", "recognised")
    assert found.slots == {"side": "right", "gesture": "up", "times": "2"}
    assert found.nbest[0].label == "2 1 2" and found.confidence == found.nbest[0].probability > 0.5
    assert 0.99 < sum(entry.probability for entry in found.nbest) <= 1.0 + 1e-9
    assert commands.recognise(tones("2 2 2"), RATE_HZ).label == "2 2"
    assert commands.recognise(tones("1"), RATE_HZ).slots == {}
    assert json.loads(json.dumps(found.to_dict()))["slots"]["side"] == "right"
    assert commands.recognise(np.zeros(RATE_HZ, np.float32), RATE_HZ).status == "no_input"
    assert len({found, Decision("speech", "a", "recognised", 1.0)}) == 2


def test_commands_are_copied_and_pickled(words: ConnectedWordRecognizer) -> None:
    commands = CommandRecognizer(words, Grammar.parse(GRAMMAR, "tones.jsgf"), min_confidence=0.8)
    said = tones("2 1")
    for again in (pickle.loads(pickle.dumps(commands)), copy.deepcopy(commands), copy.copy(commands)):
        assert again.commands_ == commands.commands_ and again.min_confidence == 0.8
        assert again.recognise(said, RATE_HZ) == commands.recognise(said, RATE_HZ)
        assert again.recognise_early(said, ["2 1"], RATE_HZ) == commands.recognise_early(said, ["2 1"], RATE_HZ)
    for state in (None, {}, commands.__getstate__() | {"grammar": 1}):
        with pytest.raises(FormatError, match="the state of CommandRecognizer must have"):
            CommandRecognizer.__new__(CommandRecognizer).__setstate__(state)


def test_stop_does_not_wait_for_the_pause_that_ends_a_command(commands: CommandRecognizer) -> None:
    stop = commands.recognise_early(tones("1"), {"1"}, RATE_HZ)
    assert stop is not None and (stop.label, stop.status) == ("1", "recognised") and 0.5 <= stop.confidence <= 1.0
    assert commands.recognise_early(tones("1"), {"2 1"}, RATE_HZ) is None
    for other in ("1 1", "2 1", "1 1 2", "2"):
        assert commands.recognise_early(tones(other), {"1"}, RATE_HZ) is None
    assert commands.recognise_early(np.zeros(RATE_HZ, np.float32), {"1"}, RATE_HZ) is None

    quiet = tones("1")[: 3 * RATE_HZ // 4]
    said = [tones("2 1 2")[: -RATE_HZ // 2], tones("1")[len(quiet) : -len(quiet) // 2], tones("2 1")]
    stream = np.concatenate(said)
    options = SessionOptions(confirm_below=0.0, fusion=FusionOptions(stop_labels=("1",)))
    ends = []
    for hangover_ms in (700, 300):  # with the other, commands end as early as words do, and nothing is early
        with open_robot("kinematic") as robot:
            endpointer = EndpointerOptions(activity=commands.endpointer.activity, hangover_ms=hangover_ms)
            session = Session(commands, robot=robot, options=options, endpointer=endpointer)
            events = list(session.run(ArraySource(stream, RATE_HZ)))
            assert robot.stopped
        decided = [(event.fields["final"], event.time) for event in events if event.event == "decision"]
        assert [label for label, _ in decided] == ["2 1 2", "1", "2 1"]
        (stopped,) = [event for event in events if event.event == "stop"]
        assert stopped.time == decided[1][1]
        ends.append([time_s for _, time_s in decided])
        (begun,) = [event for event in events if event.event == "motion_start"]
        (halted,) = [event for event in events if event.event == "halt"]
        assert begun.fields["label"] == "2 1 2" and begun.time < stopped.time <= halted.time < stopped.time + 0.1
    assert ends[0][1] == pytest.approx(ends[1][1], abs=0.02)
    assert ends[0][0] - ends[1][0] == pytest.approx(0.4, abs=0.05)

    stopped_in_mid_command = np.concatenate([tones("1")[: -5 * RATE_HZ // 4], tones("2 1")[5 * RATE_HZ // 4 :]])
    heard = Listener(commands, urgent=("1", "stop")).listen(ArraySource(stopped_in_mid_command, RATE_HZ))
    kinds = [(event.event, event.fields.get("final")) for event in heard if event.event != "level"]
    assert kinds[1:-1] == [("speech_start", None), ("decision", "1"), ("speech_end", None)]

    class Blocks(ArraySource):
        size = 1

        def read(self) -> np.ndarray | None:
            block, self._at = self._samples[self._at : self._at + self.size], self._at + self.size
            return block if len(block) else None

    def decided_in(size: int) -> list[tuple[str, float, float, float]]:
        source = Blocks(stream, RATE_HZ)
        source.size = size
        heard = Listener(commands, urgent=("1",)).listen(source)
        decided = [event for event in heard if event.event == "decision"]
        return [(e.fields["final"], e.time, e.fields["last_s"], e.fields["confidence"]) for e in decided]

    assert [label for label, *_ in decided_in(160)] == ["2 1 2", "1", "2 1"]
    assert decided_in(160) == decided_in(1000) == decided_in(len(stream))


def test_an_urgent_command_needs_the_wake_word_unless_it_always_counts(commands: CommandRecognizer) -> None:
    def heard(attention: Attention, *said: np.ndarray) -> list[Event]:
        found = Listener(commands, attention=attention, urgent=("1",)).listen(
            ArraySource(np.concatenate(said), RATE_HZ)
        )
        return [event for event in found if "first_s" in event.fields and event.event != "speech_end"]

    def kinds(events: list[Event]) -> list[tuple[str, str]]:
        return [(event.event, event.fields["final"]) for event in events if event.event != "speech_start"]

    wake, stop, command = tones("2 2"), tones("1"), tones("2 1 2")
    asleep = heard(Attention("2 2", always=()), stop)
    assert kinds(asleep) == [("ignored", "")]
    always = heard(Attention("2 2", always=("1",)), stop)
    assert kinds(always) == [("decision", "1")] and always[-1].time < asleep[-1].time - 0.1
    assert kinds(heard(Attention("2 2", 5.0, always=()), wake, stop)) == [("wake", ""), ("decision", "1")]
    assert kinds(heard(Attention("2 2", 0.5, always=()), wake, stop)) == [("wake", ""), ("ignored", "")]
    assert kinds(heard(Attention("2 2", always=()), command, stop)) == [("ignored", "")] * 2
    # Of an utterance that began in time, what is urgent counts, however late it is said.
    amid = (wake, command[: -5 * RATE_HZ // 4], stop[5 * RATE_HZ // 4 :])
    woken = heard(Attention("2 2", 60.0, always=()), *amid)
    assert kinds(woken) == [("wake", ""), ("decision", "1")]
    _, waked, begun, stopped = woken
    late_s = stopped.fields["first_s"] - 0.1 - waked.fields["last_s"]
    assert begun.fields["first_s"] < waked.fields["last_s"] + late_s
    assert kinds(heard(Attention("2 2", late_s, always=()), *amid)) == [("wake", ""), ("decision", "1")]


def test_in_a_session_stop_by_itself_counts_as_soon_as_a_word_does(commands: CommandRecognizer) -> None:
    options = SessionOptions(fusion=FusionOptions(stop_labels=("1",)))
    decided = {}
    for pauses in (False, True):
        session = Session(commands, options=options, endpointer=None if pauses else commands.endpointer)
        events = list(session.run(ArraySource(np.concatenate([tones("1"), tones("2 1 2")]), RATE_HZ)))
        decided[pauses] = [(e.fields["final"], e.time) for e in events if e.event == "decision"]
        assert [label for label, _ in decided[pauses]] == ["1", "2 1 2"]  # once, and not at the pauses of another
    (_, late_s), (_, end_s) = decided[False]
    assert decided[True] == [("1", pytest.approx(late_s - 0.15, abs=0.02)), ("2 1 2", end_s)]


def test_a_command_that_is_unsure_is_unknown_unless_it_is_stop(unscaled_words: ConnectedWordRecognizer) -> None:
    def commands(min_confidence: float) -> CommandRecognizer:
        return CommandRecognizer(unscaled_words, Grammar.parse(GRAMMAR, "tones.jsgf"), min_confidence=min_confidence)

    stream, between = tones("1"), between_words()
    taken = commands(0.0).recognise(between, RATE_HZ)
    assert taken.status == "recognised" and 0.2 < taken.confidence < 0.999
    assert commands(taken.confidence).recognise(between, RATE_HZ) == taken
    rejected = commands(taken.confidence + 0.001).recognise(between, RATE_HZ)
    assert (rejected.label, rejected.status, rejected.nbest) == ("unknown", "unknown", taken.nbest)
    for bad in (-0.1, 1.1, np.nan):
        with pytest.raises(InvalidArgument, match="min_confidence"):
            commands(bad)

    sure = commands(0.0).recognise(stream, RATE_HZ).confidence
    strict = commands(min(1.0, sure + 1e-12))
    assert strict.recognise(stream, RATE_HZ).status == ("recognised" if sure == 1.0 else "unknown")
    ends_early = EndpointerOptions(activity=strict.endpointer.activity)
    for urgent in ((), ("1",)):
        events = Listener(strict, ends_early, urgent=urgent).listen(ArraySource(stream, RATE_HZ))
        (decided,) = [event.fields["final"] for event in events if event.event == "decision"]
        assert decided == ("1" if urgent or sure == 1.0 else "")


def test_a_saved_model_is_as_sure_as_the_one_that_was_trained(words: ConnectedWordRecognizer, tmp_path: Path) -> None:
    words.save(tmp_path / "words.hri")
    loaded = ConnectedWordRecognizer.load(tmp_path / "words.hri")
    assert loaded.options.confidence_scale != words.options.confidence_scale  # it was chosen in training
    grammar = Grammar.parse(GRAMMAR, "tones.jsgf")
    for said in (between_words(), tones("2 1 2")):
        found = [
            CommandRecognizer(one, grammar, min_confidence=0.0).recognise(said, RATE_HZ) for one in (words, loaded)
        ]
        assert found[0] == found[1]


def test_words_of_no_confidence_are_no_command(words: ConnectedWordRecognizer) -> None:
    # As many sentences come near the best as the beam lets, all of them as probable.
    unsure = {"min_confidence": 1.0, "confidence_scale": 1e-6, "lattice": {"beam": 1e4}}
    model = ConnectedWordRecognizer(**OPTIONS, **unsure, choose_penalty=False)
    clips = [tone_word(500 + 20 * i, 800 if i % 2 else -350, i) for i in range(8)]
    model.fit(clips, [str(1 + (i + 1) % 2) for i in range(8)], sample_rate_hz=RATE_HZ)
    found = CommandRecognizer(model, Grammar.parse(GRAMMAR, "g")).recognise(tones("2 1 2"), RATE_HZ)
    assert (found.label, found.status, found.slots) == ("unknown", "unknown", {})
    with pytest.raises(InvalidArgument, match="its sentences have no end"):
        CommandRecognizer(words, Grammar.parse("#JSGF V1.0;\ngrammar g;\npublic <s> = 1+;", "g"))
    with pytest.raises(InvalidArgument, match="not trained on: walk; "):
        CommandRecognizer(words, Grammar.parse("#JSGF V1.0;\ngrammar g;\npublic <s> = walk;", "g"))


def test_a_session_raises_the_right_arm_twice(commands: CommandRecognizer) -> None:
    stream = tones("2 1 2")
    with open_robot("kinematic") as robot:
        session = Session(commands, robot=robot, options=SessionOptions(confirm_below=0.0))
        assert session.refused == {"2 2": "the robot's torso is held, and it cannot walk"}
        raised: list[tuple[float, float]] = []
        follow = robot._command

        def watched(positions: dict[str, float]) -> None:
            raised.append((positions.get("rarm_joint_1", np.nan), positions.get("larm_joint_1", np.nan)))
            follow(positions)

        robot._command = watched  # type: ignore[method-assign]
        events = list(session.run(ArraySource(stream, RATE_HZ)))
    fused = next(event for event in events if event.event == "fused")
    assert fused.fields["final"] == "2 1 2" and fused.fields["slots"]["times"] == "2"
    assert [event.fields["completed"] for event in events if event.event == "motion_end"] == [True]
    right, left = np.array(raised).T
    down, up = np.nanmax(right), np.nanmin(right)
    high = right < 0.5 * (down + up)
    assert np.count_nonzero(np.diff(high.astype(int)) == 1) == 2  # twice up
    assert np.nanmax(left) - np.nanmin(left) < 1e-6


def test_the_command_line_sets_how_sure_a_command_and_stop_must_be(
    hri, unscaled_words: ConnectedWordRecognizer, tmp_path: Path
) -> None:
    unscaled_words.save(tmp_path / "words.hri")
    (tmp_path / "tones.jsgf").write_text(GRAMMAR)
    write_wav_pcm16(str(tmp_path / "said.wav"), between_words(), RATE_HZ)
    given = ("--speech-model", tmp_path / "words.hri", "--grammar", tmp_path / "tones.jsgf", "--backend", "none")

    def events(*more: object) -> list[dict[str, object]]:
        done = hri("session", *given, *more, tmp_path / "said.wav")
        assert done.code == 0, done.err
        return [json.loads(line) for line in done.out.splitlines()]

    (fused,) = [row for row in events("--stop", "halt", "--min-confidence", 0) if row["event"] == "fused"]
    assert fused["final"] == "1"
    (fused,) = [row for row in events("--stop", "halt", "--min-confidence", 1) if row["event"] == "fused"]
    assert (fused["final"], fused["status"]) == ("", "unknown")
    asked = events("--stop", "1", "--min-confidence", 0, "--stop-at-rest", 1)
    assert [row["text"] for row in asked if row["event"] == "say"] == ["Did you mean 1?"]
    assert hri("session", *given, "--min-confidence", 1.1, tmp_path / "said.wav").code == 2


def test_a_session_walks_two_steps_from_the_command_line(hri, words: ConnectedWordRecognizer, tmp_path: Path) -> None:
    pytest.importorskip("pybullet")
    words.save(tmp_path / "words.hri")
    (tmp_path / "tones.jsgf").write_text(GRAMMAR)
    write_wav_pcm16(str(tmp_path / "said.wav"), tones("2 2"), RATE_HZ)
    given = ("--speech-model", tmp_path / "words.hri", "--grammar", tmp_path / "tones.jsgf", "--confirm-below", 0)
    done = hri("session", *given, "--stand", tmp_path / "said.wav")
    assert done.code == 0, done.err
    rows = [json.loads(line) for line in done.out.splitlines()]
    (fused,) = [row for row in rows if row["event"] == "fused"]
    assert fused["slots"] == {"walk": "forward", "steps": "2"}
    (ended,) = [row for row in rows if row["event"] == "motion_end"]
    assert ended["completed"] and ended["label"] == "2 2" and ended["message"] == ""
    begun = next(row for row in rows if row["event"] == "motion_start")
    assert ended["time"] - begun["time"] > 7.0
    held = hri("session", *given, "--backend", "kinematic", tmp_path / "said.wav")
    assert "no motion for 2 2: the robot's torso is held, and it cannot walk" in held.err
    no_feet = hri("session", *given, "--backend", "kinematic", "--stand", tmp_path / "said.wav")
    assert no_feet.code != 0 and "the kinematic backend cannot stand on its feet" in no_feet.err


HINDI = {
    **{"aage": "आगे", "baar": "बार", "baayaan": "बायाँ", "chaar": "चार", "chalo": "चलो", "daayaan": "दायाँ", "do": "दो"},
    **{"ek": "एक", "haath": "हाथ", "kadam": "कदम", "namaste": "नमस्ते", "paanch": "पाँच", "peeche": "पीछे"},
    **{"ruko": "रुको", "teen": "तीन", "upar": "ऊपर"},
}
SAID = {
    "robot.jsgf": ("go forward three steps", "raise the right hand"),
    "robot_hi.jsgf": ("teen kadam aage chalo", "daayaan haath upar"),
}
EXPECTED = ({"walk": "forward", "steps": "3"}, {"side": "right", "gesture": "up"})


@pytest.mark.slow
@pytest.mark.parametrize("name", SAID)
def test_example_grammars_understand_synthetic_voices(name: str, tmp_path: Path) -> None:
    grammar = Grammar.load(ROOT / "examples" / "commands" / name)
    texts = {word: word for word in grammar.words}
    if name == "robot_hi.jsgf":
        texts = HINDI
    language = "hi" if name == "robot_hi.jsgf" else "en"
    made = make_speech_corpus(tmp_path, {language: texts}, num_speakers=4, takes=1)
    words = ConnectedWordRecognizer(words={"num_vtlp_factors": 1}).fit(
        [s.path for s in made.samples], [s.label for s in made.samples], groups=[s.person for s in made.samples]
    )
    # By four voices, "daayaan" (right) is not much more likely than "baayaan" (left).
    commands = CommandRecognizer(words, grammar, min_confidence=0.5)
    for sentence, slots in zip(SAID[name], EXPECTED, strict=True):
        clips = [speak(texts[word], language, make_speaker(9)) for word in sentence.split()]
        pause = np.zeros(clips[0].sample_rate_hz // 10, np.float32)
        sound = np.concatenate([part for clip in clips for part in (pause, clip.samples)])
        found = commands.recognise(sound, clips[0].sample_rate_hz)
        assert (found.label, found.slots) == (sentence, slots)
