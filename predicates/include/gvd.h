/* Certified predicates over strips of triangles, for C and everything that can call C.
 *
 * The same as gvd/predicates/face_strip.hpp, strip_path.hpp and strip_window.hpp, where the laws and costs are described. Coordinates are
 * doubles, taken as exact real numbers. No function throws, exits or keeps global state, but for one thing: GMP and MPFR end the program if they
 * find no memory. Distinct handles may be used by distinct threads. A handle is given back by its own _free (which takes NULL). Where a function
 * does not return GVD_OK, nothing has been changed or written.
 */
#ifndef GVD_H
#define GVD_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum gvd_status {
  GVD_OK = 0,
  GVD_INVALID_ARGUMENT = 1, /* a null pointer, or a description that is no strip, point, edge or facet */
  GVD_OUT_OF_MEMORY = 2,
  GVD_INTERNAL_ERROR = 3 /* a defect of the library */
} gvd_status;

/* The stage that decided. */
typedef enum gvd_stage { GVD_IDENTITY = 0, GVD_FILTER, GVD_DOUBLE_DOUBLE, GVD_MPFR, GVD_ALGEBRA, GVD_UNDECIDED } gvd_stage;
const char* gvd_stage_name(gvd_stage stage);

/* What is not decided is not zero: zero is proved. */
typedef enum gvd_sign { GVD_NEGATIVE = -1, GVD_ZERO = 0, GVD_POSITIVE = 1, GVD_UNKNOWN = 2 } gvd_sign;
typedef struct gvd_decision {
  gvd_sign sign; /* GVD_UNKNOWN if and only if stage is GVD_UNDECIDED */
  gvd_stage stage;
} gvd_decision;

typedef struct gvd_enclosure {
  double lower, upper; /* lower <= truth <= upper */
} gvd_enclosure;

/* ---- strips: a source in a first face, and the faces crossed from there on ---- */

typedef struct gvd_strip gvd_strip;

/* corners: x y z of the three corners, counter-clockwise (that fixes left and right). The source is the point
 * (w0 V0 + w1 V1 + w2 V2) / (w0 + w1 + w2), w >= 0: exactly that rational point, so {1, 1, 1} is the centroid and {1, 0, 0} a vertex. */
gvd_status gvd_strip_create(const double corners[9], const double source[3], gvd_strip** strip);
/* The same with indices into x y z of `vertex_count` vertices. */
gvd_status gvd_strip_create_indexed(const double* vertices, size_t vertex_count, const uint32_t face[3], const double source[3],
                                    gvd_strip** strip);
gvd_status gvd_strip_copy(const gvd_strip* strip, gvd_strip** copy);
void gvd_strip_free(gvd_strip* strip);

/* Goes on into a face that shares an edge with the last one. Its corner that is not on that edge becomes the next vertex of the strip:
 * 0, 1, 2 are the corners of the first face, then comes one a face crossed. */
gvd_status gvd_strip_cross(gvd_strip* strip, const double corners[9]);
gvd_status gvd_strip_cross_indexed(gvd_strip* strip, const double* vertices, size_t vertex_count, const uint32_t face[3]);
/* 3 + the number of faces crossed; 0 for NULL. */
size_t gvd_strip_vertex_count(const gvd_strip* strip);

/* On which side of the ray from the source's image through vertex `through` vertex v lies: positive on the left. */
gvd_status gvd_ray_side(const gvd_strip* strip, size_t through, size_t v, gvd_decision* decision);

typedef enum gvd_sight { GVD_SEES_NOTHING = 0, GVD_SEES_INTERVAL = 1, GVD_SIGHT_UNKNOWN = 2 } gvd_sight;
typedef struct gvd_cone {
  gvd_sight sight;
  size_t left, right; /* the vertices whose rays bound what the source sees, if it sees an interval of the last edge crossed */
  gvd_stage stage;    /* the latest that took part */
} gvd_cone;
gvd_status gvd_cone_of(const gvd_strip* strip, gvd_cone* cone);

/* ---- paths: straight legs through strips, after a given length ---- */

typedef struct gvd_path gvd_path;

gvd_status gvd_path_create(double given, gvd_path** path);
/* A leg from the source of the strip (copied) to a point of its last face, weights in the order of its corners as they were given. */
gvd_status gvd_path_add_leg(gvd_path* path, const gvd_strip* strip, const double end[3]);
void gvd_path_free(gvd_path* path);

/* The sign of length(a) - length(b). */
gvd_status gvd_compare_lengths(const gvd_path* a, const gvd_path* b, gvd_decision* decision);
gvd_status gvd_length(const gvd_path* path, gvd_enclosure* length);
/* The double nearest to the length. With stage GVD_UNDECIDED the value is not a number. */
gvd_status gvd_rounded_length(const gvd_path* path, double* value, gvd_stage* stage);

/* ---- windows: a strip, and the path that brought the wave to its source ---- */

typedef struct gvd_window gvd_window;

/* weight: NULL for a true source. cone: the two vertices that bound what the window sees, left and right, or NULL if it sees everything.
 * Strip and path are copied. */
gvd_status gvd_window_create(const gvd_strip* strip, const gvd_path* weight, const size_t cone[2], gvd_window** window);
void gvd_window_free(gvd_window* window);

typedef enum gvd_tie_kind {
  GVD_TIES_NONE = 0,       /* one window is nearer all along: a_is_nearer */
  GVD_TIES_POINTS = 1,     /* count places, in the order of the edge */
  GVD_TIES_EVERYWHERE = 2, /* all along the edge */
  GVD_TIES_RAY = 3,        /* from ties[0].t on to an end of the edge */
  GVD_TIES_UNKNOWN = 4
} gvd_tie_kind;
typedef struct gvd_edge_ties {
  gvd_tie_kind kind;
  int a_is_nearer;
  int count; /* 0, 1 or 2 */
  struct {
    gvd_enclosure t; /* 0 at the first end, 1 at the second */
    int a_before;    /* whether a is the nearer one just before */
    int is_contact;  /* they touch without crossing */
  } ties[2];
  gvd_stage stage;
} gvd_edge_ties;
/* Where two windows tie on an edge of the last faces of both (x y z of its two ends), their cones aside. */
gvd_status gvd_ties_on_edge(const gvd_window* a, const gvd_window* b, const double edge[6], gvd_edge_ties* ties);

typedef enum gvd_conflict_verdict {
  GVD_NO_VERTEX = 0, /* the three tie nowhere in this order, or one does not see the point */
  GVD_FARTHER = 1,
  GVD_TIES = 2,
  GVD_NEARER = 3, /* the rival is nearer: the vertex is none of the diagram */
  GVD_CONFLICT_UNKNOWN = 4
} gvd_conflict_verdict;
/* What the rival is to the point at which i, j, k tie, their regions counter-clockwise round it. facet: the last face of all four,
 * counter-clockwise. */
gvd_status gvd_conflict(const double facet[9], const gvd_window* i, const gvd_window* j, const gvd_window* k, const gvd_window* rival,
                        gvd_conflict_verdict* verdict, gvd_stage* stage);

#ifdef __cplusplus
}
#endif

#endif
