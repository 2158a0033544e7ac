// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The face in a picture, by a cascade of boosted classifiers (Viola and Jones 2001) that OpenCV
// reads from a file, such as haarcascade_frontalface_alt2.xml of Debian's package opencv-data.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/options.hpp"

namespace hri {

/// The square around a face, in pixels of the picture that it was found in.
struct Face {
  double left_px = 0;
  double top_px = 0;
  double side_px = 0;
};

struct HRI_API FaceFinderOptions {
  int max_side_px = 640;
  double min_side = 0.025;
  double scale_step = 1.1;
  int min_neighbours = 2;
  int sure_neighbours = 15;

  static constexpr const char* kName = "FaceFinderOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("max_side_px", o.max_side_px, within(32, 4096),
      "larger pictures are scaled down to this first");
    v("min_side", o.min_side, within(0, 1),
      "side of the smallest face, as a share of the picture's longer side");
    v("scale_step", o.scale_step, within(1.01, 2), "ratio of one size that is tried to the next");
    v("min_neighbours", o.min_neighbours, within(1, 100),
      "windows that must agree on a face, a pixel or a size apart");
    v("sure_neighbours", o.sure_neighbours, within(0, 1000),
      "a single picture in which fewer agree is searched again at twice its size, where small "
      "faces stand out; 0: never");
  }
};

/// Const calls are safe from several threads; one of them searches at a time.
class HRI_API FaceFinder {
 public:
  /// Throws InvalidArgument naming the field that is out of range; IoError for a cascade that
  /// cannot be opened, FormatError for a file that is none.
  explicit FaceFinder(const std::string& cascade_path, const FaceFinderOptions& options = {});

  /// The face on which most windows agree; nothing where there is none. `bgr` has 3 channels.
  /// Throws InvalidArgument for another layout or an empty picture.
  [[nodiscard]] std::optional<Face> find(ImageView bgr) const;

  /// The same of a single picture, which may take three times as long: see sure_neighbours. Of
  /// persons some metres away it finds faces that find() does not, and less else in their place.
  [[nodiscard]] std::optional<Face> find_in_still(ImageView bgr) const;

 private:
  struct Cascade;
  FaceFinderOptions options_;
  std::shared_ptr<Cascade> cascade_;
};

}  // namespace hri
