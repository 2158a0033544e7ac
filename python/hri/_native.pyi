# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
# Written by tools/generate_stubs.py from the compiled module; do not edit.
"""
libhri's core: signal, features, models, language, recognition and HTK's files, without OpenCV.
"""

from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import os
import typing

__all__: list[str] = [
    "ActivityOptions",
    "AtomicFile",
    "CepstraComputer",
    "CepstraOptions",
    "CepstraStream",
    "ChainCodeComputer",
    "ChainCodeOptions",
    "Codebook",
    "CodebookOptions",
    "CodebookReport",
    "ConfusedPair",
    "ConfusionSlot",
    "ConnectedDecoder",
    "ConnectedDecoderOptions",
    "ConnectedWordRecognizer",
    "ConnectedWordRecognizerOptions",
    "ConnectedWordResult",
    "ConnectedWordStream",
    "ConnectedWordStreamOptions",
    "Decision",
    "DecodedSentence",
    "DecodedWord",
    "DiscreteHmm",
    "DiscreteHmmOptions",
    "DiscreteHmmStream",
    "DistanceClassifier",
    "DistanceClassifierOptions",
    "EmbeddedTrainerOptions",
    "Endpoint",
    "Endpointer",
    "EndpointerOptions",
    "Error",
    "FilterBankOptions",
    "FixedPointHmmSet",
    "FormatError",
    "ForwardBackward",
    "FourierDescriptorComputer",
    "FourierDescriptorOptions",
    "GaussianBayes",
    "GaussianBayesOptions",
    "GaussianEmissions",
    "GaussianMixture",
    "GaussianMixtureHmm",
    "GaussianMixtureHmmOptions",
    "GaussianMixtureHmmStream",
    "GaussianMixtureOptions",
    "GestureFeatureComputer",
    "GestureRecognizer",
    "GestureRecognizerOptions",
    "GestureSegment",
    "GestureSegmenter",
    "GestureSegmenterOptions",
    "Grammar",
    "HAND_TRACK_COLUMNS",
    "HandColourOptions",
    "HandFeatureComputer",
    "HandFeatureOptions",
    "HandFinderOptions",
    "HandObservation",
    "HandPairOptions",
    "HandPairTracker",
    "HandTrackComputer",
    "HandTrackOptions",
    "HeldOutReport",
    "HtkAlignedModel",
    "HtkAlignedState",
    "HtkConfiguration",
    "HtkDictionary",
    "HtkEditScript",
    "HtkEmbeddedTrainer",
    "HtkFeatureExtractor",
    "HtkFeatureOptions",
    "HtkFlatStart",
    "HtkLabel",
    "HtkMasterLabelFile",
    "HtkModelOccupation",
    "HtkModelSet",
    "HtkParameterFile",
    "HtkPronunciation",
    "HtkRecognisedSentence",
    "HtkRecognisedWord",
    "HtkRecognizer",
    "HtkTranscription",
    "HtkViterbiTraining",
    "HtkVqTable",
    "HtkWordLattice",
    "HybridFeatureComputer",
    "HybridFeatureOptions",
    "Interrupted",
    "InvalidArgument",
    "IoError",
    "Knn",
    "KnnOptions",
    "LEARNED_STILL_CHANGE",
    "LandmarkPairOptions",
    "LandmarkPairTracker",
    "Lattice",
    "LatticeOptions",
    "Lda",
    "LdaOptions",
    "LinearSvm",
    "LinearSvmOptions",
    "LogisticRegression",
    "LogisticRegressionOptions",
    "MarkovChain",
    "MaskSmoothingOptions",
    "ModelFile",
    "MultiStreamCodebook",
    "NBest",
    "NGramFit",
    "NGramModel",
    "NGramOptions",
    "NUM_LANDMARKS",
    "OptionField",
    "OrientationHistogramOptions",
    "PairedHand",
    "Pca",
    "PossibilisticEmissions",
    "PossibilisticGaussianHmmSet",
    "PossibilisticHmmOptions",
    "PossibilisticHmmSet",
    "PossibilisticHmmStream",
    "PossibilisticRule",
    "PossibilityClassifier",
    "RbfClassifier",
    "RbfClassifierOptions",
    "RecognisedSentence",
    "RecognisedSign",
    "ScoredRecording",
    "SentenceEvent",
    "SentenceRecognizer",
    "SentenceRecognizerOptions",
    "SentenceStream",
    "SentenceStreamOptions",
    "SequenceModelOptions",
    "SequenceNetwork",
    "SequenceNetworkOptions",
    "ShrinkageOptions",
    "SilhouetteCepstrumComputer",
    "SilhouetteCepstrumOptions",
    "SilhouetteOptions",
    "SoftmaxRegression",
    "SoftmaxRegressionOptions",
    "SpeakerAdapter",
    "SpeakerAdapterOptions",
    "SpeechEmbedding",
    "SpeechEmbeddingOptions",
    "StateChoice",
    "StateChoiceOptions",
    "StatePossibilities",
    "StreamedSign",
    "SubwordRecognizer",
    "SubwordRecognizerOptions",
    "TWO_HAND_TRACK_COLUMNS",
    "Topology",
    "TrainingReport",
    "TranscribedWord",
    "Transcript",
    "TranscriptAlternative",
    "TwoHandFeatureComputer",
    "TwoHandFeatureOptions",
    "UtteranceDecision",
    "ViterbiTrainerOptions",
    "Wav",
    "WaveletDescriptorComputer",
    "WaveletDescriptorOptions",
    "WaveletStream32",
    "WaveletStream64",
    "WaveletStreamOptions",
    "WordChain",
    "WordNetwork",
    "WordRecognizer",
    "WordRecognizerOptions",
    "activity_frames",
    "approximate",
    "b_spline_wavelet",
    "best_basis",
    "bhattacharyya_gaussian",
    "chain_code",
    "choose_num_states",
    "denoise",
    "direction_code",
    "distance",
    "dwt",
    "dwt2",
    "filter_bank",
    "filter_edges",
    "find_speech",
    "frequency_order",
    "hand_place",
    "hand_scale_px",
    "hu_features",
    "hu_moments",
    "idwt",
    "idwt2",
    "initial_start",
    "initial_transition",
    "iswt",
    "landmark_column_names",
    "landmark_features",
    "linear_prediction",
    "lpc_cepstrum",
    "max_dwt_level",
    "min_frames_of_htk_model",
    "necessity_of",
    "noise_level",
    "normalise_time",
    "num_threads",
    "orientation_histogram",
    "pair_rows",
    "parse_wav",
    "possibilities",
    "possibility_of",
    "read_file",
    "read_wav",
    "reconstruct_packets",
    "require_whole_video",
    "resample",
    "resample_contour",
    "set_num_threads",
    "shape_axis",
    "shape_moments",
    "shape_number",
    "shrink",
    "shrinkage_threshold",
    "spectral_envelope",
    "swt",
    "trace_contour",
    "track_rows",
    "train_htk_model_by_viterbi",
    "wavedec",
    "wavedec2",
    "wavelet_filters",
    "wavelet_names",
    "wavelet_packets",
    "waverec",
    "waverec2",
    "write_wav_pcm16",
]

class Error(Exception):
    """
    Root of hri's errors.
    """

class InvalidArgument(Error, ValueError):
    """
    A value outside its documented range.
    """

class FormatError(Error, ValueError):
    """
    A file breaks its format.
    """

class IoError(Error, OSError):
    """
    The operating system refused a file operation.
    """

class Interrupted(KeyboardInterrupt):
    """
    Training was interrupted; nothing was kept.
    """

class OptionField:
    """
    What a field of an options class is.
    """
    @property
    def choices(self) -> list[str]:
        """
        Names that it may hold; empty for other types.
        """
    @property
    def default(self) -> typing.Any:
        """
        As a plain value: a dict for a nested class.
        """
    @property
    def description(self) -> str:
        """
        What it does.
        """
    @property
    def name(self) -> str:
        """
        As in C++.
        """
    @property
    def options(self) -> typing.Any:
        """
        The class of a nested field, otherwise None.
        """
    @property
    def range(self) -> str:
        """
        Values that it may hold; empty where the type says so.
        """
    @property
    def type(self) -> str:
        """
        Its type in Python.
        """
    @property
    def unit(self) -> str:
        """
        Empty for a field without one.
        """

class AtomicFile:
    """
    A file that appears whole or not at all, written beside its place.
    """
    def __init__(self, path: str | bytes | os.PathLike[str]) -> None:
        """
        Raises IoError where it could not be written.
        """
    def commit(self) -> None:
        """
        Syncs it to the disk and gives it its name; raises IoError.
        """
    def discard(self) -> None:
        """
        Leaves nothing behind; after `commit` this does nothing.
        """
    def write(self, data: bytes) -> None:
        """
        Appends; raises IoError.
        """
    @property
    def temporary_path(self) -> str:
        """
        Where it is until then; with the suffix of its place.
        """

