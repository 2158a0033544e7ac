// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/face_finder.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>
#include <optional>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/io/file.hpp"
#include "vision/pictures.hpp"

namespace hri {

namespace {

struct Found {
  Face face;
  int num_windows = 0;  // that agree
};

cv::Mat grey_of(ImageView bgr, int max_side_px) {
  require(!bgr.empty() && bgr.channels == 3,
          "picture must have three channels and at least one pixel");
  cv::Mat grey;
  cv::cvtColor(detail::scaled_down(detail::as_mat(bgr), max_side_px), grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace

struct FaceFinder::Cascade {
  std::mutex mutex;  // OpenCV keeps its working memory in the classifier
  cv::CascadeClassifier classifier;

  // The best face in a grey picture, in pixels of one that is so many times as wide.
  std::optional<Found> search(const cv::Mat& grey, const FaceFinderOptions& options, double scale) {
    const int least =
        std::max(1, static_cast<int>(options.min_side * std::max(grey.cols, grey.rows)));
    std::vector<cv::Rect> found;
    std::vector<int> neighbours;
    {
      const std::lock_guard<std::mutex> lock(mutex);
      classifier.detectMultiScale(grey, found, neighbours, options.scale_step,
                                  options.min_neighbours, 0, cv::Size(least, least));
    }
    if (found.empty()) return std::nullopt;
    const auto best = std::max_element(neighbours.begin(), neighbours.end());
    const cv::Rect& box = found[static_cast<std::size_t>(best - neighbours.begin())];
    return Found{{box.x * scale, box.y * scale, box.width * scale}, *best};
  }
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
  const cv::Mat grey = grey_of(bgr, options_.max_side_px);
  const auto found =
      cascade_->search(grey, options_, bgr.width_px / static_cast<double>(grey.cols));
  return found ? std::optional<Face>(found->face) : std::nullopt;
}

std::optional<Face> FaceFinder::find_in_still(ImageView bgr) const {
  const cv::Mat grey = grey_of(bgr, options_.max_side_px);
  const double scale = bgr.width_px / static_cast<double>(grey.cols);
  auto found = cascade_->search(grey, options_, scale);
  if (options_.sure_neighbours > 0 && (!found || found->num_windows < options_.sure_neighbours)) {
    // The cascade's window moves by two pixels over small faces: few windows hit one.
    cv::Mat large;
    cv::resize(grey, large, {}, 2, 2, cv::INTER_LINEAR);
    if (const auto small = cascade_->search(large, options_, scale / 2)) found = small;
  }
  return found ? std::optional<Face>(found->face) : std::nullopt;
}

}  // namespace hri
