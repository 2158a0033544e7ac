// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The concatenated features of one hand picture: orientation histograms of the grey crop and of its
// silhouette, the silhouette cepstrum (DWT + MFCC, thesis chapter 3), and descriptors of the shape.
// Works on plain pixels, without OpenCV.
#pragma once

#include <optional>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/features/hand/chain_code.hpp"
#include "hri/features/hand/fourier_descriptor.hpp"
#include "hri/features/hand/hand_crop.hpp"
#include "hri/features/hand/orientation_histogram.hpp"
#include "hri/features/hand/silhouette_cepstrum.hpp"
#include "hri/features/hand/wavelet_descriptor.hpp"

namespace hri {

struct HRI_API HandFeatureOptions {
  int crop_px = 64;
  OrientationHistogramOptions histogram;
  bool use_grey = true;
  bool use_silhouette = true;
  bool use_cepstrum = true;
  SilhouetteCepstrumOptions cepstrum;
  double cepstrum_weight = 0.1;
  bool use_wavelet = false;
  WaveletDescriptorOptions wavelet;
  bool use_moments = false;
  bool use_fourier = false;
  FourierDescriptorOptions fourier;
  bool use_chain_code = false;
  ChainCodeOptions chain_code;
  double descriptor_weight = 1.0;

  static constexpr const char* kName = "HandFeatureOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("crop_px", o.crop_px, within(16, 256), "side of the square that the hand is scaled to");
    v("histogram", o.histogram, any_value, "cells and bins of the orientation histograms");
    v("use_grey", o.use_grey, any_value,
      "histogram of the grey crop (square root of grey, against uneven light)");
    v("use_silhouette", o.use_silhouette, any_value, "histogram of the mask crop");
    v("use_cepstrum", o.use_cepstrum, any_value, "cepstrum of the silhouette");
    v("cepstrum", o.cepstrum, any_value, "options of the cepstrum");
    v("cepstrum_weight", o.cepstrum_weight, above(0, 1e6),
      "scale of the cepstrum beside the histograms, which are blocks of length 1");
    v("use_wavelet", o.use_wavelet, any_value, "moment-invariant wavelet descriptor of the mask");
    v("wavelet", o.wavelet, any_value, "options of the wavelet descriptor");
    v("use_moments", o.use_moments, any_value, "roots of Hu's moments of the mask");
    v("use_fourier", o.use_fourier, any_value, "Fourier descriptor of the outline");
    v("fourier", o.fourier, any_value, "options of the Fourier descriptor");
    v("use_chain_code", o.use_chain_code, any_value, "chain-code histograms of the outline");
    v("chain_code", o.chain_code, any_value, "options of the chain code");
    v("descriptor_weight", o.descriptor_weight, above(0, 1e6),
      "length that each of these four descriptors is scaled to; they leave out the forearm that "
      "hand_box() cuts off");
  }
  /// nullptr, or which fields do not go together.
  [[nodiscard]] const char* conflict() const;
};

/// Immutable; const calls are safe from several threads.
class HRI_API HandFeatureComputer {
 public:
  /// Throws InvalidArgument naming the field that is out of range, or when every part is turned
  /// off.
  explicit HandFeatureComputer(const HandFeatureOptions& options);

  [[nodiscard]] int num_features() const { return num_features_; }
  [[nodiscard]] const HandFeatureOptions& options() const { return options_; }

  /// `grey` and `mask` (0 or 255) are one-channel images of one size. Throws InvalidArgument for an
  /// empty mask.
  void compute(ImageView grey, ImageView mask, Span<float> out) const;
  [[nodiscard]] VectorF compute(ImageView grey, ImageView mask) const;

 private:
  [[nodiscard]] std::size_t compute_pictures(ImageView grey, ImageView mask, const HandBox& box,
                                             Span<float> out) const;
  void compute_descriptors(ImageView mask, Span<float> out) const;

  HandFeatureOptions options_;
  SilhouetteCepstrumComputer cepstrum_;
  std::optional<WaveletDescriptorComputer> wavelet_;  // its table takes time: only where it is used
  FourierDescriptorComputer fourier_;
  ChainCodeComputer chain_code_;
  int num_features_ = 0;
};

}  // namespace hri
