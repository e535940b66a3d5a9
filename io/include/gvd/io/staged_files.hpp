#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <stdexcept>
#include <string>
#include <vector>

namespace gvd::io {

/// A place for output that cannot be used as asked: the caller's mistake.
class OutputPathError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writing failed (disk full, permissions changed meanwhile).
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Files that appear all together or not at all: each is written to a hidden temporary name in the target directory, and `commit`
/// renames them when all are complete. Without `commit` the destructor removes the temporary files and the directories it made.
class StagedFiles {
 public:
  /// Only checks, creates nothing: throws OutputPathError if `directory` is not, and cannot become, a writable directory, or if a target
  /// in it exists and is not a regular file.
  StagedFiles(std::filesystem::path directory, const std::vector<std::string>& names);
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// Writes one of the named files through `fill`. Throws OutputError if the stream fails; exceptions of `fill` pass through.
  void write(const std::string& name, const std::function<void(std::ostream&)>& fill);
  /// Renames all written files to their own names; a file of that name is replaced. Throws OutputError.
  void commit();

 private:
  void create_directories();
  std::filesystem::path temporary(const std::string& name) const;

  std::filesystem::path directory_;
  std::vector<std::filesystem::path> created_;  // directories, outermost first
  std::vector<std::string> written_;
};

}  // namespace gvd::io
