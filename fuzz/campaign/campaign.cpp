#include "fuzz/campaign/campaign.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <new>
#include <set>
#include <thread>

#include "gvd/kernel/error.hpp"

#ifdef GVD_COVERAGE
extern "C" void __gcov_dump();
#endif

namespace gvd::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

/// A case that takes longer is ended from outside. The solver's own limit (Trial::kSeconds, several runs) comes first as a rule.
constexpr double kHangSeconds = 300;

volatile sig_atomic_t stop_requested = 0;
void request_stop(int) { stop_requested = 1; }

/// What parent and child both see.
struct Shared {
  std::atomic<std::uint64_t> index{0};    ///< the case in work
  std::atomic<std::uint64_t> started{0};  ///< how many cases were begun
  std::atomic<bool> done{false};
};

class Campaign {
 public:
  explicit Campaign(const CampaignOptions& options) : options_(options), start_(Clock::now()) {
    read_earlier();
    void* page = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (page == MAP_FAILED) throw InternalError("no memory to share with the child process");
    shared_ = new (page) Shared;
    shared_->index = options.shard;
  }
  ~Campaign() { munmap(shared_, sizeof(Shared)); }
  Campaign(const Campaign&) = delete;
  Campaign& operator=(const Campaign&) = delete;

  Tally run() {
    signal(SIGINT, request_stop);
    signal(SIGTERM, request_stop);
    while (!shared_->done && stop_requested == 0) {
      const pid_t child = fork();
      if (child < 0) throw InternalError("cannot start a process");
      if (child == 0) {
        work();
#ifdef GVD_COVERAGE
        __gcov_dump();  // _exit() would lose what the child has run through
#endif
        _exit(0);
      }
      const std::string end = wait_for(child);
      if (!end.empty()) record_end(end);
    }
    Tally tally;
    for (const auto& result : merged(results())) tally.add(result);
    return tally;
  }

 private:
  /// Drops a line that was cut off, and remembers which cases are done.
  void read_earlier() {
    if (options_.out.empty()) {
      scratch_ = (std::filesystem::temp_directory_path() / fmt::format("gvd-fuzz-{}.jsonl", getpid())).string();
      return;
    }
    if (!std::filesystem::exists(options_.out)) return;
    const auto earlier = read_results(options_.out);
    std::ofstream out(options_.out, std::ios::binary | std::ios::trunc);
    for (const auto& result : earlier) {
      out << to_line(result) << '\n';
      if (result.version == kGeneratorVersion) done_.insert(result.seed);
    }
    if (!out.flush()) throw InternalError(options_.out + ": cannot be written");
  }
  const std::string& results_file() const { return options_.out.empty() ? scratch_ : options_.out; }
  std::vector<CaseResult> results() const {
    if (!std::filesystem::exists(results_file())) return {};
    auto all = read_results(results_file());
    if (!scratch_.empty()) std::filesystem::remove(scratch_);
    return all;
  }

  bool time_is_up() const {
    return stop_requested != 0 ||
           (options_.seconds > 0 && std::chrono::duration<double>(Clock::now() - start_).count() > options_.seconds);
  }

  void append(const CaseResult& result) const {
    std::ofstream out(results_file(), std::ios::binary | std::ios::app);
    out << to_line(result) + "\n";
    if (!out.flush()) throw InternalError(results_file() + ": cannot be written");
  }

  /// In the child: the cases from shared_->index on.
  void work() {
    for (std::uint64_t i = shared_->index; !time_is_up() && (options_.cases == 0 || i < options_.cases); i += options_.shards) {
      const std::uint64_t seed = campaign_seed(options_.seed, i);
      shared_->index = i;
      if (done_.count(seed) != 0) continue;
      ++shared_->started;
      const CaseResult result = run_case(seed, options_.wish, options_.choice);
      append(result);
      for (const auto& [property, what] : result.violated) report(seed, property, what);
      if (options_.stop_at_first && !result.violated.empty()) break;
      if (!options_.quiet && shared_->started % 1000 == 0) fmt::print(stderr, "gvd: fuzz: {} cases\n", shared_->started.load());
    }
    shared_->done = true;
  }
  void report(std::uint64_t seed, const std::string& property, const std::string& what) const {
    fmt::print(stderr, "gvd: fuzz: seed {}: {}: {}\n", seed, property, what);
    const std::string file =
        write_finding(make_case(seed, options_.wish), seed, property, what, options_.findings, options_.shrink_seconds);
    fmt::print(stderr, "gvd: fuzz:   gvd fuzz --replay {}\n", file);
  }

  /// Empty if the child ended of its own will; else "crash" or "hang".
  std::string wait_for(pid_t child) const {
    std::uint64_t seen = shared_->started;
    auto since = Clock::now();
    for (;;) {
      int status = 0;
      if (waitpid(child, &status, WNOHANG) == child)
        return WIFSIGNALED(status) || (WIFEXITED(status) && WEXITSTATUS(status) != 0) ? "crash" : "";
      if (shared_->started != seen) seen = shared_->started, since = Clock::now();
      if (std::chrono::duration<double>(Clock::now() - since).count() > kHangSeconds + options_.shrink_seconds) {
        kill(child, SIGKILL);
        waitpid(child, &status, 0);
        return "hang";
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  /// The case that ended the child is a finding; the next child begins after it.
  void record_end(const std::string& end) {
    const std::uint64_t index = shared_->index, seed = campaign_seed(options_.seed, index);
    const Case c = make_case(seed, options_.wish);
    CaseResult result;
    result.seed = seed;
    result.family = c.family;
    result.faces = c.mesh.faces.size();
    result.sources = c.sources.size();
    result.status = end;
    result.violated["runs_to_its_end"] = end;
    append(result);
    const std::string file = write_finding(c, seed, "runs_to_its_end", end, options_.findings, 0);
    fmt::print(stderr, "gvd: fuzz: seed {}: {}\ngvd: fuzz:   gvd fuzz --replay {}\n", seed, end, file);
    shared_->index = index + options_.shards;
    if (options_.stop_at_first) shared_->done = true;
  }

  const CampaignOptions& options_;
  Clock::time_point start_;
  std::set<std::uint64_t> done_;
  std::string scratch_;
  Shared* shared_ = nullptr;
};

}  // namespace

std::uint64_t campaign_seed(std::uint64_t seed, std::uint64_t index) { return mixed_seed(seed, index); }

Tally run_campaign(const CampaignOptions& options) { return Campaign(options).run(); }

}  // namespace gvd::fuzz
