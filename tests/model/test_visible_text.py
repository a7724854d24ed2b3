"""What a person sees of a text."""

import pytest

from equipoise.model.visible_text import is_all_visible

HIDDEN = ["\x1b[2J", "a\nb", "\x7f", "\x9b0m", "\u202eabc", "\u2066a", "a\u200bb", "\ufeffa",
          "\u2028", "\u2029", "\ud800", "\ue000", "\uffff"]  # fmt: skip


@pytest.mark.parametrize("text", ["", "sat", "Ebene 3", "a\u00a0b", "\u3000", "卫星", "é", "🛰"])
def test_letters_signs_and_blanks_are_visible(text):
    assert is_all_visible(text)


@pytest.mark.parametrize("text", HIDDEN, ids=ascii)
def test_what_hides_or_acts_is_not(text):
    assert not is_all_visible(text)
