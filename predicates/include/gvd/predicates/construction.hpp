#pragma once

#include "gvd/robust/sign.hpp"

namespace gvd::predicates {

/// Whether a construction has a result, as far as one number type can tell. `impossible` and `proved` are final; `open` is for the next stage of
/// the ladder, and whatever was computed along with it must not be used.
enum class Existence { impossible, open, proved };

/// The product of conditions of the form "positive".
class Conditions {
 public:
  void require_positive(robust::MaybeSign sign) {
    if (!sign)
      open_ = true;
    else if (*sign != robust::Sign::positive)
      failed_ = true;
  }
  void fail() { failed_ = true; }
  bool failed() const { return failed_; }
  Existence result() const { return failed_ ? Existence::impossible : open_ ? Existence::open : Existence::proved; }

 private:
  bool open_ = false, failed_ = false;
};

}  // namespace gvd::predicates
