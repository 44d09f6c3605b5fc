#include "cli/capture_command.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>

#include "bench/clips/convert.h"
#include "bench/files/files.h"
#include "bench/keypoints/read_people.h"
#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "engine/cameras/rig_file.h"
#include "engine/formats/bvh.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/trc.h"
#include "engine/keypoints/agreement.h"
#include "engine/keypoints/pixel_fit.h"
#include "engine/keypoints/recover_person.h"
#include "reports/captures/overlay_film.h"
#include "reports/films/decoder.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// One camera's part of the session.
struct FilmedView {
  fs::path path;
  FilmFacts facts;
  NamedCamera camera;
  PixelFit fit;
  SeenPeople people;  ///< in the rig's pixels
};

/// Letters and digits alone, small: cam_01 and Cam01 are one name.
std::string Bare(std::string_view name) {
  std::string bare;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      bare += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return bare;
}

std::string NamesOf(const std::vector<NamedCamera>& rig) {
  std::string names;
  for (const NamedCamera& camera : rig) names += (names.empty() ? "" : ", ") + camera.name;
  return names;
}

Result<NamedCamera> CameraOfFilm(const CaptureCommandOptions& options, const std::vector<NamedCamera>& rig,
                                 std::size_t film) {
  const std::string stem = fs::path(options.films[film]).stem().string();
  const std::string wanted = options.cameras.empty() ? stem : options.cameras[film];
  for (const NamedCamera& camera : rig) {
    if (Bare(camera.name) == Bare(wanted)) return camera;
  }
  if (!options.cameras.empty()) return Fail({options.rig}, "no camera {}; there are {}", wanted, NamesOf(rig));
  return Fail({options.films[film]}, "the rig has no camera of that name, but {}; tell which by --cameras",
              NamesOf(rig));
}

Result<std::vector<FilmedView>> OpenFilms(const CaptureCommandOptions& options) {
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(options.rig));
  ASSIGN_OR_RETURN(const auto rig, ReadRig(text, options.rig));
  constexpr std::size_t kMostFilms = 64;
  if (options.films.size() < 2 || options.films.size() > kMostFilms) {
    return Fail({}, "{} film; allowed: 2 to {}, one of each camera", options.films.size(), kMostFilms);
  }
  if (!options.cameras.empty() && options.cameras.size() != options.films.size()) {
    return Fail({}, "--cameras names {} cameras for {} films", options.cameras.size(), options.films.size());
  }
  std::vector<FilmedView> views;
  for (std::size_t i = 0; i < options.films.size(); ++i) {
    FilmedView view{.path = options.films[i], .facts = {}, .camera = {}, .fit = {}, .people = {}};
    ASSIGN_OR_RETURN(view.camera, CameraOfFilm(options, rig, i));
    ASSIGN_OR_RETURN(view.facts, ProbeFilm(view.path));
    for (const FilmedView& other : views) {
      if (other.camera.name == view.camera.name) {
        return Fail({view.path.string()}, "camera {} has {} already", view.camera.name, other.path.string());
      }
    }
    const Intrinsics& in = view.camera.camera.intrinsics;
    const auto fit =
        FitPictures(*FindFitMode(options.fit), {in.width, in.height}, {view.facts.width, view.facts.height});
    if (!fit) return Fail({view.path.string()}, "{}", fit.error().message);
    view.fit = *fit;
    views.push_back(std::move(view));
  }
  return views;
}

Result<void> CheckTogether(const std::vector<FilmedView>& views) {
  const FilmedView& first = views.front();
  constexpr double kSameRate = 1e-3;
  for (const FilmedView& view : views) {
    if (!(std::abs(view.facts.rate_hz - first.facts.rate_hz) <= kSameRate * first.facts.rate_hz)) {
      return Fail({view.path.string()}, "{:g} frames a second, {} {:g}; films must run alike", view.facts.rate_hz,
                  first.path.string(), first.facts.rate_hz);
    }
    if (view.facts.frames != first.facts.frames) {
      return Fail({view.path.string()}, "{} frames, {} {}; cut them alike", view.facts.frames, first.path.string(),
                  first.facts.frames);
    }
  }
  if (!(first.facts.rate_hz > 0))
    return Fail({first.path.string()}, "it does not tell how many frames a second it has");
  return {};
}

