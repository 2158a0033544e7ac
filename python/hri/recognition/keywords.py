# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
# Written by tools/generate_option_tables.py from the compiled module; do not edit.
"""Keywords of the recognisers, as type checkers read them; what each does stands in the class named after it."""

from __future__ import annotations

from typing import Literal, TypedDict

from hri import _native


class CepstraKeywords(TypedDict, total=False):
    """Fields of `CepstraOptions`."""

    sample_rate_hz: int
    frame_length_ms: float
    frame_shift_ms: float
    padding: Literal["none", "centred"]
    sample_scale: float
    remove_dc: bool
    pre_emphasis: float
    frame_pre_emphasis: bool
    window: Literal["hamming", "hann", "hann_periodic", "povey", "rectangular"]
    fft_size: int
    kind: Literal["filter_bank", "linear_prediction"]
    lpc_order: int
    filter_bank: Literal["mel", "hfcc"]
    num_filters: int
    low_hz: float
    high_hz: float
    erb_factor: float
    warp: float
    warp_low_hz: float
    warp_high_hz: float
    mel_scale: Literal["htk", "slaney"]
    filter_axis: Literal["hz", "mel"]
    unit_area: bool
    use_power: bool
    energy_floor: float
    decibels: bool
    top_db: float
    num_cepstra: int
    use_c0: bool
    use_energy: bool
    htk_c0: bool
    lifter: float
    rasta_pole: float
    normalisation: Literal["none", "level", "mean", "mean_variance", "running_mean", "running_mean_variance"]
    running_s: float
    delta_orders: int
    delta_window: int


class ActivityKeywords(TypedDict, total=False):
    """Fields of `ActivityOptions`."""

    frame_ms: float
    shift_ms: float
    silence_dbfs: float
    margin_db: float
    max_depth_db: float
    min_voicing: float
    max_gap_ms: float
    padding_ms: float


class SequenceNetworkKeywords(TypedDict, total=False):
    """Fields of `SequenceNetworkOptions`."""

    num_channels: int
    num_blocks: int
    num_epochs: int
    batch_size: int
    learning_rate: float
    weight_decay: float
    dropout: float
    label_smoothing: float
    seed: int


class WordRecognizerKeywords(TypedDict, total=False):
    """Fields of `WordRecognizerOptions`."""

    model: Literal["hmm", "ptbhmm"]
    num_states: int
    num_mixtures: int
    num_codewords: int
    garbage_mixtures: int
    max_iterations: int
    seed: int
    front_end: Literal["cepstra", "both", "embedding"]
    cepstra: _native.CepstraOptions | CepstraKeywords
    activity: _native.ActivityOptions | ActivityKeywords
    trim: bool
    noise_floor_db: float
    level_stream: bool
    num_vtlp_factors: int
    vtlp_step: float
    num_noisy_copies: int
    min_snr_db: float
    max_snr_db: float
    false_reject_rate: float
    num_embedding_copies: int
    embedding_weight: float
    embedding_penalty: float
    embedding_shrinkage: float
    embedding_false_accept_rate: float
    use_network: bool
    network: _native.SequenceNetworkOptions | SequenceNetworkKeywords
    network_weight: float


class SilhouetteKeywords(TypedDict, total=False):
    """Fields of `SilhouetteOptions`."""

    method: Literal["chroma_otsu", "hsv_narrow", "hsv_wide", "grey_otsu"]
    max_side_px: int
    blur_px: int
    min_contrast: float
    sure_contrast: float
    min_quality: float
    min_area: float
    max_area: float
    remove_face: bool
    max_hands: int


class HandColourKeywords(TypedDict, total=False):
    """Fields of `HandColourOptions`."""

    max_side_px: int
    fit_side_px: int
    num_fit_frames: int
    num_rounds: int
    min_area: float
    max_area: float
    min_quality: float
    remove_still: bool
    max_hands: int


class MaskSmoothingKeywords(TypedDict, total=False):
    """Fields of `MaskSmoothingOptions`."""

    max_gap: int
    min_agreement: float
    max_overlap: float


class HandFinderKeywords(TypedDict, total=False):
    """Fields of `HandFinderOptions`."""

    learning: Literal["automatic", "never"]
    min_frames: int
    silhouette: _native.SilhouetteOptions | SilhouetteKeywords
    colours: _native.HandColourOptions | HandColourKeywords
    smooth: bool
    smoothing: _native.MaskSmoothingOptions | MaskSmoothingKeywords


class OrientationHistogramKeywords(TypedDict, total=False):
    """Fields of `OrientationHistogramOptions`."""

    num_cells: int
    num_bins: int


class SilhouetteCepstrumKeywords(TypedDict, total=False):
    """Fields of `SilhouetteCepstrumOptions`."""

    wavelet: str
    num_levels: int
    mask_px: int
    signal: Literal["contour", "picture"]
    num_points: int
    num_frames: int
    average_frames: bool
    num_filters: int
    num_cepstra: int


class WaveletDescriptorKeywords(TypedDict, total=False):
    """Fields of `WaveletDescriptorOptions`."""

    source: Literal["silhouette", "contour"]
    num_scales: int
    num_frequencies: int


