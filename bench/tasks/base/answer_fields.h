#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/document/fields.h"
#include "io/files/json.h"

namespace etude {

/// Reads one object of an answer by key and type. It keeps the first error and goes on with defaults, so that the
/// calling code is a plain list of keys. (`Fields` does the same for scenarios.) Errors name the position within the
/// answer: "events[2].score: \"high\" is not a number".
class AnswerFields {
 public:
  /// Reads the object `json`, which must outlive this object. `path` is the position of `json` in the answer; it is
  /// empty if `json` is the whole answer.
  explicit AnswerFields(const Json& json, std::string path = "");

  /// Returns true if the key exists, and marks it as known.
  bool Has(std::string_view key);
  /// Returns the value of the key, of any type; null if it is absent.
  const Json* Raw(std::string_view key);
  int Integer(std::string_view key, int lowest, int highest);
  /// Reads an integer. Returns nothing if the value is null. The key must exist.
  std::optional<int> NullableInteger(std::string_view key, int lowest, int highest);
  double Number(std::string_view key, Range range);
  bool Boolean(std::string_view key, bool fallback);
  /// Reads a non-empty text of at most `longest` bytes.
  std::string Text(std::string_view key, std::size_t longest);
  std::string Choice(std::string_view key, const std::vector<std::string>& allowed, std::string_view fallback);
  std::string RequiredChoice(std::string_view key, const std::vector<std::string>& allowed);
  /// Reads the array of `key`, whose length must be in the range. Returns an empty array if the key is absent and
  /// `fewest` is 0.
  const Json& List(std::string_view key, std::size_t fewest, std::size_t most);

  /// Returns the path of a key within the answer: "events[2].score".
  std::string PathOf(std::string_view key) const;
  /// Returns the path of an element of a list: "events[2]".
  std::string PathOf(std::string_view key, std::size_t index) const;

  /// Records an error found by the caller; only the first error is kept.
  void Note(const Error& error);
  /// Returns the first error, or else an error for the first unknown key. Succeeds if there is neither.
  Result<void> Finish();

 private:
  std::string OneOf(std::string_view key, const Json& value, const std::vector<std::string>& allowed);
  const Json* Find(std::string_view key);
  const Json* Require(std::string_view key);
  void Complain(std::string_view key, const std::string& message);

  const Json& json_;
  std::string path_;
  std::vector<std::string> known_;
  std::optional<Error> error_;
};

/// Returns a value of an answer as error messages show it: its JSON, shortened.
std::string ShowJson(const Json& json);

/// Reads an integer in the range. Fails on any other value; the error names `path`.
Result<int> ReadInteger(const Json& json, const std::string& path, int lowest, int highest);
/// Reads an array of `count` numbers. Fails if the count differs, or if a value is not a finite number in `range`; the
/// error names `path`.
Result<std::vector<double>> ReadNumbers(const Json& json, const std::string& path, std::size_t count, Range range);

}  // namespace etude
