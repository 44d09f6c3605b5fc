#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <span>

#include "engine/base/order_statistics.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "tools/capture/capture_parts.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// Returns the median distance, pixels, between the keypoints of one camera's frame and the projections of the points
/// triangulated from all cameras; nullopt if no keypoint has a triangulated point.
std::optional<double> ResidualOf(const ProjectionMatrix& camera, const SeenPerson& seen, const LandmarkPositions& places) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    if (!(seen.keypoints[i].confidence > 0) || !places[i]) continue;
    if (const auto pixel = Project(camera, *places[i]))
      distances.push_back(glm::distance(*pixel, seen.keypoints[i].pixel));
  }
  if (distances.empty()) return std::nullopt;
  return UpperMedian(distances);
}

std::vector<TakeCurve> FeetOf(const BodyMotion& motion) {
  constexpr double kCm = 100;
  std::vector<TakeCurve> feet;
  for (const auto& [name, ankle, toe] : {std::tuple("left foot", Role::kLeftAnkle, Role::kLeftFoot),
                                         {"right foot", Role::kRightAnkle, Role::kRightFoot}}) {
    TakeCurve& curve = feet.emplace_back(TakeCurve{name, {}});
    for (const BodyPose& pose : motion.poses) curve.values.push_back(kCm * std::min(pose[ankle].y, pose[toe].y));
  }
  return feet;
}

CameraResiduals ResidualsOf(const std::vector<FilmedView>& views, const RecoveredPerson& person, std::size_t chosen,
                            const SeenFilms& films) {
  CameraResiduals residuals{.caption =
                                "Residual of each camera in each frame: the median distance, in px, between the "
                                "camera's keypoints and the points that are triangulated from all cameras",
                            .unit = "px",
                            .cameras = {}};
  for (std::size_t i = 0; i < views.size(); ++i) {
    CapturedCamera& camera = residuals.cameras.emplace_back();
    camera.name = camera.residual.name = views[i].camera.name;
    camera.left_out = person.report.rejected[i];
    const auto& seen = person.people[chosen].seen[i];
    for (std::size_t frame = 0; frame < person.landmarks.size(); ++frame) {
      const bool is_seen = frame < seen.size() && seen[frame];
      camera.residual.values.push_back(is_seen ? ResidualOf(films.cameras[i], *seen[frame], person.landmarks[frame])
                                               : std::nullopt);
    }
  }
  return residuals;
}

CapturePage PageOf(const CaptureFilmsOptions& options, const std::vector<FilmedView>& views,
                   const RecoveredPerson& person, std::size_t chosen, const SeenFilms& films,
                   const UnmarkedMotion* both) {
  constexpr double kPercent = 100;
  // Write the verdict: points found, residuals, and doubts.
  CapturePage page = BeginPage(options, person.motion, person.body.lengths, films.told.lines);
  page.verdict = fmt::format(
      "{} cameras, {} frames at {:g} Hz: {:.1f} % of the points were triangulated, with a median residual of {:.1f} px",
      views.size(), person.motion.poses.size(), person.motion.rate_hz, kPercent * person.report.found,
      person.report.residual_px);
  page.residuals.push_back(ResidualsOf(views, person, chosen, films));
  if (both != nullptr) {
    page.residuals.push_back(ResidualsOfOutlines(views, *both));
    page.verdict += "; " + OutlinesText(views, *both);
  }
  page.verdict += fmt::format("; {}.", DoubtsOf(films.told.lines));
  // Write the limb lengths and the fit of the skeleton.
  page.limbs = options.poses == "bundle" && options.smooth_hz == 0
                   ? "The lengths of the limbs were fitted to all keypoints."
                   : "The lengths of the limbs are medians over the frames.";
  const MarkerMotion points = JointMarkers(person.landmarks, person.motion.rate_hz);
  for (const MarkerAgreement& row : CompareMarkers(JointMarkers(person.motion), points)) {
    if (row.frames > 0) page.fit.emplace_back(row.name, std::array{row.median_mm, row.p95_mm});
  }
  page.still.caption =
      "The skeleton projected into each camera (lines; left blue, right orange), and the keypoints that it was made "
      "from (green).";
  return page;
}

}  // namespace

std::vector<std::pair<std::string, double>> ShownLengths(const LimbLengths& lengths) {
  return {{"shank", lengths.shank},
          {"thigh", lengths.thigh},
          {"trunk", lengths.trunk},
          {"upper arm", lengths.upper_arm},
          {"forearm", lengths.forearm},
          {"hips", lengths.hip_width},
          {"shoulders", lengths.shoulder_width}};
}

CapturePage BeginPage(const CaptureFilmsOptions& options, const BodyMotion& motion, const LimbLengths& lengths,
                      const std::vector<std::string>& told) {
  constexpr double kCm = 100;
  CapturePage page;
  page.title = fs::path(options.output).stem().string();
  page.rate_hz = motion.rate_hz;
  page.film = options.film;
  page.told = told;
  page.feet_cm = FeetOf(motion);
  for (const auto& [name, metres] : ShownLengths(lengths)) page.lengths_cm.emplace_back(name, kCm * metres);
  page.version = options.version;
  page.command = options.command_line;
  return page;
}

