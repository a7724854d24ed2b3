"""The README of a generated program: what it is, what it needs, on which boards it fits."""

from equipoise.onboard.sources.translated import Translated

# RAM in bytes: the smallest and the largest board of da Silva et al. 2021, Table 1, and a third.
BOARDS = (
    ("Arduino Uno, 2 KB", 2 * 1024),
    ("a board of 8 KB", 8 * 1024),
    ("Arduino Due, 96 KB", 96 * 1024),
)
# Bytes of stack, chosen: above what gcc -Os says of either law, in single precision with pointers
# of 64 bits. A processor with shorter pointers takes less.
STACK = {"ekf_9": 3072, "momentum_recursive": 512}


def verdicts(found: Translated) -> list[str]:
    """Return for each board whether the program fits."""
    needed = found.state_bytes + found.table_bytes + STACK[found.method]
    return [
        f"- {name}: {'fits' if needed <= size else 'does not fit'} ({needed} bytes needed)"
        for name, size in BOARDS
    ]


def readme(found: Translated) -> str:
    """Return README.md."""
    lines = "\n".join(verdicts(found))
    return f"""\
# {found.method} and {found.law} for {found.testbed.name}

C99 without heap, written by `equipoise generate c` from the library's own functions.

```c
static equipoise_t board;
equipoise_begin(&board);
/* for each row of the sensor: */
equipoise_row(&board, dt, q, rate, d);
/* then send the masses to board.out_displacement */
```

- `equipoise.h`, `equipoise.c`: all that a board needs. `-DEQUIPOISE_FLOAT`: single precision.
- `replay_test_vector.c`, `test_vector.h`: `ctest` compares every result with the library's.
- `stream_rows.c`: one row a line of input, one answer a line of output.

```sh
cmake -S . -B build && cmake --build build && ctest --test-dir build
```

## Memory in single precision

{found.state_bytes} bytes of struct, {found.table_bytes} bytes of constant tables (which AVR
processors copy to RAM) and {STACK[found.method]} bytes allowed for the stack:

{lines}
"""
