#pragma once

namespace etude {

/// Makes memory cheap that this process allocates and frees repeatedly: the C library keeps up to 64 MiB of freed
/// memory, and the kernel provides the first 62 MiB in large pages. Otherwise, getting new pages, which the kernel
/// fills with zeros, would take a quarter of the time of reading files, and more than half of it on virtual machines.
void PrepareHeap();

}  // namespace etude
