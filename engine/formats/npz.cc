#include "engine/formats/npz.h"

#include <zip.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "engine/base/names.h"
#include "engine/base/npy_head.h"

namespace etude {
namespace {

constexpr std::size_t kMaxMembers = 1000;
constexpr std::uint64_t kMaxUnpacked = std::uint64_t{512} << 20;
constexpr std::uint64_t kMaxDeflateRatio = 1032;  ///< DEFLATE expands one byte to at most this many

/// Returns the value of a key in the header's Python dictionary: the text up to `end`.
std::string_view ValueOf(std::string_view header, std::string_view key, char end) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) return {};
  header.remove_prefix(at + key.size());
  return header.substr(0, header.find(end));
}

/// A number in IEEE 754's format binary16.
struct Half {
  std::uint16_t bits;
  explicit operator double() const {
    const int exponent = bits >> 10 & 31, fraction = bits & 1023;
    double size = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
    if (exponent == 31) {
      size = fraction == 0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
    }
    return bits >> 15 == 0 ? size : -size;
  }
};

template <typename Number>
void Append(std::string_view bytes, std::vector<double>& values) {
  values.resize(bytes.size() / sizeof(Number));
  const char* at = bytes.data();
  for (double& value : values) {
    Number number;
    std::memcpy(&number, at, sizeof number);
    value = static_cast<double>(number);
    at += sizeof number;
  }
}

/// Reads the numbers of a type such as "<f4" or ">i2"; nullopt if they are not numbers.
std::optional<std::vector<double>> NumbersOf(std::string_view type, std::string_view bytes) {
  using Reader = void (*)(std::string_view, std::vector<double>&);
  constexpr std::pair<std::string_view, Reader> kReaders[] = {
      {"f8", Append<double>},        {"f4", Append<float>},         {"f2", Append<Half>},
      {"i8", Append<std::int64_t>},  {"i4", Append<std::int32_t>},  {"i2", Append<std::int16_t>},
      {"u8", Append<std::uint64_t>}, {"u4", Append<std::uint32_t>}, {"u2", Append<std::uint16_t>},
      {"i1", Append<std::int8_t>},   {"u1", Append<std::uint8_t>},  {"b1", Append<std::uint8_t>}};
  if (type.size() != 3) return std::nullopt;
  const auto* const reader = std::ranges::find(kReaders, type.substr(1), &std::pair<std::string_view, Reader>::first);
  if (reader == std::end(kReaders)) return std::nullopt;
  std::vector<double> values;
  if (type[0] != '>') {
    reader->second(bytes, values);
    return values;
  }
  // Reverse the bytes of big-endian numbers.
  const auto size = static_cast<std::size_t>(type[2] - '0');
  std::string turned(bytes.substr(0, bytes.size() / size * size));
  for (auto at = turned.begin(); at != turned.end(); at += static_cast<std::ptrdiff_t>(size)) {
    std::reverse(at, at + static_cast<std::ptrdiff_t>(size));
  }
  reader->second(turned, values);
  return values;
}

/// Converts numbers from Fortran order (the first index varies fastest) to C order.
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

/// The two parts of an .npy file: a Python dictionary, and the values.
struct NpyParts {
  std::string_view header, data;
};

Result<NpyParts> SplitNpy(std::string_view bytes, const std::string& file) {
  const Place place{file};
  if (!bytes.starts_with(kNpyMagic) || bytes.size() < 12) return Fail(place, "is not a .npy file");
  const bool is_first = bytes[6] == 1;  // later versions give the header's length in four bytes
  const std::size_t length_bytes = is_first ? 2 : 4, head = 8 + length_bytes;
  std::size_t length = 0;
  for (std::size_t i = 0; i < length_bytes; ++i)
    length |= std::size_t{static_cast<unsigned char>(bytes[8 + i])} << (8 * i);
  if (length > bytes.size() - head) return Fail(place, "the array's header ends too early");
  return NpyParts{bytes.substr(head, length), bytes.substr(head + length)};
}

std::string_view TypeOf(const NpyParts& parts) { return ValueOf(parts.header, "'descr': '", '\''); }

/// Returns the texts of an array of fixed-length strings (four bytes per letter); an empty list for arrays of another
/// type.
std::vector<std::string> TextsOf(const NpyParts& parts) {
  const std::string_view type = TypeOf(parts);
  std::size_t letters = 0;
  if (type.starts_with("<U")) std::from_chars(type.data() + 2, type.data() + type.size(), letters);
  if (letters == 0) return {};
  std::vector<std::string> texts(parts.data.size() / 4 / letters);
  for (std::size_t i = 0; i < texts.size() * letters; ++i) {
    std::uint32_t letter = 0;
    std::memcpy(&letter, parts.data.data() + 4 * i, sizeof letter);
    if (letter != 0) texts[i / letters] += letter < 128 ? static_cast<char>(letter) : '?';
  }
  return texts;
}

