#pragma once

namespace gvd::cli {

/// Catches SIGINT and SIGTERM from now on. The first signal only asks for the end; while no output is being written, a second one ends the
/// program at once.
void catch_signals();
/// The signal that asked for the end; 0 if none did.
int requested_signal() noexcept;

/// While one lives, a second signal does not end the program: staged files are removed, or complete, first.
class WritingOutput {
 public:
  WritingOutput() noexcept;
  ~WritingOutput();
  WritingOutput(const WritingOutput&) = delete;
  WritingOutput& operator=(const WritingOutput&) = delete;
};

}  // namespace gvd::cli
