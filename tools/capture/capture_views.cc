#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "engine/base/text.h"
#include "engine/cameras/rig_doubts.h"
#include "engine/formats/bvh.h"
#include "engine/formats/c3d.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/trc.h"
#include "engine/retargeting/joint_arrays.h"
#include "engine/retargeting/opensim_motion.h"
#include "engine/retargeting/proportions.h"
#include "io/files/files.h"
#include "io/real_takes/real_take.h"
#include "sim/choreography/canonical_body.h"
#include "tools/capture/capture_parts.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// Reduces a name to the letters and digits in it in lower case, so that cam_01 and Cam01 are equal.
std::string Bare(std::string_view name) {
  std::string bare;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c))) bare += ToLower(c);
  }
  return bare;
}

std::string NamesOf(const std::vector<NamedCamera>& rig) {
  std::string names;
  for (const NamedCamera& camera : rig) names += (names.empty() ? "" : ", ") + camera.name;
  return names;
}

Result<NamedCamera> CameraOfFilm(const CaptureFilmsOptions& options, const std::vector<NamedCamera>& rig,
                                 std::size_t film) {
  const std::string stem = fs::path(options.films[film]).stem().string();
  const std::string wanted = options.cameras.empty() ? stem : options.cameras[film];
  for (const NamedCamera& camera : rig) {
    if (Bare(camera.name) == Bare(wanted)) return camera;
  }
  if (!options.cameras.empty()) return Fail({options.rig}, "has no camera {}; allowed: {}", wanted, NamesOf(rig));
  return Fail({options.films[film]},
              "the rig has no camera with the film's name; the rig has {}. Use --cameras to assign cameras to films",
              NamesOf(rig));
}

/// The files of a rig: one file, or two files that belong together, in one folder.
struct RigPaths {
  fs::path first, second;
};

Result<RigPaths> RigPathsOf(const fs::path& path) {
  constexpr std::pair<const char*, const char*> kPairs[] = {
      {"intri.yml", "extri.yml"}, {"intrinsics.yml", "extrinsics.yml"}, {"cameras.txt", "images.txt"}};
  const bool is_folder = fs::is_directory(path);
  const fs::path folder = is_folder ? path : path.parent_path();
  for (const auto& [inside, outside] : kPairs) {
    const bool is_named = path.filename() == inside || path.filename() == outside;
    if (!is_named && !(is_folder && fs::exists(folder / inside))) continue;
    if (!fs::exists(folder / inside) || !fs::exists(folder / outside)) {
      return Fail({path.string()}, "this rig needs the two files {} and {} in one folder", inside, outside);
    }
    return RigPaths{folder / inside, folder / outside};
  }
  if (is_folder) {
    return Fail({path.string()},
                "the folder contains no rig; allowed: a rig file, or a folder that contains intri.yml and extri.yml, "
                "intrinsics.yml and extrinsics.yml, or cameras.txt and images.txt");
  }
  return RigPaths{path, {}};
}

/// Estimates the picture size of a camera for which the rig file gives none. Candidates are the film's size, the film's
/// size turned by 90°, and scaled versions of both. The best candidate is the one whose middle is nearest to the
/// principal point. If a scaled size is the best, the intrinsics are converted to the film's scale.
void FindSize(FilmedView& view, std::vector<std::string>& told) {
  Intrinsics& in = view.camera.camera.intrinsics;
  const glm::dvec2 film(view.facts.width, view.facts.height), middle(in.cx, in.cy);
  // Returns how far the principal point is from the middle of a picture of this size, as the logarithm of a ratio.
  const auto off = [&](const glm::dvec2& size) {
    return std::max(std::abs(std::log(2 * middle.x / size.x)), std::abs(std::log(2 * middle.y / size.y)));
  };
  glm::dvec2 best = film;
  double scale = 1;
  constexpr double kLikely = 0.25, kSure = 0.15;
  if (middle.x > 0 && middle.y > 0 && off(film) > kLikely) {
    for (const double gain : {1.0, 0.25, 1.0 / 3, 0.375, 0.5, 2.0 / 3, 0.75, 4.0 / 3, 1.5, 2.0, 8.0 / 3, 3.0, 4.0}) {
      for (const glm::dvec2& size : {gain * film, gain * glm::dvec2(film.y, film.x)}) {
        if (off(size) > kSure || off(size) >= off(best)) continue;
        best = size;
        scale = gain;
      }
    }
  }
  // Report a size that differs from the film's size.
  if (best != film) {
    told.push_back(
        fmt::format("{}: the rig states no picture size. The principal point ({:.0f}, {:.0f}) suggests {:.0f} x {:.0f} "
                    "pixels, so Etude assumes this size, although the film has {:.0f} x {:.0f}",
                    view.camera.name, in.cx, in.cy, best.x, best.y, film.x, film.y));
  }
  for (double* length : {&in.fx, &in.fy, &in.cx, &in.cy, &in.skew}) *length /= scale;
  in.width = static_cast<int>(std::lround(best.x / scale));
  in.height = static_cast<int>(std::lround(best.y / scale));
}