class ModelFile:
    """
    Tensors and metadata in the safetensors layout; strict reader.
    """
    @staticmethod
    def from_bytes(data: bytes, name: str = "bytes") -> ModelFile:
        """
        Reads what `to_bytes` gave, as strictly.
        """
    @staticmethod
    def read(path: str | bytes | os.PathLike[str]) -> ModelFile:
        """
        Reads a whole file; raises IoError, or FormatError naming file and field.
        """
    def __init__(self) -> None: ...
    def has(self, name: str) -> bool:
        """
        Whether there is a tensor or metadata of that name.
        """
    def integer(self, key: str) -> int:
        """
        Metadata as a whole number.
        """
    def matrix_d(self, name: str) -> numpy.typing.NDArray[numpy.float64]:
        """
        A tensor as float64, shape (rows, columns).
        """
    def matrix_f(self, name: str) -> numpy.typing.NDArray[numpy.float32]:
        """
        A tensor as float32, shape (rows, columns).
        """
    def metadata(self) -> dict[str, str]:
        """
        All metadata as a dict of text.
        """
    def number(self, key: str) -> float:
        """
        Metadata as a finite number.
        """
    def require_all_read(self) -> None:
        """
        Raises FormatError that names a field or tensor which nothing has asked for.
        """
    def set_integer(self, key: str, value: typing.SupportsInt | typing.SupportsIndex) -> None:
        """
        Set metadata to a whole number.
        """
    def set_matrix_d(self, name: str, values: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        """
        Set a tensor of float64.
        """
    def set_matrix_f(self, name: str, values: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> None:
        """
        Set a tensor of float32.
        """
    def set_number(self, key: str, value: typing.SupportsFloat | typing.SupportsIndex) -> None:
        """
        Set metadata to a finite number.
        """
    def set_text(self, key: str, value: str) -> None:
        """
        Set metadata, UTF-8.
        """
    def set_text_list(self, key: str, values: collections.abc.Sequence[str]) -> None:
        """
        Set metadata to a list of texts.
        """
    def tensor_shapes(self) -> dict[str, tuple[int, int]]:
        """
        Name to (rows, columns).
        """
    def text(self, key: str) -> str:
        """
        Metadata; raises FormatError without it.
        """
    def text_list(self, key: str) -> list[str]:
        """
        Metadata as a list of texts.
        """
    def to_bytes(self) -> bytes:
        """
        What `write` writes.
        """
    def write(self, path: str | bytes | os.PathLike[str]) -> None:
        """
        Writes beside the old file, syncs, and renames.
        """
    @property
    def kind(self) -> str:
        """
        What it holds, such as 'word_recognizer'.
        """
    @kind.setter
    def kind(self, arg1: str) -> None: ...

class Wav:
    """
    Mono samples of a WAV file.
    """
    @property
    def notes(self) -> list[str]:
        """
        What was done to the audio on reading.
        """
    @property
    def num_channels(self) -> int:
        """
        Channels of the file; they are averaged.
        """
    @property
    def sample_rate_hz(self) -> int:
        """
        Samples a second.
        """
    @property
    def samples(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, shape (num_samples,), full scale 1.
        """

class FilterBankOptions:
    """
    Triangular filters over a power spectrum.

    Parameters
    ----------
    kind : {'mel', 'hfcc'}, default 'mel'
        shape of the filters
    num_filters : int, default 26
        number of filters; 1..512
    low_hz : float, default 100.0
        lower edge of the first filter; 0..192000 Hz
    high_hz : float, default 0.0
        upper edge of the last filter; 0: half the sample rate; 0..192000 Hz
    erb_factor : float, default 1.0
        E of HFCC-E: filters E times as wide as an ear's; mel ignores it; 0.1..10
    warp : float, default 1.0
        vocal-tract-length factor on all filter frequencies; 0.5..2
    warp_low_hz : float, default 0.0
        below it the warp bends back to low_hz; 0, with warp_high_hz: it does not bend; 0..192000 Hz
    warp_high_hz : float, default 0.0
        above it the warp bends back to high_hz; 0..192000 Hz
    mel_scale : {'htk', 'slaney'}, default 'htk'
        mel scale of the filters' spacing; HFCC uses HTK's
    axis : {'hz', 'mel'}, default 'hz'
        axis on which the filters are triangles
    unit_area : bool, default False
        weights times 2 / (high - low), for filters of equal area
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        kind: typing.Literal["mel", "hfcc"] = "mel",
        num_filters: int = 26,
        low_hz: float = 100.0,
        high_hz: float = 0.0,
        erb_factor: float = 1.0,
        warp: float = 1.0,
        warp_low_hz: float = 0.0,
        warp_high_hz: float = 0.0,
        mel_scale: typing.Literal["htk", "slaney"] = "htk",
        axis: typing.Literal["hz", "mel"] = "hz",
        unit_area: bool = False,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def axis(self) -> typing.Literal["hz", "mel"]:
        """
        axis on which the filters are triangles
        """
    @axis.setter
    def axis(self, arg1: typing.Any) -> None: ...
    @property
    def erb_factor(self) -> float:
        """
        E of HFCC-E: filters E times as wide as an ear's; mel ignores it
        """
    @erb_factor.setter
    def erb_factor(self, arg1: typing.Any) -> None: ...
    @property
    def high_hz(self) -> float:
        """
        upper edge of the last filter; 0: half the sample rate
        """
    @high_hz.setter
    def high_hz(self, arg1: typing.Any) -> None: ...
    @property
    def kind(self) -> typing.Literal["mel", "hfcc"]:
        """
        shape of the filters
        """
    @kind.setter
    def kind(self, arg1: typing.Any) -> None: ...
    @property
    def low_hz(self) -> float:
        """
        lower edge of the first filter
        """
    @low_hz.setter
    def low_hz(self, arg1: typing.Any) -> None: ...
    @property
    def mel_scale(self) -> typing.Literal["htk", "slaney"]:
        """
        mel scale of the filters' spacing; HFCC uses HTK's
        """
    @mel_scale.setter
    def mel_scale(self, arg1: typing.Any) -> None: ...
    @property
    def num_filters(self) -> int:
        """
        number of filters
        """
    @num_filters.setter
    def num_filters(self, arg1: typing.Any) -> None: ...
    @property
    def unit_area(self) -> bool:
        """
        weights times 2 / (high - low), for filters of equal area
        """
    @unit_area.setter
    def unit_area(self, arg1: typing.Any) -> None: ...
    @property
    def warp(self) -> float:
        """
        vocal-tract-length factor on all filter frequencies
        """
    @warp.setter
    def warp(self, arg1: typing.Any) -> None: ...
    @property
    def warp_high_hz(self) -> float:
        """
        above it the warp bends back to high_hz
        """
    @warp_high_hz.setter
    def warp_high_hz(self, arg1: typing.Any) -> None: ...
    @property
    def warp_low_hz(self) -> float:
        """
        below it the warp bends back to low_hz; 0, with warp_high_hz: it does not bend
        """
    @warp_low_hz.setter
    def warp_low_hz(self, arg1: typing.Any) -> None: ...

class ActivityOptions:
    """
    Where a clip holds speech.

    Parameters
    ----------
    frame_ms : float, default 25.0
        length of a frame; 1..1000 ms
    shift_ms : float, default 10.0
        time from frame to frame; 1..1000 ms
    silence_dbfs : float, default -70.0
        level below which a frame is silent; -120..0 dBFS
    margin_db : float, default 4.0
        how far sound is above the noise, over all bands; 0..60 dB
    max_depth_db : float, default 30.0
        lowest level of a sound, below the loudest voiced frame; 1..120 dB
    min_voicing : float, default 1.15
        least voicing of a word, its clarity times its duration; 0..10
    max_gap_ms : float, default 300.0
        longest silence within a word, as before a plosive; 0..2000 ms
    padding_ms : float, default 30.0
        kept before and after the word; 0..1000 ms
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        frame_ms: float = 25.0,
        shift_ms: float = 10.0,
        silence_dbfs: float = -70.0,
        margin_db: float = 4.0,
        max_depth_db: float = 30.0,
        min_voicing: float = 1.15,
        max_gap_ms: float = 300.0,
        padding_ms: float = 30.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def frame_ms(self) -> float:
        """
        length of a frame
        """
    @frame_ms.setter
    def frame_ms(self, arg1: typing.Any) -> None: ...
    @property
    def margin_db(self) -> float:
        """
        how far sound is above the noise, over all bands
        """
    @margin_db.setter
    def margin_db(self, arg1: typing.Any) -> None: ...
    @property
    def max_depth_db(self) -> float:
        """
        lowest level of a sound, below the loudest voiced frame
        """
    @max_depth_db.setter
    def max_depth_db(self, arg1: typing.Any) -> None: ...
    @property
    def max_gap_ms(self) -> float:
        """
        longest silence within a word, as before a plosive
        """
    @max_gap_ms.setter
    def max_gap_ms(self, arg1: typing.Any) -> None: ...
    @property
    def min_voicing(self) -> float:
        """
        least voicing of a word, its clarity times its duration
        """
    @min_voicing.setter
    def min_voicing(self, arg1: typing.Any) -> None: ...
    @property
    def padding_ms(self) -> float:
        """
        kept before and after the word
        """
    @padding_ms.setter
    def padding_ms(self, arg1: typing.Any) -> None: ...
    @property
    def shift_ms(self) -> float:
        """
        time from frame to frame
        """
    @shift_ms.setter
    def shift_ms(self, arg1: typing.Any) -> None: ...
    @property
    def silence_dbfs(self) -> float:
        """
        level below which a frame is silent
        """
    @silence_dbfs.setter
    def silence_dbfs(self, arg1: typing.Any) -> None: ...

class EndpointerOptions:
    """
    When an utterance in a stream begins and ends.

    Parameters
    ----------
    activity : ActivityOptions or dict
        how speech is found
    hangover_ms : float, default 300.0
        silence that ends an utterance; 50..5000 ms
    pause_ms : float, default 0.0
        silence in an utterance after which what was said so far is reported, as if it ended there; 0: never, as where that is not shorter than hangover_ms; 0..5000 ms
    context_ms : float, default 300.0
        noise kept from before an utterance, to estimate its level; 50..5000 ms
    max_utterance_ms : float, default 5000.0
        longest utterance; a longer one is cut; 500..60000 ms
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        activity: ActivityOptions | collections.abc.Mapping[str, typing.Any] = ...,
        hangover_ms: float = 300.0,
        pause_ms: float = 0.0,
        context_ms: float = 300.0,
        max_utterance_ms: float = 5000.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def activity(self) -> ActivityOptions:
        """
        how speech is found
        """
    @activity.setter
    def activity(self, arg1: typing.Any) -> None: ...
    @property
    def context_ms(self) -> float:
        """
        noise kept from before an utterance, to estimate its level
        """
    @context_ms.setter
    def context_ms(self, arg1: typing.Any) -> None: ...
    @property
    def hangover_ms(self) -> float:
        """
        silence that ends an utterance
        """
    @hangover_ms.setter
    def hangover_ms(self, arg1: typing.Any) -> None: ...
    @property
    def max_utterance_ms(self) -> float:
        """
        longest utterance; a longer one is cut
        """
    @max_utterance_ms.setter
    def max_utterance_ms(self, arg1: typing.Any) -> None: ...
    @property
    def pause_ms(self) -> float:
        """
        silence in an utterance after which what was said so far is reported, as if it ended there; 0: never, as where that is not shorter than hangover_ms
        """
    @pause_ms.setter
    def pause_ms(self, arg1: typing.Any) -> None: ...

class Endpoint:
    """
    An event; positions are samples since the stream began.
    """
    @property
    def at(self) -> int:
        """
        Samples processed when this was decided.
        """
    @property
    def cut(self) -> bool:
        """
        It reached max_utterance_ms.
        """
    @property
    def first(self) -> int:
        """
        First sample of the utterance.
        """
    @property
    def kind(self) -> typing.Literal["none", "speech_start", "speech_end", "speech_dropped", "speech_pause"]:
        """
        Which event: 'none', 'speech_start', 'speech_pause', 'speech_end' or 'speech_dropped'.
        """
    @property
    def last(self) -> int:
        """
        The sample behind its last.
        """
    @property
    def segment_first(self) -> int:
        """
        First sample of the utterance with the noise around it.
        """
    @property
    def segment_last(self) -> int:
        """
        The sample behind the last of these.
        """

class Endpointer:
    """
    Finds utterances in a stream, whatever the size of its blocks.
    """
    def __init__(
        self, sample_rate_hz: typing.SupportsInt | typing.SupportsIndex, options: EndpointerOptions = ...
    ) -> None: ...
    def finish(self) -> list[Endpoint]:
        """
        The last events; the next stream may begin.
        """
    def push(self, samples: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> list[Endpoint]:
        """
        The events in the next samples of the stream.
        """
    @property
    def excess_db(self) -> float:
        """
        Excess of that level over the noise floor.
        """
    @property
    def in_speech(self) -> bool:
        """
        Speech has begun and not ended.
        """
    @property
    def level_db(self) -> float:
        """
        Level of the last frame, relative to full scale.
        """
    @property
    def num_samples(self) -> int:
        """
        Samples processed so far.
        """
    @property
    def options(self) -> EndpointerOptions:
        """
        As passed, with defaults filled in.
        """

class ShrinkageOptions:
    """
    Noise reduction by wavelets.

    Parameters
    ----------
    wavelet : str, default 'sym8'
        wavelet of the transform; the name of a wavelet, such as 'db4'
    border : {'symmetric', 'zero', 'constant', 'periodic', 'reflect', 'periodization', 'smooth', 'antisymmetric', 'antireflect'}, default 'symmetric'
        how the signal goes on beyond its ends
    num_levels : int, default 0
        levels of the transform; 0: five, or as many as the signal has room for; 0..62
    rule : {'universal', 'sure', 'bayes'}, default 'bayes'
        how the threshold follows from the noise
    shape : {'soft', 'hard', 'garrote'}, default 'soft'
        how coefficients shrink
    noise : {'quietest', 'per_level', 'finest'}, default 'quietest'
        how the noise is estimated
    strength : float, default 1.0
        factor of all thresholds; 0..1000000
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        wavelet: str = "sym8",
        border: typing.Literal[
            "symmetric",
            "zero",
            "constant",
            "periodic",
            "reflect",
            "periodization",
            "smooth",
            "antisymmetric",
            "antireflect",
        ] = "symmetric",
        num_levels: int = 0,
        rule: typing.Literal["universal", "sure", "bayes"] = "bayes",
        shape: typing.Literal["soft", "hard", "garrote"] = "soft",
        noise: typing.Literal["quietest", "per_level", "finest"] = "quietest",
        strength: float = 1.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def border(
        self,
    ) -> typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ]:
        """
        how the signal goes on beyond its ends
        """
    @border.setter
    def border(self, arg1: typing.Any) -> None: ...
    @property
    def noise(self) -> typing.Literal["quietest", "per_level", "finest"]:
        """
        how the noise is estimated
        """
    @noise.setter
    def noise(self, arg1: typing.Any) -> None: ...
    @property
    def num_levels(self) -> int:
        """
        levels of the transform; 0: five, or as many as the signal has room for
        """
    @num_levels.setter
    def num_levels(self, arg1: typing.Any) -> None: ...
    @property
    def rule(self) -> typing.Literal["universal", "sure", "bayes"]:
        """
        how the threshold follows from the noise
        """
    @rule.setter
    def rule(self, arg1: typing.Any) -> None: ...
    @property
    def shape(self) -> typing.Literal["soft", "hard", "garrote"]:
        """
        how coefficients shrink
        """
    @shape.setter
    def shape(self, arg1: typing.Any) -> None: ...
    @property
    def strength(self) -> float:
        """
        factor of all thresholds
        """
    @strength.setter
    def strength(self, arg1: typing.Any) -> None: ...
    @property
    def wavelet(self) -> str:
        """
        wavelet of the transform
        """
    @wavelet.setter
    def wavelet(self, arg1: typing.Any) -> None: ...

class WaveletStreamOptions:
    """
    What a stream of samples is transformed by.

    Parameters
    ----------
    wavelet : str, default 'db4'
        wavelet of the transform; the name of a wavelet, such as 'db4'
    num_levels : int, default 3
        levels of the transform; 1..30
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(self, *, wavelet: str = "db4", num_levels: int = 3) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def num_levels(self) -> int:
        """
        levels of the transform
        """
    @num_levels.setter
    def num_levels(self, arg1: typing.Any) -> None: ...
    @property
    def wavelet(self) -> str:
        """
        wavelet of the transform
        """
    @wavelet.setter
    def wavelet(self, arg1: typing.Any) -> None: ...

class WaveletStream32:
    """
    The transform of a signal that arrives in pieces.
    """
    def __init__(self, options: WaveletStreamOptions) -> None: ...
    def finish(self) -> list:
        """
        The rest, as if zeros followed; then it starts anew.
        """
    def push(self, samples: numpy.typing.NDArray[numpy.float32]) -> list:
        """
        Coefficients that have become final: [approximation, coarsest detail, ..., finest].
        """
    def reset(self) -> None:
        """
        Forgets what was pushed.
        """

class WaveletStream64:
    """
    The transform of a signal that arrives in pieces.
    """
    def __init__(self, options: WaveletStreamOptions) -> None: ...
    def finish(self) -> list:
        """
        The rest, as if zeros followed; then it starts anew.
        """
    def push(self, samples: numpy.typing.NDArray[numpy.float64]) -> list:
        """
        Coefficients that have become final: [approximation, coarsest detail, ..., finest].
        """
    def reset(self) -> None:
        """
        Forgets what was pushed.
        """

class CepstraOptions:
    """
    Cepstra of speech (MFCC, HFCC, LPCC).

    Parameters
    ----------
    sample_rate_hz : int, default 16000
        sample rate of the audio; 0, in a recogniser only: the lowest of the training recordings, at most 16000; 1000..384000, or 0 Hz
    frame_length_ms : float, default 25.0
        length of a frame; 1..1000 ms
    frame_shift_ms : float, default 10.0
        time from frame to frame; 1..1000 ms
    padding : {'none', 'centred'}, default 'none'
        whether zeros surround the audio
    sample_scale : float, default 1.0
        factor on the samples; 32768: as if they were 16-bit integers; 0..1000000, 0 excluded
    remove_dc : bool, default False
        subtract the mean of every frame
    pre_emphasis : float, default 0.97
        coefficient of the pre-emphasis; 0: off; 0..1
    frame_pre_emphasis : bool, default False
        pre-emphasis begins anew in every frame, as in HTK and Kaldi
    window : {'hamming', 'hann', 'hann_periodic', 'povey', 'rectangular'}, default 'hamming'
        window of a frame
    fft_size : int, default 0
        size of the FFT, at least the frame's samples; 0: the next power of two; 0..65536, even
    kind : {'filter_bank', 'linear_prediction'}, default 'filter_bank'
        what the cepstra are taken of
    lpc_order : int, default 12
        order of linear prediction; 1..64
    filter_bank : {'mel', 'hfcc'}, default 'mel'
        shape of the filters
    num_filters : int, default 26
        number of filters; 1..512
    low_hz : float, default 100.0
        lower edge of the first filter; 0..192000 Hz
    high_hz : float, default 0.0
        upper edge of the last filter; 0: half the sample rate; 0..192000 Hz
    erb_factor : float, default 1.0
        bandwidth factor E of HFCC-E; 0.1..10
    warp : float, default 1.0
        vocal-tract-length factor on the filter frequencies; 0.5..2
    warp_low_hz : float, default 0.0
        below it the warp bends back to low_hz; 0, with warp_high_hz: it does not bend; 0..192000 Hz
    warp_high_hz : float, default 0.0
        above it the warp bends back to high_hz; 0..192000 Hz
    mel_scale : {'htk', 'slaney'}, default 'htk'
        mel scale of the filters' spacing
    filter_axis : {'hz', 'mel'}, default 'hz'
        axis on which the filters are triangles
    unit_area : bool, default False
        filters of equal area, not of equal height
    use_power : bool, default True
        filters over the power; False: over the magnitude
    energy_floor : float, default 1e-10
        least energy of a filter, which keeps the log of digital silence finite; 1e-30..1e+30
    decibels : bool, default False
        10 log10 in place of ln
    top_db : float, default 0.0
        filters this far below the loudest of the utterance are raised to that; 0: off; 0..1000 dB
    num_cepstra : int, default 12
        c1 .. c_num, below num_filters (linear prediction: up to 64); 1..511
    use_c0 : bool, default True
        c0, the log energy of all filters, in front
    use_energy : bool, default False
        in the place of c0 the log energy of the frame before pre-emphasis
    htk_c0 : bool, default False
        c0 (or the energy) behind the others, and c0 sqrt(2) times as large
    lifter : float, default 22.0
        HTK's sine lifter; 0: off; 0..1000000
    rasta_pole : float, default 0.0
        pole of the RASTA filter (0.94 or 0.98 are usual); 0: off; 0..1, 1 excluded
    normalisation : {'none', 'level', 'mean', 'mean_variance', 'running_mean', 'running_mean_variance'}, default 'mean'
        what is normalised along time
    running_s : float, default 2.0
        memory of the running normalisations; 0..1000000, 0 excluded s
    delta_orders : int, default 2
        0: static only, 1: with deltas, 2: and accelerations; 0..2
    delta_window : int, default 2
        frames on each side of the regression; 1..10
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    @staticmethod
    def htk(sample_rate_hz: typing.SupportsInt | typing.SupportsIndex = 16000) -> CepstraOptions:
        """
        HTK's MFCC_0 by the configuration of the HTK book: c1 .. c12, c0.
        """
    @staticmethod
    def kaldi(sample_rate_hz: typing.SupportsInt | typing.SupportsIndex = 16000) -> CepstraOptions:
        """
        Kaldi's compute-mfcc-feats by its defaults, without dither: log energy, c1 .. c12.
        """
    @staticmethod
    def librosa(sample_rate_hz: typing.SupportsInt | typing.SupportsIndex = 22050) -> CepstraOptions:
        """
        librosa.feature.mfcc by its defaults: 20 cepstra of 128 filters.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        sample_rate_hz: int = 16000,
        frame_length_ms: float = 25.0,
        frame_shift_ms: float = 10.0,
        padding: typing.Literal["none", "centred"] = "none",
        sample_scale: float = 1.0,
        remove_dc: bool = False,
        pre_emphasis: float = 0.97,
        frame_pre_emphasis: bool = False,
        window: typing.Literal["hamming", "hann", "hann_periodic", "povey", "rectangular"] = "hamming",
        fft_size: int = 0,
        kind: typing.Literal["filter_bank", "linear_prediction"] = "filter_bank",
        lpc_order: int = 12,
        filter_bank: typing.Literal["mel", "hfcc"] = "mel",
        num_filters: int = 26,
        low_hz: float = 100.0,
        high_hz: float = 0.0,
        erb_factor: float = 1.0,
        warp: float = 1.0,
        warp_low_hz: float = 0.0,
        warp_high_hz: float = 0.0,
        mel_scale: typing.Literal["htk", "slaney"] = "htk",
        filter_axis: typing.Literal["hz", "mel"] = "hz",
        unit_area: bool = False,
        use_power: bool = True,
        energy_floor: float = 1e-10,
        decibels: bool = False,
        top_db: float = 0.0,
        num_cepstra: int = 12,
        use_c0: bool = True,
        use_energy: bool = False,
        htk_c0: bool = False,
        lifter: float = 22.0,
        rasta_pole: float = 0.0,
        normalisation: typing.Literal[
            "none", "level", "mean", "mean_variance", "running_mean", "running_mean_variance"
        ] = "mean",
        running_s: float = 2.0,
        delta_orders: int = 2,
        delta_window: int = 2,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def decibels(self) -> bool:
        """
        10 log10 in place of ln
        """
    @decibels.setter
    def decibels(self, arg1: typing.Any) -> None: ...
    @property
    def delta_orders(self) -> int:
        """
        0: static only, 1: with deltas, 2: and accelerations
        """
    @delta_orders.setter
    def delta_orders(self, arg1: typing.Any) -> None: ...
    @property
    def delta_window(self) -> int:
        """
        frames on each side of the regression
        """
    @delta_window.setter
    def delta_window(self, arg1: typing.Any) -> None: ...
    @property
    def energy_floor(self) -> float:
        """
        least energy of a filter, which keeps the log of digital silence finite
        """
    @energy_floor.setter
    def energy_floor(self, arg1: typing.Any) -> None: ...
    @property
    def erb_factor(self) -> float:
        """
        bandwidth factor E of HFCC-E
        """
    @erb_factor.setter
    def erb_factor(self, arg1: typing.Any) -> None: ...
    @property
    def fft_size(self) -> int:
        """
        size of the FFT, at least the frame's samples; 0: the next power of two
        """
    @fft_size.setter
    def fft_size(self, arg1: typing.Any) -> None: ...
    @property
    def filter_axis(self) -> typing.Literal["hz", "mel"]:
        """
        axis on which the filters are triangles
        """
    @filter_axis.setter
    def filter_axis(self, arg1: typing.Any) -> None: ...
    @property
    def filter_bank(self) -> typing.Literal["mel", "hfcc"]:
        """
        shape of the filters
        """
    @filter_bank.setter
    def filter_bank(self, arg1: typing.Any) -> None: ...
    @property
    def frame_length_ms(self) -> float:
        """
        length of a frame
        """
    @frame_length_ms.setter
    def frame_length_ms(self, arg1: typing.Any) -> None: ...
    @property
    def frame_pre_emphasis(self) -> bool:
        """
        pre-emphasis begins anew in every frame, as in HTK and Kaldi
        """
    @frame_pre_emphasis.setter
    def frame_pre_emphasis(self, arg1: typing.Any) -> None: ...
    @property
    def frame_shift_ms(self) -> float:
        """
        time from frame to frame
        """
    @frame_shift_ms.setter
    def frame_shift_ms(self, arg1: typing.Any) -> None: ...
    @property
    def high_hz(self) -> float:
        """
        upper edge of the last filter; 0: half the sample rate
        """
    @high_hz.setter
    def high_hz(self, arg1: typing.Any) -> None: ...
    @property
    def htk_c0(self) -> bool:
        """
        c0 (or the energy) behind the others, and c0 sqrt(2) times as large
        """
    @htk_c0.setter
    def htk_c0(self, arg1: typing.Any) -> None: ...
    @property
    def kind(self) -> typing.Literal["filter_bank", "linear_prediction"]:
        """
        what the cepstra are taken of
        """
    @kind.setter
    def kind(self, arg1: typing.Any) -> None: ...
    @property
    def lifter(self) -> float:
        """
        HTK's sine lifter; 0: off
        """
    @lifter.setter
    def lifter(self, arg1: typing.Any) -> None: ...
    @property
    def low_hz(self) -> float:
        """
        lower edge of the first filter
        """
    @low_hz.setter
    def low_hz(self, arg1: typing.Any) -> None: ...
    @property
    def lpc_order(self) -> int:
        """
        order of linear prediction
        """
    @lpc_order.setter
    def lpc_order(self, arg1: typing.Any) -> None: ...
    @property
    def mel_scale(self) -> typing.Literal["htk", "slaney"]:
        """
        mel scale of the filters' spacing
        """
    @mel_scale.setter
    def mel_scale(self, arg1: typing.Any) -> None: ...
    @property
    def normalisation(
        self,
    ) -> typing.Literal["none", "level", "mean", "mean_variance", "running_mean", "running_mean_variance"]:
        """
        what is normalised along time
        """
    @normalisation.setter
    def normalisation(self, arg1: typing.Any) -> None: ...
    @property
    def num_cepstra(self) -> int:
        """
        c1 .. c_num, below num_filters (linear prediction: up to 64)
        """
    @num_cepstra.setter
    def num_cepstra(self, arg1: typing.Any) -> None: ...
    @property
    def num_filters(self) -> int:
        """
        number of filters
        """
    @num_filters.setter
    def num_filters(self, arg1: typing.Any) -> None: ...
    @property
    def padding(self) -> typing.Literal["none", "centred"]:
        """
        whether zeros surround the audio
        """
    @padding.setter
    def padding(self, arg1: typing.Any) -> None: ...
    @property
    def pre_emphasis(self) -> float:
        """
        coefficient of the pre-emphasis; 0: off
        """
    @pre_emphasis.setter
    def pre_emphasis(self, arg1: typing.Any) -> None: ...
    @property
    def rasta_pole(self) -> float:
        """
        pole of the RASTA filter (0.94 or 0.98 are usual); 0: off
        """
    @rasta_pole.setter
    def rasta_pole(self, arg1: typing.Any) -> None: ...
    @property
    def remove_dc(self) -> bool:
        """
        subtract the mean of every frame
        """
    @remove_dc.setter
    def remove_dc(self, arg1: typing.Any) -> None: ...
    @property
    def running_s(self) -> float:
        """
        memory of the running normalisations
        """
    @running_s.setter
    def running_s(self, arg1: typing.Any) -> None: ...
    @property
    def sample_rate_hz(self) -> int:
        """
        sample rate of the audio; 0, in a recogniser only: the lowest of the training recordings, at most 16000
        """
    @sample_rate_hz.setter
    def sample_rate_hz(self, arg1: typing.Any) -> None: ...
    @property
    def sample_scale(self) -> float:
        """
        factor on the samples; 32768: as if they were 16-bit integers
        """
    @sample_scale.setter
    def sample_scale(self, arg1: typing.Any) -> None: ...
    @property
    def top_db(self) -> float:
        """
        filters this far below the loudest of the utterance are raised to that; 0: off
        """
    @top_db.setter
    def top_db(self, arg1: typing.Any) -> None: ...
    @property
    def unit_area(self) -> bool:
        """
        filters of equal area, not of equal height
        """
    @unit_area.setter
    def unit_area(self, arg1: typing.Any) -> None: ...
    @property
    def use_c0(self) -> bool:
        """
        c0, the log energy of all filters, in front
        """
    @use_c0.setter
    def use_c0(self, arg1: typing.Any) -> None: ...
    @property
    def use_energy(self) -> bool:
        """
        in the place of c0 the log energy of the frame before pre-emphasis
        """
    @use_energy.setter
    def use_energy(self, arg1: typing.Any) -> None: ...
    @property
    def use_power(self) -> bool:
        """
        filters over the power; False: over the magnitude
        """
    @use_power.setter
    def use_power(self, arg1: typing.Any) -> None: ...
    @property
    def warp(self) -> float:
        """
        vocal-tract-length factor on the filter frequencies
        """
    @warp.setter
    def warp(self, arg1: typing.Any) -> None: ...
    @property
    def warp_high_hz(self) -> float:
        """
        above it the warp bends back to high_hz
        """
    @warp_high_hz.setter
    def warp_high_hz(self, arg1: typing.Any) -> None: ...
    @property
    def warp_low_hz(self) -> float:
        """
        below it the warp bends back to low_hz; 0, with warp_high_hz: it does not bend
        """
    @warp_low_hz.setter
    def warp_low_hz(self, arg1: typing.Any) -> None: ...
    @property
    def window(self) -> typing.Literal["hamming", "hann", "hann_periodic", "povey", "rectangular"]:
        """
        window of a frame
        """
    @window.setter
    def window(self, arg1: typing.Any) -> None: ...

class CepstraComputer:
    """
    Cepstra of whole clips.
    """
    def __init__(self, options: CepstraOptions = ...) -> None: ...
    def compute(
        self, audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Features, float32, shape (num_frames, num_features); raises InvalidArgument for NaN.
        """
    def num_frames(self, num_samples: typing.SupportsInt | typing.SupportsIndex) -> int:
        """
        Frames of a clip of so many samples.
        """
    @property
    def num_features(self) -> int:
        """
        Columns of the features.
        """
    @property
    def options(self) -> CepstraOptions:
        """
        As passed, with defaults filled in.
        """

class CepstraStream:
    """
    Cepstra of audio that comes in blocks: the numbers of CepstraComputer, to the bit. One thread at a time.
    """
    def __init__(self, options: CepstraOptions) -> None: ...
    def finish(self, keep_normalisation: bool = False) -> numpy.typing.NDArray[numpy.float32]:
        """
        The frames that are left; then a new utterance may begin.
        """
    def push(
        self, audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Frames that are now complete, float32, shape (any, num_features).
        """
    def reset(self, keep_normalisation: bool = False) -> None:
        """
        Ready for the next utterance; the running normalisation may go on.
        """
    @property
    def num_features(self) -> int:
        """
        Columns of the features.
        """
    @property
    def options(self) -> CepstraOptions:
        """
        As passed, with defaults filled in.
        """

class ChainCodeOptions:
    """
    Histograms of chain codes.

    Parameters
    ----------
    num_parts : int, default 1
        parts of equal length with a histogram each; from 2 on the start counts, the first pixel of the outline in reading order; 1..64
    use_turns : bool, default False
        turns instead of directions
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(self, *, num_parts: int = 1, use_turns: bool = False) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def num_parts(self) -> int:
        """
        parts of equal length with a histogram each; from 2 on the start counts, the first pixel of the outline in reading order
        """
    @num_parts.setter
    def num_parts(self, arg1: typing.Any) -> None: ...
    @property
    def use_turns(self) -> bool:
        """
        turns instead of directions
        """
    @use_turns.setter
    def use_turns(self, arg1: typing.Any) -> None: ...

class ChainCodeComputer:
    """
    Histograms of the directions of an outline.
    """
    def __init__(self, options: ChainCodeOptions = ...) -> None: ...
    def compute(
        self, mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, of a mask.
        """
    def compute_contour(
        self, contour: typing.Annotated[numpy.typing.ArrayLike, numpy.int32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, of an outline as trace_contour gives it.
        """
    @property
    def num_features(self) -> int:
        """
        Columns of the features.
        """

class FourierDescriptorOptions:
    """
    Harmonics of an outline.

    Parameters
    ----------
    num_points : int, default 128
        points along the outline; powers of two are fastest; 16..4096, even
    num_harmonics : int, default 16
        harmonics of each sign, below num_points / 2; 1..2047
    use_phase : bool, default False
        real and imaginary parts, with the start where the first harmonic is real: they show how far a shape is turned
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(self, *, num_points: int = 128, num_harmonics: int = 16, use_phase: bool = False) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def num_harmonics(self) -> int:
        """
        harmonics of each sign, below num_points / 2
        """
    @num_harmonics.setter
    def num_harmonics(self, arg1: typing.Any) -> None: ...
    @property
    def num_points(self) -> int:
        """
        points along the outline; powers of two are fastest
        """
    @num_points.setter
    def num_points(self, arg1: typing.Any) -> None: ...
    @property
    def use_phase(self) -> bool:
        """
        real and imaginary parts, with the start where the first harmonic is real: they show how far a shape is turned
        """
    @use_phase.setter
    def use_phase(self, arg1: typing.Any) -> None: ...

class FourierDescriptorComputer:
    """
    Fourier descriptors of an outline.
    """
    def __init__(self, options: FourierDescriptorOptions = ...) -> None: ...
    def compute(
        self, mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, of a mask.
        """
    def compute_contour(
        self, contour: typing.Annotated[numpy.typing.ArrayLike, numpy.int32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, of an outline as trace_contour gives it.
        """
    @property
    def num_features(self) -> int:
        """
        Columns of the features.
        """

class WaveletDescriptorOptions:
    """
    Moment-invariant wavelet descriptors.

    Parameters
    ----------
    source : {'silhouette', 'contour'}, default 'silhouette'
        pixels that are described
    num_scales : int, default 4
        radial scales m = 0 .. num_scales - 1; 1..6
    num_frequencies : int, default 4
        angular frequencies, from 0; 1..32
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        source: typing.Literal["silhouette", "contour"] = "silhouette",
        num_scales: int = 4,
        num_frequencies: int = 4,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def num_frequencies(self) -> int:
        """
        angular frequencies, from 0
        """
    @num_frequencies.setter
    def num_frequencies(self, arg1: typing.Any) -> None: ...
    @property
    def num_scales(self) -> int:
        """
        radial scales m = 0 .. num_scales - 1
        """
    @num_scales.setter
    def num_scales(self, arg1: typing.Any) -> None: ...
    @property
    def source(self) -> typing.Literal["silhouette", "contour"]:
        """
        pixels that are described
        """
    @source.setter
    def source(self, arg1: typing.Any) -> None: ...

class WaveletDescriptorComputer:
    """
    Moment-invariant wavelet descriptors of a mask.
    """
    def __init__(self, options: WaveletDescriptorOptions = ...) -> None: ...
    def compute(
        self, mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, by frequency, scale and place.
        """
    @property
    def num_features(self) -> int:
        """
        Columns of the features.
        """

class HandTrackOptions:
    """
    The way of a hand.

    Parameters
    ----------
    frames_per_second : float, default 30.0
        frame rate of the clip; 0..100000, 0 excluded
    delta_orders : int, default 1
        derivatives appended; 0..2
    delta_window : int, default 2
        frames on each side of the regression; 1..10
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(self, *, frames_per_second: float = 30.0, delta_orders: int = 1, delta_window: int = 2) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def delta_orders(self) -> int:
        """
        derivatives appended
        """
    @delta_orders.setter
    def delta_orders(self, arg1: typing.Any) -> None: ...
    @property
    def delta_window(self) -> int:
        """
        frames on each side of the regression
        """
    @delta_window.setter
    def delta_window(self, arg1: typing.Any) -> None: ...
    @property
    def frames_per_second(self) -> float:
        """
        frame rate of the clip
        """
    @frames_per_second.setter
    def frames_per_second(self, arg1: typing.Any) -> None: ...

class HandTrackComputer:
    """
    Place, size, axis and speed of a hand, with deltas.
    """
    def __init__(self, options: HandTrackOptions = ...) -> None: ...
    def compute(
        self, masks: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, a row for every mask that shows a hand.
        """
    @property
    def num_features(self) -> int:
        """
        Columns of the features.
        """

class HandPairOptions:
    """
    How two hands are kept apart.

    Parameters
    ----------
    min_area : float, default 0.004
        smallest share of the picture that a hand covers; 0..1
    min_share : float, default 0.25
        least area of the smaller region, as a share of the larger, to be a hand; 0..1
    num_kept_frames : int, default 10
        frames for which the place of a hand out of sight is kept; 0..1000
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(self, *, min_area: float = 0.004, min_share: float = 0.25, num_kept_frames: int = 10) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def min_area(self) -> float:
        """
        smallest share of the picture that a hand covers
        """
    @min_area.setter
    def min_area(self, arg1: typing.Any) -> None: ...
    @property
    def min_share(self) -> float:
        """
        least area of the smaller region, as a share of the larger, to be a hand
        """
    @min_share.setter
    def min_share(self, arg1: typing.Any) -> None: ...
    @property
    def num_kept_frames(self) -> int:
        """
        frames for which the place of a hand out of sight is kept
        """
    @num_kept_frames.setter
    def num_kept_frames(self, arg1: typing.Any) -> None: ...

class PairedHand:
    """
    One of two hands in a frame.
    """
    @property
    def mask(self) -> numpy.typing.NDArray[numpy.uint8]:
        """
        uint8, shape (height, width), 255 where the hand is.
        """
    @property
    def seen(self) -> bool:
        """
        The hand is in view.
        """
    @property
    def touching(self) -> bool:
        """
        One region holds both hands: the border between them is a guess.
        """
    @property
    def x_px(self) -> float:
        """
        Column of the hand's centre.
        """
    @property
    def y_px(self) -> float:
        """
        Row of the hand's centre.
        """

class HandPairTracker:
    """
    Tracks both hands in a stream of masks, also while they touch and where they cross.
    """
    def __init__(self, options: HandPairOptions = ...) -> None: ...
    def push(
        self, mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]
    ) -> typing.Annotated[list[PairedHand], "FixedSize(2)"]:
        """
        The left hand of the picture, then the right one. mask: uint8, shape (height, width).
        """
    def reset(self) -> None:
        """
        Forgets both hands.
        """

class TwoHandFeatureOptions:
    """
    Features of tracks of both hands.

    Parameters
    ----------
    use_left : bool, default True
        the left hand beside the right one
    use_polar : bool, default False
        distance from the reference, cosine and sine of the direction, of each hand
    use_relation : bool, default False
        from the left hand to the right one: x, y and distance
    delta_orders : int, default 2
        derivatives appended; 0..2
    delta_window : int, default 2
        frames on each side of the regression; 1..10
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        use_left: bool = True,
        use_polar: bool = False,
        use_relation: bool = False,
        delta_orders: int = 2,
        delta_window: int = 2,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def delta_orders(self) -> int:
        """
        derivatives appended
        """
    @delta_orders.setter
    def delta_orders(self, arg1: typing.Any) -> None: ...
    @property
    def delta_window(self) -> int:
        """
        frames on each side of the regression
        """
    @delta_window.setter
    def delta_window(self, arg1: typing.Any) -> None: ...
    @property
    def use_left(self) -> bool:
        """
        the left hand beside the right one
        """
    @use_left.setter
    def use_left(self, arg1: typing.Any) -> None: ...
    @property
    def use_polar(self) -> bool:
        """
        distance from the reference, cosine and sine of the direction, of each hand
        """
    @use_polar.setter
    def use_polar(self, arg1: typing.Any) -> None: ...
    @property
    def use_relation(self) -> bool:
        """
        from the left hand to the right one: x, y and distance
        """
    @use_relation.setter
    def use_relation(self, arg1: typing.Any) -> None: ...

class LandmarkPairOptions:
    """
    How landmarks of two hands are kept apart.

    Parameters
    ----------
    min_apart : float, default 0.35
        joints that lie closer to those of another hand are of the same hand, found twice; root mean square, in sizes of the hand; 0..10
    num_kept_frames : int, default 10
        frames for which the place of a hand out of sight is kept; 0..1000
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(self, *, min_apart: float = 0.35, num_kept_frames: int = 10) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def min_apart(self) -> float:
        """
        joints that lie closer to those of another hand are of the same hand, found twice; root mean square, in sizes of the hand
        """
    @min_apart.setter
    def min_apart(self, arg1: typing.Any) -> None: ...
    @property
    def num_kept_frames(self) -> int:
        """
        frames for which the place of a hand out of sight is kept
        """
    @num_kept_frames.setter
    def num_kept_frames(self, arg1: typing.Any) -> None: ...

class LandmarkPairTracker:
    """
    Tracks both hands in a stream of landmarks.
    """
    def __init__(self, options: LandmarkPairOptions = ...) -> None: ...
    def push(
        self,
        hands: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]],
        width_px: typing.SupportsInt | typing.SupportsIndex,
    ) -> typing.Annotated[list[int], "FixedSize(2)"]:
        """
        Which of the hands found, each float32 of shape (21, 2) in pixels, is the left one of the picture, and which the right one; -1: not seen. Raises InvalidArgument.
        """
    def reset(self) -> None:
        """
        Forgets both hands.
        """

class TwoHandFeatureComputer:
    """
    Features of both hands in every frame, from tracks of the hands and the head.
    """
    def __init__(self, options: TwoHandFeatureOptions = ...) -> None: ...
    def compute(
        self,
        tracks: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        scale_px: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, shape (num_frames, num_features). tracks: as of hand_scale_px(); scale_px: by which places are divided, 0: hand_scale_px(tracks). Raises InvalidArgument.
        """
    @property
    def num_features(self) -> int:
        """
        Columns of the result.
        """
    @property
    def options(self) -> TwoHandFeatureOptions:
        """
        As given.
        """

class HybridFeatureOptions:
    """
    Parts of the hybrid feature of a moving gesture (thesis eq. 5.2-5.13).

    Parameters
    ----------
    use_moments : bool, default True
        moment-invariant wavelet descriptors of the mask
    moments : WaveletDescriptorOptions or dict
        options of the descriptors
    moment_scale : {'gesture', 'column'}, default 'gesture'
        which largest moment they are divided by
    use_orientation : bool, default True
        orientation of the silhouette's edges at the second level of a DWT
    wavelet : str, default 'haar'
        wavelet of that transform; the name of a wavelet, such as 'db4'
    crop_px : int, default 64
        side of the square that the silhouette is scaled to before it; 16..256 px
    use_chain_codes : bool, default True
        directions, of eight, from the middle of the way and to the next place
    angles : {'number', 'circle'}, default 'number'
        columns of orientation and of each chain code
    use_speed : bool, default True
        share of the gesture's largest speed
    speed_weight : float, default 0.5
        factor of the speed; the thesis has 0.1 to 0.9; 0..1, 0 excluded
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        use_moments: bool = True,
        moments: WaveletDescriptorOptions | collections.abc.Mapping[str, typing.Any] = ...,
        moment_scale: typing.Literal["gesture", "column"] = "gesture",
        use_orientation: bool = True,
        wavelet: str = "haar",
        crop_px: int = 64,
        use_chain_codes: bool = True,
        angles: typing.Literal["number", "circle"] = "number",
        use_speed: bool = True,
        speed_weight: float = 0.5,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def angles(self) -> typing.Literal["number", "circle"]:
        """
        columns of orientation and of each chain code
        """
    @angles.setter
    def angles(self, arg1: typing.Any) -> None: ...
    @property
    def crop_px(self) -> int:
        """
        side of the square that the silhouette is scaled to before it
        """
    @crop_px.setter
    def crop_px(self, arg1: typing.Any) -> None: ...
    @property
    def moment_scale(self) -> typing.Literal["gesture", "column"]:
        """
        which largest moment they are divided by
        """
    @moment_scale.setter
    def moment_scale(self, arg1: typing.Any) -> None: ...
    @property
    def moments(self) -> WaveletDescriptorOptions:
        """
        options of the descriptors
        """
    @moments.setter
    def moments(self, arg1: typing.Any) -> None: ...
    @property
    def speed_weight(self) -> float:
        """
        factor of the speed; the thesis has 0.1 to 0.9
        """
    @speed_weight.setter
    def speed_weight(self, arg1: typing.Any) -> None: ...
    @property
    def use_chain_codes(self) -> bool:
        """
        directions, of eight, from the middle of the way and to the next place
        """
    @use_chain_codes.setter
    def use_chain_codes(self, arg1: typing.Any) -> None: ...
    @property
    def use_moments(self) -> bool:
        """
        moment-invariant wavelet descriptors of the mask
        """
    @use_moments.setter
    def use_moments(self, arg1: typing.Any) -> None: ...
    @property
    def use_orientation(self) -> bool:
        """
        orientation of the silhouette's edges at the second level of a DWT
        """
    @use_orientation.setter
    def use_orientation(self, arg1: typing.Any) -> None: ...
    @property
    def use_speed(self) -> bool:
        """
        share of the gesture's largest speed
        """
    @use_speed.setter
    def use_speed(self, arg1: typing.Any) -> None: ...
    @property
    def wavelet(self) -> str:
        """
        wavelet of that transform
        """
    @wavelet.setter
    def wavelet(self, arg1: typing.Any) -> None: ...

class HybridFeatureComputer:
    """
    Moments, orientation, chain codes and speed of a moving hand, each in 0..1, joined.
    """
    def __init__(self, options: HybridFeatureOptions = ...) -> None: ...
    def compute(
        self, masks: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, a row for every mask of the gesture that shows a hand: moments, orientation, chain code of the direction from the middle of the way, of the step to the next place, speed. masks: uint8, each of shape (height, width). Raises InvalidArgument.
        """
    @property
    def num_features(self) -> int:
        """
        Columns of the features.
        """
    @property
    def num_moments(self) -> int:
        """
        Those that are moments; they come first.
        """
    @property
    def options(self) -> HybridFeatureOptions:
        """
        As given.
        """

class OrientationHistogramOptions:
    """
    Grid of cells and bins.

    Parameters
    ----------
    num_cells : int, default 8
        cells along each side; 1 gives the single histogram of the thesis; 1..64
    num_bins : int, default 9
        orientations over 180 degrees; 2..72
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(self, *, num_cells: int = 8, num_bins: int = 9) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def num_bins(self) -> int:
        """
        orientations over 180 degrees
        """
    @num_bins.setter
    def num_bins(self, arg1: typing.Any) -> None: ...
    @property
    def num_cells(self) -> int:
        """
        cells along each side; 1 gives the single histogram of the thesis
        """
    @num_cells.setter
    def num_cells(self, arg1: typing.Any) -> None: ...

class SilhouetteCepstrumOptions:
    """
    DWT + MFCC of a silhouette: contour or picture.

    Parameters
    ----------
    wavelet : str, default 'db2'
        wavelet of the transform; the name of a wavelet, such as 'db4'
    num_levels : int, default 3
        levels of the DWT; 0: none; 0..4
    mask_px : int, default 256
        side of the square that the mask is scaled to before the DWT; 32..1024 px
    signal : {'contour', 'picture'}, default 'contour'
        what signal is made of the approximation
    num_points : int, default 256
        samples along the contour; 64..4096
    num_frames : int, default 3
        frames that the signal is blocked into; the thesis has 11; 1..32
    average_frames : bool, default True
        the cepstra of the frames are averaged; else they stand side by side
    num_filters : int, default 20
        filters over their spectrum; 2..64
    num_cepstra : int, default 13
        coefficients kept, below num_filters; 1..63
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        wavelet: str = "db2",
        num_levels: int = 3,
        mask_px: int = 256,
        signal: typing.Literal["contour", "picture"] = "contour",
        num_points: int = 256,
        num_frames: int = 3,
        average_frames: bool = True,
        num_filters: int = 20,
        num_cepstra: int = 13,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def average_frames(self) -> bool:
        """
        the cepstra of the frames are averaged; else they stand side by side
        """
    @average_frames.setter
    def average_frames(self, arg1: typing.Any) -> None: ...
    @property
    def mask_px(self) -> int:
        """
        side of the square that the mask is scaled to before the DWT
        """
    @mask_px.setter
    def mask_px(self, arg1: typing.Any) -> None: ...
    @property
    def num_cepstra(self) -> int:
        """
        coefficients kept, below num_filters
        """
    @num_cepstra.setter
    def num_cepstra(self, arg1: typing.Any) -> None: ...
    @property
    def num_filters(self) -> int:
        """
        filters over their spectrum
        """
    @num_filters.setter
    def num_filters(self, arg1: typing.Any) -> None: ...
    @property
    def num_frames(self) -> int:
        """
        frames that the signal is blocked into; the thesis has 11
        """
    @num_frames.setter
    def num_frames(self, arg1: typing.Any) -> None: ...
    @property
    def num_levels(self) -> int:
        """
        levels of the DWT; 0: none
        """
    @num_levels.setter
    def num_levels(self, arg1: typing.Any) -> None: ...
    @property
    def num_points(self) -> int:
        """
        samples along the contour
        """
    @num_points.setter
    def num_points(self, arg1: typing.Any) -> None: ...
    @property
    def signal(self) -> typing.Literal["contour", "picture"]:
        """
        what signal is made of the approximation
        """
    @signal.setter
    def signal(self, arg1: typing.Any) -> None: ...
    @property
    def wavelet(self) -> str:
        """
        wavelet of the transform
        """
    @wavelet.setter
    def wavelet(self, arg1: typing.Any) -> None: ...

class SilhouetteCepstrumComputer:
    """
    Cepstra of a silhouette.
    """
    def __init__(self, options: SilhouetteCepstrumOptions = ...) -> None: ...
    def compute(
        self, mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        c0, c1, ..., averaged over the frames or frame by frame, float32.
        """
    def contour_signal(
        self, mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Distance from the centroid along the contour, scaled by its mean.
        """
    def picture_signal(
        self, mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Pixels of the DWT's approximation, column by column, divided by its gain of 2 a level.
        """
    @property
    def num_features(self) -> int:
        """
        Values of compute().
        """

class HandFeatureOptions:
    """
    The concatenated features of one hand picture.

    Parameters
    ----------
    crop_px : int, default 64
        side of the square that the hand is scaled to; 16..256 px
    histogram : OrientationHistogramOptions or dict
        cells and bins of the orientation histograms
    use_grey : bool, default True
        histogram of the grey crop (square root of grey, against uneven light)
    use_silhouette : bool, default True
        histogram of the mask crop
    use_cepstrum : bool, default True
        cepstrum of the silhouette
    cepstrum : SilhouetteCepstrumOptions or dict
        options of the cepstrum
    cepstrum_weight : float, default 0.1
        scale of the cepstrum beside the histograms, which are blocks of length 1; 0..1000000, 0 excluded
    use_wavelet : bool, default False
        moment-invariant wavelet descriptor of the mask
    wavelet : WaveletDescriptorOptions or dict
        options of the wavelet descriptor
    use_moments : bool, default False
        roots of Hu's moments of the mask
    use_fourier : bool, default False
        Fourier descriptor of the outline
    fourier : FourierDescriptorOptions or dict
        options of the Fourier descriptor
    use_chain_code : bool, default False
        chain-code histograms of the outline
    chain_code : ChainCodeOptions or dict
        options of the chain code
    descriptor_weight : float, default 1.0
        length that each of these four descriptors is scaled to; they leave out the forearm that hand_box() cuts off; 0..1000000, 0 excluded
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        crop_px: int = 64,
        histogram: OrientationHistogramOptions | collections.abc.Mapping[str, typing.Any] = ...,
        use_grey: bool = True,
        use_silhouette: bool = True,
        use_cepstrum: bool = True,
        cepstrum: SilhouetteCepstrumOptions | collections.abc.Mapping[str, typing.Any] = ...,
        cepstrum_weight: float = 0.1,
        use_wavelet: bool = False,
        wavelet: WaveletDescriptorOptions | collections.abc.Mapping[str, typing.Any] = ...,
        use_moments: bool = False,
        use_fourier: bool = False,
        fourier: FourierDescriptorOptions | collections.abc.Mapping[str, typing.Any] = ...,
        use_chain_code: bool = False,
        chain_code: ChainCodeOptions | collections.abc.Mapping[str, typing.Any] = ...,
        descriptor_weight: float = 1.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def cepstrum(self) -> SilhouetteCepstrumOptions:
        """
        options of the cepstrum
        """
    @cepstrum.setter
    def cepstrum(self, arg1: typing.Any) -> None: ...
    @property
    def cepstrum_weight(self) -> float:
        """
        scale of the cepstrum beside the histograms, which are blocks of length 1
        """
    @cepstrum_weight.setter
    def cepstrum_weight(self, arg1: typing.Any) -> None: ...
    @property
    def chain_code(self) -> ChainCodeOptions:
        """
        options of the chain code
        """
    @chain_code.setter
    def chain_code(self, arg1: typing.Any) -> None: ...
    @property
    def crop_px(self) -> int:
        """
        side of the square that the hand is scaled to
        """
    @crop_px.setter
    def crop_px(self, arg1: typing.Any) -> None: ...
    @property
    def descriptor_weight(self) -> float:
        """
        length that each of these four descriptors is scaled to; they leave out the forearm that hand_box() cuts off
        """
    @descriptor_weight.setter
    def descriptor_weight(self, arg1: typing.Any) -> None: ...
    @property
    def fourier(self) -> FourierDescriptorOptions:
        """
        options of the Fourier descriptor
        """
    @fourier.setter
    def fourier(self, arg1: typing.Any) -> None: ...
    @property
    def histogram(self) -> OrientationHistogramOptions:
        """
        cells and bins of the orientation histograms
        """
    @histogram.setter
    def histogram(self, arg1: typing.Any) -> None: ...
    @property
    def use_cepstrum(self) -> bool:
        """
        cepstrum of the silhouette
        """
    @use_cepstrum.setter
    def use_cepstrum(self, arg1: typing.Any) -> None: ...
    @property
    def use_chain_code(self) -> bool:
        """
        chain-code histograms of the outline
        """
    @use_chain_code.setter
    def use_chain_code(self, arg1: typing.Any) -> None: ...
    @property
    def use_fourier(self) -> bool:
        """
        Fourier descriptor of the outline
        """
    @use_fourier.setter
    def use_fourier(self, arg1: typing.Any) -> None: ...
    @property
    def use_grey(self) -> bool:
        """
        histogram of the grey crop (square root of grey, against uneven light)
        """
    @use_grey.setter
    def use_grey(self, arg1: typing.Any) -> None: ...
    @property
    def use_moments(self) -> bool:
        """
        roots of Hu's moments of the mask
        """
    @use_moments.setter
    def use_moments(self, arg1: typing.Any) -> None: ...
    @property
    def use_silhouette(self) -> bool:
        """
        histogram of the mask crop
        """
    @use_silhouette.setter
    def use_silhouette(self, arg1: typing.Any) -> None: ...
    @property
    def use_wavelet(self) -> bool:
        """
        moment-invariant wavelet descriptor of the mask
        """
    @use_wavelet.setter
    def use_wavelet(self, arg1: typing.Any) -> None: ...
    @property
    def wavelet(self) -> WaveletDescriptorOptions:
        """
        options of the wavelet descriptor
        """
    @wavelet.setter
    def wavelet(self, arg1: typing.Any) -> None: ...

class HandFeatureComputer:
    """
    Features of one hand picture.
    """
    def __init__(self, options: HandFeatureOptions = ...) -> None: ...
    def compute(
        self,
        grey: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8],
        mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8],
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, shape (num_features,); mask is 0 or 255, uint8.
        """
    @property
    def num_features(self) -> int:
        """
        Columns of the features.
        """

class SilhouetteOptions:
    """
    How the hand is found in a picture.

    Parameters
    ----------
    method : {'chroma_otsu', 'hsv_narrow', 'hsv_wide', 'grey_otsu'}, default 'chroma_otsu'
        how a hand differs from what is behind it
    max_side_px : int, default 320
        larger pictures are scaled down to this first; 32..4096 px
    blur_px : int, default 5
        size of the Gaussian blur before and of the median after the threshold; 1..31, odd px
    min_contrast : float, default 1.5
        least difference of the two classes' means, in grey levels; 0..255
    sure_contrast : float, default 5.0
        below this, as in poor light, the classes must also be separated by min_quality; 0..255
    min_quality : float, default 0.7
        least separation of the classes; camera noise alone gives 0.64; 0..1
    min_area : float, default 0.005
        smallest share of the picture that a hand covers; 0..1
    max_area : float, default 0.8
        largest; 0..1
    remove_face : bool, default True
        of more skin regions than hands the one most like an ellipse is a face
    max_hands : int, default 1
        regions that masks hold, the largest; HandPairTracker decides which is which; 1..2
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        method: typing.Literal["chroma_otsu", "hsv_narrow", "hsv_wide", "grey_otsu"] = "chroma_otsu",
        max_side_px: int = 320,
        blur_px: int = 5,
        min_contrast: float = 1.5,
        sure_contrast: float = 5.0,
        min_quality: float = 0.7,
        min_area: float = 0.005,
        max_area: float = 0.8,
        remove_face: bool = True,
        max_hands: int = 1,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def blur_px(self) -> int:
        """
        size of the Gaussian blur before and of the median after the threshold
        """
    @blur_px.setter
    def blur_px(self, arg1: typing.Any) -> None: ...
    @property
    def max_area(self) -> float:
        """
        largest
        """
    @max_area.setter
    def max_area(self, arg1: typing.Any) -> None: ...
    @property
    def max_hands(self) -> int:
        """
        regions that masks hold, the largest; HandPairTracker decides which is which
        """
    @max_hands.setter
    def max_hands(self, arg1: typing.Any) -> None: ...
    @property
    def max_side_px(self) -> int:
        """
        larger pictures are scaled down to this first
        """
    @max_side_px.setter
    def max_side_px(self, arg1: typing.Any) -> None: ...
    @property
    def method(self) -> typing.Literal["chroma_otsu", "hsv_narrow", "hsv_wide", "grey_otsu"]:
        """
        how a hand differs from what is behind it
        """
    @method.setter
    def method(self, arg1: typing.Any) -> None: ...
    @property
    def min_area(self) -> float:
        """
        smallest share of the picture that a hand covers
        """
    @min_area.setter
    def min_area(self, arg1: typing.Any) -> None: ...
    @property
    def min_contrast(self) -> float:
        """
        least difference of the two classes' means, in grey levels
        """
    @min_contrast.setter
    def min_contrast(self, arg1: typing.Any) -> None: ...
    @property
    def min_quality(self) -> float:
        """
        least separation of the classes; camera noise alone gives 0.64
        """
    @min_quality.setter
    def min_quality(self, arg1: typing.Any) -> None: ...
    @property
    def remove_face(self) -> bool:
        """
        of more skin regions than hands the one most like an ellipse is a face
        """
    @remove_face.setter
    def remove_face(self, arg1: typing.Any) -> None: ...
    @property
    def sure_contrast(self) -> float:
        """
        below this, as in poor light, the classes must also be separated by min_quality
        """
    @sure_contrast.setter
    def sure_contrast(self, arg1: typing.Any) -> None: ...

class MaskSmoothingOptions:
    """
    Which masks of a clip are repaired.

    Parameters
    ----------
    max_gap : int, default 2
        frames in a row that may be repaired; 0: none; 0..10
    min_agreement : float, default 0.6
        what the masks on both sides must share, of what either covers; 0..1
    max_overlap : float, default 0.5
        what a mask that jumps may share with either, as a share of what these share; 0..1
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(self, *, max_gap: int = 2, min_agreement: float = 0.6, max_overlap: float = 0.5) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def max_gap(self) -> int:
        """
        frames in a row that may be repaired; 0: none
        """
    @max_gap.setter
    def max_gap(self, arg1: typing.Any) -> None: ...
    @property
    def max_overlap(self) -> float:
        """
        what a mask that jumps may share with either, as a share of what these share
        """
    @max_overlap.setter
    def max_overlap(self, arg1: typing.Any) -> None: ...
    @property
    def min_agreement(self) -> float:
        """
        what the masks on both sides must share, of what either covers
        """
    @min_agreement.setter
    def min_agreement(self, arg1: typing.Any) -> None: ...

class HandColourOptions:
    """
    How the colours of hand and background are learned from a clip.

    Parameters
    ----------
    max_side_px : int, default 160
        larger pictures are scaled down to this before they are segmented; 32..4096 px
    fit_side_px : int, default 80
        and to this for learning; 32..4096 px
    num_fit_frames : int, default 8
        frames learned from, spread over the clip; 1..256
    num_rounds : int, default 4
        rounds of segmenting and learning from the segments; 1..100
    min_area : float, default 0.004
        smallest share of the picture that a hand covers; 0..1
    max_area : float, default 0.6
        largest, averaged over the frames learned from; 0..1
    min_quality : float, default 0.3
        a discriminant that separates the pixels on both sides of the hand's outline worse than this is no hand; 0..1
    remove_still : bool, default True
        what has the hand's colours but stays in place while something else of them moves, such as a face, is no hand
    max_hands : int, default 1
        regions that masks hold, the largest; HandPairTracker decides which is which; 1..2
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        max_side_px: int = 160,
        fit_side_px: int = 80,
        num_fit_frames: int = 8,
        num_rounds: int = 4,
        min_area: float = 0.004,
        max_area: float = 0.6,
        min_quality: float = 0.3,
        remove_still: bool = True,
        max_hands: int = 1,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def fit_side_px(self) -> int:
        """
        and to this for learning
        """
    @fit_side_px.setter
    def fit_side_px(self, arg1: typing.Any) -> None: ...
    @property
    def max_area(self) -> float:
        """
        largest, averaged over the frames learned from
        """
    @max_area.setter
    def max_area(self, arg1: typing.Any) -> None: ...
    @property
    def max_hands(self) -> int:
        """
        regions that masks hold, the largest; HandPairTracker decides which is which
        """
    @max_hands.setter
    def max_hands(self, arg1: typing.Any) -> None: ...
    @property
    def max_side_px(self) -> int:
        """
        larger pictures are scaled down to this before they are segmented
        """
    @max_side_px.setter
    def max_side_px(self, arg1: typing.Any) -> None: ...
    @property
    def min_area(self) -> float:
        """
        smallest share of the picture that a hand covers
        """
    @min_area.setter
    def min_area(self, arg1: typing.Any) -> None: ...
    @property
    def min_quality(self) -> float:
        """
        a discriminant that separates the pixels on both sides of the hand's outline worse than this is no hand
        """
    @min_quality.setter
    def min_quality(self, arg1: typing.Any) -> None: ...
    @property
    def num_fit_frames(self) -> int:
        """
        frames learned from, spread over the clip
        """
    @num_fit_frames.setter
    def num_fit_frames(self, arg1: typing.Any) -> None: ...
    @property
    def num_rounds(self) -> int:
        """
        rounds of segmenting and learning from the segments
        """
    @num_rounds.setter
    def num_rounds(self, arg1: typing.Any) -> None: ...
    @property
    def remove_still(self) -> bool:
        """
        what has the hand's colours but stays in place while something else of them moves, such as a face, is no hand
        """
    @remove_still.setter
    def remove_still(self, arg1: typing.Any) -> None: ...

class HandFinderOptions:
    """
    How hands are found in clips and streams.

    Parameters
    ----------
    learning : {'automatic', 'never'}, default 'automatic'
        where the colours of hand and background come from
    min_frames : int, default 8
        length of a clip from which on its colours are learned; 1..1000000
    silhouette : SilhouetteOptions or dict
        of pictures that are segmented by themselves
    colours : HandColourOptions or dict
        of clips and streams whose colours are learned
    smooth : bool, default True
        repair masks of clips that jump for a frame or two
    smoothing : MaskSmoothingOptions or dict
        which masks are repaired
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        learning: typing.Literal["automatic", "never"] = "automatic",
        min_frames: int = 8,
        silhouette: SilhouetteOptions | collections.abc.Mapping[str, typing.Any] = ...,
        colours: HandColourOptions | collections.abc.Mapping[str, typing.Any] = ...,
        smooth: bool = True,
        smoothing: MaskSmoothingOptions | collections.abc.Mapping[str, typing.Any] = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def colours(self) -> HandColourOptions:
        """
        of clips and streams whose colours are learned
        """
    @colours.setter
    def colours(self, arg1: typing.Any) -> None: ...
    @property
    def learning(self) -> typing.Literal["automatic", "never"]:
        """
        where the colours of hand and background come from
        """
    @learning.setter
    def learning(self, arg1: typing.Any) -> None: ...
    @property
    def min_frames(self) -> int:
        """
        length of a clip from which on its colours are learned
        """
    @min_frames.setter
    def min_frames(self, arg1: typing.Any) -> None: ...
    @property
    def silhouette(self) -> SilhouetteOptions:
        """
        of pictures that are segmented by themselves
        """
    @silhouette.setter
    def silhouette(self, arg1: typing.Any) -> None: ...
    @property
    def smooth(self) -> bool:
        """
        repair masks of clips that jump for a frame or two
        """
    @smooth.setter
    def smooth(self, arg1: typing.Any) -> None: ...
    @property
    def smoothing(self) -> MaskSmoothingOptions:
        """
        which masks are repaired
        """
    @smoothing.setter
    def smoothing(self, arg1: typing.Any) -> None: ...

class HandObservation:
    """
    What was found in one picture.
    """
    def __init__(
        self,
        grey: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8],
        mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8],
        quality: typing.SupportsFloat | typing.SupportsIndex = 1.0,
    ) -> None:
        """
        Of a hand that was found in another way; uint8 arrays of one size, 255 is hand.
        """
    @property
    def grey(self) -> numpy.typing.NDArray[numpy.uint8]:
        """
        uint8, read-only, at the working size.
        """
    @property
    def mask(self) -> numpy.typing.NDArray[numpy.uint8]:
        """
        uint8, read-only: 255 is hand; all 0 without one.
        """
    @property
    def quality(self) -> float:
        """
        0 (no hand) .. 1: how far the mask can be trusted.
        """
    @property
    def repaired(self) -> bool:
        """
        The frames around it made the mask, because it jumped: see smooth_masks.
        """
    @property
    def touching(self) -> bool:
        """
        Of one of two hands: one region holds both, the border is a guess.
        """

class CodebookOptions:
    """
    Options of Codebook.

    Parameters
    ----------
    num_codewords : int, default 64
        codewords; fewer come out where the data have fewer different rows; 1..65536
    max_iterations : int, default 50
        iterations of k-means after each split; 1..100000
    tolerance : float, default 0.0001
        training stops when the distortion falls by a smaller share; 0..1000000
    split_epsilon : float, default 0.01
        a codeword splits into c + e s and c - e s, s the deviation of its cell; 0..1000, 0 excluded
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        num_codewords: int = 64,
        max_iterations: int = 50,
        tolerance: float = 0.0001,
        split_epsilon: float = 0.01,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def max_iterations(self) -> int:
        """
        iterations of k-means after each split
        """
    @max_iterations.setter
    def max_iterations(self, arg1: typing.Any) -> None: ...
    @property
    def num_codewords(self) -> int:
        """
        codewords; fewer come out where the data have fewer different rows
        """
    @num_codewords.setter
    def num_codewords(self, arg1: typing.Any) -> None: ...
    @property
    def split_epsilon(self) -> float:
        """
        a codeword splits into c + e s and c - e s, s the deviation of its cell
        """
    @split_epsilon.setter
    def split_epsilon(self, arg1: typing.Any) -> None: ...
    @property
    def tolerance(self) -> float:
        """
        training stops when the distortion falls by a smaller share
        """
    @tolerance.setter
    def tolerance(self, arg1: typing.Any) -> None: ...

class CodebookReport:
    """
    How the training of a codebook went: one entry an iteration of k-means.
    """
    def __init__(self) -> None: ...
    @property
    def converged(self) -> bool:
        """
        False where the iteration limit ended the last size.
        """
    @property
    def distortions(self) -> list[float]:
        """
        Mean squared distance, before the centroids moved.
        """
    @property
    def sizes(self) -> list[int]:
        """
        Codewords there were.
        """

class Codebook:
    """
    Vector quantiser (Linde, Buzo, Gray).
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> Codebook:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train_kmeans(
        rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        centroids: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        options: CodebookOptions = ...,
        report: CodebookReport = None,
    ) -> Codebook:
        """
        k-means from given centroids.
        """
    @staticmethod
    def train_lbg(
        rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        options: CodebookOptions = ...,
        report: CodebookReport = None,
    ) -> Codebook:
        """
        Grows a codebook from one codeword by splitting.
        """
    def __init__(self, centroids: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> None: ...
    def __len__(self) -> int: ...
    def distortion(self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> float:
        """
        Mean squared distance of the frames to their codewords.
        """
    def quantise(
        self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.int32]:
        """
        The nearest codeword of every frame, int32, shape (num_frames,).
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def centroids(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        Codewords, a row each.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the rows it takes.
        """
    @property
    def size(self) -> int: ...

class MultiStreamCodebook:
    """
    Codes consecutive groups of columns apart, each by its own Codebook.
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> MultiStreamCodebook:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train_lbg(
        rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        widths: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        options: CodebookOptions = ...,
    ) -> MultiStreamCodebook:
        """
        Grows a codebook for each stream; widths are columns a stream.

        Raises InvalidArgument for widths that do not add up to the columns of the rows.
        """
    def __init__(self, streams: collections.abc.Sequence[Codebook]) -> None: ...
    def __len__(self) -> int: ...
    def distortion(self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> float:
        """
        Mean squared distance of the frames to their codewords, all streams.
        """
    def quantise(
        self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.int32]:
        """
        The nearest codewords, int32, shape (num_frames, num_streams).
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the rows it takes.
        """
    @property
    def num_streams(self) -> int:
        """
        Codebooks, one for each group of columns.
        """
    @property
    def streams(self) -> list[Codebook]:
        """
        The codebooks.
        """

class Pca:
    """
    Principal component analysis (thesis eq. 6.11-6.14).
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> Pca:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        num_components: typing.SupportsInt | typing.SupportsIndex,
    ) -> Pca: ...
    def transform(
        self, rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Shape (num_rows, num_components), float32.
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def components(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        Directions, a row each.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the rows it takes.
        """
    @property
    def mean(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        Mean of the rows trained on.
        """
    @property
    def num_components(self) -> int: ...
    @property
    def variances(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        Variance along every component.
        """

class LdaOptions:
    """
    Options of Lda.

    Parameters
    ----------
    num_components : int, default 0
        at most the number of classes less 1; 0: as many as there are; 0..1000000
    shrinkage : float, default 0.0
        share of the covariance within classes that is replaced by its mean variance times the identity; 0..1
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(self, *, num_components: int = 0, shrinkage: float = 0.0) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def num_components(self) -> int:
        """
        at most the number of classes less 1; 0: as many as there are
        """
    @num_components.setter
    def num_components(self, arg1: typing.Any) -> None: ...
    @property
    def shrinkage(self) -> float:
        """
        share of the covariance within classes that is replaced by its mean variance times the identity
        """
    @shrinkage.setter
    def shrinkage(self, arg1: typing.Any) -> None: ...

class Lda:
    """
    Linear discriminant analysis.
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> Lda:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        classes: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]],
        num_classes: typing.SupportsInt | typing.SupportsIndex,
        options: LdaOptions = ...,
    ) -> Lda:
        """
        Directions along which classes (num_rows,) in 0..num_classes - 1 lie max_displacement apart.
        """
    def transform(
        self, rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Shape (num_rows, num_components), float32.
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def components(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        Directions, a row each.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the rows it takes.
        """
    @property
    def mean(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        Mean of the rows trained on.
        """
    @property
    def num_components(self) -> int: ...
    @property
    def ratios(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        Variance between classes over variance within, falling.
        """

class LinearSvmOptions:
    """
    Options of LinearSvm.

    Parameters
    ----------
    cost : float, default 1.0
        C: larger fits the training rows more closely; 0..1e+12, 0 excluded
    bias_feature : float, default 1.0
        constant feature that carries the bias; 0..1000000, 0 excluded
    max_iterations : int, default 1000
        passes over the rows at most; 1..1000000
    tolerance : float, default 0.001
        training stops when the range of the projected gradient falls below; 0..1000000, 0 excluded
    seed : int, default 0
        of the order of the rows; 0..2^64 - 1
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        cost: float = 1.0,
        bias_feature: float = 1.0,
        max_iterations: int = 1000,
        tolerance: float = 0.001,
        seed: int = 0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def bias_feature(self) -> float:
        """
        constant feature that carries the bias
        """
    @bias_feature.setter
    def bias_feature(self, arg1: typing.Any) -> None: ...
    @property
    def cost(self) -> float:
        """
        C: larger fits the training rows more closely
        """
    @cost.setter
    def cost(self, arg1: typing.Any) -> None: ...
    @property
    def max_iterations(self) -> int:
        """
        passes over the rows at most
        """
    @max_iterations.setter
    def max_iterations(self, arg1: typing.Any) -> None: ...
    @property
    def seed(self) -> int:
        """
        of the order of the rows
        """
    @seed.setter
    def seed(self, arg1: typing.Any) -> None: ...
    @property
    def tolerance(self) -> float:
        """
        training stops when the range of the projected gradient falls below
        """
    @tolerance.setter
    def tolerance(self, arg1: typing.Any) -> None: ...

class LinearSvm:
    """
    Linear support vector machines, one class against the rest.
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> LinearSvm:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        classes: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]],
        num_classes: typing.SupportsInt | typing.SupportsIndex,
        options: LinearSvmOptions = ...,
    ) -> LinearSvm:
        """
        Trains on rows (num_rows, dim), float32, and classes (num_rows,) in 0..num_classes - 1.

        Raises InvalidArgument for values not finite (names the row) or a class without a row.
        """
    def decision_values(
        self, rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Scores, larger is likelier: (num_classes,) for one row, (num_rows, num_classes) for a matrix.
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def biases(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        Constant terms, one a class.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the rows it takes.
        """
    @property
    def num_classes(self) -> int:
        """
        Number of classes.
        """
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        Weights, as trained.
        """

class RbfClassifierOptions:
    """
    Options of RbfClassifier.

    Parameters
    ----------
    cost : float, default 10.0
        of a squared error, against the weights: larger fits more closely; 0..1e+12, 0 excluded
    sharpness : float, default 1.5
        the kernel is exp(-sharpness) at the root mean square distance of the training rows; 0..1000000, 0 excluded
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(self, *, cost: float = 10.0, sharpness: float = 1.5) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def cost(self) -> float:
        """
        of a squared error, against the weights: larger fits more closely
        """
    @cost.setter
    def cost(self, arg1: typing.Any) -> None: ...
    @property
    def sharpness(self) -> float:
        """
        the kernel is exp(-sharpness) at the root mean square distance of the training rows
        """
    @sharpness.setter
    def sharpness(self, arg1: typing.Any) -> None: ...

class RbfClassifier:
    """
    Least-squares support vector machines with a radial kernel, one class against the rest.
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> RbfClassifier:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        classes: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]],
        num_classes: typing.SupportsInt | typing.SupportsIndex,
        options: RbfClassifierOptions = ...,
    ) -> RbfClassifier:
        """
        Trains on rows (num_rows, dim), float32, and classes (num_rows,) in 0..num_classes - 1.

        Raises InvalidArgument for values not finite (names the row) or a class without a row.
        """
    def decision_values(
        self, rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Scores, larger is likelier: (num_classes,) for one row, (num_rows, num_classes) for a matrix.
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the rows it takes.
        """
    @property
    def num_classes(self) -> int:
        """
        Number of classes.
        """
    @property
    def num_rows(self) -> int: ...

class GaussianBayesOptions:
    """
    Options of GaussianBayes.

    Parameters
    ----------
    covariance : {'shared', 'full', 'diagonal'}, default 'shared'
        covariances of the classes
    shrinkage : float, default 0.1
        share of the covariance that is replaced by its mean variance times the identity; 0..1
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self, *, covariance: typing.Literal["shared", "full", "diagonal"] = "shared", shrinkage: float = 0.1
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def covariance(self) -> typing.Literal["shared", "full", "diagonal"]:
        """
        covariances of the classes
        """
    @covariance.setter
    def covariance(self, arg1: typing.Any) -> None: ...
    @property
    def shrinkage(self) -> float:
        """
        share of the covariance that is replaced by its mean variance times the identity
        """
    @shrinkage.setter
    def shrinkage(self, arg1: typing.Any) -> None: ...

class GaussianBayes:
    """
    Bayes classifier with one Gaussian a class.
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> GaussianBayes:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        classes: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]],
        num_classes: typing.SupportsInt | typing.SupportsIndex,
        options: GaussianBayesOptions = ...,
    ) -> GaussianBayes:
        """
        Trains on rows (num_rows, dim), float32, and classes (num_rows,) in 0..num_classes - 1.

        Raises InvalidArgument for values not finite (names the row) or a class without a row.
        """
    def decision_values(
        self, rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Scores, larger is likelier: (num_classes,) for one row, (num_rows, num_classes) for a matrix.
        """
    def log_densities(
        self, rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        log p(row | class), shapes as decision_values.
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the rows it takes.
        """
    @property
    def num_classes(self) -> int:
        """
        Number of classes.
        """

class KnnOptions:
    """
    Options of Knn.

    Parameters
    ----------
    num_neighbours : int, default 5
        neighbours that vote; fewer where there are fewer rows; 1..1000
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(self, *, num_neighbours: int = 5) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def num_neighbours(self) -> int:
        """
        neighbours that vote; fewer where there are fewer rows
        """
    @num_neighbours.setter
    def num_neighbours(self, arg1: typing.Any) -> None: ...

class Knn:
    """
    k nearest neighbours by Euclidean distance.
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> Knn:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        classes: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]],
        num_classes: typing.SupportsInt | typing.SupportsIndex,
        options: KnnOptions = ...,
    ) -> Knn:
        """
        Trains on rows (num_rows, dim), float32, and classes (num_rows,) in 0..num_classes - 1.

        Raises InvalidArgument for values not finite (names the row) or a class without a row.
        """
    def decision_values(
        self, rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Scores, larger is likelier: (num_classes,) for one row, (num_rows, num_classes) for a matrix.
        """
    def nearest_distance(self, row: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> float: ...
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the rows it takes.
        """
    @property
    def num_classes(self) -> int:
        """
        Number of classes.
        """

class DistanceClassifierOptions:
    """
    Options of DistanceClassifier.

    Parameters
    ----------
    metric : {'euclidean', 'manhattan', 'mahalanobis', 'bhattacharyya'}, default 'euclidean'
        distance of a row from a class
    shrinkage : float, default 0.1
        share of each covariance that is replaced by its mean variance times the identity (mahalanobis, bhattacharyya); 0..1
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        metric: typing.Literal["euclidean", "manhattan", "mahalanobis", "bhattacharyya"] = "euclidean",
        shrinkage: float = 0.1,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def metric(self) -> typing.Literal["euclidean", "manhattan", "mahalanobis", "bhattacharyya"]:
        """
        distance of a row from a class
        """
    @metric.setter
    def metric(self, arg1: typing.Any) -> None: ...
    @property
    def shrinkage(self) -> float:
        """
        share of each covariance that is replaced by its mean variance times the identity (mahalanobis, bhattacharyya)
        """
    @shrinkage.setter
    def shrinkage(self, arg1: typing.Any) -> None: ...

class DistanceClassifier:
    """
    The class whose mean is nearest (thesis table 6.5); decision values are negative distances.
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> DistanceClassifier:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        classes: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]],
        num_classes: typing.SupportsInt | typing.SupportsIndex,
        options: DistanceClassifierOptions = ...,
    ) -> DistanceClassifier:
        """
        Trains on rows (num_rows, dim), float32, and classes (num_rows,) in 0..num_classes - 1.

        Raises InvalidArgument for values not finite (names the row) or a class without a row.
        """
    def decision_values(
        self, rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Scores, larger is likelier: (num_classes,) for one row, (num_rows, num_classes) for a matrix.
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the rows it takes.
        """
    @property
    def num_classes(self) -> int:
        """
        Number of classes.
        """

class PossibilityClassifier:
    """
    Gaussian class densities divided by the largest (thesis eq. 5.14-5.15); decision values are log possibilities.
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> PossibilityClassifier:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        classes: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]],
        num_classes: typing.SupportsInt | typing.SupportsIndex,
        options: GaussianBayesOptions = ...,
    ) -> PossibilityClassifier:
        """
        Trains on rows (num_rows, dim), float32, and classes (num_rows,) in 0..num_classes - 1.

        Raises InvalidArgument for values not finite (names the row) or a class without a row.
        """
    def classify(
        self, row: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> tuple[numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.float32]]:
        """
        Possibility and necessity of every class, each of shape (num_classes,).
        """
    def decision_values(
        self, rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Scores, larger is likelier: (num_classes,) for one row, (num_rows, num_classes) for a matrix.
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the rows it takes.
        """
    @property
    def num_classes(self) -> int:
        """
        Number of classes.
        """

class LogisticRegressionOptions:
    """
    Options of LogisticRegression.

    Parameters
    ----------
    penalty : float, default 1.0
        of half the squared weights, against the sum over rows; 0..1e+12, 0 excluded
    max_iterations : int, default 50
        iterations at most; 1..1000
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(self, *, penalty: float = 1.0, max_iterations: int = 50) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def max_iterations(self) -> int:
        """
        iterations at most
        """
    @max_iterations.setter
    def max_iterations(self, arg1: typing.Any) -> None: ...
    @property
    def penalty(self) -> float:
        """
        of half the squared weights, against the sum over rows
        """
    @penalty.setter
    def penalty(self, arg1: typing.Any) -> None: ...

class LogisticRegression:
    """
    Logistic regression of two classes.
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> LogisticRegression:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        classes: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]],
        num_classes: typing.SupportsInt | typing.SupportsIndex,
        options: LogisticRegressionOptions = ...,
    ) -> LogisticRegression:
        """
        Trains on rows (num_rows, dim) and classes (num_rows,) of 0 and 1.
        """
    def decision_values(
        self, rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        0 and the log odds of class 1, shape (num_rows, 2).
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def bias(self) -> float:
        """
        Constant term.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the rows it takes.
        """
    @property
    def num_classes(self) -> int:
        """
        Number of classes.
        """
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        One for each column.
        """

class SequenceNetworkOptions:
    """
    Options of SequenceNetwork.

    Parameters
    ----------
    num_channels : int, default 96
        of every block; a multiple of 8; 8..1024
    num_blocks : int, default 3
        residual blocks, of two convolutions each; 1..16
    num_epochs : int, default 60
        how often training goes through all examples; 1..10000
    batch_size : int, default 64
        examples of one step of training; 2..4096
    learning_rate : float, default 0.004
        largest step of AdamW; it rises over a fifth of the training and falls to none; 0..1, 0 excluded
    weight_decay : float, default 0.01
        share of the weights that each step takes off; 0..1
    dropout : float, default 0.1
        share of the values behind each convolution that training leaves out; twice that, at most 0.9, before the softmax; 0..0.9
    label_smoothing : float, default 0.1
        share of the probability asked for that is spread over all classes; 0..0.9
    seed : int, default 1
        of everything random in training; 0..2^64 - 1
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        num_channels: int = 96,
        num_blocks: int = 3,
        num_epochs: int = 60,
        batch_size: int = 64,
        learning_rate: float = 0.004,
        weight_decay: float = 0.01,
        dropout: float = 0.1,
        label_smoothing: float = 0.1,
        seed: int = 1,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def batch_size(self) -> int:
        """
        examples of one step of training
        """
    @batch_size.setter
    def batch_size(self, arg1: typing.Any) -> None: ...
    @property
    def dropout(self) -> float:
        """
        share of the values behind each convolution that training leaves out; twice that, at most 0.9, before the softmax
        """
    @dropout.setter
    def dropout(self, arg1: typing.Any) -> None: ...
    @property
    def label_smoothing(self) -> float:
        """
        share of the probability asked for that is spread over all classes
        """
    @label_smoothing.setter
    def label_smoothing(self, arg1: typing.Any) -> None: ...
    @property
    def learning_rate(self) -> float:
        """
        largest step of AdamW; it rises over a fifth of the training and falls to none
        """
    @learning_rate.setter
    def learning_rate(self, arg1: typing.Any) -> None: ...
    @property
    def num_blocks(self) -> int:
        """
        residual blocks, of two convolutions each
        """
    @num_blocks.setter
    def num_blocks(self, arg1: typing.Any) -> None: ...
    @property
    def num_channels(self) -> int:
        """
        of every block; a multiple of 8
        """
    @num_channels.setter
    def num_channels(self, arg1: typing.Any) -> None: ...
    @property
    def num_epochs(self) -> int:
        """
        how often training goes through all examples
        """
    @num_epochs.setter
    def num_epochs(self, arg1: typing.Any) -> None: ...
    @property
    def seed(self) -> int:
        """
        of everything random in training
        """
    @seed.setter
    def seed(self, arg1: typing.Any) -> None: ...
    @property
    def weight_decay(self) -> float:
        """
        share of the weights that each step takes off
        """
    @weight_decay.setter
    def weight_decay(self, arg1: typing.Any) -> None: ...

class SequenceNetwork:
    """
    Time-channel separable convolutions and softmax.
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> SequenceNetwork:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        sequences: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]],
        classes: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]],
        num_classes: typing.SupportsInt | typing.SupportsIndex,
        options: SequenceNetworkOptions = ...,
    ) -> SequenceNetwork:
        """
        Trains on sequences (num_frames, dim) and classes (num_sequences,) of 0..num_classes - 1.
        """
    def log_posteriors(
        self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Log posterior of every class, shape (num_classes,).
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the frames it takes.
        """
    @property
    def num_classes(self) -> int:
        """
        Number of classes.
        """

class SoftmaxRegressionOptions:
    """
    Options of SoftmaxRegression.

    Parameters
    ----------
    penalty : float, default 1.0
        of half the squared weights, against the sum over rows; 0..1e+12, 0 excluded
    max_iterations : int, default 200
        iterations at most; 1..100000
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(self, *, penalty: float = 1.0, max_iterations: int = 200) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def max_iterations(self) -> int:
        """
        iterations at most
        """
    @max_iterations.setter
    def max_iterations(self, arg1: typing.Any) -> None: ...
    @property
    def penalty(self) -> float:
        """
        of half the squared weights, against the sum over rows
        """
    @penalty.setter
    def penalty(self, arg1: typing.Any) -> None: ...

class SoftmaxRegression:
    """
    Logistic regression of many classes.
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> SoftmaxRegression:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        classes: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]],
        num_classes: typing.SupportsInt | typing.SupportsIndex,
        options: SoftmaxRegressionOptions = ...,
    ) -> SoftmaxRegression:
        """
        Trains on rows (num_rows, dim) and classes (num_rows,) of 0..num_classes - 1.
        """
    def decision_values(
        self, rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Log posteriors but for a constant, shape (num_rows, num_classes).
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the rows it takes.
        """
    @property
    def num_classes(self) -> int:
        """
        Number of classes.
        """

class Topology:
    """
    Which transitions a sequence model has.

    Parameters
    ----------
    kind : {'left_right', 'banded', 'ergodic', 'rank_one_plus_band'}, default 'left_right'
        which transitions exist
    num_states : int, default 5
        number of states; 1..4096
    max_jump : int, default 1
        largest step to another state without a jump; ergodic ignores it; 1..4096
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        kind: typing.Literal["left_right", "banded", "ergodic", "rank_one_plus_band"] = "left_right",
        num_states: int = 5,
        max_jump: int = 1,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def allows(
        self, i: typing.SupportsInt | typing.SupportsIndex, j: typing.SupportsInt | typing.SupportsIndex
    ) -> bool:
        """
        Whether there is a transition from state i to j.
        """
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def kind(self) -> typing.Literal["left_right", "banded", "ergodic", "rank_one_plus_band"]:
        """
        which transitions exist
        """
    @kind.setter
    def kind(self, arg1: typing.Any) -> None: ...
    @property
    def max_jump(self) -> int:
        """
        largest step to another state without a jump; ergodic ignores it
        """
    @max_jump.setter
    def max_jump(self, arg1: typing.Any) -> None: ...
    @property
    def num_states(self) -> int:
        """
        number of states
        """
    @num_states.setter
    def num_states(self, arg1: typing.Any) -> None: ...

class MarkovChain:
    """
    Start and transition probabilities of a sequence model.
    """
    @staticmethod
    def initial(topology: Topology) -> MarkovChain: ...
    @staticmethod
    def read(file: ModelFile, prefix: str) -> MarkovChain:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @typing.overload
    def __init__(
        self,
        topology: Topology,
        start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        transition: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    ) -> None: ...
    @typing.overload
    def __init__(
        self,
        topology: Topology,
        start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        band: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        leave: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        land: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    ) -> None:
        """
        rank_one_plus_band: a_ij = band[i, j] + leave[i] * land[j].
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def band(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Transition probabilities within the band, a row for each state.
        """
    @property
    def land(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Weight of a jump to each state; rank-one part.
        """
    @property
    def leave(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Weight of a jump from each state; rank-one part.
        """
    @property
    def num_states(self) -> int:
        """
        States of each model.
        """
    @property
    def start(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Initial probabilities, shape (num_states,).
        """
    @property
    def topology(self) -> Topology:
        """
        Which transitions there are, a Topology.
        """
    @property
    def transition(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Transition probabilities, shape (num_states, num_states), row i from state i.
        """

class TrainingReport:
    """
    How an iterative training went.
    """
    def __init__(self) -> None: ...
    @property
    def converged(self) -> bool:
        """
        The change fell below the tolerance.
        """
    @property
    def log_likelihoods(self) -> list[float]:
        """
        Before each iteration.
        """

class GaussianMixtureOptions:
    """
    Options of GaussianMixture.

    Parameters
    ----------
    num_mixtures : int, default 16
        Gaussians; 1..4096
    max_iterations : int, default 15
        iterations of EM at most; 1..100000
    tolerance : float, default 0.001
        training stops when the log-likelihood a frame gains less; 0..1000000
    variance_floor : float, default 0.01
        share of the global variance; 0..1000000, 0 excluded
    wide_weight : float, default 0.0
        weight of one more component, as wide as five deviations of all rows: a background model then explains also what lies far from its training data; 0..0.5
    seed : int, default 0
        of the start by k-means; 0..2^64 - 1
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        num_mixtures: int = 16,
        max_iterations: int = 15,
        tolerance: float = 0.001,
        variance_floor: float = 0.01,
        wide_weight: float = 0.0,
        seed: int = 0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def max_iterations(self) -> int:
        """
        iterations of EM at most
        """
    @max_iterations.setter
    def max_iterations(self, arg1: typing.Any) -> None: ...
    @property
    def num_mixtures(self) -> int:
        """
        Gaussians
        """
    @num_mixtures.setter
    def num_mixtures(self, arg1: typing.Any) -> None: ...
    @property
    def seed(self) -> int:
        """
        of the start by k-means
        """
    @seed.setter
    def seed(self, arg1: typing.Any) -> None: ...
    @property
    def tolerance(self) -> float:
        """
        training stops when the log-likelihood a frame gains less
        """
    @tolerance.setter
    def tolerance(self, arg1: typing.Any) -> None: ...
    @property
    def variance_floor(self) -> float:
        """
        share of the global variance
        """
    @variance_floor.setter
    def variance_floor(self, arg1: typing.Any) -> None: ...
    @property
    def wide_weight(self) -> float:
        """
        weight of one more component, as wide as five deviations of all rows: a background model then explains also what lies far from its training data
        """
    @wide_weight.setter
    def wide_weight(self, arg1: typing.Any) -> None: ...

class GaussianMixture:
    """
    Gaussian mixture with diagonal covariance.
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> GaussianMixture:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        options: GaussianMixtureOptions = ...,
        report: TrainingReport = None,
    ) -> GaussianMixture: ...
    def log_likelihood(self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> float:
        """
        Sum over the frames of log p(frame), natural log.
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the rows it takes.
        """
    @property
    def means(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Means of the mixture components, a row each.
        """
    @property
    def variances(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Variances of the mixture components, a row each.
        """
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Mixture weights.
        """

class ForwardBackward:
    """
    Forward and backward log probabilities of an HMM's states, natural logs.
    """
    @property
    def log_backward(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        log P(frames after t | state of t), float64, shape (num_frames, num_states).
        """
    @property
    def log_forward(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        log P(frames 0..t, state of t), float64, shape (num_frames, num_states).
        """
    @property
    def log_likelihood(self) -> float:
        """
        log P(frames | model); -inf for an impossible sequence.
        """

class GaussianMixtureHmmOptions:
    """
    Options of GaussianMixtureHmm.

    Parameters
    ----------
    topology : Topology or dict
        which transitions exist
    num_mixtures : int, default 1
        Gaussians a state; 1..1024
    max_iterations : int, default 20
        iterations of Baum-Welch at most; 1..100000
    tolerance : float, default 0.0001
        training stops when the log-likelihood a frame gains less; 0..1000000
    variance_floor : float, default 0.01
        share of the global variance; 0..1000000, 0 excluded
    weight_floor : float, default 0.001
        smaller mixture weights are raised to it, at most 1 / num_mixtures, before all are scaled to sum to 1: then they may lie a little below; 0..1
    tied_variance : bool, default False
        one vector of variances for all Gaussians of all states
    transition_prior : float, default 0.0
        Dirichlet prior: imagined counts of every transition (and start) that the topology has; 0..1e+12
    weight_prior : float, default 0.0
        Dirichlet prior: imagined counts of every Gaussian of a state's mixture; 0..1e+12
    train_transitions : bool, default True
        False: start and transitions stay as they began
    seed : int, default 0
        of the starts by k-means; 0..2^64 - 1
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        topology: Topology | collections.abc.Mapping[str, typing.Any] = ...,
        num_mixtures: int = 1,
        max_iterations: int = 20,
        tolerance: float = 0.0001,
        variance_floor: float = 0.01,
        weight_floor: float = 0.001,
        tied_variance: bool = False,
        transition_prior: float = 0.0,
        weight_prior: float = 0.0,
        train_transitions: bool = True,
        seed: int = 0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def max_iterations(self) -> int:
        """
        iterations of Baum-Welch at most
        """
    @max_iterations.setter
    def max_iterations(self, arg1: typing.Any) -> None: ...
    @property
    def num_mixtures(self) -> int:
        """
        Gaussians a state
        """
    @num_mixtures.setter
    def num_mixtures(self, arg1: typing.Any) -> None: ...
    @property
    def seed(self) -> int:
        """
        of the starts by k-means
        """
    @seed.setter
    def seed(self, arg1: typing.Any) -> None: ...
    @property
    def tied_variance(self) -> bool:
        """
        one vector of variances for all Gaussians of all states
        """
    @tied_variance.setter
    def tied_variance(self, arg1: typing.Any) -> None: ...
    @property
    def tolerance(self) -> float:
        """
        training stops when the log-likelihood a frame gains less
        """
    @tolerance.setter
    def tolerance(self, arg1: typing.Any) -> None: ...
    @property
    def topology(self) -> Topology:
        """
        which transitions exist
        """
    @topology.setter
    def topology(self, arg1: typing.Any) -> None: ...
    @property
    def train_transitions(self) -> bool:
        """
        False: start and transitions stay as they began
        """
    @train_transitions.setter
    def train_transitions(self, arg1: typing.Any) -> None: ...
    @property
    def transition_prior(self) -> float:
        """
        Dirichlet prior: imagined counts of every transition (and start) that the topology has
        """
    @transition_prior.setter
    def transition_prior(self, arg1: typing.Any) -> None: ...
    @property
    def variance_floor(self) -> float:
        """
        share of the global variance
        """
    @variance_floor.setter
    def variance_floor(self, arg1: typing.Any) -> None: ...
    @property
    def weight_floor(self) -> float:
        """
        smaller mixture weights are raised to it, at most 1 / num_mixtures, before all are scaled to sum to 1: then they may lie a little below
        """
    @weight_floor.setter
    def weight_floor(self, arg1: typing.Any) -> None: ...
    @property
    def weight_prior(self) -> float:
        """
        Dirichlet prior: imagined counts of every Gaussian of a state's mixture
        """
    @weight_prior.setter
    def weight_prior(self, arg1: typing.Any) -> None: ...

class GaussianMixtureHmm:
    """
    HMM with Gaussian-mixture emissions of diagonal covariance.
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> GaussianMixtureHmm:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        sequences: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]],
        options: GaussianMixtureHmmOptions = ...,
        report: TrainingReport = None,
    ) -> GaussianMixtureHmm:
        """
        Baum-Welch over a list of (num_frames, dim) arrays.
        """
    def __init__(
        self,
        chain: MarkovChain,
        weights: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        means: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        variances: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    ) -> None:
        """
        weights (num_states, num_mixtures); means and variances (num_states * num_mixtures, dim), state by state.
        """
    def forward_backward(self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> ForwardBackward:
        """
        Forward and backward log probabilities of the states, frame by frame.
        """
    def log_likelihood(self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> float:
        """
        log P(frames | model), natural log; emissions in float.
        """
    def log_likelihood_exact(self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> float:
        """
        The same with emissions in double.
        """
    def posterior(
        self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        P(state | all of the sequence), shape (num_frames, num_states). Raises InvalidArgument where the sequence is impossible.
        """
    def retrain(
        self,
        sequences: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]],
        options: GaussianMixtureHmmOptions = ...,
        report: TrainingReport = None,
    ) -> GaussianMixtureHmm:
        """
        A model trained further; topology, num_mixtures and seed of the options are not read.
        """
    def sample(
        self, count: typing.SupportsInt | typing.SupportsIndex, seed: typing.SupportsInt | typing.SupportsIndex
    ) -> tuple[numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.int32]]:
        """
        Frames drawn from the model, and their states.
        """
    def state_posteriors(
        self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> tuple[float, numpy.typing.NDArray[numpy.float64]]:
        """
        Log-likelihood of the sequence, and posterior() of it, all 0 where it is impossible.
        """
    def viterbi(
        self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> tuple[float, numpy.typing.NDArray[numpy.int32]]:
        """
        log P(frames, best path | model) and the path, int32.
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def chain(self) -> MarkovChain:
        """
        Initial and transition probabilities, a MarkovChain.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the rows it takes.
        """
    @property
    def means(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Means of the mixture components, a row each.
        """
    @property
    def num_states(self) -> int:
        """
        States of each model.
        """
    @property
    def variances(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Variances of the mixture components, a row each.
        """
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Mixture weights, a row for each state.
        """

class DiscreteHmmOptions:
    """
    Options of DiscreteHmm.

    Parameters
    ----------
    topology : Topology or dict
        which transitions exist
    num_symbols : int, default 0
        size of the alphabet; 0: not set, which training refuses; 0..65536
    max_iterations : int, default 20
        iterations of Baum-Welch at most; 1..100000
    tolerance : float, default 0.0001
        training stops when the log-likelihood a symbol gains less; 0..1000000
    emission_floor : float, default 0.0001
        smallest emission probability, at most 1 / num_symbols; 0..1
    transition_prior : float, default 0.0
        Dirichlet prior: imagined counts of every transition (and start) that the topology has; 0..1e+12
    emission_prior : float, default 0.0
        Dirichlet prior: imagined counts of every symbol in every state; 0..1e+12
    train_transitions : bool, default True
        False: start and transitions stay as they began
    seed : int, default 0
        of the start of models that are not left-right; 0..2^64 - 1
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        topology: Topology | collections.abc.Mapping[str, typing.Any] = ...,
        num_symbols: int = 0,
        max_iterations: int = 20,
        tolerance: float = 0.0001,
        emission_floor: float = 0.0001,
        transition_prior: float = 0.0,
        emission_prior: float = 0.0,
        train_transitions: bool = True,
        seed: int = 0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def emission_floor(self) -> float:
        """
        smallest emission probability, at most 1 / num_symbols
        """
    @emission_floor.setter
    def emission_floor(self, arg1: typing.Any) -> None: ...
    @property
    def emission_prior(self) -> float:
        """
        Dirichlet prior: imagined counts of every symbol in every state
        """
    @emission_prior.setter
    def emission_prior(self, arg1: typing.Any) -> None: ...
    @property
    def max_iterations(self) -> int:
        """
        iterations of Baum-Welch at most
        """
    @max_iterations.setter
    def max_iterations(self, arg1: typing.Any) -> None: ...
    @property
    def num_symbols(self) -> int:
        """
        size of the alphabet; 0: not set, which training refuses
        """
    @num_symbols.setter
    def num_symbols(self, arg1: typing.Any) -> None: ...
    @property
    def seed(self) -> int:
        """
        of the start of models that are not left-right
        """
    @seed.setter
    def seed(self, arg1: typing.Any) -> None: ...
    @property
    def tolerance(self) -> float:
        """
        training stops when the log-likelihood a symbol gains less
        """
    @tolerance.setter
    def tolerance(self, arg1: typing.Any) -> None: ...
    @property
    def topology(self) -> Topology:
        """
        which transitions exist
        """
    @topology.setter
    def topology(self, arg1: typing.Any) -> None: ...
    @property
    def train_transitions(self) -> bool:
        """
        False: start and transitions stay as they began
        """
    @train_transitions.setter
    def train_transitions(self, arg1: typing.Any) -> None: ...
    @property
    def transition_prior(self) -> float:
        """
        Dirichlet prior: imagined counts of every transition (and start) that the topology has
        """
    @transition_prior.setter
    def transition_prior(self, arg1: typing.Any) -> None: ...

class DiscreteHmm:
    """
    HMM over discrete symbols.
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> DiscreteHmm:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        sequences: collections.abc.Sequence[numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]],
        options: DiscreteHmmOptions,
        report: TrainingReport = None,
    ) -> DiscreteHmm:
        """
        Baum-Welch over a list of integer arrays.
        """
    def __init__(self, chain: MarkovChain, emission: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        """
        emission has shape (num_states, num_symbols).
        """
    def forward_backward(self, symbols: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]) -> ForwardBackward:
        """
        Forward and backward log probabilities of the states, frame by frame.
        """
    def log_likelihood(self, symbols: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]) -> float:
        """
        log P(symbols | model), natural log.
        """
    def log_likelihood_exact(self, symbols: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]) -> float:
        """
        The same in logs from the first symbol on: slow, to compare with.
        """
    def posterior(
        self, symbols: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        P(state | all of the sequence), shape (num_frames, num_states). Raises InvalidArgument where the sequence is impossible.
        """
    def retrain(
        self,
        sequences: collections.abc.Sequence[numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]],
        options: DiscreteHmmOptions,
        report: TrainingReport = None,
    ) -> DiscreteHmm:
        """
        A model trained further; topology, num_symbols and seed of the options are not read.
        """
    def sample(
        self, count: typing.SupportsInt | typing.SupportsIndex, seed: typing.SupportsInt | typing.SupportsIndex
    ) -> tuple[numpy.typing.NDArray[numpy.int32], numpy.typing.NDArray[numpy.int32]]:
        """
        Symbols drawn from the model, and their states.
        """
    def state_posteriors(
        self, symbols: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]
    ) -> tuple[float, numpy.typing.NDArray[numpy.float64]]:
        """
        Log-likelihood of the sequence, and posterior() of it, all 0 where it is impossible.
        """
    def viterbi(
        self, symbols: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]
    ) -> tuple[float, numpy.typing.NDArray[numpy.int32]]:
        """
        log P(symbols, best path | model) and the path, int32.
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def chain(self) -> MarkovChain:
        """
        Initial and transition probabilities, a MarkovChain.
        """
    @property
    def emission(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Probabilities of symbols, shape (num_states, num_symbols).
        """
    @property
    def num_states(self) -> int:
        """
        States of each model.
        """
    @property
    def num_symbols(self) -> int:
        """
        Size of the alphabet.
        """

class DiscreteHmmStream:
    """
    Scores of several DiscreteHmm while the symbols still arrive.
    """
    def __init__(
        self, models: collections.abc.Sequence[DiscreteHmm], beam: typing.SupportsFloat | typing.SupportsIndex = ...
    ) -> None:
        """
        Models whose log-likelihood falls `beam` below the best are dropped until reset().
        """
    def log_likelihoods(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        log P(frames so far | model) of every model; -inf for those dropped or impossible.
        """
    def nbest(self, count: typing.SupportsInt | typing.SupportsIndex) -> list[int]:
        """
        Indices of the best models, best first, without those at -inf.
        """
    def push(self, symbol: typing.SupportsInt | typing.SupportsIndex) -> None:
        """
        Advances all models by one symbol.
        """
    def push_all(self, symbols: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]) -> None:
        """
        push() of every symbol.
        """
    def reset(self) -> None:
        """
        Back to before the first frame, with all models.
        """
    @property
    def num_active(self) -> int:
        """
        Models not dropped.
        """
    @property
    def num_frames(self) -> int:
        """
        Frames pushed so far.
        """
    @property
    def num_models(self) -> int:
        """
        Models that are scored.
        """

class GaussianMixtureHmmStream:
    """
    Scores of several GaussianMixtureHmm while the frames still arrive.
    """
    def __init__(
        self,
        models: collections.abc.Sequence[GaussianMixtureHmm],
        beam: typing.SupportsFloat | typing.SupportsIndex = ...,
    ) -> None:
        """
        Models whose log-likelihood falls `beam` below the best are dropped until reset().
        """
    def log_likelihoods(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        log P(frames so far | model) of every model; -inf for those dropped or impossible.
        """
    def nbest(self, count: typing.SupportsInt | typing.SupportsIndex) -> list[int]:
        """
        Indices of the best models, best first, without those at -inf.
        """
    def push(self, frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> None:
        """
        Advances all models by one frame, shape (dim,).
        """
    def push_all(self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> None:
        """
        push() of every row.
        """
    def reset(self) -> None:
        """
        Back to before the first frame, with all models.
        """
    @property
    def num_active(self) -> int:
        """
        Models not dropped.
        """
    @property
    def num_frames(self) -> int:
        """
        Frames pushed so far.
        """
    @property
    def num_models(self) -> int:
        """
        Models that are scored.
        """

class StateChoiceOptions:
    """
    Options of choose_num_states.

    Parameters
    ----------
    criterion : {'bic', 'held_out'}, default 'bic'
        what the candidates are compared by
    num_folds : int, default 5
        held_out: parts of the sequences, at most their number; 2..1000000
    num_restarts : int, default 3
        trainings of every candidate, of which the likeliest counts; left-right models are trained once; 1..1000
    seed : int, default 0
        of the folds and of the restarts; 0..2^64 - 1
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        criterion: typing.Literal["bic", "held_out"] = "bic",
        num_folds: int = 5,
        num_restarts: int = 3,
        seed: int = 0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def criterion(self) -> typing.Literal["bic", "held_out"]:
        """
        what the candidates are compared by
        """
    @criterion.setter
    def criterion(self, arg1: typing.Any) -> None: ...
    @property
    def num_folds(self) -> int:
        """
        held_out: parts of the sequences, at most their number
        """
    @num_folds.setter
    def num_folds(self, arg1: typing.Any) -> None: ...
    @property
    def num_restarts(self) -> int:
        """
        trainings of every candidate, of which the likeliest counts; left-right models are trained once
        """
    @num_restarts.setter
    def num_restarts(self, arg1: typing.Any) -> None: ...
    @property
    def seed(self) -> int:
        """
        of the folds and of the restarts
        """
    @seed.setter
    def seed(self, arg1: typing.Any) -> None: ...

class StateChoice:
    """
    What choose_num_states found.
    """
    class Candidate:
        """
        One number of states.
        """
        @property
        def log_likelihood(self) -> float:
            """
            Of the sequences it was judged on.
            """
        @property
        def num_parameters(self) -> int:
            """
            Free parameters of the model.
            """
        @property
        def num_states(self) -> int:
            """
            States of this candidate.
            """
        @property
        def score(self) -> float:
            """
            The larger, the better.
            """

    @property
    def candidates(self) -> list[StateChoice.Candidate]:
        """
        In the order they were given.
        """
    @property
    def num_states(self) -> int:
        """
        Of the best candidate.
        """

class StatePossibilities:
    """
    What one class of a set of possibility-theory HMMs says of its states, frame by frame; float64, shape (num_frames, num_states).
    """
    @property
    def log_backward(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        log of gamma_t(i) (eq. 4.15-4.16), of the best way on from i through the frames after t.
        """
    @property
    def log_forward(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        log of phi_t(i) (eq. 4.10-4.11), of the best path through frames 0..t that ends in i.
        """
    @property
    def log_possibility(self) -> float:
        """
        Of the whole sequence (eq. 4.12), natural log; -inf for impossible.
        """
    @property
    def necessity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        1 - the possibility of the best other state, 0..1.
        """
    @property
    def possibility(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Of state i at frame t given all frames (eq. 4.23), 0..1; 1 for the best state.
        """

class PossibilisticRule:
    """
    How a PossibilisticHmmSet is scored.

    Parameters
    ----------
    conjunction : {'product', 'min', 'max'}, default 'product'
        how possibilities are joined
    conditioned : bool, default True
        with min: possibilities are conditioned on every frame
    concentration : float, default 1.5
        with min, conditioned: power that what a state holds is raised to at a symbol that speaks against it; 1: off; 1..16
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        conjunction: typing.Literal["product", "min", "max"] = "product",
        conditioned: bool = True,
        concentration: float = 1.5,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def concentration(self) -> float:
        """
        with min, conditioned: power that what a state holds is raised to at a symbol that speaks against it; 1: off
        """
    @concentration.setter
    def concentration(self, arg1: typing.Any) -> None: ...
    @property
    def conditioned(self) -> bool:
        """
        with min: possibilities are conditioned on every frame
        """
    @conditioned.setter
    def conditioned(self, arg1: typing.Any) -> None: ...
    @property
    def conjunction(self) -> typing.Literal["product", "min", "max"]:
        """
        how possibilities are joined
        """
    @conjunction.setter
    def conjunction(self, arg1: typing.Any) -> None: ...

class PossibilisticHmmOptions:
    """
    Options of PossibilisticHmmSet.

    Parameters
    ----------
    topology : Topology or dict
        which transitions exist
    num_symbols : int, default 0
        size of the alphabet; 0: not set, which training refuses; 0..65536
    rule : PossibilisticRule or dict
        how the set is scored
    training : {'all_paths', 'best_path'}, default 'all_paths'
        how the models are trained before they are scaled
    max_iterations : int, default 20
        iterations of the training at most; 1..100000
    tolerance : float, default 0.0001
        all_paths: training stops when the log-likelihood a symbol gains less; best_path: when no parameter moves more; 0..1000000
    emission_floor : float, default 0.0001
        smallest emission share before scaling, at most 1 / num_symbols; best_path: smaller ones are raised to it before those of a state are scaled to sum to 1, and may lie a little below; 0..1
    seed : int, default 0
        of the start of models that are not left-right; 0..2^64 - 1
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        topology: Topology | collections.abc.Mapping[str, typing.Any] = ...,
        num_symbols: int = 0,
        rule: PossibilisticRule | collections.abc.Mapping[str, typing.Any] = ...,
        training: typing.Literal["all_paths", "best_path"] = "all_paths",
        max_iterations: int = 20,
        tolerance: float = 0.0001,
        emission_floor: float = 0.0001,
        seed: int = 0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def emission_floor(self) -> float:
        """
        smallest emission share before scaling, at most 1 / num_symbols; best_path: smaller ones are raised to it before those of a state are scaled to sum to 1, and may lie a little below
        """
    @emission_floor.setter
    def emission_floor(self, arg1: typing.Any) -> None: ...
    @property
    def max_iterations(self) -> int:
        """
        iterations of the training at most
        """
    @max_iterations.setter
    def max_iterations(self, arg1: typing.Any) -> None: ...
    @property
    def num_symbols(self) -> int:
        """
        size of the alphabet; 0: not set, which training refuses
        """
    @num_symbols.setter
    def num_symbols(self, arg1: typing.Any) -> None: ...
    @property
    def rule(self) -> PossibilisticRule:
        """
        how the set is scored
        """
    @rule.setter
    def rule(self, arg1: typing.Any) -> None: ...
    @property
    def seed(self) -> int:
        """
        of the start of models that are not left-right
        """
    @seed.setter
    def seed(self, arg1: typing.Any) -> None: ...
    @property
    def tolerance(self) -> float:
        """
        all_paths: training stops when the log-likelihood a symbol gains less; best_path: when no parameter moves more
        """
    @tolerance.setter
    def tolerance(self, arg1: typing.Any) -> None: ...
    @property
    def topology(self) -> Topology:
        """
        which transitions exist
        """
    @topology.setter
    def topology(self, arg1: typing.Any) -> None: ...
    @property
    def training(self) -> typing.Literal["all_paths", "best_path"]:
        """
        how the models are trained before they are scaled
        """
    @training.setter
    def training(self, arg1: typing.Any) -> None: ...

class PossibilisticHmmSet:
    """
    Possibility-theory HMMs of all classes, trained and scaled together (thesis chapter 4).
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> PossibilisticHmmSet:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        per_class: collections.abc.Sequence[
            collections.abc.Sequence[numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]]
        ],
        options: PossibilisticHmmOptions,
    ) -> PossibilisticHmmSet:
        """
        per_class[c] lists the symbol sequences of class c.
        """
    def __init__(self, models: collections.abc.Sequence[DiscreteHmm], rule: PossibilisticRule = ...) -> None:
        """
        The set of trained HMMs: starts, transitions and the emissions of each symbol divided by the largest over all classes and states (eq. 5.14).
        """
    def classify(
        self, symbols: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]
    ) -> tuple[numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.float32]]:
        """
        Possibility and necessity of each class, two float32 arrays of shape (num_classes,).
        """
    def emission(self, class_index: typing.SupportsInt | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
        """
        Possibilities, shape (num_states, num_symbols).
        """
    def log_possibilities(
        self, symbols: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        log possibility of the symbols under each class, float32, shape (num_classes,).
        """
    def log_possibilities_exact(
        self, symbols: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        The same computed in float64.
        """
    def start(self, class_index: typing.SupportsInt | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
        """
        Possibilities, shape (num_states,).
        """
    def state_possibilities(
        self,
        class_index: typing.SupportsInt | typing.SupportsIndex,
        symbols: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]],
    ) -> StatePossibilities:
        """
        Possibility and necessity of each state at each frame under one class (thesis eq. 4.10-4.17 and 4.23). Raises InvalidArgument for a conditioned minimum unless concentration is 1.
        """
    def transition(self, class_index: typing.SupportsInt | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
        """
        Possibilities, shape (num_states, num_states).
        """
    def viterbi(
        self,
        class_index: typing.SupportsInt | typing.SupportsIndex,
        symbols: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]],
    ) -> tuple[float, numpy.typing.NDArray[numpy.int32]]:
        """
        Log possibility of the best path and the path, int32.
        """
    @typing.overload
    def with_class(self, model: DiscreteHmm) -> PossibilisticHmmSet:
        """
        The set with one class more, which comes last; no other class is trained again.
        """
    @typing.overload
    def with_class(
        self,
        sequences: collections.abc.Sequence[numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]],
        options: PossibilisticHmmOptions,
    ) -> PossibilisticHmmSet: ...
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def models(self) -> list[DiscreteHmm]:
        """
        The HMMs before scaling.
        """
    @property
    def num_classes(self) -> int:
        """
        Number of classes.
        """
    @property
    def num_states(self) -> int:
        """
        States of each model.
        """
    @property
    def num_symbols(self) -> int:
        """
        Size of the alphabet.
        """
    @property
    def rule(self) -> PossibilisticRule:
        """
        How possibilities are combined, a PossibilisticRule.
        """
    @property
    def topology(self) -> Topology:
        """
        Which transitions there are, a Topology.
        """

class PossibilisticGaussianHmmSet:
    """
    Possibility-theory HMMs over frames, emissions Gaussian mixtures.
    """
    @staticmethod
    def read(file: ModelFile, prefix: str) -> PossibilisticGaussianHmmSet:
        """
        Reads what `write` added; raises FormatError naming the field that does not fit.
        """
    @staticmethod
    def train(
        per_class: collections.abc.Sequence[
            collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]]
        ],
        options: GaussianMixtureHmmOptions,
        rule: PossibilisticRule = ...,
    ) -> PossibilisticGaussianHmmSet:
        """
        per_class[c] lists the (num_frames, dim) arrays of class c.
        """
    def __init__(self, models: collections.abc.Sequence[GaussianMixtureHmm], rule: PossibilisticRule = ...) -> None: ...
    def classify(
        self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> tuple[numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.float32]]:
        """
        Possibility and necessity of each class, two float32 arrays of shape (num_classes,).
        """
    def log_possibilities(
        self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        log possibility of the frames under each class, float32, shape (num_classes,).
        """
    def state_possibilities(
        self,
        class_index: typing.SupportsInt | typing.SupportsIndex,
        frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    ) -> StatePossibilities:
        """
        Possibility and necessity of each state at each frame under one class (thesis eq. 4.10-4.17 and 4.23). Raises InvalidArgument for a conditioned minimum unless concentration is 1.
        """
    def viterbi(
        self,
        class_index: typing.SupportsInt | typing.SupportsIndex,
        frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    ) -> tuple[float, numpy.typing.NDArray[numpy.int32]]:
        """
        Log possibility of the best path and the path, int32.
        """
    def with_class(self, model: GaussianMixtureHmm) -> PossibilisticGaussianHmmSet:
        """
        The set with one class more, which comes last; no other class is trained again.
        """
    def write(self, file: ModelFile, prefix: str) -> None:
        """
        Adds the model to a ModelFile.
        """
    @property
    def dim(self) -> int:
        """
        Columns of the rows it takes.
        """
    @property
    def models(self) -> list[GaussianMixtureHmm]:
        """
        The HMMs before scaling.
        """
    @property
    def num_classes(self) -> int:
        """
        Number of classes.
        """
    @property
    def rule(self) -> PossibilisticRule:
        """
        How possibilities are combined, a PossibilisticRule.
        """
    @property
    def topology(self) -> Topology:
        """
        Which transitions there are, a Topology.
        """

class FixedPointHmmSet:
    """
    The product recursion of a PossibilisticHmmSet in 16-bit integers.
    """
    def __init__(self, set: PossibilisticHmmSet) -> None: ...
    def log_possibilities(
        self, symbols: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        log possibility of the symbols under each class, float32, shape (num_classes,).
        """
    @property
    def num_classes(self) -> int:
        """
        Number of classes.
        """
    @property
    def num_symbols(self) -> int:
        """
        Size of the alphabet.
        """
    @property
    def units(self) -> float:
        """
        Integer steps in one natural-log unit.
        """

class PossibilisticHmmStream:
    """
    Scores of a PossibilisticHmmSet while the symbols come in.
    """
    def __init__(self, set: PossibilisticHmmSet, beam: typing.SupportsFloat | typing.SupportsIndex = ...) -> None:
        """
        Classes that fall by more than `beam` (natural log) below the best are dropped.
        """
    def log_possibilities(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        Of all symbols so far under each class, float32, shape (num_classes,).
        """
    def nbest(self, count: typing.SupportsInt | typing.SupportsIndex = 5) -> list[int]:
        """
        Indices of the best classes, best first.
        """
    def push(self, symbol: typing.SupportsInt | typing.SupportsIndex) -> None:
        """
        Score the next symbol under every class.
        """
    def reset(self) -> None:
        """
        Ready for the next utterance.
        """
    @property
    def num_active(self) -> int:
        """
        Classes not dropped.
        """
    @property
    def num_classes(self) -> int:
        """
        Number of classes.
        """
    @property
    def num_frames(self) -> int:
        """
        Frames pushed so far.
        """

class NGramOptions:
    """
    Options of NGramModel.

    Parameters
    ----------
    order : int, default 2
        words of an n-gram; 2: bigram; 1..6
    smoothing : {'witten_bell', 'kneser_ney'}, default 'witten_bell'
        how n-grams that were not seen get their share
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self, *, order: int = 2, smoothing: typing.Literal["witten_bell", "kneser_ney"] = "witten_bell"
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def order(self) -> int:
        """
        words of an n-gram; 2: bigram
        """
    @order.setter
    def order(self, arg1: typing.Any) -> None: ...
    @property
    def smoothing(self) -> typing.Literal["witten_bell", "kneser_ney"]:
        """
        how n-grams that were not seen get their share
        """
    @smoothing.setter
    def smoothing(self, arg1: typing.Any) -> None: ...

class NGramFit:
    """
    How well a language model predicts sentences.
    """
    @property
    def log_probability(self) -> float:
        """
        Natural log, of all words that the model knows.
        """
    @property
    def num_unknown(self) -> int:
        """
        Words the model does not know.
        """
    @property
    def num_words(self) -> int:
        """
        Predicted: known words and ends of sentences.
        """
    @property
    def perplexity(self) -> float:
        """
        exp(-log_probability / num_words).
        """

class NGramModel:
    """
    N-gram language model of words with back-off; <s> and </s> are words, too.
    """
    @staticmethod
    def load(path: str | bytes | os.PathLike[str]) -> NGramModel:
        """
        Reads an ARPA file; raises FormatError naming file and line.
        """
    @staticmethod
    def parse(text: str, name: str) -> NGramModel:
        """
        Reads the text of an ARPA file; `name` is what errors call it.
        """
    @staticmethod
    def train(
        sentences: collections.abc.Sequence[collections.abc.Sequence[str]],
        options: NGramOptions = ...,
        vocabulary: collections.abc.Sequence[str] = [],
    ) -> NGramModel:
        """
        Trains on lists of words; `vocabulary` names words beside those in them. Raises InvalidArgument for a word that is empty, a marker or has white space in it.
        """
    def fit_of(self, sentences: collections.abc.Sequence[collections.abc.Sequence[str]]) -> NGramFit:
        """
        An NGramFit: perplexity and what it is of.
        """
    def log_probability(self, history: collections.abc.Sequence[str], word: str) -> float:
        """
        log P(word | history), natural log; -inf for an unknown word, unless there is <unk>.
        """
    def num_ngrams(self, order: typing.SupportsInt | typing.SupportsIndex) -> int:
        """
        How many n-grams of an order there are.
        """
    def save(self, path: str | bytes | os.PathLike[str]) -> None:
        """
        Writes an ARPA file.
        """
    def to_arpa(self) -> str:
        """
        The text of the ARPA file.
        """
    @property
    def order(self) -> int:
        """
        Words of the longest n-grams.
        """
    @property
    def words(self) -> list[str]:
        """
        All words and markers.
        """

class WordNetwork:
    """
    Which words may follow which; nodes are words or null nodes.
    """
    @staticmethod
    def bigram(
        language: NGramModel,
        labels: collections.abc.Sequence[str],
        silence: typing.SupportsInt | typing.SupportsIndex = -1,
    ) -> WordNetwork:
        """
        Any number of words, weighted by a language model of order 1 or 2.
        """
    @staticmethod
    def loop(
        num_words: typing.SupportsInt | typing.SupportsIndex, silence: typing.SupportsInt | typing.SupportsIndex = -1
    ) -> WordNetwork:
        """
        Any number of words in any order; `silence` is the model between them.
        """
    @staticmethod
    def sequence(
        num_words: typing.SupportsInt | typing.SupportsIndex,
        length: typing.SupportsInt | typing.SupportsIndex,
        silence: typing.SupportsInt | typing.SupportsIndex = -1,
    ) -> WordNetwork:
        """
        So many words in any order.
        """
    @staticmethod
    def transcript(
        words: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        silence: typing.SupportsInt | typing.SupportsIndex = -1,
    ) -> WordNetwork:
        """
        The given words in this order: for forced alignment.
        """
    def __init__(
        self,
        models: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        arcs: collections.abc.Sequence[
            tuple[
                typing.SupportsInt | typing.SupportsIndex,
                typing.SupportsInt | typing.SupportsIndex,
                typing.SupportsFloat | typing.SupportsIndex,
            ]
        ],
        initial: typing.SupportsInt | typing.SupportsIndex,
        final: typing.SupportsInt | typing.SupportsIndex,
    ) -> None:
        """
        `models[n]` is the model of node n, -1 for a null node; an arc is (from, to, log weight).
        """
    @property
    def final(self) -> int:
        """
        Where they end.
        """
    @property
    def initial(self) -> int:
        """
        Where sentences begin.
        """
    @property
    def models(self) -> list[int]:
        """
        The model of every node; -1: a null node.
        """

class ConnectedDecoderOptions:
    """
    Options of ConnectedDecoder.

    Parameters
    ----------
    beam : float, default 2000.0
        states whose score falls this much below the best (natural log) are dropped; 0..1e+12, 0 excluded
    language_scale : float, default 1.0
        factor on the log weights of the network (HTK's grammar scale); 0..1000000
    insertion_penalty : float, default 0.0
        added to the log score at every word; below 0: fewer words (HTK's -p); -1000000..1000000
    max_open_words : int, default 65536
        words of all hypotheses that are kept at most while these differ; beyond, the oldest word of the best one is decided; 64..100000000
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        beam: float = 2000.0,
        language_scale: float = 1.0,
        insertion_penalty: float = 0.0,
        max_open_words: int = 65536,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def beam(self) -> float:
        """
        states whose score falls this much below the best (natural log) are dropped
        """
    @beam.setter
    def beam(self, arg1: typing.Any) -> None: ...
    @property
    def insertion_penalty(self) -> float:
        """
        added to the log score at every word; below 0: fewer words (HTK's -p)
        """
    @insertion_penalty.setter
    def insertion_penalty(self, arg1: typing.Any) -> None: ...
    @property
    def language_scale(self) -> float:
        """
        factor on the log weights of the network (HTK's grammar scale)
        """
    @language_scale.setter
    def language_scale(self, arg1: typing.Any) -> None: ...
    @property
    def max_open_words(self) -> int:
        """
        words of all hypotheses that are kept at most while these differ; beyond, the oldest word of the best one is decided
        """
    @max_open_words.setter
    def max_open_words(self, arg1: typing.Any) -> None: ...

class WordChain:
    """
    The states of a word as a decoder passes them.
    """
    @staticmethod
    def of(
        chain: MarkovChain, final_stay: typing.SupportsFloat | typing.SupportsIndex, is_silence: bool = False
    ) -> WordChain:
        """
        Of a left-right MarkovChain, whose last state is left with 1 - final_stay.
        """
    def __init__(
        self,
        log_start: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        log_transition: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        log_exit: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
        is_silence: bool = False,
    ) -> None: ...

class DecodedWord:
    """
    One word, or silence, of a decoded sentence.
    """
    @property
    def first_frame(self) -> int:
        """
        First frame.
        """
    @property
    def last_frame(self) -> int:
        """
        One past the last frame.
        """
    @property
    def log_score(self) -> float:
        """
        What it adds to the sentence's.
        """
    @property
    def model(self) -> int:
        """
        Number of the model.
        """

class DecodedSentence:
    """
    What a decoder found.
    """
    @property
    def complete(self) -> bool:
        """
        Whether it is a whole sentence.
        """
    @property
    def log_score(self) -> float:
        """
        Of the best path.
        """
    @property
    def words(self) -> list[DecodedWord]:
        """
        In the order of time.
        """

class ConnectedDecoder:
    """
    Token passing over a word network, frame by frame.
    """
    def __init__(
        self, chains: collections.abc.Sequence[WordChain], network: WordNetwork, options: ConnectedDecoderOptions = ...
    ) -> None: ...
    def finish(self) -> DecodedSentence:
        """
        The best sentence; then as before the first frame.
        """
    def partial(self) -> DecodedSentence:
        """
        The best hypothesis so far.
        """
    def push(self, log_emissions: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> None:
        """
        One frame: log scores of all states, shape (num_states,).
        """
    def push_all(self, log_emissions: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> None:
        """
        push() of every row.
        """
    def reset(self) -> None:
        """
        Back to before the first frame.
        """
    def take_decided(self) -> list[DecodedWord]:
        """
        Words that change no more, since the last call.
        """
    @property
    def alive(self) -> bool:
        """
        Whether any hypothesis is left.
        """
    @property
    def num_active(self) -> int:
        """
        States with a hypothesis.
        """
    @property
    def num_frames(self) -> int:
        """
        Pushed so far.
        """
    @property
    def num_states(self) -> int:
        """
        Of all models.
        """

class LatticeOptions:
    """
    Options of Lattice.

    Parameters
    ----------
    beam : float, default 200.0
        words through which no sentence comes as near as this to the best (natural log) are left out; 0..1e+12
    max_arcs : int, default 200000
        arcs at most; where there would be more, the beam is halved until there are not; 1..100000000
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(self, *, beam: float = 200.0, max_arcs: int = 200000) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def beam(self) -> float:
        """
        words through which no sentence comes as near as this to the best (natural log) are left out
        """
    @beam.setter
    def beam(self, arg1: typing.Any) -> None: ...
    @property
    def max_arcs(self) -> int:
        """
        arcs at most; where there would be more, the beam is halved until there are not
        """
    @max_arcs.setter
    def max_arcs(self, arg1: typing.Any) -> None: ...

class ConfusionSlot:
    """
    What may have been said in one place of a recording.
    """
    @property
    def entries(self) -> list[tuple[int, float]]:
        """
        (model, probability), the most probable first; model -1: no word.
        """
    @property
    def first_frame(self) -> int:
        """
        First frame.
        """
    @property
    def last_frame(self) -> int:
        """
        One past the last frame.
        """

class Lattice:
    """
    All sentences of a recording that come near the best.
    """
    @staticmethod
    def decode(
        chains: collections.abc.Sequence[WordChain],
        network: WordNetwork,
        log_emissions: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        options: ConnectedDecoderOptions = ...,
        lattice_options: LatticeOptions = ...,
    ) -> Lattice:
        """
        Of log scores, shape (num_frames, num_states); exact, without the decoder's beam.
        """
    def __init__(
        self,
        nodes: collections.abc.Sequence[
            tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex, bool]
        ],
        arcs: collections.abc.Sequence[
            tuple[
                typing.SupportsInt | typing.SupportsIndex,
                typing.SupportsInt | typing.SupportsIndex,
                typing.SupportsFloat | typing.SupportsIndex,
                typing.SupportsFloat | typing.SupportsIndex,
            ]
        ],
    ) -> None:
        """
        A node is (model of the word that ends here or -1, frame, is_silence), an arc (from, to, log acoustic score, log weight).
        """
    def best(self) -> DecodedSentence:
        """
        The best sentence.
        """
    def confidences(
        self, words: collections.abc.Sequence[DecodedWord], scale: typing.SupportsFloat | typing.SupportsIndex
    ) -> list[float]:
        """
        For each of the words how probable it is that it was said there.
        """
    def confusion_network(self, scale: typing.SupportsFloat | typing.SupportsIndex) -> list[ConfusionSlot]:
        """
        ConfusionSlots along the best sentence.
        """
    def n_best(self, count: typing.SupportsInt | typing.SupportsIndex) -> list[DecodedSentence]:
        """
        At most `count` sentences that differ in their words, the best first.
        """
    def posteriors(self, scale: typing.SupportsFloat | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
        """
        Probability of every arc, float64; `scale` is on log scores.
        """
    @property
    def arcs(self) -> list[tuple[int, int, float, float]]:
        """
        (from, to, log acoustic score, log weight).
        """
    @property
    def empty(self) -> bool:
        """
        Whether there is no sentence.
        """
    @property
    def nodes(self) -> list[tuple[int, int, bool]]:
        """
        (model, frame, is_silence).
        """

class Grammar:
    """
    Commands with slots, in the JSpeech Grammar Format.
    """
    @staticmethod
    def load(path: str | bytes | os.PathLike[str]) -> Grammar:
        """
        Reads a file; raises FormatError naming file and line.
        """
    @staticmethod
    def parse(text: str, name: str) -> Grammar:
        """
        The same of a text; `name` is what errors call it.
        """
    def network(
        self,
        labels: collections.abc.Sequence[str],
        silence: typing.SupportsInt | typing.SupportsIndex = -1,
        unknown: typing.SupportsInt | typing.SupportsIndex = -1,
    ) -> WordNetwork:
        """
        Its sentences as a WordNetwork; model i is labels[i].
        """
    def sentences(self, most: typing.SupportsInt | typing.SupportsIndex = 10000) -> list[list[str]]:
        """
        Every sentence once, as lists of words, in the grammar's order; raises InvalidArgument for more than `most`, for repetitions, which have no end, for a sentence of more than 10000 words and for more than four million words in all.
        """
    def slots_of(self, sentence: collections.abc.Sequence[str]) -> dict[str, str] | None:
        """
        The slots of a list of words; None for what is no sentence of the grammar, or has more than 10000 words.
        """
    @property
    def text(self) -> str:
        """
        That was read.
        """
    @property
    def words(self) -> list[str]:
        """
        Sorted.
        """

class GaussianEmissions:
    """
    Log densities of the states of several models.
    """
    def __init__(self, models: collections.abc.Sequence[GaussianMixtureHmm]) -> None: ...
    def compute(
        self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, shape (num_frames, num_states).
        """
    @property
    def num_states(self) -> int:
        """
        Of all models.
        """

class PossibilisticEmissions:
    """
    Log possibilities of the states of a set of models.
    """
    def __init__(self, set: PossibilisticHmmSet) -> None: ...
    def compute(
        self, symbols: numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, a row for each symbol, shape (len(symbols), num_states).
        """
    @property
    def num_states(self) -> int:
        """
        Of all models.
        """

class NBest:
    """
    One class of the n-best list.
    """
    @property
    def label(self) -> str:
        """
        A class, "unknown" or "no_input".
        """
    @property
    def log_score(self) -> float:
        """
        The model's own score.
        """
    @property
    def probability(self) -> float:
        """
        Calibrated probability, 0..1.
        """

class Decision:
    """
    What a recogniser says of one utterance or gesture.
    """
    @property
    def class_threshold(self) -> float:
        """
        Confidence from which the best class is sure.
        """
    @property
    def confidence(self) -> float:
        """
        Calibrated probability of the best class.
        """
    @property
    def label(self) -> str:
        """
        A class, "unknown" or "no_input".
        """
    @property
    def nbest(self) -> list[NBest]:
        """
        Every class in falling order.
        """
    @property
    def notes(self) -> list[str]:
        """
        What was converted or assumed on the way.
        """
    @property
    def score(self) -> float:
        """
        What the rejection threshold was compared with.
        """
    @property
    def status(self) -> typing.Literal["recognised", "unknown", "no_input"]:
        """
        'recognised', 'unknown' or 'no_input'.
        """

class UtteranceDecision:
    """
    The decision on one utterance of a longer recording.
    """
    @property
    def decision(self) -> Decision:
        """
        The Decision; empty for segments.
        """
    @property
    def first_s(self) -> float:
        """
        Its beginning, in seconds.
        """
    @property
    def last_s(self) -> float:
        """
        Its end, in seconds.
        """

class ConfusedPair:
    """
    Two classes that are confused with one another.
    """
    @property
    def first(self) -> int:
        """
        A class number.
        """
    @property
    def rate(self) -> float:
        """
        Share of the samples decided for either that are the other.
        """
    @property
    def second(self) -> int:
        """
        A larger one.
        """

class HeldOutReport:
    """
    What training saw on samples held out; hri.HeldOutReport wraps it.
    """
    def confused_pairs(self) -> list[ConfusedPair]:
        """
        List of ConfusedPair in falling order of their rate.
        """
    @property
    def confusion(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        Counts, by true and by best class.
        """
    @property
    def false_accept_rate(self) -> float:
        """
        Share of these that are not below it; 0 without any.
        """
    @property
    def false_reject_rate(self) -> float:
        """
        Share of right decisions below the threshold.
        """
    @property
    def labels(self) -> list[str]:
        """
        Of the classes in training.
        """
    @property
    def num_others(self) -> int:
        """
        How many samples were treated as unknown.
        """

class SequenceModelOptions:
    """
    The models trained on one front end.

    Parameters
    ----------
    model : {'hmm', 'ptbhmm'}, default 'hmm'
        kind of the models
    num_states : int, default 8
        left-right states a class; 1..64
    num_mixtures : int, default 1
        Gaussians a state (hmm); 0: of words one for every two speakers, 1 to 4; else 1; 1..64, or 0
    num_codewords : int, default 128
        size of the codebook (ptbhmm); 2..4096
    garbage_mixtures : int, default 16
        Gaussians of the garbage model that rejection compares with (hmm); 1..256
    max_iterations : int, default 12
        iterations of Baum-Welch at most; 1..1000
    seed : int, default 0
        of everything random in training; 0..2^64 - 1
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        model: typing.Literal["hmm", "ptbhmm"] = "hmm",
        num_states: int = 8,
        num_mixtures: int = 1,
        num_codewords: int = 128,
        garbage_mixtures: int = 16,
        max_iterations: int = 12,
        seed: int = 0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def garbage_mixtures(self) -> int:
        """
        Gaussians of the garbage model that rejection compares with (hmm)
        """
    @garbage_mixtures.setter
    def garbage_mixtures(self, arg1: typing.Any) -> None: ...
    @property
    def max_iterations(self) -> int:
        """
        iterations of Baum-Welch at most
        """
    @max_iterations.setter
    def max_iterations(self, arg1: typing.Any) -> None: ...
    @property
    def model(self) -> typing.Literal["hmm", "ptbhmm"]:
        """
        kind of the models
        """
    @model.setter
    def model(self, arg1: typing.Any) -> None: ...
    @property
    def num_codewords(self) -> int:
        """
        size of the codebook (ptbhmm)
        """
    @num_codewords.setter
    def num_codewords(self, arg1: typing.Any) -> None: ...
    @property
    def num_mixtures(self) -> int:
        """
        Gaussians a state (hmm); 0: of words one for every two speakers, 1 to 4; else 1
        """
    @num_mixtures.setter
    def num_mixtures(self, arg1: typing.Any) -> None: ...
    @property
    def num_states(self) -> int:
        """
        left-right states a class
        """
    @num_states.setter
    def num_states(self, arg1: typing.Any) -> None: ...
    @property
    def seed(self) -> int:
        """
        of everything random in training
        """
    @seed.setter
    def seed(self, arg1: typing.Any) -> None: ...

class WordRecognizerOptions:
    """
    Options of WordRecognizer.

    Parameters
    ----------
    model : {'hmm', 'ptbhmm'}, default 'hmm'
        kind of the models
    num_states : int, default 8
        left-right states a class; 1..64
    num_mixtures : int, default 0
        Gaussians a state (hmm); 0: of words one for every two speakers, 1 to 4; else 1; 1..64, or 0
    num_codewords : int, default 128
        size of the codebook (ptbhmm); 2..4096
    garbage_mixtures : int, default 16
        Gaussians of the garbage model that rejection compares with (hmm); 1..256
    max_iterations : int, default 12
        iterations of Baum-Welch at most; 1..1000
    seed : int, default 0
        of everything random in training; 0..2^64 - 1
    front_end : {'cepstra', 'both', 'embedding'}, default 'cepstra'
        cepstra, both: with a pretrained speech embedding, whose weights are an extra, or that embedding alone, without models of cepstra
    cepstra : CepstraOptions or dict
        features of the speech; sample_rate_hz is the rate of the model whatever the front end
    activity : ActivityOptions or dict
        how the word is found in the clip
    trim : bool, default True
        trim the clip to the word, and activity.padding_ms before and after it
    noise_floor_db : float, default 45.0
        level of the noise added under a trimmed word, below its peak, under which quiet rooms and digital silence are the same; 20..120 dB
    level_stream : bool, default True
        a second stream votes, whose cepstra are normalised in level only
    num_vtlp_factors : int, default 3
        vocal-tract-length perturbation: training copies with a warped frequency axis, itself included; 1: none; 1..5, odd
    vtlp_step : float, default 0.08
        step of the warp factor between these copies; 0..0.2
    num_noisy_copies : int, default 2
        noise augmentation: training copies of every word with noise added, warped in turn; 0..10
    min_snr_db : float, default 0.0
        least signal-to-noise ratio of the noisy copies; -20..100 dB
    max_snr_db : float, default 20.0
        largest; each copy has its own, at random; -20..100 dB
    false_reject_rate : float, default 0.05
        share of correct held-out words that the threshold may reject; noisy copies included, but for front_end both or embedding; 0..0.5
    num_embedding_copies : int, default 4
        front_end both or embedding: training copies of every word for the embedding alone, with noise added and faster or slower by up to 15 %; 0..20
    embedding_weight : float, default 0.0
        front_end both or embedding: factor on the log posteriors by the speech embedding, which join the scores of the cepstra; 0: chosen on words of speakers held out, 1 without cepstra; 0..1000000
    embedding_penalty : float, default 100.0
        front_end both or embedding: of half the squared weights of the embedding's softmax regression; 0..1e+12, 0 excluded
    embedding_shrinkage : float, default 0.8
        front_end both or embedding: of the embedding's linear discriminants, by which words are rejected; 0..1
    embedding_false_accept_rate : float, default 0.1
        front_end both or embedding: share of other words that the threshold may accept; where it and false_reject_rate cannot both be kept to, both are exceeded by the same factor; 0..1
    use_network : bool, default False
        a small network of log mel energies, trained on the same words, votes too: for many speakers
    network : SequenceNetworkOptions or dict
        how that network is made and trained; its random numbers follow `seed`, too
    network_weight : float, default 0.0
        factor on the network's log posteriors, which join the other scores; 0: chosen on words of speakers held out; 0..1000000
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        model: typing.Literal["hmm", "ptbhmm"] = "hmm",
        num_states: int = 8,
        num_mixtures: int = 0,
        num_codewords: int = 128,
        garbage_mixtures: int = 16,
        max_iterations: int = 12,
        seed: int = 0,
        front_end: typing.Literal["cepstra", "both", "embedding"] = "cepstra",
        cepstra: CepstraOptions | collections.abc.Mapping[str, typing.Any] = ...,
        activity: ActivityOptions | collections.abc.Mapping[str, typing.Any] = ...,
        trim: bool = True,
        noise_floor_db: float = 45.0,
        level_stream: bool = True,
        num_vtlp_factors: int = 3,
        vtlp_step: float = 0.08,
        num_noisy_copies: int = 2,
        min_snr_db: float = 0.0,
        max_snr_db: float = 20.0,
        false_reject_rate: float = 0.05,
        num_embedding_copies: int = 4,
        embedding_weight: float = 0.0,
        embedding_penalty: float = 100.0,
        embedding_shrinkage: float = 0.8,
        embedding_false_accept_rate: float = 0.1,
        use_network: bool = False,
        network: SequenceNetworkOptions | collections.abc.Mapping[str, typing.Any] = ...,
        network_weight: float = 0.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def activity(self) -> ActivityOptions:
        """
        how the word is found in the clip
        """
    @activity.setter
    def activity(self, arg1: typing.Any) -> None: ...
    @property
    def cepstra(self) -> CepstraOptions:
        """
        features of the speech; sample_rate_hz is the rate of the model whatever the front end
        """
    @cepstra.setter
    def cepstra(self, arg1: typing.Any) -> None: ...
    @property
    def embedding_false_accept_rate(self) -> float:
        """
        front_end both or embedding: share of other words that the threshold may accept; where it and false_reject_rate cannot both be kept to, both are exceeded by the same factor
        """
    @embedding_false_accept_rate.setter
    def embedding_false_accept_rate(self, arg1: typing.Any) -> None: ...
    @property
    def embedding_penalty(self) -> float:
        """
        front_end both or embedding: of half the squared weights of the embedding's softmax regression
        """
    @embedding_penalty.setter
    def embedding_penalty(self, arg1: typing.Any) -> None: ...
    @property
    def embedding_shrinkage(self) -> float:
        """
        front_end both or embedding: of the embedding's linear discriminants, by which words are rejected
        """
    @embedding_shrinkage.setter
    def embedding_shrinkage(self, arg1: typing.Any) -> None: ...
    @property
    def embedding_weight(self) -> float:
        """
        front_end both or embedding: factor on the log posteriors by the speech embedding, which join the scores of the cepstra; 0: chosen on words of speakers held out, 1 without cepstra
        """
    @embedding_weight.setter
    def embedding_weight(self, arg1: typing.Any) -> None: ...
    @property
    def false_reject_rate(self) -> float:
        """
        share of correct held-out words that the threshold may reject; noisy copies included, but for front_end both or embedding
        """
    @false_reject_rate.setter
    def false_reject_rate(self, arg1: typing.Any) -> None: ...
    @property
    def front_end(self) -> typing.Literal["cepstra", "both", "embedding"]:
        """
        cepstra, both: with a pretrained speech embedding, whose weights are an extra, or that embedding alone, without models of cepstra
        """
    @front_end.setter
    def front_end(self, arg1: typing.Any) -> None: ...
    @property
    def garbage_mixtures(self) -> int:
        """
        Gaussians of the garbage model that rejection compares with (hmm)
        """
    @garbage_mixtures.setter
    def garbage_mixtures(self, arg1: typing.Any) -> None: ...
    @property
    def level_stream(self) -> bool:
        """
        a second stream votes, whose cepstra are normalised in level only
        """
    @level_stream.setter
    def level_stream(self, arg1: typing.Any) -> None: ...
    @property
    def max_iterations(self) -> int:
        """
        iterations of Baum-Welch at most
        """
    @max_iterations.setter
    def max_iterations(self, arg1: typing.Any) -> None: ...
    @property
    def max_snr_db(self) -> float:
        """
        largest; each copy has its own, at random
        """
    @max_snr_db.setter
    def max_snr_db(self, arg1: typing.Any) -> None: ...
    @property
    def min_snr_db(self) -> float:
        """
        least signal-to-noise ratio of the noisy copies
        """
    @min_snr_db.setter
    def min_snr_db(self, arg1: typing.Any) -> None: ...
    @property
    def model(self) -> typing.Literal["hmm", "ptbhmm"]:
        """
        kind of the models
        """
    @model.setter
    def model(self, arg1: typing.Any) -> None: ...
    @property
    def network(self) -> SequenceNetworkOptions:
        """
        how that network is made and trained; its random numbers follow `seed`, too
        """
    @network.setter
    def network(self, arg1: typing.Any) -> None: ...
    @property
    def network_weight(self) -> float:
        """
        factor on the network's log posteriors, which join the other scores; 0: chosen on words of speakers held out
        """
    @network_weight.setter
    def network_weight(self, arg1: typing.Any) -> None: ...
    @property
    def noise_floor_db(self) -> float:
        """
        level of the noise added under a trimmed word, below its peak, under which quiet rooms and digital silence are the same
        """
    @noise_floor_db.setter
    def noise_floor_db(self, arg1: typing.Any) -> None: ...
    @property
    def num_codewords(self) -> int:
        """
        size of the codebook (ptbhmm)
        """
    @num_codewords.setter
    def num_codewords(self, arg1: typing.Any) -> None: ...
    @property
    def num_embedding_copies(self) -> int:
        """
        front_end both or embedding: training copies of every word for the embedding alone, with noise added and faster or slower by up to 15 %
        """
    @num_embedding_copies.setter
    def num_embedding_copies(self, arg1: typing.Any) -> None: ...
    @property
    def num_mixtures(self) -> int:
        """
        Gaussians a state (hmm); 0: of words one for every two speakers, 1 to 4; else 1
        """
    @num_mixtures.setter
    def num_mixtures(self, arg1: typing.Any) -> None: ...
    @property
    def num_noisy_copies(self) -> int:
        """
        noise augmentation: training copies of every word with noise added, warped in turn
        """
    @num_noisy_copies.setter
    def num_noisy_copies(self, arg1: typing.Any) -> None: ...
    @property
    def num_states(self) -> int:
        """
        left-right states a class
        """
    @num_states.setter
    def num_states(self, arg1: typing.Any) -> None: ...
    @property
    def num_vtlp_factors(self) -> int:
        """
        vocal-tract-length perturbation: training copies with a warped frequency axis, itself included; 1: none
        """
    @num_vtlp_factors.setter
    def num_vtlp_factors(self, arg1: typing.Any) -> None: ...
    @property
    def seed(self) -> int:
        """
        of everything random in training
        """
    @seed.setter
    def seed(self, arg1: typing.Any) -> None: ...
    @property
    def trim(self) -> bool:
        """
        trim the clip to the word, and activity.padding_ms before and after it
        """
    @trim.setter
    def trim(self, arg1: typing.Any) -> None: ...
    @property
    def use_network(self) -> bool:
        """
        a small network of log mel energies, trained on the same words, votes too: for many speakers
        """
    @use_network.setter
    def use_network(self, arg1: typing.Any) -> None: ...
    @property
    def vtlp_step(self) -> float:
        """
        step of the warp factor between these copies
        """
    @vtlp_step.setter
    def vtlp_step(self, arg1: typing.Any) -> None: ...

class WordRecognizer:
    """
    Isolated words; hri.WordRecognizer wraps it.
    """
    @staticmethod
    def from_model_file(file: ModelFile, embedding: ... = None) -> WordRecognizer: ...
    @staticmethod
    def load(path: str | bytes | os.PathLike[str], embedding: ... = None) -> WordRecognizer: ...
    @staticmethod
    def train(
        samples: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]],
        sample_rates_hz: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        labels: collections.abc.Sequence[str],
        groups: collections.abc.Sequence[str],
        options: WordRecognizerOptions,
        progress: collections.abc.Callable[[int, int], None] | None = None,
        fillers: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]] = [],
        filler_rates_hz: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex] = [],
        filler_labels: collections.abc.Sequence[str] = [],
        embedding: ... = None,
        embedding_fillers: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]] = [],
        embedding_filler_rates_hz: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex] = [],
        embedding_filler_labels: collections.abc.Sequence[str] = [],
        recordings: collections.abc.Sequence[str] = [],
    ) -> WordRecognizer: ...
    def recognise(
        self,
        audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
    ) -> Decision: ...
    def recognise_utterances(
        self,
        audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
    ) -> list[UtteranceDecision]: ...
    def save(self, path: str | bytes | os.PathLike[str]) -> None: ...
    def scores(
        self,
        audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
    ) -> numpy.typing.NDArray[numpy.float32]: ...
    def to_model_file(self) -> ModelFile: ...
    def with_word(
        self,
        label: str,
        clips: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]],
        sample_rates_hz: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
    ) -> WordRecognizer: ...
    def without_word(self, label: str) -> WordRecognizer: ...
    @property
    def held_out(self) -> HeldOutReport | None:
        """
        HeldOutReport, or None.
        """
    @property
    def is_calibrated(self) -> bool:
        """
        Whether anything was held out to calibrate on; else nothing is rejected.
        """
    @property
    def labels(self) -> list[str]: ...
    @property
    def options(self) -> WordRecognizerOptions:
        """
        As passed, with defaults filled in.
        """
    @property
    def threshold(self) -> float:
        """
        Score from which a word is recognised.
        """

class GestureRecognizerOptions:
    """
    Options of GestureRecognizer.

    Parameters
    ----------
    source : {'silhouettes', 'landmarks'}, default 'silhouettes'
        what the features are taken of
    num_hands : int, default 1
        2: gestures are of both hands, or of either; 1..2
    relation_weight : float, default 3.0
        of the way between two hands, in sides of the picture, beside their shapes, of length 1; 0..1000000
    hands : HandFinderOptions or dict
        how hands are found in pictures
    use_faces : bool, default False
        where a face is seen, hands are those of that person; needs a finder of faces, to which a palm may look like one
    min_quality : float, default 0.25
        least quality of an observation that shows a hand: hands have more in any light, walls mostly less; 0..1
    features : HandFeatureOptions or dict
        features of a hand (silhouettes)
    model : {'svm', 'bayes', 'knn', 'hmm', 'ptbhmm', 'trajectory', 'rbf', 'automatic'}, default 'automatic'
        kind of the models; a trained recogniser says which one automatic became
    svm_cost : float, default 1.0
        C of the linear support vector machine (svm, trajectory); 0..1e+12, 0 excluded
    turn_degrees : float, default 30.0
        training gestures are also learned with the hand turned by so much to either side, in the plane of the picture (trajectory); 0: only as they are; 0..90
    rbf_cost : float, default 10.0
        C of rbf; 0..1e+12, 0 excluded
    rbf_sharpness : float, default 1.5
        of its kernel, see RbfClassifierOptions; 0..1000000, 0 excluded
    num_components : int, default 40
        principal components (bayes, knn, hmm, ptbhmm); 1..1000
    num_neighbours : int, default 5
        k of knn; 1..1000
    num_states : int, default 6
        left-right states a gesture (hmm, ptbhmm); 1..64
    num_codewords : int, default 64
        size of the codebook (ptbhmm); 2..4096
    max_iterations : int, default 12
        iterations of Baum-Welch at most; 1..1000
    false_reject_rate : float, default 0.04
        share of correct held-out gestures that the threshold may reject; 0..0.5
    seed : int, default 0
        of everything random in training; 0..2^64 - 1
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        source: typing.Literal["silhouettes", "landmarks"] = "silhouettes",
        num_hands: int = 1,
        relation_weight: float = 3.0,
        hands: HandFinderOptions | collections.abc.Mapping[str, typing.Any] = ...,
        use_faces: bool = False,
        min_quality: float = 0.25,
        features: HandFeatureOptions | collections.abc.Mapping[str, typing.Any] = ...,
        model: typing.Literal["svm", "bayes", "knn", "hmm", "ptbhmm", "trajectory", "rbf", "automatic"] = "automatic",
        svm_cost: float = 1.0,
        turn_degrees: float = 30.0,
        rbf_cost: float = 10.0,
        rbf_sharpness: float = 1.5,
        num_components: int = 40,
        num_neighbours: int = 5,
        num_states: int = 6,
        num_codewords: int = 64,
        max_iterations: int = 12,
        false_reject_rate: float = 0.04,
        seed: int = 0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def false_reject_rate(self) -> float:
        """
        share of correct held-out gestures that the threshold may reject
        """
    @false_reject_rate.setter
    def false_reject_rate(self, arg1: typing.Any) -> None: ...
    @property
    def features(self) -> HandFeatureOptions:
        """
        features of a hand (silhouettes)
        """
    @features.setter
    def features(self, arg1: typing.Any) -> None: ...
    @property
    def hands(self) -> HandFinderOptions:
        """
        how hands are found in pictures
        """
    @hands.setter
    def hands(self, arg1: typing.Any) -> None: ...
    @property
    def max_iterations(self) -> int:
        """
        iterations of Baum-Welch at most
        """
    @max_iterations.setter
    def max_iterations(self, arg1: typing.Any) -> None: ...
    @property
    def min_quality(self) -> float:
        """
        least quality of an observation that shows a hand: hands have more in any light, walls mostly less
        """
    @min_quality.setter
    def min_quality(self, arg1: typing.Any) -> None: ...
    @property
    def model(self) -> typing.Literal["svm", "bayes", "knn", "hmm", "ptbhmm", "trajectory", "rbf", "automatic"]:
        """
        kind of the models; a trained recogniser says which one automatic became
        """
    @model.setter
    def model(self, arg1: typing.Any) -> None: ...
    @property
    def num_codewords(self) -> int:
        """
        size of the codebook (ptbhmm)
        """
    @num_codewords.setter
    def num_codewords(self, arg1: typing.Any) -> None: ...
    @property
    def num_components(self) -> int:
        """
        principal components (bayes, knn, hmm, ptbhmm)
        """
    @num_components.setter
    def num_components(self, arg1: typing.Any) -> None: ...
    @property
    def num_hands(self) -> int:
        """
        2: gestures are of both hands, or of either
        """
    @num_hands.setter
    def num_hands(self, arg1: typing.Any) -> None: ...
    @property
    def num_neighbours(self) -> int:
        """
        k of knn
        """
    @num_neighbours.setter
    def num_neighbours(self, arg1: typing.Any) -> None: ...
    @property
    def num_states(self) -> int:
        """
        left-right states a gesture (hmm, ptbhmm)
        """
    @num_states.setter
    def num_states(self, arg1: typing.Any) -> None: ...
    @property
    def rbf_cost(self) -> float:
        """
        C of rbf
        """
    @rbf_cost.setter
    def rbf_cost(self, arg1: typing.Any) -> None: ...
    @property
    def rbf_sharpness(self) -> float:
        """
        of its kernel, see RbfClassifierOptions
        """
    @rbf_sharpness.setter
    def rbf_sharpness(self, arg1: typing.Any) -> None: ...
    @property
    def relation_weight(self) -> float:
        """
        of the way between two hands, in sides of the picture, beside their shapes, of length 1
        """
    @relation_weight.setter
    def relation_weight(self, arg1: typing.Any) -> None: ...
    @property
    def seed(self) -> int:
        """
        of everything random in training
        """
    @seed.setter
    def seed(self, arg1: typing.Any) -> None: ...
    @property
    def source(self) -> typing.Literal["silhouettes", "landmarks"]:
        """
        what the features are taken of
        """
    @source.setter
    def source(self, arg1: typing.Any) -> None: ...
    @property
    def svm_cost(self) -> float:
        """
        C of the linear support vector machine (svm, trajectory)
        """
    @svm_cost.setter
    def svm_cost(self, arg1: typing.Any) -> None: ...
    @property
    def turn_degrees(self) -> float:
        """
        training gestures are also learned with the hand turned by so much to either side, in the plane of the picture (trajectory); 0: only as they are
        """
    @turn_degrees.setter
    def turn_degrees(self, arg1: typing.Any) -> None: ...
    @property
    def use_faces(self) -> bool:
        """
        where a face is seen, hands are those of that person; needs a finder of faces, to which a palm may look like one
        """
    @use_faces.setter
    def use_faces(self, arg1: typing.Any) -> None: ...

class GestureFeatureComputer:
    """
    Rows of features, one a frame that shows a hand.
    """
    def __init__(
        self, options: HandFeatureOptions = ..., min_quality: typing.SupportsFloat | typing.SupportsIndex = 0.0
    ) -> None: ...
    def compute(self, hands: collections.abc.Sequence[HandObservation]) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, shape (num_hands, num_features).
        """
    def compute_every(self, hands: collections.abc.Sequence[HandObservation]) -> numpy.typing.NDArray[numpy.float32]:
        """
        The same with a row for every frame, all NaN where it shows no hand.
        """
    @property
    def num_features(self) -> int:
        """
        Columns of the features.
        """

class GestureRecognizer:
    """
    Signs and gestures; hri.GestureRecognizer wraps it.
    """
    @staticmethod
    def features(
        greys: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]],
        masks: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]],
        options: HandFeatureOptions,
    ) -> numpy.typing.NDArray[numpy.float32]: ...
    @staticmethod
    def from_model_file(file: ModelFile) -> GestureRecognizer: ...
    @staticmethod
    def load(path: str | bytes | os.PathLike[str]) -> GestureRecognizer: ...
    @staticmethod
    def train(
        features: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]],
        labels: collections.abc.Sequence[str],
        groups: collections.abc.Sequence[str],
        options: GestureRecognizerOptions,
        progress: collections.abc.Callable[[int, int], None] | None = None,
    ) -> GestureRecognizer: ...
    def recognise(self, hands: collections.abc.Sequence[HandObservation]) -> Decision: ...
    def recognise_features(self, features: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> Decision: ...
    def save(self, path: str | bytes | os.PathLike[str]) -> None: ...
    def scores(
        self, features: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]: ...
    def to_model_file(self) -> ModelFile: ...
    def with_gesture(
        self, label: str, features: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]]
    ) -> GestureRecognizer: ...
    @property
    def held_out(self) -> HeldOutReport | None:
        """
        HeldOutReport, or None.
        """
    @property
    def is_calibrated(self) -> bool:
        """
        Whether anything was held out to calibrate on; else nothing is rejected.
        """
    @property
    def is_dynamic(self) -> bool: ...
    @property
    def labels(self) -> list[str]: ...
    @property
    def options(self) -> GestureRecognizerOptions:
        """
        As passed, with defaults filled in.
        """
    @property
    def pauses(self) -> bool: ...
    @property
    def starts_at_rest(self) -> bool: ...

class SpeakerAdapterOptions:
    """
    Options of SpeakerAdapter.

    Parameters
    ----------
    words_per_label : float, default 5.0
        words a label, on average, from which on each word's model is adapted too; before, only what all have in common; 0..1000
    shared_frames : float, default 400.0
        imagined frames that hold back what changes all words in each of two passes, of which the second starts from the first: of as many real frames, three quarters of the change come through, not half; 0..1e+12, 0 excluded
    prior_frames : float, default 5.0
        frames a state that weigh as much as the training; 0..1e+12, 0 excluded
    num_iterations : int, default 3
        EM iterations of an update; 1..1000
    trusted_share : float, default 1.0
        share of the words without a label to learn from, those of the largest margins first; 0..1
    max_words : int, default 300
        words remembered; the oldest goes first; 1..100000
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        words_per_label: float = 5.0,
        shared_frames: float = 400.0,
        prior_frames: float = 5.0,
        num_iterations: int = 3,
        trusted_share: float = 1.0,
        max_words: int = 300,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def max_words(self) -> int:
        """
        words remembered; the oldest goes first
        """
    @max_words.setter
    def max_words(self, arg1: typing.Any) -> None: ...
    @property
    def num_iterations(self) -> int:
        """
        EM iterations of an update
        """
    @num_iterations.setter
    def num_iterations(self, arg1: typing.Any) -> None: ...
    @property
    def prior_frames(self) -> float:
        """
        frames a state that weigh as much as the training
        """
    @prior_frames.setter
    def prior_frames(self, arg1: typing.Any) -> None: ...
    @property
    def shared_frames(self) -> float:
        """
        imagined frames that hold back what changes all words in each of two passes, of which the second starts from the first: of as many real frames, three quarters of the change come through, not half
        """
    @shared_frames.setter
    def shared_frames(self, arg1: typing.Any) -> None: ...
    @property
    def trusted_share(self) -> float:
        """
        share of the words without a label to learn from, those of the largest margins first
        """
    @trusted_share.setter
    def trusted_share(self, arg1: typing.Any) -> None: ...
    @property
    def words_per_label(self) -> float:
        """
        words a label, on average, from which on each word's model is adapted too; before, only what all have in common
        """
    @words_per_label.setter
    def words_per_label(self, arg1: typing.Any) -> None: ...

class SpeakerAdapter:
    """
    Adapts a word recogniser to a speaker.
    """
    def __init__(self, recognizer: WordRecognizer, options: SpeakerAdapterOptions = ...) -> None: ...
    def learn(
        self,
        audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
        label: str,
    ) -> None: ...
    def recognise(
        self,
        audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
    ) -> Decision: ...
    def reset(self) -> None: ...
    def update(self) -> None: ...
    @property
    def num_learned(self) -> int: ...
    @property
    def num_words(self) -> int: ...
    @property
    def recognizer(self) -> WordRecognizer: ...
    @property
    def update_due(self) -> bool: ...

class SpeechEmbeddingOptions:
    """
    How one word becomes one vector.

    Parameters
    ----------
    trim : bool, default True
        trim the clip to the word, and activity.padding_ms before and after it
    activity : ActivityOptions or dict
        how the word is found in the clip
    level : float, default 0.1
        peak that the word is brought to; 0.001..1
    noise_floor_db : float, default 50.0
        level of the noise added under and around the word, below its peak; 20..120 dB
    padding_s : float, default 0.6
        noise before and after the word; 0.4..10 s
    rows_per_step : int, default 2
        1, 2, 4 or 8: windows begin so many times as often as every 80 ms; 1..8
    num_pieces : int, default 6
        pieces of equal length whose mean embeddings make up the vector; 1..10
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        trim: bool = True,
        activity: ActivityOptions | collections.abc.Mapping[str, typing.Any] = ...,
        level: float = 0.1,
        noise_floor_db: float = 50.0,
        padding_s: float = 0.6,
        rows_per_step: int = 2,
        num_pieces: int = 6,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def activity(self) -> ActivityOptions:
        """
        how the word is found in the clip
        """
    @activity.setter
    def activity(self, arg1: typing.Any) -> None: ...
    @property
    def level(self) -> float:
        """
        peak that the word is brought to
        """
    @level.setter
    def level(self, arg1: typing.Any) -> None: ...
    @property
    def noise_floor_db(self) -> float:
        """
        level of the noise added under and around the word, below its peak
        """
    @noise_floor_db.setter
    def noise_floor_db(self, arg1: typing.Any) -> None: ...
    @property
    def num_pieces(self) -> int:
        """
        pieces of equal length whose mean embeddings make up the vector
        """
    @num_pieces.setter
    def num_pieces(self, arg1: typing.Any) -> None: ...
    @property
    def padding_s(self) -> float:
        """
        noise before and after the word
        """
    @padding_s.setter
    def padding_s(self, arg1: typing.Any) -> None: ...
    @property
    def rows_per_step(self) -> int:
        """
        1, 2, 4 or 8: windows begin so many times as often as every 80 ms
        """
    @rows_per_step.setter
    def rows_per_step(self, arg1: typing.Any) -> None: ...
    @property
    def trim(self) -> bool:
        """
        trim the clip to the word, and activity.padding_ms before and after it
        """
    @trim.setter
    def trim(self, arg1: typing.Any) -> None: ...

class SpeechEmbedding:
    """
    A pretrained speech embedding.
    """
    def __init__(self, path: str | bytes | os.PathLike[str], options: SpeechEmbeddingOptions = ...) -> None: ...
    def compute(
        self,
        audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
    ) -> numpy.typing.NDArray[numpy.float32]: ...
    def word(
        self,
        audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
    ) -> numpy.typing.NDArray[numpy.float32]: ...
    @property
    def checksum(self) -> str: ...
    @property
    def num_outputs(self) -> int: ...
    @property
    def options(self) -> SpeechEmbeddingOptions: ...
    @property
    def step_s(self) -> float: ...
    @property
    def window_s(self) -> float: ...

class GestureSegmenterOptions:
    """
    When a gesture begins and ends; times in seconds.

    Parameters
    ----------
    appear_s : float, default 0.1
        a hand is there, or moves again, when it was seen, or moving, for so long; 0..1000000, 0 excluded s
    leave_s : float, default 0.3
        it has gone when it was not seen for so long; 0..1000000, 0 excluded s
    rest_s : float, default 0.5
        a hand that is still for so long ends the segment: it rests, or holds a sign; 0..1000000, 0 excluded s
    still_change : float, default 0.3
        it is still while the outlines of now and of compare_s ago differ by less than this share of what they cover together; 0..1, 0 excluded, 1 excluded
    compare_s : float, default 0.2
        time between the outlines that are compared; 0..1000000, 0 excluded s
    min_gesture_s : float, default 0.3
        a shorter segment that ends in the hand leaving is dropped; 0..1000000, 0 excluded s
    max_gesture_s : float, default 6.0
        a longer segment is cut; above min_gesture_s; 0..1000000, 0 excluded s
    take_away_s : float, default 1.0
        a hand that rested and leaves within this time is taken away, and shows nothing; 0..1000000, 0 excluded s
    context_s : float, default 0.1
        kept before a segment; 0..1000000, 0 excluded s
    arrivals : bool, default True
        a hand that comes into view and rests has shown something, such as a sign that it holds; otherwise only what comes after that rest is a gesture
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        appear_s: float = 0.1,
        leave_s: float = 0.3,
        rest_s: float = 0.5,
        still_change: float = 0.3,
        compare_s: float = 0.2,
        min_gesture_s: float = 0.3,
        max_gesture_s: float = 6.0,
        take_away_s: float = 1.0,
        context_s: float = 0.1,
        arrivals: bool = True,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def appear_s(self) -> float:
        """
        a hand is there, or moves again, when it was seen, or moving, for so long
        """
    @appear_s.setter
    def appear_s(self, arg1: typing.Any) -> None: ...
    @property
    def arrivals(self) -> bool:
        """
        a hand that comes into view and rests has shown something, such as a sign that it holds; otherwise only what comes after that rest is a gesture
        """
    @arrivals.setter
    def arrivals(self, arg1: typing.Any) -> None: ...
    @property
    def compare_s(self) -> float:
        """
        time between the outlines that are compared
        """
    @compare_s.setter
    def compare_s(self, arg1: typing.Any) -> None: ...
    @property
    def context_s(self) -> float:
        """
        kept before a segment
        """
    @context_s.setter
    def context_s(self, arg1: typing.Any) -> None: ...
    @property
    def leave_s(self) -> float:
        """
        it has gone when it was not seen for so long
        """
    @leave_s.setter
    def leave_s(self, arg1: typing.Any) -> None: ...
    @property
    def max_gesture_s(self) -> float:
        """
        a longer segment is cut; above min_gesture_s
        """
    @max_gesture_s.setter
    def max_gesture_s(self, arg1: typing.Any) -> None: ...
    @property
    def min_gesture_s(self) -> float:
        """
        a shorter segment that ends in the hand leaving is dropped
        """
    @min_gesture_s.setter
    def min_gesture_s(self, arg1: typing.Any) -> None: ...
    @property
    def rest_s(self) -> float:
        """
        a hand that is still for so long ends the segment: it rests, or holds a sign
        """
    @rest_s.setter
    def rest_s(self, arg1: typing.Any) -> None: ...
    @property
    def still_change(self) -> float:
        """
        it is still while the outlines of now and of compare_s ago differ by less than this share of what they cover together
        """
    @still_change.setter
    def still_change(self, arg1: typing.Any) -> None: ...
    @property
    def take_away_s(self) -> float:
        """
        a hand that rested and leaves within this time is taken away, and shows nothing
        """
    @take_away_s.setter
    def take_away_s(self, arg1: typing.Any) -> None: ...

class GestureSegment:
    """
    An event in a stream of masks.
    """
    @property
    def first_s(self) -> float:
        """
        Its beginning, in seconds.
        """
    @property
    def from_rest(self) -> bool:
        """
        The hand rested in view before it.
        """
    @property
    def kind(self) -> typing.Literal["none", "start", "end", "dropped"]:
        """
        'none', 'start', 'end' or 'dropped'.
        """
    @property
    def last_s(self) -> float:
        """
        Its end, in seconds.
        """
    @property
    def reason(self) -> typing.Literal["none", "rested", "left", "cut", "ended", "arrived", "stalled"]:
        """
        Why it ended: 'rested', 'left', 'cut', 'ended', 'arrived', 'stalled'.
        """

class GestureSegmenter:
    """
    Finds when gestures begin and end, from masks of the hand.
    """
    def __init__(self, options: GestureSegmenterOptions = ...) -> None: ...
    def finish(self) -> GestureSegment:
        """
        The stream has ended.
        """
    def interrupt(self) -> GestureSegment:
        """
        Forgets everything; what had begun is dropped.
        """
    def push(
        self,
        mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8],
        time_s: typing.SupportsFloat | typing.SupportsIndex,
    ) -> GestureSegment:
        """
        The next mask (0 is background) and its time.
        """
    def replace_outlines(self, mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]) -> None:
        """
        The hand of now looks like this, as it is found in another way.
        """
    @property
    def hand_away(self) -> bool:
        """
        No hand is in view.
        """
    @property
    def in_gesture(self) -> bool:
        """
        A gesture has begun and not ended.
        """
    @property
    def may_have_begun_s(self) -> float | None:
        """
        When a gesture that is not reported yet may have begun.
        """
    @property
    def options(self) -> GestureSegmenterOptions:
        """
        As passed, with defaults filled in.
        """

class ConnectedWordRecognizerOptions:
    """
    Options of ConnectedWordRecognizer.

    Parameters
    ----------
    words : WordRecognizerOptions or dict
        front end, models and augmentation as of isolated words; ptbhmm: the same densities as possibilities over codewords, num_codewords for every column of the features; front_end both: words of a first search are named anew by a pretrained speech embedding; what these reject words by is not used
    silence_states : int, default 3
        left-right states of silence; 1..64
    silence_mixtures : int, default 4
        Gaussians of each of them; 1..64
    max_words : int, default 7
        words of the strings that are trained on, at most; 1..100
    max_pause_ms : float, default 300.0
        longest pause in these strings; 0..10000 ms
    num_alignments : int, default 1
        times that the boundaries of words are moved to where the models put them, and the models trained again; 0..10
    choose_penalty : bool, default True
        decoder.insertion_penalty, confidence_scale, unknown_lead and, where it is 0, words.embedding_weight are chosen on strings of speakers held out
    confidence_scale : float, default 0.02
        factor on log scores in confidences, as neighbouring frames do not score independently; 1e-06..1
    min_confidence : float, default 0.0
        words of less confidence are marked unknown; 0..1
    unknown_words : bool, default False
        sounds that fit no word of the vocabulary become words marked unknown
    unknown_rank : int, default 16
        states that an unknown word's score in a frame is the mean of, the best of all words and filler words; 1..1000
    unknown_lead : float, default 12.0
        how far the best state of the words lies above this mean on average, before the speaker is known; 0..1000000
    unknown_margin : float, default 1.0
        an unknown word scores as much below the average of the best states, as a share of unknown_lead; larger: fewer words are unknown; 0..1000
    decoder : ConnectedDecoderOptions or dict
        how sentences are searched
    lattice : LatticeOptions or dict
        which other sentences are kept, for confidences
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        words: WordRecognizerOptions | collections.abc.Mapping[str, typing.Any] = ...,
        silence_states: int = 3,
        silence_mixtures: int = 4,
        max_words: int = 7,
        max_pause_ms: float = 300.0,
        num_alignments: int = 1,
        choose_penalty: bool = True,
        confidence_scale: float = 0.02,
        min_confidence: float = 0.0,
        unknown_words: bool = False,
        unknown_rank: int = 16,
        unknown_lead: float = 12.0,
        unknown_margin: float = 1.0,
        decoder: ConnectedDecoderOptions | collections.abc.Mapping[str, typing.Any] = ...,
        lattice: LatticeOptions | collections.abc.Mapping[str, typing.Any] = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def choose_penalty(self) -> bool:
        """
        decoder.insertion_penalty, confidence_scale, unknown_lead and, where it is 0, words.embedding_weight are chosen on strings of speakers held out
        """
    @choose_penalty.setter
    def choose_penalty(self, arg1: typing.Any) -> None: ...
    @property
    def confidence_scale(self) -> float:
        """
        factor on log scores in confidences, as neighbouring frames do not score independently
        """
    @confidence_scale.setter
    def confidence_scale(self, arg1: typing.Any) -> None: ...
    @property
    def decoder(self) -> ConnectedDecoderOptions:
        """
        how sentences are searched
        """
    @decoder.setter
    def decoder(self, arg1: typing.Any) -> None: ...
    @property
    def lattice(self) -> LatticeOptions:
        """
        which other sentences are kept, for confidences
        """
    @lattice.setter
    def lattice(self, arg1: typing.Any) -> None: ...
    @property
    def max_pause_ms(self) -> float:
        """
        longest pause in these strings
        """
    @max_pause_ms.setter
    def max_pause_ms(self, arg1: typing.Any) -> None: ...
    @property
    def max_words(self) -> int:
        """
        words of the strings that are trained on, at most
        """
    @max_words.setter
    def max_words(self, arg1: typing.Any) -> None: ...
    @property
    def min_confidence(self) -> float:
        """
        words of less confidence are marked unknown
        """
    @min_confidence.setter
    def min_confidence(self, arg1: typing.Any) -> None: ...
    @property
    def num_alignments(self) -> int:
        """
        times that the boundaries of words are moved to where the models put them, and the models trained again
        """
    @num_alignments.setter
    def num_alignments(self, arg1: typing.Any) -> None: ...
    @property
    def silence_mixtures(self) -> int:
        """
        Gaussians of each of them
        """
    @silence_mixtures.setter
    def silence_mixtures(self, arg1: typing.Any) -> None: ...
    @property
    def silence_states(self) -> int:
        """
        left-right states of silence
        """
    @silence_states.setter
    def silence_states(self, arg1: typing.Any) -> None: ...
    @property
    def unknown_lead(self) -> float:
        """
        how far the best state of the words lies above this mean on average, before the speaker is known
        """
    @unknown_lead.setter
    def unknown_lead(self, arg1: typing.Any) -> None: ...
    @property
    def unknown_margin(self) -> float:
        """
        an unknown word scores as much below the average of the best states, as a share of unknown_lead; larger: fewer words are unknown
        """
    @unknown_margin.setter
    def unknown_margin(self, arg1: typing.Any) -> None: ...
    @property
    def unknown_rank(self) -> int:
        """
        states that an unknown word's score in a frame is the mean of, the best of all words and filler words
        """
    @unknown_rank.setter
    def unknown_rank(self, arg1: typing.Any) -> None: ...
    @property
    def unknown_words(self) -> bool:
        """
        sounds that fit no word of the vocabulary become words marked unknown
        """
    @unknown_words.setter
    def unknown_words(self, arg1: typing.Any) -> None: ...
    @property
    def words(self) -> WordRecognizerOptions:
        """
        front end, models and augmentation as of isolated words; ptbhmm: the same densities as possibilities over codewords, num_codewords for every column of the features; front_end both: words of a first search are named anew by a pretrained speech embedding; what these reject words by is not used
        """
    @words.setter
    def words(self, arg1: typing.Any) -> None: ...

class TranscribedWord:
    """
    One word of a transcript.
    """
    @property
    def confidence(self) -> float | None:
        """
        How probable it is that this word was said here; None: not known.
        """
    @property
    def first_s(self) -> float:
        """
        Its beginning, in seconds.
        """
    @property
    def label(self) -> str:
        """
        A word of the vocabulary.
        """
    @property
    def last_s(self) -> float:
        """
        Its end, in seconds.
        """
    @property
    def log_score(self) -> float:
        """
        What it adds to the transcript's.
        """
    @property
    def unknown(self) -> bool:
        """
        Whether it is no word of the vocabulary, or its confidence too low.
        """

class TranscriptAlternative:
    """
    Another sentence.
    """
    @property
    def log_score(self) -> float:
        """
        Of its best path.
        """
    @property
    def words(self) -> list[TranscribedWord]:
        """
        In the order of time.
        """

class ScoredRecording:
    """
    A recording as models score it.
    """
    @property
    def first_s(self) -> float:
        """
        Where the first frame begins.
        """
    @property
    def frame_s(self) -> float:
        """
        From one frame to the next.
        """
    @property
    def log_emissions(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, shape (num_frames, num_states).
        """

class Transcript:
    """
    The words of a recording.
    """
    @property
    def alternatives(self) -> list[TranscriptAlternative]:
        """
        The best first.
        """
    @property
    def complete(self) -> bool:
        """
        Whether there were enough frames.
        """
    @property
    def log_score(self) -> float:
        """
        Of the best path.
        """
    @property
    def notes(self) -> list[str]:
        """
        What was converted or assumed on the way.
        """
    @property
    def slots(self) -> dict[str, str]:
        """
        Of the grammar.
        """
    @property
    def words(self) -> list[TranscribedWord]:
        """
        In the order of time.
        """

class ConnectedWordRecognizer:
    """
    Connected words; hri.ConnectedWordRecognizer wraps it.
    """
    @staticmethod
    def from_model_file(file: ModelFile, embedding: SpeechEmbedding = None) -> ConnectedWordRecognizer: ...
    @staticmethod
    def load(path: str | bytes | os.PathLike[str], embedding: SpeechEmbedding = None) -> ConnectedWordRecognizer: ...
    @staticmethod
    def train(
        samples: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]],
        sample_rates_hz: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        labels: collections.abc.Sequence[str],
        groups: collections.abc.Sequence[str],
        options: ConnectedWordRecognizerOptions,
        progress: collections.abc.Callable[[int, int], None] | None = None,
        fillers: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]] = [],
        filler_rates_hz: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex] = [],
        filler_labels: collections.abc.Sequence[str] = [],
        filler_groups: collections.abc.Sequence[str] = [],
        embedding: SpeechEmbedding = None,
    ) -> ConnectedWordRecognizer: ...
    def align(self, recording: ScoredRecording, words: collections.abc.Sequence[str]) -> Transcript: ...
    def lattice(
        self, recording: ScoredRecording, num_words: typing.SupportsInt | typing.SupportsIndex = 0
    ) -> Lattice: ...
    def recognise(
        self,
        audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
        num_words: typing.SupportsInt | typing.SupportsIndex = 0,
        num_alternatives: typing.SupportsInt | typing.SupportsIndex = 0,
    ) -> Transcript: ...
    def save(self, path: str | bytes | os.PathLike[str]) -> None: ...
    def score(
        self,
        audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
    ) -> ScoredRecording: ...
    def to_model_file(self) -> ModelFile: ...
    def with_decoder(self, decoder: ConnectedDecoderOptions) -> ConnectedWordRecognizer: ...
    def with_grammar(self, grammar: Grammar) -> ConnectedWordRecognizer: ...
    def with_language(self, language: NGramModel) -> ConnectedWordRecognizer: ...
    @property
    def labels(self) -> list[str]: ...
    @property
    def num_fillers(self) -> int:
        """
        Filler words with a model; none without unknown_words.
        """
    @property
    def options(self) -> ConnectedWordRecognizerOptions:
        """
        As trained, with what training chose.
        """

class ConnectedWordStreamOptions:
    """
    Options of ConnectedWordStream.

    Parameters
    ----------
    endpointer : EndpointerOptions or dict
        how utterances are found: pauses between words must not end them, so that hangover_ms is longer than for single words
    partial_ms : float, default 300.0
        an utterance is searched again when it has grown by this; 50..60000 ms
    partial_share : float, default 0.1
        and by this share of its length, so that long ones do not cost more and more; 0..10
    num_alternatives : int, default 0
        sentences to give at the end of an utterance; 0..1000
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        endpointer: EndpointerOptions | collections.abc.Mapping[str, typing.Any] = ...,
        partial_ms: float = 300.0,
        partial_share: float = 0.1,
        num_alternatives: int = 0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def endpointer(self) -> EndpointerOptions:
        """
        how utterances are found: pauses between words must not end them, so that hangover_ms is longer than for single words
        """
    @endpointer.setter
    def endpointer(self, arg1: typing.Any) -> None: ...
    @property
    def num_alternatives(self) -> int:
        """
        sentences to give at the end of an utterance
        """
    @num_alternatives.setter
    def num_alternatives(self, arg1: typing.Any) -> None: ...
    @property
    def partial_ms(self) -> float:
        """
        an utterance is searched again when it has grown by this
        """
    @partial_ms.setter
    def partial_ms(self, arg1: typing.Any) -> None: ...
    @property
    def partial_share(self) -> float:
        """
        and by this share of its length, so that long ones do not cost more and more
        """
    @partial_share.setter
    def partial_share(self, arg1: typing.Any) -> None: ...

class ConnectedWordResult:
    """
    What an utterance holds.
    """
    @property
    def first_s(self) -> float:
        """
        Its beginning.
        """
    @property
    def is_final(self) -> bool:
        """
        Whether it has ended.
        """
    @property
    def last_s(self) -> float:
        """
        Its end, so far.
        """
    @property
    def num_stable(self) -> int:
        """
        So many of the first words are kept until the utterance ends.
        """
    @property
    def transcript(self) -> Transcript:
        """
        Times from the beginning of the stream.
        """

class ConnectedWordStream:
    """
    A stream; hri.recognition.ConnectedWordStream wraps it.
    """
    def __init__(
        self,
        recognizer: ConnectedWordRecognizer,
        sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
        options: ConnectedWordStreamOptions,
        wake_word: str,
    ) -> None: ...
    def finish(self) -> list[ConnectedWordResult]: ...
    def process(
        self, samples: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> list[ConnectedWordResult]: ...
    @property
    def num_kept(self) -> int:
        """
        Samples in memory.
        """
    @property
    def options(self) -> ConnectedWordStreamOptions: ...

class HtkFeatureOptions:
    """
    How HTK computes parameters; defaults are HTK's.

    Parameters
    ----------
    frame_shift_ms : float, default 10.0
        TARGETRATE; 1..1000 ms
    frame_length_ms : float, default 25.6
        WINDOWSIZE; 1..1000 ms
    zero_mean : bool, default False
        ZMEANSOURCE: subtract the mean of every frame
    pre_emphasis : float, default 0.97
        PREEMCOEF; 0..1
    hamming : bool, default True
        USEHAMMING; False: no window
    use_power : bool, default False
        USEPOWER: filters over the power, not the magnitude
    num_filters : int, default 20
        NUMCHANS; 2..512
    low_hz : float, default 0.0
        LOFREQ; 0..192000 Hz
    high_hz : float, default 0.0
        HIFREQ; 0: half the sample rate; 0..192000 Hz
    warp : float, default 1.0
        WARPFREQ: frequencies are divided by it; 0.5..2
    warp_low_hz : float, default 0.0
        WARPLCUTOFF; 0..192000 Hz
    warp_high_hz : float, default 0.0
        WARPUCUTOFF; 0..192000 Hz
    lpc_order : int, default 12
        LPCORDER; 1..64
    num_cepstra : int, default 12
        NUMCEPS; 1..511
    lifter : float, default 22.0
        CEPLIFTER; 0: off; 0..1000000
    raw_energy : bool, default True
        RAWENERGY: the energy before pre-emphasis and window
    normalise_energy : bool, default True
        ENORMALISE: 1 - energy_scale times how far a frame's log energy is below the largest
    energy_scale : float, default 0.1
        ESCALE; 0..1000000, 0 excluded
    silence_floor_db : float, default 50.0
        SILFLOOR: energies further below the largest are raised to that; 0..1000 dB
    delta_window : int, default 2
        DELTAWINDOW; 1..10
    acceleration_window : int, default 2
        ACCWINDOW; 1..10
    third_window : int, default 2
        THIRDWINDOW; 1..10
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        frame_shift_ms: float = 10.0,
        frame_length_ms: float = 25.6,
        zero_mean: bool = False,
        pre_emphasis: float = 0.97,
        hamming: bool = True,
        use_power: bool = False,
        num_filters: int = 20,
        low_hz: float = 0.0,
        high_hz: float = 0.0,
        warp: float = 1.0,
        warp_low_hz: float = 0.0,
        warp_high_hz: float = 0.0,
        lpc_order: int = 12,
        num_cepstra: int = 12,
        lifter: float = 22.0,
        raw_energy: bool = True,
        normalise_energy: bool = True,
        energy_scale: float = 0.1,
        silence_floor_db: float = 50.0,
        delta_window: int = 2,
        acceleration_window: int = 2,
        third_window: int = 2,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def acceleration_window(self) -> int:
        """
        ACCWINDOW
        """
    @acceleration_window.setter
    def acceleration_window(self, arg1: typing.Any) -> None: ...
    @property
    def delta_window(self) -> int:
        """
        DELTAWINDOW
        """
    @delta_window.setter
    def delta_window(self, arg1: typing.Any) -> None: ...
    @property
    def energy_scale(self) -> float:
        """
        ESCALE
        """
    @energy_scale.setter
    def energy_scale(self, arg1: typing.Any) -> None: ...
    @property
    def frame_length_ms(self) -> float:
        """
        WINDOWSIZE
        """
    @frame_length_ms.setter
    def frame_length_ms(self, arg1: typing.Any) -> None: ...
    @property
    def frame_shift_ms(self) -> float:
        """
        TARGETRATE
        """
    @frame_shift_ms.setter
    def frame_shift_ms(self, arg1: typing.Any) -> None: ...
    @property
    def hamming(self) -> bool:
        """
        USEHAMMING; False: no window
        """
    @hamming.setter
    def hamming(self, arg1: typing.Any) -> None: ...
    @property
    def high_hz(self) -> float:
        """
        HIFREQ; 0: half the sample rate
        """
    @high_hz.setter
    def high_hz(self, arg1: typing.Any) -> None: ...
    @property
    def lifter(self) -> float:
        """
        CEPLIFTER; 0: off
        """
    @lifter.setter
    def lifter(self, arg1: typing.Any) -> None: ...
    @property
    def low_hz(self) -> float:
        """
        LOFREQ
        """
    @low_hz.setter
    def low_hz(self, arg1: typing.Any) -> None: ...
    @property
    def lpc_order(self) -> int:
        """
        LPCORDER
        """
    @lpc_order.setter
    def lpc_order(self, arg1: typing.Any) -> None: ...
    @property
    def normalise_energy(self) -> bool:
        """
        ENORMALISE: 1 - energy_scale times how far a frame's log energy is below the largest
        """
    @normalise_energy.setter
    def normalise_energy(self, arg1: typing.Any) -> None: ...
    @property
    def num_cepstra(self) -> int:
        """
        NUMCEPS
        """
    @num_cepstra.setter
    def num_cepstra(self, arg1: typing.Any) -> None: ...
    @property
    def num_filters(self) -> int:
        """
        NUMCHANS
        """
    @num_filters.setter
    def num_filters(self, arg1: typing.Any) -> None: ...
    @property
    def pre_emphasis(self) -> float:
        """
        PREEMCOEF
        """
    @pre_emphasis.setter
    def pre_emphasis(self, arg1: typing.Any) -> None: ...
    @property
    def raw_energy(self) -> bool:
        """
        RAWENERGY: the energy before pre-emphasis and window
        """
    @raw_energy.setter
    def raw_energy(self, arg1: typing.Any) -> None: ...
    @property
    def silence_floor_db(self) -> float:
        """
        SILFLOOR: energies further below the largest are raised to that
        """
    @silence_floor_db.setter
    def silence_floor_db(self, arg1: typing.Any) -> None: ...
    @property
    def third_window(self) -> int:
        """
        THIRDWINDOW
        """
    @third_window.setter
    def third_window(self, arg1: typing.Any) -> None: ...
    @property
    def use_power(self) -> bool:
        """
        USEPOWER: filters over the power, not the magnitude
        """
    @use_power.setter
    def use_power(self, arg1: typing.Any) -> None: ...
    @property
    def warp(self) -> float:
        """
        WARPFREQ: frequencies are divided by it
        """
    @warp.setter
    def warp(self, arg1: typing.Any) -> None: ...
    @property
    def warp_high_hz(self) -> float:
        """
        WARPUCUTOFF
        """
    @warp_high_hz.setter
    def warp_high_hz(self, arg1: typing.Any) -> None: ...
    @property
    def warp_low_hz(self) -> float:
        """
        WARPLCUTOFF
        """
    @warp_low_hz.setter
    def warp_low_hz(self, arg1: typing.Any) -> None: ...
    @property
    def zero_mean(self) -> bool:
        """
        ZMEANSOURCE: subtract the mean of every frame
        """
    @zero_mean.setter
    def zero_mean(self, arg1: typing.Any) -> None: ...

class HtkParameterFile:
    """
    Frames of an HTK parameter file, in rows.
    """
    @staticmethod
    def frames_beside(kind: str, target: str, options: HtkFeatureOptions = ...) -> int | None:
        """
        How many frames on each side a frame takes to become of the kind `target`; None: all.
        """
    @staticmethod
    def parse(data: bytes, name: str) -> HtkParameterFile:
        """
        The same of bytes; `name` is what errors call them.
        """
    @staticmethod
    def parse_header(data: bytes, name: str) -> tuple[str, int, int, int]:
        """
        (kind, sample_period, num_frames, num_columns) of the first 12 bytes.
        """
    @staticmethod
    def read(path: str | bytes | os.PathLike[str]) -> HtkParameterFile:
        """
        Raises FormatError naming file and byte.
        """
    @staticmethod
    def read_frames(
        path: str | bytes | os.PathLike[str],
        first: typing.SupportsInt | typing.SupportsIndex,
        last: typing.SupportsInt | typing.SupportsIndex,
    ) -> HtkParameterFile:
        """
        Frames first .. last - 1 alone, as `read` has them, in memory for these. A checksum is checked only where these are all. Raises FormatError also where the file has fewer frames, InvalidArgument unless 0 <= first < last.
        """
    @staticmethod
    def read_header(path: str | bytes | os.PathLike[str]) -> tuple[str, int, int, int]:
        """
        The same of a file, of which no more is read; raises FormatError also where the file has another size than the header says.
        """
    @staticmethod
    def verify(path: str | bytes | os.PathLike[str]) -> None:
        """
        Raises FormatError for a header, a size and a checksum that are wrong; takes memory of a fixed size.
        """
    def __init__(
        self,
        values: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        kind: str,
        sample_period: typing.SupportsInt | typing.SupportsIndex = 100000,
    ) -> None: ...
    def convert(self, kind: str, options: HtkFeatureOptions = ...) -> HtkParameterFile:
        """
        As another kind of the same base: differences are added or left out.
        """
    def observations(self, kind: str, options: HtkFeatureOptions = ...) -> numpy.typing.NDArray[numpy.float32]:
        """
        Frames as models of this kind see them, float32, shape (num_frames, num_columns).
        """
    def serialise(self) -> bytes:
        """
        The bytes of the file.
        """
    def write(self, path: str | bytes | os.PathLike[str]) -> None:
        """
        With _C in `kind` compressed, with _K with a checksum.
        """
    @property
    def kind(self) -> str:
        """
        Such as MFCC_E_D.
        """
    @property
    def sample_period(self) -> int:
        """
        From frame to frame, in 100 ns.
        """
    @property
    def values(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, shape (num_frames, num_columns).
        """

class HtkFeatureExtractor:
    """
    Audio to MFCC, FBANK, MELSPEC, LPC or LPCEPSTRA as HTK's.
    """
    def __init__(
        self, kind: str, sample_rate_hz: typing.SupportsInt | typing.SupportsIndex, options: HtkFeatureOptions = ...
    ) -> None: ...
    def compute(
        self, audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        float32, shape (num_frames, num_columns); full scale is -1..1.
        """
    @property
    def num_columns(self) -> int:
        """
        Of a frame.
        """
    @property
    def sample_period(self) -> int:
        """
        From frame to frame, in 100 ns.
        """

class HtkConfiguration:
    """
    What HTK's configuration files set.
    """
    def __init__(self, live: bool = False) -> None:
        """
        With `live` that of live sound, whose settings are refused or set nothing else.
        """
    def parse(self, text: str, name: str) -> None:
        """
        The same of a text; `name` is what errors call it.
        """
    def read(self, path: str | bytes | os.PathLike[str]) -> None:
        """
        Sets what a file sets; raises FormatError naming file and line.
        """
    def written_kind(self, source: str) -> str:
        """
        The kind of files to write, _C and _K included.
        """
    @property
    def features(self) -> HtkFeatureOptions:
        """
        As HtkFeatureOptions.
        """
    @property
    def has_codewords(self) -> bool:
        """
        Whether TARGETKIND has _V.
        """
    @property
    def has_target_rate(self) -> bool:
        """
        Whether TARGETRATE is set.
        """
    @property
    def ignored(self) -> list[str]:
        """
        Keys that set nothing here.
        """
    @property
    def live(self) -> bool:
        """
        Whether it is of live sound.
        """
    @property
    def record_prefix(self) -> str:
        """
        RECOUTPREFIX of live sound.
        """
    @property
    def record_suffix(self) -> str:
        """
        RECOUTSUFFIX of live sound.
        """
    @property
    def save_codewords(self) -> bool:
        """
        SAVEASVQ.
        """
    @property
    def settings(self) -> list[tuple[str, str]]:
        """
        Pairs of a key and a value, as they came.
        """
    @property
    def silence_frames(self) -> int:
        """
        SILSEQCOUNT of live sound: frames that end an utterance; 0: not set.
        """
    @property
    def source_format(self) -> str:
        """
        SOURCEFORMAT: HTK or WAV.
        """
    @property
    def source_rate_hz(self) -> int:
        """
        SOURCERATE of live sound, as a rate; 0: not set.
        """
    @property
    def target(self) -> str:
        """
        TARGETKIND.
        """
    @property
    def vq_table(self) -> str:
        """
        VQTABLE; empty: not set.
        """

class HtkVqTable:
    """
    Codewords that frames become for discrete models.
    """
    @staticmethod
    def parse(text: str, name: str) -> HtkVqTable:
        """
        The same of a text; `name` is what errors call it.
        """
    @staticmethod
    def read(path: str | bytes | os.PathLike[str]) -> HtkVqTable:
        """
        Raises FormatError naming file and line.
        """
    def __init__(
        self,
        codewords: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        kind: str = "ANON",
        deviation: typing.Annotated[numpy.typing.ArrayLike, numpy.float32] | None = None,
    ) -> None:
        """
        `codewords` (num_codewords, num_columns), of frames of this kind; `deviation` (num_columns,): these were divided by it, and distances are by variances. Raises InvalidArgument for more than 4096 codewords, and a deviation that is not above 0.
        """
    def quantise(
        self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.int32]:
        """
        The nearest codeword of every row, from 1, int32, shape (num_frames,).
        """
    def to_text(self) -> str:
        """
        The text of the file.
        """
    def write(self, path: str | bytes | os.PathLike[str]) -> None:
        """
        Writes the file.
        """
    @property
    def dim(self) -> int:
        """
        Columns of a frame.
        """
    @property
    def kind(self) -> str:
        """
        Of the frames; ANON: any.
        """
    @property
    def num_codewords(self) -> int:
        """
        Codewords.
        """

class HtkLabel:
    """
    A name with times in 100 ns and a score, where it has them.
    """
    def __init__(
        self,
        name: str,
        first: typing.SupportsInt | typing.SupportsIndex | None = None,
        last: typing.SupportsInt | typing.SupportsIndex | None = None,
        score: typing.SupportsFloat | typing.SupportsIndex | None = None,
        others: collections.abc.Sequence[tuple[str, typing.SupportsFloat | typing.SupportsIndex | None]] = [],
    ) -> None:
        """
        `others` are further levels of the transcription: names with scores, or None.
        """
    @property
    def first(self) -> int | None:
        """
        Where it begins, in 100 ns.
        """
    @property
    def last(self) -> int | None:
        """
        Where it ends, in 100 ns.
        """
    @property
    def line(self) -> int:
        """
        Of the file that it was read from, from 1; 0: of none.
        """
    @property
    def name(self) -> str:
        """
        What was said.
        """
    @property
    def others(self) -> list[tuple[str, float | None]]:
        """
        Names and scores of further levels.
        """
    @property
    def score(self) -> float | None:
        """
        Its score.
        """

class HtkTranscription:
    """
    The labels of one recording.
    """
    @staticmethod
    def parse(text: str, name: str) -> HtkTranscription:
        """
        The same of a text; `name` is what errors call it.
        """
    @staticmethod
    def read(path: str | bytes | os.PathLike[str]) -> HtkTranscription:
        """
        Reads a label file; raises FormatError naming file and line.
        """
    def __init__(
        self,
        labels: collections.abc.Sequence[HtkLabel],
        others: collections.abc.Sequence[collections.abc.Sequence[HtkLabel]] = [],
    ) -> None: ...
    def to_text(self) -> str:
        """
        The text of a label file.
        """
    def write(self, path: str | bytes | os.PathLike[str]) -> None:
        """
        Writes a label file.
        """
    @property
    def alternatives(self) -> list[list[HtkLabel]]:
        """
        Labels of each.
        """
    @property
    def labels(self) -> list[HtkLabel]:
        """
        Of the first alternative.
        """

class HtkMasterLabelFile:
    """
    Transcriptions by patterns of the names of their label files.
    """
    @staticmethod
    def parse(text: str, name: str) -> HtkMasterLabelFile:
        """
        The same of a text; `name` is what errors call it.
        """
    @staticmethod
    def read(path: str | bytes | os.PathLike[str]) -> HtkMasterLabelFile:
        """
        Raises FormatError naming file and line.
        """
    def __init__(self, entries: collections.abc.Sequence[tuple[str, HtkTranscription]] = []) -> None: ...
    def search(self, name: str) -> list[HtkTranscription | tuple[str, bool]]:
        """
        What the patterns that match the name of a label file stand for, in their order: a transcription, or the folder where it is and whether folders of the name may stand in it (=>).
        """
    def to_text(self) -> str:
        """
        The text of the file.
        """
    def write(self, path: str | bytes | os.PathLike[str]) -> None:
        """
        Writes the file.
        """
    @property
    def entries(self) -> list[tuple[str, HtkTranscription]]:
        """
        Pairs of a pattern and a transcription.
        """
    @property
    def folder_patterns(self) -> list[str]:
        """
        Patterns that stand for a folder.
        """

class HtkModelSet:
    """
    HTK's model definitions: HMMs of Gaussian mixtures.
    """
    def __init__(self, kind: str = "ANON") -> None: ...
    def add(
        self, name: str, model: GaussianMixtureHmm, final_stay: typing.SupportsFloat | typing.SupportsIndex
    ) -> None:
        """
        Adds a left-right HMM, whose last state is left with 1 - final_stay.
        """
    def discrete(self, name: str) -> numpy.typing.NDArray[numpy.float64]:
        """
        Probabilities of a discrete model, float64, shape (num_states, num_codewords).
        """
    def hmm(self, name: str) -> GaussianMixtureHmm:
        """
        Its Gaussians, and its chain without entry and exit.
        """
    def parse(self, text: str, name: str) -> None:
        """
        The same of a text; `name` is what errors call it.
        """
    def read(self, path: str | bytes | os.PathLike[str]) -> None:
        """
        Adds what a file defines; raises FormatError naming file and line.
        """
    def rename_hmm(self, hmm: str, name: str) -> None:
        """
        Renames an HMM.
        """
    def reorder(self, order: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex]) -> None:
        """
        The definitions in another order: the number of each, once.
        """
    def to_text(self) -> str:
        """
        The text of a file.
        """
    def transitions(self, name: str) -> numpy.typing.NDArray[numpy.float64]:
        """
        Its transitions with entry and exit, float64.
        """
    def write(self, path: str | bytes | os.PathLike[str]) -> None:
        """
        Writes a file.
        """
    def write_part(
        self,
        path: str | bytes | os.PathLike[str],
        first: typing.SupportsInt | typing.SupportsIndex,
        last: typing.SupportsInt | typing.SupportsIndex,
    ) -> None:
        """
        Writes the definitions first..last - 1, which may use those before.
        """
    @property
    def definitions(self) -> list[tuple[str, str]]:
        """
        (type, name) of every definition in order; type is one of h s m u v t.
        """
    @property
    def hmm_names(self) -> list[str]:
        """
        Names of the HMMs.
        """
    @property
    def kind(self) -> str:
        """
        Of the frames.
        """
    @property
    def num_codewords(self) -> int:
        """
        Of discrete models, whose frames have one column of them, from 1; 0: the models are of Gaussians.
        """
    @property
    def num_definitions(self) -> int:
        """
        HMMs and macros.
        """
    @property
    def vector_size(self) -> int:
        """
        Columns of a frame; 0: not set.
        """

class HtkPronunciation:
    """
    A word and the models that it is made of.
    """
    def __init__(
        self,
        word: str,
        models: collections.abc.Sequence[str],
        output: str | None = None,
        probability: typing.SupportsFloat | typing.SupportsIndex = 1.0,
    ) -> None: ...
    @property
    def line(self) -> int:
        """
        Of the file that it was read from; 0: of none.
        """
    @property
    def models(self) -> list[str]:
        """
        Names of models.
        """
    @property
    def output(self) -> str:
        """
        What is printed for it; empty: nothing.
        """
    @property
    def probability(self) -> float:
        """
        Among those of the word.
        """
    @property
    def word(self) -> str:
        """
        As networks have it.
        """

class HtkDictionary:
    """
    Pronunciations of words.
    """
    @staticmethod
    def parse(text: str, name: str) -> HtkDictionary:
        """
        The same of a text; `name` is what errors call it.
        """
    @staticmethod
    def read(path: str | bytes | os.PathLike[str]) -> HtkDictionary:
        """
        Raises FormatError naming file and line.
        """
    def __init__(self, entries: collections.abc.Sequence[HtkPronunciation] = []) -> None: ...
    def to_text(self) -> str:
        """
        The text of the file.
        """
    def write(self, path: str | bytes | os.PathLike[str]) -> None:
        """
        Writes the file.
        """
    @property
    def entries(self) -> list[HtkPronunciation]:
        """
        In the order of the file.
        """

class HtkWordLattice:
    """
    A word network: words on nodes, weights on arcs.
    """
    @staticmethod
    def of_bigram(
        language: NGramModel, words: collections.abc.Sequence[str], start: str = "<s>", end: str = "</s>"
    ) -> HtkWordLattice:
        """
        Words in any order, weighted by an NGramModel of order 1 or 2.
        """
    @staticmethod
    def of_grammar(text: str, name: str) -> HtkWordLattice:
        """
        The network of a grammar in HParse's form.
        """
    @staticmethod
    def of_lattice(
        lattice: Lattice,
        labels: collections.abc.Sequence[str],
        first_s: typing.SupportsFloat | typing.SupportsIndex,
        frame_s: typing.SupportsFloat | typing.SupportsIndex,
        language_scale: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        insertion_penalty: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> HtkWordLattice:
        """
        A hri.language.Lattice as a file: labels of its models, frame n at first_s + n frame_s. Scale and penalty that its weights hold are taken out.
        """
    @staticmethod
    def of_words(words: collections.abc.Sequence[str]) -> HtkWordLattice:
        """
        The one sentence, for forced alignment.
        """
    @staticmethod
    def parse(text: str, name: str) -> HtkWordLattice:
        """
        The same of a text; `name` is what errors call it.
        """
    @staticmethod
    def read(path: str | bytes | os.PathLike[str]) -> HtkWordLattice:
        """
        Reads a file in standard lattice format; raises FormatError naming file and line.
        """
    @staticmethod
    def read_grammar(path: str | bytes | os.PathLike[str]) -> HtkWordLattice:
        """
        The same of a file.
        """
    def __init__(
        self,
        words: collections.abc.Sequence[str],
        arcs: collections.abc.Sequence[
            tuple[
                typing.SupportsInt | typing.SupportsIndex,
                typing.SupportsInt | typing.SupportsIndex,
                typing.SupportsFloat | typing.SupportsIndex,
            ]
        ],
    ) -> None:
        """
        An arc is (from, to, log weight).
        """
    def to_lattice(
        self,
        labels: collections.abc.Sequence[str],
        silences: collections.abc.Sequence[str] = [],
        first_s: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        frame_s: typing.SupportsFloat | typing.SupportsIndex = 0.01,
    ) -> Lattice:
        """
        The same back, weighed again; words of `silences` are silence. Raises InvalidArgument for a file without times.
        """
    def to_text(self) -> str:
        """
        The text of the file.
        """
    def write(self, path: str | bytes | os.PathLike[str]) -> None:
        """
        Writes the file.
        """
    @property
    def arcs(self) -> list[tuple[int, int, float]]:
        """
        (from, to, log weight).
        """
    @property
    def first(self) -> int:
        """
        The node that begins sentences.
        """
    @property
    def insertion_penalty(self) -> float:
        """
        That every word had in recognition.
        """
    @property
    def language_scale(self) -> float:
        """
        That weights had in recognition.
        """
    @property
    def last(self) -> int:
        """
        The node that ends them.
        """
    @property
    def lines(self) -> list[int]:
        """
        Of the file that the nodes were read from; empty: of none.
        """
    @property
    def times_s(self) -> list[float]:
        """
        Where the words of the nodes end, or empty.
        """
    @property
    def variants(self) -> list[int]:
        """
        Pronunciation of every node, from 1, 0: any; or empty.
        """
    @property
    def words(self) -> list[str]:
        """
        Of the nodes; !NULL: none.
        """

class HtkRecognisedWord:
    """
    A word of a recognised sentence.
    """
    @property
    def first_frame(self) -> int:
        """
        First frame.
        """
    @property
    def last_frame(self) -> int:
        """
        One past the last frame.
        """
    @property
    def log_score(self) -> float:
        """
        What it adds to the sentence's.
        """
    @property
    def output(self) -> str:
        """
        What is printed for it; empty: nothing.
        """
    @property
    def pronunciation(self) -> int:
        """
        Its entry in the dictionary.
        """
    @property
    def word(self) -> str:
        """
        As the network has it.
        """

class HtkAlignedState:
    """
    A state on the best path through a model.
    """
    @property
    def first_frame(self) -> int:
        """
        First frame.
        """
    @property
    def last_frame(self) -> int:
        """
        One past the last frame.
        """
    @property
    def log_score(self) -> float:
        """
        Of its frames, and of the steps into it and on from it.
        """
    @property
    def state(self) -> int:
        """
        As HTK counts: the entry is 1.
        """

class HtkAlignedModel:
    """
    A model of a recognised word.
    """
    @property
    def first_frame(self) -> int:
        """
        First frame.
        """
    @property
    def last_frame(self) -> int:
        """
        One past the last frame; the first where it was passed without a frame.
        """
    @property
    def log_score(self) -> float:
        """
        Of its frames and steps.
        """
    @property
    def model(self) -> str:
        """
        Its name.
        """
    @property
    def states(self) -> list[HtkAlignedState]:
        """
        In the order of time.
        """

class HtkRecognisedSentence:
    """
    What a recogniser found.
    """
    @property
    def complete(self) -> bool:
        """
        Whether it is a whole sentence.
        """
    @property
    def log_score(self) -> float:
        """
        Of the best path.
        """
    @property
    def words(self) -> list[HtkRecognisedWord]:
        """
        In the order of time.
        """

class HtkRecognizer:
    """
    HVite: models, dictionary and network of words.
    """
    def __init__(
        self,
        models: HtkModelSet,
        dictionary: HtkDictionary,
        lattice: HtkWordLattice,
        options: ConnectedDecoderOptions = ...,
    ) -> None: ...
    def align(
        self, observations: typing.Annotated[numpy.typing.ArrayLike, numpy.float32], sentence: HtkRecognisedSentence
    ) -> list[list[HtkAlignedModel]]:
        """
        Models and states of every word of a sentence of these frames.
        """
    def lattice(
        self, observations: typing.Annotated[numpy.typing.ArrayLike, numpy.float32], options: LatticeOptions = ...
    ) -> Lattice:
        """
        All sentences near the best; model i is the pronunciation of words[i].
        """
    def n_best(self, lattice: Lattice, count: typing.SupportsInt | typing.SupportsIndex) -> list[HtkRecognisedSentence]:
        """
        At most `count` (1..1000) sentences of a lattice of this recogniser that differ in their words, the best first.
        """
    def recognise(self, observations: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> HtkRecognisedSentence:
        """
        The best sentence of frames, shape (num_frames, num_columns).
        """
    @property
    def options(self) -> ConnectedDecoderOptions:
        """
        Those that it was made with.
        """
    @property
    def words(self) -> list[str]:
        """
        Of every pronunciation.
        """

class HtkFlatStart:
    """
    HCompV: models at the mean and variance of all frames.
    """
    def __init__(self) -> None: ...
    def add(self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> None:
        """
        Adds frames, shape (num_frames, num_columns).
        """
    def apply(
        self, models: HtkModelSet, update_means: bool, min_variance: typing.SupportsFloat | typing.SupportsIndex = 0.0
    ) -> HtkModelSet:
        """
        The models with the variance in every Gaussian, and with update_means the mean.
        """
    def variance_floors(self, share: typing.SupportsFloat | typing.SupportsIndex) -> HtkModelSet:
        """
        The macro varFloor1, of this share of the variance.
        """
    @property
    def mean(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Of all frames, float64.
        """
    @property
    def num_frames(self) -> int:
        """
        Frames added.
        """
    @property
    def variance(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Of all frames, divided by their number, float64.
        """

class ViterbiTrainerOptions:
    """
    Options of training by best paths.

    Parameters
    ----------
    max_iterations : int, default 20
        passes after that over equal parts, at most; 0..100000
    tolerance : float, default 0.0001
        training stops when the log probability of a recording grows by less (natural log); 0..1000000
    weight_floor : float, default 0.0
        smallest mixture weight, in units of 1e-5; 0..100000
    min_variance : float, default 0.01
        smallest variance; ~v "varFloor1" of the models holds beside it; 0..1e+12
    uniform_start : bool, default True
        False: the model is good enough to begin with the best paths
    update_transitions : bool, default True
        False: transitions stay
    update_means : bool, default True
        False: means stay
    update_variances : bool, default True
        False: variances stay
    update_weights : bool, default True
        False: mixture weights stay
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        max_iterations: int = 20,
        tolerance: float = 0.0001,
        weight_floor: float = 0.0,
        min_variance: float = 0.01,
        uniform_start: bool = True,
        update_transitions: bool = True,
        update_means: bool = True,
        update_variances: bool = True,
        update_weights: bool = True,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def max_iterations(self) -> int:
        """
        passes after that over equal parts, at most
        """
    @max_iterations.setter
    def max_iterations(self, arg1: typing.Any) -> None: ...
    @property
    def min_variance(self) -> float:
        """
        smallest variance; ~v "varFloor1" of the models holds beside it
        """
    @min_variance.setter
    def min_variance(self, arg1: typing.Any) -> None: ...
    @property
    def tolerance(self) -> float:
        """
        training stops when the log probability of a recording grows by less (natural log)
        """
    @tolerance.setter
    def tolerance(self, arg1: typing.Any) -> None: ...
    @property
    def uniform_start(self) -> bool:
        """
        False: the model is good enough to begin with the best paths
        """
    @uniform_start.setter
    def uniform_start(self, arg1: typing.Any) -> None: ...
    @property
    def update_means(self) -> bool:
        """
        False: means stay
        """
    @update_means.setter
    def update_means(self, arg1: typing.Any) -> None: ...
    @property
    def update_transitions(self) -> bool:
        """
        False: transitions stay
        """
    @update_transitions.setter
    def update_transitions(self, arg1: typing.Any) -> None: ...
    @property
    def update_variances(self) -> bool:
        """
        False: variances stay
        """
    @update_variances.setter
    def update_variances(self, arg1: typing.Any) -> None: ...
    @property
    def update_weights(self) -> bool:
        """
        False: mixture weights stay
        """
    @update_weights.setter
    def update_weights(self, arg1: typing.Any) -> None: ...
    @property
    def weight_floor(self) -> float:
        """
        smallest mixture weight, in units of 1e-5
        """
    @weight_floor.setter
    def weight_floor(self, arg1: typing.Any) -> None: ...

class HtkViterbiTraining:
    """
    What training by best paths gave.
    """
    @property
    def converged(self) -> bool:
        """
        Or the passes were at their end.
        """
    @property
    def log_probabilities(self) -> list[float]:
        """
        Of the best paths before each pass, all recordings together; natural log.
        """
    @property
    def models(self) -> HtkModelSet:
        """
        All of the set.
        """

class EmbeddedTrainerOptions:
    """
    Options of embedded Baum-Welch.

    Parameters
    ----------
    beam : float, default 0.0
        states whose backward score falls this much below the best of a frame (natural log) are dropped; 0: none is; 0..1e+12
    beam_step : float, default 0.0
        added to the beam when nothing of an utterance is left; 0: it is left out; 0..1e+12
    beam_limit : float, default 0.0
        beam up to which the step is added; 0..1e+12
    min_examples : int, default 3
        models that occur less often in the transcripts stay as they are; 0..1e+09
    weight_floor : float, default 0.0
        smallest mixture weight, in units of 1e-5; 0..100000
    min_variance : float, default 0.0
        smallest variance; ~v "varFloor1" of the models holds beside it; 0..1e+12
    update_transitions : bool, default True
        False: transitions stay
    update_means : bool, default True
        False: means stay
    update_variances : bool, default True
        False: variances stay
    update_weights : bool, default True
        False: mixture weights stay
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        beam: float = 0.0,
        beam_step: float = 0.0,
        beam_limit: float = 0.0,
        min_examples: int = 3,
        weight_floor: float = 0.0,
        min_variance: float = 0.0,
        update_transitions: bool = True,
        update_means: bool = True,
        update_variances: bool = True,
        update_weights: bool = True,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def beam(self) -> float:
        """
        states whose backward score falls this much below the best of a frame (natural log) are dropped; 0: none is
        """
    @beam.setter
    def beam(self, arg1: typing.Any) -> None: ...
    @property
    def beam_limit(self) -> float:
        """
        beam up to which the step is added
        """
    @beam_limit.setter
    def beam_limit(self, arg1: typing.Any) -> None: ...
    @property
    def beam_step(self) -> float:
        """
        added to the beam when nothing of an utterance is left; 0: it is left out
        """
    @beam_step.setter
    def beam_step(self, arg1: typing.Any) -> None: ...
    @property
    def min_examples(self) -> int:
        """
        models that occur less often in the transcripts stay as they are
        """
    @min_examples.setter
    def min_examples(self, arg1: typing.Any) -> None: ...
    @property
    def min_variance(self) -> float:
        """
        smallest variance; ~v "varFloor1" of the models holds beside it
        """
    @min_variance.setter
    def min_variance(self, arg1: typing.Any) -> None: ...
    @property
    def update_means(self) -> bool:
        """
        False: means stay
        """
    @update_means.setter
    def update_means(self, arg1: typing.Any) -> None: ...
    @property
    def update_transitions(self) -> bool:
        """
        False: transitions stay
        """
    @update_transitions.setter
    def update_transitions(self, arg1: typing.Any) -> None: ...
    @property
    def update_variances(self) -> bool:
        """
        False: variances stay
        """
    @update_variances.setter
    def update_variances(self, arg1: typing.Any) -> None: ...
    @property
    def update_weights(self) -> bool:
        """
        False: mixture weights stay
        """
    @update_weights.setter
    def update_weights(self, arg1: typing.Any) -> None: ...
    @property
    def weight_floor(self) -> float:
        """
        smallest mixture weight, in units of 1e-5
        """
    @weight_floor.setter
    def weight_floor(self, arg1: typing.Any) -> None: ...

class HtkModelOccupation:
    """
    How often a model was met in training.
    """
    @property
    def name(self) -> str:
        """
        Of the model.
        """
    @property
    def num_examples(self) -> int:
        """
        In the transcripts.
        """
    @property
    def states(self) -> list[float]:
        """
        Expected frames of its states.
        """

class HtkEmbeddedTrainer:
    """
    HERest: one pass of Baum-Welch from transcripts without times.
    """
    def __init__(self, models: HtkModelSet, options: EmbeddedTrainerOptions = ...) -> None: ...
    def add(
        self, frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32], units: collections.abc.Sequence[str]
    ) -> str:
        """
        Adds an utterance, shape (num_frames, num_columns), by the names of its models; gives 'added', 'too_short' or 'impossible'.
        """
    def add_sums(self, path: str | bytes | os.PathLike[str]) -> None:
        """
        As if the utterances that a file of write_sums() sums up were added here; raises FormatError for sums of other models.
        """
    def estimate(self) -> HtkModelSet:
        """
        The models that the utterances added make most likely.
        """
    def occupations(self) -> list[HtkModelOccupation]:
        """
        Of every model, in the order of the set.
        """
    def write_sums(self, path: str | bytes | os.PathLike[str]) -> None:
        """
        Writes the sums over the utterances added, for add_sums().
        """
    @property
    def log_likelihood(self) -> float:
        """
        Of the utterances added, before estimation; natural log.
        """
    @property
    def num_frames(self) -> int:
        """
        Frames added.
        """

class HtkEditScript:
    """
    HHEd: commands that change the structure of models.
    """
    @staticmethod
    def parse(text: str, name: str) -> HtkEditScript:
        """
        The same of a text; `name` is what errors call it.
        """
    @staticmethod
    def read(path: str | bytes | os.PathLike[str]) -> HtkEditScript:
        """
        Raises FormatError naming file and line.
        """
    def apply(self, models: HtkModelSet) -> HtkModelSet:
        """
        The models after all commands; raises FormatError for items that no model has.
        """
    def apply_with_files(self, models: HtkModelSet) -> tuple[HtkModelSet, list[tuple[str, str]]]:
        """
        The same, and (path, text) of the files that CO and ST want written, which are not.
        """
    @property
    def num_commands(self) -> int:
        """
        Commands.
        """

class SubwordRecognizerOptions:
    """
    Options of SubwordRecognizer.

    Parameters
    ----------
    words : WordRecognizerOptions or dict
        front end and warped copies as of isolated words; models and rejection are not used
    num_states : int, default 2
        left-right states of a unit, and of silence; 1..10
    num_mixtures : int, default 1
        Gaussians of a state; 1..64
    num_passes : int, default 4
        passes of embedded Baum-Welch with every number of Gaussians, which doubles from 1; 1..100
    variance_floor : float, default 1.0
        share of the variance of all frames; wide Gaussians leave room for neighbours that a unit had not in training; 0..1, 0 excluded
    num_folds : int, default 4
        groups of speakers that are held out for confidences and rejection at most; 0, 1: none, and no word is rejected; 0..10
    false_reject_rate : float, default 0.05
        share of correct held-out words that the threshold may reject; 0..0.5
    num_word_folds : int, default 5
        groups of words that are left out, with speakers, to choose unrecorded_bonus; 0, 1: it is not chosen; 0..20
    unrecorded_bonus : float, default 0.0
        added to the score of words added without recordings, as units fit the words better that they were trained on; 0..1000
    prior_frames : float, default 3.0
        recordings of an added word move the means of its units from their own, which weigh as much as so many frames; 0..1000000, 0 excluded
    num_adaptations : int, default 3
        passes in which they do; 1..100
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        words: WordRecognizerOptions | collections.abc.Mapping[str, typing.Any] = ...,
        num_states: int = 2,
        num_mixtures: int = 1,
        num_passes: int = 4,
        variance_floor: float = 1.0,
        num_folds: int = 4,
        false_reject_rate: float = 0.05,
        num_word_folds: int = 5,
        unrecorded_bonus: float = 0.0,
        prior_frames: float = 3.0,
        num_adaptations: int = 3,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def false_reject_rate(self) -> float:
        """
        share of correct held-out words that the threshold may reject
        """
    @false_reject_rate.setter
    def false_reject_rate(self, arg1: typing.Any) -> None: ...
    @property
    def num_adaptations(self) -> int:
        """
        passes in which they do
        """
    @num_adaptations.setter
    def num_adaptations(self, arg1: typing.Any) -> None: ...
    @property
    def num_folds(self) -> int:
        """
        groups of speakers that are held out for confidences and rejection at most; 0, 1: none, and no word is rejected
        """
    @num_folds.setter
    def num_folds(self, arg1: typing.Any) -> None: ...
    @property
    def num_mixtures(self) -> int:
        """
        Gaussians of a state
        """
    @num_mixtures.setter
    def num_mixtures(self, arg1: typing.Any) -> None: ...
    @property
    def num_passes(self) -> int:
        """
        passes of embedded Baum-Welch with every number of Gaussians, which doubles from 1
        """
    @num_passes.setter
    def num_passes(self, arg1: typing.Any) -> None: ...
    @property
    def num_states(self) -> int:
        """
        left-right states of a unit, and of silence
        """
    @num_states.setter
    def num_states(self, arg1: typing.Any) -> None: ...
    @property
    def num_word_folds(self) -> int:
        """
        groups of words that are left out, with speakers, to choose unrecorded_bonus; 0, 1: it is not chosen
        """
    @num_word_folds.setter
    def num_word_folds(self, arg1: typing.Any) -> None: ...
    @property
    def prior_frames(self) -> float:
        """
        recordings of an added word move the means of its units from their own, which weigh as much as so many frames
        """
    @prior_frames.setter
    def prior_frames(self, arg1: typing.Any) -> None: ...
    @property
    def unrecorded_bonus(self) -> float:
        """
        added to the score of words added without recordings, as units fit the words better that they were trained on
        """
    @unrecorded_bonus.setter
    def unrecorded_bonus(self, arg1: typing.Any) -> None: ...
    @property
    def variance_floor(self) -> float:
        """
        share of the variance of all frames; wide Gaussians leave room for neighbours that a unit had not in training
        """
    @variance_floor.setter
    def variance_floor(self, arg1: typing.Any) -> None: ...
    @property
    def words(self) -> WordRecognizerOptions:
        """
        front end and warped copies as of isolated words; models and rejection are not used
        """
    @words.setter
    def words(self, arg1: typing.Any) -> None: ...

class SubwordRecognizer:
    """
    Words of sub-word units; hri.SubwordRecognizer wraps it.
    """
    @staticmethod
    def from_model_file(file: ModelFile) -> SubwordRecognizer: ...
    @staticmethod
    def load(path: str | bytes | os.PathLike[str]) -> SubwordRecognizer: ...
    @staticmethod
    def train(
        samples: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]],
        sample_rates_hz: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
        labels: collections.abc.Sequence[str],
        groups: collections.abc.Sequence[str],
        lexicon: HtkDictionary,
        options: SubwordRecognizerOptions,
        progress: collections.abc.Callable[[int, int], None] | None = None,
    ) -> SubwordRecognizer: ...
    def recognise(
        self,
        audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
    ) -> Decision: ...
    def save(self, path: str | bytes | os.PathLike[str]) -> None: ...
    def scores(
        self,
        audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
    ) -> numpy.typing.NDArray[numpy.float32]: ...
    def to_model_file(self) -> ModelFile: ...
    def with_word(
        self,
        label: str,
        pronunciations: collections.abc.Sequence[collections.abc.Sequence[str]],
        samples: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]],
        sample_rates_hz: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
    ) -> SubwordRecognizer: ...
    def without_word(self, label: str) -> SubwordRecognizer: ...
    @property
    def is_calibrated(self) -> bool:
        """
        Whether anything was held out to calibrate on; else nothing is rejected.
        """
    @property
    def labels(self) -> list[str]: ...
    @property
    def lexicon(self) -> HtkDictionary: ...
    @property
    def options(self) -> SubwordRecognizerOptions:
        """
        As trained, with what training chose.
        """
    @property
    def threshold(self) -> float:
        """
        Decision.score from which a word is recognised.
        """
    @property
    def units(self) -> list[str]: ...

class SentenceRecognizerOptions:
    """
    Options of SentenceRecognizer.

    Parameters
    ----------
    input : {'tracks', 'rows'}, default 'tracks'
        what sentences are given as
    features : TwoHandFeatureOptions or dict
        what is computed of the tracks; of rows, only deltas are appended
    model : {'hmm', 'ptbhmm'}, default 'hmm'
        kind of the models; ptbhmm: the same densities as possibilities over codewords
    num_codewords : int, default 64
        codewords of every column of the features (ptbhmm); 2..4096
    frames_per_state : int, default 3
        a word has a state for so many frames of its mean length; 0: 2, 3 or 4, chosen on sentences held out; 0..100
    max_states : int, default 8
        left-right states of a word, at most; 1..64
    max_iterations : int, default 8
        iterations of Viterbi training at most; 1..100000
    margin_frames : int, default 1
        frames before and behind its span that count as a word's; 0..100
    max_variant_frames : int, default 1200
        frames, of all together at most, of those recordings of a word that have a model of their own, of a state a frame; 0: one model a word; 0..1000000
    variant_weight : float, default 0.6
        where the mean of such a state lies: 0 at that of the word's state, 1 at the frame; 0..1
    variant_variance : float, default 0.7
        factor on the variances of the word's states in its variants; 0.001..1000
    between_states : int, default 2
        ergodic states of what lies between words: rest and movement; 1..16
    between_mixtures : int, default 2
        Gaussians of each of them; 1..64
    language_order : int, default 2
        words of an n-gram of the sentences trained on; 0: any word may follow any; 0..2
    choose_weights : bool, default True
        decoder.insertion_penalty, decoder.language_scale and known_language_scale are chosen on sentences held out
    known_language_scale : float, default 1.0
        factor on the log probabilities of words whose frames are known; 0..1000000
    decoder : ConnectedDecoderOptions or dict
        how sentences are searched
    seed : int, default 0
        of the start of training by k-means; 0..2^64 - 1
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        input: typing.Literal["tracks", "rows"] = "tracks",
        features: TwoHandFeatureOptions | collections.abc.Mapping[str, typing.Any] = ...,
        model: typing.Literal["hmm", "ptbhmm"] = "hmm",
        num_codewords: int = 64,
        frames_per_state: int = 3,
        max_states: int = 8,
        max_iterations: int = 8,
        margin_frames: int = 1,
        max_variant_frames: int = 1200,
        variant_weight: float = 0.6,
        variant_variance: float = 0.7,
        between_states: int = 2,
        between_mixtures: int = 2,
        language_order: int = 2,
        choose_weights: bool = True,
        known_language_scale: float = 1.0,
        decoder: ConnectedDecoderOptions | collections.abc.Mapping[str, typing.Any] = ...,
        seed: int = 0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def between_mixtures(self) -> int:
        """
        Gaussians of each of them
        """
    @between_mixtures.setter
    def between_mixtures(self, arg1: typing.Any) -> None: ...
    @property
    def between_states(self) -> int:
        """
        ergodic states of what lies between words: rest and movement
        """
    @between_states.setter
    def between_states(self, arg1: typing.Any) -> None: ...
    @property
    def choose_weights(self) -> bool:
        """
        decoder.insertion_penalty, decoder.language_scale and known_language_scale are chosen on sentences held out
        """
    @choose_weights.setter
    def choose_weights(self, arg1: typing.Any) -> None: ...
    @property
    def decoder(self) -> ConnectedDecoderOptions:
        """
        how sentences are searched
        """
    @decoder.setter
    def decoder(self, arg1: typing.Any) -> None: ...
    @property
    def features(self) -> TwoHandFeatureOptions:
        """
        what is computed of the tracks; of rows, only deltas are appended
        """
    @features.setter
    def features(self, arg1: typing.Any) -> None: ...
    @property
    def frames_per_state(self) -> int:
        """
        a word has a state for so many frames of its mean length; 0: 2, 3 or 4, chosen on sentences held out
        """
    @frames_per_state.setter
    def frames_per_state(self, arg1: typing.Any) -> None: ...
    @property
    def input(self) -> typing.Literal["tracks", "rows"]:
        """
        what sentences are given as
        """
    @input.setter
    def input(self, arg1: typing.Any) -> None: ...
    @property
    def known_language_scale(self) -> float:
        """
        factor on the log probabilities of words whose frames are known
        """
    @known_language_scale.setter
    def known_language_scale(self, arg1: typing.Any) -> None: ...
    @property
    def language_order(self) -> int:
        """
        words of an n-gram of the sentences trained on; 0: any word may follow any
        """
    @language_order.setter
    def language_order(self, arg1: typing.Any) -> None: ...
    @property
    def margin_frames(self) -> int:
        """
        frames before and behind its span that count as a word's
        """
    @margin_frames.setter
    def margin_frames(self, arg1: typing.Any) -> None: ...
    @property
    def max_iterations(self) -> int:
        """
        iterations of Viterbi training at most
        """
    @max_iterations.setter
    def max_iterations(self, arg1: typing.Any) -> None: ...
    @property
    def max_states(self) -> int:
        """
        left-right states of a word, at most
        """
    @max_states.setter
    def max_states(self, arg1: typing.Any) -> None: ...
    @property
    def max_variant_frames(self) -> int:
        """
        frames, of all together at most, of those recordings of a word that have a model of their own, of a state a frame; 0: one model a word
        """
    @max_variant_frames.setter
    def max_variant_frames(self, arg1: typing.Any) -> None: ...
    @property
    def model(self) -> typing.Literal["hmm", "ptbhmm"]:
        """
        kind of the models; ptbhmm: the same densities as possibilities over codewords
        """
    @model.setter
    def model(self, arg1: typing.Any) -> None: ...
    @property
    def num_codewords(self) -> int:
        """
        codewords of every column of the features (ptbhmm)
        """
    @num_codewords.setter
    def num_codewords(self, arg1: typing.Any) -> None: ...
    @property
    def seed(self) -> int:
        """
        of the start of training by k-means
        """
    @seed.setter
    def seed(self, arg1: typing.Any) -> None: ...
    @property
    def variant_variance(self) -> float:
        """
        factor on the variances of the word's states in its variants
        """
    @variant_variance.setter
    def variant_variance(self, arg1: typing.Any) -> None: ...
    @property
    def variant_weight(self) -> float:
        """
        where the mean of such a state lies: 0 at that of the word's state, 1 at the frame
        """
    @variant_weight.setter
    def variant_weight(self, arg1: typing.Any) -> None: ...

class RecognisedSign:
    """
    One word of a signed sentence.
    """
    @property
    def first_frame(self) -> int:
        """
        Its first frame.
        """
    @property
    def label(self) -> str:
        """
        A word of the vocabulary.
        """
    @property
    def last_frame(self) -> int:
        """
        One past its last frame.
        """
    @property
    def log_score(self) -> float:
        """
        What it adds to the sentence's.
        """

class RecognisedSentence:
    """
    The words of a signed sentence.
    """
    @property
    def log_score(self) -> float:
        """
        Of the best path.
        """
    @property
    def words(self) -> list[RecognisedSign]:
        """
        In the order of time.
        """

class SentenceRecognizer:
    """
    Sentences of signs; hri.SentenceRecognizer wraps it.
    """
    @staticmethod
    def from_model_file(file: ModelFile) -> SentenceRecognizer: ...
    @staticmethod
    def load(path: str | bytes | os.PathLike[str]) -> SentenceRecognizer: ...
    @staticmethod
    def train(
        tracks: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]],
        words: collections.abc.Sequence[
            collections.abc.Sequence[
                tuple[str, typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex]
            ]
        ],
        scales_px: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex],
        groups: collections.abc.Sequence[str],
        options: SentenceRecognizerOptions,
        progress: collections.abc.Callable[[int, int], None] | None = None,
    ) -> SentenceRecognizer: ...
    def recognise(
        self,
        tracks: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        scale_px: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> RecognisedSentence: ...
    def recognise_n_best(
        self,
        tracks: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        count: typing.SupportsInt | typing.SupportsIndex,
        scale_px: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> list[RecognisedSentence]: ...
    def recognise_spans(
        self,
        tracks: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        spans: collections.abc.Sequence[
            tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex]
        ],
        scale_px: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        with_language: bool = True,
    ) -> RecognisedSentence: ...
    def save(self, path: str | bytes | os.PathLike[str]) -> None: ...
    def score_spans(
        self,
        tracks: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        spans: collections.abc.Sequence[
            tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex]
        ],
        scale_px: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        Log scores (num_spans, num_labels) of every label in every span.
        """
    def to_model_file(self) -> ModelFile: ...
    def with_decoder(self, decoder: ConnectedDecoderOptions) -> SentenceRecognizer: ...
    def with_known_language_scale(self, scale: typing.SupportsFloat | typing.SupportsIndex) -> SentenceRecognizer: ...
    @property
    def labels(self) -> list[str]: ...
    @property
    def options(self) -> SentenceRecognizerOptions:
        """
        As trained, with what training chose.
        """

class SentenceStreamOptions:
    """
    When signed sentences begin and end.

    Parameters
    ----------
    appear_s : float, default 0.1
        a sentence has begun when the hands have moved for so long; 0..1000000, 0 excluded s
    rest_s : float, default 1.0
        hands that are still for so long end it; 0..1000000, 0 excluded s
    leave_s : float, default 1.5
        and so do hands that were not seen for so long; 0..1000000, 0 excluded s
    still_change : float, default 0.25
        hands are still while they have moved by less since compare_s ago, as a share of how much they move in the signs trained on; 0..1000000, 0 excluded
    compare_s : float, default 0.2
        time between the frames that are compared; 0..1000000, 0 excluded s
    context_s : float, default 0.5
        of the rest before and behind it is part of it; 0..10 s
    max_sentence_s : float, default 30.0
        a longer sentence is cut, and one of more than 8192 frames; 0.5..300 s
    partial_s : float, default 0.3
        a sentence is searched again when it has grown by this; 0..1000000, 0 excluded, or infinite s
    partial_share : float, default 0.02
        and by this share of its length, so that long ones do not cost more and more; 0..10
    num_agreeing : int, default 2
        searches in a row that find a word which has ended, until it is stable; 1..100
    scale_px : float, default 0.0
        of the signer, as SentenceRecognizer takes it; 0: of each sentence; 0..1000000 px
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def fields() -> list[OptionField]:
        """
        What each field is, in their order.
        """
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> dict: ...
    def __init__(
        self,
        *,
        appear_s: float = 0.1,
        rest_s: float = 1.0,
        leave_s: float = 1.5,
        still_change: float = 0.25,
        compare_s: float = 0.2,
        context_s: float = 0.5,
        max_sentence_s: float = 30.0,
        partial_s: float = 0.3,
        partial_share: float = 0.02,
        num_agreeing: int = 2,
        scale_px: float = 0.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: dict) -> None: ...
    def as_dict(self) -> dict:
        """
        All fields as plain values, those of nested structs as dicts.
        """
    @property
    def appear_s(self) -> float:
        """
        a sentence has begun when the hands have moved for so long
        """
    @appear_s.setter
    def appear_s(self, arg1: typing.Any) -> None: ...
    @property
    def compare_s(self) -> float:
        """
        time between the frames that are compared
        """
    @compare_s.setter
    def compare_s(self, arg1: typing.Any) -> None: ...
    @property
    def context_s(self) -> float:
        """
        of the rest before and behind it is part of it
        """
    @context_s.setter
    def context_s(self, arg1: typing.Any) -> None: ...
    @property
    def leave_s(self) -> float:
        """
        and so do hands that were not seen for so long
        """
    @leave_s.setter
    def leave_s(self, arg1: typing.Any) -> None: ...
    @property
    def max_sentence_s(self) -> float:
        """
        a longer sentence is cut, and one of more than 8192 frames
        """
    @max_sentence_s.setter
    def max_sentence_s(self, arg1: typing.Any) -> None: ...
    @property
    def num_agreeing(self) -> int:
        """
        searches in a row that find a word which has ended, until it is stable
        """
    @num_agreeing.setter
    def num_agreeing(self, arg1: typing.Any) -> None: ...
    @property
    def partial_s(self) -> float:
        """
        a sentence is searched again when it has grown by this
        """
    @partial_s.setter
    def partial_s(self, arg1: typing.Any) -> None: ...
    @property
    def partial_share(self) -> float:
        """
        and by this share of its length, so that long ones do not cost more and more
        """
    @partial_share.setter
    def partial_share(self, arg1: typing.Any) -> None: ...
    @property
    def rest_s(self) -> float:
        """
        hands that are still for so long end it
        """
    @rest_s.setter
    def rest_s(self, arg1: typing.Any) -> None: ...
    @property
    def scale_px(self) -> float:
        """
        of the signer, as SentenceRecognizer takes it; 0: of each sentence
        """
    @scale_px.setter
    def scale_px(self, arg1: typing.Any) -> None: ...
    @property
    def still_change(self) -> float:
        """
        hands are still while they have moved by less since compare_s ago, as a share of how much they move in the signs trained on
        """
    @still_change.setter
    def still_change(self, arg1: typing.Any) -> None: ...

class StreamedSign(RecognisedSign):
    """
    One word of a sentence in a stream.
    """
    @property
    def first_s(self) -> float:
        """
        Time of its first frame.
        """
    @property
    def last_s(self) -> float:
        """
        Time of its last frame.
        """

class SentenceEvent:
    """
    What happened with a frame.
    """
    @property
    def first_s(self) -> float:
        """
        Its beginning.
        """
    @property
    def kind(self) -> typing.Literal["none", "start", "partial", "end", "dropped"]:
        """
        'none', 'start', 'partial', 'end' or 'dropped'.
        """
    @property
    def last_s(self) -> float:
        """
        Its end, so far.
        """
    @property
    def log_score(self) -> float:
        """
        Of the best path.
        """
    @property
    def num_stable(self) -> int:
        """
        So many of the first words are kept until the sentence ends.
        """
    @property
    def reason(self) -> typing.Literal["none", "rested", "left", "cut", "ended", "stalled"]:
        """
        Why it ended: 'rested', 'left', 'cut', 'ended' or 'stalled'.
        """
    @property
    def words(self) -> list[StreamedSign]:
        """
        In the order of time.
        """

class SentenceStream:
    """
    A stream; hri.recognition.SentenceStream wraps it.
    """
    def __init__(self, recognizer: SentenceRecognizer, options: SentenceStreamOptions) -> None: ...
    def finish(self) -> SentenceEvent: ...
    def interrupt(self) -> SentenceEvent: ...
    def push(
        self,
        row: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
        time_s: typing.SupportsFloat | typing.SupportsIndex,
    ) -> SentenceEvent: ...
    @property
    def change(self) -> float:
        """
        Movement in units of still_change.
        """
    @property
    def in_sentence(self) -> bool:
        """
        One has begun and not ended.
        """
    @property
    def num_columns(self) -> int:
        """
        Of a frame.
        """
    @property
    def num_kept(self) -> int:
        """
        Frames in memory.
        """

def activity_frames(
    audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
    options: ActivityOptions = ...,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    What end points are found from, a row a frame: level (dB), voicing (0..1), then the level of each band (dB).
    """

@typing.overload
def approximate(
    x: numpy.typing.NDArray[numpy.float32],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
    num_levels: typing.SupportsInt | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    The approximation of a level, as loud as the signal.
    """

@typing.overload
def approximate(
    x: numpy.typing.NDArray[numpy.float64],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
    num_levels: typing.SupportsInt | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float64]:
    """
    The approximation of a level, as loud as the signal.
    """

def b_spline_wavelet(r: typing.SupportsFloat | typing.SupportsIndex) -> float:
    """
    The wavelet along the radius (thesis eq. 3.22).
    """

@typing.overload
def best_basis(packets: list[numpy.typing.NDArray[numpy.float32]]) -> list[tuple[int, int]]:
    """
    (level, index) of the nodes with the least entropy.
    """

@typing.overload
def best_basis(packets: list[numpy.typing.NDArray[numpy.float64]]) -> list[tuple[int, int]]:
    """
    (level, index) of the nodes with the least entropy.
    """

def bhattacharyya_gaussian(
    mean_a: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    covariance_a: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    mean_b: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    covariance_b: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
) -> float: ...
def chain_code(contour: typing.Annotated[numpy.typing.ArrayLike, numpy.int32]) -> numpy.typing.NDArray[numpy.uint8]:
    """
    Freeman's directions, uint8: 0 right, 2 up, 4 left, 6 down.
    """

@typing.overload
def choose_num_states(
    sequences: collections.abc.Sequence[numpy.ndarray[typing.Any, numpy.dtype[typing.Any]]],
    options: DiscreteHmmOptions,
    candidates: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
    choice: StateChoiceOptions = ...,
) -> StateChoice:
    """
    The number of states, out of `candidates`, whose models explain the sequences best: by BIC, or by the likelihood of sequences held out of training.
    """

@typing.overload
def choose_num_states(
    sequences: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]],
    options: GaussianMixtureHmmOptions,
    candidates: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
    choice: StateChoiceOptions = ...,
) -> StateChoice:
    """
    The number of states, out of `candidates`, whose models explain the sequences best: by BIC, or by the likelihood of sequences held out of training.
    """

@typing.overload
def denoise(
    x: numpy.typing.NDArray[numpy.float32], options: ShrinkageOptions = ...
) -> numpy.typing.NDArray[numpy.float32]:
    """
    The signal without its noise, of the same length.
    """

@typing.overload
def denoise(
    x: numpy.typing.NDArray[numpy.float64], options: ShrinkageOptions = ...
) -> numpy.typing.NDArray[numpy.float64]:
    """
    The signal without its noise, of the same length.
    """

def direction_code(
    dx: typing.SupportsFloat | typing.SupportsIndex, dy: typing.SupportsFloat | typing.SupportsIndex
) -> int:
    """
    Freeman's direction of a way in image axes (y down): 0 right, 2 up, 4 left, 6 down; 0 for no way (thesis eq. 5.11). Raises InvalidArgument for what is not finite.
    """

def distance(
    kind: typing.Literal["euclidean", "manhattan", "cosine", "bhattacharyya"],
    a: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    b: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
) -> float:
    """
    Distance of two vectors of one length.
    """

@typing.overload
def dwt(
    x: numpy.typing.NDArray[numpy.float32],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
) -> tuple[numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.float32]]:
    """
    One level: (approximation, detail), float32 or float64 as x.
    """

@typing.overload
def dwt(
    x: numpy.typing.NDArray[numpy.float64],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
    """
    One level: (approximation, detail), float32 or float64 as x.
    """

@typing.overload
def dwt2(
    image: numpy.typing.NDArray[numpy.float32],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
) -> tuple[
    numpy.typing.NDArray[numpy.float32],
    tuple[
        numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.float32]
    ],
]:
    """
    One level of an image: (approximation, (horizontal, vertical, diagonal)).
    """

@typing.overload
def dwt2(
    image: numpy.typing.NDArray[numpy.float64],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
) -> tuple[
    numpy.typing.NDArray[numpy.float64],
    tuple[
        numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]
    ],
]:
    """
    One level of an image: (approximation, (horizontal, vertical, diagonal)).
    """

