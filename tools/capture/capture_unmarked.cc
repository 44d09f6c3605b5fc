#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/keypoints/agreement.h"
#include "engine/kinematics/limb_lengths.h"
#include "engine/unmarked/recover_unmarked.h"
#include "io/keypoints/read_people.h"
#include "tools/capture/capture_parts.h"
#include "tools/capture/mask_films.h"
#include "tools/capture/reduced_film.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxPictures = 4000;  // reduced pictures of all films: about 2 GB of memory

Result<ColourImage> ReadRoom(const std::string& folder, const FilmedView& view) {
  ASSIGN_OR_RETURN(const fs::path entry, EntryOfFilm(folder, view.path.stem().string()));
  ASSIGN_OR_RETURN(const FilmFacts facts, ProbeFilm(entry));
  if (facts.width != view.facts.width || facts.height != view.facts.height) {
    return Fail({entry.string()}, "the picture has {} x {} pixels, but the film {} has {} x {}", facts.width,
                facts.height, view.path.string(), view.facts.width, view.facts.height);
  }
  ASSIGN_OR_RETURN(auto pictures,
                   ReadReduced(entry, facts, view.camera.camera, view.fit, UnmarkedTake::kPictureSide, 1));
  if (pictures.empty()) return Fail({entry.string()}, "the file contains no picture");
  return std::move(pictures.front());
}

/// Sets the clocks from the films' frame rates, and reports rates that differ.
std::vector<FilmClock> ClocksByRates(const std::vector<FilmedView>& views, MessageLog& told) {
  const FilmFacts& first = views.front().facts;
  std::vector<FilmClock> clocks;
  for (const FilmedView& view : views) {
    clocks.emplace_back();
    const double own = view.facts.rate_hz, rate = first.rate_hz;
    if (own == rate) continue;
    constexpr double kMs = 1000;
    const double seconds = first.EvenFrames() / rate;
    const bool is_one = std::abs(own - rate) <= kSameRateTolerance * rate;
    if (!is_one) clocks.back().drift = rate / own - 1;
    told.Tell(fmt::format("{}: the film has {:g} frames per second, but the first film has {:g}; ", view.camera.name,
                          own, rate) +
              (is_one ? fmt::format("Etude assumes that both have the same rate; if both stated rates were right, the "
                                    "error at the end would be {:.0f} ms",
                                    kMs * seconds * std::abs(own / rate - 1))
                      : fmt::format("Etude uses the picture that is nearest in time, which is up to {:.0f} ms away",
                                    0.5 * kMs / own)));
  }
  return clocks;
}

/// Selects the pictures of a film that are nearest to the times of the first film's frames.
template <typename Picture>
std::vector<Picture> NearestInTime(std::vector<Picture> film, const FilmFacts& facts, const FilmClock& clock,
                                   int frames) {
  if (clock == FilmClock{} && std::ssize(film) == frames && facts.pictures.empty()) return film;
  std::vector<Picture> in_time;
  for (int k = 0; k < frames; ++k) {
    const double at = std::clamp<double>(clock.FrameAt(k), 0, facts.EvenFrames() - 1);
    in_time.push_back(film[static_cast<std::size_t>(facts.PictureAt(static_cast<int>(std::lround(at))))]);
  }
  return in_time;
}

}  // namespace

Result<ReducedTake> ReadTake(const CaptureFilmsOptions& options, const std::vector<FilmedView>& views,
                             const std::vector<FilmClock>& clocks, MessageLog& told) {
  // Refuse films with more pictures than fit into memory.
  std::size_t pictures = 0;
  for (const FilmedView& view : views) pictures += view.facts.frames;
  if (pictures > kMaxPictures) {
    return Fail(
        {views.front().path.string()},
        "{} films have {} frames in total; allowed: at most {} pictures in memory, which are {} frames of each film",
        views.size(), pictures, kMaxPictures, kMaxPictures / views.size());
  }
  ReducedTake take;
  // Read each film's masks, or its pictures and the picture of the empty room, at the times of the first film's frames.
  for (const FilmedView& view : views) {
    take.cameras.push_back(ReducedCamera(view.camera.camera, UnmarkedTake::kPictureSide));
    take.reductions.push_back(take.cameras.back().intrinsics.fx / view.camera.camera.intrinsics.fx);
    const FilmClock& clock = clocks[take.cameras.size() - 1];
    if (!options.masks.empty()) {
      ASSIGN_OR_RETURN(auto masks, ReadMasks(options.masks, options.mask_id, view, told));
      take.masks.push_back(NearestInTime(std::move(masks), view.facts, clock, views.front().facts.EvenFrames()));
      continue;
    }
    ASSIGN_OR_RETURN(auto film, ReadReduced(view.path, view.facts, view.camera.camera, view.fit,
                                            UnmarkedTake::kPictureSide, view.facts.frames));
    if (film.empty() || film.size() != static_cast<std::size_t>(view.facts.frames)) {
      return Fail({view.path.string()}, "found {} frames, but the film's header states {}", film.size(),
                  view.facts.frames);
    }
    take.pictures.push_back(NearestInTime(std::move(film), view.facts, clock, views.front().facts.EvenFrames()));
    if (options.rooms.empty()) continue;
    ASSIGN_OR_RETURN(ColourImage room, ReadRoom(options.rooms, view));
    take.rooms.push_back(std::move(room));
  }
  return take;
}

