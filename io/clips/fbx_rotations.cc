#include "io/clips/fbx_rotations.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/text.h"

namespace etude {
namespace {

constexpr std::array<std::string_view, 3> kIgnored = {"PreRotation", "PostRotation", "RotationOrder"};
constexpr std::string_view kActive = "RotationActive", kTemplate = "FbxNode", kFbxTextHead = "; FBX";

bool IsIgnored(std::string_view name) { return std::ranges::find(kIgnored, name) != kIgnored.end(); }

/// A range of the file's bytes.
struct FbxRange {
  std::size_t begin = 0, end = 0;
};

// --- Binary files

template <typename Number>
Number NumberAt(std::string_view bytes, std::size_t at) {
  Number number{};
  if (at <= bytes.size() && bytes.size() - at >= sizeof number) std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

/// A node record: the node's name, properties and children.
struct FbxNode {
  std::string_view name;
  FbxRange properties, children;
};

/// Reads the nodes of one level. Stops at the null record, or at a record whose end lies outside `range`.
std::vector<FbxNode> NodesIn(std::string_view bytes, FbxRange range) {
  constexpr std::size_t kVersionAt = 23;
  constexpr std::uint32_t kLongOffsets = 7500;
  const bool is_long = NumberAt<std::uint32_t>(bytes, kVersionAt) >= kLongOffsets;
  const std::size_t word = is_long ? 8 : 4, head = 3 * word + 1;
  const auto offset_at = [&](std::size_t at) -> std::uint64_t {
    return is_long ? NumberAt<std::uint64_t>(bytes, at) : NumberAt<std::uint32_t>(bytes, at);
  };
  std::vector<FbxNode> nodes;
  for (std::size_t at = range.begin; range.end - at >= head;) {
    const std::uint64_t end = offset_at(at), length = offset_at(at + 2 * word);
    const std::size_t name_at = at + head, properties_at = name_at + static_cast<unsigned char>(bytes[at + head - 1]);
    if (end <= at || end > range.end || properties_at > end || length > end - properties_at) break;
    const auto begin = static_cast<std::size_t>(properties_at + length), stop = static_cast<std::size_t>(end);
    nodes.push_back({bytes.substr(name_at, properties_at - name_at), {properties_at, begin}, {begin, stop}});
    at = stop;
  }
  return nodes;
}

/// A "P" record: the property's name, and the position and size of each number of the property.
struct FbxProperty {
  std::string_view name;
  std::vector<FbxRange> numbers;
};

FbxProperty PropertyOf(std::string_view bytes, FbxRange range) {
  FbxProperty property;
  constexpr std::string_view kTypes = "CYIFDL";
  constexpr std::array<std::size_t, kTypes.size()> kSizes = {1, 2, 4, 4, 8, 8};
  bool is_first = true;
  for (std::size_t at = range.begin; at < range.end;) {
    const char type = bytes[at++];
    if (type == 'S') {
      const std::size_t length = NumberAt<std::uint32_t>(bytes, at);
      at += sizeof(std::uint32_t);
      if (at > range.end || length > range.end - at) break;
      if (is_first) property.name = bytes.substr(at, length);
      at += length;
    } else {
      const std::size_t known = kTypes.find(type);
      if (known == std::string_view::npos || range.end - at < kSizes[known]) break;
      property.numbers.push_back({at, at + kSizes[known]});
      at += kSizes[known];
    }
    is_first = false;
  }
  return property;
}

bool IsZero(std::string_view bytes, const FbxProperty& property) {
  return std::ranges::all_of(property.numbers, [&](const FbxRange& number) {
    return bytes.substr(number.begin, number.end - number.begin).find_first_not_of('\0') == std::string_view::npos;
  });
}

/// Reads the entries of a node's table of properties.
std::vector<FbxProperty> TableOf(std::string_view bytes, const FbxNode& node) {
  std::vector<FbxProperty> entries;
  for (const FbxNode& table : NodesIn(bytes, node.children)) {
    if (table.name != "Properties70") continue;
    for (const FbxNode& entry : NodesIn(bytes, table.children)) entries.push_back(PropertyOf(bytes, entry.properties));
  }
  return entries;
}

/// Returns true if the template of models sets RotationActive.
bool IsActiveByTemplate(std::string_view bytes, const FbxNode& definitions) {
  bool is_active = false;
  for (const FbxNode& type : NodesIn(bytes, definitions.children)) {
    for (const FbxNode& preset : NodesIn(bytes, type.children)) {
      if (preset.name != "PropertyTemplate" || PropertyOf(bytes, preset.properties).name != kTemplate) continue;
      for (const FbxProperty& entry : TableOf(bytes, preset)) {
        if (entry.name == kActive) is_active = !IsZero(bytes, entry);
      }
    }
  }
  return is_active;
}

std::size_t LeaveOutOfBinary(std::string_view bytes, std::string& changed) {
  constexpr std::size_t kHeadBytes = 27;
  std::size_t models = 0;
  bool active_by_template = false;
  if (bytes.size() < kHeadBytes) return 0;
  for (const FbxNode& part : NodesIn(bytes, {kHeadBytes, bytes.size()})) {
    if (part.name == "Definitions") active_by_template = IsActiveByTemplate(bytes, part);
    if (part.name != "Objects") continue;
    for (const FbxNode& model : NodesIn(bytes, part.children)) {
      if (model.name != "Model") continue;
      // Collect the model's own properties.
      std::vector<FbxProperty> ignored;
      bool is_active = active_by_template;
      for (FbxProperty& property : TableOf(bytes, model)) {
        if (property.name == kActive) is_active = !IsZero(bytes, property);
        if (IsIgnored(property.name) && !IsZero(bytes, property)) ignored.push_back(std::move(property));
      }
      if (is_active || ignored.empty()) continue;
      // In a copy of the file, overwrite the numbers with zeros; the size stays the same.
      if (changed.empty()) changed = bytes;
      for (const FbxProperty& property : ignored) {
        for (const FbxRange& number : property.numbers) {
          std::fill(changed.begin() + static_cast<std::ptrdiff_t>(number.begin),
                    changed.begin() + static_cast<std::ptrdiff_t>(number.end), '\0');
        }
      }
      ++models;
    }
  }
  return models;
}

// --- Text files

/// Splits 'P: "NAME", "type", "label", "flags",1,2,3' into the name and the range of the numbers in the file.
std::optional<std::pair<std::string_view, FbxRange>> PropertyInLine(std::string_view text, FbxRange line) {
  const std::string_view here = Trimmed(text.substr(line.begin, line.end - line.begin));
  constexpr std::string_view kBegin = "P: \"";
  if (!here.starts_with(kBegin)) return std::nullopt;
  const std::string_view name = here.substr(kBegin.size(), here.find('"', kBegin.size()) - kBegin.size());
  std::size_t at = line.begin;
  for (int comma = 0; comma < 4; ++comma) {
    at = text.find(',', at) + 1;
    if (at == 0 || at > line.end) return std::nullopt;
  }
  return std::pair(name, FbxRange{at, line.end});
}

bool AreZeros(std::string_view numbers) { return numbers.find_first_of("123456789") == std::string_view::npos; }

std::size_t LeaveOutOfText(std::string_view text, std::string& changed) {
  std::vector<FbxRange> zeroed, ignored;
  std::size_t models = 0;
  bool in_model = false, in_template = false, in_table = false, active_by_template = false, is_active = false;
  // Follow the tables of properties of the models and of the model template; collect the ignored numbers that are not
  // zero.
  for (std::size_t begin = 0; begin < text.size();) {
    const FbxRange line{begin, std::min(text.find('\n', begin), text.size())};
    begin = line.end + 1;
    const std::string_view here = Trimmed(text.substr(line.begin, line.end - line.begin));
    if (here.starts_with("Model:")) in_model = true;
    if (here.starts_with("PropertyTemplate:")) in_template = here.find(kTemplate) != std::string_view::npos;
    if ((in_model || in_template) && here.starts_with("Properties70:")) {
      in_table = true;
      is_active = active_by_template;
      ignored.clear();
    } else if (in_table && here == "}") {
      if (in_template) active_by_template = is_active;
      if (in_model && !is_active && !ignored.empty()) {
        ++models;
        zeroed.insert(zeroed.end(), ignored.begin(), ignored.end());
      }
      in_table = in_model = in_template = false;
    } else if (const auto property = in_table ? PropertyInLine(text, line) : std::nullopt) {
      const auto& [name, numbers] = *property;
      const bool are_zeros = AreZeros(text.substr(numbers.begin, numbers.end - numbers.begin));
      if (name == kActive) is_active = !are_zeros;
      if (IsIgnored(name) && !are_zeros) ignored.push_back(numbers);
    }
  }
  if (models == 0) return 0;
  // Copy the text with zeros in place of the numbers.
  std::size_t copied = 0;
  for (const FbxRange& numbers : zeroed) {
    const std::string_view old = text.substr(numbers.begin, numbers.end - numbers.begin);
    changed += text.substr(copied, numbers.begin - copied);
    changed += std::ranges::count(old, ',') == 0 ? "0" : "0,0,0";
    copied = numbers.end;
  }
  changed += text.substr(copied);
  return models;
}

}  // namespace

std::size_t LeaveOutInactiveRotations(std::string_view bytes, std::string& changed) {
  changed.clear();
  return bytes.starts_with(kFbxTextHead) ? LeaveOutOfText(bytes, changed) : LeaveOutOfBinary(bytes, changed);
}

}  // namespace etude
