#include "io/keypoints/read_people.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "engine/base/order_statistics.h"
#include "engine/vision/strokes.h"
#include "io/files/files.h"
#include "io/files/json.h"
#include "io/images/image_files.h"
#include "io/keypoints/coco_file.h"
#include "io/keypoints/frame_numbers.h"
#include "io/keypoints/keypoint_lists.h"
#include "io/keypoints/layout_doubts.h"
#include "io/keypoints/people_json.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr double kOurPixelCentre = 0.5;
constexpr const char* kAllowed = "JSON of OpenPose, COCO, AlphaPose, MMPose or MediaPipe";

Result<std::vector<fs::path>> FilesIn(const fs::path& folder, const char* ending) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ending) files.push_back(entry.path());
  }
  if (error) return Fail({folder.string()}, "{}", error.message());
  if (files.empty()) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
      if (entry.path().extension() != ".txt") continue;
      return Fail({folder.string()}, "the folder contains no {} file, but text files, as YOLO writes; allowed: {}",
                  ending, kAllowed);
    }
    return Fail({folder.string()}, "the folder contains no {} file", ending);
  }
  std::ranges::sort(files, NaturallyBefore, &fs::path::native);
  return files;
}

/// Replaces bare NaN by null, because JSON does not allow NaN. Python writes NaN for missing numbers, such as points
/// that an estimator did not see.
std::string WithNullForNan(std::string text) {
  constexpr std::string_view kNan = "NaN";
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (in_string && text[i] == '\\') {
      ++i;
    } else if (text[i] == '"') {
      in_string = !in_string;
    } else if (!in_string && std::string_view(text).substr(i).starts_with(kNan)) {
      text.replace(i, kNan.size(), "null");
    }
  }
  return text;
}

bool IsAnySeen(const SeenPerson& person) {
  return std::ranges::any_of(person.keypoints, [](const Keypoint& keypoint) { return keypoint.confidence > 0; });
}

Result<std::vector<SeenPerson>> ReadFrame(const fs::path& file, const std::string& layout) {
  const Place place{file.string()};
  ASSIGN_OR_RETURN(const std::string text, ReadWholeFile(file));
  ASSIGN_OR_RETURN(const Json json, ReadJson(WithNullForNan(text), file.string()));
  std::vector<SeenPerson> frame;
  const Json* people = json.is_array() ? &json : FirstMember(json, {"people", "instance_info"});
  if (people == nullptr || !people->is_array()) {
    return Fail(place,
                "the list 'people' or 'instance_info' is missing; allowed: JSON as OpenPose writes it, or MMPose's "
                "list of people");
  }
  // MMPose writes a list of people; its own scripts write an object for a picture.
  if (json.is_array() || people == Member(json, "instance_info")) {
    ASSIGN_OR_RETURN(auto listed, PeopleOfList(*people, layout, NamesOfMeta(json), place));
    std::ranges::copy_if(listed, std::back_inserter(frame), IsAnySeen);
    return frame;
  }
  if (people->size() > kMaxPeople) return Fail(place, "{} people; allowed: {}", people->size(), kMaxPeople);
  for (const Json& person : *people) {
    const Json* list = Member(person, "pose_keypoints_2d");
    if (list == nullptr) list = Member(person, "pose_keypoints");  // OpenPose 1.0 uses this name
    ASSIGN_OR_RETURN(const auto points, Triples(list, place));
    if (points.empty()) continue;
    ASSIGN_OR_RETURN(const SeenPerson seen, ToPerson(points, layout, {}, place));
    if (IsAnySeen(seen)) frame.push_back(seen);
  }
  return frame;
}

Result<PeopleOfFilm> ReadFolder(const fs::path& folder, const std::string& layout, const FilmOfKeypoints& of) {
  ASSIGN_OR_RETURN(const auto files, FilesIn(folder, ".json"));
  PeopleOfFilm film;
  std::vector<std::string> names;
  for (const fs::path& file : files) {
    ASSIGN_OR_RETURN(auto frame, ReadFrame(file, layout));
    film.frames.push_back(std::move(frame));
    names.push_back(file.filename().string());
  }
  LayByNames(names, of, film);
  return film;
}