Result<UnmarkedMotion> RecoverByOutlines(const ReducedTake& take, const CaptureFilmsOptions& options, double rate_hz,
                                         const KeypointSupport& beside) {
  std::vector<std::vector<std::optional<SeenPerson>>> people;
  for (std::size_t c = 0; beside.person != nullptr && c < take.cameras.size(); ++c) {
    people.push_back(beside.person->seen[c]);
    for (auto& seen : people.back()) {
      for (Keypoint& keypoint : seen ? std::span<Keypoint>(seen->keypoints) : std::span<Keypoint>()) {
        keypoint.pixel *= take.reductions[c];
      }
    }
  }
  return RecoverUnmarked({.cameras = take.cameras,
                          .pictures = take.pictures,
                          .rooms = take.rooms,
                          .masks = take.masks,
                          .rate_hz = rate_hz,
                          .stature_m = options.stature_m > 0 ? std::optional(options.stature_m) : std::nullopt,
                          .lengths = beside.lengths,
                          .people = people});
}

ReducedTake PairOf(const ReducedTake& take, const CameraPair& pair) {
  ReducedTake two;
  for (const std::size_t i : {pair.first, pair.second}) {
    two.cameras.push_back(take.cameras[i]);
    two.reductions.push_back(take.reductions[i]);
    if (!take.pictures.empty()) two.pictures.push_back(take.pictures[i]);
    if (!take.masks.empty()) two.masks.push_back(take.masks[i]);
    if (!take.rooms.empty()) two.rooms.push_back(take.rooms[i]);
  }
  return two;
}

MarkerMotion JointsOfReference(const MarkerMotion& reference) {
  const bool has_landmarks =
      std::ranges::any_of(reference.names, [](const std::string& name) { return FindLandmark(name).has_value(); });
  if (!has_landmarks) return reference;
  MarkerMotion joints = JointMarkers(ToLandmarks(reference), reference.rate_hz);
  const auto knows = [&](Landmark landmark) {
    return std::ranges::find(reference.names, LandmarkName(landmark)) != reference.names.end();
  };
  const auto forget = [&](Role role) {
    for (auto& frame : joints.frames) frame[Index(role)].reset();
  };
  if (!knows(Landmark::kLeftHand)) forget(Role::kLeftHand);
  if (!knows(Landmark::kRightHand)) forget(Role::kRightHand);
  if (!knows(Landmark::kLeftBigToe)) forget(Role::kLeftFoot);
  if (!knows(Landmark::kRightBigToe)) forget(Role::kRightFoot);
  return joints;
}

namespace {

Result<std::vector<ComparedColumn>> CompareWithReference(const MarkerMotion& reference, const UnmarkedMotion& person,
                                                         const ReducedTake& take, const CaptureFilmsOptions& options,
                                                         MessageLog& told) {
  const MarkerMotion motion = JointMarkers(person.motion);
  const MarkerMotion joints = SynchroniseWith(motion, JointsOfReference(reference), told);
  std::vector<ComparedColumn> columns{CompareColumn("all", motion, joints)};
  const std::vector<CameraPair> pairs = PairsOf(take.cameras.size());
  const OnProgress tell = options.listener.progress("pairs of cameras");
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    tell(i, pairs.size());
    const auto pair = RecoverByOutlines(PairOf(take, pairs[i]), options, motion.rate_hz);
    columns.push_back(pair ? CompareColumn(pairs[i].heading, JointMarkers(pair->motion), joints)
                           : ComparedColumn{pairs[i].heading + kLost, {}, {}});
  }
  tell(pairs.size(), pairs.size());
  return columns;
}

std::vector<OverlayView> OverlaysOf(const std::vector<FilmedView>& views, const std::vector<FilmClock>& clocks,
                                    std::size_t frames) {
  std::vector<OverlayView> overlays;
  for (const FilmedView& view : views) {
    overlays.push_back({.name = view.camera.name,
                        .film = view.path,
                        .facts = view.facts,
                        .camera = view.camera.camera,
                        .fit = view.fit,
                        .keypoints = {},
                        .drift = clocks[overlays.size()].drift});
    overlays.back().keypoints.resize(frames);
  }
  return overlays;
}

constexpr double kPercent = 100;

