#include "gvd/io/staged_files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <utility>

namespace gvd::io {

namespace fs = std::filesystem;

namespace {

/// The directory itself if it exists, else the nearest ancestor that does.
fs::path nearest_existing(const fs::path& directory) {
  fs::path p = fs::absolute(directory).lexically_normal();
  std::error_code error;
  while (!fs::exists(fs::symlink_status(p, error)) && p.has_parent_path() && p != p.parent_path()) p = p.parent_path();
  return p;
}

void check_directory(const fs::path& directory) {
  const fs::path existing = nearest_existing(directory);
  std::error_code error;
  if (!fs::is_directory(existing, error))
    throw OutputPathError(fmt::format("cannot write to {}: {} is not a directory", directory.string(), existing.string()));
  if (::access(existing.c_str(), W_OK | X_OK) != 0)
    throw OutputPathError(fmt::format("cannot write to {}: no permission to create files in {}", directory.string(), existing.string()));
}

}  // namespace

StagedFiles::StagedFiles(fs::path directory, const std::vector<std::string>& names)
    : directory_(directory.empty() ? fs::path(".") : std::move(directory)) {
  check_directory(directory_);
  for (const auto& name : names) {
    const fs::path target = directory_ / name;
    std::error_code error;
    const auto kind = fs::status(target, error).type();
    if (kind != fs::file_type::not_found && kind != fs::file_type::regular)
      throw OutputPathError(fmt::format("cannot write {}: it exists and is not a regular file", target.string()));
  }
}

StagedFiles::~StagedFiles() {
  std::error_code ignored;
  for (const auto& name : written_) fs::remove(temporary(name), ignored);
  for (auto d = created_.rbegin(); d != created_.rend(); ++d) fs::remove(*d, ignored);
}

fs::path StagedFiles::temporary(const std::string& name) const {
  return directory_ / fmt::format(".{}.tmp-{}", name, ::getpid());
}

void StagedFiles::create_directories() {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path p = fs::absolute(directory_).lexically_normal(); !fs::exists(p, error); p = p.parent_path()) {
    if (p.filename().empty()) continue;  // a trailing slash
    missing.push_back(p);
  }
  for (auto p = missing.rbegin(); p != missing.rend(); ++p) {
    if (!fs::create_directory(*p, error) && error)
      throw OutputError(fmt::format("cannot create the directory {}: {}", p->string(), error.message()));
    created_.push_back(*p);
  }
}

void StagedFiles::write(const std::string& name, const std::function<void(std::ostream&)>& fill) {
  create_directories();
  const fs::path path = temporary(name);
  written_.push_back(name);
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  if (!out) throw OutputError(fmt::format("cannot create {}", path.string()));
  fill(out);
  out.close();
  if (!out) throw OutputError(fmt::format("cannot write {}: the disk may be full", (directory_ / name).string()));
}

void StagedFiles::commit() {
  while (!written_.empty()) {
    const std::string name = written_.back();
    std::error_code error;
    fs::rename(temporary(name), directory_ / name, error);
    if (error) throw OutputError(fmt::format("cannot rename {} into place: {}", (directory_ / name).string(), error.message()));
    created_.clear();
    written_.pop_back();
  }
}

}  // namespace gvd::io
