#pragma once

namespace etude {

/// What one cell took, on this machine.
struct CellUsage {
  double wall_s = 0;
  double cpu_s = 0;  ///< of the worker and of the method outside
  /// The largest resident size of either while the cell was run; cells shorter than a look at it share one look.
  double peak_mb = 0;
  /// The building of the world, in the row of the first cell that was run in it.
  double world_wall_s = 0, world_cpu_s = 0;
};

}  // namespace etude
