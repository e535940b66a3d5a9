#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace gvd::cli {

/// What the arguments said. Each command reads what it needs.
struct Options {
  std::string mesh, sources, out;
  std::string units = "mesh units";
  std::uint64_t seed = 0;
  unsigned threads = 1;
  std::uint64_t max_memory_bytes = 0;  ///< 0: none
  double time_limit_seconds = 0;       ///< 0: none
  double deviation = 0;
  bool json = false, quiet = false;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
};

/// Each returns an exit code. Errors are exceptions; `report_error` turns them into messages and codes.
int run_info(const Options& options);
int run_distance(const Options& options);
int run_compute(const Options& options);

}  // namespace gvd::cli
