#include "fuzz/campaign/external.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "gvd/kernel/error.hpp"

namespace gvd::fuzz {
namespace {

/// In the child, between fork and exec.
[[noreturn]] void become(const std::string& command, const Limits& limits) {
  setpgid(0, 0);
  const int null = open("/dev/null", O_RDWR);
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(null, fd);
  const rlimit memory{limits.bytes, limits.bytes}, no_core{0, 0};
  setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_CORE, &no_core);
  execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
  _exit(127);
}

/// The shell tells a signal that ended the program as 128 plus its number.
ExternalEnd end_of(int status) {
  if (WIFSIGNALED(status)) return {ExternalEnd::Kind::crashed, WTERMSIG(status)};
  const int code = WEXITSTATUS(status);
  if (code > 128) return {ExternalEnd::Kind::crashed, code - 128};
  return {code == 0 ? ExternalEnd::Kind::ended : ExternalEnd::Kind::failed, code};
}

}  // namespace

ExternalEnd run_external(const std::string& command, const Limits& limits) {
  const pid_t child = fork();
  if (child < 0) throw InternalError("cannot start a process");
  if (child == 0) become(command, limits);
  setpgid(child, child);  // whoever comes first
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(limits.seconds);
  auto pause = std::chrono::microseconds(200);
  for (;;) {
    int status = 0;
    const bool over = waitpid(child, &status, WNOHANG) == child;
    const bool late = std::chrono::steady_clock::now() > deadline;
    if (over || late) kill(-child, SIGKILL);
    if (over) return end_of(status);
    if (late) {
      waitpid(child, &status, 0);
      return {ExternalEnd::Kind::hung, 0};
    }
    std::this_thread::sleep_for(pause);
    if (pause < std::chrono::milliseconds(5)) pause *= 2;
  }
}

}  // namespace gvd::fuzz
