#include "bench/sensor_fit/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace etude {
namespace {

std::string CellText(const StatisticRow& row) { return row.value ? fmt::format("{:.2f}", *row.value) : "-"; }

bool IsWithin(const StatisticRow& reference, const StatisticRow& other) {
  if (reference.held_by == HeldBy::kDifference) {
    return std::abs(*other.value - *reference.value) <= kCorrelationTolerance;
  }
  return *reference.value > 0 && std::abs(*other.value / *reference.value - 1) <= kSizeTolerance;
}

std::string Held(const StatisticRow& reference, const StatisticRow& other) {
  if (!reference.value || !other.value) return "";
  const char* mark = IsWithin(reference, other) ? "" : " !";
  if (reference.held_by == HeldBy::kDifference) {
    return fmt::format("{:+.2f}{}", *other.value - *reference.value, mark);
  }
  return *reference.value > 0 ? fmt::format("x{:.2f}{}", *other.value / *reference.value, mark) : "";
}

}  // namespace

std::vector<StatisticRow> RowsOf(const SensorStatistics& statistics) {
  std::vector<StatisticRow> rows;
  const auto add = [&](std::string name, const char* unit, const std::optional<double>& value,
                       HeldBy held_by = HeldBy::kRatio) {
    rows.push_back({std::move(name), unit, held_by, value});
  };
  for (const JointGroup group : AllJointGroups()) {
    if (group == JointGroup::kFeet) continue;
    add(fmt::format("error of {}", GroupName(group)), "mm", statistics.error_mm[Index(group)]);
  }
  add("error of shoulders and hips", "mm", statistics.shoulders_and_hips_mm);
  add("error of all feet", "mm", statistics.error_mm[Index(JointGroup::kFeet)]);
  add("error of planted feet", "mm", statistics.planted_feet_mm);
  for (const JointGroup group : AllJointGroups()) {
    add(fmt::format("depth : across, {}", GroupName(group)), "", statistics.depth_ratio[Index(group)]);
  }
  for (const BoneKind kind : AllBoneKinds()) {
    std::string name(BoneName(kind));
    std::ranges::replace(name, '_', ' ');
    add("correlation along " + name, "", statistics.correlation[Index(kind)], HeldBy::kDifference);
  }
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
