#include "io/keypoints/read_people.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "engine/vision/strokes.h"
#include "io/files/files.h"
#include "io/files/json.h"
#include "io/images/image_files.h"
#include "io/keypoints/keypoint_lists.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr double kOurPixelCentre = 0.5;
constexpr double kMaxPixel = 1e6;

/// Returns true if name `a` sorts before `b`, with numbers compared by value: frame 9 comes before frame 10.
bool NaturallyBefore(const fs::path& a, const fs::path& b) {
  const std::string x = a.filename().string(), y = b.filename().string();
  std::size_t i = 0, j = 0;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  while (i < x.size() && j < y.size()) {
    if (is_digit(x[i]) && is_digit(y[j])) {
      // Compare two numbers without their leading zeros.
      std::size_t end_x = i, end_y = j;
      while (end_x < x.size() && is_digit(x[end_x])) ++end_x;
      while (end_y < y.size() && is_digit(y[end_y])) ++end_y;
      std::string_view m = std::string_view(x).substr(i, end_x - i), n = std::string_view(y).substr(j, end_y - j);
      while (m.size() > 1 && m.front() == '0') m.remove_prefix(1);
      while (n.size() > 1 && n.front() == '0') n.remove_prefix(1);
      if (m != n) return m.size() != n.size() ? m.size() < n.size() : m < n;
      i = end_x;
      j = end_y;
    } else {
      if (x[i] != y[j]) return x[i] < y[j];
      ++i;
      ++j;
    }
  }
  // The numbers are equal up to leading zeros. The name with the shorter remainder comes first; if the remainders have
  // equal lengths, the characters decide.
  return x.size() - i != y.size() - j ? x.size() - i < y.size() - j : x < y;
}

Result<std::vector<fs::path>> FilesIn(const fs::path& folder, const char* ending) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ending) files.push_back(entry.path());
  }
  if (error) return Fail({folder.string()}, "{}", error.message());
  if (files.empty()) return Fail({folder.string()}, "no {} file in it", ending);
  std::ranges::sort(files, NaturallyBefore);
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
  if (json.is_array()) {  // MMPose writes a list of people
    ASSIGN_OR_RETURN(auto people, PeopleOfList(json, layout, {}, place));
    std::ranges::copy_if(people, std::back_inserter(frame), IsAnySeen);
    return frame;
  }
  const Json* people = Member(json, "people");
  if (people == nullptr || !people->is_array())
    return Fail(place, "no list 'people'; allowed: JSON as OpenPose writes it, or MMPose's list of people");
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

/// Returns the keypoint names of a COCO file's first category.
std::vector<std::string> NamesOf(const Json& json) {
  const Json* categories = Member(json, "categories");
  if (categories == nullptr || !categories->is_array() || categories->empty()) return {};
  return TextsOf(Member(categories->front(), "keypoints"));
}

struct CocoPerson {
  std::size_t frame;
  std::vector<Keypoint> points;  ///< the points; `confidence` holds COCO's visibility flag v
};

Result<std::map<double, std::size_t>> FramesOf(const Json& images, PeopleOfFilm& film, std::vector<std::string>& names,
                                               const Place& place) {
  std::map<double, std::size_t> frames;
  for (const Json& image : images) {
    const Json* name = Member(image, "file_name");
    names.push_back(name != nullptr && name->is_string() ? fs::path(name->get<std::string>()).filename().string() : "");
    const Json *id = Member(image, "id"), *width = Member(image, "width"), *height = Member(image, "height");
    if (id == nullptr || !id->is_number()) return Fail(place, "an image without a number 'id'");
    if (!frames.try_emplace(id->get<double>(), frames.size()).second) {
      return Fail(place, "two images with the id {}", id->dump());
    }
    if (width != nullptr && width->is_number() && height != nullptr && height->is_number()) {
      const int w = static_cast<int>(std::clamp(width->get<double>(), 0.0, kMaxPixel));
      const int h = static_cast<int>(std::clamp(height->get<double>(), 0.0, kMaxPixel));
      if (film.width != 0 && (w != film.width || h != film.height)) {
        return Fail(place, "images of {} x {} and of {} x {} pixels in one film", film.width, film.height, w, h);
      }
      film.width = w;
      film.height = h;
    }
  }
  return frames;
}