/// Checks that the films cover the same time, to 1.5 frames. Films whose rates differ by less than `kSameRateTolerance`
/// may instead have equally many frames.
Result<void> CheckTogether(const std::vector<FilmedView>& views, bool may_differ_in_time,
                           std::vector<std::string>& told) {
  const FilmFacts& first = views.front().facts;
  for (const FilmedView& view : views) {
    const FilmFacts& film = view.facts;
    if (!(film.rate_hz > 0)) {
      return Fail({view.path.string()}, "the film file does not state a frame rate");
    }
    if (may_differ_in_time) continue;
    const bool is_one_rate = std::abs(film.rate_hz - first.rate_hz) <= kSameRateTolerance * first.rate_hz;
    if (is_one_rate && film.EvenFrames() == first.EvenFrames()) continue;
    const double seconds = film.EvenFrames() / film.rate_hz, wanted = first.EvenFrames() / first.rate_hz;
    constexpr double kFrames = 1.5;
    if (std::abs(seconds - wanted) > kFrames / std::min(film.rate_hz, first.rate_hz)) {
      return Fail(
          {view.path.string()},
          "the film has {} frames ({:.4g} s at {:g} Hz), but {} has {} frames ({:.4g} s at {:g} Hz). Cut both films so "
          "that they begin and end at the same moments, or use --sync to find the delay from keypoints",
          film.EvenFrames(), seconds, film.rate_hz, views.front().path.string(), first.EvenFrames(), wanted,
          first.rate_hz);
    }
    if (!is_one_rate) continue;
    told.push_back(
        fmt::format("{}: the film has {} frames, but {} has {}; Etude assumes that both begin at the same moment",
                    view.camera.name, film.EvenFrames(), views.front().camera.name, first.EvenFrames()));
  }
  return {};
}

std::string BytesOf(Clip clip, const BodyMotion& motion, MotionFormat format, const std::string& name) {
  clip.name = name;
  switch (format) {
    case MotionFormat::kBvh:
      return WriteBvh(std::move(clip));
    case MotionFormat::kGlb:
      return WriteGlb(Character{.name = name, .skeleton = clip.skeleton, .materials = {}, .meshes = {}}, {&clip, 1});
    case MotionFormat::kTrc:
      return WriteTrc(motion, name);
    case MotionFormat::kCsv:
      return WriteJointCsv(motion);
    case MotionFormat::kC3d:
      return WriteC3d(motion);
    case MotionFormat::kNpz:
      return WriteBodyNpz(motion, StandingPose());
    case MotionFormat::kBids:
      break;  // the path is a folder; no output file has this format
    case MotionFormat::kMot:
      return WriteOpenSimMotion(motion, Retarget({.poses = {StandingPose()}}, motion.poses.front()).poses.front(),
                                name);
  }
  return {};
}

}  // namespace

Result<RigFile> OpenRig(const std::string& path) {
  ASSIGN_OR_RETURN(const RigPaths paths, RigPathsOf(path));
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(paths.first.string()));
  if (paths.second.empty()) return ReadRigFile(text, path);
  ASSIGN_OR_RETURN(const auto other, ReadWholeFile(paths.second.string()));
  return ReadRigPair(text, other, paths.first.string(), paths.second.string());
}

