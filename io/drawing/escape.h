#pragma once

#include <string>
#include <string_view>

namespace etude {

/// Makes text safe inside HTML or XML, in content and in quoted attributes. Control characters that XML forbids become
/// U+FFFD, and so does every byte that is not UTF-8; what turns text around becomes its number, "[U+202E]": a hostile
/// name can neither break a file nor read as another.
std::string EscapeMarkup(std::string_view text);

/// Makes JSON safe inside a <script> element: no "<" survives, so nothing in it can end the element; what turns text
/// around becomes its number.
std::string EscapeScriptJson(std::string_view json);

/// Makes text safe in a line or table cell of Markdown; what turns text around becomes its number.
std::string EscapeMarkdown(std::string_view text);

/// Makes text safe in LaTeX outside of mathematics, for pdflatex without packages. A character beyond what its fonts
/// hold becomes its number, "[U+4E2D]": a table with a foreign name still compiles.
std::string EscapeLatex(std::string_view text);

/// Gives the name, without an ending, of the files of a run's scenario number `index`. A scenario's name comes from a
/// file of the user: only harmless characters reach a path, and no two scenarios of a run share a name.
std::string FileNameOf(const std::string& scenario, std::size_t index);

/// Gives the name of the file that holds the motion which a cell recovered.
std::string MotionFileOf(const std::string& cell);

/// Writes a relative path as the target of a link: whatever is no plain character becomes "%XX".
std::string UrlPath(std::string_view path);

/// Writes a word of a command line, in quotes when a shell would take it apart.
std::string ShellWord(std::string_view text);

}  // namespace etude