def filter_bank(
    options: FilterBankOptions,
    sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
    fft_size: typing.SupportsInt | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Weights, float32, shape (num_filters, fft_size / 2 + 1).
    """

def filter_edges(
    options: FilterBankOptions, sample_rate_hz: typing.SupportsInt | typing.SupportsIndex
) -> numpy.typing.NDArray[numpy.float64]:
    """
    Low, centre and high frequency in Hz, shape (num_filters, 3).
    """

def find_speech(
    audio: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
    options: ActivityOptions = ...,
) -> typing.Any:
    """
    (first, last) sample of the word, or None without speech.
    """

def frequency_order(level: typing.SupportsInt | typing.SupportsIndex) -> list[int]:
    """
    Natural indices of a level's nodes by rising frequency.
    """

def hand_place(mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]) -> typing.Any:
    """
    x, y and area of the hand in shares of the picture; None without one.
    """

def hand_scale_px(tracks: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> float:
    """
    Root mean square distance of the hands from the reference, in pixels. tracks: float32, shape (num_frames, 6), columns TWO_HAND_TRACK_COLUMNS, NaN where a point is out of sight. Raises InvalidArgument.
    """

def hu_features(mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]) -> numpy.typing.NDArray[numpy.float32]:
    """
    The root of each of Hu's invariants by its degree, float32.
    """

def hu_moments(mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]) -> numpy.typing.NDArray[numpy.float64]:
    """
    Hu's seven invariants, float64.
    """

@typing.overload
def idwt(
    approx: numpy.typing.NDArray[numpy.float32],
    detail: numpy.typing.NDArray[numpy.float32],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
) -> numpy.typing.NDArray[numpy.float32]:
    """
    The inverse of one level.
    """

@typing.overload
def idwt(
    approx: numpy.typing.NDArray[numpy.float64],
    detail: numpy.typing.NDArray[numpy.float64],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
) -> numpy.typing.NDArray[numpy.float64]:
    """
    The inverse of one level.
    """

@typing.overload
def idwt2(
    approx: numpy.typing.NDArray[numpy.float32],
    horizontal: numpy.typing.NDArray[numpy.float32],
    vertical: numpy.typing.NDArray[numpy.float32],
    diagonal: numpy.typing.NDArray[numpy.float32],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
    shape: tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex],
) -> numpy.typing.NDArray[numpy.float32]:
    """
    The inverse of dwt2.
    """

@typing.overload
def idwt2(
    approx: numpy.typing.NDArray[numpy.float64],
    horizontal: numpy.typing.NDArray[numpy.float64],
    vertical: numpy.typing.NDArray[numpy.float64],
    diagonal: numpy.typing.NDArray[numpy.float64],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
    shape: tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex],
) -> numpy.typing.NDArray[numpy.float64]:
    """
    The inverse of dwt2.
    """

def initial_start(topology: Topology) -> numpy.typing.NDArray[numpy.float64]:
    """
    Start probabilities, shape (num_states,).
    """

def initial_transition(
    topology: Topology, stay: typing.SupportsFloat | typing.SupportsIndex = 0.6
) -> numpy.typing.NDArray[numpy.float64]:
    """
    Row-stochastic start values without jumps, shape (num_states, num_states).
    """

@typing.overload
def iswt(
    approximation: numpy.typing.NDArray[numpy.float32], details: numpy.typing.NDArray[numpy.float32], wavelet: str
) -> numpy.typing.NDArray[numpy.float32]:
    """
    The inverse, from the approximation of the highest level and all details.
    """

@typing.overload
def iswt(
    approximation: numpy.typing.NDArray[numpy.float64], details: numpy.typing.NDArray[numpy.float64], wavelet: str
) -> numpy.typing.NDArray[numpy.float64]:
    """
    The inverse, from the approximation of the highest level and all details.
    """

def landmark_column_names() -> list[str]:
    """
    Names of the columns of landmark_features; joints are numbered as MediaPipe's are.
    """

def landmark_features(
    points: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    width_px: typing.SupportsInt | typing.SupportsIndex,
    height_px: typing.SupportsInt | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    float32, shape (85,), of joints in pixels, shape (21, 2).
    """

def linear_prediction(
    frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], order: typing.SupportsInt | typing.SupportsIndex
) -> tuple[numpy.typing.NDArray[numpy.float64], float]:
    """
    (a, gain): x[n] is predicted as -a[0] x[n-1] - ..., by the autocorrelation method.
    """

