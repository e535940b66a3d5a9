#include "gvd/robust/proof_limit.hpp"

#include <utility>

namespace gvd::robust {

namespace {
thread_local ProofLimit* limit_of_thread = nullptr;
}  // namespace

ProofLimit::ProofLimit(std::uint64_t answered, std::uint64_t refused) noexcept
    : answered_(answered), refused_(refused), outer_(std::exchange(limit_of_thread, this)) {}
ProofLimit::~ProofLimit() { limit_of_thread = outer_; }

bool ProofLimit::allows_one() noexcept {
  ProofLimit* limit = limit_of_thread;
  if (limit == nullptr) return true;
  if (limit->answered_ > 0) {
    --limit->answered_;
    return true;
  }
  if (limit->refused_ == 0) return true;
  --limit->refused_;
  limit->reached_ = true;
  return false;
}

}  // namespace gvd::robust
