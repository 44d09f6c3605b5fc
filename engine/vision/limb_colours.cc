#include "engine/vision/limb_colours.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/vision/components.h"

namespace etude {
namespace {

/// The label of each pixel: 0 for none, 1 for the trunk, then one label for the limb of each stroke.
using LimbImage = Image<std::uint8_t>;
constexpr std::uint8_t kTrunk = 1, kFirstLimb = 2;
constexpr std::size_t kLabels = kFirstLimb + kStrokeCount;

constexpr std::uint8_t LabelOf(std::size_t stroke) { return static_cast<std::uint8_t>(kFirstLimb + stroke); }

/// For each pair of labels, the stroke that begins at the border of the two regions; kNoStroke for most pairs.
constexpr std::uint8_t kNoStroke = 255;
constexpr auto kStrokeBetween = [] {
  std::array<std::array<std::uint8_t, kLabels>, kLabels> table{};
  for (auto& row : table) row.fill(kNoStroke);
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    const std::uint8_t inner = IsAttachedToTrunk(i) ? kTrunk : LabelOf(i - 1);
    table[LabelOf(i)][inner] = table[inner][LabelOf(i)] = static_cast<std::uint8_t>(i);
  }
  return table;
}();

/// A box of pixels, low ≤ (x, y) < high. It is empty before a pixel is added.
struct PixelBox {
  glm::ivec2 low{std::numeric_limits<int>::max()}, high{0};

  void Add(int x, int y) {
    low = glm::min(low, glm::ivec2(x, y));
    high = glm::max(high, glm::ivec2(x + 1, y + 1));
  }
  bool IsEmpty() const { return low.x >= high.x; }
};

template <typename Pixel>
PixelBox BoxOf(const Image<Pixel>& image) {
  PixelBox box;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.At(x, y) != 0) box.Add(x, y);
    }
  }
  return box;
}

/// Returns the box, enlarged by `by` on every side and clipped to the image.
template <typename Pixel>
PixelBox Grown(PixelBox box, int by, const Image<Pixel>& image) {
  if (box.IsEmpty()) return box;
  box.low = glm::max(box.low - by, glm::ivec2(0));
  box.high = glm::min(box.high + by, glm::ivec2(image.width, image.height));
  return box;
}

glm::dvec2 ChromaticityOf(Rgb8 colour) {
  const double sum = colour.r + colour.g + colour.b;
  return sum > 0 ? glm::dvec2(colour.r, colour.g) / sum : glm::dvec2(1.0 / 3);
}

/// Classifies pixels by the suit's colours.
class Palette {
 public:
  Palette(const LimbColours& suit, const LimbColourOptions& options) : options_(options) {
    colours_[kTrunk] = ChromaticityOf(suit.trunk);
    for (std::size_t i = 0; i < kStrokeCount; ++i) colours_[LabelOf(i)] = ChromaticityOf(suit.limbs[i]);
  }

  std::uint8_t LabelAt(Rgb8 pixel) const {
    if (pixel.r + pixel.g + pixel.b < options_.darkest) return 0;
    const glm::dvec2 seen = ChromaticityOf(pixel);
    double nearest = options_.reach * options_.reach;
    std::uint8_t label = 0;
    for (std::uint8_t i = kTrunk; i < kLabels; ++i) {
      // Compute the distance in the plane of chromaticities. The share of blue is 1 minus the shares of red and green.
      const glm::dvec2 off = seen - colours_[i];
      const double distance = glm::dot(off, off) + (off.x + off.y) * (off.x + off.y);
      if (distance >= nearest) continue;
      nearest = distance;
      label = i;
    }
    return label;
  }

 private:
  const LimbColourOptions& options_;
  std::array<glm::dvec2, kLabels> colours_{};
};

LimbImage Classified(const ColourImage& picture, const Mask& person, const LimbColours& suit,
                     const LimbColourOptions& options) {
  const Palette palette(suit, options);
  const PixelBox box = Grown(BoxOf(person), options.margin_px, picture);
  LimbImage limbs(picture.width, picture.height);
  for (int y = box.low.y; y < box.high.y; ++y) {
    for (int x = box.low.x; x < box.high.x; ++x) {
      if (const std::uint8_t label = palette.LabelAt(picture.At(x, y));
          label != 0 && IsNearPerson(person, x, y, options.margin_px)) {
        limbs.At(x, y) = label;
      }
    }
  }
  return limbs;
}

/// Replaces each pixel by the majority of its 3 × 3 neighbourhood. This removes noise and lines of mixed colours along
/// edges.
LimbImage Voted(const LimbImage& limbs) {
  constexpr int kMajority = 5;
  LimbImage voted(limbs.width, limbs.height);
  const PixelBox box = Grown(BoxOf(limbs), 1, limbs);
  for (int y = box.low.y; y < box.high.y; ++y) {
    for (int x = box.low.x; x < box.high.x; ++x) {
      std::array<std::uint8_t, kLabels> votes{};
      for (int v = std::max(0, y - 1); v <= std::min(limbs.height - 1, y + 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(limbs.width - 1, x + 1); ++u) ++votes[limbs.At(u, v)];
      }
      const auto most = std::ranges::max_element(votes);
      if (*most >= kMajority) voted.At(x, y) = static_cast<std::uint8_t>(most - votes.begin());
    }
  }
  return voted;
}

