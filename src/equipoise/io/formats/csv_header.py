"""Find the header of a text table, and name its columns.

Motive writes several header lines (kind, name, identity, rotation or position) above the one with
X, Y, Z, W; a name that occurs twice there is told apart by what stands above it.
"""

HEAD_ROWS = 50  # rows; chosen: more than any header has
SHARE = 0.5  # of a row's filled cells that must be numbers for it to hold data (chosen)
ABOVE = 3  # filled cells that a line above the header needs to belong to it (chosen)


def header_row(rows: list[list[str]]) -> int:
    """Return the row before the first that holds data, as the next does; the first if none does.

    Motive's line of identities is all numbers as well, but more header follows it.
    """
    data = [_holds_data(row) for row in rows[:HEAD_ROWS]]
    pairs = zip(data, [*data[1:], True], strict=True)
    first = next((i for i, (this, after) in enumerate(pairs) if this and after), 1)
    return max(first - 1, 0)


def column_names(rows: list[list[str]], head: int) -> tuple[str, ...]:
    """Return a name for each column; it is empty where the header has none."""
    names = [name.strip() for name in rows[head]]
    filled = [name for name in names if name]
    if len(set(filled)) == len(filled):
        return tuple(names)
    # Motive leaves the first cell of these lines blank; its line of settings begins with text.
    above = [row for row in rows[:head] if not row[0].strip() and _filled(row) >= ABOVE]
    return tuple(_full_name(name, i, above) for i, name in enumerate(names))


def _full_name(name: str, column: int, above: list[list[str]]) -> str:
    """Return a name with what stands above it, as kind/name/rotation/X."""
    parents = [row[column].strip() for row in above if column < len(row)]
    return "/".join([*filter(None, parents), name])


def _filled(row: list[str]) -> int:
    return sum(bool(cell.strip()) for cell in row)


def _holds_data(row: list[str]) -> bool:
    filled = [cell for cell in row if cell.strip()]
    return len(filled) > 1 and sum(map(_is_number, filled)) > SHARE * len(filled)


def _is_number(cell: str) -> bool:
    try:
        float(cell.replace(",", "."))
    except ValueError:
        return False
    return True
