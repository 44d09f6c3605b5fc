#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/boards/board_views.h"
#include "engine/boards/film_delays.h"
#include "engine/cameras/rig_file.h"
#include "io/drawing/look.h"
#include "io/files/files.h"
#include "tools/calibrate/calibrate_rig.h"
#include "tools/calibrate/search_boards.h"

namespace etude {
namespace {

/// Returns the RMS residual of each view, pixels.
std::vector<double> ResidualsOf(const RefinedRig& rig, std::span<const TargetView> views) {
  std::vector<double> rms;
  for (const TargetView& view : views) {
    rms.push_back(ReprojectionRms(rig.cameras[view.camera], rig.targets[view.target], view.pairs));
  }
  return rms;
}

/// Calibrates the rig. If the board is OpenCV's, leaves out the pictures whose residual exceeds 0.3 pixels and three
/// times the median, because in such pictures the board is blurred or has moved, and calibrates again, at most three
/// times.
Result<RefinedRig> CalibrateWithoutOutliers(const BoardViews& search, const CalibrateOptions& options,
                                           std::vector<TargetView>& views) {
  std::erase_if(views, [](const TargetView& view) { return !HomographyOf(view.pairs); });
  NumberTargets(views);
  const std::size_t all = views.size();
  constexpr int kMaxRounds = 3;
  for (int round = 0;; ++round) {
    ASSIGN_OR_RETURN(RefinedRig rig, CalibrateFromPlanes(search.sizes(), views, RefineOptionsOf(options)));
    const std::vector<double> rms = ResidualsOf(rig, views);
    constexpr double kFar = 3, kMinLimitPx = 0.3;
    const double limit = std::max(kMinLimitPx, kFar * UpperMedian(rms));
    std::vector<TargetView> kept;
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (rms[i] <= limit) kept.push_back(views[i]);
    }
    if (search.Told().empty() || kept.size() == views.size() || round == kMaxRounds) {
      if (views.size() < all) {
        options.listener.print(
            fmt::format("{} of {} pictures of boards were left out, because the residual of each is larger than three "
                        "times the median\n",
                        all - views.size(), all));
      }
      return rig;
    }
    views = std::move(kept);
    NumberTargets(views);
  }
}

/// Returns the views of one camera, renumbered as views of camera 0 of a rig with one camera.
std::vector<TargetView> ViewsOf(std::size_t camera, std::span<const TargetView> views) {
  std::vector<TargetView> own;
  for (const TargetView& view : views) {
    if (view.camera == camera) own.push_back({0, own.size(), view.pairs});
  }
  return own;
}

/// Finds the films' delays, reports them, and returns the views, matched by these delays.
Result<std::vector<TargetView>> SynchroniseFilms(const CalibrateOptions& options, const BoardViews& search,
                                          const std::vector<CameraBoards>& seen) {
  const bool are_films = std::ranges::all_of(seen, [](const CameraBoards& s) { return s.period_s > 0; });
  // Only films have clocks, so folders of pictures are not synchronised.
  if (!are_films || seen.size() < 2) return search.views();
  std::vector<double> period_s;
  for (const CameraBoards& s : seen) period_s.push_back(s.period_s);
  // Find the delay of each film by minimising the reprojection error of all films together.
  constexpr double kLooks = 2;
  const double max_delay_s = options.sync_s > 0 ? options.sync_s : kLooks * period_s.front();
  ASSIGN_OR_RETURN(const FilmDelays steps, FindFilmDelays(search.sizes(), search.sightings(), period_s, max_delay_s,
                                                        RefineOptionsOf(options), options.listener.progress("times of films")));
  // Report each delay, and warn if it is at the limit of the search.
  for (std::size_t i = 1; i < seen.size(); ++i) {
    const double delay_s = steps.delay_s[i];
    if (delay_s == 0) continue;
    constexpr double kMs = 1000;
    options.listener.print(fmt::format(
        "{}: this film is {:.0f} ms ({:.2f} frames) {} than {}; corrected by interpolating corners between frames\n",
        seen[i].name, kMs * std::abs(delay_s), std::abs(delay_s) / seen[i].period_s * seen[i].every,
        delay_s > 0 ? "later" : "earlier", seen.front().name));
    if (std::abs(delay_s) > max_delay_s - 0.5 * period_s.front()) {
      options.listener.print(fmt::format(
          "doubtful: this delay is at the end of the searched range; use --sync {:.1f} to search a larger range\n",
          2 * max_delay_s + 0.1));
    }
  }
  if (steps.after_px < steps.before_px) {
    options.listener.print(fmt::format("residual of all films: {:.3f} px without delays, {:.3f} px with these delays\n",
                                       steps.before_px, steps.after_px));
  }
  return SynchronisedViews(search.sightings(), period_s, steps.delay_s);
}

/// Prints two residuals of each camera: calibrated together with the other cameras, and calibrated alone. Warns if the
/// two residuals differ much.
void TellResiduals(const RefinedRig& rig, const CalibrateOptions& options, std::span<const PictureSize> sizes,
                   std::span<const TargetView> views, const std::vector<CameraBoards>& seen) {
  const std::vector<double> rms = ResidualsOf(rig, views);
  options.listener.print(fmt::format("\nresiduals, px RMS{:>14}{:>10}{:>12}{:>10}\n", "together", "alone", "a board's", "worst"));
  bool do_disagree = false;
  for (std::size_t camera = 0; camera < seen.size(); ++camera) {
    std::vector<double> own;
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (views[i].camera == camera) own.push_back(rms[i]);
    }
    const std::array size = {sizes[camera]};
    const auto alone = CalibrateFromPlanes(size, ViewsOf(camera, views), RefineOptionsOf(options));
    const double together = rig.camera_rms_px[camera];
    options.listener.print(fmt::format("{:<17}{:>14.3f}{:>10}{:>12.3f}{:>10.3f}\n", seen[camera].name, together,
               alone ? fmt::format("{:.3f}", alone->rms_px) : "-", UpperMedian(own), std::ranges::max(own)));
    constexpr double kTimes = 3, kMinLimitPx = 0.5;
    do_disagree = do_disagree || (alone && together > kMinLimitPx && together > kTimes * alone->rms_px);
  }
  if (!do_disagree) return;
  options.listener.print(
      fmt::format("doubtful: each camera calibrated alone has a far smaller residual than all cameras together. The "
                  "films may not be\n"
                  "synchronised{}, a camera may have moved, or the board may be bent.\n",
                  seen.front().every > 1 ? " (use --every 1 to find delays)" : ""));
}

