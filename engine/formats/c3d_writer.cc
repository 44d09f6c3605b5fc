#include <algorithm>
#include <bit>
#include <cstdint>

#include "engine/formats/c3d.h"

namespace etude {
namespace {

constexpr std::size_t kBlock = 512;
constexpr std::size_t kMostNamesAtOnce = 255;

void PutWord(std::string& bytes, std::size_t value) {
  bytes += static_cast<char>(value & 0xffU);
  bytes += static_cast<char>((value >> 8U) & 0xffU);
}

void PutFloat(std::string& bytes, double value) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  PutWord(bytes, bits & 0xffffU);
  PutWord(bytes, bits >> 16U);
}

std::string Word(std::size_t value) {
  std::string bytes;
  PutWord(bytes, value);
  return bytes;
}

std::string Float(double value) {
  std::string bytes;
  PutFloat(bytes, value);
  return bytes;
}

void PadToBlock(std::string& bytes) { bytes.resize((bytes.size() + kBlock - 1) / kBlock * kBlock, '\0'); }

/// Writes a parameter section: groups, and what is in them.
class ParameterWriter {
 public:
  void Group(int id, std::string_view name) {
    bytes_ += static_cast<char>(name.size());
    bytes_ += static_cast<char>(-id);
    bytes_ += name;
    PutWord(bytes_, 3);  // to the next one, from here: this word and no description
    bytes_ += '\0';
  }

  /// `type`: −1 letters, 2 words, 4 floats. `sizes` are of its dimensions, at most 255 each.
  void Add(int id, std::string_view name, int type, const std::vector<std::size_t>& sizes, std::string_view data) {
    bytes_ += static_cast<char>(name.size());
    bytes_ += static_cast<char>(id);
    bytes_ += name;
    PutWord(bytes_, 2 + 2 + sizes.size() + data.size() + 1);
    bytes_ += static_cast<char>(type);
    bytes_ += static_cast<char>(sizes.size());
    for (const std::size_t size : sizes) bytes_ += static_cast<char>(size);
    bytes_ += data;
    bytes_ += '\0';
  }

  void AddText(int id, std::string_view name, std::string_view text) { Add(id, name, -1, {text.size()}, text); }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

void AddLabels(const std::vector<std::string>& names, ParameterWriter& parameters) {
  std::size_t width = 1;
  for (const std::string& name : names) width = std::max(width, std::min<std::size_t>(name.size(), 127));
  for (std::size_t first = 0, part = 1; first < names.size(); first += kMostNamesAtOnce, ++part) {
    const std::size_t count = std::min(kMostNamesAtOnce, names.size() - first);
    std::string text;
    for (std::size_t i = first; i < first + count; ++i) {
      std::string label = names[i].substr(0, width);
      label.resize(width, ' ');
      text += label;
    }
    parameters.Add(1, part == 1 ? "LABELS" : "LABELS" + std::to_string(part), -1, {width, count}, text);
  }
}

/// The section of parameters, given the block that the places begin in.
std::string ParameterSection(const MarkerMotion& motion, std::size_t data_block) {
  constexpr std::size_t kMostFrames = 65535;
  constexpr int kPoint = 1, kTrial = 2;
  ParameterWriter parameters;
  parameters.Group(kPoint, "POINT");
  parameters.Add(kPoint, "USED", 2, {}, Word(motion.names.size()));
  parameters.Add(kPoint, "SCALE", 4, {}, Float(-1));
  parameters.Add(kPoint, "RATE", 4, {}, Float(motion.rate_hz));
  parameters.Add(kPoint, "DATA_START", 2, {}, Word(data_block));
  parameters.Add(kPoint, "FRAMES", 2, {}, Word(std::min(motion.frames.size(), kMostFrames)));
  parameters.AddText(kPoint, "UNITS", "mm");
  parameters.AddText(kPoint, "X_SCREEN", "+X");
  parameters.AddText(kPoint, "Y_SCREEN", "+Y");
  AddLabels(motion.names, parameters);
  parameters.Group(kTrial, "TRIAL");
  const auto field = [](std::size_t frame) { return Word(frame & 0xffffU) + Word(frame >> 16U); };
  parameters.Add(kTrial, "ACTUAL_START_FIELD", 2, {2}, field(1));
  parameters.Add(kTrial, "ACTUAL_END_FIELD", 2, {2}, field(motion.frames.size()));
  std::string section("\x01\x50\x00\x54", 4);
  section += parameters.bytes();
  section += '\0';  // no further parameter
  PadToBlock(section);
  section[2] = static_cast<char>(section.size() / kBlock);
  return section;
}

}  // namespace

std::string WriteC3d(const MarkerMotion& motion) {
  constexpr std::size_t kMostFrames = 65535;
  constexpr double kMillimetres = 1000;
  const std::size_t blocks = ParameterSection(motion, 0).size() / kBlock;
  const std::size_t data_block = 2 + blocks;
  std::string bytes("\x02\x50", 2);
  PutWord(bytes, motion.names.size());
  PutWord(bytes, 0);  // analogue values
  PutWord(bytes, 1);
  PutWord(bytes, std::min(motion.frames.size(), kMostFrames));
  PutWord(bytes, 0);  // no gaps are bridged
  PutFloat(bytes, -1);
  PutWord(bytes, data_block);
  PutWord(bytes, 0);
  PutFloat(bytes, motion.rate_hz);
  PadToBlock(bytes);
  bytes += ParameterSection(motion, data_block);
  for (const auto& frame : motion.frames) {
    for (const std::optional<glm::dvec3>& place : frame) {
      for (int axis = 0; axis < 3; ++axis) PutFloat(bytes, place ? kMillimetres * (*place)[axis] : 0);
      PutFloat(bytes, place ? 0 : -1);
    }
  }
  PadToBlock(bytes);
  return bytes;
}

std::string WriteC3d(const BodyMotion& motion) {
  MarkerMotion markers{.rate_hz = motion.rate_hz, .names = {}, .frames = {}};
  for (const Role role : AllRoles()) markers.names.emplace_back(RoleName(role));
  for (const BodyPose& pose : motion.poses) markers.frames.emplace_back(pose.joints.begin(), pose.joints.end());
  return WriteC3d(markers);
}

}  // namespace etude
