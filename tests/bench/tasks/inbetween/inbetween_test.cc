#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/inbetween/windows.h"
#include "engine/document/node.h"
#include "io/clips/clip_library.h"
#include "io/clips/references.h"
#include "io/files/temporary_folder.h"
#include "tests/support/kept_answers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

constexpr const char* kFiles = "truth: [assimp:01_03], training: [assimp:01_01], rate_hz: 30";

struct Study {
  std::vector<JudgedFiles> windows;
  std::unique_ptr<Task> task;
};

Result<Study> StudyOf(const std::string& keys, const std::string& filler) {
  ASSIGN_OR_RETURN(const auto condition, ParseYaml("{" + keys + "}", "s.yaml"));
  ASSIGN_OR_RETURN(
      const auto method,
      ParseYaml("{name: a, " + (filler == "hidden" ? "oracle: [frames]" : "filler: " + filler) + "}", "s.yaml"));
  const std::span methods(&method, 1);
  ASSIGN_OR_RETURN(auto found, FindWindows(condition, methods, {}));
  Fields fields(condition, "a condition");
  const ClipLibrary no_clips;
  TaskInput input{fields, methods, no_clips};
  input.files = found.worlds;
  ASSIGN_OR_RETURN(auto task, MakeInbetweenTaskKind().make(input));
  RETURN_IF_ERROR(fields.Finish());
  return Study{std::move(found.worlds), std::move(task)};
}

std::unique_ptr<TaskWorld> WorldOf(const Study& study, int trial) {
  return study.task->MakeWorld({1, "s", trial}, false);
}

double Measured(const CellResult& result, const std::string& id) {
  for (const MetricValue& metric : result.metrics) {
    if (metric.id == id) return metric.value.value_or(-1);
  }
  return -2;
}

/// L2P, L2Q and NPSS over all windows, averaged as in a run.
struct Distances {
  double l2p = 0, l2q = 0, npss = 0;
};

Distances DistancesOf(const std::string& keys, const std::string& filler, std::size_t windows) {
  const auto study = StudyOf(keys, filler);
  EXPECT_TRUE(study) << ToString(study.error());
  EXPECT_EQ(study->windows.size(), windows);
  Distances mean;
  double power = 0;
  for (std::size_t trial = 0; trial < windows; ++trial) {
    const CellResult result = WorldOf(*study, static_cast<int>(trial))->Run(0);
    mean.l2p += Measured(result, "l2p@lafan1") / static_cast<double>(windows);
    mean.l2q += Measured(result, "l2q@lafan1") / static_cast<double>(windows);
    mean.npss += Measured(result, "npss@lafan1") * Measured(result, "npss_power@lafan1");
    power += Measured(result, "npss_power@lafan1");
  }
  mean.npss /= power;
  return mean;
}

/// Values that the benchmark's own code computes from every fourth frame of kFiles: get_lafan1_set, get_train_stats and
/// benchmark_interpolation of ubisoft/ubisoft-laforge-animation-dataset 9408460, with its own BVH reader. Its number of
/// joints, 22, was replaced by the files' number.
struct Known {
  int gap;
  const char* filler;
  double l2p, l2q, npss;
};
constexpr Known kKnown[] = {{5, "zero-velocity", 2.3656142542622094, 0.4966549082713087, 0.004297833756201702},
                            {5, "interpolation", 0.5517855141646711, 0.25358764596597905, 0.002416645806239408},
                            {15, "zero-velocity", 6.033227322137425, 1.0794794933508616, 0.03978111587567852},
                            {15, "interpolation", 1.8733076677237197, 0.553268653387676, 0.025372097729388324},
                            {30, "zero-velocity", 10.095389900945774, 1.5349829882192936, 0.1721970260278843},
                            {30, "interpolation", 4.145798930708553, 0.937078937780961, 0.1443864832185145},
                            {45, "zero-velocity", 13.095840533303804, 1.8686101658655785, 0.33940968437320324},
                            {45, "interpolation", 6.017234810390206, 1.1953154006794986, 0.3067619453809995}};