Result<PeopleOfFilm> ReadCoco(const Json& json, const std::string& layout, const FilmOfKeypoints& of,
                              const Place& place) {
  const Json *images = Member(json, "images"), *annotations = Member(json, "annotations");
  if (images == nullptr || !images->is_array() || annotations == nullptr || !annotations->is_array()) {
    return Fail(place,
                "no lists 'images' and 'annotations'; allowed: keypoint files or results of COCO, AlphaPose or MMPose, "
                "landmarks of MediaPipe, or a folder of OpenPose's JSON files");
  }
  const std::vector<std::string> names = NamesOf(json);
  PeopleOfFilm film;
  std::vector<std::string> file_names;
  ASSIGN_OR_RETURN(const auto frames, FramesOf(*images, film, file_names, place));
  // Collect the people of every image.
  std::vector<CocoPerson> people;
  double max_confidence = 0;
  for (const Json& annotation : *annotations) {
    const Json* id = Member(annotation, "image_id");
    const auto frame = id != nullptr && id->is_number() ? frames.find(id->get<double>()) : frames.end();
    if (frame == frames.end()) return Fail(place, "an annotation of an image that is not listed");
    ASSIGN_OR_RETURN(auto points, Triples(Member(annotation, "keypoints"), place));
    for (const Keypoint& point : points) max_confidence = std::max(max_confidence, point.confidence);
    people.push_back({frame->second, std::move(points)});
  }
  film.frames.resize(frames.size());
  if (film.frames.empty()) return Fail(place, "no image");
  for (CocoPerson& person : people) {
    // If any value exceeds 1, the values are COCO's flags; otherwise they are scores.
    for (Keypoint& point : person.points) point.confidence /= max_confidence > 1 ? 2 : 1;
    ASSIGN_OR_RETURN(const SeenPerson seen, ToPerson(person.points, layout, names, place));
    if (film.frames[person.frame].size() >= kMaxPeople)
      return Fail(place, "more than {} people in a frame", kMaxPeople);
    film.frames[person.frame].push_back(seen);
  }
  LayByNames(file_names, of, film);
  return film;
}

/// If all seen keypoints lie within ±1.1, treats them as shares of the film's width and height (0…1 in the picture) and
/// converts them to pixels.
void Denormalise(const FilmOfKeypoints& of, PeopleOfFilm& film) {
  constexpr double kMaxShare = 1.1;
  constexpr int kSmallPicture = 16;
  if (of.width < kSmallPicture || of.height < kSmallPicture) return;
  // Keep the keypoints as they are if a coordinate of any seen keypoint lies outside ±1.1.
  std::size_t seen = 0;
  for (const auto& frame : film.frames) {
    for (const SeenPerson& person : frame) {
      for (const Keypoint& keypoint : person.keypoints) {
        const glm::dvec2 p = keypoint.pixel - kOurPixelCentre;
        if (keypoint.confidence <= 0) continue;
        if (std::abs(p.x) > kMaxShare || std::abs(p.y) > kMaxShare) return;
        ++seen;
      }
    }
  }
  if (seen == 0) return;
  for (auto& frame : film.frames) {
    for (SeenPerson& person : frame) {
      for (Keypoint& keypoint : person.keypoints) {
        keypoint.pixel = (keypoint.pixel - kOurPixelCentre) * glm::dvec2(of.width, of.height);
      }
    }
  }
  film.told += film.told.empty() ? "" : "; ";
  film.told +=
      fmt::format("keypoints lie between 0 and 1, so they are taken as fractions of the picture's {} x {} pixels",
                  of.width, of.height);
}

Result<PeopleOfFilm> ReadFile(const fs::path& file, const std::string& layout, const FilmOfKeypoints& of) {
  ASSIGN_OR_RETURN(const std::string text, ReadWholeFile(file));
  ASSIGN_OR_RETURN(const Json json, ReadJson(WithNullForNan(text), file.string()));
  const Place place{file.string()};
  return IsKeypointList(json) ? ReadKeypointList(json, layout, of, place) : ReadCoco(json, layout, of, place);
}

Result<PeopleOfFilm> ReadAs(const fs::path& path, const std::string& layout, const FilmOfKeypoints& of) {
  return fs::is_directory(path) ? ReadFolder(path, layout, of) : ReadFile(path, layout, of);
}

