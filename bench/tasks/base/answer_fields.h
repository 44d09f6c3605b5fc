#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/files/json.h"
#include "engine/base/result.h"
#include "engine/document/fields.h"

namespace etude {

/// Reads one object of an answer by key and type, as `Fields` reads a scenario: keeps the first complaint and
/// goes on with defaults, so that reading code is a plain list of its keys. Complaints name the place within the
/// answer: "events[2].score: \"high\" is not a number".
class AnswerFields {
 public:
  /// `path` is where the object stands in the answer: "" = it is the answer. `json` must outlive this.
  explicit AnswerFields(const Json& json, std::string path = "");

  /// True when the key is there; marks it as known.
  bool Has(std::string_view key);
  /// The value of the key, whatever its type; null when it is absent.
  const Json* Raw(std::string_view key);
  int Integer(std::string_view key, int lowest, int highest);
  /// Null means nothing; the key must be there.
  std::optional<int> NullableInteger(std::string_view key, int lowest, int highest);
  double Number(std::string_view key, Range range);
  bool Boolean(std::string_view key, bool fallback);
  /// Not empty, at most `longest` bytes.
  std::string Text(std::string_view key, std::size_t longest);
  std::string Choice(std::string_view key, const std::vector<std::string>& allowed, std::string_view fallback);
  std::string RequiredChoice(std::string_view key, const std::vector<std::string>& allowed);
  /// The array under `key`, of a length within the range; an empty one when the key is absent and `fewest` is 0.
  const Json& List(std::string_view key, std::size_t fewest, std::size_t most);

  /// "events[2].score"
  std::string PathOf(std::string_view key) const;
  /// "events[2]": of an element of the list under `key`.
  std::string PathOf(std::string_view key, std::size_t index) const;

  /// Notes an error of the caller's own; only the first one is kept.
  void Note(const Error& error);
  /// The first complaint, or an unknown key, or success.
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

/// A value of an answer as complaints show it: its JSON, shortened.
std::string ShowJson(const Json& json);

/// Refused, naming `path`: whatever is not a whole number in range.
Result<int> ReadInteger(const Json& json, const std::string& path, int lowest, int highest);
/// The numbers of an array, all within `range`. Refused, naming `path`: another count than `count`, whatever is not
/// a finite number in range.
Result<std::vector<double>> ReadNumbers(const Json& json, const std::string& path, std::size_t count, Range range);

}  // namespace etude
