#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "engine/base/angles.h"
#include "engine/base/names.h"
#include "engine/formats/trc.h"
#include "engine/keypoints/adjust_person.h"
#include "engine/keypoints/agreement.h"
#include "engine/keypoints/keypoint_motion.h"
#include "engine/keypoints/rig_warnings.h"
#include "engine/retargeting/exchanged_sides.h"
#include "engine/unmarked/join_outlines.h"
#include "io/files/files.h"
#include "tools/capture/capture_parts.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

RecoverPersonOptions RecoverOptionsOf(const CaptureFilmsOptions& options, const std::vector<FilmedView>& views) {
  double longer_side = 0;
  for (const FilmedView& view : views) {
    const Intrinsics& in = view.camera.camera.intrinsics;
    longer_side = std::max<double>({longer_side, static_cast<double>(in.width), static_cast<double>(in.height)});
  }
  RecoverPersonOptions recover = DefaultRecovery(views.front().facts.rate_hz, longer_side);
  recover.person = static_cast<std::size_t>(options.person - 1);
  recover.cutoff_hz = options.smooth_hz;
  recover.max_gap_s = options.max_gap_s;
  constexpr double kMinOutlierShare =
      0.004;  // share of the picture's longer side; rounding and lens distortion cause errors up to this size
  recover.min_outlier_px = kMinOutlierShare * longer_side;
  if (options.outlier_px > 0) recover.triangulate.robust.outlier_px = recover.min_outlier_px = options.outlier_px;
  recover.corrects = recover.match.may_be_swapped = true;
  return recover;
}

std::string PeopleText(const RecoveredPerson& person, const std::vector<FilmedView>& views) {
  std::string text;
  int number = 0, alone = 0;
  for (const MatchedPerson& one : person.people) {
    if (one.cameras < 2) {
      ++alone;
      continue;
    }
    std::string by;
    for (std::size_t i = 0; i < views.size(); ++i) {
      const auto frames = std::ranges::count_if(one.seen[i], [](const auto& seen) { return seen.has_value(); });
      if (frames > 0) by += fmt::format("{}{} ({} frames)", by.empty() ? "" : ", ", views[i].camera.name, frames);
    }
    text += fmt::format("person {}: seen by {}; the median distance between rays is {:.1f} % of the person's height\n",
                        ++number, by, 100 * one.error);
  }
  if (alone > 0) {
    text += fmt::format("{} track{} seen by only one camera: other people, or errors\n", alone, alone == 1 ? "" : "s");
  }
  return text;
}

std::string ReportText(const RecoveredPerson& person, const std::vector<FilmedView>& views) {
  std::string text;
  text += fmt::format(
      "points: {:.1f} % triangulated, with a median residual of {:.1f} px; keypoints with more than {:.1f} px are "
      "outliers",
      100 * person.report.found, person.report.residual_px, person.outlier_px);
  for (std::size_t i = 0; i < views.size(); ++i) {
    text += fmt::format("{} {} {:.1f} %", i == 0 ? "; share of outliers:" : ",", views[i].camera.name,
                        100 * person.report.rejected[i]);
  }
  std::vector<std::string> lengths;
  constexpr double kCmPerMetre = 100;
  for (const auto& [name, metres] : ShownLengths(person.body.lengths)) {
    lengths.push_back(fmt::format("{} {:.1f}", name, kCmPerMetre * metres));
  }
  // The landmark is the top of the head; files often have this joint in the middle of the head.
  const bool has_top = std::ranges::any_of(
      person.landmarks, [](const LandmarkPositions& at) { return at[Index(Landmark::kHead)].has_value(); });
  if (has_top)
    lengths.push_back(
        fmt::format("from the neck to the top of the head {:.1f}", kCmPerMetre * person.body.lengths.neck));
  text += fmt::format("\nlimb lengths, cm: {}\n", Join(lengths));
  const auto held = std::ranges::count(person.is_held, true);
  if (held > 0) text += fmt::format("{} frames show too few keypoints and repeat the last pose\n", held);
  return text;
}

