#pragma once

#include <string>
#include <string_view>

namespace etude {

/// Makes text safe in HTML and XML, in content and in quoted attributes. Control characters that XML forbids become
/// U+FFFD, and so does every byte that is not UTF-8. Characters that reverse the direction of text become their code
/// point, "[U+202E]". A hostile name can therefore neither break a file nor look like another name.
std::string EscapeMarkup(std::string_view text);

/// Makes JSON safe inside a <script> element: every "<" is escaped, so no text can end the element. Characters that
/// reverse the direction of text become their code point.
std::string EscapeScriptJson(std::string_view json);

/// Makes text safe in a line or table cell of Markdown. Characters that reverse the direction of text become their code
/// point.
std::string EscapeMarkdown(std::string_view text);

/// Makes text safe in LaTeX outside of mathematics, for pdflatex without packages. A character outside pdflatex's fonts
/// becomes its code point, "[U+4E2D]". A table with a foreign name therefore still compiles.
std::string EscapeLatex(std::string_view text);

/// Returns the file name, without an extension, for scenario number `index` of a run. The name comes from a user's
/// file, so only harmless characters reach a path; no two scenarios of a run share a file name.
std::string FileNameOf(const std::string& scenario, std::size_t index);

/// Returns the name of the file with a cell's recovered motion.
std::string MotionFileOf(const std::string& cell);

/// Writes a relative path as the target of a link: every byte that is special in a URL becomes "%XX".
std::string UrlPath(std::string_view path);

/// Writes a word of a command line; the word is quoted if a shell would split or expand it.
std::string ShellWord(std::string_view text);

}  // namespace etude
