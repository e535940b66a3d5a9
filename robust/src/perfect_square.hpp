#pragma once

#include "gvd/robust/gmp.hpp"

namespace gvd::robust {

inline bool is_perfect_square(const mpz_class& n) noexcept { return mpz_perfect_square_p(n.get_mpz_t()) != 0; }

}  // namespace gvd::robust
