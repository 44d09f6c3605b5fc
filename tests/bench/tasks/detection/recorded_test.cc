#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "bench/tasks/base/pose_json.h"
#include "bench/tasks/detection/label_scores.h"
#include "bench/tasks/detection/recorded_faults.h"
#include "bench/tasks/detection/recorded_task.h"
#include "engine/base/directions.h"
#include "engine/base/named.h"
#include "engine/teaching/moves_file.h"
#include "tests/bench/tasks/detection/detection_fixture.h"
#include "tests/io/streams/record_people.h"
#include "tests/support/results.h"
#include "tests/support/run_world.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> kDanced = {"boxing", "clap", "robot", "side_kick", "stretch"};

class RecordedPeopleTest : public DetectionFixture {
 protected:
  static LabelledStreams SetOf(const Recorded& recorded) {
    LabelledStreams set = *LabelStreams(recorded.streams, {});
    set.parts = recorded.parts;
    set.moves = kDanced;
    set.file = "labels.csv";
    set.nobody = "";
    return set;
  }

  static Result<std::unique_ptr<Task>> MakeTask(const std::string& yaml, const LabelledStreams& set,
                                                const std::string& moves = "") {
    ASSIGN_OR_RETURN(auto node, ParseYaml(yaml, "test.yaml"));
    Fields condition(node, "a detection scenario");
    const ClipLibrary none;
    TaskInput input{.condition = condition, .methods = node.Find("methods")->items, .clips = none};
    input.recordings = &set;
    input.texts["moves"] = moves;
    return MakeDetectionTaskKind().make(input);
  }

  static std::string ComplaintAbout(const std::string& yaml, const LabelledStreams& set) {
    return testing::Refusal(MakeTask(yaml, set));
  }
};

TEST_F(RecordedPeopleTest, OnePersonLeftOutIsNamedAsTheRecordingsOwnScoreHasIt) {
  const Recorded recorded = Record(5, kDanced, 10);
  const LabelledStreams set = SetOf(recorded);
  for (const char* name : {"dtw", "key-pose"}) {
    WatchOptions options;
    options.recogniser.kind = FindRecogniser(name);
    const auto out = LeaveOnePersonOut(recorded.streams, recorded.parts, "labels.csv", options);
    const auto task = *MakeTask("methods: [{name: a, recogniser: " + std::string(name) + "}]\n", set);
    double named = 0;
    for (int trial = 0; trial < 5; ++trial) {
      const CellResult cell = RunWorld(*task, World(trial), 1).front();
      ASSERT_EQ(cell.status, Status::kOk) << cell.reason;
      named += *ValueOf(cell, "move_named") / 5;
      EXPECT_EQ(task->ClipsOf(World(trial)).front(), "person-" + std::to_string(trial));
    }
    EXPECT_NEAR(named, *Accuracy(out->verdicts), 1e-12) << name;
  }
}

TEST_F(RecordedPeopleTest, ProgramsAreTaughtWhatBuiltInRecognisersAreAndNothingOfWhoIsJudged) {
  const LabelledStreams set = SetOf(Record(3, kDanced, 10));
  const auto task = *MakeTask("methods: [{name: a, recogniser: dtw}]\n", set);
  ASSERT_TRUE(task->HasOwnSettings());
  for (int trial = 0; trial < 3; ++trial) {
    const std::string judged = "person-" + std::to_string(trial);
    const auto world = task->MakeWorld(World(trial), false);
    const Payload setting = *world->MakeSetting();
    const auto fold = *MakeFold(set, {}, {judged}, {});
    const Json& moves = (*setting.json)["moves"];
    ASSERT_EQ(moves.size(), fold.repertoire.names.size());
    std::size_t told = 0;
    for (const Json& move : moves) {
      const TaughtMove* taught = FindByName(fold.repertoire.taught, move["name"].get<std::string>());
      ASSERT_EQ(move["examples"].empty(), taught == nullptr);
      if (taught == nullptr) continue;
      ASSERT_EQ(move["examples"].size(), taught->examples.size() + taught->counter_examples.size());
      EXPECT_EQ(move["poses"].size(), taught->examples.front().frames.size());
      EXPECT_EQ(move["key_poses"].size(), taught->poses.size());
      for (std::size_t i = 0; i < taught->examples.size(); ++i) {
        const Json& example = move["examples"][i];  // nobody errs: all are right, in the order of teaching
        EXPECT_NE(example["person"], judged);
        EXPECT_TRUE(example["is_right"]);
        EXPECT_EQ(example["frames"].size(), taught->examples[i].frames.size());
        EXPECT_EQ(example["frames"][0]["pose"], EncodePose(PoseOf(taught->examples[i].frames[0])));
        ++told;
      }
    }
    EXPECT_GT(told, 10u);
  }
  // With moves taught beforehand all people share one setting with the same examples.
  const auto fold = *MakeFold(set, {}, {}, {});
  const std::string file = WriteMoves(fold.repertoire.taught);
  const auto taught = *MakeTask("moves: moves.yaml\nmethods: [{name: a, recogniser: dtw}]\n", set, file);
  EXPECT_FALSE(taught->HasOwnSettings());
  const Payload setting = *taught->Setting();
  EXPECT_EQ((*setting.json)["moves"][0]["examples"].size(), fold.repertoire.taught[0].examples.size());
}

