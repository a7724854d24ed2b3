"""The one look of all tables in the terminal."""

from collections.abc import Mapping, Sequence

from rich.console import Group
from rich.table import Table
from rich.text import Text

from equipoise.app.console.terminal import stdout
from equipoise.app.text.sheet import Sheet


def quiet_table() -> Table:
    """Return a table without lines between rows."""
    return Table(box=None, pad_edge=False)


def named_rows(texts: Sequence[tuple[str, str]]) -> Table:
    """Return names and texts, line by line."""
    table = quiet_table()
    table.show_header = False
    table.add_column(style="bold", no_wrap=True)
    table.add_column()
    for name, text in texts:
        table.add_row(name, text)
    return table


def titled(title: str, table: Table) -> Group:
    """Return a table under its title, which may be the wider one."""
    return Group(Text(title, style="bold"), table)


def show_sheet(sheet: Sheet, bad: Mapping[str, bool] | None = None) -> None:
    """Print a table; remarks of what warns stand out."""
    table, console = quiet_table(), stdout()
    for k, head in enumerate(sheet.heads):
        justify = "left" if k in sheet.words else "right"
        table.add_column(head, justify=justify, style="" if k else "bold")
    for line in sheet.lines:
        table.add_row(*map(Text, line))
    console.print()
    console.print(titled(sheet.title, table))
    for remark in sheet.remarks:
        style = "yellow" if (bad or {}).get(remark.split(":")[0]) else ""
        console.print(remark, style=style, markup=False)
