#include "engine/formats/c3d_parameters.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "engine/base/text.h"

namespace etude {

int C3dBytes::Integer(std::size_t at) const { return static_cast<std::int16_t>(Word(at)); }

double C3dBytes::Float(std::size_t at) const {
  std::uint32_t bits = Word(at + 2) << 16 | Word(at);
  if (machine_ != C3dMachine::kIntel) bits = Word(at) << 16 | Word(at + 2);
  // A DEC float has an exponent bias larger by one than an IEEE float, and a mantissa in [½, 1). The bits of a DEC
  // float, read as an IEEE float, therefore give 4 times its value.
  return machine_ == C3dMachine::kDec ? std::bit_cast<float>(bits) / 4 : std::bit_cast<float>(bits);
}

std::string C3dBytes::Text(std::size_t at, std::size_t length) const {
  if (at >= bytes_.size()) return "";
  std::string text(bytes_.substr(at, length));
  text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

std::size_t C3dParameters::Parameter::Count() const {
  std::size_t count = 1;
  for (const std::size_t size : sizes) count *= size;
  return count;
}

C3dParameters::C3dParameters(const C3dBytes& bytes, std::size_t at) : bytes_(bytes) {
  // Read the records, which are groups and parameters.
  std::map<int, std::string> group_names;
  std::vector<std::pair<int, std::pair<std::string, Parameter>>> found;
  const std::size_t end = std::min(bytes.size(), at + kC3dBlock * std::max(1u, bytes.Byte(at + 2)));
  // Some files state a wrong number of blocks, so follow the chain of records to its last record or to the end of the
  // file.
  for (std::size_t record = at + 4; record + 4 < std::max(end, bytes.size());) {
    const auto length = static_cast<std::int8_t>(bytes.Byte(record));
    const auto id = static_cast<std::int8_t>(bytes.Byte(record + 1));
    const auto letters = static_cast<std::size_t>(std::abs(length));
    if (letters == 0 || id == 0) break;
    const std::string name = InUpperCase(bytes.Text(record + 2, letters));
    const std::size_t offset_at = record + 2 + letters;
    if (id < 0) {
      group_names[-id] = name;
    } else {
      Parameter parameter{.type = static_cast<std::int8_t>(bytes.Byte(offset_at + 2)), .sizes = {}};
      const std::size_t dimensions = std::min(bytes.Byte(offset_at + 3), 7u);
      for (std::size_t d = 0; d < dimensions; ++d) parameter.sizes.push_back(bytes.Byte(offset_at + 4 + d));
      parameter.at = offset_at + 4 + dimensions;
      found.push_back({id, {name, parameter}});
    }
    const std::size_t offset = bytes.Word(offset_at);
    if (offset == 0) break;
    record = offset_at + offset;
  }
  // A group's record may follow the records of its parameters, so combine the names after all records are read.
  for (auto& [group, named] : found) all_[group_names[group] + ":" + named.first] = named.second;
}

const C3dParameters::Parameter* C3dParameters::Find(const std::string& name) const {
  const auto found = all_.find(name);
  return found == all_.end() ? nullptr : &found->second;
}

std::optional<double> C3dParameters::Number(const std::string& name, std::size_t index) const {
  const Parameter* one = Find(name);
  if (one == nullptr || index >= one->Count()) return std::nullopt;
  if (one->type == 4) return bytes_.Float(one->at + 4 * index);
  // Read words as unsigned, because some files hold counts above 32,767.
  if (one->type == 2) return bytes_.Word(one->at + 2 * index);
  if (one->type == 1) return bytes_.Byte(one->at + index);
  return std::nullopt;
}

std::vector<std::string> C3dParameters::Texts(const std::string& name, std::size_t most) const {
  const Parameter* one = Find(name);
  std::vector<std::string> texts;
  if (one == nullptr || one->type != -1 || one->sizes.empty()) return texts;
  const std::size_t length = one->sizes[0], count = length == 0 ? 0 : std::min(one->Count() / length, most);
  for (std::size_t i = 0; i < count && one->at + i * length < bytes_.size(); ++i) {
    texts.push_back(bytes_.Text(one->at + i * length, length));
  }
  return texts;
}

}  // namespace etude
