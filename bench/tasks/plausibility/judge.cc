#include "bench/tasks/plausibility/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/metrics/plausibility.h"
#include "bench/model/reasons.h"
#include "bench/model/recording.h"
#include "bench/recordings/task_extras.h"
#include "engine/base/digest.h"
#include "engine/base/names.h"
#include "engine/motion/motion_faults.h"

namespace etude {
namespace {

using enum FaultKind;

/// A metric of one kind of fault: the quantity that is measured, and the factor from the fault's unit to the metric's.
struct FaultMetric {
  enum class What { kShare, kLargest, kCount };
  const char* id;
  FaultKind kind;
  What what;
  double factor = 1;
};
constexpr double kPercent = 100;
constexpr FaultMetric kMetrics[] = {{"floats_share", kFloats, FaultMetric::What::kShare},
                                    {"floats_max_cm", kFloats, FaultMetric::What::kLargest, kPercent},
                                    {"sinks_share", kSinks, FaultMetric::What::kShare},
                                    {"sinks_max_cm", kSinks, FaultMetric::What::kLargest, kPercent},
                                    {"skates_share", kSkates, FaultMetric::What::kShare},
                                    {"skates_max_cmps", kSkates, FaultMetric::What::kLargest, kPercent},
                                    {"jumps", kJumps, FaultMetric::What::kCount},
                                    {"jumps_max_cm", kJumps, FaultMetric::What::kLargest, kPercent},
                                    {"pops", kPops, FaultMetric::What::kCount},
                                    {"pops_max_cm", kPops, FaultMetric::What::kLargest, kPercent},
                                    {"freezes_share", kFreezes, FaultMetric::What::kShare},
                                    {"stretches_max_percent", kStretches, FaultMetric::What::kLargest, kPercent},
                                    {"torn_max_cm", kTorn, FaultMetric::What::kLargest, kPercent},
                                    {"gaps_share", kGaps, FaultMetric::What::kShare},
                                    {"bends_share", kBends, FaultMetric::What::kShare},
                                    {"bends_max_deg", kBends, FaultMetric::What::kLargest},
                                    {"passes_share", kPasses, FaultMetric::What::kShare}};

/// The separator in a reason between the text about faults and the text about the file.
constexpr std::string_view kAboutFile = " · ";

double ValueOf(const FaultMetric& metric, const std::vector<MotionFault>& faults, double duration_s) {
  switch (metric.what) {
    case FaultMetric::What::kShare:
      return FaultyShare(faults, metric.kind, duration_s);
    case FaultMetric::What::kLargest:
      return metric.factor * LargestFault(faults, metric.kind);
    case FaultMetric::What::kCount:
      return FaultCount(faults, metric.kind);
  }
  return 0;
}

std::string FloorWords(const MotionFaults& found, const PlausibilityOptions& options) {
  if (options.floor_m) return fmt::format("floor at {:g} m, as given", found.floor_m);
  if (!found.is_floor_found) return "floor at height 0";
  return fmt::format("floor not at height 0 but at {:.2f} m, where the feet rest", found.floor_m);
}

/// Describes how much of the file was judged, and which times were not.
std::string ExtentWords(const BodyInPlace& body, const FaultsInPlace& judged) {
  std::string words = fmt::format("{} frames at {:g} Hz", judged.frames, body.motion.rate_hz);
  if (judged.not_judged_s.empty()) return words;
  std::vector<std::string> times;
  for (const auto& [from, to] : judged.not_judged_s) times.push_back(fmt::format("{:.2f} to {:.2f}", from, to));
  return words + fmt::format(" (not judged, because joints are missing: {} s)", Join(times));
}

std::string DigestOf(const BodyInPlace& body) {
  Digest digest;
  digest.Add(body.motion.rate_hz);
  const auto add = [&](const BodyMotion& motion) {
    for (const BodyPose& pose : motion.poses) {
      for (const glm::dvec3& joint : pose.joints) digest.Add(joint.x).Add(joint.y).Add(joint.z);
    }
  };
  add(body.motion);
  for (const OtherStretch& other : body.others) add(other.motion);
  return digest.Hex();
}

Recording RecordingOf(BodyInPlace body, const MotionFaults& found) {
  PlausibilityExtras extras{.floor_m = found.floor_m, .faults = {}};
  // A gap may begin before the first frame of the body and end after the body's last frame.
  const auto frame_at = [&](double time_s) {
    const auto frame = static_cast<int>(std::lround((time_s - body.begin_s) * body.motion.rate_hz));
    return std::clamp(frame, 0, static_cast<int>(body.motion.poses.size()) - 1);
  };
  // Only the longest stretch is recorded, so faults of other stretches are left out.
  const double end_s = body.begin_s + static_cast<double>(body.motion.poses.size()) / body.motion.rate_hz;
  for (const MotionFault& fault : found.faults) {
    if (fault.from_s > end_s || fault.to_s < body.begin_s) continue;
    extras.faults.push_back(
        {std::string(FaultName(fault.kind)), fault.text, frame_at(fault.from_s), frame_at(fault.to_s)});
  }
  return {{{"answer", std::move(body.motion)}}, WriteExtras(extras)};
}

}  // namespace

std::vector<std::string> LimitedMetrics() {
  std::vector<std::string> ids = {"faults"};
  for (const FaultMetric& metric : kMetrics) ids.emplace_back(metric.id);
  ids.emplace_back("wrong_rate");
  return ids;
}

std::vector<std::string> PlausibilityMetrics() {
  std::vector<std::string> ids = LimitedMetrics();
  ids.insert(ids.end(), {"fault_free", "within_limits"});
  return ids;
}

CellResult JudgeAlone(BodyInPlace body, const PlausibilityOptions& options, bool keeps_motion) {
  if (const std::size_t frames = body.motion.poses.size(); frames < kMinFramesForFaults) {
    return CellResult::Ended(
        Status::kFailed, fmt::format("{} frames; a search for faults needs at least {}", frames, kMinFramesForFaults));
  }
  const FaultsInPlace judged = FindFaultsInPlace(body, options.floor_m);
  const MotionFaults& found = judged.found;
  // Measure all kinds of faults.
  CellResult result;
  result.status = Status::kOk;
  result.Measure("faults", static_cast<double>(found.faults.size()));
  for (const FaultMetric& metric : kMetrics) {
    // Gaps are relative to the duration of the file, which includes the time without a whole body.
    result.Measure(metric.id, ValueOf(metric, found.faults, metric.kind == kGaps ? judged.file_s : judged.judged_s));
  }
  result.Measure("wrong_rate", FaultCount(found.faults, kRate) + FaultCount(found.faults, kSpeed) > 0 ? 1 : 0);
  // Compare with the limits.
  std::map<std::string, double> values;
  for (const MetricValue& metric : result.metrics) values[metric.id] = *metric.value;
  const std::vector<std::string> beyond = BeyondLimits(values, options.limits);
  result.Measure("fault_free", found.faults.empty() ? 1 : 0);
  if (options.limits.empty()) {
    result.Missing("within_limits", "no limits are given");
  } else {
    result.Measure("within_limits", beyond.empty() ? 1 : 0);
  }
  // Describe the result in words.
  std::vector<std::string> words;
  for (const std::string& id : beyond) {
    words.push_back(fmt::format("{} is {:.3g}, allowed {:g}", id, values[id], options.limits.at(id)));
  }
  for (const std::string& sentence : FaultSentences(found.faults)) words.push_back(sentence);
  if (found.faults.empty()) words.emplace_back("no fault");
  const std::string file = fmt::format("{}, {}", ExtentWords(body, judged), FloorWords(found, options));
  result.reason = fmt::format("{}{}{}", Join(words, "; "), kAboutFile, file);
  const std::vector<std::string> notes = NotesWithoutDoubts(body.notes, body.doubts);
  if (!notes.empty()) result.reason += ", " + Join(notes);
  result.reason += DoubtfulPart("", body.doubts);
  result.digests = {{"motion", DigestOf(body)}};
  if (keeps_motion) result.recording = RecordingOf(std::move(body), found);
  return result;
}

std::string_view FaultWords(std::string_view reason) { return reason.substr(0, reason.find(kAboutFile)); }

}  // namespace etude
