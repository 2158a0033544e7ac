# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""HTK's files: parameters, labels, model definitions, dictionaries, word networks; and what its tools do with them."""

from hri._native import EmbeddedTrainerOptions, HtkFeatureOptions, ViterbiTrainerOptions
from hri._native import HtkAlignedModel as AlignedModel
from hri._native import HtkAlignedState as AlignedState
from hri._native import HtkConfiguration as Configuration
from hri._native import HtkDictionary as Dictionary
from hri._native import HtkEditScript as EditScript
from hri._native import HtkEmbeddedTrainer as EmbeddedTrainer
from hri._native import HtkFeatureExtractor as FeatureExtractor
from hri._native import HtkFlatStart as FlatStart
from hri._native import HtkLabel as Label
from hri._native import HtkMasterLabelFile as MasterLabelFile
from hri._native import HtkModelOccupation as ModelOccupation
from hri._native import HtkModelSet as ModelSet
from hri._native import HtkParameterFile as ParameterFile
from hri._native import HtkPronunciation as Pronunciation
from hri._native import HtkRecognisedSentence as RecognisedSentence
from hri._native import HtkRecognisedWord as RecognisedWord
from hri._native import HtkRecognizer as Recognizer
from hri._native import HtkTranscription as Transcription
from hri._native import HtkViterbiTraining as ViterbiTraining
from hri._native import HtkVqTable as VqTable
from hri._native import HtkWordLattice as WordLattice
from hri.htk.coding import (
    DISCRETE,
    ParameterHeader,
    Source,
    code_file,
    code_sources,
    load_observations,
    observe_samples,
    observed,
    read_header,
)
from hri.htk.listing import blocks_of, header_of, list_parameters, observation_names
from hri.htk.lists import read_list, read_script
from hri.htk.results import HTK_COSTS, Results, compare
from hri.htk.sentences import (
    DrawnSentence,
    draw_sentence,
    network_statistics,
    random_sentence,
    require_words,
)
from hri.htk.training import retrain_by_baum_welch, train_by_viterbi, train_model
from hri.htk.word_spotting import WordSpotting

__all__ = [
    "DISCRETE",
    "HTK_COSTS",
    "AlignedModel",
    "AlignedState",
    "Configuration",
    "Dictionary",
    "DrawnSentence",
    "EditScript",
    "EmbeddedTrainer",
    "EmbeddedTrainerOptions",
    "FeatureExtractor",
    "FlatStart",
    "HtkFeatureOptions",
    "Label",
    "MasterLabelFile",
    "ModelOccupation",
    "ModelSet",
    "ParameterFile",
    "ParameterHeader",
    "Pronunciation",
    "RecognisedSentence",
    "RecognisedWord",
    "Recognizer",
    "Results",
    "Source",
    "Transcription",
    "ViterbiTrainerOptions",
    "ViterbiTraining",
    "VqTable",
    "WordLattice",
    "WordSpotting",
    "blocks_of",
    "code_file",
    "code_sources",
    "compare",
    "draw_sentence",
    "header_of",
    "list_parameters",
    "load_observations",
    "network_statistics",
    "observation_names",
    "observe_samples",
    "observed",
    "random_sentence",
    "read_header",
    "read_list",
    "read_script",
    "require_words",
    "retrain_by_baum_welch",
    "train_by_viterbi",
    "train_model",
]
