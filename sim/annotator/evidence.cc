#include "sim/annotator/evidence.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/vision/limb_regions.h"

namespace etude {
namespace {

constexpr int kNoBorder = -1;

// For each pair of parts, the index of the stroke that begins at the border between the two parts, or kNoBorder.
using BorderTable = std::array<std::array<int, kPartCount>, kPartCount>;
constexpr BorderTable kBorderOf = [] {
  BorderTable table{};
  for (auto& row : table) row.fill(kNoBorder);
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    const auto limb = static_cast<std::size_t>(kLimbParts[i].limb),
               inner = static_cast<std::size_t>(kLimbParts[i].inner);
    table[limb][inner] = table[inner][limb] = static_cast<int>(i);
  }
  return table;
}();

class RegionFinder {
 public:
  RegionFinder(const LabelImage& labels, const ColourImage& colours, const Mask& person, int margin_px)
      : labels_(labels), colours_(colours), person_(person), margin_px_(margin_px), seen_(labels.width, labels.height) {
    found_.width = labels.width;
    found_.height = labels.height;
  }

  Regions Find() {
    for (int y = 0; y < labels_.height; ++y) {
      FindVisible(y);
      AddRuns(y);
    }
    for (std::size_t i = 0; i < kPartCount; ++i) {
      Region& region = found_.parts[i];
      if (region.pixels > 0) region.middle /= region.pixels;
      if (outline_[i] > 0) region.contrast /= outline_[i];
    }
    return std::move(found_);
  }

 private:
  static bool HasPerformer(const std::uint32_t* labels, int count) {
    std::uint32_t found = 0;
    for (int i = 0; i < count; ++i) found |= static_cast<std::uint32_t>(IsPerformer(labels[i]));
    return found != 0;
  }

  void FindVisible(int y) {
    const std::uint32_t* labels = &labels_.pixels[static_cast<std::size_t>(y) * labels_.width];
    constexpr int kBlock = 16;  // pixels that are skipped together if none of them shows the performer
    for (int x = 0; x < labels_.width; ++x) {
      if (x + kBlock <= labels_.width && !HasPerformer(labels + x, kBlock)) {
        x += kBlock - 1;
        continue;
      }
      if (!IsPerformer(labels[x]) || !IsNearPerson(person_, x, y, margin_px_)) continue;
      seen_.At(x, y) = static_cast<std::uint8_t>(labels[x]);
      first_ = std::min(first_, x);
      last_ = std::max(last_, x);
    }
  }

  void AddRuns(int y) {
    int x = first_;
    while (x <= last_) {
      const std::uint8_t part = seen_.At(x, y);
      const int start = x;
      while (x <= last_ && seen_.At(x, y) == part) ++x;
      if (part != 0) AddRun({y, start, x}, part);
    }
  }

  // Adds a run that shows `part` to the region of this part.
  void AddRun(const PixelRun& run, std::uint8_t part) {
    Region& region = found_.parts[part];
    const int count = run.x1 - run.x0;
    region.runs.push_back(run);
    region.pixels += count;
    region.is_cut |= run.x0 == 0 || run.x1 == labels_.width || run.y == 0 || run.y == labels_.height - 1;
    region.middle += static_cast<double>(count) * glm::dvec2(0.5 * (run.x0 + run.x1), run.y + 0.5);
    // Collect the borders of this run with the parts to its left and above it.
    if (run.x0 > 0) AddBorder(part, seen_.At(run.x0 - 1, run.y), {run.x0, run.y + 0.5});
    if (run.y > 0) {
      for (int x = run.x0; x < run.x1; ++x) AddBorder(part, seen_.At(x, run.y - 1), {x + 0.5, run.y});
    }
    // Measure the contrast at the two ends of the run.
    AddContrast(run, part, run.x0, -1);
    AddContrast(run, part, run.x1 - 1, +1);
  }

  void AddBorder(std::uint8_t part, std::uint8_t other, const glm::dvec2& at) {
    const int stroke = kBorderOf[part][other];
    if (stroke != kNoBorder) found_.borders[static_cast<std::size_t>(stroke)].push_back(at);
  }

  // Adds the contrast at the end `x` of a run. The pixel at x + `step` is outside the run.
  void AddContrast(const PixelRun& run, std::uint8_t part, int x, int step) {
    constexpr int kApart = 2;  // distance in pixels from the end of the run; nearer pixels may mix two surfaces
    const int outside = x + kApart * step, inside = std::clamp(x - kApart * step, run.x0, run.x1 - 1);
    if (outside < 0 || outside >= labels_.width) return;
    const std::uint32_t other = labels_.At(outside, run.y);
    if (other == part || (IsPerformer(other) && kBorderOf[part][other] != kNoBorder)) return;
    const Rgb8 a = colours_.At(inside, run.y), b = colours_.At(outside, run.y);
    const double r = a.r - b.r, g = a.g - b.g, blue = a.b - b.b;
    found_.parts[part].contrast += std::sqrt(r * r + g * g + blue * blue);
    ++outline_[part];
  }

  const LabelImage& labels_;
  const ColourImage& colours_;
  const Mask& person_;
  const int margin_px_;
  Image<std::uint8_t> seen_;         // part of each visible pixel, 0 elsewhere
  int first_ = 1 << 30, last_ = -1;  // range of columns with visible pixels so far; empty at first
  std::array<int, kPartCount> outline_{};
  Regions found_;
};

LimbRegions ByStroke(Regions regions) {
  LimbRegions limbs{.width = regions.width,
                    .height = regions.height,
                    .trunk = std::move(regions.parts[static_cast<std::size_t>(Part::kTrunk)]),
                    .limbs = {},
                    .borders = std::move(regions.borders)};
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    limbs.limbs[i] = std::move(regions.parts[static_cast<std::size_t>(kLimbParts[i].limb)]);
  }
  return limbs;
}

}  // namespace

Regions FindRegions(const LabelImage& labels, const ColourImage& colours, const Mask& person, int margin_px) {
  assert(labels.pixels.size() == colours.pixels.size() && labels.pixels.size() == person.pixels.size());
  return RegionFinder(labels, colours, person, margin_px).Find();
}

PictureEvidence SeePicture(const AnnotatedPicture& picture, const EvidenceOptions& options) {
  const LimbRegions regions = ByStroke(FindRegions(picture.labels, picture.colours, picture.person, options.margin_px));
  return FindLimbEvidence(regions, options.look);
}

}  // namespace etude
