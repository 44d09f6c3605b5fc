#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/document/node.h"

namespace etude {

/// The closed interval a number must lie in.
struct Range {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
};

/// Reads the keys of one mapping by name and type. Keeps the first complaint and goes on with
/// defaults, so that reading code is a plain list of its keys; `Finish` then reports that complaint,
/// or any key that nobody asked for (with the nearest known one).
///
///     Fields fields(node, "an ik scenario");
///     options.trials = fields.Integer("trials", 100, {1, 100000});
///     options.start = fields.Choice("start", {"near", "cold"}, "near");
///     RETURN_IF_ERROR(fields.Finish());
class Fields {
 public:
  /// Reads the fields of `node`; `what` is the mapping's role in complaints, e.g. "a method of task ik". `node` must
  /// outlive this.
  Fields(const Node& node, std::string what);

  double Number(std::string_view key, double fallback, Range range = {});
  int Integer(std::string_view key, int fallback, Range range = {});
  bool Boolean(std::string_view key, bool fallback);
  std::string Text(std::string_view key, std::string_view fallback);
  /// A text that must be one of `allowed`.
  std::string Choice(std::string_view key, const std::vector<std::string>& allowed, std::string_view fallback);
  std::vector<std::string> Texts(std::string_view key);
  std::vector<double> Numbers(std::string_view key, Range range = {});
  std::optional<double> OptionalNumber(std::string_view key, Range range = {});
  /// A number without fraction; may be larger than an int.
  std::optional<double> OptionalWhole(std::string_view key, Range range = {});
  std::string RequiredText(std::string_view key);

  /// The raw value under `key` (null when absent), marked as known.
  const Node* Raw(std::string_view key);
  const Node& node() const { return node_; }

  /// Notes a complaint of the caller's own, at `place`; only the first one is kept.
  void Complain(Place place, std::string message);
  bool ok() const { return !error_.has_value(); }
  /// The first complaint, or an unknown key, or success.
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
