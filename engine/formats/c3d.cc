#include "engine/formats/c3d.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/formats/c3d_parameters.h"
#include "engine/formats/length_units.h"

namespace etude {
namespace {

constexpr unsigned char kC3dKey = 0x50;
constexpr std::size_t kMaxPoints = 10'000;
constexpr double kMaxC3dFrames = 1e7;
constexpr double kMaxValue = 1e9;

/// Returns the names of all points, from LABELS, LABELS2 and so on.
std::vector<std::string> PointNames(const C3dParameters& parameters, std::size_t points) {
  std::vector<std::string> names;
  for (int part = 1; names.size() < points; ++part) {
    const auto more = parameters.Texts("POINT:LABELS" + (part == 1 ? "" : std::to_string(part)), points - names.size());
    if (more.empty()) break;
    names.insert(names.end(), more.begin(), more.end());
  }
  names.resize(points);
  for (std::size_t i = 0; i < points; ++i) {
    if (names[i].empty()) names[i] = "point " + std::to_string(i + 1);
  }
  return names;
}

/// Returns the joint widths that Vicon's programs write, in metres, keyed by the parameter's name without the group.
std::map<std::string, double> BodySizes(const C3dParameters& parameters) {
  constexpr double kMin_mm = 5, kMax_mm = 400;
  std::map<std::string, double> sizes;
  const auto add = [&](const std::string& name) {
    const auto value = parameters.Number("PROCESSING:" + name);
    if (value && *value >= kMin_mm && *value <= kMax_mm) sizes[name] = *value / 1000;
  };
  for (const char* side : {"L", "R"}) {
    for (const char* size : {"KNEEWIDTH", "ANKLEWIDTH", "ELBOWWIDTH", "SHOULDEROFFSET"}) add(std::string(side) + size);
  }
  add("MARKERDIAMETER");
  return sizes;
}

/// Returns the frame number in a parameter of the group TRIAL. It is stored as two 16-bit words, the lower first.
std::optional<double> TrialField(const C3dParameters& parameters, const char* name) {
  const auto low = parameters.Number(name, 0), high = parameters.Number(name, 1);
  return low && high ? std::optional(*low + 65536 * *high) : std::nullopt;
}
constexpr const char* kStartField = "TRIAL:ACTUAL_START_FIELD";

/// The number of frames, and the other number that the file states; 0 = none differs.
struct FrameCount {
  double frames = 0, other = 0;
  const char *by = "", *other_by = "";  ///< the entries that state the two numbers
};

/// POINT:FRAMES is the number of frames (c3d.org). A number that does not fit into its 16 bits is in POINT:LONG_FRAMES
/// or in TRIAL. The header's words count only if these are missing, because programs leave the range of the first
/// recording there.
FrameCount CountFrames(const C3dBytes& bytes, const C3dParameters& parameters) {
  constexpr double kWords = 65536;
  const double first = bytes.Word(6), last = bytes.Word(8), in_header = last - first + 1;
  const auto begin = TrialField(parameters, kStartField), end = TrialField(parameters, "TRIAL:ACTUAL_END_FIELD");
  std::optional<double> of_trial;
  if (begin && end && *end >= *begin) of_trial = *end - *begin + 1;
  FrameCount count{.frames = in_header, .by = "its header", .other_by = ""};
  if (of_trial) count = {.frames = *of_trial, .by = "TRIAL", .other_by = ""};
  if (const auto told = parameters.Number("POINT:LONG_FRAMES"); told && *told > count.frames)
    count = {.frames = *told, .by = "POINT:LONG_FRAMES", .other_by = ""};
  const auto told = parameters.Number("POINT:FRAMES");
  const bool is_long = count.frames >= kWords && told && std::fmod(count.frames, kWords) == *told;
  if (told && *told >= 1 && *told != kWords - 1 && !is_long) count = {.frames = *told, .by = "POINT:FRAMES", .other_by = ""};
  if (of_trial && *of_trial != count.frames) {
    count.other = *of_trial;
    count.other_by = "TRIAL";
  } else if (in_header != count.frames && last < kWords - 1 && count.frames < kWords) {
    count.other = in_header;
    count.other_by = "its header";
  }
  return count;
}

/// Returns the labels of the points that hold angles, forces and so on instead of positions: those in POINT:ANGLES and
/// similar lists, and in lists to which POINT:TYPE_GROUPS gives such a type. (Vicon's programs write both.)
std::set<std::string> LabelsOfOtherQuantities(const C3dParameters& parameters) {
  constexpr std::array<std::string_view, 6> kTypes = {"ANGLE", "FORCE", "MOMENT", "POWER", "SCALAR", "REACTION"};
  constexpr std::size_t kMaxGroups = 200;
  std::set<std::string> lists;
  for (const std::string_view type : kTypes) lists.insert(std::string(type) + "S");
  // The entries of TYPE_GROUPS are pairs: a type, and the name of the list.
  auto groups = parameters.Texts("POINT:TYPE_GROUPS", kMaxGroups);
  for (std::string& name : groups) name = InUpperCase(std::move(name));
  for (std::size_t i = 0; i + 1 < groups.size(); i += 2) {
    const bool is_other = std::ranges::any_of(kTypes, [&](std::string_view t) { return groups[i].starts_with(t); });
    if (is_other) lists.insert(groups[i + 1]);
  }
  std::set<std::string> labels;
  for (const std::string& list : lists) {
    for (int part = 1; part < 100; ++part) {
      const auto more = parameters.Texts("POINT:" + list + (part == 1 ? "" : std::to_string(part)), kMaxPoints);
      if (more.empty()) break;
      labels.insert(more.begin(), more.end());
    }
  }
  labels.erase("");
  return labels;
}

/// The layout of the points in a frame of the file.
struct Layout {
  std::size_t points = 0, begin = 0, frame_bytes = 0;
  bool has_floats = false;
  double metres = 0;  ///< metres per unit of a stored number
};

std::optional<glm::dvec3> PointAt(const C3dBytes& bytes, std::size_t at, const Layout& layout) {
  glm::dvec3 point(0);
  const std::size_t step = layout.has_floats ? 4 : 2;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t value = at + step * static_cast<std::size_t>(axis);
    point[axis] = (layout.has_floats ? bytes.Float(value) : bytes.Integer(value)) * layout.metres;
    if (!(std::abs(point[axis]) < kMaxValue)) return std::nullopt;
  }
  const double residual = layout.has_floats ? bytes.Float(at + 3 * step) : bytes.Integer(at + 3 * step);
  return residual >= 0 ? std::optional(point) : std::nullopt;
}

}  // namespace