/// Reads the numbers of an .npy file; returns nullopt if its values are not plain numbers.
Result<std::optional<NumberArray>> NumbersIn(const NpyParts& parts, const std::string& file) {
  const Place place{file};
  const auto [header, data] = parts;
  NumberArray array;
  std::size_t count = 1;
  const std::string_view shape = ValueOf(header, "'shape': (", ')');
  for (std::size_t at = 0; (at = shape.find_first_not_of(" ,", at)) != std::string_view::npos;) {
    std::size_t size = 0;
    const auto [end, error] = std::from_chars(shape.data() + at, shape.data() + shape.size(), size);
    if (error != std::errc() || size > kMaxUnpacked) return Fail(place, "its shape is {}", Quote(shape));
    if (size != 0 && count > kMaxUnpacked / size) return Fail(place, "the array has more numbers than Etude can read");
    array.shape.push_back(size);
    count *= size;
    at = static_cast<std::size_t>(end - shape.data());
  }
  auto values = NumbersOf(TypeOf(parts), data);
  if (!values) return std::optional<NumberArray>();
  if (values->size() != count)
    return Fail(place, "the array has {} numbers, but its shape requires {}", values->size(), count);
  const bool is_fortran = ValueOf(header, "'fortran_order': ", ',') == "True";
  array.values = is_fortran ? InOrderOfC(*values, array.shape) : std::move(*values);
  return std::optional(std::move(array));
}

using Archive = std::unique_ptr<zip_t, decltype(&zip_discard)>;

/// Unpacks a member. `left` is the number of bytes that may still be unpacked.
Result<std::string> Unpack(zip_t* archive, zip_uint64_t member, std::uint64_t& left, const std::string& file) {
  zip_stat_t status;
  zip_stat_init(&status);
  if (zip_stat_index(archive, member, 0, &status) != 0 || (status.valid & ZIP_STAT_SIZE) == 0) {
    return Fail({file}, "member {} has no size", member);
  }
  if (status.size > left)
    return Fail({file}, "the unpacked file has more than {} MiB; allowed: at most this size", kMaxUnpacked >> 20);
  if ((status.valid & ZIP_STAT_COMP_SIZE) != 0 && status.size / kMaxDeflateRatio > status.comp_size) {
    return Fail({file}, "member {} states that {} bytes unpack to {} bytes, which is impossible", member,
                status.comp_size, status.size);
  }
  left -= status.size;
  std::string bytes(status.size, '\0');
  const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> opened(zip_fopen_index(archive, member, 0), &zip_fclose);
  const bool is_read =
      opened && zip_fread(opened.get(), bytes.data(), status.size) == static_cast<zip_int64_t>(status.size);
  // Reading one more byte makes the library compare the checksums.
  char more = 0;
  if (!is_read || zip_fread(opened.get(), &more, 1) != 0) return Fail({file}, "member {} is damaged", member);
  return bytes;
}

template <typename Number>
void Put(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

std::string NpyOfNumbers(const NumberArray& array) {
  std::string bytes = NpyHead("<f8", array.shape);
  bytes.reserve(bytes.size() + 8 * array.values.size());
  for (const double value : array.values) Put(bytes, value);
  return bytes;
}

/// Writes ASCII texts in NumPy's form: four bytes for each letter, all texts of one length.
std::string NpyOfTexts(const std::vector<std::string>& texts) {
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, text.size());
  std::string bytes = NpyHead("<U" + std::to_string(width), std::vector{texts.size()});
  for (const std::string& text : texts) {
    for (std::size_t i = 0; i < width; ++i) {
      Put<std::uint32_t>(bytes, i < text.size() ? static_cast<unsigned char>(text[i]) : 0);
    }
  }
  return bytes;
}

/// Returns `made`, a result of the ZIP library. Throws std::bad_alloc if it is null, because writing into memory can
/// only fail for lack of memory.
template <typename Made>
Made Needed(Made made) {
  if (!made) throw std::bad_alloc();
  return made;
}

using Source = std::unique_ptr<zip_source_t, decltype(&zip_source_free)>;

}  // namespace

bool IsNpy(std::string_view bytes) { return bytes.starts_with(kNpyMagic); }

Result<NumberArray> ReadNpy(std::string_view bytes, const std::string& file) {
  ASSIGN_OR_RETURN(const auto parts, SplitNpy(bytes, file));
  ASSIGN_OR_RETURN(auto array, NumbersIn(parts, file));
  if (!array)
    return Fail({file}, "the array contains other data than numbers; allowed: floating-point numbers and integers");
  return *std::move(array);
}

bool IsZip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

const NumberArray* Npz::Find(const std::string& name) const {
  const auto found = arrays.find(name);
  return found == arrays.end() ? nullptr : &found->second;
}

bool Npz::Contains(const std::string& name) const {
  return arrays.contains(name) || texts.contains(name) || std::ranges::find(skipped, name) != skipped.end();
}

