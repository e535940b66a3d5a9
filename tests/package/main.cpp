#include <cstdio>

#include "gvd/kernel/mesh.hpp"
#include "gvd/robust/sign.hpp"

int main() {
  const gvd::kernel::Mesh empty;
  const bool fine = -gvd::robust::Sign::negative == gvd::robust::Sign::positive && empty.face_count() == 0;
  std::puts(fine ? "consumer: fine" : "consumer: wrong");
  return fine ? 0 : 1;
}
