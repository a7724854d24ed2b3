"""The server as it runs, open to a network: what its own sockets refuse, and who gets in."""

import urllib.error
import urllib.request

import pytest
from playwright.sync_api import expect
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from equipoise.app.dashboard.server.gate import LARGEST
from equipoise.hardware.bench.stop_signals import STOPPING
from tests.support import thorough
from tests.support.dashboard_program import CHROMIUM, Received, browser, dashboard, started

SOCKETS = ("/live", "/_nicegui_ws/socket.io/?EIO=4&transport=websocket")
LATER = 120_000  # ms


@pytest.fixture(scope="module")
def running(tmp_path_factory):
    """An address that others may open, as with --expose; here it is this computer's own."""
    folder = tmp_path_factory.mktemp("exposed")
    words = ("nanosat", "--expose", "127.0.0.1")
    with dashboard(folder, *words, ended_with=STOPPING[-1]) as there:
        yield there


@thorough.whole
@pytest.mark.parametrize("number", STOPPING)
def test_ctrl_c_and_its_like_end_it_without_a_fault(tmp_path, number):
    assert started(tmp_path, "nanosat").end(number) == 0
    assert "Traceback" not in (tmp_path / "printed.txt").read_text()


def here(running):
    return f"http://127.0.0.1:{running.port}"


def opened(running, path, origin=None, token=None):
    headers = {} if token is None else {"Cookie": f"equipoise_token={token}"}
    address = f"ws://127.0.0.1:{running.port}{path}"
    return connect(address, origin=origin, additional_headers=headers, open_timeout=60)


def status_of(address, token=None):
    headers = {} if token is None else {"Cookie": f"equipoise_token={token}"}
    try:
        with urllib.request.urlopen(urllib.request.Request(address, headers=headers)) as answer:
            return answer.status
    except urllib.error.HTTPError as error:
        return error.code


@pytest.mark.parametrize("path", SOCKETS)
def test_sockets_open_to_our_page_with_the_token(running, path):
    with opened(running, path, here(running), running.token) as socket:
        assert socket.recv(timeout=60)


@pytest.mark.parametrize("path", SOCKETS)
@pytest.mark.parametrize("origin", ["http://evil.example", "null", None])
def test_sockets_are_closed_to_other_origins(running, path, origin):
    with pytest.raises(InvalidStatus) as refused:
        opened(running, path, origin, running.token)
    assert refused.value.response.status_code == 403


@pytest.mark.parametrize("path", SOCKETS)
@pytest.mark.parametrize("token", [None, "wrong"])
def test_sockets_are_closed_without_the_token(running, path, token):
    with pytest.raises(InvalidStatus) as refused:
        opened(running, path, here(running), token)
    assert refused.value.response.status_code == 403


def received_after(socket, message):
    socket.send(message)
    for _ in range(1000):
        socket.recv(timeout=60)


@pytest.mark.parametrize("path", SOCKETS)
def test_an_oversized_message_ends_its_connection_alone(running, path):
    with opened(running, path, here(running), running.token) as other:
        with opened(running, path, here(running), running.token) as socket:
            socket.recv(timeout=60)
            with pytest.raises(ConnectionClosed) as closed:
                received_after(socket, "4" * (LARGEST + 1))
            assert closed.value.rcvd.code == 1009  # too big
        assert other.recv(timeout=60)
    assert running.process.poll() is None


def test_pages_and_files_need_the_token(running):
    for path in ("/", "/?token=wrong", "/static/page.js", "/runs/any.mcap"):
        assert status_of(here(running) + path) == 401
        assert status_of(here(running) + path, "wrong") == 401
    for path in ("/", "/static/page.js", "/favicon.ico"):
        assert status_of(here(running) + path, running.token) == 200


NOT_THERE = ("/runs/%00", "/runs/a%00.html", "/runs/%1b%5b2J", "/runs/" + "x" * 300, "/runs/",
             "/runs/%ff", "/nothing", "/_nicegui/x", "/_nicegui/%00", "/static/%00", "/static/x%0a",
             "/static/../secret", "/_nicegui_ws/socket.io/?EIO=4&transport=polling")  # fmt: skip


@pytest.mark.parametrize("path", NOT_THERE)
def test_what_is_not_there_is_404_and_no_fault(running, path):
    assert status_of(here(running) + path, running.token) == 404


def test_a_report_of_others_is_shown_without_scripts(running):
    folder = running.folder / "runs" / "theirs"
    folder.mkdir(parents=True)
    (folder / "report.html").write_text("<script>document.title = 'ran'</script>")
    headers = {"Cookie": f"equipoise_token={running.token}"}
    address = f"{here(running)}/runs/theirs/report.html"
    with urllib.request.urlopen(urllib.request.Request(address, headers=headers)) as answer:
        assert answer.headers["content-security-policy"].startswith("sandbox; default-src 'none'")
        assert answer.headers["x-content-type-options"] == "nosniff"


@thorough.whole
@pytest.mark.skipif(CHROMIUM is None, reason="no chromium: apt-get install chromium")
def test_the_address_that_was_printed_opens_the_page(running):
    """The token of the address lets a page observe; to command it is asked for once more."""
    with browser() as chromium:
        page = chromium.new_page()
        received = Received(page)
        page.goto(running.url)
        assert page.url == here(running) + "/"  # the token stays in no address
        expect(page.locator("#eq-link")).to_contain_text("connected", timeout=LATER)
        page.wait_for_function("() => window.equipoise?.state().link === 'open'", timeout=LATER)
        start = page.get_by_role("button", name="Start balancing", exact=True)
        expect(start).to_be_disabled()
        page.get_by_label("Token").fill(running.token)
        page.keyboard.press("Enter")
        expect(start).to_be_enabled(timeout=LATER)
        assert received.wrong == []
