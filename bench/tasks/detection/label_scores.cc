#include "bench/tasks/detection/label_scores.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/base/named.h"
#include "engine/recognition/pose_vector.h"

namespace etude {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Returns the mean squared distance along the best warping path. May stop early and return infinity if the result
/// would exceed `enough`.
double WarpedCost(const std::vector<PoseVector>& a, const std::vector<PoseVector>& b, double enough) {
  if (a.empty() || b.empty()) return kFar;
  const double all = static_cast<double>(a.size() + b.size());
  std::vector<double> before(b.size() + 1, kFar), now(b.size() + 1, kFar);
  before[0] = 0;
  for (const PoseVector& pose : a) {
    now[0] = kFar;
    double lowest = kFar;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double here = SquaredDistance(pose, b[j]);
      now[j + 1] = std::min({before[j] + 2 * here, before[j + 1] + here, now[j] + here});
      lowest = std::min(lowest, now[j + 1]);
    }
    if (lowest / all > enough) return kFar;
    std::swap(before, now);
  }
  return before.back() / all;
}

struct Described {
  const LabelledPart* part;
  std::vector<PoseVector> steps;
};

/// Returns the move of the nearest performance by any other person; "" if there is none.
std::string NearestByOthers(const Described& one, const std::vector<Described>& all) {
  double lowest = kFar;
  std::string move;
  for (const Described& other : all) {
    if (other.part->person == one.part->person) continue;
    const double cost = WarpedCost(one.steps, other.steps, lowest);
    if (cost >= lowest) continue;
    lowest = cost;
    move = other.part->move;
  }
  return move;
}

std::vector<Classified> ByNearest(const std::vector<NamedStream>& streams, const std::vector<LabelledPart>& parts) {
  std::vector<Described> described;
  for (const LabelledPart& part : parts) {
    if (part.is_action_point || !part.IsRight()) continue;
    described.push_back(
        {&part, DescribeStream(PartOf(streams[part.stream].stream, part.begin, part.end), PoseParts::kJoints)});
  }
  std::vector<Classified> verdicts;
  for (const Described& one : described) {
    verdicts.push_back({one.part->move, NearestByOthers(one, described), one.part->person});
  }
  return verdicts;
}

/// Classifies all performances of one person, and spots the person's action points.
class PersonLeftOut {
 public:
  PersonLeftOut(const std::vector<NamedStream>& streams, const std::vector<LabelledPart>& parts,
                const WatchOptions& options, LeaveOneOut& out)
      : streams_(streams), parts_(parts), options_(options), out_(out) {}

  Result<void> Run(const std::string& person) {
    const auto by_others = [&](const LabelledPart& part) { return part.person != person; };
    ASSIGN_OR_RETURN(taught_, TeachMoves(streams_, parts_, by_others, false));
    ASSIGN_OR_RETURN(recogniser_, MakeRecogniser(options_.recogniser, taught_));
    for (std::size_t i = 0; i < parts_.size();) {
      std::size_t end = i + 1;
      while (end < parts_.size() && parts_[end].stream == parts_[i].stream) ++end;
      TakeStream(person, std::span(parts_).subspan(i, end - i));
      i = end;
    }
    return {};
  }

 private:
  void TakeStream(const std::string& person, std::span<const LabelledPart> parts) {
    const auto is_theirs = [&](const LabelledPart& part) { return part.person == person; };
    if (std::ranges::none_of(parts, is_theirs)) return;
    const SkeletonStream& stream = streams_[parts.front().stream].stream;
    const SeenStream seen = SeeStream(stream, options_.filter);
    bool has_points = false;
    for (const LabelledPart& part : parts) {
      if (!is_theirs(part)) continue;
      if (part.is_action_point) {
        has_points = true;
        out_.points.push_back({part.move, clock_s_ + part.begin / stream.rate_hz});
      } else if (part.IsRight()) {
        const auto move = Classify(seen, part.begin, part.end, *recogniser_, taught_.size());
        out_.untaught_performances += FindByName(taught_, part.move) == nullptr;
        out_.verdicts.push_back({part.move, move ? taught_[*move].name : "", part.person});
      }
    }
    if (has_points) {
      for (const Spotting& spotting : Watch(stream, *recogniser_, taught_.size(), options_)) {
        out_.detections.push_back({taught_[spotting.move].name, clock_s_ + spotting.frame / stream.rate_hz});
      }
    }
    // Put seconds between the streams on the time axis, so that no detection can match an action point of the next
    // stream.
    constexpr double kBetweenStreams = 10;
    clock_s_ += static_cast<double>(stream.frames.size()) / stream.rate_hz + kBetweenStreams;
  }

