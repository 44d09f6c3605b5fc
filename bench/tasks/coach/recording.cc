#include "bench/tasks/coach/recording.h"

#include <nlohmann/json.hpp>

#include "bench/model/recording.h"
#include "bench/tasks/base/pose_json.h"
#include "bench/tasks/detection/score.h"

namespace etude {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// Stretches of frames in one mode.
OrderedJson DescribeModes(const SessionLog& log) {
  OrderedJson modes = OrderedJson::array();
  for (int frame = 0; frame < log.Frames(); ++frame) {
    const CoachMode mode = log.modes[static_cast<std::size_t>(frame)];
    const bool begins = frame == 0 || log.modes[static_cast<std::size_t>(frame) - 1] != mode;
    if (begins) modes.push_back({{"mode", ModeName(mode)}, {"begin_frame", frame}});
  }
  return modes;
}

std::string_view TruthName(PerformanceTruth truth) {
  if (truth == PerformanceTruth::kGrey) return "grey";
  return truth == PerformanceTruth::kRight ? "right" : "wrong";
}

OrderedJson DescribePerformances(const CoachStage& stage, const SessionLog& log) {
  OrderedJson performances = OrderedJson::array();
  for (const LoggedPerformance& performance : log.performances) {
    const CoachedPerformance& judged = performance.judged;
    performances.push_back({{"move", stage.moves[static_cast<std::size_t>(performance.move)].name},
                            {"begin_frame", judged.begin_frame},
                            {"end_frame", judged.end_frame},
                            {"truth", TruthName(judged.truth)},
                            {"faults", performance.faults},
                            {"called", judged.called_right   ? "right"
                                       : judged.called_wrong ? "wrong"
                                                             : "unjudged"}});
  }
  return performances;
}

OrderedJson DescribeWords(const SessionLog& log) {
  OrderedJson all = OrderedJson::array();
  for (const LoggedWords& words : log.words) {
    all.push_back({{"begin_frame", words.begin_frame}, {"say", words.say}, {"hint", words.hint}});
    if (words.picture) all.back()["picture"] = EncodePose(*words.picture);
  }
  return all;
}

}  // namespace

Recording RecordCoaching(const CoachStage& stage, const SessionLog& log) {
  OrderedJson extras = {{"format", "etude-coach"}, {"version", 1}, {"song", stage.dance().title}};
  extras["modes"] = DescribeModes(log);
  extras["performances"] = DescribePerformances(stage, log);
  extras["words"] = DescribeWords(log);
  extras["decisions"] = OrderedJson::array();
  for (const CoachRecord& record : log.records) {
    extras["decisions"].push_back({{"frame", record.frame}, {"event", EventName(record.event)}, {"why", record.why}});
  }
  extras["corrections"] = OrderedJson::array();
  for (const GivenCorrection& correction : log.corrections) extras["corrections"].push_back(correction.decided_frame);
  extras["transitions"] = OrderedJson::array();
  for (const LoggedTransition& transition : log.transitions) {
    for (const int seam : transition.seams) extras["transitions"].push_back(seam);
  }
  extras["beats_s"] = log.beats_s;
  extras["joint_states"] = OrderedJson::array();
  for (const SensedFrame& frame : log.sensed.frames) extras["joint_states"].push_back(StateLetters(frame));
  return {{{"coach", log.coach}, {"truth", log.learner}, {"sensed", MotionOf(log.sensed)}},
          extras.dump()};
}

}  // namespace etude