/// Reports the findings and the doubts, one line each. Returns the reason why the motion is probably wrong: body and
/// outline overlap by less than half in most frames of a camera, or most frames repeat the last pose. Returns "" if the
/// motion seems right.
std::string TellUnmarked(const CaptureFilmsOptions& options, const std::vector<FilmedView>& views,
                         const UnmarkedMotion& person, MessageLog& told) {
  // Report the stature and the frames without a pose of their own.
  told.Tell(fmt::format("stature: {:.2f} m{}; {}", person.stature_m,
                        options.stature_m > 0 ? "" : ", estimated from the outlines", OutlinesText(views, person)));
  if (person.held > 0) {
    told.Tell(fmt::format(
        "doubtful: in {} frames, fewer than two cameras show the person, so these frames repeat the last pose",
        person.held));
  }
  constexpr double kMaxApart = 0.5, kDoubtfulShare = 0.1, kWrongShare = 0.5;
  std::string wrong;
  if (static_cast<double>(person.held) > kWrongShare * static_cast<double>(person.motion.poses.size())) {
    wrong = fmt::format("in {} of {} frames, fewer than two cameras show the person", person.held,
                        person.motion.poses.size());
  }
  // Report the cameras in which body and outline disagree.
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::vector<double> apart = KnownOf(person.apart[i]);
    const auto far = std::ranges::count_if(apart, [](double share) { return share > kMaxApart; });
    const double share = static_cast<double>(far) / static_cast<double>(std::max<std::size_t>(1, apart.size()));
    if (share <= kDoubtfulShare) continue;
    told.Tell(fmt::format("doubtful: {}: in {:.0f} % of the frames, body and outline overlap by less than half",
                          views[i].camera.name, kPercent * share));
    if (share <= kWrongShare || !wrong.empty()) continue;
    wrong = fmt::format("in {:.0f} % of the frames of {}, body and outline overlap by less than half", kPercent * share,
                        views[i].camera.name);
  }
  if (wrong.empty() || !options.rooms.empty() || !options.masks.empty()) return wrong;
  return wrong +
         ". A person who stays in one place cannot be distinguished from the room, so use pictures of the empty rooms "
         "(--rooms)";
}

Result<bool> WriteUnmarkedReport(const CaptureFilmsOptions& options, const std::vector<FilmedView>& views,
                                 const UnmarkedMotion& person, const std::vector<FilmClock>& clocks,
                                 const std::vector<std::string>& told) {
  CapturePage page = BeginPage(options, person.motion, MeasureLimbLengths(person.motion.poses), told);
  page.residuals.push_back(ResidualsOfOutlines(views, person));
  page.verdict = fmt::format("{} cameras, {} frames at {:g} Hz: {}; {}.", views.size(), person.motion.poses.size(),
                             person.motion.rate_hz, OutlinesText(views, person), DoubtsOf(told));
  page.limbs = "The limb lengths are those of a standard adult, scaled to the person's height.";
  page.still.caption = "The skeleton projected into each camera (lines; left blue, right orange).";
  return WritePage(options, std::move(page), OverlaysOf(views, clocks, person.motion.poses.size()), person.motion);
}

}  // namespace

Result<bool> CaptureUnmarked(const CaptureFilmsOptions& options, const FilmedSession& session,
                             const std::optional<MarkerMotion>& reference, Json& facts) {
  if (!options.points.empty())
    return Fail({}, "--points: not allowed with --silhouettes alone, because there are no keypoints to write");
  const std::vector<FilmedView>& views = session.views;
  // Recover the motion from the silhouettes.
  MessageLog told{options.listener.print};
  for (const std::string& line : session.told) told.Tell(line);
  const std::vector<FilmClock> clocks = ClocksByRates(views, told);
  ASSIGN_OR_RETURN(const ReducedTake take, ReadTake(options, views, clocks, told));
  ASSIGN_OR_RETURN(const UnmarkedMotion person, RecoverByOutlines(take, options, views.front().facts.rate_hz));
  const std::string doubt = TellUnmarked(options, views, person, told);
  facts["silhouettes"] = {{"stature_m", person.stature_m}, {"cost", person.cost}, {"held_frames", person.held}};
  if (!doubt.empty()) {
    facts["doubt"] = doubt;
    if (!options.accepts_doubtful) return true;
  }
  // Write the motion, the comparison, the film and the page.
  RETURN_IF_ERROR(WriteMotion(options, person.clip, person.motion));
  if (reference) {
    ASSIGN_OR_RETURN(const auto columns, CompareWithReference(*reference, person, take, options, told));
    RETURN_IF_ERROR(TellColumns(
        fmt::format(
            "Median distance between the joints and {}, mm. This distance is the error only if the reference is right.",
            options.reference),
        columns, views, options));
  }
  if (!options.report.empty()) return WriteUnmarkedReport(options, views, person, clocks, told.lines);
  if (options.film.empty()) return true;
  return WriteFilm(options, OverlaysOf(views, clocks, person.motion.poses.size()), person.motion);
}

}  // namespace etude