def lpc_cepstrum(
    a: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    gain: typing.SupportsFloat | typing.SupportsIndex,
    num_cepstra: typing.SupportsInt | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float64]:
    """
    c0 .. c_num of the log spectrum ln(gain / |A|^2) = c0 + 2 sum of c_n cos(n w).
    """

def max_dwt_level(num_samples: typing.SupportsInt | typing.SupportsIndex, wavelet: str) -> int:
    """
    Levels until the border reaches every coefficient.
    """

def min_frames_of_htk_model(models: HtkModelSet, hmm: str) -> int:
    """
    Frames on the shortest way through a model.
    """

def necessity_of(
    distribution: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    event: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
) -> float:
    """
    N(A) = 1 - Pi(not A) (thesis eq. 4.2).
    """

@typing.overload
def noise_level(details: numpy.typing.NDArray[numpy.float32]) -> float:
    """
    Standard deviation of noise, by the median of details.
    """

@typing.overload
def noise_level(details: numpy.typing.NDArray[numpy.float64]) -> float:
    """
    Standard deviation of noise, by the median of details.
    """

def normalise_time(
    frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float32], num_rows: typing.SupportsInt | typing.SupportsIndex
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Frames stretched or squeezed to num_rows rows by linear interpolation, float32.
    """

def num_threads() -> int:
    """
    How many threads train, as set.
    """

def orientation_histogram(
    image: typing.Annotated[numpy.typing.ArrayLike, numpy.float32], options: OrientationHistogramOptions = ...
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Histograms, float32; of several cells normalised by blocks, of one by its length.
    """

