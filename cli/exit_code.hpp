#pragma once

namespace gvd::cli {

/// What the program's exit code means (docs/formats.md#exit-codes). After SIGINT or SIGTERM it is 128 plus the signal's number.
enum ExitCode : int {
  kCertified = 0,
  kUsage = 2,         ///< wrong arguments, or an output path that cannot be used
  kInputRefused = 3,  ///< the mesh or the sources
  kUnproved = 4,      ///< undecided decisions, or a resource limit
  kInternal = 5,      ///< a broken invariant of our own, or a failed write
};

}  // namespace gvd::cli
