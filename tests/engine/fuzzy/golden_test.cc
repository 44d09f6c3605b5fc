// Golden values of whole results: shapes, distances and similarities of poses that come from anywhere.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/fuzzy/defuzzify.h"
#include "engine/fuzzy/fuzzy_motion.h"
#include "engine/fuzzy/fuzzy_system.h"
#include "engine/fuzzy/weights.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Dice;
using testing::Fingerprint;

BodyMotion WanderingBody(std::uint64_t seed, int frames, double pace) {
  Dice dice(seed);
  BodyPose from, to;
  for (glm::dvec3& joint : from.joints) joint = dice.Vector();
  for (glm::dvec3& joint : to.joints) joint = dice.Vector();
  from[Role::kHipCentre].y = 0.1, to[Role::kHipCentre].y = 1.1;
  BodyMotion motion{.rate_hz = 25, .poses = {}};
  for (int t = 0; t < frames; ++t) {
    BodyPose& pose = motion.poses.emplace_back();
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      pose.joints[i] = glm::mix(from.joints[i], to.joints[i], 0.5 + 0.6 * std::sin(pace * t));
    }
  }
  return motion;
}

TEST(Fuzzy, GoldenMotionsTheirDistancesAndSimilarities) {
  Fingerprint print, names;
  std::vector<FuzzyMotion> motions;
  const FuzzySystem gaussian = LoadBuiltinFuzzySystem("gaussian", {}).value();
  for (int i = 0; i < 6; ++i) {
    const BodyMotion motion = WanderingBody(i / 2, 17 + 9 * i, 0.2 - 0.02 * i);
    const double hips = StandingHipHeight(motion.poses[3]);
    const FuzzyMotion fuzzy = FuzzifyMotion(motion, 0.8 * hips, i % 3 == 2 ? gaussian : FuzzySystem{});
    print.Add(hips).Add(fuzzy.rate_hz).Add(fuzzy.grades).Add(fuzzy.tags);
    for (const PoseFeatures& features : fuzzy.features) print.Add(features.values);
    for (const std::string& pose : fuzzy.poses) names.Add(pose);
    for (const Grades& grades : fuzzy.grades) print.Add(InferPoses(PaperRules(), grades));
    for (const Feature feature : AllFeatures()) {
      for (const Defuzzification method : AllDefuzzifications()) {
        print.Add(DefuzzifyFeature(fuzzy.grades[5], feature, PaperMemberships(), method));
      }
    }
    motions.push_back(fuzzy);
  }
  const FeatureWeights weights = {0.5, 1.5, 1, 0.2, 0.8, 1, 1, 0.6, 0.4, 1};
  for (const FuzzyMotion& a : motions) {
    for (const FuzzyMotion& b : motions) {
      const FuzzyDistance distance = ComputeDistance(a.grades[4], b.grades[9], weights);
      print.Add(distance.value).Add(distance.partials).Add(SquaredGradeGaps(a.grades[2], b.grades[7]));
      for (const double share : {0.7, 1.0, 1.1}) {
        print.Add(IsCloser(a.grades[4], b.grades[9], weights, share * distance.value));
      }
      for (const double band : {0.0, 0.07, 0.3, 1.0}) {
        print.Add(ComputeMotionSimilarity(a.grades, b.grades, {.band = band}));
        print.Add(ComputeMotionSimilarity(a.grades, b.grades,
                                          {.weights = weights, .band = band, .half_at = 0.9, .at_least = 0.45}));
      }
    }
  }
  EXPECT_TRUE(print.Is(15917, 4720.3423337));
  EXPECT_TRUE(names.Is(1491, 2355.1811786));
}

Shape RandomShape(Dice& dice, int kind) {
  std::array<double, 4> x;
  for (double& number : x) number = 90 + 130 * dice.Signed();
  std::ranges::sort(x);
  if (kind == 0) return Triangular{x[0], x[1], x[3]};
  if (kind == 1) return Trapezoidal{x[0], x[1], x[2], x[3]};
  return kind == 2 ? Shape(Gaussian{x[1], 0.2 * (x[3] - x[0])}) : Shape(Singleton{x[1]});
}

TEST(Fuzzy, GoldenShapesAndTheirDefuzzifications) {
  Fingerprint print;
  Dice dice(2);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<ActivatedTerm> terms;
    const int count = 1 + trial % 4;
    for (int i = 0; i < count; ++i) {
      const int kind = trial % 7 == 0 ? 3 : static_cast<int>(dice.Below(4));
      const double grade = dice.Below(6) == 0 ? 1 : dice.Below(9) == 0 ? 0 : 0.5 + 0.5 * dice.Signed();
      terms.push_back({RandomShape(dice, kind), i > 0 && dice.Below(3) == 0 ? terms[0].grade : grade});
      for (const double at : {0.0, 47.0, 131.0}) print.Add(GradeOf(terms.back().shape, at));
      const Cut cut = CutOf(terms.back().shape, 0.3);
      print.Add(cut.low).Add(cut.high);
    }
    for (const Defuzzification method : AllDefuzzifications()) print.Add(Defuzzify(terms, {0, 180}, method));
  }
  EXPECT_TRUE(print.Is(6050, 1982.297966));
}