/// Returns the digits at the end of a name: "0" for cam_0; "" if there are none.
std::string NumberAtEnd(const std::string& name) {
  std::size_t from = name.size();
  while (from > 0 && std::isdigit(static_cast<unsigned char>(name[from - 1]))) --from;
  return name.substr(from);
}

// With this value, --beside names no file, but asks for a comparison with OpenCV's calibrateCamera.
constexpr const char* kOpenCv = "opencv";

/// Compares with OpenCV's calibration from the same corners. OpenCV calibrates one camera at a time, so each camera is
/// calibrated and compared alone.
Result<void> CompareWithOpenCv(const CalibrateOptions& options, std::span<const PictureSize> sizes,
                               std::span<const TargetView> views, const std::vector<CameraBoards>& seen) {
  options.listener.print(
      fmt::format("\nComparison with OpenCV's calibrateCamera on the same corners, for each camera alone:\n"));
  constexpr double kPercent = 100;
  for (std::size_t camera = 0; camera < seen.size(); ++camera) {
    const std::vector<TargetView> own = ViewsOf(camera, views);
    const auto alone = CalibrateFromPlanes(sizes.subspan(camera, 1), own, RefineOptionsOf(options));
    if (!alone) {
      options.listener.print(
          fmt::format("  {:<14} cannot be calibrated alone: {}\n", seen[camera].name, alone.error().message));
      continue;
    }
    ASSIGN_OR_RETURN(const OpenCvCalibration theirs, CalibrateByOpenCv(own, sizes[camera], RefineOptionsOf(options).lens));
    const Intrinsics &a = alone->cameras.front().intrinsics, &b = theirs.intrinsics;
    options.listener.print(fmt::format(
        "  {:<14} focal lengths {:.2f}, {:.2f} px, OpenCV's {:.2f}, {:.2f} ({:+.3f}, {:+.3f} %); residual {:.4f} "
        "px, OpenCV's {:.4f}\n",
        seen[camera].name, a.fx, a.fy, b.fx, b.fy, kPercent * (a.fx / b.fx - 1), kPercent * (a.fy / b.fy - 1),
        alone->rms_px, theirs.rms_px));
  }
  return {};
}

