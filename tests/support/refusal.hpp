#pragma once

#include <string>

#include "gvd/kernel/error.hpp"

namespace gvd::test {

/// What the input error says that an act throws.
template <class Act>
std::string refusal(Act&& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace gvd::test