/// Brings the confidences to 0…1. Some estimators give percentages or raw scores without an upper limit, so a quantile
/// decides. Without this, unsure keypoints would count as certain.
void ScaleConfidences(double given_scale, PeopleOfFilm& film) {
  constexpr double kQuantile = 0.75, kMaxOfScores = 1.2;  // scores of 0…1 may exceed 1 a little
  std::vector<double> confidences;
  const auto for_each = [&](const auto& take) {
    for (auto& frame : film.frames) {
      for (SeenPerson& person : frame) {
        for (Keypoint& keypoint : person.keypoints) take(keypoint.confidence);
      }
    }
  };
  for_each([&](double confidence) {
    if (confidence > 0) confidences.push_back(confidence);
  });
  if (confidences.empty()) return;
  const double largest = std::ranges::max(confidences);
  double scale = LowerPercentile(std::move(confidences), kQuantile);
  const bool is_given = scale > kMaxOfScores && given_scale > 0;
  if (scale <= kMaxOfScores) scale = 1;
  if (is_given) scale = given_scale;
  film.score_scale = scale;
  for_each([&](double& confidence) { confidence = std::min(confidence / scale, 1.0); });
  if (scale == 1) return;
  film.Tell(fmt::format("confidences reach {:.3g}; Etude takes {:.3g}, {} third quartile, and all above it as certain",
                        largest, scale, is_given ? "the films' largest" : "their"));
}

/// The distribution of the coordinates of a film's keypoints.
struct KeypointRange {
  std::size_t confident = 0;  ///< number of keypoints that decide
  std::size_t shares = 0;     ///< those of them within ±1.1
  std::size_t negative = 0;   ///< those of them with a coordinate clearly below 0
  std::size_t seen = 0;       ///< all keypoints that were seen
  std::size_t outside = 0;    ///< those of them that lie outside the picture if coordinates are shares of 0…1
};

KeypointRange RangeOf(const SeenPeople& frames, double min_confidence) {
  constexpr double kMaxShare = 1.1, kMargin = 0.05;
  KeypointRange range;
  for (const auto& frame : frames) {
    for (const SeenPerson& person : frame) {
      for (const Keypoint& keypoint : person.keypoints) {
        if (keypoint.confidence <= 0) continue;
        const glm::dvec2 p = keypoint.pixel - kOurPixelCentre;
        const double low = std::min(p.x, p.y), high = std::max(p.x, p.y);
        ++range.seen;
        range.outside += low < -kMargin || high > 1 + kMargin;
        if (keypoint.confidence < min_confidence) continue;
        ++range.confident;
        range.shares += low >= -kMaxShare && high <= kMaxShare;
        range.negative += low < -kMargin;
      }
    }
  }
  return range;
}

/// Converts keypoints that are shares of the film's width and height, 0…1 or −1…1 in the picture, to pixels. The
/// confident keypoints decide, because estimators such as MediaPipe also guess keypoints far outside the picture.
void Denormalise(const FilmOfKeypoints& of, PeopleOfFilm& film) {
  constexpr int kSmallPicture = 16;
  if (of.width < kSmallPicture || of.height < kSmallPicture) return;
  constexpr double kConfident = 0.5, kFew = 0.1;
  KeypointRange range = RangeOf(film.frames, kConfident);
  if (range.confident == 0) range = RangeOf(film.frames, 0);
  const auto share_of = [](std::size_t part, std::size_t all) {
    return static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(all, 1));
  };
  const double shares = share_of(range.shares, range.confident);
  if (shares <= 0.5) {
    if (shares > kFew) {
      film.Tell(
          fmt::format("{} of {} keypoints have coordinates between -1 and 1, but most keypoints do not, so Etude reads "
                      "all coordinates as pixels",
                      range.shares, range.confident));
    }
    return;
  }
  const bool is_signed = share_of(range.negative, range.confident) > kFew;
  for (auto& frame : film.frames) {
    for (SeenPerson& person : frame) {
      for (Keypoint& keypoint : person.keypoints) {
        const glm::dvec2 p = keypoint.pixel - kOurPixelCentre;
        keypoint.pixel = (is_signed ? 0.5 * (p + 1.0) : p) * glm::dvec2(of.width, of.height);
      }
    }
  }
  if (is_signed) {
    film.Tell(
        fmt::format("keypoint coordinates are between -1 and 1, so Etude reads -1 and 1 as the edges of the picture of "
                    "{} x {} pixels (OpenPose's --keypoint_scale 4)",
                    of.width, of.height));
    return;
  }
  const std::string but = range.outside == 0 ? "" : fmt::format(", all but {} of {}", range.outside, range.seen);
  film.Tell(fmt::format(
      "keypoint coordinates are between 0 and 1{}, so Etude reads them as fractions of the picture's {} x {} pixels",
      but, of.width, of.height));
}