def pair_rows(
    left: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    right: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    relation_weight: typing.SupportsFloat | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Rows of a gesture of both hands, float32, a row for every frame that shows a hand. left, right: rows of each in every frame, all NaN where it is not seen. Raises InvalidArgument.
    """

def parse_wav(data: bytes, name: str = "bytes") -> Wav: ...
def possibilities(
    log_densities: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
) -> tuple[numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.float32]]:
    """
    Possibility and necessity of every class from log densities (thesis eq. 5.14).
    """

def possibility_of(
    distribution: typing.Annotated[numpy.typing.ArrayLike, numpy.float64],
    event: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex],
) -> float:
    """
    Pi(A) = max over the event (thesis eq. 4.1).
    """

def read_file(path: str | bytes | os.PathLike[str], max_bytes: typing.SupportsInt | typing.SupportsIndex) -> bytes:
    """
    The bytes of a regular file; raises IoError, and FormatError for a larger one.
    """

def read_wav(path: str | bytes | os.PathLike[str]) -> Wav:
    """
    Reads PCM or float WAV, averaged to mono; raises FormatError naming file and field.
    """

@typing.overload
def reconstruct_packets(
    packets: list[numpy.typing.NDArray[numpy.float32]],
    basis: collections.abc.Sequence[
        tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex]
    ],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
) -> numpy.typing.NDArray[numpy.float32]:
    """
    The signal from the nodes of a basis.
    """

@typing.overload
def reconstruct_packets(
    packets: list[numpy.typing.NDArray[numpy.float64]],
    basis: collections.abc.Sequence[
        tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex]
    ],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
) -> numpy.typing.NDArray[numpy.float64]:
    """
    The signal from the nodes of a basis.
    """

def require_whole_video(path: str | bytes | os.PathLike[str]) -> None:
    """
    Raises FormatError for a video that is shorter than it says, and IoError.
    """

def resample(
    samples: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    from_hz: typing.SupportsInt | typing.SupportsIndex,
    to_hz: typing.SupportsInt | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Band-limited change of sampling rate.
    """

def resample_contour(
    contour: typing.Annotated[numpy.typing.ArrayLike, numpy.int32],
    num_points: typing.SupportsInt | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Points at equal distances along the smoothed outline: float32, shape (num_points, 2).
    """

def set_num_threads(count: typing.SupportsInt | typing.SupportsIndex) -> None:
    """
    At most this many threads train from now on, in this process; 0 (as at the start): one for each processor.

    What is trained is the same to the bit for any number.
    """

def shape_axis(mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]) -> tuple[float, float]:
    """
    Angle of the longer axis from x towards y (down), and elongation, 0 (round) to 1 (a line).
    """

def shape_moments(mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]) -> dict:
    """
    Moments to the third order, named as OpenCV names them.
    """

def shape_number(contour: typing.Annotated[numpy.typing.ArrayLike, numpy.int32]) -> numpy.typing.NDArray[numpy.uint8]:
    """
    Turns of the outline from their least start on, uint8.
    """

@typing.overload
def shrink(
    details: numpy.typing.NDArray[numpy.float32],
    threshold: typing.SupportsFloat | typing.SupportsIndex,
    shape: typing.Literal["soft", "hard", "garrote"],
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Details with a threshold applied.
    """

@typing.overload
def shrink(
    details: numpy.typing.NDArray[numpy.float64],
    threshold: typing.SupportsFloat | typing.SupportsIndex,
    shape: typing.Literal["soft", "hard", "garrote"],
) -> numpy.typing.NDArray[numpy.float64]:
    """
    Details with a threshold applied.
    """

@typing.overload
def shrinkage_threshold(
    details: numpy.typing.NDArray[numpy.float32],
    noise: typing.SupportsFloat | typing.SupportsIndex,
    num_samples: typing.SupportsInt | typing.SupportsIndex,
    rule: typing.Literal["universal", "sure", "bayes"],
) -> float:
    """
    The threshold for the details of one level.
    """

@typing.overload
def shrinkage_threshold(
    details: numpy.typing.NDArray[numpy.float64],
    noise: typing.SupportsFloat | typing.SupportsIndex,
    num_samples: typing.SupportsInt | typing.SupportsIndex,
    rule: typing.Literal["universal", "sure", "bayes"],
) -> float:
    """
    The threshold for the details of one level.
    """

def spectral_envelope(
    cepstra: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    num_bins: typing.SupportsInt | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    exp(sum of c_i cos(pi i t / num_bins)), t = 1 .. num_bins, of rows c_1, c_2, ...; shape (num_frames, num_bins) (thesis eq. 3.34-3.36).
    """

@typing.overload
def swt(
    x: numpy.typing.NDArray[numpy.float32], wavelet: str, num_levels: typing.SupportsInt | typing.SupportsIndex
) -> tuple[numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.float32]]:
    """
    Approximations and details, each of shape (num_levels, num_samples), finest level first.
    """

@typing.overload
def swt(
    x: numpy.typing.NDArray[numpy.float64], wavelet: str, num_levels: typing.SupportsInt | typing.SupportsIndex
) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
    """
    Approximations and details, each of shape (num_levels, num_samples), finest level first.
    """

def trace_contour(mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]) -> numpy.typing.NDArray[numpy.int32]:
    """
    Outer outline of the largest region, clockwise in image axes: int32, shape (num_points, 2), x and y.
    """

def track_rows(
    tracks: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    scale_px: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    num_hands: typing.SupportsInt | typing.SupportsIndex = 2,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Rows of a gesture of which only places are known, for GestureRecognizer.fit_features: float32, shape (num_frames, num_features). tracks, scale_px: as of TwoHandFeatureComputer.compute. Raises InvalidArgument.
    """

def train_htk_model_by_viterbi(
    models: HtkModelSet,
    hmm: str,
    recordings: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float32]],
    options: ViterbiTrainerOptions = ...,
) -> HtkViterbiTraining:
    """
    HInit: a model from recordings of its unit, each of shape (num_frames, num_columns); its topology, number of Gaussians and macros stay.
    """

@typing.overload
def wavedec(
    x: numpy.typing.NDArray[numpy.float32],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
    num_levels: typing.SupportsInt | typing.SupportsIndex,
) -> list:
    """
    Several levels, [approximation, coarsest detail, ..., finest detail].
    """

@typing.overload
def wavedec(
    x: numpy.typing.NDArray[numpy.float64],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
    num_levels: typing.SupportsInt | typing.SupportsIndex,
) -> list:
    """
    Several levels, [approximation, coarsest detail, ..., finest detail].
    """

@typing.overload
def wavedec2(
    image: numpy.typing.NDArray[numpy.float32],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
    num_levels: typing.SupportsInt | typing.SupportsIndex,
) -> list:
    """
    Several levels of an image, [approximation, coarsest details, ..., finest details].
    """

@typing.overload
def wavedec2(
    image: numpy.typing.NDArray[numpy.float64],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
    num_levels: typing.SupportsInt | typing.SupportsIndex,
) -> list:
    """
    Several levels of an image, [approximation, coarsest details, ..., finest details].
    """

def wavelet_filters(name: str) -> tuple[list[float], list[float], list[float], list[float]]:
    """
    The filters dec_lo, dec_hi, rec_lo and rec_hi.
    """

def wavelet_names() -> list[str]:
    """
    Names of all wavelets, as PyWavelets has them.
    """

@typing.overload
def wavelet_packets(
    x: numpy.typing.NDArray[numpy.float32],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
    num_levels: typing.SupportsInt | typing.SupportsIndex,
) -> list:
    """
    Nodes of all levels, the signal's first, in natural order.
    """

@typing.overload
def wavelet_packets(
    x: numpy.typing.NDArray[numpy.float64],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
    num_levels: typing.SupportsInt | typing.SupportsIndex,
) -> list:
    """
    Nodes of all levels, the signal's first, in natural order.
    """

@typing.overload
def waverec(
    coefficients: list[numpy.typing.NDArray[numpy.float32]],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
    num_samples: typing.SupportsInt | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    The inverse of wavedec.
    """

@typing.overload
def waverec(
    coefficients: list[numpy.typing.NDArray[numpy.float64]],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
    num_samples: typing.SupportsInt | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float64]:
    """
    The inverse of wavedec.
    """

@typing.overload
def waverec2(
    approx: numpy.typing.NDArray[numpy.float32],
    details: list[typing.Annotated[list[numpy.typing.NDArray[numpy.float32]], "FixedSize(3)"]],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
    shape: tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex],
) -> numpy.typing.NDArray[numpy.float32]:
    """
    The inverse of wavedec2.
    """

@typing.overload
def waverec2(
    approx: numpy.typing.NDArray[numpy.float64],
    details: list[typing.Annotated[list[numpy.typing.NDArray[numpy.float64]], "FixedSize(3)"]],
    wavelet: str,
    border: typing.Literal[
        "symmetric",
        "zero",
        "constant",
        "periodic",
        "reflect",
        "periodization",
        "smooth",
        "antisymmetric",
        "antireflect",
    ],
    shape: tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex],
) -> numpy.typing.NDArray[numpy.float64]:
    """
    The inverse of wavedec2.
    """

def write_wav_pcm16(
    path: str | bytes | os.PathLike[str],
    samples: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
) -> None: ...

HAND_TRACK_COLUMNS: tuple = ("x", "y", "log_area", "axis_cosine", "axis_sine", "speed", "move_cosine", "move_sine")
LEARNED_STILL_CHANGE: float = 0.12
NUM_LANDMARKS: int = 21
TWO_HAND_TRACK_COLUMNS: tuple = ("left_x", "left_y", "right_x", "right_y", "reference_x", "reference_y")
__version__: str = "0.1.0"