CameraResiduals ResidualsOfOutlines(const std::vector<FilmedView>& views, const UnmarkedMotion& person) {
  constexpr double kPercent = 100;
  CameraResiduals residuals{.caption =
                                "Difference between the body and the outline in each frame of a camera: the area that "
                                "only one of them covers, in % of the area that at least one of them covers",
                            .unit = "%",
                            .cameras = {}};
  for (std::size_t i = 0; i < views.size(); ++i) {
    CapturedCamera& camera = residuals.cameras.emplace_back();
    camera.name = camera.residual.name = views[i].camera.name;
    for (const auto& apart : person.apart[i]) {
      camera.residual.values.push_back(apart ? std::optional(kPercent * *apart) : std::nullopt);
    }
  }
  return residuals;
}

double MedianOf(const CameraResiduals& residuals) {
  std::vector<double> all;
  for (const CapturedCamera& camera : residuals.cameras) {
    std::ranges::copy(KnownOf(camera.residual.values), std::back_inserter(all));
  }
  constexpr double kNothingAlike = 100;
  return all.empty() ? kNothingAlike : UpperMedian(std::move(all));
}

std::string OutlinesText(const std::vector<FilmedView>& views, const UnmarkedMotion& person) {
  return fmt::format("the median difference between body and outlines is {:.0f} %",
                     MedianOf(ResidualsOfOutlines(views, person)));
}

std::string DoubtsOf(const std::vector<std::string>& told) {
  const auto doubts = std::ranges::count_if(told, [](const std::string& s) { return s.starts_with("doubtful"); });
  return doubts == 0 ? "nothing is doubtful" : fmt::format("doubtful findings, listed below: {}", doubts);
}

Result<bool> WriteFilm(const CaptureFilmsOptions& options, const std::vector<OverlayView>& overlays,
                       const BodyMotion& motion, Picture* middle) {
  auto is_whole = options.listener.film(
      [&](const FilmWatch& watch) { return WriteOverlayFilm(options.film, overlays, motion, watch, middle); });
  if (is_whole && *is_whole) TellWritten(options.listener, options.film);
  return is_whole;
}

std::vector<OverlayView> OverlaysOf(const std::vector<FilmedView>& views, const RecoveredPerson& person,
                                    std::size_t chosen, const std::vector<FilmClock>& clocks) {
  std::vector<OverlayView> overlays;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const FilmedView& view = views[i];
    overlays.push_back(
        {view.camera.name, view.path, view.facts, view.camera.camera, view.fit, clocks[i].offset, {}, clocks[i].drift});
    for (auto seen : person.people[chosen].seen[i]) {
      // Keypoints of matched persons have no lens distortion; add the distortion before the keypoints are drawn.
      for (Keypoint& keypoint : seen ? std::span<Keypoint>(seen->keypoints) : std::span<Keypoint>()) {
        const auto rig = DistortPixel(view.camera.camera, keypoint.pixel);
        keypoint = rig && keypoint.confidence > 0 ? Keypoint{view.fit.ToFilm(*rig), keypoint.confidence} : Keypoint{};
      }
      overlays.back().keypoints.push_back(seen);
    }
  }
  return overlays;
}

Result<bool> WritePage(const CaptureFilmsOptions& options, CapturePage page, const std::vector<OverlayView>& overlays,
                       const BodyMotion& motion) {
  ASSIGN_OR_RETURN(const TemporaryFolder folder, TemporaryFolder::Make("capture-report"));
  // The film of --film, or else a temporary one.
  const fs::path film = options.film.empty() ? folder.path() / "overlay.mp4" : fs::path(options.film);
  ASSIGN_OR_RETURN(const bool is_whole, options.film.empty() ? options.listener.film([&](const FilmWatch& watch) {
    return WriteOverlayFilm(film, overlays, motion, watch, &page.still);
  })
                                                             : WriteFilm(options, overlays, motion, &page.still));
  if (!is_whole) return false;
  constexpr std::uintmax_t kMaxFilmBytes = 16'000'000;
  std::error_code unreadable;
  if (fs::file_size(film, unreadable) <= kMaxFilmBytes && !unreadable) {
    ASSIGN_OR_RETURN(page.mp4, ReadWholeFile(film.string()));
  }
  RETURN_IF_ERROR(WriteFileAtomically(options.report, WriteCapturePage(page)));
  TellWritten(options.listener, options.report);
  return true;
}

Result<bool> WriteReport(const CaptureFilmsOptions& options, const std::vector<FilmedView>& views,
                         const RecoveredPerson& person, std::size_t chosen, const SeenFilms& films,
                         const UnmarkedMotion* both) {
  return WritePage(options, PageOf(options, views, person, chosen, films, both),
                   OverlaysOf(views, person, chosen, films.clocks), person.motion);
}

}  // namespace etude
