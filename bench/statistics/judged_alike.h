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
    double rate_hz = 0, compared_hz = 0;  ///< as in JudgedOn
    double share = 1;
  };
  Side baseline, method;
};

/// Returns why the values of two methods cannot be compared, although both have values: other parts of the truth were
/// judged (joints and the root, if the metric needs them), another share of it, or, if the metric depends on the rate,
/// frames of rates that differ by more than 1 %. A metric that compares answer and truth uses the rate at which
/// both are compared. A metric of the answer alone uses the answer's rate. The metric's inputs say what it needs.
/// Another root and another rate count as 100 %. Returns "" if the mean difference over the worlds is below
/// kMaxShareDifference, and always for a metric of success, which measures the share itself. For other metrics, such as
/// errors of poses, fewer frames of the same span do not matter: evenly spaced frames have the same mean. `worlds` are
/// the worlds in which both have a value; `baseline` and `method` are names.
std::string WhyNotAlike(const MetricInfo& metric, const std::vector<JudgedPair>& worlds, const std::string& baseline,
                        const std::string& method);

}  // namespace etude
