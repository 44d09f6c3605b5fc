#pragma once

#include <string>
#include <vector>

#include "bench/metrics/catalogue.h"
#include "bench/model/row.h"

namespace etude {

/// What one metric of two methods (or of one method in two runs) was measured on in one world (JudgedOn).
struct JudgedPair {
  struct Side {
    const std::vector<std::string>* parts = nullptr;
    double rate_hz = 0;
    double share = 1;
  };
  Side baseline, method;
};

/// Returns why the values of two methods cannot be compared, although both have values: other parts of the truth were
/// judged (joints, root), another share of it, or, if the metric depends on the rate, frames of rates that differ by
/// more than 1 %. Another root and another rate count as 100 %. Returns "" if the mean difference over the worlds is
/// below kMaxShareDifference, and always for a metric of success, which measures the share itself. `worlds` are the
/// worlds in which both have a value; `baseline` and `method` are names.
std::string WhyNotAlike(const MetricInfo& metric, const std::vector<JudgedPair>& worlds, const std::string& baseline,
                        const std::string& method);

}  // namespace etude
