#pragma once

#include <cstddef>
#include <memory_resource>
#include <utility>

namespace gvd::predicates {

/// Columns of doubles in one piece of memory. Not filled.
class Columns {
 public:
  Columns(std::size_t count, std::size_t rows, std::pmr::memory_resource* room)
      : rows_(rows), bytes_(count * rows * sizeof(double)), room_(room), numbers_(static_cast<double*>(room->allocate(bytes_, kAlignment))) {}
  Columns(Columns&& other) noexcept : rows_(other.rows_), bytes_(other.bytes_), room_(other.room_), numbers_(std::exchange(other.numbers_, nullptr)) {}
  Columns& operator=(Columns&&) = delete;
  ~Columns() {
    if (numbers_ != nullptr) room_->deallocate(numbers_, bytes_, kAlignment);
  }
  std::size_t rows() const noexcept { return rows_; }
  double* operator[](std::size_t k) noexcept { return numbers_ + k * rows_; }
  const double* operator[](std::size_t k) const noexcept { return numbers_ + k * rows_; }

 private:
  static constexpr std::size_t kAlignment = 32;
  std::size_t rows_, bytes_;
  std::pmr::memory_resource* room_;
  double* numbers_;
};

}  // namespace gvd::predicates