TEST(Inbetween, GivesTheFiguresOfTheSource) {
  for (const Known& known : kKnown) {
    const std::string what = fmt::format("{}, gap {}", known.filler, known.gap);
    const Distances found = DistancesOf(fmt::format("{}, gap: {}", kFiles, known.gap), known.filler, 27);
    EXPECT_NEAR(found.l2p, known.l2p, 1e-6) << what;
    EXPECT_NEAR(found.l2q, known.l2q, 1e-6) << what;
    EXPECT_NEAR(found.npss, known.npss, 1e-6) << what;
  }
}

TEST(Inbetween, GivesOtherFiguresByAnotherProtocol) {
  const Known& known = kKnown[5];
  for (const char* other : {"facing: x", "past: 11", "training_window: 40"}) {
    const Distances found = DistancesOf(fmt::format("{}, {}", kFiles, other), known.filler, 27);
    EXPECT_GT(std::abs(found.l2p - known.l2p), 1e-4) << other;
  }
}

/// Returns a program's answer: the truth changed by `change`.
template <typename Change>
CellResult JudgedAfter(TaskWorld& world, const Change& change) {
  Json answer = *world.MakeTruth()->json;
  int frame = 0;
  for (Json& pose : answer.at("frames")) change(pose, frame++);
  const auto result = world.Judge(answer);
  EXPECT_TRUE(result) << ToString(result.error());
  return result.value_or(CellResult{});
}

/// Returns the first window in which the truth is supported and its feet rest.
std::unique_ptr<TaskWorld> StandingWorld(const Study& study) {
  for (std::size_t trial = 0; trial < study.windows.size(); ++trial) {
    auto world = WorldOf(study, static_cast<int>(trial));
    const CellResult own = world->Run(0);
    if (Measured(own, "clean_share") == 1 && Measured(own, "foot_slide_cmps") < 3) return world;
  }
  return nullptr;
}

TEST(Inbetween, KnowsTheTruthAndWhatIsDoneToIt) {
  ASSERT_OK(study, StudyOf("truth: ['builtin:warm_up'], training: ['builtin:sprint'], facing: z", "hidden"));
  const auto world = StandingWorld(*study);
  ASSERT_NE(world, nullptr);
  const CellResult own = world->Run(0);
  for (const char* id : {"l2p@lafan1", "l2q@lafan1", "npss@lafan1", "mpjpe_unaligned_mm"})
    EXPECT_EQ(Measured(own, id), 0) << id;
  // The truth itself, sent by a program.
  const CellResult same = JudgedAfter(*world, [](Json&, int) {});
  EXPECT_LT(Measured(same, "mpjpe_unaligned_mm") + Measured(same, "l2q@lafan1"), 1e-9);
  EXPECT_EQ(Measured(same, "supported_share"), 1);
  EXPECT_EQ(Measured(same, "clean_share"), 1);
  // Lifted by 10 cm, the body floats, has an error of 10 cm, and jumps at both ends.
  const CellResult lifted = JudgedAfter(*world, [](Json& pose, int) { pose[1] = pose[1].get<double>() + 0.1; });
  EXPECT_EQ(Measured(lifted, "supported_share"), 0);
  EXPECT_EQ(Measured(lifted, "clean_share"), 0);
  EXPECT_NEAR(Measured(lifted, "mpjpe_unaligned_mm"), 100, 1e-9);
  EXPECT_NEAR(Measured(lifted, "l2q@lafan1"), 0, 1e-12);
  EXPECT_GT(Measured(lifted, "jitter@wham"), 2 * Measured(own, "jitter@wham"));
  // The body glides along X by 1 cm per frame.
  const CellResult glides = JudgedAfter(*world, [](Json& pose, int f) { pose[0] = pose[0].get<double>() + 0.01 * f; });
  EXPECT_GT(Measured(glides, "foot_slide_cmps"), Measured(own, "foot_slide_cmps") + 5);
  EXPECT_EQ(Measured(glides, "clean_share"), 0);
  // The body shakes along Z by ±2 mm.
  const CellResult shakes =
      JudgedAfter(*world, [](Json& pose, int f) { pose[2] = pose[2].get<double>() + (f % 2 ? 0.002 : -0.002); });
  EXPECT_GT(Measured(shakes, "jitter@wham"), Measured(own, "jitter@wham") + 10);
}

