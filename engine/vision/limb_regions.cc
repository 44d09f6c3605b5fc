#include "engine/vision/limb_regions.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "engine/base/order_statistics.h"
#include "engine/vision/scatter.h"

namespace etude {
namespace {

template <typename Use>
void ForEachPixel(const Region& region, Use use) {
  for (const PixelRun& run : region.runs) {
    for (int x = run.x0; x < run.x1; ++x) use(glm::dvec2(x + 0.5, run.y + 0.5));
  }
}

// Returns the principal axis of the region's pixels.
glm::dvec2 ScatterAxis(const Region& region) {
  Scatter scatter;
  ForEachPixel(region, [&](const glm::dvec2& p) { scatter.Add(p - region.middle); });
  return scatter.Axis();
}

// A slice of a region, one pixel thick, between two lines perpendicular to the region's axis.
struct Section {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool IsEmpty() const { return low > high; }
  double Width() const { return high - low + 1; }  // pixel centres are half a pixel from the edges
  double Middle() const { return 0.5 * (low + high); }
};

// Cuts the region into slices perpendicular to `line`, and sets the line's `low` and `high`.
std::vector<Section> Slice(const Region& region, MiddleLine& line) {
  const glm::dvec2 across(-line.along.y, line.along.x);
  line.low = std::numeric_limits<double>::infinity();
  line.high = -line.low;
  ForEachPixel(region, [&](const glm::dvec2& p) {
    const double s = line.Where(p);
    line.low = std::min(line.low, s);
    line.high = std::max(line.high, s);
  });
  std::vector<Section> sections(static_cast<std::size_t>(line.high - line.low) + 1);
  ForEachPixel(region, [&](const glm::dvec2& p) {
    Section& section = sections[static_cast<std::size_t>(line.Where(p) - line.low)];
    const double off = glm::dot(p - line.origin, across);
    section.low = std::min(section.low, off);
    section.high = std::max(section.high, off);
  });
  line.low -= 0.5;
  line.high += 0.5;
  return sections;
}

// Returns the 90th percentile of the slices' widths.
double UsualWidth(const std::vector<Section>& sections) {
  std::vector<double> widths;
  for (const Section& section : sections) {
    if (!section.IsEmpty()) widths.push_back(section.Width());
  }
  constexpr double kShare = 0.9;
  return LowerPercentile(std::move(widths), kShare);
}

// Fits the line to the middles of the slices that are at least 85 % as wide as usual.
void FitThroughMiddles(const std::vector<Section>& sections, MiddleLine& line) {
  constexpr double kWholeShare = 0.85;
  double n = 0, s1 = 0, m1 = 0, ss = 0, sm = 0;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (sections[i].IsEmpty() || sections[i].Width() < kWholeShare * 2 * line.half_width) continue;
    const double s = line.low + 1 + static_cast<double>(i), middle = sections[i].Middle();
    n += 1;
    s1 += s;
    m1 += middle;
    ss += s * s;
    sm += s * middle;
  }
  const double spread = n * ss - s1 * s1;
  if (n < 5 || spread <= 0) return;
  const double slope = (n * sm - s1 * m1) / spread, offset = (m1 - slope * s1) / n;
  const glm::dvec2 across(-line.along.y, line.along.x);
  line.origin += offset * across;
  line.along = glm::normalize(line.along + slope * across);
}

}  // namespace

bool MiddleLine::IsLong() const {
  constexpr double kLong = 1.5;
  return high - low > kLong * 2 * half_width;
}

MiddleLine FindMiddleLine(const Region& region) {
  MiddleLine line{.origin = region.middle, .along = ScatterAxis(region)};
  constexpr int kPasses = 2;  // the second pass cuts across the line that the first pass found
  for (int pass = 0; pass <= kPasses; ++pass) {
    const std::vector<Section> sections = Slice(region, line);
    line.half_width = 0.5 * UsualWidth(sections);
    if (pass == kPasses || !line.IsLong()) break;
    FitThroughMiddles(sections, line);
  }
  return line;
}

}  // namespace etude
