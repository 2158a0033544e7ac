# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Commands of several words that a person writes on the page."""

from __future__ import annotations

from hri.core.errors import Error
from hri.core.phrases import phrase, phrase_of
from hri.language import Grammar
from hri.serve.stage import Stage

_NAME = "the grammar"


def change_commands(stage: Stage, text: bytes) -> tuple[str, int]:
    """Take the sentences of a grammar as commands.

    Parameters
    ----------
    stage : Stage
    text : bytes
        In the JSpeech Grammar Format, UTF-8.

    Returns
    -------
    tuple of str and int
        Why the commands stay as they are, for people, or ""; and how many there are.
    """
    try:
        grammar = Grammar.parse(text.decode("utf-8"), _NAME)
        grammar.sentences(stage.limits.max_sentences)  # refuses more
        stage.command_by(grammar)
    except UnicodeDecodeError:
        return phrase("grammar_no_text"), 0
    except Error as error:
        return phrase_of(error), 0
    return "", 0 if stage.words is None else len(stage.words.classes_)
