#include "bench/metrics/vectors.h"

#include <gmock/gmock.h>

#include <cmath>

#include "bench/metrics/catalogue.h"
#include "bench/metrics/evaluate.h"

namespace etude {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::vector<MetricVector>& Vectors() {
  static const auto vectors = AllVectors();
  EXPECT_TRUE(vectors) << ToString(vectors.error());
  return *vectors;
}

std::vector<MetricVector> VectorsOf(std::string_view metric) {
  std::vector<MetricVector> own;
  for (const MetricVector& vector : Vectors()) {
    if (vector.metric == metric) own.push_back(vector);
  }
  return own;
}

TEST(Vectors, AgreeWithTheProgram) {
  int checked = 0;
  for (const MetricVector& vector : Vectors()) {
    const auto value = EvaluateMetric(vector.metric, vector.input_json);
    ASSERT_TRUE(value) << vector.metric << ", " << vector.title << ": " << ToString(value.error());
    EXPECT_EQ(Disagreement(vector, *value), "");
    ++checked;
  }
  EXPECT_GE(checked, 150);
}

TEST(Vectors, AreThereForEveryMetricOfTheCatalogue) {
  for (const MetricInfo& metric : AllMetrics()) {
    EXPECT_GE(VectorsOf(metric.id).size(), 2u) << metric.id << " has too few test vectors to tell it from another";
  }
}

TEST(Vectors, UseTheInputsThatTheCatalogueNames) {
  for (const MetricInfo& metric : AllMetrics()) {
    EXPECT_FALSE(metric.inputs.empty()) << metric.id;
    for (const MetricInput& input : metric.inputs) {
      bool used = false;
      const std::string quoted = '"' + input.key + '"';
      for (const MetricVector& vector : VectorsOf(metric.id))
        used |= vector.input_json.find(quoted) != std::string::npos;
      EXPECT_TRUE(used) << metric.id << ": no vector gives '" << input.key << "'";
    }
  }
}

// The control: metrics that read the same input, such as mean and worst, or precision and recall, must differ
// somewhere, or their vectors would also pass for the other.
TEST(Vectors, LetNoMetricPassForAnother) {
  int pairs = 0;
  for (const MetricInfo& metric : AllMetrics()) {
    const std::vector<MetricVector> vectors = VectorsOf(metric.id);
    for (const MetricInfo& other : AllMetrics()) {
      if (metric.id == other.id) continue;
      bool caught = false, understood = false;
      for (const MetricVector& vector : vectors) {
        const auto value = EvaluateMetric(other.id, vector.input_json);
        if (!value) continue;
        understood = true;
        caught |= !Disagreement(vector, *value).empty();
      }
      pairs += understood;
      EXPECT_TRUE(caught || !understood) << other.id << " would pass for " << metric.id;
    }
  }
  EXPECT_GT(pairs, 50) << "too few metrics read each other's inputs for this to mean anything";
}

TEST(Vectors, ReportAnExpectationThatIsWrong) {
  for (MetricVector vector : Vectors()) {
    const auto value = EvaluateMetric(vector.metric, vector.input_json);
    ASSERT_TRUE(value);
    if (vector.expected) {
      *vector.expected += 1.01 * vector.tolerance + 1e-6 * std::max(1.0, std::abs(*vector.expected));
    } else {
      vector.expected = 0;
    }
    EXPECT_THAT(Disagreement(vector, *value), AllOf(HasSubstr(vector.metric), HasSubstr(vector.title)));
    vector.expected.reset();
    EXPECT_EQ(Disagreement(vector, *value).empty(), !*value) << "a value where none is expected, or the reverse";
  }
}

TEST(Vectors, ThatCannotBeReadAreRefusedWithTheirPlace) {
  const auto complaint = [](const std::string& vector) {
    const auto read = ReadVectors("[" + vector + "]", "mine.json");
    return read ? std::string() : ToString(read.error());
  };
  const std::string good =
      R"({"metric": "iou", "version": 1, "title": "t", "input": {}, "expected": 1, "tolerance": 0, "source": "derived: x"})";
  EXPECT_EQ(complaint(good), "");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return complaint(text.replace(text.find(from), from.size(), to));
  };
  EXPECT_THAT(with("iou", "iuo"), HasSubstr("mine.json: vector 1: the metric 'iuo' is not in the catalogue"));
  EXPECT_THAT(with("\"version\": 1", "\"version\": 2"), HasSubstr("version 2 of iou; the catalogue has 1"));
  EXPECT_THAT(with("\"expected\": 1", "\"expected\": null"), HasSubstr("null_reason"));
  EXPECT_THAT(with("derived: ", "felt: "), HasSubstr("source"));
  EXPECT_THAT(with("\"tolerance\": 0", "\"tolerance\": -1"), HasSubstr("tolerance"));
  EXPECT_THAT(with("\"title\": \"t\", ", ""), HasSubstr("title"));
}

TEST(EvaluateMetric, RefusesWhatIsNoInputOfTheMetric) {
  EXPECT_FALSE(EvaluateMetric("nonsense", "{}"));
  EXPECT_FALSE(EvaluateMetric("jump_cm", "{}"));
  EXPECT_FALSE(EvaluateMetric("jump_cm", "not JSON"));
  const auto unknown_joint =
      EvaluateMetric("jump_cm", R"({"motion": {"frames": 3, "joints_m": {"tail": [[0, 0, 0]]}}, "seams": [1]})");
  ASSERT_FALSE(unknown_joint);
  EXPECT_THAT(unknown_joint.error().message, HasSubstr("tail"));
}

}  // namespace
}  // namespace etude