TEST(Fuzzy, GoldenWeights) {
  Fingerprint print;
  for (int trial = 0; trial < 18; ++trial) {
    Dice dice(trial);
    std::vector<LabelledPair> pairs(60);
    for (LabelledPair& pair : pairs) {
      double sum = 0;
      for (std::size_t k = 0; k < kFeatureCount; ++k) {
        pair.squared_gaps[k] = std::abs(dice.Signed());
        sum += (static_cast<double>(k) - 2) * pair.squared_gaps[k];
      }
      pair.close = (trial % 6 == 5 ? -sum : sum) + 4 * dice.Signed() < 11;
    }
    const WeightFit fit = FitWeights(pairs, {.ridge = trial % 2 == 0 ? 1e-2 : 3,
                                             .max_iterations = 3 + trial / 3,
                                             .tolerance = trial % 3 == 0 ? 0.2 : 1e-4});
    print.Add(fit.status).Add(fit.weights).Add(fit.pairs).Add(fit.close_pairs).Add(fit.iterations);
  }
  EXPECT_TRUE(print.Is(270, 137.144768051));
}

// The system of paper A with something else in it, and what is said of that.
std::string ComplaintOf(const std::string& found, const std::string& replacement) {
  std::string text = WriteFuzzySystem({});
  const std::size_t at = text.find(found);
  EXPECT_NE(at, std::string::npos) << found;
  if (at != std::string::npos) text.replace(at, found.size(), replacement);
  const auto read = ReadFuzzySystem(text, "f.yaml");
  return read ? "none" : ToString(read.error());
}

TEST(FuzzySystem, TakesWhatIsAtABoundAndNothingBeyond) {
  const auto named = [](const std::string& name) { return ComplaintOf("system: paper", "system: '" + name + "'"); };
  const auto posed = [](const std::string& pose) { return ComplaintOf("then: at rest", "then: '" + pose + "'"); };
  const auto shaped = [](const std::string& shape) { return ComplaintOf("{triangular: [20, 90, 180]}", shape); };
  EXPECT_EQ(named(std::string(80, 'a')), "none");
  EXPECT_EQ(named(std::string(81, 'a')),
            "f.yaml:1:9: '" + std::string(40, 'a') + "…' is no name: at most 80 letters, digits, '-', '_', '.'");
  EXPECT_EQ(named("azAZ09-_."), "none");
  for (const char* bad : {"a/", "a:", "a@", "a[", "a`", "a{", "a "}) EXPECT_NE(named(bad), "none") << bad;
  EXPECT_EQ(posed("azAZ09 -x"), "none");
  EXPECT_EQ(posed(std::string(40, 'Z')), "none");
  for (const std::string& bad : {std::string(41, 'z'), std::string("0a"), std::string("a "), std::string("a/"),
                                 std::string("a:"), std::string("a@"), std::string("a["), std::string("a`"),
                                 std::string("a{"), std::string("-a"), std::string("[a"), std::string("{a")}) {
    EXPECT_NE(posed(bad), "none") << bad;
  }
  for (const char* good :
       {"{gaussian: [180, 0.001]}", "{triangular: [-1000000, 90, 1000000]}", "{singleton: 0}",
        "{trapezoidal: [5, 5, 5, 5]}", "{gaussian: [0, 30]}", "{trapezoidal: [180, 180, 190, 200]}"}) {
    EXPECT_EQ(shaped(good), "none");
  }
  EXPECT_EQ(shaped("{gaussian: [90, 0.0009]}"), "f.yaml:8:28: sigma must be at least 0.001, found 0.0009");
  EXPECT_EQ(shaped("{triangular: [20, 90, 1000001]}"), "f.yaml:8:34: 1000001 is out of range; allowed: ±1000000");
  EXPECT_EQ(shaped("{trapezoidal: [181, 182, 183, 184]}"),
            "f.yaml:8:26: no input of the universe [0, 180] has grade 1 here: the top is at 182 to 183");
  EXPECT_EQ(shaped("{singleton: -1}"),
            "f.yaml:8:24: no input of the universe [0, 180] has grade 1 here: the top is at -1");
  EXPECT_EQ(shaped("{triangular: [20, 90, 89]}"),
            "f.yaml:8:34: 'triangular' needs rising numbers [left, peak, right], found 89 after 90");
  EXPECT_EQ(shaped("{a: 1, b: 2}"),
            "f.yaml:8:12: a term needs one shape, such as {triangular: [20, 90, 180]}; found 2 keys. Allowed: "
            "triangular, trapezoidal, gaussian, singleton");
  EXPECT_EQ(ComplaintOf("weight: 1\n", "weight: 1000000\n"), "none");
  EXPECT_NE(ComplaintOf("weight: 1\n", "weight: 1000001\n"), "none");
  EXPECT_EQ(ComplaintOf("universe: [0, 180]", "universe: [-1000000, 1000000]"), "none");
  EXPECT_NE(ComplaintOf("universe: [0, 180]", "universe: [-1000001, 180]"), "none");
  EXPECT_NE(ComplaintOf("universe: [0, 180]", "universe: [180, 180]"), "none");
  std::string rules;
  for (std::size_t i = PaperRules().rules.size(); i < 100; ++i) rules += "  - {if: {RH: up}, then: more}\n";
  EXPECT_EQ(ComplaintOf("rules:\n", "rules:\n" + rules), "none");
  EXPECT_EQ(
      ComplaintOf("rules:\n", "rules:\n  - {if: {RH: up}, then: more}\n" + rules).find("'rules' must be a list of "),
      std::string("f.yaml:59:3: ").size());
}

}  // namespace
}  // namespace etude
