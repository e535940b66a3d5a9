#pragma once

// <gmpxx.h> declares templates named sqrt, floor, trunc, ...: where they come before the functions of <cmath>, GCC 12 does not know those as
// built-in, and every square root is a call. So this is the one place that includes it.
#include <cmath>

#include <gmpxx.h>
