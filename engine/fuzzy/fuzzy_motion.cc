#include "engine/fuzzy/fuzzy_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace etude {

FuzzyMotion FuzzifyMotion(const BodyMotion& motion, double standing_hip_height, const FuzzySystem& system) {
  FuzzyMotion fuzzy{.rate_hz = motion.rate_hz, .features = {}, .grades = {}, .tags = {}, .poses = {}};
  for (const BodyPose& pose : motion.poses) {
    fuzzy.features.push_back(ComputeFeatures(pose, standing_hip_height));
    fuzzy.grades.push_back(Fuzzify(fuzzy.features.back(), system.memberships));
    fuzzy.tags.push_back(ChooseTags(fuzzy.grades.back()));
    const std::string* concluded = ChoosePose(system.rules, fuzzy.grades.back());
    fuzzy.poses.push_back(concluded == nullptr ? "" : *concluded);
  }
  return fuzzy;
}

namespace {

constexpr double kUnreached = std::numeric_limits<double>::infinity();

/// Returns √S · μ of every frame. The Euclidean distance of two such vectors is the distance of paper A's equation 1.
std::vector<Grades> Scaled(std::span<const Grades> motion, const FeatureWeights& weights) {
  Grades roots{};
  for (std::size_t i = 0; i < kTermCount; ++i) {
    roots[i] = std::sqrt(weights[static_cast<std::size_t>(AllTerms()[i].feature)]);
  }
  std::vector<Grades> scaled(motion.begin(), motion.end());
  for (Grades& frame : scaled) {
    for (std::size_t i = 0; i < kTermCount; ++i) frame[i] *= roots[i];
  }
  return scaled;
}

double Euclidean(const Grades& a, const Grades& b) {
  double sum = 0;
  for (std::size_t i = 0; i < kTermCount; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

/// The range of columns that the Sakoe–Chiba band allows in each row. It is symmetric in rows and columns, and
/// neighbouring rows always share a column.
class Band {
 public:
  Band(std::size_t rows, std::size_t columns, double share)
      : rows_(static_cast<double>(rows) - 1), columns_(static_cast<double>(columns) - 1) {
    slack_ = std::max(share * rows_ * columns_, std::max(rows_, columns_));
  }
  std::size_t First(std::size_t row) const {
    if (rows_ == 0) return 0;
    return static_cast<std::size_t>(std::max(0.0, std::ceil((static_cast<double>(row) * columns_ - slack_) / rows_)));
  }
  std::size_t Last(std::size_t row) const {
    if (rows_ == 0) return static_cast<std::size_t>(columns_);
    return static_cast<std::size_t>(
        std::min(columns_, std::floor((static_cast<double>(row) * columns_ + slack_) / rows_)));
  }

 private:
  double rows_, columns_;  ///< the number of rows minus one; the number of columns minus one
  double slack_;           ///< upper limit of |row · columns_ − column · rows_|
};

}  // namespace

std::optional<double> ComputeMotionSimilarity(std::span<const Grades> a, std::span<const Grades> b,
                                              const MotionSimilarityOptions& options) {
  if (a.empty() || b.empty()) return std::nullopt;
  const std::vector<Grades> rows = Scaled(a, options.weights), columns = Scaled(b, options.weights);
  const Band band(rows.size(), columns.size(), options.band);
  const double steps = static_cast<double>(rows.size() + columns.size());
  // The similarity is below `at_least` if and only if the sum of distances along the path exceeds `max_cost`, apart
  // from a margin for rounding.
  const double max_cost =
      options.at_least > 0 ? steps * options.half_at * (1 / options.at_least - 1) * (1 + 1e-12) + 1e-12 : kUnreached;

  // Dynamic time warping, row by row within the band. A diagonal step has twice the weight of the other steps.
  std::vector<double> above(columns.size(), kUnreached), row(columns.size(), kUnreached);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::ranges::fill(row, kUnreached);
    double least = kUnreached;
    const std::size_t last = band.Last(i);
    for (std::size_t j = band.First(i); j <= last; ++j) {
      const double cost = Euclidean(rows[i], columns[j]);
      double best = i == 0 && j == 0 ? 2 * cost : kUnreached;
      if (i > 0) best = std::min(best, above[j] + cost);
      if (j > 0) best = std::min(best, row[j - 1] + cost);
      if (i > 0 && j > 0) best = std::min(best, above[j - 1] + 2 * cost);
      row[j] = best;
      least = std::min(least, best);
    }
    // Give up when every path in this row costs too much.
    if (least > max_cost) return std::nullopt;
    std::swap(above, row);
  }
  const double similarity = 1 / (1 + above.back() / steps / options.half_at);
  if (similarity < options.at_least) return std::nullopt;
  return similarity;
}

}  // namespace etude
