#pragma once

#include <stdexcept>
#include <string>

namespace gvd {

/// The input is refused. The message is one sentence that names the offending elements (or file and line). Program exit code 3.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A broken invariant of our own: always checked, never compiled out. Program exit code 5.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

}  // namespace gvd
