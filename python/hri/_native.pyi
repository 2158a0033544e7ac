# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
# Written by tools/generate_stubs.py from the compiled module; do not edit.
"""
libhri's core: signal, features, models and recognition, without OpenCV.
"""

from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import typing

__all__: list[str] = [
    "ActivityOptions",
    "Border",
    "CepstraComputer",
    "CepstraKind",
    "CepstraOptions",
    "CepstraStream",
    "ChainCodeComputer",
    "ChainCodeOptions",
    "ClassDistance",
    "Codebook",
    "CodebookOptions",
    "CodebookReport",
    "ColourLearning",
    "Conjunction",
    "CovarianceKind",
    "Decision",
    "DecisionStatus",
    "DiscreteHmm",
    "DiscreteHmmOptions",
    "DiscreteHmmStream",
    "Distance",
    "DistanceClassifier",
    "DistanceClassifierOptions",
    "Endpoint",
    "EndpointKind",
    "Endpointer",
    "EndpointerOptions",
    "Error",
    "FilterAxis",
    "FilterBankKind",
    "FilterBankOptions",
    "FixedPointHmmSet",
    "FormatError",
    "FourierDescriptorComputer",
    "FourierDescriptorOptions",
    "FramePadding",
    "GaussianBayes",
    "GaussianBayesOptions",
    "GaussianMixture",
    "GaussianMixtureHmm",
    "GaussianMixtureHmmOptions",
    "GaussianMixtureHmmStream",
    "GaussianMixtureOptions",
    "GestureFeatureComputer",
    "GestureModel",
    "GestureRecognizer",
    "GestureRecognizerOptions",
    "GestureSegment",
    "GestureSegmentKind",
    "GestureSegmentReason",
    "GestureSegmenter",
    "GestureSegmenterOptions",
    "GestureSource",
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
    "Interrupted",
    "InvalidArgument",
    "IoError",
    "Knn",
    "KnnOptions",
    "LEARNED_STILL_CHANGE",
    "Lda",
    "LdaOptions",
    "LinearSvm",
    "LinearSvmOptions",
    "LogisticRegression",
    "LogisticRegressionOptions",
    "MarkovChain",
    "MaskSmoothingOptions",
    "MelScale",
    "ModelFile",
    "MultiStreamCodebook",
    "NBest",
    "NUM_LANDMARKS",
    "NoiseEstimate",
    "Normalisation",
    "OrientationHistogramOptions",
    "PairedHand",
    "Pca",
    "PossibilisticGaussianHmmSet",
    "PossibilisticHmmOptions",
    "PossibilisticHmmSet",
    "PossibilisticHmmStream",
    "PossibilisticRule",
    "PossibilisticTraining",
    "PossibilityClassifier",
    "RbfClassifier",
    "RbfClassifierOptions",
    "SequenceModelKind",
    "SequenceModelOptions",
    "ShrinkageOptions",
    "SilhouetteCepstrumComputer",
    "SilhouetteCepstrumOptions",
    "SilhouetteMethod",
    "SilhouetteOptions",
    "SpeakerAdapter",
    "SpeakerAdapterOptions",
    "StateChoice",
    "StateChoiceOptions",
    "ThresholdRule",
    "ThresholdShape",
    "Topology",
    "TrainingReport",
    "UtteranceDecision",
    "Wav",
    "WaveletDescriptorComputer",
    "WaveletDescriptorOptions",
    "WaveletDescriptorSource",
    "WaveletStream32",
    "WaveletStream64",
    "WaveletStreamOptions",
    "WindowKind",
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
    "distance",
    "dwt",
    "dwt2",
    "filter_bank",
    "filter_edges",
    "find_speech",
    "frequency_order",
    "hand_place",
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
    "necessity_of",
    "noise_level",
    "normalise_time",
    "orientation_histogram",
    "parse_wav",
    "possibilities",
    "possibility_of",
    "read_wav",
    "reconstruct_packets",
    "resample",
    "resample_contour",
    "shape_axis",
    "shape_moments",
    "shape_number",
    "shrink",
    "shrinkage_threshold",
    "spectral_envelope",
    "swt",
    "trace_contour",
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

class ModelFile:
    """
    Tensors and metadata in the safetensors layout; strict reader.
    """

    kind: str
    @staticmethod
    def from_bytes(data: bytes, name: str = "bytes") -> ModelFile:
        """
        Reads what `to_bytes` gave, as strictly.
        """
    @staticmethod
    def read(path: str) -> ModelFile:
        """
        Reads a whole file; raises IoError, or FormatError naming file and field.
        """
    def __init__(self) -> None: ...
    def has(self, name: str) -> bool: ...
    def integer(self, key: str) -> int: ...
    def matrix_d(self, name: str) -> numpy.typing.NDArray[numpy.float64]: ...
    def matrix_f(self, name: str) -> numpy.typing.NDArray[numpy.float32]: ...
    def metadata(self) -> dict[str, str]:
        """
        All metadata as a dict of text.
        """
    def number(self, key: str) -> float: ...
    def set_integer(self, key: str, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def set_matrix_d(self, name: str, values: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None: ...
    def set_matrix_f(self, name: str, values: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]) -> None: ...
    def set_number(self, key: str, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    def set_text(self, key: str, value: str) -> None: ...
    def set_text_list(self, key: str, values: collections.abc.Sequence[str]) -> None: ...
    def tensor_shapes(self) -> dict[str, tuple[int, int]]:
        """
        Name to (rows, columns).
        """
    def text(self, key: str) -> str: ...
    def text_list(self, key: str) -> list[str]: ...
    def to_bytes(self) -> bytes:
        """
        What `write` writes.
        """
    def write(self, path: str) -> None:
        """
        Writes beside the old file, syncs, and renames.
        """

class Wav:
    """
    Mono samples of a WAV file.
    """
    @property
    def notes(self) -> list[str]: ...
    @property
    def num_channels(self) -> int: ...
    @property
    def sample_rate_hz(self) -> int: ...
    @property
    def samples(self) -> numpy.typing.NDArray[numpy.float32]: ...

class Border:
    """
    What stands beyond the ends of a signal, by PyWavelets' names.

    Members:

      symmetric

      zero

      constant

      periodic

      reflect

      periodization

      smooth

      antisymmetric

      antireflect
    """

    __members__: typing.ClassVar[dict[str, Border]]
    antireflect: typing.ClassVar[Border]
    antisymmetric: typing.ClassVar[Border]
    constant: typing.ClassVar[Border]
    periodic: typing.ClassVar[Border]
    periodization: typing.ClassVar[Border]
    reflect: typing.ClassVar[Border]
    smooth: typing.ClassVar[Border]
    symmetric: typing.ClassVar[Border]
    zero: typing.ClassVar[Border]
    @typing.overload
    def __eq__(self, other: Border) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: Border) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class FilterBankKind:
    """
    Members:

      mel

      hfcc
    """

    __members__: typing.ClassVar[dict[str, FilterBankKind]]
    hfcc: typing.ClassVar[FilterBankKind]
    mel: typing.ClassVar[FilterBankKind]
    @typing.overload
    def __eq__(self, other: FilterBankKind) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: FilterBankKind) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class MelScale:
    """
    Members:

      htk

      slaney
    """

    __members__: typing.ClassVar[dict[str, MelScale]]
    htk: typing.ClassVar[MelScale]
    slaney: typing.ClassVar[MelScale]
    @typing.overload
    def __eq__(self, other: MelScale) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: MelScale) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class FilterAxis:
    """
    Members:

      hz

      mel
    """

    __members__: typing.ClassVar[dict[str, FilterAxis]]
    hz: typing.ClassVar[FilterAxis]
    mel: typing.ClassVar[FilterAxis]
    @typing.overload
    def __eq__(self, other: FilterAxis) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: FilterAxis) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class FilterBankOptions:
    """
    Triangular filters over a power spectrum.
    """

    __hash__: typing.ClassVar[None] = None
    axis: FilterAxis
    kind: FilterBankKind
    mel_scale: MelScale
    unit_area: bool
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def erb_factor(self) -> float: ...
    @erb_factor.setter
    def erb_factor(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def high_hz(self) -> float: ...
    @high_hz.setter
    def high_hz(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def low_hz(self) -> float: ...
    @low_hz.setter
    def low_hz(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def num_filters(self) -> int: ...
    @num_filters.setter
    def num_filters(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def warp(self) -> float: ...
    @warp.setter
    def warp(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def warp_high_hz(self) -> float: ...
    @warp_high_hz.setter
    def warp_high_hz(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def warp_low_hz(self) -> float: ...
    @warp_low_hz.setter
    def warp_low_hz(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class ActivityOptions:
    """
    Where somebody speaks in a clip.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def frame_ms(self) -> float: ...
    @frame_ms.setter
    def frame_ms(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def margin_db(self) -> float: ...
    @margin_db.setter
    def margin_db(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_depth_db(self) -> float: ...
    @max_depth_db.setter
    def max_depth_db(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_gap_ms(self) -> float: ...
    @max_gap_ms.setter
    def max_gap_ms(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def min_voicing(self) -> float: ...
    @min_voicing.setter
    def min_voicing(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def padding_ms(self) -> float: ...
    @padding_ms.setter
    def padding_ms(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def shift_ms(self) -> float: ...
    @shift_ms.setter
    def shift_ms(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def silence_dbfs(self) -> float: ...
    @silence_dbfs.setter
    def silence_dbfs(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class EndpointerOptions:
    """
    When an utterance in a stream begins and ends.
    """

    __hash__: typing.ClassVar[None] = None
    activity: ActivityOptions
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def context_ms(self) -> float: ...
    @context_ms.setter
    def context_ms(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def hangover_ms(self) -> float: ...
    @hangover_ms.setter
    def hangover_ms(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_utterance_ms(self) -> float: ...
    @max_utterance_ms.setter
    def max_utterance_ms(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class EndpointKind:
    """
    Members:

      none

      speech_start

      speech_end

      speech_dropped
    """

    __members__: typing.ClassVar[dict[str, EndpointKind]]
    none: typing.ClassVar[EndpointKind]
    speech_dropped: typing.ClassVar[EndpointKind]
    speech_end: typing.ClassVar[EndpointKind]
    speech_start: typing.ClassVar[EndpointKind]
    @typing.overload
    def __eq__(self, other: EndpointKind) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: EndpointKind) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Endpoint:
    """
    An event; positions are samples since the stream began.
    """
    @property
    def at(self) -> int: ...
    @property
    def cut(self) -> bool: ...
    @property
    def first(self) -> int: ...
    @property
    def kind(self) -> EndpointKind: ...
    @property
    def last(self) -> int: ...
    @property
    def segment_first(self) -> int: ...
    @property
    def segment_last(self) -> int: ...

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
    def excess_db(self) -> float: ...
    @property
    def in_speech(self) -> bool: ...
    @property
    def level_db(self) -> float: ...
    @property
    def num_samples(self) -> int: ...
    @property
    def options(self) -> EndpointerOptions: ...

class ThresholdRule:
    """
    How a threshold follows from the noise.

    Members:

      universal

      sure

      bayes
    """

    __members__: typing.ClassVar[dict[str, ThresholdRule]]
    bayes: typing.ClassVar[ThresholdRule]
    sure: typing.ClassVar[ThresholdRule]
    universal: typing.ClassVar[ThresholdRule]
    @typing.overload
    def __eq__(self, other: ThresholdRule) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: ThresholdRule) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class ThresholdShape:
    """
    What becomes of details at a threshold.

    Members:

      soft

      hard

      garrote
    """

    __members__: typing.ClassVar[dict[str, ThresholdShape]]
    garrote: typing.ClassVar[ThresholdShape]
    hard: typing.ClassVar[ThresholdShape]
    soft: typing.ClassVar[ThresholdShape]
    @typing.overload
    def __eq__(self, other: ThresholdShape) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: ThresholdShape) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class NoiseEstimate:
    """
    Where a level's noise is measured.

    Members:

      quietest

      per_level

      finest
    """

    __members__: typing.ClassVar[dict[str, NoiseEstimate]]
    finest: typing.ClassVar[NoiseEstimate]
    per_level: typing.ClassVar[NoiseEstimate]
    quietest: typing.ClassVar[NoiseEstimate]
    @typing.overload
    def __eq__(self, other: NoiseEstimate) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: NoiseEstimate) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class ShrinkageOptions:
    """
    Noise reduction by wavelets.
    """

    __hash__: typing.ClassVar[None] = None
    border: Border
    noise: NoiseEstimate
    rule: ThresholdRule
    shape: ThresholdShape
    wavelet: str
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def num_levels(self) -> int:
        """
        0: five, or as many as fit.
        """
    @num_levels.setter
    def num_levels(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def strength(self) -> float:
        """
        Factor of all thresholds.
        """
    @strength.setter
    def strength(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class WaveletStreamOptions:
    """
    What a stream of samples is transformed by.
    """

    __hash__: typing.ClassVar[None] = None
    wavelet: str
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def num_levels(self) -> int: ...
    @num_levels.setter
    def num_levels(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

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

class CepstraKind:
    """
    Members:

      filter_bank

      linear_prediction
    """

    __members__: typing.ClassVar[dict[str, CepstraKind]]
    filter_bank: typing.ClassVar[CepstraKind]
    linear_prediction: typing.ClassVar[CepstraKind]
    @typing.overload
    def __eq__(self, other: CepstraKind) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: CepstraKind) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class FramePadding:
    """
    Members:

      none

      centred
    """

    __members__: typing.ClassVar[dict[str, FramePadding]]
    centred: typing.ClassVar[FramePadding]
    none: typing.ClassVar[FramePadding]
    @typing.overload
    def __eq__(self, other: FramePadding) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: FramePadding) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class WindowKind:
    """
    Members:

      hamming

      hann

      hann_periodic

      povey

      rectangular
    """

    __members__: typing.ClassVar[dict[str, WindowKind]]
    hamming: typing.ClassVar[WindowKind]
    hann: typing.ClassVar[WindowKind]
    hann_periodic: typing.ClassVar[WindowKind]
    povey: typing.ClassVar[WindowKind]
    rectangular: typing.ClassVar[WindowKind]
    @typing.overload
    def __eq__(self, other: WindowKind) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: WindowKind) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Normalisation:
    """
    Members:

      none

      level

      mean

      mean_variance

      running_mean

      running_mean_variance
    """

    __members__: typing.ClassVar[dict[str, Normalisation]]
    level: typing.ClassVar[Normalisation]
    mean: typing.ClassVar[Normalisation]
    mean_variance: typing.ClassVar[Normalisation]
    none: typing.ClassVar[Normalisation]
    running_mean: typing.ClassVar[Normalisation]
    running_mean_variance: typing.ClassVar[Normalisation]
    @typing.overload
    def __eq__(self, other: Normalisation) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: Normalisation) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class CepstraOptions:
    """
    Cepstra of speech (MFCC, HFCC, LPCC).
    """

    __hash__: typing.ClassVar[None] = None
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
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def decibels(self) -> bool:
        """
        10 log10 in place of ln
        """
    @decibels.setter
    def decibels(self, arg0: bool) -> None: ...
    @property
    def delta_orders(self) -> int:
        """
        0..2
        """
    @delta_orders.setter
    def delta_orders(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def delta_window(self) -> int:
        """
        frames on each side of the regression, 1..10
        """
    @delta_window.setter
    def delta_window(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def energy_floor(self) -> float:
        """
        below the log, 1e-30..1e30
        """
    @energy_floor.setter
    def energy_floor(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def erb_factor(self) -> float:
        """
        bandwidth factor E of HFCC-E, 0.1..10
        """
    @erb_factor.setter
    def erb_factor(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def fft_size(self) -> int:
        """
        even, at least the frame's samples; 0: the next power of two
        """
    @fft_size.setter
    def fft_size(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def filter_axis(self) -> FilterAxis:
        """
        along which the sides of filters are straight: hz or mel
        """
    @filter_axis.setter
    def filter_axis(self, arg0: FilterAxis) -> None: ...
    @property
    def filter_bank(self) -> FilterBankKind:
        """
        mel or hfcc
        """
    @filter_bank.setter
    def filter_bank(self, arg0: FilterBankKind) -> None: ...
    @property
    def frame_length_ms(self) -> float:
        """
        1..1000
        """
    @frame_length_ms.setter
    def frame_length_ms(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def frame_pre_emphasis(self) -> bool:
        """
        every frame begins anew, as in HTK and Kaldi
        """
    @frame_pre_emphasis.setter
    def frame_pre_emphasis(self, arg0: bool) -> None: ...
    @property
    def frame_shift_ms(self) -> float:
        """
        1..1000
        """
    @frame_shift_ms.setter
    def frame_shift_ms(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def high_hz(self) -> float:
        """
        upper edge of the last filter; 0: the Nyquist rate
        """
    @high_hz.setter
    def high_hz(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def htk_c0(self) -> bool:
        """
        c0 (or the energy) behind the others, and c0 sqrt(2) times as large
        """
    @htk_c0.setter
    def htk_c0(self, arg0: bool) -> None: ...
    @property
    def kind(self) -> CepstraKind:
        """
        filter_bank (MFCC, HFCC) or linear_prediction (LPCC)
        """
    @kind.setter
    def kind(self, arg0: CepstraKind) -> None: ...
    @property
    def lifter(self) -> float:
        """
        HTK's sine lifter; 0: off
        """
    @lifter.setter
    def lifter(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def low_hz(self) -> float:
        """
        lower edge of the first filter
        """
    @low_hz.setter
    def low_hz(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def lpc_order(self) -> int:
        """
        1..64
        """
    @lpc_order.setter
    def lpc_order(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def mel_scale(self) -> MelScale:
        """
        htk or slaney
        """
    @mel_scale.setter
    def mel_scale(self, arg0: MelScale) -> None: ...
    @property
    def normalisation(self) -> Normalisation:
        """
        of an utterance or running
        """
    @normalisation.setter
    def normalisation(self, arg0: Normalisation) -> None: ...
    @property
    def num_cepstra(self) -> int:
        """
        c1 .. c_num, 1..num_filters - 1
        """
    @num_cepstra.setter
    def num_cepstra(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_filters(self) -> int:
        """
        1..512
        """
    @num_filters.setter
    def num_filters(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def padding(self) -> FramePadding:
        """
        none, or zeros around the audio so that frame t has sample t * shift in its middle
        """
    @padding.setter
    def padding(self, arg0: FramePadding) -> None: ...
    @property
    def pre_emphasis(self) -> float:
        """
        0 (off) .. 1
        """
    @pre_emphasis.setter
    def pre_emphasis(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def rasta_pole(self) -> float:
        """
        of the RASTA filter, below 1; 0: off
        """
    @rasta_pole.setter
    def rasta_pole(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def remove_dc(self) -> bool:
        """
        subtract the mean of every frame
        """
    @remove_dc.setter
    def remove_dc(self, arg0: bool) -> None: ...
    @property
    def running_s(self) -> float:
        """
        memory of the running normalisations
        """
    @running_s.setter
    def running_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def sample_rate_hz(self) -> int:
        """
        1000..384000
        """
    @sample_rate_hz.setter
    def sample_rate_hz(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def sample_scale(self) -> float:
        """
        32768: as if samples were 16-bit integers
        """
    @sample_scale.setter
    def sample_scale(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def top_db(self) -> float:
        """
        filters this far below the loudest of the utterance are raised to that; 0: off
        """
    @top_db.setter
    def top_db(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def unit_area(self) -> bool:
        """
        filters of equal area, not of equal height
        """
    @unit_area.setter
    def unit_area(self, arg0: bool) -> None: ...
    @property
    def use_c0(self) -> bool:
        """
        put c0 in front
        """
    @use_c0.setter
    def use_c0(self, arg0: bool) -> None: ...
    @property
    def use_energy(self) -> bool:
        """
        log energy of the frame in the place of c0
        """
    @use_energy.setter
    def use_energy(self, arg0: bool) -> None: ...
    @property
    def use_power(self) -> bool:
        """
        False: filters over the magnitude
        """
    @use_power.setter
    def use_power(self, arg0: bool) -> None: ...
    @property
    def warp(self) -> float:
        """
        vocal-tract-length factor on the filter frequencies, 0.5..2
        """
    @warp.setter
    def warp(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def warp_high_hz(self) -> float:
        """
        where the warp bends back to high_hz; 0: it does not
        """
    @warp_high_hz.setter
    def warp_high_hz(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def warp_low_hz(self) -> float:
        """
        where the warp bends back to low_hz; 0: it does not
        """
    @warp_low_hz.setter
    def warp_low_hz(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def window(self) -> WindowKind:
        """
        laid over every frame
        """
    @window.setter
    def window(self, arg0: WindowKind) -> None: ...

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
    def num_frames(self, num_samples: typing.SupportsInt | typing.SupportsIndex) -> int: ...
    @property
    def num_features(self) -> int: ...
    @property
    def options(self) -> CepstraOptions: ...

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
    def reset(self, keep_normalisation: bool = False) -> None: ...
    @property
    def num_features(self) -> int: ...
    @property
    def options(self) -> CepstraOptions: ...

class ChainCodeOptions:
    """
    Histograms of chain codes.
    """

    __hash__: typing.ClassVar[None] = None
    use_turns: bool
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def num_parts(self) -> int: ...
    @num_parts.setter
    def num_parts(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

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
    def num_features(self) -> int: ...

class FourierDescriptorOptions:
    """
    Harmonics of an outline.
    """

    __hash__: typing.ClassVar[None] = None
    use_phase: bool
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def num_harmonics(self) -> int: ...
    @num_harmonics.setter
    def num_harmonics(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_points(self) -> int: ...
    @num_points.setter
    def num_points(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

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
    def num_features(self) -> int: ...

class WaveletDescriptorSource:
    """
    Members:

      silhouette

      contour
    """

    __members__: typing.ClassVar[dict[str, WaveletDescriptorSource]]
    contour: typing.ClassVar[WaveletDescriptorSource]
    silhouette: typing.ClassVar[WaveletDescriptorSource]
    @typing.overload
    def __eq__(self, other: WaveletDescriptorSource) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: WaveletDescriptorSource) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class WaveletDescriptorOptions:
    """
    Moment-invariant wavelet descriptors.
    """

    __hash__: typing.ClassVar[None] = None
    source: WaveletDescriptorSource
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def num_frequencies(self) -> int: ...
    @num_frequencies.setter
    def num_frequencies(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_scales(self) -> int: ...
    @num_scales.setter
    def num_scales(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

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
    def num_features(self) -> int: ...

class HandTrackOptions:
    """
    The way of a hand.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def delta_orders(self) -> int: ...
    @delta_orders.setter
    def delta_orders(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def delta_window(self) -> int: ...
    @delta_window.setter
    def delta_window(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def frames_per_second(self) -> float: ...
    @frames_per_second.setter
    def frames_per_second(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

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
    def num_features(self) -> int: ...

class HandPairOptions:
    """
    How two hands are kept apart.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def min_area(self) -> float: ...
    @min_area.setter
    def min_area(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def min_share(self) -> float: ...
    @min_share.setter
    def min_share(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def num_kept_frames(self) -> int: ...
    @num_kept_frames.setter
    def num_kept_frames(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class PairedHand:
    """
    One of two hands in a frame.
    """
    @property
    def mask(self) -> numpy.typing.NDArray[numpy.uint8]: ...
    @property
    def seen(self) -> bool: ...
    @property
    def touching(self) -> bool:
        """
        One region holds both hands: the border between them is a guess.
        """
    @property
    def x_px(self) -> float: ...
    @property
    def y_px(self) -> float: ...

class HandPairTracker:
    """
    Tells both hands of a stream of masks apart, also while they touch and where they cross.
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

class OrientationHistogramOptions:
    """
    Grid of cells and bins.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def num_bins(self) -> int: ...
    @num_bins.setter
    def num_bins(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_cells(self) -> int: ...
    @num_cells.setter
    def num_cells(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class SilhouetteCepstrumOptions:
    """
    DWT + MFCC of a silhouette.
    """

    __hash__: typing.ClassVar[None] = None
    wavelet: str
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def mask_px(self) -> int: ...
    @mask_px.setter
    def mask_px(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_cepstra(self) -> int: ...
    @num_cepstra.setter
    def num_cepstra(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_filters(self) -> int: ...
    @num_filters.setter
    def num_filters(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_levels(self) -> int: ...
    @num_levels.setter
    def num_levels(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_points(self) -> int: ...
    @num_points.setter
    def num_points(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class SilhouetteCepstrumComputer:
    """
    Cepstrum of a silhouette's contour.
    """
    def __init__(self, options: SilhouetteCepstrumOptions = ...) -> None: ...
    def compute(
        self, mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        c0, c1, ..., float32.
        """
    def contour_signal(
        self, mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]
    ) -> numpy.typing.NDArray[numpy.float32]:
        """
        Distance from the centroid along the contour, scaled by its mean.
        """

class HandFeatureOptions:
    """
    The joined feature of one hand picture.
    """

    __hash__: typing.ClassVar[None] = None
    cepstrum: SilhouetteCepstrumOptions
    chain_code: ChainCodeOptions
    fourier: FourierDescriptorOptions
    histogram: OrientationHistogramOptions
    use_cepstrum: bool
    use_chain_code: bool
    use_fourier: bool
    use_grey: bool
    use_moments: bool
    use_silhouette: bool
    use_wavelet: bool
    wavelet: WaveletDescriptorOptions
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def cepstrum_weight(self) -> float: ...
    @cepstrum_weight.setter
    def cepstrum_weight(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def crop_px(self) -> int: ...
    @crop_px.setter
    def crop_px(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def descriptor_weight(self) -> float: ...
    @descriptor_weight.setter
    def descriptor_weight(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

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
    def num_features(self) -> int: ...

class SilhouetteMethod:
    """
    Members:

      chroma_otsu

      hsv

      grey_otsu
    """

    __members__: typing.ClassVar[dict[str, SilhouetteMethod]]
    chroma_otsu: typing.ClassVar[SilhouetteMethod]
    grey_otsu: typing.ClassVar[SilhouetteMethod]
    hsv: typing.ClassVar[SilhouetteMethod]
    @typing.overload
    def __eq__(self, other: SilhouetteMethod) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: SilhouetteMethod) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class SilhouetteOptions:
    """
    How the hand is found in a picture.
    """

    __hash__: typing.ClassVar[None] = None
    method: SilhouetteMethod
    remove_face: bool
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def blur_px(self) -> int: ...
    @blur_px.setter
    def blur_px(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_area(self) -> float: ...
    @max_area.setter
    def max_area(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_hands(self) -> int: ...
    @max_hands.setter
    def max_hands(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_side_px(self) -> int: ...
    @max_side_px.setter
    def max_side_px(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def min_area(self) -> float: ...
    @min_area.setter
    def min_area(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def min_contrast(self) -> float: ...
    @min_contrast.setter
    def min_contrast(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def min_quality(self) -> float: ...
    @min_quality.setter
    def min_quality(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def sure_contrast(self) -> float: ...
    @sure_contrast.setter
    def sure_contrast(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class MaskSmoothingOptions:
    """
    Which masks of a clip are repaired.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def max_gap(self) -> int: ...
    @max_gap.setter
    def max_gap(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_overlap(self) -> float: ...
    @max_overlap.setter
    def max_overlap(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def min_agreement(self) -> float: ...
    @min_agreement.setter
    def min_agreement(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class HandColourOptions:
    """
    How the colours of hand and background are learned from a clip.
    """

    __hash__: typing.ClassVar[None] = None
    remove_still: bool
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def fit_side_px(self) -> int: ...
    @fit_side_px.setter
    def fit_side_px(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_area(self) -> float: ...
    @max_area.setter
    def max_area(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_hands(self) -> int: ...
    @max_hands.setter
    def max_hands(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_side_px(self) -> int: ...
    @max_side_px.setter
    def max_side_px(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def min_area(self) -> float: ...
    @min_area.setter
    def min_area(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def min_quality(self) -> float: ...
    @min_quality.setter
    def min_quality(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def num_fit_frames(self) -> int: ...
    @num_fit_frames.setter
    def num_fit_frames(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_rounds(self) -> int: ...
    @num_rounds.setter
    def num_rounds(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class ColourLearning:
    """
    Members:

      automatic

      never
    """

    __members__: typing.ClassVar[dict[str, ColourLearning]]
    automatic: typing.ClassVar[ColourLearning]
    never: typing.ClassVar[ColourLearning]
    @typing.overload
    def __eq__(self, other: ColourLearning) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: ColourLearning) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class HandFinderOptions:
    """
    How hands are found in clips and streams.
    """

    __hash__: typing.ClassVar[None] = None
    colours: HandColourOptions
    learning: ColourLearning
    silhouette: SilhouetteOptions
    smooth: bool
    smoothing: MaskSmoothingOptions
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def min_frames(self) -> int: ...
    @min_frames.setter
    def min_frames(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

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
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def max_iterations(self) -> int: ...
    @max_iterations.setter
    def max_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_codewords(self) -> int: ...
    @num_codewords.setter
    def num_codewords(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def split_epsilon(self) -> float: ...
    @split_epsilon.setter
    def split_epsilon(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def tolerance(self) -> float: ...
    @tolerance.setter
    def tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

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
    def centroids(self) -> numpy.typing.NDArray[numpy.float32]: ...
    @property
    def dim(self) -> int: ...
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
    def dim(self) -> int: ...
    @property
    def num_streams(self) -> int: ...
    @property
    def streams(self) -> list[Codebook]: ...

class Distance:
    """
    Members:

      euclidean

      manhattan

      cosine

      bhattacharyya
    """

    __members__: typing.ClassVar[dict[str, Distance]]
    bhattacharyya: typing.ClassVar[Distance]
    cosine: typing.ClassVar[Distance]
    euclidean: typing.ClassVar[Distance]
    manhattan: typing.ClassVar[Distance]
    @typing.overload
    def __eq__(self, other: Distance) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: Distance) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

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
    def components(self) -> numpy.typing.NDArray[numpy.float32]: ...
    @property
    def dim(self) -> int: ...
    @property
    def mean(self) -> numpy.typing.NDArray[numpy.float32]: ...
    @property
    def num_components(self) -> int: ...
    @property
    def variances(self) -> numpy.typing.NDArray[numpy.float32]: ...

class LdaOptions:
    """
    Options of Lda.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def num_components(self) -> int: ...
    @num_components.setter
    def num_components(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def shrinkage(self) -> float: ...
    @shrinkage.setter
    def shrinkage(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

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
    def components(self) -> numpy.typing.NDArray[numpy.float32]: ...
    @property
    def dim(self) -> int: ...
    @property
    def mean(self) -> numpy.typing.NDArray[numpy.float32]: ...
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
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def bias_feature(self) -> float: ...
    @bias_feature.setter
    def bias_feature(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def cost(self) -> float: ...
    @cost.setter
    def cost(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_iterations(self) -> int: ...
    @max_iterations.setter
    def max_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def seed(self) -> int: ...
    @seed.setter
    def seed(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def tolerance(self) -> float: ...
    @tolerance.setter
    def tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

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
    def biases(self) -> numpy.typing.NDArray[numpy.float32]: ...
    @property
    def dim(self) -> int: ...
    @property
    def num_classes(self) -> int: ...
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float32]: ...

class RbfClassifierOptions:
    """
    Options of RbfClassifier.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def cost(self) -> float: ...
    @cost.setter
    def cost(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def sharpness(self) -> float: ...
    @sharpness.setter
    def sharpness(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

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
    def dim(self) -> int: ...
    @property
    def num_classes(self) -> int: ...
    @property
    def num_rows(self) -> int: ...

class CovarianceKind:
    """
    Members:

      shared

      full

      diagonal
    """

    __members__: typing.ClassVar[dict[str, CovarianceKind]]
    diagonal: typing.ClassVar[CovarianceKind]
    full: typing.ClassVar[CovarianceKind]
    shared: typing.ClassVar[CovarianceKind]
    @typing.overload
    def __eq__(self, other: CovarianceKind) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: CovarianceKind) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class GaussianBayesOptions:
    """
    Options of GaussianBayes.
    """

    __hash__: typing.ClassVar[None] = None
    covariance: CovarianceKind
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def shrinkage(self) -> float: ...
    @shrinkage.setter
    def shrinkage(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

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
    def dim(self) -> int: ...
    @property
    def num_classes(self) -> int: ...

class KnnOptions:
    """
    Options of Knn.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def num_neighbours(self) -> int: ...
    @num_neighbours.setter
    def num_neighbours(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

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
    def dim(self) -> int: ...
    @property
    def num_classes(self) -> int: ...

class ClassDistance:
    """
    Members:

      euclidean

      manhattan

      mahalanobis

      bhattacharyya
    """

    __members__: typing.ClassVar[dict[str, ClassDistance]]
    bhattacharyya: typing.ClassVar[ClassDistance]
    euclidean: typing.ClassVar[ClassDistance]
    mahalanobis: typing.ClassVar[ClassDistance]
    manhattan: typing.ClassVar[ClassDistance]
    @typing.overload
    def __eq__(self, other: ClassDistance) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: ClassDistance) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class DistanceClassifierOptions:
    """
    Options of DistanceClassifier.
    """

    __hash__: typing.ClassVar[None] = None
    metric: ClassDistance
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def shrinkage(self) -> float: ...
    @shrinkage.setter
    def shrinkage(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

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
    def dim(self) -> int: ...
    @property
    def num_classes(self) -> int: ...

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
    def dim(self) -> int: ...
    @property
    def num_classes(self) -> int: ...

class LogisticRegressionOptions:
    """
    Options of LogisticRegression.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def max_iterations(self) -> int: ...
    @max_iterations.setter
    def max_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def penalty(self) -> float: ...
    @penalty.setter
    def penalty(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

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
    def bias(self) -> float: ...
    @property
    def dim(self) -> int: ...
    @property
    def num_classes(self) -> int: ...
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]: ...

class Topology:
    """
    Which transitions a sequence model has.
    """
    class Kind:
        """
        Members:

          left_right

          banded

          ergodic

          rank_one_plus_band
        """

        __members__: typing.ClassVar[dict[str, Topology.Kind]]
        banded: typing.ClassVar[Topology.Kind]
        ergodic: typing.ClassVar[Topology.Kind]
        left_right: typing.ClassVar[Topology.Kind]
        rank_one_plus_band: typing.ClassVar[Topology.Kind]
        @typing.overload
        def __eq__(self, other: Topology.Kind) -> bool: ...
        @typing.overload
        def __eq__(self, other: typing.Any) -> bool: ...
        def __getstate__(self) -> int: ...
        def __hash__(self) -> int: ...
        def __index__(self) -> int: ...
        def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
        def __int__(self) -> int: ...
        @typing.overload
        def __ne__(self, other: Topology.Kind) -> bool: ...
        @typing.overload
        def __ne__(self, other: typing.Any) -> bool: ...
        def __repr__(self) -> str: ...
        def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
        def __str__(self) -> str: ...
        @property
        def name(self) -> str: ...
        @property
        def value(self) -> int: ...

    __hash__: typing.ClassVar[None] = None
    kind: Topology.Kind
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def allows(
        self, i: typing.SupportsInt | typing.SupportsIndex, j: typing.SupportsInt | typing.SupportsIndex
    ) -> bool: ...
    def as_dict(self) -> dict: ...
    @property
    def max_jump(self) -> int: ...
    @max_jump.setter
    def max_jump(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_states(self) -> int: ...
    @num_states.setter
    def num_states(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

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
    def band(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @property
    def land(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @property
    def leave(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @property
    def num_states(self) -> int: ...
    @property
    def start(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @property
    def topology(self) -> Topology: ...
    @property
    def transition(self) -> numpy.typing.NDArray[numpy.float64]: ...

class TrainingReport:
    """
    How an iterative training went.
    """
    def __init__(self) -> None: ...
    @property
    def converged(self) -> bool: ...
    @property
    def log_likelihoods(self) -> list[float]: ...

class GaussianMixtureOptions:
    """
    Options of GaussianMixture.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def max_iterations(self) -> int: ...
    @max_iterations.setter
    def max_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_mixtures(self) -> int: ...
    @num_mixtures.setter
    def num_mixtures(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def seed(self) -> int: ...
    @seed.setter
    def seed(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def tolerance(self) -> float: ...
    @tolerance.setter
    def tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def variance_floor(self) -> float: ...
    @variance_floor.setter
    def variance_floor(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def wide_weight(self) -> float: ...
    @wide_weight.setter
    def wide_weight(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

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
    def dim(self) -> int: ...
    @property
    def means(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @property
    def variances(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]: ...

class GaussianMixtureHmmOptions:
    """
    Options of GaussianMixtureHmm.
    """

    __hash__: typing.ClassVar[None] = None
    tied_variance: bool
    topology: Topology
    train_transitions: bool
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def max_iterations(self) -> int: ...
    @max_iterations.setter
    def max_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_mixtures(self) -> int: ...
    @num_mixtures.setter
    def num_mixtures(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def seed(self) -> int: ...
    @seed.setter
    def seed(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def tolerance(self) -> float: ...
    @tolerance.setter
    def tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def transition_prior(self) -> float: ...
    @transition_prior.setter
    def transition_prior(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def variance_floor(self) -> float: ...
    @variance_floor.setter
    def variance_floor(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def weight_floor(self) -> float: ...
    @weight_floor.setter
    def weight_floor(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def weight_prior(self) -> float: ...
    @weight_prior.setter
    def weight_prior(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

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
        P(state | all frames), shape (num_frames, num_states).
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
    def chain(self) -> MarkovChain: ...
    @property
    def dim(self) -> int: ...
    @property
    def means(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @property
    def num_states(self) -> int: ...
    @property
    def variances(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @property
    def weights(self) -> numpy.typing.NDArray[numpy.float64]: ...

class DiscreteHmmOptions:
    """
    Options of DiscreteHmm.
    """

    __hash__: typing.ClassVar[None] = None
    topology: Topology
    train_transitions: bool
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def emission_floor(self) -> float: ...
    @emission_floor.setter
    def emission_floor(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def emission_prior(self) -> float: ...
    @emission_prior.setter
    def emission_prior(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_iterations(self) -> int: ...
    @max_iterations.setter
    def max_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_symbols(self) -> int: ...
    @num_symbols.setter
    def num_symbols(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def seed(self) -> int: ...
    @seed.setter
    def seed(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def tolerance(self) -> float: ...
    @tolerance.setter
    def tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def transition_prior(self) -> float: ...
    @transition_prior.setter
    def transition_prior(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

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
        P(state | all symbols), shape (num_symbols_given, num_states).
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
    def chain(self) -> MarkovChain: ...
    @property
    def emission(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @property
    def num_states(self) -> int: ...
    @property
    def num_symbols(self) -> int: ...

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
    def num_frames(self) -> int: ...
    @property
    def num_models(self) -> int: ...

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
    def num_frames(self) -> int: ...
    @property
    def num_models(self) -> int: ...

class StateChoiceOptions:
    """
    Options of choose_num_states.
    """
    class Criterion:
        """
        Members:

          bic

          held_out
        """

        __members__: typing.ClassVar[dict[str, StateChoiceOptions.Criterion]]
        bic: typing.ClassVar[StateChoiceOptions.Criterion]
        held_out: typing.ClassVar[StateChoiceOptions.Criterion]
        @typing.overload
        def __eq__(self, other: StateChoiceOptions.Criterion) -> bool: ...
        @typing.overload
        def __eq__(self, other: typing.Any) -> bool: ...
        def __getstate__(self) -> int: ...
        def __hash__(self) -> int: ...
        def __index__(self) -> int: ...
        def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
        def __int__(self) -> int: ...
        @typing.overload
        def __ne__(self, other: StateChoiceOptions.Criterion) -> bool: ...
        @typing.overload
        def __ne__(self, other: typing.Any) -> bool: ...
        def __repr__(self) -> str: ...
        def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
        def __str__(self) -> str: ...
        @property
        def name(self) -> str: ...
        @property
        def value(self) -> int: ...

    __hash__: typing.ClassVar[None] = None
    criterion: StateChoiceOptions.Criterion
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def num_folds(self) -> int: ...
    @num_folds.setter
    def num_folds(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_restarts(self) -> int: ...
    @num_restarts.setter
    def num_restarts(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def seed(self) -> int: ...
    @seed.setter
    def seed(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class StateChoice:
    """
    What choose_num_states found.
    """
    class Candidate:
        """
        One number of states.
        """
        @property
        def log_likelihood(self) -> float: ...
        @property
        def num_parameters(self) -> int: ...
        @property
        def num_states(self) -> int: ...
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

class Conjunction:
    """
    Members:

      product

      min

      max
    """

    __members__: typing.ClassVar[dict[str, Conjunction]]
    max: typing.ClassVar[Conjunction]
    min: typing.ClassVar[Conjunction]
    product: typing.ClassVar[Conjunction]
    @typing.overload
    def __eq__(self, other: Conjunction) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: Conjunction) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class PossibilisticRule:
    """
    How a PossibilisticHmmSet is scored.
    """

    __hash__: typing.ClassVar[None] = None
    conditioned: bool
    conjunction: Conjunction
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def concentration(self) -> float: ...
    @concentration.setter
    def concentration(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class PossibilisticTraining:
    """
    Members:

      all_paths

      best_path
    """

    __members__: typing.ClassVar[dict[str, PossibilisticTraining]]
    all_paths: typing.ClassVar[PossibilisticTraining]
    best_path: typing.ClassVar[PossibilisticTraining]
    @typing.overload
    def __eq__(self, other: PossibilisticTraining) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: PossibilisticTraining) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class PossibilisticHmmOptions:
    """
    Options of PossibilisticHmmSet.
    """

    __hash__: typing.ClassVar[None] = None
    rule: PossibilisticRule
    topology: Topology
    training: PossibilisticTraining
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def emission_floor(self) -> float: ...
    @emission_floor.setter
    def emission_floor(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_iterations(self) -> int: ...
    @max_iterations.setter
    def max_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_symbols(self) -> int: ...
    @num_symbols.setter
    def num_symbols(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def seed(self) -> int: ...
    @seed.setter
    def seed(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def tolerance(self) -> float: ...
    @tolerance.setter
    def tolerance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

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
    def num_classes(self) -> int: ...
    @property
    def num_states(self) -> int: ...
    @property
    def num_symbols(self) -> int: ...
    @property
    def rule(self) -> PossibilisticRule: ...
    @property
    def topology(self) -> Topology: ...

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
    def dim(self) -> int: ...
    @property
    def models(self) -> list[GaussianMixtureHmm]:
        """
        The HMMs before scaling.
        """
    @property
    def num_classes(self) -> int: ...
    @property
    def rule(self) -> PossibilisticRule: ...
    @property
    def topology(self) -> Topology: ...

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
    def num_classes(self) -> int: ...
    @property
    def num_symbols(self) -> int: ...
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
    def push(self, symbol: typing.SupportsInt | typing.SupportsIndex) -> None: ...
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
    def num_classes(self) -> int: ...
    @property
    def num_frames(self) -> int: ...

class DecisionStatus:
    """
    Members:

      recognised

      unknown

      no_input
    """

    __members__: typing.ClassVar[dict[str, DecisionStatus]]
    no_input: typing.ClassVar[DecisionStatus]
    recognised: typing.ClassVar[DecisionStatus]
    unknown: typing.ClassVar[DecisionStatus]
    @typing.overload
    def __eq__(self, other: DecisionStatus) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: DecisionStatus) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class NBest:
    """
    One class of the n-best list.
    """
    @property
    def label(self) -> str: ...
    @property
    def log_score(self) -> float: ...
    @property
    def probability(self) -> float: ...

class Decision:
    """
    What a recogniser says of one utterance or gesture.
    """
    @property
    def class_threshold(self) -> float: ...
    @property
    def confidence(self) -> float: ...
    @property
    def label(self) -> str: ...
    @property
    def nbest(self) -> list[NBest]: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def score(self) -> float: ...
    @property
    def status(self) -> DecisionStatus: ...

class UtteranceDecision:
    """
    The decision on one utterance of a longer recording.
    """
    @property
    def decision(self) -> Decision: ...
    @property
    def first_s(self) -> float: ...
    @property
    def last_s(self) -> float: ...

class SequenceModelKind:
    """
    Members:

      hmm

      ptbhmm
    """

    __members__: typing.ClassVar[dict[str, SequenceModelKind]]
    hmm: typing.ClassVar[SequenceModelKind]
    ptbhmm: typing.ClassVar[SequenceModelKind]
    @typing.overload
    def __eq__(self, other: SequenceModelKind) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: SequenceModelKind) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class SequenceModelOptions:
    """
    The models trained on one front end.
    """

    __hash__: typing.ClassVar[None] = None
    model: SequenceModelKind
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def garbage_mixtures(self) -> int: ...
    @garbage_mixtures.setter
    def garbage_mixtures(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def max_iterations(self) -> int: ...
    @max_iterations.setter
    def max_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_codewords(self) -> int: ...
    @num_codewords.setter
    def num_codewords(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_mixtures(self) -> int: ...
    @num_mixtures.setter
    def num_mixtures(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_states(self) -> int: ...
    @num_states.setter
    def num_states(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def seed(self) -> int: ...
    @seed.setter
    def seed(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class WordRecognizerOptions:
    """
    Options of WordRecognizer.
    """

    __hash__: typing.ClassVar[None] = None
    activity: ActivityOptions
    cepstra: CepstraOptions
    level_stream: bool
    models: SequenceModelOptions
    trim: bool
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def false_reject_rate(self) -> float: ...
    @false_reject_rate.setter
    def false_reject_rate(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def floor_db(self) -> float: ...
    @floor_db.setter
    def floor_db(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def noise_copies(self) -> int: ...
    @noise_copies.setter
    def noise_copies(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def noise_high_db(self) -> float: ...
    @noise_high_db.setter
    def noise_high_db(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def noise_low_db(self) -> float: ...
    @noise_low_db.setter
    def noise_low_db(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def num_warps(self) -> int: ...
    @num_warps.setter
    def num_warps(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def warp_step(self) -> float: ...
    @warp_step.setter
    def warp_step(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class WordRecognizer:
    """
    Isolated words; hri.WordRecognizer wraps it.
    """
    @staticmethod
    def from_model_file(file: ModelFile) -> WordRecognizer: ...
    @staticmethod
    def load(path: str) -> WordRecognizer: ...
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
    def save(self, path: str) -> None: ...
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
    def labels(self) -> list[str]: ...
    @property
    def options(self) -> WordRecognizerOptions: ...
    @property
    def threshold(self) -> float:
        """
        Score from which a word is recognised.
        """

class GestureSource:
    """
    Members:

      silhouettes

      landmarks
    """

    __members__: typing.ClassVar[dict[str, GestureSource]]
    landmarks: typing.ClassVar[GestureSource]
    silhouettes: typing.ClassVar[GestureSource]
    @typing.overload
    def __eq__(self, other: GestureSource) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: GestureSource) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class GestureModel:
    """
    Members:

      svm

      bayes

      knn

      hmm

      ptbhmm

      trajectory

      rbf

      automatic
    """

    __members__: typing.ClassVar[dict[str, GestureModel]]
    automatic: typing.ClassVar[GestureModel]
    bayes: typing.ClassVar[GestureModel]
    hmm: typing.ClassVar[GestureModel]
    knn: typing.ClassVar[GestureModel]
    ptbhmm: typing.ClassVar[GestureModel]
    rbf: typing.ClassVar[GestureModel]
    svm: typing.ClassVar[GestureModel]
    trajectory: typing.ClassVar[GestureModel]
    @typing.overload
    def __eq__(self, other: GestureModel) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: GestureModel) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class GestureRecognizerOptions:
    """
    Options of GestureRecognizer.
    """

    __hash__: typing.ClassVar[None] = None
    features: HandFeatureOptions
    hands: HandFinderOptions
    model: GestureModel
    source: GestureSource
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def false_reject_rate(self) -> float: ...
    @false_reject_rate.setter
    def false_reject_rate(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_iterations(self) -> int: ...
    @max_iterations.setter
    def max_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def min_quality(self) -> float: ...
    @min_quality.setter
    def min_quality(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def num_codewords(self) -> int: ...
    @num_codewords.setter
    def num_codewords(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_components(self) -> int: ...
    @num_components.setter
    def num_components(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_neighbours(self) -> int: ...
    @num_neighbours.setter
    def num_neighbours(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_states(self) -> int: ...
    @num_states.setter
    def num_states(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def rbf_cost(self) -> float: ...
    @rbf_cost.setter
    def rbf_cost(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def rbf_sharpness(self) -> float: ...
    @rbf_sharpness.setter
    def rbf_sharpness(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def seed(self) -> int: ...
    @seed.setter
    def seed(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def svm_cost(self) -> float: ...
    @svm_cost.setter
    def svm_cost(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

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
    @property
    def num_features(self) -> int: ...

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
    def load(path: str) -> GestureRecognizer: ...
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
    def save(self, path: str) -> None: ...
    def scores(
        self, features: typing.Annotated[numpy.typing.ArrayLike, numpy.float32]
    ) -> numpy.typing.NDArray[numpy.float32]: ...
    def to_model_file(self) -> ModelFile: ...
    @property
    def is_dynamic(self) -> bool: ...
    @property
    def labels(self) -> list[str]: ...
    @property
    def options(self) -> GestureRecognizerOptions: ...
    @property
    def pauses(self) -> bool: ...
    @property
    def starts_at_rest(self) -> bool: ...

class SpeakerAdapterOptions:
    """
    Options of SpeakerAdapter.
    """

    __hash__: typing.ClassVar[None] = None
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def max_words(self) -> int: ...
    @max_words.setter
    def max_words(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def num_iterations(self) -> int: ...
    @num_iterations.setter
    def num_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def prior_frames(self) -> float: ...
    @prior_frames.setter
    def prior_frames(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def shared_frames(self) -> float: ...
    @shared_frames.setter
    def shared_frames(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def trusted_share(self) -> float: ...
    @trusted_share.setter
    def trusted_share(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def words_per_label(self) -> float: ...
    @words_per_label.setter
    def words_per_label(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

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

class GestureSegmenterOptions:
    """
    When a gesture begins and ends; times in seconds.
    """

    __hash__: typing.ClassVar[None] = None
    arrivals: bool
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __init__(self, **kwargs) -> None: ...
    def __repr__(self) -> str: ...
    def as_dict(self) -> dict: ...
    @property
    def appear_s(self) -> float: ...
    @appear_s.setter
    def appear_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def compare_s(self) -> float: ...
    @compare_s.setter
    def compare_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def context_s(self) -> float: ...
    @context_s.setter
    def context_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def leave_s(self) -> float: ...
    @leave_s.setter
    def leave_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_gesture_s(self) -> float: ...
    @max_gesture_s.setter
    def max_gesture_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def min_gesture_s(self) -> float: ...
    @min_gesture_s.setter
    def min_gesture_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def rest_s(self) -> float: ...
    @rest_s.setter
    def rest_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def still_change(self) -> float: ...
    @still_change.setter
    def still_change(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def take_away_s(self) -> float: ...
    @take_away_s.setter
    def take_away_s(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class GestureSegmentKind:
    """
    Members:

      none

      start

      end

      dropped
    """

    __members__: typing.ClassVar[dict[str, GestureSegmentKind]]
    dropped: typing.ClassVar[GestureSegmentKind]
    end: typing.ClassVar[GestureSegmentKind]
    none: typing.ClassVar[GestureSegmentKind]
    start: typing.ClassVar[GestureSegmentKind]
    @typing.overload
    def __eq__(self, other: GestureSegmentKind) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: GestureSegmentKind) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class GestureSegmentReason:
    """
    Members:

      none

      rested

      left

      cut

      ended

      arrived

      stalled
    """

    __members__: typing.ClassVar[dict[str, GestureSegmentReason]]
    arrived: typing.ClassVar[GestureSegmentReason]
    cut: typing.ClassVar[GestureSegmentReason]
    ended: typing.ClassVar[GestureSegmentReason]
    left: typing.ClassVar[GestureSegmentReason]
    none: typing.ClassVar[GestureSegmentReason]
    rested: typing.ClassVar[GestureSegmentReason]
    stalled: typing.ClassVar[GestureSegmentReason]
    @typing.overload
    def __eq__(self, other: GestureSegmentReason) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: GestureSegmentReason) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class GestureSegment:
    """
    An event in a stream of masks.
    """
    @property
    def first_s(self) -> float: ...
    @property
    def from_rest(self) -> bool:
        """
        The hand rested in view before it.
        """
    @property
    def kind(self) -> typing.Any:
        """
        'none', 'start', 'end' or 'dropped'.
        """
    @property
    def last_s(self) -> float: ...
    @property
    def reason(self) -> typing.Any:
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
    def hand_away(self) -> bool: ...
    @property
    def in_gesture(self) -> bool: ...
    @property
    def may_have_begun_s(self) -> float | None: ...
    @property
    def options(self) -> GestureSegmenterOptions: ...

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
    border: Border,
    num_levels: typing.SupportsInt | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    The approximation of a level, as loud as the signal.
    """

@typing.overload
def approximate(
    x: numpy.typing.NDArray[numpy.float64],
    wavelet: str,
    border: Border,
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

def distance(
    kind: Distance,
    a: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    b: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
) -> float:
    """
    Distance of two vectors of one length.
    """

@typing.overload
def dwt(
    x: numpy.typing.NDArray[numpy.float32], wavelet: str, border: Border
) -> tuple[numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.float32]]:
    """
    One level: (approximation, detail), float32 or float64 as x.
    """

@typing.overload
def dwt(
    x: numpy.typing.NDArray[numpy.float64], wavelet: str, border: Border
) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
    """
    One level: (approximation, detail), float32 or float64 as x.
    """

@typing.overload
def dwt2(
    image: numpy.typing.NDArray[numpy.float32], wavelet: str, border: Border
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
    image: numpy.typing.NDArray[numpy.float64], wavelet: str, border: Border
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
    (first, last) sample of the word, or None where nobody speaks.
    """

def frequency_order(level: typing.SupportsInt | typing.SupportsIndex) -> list[int]:
    """
    Natural indices of a level's nodes by rising frequency.
    """

def hand_place(mask: typing.Annotated[numpy.typing.ArrayLike, numpy.uint8]) -> typing.Any:
    """
    x, y and area of the hand in shares of the picture; None without one.
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
    border: Border,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    The inverse of one level.
    """

@typing.overload
def idwt(
    approx: numpy.typing.NDArray[numpy.float64],
    detail: numpy.typing.NDArray[numpy.float64],
    wavelet: str,
    border: Border,
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
    border: Border,
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
    border: Border,
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

def orientation_histogram(
    image: typing.Annotated[numpy.typing.ArrayLike, numpy.float32], options: OrientationHistogramOptions = ...
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Block-normalised histograms, float32.
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

def read_wav(path: str) -> Wav:
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
    border: Border,
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
    border: Border,
) -> numpy.typing.NDArray[numpy.float64]:
    """
    The signal from the nodes of a basis.
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
    shape: ThresholdShape,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    Details with a threshold applied.
    """

@typing.overload
def shrink(
    details: numpy.typing.NDArray[numpy.float64],
    threshold: typing.SupportsFloat | typing.SupportsIndex,
    shape: ThresholdShape,
) -> numpy.typing.NDArray[numpy.float64]:
    """
    Details with a threshold applied.
    """

@typing.overload
def shrinkage_threshold(
    details: numpy.typing.NDArray[numpy.float32],
    noise: typing.SupportsFloat | typing.SupportsIndex,
    num_samples: typing.SupportsInt | typing.SupportsIndex,
    rule: ThresholdRule,
) -> float:
    """
    The threshold for the details of one level.
    """

@typing.overload
def shrinkage_threshold(
    details: numpy.typing.NDArray[numpy.float64],
    noise: typing.SupportsFloat | typing.SupportsIndex,
    num_samples: typing.SupportsInt | typing.SupportsIndex,
    rule: ThresholdRule,
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

@typing.overload
def wavedec(
    x: numpy.typing.NDArray[numpy.float32],
    wavelet: str,
    border: Border,
    num_levels: typing.SupportsInt | typing.SupportsIndex,
) -> list:
    """
    Several levels, [approximation, coarsest detail, ..., finest detail].
    """

@typing.overload
def wavedec(
    x: numpy.typing.NDArray[numpy.float64],
    wavelet: str,
    border: Border,
    num_levels: typing.SupportsInt | typing.SupportsIndex,
) -> list:
    """
    Several levels, [approximation, coarsest detail, ..., finest detail].
    """

@typing.overload
def wavedec2(
    image: numpy.typing.NDArray[numpy.float32],
    wavelet: str,
    border: Border,
    num_levels: typing.SupportsInt | typing.SupportsIndex,
) -> list:
    """
    Several levels of an image, [approximation, coarsest details, ..., finest details].
    """

@typing.overload
def wavedec2(
    image: numpy.typing.NDArray[numpy.float64],
    wavelet: str,
    border: Border,
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
    border: Border,
    num_levels: typing.SupportsInt | typing.SupportsIndex,
) -> list:
    """
    Nodes of all levels, the signal's first, in natural order.
    """

@typing.overload
def wavelet_packets(
    x: numpy.typing.NDArray[numpy.float64],
    wavelet: str,
    border: Border,
    num_levels: typing.SupportsInt | typing.SupportsIndex,
) -> list:
    """
    Nodes of all levels, the signal's first, in natural order.
    """

@typing.overload
def waverec(
    coefficients: list[numpy.typing.NDArray[numpy.float32]],
    wavelet: str,
    border: Border,
    num_samples: typing.SupportsInt | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.float32]:
    """
    The inverse of wavedec.
    """

@typing.overload
def waverec(
    coefficients: list[numpy.typing.NDArray[numpy.float64]],
    wavelet: str,
    border: Border,
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
    border: Border,
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
    border: Border,
    shape: tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex],
) -> numpy.typing.NDArray[numpy.float64]:
    """
    The inverse of wavedec2.
    """

def write_wav_pcm16(
    path: str,
    samples: typing.Annotated[numpy.typing.ArrayLike, numpy.float32],
    sample_rate_hz: typing.SupportsInt | typing.SupportsIndex,
) -> None: ...

HAND_TRACK_COLUMNS: tuple = ("x", "y", "log_area", "axis_cosine", "axis_sine", "speed", "move_cosine", "move_sine")
LEARNED_STILL_CHANGE: float = 0.12
NUM_LANDMARKS: int = 21
__version__: str = "0.1.0"
