# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What ``hri session`` shows: JSON lines, or state, level and hand below a line for whatever was decided and done."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from typing import Any

import click

from hri.cli.live_screen import describe_stream, hand_line, meter
from hri.live import Event
from hri.recognition.decision import RECOGNISED

EXIT_NOT_READ = 141
"""As a shell has it for a program that ends by SIGPIPE."""
_WAIT_TEXT = "{wait:.0f} ms to be decided on, {compute:.0f} ms of computing"


def show_session(events: Iterator[Event], as_json: bool, ended: Callable[[], bool]) -> str:
    """Show events until there are no more, or `ended` says so; why nothing could be heard or seen, if so.

    They are closed then, and also when showing fails.
    """
    lines = as_json or not sys.stdout.isatty()
    failures: dict[str, str] = {}
    began: set[str] = set()
    shown = _Lines() if lines else _Screen()
    close = getattr(events, "close", lambda: None)
    try:
        with shown:
            for event in events:
                shown.show(event)
                if event.event in ("listening", "watching"):
                    began.add(event.mode)
                elif event.event == "stall":
                    failures[event.mode] = str(event.fields["message"])
                if ended():
                    break
    finally:
        close()
    return "" if began else "; ".join(failures.values())


class _Lines:
    """One JSON object a line."""

    def __enter__(self) -> None:
        pass

    def __exit__(self, *_: object) -> None:
        pass

    def show(self, event: Event) -> None:
        try:
            click.echo(event.to_json())
            sys.stdout.flush()
        except BrokenPipeError:  # the program that reads them has ended
            raise click.exceptions.Exit(EXIT_NOT_READ) from None


class _Screen:
    """A few lines that change, below those that stay."""

    def __init__(self) -> None:
        from rich.live import Live

        self._live = Live(refresh_per_second=20)
        self._changing = {"state": "idle", "speech": "", "gesture": ""}

    def __enter__(self) -> None:
        self._live.__enter__()

    def __exit__(self, *_: object) -> None:
        self._live.__exit__(None, None, None)

    def show(self, event: Event) -> None:
        from rich.text import Text

        if event.event == "state":
            self._changing["state"] = str(event.fields["state"])
        elif event.event == "level":
            self._changing["speech"] = meter(event)
        elif event.event in ("hand", "partial", "signing"):
            self._changing["gesture"] = hand_line(event)
        else:
            line = describe(event)
            if line:
                self._live.console.print(Text(line))
        shown = (self._changing["state"].upper(), self._changing["speech"], self._changing["gesture"])
        self._live.update(Text("\n".join(filter(None, shown))))


def _confidence(found: dict[str, Any]) -> str:
    """Of what was recognised; that of a rejected one is the nearest label's."""
    return f" {found['confidence']:.2f}" if found["status"] == RECOGNISED else ""


def describe(event: Event) -> str:
    """One line for people; "" for what they need not read."""
    fields, at = event.fields, f"{event.time:8.2f} s  "
    if event.event == "fused":
        modes = " + ".join(
            f"{name} {fields[mode]['label']}{_confidence(fields[mode])}"
            for mode, name in (("speech", "word"), ("gesture", "sign"))
            if fields[mode]
        )
        label = fields["final"] or fields["status"]
        return f"{at}{label}  ({modes}; {fields['rule']}; {fields['why']})"
    if event.event == "signed":
        return f"{at}signs: {' '.join(fields['words'])}"
    if event.event == "say":
        return f"{at}robot: {fields['text']}"
    if event.event == "voice_end" and fields["message"]:
        return f"{at}not said: {fields['message']}"
    if event.event == "sentence":
        near = f"  (nearest: {' '.join(fields['nearest'])}, {fields['distance']:.2f})" if fields["nearest"] else ""
        return f"{at}sentence: {' '.join(fields['words'])}{near}"
    if event.event in ("ignored", "stop", "rest"):
        name = f" {fields['label']}" if fields["label"] else ""
        return f"{at}{event.event.upper() if event.event == 'stop' else event.event}{name}: {fields['reason']}"
    if event.event in ("motion_start", "halt"):
        latency = _WAIT_TEXT.format(wait=fields["wait_ms"], compute=fields["compute_ms"])
        done = "moves" if event.event == "motion_start" else "begins to stop"
        return f"{at}the robot {done}: {fields['label']}, after {latency}"
    if event.event == "motion_end":
        return f"{at}the robot has {'finished' if fields['completed'] else 'stopped'}: {fields['label']}"
    return describe_stream(event)