Result<FilmedSession> OpenFilms(const CaptureFilmsOptions& options) {
  ASSIGN_OR_RETURN(RigFile rig_file, OpenRig(options.rig));
  const std::vector<NamedCamera>& rig = rig_file.cameras;
  // Check the numbers of films and cameras.
  constexpr std::size_t kMaxFilms = 64;
  if (options.films.size() < 2 || options.films.size() > kMaxFilms) {
    return Fail({}, "found {} film{}; allowed: 2 to {} films, one for each camera", options.films.size(),
                options.films.size() == 1 ? "" : "s", kMaxFilms);
  }
  if (!options.cameras.empty() && options.cameras.size() != options.films.size()) {
    return Fail({}, "--cameras: found {} cameras, but there are {} films; allowed: one camera for each film",
                options.cameras.size(), options.films.size());
  }
  std::vector<FilmedView> views;
  std::vector<std::string> told;
  // Assign a camera to each film, and a fit that maps the camera's pictures to the film's pictures.
  for (std::size_t i = 0; i < options.films.size(); ++i) {
    FilmedView view{.path = options.films[i], .facts = {}, .camera = {}, .fit = {}};
    ASSIGN_OR_RETURN(view.camera, CameraOfFilm(options, rig, i));
    ASSIGN_OR_RETURN(view.facts, ProbeFilm(view.path));
    for (const FilmedView& other : views) {
      if (other.camera.name == view.camera.name) {
        return Fail({view.path.string()}, "camera {} already has the film {}; allowed: one film for each camera",
                    view.camera.name, other.path.string());
      }
    }
    // Fit the camera's pictures to the film's pictures.
    Intrinsics& in = view.camera.camera.intrinsics;
    if (in.width == 0) FindSize(view, told);
    const bool is_turned = options.fit == "none" && in.width != in.height && in.width == view.facts.height &&
                           in.height == view.facts.width;
    if (is_turned) {  // the keypoints will show in which direction the film is turned, if it does not state it
      const int turns = view.facts.turned % 2 != 0 ? view.facts.turned : 1;
      view.fit = {.quarter_turns = turns, .size = {in.width, in.height}};
      views.push_back(std::move(view));
      continue;
    }
    const auto fit =
        FitPictures(*FindFitMode(options.fit), {in.width, in.height}, {view.facts.width, view.facts.height});
    if (!fit) return Fail({view.path.string()}, "{}", fit.error().message);
    view.fit = *fit;
    views.push_back(std::move(view));
  }
  for (const FilmedView& view : views) {
    if (view.facts.remark.empty()) continue;
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < view.facts.pictures.size(); ++i) {
      if (view.facts.pictures[i] < 0) missing.push_back(i);
    }
    told.push_back(fmt::format("{}: {}{}", view.camera.name, view.facts.remark,
                               missing.empty() ? "" : fmt::format("; missing frames: {}", FramesText(missing))));
  }
  RETURN_IF_ERROR(CheckTogether(views, options.sync_s > 0, told));
  return FilmedSession{std::move(views), std::move(rig_file), std::move(told)};
}

std::vector<std::string> DoubtsOnCameras(const std::vector<FilmedView>& views) {
  std::vector<NamedCamera> cameras;
  for (const FilmedView& view : views) cameras.push_back(view.camera);
  std::vector<std::string> doubts = RigDoubts(cameras);
  for (std::string& doubt : doubts) doubt.insert(0, "doubtful: ");
  return doubts;
}

Result<void> WriteMotion(const CaptureFilmsOptions& options, Clip clip, const BodyMotion& motion) {
  const std::string& path = options.output;
  ASSIGN_OR_RETURN(const MotionFormat format, FormatOfName(path));
  RETURN_IF_ERROR(WriteFileAtomically(path, BytesOf(std::move(clip), motion, format, fs::path(path).stem().string())));
  TellWritten(options.listener, path);
  return {};
}

ComparedColumn CompareColumn(std::string heading, const MarkerMotion& markers, const MarkerMotion& reference) {
  return {std::move(heading), CompareMarkers(markers, reference), CompareAllMarkers(markers, reference)};
}

