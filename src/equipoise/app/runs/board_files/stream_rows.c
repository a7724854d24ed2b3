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
    bool started = false;
    equipoise_begin(&board);
    while (fgets(line, sizeof line, stdin) != NULL) {
        real_t row[NUMBERS];
        char *rest = line;
        const double t = strtod(rest, &rest);
        for (int k = 1; k < NUMBERS; k++) {
            row[k] = (real_t)strtod(rest, &rest);
        }
        equipoise_row(&board, (real_t)(started ? t - last : 0.0), row + 1, row + 5, row + 8);
        last = t;
        started = true;
        for (int k = 0; k < 3; k++) {
            printf("%.17g ", (double)board.out_com[k]);
        }
        for (int k = 0; k < 3; k++) {
            printf("%.17g ", (double)board.out_com_sd[k]);
        }
        for (int k = 0; k < EQUIPOISE_MASSES; k++) {
            printf("%.17g ", (double)board.out_displacement[k]);
        }
        printf("%d\n", board.out_finished[0] ? 1 : 0);
        fflush(stdout);
    }
    return 0;
}
