#pragma once

namespace etude {

/// Makes `stdout` safe to be read on a terminal, whatever a file or a method calls itself: what is printed passes
/// through Visible, line ends and tabs kept. JSON stays as it is, for WriteJson writes nothing that would change.
void MakeOutputSafe();

}  // namespace etude
