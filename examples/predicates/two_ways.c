/* The same from C: two ways over a roof, through gvd.h alone.
 *   cc two_ways.c $(pkg-config --cflags --libs gvd-predicates) -o two_ways */
#include <gvd.h>
#include <stdio.h>

static const double vertices[] = {-4, -4, 0, 4, -4, 0, 4, 4, 0, -4, 4, 0, 0, -4, 3, 0, 4, 3};

static void check(gvd_status status, const char* what, int* failures) {
  if (status == GVD_OK) return;
  printf("%s: status %d\n", what, (int)status);
  ++*failures;
}

int main(void) {
  const uint32_t left[3] = {0, 4, 3}, middle[3] = {4, 5, 3}, right[3] = {4, 2, 5};
  const double centroid[3] = {1, 1, 1}, first[3] = {1, 0, 0}, second[3] = {0, 1, 0}, third[3] = {0, 0, 1};
  gvd_strip *over = NULL, *to_ridge = NULL, *down = NULL;
  gvd_path *straight = NULL, *by_ridge = NULL;
  gvd_decision shorter = {GVD_UNKNOWN, GVD_UNDECIDED};
  gvd_enclosure length = {0, 0};
  int failures = 0;

  check(gvd_strip_create_indexed(vertices, 6, left, centroid, &over), "strip", &failures);
  check(gvd_strip_cross_indexed(over, vertices, 6, middle), "cross", &failures);
  check(gvd_strip_copy(over, &to_ridge), "copy", &failures);
  check(gvd_strip_cross_indexed(over, vertices, 6, right), "cross", &failures);
  check(gvd_strip_create_indexed(vertices, 6, right, third, &down), "strip", &failures);

  check(gvd_path_create(0, &straight), "path", &failures);
  check(gvd_path_add_leg(straight, over, second), "leg", &failures);
  check(gvd_path_create(0, &by_ridge), "path", &failures);
  check(gvd_path_add_leg(by_ridge, to_ridge, second), "leg", &failures);
  check(gvd_path_add_leg(by_ridge, down, second), "leg", &failures);

  check(gvd_compare_lengths(straight, by_ridge, &shorter), "compare", &failures);
  check(gvd_length(straight, &length), "length", &failures);
  printf("straight over the ridge - by the end of the ridge: %d, by %s\n", (int)shorter.sign, gvd_stage_name(shorter.stage));
  printf("straight: in [%.17g, %.17g]\n", length.lower, length.upper);

  /* What is no strip is refused, and nothing happens. */
  if (gvd_strip_cross_indexed(over, vertices, 6, left) != GVD_INVALID_ARGUMENT) ++failures;
  if (gvd_ray_side(over, 99, 0, &shorter) != GVD_INVALID_ARGUMENT) ++failures;
  if (gvd_path_add_leg(straight, NULL, first) != GVD_INVALID_ARGUMENT) ++failures;

  gvd_path_free(by_ridge);
  gvd_path_free(straight);
  gvd_strip_free(down);
  gvd_strip_free(to_ridge);
  gvd_strip_free(over);
  return failures != 0 || shorter.sign != GVD_NEGATIVE;
}
