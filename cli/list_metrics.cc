#include <fmt/core.h>

#include "bench/metrics/catalogue.h"
#include "bench/metrics/export.h"
#include "cli/commands.h"

namespace etude {
namespace {

int PrintTable() {
  for (const MetricInfo& metric : AllMetrics()) {
    fmt::print("{:<26} v{}  {:<16}  {}\n", metric.id, metric.version, DirectionWords(metric.direction),
               metric.definition);
  }
  return kSuccess;
}

}  // namespace

int ListMetricsCommand(MetricsFormat format) {
  if (format == MetricsFormat::kTable) return PrintTable();
  fmt::print("{}", format == MetricsFormat::kJson ? MetricsJson() + "\n" : MetricsPage());
  return kSuccess;
}

}  // namespace etude
