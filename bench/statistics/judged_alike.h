#pragma once

#include <string>
#include <vector>

#include "bench/metrics/catalogue.h"
#include "bench/model/row.h"

namespace etude {

/// The data of one world (JudgedOn) on which one metric of two methods, or of one method in two runs, was measured.
struct JudgedPair {
  struct Side {
    const std::vector<std::string>* parts = nullptr;
    double rate_hz = 0, compared_hz = 0;  ///< as in JudgedOn
    double share = 1;
  };
  Side baseline, method;
};

/// Returns why the values of two methods cannot be compared, or "" if they can. `worlds` are the worlds in which both
/// methods have a value; `baseline` and `method` are names. In each world, the two differ by the largest of:
/// - the share of the judged joints that only one of them was judged on (1 if the metric needs the root and their roots
///   differ);
/// - the difference between the shares of the truth on which they were judged;
/// - 1 if the metric depends on the rate and the rates differ by more than 1 %. A metric that compares answer and truth
///   has the rate at which both are compared; a metric of the answer alone has the answer's rate.
/// They cannot be compared if the mean over the worlds is kMaxShareDifference or more. A metric of success is always
/// compared, because it measures the share itself. A metric that does not depend on the rate is compared at any rate:
/// evenly spaced frames of the same span have the same mean.
std::string WhyNotAlike(const MetricInfo& metric, const std::vector<JudgedPair>& worlds, const std::string& baseline,
                        const std::string& method);

}  // namespace etude
