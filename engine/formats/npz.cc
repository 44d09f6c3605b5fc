#include "engine/formats/npz.h"

#include <zip.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>

#include "engine/base/names.h"

namespace etude {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kMostMembers = 1000;
constexpr std::uint64_t kMostUnpacked = std::uint64_t{512} << 20;
constexpr std::uint64_t kMostOfAByte = 1032;  ///< DEFLATE makes no more of one

/// Returns what follows a key of the header's Python dictionary, up to `end`.
std::string_view ValueOf(std::string_view header, std::string_view key, char end) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) return {};
  header.remove_prefix(at + key.size());
  return header.substr(0, header.find(end));
}

template <typename Number>
void Append(std::string_view bytes, std::vector<double>& values) {
  for (std::size_t at = 0; at + sizeof(Number) <= bytes.size(); at += sizeof(Number)) {
    Number number;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    values.push_back(static_cast<double>(number));
  }
}

/// Reads the numbers of a type such as "<f4"; nothing when they are none.
std::optional<std::vector<double>> NumbersOf(std::string_view type, std::string_view bytes) {
  std::vector<double> values;
  if (type == "<f8") {
    Append<double>(bytes, values);
  } else if (type == "<f4") {
    Append<float>(bytes, values);
  } else if (type == "<i8") {
    Append<std::int64_t>(bytes, values);
  } else if (type == "<i4") {
    Append<std::int32_t>(bytes, values);
  } else if (type == "<u4") {
    Append<std::uint32_t>(bytes, values);
  } else if (type == "<i2") {
    Append<std::int16_t>(bytes, values);
  } else if (type == "|u1" || type == "|b1") {
    Append<std::uint8_t>(bytes, values);
  } else {
    return std::nullopt;
  }
  return values;
}

/// Numbers in Fortran's order, whose first index runs fastest, in C's.
std::vector<double> InOrderOfC(const std::vector<double>& values, const std::vector<std::size_t>& shape) {
  std::vector<double> ordered(values.size());
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    std::size_t rest = i, stride = values.size(), from = 0;
    for (std::size_t d = shape.size(); d-- > 0; rest /= shape[d]) {
      stride /= shape[d];
      from += stride * (rest % shape[d]);
    }
    ordered[i] = values[from];
  }
  return ordered;
}

/// Reads an .npy file; nothing when it holds no plain numbers.
Result<std::optional<NumberArray>> ReadMember(std::string_view bytes, const std::string& file) {
  const Place place{file};
  if (!bytes.starts_with(kMagic) || bytes.size() < 12) return Fail(place, "is no .npy file");
  const bool is_first = bytes[6] == 1;  // later versions tell the header's length by four bytes
  const std::size_t length_bytes = is_first ? 2 : 4, head = 8 + length_bytes;
  std::size_t length = 0;
  for (std::size_t i = 0; i < length_bytes; ++i)
    length |= std::size_t{static_cast<unsigned char>(bytes[8 + i])} << (8 * i);
  if (length > bytes.size() - head) return Fail(place, "its header is cut short");
  const std::string_view header = bytes.substr(head, length), data = bytes.substr(head + length);
  NumberArray array;
  std::size_t count = 1;
  const std::string_view shape = ValueOf(header, "'shape': (", ')');
  for (std::size_t at = 0; (at = shape.find_first_not_of(" ,", at)) != std::string_view::npos;) {
    std::size_t size = 0;
    const auto [end, error] = std::from_chars(shape.data() + at, shape.data() + shape.size(), size);
    if (error != std::errc() || size > kMostUnpacked) return Fail(place, "its shape is {}", Quote(shape));
    if (size != 0 && count > kMostUnpacked / size) return Fail(place, "is larger than it can be");
    array.shape.push_back(size);
    count *= size;
    at = static_cast<std::size_t>(end - shape.data());
  }
  auto values = NumbersOf(ValueOf(header, "'descr': '", '\''), data);
  if (!values) return std::optional<NumberArray>();
  if (values->size() != count) return Fail(place, "holds {} numbers; its shape says {}", values->size(), count);
  const bool is_fortran = ValueOf(header, "'fortran_order': ", ',') == "True";
  array.values = is_fortran ? InOrderOfC(*values, array.shape) : std::move(*values);
  return std::optional(std::move(array));
}

