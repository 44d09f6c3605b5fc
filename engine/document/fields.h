#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/document/node.h"

namespace etude {

/// The closed interval in which a number must lie.
struct Range {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
};

/// Reads the keys of one mapping by name and type. It keeps the first error and continues with defaults, so that
/// reading code is a plain list of keys. At the end, `Finish` returns this error, or an error about a key that was not
/// read (with the nearest known key).
///
///     Fields fields(node, "an ik scenario");
///     options.trials = fields.Integer("trials", 100, {1, 100000});
///     options.start = fields.Choice("start", {"near", "cold"}, "near");
///     RETURN_IF_ERROR(fields.Finish());
class Fields {
 public:
  /// `what` names the mapping in error messages, e.g. "a method of task ik". `node` must outlive this object.
  Fields(const Node& node, std::string what);

  /// Each of these functions returns the value of `key`. If the key is absent or its value is refused, the function
  /// returns `fallback`, or, without that parameter, an empty list or nullopt.
  double Number(std::string_view key, double fallback, Range range = {});
  int Integer(std::string_view key, int fallback, Range range = {});
  bool Boolean(std::string_view key, bool fallback);
  std::string Text(std::string_view key, std::string_view fallback);
  /// Reads a text that must be one of `allowed`.
  std::string Choice(std::string_view key, const std::vector<std::string>& allowed, std::string_view fallback);
  std::vector<std::string> Texts(std::string_view key);
  std::vector<double> Numbers(std::string_view key, Range range = {});
  std::optional<double> OptionalNumber(std::string_view key, Range range = {});
  /// Reads a whole number, which may exceed the range of int.
  std::optional<double> OptionalWhole(std::string_view key, Range range = {});
  /// Reads a text that must be present and not empty.
  std::string RequiredText(std::string_view key);

  /// Returns the node at `key` without conversion, null if the key is absent, and marks the key as known.
  const Node* Raw(std::string_view key);
  const Node& node() const { return node_; }

  /// Records an error of the caller at `place`; only the first error is kept.
  void Complain(Place place, std::string message);
  bool ok() const { return !error_.has_value(); }
  /// Returns the first error; without one, an error about the first unknown key; else success.
  Result<void> Finish();

 private:
  const Node* Scalar(std::string_view key, std::string_view expected);

  const Node& node_;
  std::string what_;
  std::vector<std::string> known_;
  std::optional<Error> error_;
};

/// Reads a scalar as a finite number.
Result<double> AsNumber(const Node& node);
/// Reads a sequence of scalars.
Result<std::vector<std::string>> AsTexts(const Node& node);

}  // namespace etude
