#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "bench/metrics/catalogue.h"
#include "tests/bench/metrics/evaluate.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string ValueText(std::optional<double> value) { return value ? fmt::format("{}", *value) : "no value"; }

/// Returns the difference from the vector's expected value in words; "" if it is within the tolerance.
std::string Disagreement(const MetricInfo& metric, const MetricVector& vector, std::optional<double> found) {
  const bool agrees = found && vector.expected ? std::abs(*found - *vector.expected) <= vector.tolerance
                                               : found.has_value() == vector.expected.has_value();
  if (agrees) return "";
  return fmt::format("{} of \"{}\" is {}, expected {} ± {} ({})", metric.id, vector.title, ValueText(found),
                     ValueText(vector.expected), vector.tolerance, vector.source);
}

TEST(Vectors, AgreeWithTheProgram) {
  int checked = 0;
  for (const MetricInfo& metric : AllMetrics()) {
    for (const MetricVector& vector : metric.vectors) {
      const auto value = EvaluateMetric(metric.id, vector.input_json);
      ASSERT_TRUE(value) << metric.id << ", " << vector.title << ": " << ToString(value.error());
      EXPECT_EQ(Disagreement(metric, vector, *value), "");
      ++checked;
    }
  }
  EXPECT_GE(checked, 150);
}

TEST(Vectors, AreThereForEveryMetricOfTheCatalogue) {
  for (const MetricInfo& metric : AllMetrics()) {
    EXPECT_GE(metric.vectors.size(), 2u) << metric.id << " has too few test vectors to tell it from another";
  }
}

TEST(Vectors, UseTheInputsThatTheCatalogueNames) {
  for (const MetricInfo& metric : AllMetrics()) {
    EXPECT_FALSE(metric.inputs.empty()) << metric.id;
    for (const MetricInput& input : metric.inputs) {
      bool used = false;
      const std::string quoted = '"' + input.key + '"';
      for (const MetricVector& vector : metric.vectors)
        used |= vector.input_json.find(quoted) != vector.input_json.npos;
      EXPECT_TRUE(used) << metric.id << ": no vector gives '" << input.key << "'";
    }
  }
}

/// Returns true if both metrics have the same input keys.
bool HaveEqualInputs(const MetricInfo& a, const MetricInfo& b) {
  return std::ranges::equal(a.inputs, b.inputs, {}, &MetricInput::key, &MetricInput::key);
}

/// The control: two metrics of the same inputs, such as mean and worst, must differ in some vector. Tries every pair of
/// metrics that `is_tried` accepts, and returns the number of pairs in which the second metric reads the first one's
/// vectors.
template <typename IsTried>
int TryMetricsForEachOther(IsTried is_tried) {
  int pairs = 0;
  for (const MetricInfo& metric : AllMetrics()) {
    for (const MetricInfo& other : AllMetrics()) {
      if (metric.id == other.id || !is_tried(metric, other)) continue;
      bool caught = false, understood = false;
      for (const MetricVector& vector : metric.vectors) {
        if (caught) break;
        const auto value = EvaluateMetric(other.id, vector.input_json);
        if (!value) continue;
        understood = true;
        caught |= !Disagreement(metric, vector, *value).empty();
      }
      pairs += understood;
      EXPECT_TRUE(caught || !understood) << other.id << " would pass for " << metric.id;
    }
  }
  return pairs;
}

TEST(Vectors, LetNoMetricPassForAnotherOfTheSameInputs) { EXPECT_GT(TryMetricsForEachOther(HaveEqualInputs), 50); }

TEST(Vectors, HEAVY_LetNoMetricPassForAnother) {
  EXPECT_GT(TryMetricsForEachOther([](const auto&, const auto&) { return true; }), 50);
}

TEST(Vectors, ReportAnExpectationThatIsWrong) {
  for (const MetricInfo& metric : AllMetrics()) {
    for (MetricVector vector : metric.vectors) {
      ASSERT_OK(value, EvaluateMetric(metric.id, vector.input_json));
      if (vector.expected) {
        *vector.expected += 1.01 * vector.tolerance + 1e-6 * std::max(1.0, std::abs(*vector.expected));
      } else {
        vector.expected = 0;
      }
      EXPECT_THAT(Disagreement(metric, vector, *value),
                  AllOf(HasSubstr(metric.id), HasSubstr(std::string(vector.title))));
      vector.expected.reset();
      EXPECT_EQ(Disagreement(metric, vector, *value).empty(), !*value)
          << "a value where none is expected, or the reverse";
    }
  }
}

TEST(EvaluateMetric, RefusesWhatIsNoInputOfTheMetric) {
  EXPECT_FALSE(EvaluateMetric("nonsense", "{}"));
  EXPECT_FALSE(EvaluateMetric("jump_cm", "{}"));
  EXPECT_FALSE(EvaluateMetric("jump_cm", "not JSON"));
  const auto unknown_joint =
      EvaluateMetric("jump_cm", R"({"motion": {"frames": 3, "joints_m": {"tail": [[0, 0, 0]]}}, "transition_points": [1]})");
  EXPECT_THAT(testing::Message(unknown_joint), HasSubstr("tail"));
}

}  // namespace
}  // namespace etude