MarkerMotion SynchroniseWith(const MarkerMotion& motion, MarkerMotion reference, MessageLog& told) {
  const std::size_t frames = motion.frames.size();
  if (reference.frames.size() != frames) {
    told.Tell(fmt::format("the reference has {} frames, but the films have {}; only the first {} frames are compared",
                          reference.frames.size(), frames, std::min(reference.frames.size(), frames)));
  }
  const double own_rate = reference.rate_hz;
  constexpr double kWritten = 1e-5;  // relative tolerance: a file rounds 30000/1001 to 29.97
  // If the rates differ, measure the drift of the reference's clock, and undo the drift if this halves the share of
  // large distances.
  if (std::abs(own_rate - motion.rate_hz) > kWritten * own_rate) {
    const auto clock = MeasureClock(motion, reference);
    const bool is_mended = clock && clock->after < 0.5 * clock->before;
    std::string said = "; no common marker determines the clock drift between them";
    if (clock) {
      said = fmt::format(
          "; the measured clock drift is {:+.2f} frames over the films, and the shift in the middle of the films is "
          "{:+.2f} frames{}",
          clock->DriftOver(frames), clock->at + 0.5 * clock->DriftOver(frames),
          is_mended ? "; corrected" : "; too little to correct");
    }
    told.Tell(
        fmt::format("the reference has {:g} frames per second, but the films have {:g}; Etude assumes that both have "
                    "the same rate{}",
                    own_rate, motion.rate_hz, said));
    if (is_mended) reference = AtClock(reference, *clock, frames, motion.rate_hz);
  }
  return reference;
}

namespace {

std::string ColumnsText(const std::string& words, const std::vector<ComparedColumn>& columns,
                        const std::vector<FilmedView>& views) {
  std::string text = fmt::format("\n{} Cameras:", words);
  for (std::size_t i = 0; i < views.size(); ++i) text += fmt::format(" {} {}", i + 1, views[i].camera.name);
  text += fmt::format("\n{:<16}", "");
  for (const ComparedColumn& column : columns) text += fmt::format("{:>8}", column.heading);
  text += "\n";
  for (const MarkerAgreement& marker : columns.front().markers) {
    text += fmt::format("{:<16}", marker.name);
    for (const ComparedColumn& column : columns) {
      const auto found = std::ranges::find(column.markers, marker.name, &MarkerAgreement::name);
      const bool is_there = found != column.markers.end() && found->frames > 0;
      text += fmt::format("{:>8}", is_there ? fmt::format("{:.1f}", found->median_mm) : "-");
    }
    text += "\n";
  }
  for (const auto& [label, member] :
       {std::pair("all, median", &MarkerAgreement::median_mm), {"all, p95", &MarkerAgreement::p95_mm}}) {
    text += fmt::format("{:<16}", label);
    for (const ComparedColumn& column : columns)
      text += fmt::format("{:>8}", column.all.frames > 0 ? fmt::format("{:.1f}", column.all.*member) : "-");
    text += "\n";
  }
  return text;
}

RealTake RealTakeOf(const std::vector<ComparedColumn>& columns, const std::vector<FilmedView>& views,
                    const CaptureFilmsOptions& options) {
  RealTake take{.name = fs::path(options.output).stem().string(),
                .recovery = options.silhouettes         ? "silhouettes"
                            : options.keypoints.empty() ? "marks"
                                                        : "keypoints",
                .reference = fs::path(options.reference).filename().string(),
                .frames = views.front().facts.EvenFrames(),
                .rate_hz = views.front().facts.rate_hz};
  for (const FilmedView& view : views) take.films.push_back(view.path.filename().string());
  for (const ComparedColumn& column : columns) {
    const std::string cameras = column.heading.substr(0, column.heading.find(kLost));
    RealDistance& distance = take.distances.emplace_back(RealDistance{.cameras = cameras});
    if (column.all.frames == 0) continue;
    distance.median_mm = column.all.median_mm;
    distance.p95_mm = column.all.p95_mm;
  }
  return take;
}

}  // namespace

Result<void> TellColumns(const std::string& words, const std::vector<ComparedColumn>& columns,
                         const std::vector<FilmedView>& views, const CaptureFilmsOptions& options) {
  options.listener.print(ColumnsText(words, columns, views));
  if (options.distances.empty()) return {};
  RETURN_IF_ERROR(WriteFileAtomically(options.distances, WriteRealTake(RealTakeOf(columns, views, options))));
  TellWritten(options.listener, options.distances);
  return {};
}

std::vector<CameraPair> PairsOf(std::size_t films) {
  std::vector<CameraPair> pairs;
  for (std::size_t i = 0; films > 2 && i < films; ++i) {
    for (std::size_t j = i + 1; j < films; ++j) pairs.push_back({i, j, fmt::format("{}+{}", i + 1, j + 1)});
  }
  return pairs;
}

}  // namespace etude