/// People of a film, moved into the rig's pixels.
Result<void> ReadPeople(const CaptureCommandOptions& options, FilmedView& view) {
  const bool is_marks = !options.marks.empty();
  ASSIGN_OR_RETURN(const fs::path entry,
                   EntryOfFilm(is_marks ? options.marks : options.keypoints, view.path.stem().string()));
  ASSIGN_OR_RETURN(PeopleOfFilm film, is_marks ? ReadMarkedPictures(entry) : ReadKeypoints(entry, options.layout));
  if (film.frames.size() != static_cast<std::size_t>(view.facts.frames)) {
    return Fail({entry.string()}, "{} frames, the film {} {}", film.frames.size(), view.path.string(),
                view.facts.frames);
  }
  if (film.width != 0 && (film.width != view.facts.width || film.height != view.facts.height)) {
    return Fail({entry.string()}, "of pictures of {} x {} pixels, the film {} x {}", film.width, film.height,
                view.facts.width, view.facts.height);
  }
  for (auto& frame : film.frames) {
    for (SeenPerson& person : frame) {
      for (Keypoint& keypoint : person.keypoints) keypoint.pixel = view.fit.ToRig(keypoint.pixel);
    }
  }
  view.people = std::move(film.frames);
  return {};
}

RecoverPersonOptions RecoverOptionsOf(const CaptureCommandOptions& options, const std::vector<FilmedView>& views) {
  RecoverPersonOptions recover{.rate_hz = views.front().facts.rate_hz, .match = {}, .triangulate = {}};
  recover.person = static_cast<std::size_t>(options.person - 1);
  recover.cutoff_hz = options.smooth_hz;
  recover.longest_gap_s = options.longest_gap_s;
  recover.match.longest_absence = std::max(1, static_cast<int>(std::lround(0.5 * recover.rate_hz)));
  constexpr double kOutlierShare = 0.03;
  double longest_side = 0;
  for (const FilmedView& view : views) {
    const Intrinsics& in = view.camera.camera.intrinsics;
    longest_side = std::max<double>({longest_side, static_cast<double>(in.width), static_cast<double>(in.height)});
  }
  recover.triangulate.robust.outlier_px = options.outlier_px > 0 ? options.outlier_px : kOutlierShare * longest_side;
  return recover;
}

Result<RecoveredPerson> Recover(const std::vector<const FilmedView*>& views, const RecoverPersonOptions& options) {
  std::vector<Camera> cameras;
  std::vector<SeenPeople> people;
  for (const FilmedView* view : views) {
    cameras.push_back(view->camera.camera);
    people.push_back(view->people);
  }
  return RecoverPerson(cameras, people, options);
}

void PrintPeople(const RecoveredPerson& person, const std::vector<FilmedView>& views) {
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
    fmt::print("person {}: seen by {}; rays miss by {:.1f} % of the height\n", ++number, by, 100 * one.error);
  }
  if (alone > 0) fmt::print("{} tracks of people or errors that one camera alone saw\n", alone);
}

void PrintReport(const RecoveredPerson& person, const std::vector<FilmedView>& views) {
  const LimbLengths& l = person.lengths;
  constexpr double kCmPerMetre = 100;
  fmt::print("points: {:.1f} % found, {:.1f} px off the keypoints (median)", 100 * person.report.found,
             person.report.residual_px);
  for (std::size_t i = 0; i < views.size(); ++i) {
    fmt::print("{} {} {:.1f} %", i == 0 ? "; left out:" : ",", views[i].camera.name, 100 * person.report.rejected[i]);
  }
  fmt::print(
      "\nlengths, cm: shank {:.1f}, thigh {:.1f}, trunk {:.1f}, upper arm {:.1f}, forearm {:.1f}, hips {:.1f}, "
      "shoulders {:.1f}\n",
      kCmPerMetre * l.shank, kCmPerMetre * l.thigh, kCmPerMetre * l.trunk, kCmPerMetre * l.upper_arm,
      kCmPerMetre * l.forearm, kCmPerMetre * l.hip_width, kCmPerMetre * l.shoulder_width);
  if (person.held > 0) fmt::print("{} frames show too little and hold the last pose\n", person.held);
}

