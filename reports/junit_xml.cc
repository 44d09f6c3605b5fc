#include "reports/junit_xml.h"

#include <fmt/core.h>

#include "reports/words/escape.h"

namespace etude {
namespace {

std::string CaseXml(const std::string& suite, const JunitCase& c) {
  const std::string head =
      fmt::format("    <testcase classname=\"etude.{}\" name=\"{}\"", EscapeMarkup(suite), EscapeMarkup(c.name));
  const std::string detail = EscapeMarkup(c.detail);
  std::string body;
  if (c.ruling == Ruling::kUnmet) body = fmt::format("<failure message=\"not met\">{}</failure>", detail);
  if (c.ruling == Ruling::kUndecided) body = fmt::format("<skipped message=\"{}\"/>", detail);
  if (!c.said.empty()) body += fmt::format("<system-out>{}</system-out>", EscapeMarkup(c.said));
  return body.empty() ? head + "/>\n" : head + fmt::format(">{}</testcase>\n", body);
}

}  // namespace

std::string WriteJunitXml(const std::string& name, const std::vector<JunitSuite>& suites) {
  std::string body;
  std::size_t all = 0, all_failed = 0, all_skipped = 0;
  for (const JunitSuite& suite : suites) {
    std::size_t failed = 0, skipped = 0;
    std::string cases;
    for (const JunitCase& c : suite.cases) {
      failed += c.ruling == Ruling::kUnmet;
      skipped += c.ruling == Ruling::kUndecided;
      cases += CaseXml(suite.name, c);
    }
    body += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\">\n{}  </testsuite>\n",
        EscapeMarkup(suite.name), suite.cases.size(), failed, skipped, cases);
    all += suite.cases.size();
    all_failed += failed;
    all_skipped += skipped;
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" "
      "skipped=\"{}\">\n{}</testsuites>\n",
      EscapeMarkup(name), all, all_failed, all_skipped, body);
}

}  // namespace etude
