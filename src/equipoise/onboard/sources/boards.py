"""How much RAM a generated program needs, and on which boards it fits."""

from equipoise.onboard.sources.translated import Translated

# RAM in bytes: the smallest and the largest board of da Silva et al. 2021, Table 1, and a third.
BOARDS = (
    ("Arduino Uno, 2 KB", 2 * 1024),
    ("a board of 8 KB", 8 * 1024),
    ("Arduino Due, 96 KB", 96 * 1024),
)
# Bytes of stack, chosen: above what gcc -Os says of either law, in single precision with pointers
# of 64 bits. A processor with shorter pointers takes less.
STACK = {"ekf_9": 3072, "momentum_recursive": 640}


def verdicts(found: Translated) -> list[str]:
    """Return for each board whether the program fits."""
    needed = found.state_bytes + found.table_bytes + STACK[found.method]
    return [
        f"- {name}: {'fits' if needed <= size else 'does not fit'} ({needed} bytes needed)"
        for name, size in BOARDS
    ]
