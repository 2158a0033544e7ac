# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Services that behave like NAO's, on the loopback: names, signatures, limits, silent clamping, errors.

Run as a program it prints its address and serves until its input ends.
"""

from __future__ import annotations

import sys
import threading
import time

import numpy as np
import qi

from hri.robot import NAO

qi.logging.setLevel(qi.logging.SILENT)  # it writes to stdout

REST_RAD = {"LShoulderPitch": 1.45, "RShoulderPitch": 1.45, "HeadPitch": 0.1, "LElbowYaw": -0.4, "RElbowYaw": 0.4}
HANDS = ("LHand", "RHand")


@qi.multiThreaded()
class Motion:
    """ALMotion: joints follow their targets at the speed allowed, once stiff; what is beyond a limit is clamped."""

    def __init__(self):
        self.body = [*NAO.names, *HANDS]
        self.limits = {
            joint.name: [joint.lower_rad, joint.upper_rad, NAO.max_speed_rad_s, NAO.max_torque_n_m]
            for joint in NAO.joints
        } | {key: [0.0, 1.0, 8.33, 0.3] for key in HANDS}
        self.positions = NAO.rest_rad | dict.fromkeys(HANDS, 0.0)
        self.targets = dict(self.positions)
        self.speeds = dict(self.limits)
        self.stiffness = dict.fromkeys(self.body, 0.0)
        self.sent = []  # (time, {joint: angle}) of every setAngles
        self.clamped = []
        self.postures = []
        self.posture_s = 0.2
        self.silent = threading.Event()  # set: calls are not answered
        self.killed = threading.Event()
        self.standing_up = threading.Event()  # or resting: on the way
        self._lock = threading.Lock()
        self._at_s = time.monotonic()

    def _answering(self):
        while self.silent.is_set():
            time.sleep(0.01)

    def _move(self):
        now_s = time.monotonic()
        for name, target in self.targets.items():
            if self.stiffness[name] > 0.0:
                most = self.limits[name][2] * (now_s - self._at_s)
                self.positions[name] += max(-most, min(most, target - self.positions[name]))
        self._at_s = now_s

    def _names(self, names):
        names = self.body if names == "Body" else [names] if isinstance(names, str) else list(names)
        for name in names:
            if name not in self.limits:
                raise RuntimeError(f"ALMotion: {name} is not a valid joint name")
        return names

    def getBodyNames(self, name):
        return self._names(name)

    def getLimits(self, name):
        return [self.limits[joint] for joint in self._names(name)]

    def getAngles(self, names, use_sensors):
        self._answering()
        with self._lock:
            self._move()
            return [self.positions[name] for name in self._names(names)]

    def setStiffnesses(self, names, values):
        self._answering()
        with self._lock:
            self._move()
            names = self._names(names)
            for name, value in zip(names, values if isinstance(values, list) else [values] * len(names), strict=True):
                if self.stiffness[name] == 0.0:
                    self.targets[name] = self.positions[name]
                self.stiffness[name] = value

    def setAngles(self, names, angles, fraction):
        self._answering()
        if not 0.0 < fraction <= 1.0:
            raise RuntimeError("ALMotion::setAngles: fractionMaxSpeed must be in ]0, 1]")
        with self._lock:
            self._move()
            asked = dict(zip(self._names(names), angles, strict=True))
            self.sent.append((time.monotonic(), asked))
            for name, angle in asked.items():
                low, high = self.limits[name][:2]
                if not low - 1e-4 <= angle <= high + 1e-4:
                    self.clamped.append((name, angle))
                self.targets[name] = min(max(angle, low), high)

    def killAll(self):
        self.killed.set()

    def wakeUp(self):
        self._posture("wakeUp", 1.0)

    def rest(self):
        self._posture("rest", 0.0)

    def _posture(self, name, stiffness):
        self.killed.clear()
        self.standing_up.set()
        if not self.killed.wait(self.posture_s):
            self.postures.append(name)
            with self._lock:
                self._move()
                self.positions |= REST_RAD
                self.targets = dict(self.positions)
                self.stiffness = dict.fromkeys(self.body, stiffness)


class TextToSpeech:
    """ALTextToSpeech: remembers what it said."""

    def __init__(self):
        self.said = []
        self.hoarse = False

    @qi.bind(qi.Void, [qi.String], "say")
    def say_as_set(self, text):
        self.say_in(text, "English")

    @qi.bind(qi.Void, [qi.String, qi.String], "say")
    def say_in(self, text, language):
        if language not in ("English", "French"):
            raise RuntimeError(f"ALTextToSpeech::say: language {language} is not installed")
        if self.hoarse:
            raise RuntimeError("ALTextToSpeech::say: hoarse")
        time.sleep(0.05)
        self.said.append((text, language))


@qi.multiThreaded()
class VideoDevice:
    """ALVideoDevice: dark pictures with a dot that moves, or `frames`, the last of which stays."""

    SIZES = ((160, 120), (320, 240), (640, 480))

    def __init__(self):
        self.subscribers = {}
        self.frozen = False
        self.broken = False
        self.frames = []
        self.number = 0
        self.paced = False  # set: `frames` come again and again, by the clock
        self.begun_s = 0.0

    def subscribeCamera(self, name, camera, resolution, colours, fps):
        if camera not in (0, 1) or colours != 13 or resolution not in (0, 1, 2):
            return ""
        if len(self.subscribers) >= 8:
            raise RuntimeError("ALVideoDevice: too many subscribers")
        handle = f"{name}_{len(self.subscribers)}"
        self.begun_s = time.monotonic()
        self.subscribers[handle] = (camera, fps, self.SIZES[resolution])
        return handle

    # Width, height, layers, colours, s, us, pixels, camera, angles of view.
    @qi.bind("(iiiiiiriffff)", [qi.String], "getImageRemote")
    def get_image(self, handle):
        if handle not in self.subscribers:
            raise RuntimeError(f"ALVideoDevice: {handle} is not subscribed")
        camera, fps, (width, height) = self.subscribers[handle]
        if self.paced:
            self.number = int((time.monotonic() - self.begun_s) * fps) % len(self.frames)
        else:
            self.number += not (self.frozen or self.number == len(self.frames) - 1)
        pixels = self.picture(camera, width, height).tobytes()[: -5 if self.broken else None]
        seconds, part_s = divmod(1000 + self.number / fps, 1.0)
        return (width, height, 3, 13, int(seconds), int(1e6 * part_s), pixels, camera, 0.53, 0.42, -0.53, -0.42)

    def picture(self, camera, width, height):
        if self.frames:
            return self.frames[self.number]
        picture = np.full((height, width, 3), 30 + camera, dtype=np.uint8)
        picture[0, self.number % width] = (1, 128, 255)
        return picture

    def releaseImage(self, handle):
        return handle in self.subscribers

    def unsubscribe(self, handle):
        self.subscribers.pop(handle, None)


@qi.multiThreaded()
class AudioDevice:
    """ALAudioDevice: calls its subscribers' processRemote 20 times faster than sound is."""

    def __init__(self):
        self.session = None
        self.preferences = {}
        self.subscribers = set()
        self.samples = np.zeros(0, dtype="<i2")  # what is heard; then nothing comes
        self.num_channels = 1

    def setClientPreferences(self, name, rate_hz, channels, deinterleaved):
        if (rate_hz, channels) not in ((48000, 0), (16000, 1), (16000, 2), (16000, 3), (16000, 4)):
            raise RuntimeError("ALAudioDevice: these preferences are not supported")
        self.preferences[name] = (rate_hz, channels, deinterleaved)

    def subscribe(self, name):
        client = self.session.service(name)
        self.subscribers.add(name)
        threading.Thread(target=self._play, args=(name, client), daemon=True).start()

    def _play(self, name, client):
        for begin in range(0, len(self.samples), 1365):
            if name not in self.subscribers:
                return
            block = self.samples[begin : begin + 1365]
            client.processRemote(self.num_channels, len(block), [1000, begin], block.tobytes())
            time.sleep(len(block) / 16000 / 20)

    def unsubscribe(self, name):
        self.subscribers.discard(name)


class Nao:
    """A service directory with the services named; `close` switches it off."""

    def __init__(
        self,
        services=("ALMotion", "ALTextToSpeech", "ALVideoDevice", "ALAudioDevice"),
        url="tcp://127.0.0.1:0",
        motion=None,
        video=None,
    ):
        self.motion, self.video = motion or Motion(), video or VideoDevice()
        self.voice, self.audio = TextToSpeech(), AudioDevice()
        known = {
            "ALMotion": self.motion,
            "ALTextToSpeech": self.voice,
            "ALVideoDevice": self.video,
            "ALAudioDevice": self.audio,
        }
        self.session = self.audio.session = qi.Session()
        self.session.listenStandalone(url)
        self.url = self.session.endpoints()[0]
        for name in services:
            self.session.registerService(name, known[name])

    def close(self):
        self.motion.silent.clear()
        self.session.close()


if __name__ == "__main__":
    served = Nao()
    print(served.url, flush=True)
    sys.stdin.read()