bool IsC3d(std::string_view bytes) {
  return bytes.size() >= 2 * kC3dBlock && static_cast<unsigned char>(bytes[1]) == kC3dKey && bytes[0] > 0;
}

Result<C3d> ReadC3d(std::string_view bytes, const std::string& file) {
  // Find the kind of machine and read the parameters.
  if (!IsC3d(bytes)) return Fail({file}, "no C3D file");
  const std::size_t parameters_at = (static_cast<unsigned char>(bytes[0]) - std::size_t{1}) * kC3dBlock;
  const unsigned machine = C3dBytes(bytes, C3dMachine::kIntel).Byte(parameters_at + 3);
  if (machine < 84 || machine > 86) {
    return Fail({file}, "the processor type is {}; allowed: 84 (Intel), 85 (DEC), 86 (MIPS)", machine);
  }
  const C3dBytes all(bytes, static_cast<C3dMachine>(machine));
  const C3dParameters parameters(all, parameters_at);

  // Read and check the number of points, scale, rate and unit.
  Layout layout{.points = static_cast<std::size_t>(parameters.Number("POINT:USED").value_or(all.Word(2)))};
  const double scale = parameters.Number("POINT:SCALE").value_or(all.Float(12));
  const double stated_hz = parameters.Number("POINT:RATE").value_or(0), header_hz = all.Float(20);
  const double rate = stated_hz == 0 ? header_hz : stated_hz;
  if (layout.points == 0)
    return Fail({file}, "the file contains no points (Etude does not read rotations and analogue channels)");
  if (layout.points > kMaxPoints)
    return Fail({file}, "found {} points; allowed: at most {}", layout.points, kMaxPoints);
  if (!(rate > 0 && rate < kMaxValue)) return Fail({file}, "the rate is {} Hz; allowed: above 0", rate);
  if (!(std::abs(scale) < kMaxValue) || scale == 0) return Fail({file}, "POINT:SCALE is {}; allowed: not 0", scale);
  const auto units = parameters.Texts("POINT:UNITS");
  C3d read{.markers = {.rate_hz = rate, .names = PointNames(parameters, layout.points), .frames = {}},
           .unit = units.empty() ? "" : units.front()};
  const auto metres = MetresOfUnit(read.unit.empty() ? "mm" : read.unit);
  if (!metres) return Fail({file}, "units are {}; allowed: m, cm, mm, in, ft", Quote(read.unit));
  // A negative scale means that points are stored as floats.
  layout.has_floats = scale < 0;
  layout.metres = layout.has_floats ? *metres : *metres * scale;
  read.step_m = layout.has_floats ? 0 : layout.metres;
  if (const auto screen = parameters.Texts("POINT:Y_SCREEN"); !screen.empty() && screen.front().size() == 2) {
    const char axis = screen.front()[1];
    if (axis >= 'X' && axis <= 'Z') read.up = axis;
    read.is_up_negative = screen.front()[0] == '-';
  }
  read.markers.metres_per_unit = *metres;
  // Frame 1 has time 0.
  read.markers.start_s = std::max(0.0, TrialField(parameters, kStartField).value_or(all.Word(6)) - 1) / rate;
  constexpr double kSameRate = 0.01;
  if (stated_hz == 0 && parameters.Number("POINT:RATE")) {
    read.markers.remark = fmt::format("POINT:RATE is 0; Etude uses the header's rate, {:g} Hz", rate);
  } else if (header_hz > 0 && std::abs(header_hz / rate - 1) > kSameRate) {
    read.markers.remark =
        fmt::format("POINT:RATE states {:g} Hz, but the header states {:g} Hz; Etude uses POINT:RATE", rate, header_hz);
  }
  read.markers.sizes_m = BodySizes(parameters);

  // Leave out the points that are not positions.
  const std::set<std::string> others = LabelsOfOtherQuantities(parameters);
  std::vector<std::size_t> kept;
  for (std::size_t point = 0; point < layout.points; ++point) {
    if (!others.contains(read.markers.names[point])) kept.push_back(point);
  }
  if (kept.empty())
    return Fail({file}, "the file contains no points (Etude does not read angles, forces and analogue channels)");
  std::vector<std::string> names;
  for (const std::size_t point : kept) names.push_back(std::move(read.markers.names[point]));
  read.markers.names = std::move(names);

  // Locate the frames and check that they are all there.
  const auto data_block = static_cast<std::size_t>(parameters.Number("POINT:DATA_START").value_or(all.Word(16)));
  layout.begin = (std::max<std::size_t>(data_block, 1) - 1) * kC3dBlock;
  layout.frame_bytes = (4 * layout.points + all.Word(4)) * (layout.has_floats ? 4 : 2);
  const FrameCount count = CountFrames(all, parameters);
  const auto frames = static_cast<std::size_t>(count.frames >= 1 && count.frames <= kMaxC3dFrames ? count.frames : 0);
  if (frames == 0) return Fail({file}, "the header states 0 frames or more than 10⁷; allowed: 1 to 10⁷ frames");
  const std::size_t there = bytes.size() > layout.begin ? (bytes.size() - layout.begin) / layout.frame_bytes : 0;
  if (there < frames) return Fail({file}, "the file ends too early: it contains {} of {} frames", there, frames);
  // Read the points.
  read.markers.frames.reserve(frames);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    auto& places = read.markers.frames.emplace_back();
    places.reserve(kept.size());
    for (const std::size_t point : kept) {
      const std::size_t at = layout.begin + frame * layout.frame_bytes + point * (layout.has_floats ? 16 : 8);
      places.push_back(PointAt(all, at, layout));
    }
  }
  // Add remarks if data follow after the block of the last frame, or if the file states another number of frames.
  const std::size_t end = layout.begin + frames * layout.frame_bytes;
  const std::size_t data_end = parameters_at >= end ? parameters_at : bytes.size();
  const std::size_t padded = (end + kC3dBlock - 1) / kC3dBlock * kC3dBlock;
  const bool has_more = data_end >= padded + layout.frame_bytes &&
                        bytes.substr(padded, data_end - padded).find_first_not_of('\0') != std::string_view::npos;
  const std::size_t more = has_more ? (data_end - end) / layout.frame_bytes : 0;
  const auto remark = [&](const std::string& text) {
    read.markers.remark += (read.markers.remark.empty() ? "" : "; ") + text;
  };
  if (count.other > 0) {
    remark(fmt::format("{} states {} frames, but {} states {:g} and the file contains {}; Etude uses the first number",
                       count.by, frames, count.other_by, count.other, frames + more));
  }
  if (has_more) {
    remark(fmt::format("the file contains {} frames more than the {} that {} states; Etude did not read them", more,
                       frames, count.by));
  }
  return read;
}

