/* @METHOD@ and @LAW@ for @TESTBED@: see README.md.

   SI throughout. Body axes as in the testbed file; attitude as a unit quaternion w x y z from body
   to laboratory, whose z points up; displacements in m from home, in the order: @NAMES@. */

#ifndef EQUIPOISE_H
#define EQUIPOISE_H

#include <stdbool.h>

#define EQUIPOISE_MASSES @MASSES@

/* Numbers: double, or float with -DEQUIPOISE_FLOAT. */
#ifdef EQUIPOISE_FLOAT
typedef float real_t;
#else
typedef double real_t;
#endif

/* The whole memory: no heap, nothing static that changes. The fields out_... are for the board. */
typedef struct {
@FIELDS@
} equipoise_t;

/* Set the memory to what the testbed file says, before the first row. */
void equipoise_begin(equipoise_t *self);

/* Take a row that was measured dt s after the last one (0 for the first): attitude q, rate in rad/s
   without bias, masses at d m, all at the moment of the measurement. Afterwards

       self->out_com[3]           m, centre of mass from the centre of rotation, masses at home
       self->out_com_sd[3]        m, one sd by the method
       self->out_displacement[@MASSES@]  m, where the masses are to go
       self->out_finished[0]      the law has done its work */
void equipoise_row(equipoise_t *self, real_t dt, const real_t q[4], const real_t rate[3],
                   const real_t d[EQUIPOISE_MASSES]);

#endif
