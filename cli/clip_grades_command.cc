#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/output_file.h"
#include "engine/base/csv.h"
#include "engine/fuzzy/fuzzy_motion.h"
#include "io/clips/clip_library.h"
#include "io/files/files.h"

namespace etude {
namespace {

struct ClipGradesOptions {
  std::vector<std::string> clips;
  std::string output;                   ///< a CSV file for one clip; "" = none
  std::string fuzzy = "builtin:paper";  ///< builtin:NAME or a file (docs/fuzzy-system.md)
  bool overwrite = false, as_json = false;
  ClipReading reading;
};

/// Writes one line per frame: the ten features, their 24 membership grades and ten tags, and the name of the pose.
std::string GradesCsv(const FuzzyMotion& motion) {
  std::string csv = "frame,time_s";
  for (Feature feature : AllFeatures()) csv += fmt::format(",{}", FeatureName(feature));
  for (const Term& term : AllTerms()) csv += "," + CsvText(fmt::format("{}_{}", FeatureName(term.feature), term.name));
  for (Feature feature : AllFeatures()) csv += fmt::format(",{}_tag", FeatureName(feature));
  csv += ",pose\n";
  for (std::size_t i = 0; i < motion.grades.size(); ++i) {
    csv += fmt::format("{},{}", i, static_cast<double>(i) / motion.rate_hz);
    for (double value : motion.features[i].values) csv += fmt::format(",{}", value);
    for (double grade : motion.grades[i]) csv += fmt::format(",{}", grade);
    for (Feature feature : AllFeatures()) csv += fmt::format(",{}", CsvText(TagName(motion.tags[i], feature)));
    csv += fmt::format(",{}\n", CsvText(motion.poses[i]));
  }
  return csv;
}

/// Summarises the shares of time in each pose, the most frequent pose first: "at rest 62 %, arms up 20 %, no rule holds
/// 18 %".
std::string PoseShares(const FuzzyMotion& motion, const RuleBase& rules) {
  std::vector<std::pair<std::size_t, std::string>> counts;
  for (const std::string& pose : rules.poses) {
    counts.emplace_back(static_cast<std::size_t>(std::ranges::count(motion.poses, pose)), pose);
  }
  counts.emplace_back(static_cast<std::size_t>(std::ranges::count(motion.poses, "")), "no rule holds");
  std::ranges::stable_sort(counts, std::ranges::greater{}, &std::pair<std::size_t, std::string>::first);
  std::string text;
  for (const auto& [count, pose] : counts) {
    if (count == 0) continue;
    text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", pose,
                        100.0 * static_cast<double>(count) / static_cast<double>(motion.poses.size()));
  }
  return text;
}

void PrintSimilarities(const ClipLibrary& clips, const std::vector<FuzzyMotion>& motions,
                       const FeatureWeights& weights) {
  fmt::print("\nfuzzy similarity of whole motions: 1 = equal; 0.5 = a mean fuzzy distance of {}:\n", kPaperThreshold);
  for (std::size_t a = 0; a < motions.size(); ++a) {
    for (std::size_t b = a + 1; b < motions.size(); ++b) {
      const auto similarity = ComputeMotionSimilarity(motions[a].grades, motions[b].grades, {.weights = weights});
      if (similarity) fmt::print("  {:.3f}  {} – {}\n", *similarity, clips.clips[a].name, clips.clips[b].name);
    }
  }
}

Json FactsOf(const ClipLibrary& clips, const std::vector<FuzzyMotion>& motions, const FuzzySystem& system) {
  Json told = Json::array(), similarities = Json::array();
  for (std::size_t a = 0; a < motions.size(); ++a) {
    Json poses = Json::object();
    for (const std::string& pose : system.rules.poses) poses[pose] = std::ranges::count(motions[a].poses, pose);
    told.push_back({{"clip", clips.clips[a].name}, {"frames", motions[a].grades.size()}, {"poses", std::move(poses)}});
    for (std::size_t b = a + 1; b < motions.size(); ++b) {
      const auto similarity =
          ComputeMotionSimilarity(motions[a].grades, motions[b].grades, {.weights = system.weights});
      if (!similarity) continue;
      similarities.push_back({{"a", clips.clips[a].name}, {"b", clips.clips[b].name}, {"similarity", *similarity}});
    }
  }
  return {{"clips", std::move(told)}, {"similarities", std::move(similarities)}};
}

Result<int> ClipGradesCommand(const ClipGradesOptions& options) {
  RETURN_IF_ERROR(CheckOutput(options.output, options.overwrite, ".csv"));
  ASSIGN_OR_RETURN(const auto system, ReadFuzzy(options.fuzzy));
  ASSIGN_OR_RETURN(const auto reading, ReadOptionsTellingDoubts(options.reading));
  ASSIGN_OR_RETURN(const auto clips, LoadClips(options.clips, {}, reading));
  if (!options.output.empty() && clips.clips.size() != 1) {
    return Fail({options.output}, "can only contain the grades of one clip; found {} clips", clips.clips.size());
  }
  std::vector<FuzzyMotion> motions;
  for (const LibraryClip& clip : clips.clips) {
    motions.push_back(FuzzifyMotion(clip.motion, StandingHipHeight(clip.motion.poses.front()), system));
    if (options.as_json) continue;
    fmt::print("{}: {} frames; {}\n", clip.name, motions.back().grades.size(),
               PoseShares(motions.back(), system.rules));
  }
  if (options.as_json) {
    RETURN_IF_ERROR(PrintFacts("clip grades", FactsOf(clips, motions, system)));
  } else if (motions.size() > 1) {
    PrintSimilarities(clips, motions, system.weights);
  }
  if (options.output.empty()) return kSuccess;
  RETURN_IF_ERROR(WriteFileAtomically(options.output, GradesCsv(motions.front())));
  TellWritten(options.output, options.as_json ? stderr : stdout);
  return kSuccess;
}

}  // namespace

void DefineGrades(CLI::App& clip, Action& action) {
  auto options = std::make_shared<ClipGradesOptions>();
  CLI::App* command = clip.add_subcommand(
      "grades", "Show fuzzy features, grades, tags and poses of every frame, and the similarity of clips");
  command->add_option("clips", options->clips, "Clips")->required();
  command->add_option("-o,--output", options->output, "Write a table of one clip with one line per frame (.csv)");
  command->add_option("--fuzzy", options->fuzzy, "Fuzzy system: builtin:NAME or a file");
  AddOverwrite(*command, options->overwrite);
  AddJson(*command, options->as_json);
  AddClipReading(*command, options->reading);
  command->callback([=, &action] { action = [=] { return Finish(ClipGradesCommand(*options)); }; });
}

}  // namespace etude
