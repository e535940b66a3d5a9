#pragma once

#include <cstdint>
#include <string>

namespace gvd::fuzz {

struct Limits {
  double seconds = 10;
  std::uint64_t bytes = std::uint64_t{2} << 30;  ///< of address space
};

/// How a program came to its end.
struct ExternalEnd {
  enum class Kind : std::uint8_t { ended, failed, crashed, hung };
  Kind kind = Kind::ended;
  int number = 0;  ///< exit code of a failure, signal of a crash
};

/// Runs `sh -c command` in a process group of its own, output thrown away. When the time is up the whole group is killed; whatever
/// it leaves behind is killed too.
ExternalEnd run_external(const std::string& command, const Limits& limits);

}  // namespace gvd::fuzz