/// Returns the findings of a capture from keypoints as JSON.
Json FactsOf(const RecoveredPerson& person, const std::vector<FilmedView>& views,
             const std::vector<std::string>& told) {
  Json cameras = Json::array(), fit = Json::array();
  for (std::size_t i = 0; i < views.size(); ++i) {
    cameras.push_back({{"camera", views[i].camera.name}, {"left_out_share", person.report.rejected[i]}});
  }
  const MarkerMotion points = JointMarkers(person.landmarks, person.motion.rate_hz);
  for (const MarkerAgreement& row : CompareMarkers(JointMarkers(person.motion), points)) {
    if (row.frames > 0) fit.push_back({{"joint", row.name}, {"median_mm", row.median_mm}, {"p95_mm", row.p95_mm}});
  }
  Json lengths;
  for (auto [name, metres] : ShownLengths(person.body.lengths)) {
    std::ranges::replace(name, ' ', '_');
    lengths[name] = metres;
  }
  return {{"people", std::ranges::count_if(person.people, [](const auto& one) { return one.cameras >= 2; })},
          {"found_share", person.report.found},
          {"residual_px", person.report.residual_px},
          {"outlier_px", person.outlier_px},
          {"held_frames", std::ranges::count(person.is_held, true)},
          {"cameras", std::move(cameras)},
          {"lengths_m", std::move(lengths)},
          {"fit", std::move(fit)},
          {"told", told}};
}

/// Reports the distances between the joints of the written motion and the points to which the joints were fitted.
std::string FitText(const RecoveredPerson& person) {
  std::string text;
  const MarkerMotion skeleton = JointMarkers(person.motion);
  const MarkerMotion points = JointMarkers(person.landmarks, person.motion.rate_hz);
  std::vector<MarkerAgreement> rows = CompareMarkers(skeleton, points);
  rows.push_back(CompareAllMarkers(skeleton, points));
  text += fmt::format("\nDistance from the skeleton's joints to the triangulated points, mm:\n{:<16}{:>8}{:>8}\n", "",
                      "median", "p95");
  for (const MarkerAgreement& row : rows) {
    if (row.frames > 0) text += fmt::format("{:<16}{:>8.1f}{:>8.1f}\n", row.name, row.median_mm, row.p95_mm);
  }
  return text;
}

/// Tracks the person again with silhouettes added to the keypoints.
Result<UnmarkedMotion> WithOutlines(const RecoveredPerson& person, std::size_t chosen, const ReducedTake& take,
                                    const CaptureFilmsOptions& options) {
  return RecoverByOutlines(take, options, person.motion.rate_hz,
                           {.person = &person.people[chosen], .lengths = person.body.lengths});
}

/// Returns true if, in most frames, the person hangs upside down with exchanged sides in all cameras: seen from afar,
/// pictures that are turned by 180° show this.
bool HangsMirrored(const RecoveredPerson& person, std::size_t cameras) {
  constexpr double kMaxLean = Radians(120), kMostly = 0.5;
  std::size_t hanging = 0, standing = 0, exchanged = 0;
  for (const LandmarkPositions& at : person.landmarks) {
    using enum Landmark;
    const auto &a = at[Index(kLeftAnkle)], &b = at[Index(kRightAnkle)], &c = at[Index(kLeftShoulder)],
               &d = at[Index(kRightShoulder)];
    if (!a || !b || !c || !d) continue;
    const glm::dvec3 body = *c + *d - *a - *b;
    ++(body.y < std::cos(kMaxLean) * glm::length(body) ? hanging : standing);
  }
  for (std::size_t camera = 0; camera < cameras; ++camera) {
    std::size_t frames = 0;
    for (const PersonCorrection& correction : person.corrections) {
      if (correction.camera == camera && correction.kind == PersonCorrection::Kind::kSwappedSides)
        frames += correction.frames.size();
    }
    exchanged += static_cast<double>(frames) > kMostly * static_cast<double>(person.landmarks.size());
  }
  return hanging > standing && exchanged == cameras;
}

/// Returns the first doubt about the keypoints' layout or scores, which explains why nobody was found, for the end of a
/// message.
std::string DoubtOfLayout(const SeenFilms& films) {
  for (const std::string& line : films.told.lines) {
    if (line.find(" have a score below ") != line.npos) return "; " + line;
    if (line.starts_with("doubtful: ") && line.find("layout") != line.npos)
      return "; " + line.substr(line.find(' ') + 1);
  }
  return "";
}