/// Compares with another calibration of these cameras, at the same board corners.
Result<void> CompareBeside(const CalibrateOptions& options, const RefinedRig& rig, std::span<const TargetView> views,
                           const std::vector<CameraBoards>& seen) {
  const std::string& file = options.beside;
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(file));
  ASSIGN_OR_RETURN(const std::vector<NamedCamera> theirs, ReadRig(text, file));
  // Match cameras by name, else by the number at the end of the name.
  std::vector<Camera> cameras;
  for (const CameraBoards& own : seen) {
    auto same = std::ranges::find(theirs, own.name, &NamedCamera::name);
    if (same == theirs.end() && !NumberAtEnd(own.name).empty()) {
      same = std::ranges::find(theirs, NumberAtEnd(own.name), [](const NamedCamera& c) { return NumberAtEnd(c.name); });
    }
    if (same == theirs.end()) return Fail({file}, "has no camera with the name or number of {}", own.name);
    cameras.push_back(same->camera);
  }
  // Find the boards' poses with the other calibration, then compare intrinsics, residuals and distances of cameras.
  const auto placed = LocateBoards(cameras, views);
  if (!placed) return Fail({file}, "{}", placed.error().message);
  options.listener.print(fmt::format("\nComparison with {} on the same corners:\n", file));
  constexpr double kPercent = 100;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Intrinsics &a = rig.cameras[i].intrinsics, &b = cameras[i].intrinsics;
    options.listener.print(
        fmt::format("  {:<14} focal lengths {:.1f}, {:.1f} px, in the other rig {:.1f}, {:.1f} ({:+.1f}, {:+.1f} %); "
                    "residual {:.3f} px, in the other rig {:.3f}\n",
                    seen[i].name, a.fx, a.fy, b.fx, b.fy, kPercent * (a.fx / b.fx - 1), kPercent * (a.fy / b.fy - 1),
                    rig.camera_rms_px[i], placed->camera_rms_px[i]));
    if (i == 0) continue;
    options.listener.print(fmt::format("  {:<14} {:.3f} m from {}, in the other rig {:.3f}\n", "",
                                       glm::distance(rig.cameras[i].p_WC, rig.cameras[0].p_WC), seen.front().name,
                                       glm::distance(cameras[i].p_WC, cameras[0].p_WC)));
  }
  return {};
}