namespace {

constexpr std::size_t kMaxNamesPerParameter = 255;

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

void PadToBlock(std::string& bytes) { bytes.resize((bytes.size() + kC3dBlock - 1) / kC3dBlock * kC3dBlock, '\0'); }

/// Writes a parameter section, which holds groups and their parameters.
class ParameterWriter {
 public:
  void Group(int id, std::string_view name) {
    bytes_ += static_cast<char>(name.size());
    bytes_ += static_cast<char>(-id);
    bytes_ += name;
    PutWord(bytes_, 3);  // bytes to the next record: 2 of this word, 1 of the empty description
    bytes_ += '\0';
  }

  /// Adds a parameter. `type` is −1 for text, 2 for 16-bit integers, 4 for floats. `sizes` are its dimensions, at
  /// most 255 each.
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
  for (std::size_t first = 0, part = 1; first < names.size(); first += kMaxNamesPerParameter, ++part) {
    const std::size_t count = std::min(kMaxNamesPerParameter, names.size() - first);
    std::string text;
    for (std::size_t i = first; i < first + count; ++i) {
      std::string label = names[i].substr(0, width);
      label.resize(width, ' ');
      text += label;
    }
    parameters.Add(1, part == 1 ? "LABELS" : "LABELS" + std::to_string(part), -1, {width, count}, text);
  }
}

/// Returns the number of the first frame, by which C3D states its time; 1 if the time is negative or has no number.
std::size_t FirstField(double start_s, double rate_hz, std::size_t frames) {
  constexpr double kMaxField = 4e9;
  const double field = std::round(start_s * rate_hz) + 1;
  return field >= 1 && field + static_cast<double>(frames) < kMaxField ? static_cast<std::size_t>(field) : 1;
}

std::size_t FirstField(const MarkerMotion& motion) {
  return FirstField(motion.start_s.value_or(0), motion.rate_hz, motion.frames.size());
}

/// Returns the parameter section; `data_block` is the number of the block at which the points begin.
std::string ParameterSection(const MarkerMotion& motion, std::size_t data_block) {
  constexpr std::size_t kMaxWord = 65535;
  constexpr int kPoint = 1, kTrial = 2;
  ParameterWriter parameters;
  parameters.Group(kPoint, "POINT");
  parameters.Add(kPoint, "USED", 2, {}, Word(motion.names.size()));
  parameters.Add(kPoint, "SCALE", 4, {}, Float(-1));
  parameters.Add(kPoint, "RATE", 4, {}, Float(motion.rate_hz));
  parameters.Add(kPoint, "DATA_START", 2, {}, Word(data_block));
  parameters.Add(kPoint, "FRAMES", 2, {}, Word(std::min(motion.frames.size(), kMaxWord)));
  parameters.AddText(kPoint, "UNITS", "mm");
  parameters.AddText(kPoint, "X_SCREEN", "+X");
  parameters.AddText(kPoint, "Y_SCREEN", "+Y");
  AddLabels(motion.names, parameters);
  parameters.Group(kTrial, "TRIAL");
  const auto field = [](std::size_t frame) { return Word(frame & 0xffffU) + Word(frame >> 16U); };
  const std::size_t first = FirstField(motion);
  parameters.Add(kTrial, "ACTUAL_START_FIELD", 2, {2}, field(first));
  parameters.Add(kTrial, "ACTUAL_END_FIELD", 2, {2}, field(first + motion.frames.size() - 1));
  std::string section("\x01\x50\x00\x54", 4);
  section += parameters.bytes();
  section += '\0';  // end of the parameters
  PadToBlock(section);
  section[2] = static_cast<char>(section.size() / kC3dBlock);
  return section;
}

}  // namespace

double StartInC3d(double start_s, double rate_hz, std::size_t frames) {
  return (static_cast<double>(FirstField(start_s, rate_hz, frames)) - 1) / rate_hz;
}

std::string WriteC3d(const MarkerMotion& motion) {
  constexpr std::size_t kMaxWord = 65535;
  constexpr double kMillimetres = 1000;
  // Write the header block.
  const std::size_t blocks = ParameterSection(motion, 0).size() / kC3dBlock;
  const std::size_t data_block = 2 + blocks;
  std::string bytes("\x02\x50", 2);
  PutWord(bytes, motion.names.size());
  PutWord(bytes, 0);  // number of analogue values
  PutWord(bytes, std::min(FirstField(motion), kMaxWord));
  PutWord(bytes, std::min(FirstField(motion) + motion.frames.size() - 1, kMaxWord));
  PutWord(bytes, 0);  // maximal interpolation gap
  PutFloat(bytes, -1);
  PutWord(bytes, data_block);
  PutWord(bytes, 0);
  PutFloat(bytes, motion.rate_hz);
  PadToBlock(bytes);
  // Write the parameters and the points.
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

std::string WriteC3d(const BodyMotion& motion) { return WriteC3d(JointMarkers(motion, 0)); }

}  // namespace etude