TEST_F(RecordedPeopleTest, LabelsThatMeanNothingAreGuessed) {
  Recorded recorded = Record(4, kDanced, 10);
  for (LabelledPart& part : recorded.parts) {
    const auto at = static_cast<std::size_t>(std::ranges::find(kDanced, part.move) - kDanced.begin());
    part.move = kDanced[(at + part.stream) % kDanced.size()];
  }
  const LabelledStreams set = SetOf(recorded);
  const auto task = *MakeTask("methods: [{name: a, recogniser: dtw}]\n", set);
  double named = 0;
  for (int trial = 0; trial < 4; ++trial) {
    named += *ValueOf(RunWorld(*task, World(trial), 1).front(), "move_named") / 4;
  }
  EXPECT_LT(named, 0.4);
}

TEST_F(RecordedPeopleTest, AWindowLastsHalfASecondMoreButNotIntoTheNextNorTheNextRecording) {
  LabelledStreams set;
  for (const char* name : {"first", "second"}) {
    NamedStream& stream = set.streams.emplace_back();
    stream.name = name;
    stream.stream.frames.resize(100);
  }
  const auto part = [](std::size_t stream, const char* fault, int begin, int end) {
    LabelledPart made{.stream = stream, .move = "clap", .fault = fault, .begin = begin};
    made.end = end;
    return made;
  };
  set.parts = {part(0, "", 10, 40), part(0, "half", 45, 70), part(0, "", 80, 95), part(1, "", 0, 30)};
  set.parts.push_back(part(1, "", 50, 51));
  set.parts.back().is_action_point = true;
  set.people = {{"anna", {0, 1}}};
  const DetectionWorld world = MakeRecordedWorld(set, 0, {}, World(0));
  ASSERT_EQ(world.stream.frames.size(), 200u);
  EXPECT_EQ(world.starts, std::vector{100});
  ASSERT_EQ(world.events.size(), 4u);
  const std::vector<std::pair<int, int>> windows = {{10, 45}, {45, 80}, {80, 100}, {100, 145}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(world.events[i].window.begin, windows[i].first);
    EXPECT_EQ(world.events[i].window.end, windows[i].second);
  }
  EXPECT_FALSE(world.events[1].IsRight());
  EXPECT_EQ(world.events[1].FaultText(), "half");
  EXPECT_EQ(world.events[1].danced, "") << "what was done instead the label does not say";
  ASSERT_EQ(world.points.size(), 1u);
  EXPECT_EQ(world.points[0].frame, 150);
  EXPECT_TRUE(IsPerformance("clap", 150, world));
  EXPECT_FALSE(IsPerformance("clap", 180, world));
}

TEST_F(RecordedPeopleTest, ThresholdsAreSetOnTheOthers) {
  const LabelledStreams set = SetOf(Record(4, kDanced, 6));
  const auto alarms = [&](const char* point) {
    const auto task = *MakeTask(std::string(point) + "methods: [{name: a, recogniser: dtw}]\n", set);
    double sum = 0;
    for (int trial = 0; trial < 4; ++trial) {
      sum += *ValueOf(RunWorld(*task, World(trial), 1).front(), "false_alarms_per_min");
    }
    return sum / 4;
  };
  const double few = alarms("operating_point: {false_alarms_per_min: 1}\n"),
               many = alarms("operating_point: {false_alarms_per_min: 12}\n");
  EXPECT_LT(few, 3);
  EXPECT_GT(many, few + 3);
}

