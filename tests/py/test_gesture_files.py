# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Gestures in a file of one's own: whatever is wrong with it is a typed error that names the place."""

import re

import numpy as np
import pytest

from hri.core.errors import InvalidArgument
from hri.robot.motion.gestures import parse_gestures

HEAD = """period_s = 0.01
speed_rad_s = 3.0
acceleration_rad_s2 = 20.0
least_move_s = 0.45
[arms]
down = [80, 8, 0, -18]
up = [-88, 6, 0, 0]
[[gesture]]
name = "mine"
meaning = "an arm up"
"""
WHOLE = HEAD + 'keys = [{ right = "up" }]\n'


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "period_s is missing"),
        (HEAD.split("[[gesture]]")[0], "gesture is missing"),
        (WHOLE.replace("speed_rad_s = ", "spede_rad_s = "), "speed_rad_s is missing"),
        (WHOLE.replace("[[gesture]]", "[gesture]"), "gesture must be a list"),
        (WHOLE.replace("[arms]", "[legs]"), "arms is missing"),
        (WHOLE.replace("[arms]", "[[arms]]"), "arms must be a table"),
        (WHOLE.replace('meaning = "', 'meaning = 3 #"'), "meaning must be text"),
        (WHOLE.replace('name = "', 'mane = "'), "gesture 1: name is missing"),
        (WHOLE + "salute = 1\n", "no field salute"),
        (WHOLE.replace("keys = [", "keys = [3, "), "key 1: is no table"),
        (WHOLE.replace("keys = [", "keys = {} #"), "keys must be a list"),
        (WHOLE.replace('right = "up"', "right = true"), "key 1, right: must be a list"),
        (WHOLE.replace('right = "up"', "right = [1, 2, 3]"), "4 or 5 numbers"),
        (WHOLE.replace('right = "up"', "right = [1, 2, 3, nan]"), "4 or 5 numbers"),
        (WHOLE.replace('right = "up"', "right = [1, 2, 3, '4']"), "4 or 5 numbers"),
        (WHOLE.replace('right = "up"', "right = { at_cm = 3 }"), "at_cm must be a list"),
        (WHOLE.replace('right = "up"', "right = { at_cm = [1, 2] }"), "3 numbers"),
        (WHOLE.replace('right = "up"', "right = { at_cm = [14, 4, 0], elbow = 'out' }"), "elbow must be a number"),
        (WHOLE.replace('right = "up"', "right = { at_cm = [14, 4, 0], hand = inf }"), "hand must be a number"),
        (WHOLE.replace('right = "up"', "head = 3"), "head: must be a list of 2 numbers"),
        (WHOLE.replace('right = "up"', "hold_s = -1"), "hold_s must be a number from 0 to 60"),
        (WHOLE.replace('right = "up"', "hold_s = 1e300"), "hold_s"),
        (WHOLE.replace('right = "up"', "hold_s = " + "9" * 400), "hold_s"),
        (WHOLE.replace('right = "up"', "hold_s = " + "9" * 6000), "gestures: "),
        (WHOLE.replace('right = "up"', 'right = "up", slower = nan'), "slower"),
        (WHOLE.replace("period_s = 0.01", "period_s = 0.0"), "period_s must be a number from 0.001 to 1"),
        (WHOLE.replace("period_s = 0.01", "period_s = true"), "period_s must be"),
        (WHOLE + "\nx = " + "[" * 5000 + "]" * 5000, "gestures: "),
        (WHOLE + "\n" + "[" * 5000, "gestures: "),
        (WHOLE + WHOLE[WHOLE.index("[[gesture]]") :], "is there twice"),
        (HEAD + "keys = []", "no key moves or holds"),
        (HEAD + "keys = [{}]", "no key moves or holds"),
        ("\x00", "gestures: "),
    ],
)
def test_a_file_that_is_not_as_it_should_be_is_a_typed_error(text, words):
    assert list(parse_gestures(WHOLE))
    with pytest.raises(InvalidArgument, match=re.escape(words)):
        parse_gestures(text)


def test_any_change_of_a_value_is_read_or_refused():
    rng = np.random.default_rng(0)
    values = ["1", "-1", "0", "nan", "inf", "1e308", "true", '""', "[]", "{}", "[[]]", "1979-05-27", "[1, 2, 3, 4]"]
    lines = WHOLE.splitlines()
    read = 0
    for _ in range(600):
        changed = lines[:]
        place = int(rng.integers(len(changed)))
        if "=" in changed[place] and rng.random() < 0.7:
            changed[place] = f"{changed[place].split('=')[0]}= {values[rng.integers(len(values))]}"
        else:
            changed.pop(place)
        try:
            for gesture in parse_gestures("\n".join(changed)).values():
                assert len(gesture.trajectory()) < 100_000
                read += 1
        except InvalidArgument:
            continue
    assert 5 < read < 500
