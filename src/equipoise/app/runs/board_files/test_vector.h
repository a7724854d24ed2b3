/* Rows of a simulated run, and what the library answers to each. Hexadecimal: exact. */

#ifndef TEST_VECTOR_H
#define TEST_VECTOR_H

#define VECTOR_ROWS @ROWS@

/* t (s), q (w x y z), rate (rad/s), displacements (m) */
static const double vector_rows[VECTOR_ROWS][@ROW_WIDTH@] = {
@VECTOR_ROWS@
};

/* centre of mass (m), its sd (m), displacements wanted (m) */
static const double vector_results[VECTOR_ROWS][@RESULT_WIDTH@] = {
@VECTOR_RESULTS@
};

#endif