using Archive = std::unique_ptr<zip_t, decltype(&zip_discard)>;

/// Unpacks a member; `left` is what may still be unpacked.
Result<std::string> Unpack(zip_t* archive, zip_uint64_t member, std::uint64_t& left, const std::string& file) {
  zip_stat_t status;
  zip_stat_init(&status);
  if (zip_stat_index(archive, member, 0, &status) != 0 || (status.valid & ZIP_STAT_SIZE) == 0) {
    return Fail({file}, "member {} has no size", member);
  }
  if (status.size > left) return Fail({file}, "unpacks to more than {} MiB", kMostUnpacked >> 20);
  if ((status.valid & ZIP_STAT_COMP_SIZE) != 0 && status.size / kMostOfAByte > status.comp_size) {
    return Fail({file}, "member {} says that it unpacks {} bytes to {}", member, status.comp_size, status.size);
  }
  left -= status.size;
  std::string bytes(status.size, '\0');
  const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> opened(zip_fopen_index(archive, member, 0), &zip_fclose);
  const bool is_read =
      opened && zip_fread(opened.get(), bytes.data(), status.size) == static_cast<zip_int64_t>(status.size);
  // One byte more makes the library compare the sums.
  char more = 0;
  if (!is_read || zip_fread(opened.get(), &more, 1) != 0) return Fail({file}, "member {} is damaged", member);
  return bytes;
}

}  // namespace

bool IsNpy(std::string_view bytes) { return bytes.starts_with(kMagic); }

Result<NumberArray> ReadNpy(std::string_view bytes, const std::string& file) {
  ASSIGN_OR_RETURN(auto array, ReadMember(bytes, file));
  if (!array) return Fail({file}, "holds no plain numbers; allowed: floats and whole numbers, little-endian");
  return *std::move(array);
}

bool IsZip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

Result<Npz> ReadNpz(std::string_view bytes, const std::string& file) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  Archive archive(source == nullptr ? nullptr : zip_open_from_source(source, ZIP_RDONLY, &error), &zip_discard);
  if (!archive) {
    if (source != nullptr) zip_source_free(source);
    auto failed = Fail({file}, "no ZIP file that can be read: {}", zip_error_strerror(&error));
    zip_error_fini(&error);
    return failed;
  }
  const zip_int64_t members = zip_get_num_entries(archive.get(), 0);
  if (members < 0 || static_cast<std::size_t>(members) > kMostMembers) {
    return Fail({file}, "{} members; allowed: {}", members, kMostMembers);
  }
  Npz read;
  std::string others;
  std::uint64_t left = kMostUnpacked;
  for (zip_uint64_t i = 0; i < static_cast<zip_uint64_t>(members); ++i) {
    const char* name = zip_get_name(archive.get(), i, 0);
    std::string key = name == nullptr ? "" : name;
    constexpr std::string_view kEnding = ".npy";
    if (!key.ends_with(kEnding)) {
      if (others.empty()) others = key;
      continue;
    }
    key.resize(key.size() - kEnding.size());
    ASSIGN_OR_RETURN(const auto unpacked, Unpack(archive.get(), i, left, file));
    ASSIGN_OR_RETURN(auto array, ReadMember(unpacked, file + "/" + key));
    if (array) {
      read.arrays[key] = std::move(*array);
    } else {
      read.skipped.push_back(key);
    }
  }
  if (!others.empty() && read.arrays.empty() && read.skipped.empty()) {
    return Fail({file}, "a ZIP file that begins with {} and holds no arrays (.npy): unpack it", Quote(others));
  }
  return read;
}

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
