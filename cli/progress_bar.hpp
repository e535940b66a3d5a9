#pragma once

#include <chrono>
#include <string>

#include "gvd/kernel/solver.hpp"

namespace gvd::cli {

/// One line of progress with rate and remaining time of the phase, for one that has run for a second; "" before.
/// Units of `done` and `total` are those of the phase. Pre: seconds >= 0.
std::string progress_line(const kernel::Progress& progress, double seconds);

/// Shows progress on stderr, if that is a terminal, once the work has taken a second. The destructor clears the line.
class ProgressBar {
 public:
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const kernel::Progress& progress);

 private:
  using Clock = std::chrono::steady_clock;

  bool enabled_, shown_ = false;
  std::string phase_;
  Clock::time_point phase_start_{}, last_{};
};

}  // namespace gvd::cli
