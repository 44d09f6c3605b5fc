#include "bench/streams/label_scores.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/files/json.h"
#include "engine/base/named.h"

namespace etude {
namespace {

constexpr double kMargin = 0.5;  // seconds, as the detection task's windows have it
constexpr double kApart = 10;    // seconds between recordings, so that no detection is of a point in the next one

double Rounded(double value) { return std::round(value * 1e4) / 1e4; }

Json NumberOrNull(const std::optional<double>& value) { return value ? Json(Rounded(*value)) : Json(); }

}  // namespace

LabelScores::LabelScores(std::span<const TaughtMove> moves, const Recogniser& recogniser, const WatchOptions& watch)
    : moves_(moves), recogniser_(recogniser), watch_(watch) {}

void LabelScores::Add(const NamedStream& stream, std::span<const LabelledPart> parts,
                      std::span<const Spotting> spottings) {
  const SkeletonStream& frames = stream.stream;
  const SeenStream seen = SeeStream(frames, watch_.filter);
  const auto count = static_cast<int>(frames.frames.size()), margin = static_cast<int>(kMargin * frames.rate_hz);
  std::vector<MoveWindow> windows;
  bool has_points = false;
  for (const LabelledPart& part : parts) {
    const TaughtMove* move = FindByName(moves_, part.move);
    if (move == nullptr) {
      ++untaught_;
      continue;
    }
    if (part.is_action_point) {
      has_points = true;
      points_.push_back({part.move, clock_s_ + part.begin / frames.rate_hz});
      windows.push_back({part.move, part.move, part.begin - margin, part.end + margin});
      continue;
    }
    const int end = std::min(part.end + margin, count);
    windows.push_back({part.move, part.IsRight() ? part.move : "", part.begin, end});
    const auto index = static_cast<std::size_t>(move - moves_.data());
    const double score = JudgeAsked(seen, part.begin, end, recogniser_, index);
    performances_.push_back({part.IsRight(), score >= watch_.decision.threshold, score});
  }
  for (const Spotting& spotting : spottings) {
    const std::string& move = moves_[spotting.move].name;
    alarms_ += IsFalseAlarm(move, spotting.frame, windows);
    if (has_points) detections_.push_back({move, clock_s_ + spotting.frame / frames.rate_hz});
  }
  seconds_ += count / frames.rate_hz;
  clock_s_ += count / frames.rate_hz + kApart;
}

std::optional<double> LabelScores::PointFScore() const {
  if (points_.empty()) return std::nullopt;
  return MeanFScore(points_, detections_, kActionPointTolerance);
}

double LabelScores::FalseAlarmsAMinute() const { return seconds_ > 0 ? FalseAlarmsPerMinute(alarms_, seconds_) : 0; }

std::string SpottingLine(const Spotting& spotting, const std::string& move, double rate_hz, const std::string& stream) {
  Json line;
  if (!stream.empty()) line["stream"] = stream;
  line["frame"] = spotting.frame;
  line["time_s"] = Rounded(spotting.frame / rate_hz);
  line["move"] = move;
  line["evidence"] = Rounded(spotting.evidence);
  return line.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string ScoresLine(const LabelScores& scores) {
  const Confusion confusion = CountConfusion(scores.Performances());
  const Json told = {{"performances", scores.Performances().size()},
                     {"f1", NumberOrNull(F1(confusion))},
                     {"precision", NumberOrNull(Precision(confusion))},
                     {"recall", NumberOrNull(Recall(confusion))},
                     {"roc_auc", NumberOrNull(RocAuc(scores.Performances()))},
                     {"action_points", scores.Points().size()},
                     {"action_point_f", NumberOrNull(scores.PointFScore())},
                     {"false_alarms_per_min", Rounded(scores.FalseAlarmsAMinute())}};
  return Json{{"scores", told}}.dump();
}

std::string ScoresLine(const LeaveOneOut& out) {
  const auto f_score =
      out.points.empty() ? std::nullopt : MeanFScore(out.points, out.detections, kActionPointTolerance);
  const Json told = {{"people", out.people.size()},
                     {"performances", out.verdicts.size()},
                     {"accuracy", NumberOrNull(Accuracy(out.verdicts))},
                     {"nearest_accuracy", NumberOrNull(Accuracy(out.nearest))},
                     {"action_points", out.points.size()},
                     {"action_point_f", NumberOrNull(f_score)}};
  return Json{{"scores", told}}.dump();
}

}  // namespace etude
