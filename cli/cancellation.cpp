#include "cancellation.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>

namespace gvd::cli {

namespace {

// A signal handler can reach nothing but objects of static lifetime.
std::atomic<int> signal_caught{0};
std::atomic<bool> writing{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void on_signal(int number) {
  if (signal_caught.exchange(number) != 0 && !writing.load()) ::_exit(128 + number);
}

}  // namespace

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int requested_signal() noexcept { return signal_caught.load(); }

WritingOutput::WritingOutput() noexcept { writing = true; }
WritingOutput::~WritingOutput() { writing = false; }

}  // namespace gvd::cli
