#include "messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <new>
#include <nlohmann/json.hpp>

#include "exit_code.hpp"
#include "gvd/io/staged_files.hpp"
#include "gvd/kernel/error.hpp"

namespace gvd::cli {

namespace {

constexpr std::size_t kMostShown = 20;

int failed(bool json, const char* status, const std::string& message, int code) {
  note("error: " + message);
  if (json) {
    const nlohmann::ordered_json object = {{"status", status}, {"error", message}};
    std::fputs((object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n").c_str(), stdout);
  }
  return code;
}

int classify(bool json) {
  try {
    throw;
  } catch (const InputError& e) {
    return failed(json, "input_refused", e.what(), kInputRefused);
  } catch (const io::OutputPathError& e) {
    return failed(json, "usage", e.what(), kUsage);
  } catch (const io::OutputError& e) {
    return failed(json, "write_failed", e.what(), kInternal);
  } catch (const std::bad_alloc&) {
    return failed(json, "memory_limit", "there is not enough memory", kUnproved);
  } catch (const std::exception& e) {
    return failed(json, "internal_error", fmt::format("internal: {} (please report this with the input)", e.what()), kInternal);
  }
}

}  // namespace

void print(const std::string& text) {
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0) throw io::OutputError("cannot write to the standard output");
}

void note(const std::string& message) { std::fputs(("gvd: " + message + "\n").c_str(), stderr); }

int report_undecided(const predicates::Decisions& decisions) {
  const auto count = decisions.total(robust::Stage::undecided);
  if (count == 0) return kCertified;
  const auto& list = decisions.undecided_list();
  note(fmt::format("{} decisions could not be proved:", count));
  const std::size_t shown = std::min(list.size(), kMostShown);
  for (std::size_t i = 0; i < shown; ++i) std::fputs(("  " + list[i] + "\n").c_str(), stderr);
  if (count > shown) std::fputs(fmt::format("  ... and {} more\n", count - shown).c_str(), stderr);
  return kUnproved;
}

int report_error(bool json) noexcept {
  try {
    return classify(json);
  } catch (...) {
    return kInternal;
  }
}

}  // namespace gvd::cli
