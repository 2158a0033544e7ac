// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The joined feature of one hand picture: orientation histograms of the grey crop and of its
// silhouette, the silhouette cepstrum (DWT + MFCC, thesis chapter 3), and descriptors of the shape.
// Works on plain pixels, without OpenCV.
#pragma once

#include <optional>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/types.hpp"
#include "hri/features/hand/chain_code.hpp"
#include "hri/features/hand/fourier_descriptor.hpp"
#include "hri/features/hand/hand_crop.hpp"
#include "hri/features/hand/orientation_histogram.hpp"
#include "hri/features/hand/silhouette_cepstrum.hpp"
#include "hri/features/hand/wavelet_descriptor.hpp"

namespace hri {

struct HandFeatureOptions {
  int crop_px = 64;                       ///< side of the square the hand is scaled to, 16..256
  OrientationHistogramOptions histogram;  ///< grid of cells and bins
  bool use_grey = true;  ///< histogram of the grey crop (square root of grey against uneven light)
  bool use_silhouette = true;  ///< histogram of the mask crop
  bool use_cepstrum = true;    ///< silhouette cepstrum
  SilhouetteCepstrumOptions cepstrum;
  double cepstrum_weight =
      0.1;  ///< scale of the cepstrum beside the histograms (blocks of length 1), > 0
  bool use_wavelet = false;  ///< moment-invariant wavelet descriptor of the mask
  WaveletDescriptorOptions wavelet;
  bool use_moments = false;  ///< roots of Hu's moments of the mask
  bool use_fourier = false;  ///< Fourier descriptor of the outline
  FourierDescriptorOptions fourier;
  bool use_chain_code = false;  ///< chain code histograms of the outline
  ChainCodeOptions chain_code;
  double descriptor_weight = 1.0;  ///< length that each of these four is scaled to, > 0; they leave
                                   ///< out the forearm that hand_box() cuts off
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
