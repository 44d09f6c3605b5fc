#include <nlohmann/json.hpp>
#include <vector>

#include "bench/metrics/coach.h"
#include "bench/metrics/transition_smoothness.h"
#include "bench/statistics/curves/curves.h"
#include "tests/bench/metrics/evaluators.h"

namespace etude {
namespace {

std::optional<int> FrameOf(const Json& frame) {
  return frame.is_null() ? std::nullopt : std::optional(frame.get<int>());
}

PerformanceTruth TruthOf(const Json& truth) {
  if (truth == "right") return PerformanceTruth::kRight;
  return truth == "wrong" ? PerformanceTruth::kWrong : PerformanceTruth::kGrey;
}

std::vector<PerformanceTruth> TruthsOf(const Json& truths) {
  std::vector<PerformanceTruth> result;
  for (const Json& truth : truths) result.push_back(TruthOf(truth));
  return result;
}

CoachedSession SessionOf(const Json& in) {
  CoachedSession session{in.at("rate_hz").get<double>(), in.at("frames").get<int>(), {}, {}};
  for (const Json& told : in.at("performances")) {
    session.performances.push_back({told.at("begin_frame").get<int>(), told.at("end_frame").get<int>(),
                                    TruthOf(told.at("truth")), FrameOf(told.at("called_wrong")),
                                    told.at("called_right").get<bool>()});
  }
  for (const Json& told : in.at("corrections")) {
    session.corrections.push_back({told.at("decided_frame").get<int>(), FrameOf(told.at("act_frame"))});
  }
  return session;
}

template <int CorrectionTally::*kCount>
Value PerMinute(const Json& in) {
  const CoachedSession session = SessionOf(in);
  return TallyCorrections(session).*kCount / session.Minutes();
}

Value UntilRight(const Json& in) {
  std::vector<std::vector<PerformanceTruth>> moves;
  for (const Json& move : in.at("moves")) moves.push_back(TruthsOf(move));
  return RepetitionsUntilRight(moves);
}

std::vector<double> NumbersOf(const Json& in, const char* key) { return in.at(key).get<std::vector<double>>(); }

}  // namespace

std::span<const Evaluator> CoachEvaluators() {
  static constexpr Evaluator kAll[] = {
      {"corrections_due_per_min", PerMinute<&CorrectionTally::due>},
      {"corrections_given_per_min", PerMinute<&CorrectionTally::given>},
      {"corrections_missed_per_min", PerMinute<&CorrectionTally::missed>},
      {"corrections_unneeded_per_min", PerMinute<&CorrectionTally::unneeded>},
      {"wrong_praise_per_min", PerMinute<&CorrectionTally::wrong_praise>},
      {"answered_share", [](const Json& in) -> Value { return AnsweredShare(TallyCorrections(SessionOf(in))); }},
      {"decision_delay_s", [](const Json& in) -> Value { return DecisionDelaySeconds(SessionOf(in)); }},
      {"feedback_delay_s", [](const Json& in) -> Value { return FeedbackDelaySeconds(SessionOf(in)); }},
      {"feedback_delay_max_s", [](const Json& in) -> Value { return MaxFeedbackDelaySeconds(SessionOf(in)); }},
      {"repetitions_until_right", UntilRight},
      {"retention", [](const Json& in) -> Value { return Retention(NumbersOf(in, "chances")); }},
      {"danced_share",
       [](const Json& in) -> Value { return Share(in.at("danced_frames").get<int>(), in.at("frames").get<int>()); }},
      {"gave_up", [](const Json& in) -> Value { return in.at("given_up").get<bool>() ? 1.0 : 0.0; }},
      {"beat_error_ms", [](const Json& in) -> Value { return BeatErrorMs(NumbersOf(in, "errors_s")); }},
      {"transition_jump_cm", [](const Json& in) -> Value { return MedianOf(NumbersOf(in, "jumps_cm")); }},
      {"transition_natural_share",
       [](const Json& in) -> Value {
         return NaturalShare(NumbersOf(in, "jumps_cm"), NumbersOf(in, "natural_jumps_cm"));
       }},
      {"transition_bridged_share",
       [](const Json& in) -> Value { return Share(in.at("bridged").get<int>(), in.at("transitions").get<int>()); }},
  };
  return kAll;
}

}  // namespace etude
