#pragma once

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "support/temporary_directory.hpp"

extern char** environ;

namespace gvd::test {

struct Outcome {
  int code = -1;  ///< exit code; 128 plus the number of the signal that killed it
  std::string out, err;
};

/// Runs a program with its output in files of `directory`.
class Program {
 public:
  Program(const std::string& executable, const std::vector<std::string>& arguments, const TemporaryDirectory& directory)
      : out_(directory / "stdout"), err_(directory / "stderr") {
    std::vector<std::string> words = {executable};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out_.c_str(), kFlags, 0600);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err_.c_str(), kFlags, 0600);
    const int error = posix_spawn(&process_, executable.c_str(), &files, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0) throw std::runtime_error("cannot start " + executable);
  }

  void send(int signal_number) const { ::kill(process_, signal_number); }

  Outcome wait() const {
    int status = 0;
    ::waitpid(process_, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, read_file(out_), read_file(err_)};
  }

 private:
  std::filesystem::path out_, err_;
  pid_t process_ = -1;
};

}  // namespace gvd::test
