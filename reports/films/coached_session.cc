#include "reports/films/coached_session.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/model/recording.h"

namespace etude {
namespace {

using SessionJson = nlohmann::json;

/// Within the session, whatever the file says.
int FrameIn(const SessionJson& json, const char* key, int frames) {
  return std::clamp(json.at(key).get<int>(), 0, std::max(0, frames - 1));
}

std::optional<BodyPose> KeyPoseIn(const SessionJson& words) {
  if (!words.contains("picture")) return std::nullopt;
  const auto numbers = words.at("picture").get<std::vector<double>>();
  if (numbers.size() != 3 * kRoleCount) return std::nullopt;
  BodyPose pose;
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    pose.joints[j] = {numbers[3 * j], numbers[3 * j + 1], numbers[3 * j + 2]};
  }
  return pose;
}

void Fill(const SessionJson& extras, CoachedSessionFacts& facts) {
  const int frames = facts.Frames();
  facts.song = extras.at("song").get<std::string>();
  for (const SessionJson& mode : extras.at("modes")) {
    facts.modes.push_back({mode.at("mode").get<std::string>(), FrameIn(mode, "begin_frame", frames)});
  }
  for (const SessionJson& told : extras.at("performances")) {
    facts.performances.push_back({told.at("move").get<std::string>(), told.at("truth").get<std::string>(),
                                  told.at("called").get<std::string>(), FrameIn(told, "begin_frame", frames),
                                  FrameIn(told, "end_frame", frames)});
  }
  for (const SessionJson& words : extras.at("words")) {
    facts.words.push_back({FrameIn(words, "begin_frame", frames), words.at("say").get<std::string>(),
                           words.at("hint").get<std::string>(), KeyPoseIn(words)});
  }
  for (const SessionJson& told : extras.at("decisions")) {
    facts.decisions.push_back(
        {FrameIn(told, "frame", frames), told.at("event").get<std::string>(), told.at("why").get<std::string>()});
  }
  for (const SessionJson& frame : extras.at("corrections")) {
    facts.corrections.push_back(std::clamp(frame.get<int>(), 0, frames - 1));
  }
  for (const SessionJson& frame : extras.at("transitions")) {
    facts.transitions.push_back(std::clamp(frame.get<int>(), 0, frames - 1));
  }
  facts.beats_s = extras.at("beats_s").get<std::vector<double>>();
}

}  // namespace

Result<CoachedSessionFacts> ReadCoachedSession(const CastCell& cell) {
  const Place place{.file = "recording " + cell.row->Id()};
  CoachedSessionFacts facts;
  for (const auto& [name, motion] :
       {std::pair{"coach", &facts.coach}, std::pair{"truth", &facts.learner}, std::pair{"sensed", &facts.sensed}}) {
    const BodyMotion* track = FindTrack(*cell.recording, name);
    if (track == nullptr || track->poses.empty()) return Fail(place, "has no track '{}'", name);
    *motion = *track;
  }
  if (facts.learner.poses.size() != facts.coach.poses.size() || facts.sensed.poses.size() != facts.coach.poses.size()) {
    return Fail(place, "its tracks are not of one length");
  }
  try {
    Fill(SessionJson::parse(cell.recording->extras_json), facts);
  } catch (const SessionJson::exception& error) {
    return Fail(place, "its extras are no coached session's: {}", error.what());
  }
  if (facts.modes.empty() || facts.words.empty()) return Fail(place, "its extras tell of no mode or words");
  return facts;
}

std::optional<CastCell> ChooseWorstSession(const RunData& run, const ScenarioSummary& scenario) {
  std::optional<CastCell> worst;
  double most = -1;
  for (const CellRecording& recorded : run.recordings) {
    const auto row = std::ranges::find_if(run.rows, [&](const Row& each) { return each.Id() == recorded.cell; });
    if (row == run.rows.end() || row->scenario != scenario.name) continue;
    const double wrong = ValueOf(*row, "corrections_unneeded_per_min").value_or(0) +
                         ValueOf(*row, "corrections_missed_per_min").value_or(0);
    if (wrong <= most) continue;
    most = wrong;
    worst = CastCell{&scenario, &*row, &recorded.recording};
  }
  return worst;
}

}  // namespace etude