  const std::vector<NamedStream>& streams_;
  const std::vector<LabelledPart>& parts_;
  const WatchOptions& options_;
  LeaveOneOut& out_;
  std::vector<TaughtMove> taught_;
  std::unique_ptr<Recogniser> recogniser_;
  double clock_s_ = 0;
};

constexpr double kMargin = 0.5;  // seconds; the windows of the detection task have the same margin
// Seconds between recordings on the time axis, so that no detection can match an action point of the next recording.
constexpr double kApart = 10;

double Rounded(double value) { return std::round(value * 1e4) / 1e4; }

Json NumberOrNull(const std::optional<double>& value) { return value ? Json(Rounded(*value)) : Json(); }

}  // namespace

std::optional<double> Accuracy(std::span<const Classified> verdicts) {
  if (verdicts.empty()) return std::nullopt;
  const auto right = std::ranges::count_if(verdicts, [](const Classified& v) { return v.truth == v.taken_for; });
  return static_cast<double>(right) / static_cast<double>(verdicts.size());
}

std::optional<double> WarpedDistanceCm(const SkeletonStream& a, const SkeletonStream& b) {
  const double cost = WarpedCost(DescribeStream(a, PoseParts::kJoints), DescribeStream(b, PoseParts::kJoints), kFar);
  return cost < kFar ? std::optional(100 * std::sqrt(cost)) : std::nullopt;
}

Result<LeaveOneOut> LeaveOnePersonOut(const std::vector<NamedStream>& streams, const std::vector<LabelledPart>& parts,
                                      const std::string& file, const WatchOptions& options) {
  LeaveOneOut out;
  std::set<std::string> people;
  for (const LabelledPart& part : parts) {
    if (part.person.empty()) {
      return Fail(
          {file, part.line},
          "the person in the recording {} is unknown; needed: a column 'person', or file names of a known data set",
          streams[part.stream].name);
    }
    people.insert(part.person);
  }
  out.people.assign(people.begin(), people.end());
  if (people.size() < 2)
    return Fail({file},
                "the labels contain {} person; needed: at least two people, because each person is judged with the "
                "data of the other people",
                people.size());
  PersonLeftOut left_out(streams, parts, options, out);
  for (const std::string& person : out.people) RETURN_IF_ERROR(left_out.Run(person));
  out.nearest = ByNearest(streams, parts);
  return out;
}

LabelScores::LabelScores(std::span<const TaughtMove> moves, const Recogniser& recogniser, const WatchOptions& watch)
    : moves_(moves), recogniser_(recogniser), watch_(watch) {}

void LabelScores::Add(const NamedStream& stream, std::span<const LabelledPart> parts,
                      std::span<const Spotting> spottings) {
  const SkeletonStream& frames = stream.stream;
  const SeenStream seen = SeeStream(frames, watch_.filter);
  const auto count = static_cast<int>(frames.frames.size()), margin = static_cast<int>(kMargin * frames.rate_hz);
  // Collect the performances and action points of this recording.
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
  // Count the detections outside all windows of their move as false alarms.
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

Json FactsOf(const LabelScores& scores) {
  const Confusion confusion = CountConfusion(scores.Performances());
  const Json told = {{"performances", scores.Performances().size()},
                     {"f1", NumberOrNull(F1(confusion))},
                     {"precision", NumberOrNull(PrecisionOf(confusion))},
                     {"recall", NumberOrNull(RecallOf(confusion))},
                     {"roc_auc", NumberOrNull(RocAuc(scores.Performances()))},
                     {"action_points", scores.Points().size()},
                     {"action_point_f", NumberOrNull(scores.PointFScore())},
                     {"false_alarms_per_min", Rounded(scores.FalseAlarmsAMinute())}};
  return {{"scores", told}};
}

Json FactsOf(const LeaveOneOut& out) {
  const auto f_score =
      out.points.empty() ? std::nullopt : MeanFScore(out.points, out.detections, kActionPointTolerance);
  const Json told = {{"people", out.people.size()},
                     {"performances", out.verdicts.size()},
                     {"accuracy", NumberOrNull(Accuracy(out.verdicts))},
                     {"nearest_accuracy", NumberOrNull(Accuracy(out.nearest))},
                     {"action_points", out.points.size()},
                     {"action_point_f", NumberOrNull(f_score)}};
  return {{"scores", told}};
}

}  // namespace etude
