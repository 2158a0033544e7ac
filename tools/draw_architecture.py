#!/usr/bin/env python3
# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Draw docs/images/architecture.svg: the folders, and how data flows from a microphone and a camera to the robot."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from pathlib import Path

TARGET = Path(__file__).resolve().parents[1] / "docs" / "images" / "architecture.svg"
WIDTH, HEIGHT = 1000, 430
CPP, PYTHON, OUTSIDE = "#d9e8f6", "#fdf0d0", "#eeeeee"


@dataclass(frozen=True)
class Box:
    """A folder: its name, what it does in a line or two, and where it is drawn."""

    name: str
    lines: tuple[str, ...]
    x: int
    y: int
    width: int = 140
    colour: str = CPP
    height: int = 74

    def svg(self) -> str:
        middle = self.x + self.width / 2
        parts = [
            f'<rect x="{self.x}" y="{self.y}" width="{self.width}" height="{self.height}" rx="6" fill="{self.colour}" '
            'stroke="#555"/>',
            f'<text x="{middle}" y="{self.y + 22}" class="name">{escape(self.name)}</text>',
        ]
        for number, line in enumerate(self.lines):
            parts.append(f'<text x="{middle}" y="{self.y + 42 + 16 * number}">{escape(line)}</text>')
        return "\n".join(parts)


BOXES = (
    Box("audio", (), 20, 40, colour=OUTSIDE, height=36),
    Box("video", (), 20, 270, colour=OUTSIDE, height=36),
    Box("signal", ("endpointing, FFT", "wavelets"), 190, 20),
    Box("features", ("speech: cepstra", "hand: shapes, tracks"), 350, 120),
    Box("vision", ("hands in pictures", "(OpenCV)"), 190, 250),
    Box("models", ("HMM, PTBHMM", "classifiers, codebook"), 510, 20),
    Box("language", ("n-grams, networks", "decoder"), 510, 172),
    Box("recognition", ("word, gesture, sentence", "decision, rejection"), 670, 120),
    Box("fusion", ("speech + gesture", "STOP wins"), 830, 20, colour=PYTHON),
    Box("robot", ("motion, checks", "simulation"), 830, 250, colour=PYTHON),
    Box("core, io", ("types, errors, random numbers, model files: used by all C++ folders",), 350, 250, 460, height=56),
    Box(
        "Python around it",
        ("media, datasets, synthetic · evaluation, studies · live: devices and events · cli, demo",),
        190,
        356,
        780,
        PYTHON,
        56,
    ),
)
ARROWS = (
    ((160, 57), (190, 57)),
    ((160, 287), (190, 287)),
    ((330, 75), (370, 120)),
    ((330, 270), (390, 194)),
    ((490, 140), (520, 94)),
    ((650, 75), (690, 120)),
    ((580, 94), (580, 172)),
    ((650, 205), (686, 194)),
    ((490, 165), (670, 165)),
    ((810, 140), (840, 94)),
    ((900, 94), (900, 250)),
)


def draw() -> str:
    """The whole picture."""
    arrows = "\n".join(
        f'<line x1="{a}" y1="{b}" x2="{c}" y2="{d}" stroke="#333" stroke-width="1.6" marker-end="url(#head)"/>'
        for (a, b), (c, d) in ARROWS
    )
    return f"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}">
<style>text {{ font: 13px sans-serif; text-anchor: middle; fill: #222 }}
.name {{ font-weight: bold; font-size: 15px }}</style>
<defs><marker id="head" markerWidth="9" markerHeight="8" refX="8" refY="4" orient="auto"><path d="M0,0 L9,4 L0,8 z"
fill="#333"/></marker></defs>
<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>
{arrows}
{chr(10).join(box.svg() for box in BOXES)}
<text x="90" y="372" style="fill:#666">blue: C++ and Python</text>
<text x="90" y="392" style="fill:#666">yellow: Python</text>
</svg>
"""


if __name__ == "__main__":
    TARGET.write_text(draw(), encoding="utf-8")
