#include "bench/scenario/scenario.h"
#include "engine/fuzzy/fuzzy_system.h"
#include "engine/recognition/learnt_model.h"
#include "engine/teaching/moves_file.h"
#include "engine/transitions/tags_file/tags_file.h"
#include "io/keypoints/read_people.h"
#include "sim/choreography/dance_of.h"
#include "sim/choreography/move.h"
#include "sim/choreography/song.h"
#include "sim/skeleton_sensor/options.h"
#include "tests/engine/transitions/test_clips.h"
#include "tests/fuzz/readers/folder.h"
#include "tests/fuzz/readers/target.h"

namespace etude::fuzz {
namespace {

void Yaml(std::string_view bytes) {
  const auto node = ParseYaml(bytes, kFile);
  if (node) Require(CountValues(*node) <= 10'000, "more values than allowed");
}

void ScenarioFile(std::string_view bytes) { ParseScenarios(kFile, {{kFile, std::string(bytes)}}); }

/// Returns every key that a scenario may have, from the scenarios' own files.
std::vector<std::string> ScenarioWords() {
  std::vector<std::string> words;
  for (const KeyInfo& key : CommonScenarioKeys()) words.push_back(key.key + ":");
  return words;
}

void Moves(std::string_view bytes) {
  RequireRoundTrip(
      bytes, [](std::string_view text) { return ReadMoves(text, kFile); }, WriteMoves);
}

std::vector<std::string> MoveSeeds() {
  SensedFrame frame{.body_seen = true};
  TaughtMove posed{.name = "arms-open", .poses = {{{{Feature::kRH, 57, 20}}}}};
  TaughtMove shown{.name = "shown"};
  shown.examples.push_back({.rate_hz = 30, .frames = {frame, frame}});
  return {WriteMoves({posed, shown})};
}

void Fuzzy(std::string_view bytes) {
  RequireRoundTrip(
      bytes, [](std::string_view text) { return ReadFuzzySystem(text, kFile); }, WriteFuzzySystem);
}

void Learnt(std::string_view bytes) {
  RequireRoundTrip(
      bytes, [](std::string_view text) { return ReadLearntModel(text, kFile); }, WriteLearntModel);
}

void Sensor(std::string_view bytes) {
  RequireRoundTrip(
      bytes, [](std::string_view text) { return ReadSensorFile(text, kFile); },
      [](const SkeletonSensorOptions& options) { return WriteSensorFile(options, "v2"); });
}

void MoveFile(std::string_view bytes) { ParseMove(bytes, kFile); }
void SongFile(std::string_view bytes) { ParseSong(bytes, kFile); }
void Beats(std::string_view bytes) { ReadBeats(bytes, kFile); }

void Tags(std::string_view bytes) {
  RequireRoundTrip(
      bytes, [](std::string_view text) { return ReadTagsFile(text, kFile); },
      [](const BridgeTags& tags) { return Required(WriteTagsFile(tags), "tags that were read cannot be written"); });
}

std::vector<std::string> TagsSeeds() {
  const BodyMotion clips[] = {WavingClip(20), WavingClip(15, 1.1)};
  const MotionLibrary library =
      MakeLibrary({"wave", "other"}, clips, MakeBodyProportions(StandingClip(1, 0).poses[0], 0.9));
  const std::vector<std::string> sources = {"mocap/wave.bvh", "mocap/other.glb#1"};
  return {Required(WriteTagsFile(CollectTags(library, sources, {}, {}, {})), "a seed")};
}

void Keypoints(std::string_view bytes) {
  static const Folder folder;
  ReadKeypoints(folder.With("f_0.json", bytes), "");
  ReadKeypoints(folder.path(), "");
}

std::vector<std::string> KeypointSeeds() {
  std::string triples = "10, 20, 0.5";
  for (int i = 1; i < 17; ++i) triples += ", 1, 2, 1";
  return {R"({"version": 1.3, "people": [{"pose_keypoints_2d": [)" + triples + "]}]}",
          R"({"images": [{"id": 7, "width": 640, "height": 480}, {"id": 3, "width": 640, "height": 480}],)"
          R"("annotations": [{"image_id": 3, "keypoints": [)" +
              triples + "]}]}"};
}

}  // namespace

std::vector<Target> SettingTargets() {
  const std::vector<std::string> yaml = {"&a",           "*a",       "---",  "!!int", "|", ">",
                                         "\xef\xbb\xbf", "\xff\xfe", ".nan", "{",     "["};
  return {
      {"yaml", Yaml,
       [] {
         return std::vector<std::string>{"a: 1\nb: [x, 'y', \"z\"]\nc: {d: null}\n", "- |\n  text\n- >\n  more\n"};
       },
       yaml},
      {"scenario", ScenarioFile, [] { return FilesOf("scenarios/quick", ".yaml"); }, ScenarioWords()},
      {"moves", Moves, MoveSeeds, {"wrong:", "key_poses:", "tolerance_deg:", "Posture"}},
      {"fuzzy-system", Fuzzy, [] { return FilesOf("scenarios/fuzzy", ".yaml"); }, yaml},
      {"learnt-model", Learnt,
       [] {
         LearntModel small = BuiltinLearntModel();
         small.asked.trees.resize(1), small.spotted.trees.resize(1);
         return std::vector{WriteLearntModel(small)};
       },
       yaml},
      {"sensor", Sensor,
       [] {
         return std::vector{WriteSensorFile({}, "v2"), std::string("based_on: v1\n")};
       },
       yaml},
      {"choreography-move", MoveFile, [] { return FilesOf("scenarios/choreography/moves", "clap.yaml"); }, yaml},
      {"choreography-song", SongFile, [] { return FilesOf("scenarios/choreography/songs", "sprint.yaml"); }, yaml},
      {"beats", Beats, [] { return std::vector<std::string>{"0.5\n1\n1.5\n2 x\n# no\n2.5\n3\n3.5\n4\n4.5\n"}; }},
      {"tags", Tags, TagsSeeds, {"<!DOCTYPE a [<!ENTITY b \"c\">]>", "&amp;", "<![CDATA[", "]]>", "<?x?>"}},
      {"keypoints", Keypoints, KeypointSeeds, {"null", "-1", "1e400", "\"width\"", "\"bbox\"", "\"score\""}},
  };
}

}  // namespace etude::fuzz
