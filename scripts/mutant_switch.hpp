// Included before everything else in the mutated sources that scripts/mutate builds, and nowhere else: which mutant is on, and how to say the opposite.
#pragma once
#if __cplusplus >= 202002L  // CMake tries the compiler with less

#include <cmath>
#include <cstdlib>
#include <optional>
#include <type_traits>

inline const int gvd_mutant = [] {
  const char* number = std::getenv("GVD_MUTANT");
  return number == nullptr ? 0 : std::atoi(number);
}();

/// The opposite of an answer: another sign, yes for no, the next double for a double, another value for any other enumeration.
template <class Answer>
Answer gvd_opposite(Answer answer) {
  if constexpr (std::is_same_v<Answer, bool>) {
    return !answer;
  } else if constexpr (std::is_same_v<Answer, double>) {
    return std::nextafter(answer, 0.0);
  } else {
    const int value = static_cast<int>(answer);
    if constexpr (requires { Answer::negative; }) return static_cast<Answer>(value == 0 ? 1 : -value);
    return static_cast<Answer>(value == 0 ? 1 : 0);
  }
}
template <class Answer>
std::optional<Answer> gvd_flip(bool flips, std::optional<Answer> answer) {
  if (flips && answer) return gvd_opposite(*answer);
  return answer;
}
template <class Answer>
Answer gvd_flip(bool flips, Answer answer) {
  return flips ? gvd_opposite(answer) : answer;
}

#endif