TEST(Inbetween, SaysWhyAFillingIsNeitherCleanNorNot) {
  const auto reason = [](const std::string& keys) {
    const auto study = StudyOf(keys, "interpolation");
    EXPECT_TRUE(study) << ToString(study.error());
    for (const MetricValue& metric : WorldOf(*study, 0)->Run(0).metrics) {
      if (metric.id == "clean_share") return metric.value ? "measured" : metric.null_reason;
    }
    return std::string("not reported");
  };
  EXPECT_EQ(reason(kFiles), "measured");
  EXPECT_EQ(reason("truth: [assimp:01_03], training: [assimp:01_01], rate_hz: 60"), "the rate is not 30 Hz");
}

TEST(Inbetween, TakesAFillerOrTheTruth) {
  const auto complaint = [](const std::string& method) { return testing::Message(StudyOf(kFiles, method)); };
  EXPECT_EQ(complaint("interpolation"), "accepted");
  EXPECT_EQ(complaint("hidden"), "accepted");
  EXPECT_THAT(complaint("interpolation, oracle: [frames]"), HasSubstr("exactly one of 'filler' and 'oracle: "
                                                                      "[frames]'"));
}

TEST(Inbetween, TellsAProgramTheEndsAndNoMore) {
  ASSERT_OK(study, StudyOf(kFiles, "interpolation"));
  const auto world = WorldOf(*study, 3);
  const auto problem = world->MakeProblem(), truth = world->MakeTruth();
  ASSERT_TRUE(problem && truth);
  EXPECT_EQ(problem->json->at("past").size(), 10u);
  EXPECT_EQ(problem->json->at("future").size(), 1u);
  EXPECT_EQ(problem->json->at("gap"), 30);
  EXPECT_THAT(problem->json->dump(), ::testing::Not(HasSubstr(truth->json->at("frames")[0][0].dump())));
  const auto complaint = [&](const auto& change) {
    Json answer = *truth->json;
    change(answer.at("frames"));
    return testing::Message(world->Judge(answer));
  };
  EXPECT_EQ(complaint([](Json&) {}), "accepted");
  EXPECT_THAT(complaint([](Json& frames) { frames.erase(0); }), HasSubstr("frames"));
  EXPECT_THAT(complaint([](Json& frames) {
                for (std::size_t i = 0; i < 4; ++i) frames[2][7 + i] = i < 2 ? 1 : 0;
              }),
              HasSubstr("frames[2][7…10]: a quaternion of length 1.41"));
  EXPECT_THAT(complaint([](Json& frames) { frames[2].erase(0); }), HasSubstr("frames[2]"));
  EXPECT_THAT(complaint([](Json& frames) { frames[4][0] = 1e9; }), HasSubstr("frames[4]"));
}

TEST(Inbetween, KnowsCopiesOfAFile) {
  const TemporaryFolder folder = *TemporaryFolder::Make("inbetween-test");
  const std::string original = FileOf("assimp:01_03"), copy = (folder.path() / "copy.bvh").string();
  std::filesystem::copy_file(original, copy);
  const auto refusal = [](const std::string& truth, const std::string& training) {
    return testing::Refusal(StudyOf("truth: [" + truth + "], training: [" + training + "]", "interpolation"));
  };
  EXPECT_THAT(refusal("assimp:01_03", copy),
              HasSubstr("'" + copy + "' is in 'truth' and in 'training' (in 'truth' as 'assimp:01_03')"));
  EXPECT_THAT(refusal("assimp:01_03, " + copy, "assimp:01_01"), HasSubstr("are the same motion"));
}

TEST(Inbetween, RefusesWhatCannotBeJudged) {
  EXPECT_TRUE(testing::AnswersAreKept("tests/bench/tasks/inbetween/complaints.txt", [](const std::string& keys) {
    return testing::Refusal(StudyOf(keys, "interpolation"));
  }));
  // No training clip has this skeleton.
  ASSERT_OK(study, StudyOf("truth: [assimp:Boxing_Toes], training: [assimp:01_01], rate_hz: 30", "interpolation"));
  EXPECT_THAT(WorldOf(*study, 0)->WhySkipped().value_or(""), HasSubstr("no training clip has the same joints"));
}

}  // namespace
}  // namespace etude
