#include "reports/films/coached_session.h"

#include <algorithm>
#include <utility>

#include "bench/model/recording.h"
#include "reports/words/cell_series.h"

namespace etude {
namespace {

/// Moves every frame that a recording tells into the session.
void KeepWithin(CoachedSessionFacts& facts) {
  const int last = facts.Frames() - 1;
  const auto keep = [&](int& frame) { frame = std::clamp(frame, 0, last); };
  for (auto& mode : facts.modes) keep(mode.begin_frame);
  for (auto& performance : facts.performances) {
    keep(performance.begin_frame);
    keep(performance.end_frame);
  }
  for (auto& words : facts.words) keep(words.begin_frame);
  for (auto& decision : facts.decisions) keep(decision.frame);
  for (std::vector<int>* frames : {&facts.corrections, &facts.transitions}) std::ranges::for_each(*frames, keep);
}

}  // namespace

Result<CoachedSessionFacts> ReadCoachedSession(const CastCell& cell) {
  const Place place{.file = "recording " + cell.row->Id()};
  auto extras = ReadCoachExtras(cell.recording->extras_json);
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
  if (!extras) return Fail(place, "its extras are no coached session's: {}", extras.error().message);
  static_cast<CoachExtras&>(facts) = *std::move(extras);
  KeepWithin(facts);
  if (facts.modes.empty() || facts.words.empty()) return Fail(place, "its extras tell of no mode or words");
  return facts;
}

std::optional<CastCell> ChooseWorstSession(const RunData& run, const ScenarioSummary& scenario) {
  std::optional<CastCell> worst;
  double most = -1;
  for (const auto& [row, recorded] : RecordedRows(run)) {
    if (row->scenario != scenario.name) continue;
    const double wrong = ValueOf(*row, "corrections_unneeded_per_min").value_or(0) +
                         ValueOf(*row, "corrections_missed_per_min").value_or(0);
    if (wrong <= most) continue;
    most = wrong;
    worst = CastCell{&scenario, row, &recorded->recording};
  }
  return worst;
}

}  // namespace etude
