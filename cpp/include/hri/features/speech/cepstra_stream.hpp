// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Cepstra of audio that comes in blocks of any size: the same numbers, to the bit, as from the
// whole utterance.
#pragma once

#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/features/speech/cepstra.hpp"

namespace hri {

/// For one thread at a time. Frames come out as soon as they are complete; deltas make them
/// delta_orders * delta_window frames late.
class HRI_API CepstraStream {
 public:
  /// Throws InvalidArgument as CepstraComputer does, and for what needs the whole utterance:
  /// normalisation other than none or a running one, top_db.
  explicit CepstraStream(const CepstraOptions& options);

  [[nodiscard]] const CepstraOptions& options() const { return computer_.options(); }
  [[nodiscard]] int num_features() const { return computer_.num_features(); }
  /// The most frames that a push of so many samples gives, or finish() after it.
  [[nodiscard]] int max_frames(std::size_t num_samples) const;

  /// Takes `audio` in, writes the frames that are now complete into the first rows of `out`
  /// (max_frames(audio.size()) rows, num_features() columns) and gives their number. Throws
  /// InvalidArgument for a sample that is not finite (names it), before anything is taken in.
  /// Allocates nothing after the first push of a thread.
  int push(Span<const float> audio, MatrixRefF out);
  /// The frames that are left (max_frames(0) rows), and reset().
  int finish(MatrixRefF out, bool keep_normalisation = false);
  /// Forgets the utterance. With `keep_normalisation`, running means and deviations go on: what was
  /// learned of the channel stays.
  void reset(bool keep_normalisation = false);

 private:
  void begin(float first_sample);
  int take(const float* samples, std::size_t count, MatrixRefF out, int written);
  int add_frames(MatrixRefF out, int written);
  int advance(bool ended, MatrixRefF out, int written);
  float* row(std::ptrdiff_t t);  // of frame t

  CepstraComputer computer_;
  bool started_ = false;
  std::vector<float> buffer_;  // audio that frames still need
  std::size_t next_ = 0;       // where in it the next frame begins, with the sample before it
  std::vector<const float*> frames_;
  MatrixF statics_;  // of the frames of one go
  RastaFilter rasta_;
  RunningNormaliser normaliser_;
  MatrixF recent_;                    // the last frames, in a ring
  std::vector<std::ptrdiff_t> done_;  // frames whose statics, deltas, ... are known
  std::ptrdiff_t given_ = 0;          // frames that went out
};

}  // namespace hri
