# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""NAO's microphone as a source, and a spoken word that NAO hears and answers, over its own protocol."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("qi")

from conftest import RATE_HZ
from hri.core.errors import Error, InvalidArgument, IoError
from hri.live import Stalled
from hri.robot import NaoqiRobot, Trajectory
from hri.session import NaoMicrophone, Session
from nao_services import Nao

NOD = Trajectory(["HeadPitch"], 0.3, [[0.0], [0.1], [0.0]])


@pytest.fixture
def nao():
    made = Nao()
    yield made
    made.close()


def samples_until_stalled(source):
    found = [np.zeros(0, dtype=np.float32)]
    try:
        while True:
            found.append(source.read())
    except Stalled as stalled:
        return np.concatenate(found), str(stalled)


def test_sound_comes_as_it_was_heard(nao):
    nao.audio.samples = np.random.default_rng(0).integers(-32768, 32767, 16000).astype("<i2")
    source = NaoMicrophone(nao.url, stall_s=3.0)
    found, why = samples_until_stalled(source)
    assert found.dtype == np.float32 and source.sample_rate_hz == 16000 and source.num_lost == 0
    np.testing.assert_array_equal(found, nao.audio.samples / np.float32(32768))
    assert "no sound for 3 s" in why
    assert list(nao.audio.preferences.values()) == [(16000, 3, 0)] and len(nao.audio.subscribers) == 1
    source.close()
    source.close()
    assert nao.audio.subscribers == set() and source.read() is None


def test_a_late_reader_loses_samples_that_are_counted(nao):
    nao.audio.samples = np.ones(1365 * 4, dtype="<i2")
    source = NaoMicrophone(nao.url, stall_s=3.0, buffer_s=0.1)
    while source.num_lost < 1365 * 4 - 1600:
        pass
    found, _ = samples_until_stalled(source)
    assert len(found) == 1600 and source.num_lost == 1365 * 4 - 1600
    source.close()


def test_what_is_no_sound_and_a_robot_that_is_gone_stall(nao):
    nao.audio.samples, nao.audio.num_channels = np.ones(1365, dtype="<i2"), 4
    source = NaoMicrophone(nao.url, stall_s=3.0)
    found, why = samples_until_stalled(source)
    assert len(found) == 0 and "2730 bytes for 1365 samples of 4 channels" in why
    nao.close()
    source.close()
    with pytest.raises(IoError, match="no NAO"):
        NaoMicrophone(nao.url)


def test_what_no_microphone_has_is_refused(nao):
    for values in ({"stall_s": 0.0}, {"buffer_s": 0.0}):
        with pytest.raises(InvalidArgument, match=next(iter(values))):
            NaoMicrophone(nao.url, **values)
    without = Nao(services=["ALMotion"])
    with pytest.raises(Error, match="no service ALAudioDevice"):
        NaoMicrophone(without.url)
    without.close()


@pytest.mark.usefixtures("few_fillers")
def test_nao_hears_a_word_says_so_and_answers_by_a_motion(nao):
    from session_people import speech, train_words

    nao.audio.samples = (32767 * speech([("tall", 1.0)], 3.0)).astype("<i2")
    assert RATE_HZ == 16000
    with NaoqiRobot(nao.url, timeout_s=20.0) as robot:
        session = Session(train_words(), robot=robot, motions={"tall": NOD}, on_say=robot.say_later)
        events = list(session.run(sound=NaoMicrophone(nao.url, stall_s=4.0)))
        robot.say("the end")  # after what was to be said before
    finals = [event.fields["final"] for event in events if event.event == "fused"]
    done = [event.fields["completed"] for event in events if event.event == "motion_end"]
    assert finals == ["tall"] and done == [True] and robot.events == []
    assert [text for text, _ in nao.voice.said] == ["tall.", "the end"] and len(nao.motion.sent) > 20