class FourierDescriptorKeywords(TypedDict, total=False):
    """Fields of `FourierDescriptorOptions`."""

    num_points: int
    num_harmonics: int
    use_phase: bool


class ChainCodeKeywords(TypedDict, total=False):
    """Fields of `ChainCodeOptions`."""

    num_parts: int
    use_turns: bool


class HandFeatureKeywords(TypedDict, total=False):
    """Fields of `HandFeatureOptions`."""

    crop_px: int
    histogram: _native.OrientationHistogramOptions | OrientationHistogramKeywords
    use_grey: bool
    use_silhouette: bool
    use_cepstrum: bool
    cepstrum: _native.SilhouetteCepstrumOptions | SilhouetteCepstrumKeywords
    cepstrum_weight: float
    use_wavelet: bool
    wavelet: _native.WaveletDescriptorOptions | WaveletDescriptorKeywords
    use_moments: bool
    use_fourier: bool
    fourier: _native.FourierDescriptorOptions | FourierDescriptorKeywords
    use_chain_code: bool
    chain_code: _native.ChainCodeOptions | ChainCodeKeywords
    descriptor_weight: float


class GestureRecognizerKeywords(TypedDict, total=False):
    """Fields of `GestureRecognizerOptions`."""

    source: Literal["silhouettes", "landmarks"]
    num_hands: int
    relation_weight: float
    hands: _native.HandFinderOptions | HandFinderKeywords
    use_faces: bool
    min_quality: float
    features: _native.HandFeatureOptions | HandFeatureKeywords
    model: Literal["svm", "bayes", "knn", "hmm", "ptbhmm", "trajectory", "rbf", "automatic"]
    svm_cost: float
    turn_degrees: float
    rbf_cost: float
    rbf_sharpness: float
    num_components: int
    num_neighbours: int
    num_states: int
    num_codewords: int
    max_iterations: int
    false_reject_rate: float
    seed: int


class SpeakerAdapterKeywords(TypedDict, total=False):
    """Fields of `SpeakerAdapterOptions`."""

    words_per_label: float
    shared_frames: float
    prior_frames: float
    num_iterations: int
    trusted_share: float
    max_words: int


class SpeechEmbeddingKeywords(TypedDict, total=False):
    """Fields of `SpeechEmbeddingOptions`."""

    trim: bool
    activity: _native.ActivityOptions | ActivityKeywords
    level: float
    noise_floor_db: float
    padding_s: float
    rows_per_step: int
    num_pieces: int


class ConnectedDecoderKeywords(TypedDict, total=False):
    """Fields of `ConnectedDecoderOptions`."""

    beam: float
    language_scale: float
    insertion_penalty: float
    max_open_words: int


class LatticeKeywords(TypedDict, total=False):
    """Fields of `LatticeOptions`."""

    beam: float
    max_arcs: int


class ConnectedWordRecognizerKeywords(TypedDict, total=False):
    """Fields of `ConnectedWordRecognizerOptions`."""

    words: _native.WordRecognizerOptions | WordRecognizerKeywords
    silence_states: int
    silence_mixtures: int
    max_words: int
    max_pause_ms: float
    num_alignments: int
    choose_penalty: bool
    confidence_scale: float
    min_confidence: float
    unknown_words: bool
    unknown_rank: int
    unknown_lead: float
    unknown_margin: float
    decoder: _native.ConnectedDecoderOptions | ConnectedDecoderKeywords
    lattice: _native.LatticeOptions | LatticeKeywords


class TwoHandFeatureKeywords(TypedDict, total=False):
    """Fields of `TwoHandFeatureOptions`."""

    use_left: bool
    use_polar: bool
    use_relation: bool
    delta_orders: int
    delta_window: int


class SentenceRecognizerKeywords(TypedDict, total=False):
    """Fields of `SentenceRecognizerOptions`."""

    input: Literal["tracks", "rows"]
    features: _native.TwoHandFeatureOptions | TwoHandFeatureKeywords
    model: Literal["hmm", "ptbhmm"]
    num_codewords: int
    frames_per_state: int
    max_states: int
    max_iterations: int
    margin_frames: int
    max_variant_frames: int
    variant_weight: float
    variant_variance: float
    between_states: int
    between_mixtures: int
    language_order: int
    choose_weights: bool
    known_language_scale: float
    decoder: _native.ConnectedDecoderOptions | ConnectedDecoderKeywords
    seed: int


class SentenceStreamKeywords(TypedDict, total=False):
    """Fields of `SentenceStreamOptions`."""

    appear_s: float
    rest_s: float
    leave_s: float
    still_change: float
    compare_s: float
    context_s: float
    max_sentence_s: float
    partial_s: float
    partial_share: float
    num_agreeing: int
    scale_px: float


class SubwordRecognizerKeywords(TypedDict, total=False):
    """Fields of `SubwordRecognizerOptions`."""

    words: _native.WordRecognizerOptions | WordRecognizerKeywords
    num_states: int
    num_mixtures: int
    num_passes: int
    variance_floor: float
    num_folds: int
    false_reject_rate: float
    num_word_folds: int
    unrecorded_bonus: float
    prior_frames: float
    num_adaptations: int