AdjustPersonOptions AdjustOf(const RecoverPersonOptions& recover) {
  return {.rate_hz = recover.rate_hz, .min_confidence = recover.triangulate.min_confidence};
}

/// Compares the joints from silhouettes and keypoints with a reference, for all cameras and for each pair alone.
Result<std::vector<ComparedColumn>> CompareWithOutlines(const MarkerMotion& reference, const BodyMotion& both,
                                                        const SeenFilms& films, const ReducedTake& take,
                                                        const RecoverPersonOptions& recover,
                                                        const CaptureFilmsOptions& options) {
  const MarkerMotion joints = JointsOfReference(reference);
  std::vector<ComparedColumn> columns{CompareColumn("all", JointMarkers(both), joints)};
  for (const CameraPair& pair : PairsOf(films.cameras.size())) {
    const std::array cameras = {films.cameras[pair.first], films.cameras[pair.second]};
    const std::array people = {films.people[pair.first], films.people[pair.second]};
    auto seen = RecoverPerson(cameras, people, recover);
    const std::size_t chosen = seen ? IndexOfPerson(*seen, recover.person).value_or(0) : 0;
    if (seen) AdjustPerson(cameras, seen->people[chosen], AdjustOf(recover), *seen);
    const auto found = seen ? WithOutlines(*seen, chosen, PairOf(take, pair), options)
                            : Result<UnmarkedMotion>(tl::unexpected(seen.error()));
    if (found) JoinOutlines(cameras, seen->people[chosen], found->motion, AdjustOf(recover), *seen);
    columns.push_back(found ? CompareColumn(pair.heading, JointMarkers(seen->motion), joints)
                            : ComparedColumn{pair.heading + kLost, {}, {}});
  }
  return columns;
}

/// Returns true if the markers of a reference are an estimator's landmarks; false if the markers are joints.
bool HasLandmarks(const MarkerMotion& reference) {
  return std::ranges::any_of(reference.names, [](const std::string& name) { return FindLandmark(name).has_value(); });
}

/// Returns the motion that is compared with a reference: the triangulated keypoints, or the skeleton's joints.
MarkerMotion ComparedOf(const RecoveredPerson& person, const MarkerMotion& reference, double rate_hz) {
  return HasLandmarks(reference) ? ToMarkers(person.landmarks, rate_hz) : JointMarkers(person.motion);
}

/// Compares the person with a reference, for all cameras and for each pair alone. For a pair, the person is recovered
/// again from the keypoints of the pair's films.
std::vector<ComparedColumn> CompareWithReference(const MarkerMotion& reference, const RecoveredPerson& person,
                                                 const SeenFilms& films, const RecoverPersonOptions& options) {
  const auto column = [&](std::string heading, const RecoveredPerson& of) {
    return CompareColumn(std::move(heading), ComparedOf(of, reference, options.rate_hz), reference);
  };
  std::vector<ComparedColumn> columns{column("all", person)};
  for (const CameraPair& pair : PairsOf(films.cameras.size())) {
    const std::array cameras = {films.cameras[pair.first], films.cameras[pair.second]};
    const std::array people = {films.people[pair.first], films.people[pair.second]};
    const auto recovered = RecoverPerson(cameras, people, options);
    columns.push_back(recovered ? column(pair.heading, *recovered) : ComparedColumn{pair.heading + kLost, {}, {}});
  }
  return columns;
}

/// Prints the cameras and frames in which keypoints contradict the rig.
void TellDoubts(const MatchedPerson& person, const std::vector<FilmedView>& views, double min_confidence,
                MessageLog& told) {
  std::vector<Camera> cameras;
  std::vector<std::string> names;
  for (const FilmedView& view : views) {
    cameras.push_back(view.camera.camera);
    names.push_back(view.camera.name);
  }
  for (const std::string& doubt : RigWarnings(cameras, names, person, min_confidence)) {
    told.Tell("doubtful: " + doubt);
  }
}

