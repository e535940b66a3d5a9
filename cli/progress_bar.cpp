#include "progress_bar.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace gvd::cli {

namespace {

constexpr double kQuiet = 1;       // seconds before anything is shown
constexpr double kInterval = 0.1;  // seconds between two lines
constexpr int kBarWidth = 30;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// 1234567 -> "1.23M".
std::string short_number(double x) {
  if (x >= 1e9) return fmt::format("{:.3g}G", x / 1e9);
  if (x >= 1e6) return fmt::format("{:.3g}M", x / 1e6);
  if (x >= 1e3) return fmt::format("{:.3g}k", x / 1e3);
  return fmt::format("{:.3g}", x);
}

std::string remaining(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s left", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min left", seconds / 60);
  return fmt::format("{:.1f} h left", seconds / 3600);
}

}  // namespace

std::string progress_line(const kernel::Progress& progress, double seconds) {
  if (seconds < kQuiet) return "";
  const double rate = progress.done / seconds;
  const std::string speed = short_number(rate) + "/s";
  if (!(progress.total > 0)) return fmt::format("{}: {} ({})", progress.phase, short_number(progress.done), speed);
  const double part = std::clamp(progress.done / progress.total, 0.0, 1.0);
  const int filled = static_cast<int>(part * kBarWidth);
  std::string line = fmt::format("{} [{}{}] {:3.0f} %  {}", progress.phase, std::string(static_cast<std::size_t>(filled), '#'),
                                 std::string(static_cast<std::size_t>(kBarWidth - filled), '.'), 100 * part, speed);
  if (rate > 0) line += "  " + remaining(std::max(0.0, progress.total - progress.done) / rate);
  return line;
}

ProgressBar::ProgressBar(bool wanted) : enabled_(wanted && ::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (shown_) std::fputs("\r\x1b[K", stderr);
}

void ProgressBar::show(const kernel::Progress& progress) {
  if (!enabled_) return;
  if (phase_ != progress.phase) {
    phase_ = progress.phase;
    phase_start_ = Clock::now();
  }
  const std::string line = progress_line(progress, seconds_since(phase_start_));
  if (line.empty() || seconds_since(last_) < kInterval) return;
  std::fputs(("\r" + line + "\x1b[K").c_str(), stderr);
  std::fflush(stderr);
  last_ = Clock::now();
  shown_ = true;
}

}  // namespace gvd::cli