/// How far the joints of what is written are from the points that they were fitted to.
void PrintFit(const RecoveredPerson& person) {
  const MarkerMotion skeleton = JointMarkers(person.motion);
  const MarkerMotion points = JointMarkers(person.landmarks, person.motion.rate_hz);
  std::vector<MarkerAgreement> rows = CompareMarkers(skeleton, points);
  rows.push_back(CompareAllMarkers(skeleton, points));
  fmt::print("\nDistance of the skeleton's joints to the triangulated points, mm:\n{:<16}{:>8}{:>8}\n", "", "median",
             "p95");
  for (const MarkerAgreement& row : rows) {
    if (row.frames > 0) fmt::print("{:<16}{:>8.1f}{:>8.1f}\n", row.name, row.median_mm, row.p95_mm);
  }
}

/// One column of the table: some cameras, and how near their points come to the reference.
struct AgreementColumn {
  std::string heading;
  std::vector<MarkerAgreement> markers;
  MarkerAgreement all;
};

AgreementColumn ColumnOf(std::string heading, const MarkerMotion& markers, const MarkerMotion& reference) {
  return {std::move(heading), CompareMarkers(markers, reference), CompareAllMarkers(markers, reference)};
}

/// The pairs' own points are found among the same persons by themselves, as if there were no other camera.
Result<std::vector<AgreementColumn>> CompareWithReference(const MarkerMotion& reference, const RecoveredPerson& person,
                                                          const std::vector<FilmedView>& views,
                                                          const RecoverPersonOptions& options) {
  std::vector<AgreementColumn> columns{ColumnOf("all", ToMarkers(person.landmarks, options.rate_hz), reference)};
  for (std::size_t i = 0; views.size() > 2 && i < views.size(); ++i) {
    for (std::size_t j = i + 1; j < views.size(); ++j) {
      const auto pair = Recover({&views[i], &views[j]}, options);
      const std::string heading = fmt::format("{}+{}", i + 1, j + 1);
      columns.push_back(pair ? ColumnOf(heading, ToMarkers(pair->landmarks, options.rate_hz), reference)
                             : AgreementColumn{heading + "!", {}, {}});
    }
  }
  return columns;
}

void PrintAgreement(const std::vector<AgreementColumn>& columns, const std::string& file,
                    const std::vector<FilmedView>& views) {
  fmt::print(
      "\nDistance of the triangulated keypoints to {}, median, mm. Where it was made of the same keypoints,\n"
      "this is agreement, not error. Cameras:",
      file);
  for (std::size_t i = 0; i < views.size(); ++i) fmt::print(" {} {}", i + 1, views[i].camera.name);
  fmt::print("\n{:<12}", "");
  for (const AgreementColumn& column : columns) fmt::print("{:>8}", column.heading);
  fmt::print("\n");
  for (const MarkerAgreement& marker : columns.front().markers) {
    fmt::print("{:<12}", marker.name);
    for (const AgreementColumn& column : columns) {
      const auto found = std::ranges::find(column.markers, marker.name, &MarkerAgreement::name);
      const bool is_there = found != column.markers.end() && found->frames > 0;
      fmt::print("{:>8}", is_there ? fmt::format("{:.1f}", found->median_mm) : "-");
    }
    fmt::print("\n");
  }
  for (const auto& [words, member] :
       {std::pair("all, median", &MarkerAgreement::median_mm), {"all, p95", &MarkerAgreement::p95_mm}}) {
    fmt::print("{:<12}", words);
    for (const AgreementColumn& column : columns)
      fmt::print("{:>8}", column.all.frames > 0 ? fmt::format("{:.1f}", column.all.*member) : "-");
    fmt::print("\n");
  }
}

std::string BytesOf(const RecoveredPerson& person, MotionFormat format, const std::string& name) {
  Clip clip = person.clip;
  clip.name = name;
  switch (format) {
    case MotionFormat::kBvh:
      return WriteBvh(std::move(clip));
    case MotionFormat::kGlb:
      return WriteGlb(Character{.name = name, .skeleton = clip.skeleton, .materials = {}, .meshes = {}}, {&clip, 1});
    case MotionFormat::kTrc:
      return WriteTrc(person.motion, name);
    case MotionFormat::kCsv:
      return WriteJointCsv(person.motion);
  }
  return {};
}

