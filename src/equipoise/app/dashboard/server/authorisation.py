"""Who commands: whoever has the token, and one page at a time. All others observe."""

import hmac
import secrets


def new_token() -> str:
    """Return a token that nobody guesses (128 bits)."""
    return secrets.token_urlsafe(16)


class Guard:
    """The token, and the page that commands."""

    def __init__(self, token: str) -> None:
        self._token = token
        self._commander: str | None = None

    def is_right(self, token: str) -> bool:
        """Say whether a token is the right one, in constant time."""
        return hmac.compare_digest(token.encode(), self._token.encode())

    def take(self, page: str, token: str) -> str:
        """Let a page command; return why not, or nothing."""
        if not self.is_right(token.strip()):
            return "Wrong token. The token was printed when the dashboard started."
        if self._commander not in (None, page):
            return "Another page is in command; release it there, or close that page."
        self._commander = page
        return ""

    def leave(self, page: str) -> None:
        """Let a page command no more, if it did."""
        if self._commander == page:
            self._commander = None

    def commands(self, page: str) -> bool:
        """Say whether a page commands."""
        return self._commander == page