/// Moves the rig, its views and the points into the world: metres, Y up, with the floor that the options define.
Result<void> PlaceInWorld(const CaptureFilmsOptions& options, double rate_hz, FilmedSession& session, SeenFilms& films,
                          RecoveredPerson& located) {
  std::vector<FilmedView>& views = session.views;
  for (const FilmedView& view : views) {  // `SeeFilms` may have exchanged or corrected the cameras in `views`
    const auto same = std::ranges::find(session.rig.cameras, view.camera.name, &NamedCamera::name);
    if (same != session.rig.cameras.end()) same->camera = view.camera.camera;
  }
  const auto place = PlaceRig(session.rig, located.landmarks, rate_hz, options.place);
  if (!place && !place.error().place.file.empty()) {
    return Fail({options.marks.empty() ? options.keypoints : options.marks}, "{}{}", place.error().message,
                DoubtOfLayout(films));
  }
  if (!place) return Fail({options.rig}, "{}", place.error().message);
  films.told.Tell(fmt::format("rig, {}: {}", session.rig.format, place->told));
  if (!place->doubt.empty()) films.told.Tell("doubtful: " + place->doubt);
  if (place->IsNone()) return {};
  for (std::size_t i = 0; i < views.size(); ++i) {
    views[i].camera.camera = Placed(*place, views[i].camera.camera);
    films.cameras[i] = MatrixOf(views[i].camera.camera);
  }
  for (LandmarkPositions& frame : located.landmarks) {
    for (auto& point : frame) {
      if (point) point = (*place)(*point);
    }
  }
  return {};
}

/// Reports the people, the repairs, the doubts and the residuals.
void TellFindings(const CaptureFilmsOptions& options, const RecoverPersonOptions& recover,
                  const std::vector<FilmedView>& views, const RecoveredPerson& person, std::size_t chosen,
                  MessageLog& told) {
  options.listener.print(PeopleText(person, views));
  TellCorrections(person, chosen, views, told);
  TellDoubts(person.people[chosen], views, recover.triangulate.min_confidence, told);
  std::vector<JointPositions> joints;
  for (const LandmarkPositions& frame : person.landmarks) joints.push_back(JointsOf(frame));
  if (HangsMirrored(person, views.size())) {
    told.Tell(
        "doubtful: the person is upside down, and left and right are exchanged in all cameras. The pictures of all "
        "films may be rotated by 180° relative to the rig");
  }
  const std::string exchanged = DescribeExchangedJoints(joints, recover.rate_hz);
  if (!exchanged.empty()) told.Tell("doubtful: " + exchanged);
  options.listener.print(ReportText(person, views) + FitText(person));
}

/// The outlines in all films, and the motion that fits keypoints and outlines.
struct CapturedOutlines {
  ReducedTake take;
  UnmarkedMotion motion;
};

/// Reads the silhouettes and fits the person's joints to keypoints and outlines together.
Result<CapturedOutlines> RefineWithOutlines(const CaptureFilmsOptions& options, const RecoverPersonOptions& recover,
                                            const std::vector<FilmedView>& views, std::size_t chosen, SeenFilms& films,
                                            RecoveredPerson& person) {
  ASSIGN_OR_RETURN(ReducedTake take, ReadTake(options, views, films.clocks, films.told));
  ASSIGN_OR_RETURN(UnmarkedMotion both, WithOutlines(person, chosen, take, options));
  if (JoinOutlines(films.cameras, person.people[chosen], both.motion, AdjustOf(recover), person)) {
    films.told.Tell(
        fmt::format("{}; the joints are fitted to keypoints and outlines together", OutlinesText(views, both)));
  } else {
    films.told.Tell(
        "doubtful: found no motion that fits keypoints and outlines at once, so the joints are fitted to the "
        "keypoints alone");
  }
  return CapturedOutlines{std::move(take), std::move(both)};
}

/// Compares the captured motion with a reference, and reports the distances.
Result<void> CompareWith(const MarkerMotion& reference, const CaptureFilmsOptions& options,
                         const RecoverPersonOptions& recover, const std::vector<FilmedView>& views,
                         const CapturedOutlines* outlines, const RecoveredPerson& person, SeenFilms& films) {
  const std::string what =
      fmt::format("Median distance between the {} and {}, mm.",
                  outlines || !HasLandmarks(reference) ? "joints" : "triangulated keypoints", options.reference);
  const MarkerMotion in_time = SynchroniseWith(ComparedOf(person, reference, recover.rate_hz), reference, films.told);
  std::vector<ComparedColumn> columns;
  if (outlines) {
    ASSIGN_OR_RETURN(columns, CompareWithOutlines(in_time, person.motion, films, outlines->take, recover, options));
  } else {
    columns = CompareWithReference(in_time, person, films, recover);
  }
  return TellColumns(
      what + " If the reference was made from the same\nkeypoints, the distance shows agreement, not error.", columns,
      views, options);
}

}  // namespace

