// A square of side 1, a source in one corner: solved through the installed library alone.
#include <cmath>
#include <cstdio>

#include "gvd/io/mesh_reader.hpp"
#include "gvd/kernel/solver.hpp"

int main() {
  using namespace gvd::kernel;
  const Mesh mesh(gvd::io::parse_mesh("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 3\n3 1 2 3\n", "square.off"));
  const Source corner{{0, 0, {1, 0, 0}}, 0};
  const Solution solution = solve(mesh, {corner});
  const bool fine = solution.status() == Status::certified && solution.distance(1) == 1 && solution.distance(2) == std::sqrt(2.0) &&
                    solution.diagram().cells.size() == 1;
  std::printf("%s: the diagonal of the square is %.17g\n", status_name(solution.status()), solution.distance(2));
  return fine ? 0 : 1;
}
