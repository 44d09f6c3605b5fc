#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/document/fields.h"
#include "io/files/json.h"

namespace etude {

/// Reads one object of an answer by key and type, as `Fields` reads a scenario: keeps the first complaint and
/// goes on with defaults, so that reading code is a plain list of its keys. Complaints name the place within the
/// answer: "events[2].score: \"high\" is not a number".
class AnswerFields {
 public:
  /// Reads the object `json`, which must outlive this. `path` is where it stands in the answer; "" is the answer
  /// itself.
  explicit AnswerFields(const Json& json, std::string path = "");

  /// Tells whether the key is there, and marks it as known.
  bool Has(std::string_view key);
  /// Gives what stands under the key, whatever its type; null when it is absent.
  const Json* Raw(std::string_view key);
  int Integer(std::string_view key, int lowest, int highest);
  /// Reads a whole number, or nothing where null stands. The key must be there.
  std::optional<int> NullableInteger(std::string_view key, int lowest, int highest);
  double Number(std::string_view key, Range range);
  bool Boolean(std::string_view key, bool fallback);
  /// Reads a text that is not empty and has at most `longest` bytes.
  std::string Text(std::string_view key, std::size_t longest);
  std::string Choice(std::string_view key, const std::vector<std::string>& allowed, std::string_view fallback);
  std::string RequiredChoice(std::string_view key, const std::vector<std::string>& allowed);
  /// Reads the array under `key`, of a length within the range; it is empty when the key is absent and `fewest` is 0.
  const Json& List(std::string_view key, std::size_t fewest, std::size_t most);

  /// Names a key within the answer: "events[2].score".
  std::string PathOf(std::string_view key) const;
  /// Names an element of the list under `key`: "events[2]".
  std::string PathOf(std::string_view key, std::size_t index) const;

  /// Notes an error of the caller's own; only the first one is kept.
  void Note(const Error& error);
  /// Gives the first complaint, or names an unknown key, or succeeds.
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

/// Shows a value of an answer as complaints do: its JSON, shortened.
std::string ShowJson(const Json& json);

/// Reads a whole number within the range. Refuses anything else, naming `path`.
Result<int> ReadInteger(const Json& json, const std::string& path, int lowest, int highest);
/// Reads the numbers of an array. Refuses, naming `path`, another count than `count`, and whatever is not a finite
/// number within `range`.
Result<std::vector<double>> ReadNumbers(const Json& json, const std::string& path, std::size_t count, Range range);

}  // namespace etude