Result<PeopleOfFilm> ReadFile(const fs::path& file, const std::string& layout, const FilmOfKeypoints& of) {
  ASSIGN_OR_RETURN(const std::string text, ReadWholeFile(file));
  const Place place{file.string()};
  if (text.starts_with("\x89HDF")) {
    return Fail(place, "this is an HDF5 file, as DeepLabCut (.h5) and SLEAP (.slp) write; allowed: {}", kAllowed);
  }
  if (file.extension() == ".csv") {
    return Fail(place, "this is a CSV file, as DeepLabCut and SLEAP write; allowed: {}", kAllowed);
  }
  ASSIGN_OR_RETURN(const Json json, ReadJson(WithNullForNan(text), file.string()));
  return IsKeypointList(json) ? ReadKeypointList(json, layout, of, place) : ReadCoco(json, layout, of, place);
}

Result<PeopleOfFilm> ReadAs(const fs::path& path, const std::string& layout, const FilmOfKeypoints& of) {
  return fs::is_directory(path) ? ReadFolder(path, layout, of) : ReadFile(path, layout, of);
}

/// Returns the reason why the keypoints seem to be in another order than `layout`, and the layout that fits better, if
/// there is one; "" if there is no such reason.
std::string DoubtOf(const fs::path& path, const std::string& layout, const FilmOfKeypoints& of,
                    const SeenPeople& frames) {
  std::string doubt = DoubtOf(layout, frames);
  if (doubt.empty() || doubt.find("--layout") != std::string::npos) return doubt;
  for (const KeypointLayout& other : KeypointLayouts()) {
    if (other.name == layout) continue;
    if (const auto read = ReadAs(path, other.name, of); read && FitsClearly(read->frames))
      return doubt + "; try --layout " + other.name;
  }
  return doubt + "; allowed: a name for each keypoint in the file, or --layout";
}

}  // namespace

Result<PeopleOfFilm> ReadKeypoints(const fs::path& path, const std::string& layout, const FilmOfKeypoints& of) {
  Result<PeopleOfFilm> film = ReadAs(path, layout, of);
  if (!film && layout.empty()) {
    // The number of keypoints may fit two layouts, which the mid-hip distinguishes.
    auto other = ReadAs(path, "body_25", of);
    if (other && HasMidHips(other->frames)) {
      other->Tell(
          "Etude uses the layout body_25, because there are 25 keypoints per person and one keypoint is between the "
          "hips");
      film = std::move(other);
    }
  }
  if (!film) return film;
  ScaleConfidences(of.score_scale, *film);
  film->doubt = DoubtOf(path, layout, of, film->frames);
  Denormalise(of, *film);
  return film;
}

double SharedScoreScale(double scale, std::span<const PeopleOfFilm> films) {
  constexpr double kMaxRatio = 4;
  double largest = 1;
  for (const PeopleOfFilm& film : films) largest = std::max(largest, film.score_scale);
  return scale > 1 && scale < largest && largest <= kMaxRatio * scale ? largest : 0;
}

Result<PeopleOfFilm> ReadMarkedPictures(const fs::path& folder) {
  ASSIGN_OR_RETURN(const auto files, FilesIn(folder, ".png"));
  PeopleOfFilm film;
  for (const fs::path& file : files) {
    ASSIGN_OR_RETURN(const ColourImage picture, LoadColourPng(file.string()));
    if (film.width != 0 && (picture.width != film.width || picture.height != film.height)) {
      return Fail({file.string()}, "the picture has {} x {} pixels, but earlier pictures have {} x {}", picture.width,
                  picture.height, film.width, film.height);
    }
    film.width = picture.width;
    film.height = picture.height;
    const SeenPerson person = PersonOf(ReadMarks(picture));
    film.frames.emplace_back();
    if (HeightPx(person) > 0) film.frames.back().push_back(person);
  }
  return film;
}

Result<fs::path> EntryOfFilm(const fs::path& folder, const std::string& film) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    std::string name = entry.path().filename().string();
    constexpr std::string_view kOfMmpose = "results_";  // MMPose's demo puts this before the film's name
    if (!film.starts_with(kOfMmpose) && name.starts_with(kOfMmpose)) name.erase(0, kOfMmpose.size());
    const bool begins = name.starts_with(film);
    if (begins && (name.size() == film.size() || !std::isalnum(static_cast<unsigned char>(name[film.size()])))) {
      found.push_back(entry.path());
    }
  }
  std::ranges::sort(found);
  if (error) return Fail({folder.string()}, "{}", error.message());
  if (found.empty())
    return Fail({folder.string()},
                "the folder contains no file for the film {}; allowed: a file name that begins with the film's name, "
                "followed by another character than a letter or a digit",
                film);
  if (found.size() > 1) {
    return Fail({folder.string()},
                "the names of two files, {} and {}, begin with the film's name {}; allowed: one such file",
                found[0].filename().string(), found[1].filename().string(), film);
  }
  return found.front();
}

}  // namespace etude
