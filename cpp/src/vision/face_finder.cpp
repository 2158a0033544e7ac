// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/face_finder.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <opencv2/objdetect.hpp>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/io/file.hpp"
#include "vision/pictures.hpp"

namespace hri {

struct FaceFinder::Cascade {
  std::mutex mutex;  // OpenCV keeps its working memory in the classifier
  cv::CascadeClassifier classifier;
};

FaceFinder::FaceFinder(const std::string& cascade_path, const FaceFinderOptions& options)
    : options_(validated(options)), cascade_(std::make_shared<Cascade>()) {
  require_regular_file(cascade_path);
  bool loaded = false;
  try {
    loaded = cascade_->classifier.load(cascade_path);
    // NOLINTNEXTLINE(bugprone-empty-catch): it parses what is no XML, or other XML, by throwing
  } catch (const cv::Exception&) {
  }
  if (!loaded || cascade_->classifier.empty())
    fail(ErrorKind::format, cascade_path + ": not a cascade of classifiers that OpenCV reads");
}

std::optional<Face> FaceFinder::find(ImageView bgr) const {
  require(!bgr.empty() && bgr.channels == 3,
          "picture must have three channels and at least one pixel");
  const cv::Mat small = detail::scaled_down(detail::as_mat(bgr), options_.max_side_px);
  cv::Mat grey;
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  const int least =
      std::max(1, static_cast<int>(options_.min_side * std::max(small.cols, small.rows)));
  std::vector<cv::Rect> found;
  std::vector<int> neighbours;
  {
    const std::lock_guard<std::mutex> lock(cascade_->mutex);
    cascade_->classifier.detectMultiScale(grey, found, neighbours, options_.scale_step,
                                          options_.min_neighbours, 0, cv::Size(least, least));
  }
  if (found.empty()) return std::nullopt;
  const auto best = std::max_element(neighbours.begin(), neighbours.end()) - neighbours.begin();
  const cv::Rect& box = found[static_cast<std::size_t>(best)];
  const double scale = bgr.width_px / static_cast<double>(small.cols);
  return Face{box.x * scale, box.y * scale, box.width * scale};
}

}  // namespace hri