/// Returns a flag for each component: true if the component contains a square with this side, pixels.
std::vector<bool> HaveSquares(const Components& found, const Mask& mask, int side) {
  std::vector<bool> have(found.pieces.size());
  const auto is_square = [&](int left, int top) {
    for (int y = top; y < top + side; ++y) {
      for (int x = left; x < left + side; ++x) {
        if (mask.At(x, y) == 0) return false;
      }
    }
    return true;
  };
  for (const Components::Run& run : found.runs) {
    if (!found.pieces[run.piece].set || have[run.piece] || run.row + side > mask.height) continue;
    for (int x = run.begin; x + side <= run.end && !have[run.piece]; ++x) have[run.piece] = is_square(x, run.row);
  }
  return have;
}

/// Returns the region of one label. Keeps components that are large and thick enough to be a part of the limb; thin
/// components are edges of other limbs, where colours mix.
Region RegionOf(const LimbImage& limbs, std::uint8_t label, const PixelBox& box, const LimbColourOptions& options) {
  Region region;
  if (box.IsEmpty()) return region;
  Mask crop(box.high.x - box.low.x, box.high.y - box.low.y);
  for (int y = 0; y < crop.height; ++y) {
    for (int x = 0; x < crop.width; ++x) crop.At(x, y) = limbs.At(box.low.x + x, box.low.y + y) == label;
  }
  // Select the components that contain a square and are not much smaller than the largest component.
  const Components found = LabelComponents(crop);
  const std::vector<bool> is_thick = HaveSquares(found, crop, options.min_side_px);
  int largest = 0;
  for (std::size_t i = 0; i < is_thick.size(); ++i)
    largest = is_thick[i] ? std::max(largest, found.pieces[i].size) : largest;
  const double smallest = std::max<double>(options.min_piece_px, options.piece_share * largest);
  // Convert the runs of these components to the picture's coordinates, and sum up the pixels of the runs.
  for (const Components::Run& in_crop : found.runs) {
    if (!is_thick[in_crop.piece] || found.pieces[in_crop.piece].size < smallest) continue;
    const PixelRun run{in_crop.row + box.low.y, in_crop.begin + box.low.x, in_crop.end + box.low.x};
    const int count = run.x1 - run.x0;
    region.runs.push_back(run);
    region.pixels += count;
    region.is_cut |= run.x0 == 0 || run.x1 == limbs.width || run.y == 0 || run.y == limbs.height - 1;
    region.middle += static_cast<double>(count) * glm::dvec2(0.5 * (run.x0 + run.x1), run.y + 0.5);
  }
  if (region.pixels > 0) region.middle /= region.pixels;
  return region;
}

void Paint(const Region& region, std::uint8_t label, LimbImage& limbs) {
  for (const PixelRun& run : region.runs) {
    for (int x = run.x0; x < run.x1; ++x) limbs.At(x, run.y) = label;
  }
}

/// Adds the borders between neighbouring limbs: the midpoints between each pixel and its right or lower neighbour, if
/// the two belong to different limbs.
void AddBorders(const LimbImage& limbs, int border_px, LimbRegions& regions) {
  const auto look = [&](int x, int y, int step_x, int step_y) {
    const std::uint8_t label = limbs.At(x, y);
    for (int d = 1; d <= border_px + 1 && limbs.Contains(x + d * step_x, y + d * step_y); ++d) {
      const std::uint8_t other = limbs.At(x + d * step_x, y + d * step_y);
      if (other == 0) continue;
      const std::uint8_t stroke = kStrokeBetween[label][other];
      if (stroke != kNoStroke) {
        regions.borders[stroke].push_back({x + 0.5 + 0.5 * d * step_x, y + 0.5 + 0.5 * d * step_y});
      }
      return;
    }
  };
  const PixelBox box = BoxOf(limbs);
  for (int y = box.low.y; y < box.high.y; ++y) {
    for (int x = box.low.x; x < box.high.x; ++x) {
      if (limbs.At(x, y) == 0) continue;
      look(x, y, 1, 0);
      look(x, y, 0, 1);
    }
  }
}

}  // namespace

LimbRegions FindColouredLimbs(const ColourImage& picture, const Mask& person, const LimbColours& suit,
                              const LimbColourOptions& options) {
  assert(picture.pixels.size() == person.pixels.size());
  const LimbImage voted = Voted(Classified(picture, person, suit, options));
  std::array<PixelBox, kLabels> boxes;
  for (int y = 0; y < voted.height; ++y) {
    for (int x = 0; x < voted.width; ++x) boxes[voted.At(x, y)].Add(x, y);
  }
  LimbRegions regions{.width = picture.width, .height = picture.height, .trunk = {}, .limbs = {}, .borders = {}};
  LimbImage kept(picture.width, picture.height);
  regions.trunk = RegionOf(voted, kTrunk, boxes[kTrunk], options);
  Paint(regions.trunk, kTrunk, kept);
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    regions.limbs[i] = RegionOf(voted, LabelOf(i), boxes[LabelOf(i)], options);
    Paint(regions.limbs[i], LabelOf(i), kept);
  }
  AddBorders(kept, options.border_px, regions);
  return regions;
}

Marks ReadLimbColours(const ColourImage& picture, const Mask& person, const LimbColours& suit,
                      const LimbColourOptions& options) {
  const PictureEvidence seen = FindLimbEvidence(FindColouredLimbs(picture, person, suit, options), options.look);
  Marks marks;
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (seen.limbs[i]) marks.strokes[i] = seen.limbs[i]->line;
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) marks.effectors[i] = seen.joints[Index(EffectorMarks()[i].role)];
  return marks;
}

}  // namespace etude