/// Counts the people who show three landmarks (`people`), and those whose middle landmark lies midway (`between`).
struct Midway {
  int between = 0, people = 0;
  bool Are() const { return IsEnough() && between >= kMostly * people; }
  bool AreNot() const { return IsEnough() && between <= (1 - kMostly) * people; }

 private:
  static constexpr double kMostly = 0.9;
  static constexpr int kMinPeople = 3;
  bool IsEnough() const { return people >= kMinPeople; }
};

Midway CountMidway(const SeenPeople& frames, Landmark middle, Landmark a, Landmark b) {
  constexpr double kMaxShare = 0.03;  // tolerance as a share of the person's height
  Midway count;
  for (const auto& frame : frames) {
    for (const SeenPerson& person : frame) {
      const double height = HeightPx(person);
      const bool shows_all = std::min({person[middle].confidence, person[a].confidence, person[b].confidence}) > 0;
      if (!shows_all || height <= 0) continue;
      ++count.people;
      const glm::dvec2 wanted = 0.5 * (person[a].pixel + person[b].pixel);
      if (glm::distance(person[middle].pixel, wanted) <= kMaxShare * height) ++count.between;
    }
  }
  return count;
}

Midway MidHipsOfBody25(const SeenPeople& frames) {
  return CountMidway(frames, Landmark::kMidHip, Landmark::kLeftHip, Landmark::kRightHip);
}

/// Returns the reason why the people of this layout seem to have the other layout of 25 keypoints; "" if there is none.
std::string DoubtOf(const std::string& layout, const SeenPeople& frames) {
  if (layout == "body_25") {
    const Midway hips = MidHipsOfBody25(frames);
    if (!hips.AreNot()) return "";
    return fmt::format(
        "read as layout body_25, the mid-hip lies between the hips in only {} of {} people; try --layout body_25b",
        hips.between, hips.people);
  }
  if (layout != "body_25b") return "";
  // The mid-hip and the two hips of body_25 have the numbers 8, 9 and 12. In body_25b, these numbers stand for the
  // right elbow, the left wrist and the right hip.
  const Midway hips = CountMidway(frames, Landmark::kRightElbow, Landmark::kLeftWrist, Landmark::kRightHip);
  if (!hips.Are()) return "";
  return fmt::format(
      "read as layout body_25b, the right elbow lies between the left wrist and the right hip in {} of {} people; try "
      "--layout body_25",
      hips.between, hips.people);
}

}  // namespace

Result<PeopleOfFilm> ReadKeypoints(const fs::path& path, const std::string& layout, const FilmOfKeypoints& of) {
  Result<PeopleOfFilm> film = ReadAs(path, layout, of);
  if (!film && layout.empty()) {
    // The number of keypoints may fit two layouts, which the mid-hip tells apart.
    auto other = ReadAs(path, "body_25", of);
    if (other && MidHipsOfBody25(other->frames).Are()) {
      other->told += other->told.empty() ? "" : "; ";
      other->told += "25 keypoints per person, one of them between the hips: layout body_25";
      film = std::move(other);
    }
  }
  if (!film) return film;
  film->doubt = DoubtOf(layout, film->frames);
  Denormalise(of, *film);
  return film;
}

Result<PeopleOfFilm> ReadMarkedPictures(const fs::path& folder) {
  ASSIGN_OR_RETURN(const auto files, FilesIn(folder, ".png"));
  PeopleOfFilm film;
  for (const fs::path& file : files) {
    ASSIGN_OR_RETURN(const ColourImage picture, LoadColourPng(file.string()));
    if (film.width != 0 && (picture.width != film.width || picture.height != film.height)) {
      return Fail({file.string()}, "{} x {} pixels, but earlier pictures have {} x {}", picture.width, picture.height,
                  film.width, film.height);
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
    const std::string name = entry.path().filename().string();
    const bool begins = name.starts_with(film);
    if (begins && (name.size() == film.size() || !std::isalnum(static_cast<unsigned char>(name[film.size()])))) {
      found.push_back(entry.path());
    }
  }
  std::ranges::sort(found);
  if (error) return Fail({folder.string()}, "{}", error.message());
  if (found.empty()) return Fail({folder.string()}, "no file in it begins with the film's name {}", film);
  if (found.size() > 1) {
    return Fail({folder.string()}, "{} and {} both begin with the film's name {}", found[0].filename().string(),
                found[1].filename().string(), film);
  }
  return found.front();
}

}  // namespace etude