Result<KeypointNoise> MeasureFilmedNoise(const CaptureFilmsOptions& options) {
  ASSIGN_OR_RETURN(FilmedSession session, OpenFilms(options));
  const RecoverPersonOptions recover = RecoverOptionsOf(options, session.views);
  ASSIGN_OR_RETURN(SeenFilms films, SeeFilms(options, recover, session));
  ASSIGN_OR_RETURN(const RecoveredPerson person, LocatePerson(films.cameras, films.people, recover));
  const std::size_t chosen = IndexOfPerson(person, recover.person).value_or(0);
  TellCorrections(person, chosen, session.views, films.told);
  const auto noise =
      MeasureKeypointNoise(films.cameras, person.people[chosen], recover.triangulate.min_confidence, person.outlier_px);
  if (!noise) return Fail({options.keypoints}, "no keypoint is seen by two cameras that agree on its position");
  return *noise;
}

Result<bool> CaptureKeypoints(const CaptureFilmsOptions& options, FilmedSession session,
                              const std::optional<MarkerMotion>& reference, Json& facts) {
  std::vector<FilmedView>& views = session.views;
  // Read the keypoints and triangulate the person in the rig's coordinates.
  const RecoverPersonOptions recover = RecoverOptionsOf(options, views);
  ASSIGN_OR_RETURN(SeenFilms films, SeeFilms(options, recover, session));
  auto found = LocatePerson(films.cameras, films.people, recover);
  if (!found) return Fail(found.error().place, "{}{}", found.error().message, DoubtOfLayout(films));
  RecoveredPerson located = *std::move(found);
  RETURN_IF_ERROR(PlaceInWorld(options, recover.rate_hz, session, films, located));
  // Fit the skeleton: each frame alone, or all frames at once.
  ASSIGN_OR_RETURN(RecoveredPerson person, FitLocated(std::move(located), recover));
  const std::size_t chosen = IndexOfPerson(person, recover.person).value_or(0);
  if (options.poses == "bundle" && options.smooth_hz == 0) {
    if (!AdjustPerson(films.cameras, person.people[chosen], AdjustOf(recover), person)) {
      films.told.Tell(
          "doubtful: found no motion that fits all keypoints at once, so every frame was fitted separately");
    }
  }
  TellFindings(options, recover, views, person, chosen, films.told);
  facts["keypoints"] = FactsOf(person, views, films.told.lines);
  std::optional<CapturedOutlines> outlines;
  if (options.silhouettes) {
    ASSIGN_OR_RETURN(outlines, RefineWithOutlines(options, recover, views, chosen, films, person));
    const UnmarkedMotion& both = outlines->motion;
    facts["silhouettes"] = {{"stature_m", both.stature_m}, {"cost", both.cost}, {"held_frames", both.held}};
  }
  // Write the motion and the points.
  RETURN_IF_ERROR(WriteMotion(options, person.clip, person.motion));
  if (!options.points.empty()) {
    const std::string name = fs::path(options.output).stem().string();
    RETURN_IF_ERROR(WriteFileAtomically(options.points, WriteTrc(ToMarkers(person.landmarks, recover.rate_hz), name)));
    TellWritten(options.listener, options.points);
  }
  if (reference) {
    RETURN_IF_ERROR(CompareWith(*reference, options, recover, views, outlines ? &*outlines : nullptr, person, films));
  }
  // Write the film and the page.
  if (!options.report.empty())
    return WriteReport(options, views, person, chosen, films, outlines ? &outlines->motion : nullptr);
  if (options.film.empty()) return true;
  return WriteFilm(options, OverlaysOf(views, person, chosen, films.clocks), person.motion);
}

}  // namespace etude
