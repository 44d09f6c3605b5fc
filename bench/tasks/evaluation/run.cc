#include "bench/tasks/evaluation/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/metrics/alignment.h"
#include "bench/metrics/beat_alignment.h"
#include "bench/tasks/evaluation/judged_shares.h"
#include "engine/base/digest.h"

namespace etude {
namespace {

constexpr const char* kNoFit = "the alignment is not determined: fewer than three joints are seen in both motions";
constexpr const char* kNoRoot = "no frame shows the root in both motions";
constexpr const char* kNoFeet = "the answer has no ankles and toes, or fewer than two frames";

/// A metric that is the mean joint error after an alignment, and the reason if the metric has no value.
struct AlignedError {
  const char* id;
  Alignment alignment;
  const char* why_missing;
};
constexpr AlignedError kErrors[] = {{"mpjpe_unaligned_mm", Alignment::kNone, "no joint is seen in both motions"},
                                    {"mpjpe_root_mm", Alignment::kRoot, kNoRoot},
                                    {"mpjpe_root_scaled_mm", Alignment::kRootScaled, kNoRoot},
                                    {"mpjpe_first_frame_mm", Alignment::kFirst, kNoFit},
                                    {"mpjpe_first_frame_scaled_mm", Alignment::kFirstScaled, kNoFit},
                                    {"mpjpe_take_mm", Alignment::kTake, kNoFit},
                                    {"mpjpe_take_scaled_mm", Alignment::kTakeScaled, kNoFit},
                                    {"mpjpe_each_frame_mm", Alignment::kFrame, kNoFit},
                                    {"mpjpe_each_frame_scaled_mm", Alignment::kFrameScaled, kNoFit}};

std::optional<double> Times(double factor, std::optional<double> value) {
  return value ? std::optional(factor * *value) : std::nullopt;
}

std::string DigestOf(const PointTracks& tracks) {
  Digest digest;
  const auto& points = tracks.positions;
  for (std::size_t at = 0; at < points.size();) {
    // Add the points up to the next point that is not seen.
    std::size_t end = at;
    while (end < points.size() && !std::isnan(points[end].x)) ++end;
    if (end > at) digest.Add(std::span(&points[at].x, 3 * (end - at)));
    if (end < points.size()) digest.Add(std::string_view("unseen"));
    at = end + 1;
  }
  return digest.Hex();
}

/// Returns each frame's mean error for a curve, rounded to a nanometre. A frame without a value repeats the previous
/// value.
std::vector<double> CurveOf(const std::vector<double>& errors, std::size_t joints) {
  std::vector<double> curve;
  for (std::size_t at = 0; at < errors.size(); at += joints) {
    const auto mean = MeanOfSeen({&errors[at], joints});
    constexpr double kPerMm = 1e6;
    curve.push_back(mean ? std::round(kPerMm * *mean) / kPerMm : curve.empty() ? 0 : curve.back());
  }
  return curve;
}

void MeasureErrors(const MatchedMotions& matched, const PairFits& fits, CellResult& result) {
  const EvaluatedPair& pair = matched.pair;
  std::vector<JointMeans> by_joint(matched.joints.size());
  for (const AlignedError& error : kErrors) {
    const FrameFits aligned = fits.Of(error.alignment);
    const auto detailed = std::ranges::find(kByJoint, error.alignment);
    if (detailed == kByJoint.end()) {
      result.MeasureOr(error.id, MeanJointErrorMm(pair, aligned), error.why_missing);
      continue;
    }
    const std::vector<double> errors = JointErrorsMm(pair, aligned);
    const auto mean = MeanOfSeen(errors);
    result.MeasureOr(error.id, mean, error.why_missing);
    for (std::size_t joint = 0; joint < by_joint.size(); ++joint) {
      by_joint[joint][detailed - kByJoint.begin()] = MeanOfJoint(errors, by_joint.size(), joint);
    }
    if (error.alignment == Alignment::kFrameScaled) continue;
    if (mean) result.series.push_back({error.id, "frame", CurveOf(errors, pair.found.points)});
    if (error.alignment != Alignment::kRoot) continue;
    constexpr double kPck_mm = 150;
    result.MeasureOr("pck_150mm@mpi_inf_3dhp", ShareBelow(errors, kPck_mm), kNoRoot);
    result.MeasureOr("auc_150mm@mpi_inf_3dhp", AucTo150(errors), kNoRoot);
  }
  for (std::size_t joint = 0; joint < by_joint.size(); ++joint) {
    if (by_joint[joint].front()) {
      result.series.push_back({matched.joints[joint], kJointErrorAxis, EncodeMeans(by_joint[joint])});
    }
  }
  const auto by_segments = [&](std::size_t fitted) {
    return MeanJointErrorMm(pair, fits.OfSegments(kSegmentFrames, fitted));
  };
  result.MeasureOr("w_mpjpe_mm@wham", by_segments(2), kNoFit);
  result.MeasureOr("wa_mpjpe_mm@wham", by_segments(kSegmentFrames), kNoFit);
  result.MeasureOr("rte@wham", RootTranslationError(pair),
                   "the root is seen in both motions in fewer than three frames, or the true root does not move");
}

void MeasureMovement(const MatchedMotions& matched, CellResult& result) {
  const EvaluatedPair &pair = matched.pair, &own = matched.OwnFrames();
  const double rate = pair.rate_hz;
  constexpr const char* kTooShort = "no joint is seen in both motions in three frames in a row";
  constexpr const char* kBetween =
      "the truth has no frames at the answer's times, and interpolation would lower the accelerations of its noise";
  constexpr double kToMm = 1000;
  const bool can_differ = !matched.is_interpolated;
  const auto acceleration = can_differ ? AccelerationError(pair.found, pair.truth) : std::nullopt;
  const auto of_root = can_differ ? RootAccelerationError(pair) : std::nullopt;
  result.MeasureOr("accel_error_mm@human_dynamics", Times(kToMm, acceleration), can_differ ? kTooShort : kBetween);
  result.MeasureOr("accel_error_mps2", Times(rate * rate, acceleration), can_differ ? kTooShort : kBetween);
  result.MeasureOr("accel_error_mps2@wham", Times(rate * rate, of_root),
                   can_differ ? "no joint is seen together with the root in both motions in three frames in a row, not "
                                "counting the first and last frame"
                              : kBetween);
  result.MeasureOr("jitter@wham", Jitter(own.found, own.rate_hz), "no joint is seen in four frames in a row");
}

/// Measures the feet and the floor contact of the answer, with the floor of the answer's file.
void MeasureFeet(const MatchedMotions& matched, CellResult& result) {
  const EvaluatedPair& pair = matched.OwnFrames();
  result.MeasureOr("skating_ratio@gmd", SkatingRatio(pair.feet, pair.rate_hz), kNoFeet);
  result.MeasureOr("skate_from_height_mps@kimodo", SkateFromHeight(pair.feet, pair.rate_hz), kNoFeet);
  const char* no_contacts = pair.found_contacts.empty() ? "the answer's file has no contacts" : kNoFeet;
  result.MeasureOr("skate_from_contacts_mps@kimodo", SkateFromContacts(pair.feet, pair.found_contacts, pair.rate_hz),
                   no_contacts);
  const std::vector<bool>&true_contacts = matched.pair.true_contacts, &contacts = matched.pair.found_contacts;
  const bool have_contacts = !contacts.empty() && !true_contacts.empty();
  result.MeasureOr("contact_f1", ContactF1(contacts, true_contacts),
                   have_contacts ? "neither foot ever touches the floor" : "one of the two files has no contacts");
  result.MeasureOr("pfc@edge", PhysicalFootContact(pair.feet, pair.found_root, pair.rate_hz),
                   "the answer has no ankles, toes or root, has fewer than three frames, or its root does not "
                   "accelerate");
  const FloorErrors floor = MeasureFloor(pair.found);
  result.MeasureOr("penetration_mm", floor.penetration_mm, "no joint of the answer is seen");
  result.MeasureOr("floating_mm", floor.floating_mm, "no joint of the answer is seen");
}

/// Measures the angles that both motions have. Also keeps the sums from which the agreement of each angle over a run is
/// computed.
void MeasureAngles(const MatchedMotions& matched, CellResult& result) {
  std::vector<double> rms, biases, iccs;
  for (std::size_t column = 0; column < matched.true_angles.names.size(); ++column) {
    const AgreementSums sums = SumAgreement(matched.found_angles, matched.true_angles, column);
    const auto none = std::nan("");
    rms.push_back(RmsOf(sums).value_or(none));
    biases.push_back(std::abs(BiasOf(sums).value_or(none)));
    iccs.push_back(IccOf(sums).value_or(none));
    if (sums.count > 0) {
      result.series.push_back({matched.true_angles.names[column], kAgreementAxis, EncodeSums(sums)});
    }
  }
  constexpr const char* kNoAngles = "one of the two files lacks rotations of two neighbouring segments";
  result.MeasureOr("angle_rmse_deg", MeanOfSeen(rms), kNoAngles);
  result.MeasureOr("angle_bias_deg", MeanOfSeen(biases), kNoAngles);
  result.MeasureOr("angle_icc_a1", MeanOfSeen(iccs), kNoAngles);
}

/// Measures the metrics of LAFAN1's code.
void MeasureInbetweening(const MatchedMotions& matched, const EvaluationSideData& side, CellResult& result) {
  constexpr const char* kNoRotations =
      "one of the two files has no joint rotations, or is an array, of which only positions are read";
  const auto rotations = RotationsOf(matched.pair);
  result.MeasureOr("l2q@lafan1", rotations ? MeanChannelDistance(rotations->found, rotations->truth) : std::nullopt,
                   rotations ? "no frame shows every joint in both motions" : kNoRotations);
  // Measure L2P, if the statistics contain every joint.
  std::string why = "needs `statistics`: means and deviations of joints";
  std::vector<glm::dvec3> means, deviations;
  for (const std::string& joint : matched.joints) {
    if (!side.statistics) break;
    const auto known = side.statistics->find(joint);
    if (known == side.statistics->end()) {
      why = "the statistics lack the joint " + joint;
      break;
    }
    means.push_back(known->second.mean);
    deviations.push_back(known->second.deviation);
  }
  std::optional<double> l2p;
  if (means.size() == matched.joints.size()) {
    why = "no frame shows every joint in both motions";
    l2p = MeanChannelDistance(StandardisedChannels(matched.pair.found.positions, means, deviations),
                              StandardisedChannels(matched.pair.truth.positions, means, deviations));
  }
  result.MeasureOr("l2p@lafan1", l2p, why);
  // Measure NPSS, and the weight of this pair among other pairs.
  const bool is_even = matched.is_even;
  const auto measure = [&](PowerOf kind) {
    return rotations && is_even ? MeasurePowerSpectrum(rotations->found, rotations->truth, kWindowFrames, kind)
                                : std::nullopt;
  };
  const char* no_window = rotations && !is_even ? "the frames nearest to the truth's do not follow at equal times"
                          : rotations           ? "no 30 frames in a row show every joint in both motions"
                                                : kNoRotations;
  const auto real = measure(PowerOf::kRealPart), magnitude = measure(PowerOf::kMagnitude);
  const auto part = [](const auto& error, double PowerSpectrumError::*which) {
    return error ? std::optional<double>((*error).*which) : std::nullopt;
  };
  result.MeasureOr("npss@lafan1", part(real, &PowerSpectrumError::value), no_window);
  result.MeasureOr("npss_power@lafan1", part(real, &PowerSpectrumError::power), no_window);
  result.MeasureOr("npss", part(magnitude, &PowerSpectrumError::value), no_window);
  result.MeasureOr("npss_power", part(magnitude, &PowerSpectrumError::power), no_window);
}

void MeasureBeats(const MatchedMotions& matched, const EvaluationSideData& side, CellResult& result) {
  const EvaluatedPair& own = matched.OwnFrames();
  std::vector<double> beats_s = side.music_beats_s.value_or(std::vector<double>());
  for (double& beat_s : beats_s) beat_s -= matched.own_start_s;
  const char* why = side.music_beats_s ? "no beat of the music is within the motion, the motion has no beat of its "
                                         "own, or a joint is not seen throughout"
                                       : "needs `music_beats`";
  for (const auto& [id, measure] :
       {std::pair("beat_alignment@bailando", &BeatAlignmentOfMusic), {"beat_alignment@mint", &BeatAlignmentOfMotion}}) {
    const auto value = side.music_beats_s ? measure(own.found, own.rate_hz, beats_s) : std::nullopt;
    result.MeasureOr(id, value, why);
  }
}

}  // namespace

std::vector<std::string> EvaluationMetrics() {
  std::vector<std::string> ids;
  // The joint errors come first, one for each alignment, and then the other metrics.
  for (const AlignedError& error : kErrors) ids.emplace_back(error.id);
  for (const char* id : {"pck_150mm@mpi_inf_3dhp",
                         "auc_150mm@mpi_inf_3dhp",
                         "w_mpjpe_mm@wham",
                         "wa_mpjpe_mm@wham",
                         "rte@wham",
                         "accel_error_mm@human_dynamics",
                         "accel_error_mps2",
                         "accel_error_mps2@wham",
                         "jitter@wham",
                         "skating_ratio@gmd",
                         "skate_from_height_mps@kimodo",
                         "skate_from_contacts_mps@kimodo",
                         "contact_f1",
                         "pfc@edge",
                         "penetration_mm",
                         "floating_mm",
                         "bend_error_deg",
                         "angle_rmse_deg",
                         "angle_bias_deg",
                         "angle_icc_a1",
                         "l2q@lafan1",
                         "l2p@lafan1",
                         "npss@lafan1",
                         "npss_power@lafan1",
                         "npss",
                         "npss_power",
                         "beat_alignment@bailando",
                         "beat_alignment@mint",
                         "lag_ms",
                         "seen_share"}) {
    ids.emplace_back(id);
  }
  return ids;
}

CellResult JudgeMotion(const MatchedMotions& matched, const EvaluationSideData& side) {
  CellResult result = CellResult::Ended(Status::kOk, matched.note);
  if (side.music_beats_s) {
    const double end_s = static_cast<double>(matched.pair.found.FrameCount()) / matched.pair.rate_hz;
    result.reason += DoubtOnBeats(*side.music_beats_s, end_s, matched.pair.rate_hz);
    if (std::abs(matched.truth_begin_s) * matched.pair.rate_hz >= 0.5) {
      result.reason +=
          fmt::format(", the music's beats are counted from the truth's first frame, which is at {:.6g} s of its clock",
                      matched.truth_begin_s);
    }
  }
  result.digests = {{"truth", DigestOf(matched.pair.truth)}, {"answer", DigestOf(matched.pair.found)}};
  const PairFits fits(matched.pair);
  result.judged = JudgedOf(matched);
  MeasureErrors(matched, fits, result);
  MeasureMovement(matched, result);
  MeasureFeet(matched, result);
  result.MeasureOr("bend_error_deg", BendErrorDeg(matched.pair.found, matched.pair.truth, matched.bends),
                   "no knee or elbow with its neighbours is seen in both motions");
  MeasureAngles(matched, result);
  MeasureInbetweening(matched, side, result);
  MeasureBeats(matched, side, result);
  constexpr double kToMs = 1000;
  result.MeasureOr("lag_ms", matched.lag ? std::optional(kToMs * matched.lag->shift_s) : std::nullopt,
                   "is measured only with `lag: find`");
  result.MeasureOr("seen_share", SeenShare(matched.pair), "the truth shows no joint");
  return result;
}

}  // namespace etude
