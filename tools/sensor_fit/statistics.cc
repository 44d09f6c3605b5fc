#include "tools/sensor_fit/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "engine/base/names.h"
#include "engine/base/order_statistics.h"

namespace etude {
namespace {

using enum Role;

/// The errors of one joint, for the frames in which both the sensor and the optical system of the twin saw the joint.
struct ErrorSeries {
  std::vector<glm::dvec3> errors;
  std::vector<std::size_t> frames;

  glm::dvec3 Mean() const {
    glm::dvec3 sum(0);
    for (const glm::dvec3& error : errors) sum += error;
    return errors.empty() ? sum : sum / static_cast<double>(errors.size());
  }
};

std::optional<glm::dvec3> ErrorAt(const JointRecording& recording, const TwinMatch& match, std::size_t t,
                                  std::size_t j) {
  const auto &sensed = recording.frames[t][j], &truth = match.truth[t][j];
  if (!sensed || !truth) return std::nullopt;
  return *sensed - *truth;
}

ErrorSeries ErrorsOf(const JointRecording& recording, const TwinMatch& match, Role role) {
  ErrorSeries series;
  for (std::size_t t = 0; t < recording.frames.size(); ++t) {
    if (const auto error = ErrorAt(recording, match, t, Index(role))) {
      series.errors.push_back(*error);
      series.frames.push_back(t);
    }
  }
  return series;
}

/// Returns true if the joint is at rest in the twin from five frames before `frame` to five frames after it.
bool IsPlanted(const TwinMatch& match, std::size_t frame, std::size_t joint, double rate_hz) {
  constexpr std::size_t kReach = 5;
  constexpr double kResting = 0.1;  // m/s; a slower joint is at rest
  for (std::size_t t = frame - std::min(frame, kReach); t < std::min(frame + kReach, match.truth.size() - 1); ++t) {
    const auto &a = match.truth[t][joint], &b = match.truth[t + 1][joint];
    if (a && b && glm::distance(*a, *b) * rate_hz > kResting) return false;
  }
  return true;
}

/// Returns the coefficient of variation of the distance between two joints, per cent.
std::optional<double> Variation(const JointRecording& recording, Role a, Role b) {
  std::vector<double> lengths;
  for (const RolePositions& places : recording.frames) {
    if (places[Index(a)] && places[Index(b)]) lengths.push_back(glm::distance(*places[Index(a)], *places[Index(b)]));
  }
  if (lengths.size() < 2) return std::nullopt;
  const auto count = static_cast<double>(lengths.size());
  const double mean = std::accumulate(lengths.begin(), lengths.end(), 0.0) / count;
  double squares = 0;
  for (const double length : lengths) squares += (length - mean) * (length - mean);
  return mean > 0 ? std::optional(100 * std::sqrt(squares / count) / mean) : std::nullopt;
}

/// Returns |p(t−1) − 2 p(t) + p(t+1)|; nullopt unless the joint was seen in all three frames.
std::optional<double> SecondDifference(const JointRecording& recording, std::size_t t, std::size_t j) {
  if (t == 0 || t + 1 >= recording.frames.size()) return std::nullopt;
  const auto &before = recording.frames[t - 1][j], &here = recording.frames[t][j], &after = recording.frames[t + 1][j];
  if (!before || !here || !after) return std::nullopt;
  return glm::length(*before - 2.0 * *here + *after);
}

struct MeanOf {
  double sum = 0, count = 0;
  void Add(double value) {
    sum += value;
    ++count;
  }
  void Add(const std::optional<double>& value) {
    if (value) Add(*value);
  }
  std::optional<double> Value() const { return count > 0 ? std::optional(sum / count) : std::nullopt; }
  std::optional<double> Root(double scale) const {
    return count > 0 ? std::optional(scale * std::sqrt(sum / count)) : std::nullopt;
  }
};

void MeasureErrors(const JointRecording& recording, const TwinMatch& match, SensorStatistics& result) {
  std::array<MeanOf, kJointGroupCount> squares;
  MeanOf planted, shoulders_and_hips;
  for (const Role role : AllRoles()) {
    const ErrorSeries series = ErrorsOf(recording, match, role);
    const JointGroup group = GroupOf(role);
    for (std::size_t i = 0; i < series.errors.size(); ++i) {
      const double square = glm::dot(series.errors[i], series.errors[i]);
      squares[Index(group)].Add(square);
      if (group == JointGroup::kShoulders || group == JointGroup::kHips) shoulders_and_hips.Add(square);
      if (group != JointGroup::kFeet) continue;
      if (IsPlanted(match, series.frames[i], Index(role), recording.rate_hz)) planted.Add(square);
    }
  }
  for (std::size_t g = 0; g < kJointGroupCount; ++g) result.error_mm[g] = squares[g].Root(1000);
  result.shoulders_and_hips_mm = shoulders_and_hips.Root(1000);
  result.planted_feet_mm = planted.Root(1000);
}

void MeasureDepth(const JointRecording& recording, const TwinMatch& match, SensorStatistics& result) {
  std::array<MeanOf, kJointGroupCount> along_squares, across_squares;
  if (!recording.sensor_at) return;
  for (const Role role : AllRoles()) {
    const ErrorSeries series = ErrorsOf(recording, match, role);
    const glm::dvec3 mean = series.Mean();
    const std::size_t group = Index(GroupOf(role));
    for (std::size_t i = 0; i < series.errors.size(); ++i) {
      const glm::dvec3 from = *match.truth[series.frames[i]][Index(role)] - *recording.sensor_at;
      if (from == glm::dvec3(0)) continue;
      const glm::dvec3 error = series.errors[i] - mean;
      const double along = glm::dot(error, glm::normalize(from));
      along_squares[group].Add(along * along);
      across_squares[group].Add(0.5 * (glm::dot(error, error) - along * along));
    }
  }
  for (std::size_t g = 0; g < kJointGroupCount; ++g) {
    const auto along = along_squares[g].Root(1), across = across_squares[g].Root(1);
    if (along && *across > 0) result.depth_ratio[g] = *along / *across;
  }
}

void MeasureCorrelations(const JointRecording& recording, const TwinMatch& match, SensorStatistics& result) {
  struct Sums {
    double both = 0, first = 0, second = 0;
  };
  // Sum the products of the errors at both ends of each bone, about the means of these errors.
  std::array<Sums, kBoneKindCount> all_sums{};
  for (const Bone& bone : AllBones()) {
    ErrorSeries parent, child;  // the errors of the bone's two joints, in frames in which both joints were seen
    for (std::size_t t = 0; t < recording.frames.size(); ++t) {
      const auto a = ErrorAt(recording, match, t, Index(bone.parent));
      const auto b = ErrorAt(recording, match, t, Index(bone.child));
      if (!a || !b) continue;
      parent.errors.push_back(*a);
      child.errors.push_back(*b);
    }
    const glm::dvec3 mean_parent = parent.Mean(), mean_child = child.Mean();
    Sums& sums = all_sums[Index(BoneKindOf(bone.child))];
    for (std::size_t i = 0; i < parent.errors.size(); ++i) {
      const glm::dvec3 a = parent.errors[i] - mean_parent, b = child.errors[i] - mean_child;
      sums.both += glm::dot(a, b);
      sums.first += glm::dot(a, a);
      sums.second += glm::dot(b, b);
    }
  }
  // Normalise the sums to correlations.
  for (std::size_t b = 0; b < kBoneKindCount; ++b) {
    const Sums& sums = all_sums[b];
    if (sums.first > 0 && sums.second > 0) result.correlation[b] = sums.both / std::sqrt(sums.first * sums.second);
  }
}

void MeasureQuiet(const JointRecording& recording, SensorStatistics& result) {
  MeanOf white;
  constexpr std::size_t kReach = 5, kMinLengths = 20;
  constexpr double kQuiet = 0.005;
  // The median length of a vector of three independent normal variables with variance 6 each (weights 1, −2, 1).
  const double middle_length = 1.5381722544550522 * std::sqrt(6.0);
  for (const Role role : AllRoles()) {
    if (GroupOf(role) != JointGroup::kTorso) continue;
    const std::size_t j = Index(role);
    std::vector<double> lengths;
    for (std::size_t t = kReach; t + kReach < recording.frames.size(); ++t) {
      const auto &before = recording.frames[t - kReach][j], &after = recording.frames[t + kReach][j];
      if (!before || !after || glm::distance(*before, *after) > kQuiet) continue;
      if (const auto difference = SecondDifference(recording, t, j)) lengths.push_back(*difference);
    }
    if (lengths.size() >= kMinLengths) white.Add(1000 * UpperMedian(std::move(lengths)) / middle_length);
  }
  result.quiet_white_mm = white.Value();
}

void MeasureBones(const JointRecording& recording, SensorStatistics& result) {
  MeanOf arms, legs, hands;
  for (const Bone& bone : AllBones()) {
    const auto variation = Variation(recording, bone.parent, bone.child);
    const BoneKind kind = BoneKindOf(bone.child);
    if (kind == BoneKind::kUpperArm || kind == BoneKind::kForearm) arms.Add(variation);
    if (kind == BoneKind::kThigh || kind == BoneKind::kShank) legs.Add(variation);
    if (kind == BoneKind::kHand) hands.Add(variation);
  }
  result.arm_bones_percent = arms.Value();
  result.leg_bones_percent = legs.Value();
  result.hand_bones_percent = hands.Value();
  result.shoulder_width_percent = Variation(recording, kLeftShoulder, kRightShoulder);
}

void MeasureJumps(const JointRecording& recording, SensorStatistics& result) {
  std::vector<double> jumps;
  for (const Role role : {kLeftHand, kRightHand}) {
    for (std::size_t t = 0; t < recording.frames.size(); ++t) {
      if (const auto difference = SecondDifference(recording, t, Index(role))) jumps.push_back(*difference);
    }
  }
  if (jumps.empty()) return;
  result.hand_jump_cm = 100 * LowerPercentile(std::move(jumps), 0.99);
}

/// Returns pointers to all values of a set of statistics, in a fixed order.
std::vector<std::optional<double>*> ValuesOf(SensorStatistics& s) {
  std::vector<std::optional<double>*> values = {
      &s.shoulders_and_hips_mm, &s.planted_feet_mm,        &s.quiet_white_mm,     &s.arm_bones_percent,
      &s.leg_bones_percent,     &s.shoulder_width_percent, &s.hand_bones_percent, &s.hand_jump_cm};
  for (auto& value : s.error_mm) values.push_back(&value);
  for (auto& value : s.depth_ratio) values.push_back(&value);
  for (auto& value : s.correlation) values.push_back(&value);
  return values;
}

std::string CellText(const StatisticRow& row) { return row.value ? fmt::format("{:.2f}", *row.value) : "-"; }

bool IsWithin(const StatisticRow& reference, const StatisticRow& other) {
  if (reference.held_by == ComparedBy::kDifference) {
    return std::abs(*other.value - *reference.value) <= kCorrelationTolerance;
  }
  return *reference.value > 0 && std::abs(*other.value / *reference.value - 1) <= kSizeTolerance;
}

std::string Held(const StatisticRow& reference, const StatisticRow& other) {
  if (!reference.value || !other.value) return "";
  const char* mark = IsWithin(reference, other) ? "" : " !";
  if (reference.held_by == ComparedBy::kDifference) {
    return fmt::format("{:+.2f}{}", *other.value - *reference.value, mark);
  }
  return *reference.value > 0 ? fmt::format("x{:.2f}{}", *other.value / *reference.value, mark) : "";
}

}  // namespace

SensorStatistics StatisticsOf(const JointRecording& recording, const TwinMatch* match) {
  SensorStatistics result;
  if (match != nullptr) {
    MeasureErrors(recording, *match, result);
    MeasureDepth(recording, *match, result);
    MeasureCorrelations(recording, *match, result);
  }
  MeasureQuiet(recording, result);
  MeasureBones(recording, result);
  MeasureJumps(recording, result);
  return result;
}

SensorStatisticsSummary Summarise(const std::vector<SensorStatistics>& recordings) {
  SensorStatisticsSummary summary;
  const auto means = ValuesOf(summary.mean), deviations = ValuesOf(summary.deviation);
  for (std::size_t i = 0; i < means.size(); ++i) {
    MeanOf mean, square;
    for (SensorStatistics recording : recordings) {
      const auto value = *ValuesOf(recording)[i];
      mean.Add(value);
      if (value) square.Add(*value * *value);
    }
    *means[i] = mean.Value();
    if (mean.count < 2) continue;
    const double variance = (square.sum - mean.sum * mean.sum / mean.count) / (mean.count - 1);
    *deviations[i] = std::sqrt(std::max(0.0, variance));
  }
  return summary;
}

std::vector<StatisticRow> RowsOf(const SensorStatistics& statistics) {
  std::vector<StatisticRow> rows;
  const auto add = [&](std::string name, const char* unit, const std::optional<double>& value,
                       ComparedBy held_by = ComparedBy::kRatio) {
    rows.push_back({std::move(name), unit, held_by, value});
  };
  // Add the errors.
  for (const JointGroup group : AllJointGroups()) {
    if (group == JointGroup::kFeet) continue;
    add(fmt::format("error of {}", GroupName(group)), "mm", statistics.error_mm[Index(group)]);
  }
  add("error of shoulders and hips", "mm", statistics.shoulders_and_hips_mm);
  add("error of all feet", "mm", statistics.error_mm[Index(JointGroup::kFeet)]);
  add("error of planted feet", "mm", statistics.planted_feet_mm);
  // Add the ratios and correlations.
  for (const JointGroup group : AllJointGroups()) {
    add(fmt::format("depth : across, {}", GroupName(group)), "", statistics.depth_ratio[Index(group)]);
  }
  for (const BoneKind kind : AllBoneKinds()) {
    add("correlation along " + WithSpaces(std::string(BoneName(kind))), "", statistics.correlation[Index(kind)],
        ComparedBy::kDifference);
  }
  // Add noise at rest, varying lengths, and jumps.
  add("white part, quiet torso", "mm", statistics.quiet_white_mm);
  add("length of arm bones varies", "%", statistics.arm_bones_percent);
  add("length of leg bones varies", "%", statistics.leg_bones_percent);
  add("shoulder width varies", "%", statistics.shoulder_width_percent);
  add("length of hand bones varies", "%", statistics.hand_bones_percent);
  add("hands' second difference, p99", "cm", statistics.hand_jump_cm);
  return rows;
}

Agreement AgreementOf(const SensorStatistics& reference, const SensorStatistics& other) {
  const auto a = RowsOf(reference), b = RowsOf(other);
  Agreement agreement;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!a[i].value || !b[i].value) continue;
    ++agreement.compared;
    agreement.within += IsWithin(a[i], b[i]);
  }
  return agreement;
}

std::string StatisticsTable(const std::vector<std::pair<std::string, SensorStatistics>>& columns, bool compares) {
  constexpr int kNameWidth = 31, kUnitWidth = 3;
  std::vector<std::vector<StatisticRow>> rows;
  std::string text = fmt::format("{:<{}} {:<{}}", "", kNameWidth, "", kUnitWidth);
  const auto out = std::back_inserter(text);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    fmt::format_to(out, " {:>12}{}", columns[c].first, compares && c == 1 ? fmt::format("{:>9}", "") : "");
    rows.push_back(RowsOf(columns[c].second));
  }
  text += '\n';
  for (std::size_t r = 0; !rows.empty() && r < rows[0].size(); ++r) {
    fmt::format_to(out, "{:<{}} {:<{}}", rows[0][r].name, kNameWidth, rows[0][r].unit, kUnitWidth);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      fmt::format_to(out, " {:>12}", CellText(rows[c][r]));
      if (compares && c == 1) fmt::format_to(out, "  {:<7}", Held(rows[0][r], rows[c][r]));
    }
    while (text.back() == ' ') text.pop_back();
    text += '\n';
  }
  return text;
}

}  // namespace etude