/// Tells how far the film has come: redrawn on a terminal, else silent.
void ShowProgress(double share) {
  if (isatty(STDERR_FILENO) == 0) return;
  fmt::print(stderr, "\rfilm {:3.0f} %{}", 100 * share, share >= 1 ? "\n" : "");
}

Result<void> WriteFilm(const CaptureCommandOptions& options, const std::vector<FilmedView>& views,
                       const RecoveredPerson& person, std::size_t chosen) {
  std::vector<OverlayView> overlays;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const FilmedView& view = views[i];
    overlays.push_back({view.camera.name, view.path, view.facts, view.camera.camera, view.fit, {}});
    for (auto seen : person.people[chosen].seen[i]) {
      // Matched persons are told without the lens.
      for (Keypoint& keypoint : seen ? std::span<Keypoint>(seen->keypoints) : std::span<Keypoint>()) {
        const auto rig = DistortPixel(view.camera.camera, keypoint.pixel);
        keypoint = rig && keypoint.confidence > 0 ? Keypoint{view.fit.ToFilm(*rig), keypoint.confidence} : Keypoint{};
      }
      overlays.back().keypoints.push_back(seen);
    }
  }
  RETURN_IF_ERROR(WriteOverlayFilm(options.film, overlays, person.motion, ShowProgress));
  fmt::print("written: {}\n", options.film);
  return {};
}

/// The place of the person asked for among all that were found.
std::size_t ChosenOf(const RecoveredPerson& person, std::size_t number) {
  for (std::size_t i = 0; i < person.people.size(); ++i) {
    if (person.people[i].cameras >= 2 && number-- == 0) return i;
  }
  return 0;
}

Result<void> Capture(const CaptureCommandOptions& options) {
  for (const std::string* path : {&options.output, &options.points, &options.film}) {
    if (!path->empty()) RETURN_IF_ERROR(CheckOutput(*path, options.overwrite));
  }
  ASSIGN_OR_RETURN(const MotionFormat format, FormatOfName(options.output));
  if (options.keypoints.empty() && options.marks.empty()) {
    return Fail({}, "what shall tell where the person is? allowed: --keypoints DIR or --marks DIR");
  }
  std::optional<MarkerMotion> reference;
  if (!options.reference.empty()) {
    ASSIGN_OR_RETURN(const auto text, ReadWholeFile(options.reference));
    ASSIGN_OR_RETURN(reference, ReadTrc(text, options.reference));
  }
  ASSIGN_OR_RETURN(auto views, OpenFilms(options));
  RETURN_IF_ERROR(CheckTogether(views));
  for (FilmedView& view : views) RETURN_IF_ERROR(ReadPeople(options, view));
  const RecoverPersonOptions recover = RecoverOptionsOf(options, views);
  if (reference && std::abs(reference->rate_hz - recover.rate_hz) > 0.01) {
    return Fail({options.reference}, "{:g} frames a second, the films {:g}", reference->rate_hz, recover.rate_hz);
  }
  fmt::print("{} films, {} frames at {:g} Hz\n", views.size(), views.front().facts.frames, recover.rate_hz);
  std::vector<const FilmedView*> all;
  for (const FilmedView& view : views) all.push_back(&view);
  ASSIGN_OR_RETURN(const RecoveredPerson person, Recover(all, recover));
  PrintPeople(person, views);
  PrintReport(person, views);
  PrintFit(person);
  const std::string name = fs::path(options.output).stem().string();
  RETURN_IF_ERROR(WriteFileAtomically(options.output, BytesOf(person, format, name)));
  fmt::print("written: {}\n", options.output);
  if (!options.points.empty()) {
    RETURN_IF_ERROR(WriteFileAtomically(options.points, WriteTrc(ToMarkers(person.landmarks, recover.rate_hz), name)));
    fmt::print("written: {}\n", options.points);
  }
  if (reference) {
    ASSIGN_OR_RETURN(const auto columns, CompareWithReference(*reference, person, views, recover));
    PrintAgreement(columns, options.reference, views);
  }
  if (!options.film.empty()) RETURN_IF_ERROR(WriteFilm(options, views, person, ChosenOf(person, recover.person)));
  return {};
}

}  // namespace

int CaptureCommand(const CaptureCommandOptions& options) {
  if (auto done = Capture(options); !done) return Complain(done.error());
  return kSuccess;
}

}  // namespace etude
