# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Model files (safetensors layout, read strictly; as C++ or JSON) and which of their words synthetic voices said, WAV
files, and whether a video file is whole."""

from hri._native import ModelFile, Wav, parse_wav, read_wav, require_whole_video, write_wav_pcm16
from hri.io.export import model_as_cpp, model_as_json
from hri.io.spoken_words import SpokenWords

__all__ = [
    "ModelFile",
    "SpokenWords",
    "Wav",
    "model_as_cpp",
    "model_as_json",
    "parse_wav",
    "read_wav",
    "require_whole_video",
    "write_wav_pcm16",
]
