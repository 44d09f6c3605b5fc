#pragma once

#include <string>
#include <string_view>

namespace etude {

/// The parts of a tool's page around the page's content. All parts are plain texts, not HTML.
struct ToolPage {
  std::string_view kind;  ///< name of the command, e.g. "capture"
  std::string title;
  std::string verdict;  ///< the result in one or two sentences
  std::string version;
  std::string command;          ///< the command as typed; "" = not shown
  std::string_view script = {};  ///< script that runs when the page is opened; "" = the page allows no scripts
};

/// Writes one HTML page in the style of a run's page. It needs no other file, and may not use the network.
std::string WriteToolPage(const ToolPage& page, std::string_view content_html);

}  // namespace etude
