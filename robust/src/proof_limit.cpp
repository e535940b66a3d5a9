#include "gvd/robust/proof_limit.hpp"

#include <utility>

namespace gvd::robust {

namespace {
thread_local ProofLimit* limit_of_thread = nullptr;
}  // namespace

ProofLimit::ProofLimit(std::uint64_t questions) noexcept : left_(questions), outer_(std::exchange(limit_of_thread, this)) {}
ProofLimit::~ProofLimit() { limit_of_thread = outer_; }

bool ProofLimit::allows_one() noexcept {
  ProofLimit* limit = limit_of_thread;
  if (limit == nullptr) return true;
  if (limit->left_ > 0) {
    --limit->left_;
    return true;
  }
  limit->reached_ = true;
  return false;
}

}  // namespace gvd::robust
