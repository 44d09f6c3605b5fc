#include "engine/cameras/pairs_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/text.h"
#include "engine/document/fields.h"

namespace etude {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxCameras = 64;
constexpr std::string_view kHeading = "camera,x,y,z,u,v";

using Five = std::array<double, 5>;

Result<PointPair> ToPair(const Five& v, const Place& place) {
  constexpr double kMaxAbsolute = 1e9;
  for (const double value : v) {
    if (!(std::abs(value) <= kMaxAbsolute))
      return Fail(place, "found {} in a point pair; allowed: numbers within ±10⁹", value);
  }
  return PointPair{{v[0], v[1], v[2]}, {v[3] + kFromOpenCv, v[4] + kFromOpenCv}};
}

Result<std::vector<CameraPairs>> ReadCsv(std::string_view text, const std::string& file) {
  std::vector<CameraPairs> cameras;
  int line = 0;
  TakeFirstLine(text, line);  // the heading
  while (!text.empty()) {
    const std::string_view here = TakeLine(text, line);
    // Skip blank lines and comments.
    const Place place{file, line, 0};
    std::vector<std::string_view> words = SplitAt(here, ',');
    for (std::string_view& word : words) word = Trimmed(word);
    if (words.size() == 1 && (words[0].empty() || words[0].front() == '#')) continue;
    if (words.size() != 6 || words[0].empty()) {
      return Fail(place, "found '{}'; allowed: the name of a camera and five numbers, {}", here, kHeading);
    }
    // Parse the five numbers and add the pair to its camera.
    Five values;
    for (std::size_t i = 0; i < 5; ++i) {
      const auto value = ParseNumber<double>(words[i + 1]);
      if (!value) return Fail(place, "'{}' is not a number", words[i + 1]);
      values[i] = *value;
    }
    ASSIGN_OR_RETURN(const PointPair pair, ToPair(values, place));
    auto of = std::ranges::find(cameras, words[0], &CameraPairs::name);
    if (of == cameras.end())
      of = cameras.insert(cameras.end(), CameraPairs{.name = std::string(words[0]), .pairs = {}});
    of->pairs.push_back(pair);
  }
  return cameras;
}

Result<CameraPairs> ReadCamera(const Node::Entry& entry) {
  CameraPairs camera{.name = entry.key, .pairs = {}};
  // Read the size of the picture.
  Fields fields(entry.value, "a camera's point pairs");
  const std::vector<double> size = fields.Numbers("size", {1, 65536});
  const Node* pairs = fields.Raw("pairs");
  RETURN_IF_ERROR(fields.Finish());
  if (size.size() != 2 || size[0] != std::floor(size[0]) || size[1] != std::floor(size[1])) {
    return Fail(entry.place, "camera {} has no valid size; allowed: `size: [width, height]`, in whole pixels",
                entry.key);
  }
  camera.width = static_cast<int>(size[0]);
  camera.height = static_cast<int>(size[1]);
  // Read the pairs, five numbers each.
  if (pairs == nullptr || pairs->kind != Node::Kind::kSequence) {
    return Fail(entry.place, "camera {} has no list of point pairs; allowed: `pairs: [[x, y, z, u, v], ...]`",
                entry.key);
  }
  for (const Node& item : pairs->items) {
    if (item.kind != Node::Kind::kSequence || item.items.size() != 5) {
      return Fail(item.place, "found {}; allowed: [x, y, z, u, v]", Describe(item));
    }
    Five values;
    for (std::size_t i = 0; i < 5; ++i) {
      ASSIGN_OR_RETURN(values[i], AsNumber(item.items[i]));
    }
    ASSIGN_OR_RETURN(const PointPair pair, ToPair(values, item.place));
    camera.pairs.push_back(pair);
  }
  return camera;
}

Result<std::vector<CameraPairs>> ReadYaml(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(const Node root, ParseYaml(text, file));
  if (root.kind != Node::Kind::kMapping) {
    return Fail(
        {file},
        "found {}; allowed: point pairs in a CSV file with the heading {}, or in a YAML file with one key per camera",
        Describe(root), kHeading);
  }
  std::vector<CameraPairs> cameras;
  for (const Node::Entry& entry : root.entries) {
    ASSIGN_OR_RETURN(auto camera, ReadCamera(entry));
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

}  // namespace

Result<std::vector<CameraPairs>> ReadPointPairs(std::string_view text, const std::string& file) {
  if (text.size() > kMaxBytes) return Fail({file}, "found {} bytes; allowed: at most {}", text.size(), kMaxBytes);
  std::string heading(FirstLine(text));
  std::erase_if(heading, [](char c) { return c == ' ' || c == '\t'; });
  ASSIGN_OR_RETURN(auto cameras, heading == kHeading ? ReadCsv(text, file) : ReadYaml(text, file));
  if (cameras.empty() || cameras.size() > kMaxCameras) {
    return Fail({file}, "found point pairs of {} cameras; allowed: 1 to {} cameras", cameras.size(), kMaxCameras);
  }
  return cameras;
}

}  // namespace etude
