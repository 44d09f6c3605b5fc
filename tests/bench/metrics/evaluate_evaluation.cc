#include <nlohmann/json.hpp>
#include <vector>

#include "bench/metrics/alignment.h"
#include "bench/metrics/beat_alignment.h"
#include "bench/metrics/evaluation.h"
#include "bench/metrics/joint_angles.h"
#include "bench/metrics/time_shift.h"
#include "tests/bench/metrics/evaluators.h"
#include "tests/bench/metrics/vector_input.h"

namespace etude {
namespace {

glm::dvec3 PointOrUnseen(const Json& json) {
  return ReadOptionalPoint(json).value_or(glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
}

PointTracks TracksOf(const Json& in, const char* key) {
  PointTracks tracks;
  for (const Json& frame : in.at(key)) {
    tracks.points = frame.size();
    for (const Json& point : frame) tracks.positions.push_back(PointOrUnseen(point));
  }
  return tracks;
}

std::vector<glm::dvec3> RootOf(const Json& in, const char* key) {
  std::vector<glm::dvec3> root;
  for (const Json& point : in.at(key)) root.push_back(PointOrUnseen(point));
  return root;
}

EvaluatedPair PairOf(const Json& in, bool has_roots = false) {
  EvaluatedPair pair{.found = TracksOf(in, "found"), .truth = TracksOf(in, "truth")};
  if (has_roots) {
    pair.found_root = RootOf(in, "found_root");
    pair.true_root = RootOf(in, "true_root");
  }
  return pair;
}

std::vector<double> RootErrors(const Json& in) {
  const EvaluatedPair pair = PairOf(in, true);
  return JointErrorsMm(pair, PairFits(pair).Of(Alignment::kRoot));
}

template <Alignment alignment>
Value Mpjpe(const Json& in) {
  const bool by_root = alignment == Alignment::kRoot || alignment == Alignment::kRootScaled;
  const EvaluatedPair pair = PairOf(in, by_root);
  return MeanJointErrorMm(pair, PairFits(pair).Of(alignment));
}

template <bool by_first_two>
Value SegmentMpjpe(const Json& in) {
  const EvaluatedPair pair = PairOf(in);
  const auto length = in.at("segment").get<std::size_t>();
  return MeanJointErrorMm(pair, PairFits(pair).OfSegments(length, by_first_two ? 2 : length));
}

Value Times(double factor, Value value) { return value ? Value(factor * *value) : std::nullopt; }

double RateOf(const Json& in) { return in.at("rate_hz").get<double>(); }

Value AccelerationMps2(const Json& in) {
  const EvaluatedPair pair = PairOf(in);
  return Times(RateOf(in) * RateOf(in), AccelerationError(pair.found, pair.truth));
}

Value RootAccelerationMps2(const Json& in) {
  const EvaluatedPair pair = PairOf(in, true);
  return Times(RateOf(in) * RateOf(in), RootAccelerationError(pair));
}

Value Rte(const Json& in) {
  return RootTranslationError({.found_root = RootOf(in, "found_root"), .true_root = RootOf(in, "true_root")});
}

std::vector<glm::dquat> TurnsOf(const Json& in, const char* key) {
  std::vector<glm::dquat> turns;
  for (const Json& frame : in.at(key)) {
    for (const Json& q : frame) {
      turns.emplace_back(q.at(0).get<double>(), q.at(1).get<double>(), q.at(2).get<double>(), q.at(3).get<double>());
    }
  }
  return turns;
}

std::optional<RotationChannels> RotationsIn(const Json& in) {
  EvaluatedPair pair{.found_turns = TurnsOf(in, "found_turns"), .true_turns = TurnsOf(in, "true_turns")};
  pair.found.points = in.at("true_turns").at(0).size();
  pair.found.positions.resize(pair.true_turns.size());
  pair.truth = pair.found;
  return RotationsOf(pair);
}

Value L2q(const Json& in) {
  const auto rotations = RotationsIn(in);
  return rotations ? MeanChannelDistance(rotations->found, rotations->truth) : std::nullopt;
}

Value L2p(const Json& in) {
  std::vector<glm::dvec3> means, deviations;
  for (const Json& joint : in.at("statistics")) {
    means.push_back(PointOrUnseen(joint.at(0)));
    deviations.push_back(PointOrUnseen(joint.at(1)));
  }
  return MeanChannelDistance(StandardisedChannels(TracksOf(in, "found").positions, means, deviations),
                             StandardisedChannels(TracksOf(in, "truth").positions, means, deviations));
}

template <PowerOf kind, double PowerSpectrumError::*part>
Value Npss(const Json& in) {
  const auto rotations = RotationsIn(in);
  if (!rotations) return std::nullopt;
  const auto error = MeasurePowerSpectrum(rotations->found, rotations->truth, in.at("window").get<std::size_t>(), kind);
  return error ? Value((*error).*part) : std::nullopt;
}

Value LagMs(const Json& in) {
  const auto shift =
      FindTimeShift(TracksOf(in, "truth"), RateOf(in), TracksOf(in, "found"), in.at("found_rate_hz").get<double>());
  return shift ? Value(1000 * shift->shift_s) : std::nullopt;
}

AngleTracks AnglesIn(const Json& in, const char* key) {
  AngleTracks angles;
  for (const Json& frame : in.at(key)) {
    angles.names.resize(frame.size());
    for (const Json& value : frame) angles.degrees.push_back(value.is_null() ? std::nan("") : value.get<double>());
  }
  return angles;
}

/// Returns the mean of `measure` over the columns of angles.
template <auto measure, bool is_absolute>
Value MeanOverAngles(const Json& in) {
  const AngleTracks found = AnglesIn(in, "found_angles"), truth = AnglesIn(in, "true_angles");
  std::vector<double> values;
  for (std::size_t column = 0; column < truth.names.size(); ++column) {
    const double value = measure(SumAgreement(found, truth, column)).value_or(std::nan(""));
    values.push_back(is_absolute ? std::abs(value) : value);
  }
  return MeanOfSeen(values);
}

std::vector<bool> ContactsIn(const Json& in, const char* key) {
  std::vector<bool> contacts;
  for (const Json& frame : in.at(key)) {
    for (const Json& contact : frame) contacts.push_back(contact.get<int>() != 0);
  }
  return contacts;
}

template <auto measure>
Value Beats(const Json& in) {
  return measure(TracksOf(in, "found"), RateOf(in), in.at("beats_s").get<std::vector<double>>());
}

Value Bend(const Json& in) {
  return BendErrorDeg(TracksOf(in, "found"), TracksOf(in, "truth"),
                      in.at("bends").get<std::vector<std::array<std::size_t, 3>>>());
}

}  // namespace

std::span<const Evaluator> EvaluationEvaluators() {
  using enum Alignment;
  static constexpr Evaluator kAll[] = {
      {"mpjpe_unaligned_mm", Mpjpe<kNone>},
      {"mpjpe_root_mm", Mpjpe<kRoot>},
      {"mpjpe_root_scaled_mm", Mpjpe<kRootScaled>},
      {"mpjpe_first_frame_mm", Mpjpe<kFirst>},
      {"mpjpe_first_frame_scaled_mm", Mpjpe<kFirstScaled>},
      {"mpjpe_take_mm", Mpjpe<kTake>},
      {"mpjpe_take_scaled_mm", Mpjpe<kTakeScaled>},
      {"mpjpe_each_frame_mm", Mpjpe<kFrame>},
      {"mpjpe_each_frame_scaled_mm", Mpjpe<kFrameScaled>},
      {"pck_150mm@mpi_inf_3dhp", [](const Json& in) -> Value { return ShareBelow(RootErrors(in), 150); }},
      {"auc_150mm@mpi_inf_3dhp", [](const Json& in) -> Value { return AucTo150(RootErrors(in)); }},
      {"accel_error_mm@human_dynamics",
       [](const Json& in) -> Value {
         return Times(1000, AccelerationError(TracksOf(in, "found"), TracksOf(in, "truth")));
       }},
      {"accel_error_mps2", AccelerationMps2},
      {"accel_error_mps2@wham", RootAccelerationMps2},
      {"w_mpjpe_mm@wham", SegmentMpjpe<true>},
      {"wa_mpjpe_mm@wham", SegmentMpjpe<false>},
      {"rte@wham", Rte},
      {"jitter@wham", [](const Json& in) -> Value { return Jitter(TracksOf(in, "found"), RateOf(in)); }},
      {"skating_ratio@gmd", [](const Json& in) -> Value { return SkatingRatio(TracksOf(in, "feet"), RateOf(in)); }},
      {"skate_from_height_mps@kimodo",
       [](const Json& in) -> Value { return SkateFromHeight(TracksOf(in, "feet"), RateOf(in)); }},
      {"skate_from_contacts_mps@kimodo",
       [](const Json& in) -> Value {
         return SkateFromContacts(TracksOf(in, "feet"), ContactsIn(in, "found_contacts"), RateOf(in));
       }},
      {"contact_f1",
       [](const Json& in) -> Value {
         return ContactF1(ContactsIn(in, "found_contacts"), ContactsIn(in, "true_contacts"));
       }},
      {"pfc@edge",
       [](const Json& in) -> Value {
         return PhysicalFootContact(TracksOf(in, "feet"), RootOf(in, "found_root"), RateOf(in));
       }},
      {"penetration_mm", [](const Json& in) -> Value { return MeasureFloor(TracksOf(in, "found")).penetration_mm; }},
      {"floating_mm", [](const Json& in) -> Value { return MeasureFloor(TracksOf(in, "found")).floating_mm; }},
      {"bend_error_deg", Bend},
      {"angle_rmse_deg", MeanOverAngles<RmsOf, false>},
      {"angle_bias_deg", MeanOverAngles<BiasOf, true>},
      {"angle_icc_a1", MeanOverAngles<IccOf, false>},
      {"l2q@lafan1", L2q},
      {"l2p@lafan1", L2p},
      {"npss@lafan1", Npss<PowerOf::kRealPart, &PowerSpectrumError::value>},
      {"npss_power@lafan1", Npss<PowerOf::kRealPart, &PowerSpectrumError::power>},
      {"npss", Npss<PowerOf::kMagnitude, &PowerSpectrumError::value>},
      {"npss_power", Npss<PowerOf::kMagnitude, &PowerSpectrumError::power>},
      {"beat_alignment@bailando", Beats<BeatAlignmentOfMusic>},
      {"beat_alignment@mint", Beats<BeatAlignmentOfMotion>},
      {"lag_ms", LagMs},
      {"seen_share", [](const Json& in) -> Value { return SeenShare(PairOf(in)); }},
  };
  return kAll;
}

}  // namespace etude
