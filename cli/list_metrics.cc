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
  const auto text = format == MetricsFormat::kJson ? MetricsJson() : MetricsPage();
  if (!text) return Complain(text.error());
  fmt::print("{}{}", *text, text->ends_with('\n') ? "" : "\n");
  return kSuccess;
}

}  // namespace etude
