# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Measured claims on real recordings: ``hri study list``, ``hri study NAME --data DIR``."""

from hri.core.errors import InvalidArgument
from hri.core.suggest import did_you_mean
from hri.studies import (
    adaptation,
    asl_gestures,
    asl_stream,
    classifiers,
    commands,
    commands_curve,
    connected_words,
    cpp_parity,
    denoise,
    distance,
    endpoints,
    endurance,
    false_alarms,
    few_samples,
    fusion,
    fusion_conditions,
    gesture_sentences,
    hand_pairs,
    hands_in_rooms,
    htk_thesis,
    htk_training,
    hybrid_features,
    imitation,
    knowledge,
    mask_quality,
    nao_camera,
    new_words,
    noise,
    parity,
    robot_commands,
    robot_motions,
    sentences,
    session,
    session_signing,
    session_soak,
    session_stop,
    session_talk,
    sign_features,
    signs,
    speech,
    speech_embedding,
    synthetic_speakers,
    tempo,
    training_size,
    unknown_gestures,
    unknown_words,
    unrecorded_words,
    wavelets,
    webcam,
    webcam_live,
    word_trimming,
)
from hri.studies.pictures import draw
from hri.studies.registry import Layout, Study, find_data, run_study

_MODULES = (
    speech,
    speech_embedding,
    commands,
    commands_curve,
    connected_words,
    robot_commands,
    htk_thesis,
    htk_training,
    noise,
    distance,
    tempo,
    synthetic_speakers,
    endpoints,
    word_trimming,
    false_alarms,
    classifiers,
    training_size,
    few_samples,
    new_words,
    unrecorded_words,
    adaptation,
    wavelets,
    denoise,
    unknown_words,
    unknown_gestures,
    webcam,
    webcam_live,
    hybrid_features,
    nao_camera,
    cpp_parity,
    endurance,
    mask_quality,
    hand_pairs,
    hands_in_rooms,
    sentences,
    asl_gestures,
    asl_stream,
    gesture_sentences,
    knowledge,
    signs,
    sign_features,
    fusion,
    fusion_conditions,
    session,
    session_signing,
    session_soak,
    session_stop,
    session_talk,
    imitation,
    parity,
    robot_commands,
    robot_motions,
)

STUDIES: dict[str, Study] = {study.name: study for module in _MODULES for study in module.STUDIES}


def get_study(name: str) -> Study:
    """The study of that name. Raises InvalidArgument that lists the names there are."""
    if name not in STUDIES:
        raise InvalidArgument(f"no study '{name}'; {did_you_mean(name, STUDIES)}")
    return STUDIES[name]


__all__ = ["STUDIES", "Layout", "Study", "draw", "find_data", "get_study", "run_study"]
