# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Model files (safetensors layout, read strictly; as C++ or JSON), WAV files, and whether a video file is whole."""

from hri._native import ModelFile, Wav, parse_wav, read_wav, require_whole_video, write_wav_pcm16
from hri.io.export import model_as_cpp, model_as_json

__all__ = [
    "ModelFile",
    "Wav",
    "model_as_cpp",
    "model_as_json",
    "parse_wav",
    "read_wav",
    "require_whole_video",
    "write_wav_pcm16",
]
