#include "bench/replay/compare_rows.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

constexpr const char* kAbsent = "nothing";

std::string TextOf(const Row& row, const std::string& metric) {
  for (const MetricValue& value : row.result.metrics) {
    if (value.id == metric) return value.value ? fmt::format("{}", *value.value) : "null (" + value.null_reason + ")";
  }
  return kAbsent;
}

std::string DigestOf(const Row& row, const std::string& stage) {
  for (const auto& [name, digest] : row.result.digests) {
    if (name == stage) return digest;
  }
  return kAbsent;
}

}  // namespace

CellCheck CompareRows(const Row& then, const Row& now) {
  CellCheck check{.cell = then.Id(), .same = true, .stage = "", .then = "", .now = ""};
  const auto differ = [&](const std::string& stage, const std::string& was, const std::string& is) {
    if (check.same && was != is) check = {check.cell, false, stage, was, is};
  };
  // In the order of the pipeline: the first difference is the culprit, later ones only follow from it.
  for (const Row* row : {&then, &now}) {
    for (const auto& [stage, digest] : row->result.digests) differ(stage, DigestOf(then, stage), DigestOf(now, stage));
  }
  differ("status", std::string(StatusName(then.result.status)), std::string(StatusName(now.result.status)));
  differ("reason", then.result.reason, now.result.reason);
  for (const Row* row : {&then, &now}) {
    for (const MetricValue& metric : row->result.metrics) {
      differ(metric.id, TextOf(then, metric.id), TextOf(now, metric.id));
    }
  }
  return check;
}

}  // namespace etude