Result<std::optional<ArrayRate>> RateOfArrays(const Npz& arrays, const std::string& file) {
  std::optional<ArrayRate> found;
  for (const char* name : {"rate_hz", "fps", "framerate", "frame_rate", "mocap_framerate", "mocap_frame_rate"}) {
    if (!arrays.Contains(name)) continue;
    const NumberArray* rate = arrays.Find(name);
    if (rate == nullptr || rate->values.size() != 1) {
      return Fail({file},
                  "the array {} must be a single number, the frames per second; otherwise use `--rate` (for `etude "
                  "clip convert`: `--file-rate`; in a joint map: `rate: 30`)",
                  name);
    }
    const double value = rate->values[0];
    if (found && found->rate_hz != value) {
      return Fail({file},
                  "the file states two rates: {} is {:g} and {} is {:g}; allowed: one rate, or `--rate` (for `etude "
                  "clip convert`: `--file-rate`; in a joint map: `rate: 30`)",
                  found->name, found->rate_hz, name, value);
    }
    if (!found) found = ArrayRate{value, name};
  }
  return found;
}

std::string NamesOfArrays(const Npz& npz) {
  constexpr std::size_t kListed = 20;
  std::vector<std::string> names;
  for (const auto& [name, array] : npz.arrays) names.push_back(name);
  for (const std::string& name : npz.skipped) names.push_back(name + " (no plain numbers)");
  if (names.empty()) return "none";
  const std::size_t more = names.size() - std::min(names.size(), kListed);
  names.resize(names.size() - more);
  return Join(names) + (more > 0 ? fmt::format(" and {} more", more) : "");
}

std::string ShapeText(const NumberArray& array) {
  std::vector<std::string> sizes;
  for (const std::size_t size : array.shape) sizes.push_back(std::to_string(size));
  return array.shape.empty() ? "one number" : Join(sizes, " × ");
}

Result<Npz> ReadNpz(std::string_view bytes, const std::string& file) {
  // Open the archive.
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  Archive archive(source == nullptr ? nullptr : zip_open_from_source(source, ZIP_RDONLY, &error), &zip_discard);
  if (!archive) {
    if (source != nullptr) zip_source_free(source);
    auto failed = Fail({file}, "not a readable ZIP file: {}", zip_error_strerror(&error));
    zip_error_fini(&error);
    return failed;
  }
  const zip_int64_t members = zip_get_num_entries(archive.get(), 0);
  if (members < 0 || static_cast<std::size_t>(members) > kMaxMembers) {
    return Fail({file}, "found {} members; allowed: at most {}", members, kMaxMembers);
  }
  // Read every .npy member, and remember the first member of another kind for the error message.
  Npz read;
  std::string others;
  std::uint64_t left = kMaxUnpacked;
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
    ASSIGN_OR_RETURN(const auto parts, SplitNpy(unpacked, file + "/" + key));
    ASSIGN_OR_RETURN(auto array, NumbersIn(parts, file + "/" + key));
    if (array) {
      read.arrays[key] = std::move(*array);
    } else {
      read.skipped.push_back(key);
      if (auto texts = TextsOf(parts); !texts.empty()) read.texts[key] = std::move(texts);
    }
  }
  if (!others.empty() && read.arrays.empty() && read.skipped.empty()) {
    return Fail({file},
                "the file is a ZIP file without arrays (.npy), and its first member is {}; unpack the ZIP file first",
                Quote(others));
  }
  return read;
}

std::string WriteNpz(const std::map<std::string, NumberArray>& numbers,
                     const std::map<std::string, std::vector<std::string>>& texts) {
  std::map<std::string, std::string> members;
  for (const auto& [name, array] : numbers) members[name + ".npy"] = NpyOfNumbers(array);
  for (const auto& [name, array] : texts) members[name + ".npy"] = NpyOfTexts(array);

  const Source whole(Needed(zip_source_buffer_create(nullptr, 0, 0, nullptr)), &zip_source_free);
  // Keep a second reference to the source: closing the archive frees the first one, and the written bytes are read
  // through the second.
  zip_source_keep(whole.get());
  Archive archive(Needed(zip_open_from_source(whole.get(), ZIP_CREATE | ZIP_TRUNCATE, nullptr)), &zip_discard);
  for (const auto& [name, bytes] : members) {
    zip_source_t* const member = Needed(zip_source_buffer(archive.get(), bytes.data(), bytes.size(), 0));
    const zip_int64_t at = zip_file_add(archive.get(), name.c_str(), member, ZIP_FL_ENC_UTF_8);
    constexpr zip_uint16_t kFirstDay = 0x21;  // 1 January 1980, so that the bytes do not depend on the date
    const auto index = static_cast<zip_uint64_t>(at);
    Needed(at >= 0 && zip_set_file_compression(archive.get(), index, ZIP_CM_STORE, 0) == 0 &&
           zip_file_set_dostime(archive.get(), index, 0, kFirstDay, 0) == 0);
  }
  Needed(zip_close(archive.get()) == 0);
  archive.release();  // zip_close has freed it

  zip_stat_t status;
  zip_stat_init(&status);
  Needed(zip_source_stat(whole.get(), &status) == 0 && zip_source_open(whole.get()) == 0);
  std::string file(status.size, '\0');
  Needed(zip_source_read(whole.get(), file.data(), file.size()) == static_cast<zip_int64_t>(file.size()));
  zip_source_close(whole.get());
  return file;
}

}  // namespace etude
