#pragma once

#include <string>

namespace etude {

/// Returns the system call filter for outside programs, a seccomp BPF program; "" if this CPU is not supported. It
/// refuses calls that create or use
/// - memory that TreeMeter and Fence::MeasureScratch cannot measure;
/// - resources that are counted per user or machine and have no limit in a namespace;
/// - the user's keys, or the kernel's log;
/// - sockets, except UNIX, INET, INET6 and NETLINK. Network namespaces do not isolate all other families: AF_VSOCK
///   reaches the host.
std::string SystemCallFilter();

}  // namespace etude
