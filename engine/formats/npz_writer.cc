#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "engine/formats/npz.h"

namespace etude {
namespace {

void Put(std::string& bytes, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xffU);
}

/// The sum that ZIP files check members by.
std::uint32_t Crc32(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> made{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) value = (value >> 1U) ^ ((value & 1U) != 0 ? 0xedb88320U : 0U);
      made[i] = value;
    }
    return made;
  }();
  std::uint32_t sum = 0xffffffffU;
  for (const char c : bytes) sum = table[(sum ^ static_cast<unsigned char>(c)) & 0xffU] ^ (sum >> 8U);
  return ~sum;
}

std::string Npy(const std::string& type, const std::vector<std::size_t>& shape, std::string_view data) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (";
  for (const std::size_t size : shape) header += std::to_string(size) + ", ";
  header += "), }";
  constexpr std::size_t kAligned = 64, kBefore = 10;
  header.resize((kBefore + header.size() + 1 + kAligned - 1) / kAligned * kAligned - kBefore - 1, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  Put(bytes, header.size(), 2);
  return bytes + header + std::string(data);
}

std::string NpyOfNumbers(const NumberArray& array) {
  std::string data;
  data.reserve(8 * array.values.size());
  for (const double value : array.values) Put(data, std::bit_cast<std::uint64_t>(value), 8);
  return Npy("<f8", array.shape, data);
}

/// Texts of ASCII, as NumPy has them: four bytes a letter, all of one length.
std::string NpyOfTexts(const std::vector<std::string>& texts) {
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, text.size());
  std::string data;
  for (const std::string& text : texts) {
    for (std::size_t i = 0; i < width; ++i) Put(data, i < text.size() ? static_cast<unsigned char>(text[i]) : 0, 4);
  }
  return Npy("<U" + std::to_string(width), {texts.size()}, data);
}

/// Returns what a member's own head and the directory both say of it.
std::string MemberFacts(const std::string& name, std::string_view bytes) {
  constexpr std::uint64_t kVersion = 20, kFirstDay = 0x21;  // 1 January 1980: no clock is read
  std::string facts;
  Put(facts, kVersion, 2);
  Put(facts, 0, 2);  // flags
  Put(facts, 0, 2);  // stored
  Put(facts, 0, 2);
  Put(facts, kFirstDay, 2);
  Put(facts, Crc32(bytes), 4);
  Put(facts, bytes.size(), 4);
  Put(facts, bytes.size(), 4);
  Put(facts, name.size(), 2);
  Put(facts, 0, 2);
  return facts;
}

}  // namespace

std::string WriteNpz(const std::map<std::string, NumberArray>& numbers,
                     const std::map<std::string, std::vector<std::string>>& texts) {
  std::map<std::string, std::string> members;
  for (const auto& [name, array] : numbers) members[name + ".npy"] = NpyOfNumbers(array);
  for (const auto& [name, array] : texts) members[name + ".npy"] = NpyOfTexts(array);
  std::string file, directory;
  for (const auto& [name, bytes] : members) {
    const std::string facts = MemberFacts(name, bytes);
    directory += "PK\x01\x02";
    Put(directory, 20, 2);
    directory += facts;
    directory.append(2 + 2 + 2 + 4, '\0');  // no remark, first disk, no attributes
    Put(directory, file.size(), 4);
    directory += name;
    file += "PK\x03\x04" + facts + name + bytes;
  }
  const std::size_t start = file.size();
  file += directory + "PK\x05\x06";
  Put(file, 0, 4);
  Put(file, members.size(), 2);
  Put(file, members.size(), 2);
  Put(file, directory.size(), 4);
  Put(file, start, 4);
  Put(file, 0, 2);
  return file;
}

}  // namespace etude
