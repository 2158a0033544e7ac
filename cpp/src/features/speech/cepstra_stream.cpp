// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/speech/cepstra_stream.hpp"

#include <algorithm>
#include <array>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/signal/lanes.hpp"

namespace hri {
namespace {

constexpr std::size_t kMostDeltaFrames = 10;

CepstraOptions checked_for_stream(const CepstraOptions& o) {
  require(o.normalisation == Normalisation::none || is_running(o.normalisation),
          "normalisation of a stream must be none or a running one");
  require(o.top_db == 0, "top_db needs the whole utterance, and must be 0 for a stream");
  return o;
}

}  // namespace

CepstraStream::CepstraStream(const CepstraOptions& options)
    : computer_(checked_for_stream(options)) {
  const auto lanes = static_cast<std::size_t>(num_lanes());
  frames_.resize(lanes);
  statics_.resize(static_cast<Eigen::Index>(lanes), computer_.num_static());
  const auto shift = static_cast<std::size_t>(computer_.frame_shift());
  const auto length = static_cast<std::size_t>(computer_.frame_length());
  buffer_.reserve(2 * length + lanes * shift + 2);
  recent_.resize((options.delta_orders + 1) * options.delta_window + 2, num_features());
  done_.resize(static_cast<std::size_t>(options.delta_orders) + 1);
  reset();
}

int CepstraStream::max_frames(std::size_t num_samples) const {
  const auto shift = static_cast<std::size_t>(computer_.frame_shift());
  const auto length = static_cast<std::size_t>(computer_.frame_length());
  return static_cast<int>((num_samples + 2 * length) / shift) + 2 +
         options().delta_orders * options().delta_window;
}

void CepstraStream::reset(bool keep_normalisation) {
  started_ = false;
  buffer_.clear();
  next_ = 0;
  given_ = 0;
  std::fill(done_.begin(), done_.end(), 0);
  if (options().rasta_pole > 0) rasta_.start(computer_.num_static(), options().rasta_pole);
  if (is_running(options().normalisation) && !keep_normalisation) {
    normaliser_.start(computer_.num_static(), options().normalisation, computer_.running_frames());
  }
}

// What stands before the first sample.
void CepstraStream::begin(float first_sample) {
  started_ = true;
  if (options().padding == FramePadding::centred) {
    buffer_.assign(static_cast<std::size_t>(computer_.frame_length() / 2) + 1, 0.0F);
  } else {
    buffer_.assign(1, first_sample);
  }
}

int CepstraStream::push(Span<const float> audio, MatrixRefF out) {
  const std::size_t bad = first_not_finite(audio.data(), audio.size());
  if (bad < audio.size()) {
    fail(ErrorKind::invalid_argument, "audio is not finite at sample " + std::to_string(bad));
  }
  require(out.rows() >= max_frames(audio.size()) && out.cols() == num_features(),
          "out must have max_frames(audio.size()) rows and num_features() columns");
  if (audio.empty()) return 0;
  if (!started_) begin(audio[0]);
  return take(audio.data(), audio.size(), out, 0);
}

int CepstraStream::finish(MatrixRefF out, bool keep_normalisation) {
  require(out.rows() >= max_frames(0) && out.cols() == num_features(),
          "out must have max_frames(0) rows and num_features() columns");
  int written = 0;
  if (started_ && options().padding == FramePadding::centred) {
    const float zero = 0;
    for (int n = 0; n < computer_.frame_length() / 2; ++n) written = take(&zero, 1, out, written);
  }
  written = advance(true, out, written);
  reset(keep_normalisation);
  return written;
}

// As much at a time as gives every lane a frame.
int CepstraStream::take(const float* samples, std::size_t count, MatrixRefF out, int written) {
  while (count > 0) {
    const std::size_t part = std::min(count, buffer_.capacity() - buffer_.size());
    buffer_.insert(buffer_.end(), samples, samples + part);
    samples += part;
    count -= part;
    written = add_frames(out, written);
  }
  return written;
}

int CepstraStream::add_frames(MatrixRefF out, int written) {
  const auto shift = static_cast<std::size_t>(computer_.frame_shift());
  const auto length = static_cast<std::size_t>(computer_.frame_length()) + 1;
  for (;;) {
    std::size_t count = 0;
    for (; count < frames_.size() && next_ + length <= buffer_.size(); next_ += shift)
      frames_[count++] = buffer_.data() + next_;
    if (count == 0) break;
    computer_.compute_frames({frames_.data(), count},
                             statics_.topRows(static_cast<Eigen::Index>(count)));
    for (std::size_t i = 0; i < count; ++i) {
      const Span<float> frame(row(done_[0]), static_cast<std::size_t>(computer_.num_static()));
      const auto found = row_span(statics_, static_cast<Eigen::Index>(i));
      std::copy(found.begin(), found.end(), frame.begin());
      if (options().rasta_pole > 0) rasta_.apply(frame);
      if (is_running(options().normalisation)) normaliser_.apply(frame);
      ++done_[0];
      written = advance(false, out, written);
    }
  }
  const std::size_t used = std::min(next_, buffer_.size());
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(used));
  next_ -= used;
  return written;
}

float* CepstraStream::row(std::ptrdiff_t t) {
  return recent_.data() + t % recent_.rows() * recent_.cols();
}

// Deltas that have become possible, order by order; frames that are complete go out.
int CepstraStream::advance(bool ended, MatrixRefF out, int written) {
  const int width = computer_.num_static();
  const std::ptrdiff_t window = options().delta_window;
  for (std::size_t order = 1; order < done_.size(); ++order) {
    const std::ptrdiff_t known = done_[order - 1];
    const int first = static_cast<int>(order - 1) * width;
    for (std::ptrdiff_t& t = done_[order]; t < known && (ended || t + window < known); ++t) {
      std::array<const float*, 2 * kMostDeltaFrames + 1> around{};
      for (std::ptrdiff_t k = 0; k <= 2 * window; ++k) {
        const auto at = std::clamp<std::ptrdiff_t>(t + k - window, 0, known - 1);
        around[static_cast<std::size_t>(k)] = row(at) + first;
      }
      detail::write_delta(around.data(), options().delta_window, width, row(t) + first + width);
    }
  }
  for (; given_ < done_.back(); ++given_)
    out.row(written++) = Eigen::Map<const Eigen::RowVectorXf>(row(given_), recent_.cols());
  return written;
}

}  // namespace hri
