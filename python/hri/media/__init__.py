# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Sound, pictures and video in and out of files."""

from hri.media.audio import Audio, naming_file, naming_files, read_audio
from hri.media.order import natural_key
from hri.media.picture_size import picture_size
from hri.media.suffixes import AUDIO_SUFFIXES, IMAGE_SUFFIXES, MODEL_SUFFIX, VIDEO_SUFFIXES, kind_of_file
from hri.media.video import (
    DEFAULT_FPS,
    Clip,
    decode_image,
    encode_png,
    frame_rate,
    iterate_frames,
    read_frames,
    read_image,
    read_pictures,
    write_image,
)
from hri.media.video_writer import VideoWriter, write_video

__all__ = [
    "AUDIO_SUFFIXES",
    "DEFAULT_FPS",
    "IMAGE_SUFFIXES",
    "MODEL_SUFFIX",
    "VIDEO_SUFFIXES",
    "Audio",
    "Clip",
    "VideoWriter",
    "decode_image",
    "encode_png",
    "frame_rate",
    "iterate_frames",
    "kind_of_file",
    "naming_file",
    "naming_files",
    "natural_key",
    "picture_size",
    "read_audio",
    "read_frames",
    "read_image",
    "read_pictures",
    "write_image",
    "write_video",
]
