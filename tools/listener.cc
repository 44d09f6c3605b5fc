#include "tools/listener.h"

#include <fmt/core.h>

#include "engine/base/utf8.h"

namespace etude {

void TellWritten(const Listener& listener, const std::string& path) {
  listener.print(fmt::format("written: {}\n", Visible(path)));
}

void MessageLog::Tell(const std::string& line) {
  print(line + "\n");
  lines.push_back(line);
}

}  // namespace etude