TEST_F(RecordedPeopleTest, ClipsWithLabelsAreSensedUnderTheCondition) {
  Recorded recorded = Record(3, kDanced, 4);
  for (NamedStream& stream : recorded.streams) stream.motion = MotionOf(stream.stream);
  const LabelledStreams set = SetOf(recorded);
  const auto run = [&](const char* condition) {
    return RunWorld(**MakeTask(std::string(condition) + "methods: [{name: a, recogniser: dtw}]\n", set), World(0), 1)
        .front();
  };
  const CellResult calm = run("noise: 0\n"), noisy = run("noise: 4\n");
  EXPECT_EQ(DigestOf(calm, "session"), DigestOf(noisy, "session"));
  EXPECT_NE(DigestOf(calm, "stream"), DigestOf(noisy, "stream"));
}

TEST_F(RecordedPeopleTest, RefusesWhatHasNoUseOrCannotBeJudged) {
  const std::string method = "methods: [{name: a}]\n";
  LabelledStreams set = SetOf(Record(2, kDanced, 5));
  EXPECT_EQ(ComplaintAbout(method, set), "accepted");
  EXPECT_THAT(ComplaintAbout("people: adult\n" + method, set), HasSubstr("it describes simulated people"));
  EXPECT_THAT(ComplaintAbout("noise: 2\n" + method, set), HasSubstr("it describes a simulated sensor"));
  EXPECT_THAT(ComplaintAbout("methods: [{name: a, oracle: [stream]}]\n", set), HasSubstr("is unknown"));
  LabelledStreams alone = SetOf(Record(1, kDanced, 5));
  EXPECT_THAT(ComplaintAbout(method, alone),
              HasSubstr("person-0 is the only recorded person; needed: at least two people"));
  LabelledStreams unnamed = set;
  unnamed.nobody = "take";
  EXPECT_THAT(ComplaintAbout(method, unnamed), HasSubstr("the person in the recording take is unknown"));
  set.parts[1].begin = set.parts[0].begin;
  set.parts[1].line = 7;
  EXPECT_THAT(ComplaintAbout(method, set),
              HasSubstr("labels.csv:7: two performances in the recording person-0 begin at the same time"));
}

/// Returns an error-free recording of a built-in move, and its label.
LabelledStreams Alone(const std::string& name) {
  LabelledStreams set;
  NamedStream& recording = set.streams.emplace_back();
  recording.name = name;
  recording.stream = StreamOf(LoadBuiltinMove(name)->motion);
  LabelledPart part{.move = name};
  part.end = static_cast<int>(recording.stream.frames.size());
  set.parts = {part};
  set.moves = {name};
  set.people = {{"anna", {0}}};
  return set;
}

TEST(MadeFaults, HalfOfAMoveHasHalfOfEveryLimbsAngleAndItsLength) {
  const NamedStream right = Alone("side_kick").streams[0];
  const NamedStream half = WithFault(right, Fault::kAmplitude);
  ASSERT_EQ(half.stream.frames.size(), right.stream.frames.size());
  const BodyPose first = PoseOf(right.stream.frames[0]);
  double widest = 0;
  for (std::size_t t = 0; t < right.stream.frames.size(); ++t) {
    const BodyPose whole = PoseOf(right.stream.frames[t]), halved = PoseOf(half.stream.frames[t]);
    for (const Bone& bone : AllBones()) {
      EXPECT_NEAR(BoneLength(halved, bone), BoneLength(whole, bone), 1e-9);
      const auto angle = [&](const BodyPose& pose) {
        return AngleBetween(first[bone.child] - first[bone.parent], pose[bone.child] - pose[bone.parent]);
      };
      EXPECT_NEAR(angle(halved), angle(whole) / 2, 1e-6);
      widest = std::max(widest, angle(whole));
    }
  }
  EXPECT_GT(widest, 0.5) << "nothing moved";
}

