# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A page for the browser of this computer: its camera and microphone feed a session, a robot answers."""

from hri.serve.app import make_app
from hri.serve.devices import PageCamera, PageMicrophone
from hri.serve.limits import ServeLimits
from hri.serve.server import PageServer
from hri.serve.stage import Stage

__all__ = ["PageCamera", "PageMicrophone", "PageServer", "ServeLimits", "Stage", "make_app"]
