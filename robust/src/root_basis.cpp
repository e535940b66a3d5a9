#include "root_basis.hpp"

#include "gvd/robust/rational.hpp"
#include "perfect_square.hpp"
#include "prime_field.hpp"

namespace gvd::robust {

RootBasis::Product RootBasis::root(const mpz_class& radicand) {
  Row row;
  for (std::size_t i = 0; i < symbols_; ++i)
    if (is_non_residue(radicand, large_prime(i))) mpz_setbit(row.symbols.get_mpz_t(), i);
  for (const Row& known : rows_) {
    if (mpz_tstbit(row.symbols.get_mpz_t(), known.pivot) == 0) continue;
    row.symbols ^= known.symbols;
    row.members ^= known.members;
  }
  const bool seems_dependent = row.symbols == 0;
  if (seems_dependent) {
    Product result;
    mpz_class others = 1;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      if (mpz_tstbit(row.members.get_mpz_t(), i) == 0) continue;
      result.members.push_back(i);
      others *= members_[i];
    }
    const mpz_class square = radicand * others;
    if (is_perfect_square(square)) {
      result.factor = mpq_class(sqrt(square), others);
      result.factor.canonicalize();
      return result;
    }
  } else {
    mpz_setbit(row.members.get_mpz_t(), members_.size());
    row.pivot = mpz_scan1(row.symbols.get_mpz_t(), 0);
    rows_.push_back(std::move(row));
  }
  members_.push_back(radicand);
  return {1, {members_.size() - 1}};
}

}  // namespace gvd::robust