/// Draws each camera's picture with the most corners, and over it the corners from all pictures of this camera,
/// coloured by error: yellow below 0.5 px, orange below 1 px, else red.
std::string PictureOfBoards(const RefinedRig& rig, std::span<const TargetView> views, std::vector<CameraBoards> seen) {
  // Lay out one panel for each camera, one below the other.
  constexpr int kWidth = 640, kGap = 8;
  double height = kGap;
  for (const CameraBoards& s : seen) height += kWidth * static_cast<double>(s.best.height) / s.best.width + kGap;
  Canvas canvas(kWidth + 2 * kGap, static_cast<int>(std::ceil(height)));
  canvas.FillBox({0, 0, static_cast<double>(canvas.width()), height}, kBackdrop);
  double top = kGap;
  for (std::size_t camera = 0; camera < seen.size(); ++camera) {
    const CameraBoards& s = seen[camera];
    const double scale = static_cast<double>(kWidth) / s.best.width;
    const Box panel{kGap, top, kWidth, scale * s.best.height};
    canvas.DrawImage(s.best, panel);
    canvas.FillBox(panel, {0, 0, 0, 0.35});
    // Draw each corner, and the corner's error as a line, enlarged 20 times.
    for (const TargetView& view : views) {
      for (const PointPair& pair : view.pairs) {
        const CalibrationTargetPose& place = rig.targets[view.target];
        const auto shown = Project(rig.cameras[view.camera], place.R_WT * pair.world + place.p_WT);
        if (view.camera != camera || !shown) continue;
        constexpr double kLonger = 20, kHalfPx = 0.5;
        const glm::dvec2 at = glm::dvec2(panel.x, panel.y) + scale * pair.pixel;
        const double off = glm::distance(*shown, pair.pixel);
        const Paint paint = off < kHalfPx ? Paint{1, 0.9, 0.2, 1}
                            : off < 1     ? Paint{1, 0.55, 0.1, 1}
                                          : Paint{1, 0.2, 0.2, 1};
        canvas.DrawLine(at, at + kLonger * scale * (*shown - pair.pixel), 1, paint);
        canvas.DrawDot(at, 1.6, paint);
      }
    }
    DrawTag(canvas, panel,
            fmt::format("{}: board in {} of {} pictures, {:.2f} px RMS; errors drawn 20 times larger", s.name,
                        s.with_board, s.looked, rig.camera_rms_px[camera]));
    top += panel.height + kGap;
  }
  return canvas.Png();
}

}  // namespace

Result<Calibrated> CalibrateFromPictures(const CalibrateOptions& options) {
  ASSIGN_OR_RETURN(BoardViews search, SearchFor(options));
  std::vector<CameraBoards> seen;
  for (std::size_t camera = 0; camera < options.inputs.size(); ++camera) {
    ASSIGN_OR_RETURN(seen.emplace_back(), SearchInput(camera, options, search));
    const CameraBoards& own = seen.back();
    options.listener.print(fmt::format("{}: {} pictures; {} pictures show a board, with {} corners\n",
                                       options.inputs[camera], own.looked, own.with_board, own.corners));
  }
  if (!search.Told().empty()) options.listener.print(fmt::format("the board is {}\n", search.Told()));
  for (std::size_t camera = 0; camera < seen.size(); ++camera) {
    if (seen[camera].corners > 0) continue;
    return Fail({options.inputs[camera]},
                "found no board {} in {} pictures; describe your board with --board: 5x7x0.034 (a board printed by "
                "Etude), charuco:5x7x0.04 (ChArUco), chess:9x6x0.025 (chessboard)",
                Join(options.boards), seen[camera].looked);
  }
  // Synchronise the films, calibrate, and report the residuals.
  ASSIGN_OR_RETURN(std::vector<TargetView> views, SynchroniseFilms(options, search, seen));
  ASSIGN_OR_RETURN(RefinedRig refined, CalibrateWithoutOutliers(search, options, views));
  TellResiduals(refined, options, search.sizes(), views, seen);
  if (options.beside == kOpenCv) {
    RETURN_IF_ERROR(CompareWithOpenCv(options, search.sizes(), views, seen));
  } else if (!options.beside.empty()) {
    RETURN_IF_ERROR(CompareBeside(options, refined, views, seen));
  }
  if (!options.picture.empty()) {
    RETURN_IF_ERROR(WriteFileAtomically(options.picture, PictureOfBoards(refined, views, seen)));
    TellWritten(options.listener, options.picture);
  }
  // Set the world frame to the first board, and name the cameras after the inputs.
  AlignToBoard(options.world == "floor" ? BoardPlacement::kOnFloor : BoardPlacement::kOnWall, refined.cameras);
  Calibrated rig;
  rig.rms_px = refined.camera_rms_px;
  rig.points.resize(refined.cameras.size());
  for (const TargetView& view : views) rig.points[view.camera] += view.pairs.size();
  for (std::size_t i = 0; i < refined.cameras.size(); ++i) {
    rig.cameras.push_back({seen[i].name, refined.cameras[i]});
    rig.deviations.push_back(refined.deviations[i]);
  }
  return rig;
}

}  // namespace etude
