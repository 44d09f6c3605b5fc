#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

constexpr std::size_t kC3dBlock = 512;  ///< size of a block, bytes

/// The types of processor whose number formats a C3D file may use, with their codes in the file.
enum class C3dMachine { kIntel = 84, kDec = 85, kMips = 86 };

/// Reads numbers in the representation of one kind of machine; bytes beyond the end count as zero.
class C3dBytes {
 public:
  C3dBytes(std::string_view bytes, C3dMachine machine) : bytes_(bytes), machine_(machine) {}

  std::size_t size() const { return bytes_.size(); }
  unsigned Byte(std::size_t at) const { return at < bytes_.size() ? static_cast<unsigned char>(bytes_[at]) : 0; }
  unsigned Word(std::size_t at) const {
    return machine_ == C3dMachine::kMips ? Byte(at) << 8 | Byte(at + 1) : Byte(at + 1) << 8 | Byte(at);
  }
  int Integer(std::size_t at) const;
  double Float(std::size_t at) const;
  std::string Text(std::size_t at, std::size_t length) const;

 private:
  std::string_view bytes_;
  C3dMachine machine_;
};

/// The parameters of a C3D file, with names such as "POINT:USED".
class C3dParameters {
 public:
  /// Reads the parameter section that begins at byte `at`.
  C3dParameters(const C3dBytes& bytes, std::size_t at);

  std::optional<double> Number(const std::string& name, std::size_t index = 0) const;
  /// Returns at most the first `most` texts of a list, without the texts that begin beyond the file's end. A single
  /// text counts as a list of one.
  std::vector<std::string> Texts(const std::string& name, std::size_t most = 1) const;

 private:
  struct Parameter {
    int type = 0;  ///< −1: text, 1: bytes, 2: whole numbers, 4: floats
    std::vector<std::size_t> sizes;
    std::size_t at = 0;  ///< position of the first value

    std::size_t Count() const;
  };
  const Parameter* Find(const std::string& name) const;

  C3dBytes bytes_;
  std::map<std::string, Parameter> all_;
};

}  // namespace etude
