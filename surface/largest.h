/* The largest value of a field, for a message that says how far off a threshold is. */
#ifndef SURFACE_LARGEST_H
#define SURFACE_LARGEST_H

#include "surface/field.h"

/* The largest value found at the middles of leaves, their faces and their first sub-cells, and uphill from
 * the best of these; and the point, in the octree's cells. Where sigma is wide, one leaf in each aligned cube
 * of up to its size is enough. The search ends with the first value that is `enough` or more, HUGE_VAL for
 * the largest of all. Errors: STATUS_NO_MEMORY. */
enum status field_largest(const struct field *field, double enough, double *value, double point[3],
                          struct error *err);

#endif