TEST(MadeFaults, TheOtherSideIsTheOtherSidesJointsAndTwiceItIsTheRecording) {
  NamedStream right = Alone("side_kick").streams[0];
  right.stream.frames[3][Role::kLeftHand].state = TrackingState::kInferred;
  const NamedStream image = WithFault(right, Fault::kWrongSide);
  const SensedFrame &own = right.stream.frames[3], &other = image.stream.frames[3];
  EXPECT_EQ(other[Role::kRightHand].position, own[Role::kLeftHand].position * glm::dvec3(-1, 1, 1));
  EXPECT_EQ(other[Role::kRightHand].state, TrackingState::kInferred);
  EXPECT_EQ(other[Role::kLeftHand].state, TrackingState::kTracked);
  const NamedStream again = WithFault(image, Fault::kWrongSide);
  for (std::size_t t = 0; t < right.stream.frames.size(); ++t) {
    for (const Role role : AllRoles()) {
      EXPECT_EQ(again.stream.frames[t][role].position, right.stream.frames[t][role].position);
    }
  }
}

TEST(MadeFaults, AMoveThatIsItsOwnImageHasNoWrongSide) {
  const auto truth = [](const std::string& name, Fault fault) {
    const LabelledStreams set = Alone(name);
    return TruthOfFault(set.streams[0], WithFault(set.streams[0], fault), set.parts[0], fault);
  };
  EXPECT_NE(truth("clap", Fault::kWrongSide), Truth::kWrong);
  EXPECT_EQ(truth("side_kick", Fault::kWrongSide), Truth::kWrong);
  EXPECT_EQ(truth("stretch", Fault::kAmplitude), Truth::kWrong);
  EXPECT_EQ(truth("clap", Fault::kWrongMove), Truth::kWrong);
}

TEST(MadeFaults, EachRecordingFollowsOnceMoreWithEachFault) {
  LabelledStreams set = Alone("side_kick");
  set.moves = {"clap", "side_kick", "twist"};
  set.parts.push_back(set.parts[0]);
  set.parts[0].end = set.parts[1].begin = 60;
  set.parts[1].fault = "half";
  DetectionOptions options;
  options.session.faults = {Fault::kWrongSide, Fault::kWrongMove};
  const DetectionWorld world = MakeRecordedWorld(set, 0, options, {.suite_seed = 1, .scenario = "made", .trial = 0});
  const auto frames = static_cast<int>(set.streams[0].stream.frames.size());
  EXPECT_EQ(world.starts, (std::vector{frames, 2 * frames}));
  ASSERT_EQ(world.events.size(), 6u);
  const auto told = [&](std::size_t i) {
    const DetectionEvent& event = world.events[i];
    return event.move + " " + std::string(TruthName(event.truth)) + " " + event.labelled_fault + " " + event.danced;
  };
  EXPECT_EQ(told(0), "side_kick right  side_kick");
  EXPECT_EQ(told(1), "side_kick wrong half ");
  EXPECT_EQ(told(2), "side_kick wrong wrong_side ");
  EXPECT_EQ(told(3), "side_kick grey  ");
  EXPECT_EQ(told(4), "twist wrong wrong_move side_kick");
  EXPECT_EQ(told(5), "clap grey  ") << "what was wrong before is nobody's fault here";
  EXPECT_FALSE(world.events[4].first_right_s);
}

TEST_F(RecordedPeopleTest, FaultsThatCannotBeMadeAreRefused) {
  LabelledStreams set = SetOf(Record(2, kDanced, 5));
  const std::string method = "methods: [{name: a}]\n";
  EXPECT_EQ(ComplaintAbout("faults: [amplitude, wrong_side, wrong_move]\n" + method, set), "accepted");
  EXPECT_THAT(
      ComplaintAbout("faults: [wrong_side, late]\n" + method, set),
      HasSubstr("the fault 'late' cannot be made from a recording; allowed: amplitude, wrong_side, wrong_move"));
  LabelledStreams points = set;
  points.parts[0].is_action_point = true;
  EXPECT_THAT(ComplaintAbout("faults: [amplitude]\n" + method, points), HasSubstr("labels.csv has action points"));
  set.moves = {"clap"};
  EXPECT_THAT(ComplaintAbout("faults: [wrong_move]\n" + method, set), HasSubstr("needs two moves, found: clap"));
}

TEST_F(RecordedPeopleTest, APersonIsJudgedOnce) {
  const LabelledStreams set = SetOf(Record(2, kDanced, 5));
  const auto task = *MakeTask("methods: [{name: a}]\n", set);
  const CellResult third = RunWorld(*task, World(2), 1).front();
  EXPECT_EQ(third.status, Status::kSkipped);
  EXPECT_EQ(third.reason, "only 2 people were recorded");
}

}  // namespace
}  // namespace etude
