/* Written by equipoise generate: the library's own functions in C99. Do not edit. */

#include "equipoise.h"

#include <math.h>
#include <string.h>

#ifdef EQUIPOISE_FLOAT
#define R(x) ((real_t)x)
#define eq_sin sinf
#define eq_cos cosf
#define eq_atan2 atan2f
#define eq_sqrt sqrtf
#define eq_exp expf
#define eq_pow powf
#define eq_fabs fabsf
#define eq_ceil ceilf
#define eq_floor floorf
#else
#define R(x) (x)
#define eq_sin sin
#define eq_cos cos
#define eq_atan2 atan2
#define eq_sqrt sqrt
#define eq_exp exp
#define eq_pow pow
#define eq_fabs fabs
#define eq_ceil ceil
#define eq_floor floor
#endif

@FUNCTIONS@

void equipoise_begin(equipoise_t *self)
{
    memset(self, 0, sizeof *self);
@BEGINNINGS@
}

void equipoise_row(equipoise_t *self, real_t dt, const real_t q[4], const real_t rate[3],
                   const real_t d[EQUIPOISE_MASSES])
{
@ENTRY@
}
