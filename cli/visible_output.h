#pragma once

namespace etude {

/// Makes `stdout` safe for terminals, even if names of files or methods contain control characters: all output passes
/// through Visible, which keeps line ends and tabs. JSON does not change, because WriteJson writes no control
/// characters.
void MakeOutputSafe();

/// Returns the `errno` of the first write to `stdout` that failed; 0 if none failed. A later flush does not report it.
int OutputError();

}  // namespace etude
