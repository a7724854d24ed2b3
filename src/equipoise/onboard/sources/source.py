"""The source: the translated functions, and the two that a board calls."""

from equipoise.onboard.sources.translated import Translated, beginnings

MACROS = """\
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
"""


def source(found: Translated) -> str:
    """Return equipoise.c."""
    lines = "\n".join(f"    {line}" for line in beginnings(found.fields))
    unused = [f"    (void){name};" for name in ("q", "rate", "d") if f" {name}" not in found.call]
    entry = "\n".join([*unused, f"    {found.call}"])
    return f"""\
/* Written by equipoise generate: the library's own functions in C99. Do not edit. */

#include "equipoise.h"

#include <math.h>
#include <string.h>

{MACROS}
{found.functions}

void equipoise_begin(equipoise_t *self)
{{
    memset(self, 0, sizeof *self);
{lines}
}}

void equipoise_row(equipoise_t *self, real_t dt, const real_t q[4], const real_t rate[3],
                   const real_t d[EQUIPOISE_MASSES])
{{
{entry}
}}
"""
