#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <optional>
#include <utility>
#include <variant>

#include "engine/formats/gltf/gltf.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/to_body.h"
#include "io/clips/fbx.h"
#include "tests/fuzz/readers/target.h"

namespace etude::fuzz {
namespace {

/// The value of an FBX element: a text, a number, or an array of numbers.
using FbxValue =
    std::variant<std::string, std::int64_t, double, std::vector<std::int64_t>, std::vector<double>, std::vector<float>>;

struct Element {
  std::string name;
  std::vector<FbxValue> values = {};
  std::vector<Element> below = {};
};

std::string InText(const Element& element) {
  std::string text = element.name + ":", array;
  std::string_view comma = " ";
  const auto add = [&](const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    text += std::exchange(comma, ", ");
    if constexpr (std::is_same_v<Value, std::string>) {
      // "Model::Hips" in text, "Hips\0\1Model" in bytes.
      const std::size_t zero = value.find('\0');
      text += zero == std::string::npos ? '"' + value + '"'
                                        : '"' + value.substr(zero + 2) + "::" + value.substr(0, zero) + '"';
    } else if constexpr (std::is_arithmetic_v<Value>) {
      text += fmt::format("{}", value);
    } else {
      text += fmt::format("*{}", value.size());
      array = fmt::format("a: {}\n", fmt::join(value, ","));
    }
  };
  for (const FbxValue& value : element.values) std::visit(add, value);
  if (array.empty() && element.below.empty()) return text + "\n";
  text += " {\n" + array;
  for (const Element& one : element.below) text += InText(one);
  return text + "}\n";
}

template <typename Number>
std::string Raw(Number number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

/// Returns the element in binary form, for a file in which the element begins at byte `at`: header, name, values and
/// children.
std::string InBytes(const Element& element, std::size_t at) {
  std::string values;
  const auto add = [&](const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, std::string>) {
      values += 'S' + Raw(static_cast<std::uint32_t>(value.size())) + value;
    } else if constexpr (std::is_arithmetic_v<Value>) {
      values += (std::is_integral_v<Value> ? 'L' : 'D') + Raw(value);
    } else {
      using Number = typename Value::value_type;
      values += std::is_integral_v<Number> ? 'l' : sizeof(Number) == 4 ? 'f' : 'd';
      values += Raw(static_cast<std::uint32_t>(value.size())) + Raw(std::uint32_t{0}) +
                Raw(static_cast<std::uint32_t>(value.size() * sizeof(Number)));
      for (const Number number : value) values += Raw(number);
    }
  };
  for (const FbxValue& value : element.values) std::visit(add, value);
  constexpr std::size_t kHead = 13;
  std::string below;
  const std::size_t begin = at + kHead + element.name.size() + values.size();
  for (const Element& one : element.below) below += InBytes(one, begin + below.size());
  if (!element.below.empty()) below += std::string(kHead, '\0');
  return Raw(static_cast<std::uint32_t>(begin + below.size())) +
         Raw(static_cast<std::uint32_t>(element.values.size())) + Raw(static_cast<std::uint32_t>(values.size())) +
         static_cast<char>(element.name.size()) + element.name + values + below;
}

/// Returns a person whose hips turn once about the vertical in a second.
std::vector<Element> Person() {
  const auto called = [](const std::string& name, const std::string& kind) {
    return name + std::string("\0\1", 2) + kind;
  };
  std::vector<Element> objects = {{"AnimationStack", {std::int64_t{1}, called("Turn", "AnimStack"), ""}},
                                  {"AnimationLayer", {std::int64_t{2}, called("Base", "AnimLayer"), ""}},
                                  {"AnimationCurveNode", {std::int64_t{3}, called("R", "AnimCurveNode"), ""}}};
  std::vector<Element> links;
  const auto link = [&](std::int64_t from, std::int64_t to, const std::string& property = "") {
    Element one{"C", {property.empty() ? "OO" : "OP", from, to}};
    if (!property.empty()) one.values.emplace_back(property);
    links.push_back(std::move(one));
  };
  std::int64_t last = 99;
  const auto joint = [&](const std::string& name, std::int64_t parent, double x, double y, double z) {
    Element place{"P", {"Lcl Translation", "Lcl Translation", "", "A", x, y, z}};
    objects.push_back({"Model",
                       {++last, called(name, "Model"), "LimbNode"},
                       {{"Version", {std::int64_t{232}}}, {"Properties70", {}, {std::move(place)}}}});
    link(last, parent);
    return last;
  };
  const std::int64_t hips = joint("Hips", 0, 0, 95, 0), spine = joint("Spine", hips, 0, 20, 0);
  joint("Head", joint("Neck", spine, 0, 30, 0), 0, 12, 0);
  for (const double side : {1.0, -1.0}) {
    const std::string name = side > 0 ? "Left" : "Right";
    const std::int64_t arm = joint(name + "Arm", spine, 18 * side, 26, 0);
    joint(name + "Hand", joint(name + "ForeArm", arm, 28 * side, 0, 0), 25 * side, 0, 0);
    const std::int64_t thigh = joint(name + "UpLeg", hips, 9 * side, -5, 0);
    joint(name + "Foot", joint(name + "Leg", thigh, 0, -43, 0), 0, -42, 0);
  }
  constexpr std::int64_t kSecond = 46'186'158'000;
  objects.push_back({"AnimationCurve",
                     {std::int64_t{4}, called("", "AnimCurve"), ""},
                     {{"Default", {0.0}},
                      {"KeyVer", {std::int64_t{4008}}},
                      {"KeyTime", {std::vector<std::int64_t>{0, kSecond / 2, kSecond}}},
                      {"KeyValueFloat", {std::vector<float>{0, 180, 360}}},
                      {"KeyAttrFlags", {std::vector<std::int64_t>{24836}}},
                      {"KeyAttrDataFloat", {std::vector<float>{0, 0, 0, 0}}},
                      {"KeyAttrRefCount", {std::vector<std::int64_t>{3}}}}});
  link(2, 1), link(3, 2), link(3, hips, "Lcl Rotation"), link(4, 3, "d|Y");
  return {{"FBXHeaderExtension", {}, {{"FBXVersion", {std::int64_t{7400}}}}},
          {"GlobalSettings", {}, {{"Version", {std::int64_t{1000}}}}},
          {"Objects", {}, std::move(objects)},
          {"Connections", {}, std::move(links)}};
}

std::vector<std::string> FbxSeeds() {
  std::string text = "; FBX 7.4.0 project file\n";
  std::string bytes("Kaydara FBX Binary  \0\x1a\0", 23);
  bytes += Raw(std::uint32_t{7400});
  for (const Element& element : Person()) {
    text += InText(element);
    bytes += InBytes(element, bytes.size());
  }
  return {text, bytes + std::string(13, '\0')};
}

// assimp is compiled without edge counters, so its messages serve instead: libFuzzer treats new ones as new coverage.
constexpr std::size_t kSigns = 4096, kSigned = 60;
__attribute__((used, section("__libfuzzer_extra_counters"))) std::uint8_t signs[kSigns];

/// Sets the coverage counter of the message `told`, which the reading of a file returned. Digits and quoted names in
/// the message are ignored.
void Sign(std::string_view told) {
  std::size_t hash = 0;
  bool is_quoted = false;
  for (const char c : told) {
    is_quoted = is_quoted != (c == '\'' || c == '"');
    if (!is_quoted && (c < '0' || c > '9')) hash = 31 * hash + static_cast<unsigned char>(c);
  }
  signs[hash % kSigns] = 1;
}

/// Reads a file as users do, in a child process with limits. The child reads up to 10,000 files, because starting a
/// process takes fifty times as long as reading a file. When the child ends, the memory that assimp leaked is freed.
void Fbx(std::string_view bytes) {
  constexpr int kFilesOfChild = 10'000;
  static std::optional<FbxReader> reader;
  static int count = 0;
  if (count++ % kFilesOfChild == 0) reader.emplace();
  const auto motion = reader->Read(bytes, kFile);
  if (!motion) {
    const std::string told = motion.error().message;
    Require(!told.starts_with("reading an FBX file needs assimp, which is missing"), told.c_str());
    constexpr std::size_t kLongest = 320;
    Require(!told.empty() && told.size() < kLongest && ToString(motion.error()).find('\n') == std::string::npos,
            "a refusal is one short line");
    if (told.starts_with(kReaderCrashed)) std::fprintf(stderr, "ASSIMP FELL: %s\n", told.c_str());
    Sign(told.substr(0, kSigned));
    return;
  }
  const auto content = ReadGltf(motion->glb, kFile, nullptr);
  if (!content) return Sign(content.error().message.substr(0, kSigned));
  for (const Clip& clip : content->clips) {
    Sign(std::string(clip.skeleton.joints.size(), 'j') + std::string(clip.frames.size(), 'f'));
    const auto map = FindJointMap(clip.skeleton, kFile);
    if (map) (void)ToBodyMotion(clip, *map, kFile);
  }
}

}  // namespace

std::vector<Target> FbxTargets() {
  return {{"fbx",
           Fbx,
           FbxSeeds,
           {"PreRotation", "RotationOrder", "UnitScaleFactor", "UpAxis", "Lcl Scaling", "GeometricTranslation", "d|X",
            "NodeAttribute", "Takes", "FBXVersion: 6100", "Channel: \"T\""}}};
}

}  // namespace etude::fuzz
