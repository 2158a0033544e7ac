// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The fields of the options structs, each named once, so that writing and reading a model file
// cannot drift apart. `visit(v, options)` calls v("name", field) for every field; nested structs
// are visited by visit_nested.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "hri/core/error.hpp"
#include "hri/features/speech/cepstra.hpp"
#include "hri/io/model_file.hpp"
#include "hri/recognition/gesture/gesture_recognizer.hpp"
#include "hri/recognition/word/word_recognizer.hpp"

namespace hri::detail {

template <class V, class O>
void visit_cepstra(V&& v, O& o) {
  v("cepstra.sample_rate_hz", o.sample_rate_hz);
  v("cepstra.frame_length_ms", o.frame_length_ms);
  v("cepstra.frame_shift_ms", o.frame_shift_ms);
  v("cepstra.padding", o.padding);
  v("cepstra.sample_scale", o.sample_scale);
  v("cepstra.remove_dc", o.remove_dc);
  v("cepstra.pre_emphasis", o.pre_emphasis);
  v("cepstra.frame_pre_emphasis", o.frame_pre_emphasis);
  v("cepstra.window", o.window);
  v("cepstra.fft_size", o.fft_size);
  v("cepstra.kind", o.kind);
  v("cepstra.lpc_order", o.lpc_order);
  v("cepstra.filter_bank", o.filter_bank);
  v("cepstra.num_filters", o.num_filters);
  v("cepstra.low_hz", o.low_hz);
  v("cepstra.high_hz", o.high_hz);
  v("cepstra.erb_factor", o.erb_factor);
  v("cepstra.warp", o.warp);
  v("cepstra.warp_low_hz", o.warp_low_hz);
  v("cepstra.warp_high_hz", o.warp_high_hz);
  v("cepstra.mel_scale", o.mel_scale);
  v("cepstra.filter_axis", o.filter_axis);
  v("cepstra.unit_area", o.unit_area);
  v("cepstra.use_power", o.use_power);
  v("cepstra.energy_floor", o.energy_floor);
  v("cepstra.decibels", o.decibels);
  v("cepstra.top_db", o.top_db);
  v("cepstra.num_cepstra", o.num_cepstra);
  v("cepstra.use_c0", o.use_c0);
  v("cepstra.use_energy", o.use_energy);
  v("cepstra.htk_c0", o.htk_c0);
  v("cepstra.lifter", o.lifter);
  v("cepstra.rasta_pole", o.rasta_pole);
  v("cepstra.normalisation", o.normalisation);
  v("cepstra.running_s", o.running_s);
  v("cepstra.delta_orders", o.delta_orders);
  v("cepstra.delta_window", o.delta_window);
}

template <class V, class O>
void visit_activity(V&& v, O& o) {
  v("activity.frame_ms", o.frame_ms);
  v("activity.shift_ms", o.shift_ms);
  v("activity.silence_dbfs", o.silence_dbfs);
  v("activity.margin_db", o.margin_db);
  v("activity.max_depth_db", o.max_depth_db);
  v("activity.min_voicing", o.min_voicing);
  v("activity.max_gap_ms", o.max_gap_ms);
  v("activity.padding_ms", o.padding_ms);
}

template <class V, class O>
void visit_word(V&& v, O& o) {
  visit_cepstra(v, o.cepstra);
  visit_activity(v, o.activity);
  v("models.model", o.models.model);
  v("models.num_states", o.models.num_states);
  v("models.num_mixtures", o.models.num_mixtures);
  v("models.num_codewords", o.models.num_codewords);
  v("models.garbage_mixtures", o.models.garbage_mixtures);
  v("models.max_iterations", o.models.max_iterations);
  v("models.seed", o.models.seed);
  v("trim", o.trim);
  v("floor_db", o.floor_db);
  v("level_stream", o.level_stream);
  v("num_warps", o.num_warps);
  v("warp_step", o.warp_step);
  v("noise_copies", o.noise_copies);
  v("noise_low_db", o.noise_low_db);
  v("noise_high_db", o.noise_high_db);
  v("false_reject_rate", o.false_reject_rate);
}

template <class V, class O>
void visit_descriptors(V&& v, O& o) {
  v("features.use_wavelet", o.features.use_wavelet);
  v("features.wavelet.source", o.features.wavelet.source);
  v("features.wavelet.num_scales", o.features.wavelet.num_scales);
  v("features.wavelet.num_frequencies", o.features.wavelet.num_frequencies);
  v("features.use_fourier", o.features.use_fourier);
  v("features.fourier.num_points", o.features.fourier.num_points);
  v("features.fourier.num_harmonics", o.features.fourier.num_harmonics);
  v("features.fourier.use_phase", o.features.fourier.use_phase);
  v("features.use_chain_code", o.features.use_chain_code);
  v("features.chain_code.num_parts", o.features.chain_code.num_parts);
  v("features.chain_code.use_turns", o.features.chain_code.use_turns);
  v("features.use_moments", o.features.use_moments);
  v("features.descriptor_weight", o.features.descriptor_weight);
}

template <class V, class O>
void visit_gesture(V&& v, O& o) {
  v("features.crop_px", o.features.crop_px);
  v("features.histogram.num_cells", o.features.histogram.num_cells);
  v("features.histogram.num_bins", o.features.histogram.num_bins);
  v("features.use_grey", o.features.use_grey);
  v("features.use_silhouette", o.features.use_silhouette);
  v("features.use_cepstrum", o.features.use_cepstrum);
  v("features.cepstrum.wavelet", o.features.cepstrum.wavelet);
  v("features.cepstrum.num_levels", o.features.cepstrum.num_levels);
  v("features.cepstrum.mask_px", o.features.cepstrum.mask_px);
  v("features.cepstrum.num_points", o.features.cepstrum.num_points);
  v("features.cepstrum.num_filters", o.features.cepstrum.num_filters);
  v("features.cepstrum.num_cepstra", o.features.cepstrum.num_cepstra);
  v("features.cepstrum_weight", o.features.cepstrum_weight);
  visit_descriptors(v, o);
  v("source", o.source);
  v("model", o.model);
  v("svm_cost", o.svm_cost);
  v("rbf_cost", o.rbf_cost);
  v("rbf_sharpness", o.rbf_sharpness);
  v("num_components", o.num_components);
  v("num_neighbours", o.num_neighbours);
  v("num_states", o.num_states);
  v("num_codewords", o.num_codewords);
  v("max_iterations", o.max_iterations);
  v("false_reject_rate", o.false_reject_rate);
  v("seed", o.seed);
}

/// Files written before recognisers owned their finder's options have none of these.
template <class V, class O>
void visit_hands(V&& v, O& o) {
  v("min_quality", o.min_quality);
  v("hands.learning", o.hands.learning);
  v("hands.min_frames", o.hands.min_frames);
  v("hands.silhouette.method", o.hands.silhouette.method);
  v("hands.silhouette.max_side_px", o.hands.silhouette.max_side_px);
  v("hands.silhouette.blur_px", o.hands.silhouette.blur_px);
  v("hands.silhouette.min_contrast", o.hands.silhouette.min_contrast);
  v("hands.silhouette.sure_contrast", o.hands.silhouette.sure_contrast);
  v("hands.silhouette.min_quality", o.hands.silhouette.min_quality);
  v("hands.silhouette.min_area", o.hands.silhouette.min_area);
  v("hands.silhouette.max_area", o.hands.silhouette.max_area);
  v("hands.silhouette.remove_face", o.hands.silhouette.remove_face);
  v("hands.silhouette.max_hands", o.hands.silhouette.max_hands);
  v("hands.colours.max_side_px", o.hands.colours.max_side_px);
  v("hands.colours.fit_side_px", o.hands.colours.fit_side_px);
  v("hands.colours.num_fit_frames", o.hands.colours.num_fit_frames);
  v("hands.colours.num_rounds", o.hands.colours.num_rounds);
  v("hands.colours.min_area", o.hands.colours.min_area);
  v("hands.colours.max_area", o.hands.colours.max_area);
  v("hands.colours.min_quality", o.hands.colours.min_quality);
  v("hands.colours.remove_still", o.hands.colours.remove_still);
  v("hands.colours.max_hands", o.hands.colours.max_hands);
  v("hands.smooth", o.hands.smooth);
  v("hands.smoothing.max_gap", o.hands.smoothing.max_gap);
  v("hands.smoothing.min_agreement", o.hands.smoothing.min_agreement);
  v("hands.smoothing.max_overlap", o.hands.smoothing.max_overlap);
}

/// Visitor that writes every field into a model file's metadata.
struct FieldWriter {
  ModelFile& file;
  template <class T>
  void operator()(const char* name, const T& field) const {
    if constexpr (std::is_same_v<T, std::string>) {
      file.set_text(name, field);
    } else if constexpr (std::is_floating_point_v<T>) {
      file.set_number(name, static_cast<double>(field));
    } else {
      file.set_integer(name, static_cast<std::int64_t>(field));
    }
  }
};

/// Visitor that reads every field back; range checks stay with the classes that use the options.
struct FieldReader {
  const ModelFile& file;
  template <class T>
  void operator()(const char* name, T& field) const {
    if constexpr (std::is_same_v<T, std::string>) {
      field = file.text(name);
    } else if constexpr (std::is_floating_point_v<T>) {
      field = static_cast<T>(file.number(name));
    } else {
      const std::int64_t value = file.integer(name);
      field = static_cast<T>(value);
      if (static_cast<std::int64_t>(field) != value ||
          (std::is_enum_v<T> && (value < 0 || value > 7))) {
        fail(ErrorKind::format,
             file.name() + ": field '" + name + "' is out of range: " + std::to_string(value));
      }
    }
  }
};

}  // namespace hri::detail
