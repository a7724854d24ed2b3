"""Programs for a computer: one replays the test vector, one goes along rows as they come."""

from collections.abc import Sequence

from equipoise.model.arrays import Floats
from equipoise.onboard.sources.translated import Translated

WITHIN = 0.1  # chosen: of the stated sd, by which single precision may differ

REPLAY = """\
/* Replays the test vector. Ends with 0 if the results are the same: every bit in double precision;
   in single precision the centre of mass within %(within)g of its stated sd. */

#include "equipoise.h"
#include "test_vector.h"

#include <math.h>
#include <stdio.h>

static equipoise_t board;

int main(void)
{
    double worst = 0.0, last = vector_rows[0][0];
    long different = 0;
    equipoise_begin(&board);
    for (int i = 0; i < VECTOR_ROWS; i++) {
        const double *row = vector_rows[i], *wanted = vector_results[i];
        real_t q[4], rate[3], d[EQUIPOISE_MASSES];
        for (int k = 0; k < 4; k++) {
            q[k] = (real_t)row[1 + k];
        }
        for (int k = 0; k < 3; k++) {
            rate[k] = (real_t)row[5 + k];
        }
        for (int k = 0; k < EQUIPOISE_MASSES; k++) {
            d[k] = (real_t)row[8 + k];
        }
        equipoise_row(&board, (real_t)(row[0] - last), q, rate, d);
        last = row[0];
        for (int k = 0; k < 3; k++) {
            const double off = fabs((double)board.out_com[k] - wanted[k]) / wanted[3 + k];
            worst = off > worst ? off : worst;
            different += (double)board.out_com[k] != wanted[k];
            different += (double)board.out_com_sd[k] != wanted[3 + k];
        }
        for (int k = 0; k < EQUIPOISE_MASSES; k++) {
            different += (double)board.out_displacement[k] != wanted[6 + k];
        }
    }
    printf("rows %%d, numbers that differ %%ld, greatest difference %%.3g sd, memory %%lu bytes\\n",
           VECTOR_ROWS, different, worst, (unsigned long)sizeof board);
    return sizeof(real_t) == sizeof(double) ? different != 0 : !(worst <= %(within)g);
}
"""

STREAM = """\
/* Takes a row from each line of input (t, q, rate, d) and answers with a line: the centre of mass,
   its sd, the displacements, and 1 once the law has finished. */

#include "equipoise.h"

#include <stdio.h>
#include <stdlib.h>

#define NUMBERS (8 + EQUIPOISE_MASSES)

static equipoise_t board;

int main(void)
{
    static char line[64 * (NUMBERS + 1)];
    double last = 0.0;
    bool begun = false;
    equipoise_begin(&board);
    while (fgets(line, sizeof line, stdin) != NULL) {
        real_t row[NUMBERS];
        char *rest = line;
        const double t = strtod(rest, &rest);
        for (int k = 1; k < NUMBERS; k++) {
            row[k] = (real_t)strtod(rest, &rest);
        }
        equipoise_row(&board, (real_t)(begun ? t - last : 0.0), row + 1, row + 5, row + 8);
        last = t;
        begun = true;
        for (int k = 0; k < 3; k++) {
            printf("%.17g ", (double)board.out_com[k]);
        }
        for (int k = 0; k < 3; k++) {
            printf("%.17g ", (double)board.out_com_sd[k]);
        }
        for (int k = 0; k < EQUIPOISE_MASSES; k++) {
            printf("%.17g ", (double)board.out_displacement[k]);
        }
        printf("%d\\n", board.out_finished[0] ? 1 : 0);
        fflush(stdout);
    }
    return 0;
}
"""

CMAKE = """\
# Builds the library equipoise, and two programs that run on a computer.
cmake_minimum_required(VERSION 3.10)
project(equipoise_board C)

option(EQUIPOISE_FLOAT "single precision, for processors without double" OFF)

add_library(equipoise STATIC equipoise.c)
set_target_properties(equipoise PROPERTIES C_STANDARD 99 C_STANDARD_REQUIRED ON)
target_include_directories(equipoise PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
if(EQUIPOISE_FLOAT)
  target_compile_definitions(equipoise PUBLIC EQUIPOISE_FLOAT)
endif()
# Fused multiplication and addition rounds once where Python rounds twice.
if(CMAKE_C_COMPILER_ID MATCHES "GNU|Clang")
  target_compile_options(equipoise PRIVATE -ffp-contract=off -Wall -Wextra)
endif()
find_library(MATH_LIBRARY m)
if(MATH_LIBRARY)
  target_link_libraries(equipoise PUBLIC ${MATH_LIBRARY})
endif()

foreach(program replay_test_vector stream_rows)
  add_executable(${program} ${program}.c)
  set_target_properties(${program} PROPERTIES C_STANDARD 99)
  target_link_libraries(${program} equipoise)
endforeach()
enable_testing()
add_test(NAME replay_test_vector COMMAND replay_test_vector)
"""


def replay_program() -> str:
    """Return replay_test_vector.c."""
    return REPLAY % {"within": WITHIN}


def numbers(rows: Sequence[Floats]) -> str:
    """Return rows of numbers as C has them, exact to the last bit."""
    return ",\n".join("    {" + ", ".join(float(x).hex() for x in row) + "}" for row in rows)


def test_vector(found: Translated, rows: Sequence[Floats], results: Sequence[Floats]) -> str:
    """Return test_vector.h; hexadecimal numbers are exact."""
    masses, count = len(found.testbed.masses), len(rows)
    return f"""\
/* Rows of a simulated run, and what the library answers to each. Hexadecimal: exact. */

#ifndef TEST_VECTOR_H
#define TEST_VECTOR_H

#define VECTOR_ROWS {count}

/* t (s), q (w x y z), rate (rad/s), displacements (m) */
static const double vector_rows[VECTOR_ROWS][{8 + masses}] = {{
{numbers(rows)}
}};

/* centre of mass (m), its sd (m), displacements wanted (m) */
static const double vector_results[VECTOR_ROWS][{6 + masses}] = {{
{numbers(results)}
}};

#endif
"""
