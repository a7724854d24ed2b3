"""Find the header of a text table, and name its columns.

Motive writes several header lines (kind, name, identity, rotation or position) above the one with
X, Y, Z, W; a name that occurs twice there is told apart by what stands above it.
"""

SHARE = 0.5  # of a row's filled cells that must be numbers for it to hold data (chosen)
ABOVE = 3  # filled cells that a line above the header needs to belong to it (chosen)


def header_row(rows: list[list[str]]) -> int:
    """Return the row before the first one that holds data; the first if none does."""
    first = next((i for i, row in enumerate(rows) if _holds_data(row)), 1)
    return max(first - 1, 0)


def column_names(rows: list[list[str]], head: int) -> tuple[str, ...]:
    """Return a name for each column; it is empty where the header has none."""
    names = [name.strip() for name in rows[head]]
    filled = [name for name in names if name]
    if len(set(filled)) == len(filled):
        return tuple(names)
    above = [row for row in rows[:head] if sum(bool(c.strip()) for c in row[2:]) >= ABOVE]
    return tuple(_full_name(name, i, above) for i, name in enumerate(names))


def _full_name(name: str, column: int, above: list[list[str]]) -> str:
    """Return a name with what stands above it, as kind/name/rotation/X."""
    parents = [row[column].strip() for row in above if column < len(row)]
    return "/".join([*filter(None, parents), name])


def _holds_data(row: list[str]) -> bool:
    filled = [cell for cell in row if cell.strip()]
    return len(filled) > 1 and sum(map(_is_number, filled)) > SHARE * len(filled)


def _is_number(cell: str) -> bool:
    try:
        float(cell.replace(",", "."))
    except ValueError:
        return False
    return True
