# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""HTK's files: parameters, labels, model definitions, dictionaries, word networks; and what its tools do with them."""

from hri._native import EmbeddedTrainerOptions, HtkFeatureOptions
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
from hri._native import HtkWordLattice as WordLattice
from hri.htk.coding import code_file, load_observations
from hri.htk.listing import list_parameters
from hri.htk.lists import read_list, read_script
from hri.htk.results import HTK_COSTS, Results, compare
from hri.htk.sentences import random_sentence
from hri.htk.training import retrain_model, train_model

__all__ = [
    "HTK_COSTS",
    "Configuration",
    "Dictionary",
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
    "Pronunciation",
    "RecognisedSentence",
    "RecognisedWord",
    "Recognizer",
    "Results",
    "Transcription",
    "WordLattice",
    "code_file",
    "compare",
    "list_parameters",
    "load_observations",
    "random_sentence",
    "read_list",
    "read_script",
    "retrain_model",
    "train_model",
]
