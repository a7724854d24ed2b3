/* Replays the test vector. Ends with 0 if the results are the same: every bit in double precision;
   in single precision the centre of mass within @WITHIN@ of its stated sd. */

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
    printf("rows %d, numbers that differ %ld, greatest difference %.3g sd, memory %lu bytes\n",
           VECTOR_ROWS, different, worst, (unsigned long)sizeof board);
    return sizeof(real_t) == sizeof(double) ? different != 0 : !(worst <= @WITHIN@);
}
