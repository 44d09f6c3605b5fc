#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bench/model/row.h"

namespace etude {

/// The rows of a run that is too large to be held in memory, in canonical order: scenario, condition, trial, method.
class RowSource {
 public:
  virtual ~RowSource() = default;
  virtual std::size_t size() const = 0;
  /// The places of all rows of whole worlds at equal steps, about so many rows or all that there are.
  virtual std::vector<std::size_t> PlacesAtEqualSteps(std::size_t rows) const = 0;
  /// Makes `row` the one at this place, whatever it was; its memory is used again. Without series and recording.
  virtual void Read(std::size_t place, Row& row) const = 0;
  virtual std::vector<Series> SeriesOf(std::size_t place) const = 0;
  /// Processor time of the cell; nothing where the folder tells of none.
  virtual std::optional<double> CpuSecondsOf(std::size_t place) const = 0;
};

}  // namespace etude
