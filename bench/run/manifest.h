#pragma once

#include <span>
#include <string>

#include "bench/results/json.h"
#include "bench/run/setup.h"

namespace etude {

/// What repeats the run: manifest.json. Its bytes do not depend on how or where it is run.
Json MakeManifest(const SuiteSetup& suite, std::span<const PreparedScenario> scenarios, const std::string& version);

/// Where and how it was run: host.json.
Json DescribeHost(const std::string& command_line, int jobs, double seconds);

}  // namespace etude
