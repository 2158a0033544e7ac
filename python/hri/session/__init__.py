# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A live session: words and signs paired, a dialogue, a robot that answers."""

from hri.session.dialogue import STATES, Action, Dialogue
from hri.session.live import EventQueue
from hri.session.options import SessionOptions
from hri.session.pairing import Observation, Pair, Pairer
from hri.session.session import Session

__all__ = ["STATES", "Action", "Dialogue", "EventQueue", "Observation", "Pair", "Pairer", "Session", "SessionOptions"]
