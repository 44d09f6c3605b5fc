#pragma once

namespace CLI {
class App;
}

namespace etude {

/// Ends the help of every command with examples of its own, which `tests/cli/help_test.py` holds against its options.
void AddExamples(CLI::App& app);

}  // namespace etude
