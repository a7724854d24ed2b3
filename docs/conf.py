"""What Sphinx needs to know; `make docs` gathers the pages and builds (`docs/site`)."""

from equipoise.model.version import __version__

project = "Equipoise"
author = "Equipoise contributors"
project_copyright = f"2026, {author}"
release = version = __version__
language = "en"

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "docs.site.access",
    "docs.site.linked_names",
]
exclude_patterns = ["decisions/0000-template.md"]

# --- Pages -----------------------------------------------------------------------------------

myst_heading_anchors = 4
nb_execution_mode = "off"  # `make docs` executes notebooks without outputs
nb_execution_timeout = 120  # s, chosen: a notebook that takes longer is too long for a reader
nb_execution_raise_on_error = True

autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
autodoc_member_order = "bysource"
napoleon_google_docstring = False
napoleon_use_rtype = False
add_module_names = False
python_maximum_signature_line_length = 78  # a line of a page

# --- Looks -----------------------------------------------------------------------------------
# Furo brings its fonts and scripts: no page asks another host.

html_theme = "furo"
html_title = f"Equipoise {release}"
html_show_sourcelink = False
html_copy_source = False
html_static_path = ["site/style"]
html_css_files = ["site.css"]
