"""A page of a foreign origin, in a real browser: it neither reads nor commands."""

import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest
from playwright.sync_api import expect

from tests.support import thorough
from tests.support.dashboard_program import CHROMIUM, browser, dashboard

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no chromium: apt-get install chromium")
LATER = 120_000  # ms
FOREIGN = "evil.example"  # leads to this computer, as a foreign name may
TRIES = """async (to) => {
    const here = [];
    const settled = (make) => new Promise((resolve) => {
        const one = make();
        one.onload = one.onopen = () => resolve("came");
        one.onerror = one.onclose = () => resolve("refused");
        if (one instanceof Element) document.body.append(one);
    });
    const fetched = async (path, options) => {
        try {
            const answer = await fetch(to + path, options);
            return answer.type === "opaque" ? "refused" : "came";
        } catch { return "refused"; }
    };
    const paths = ["/", "/static/page.js", "/runs/theirs/report.html", "/favicon.ico"];
    for (const path of paths) {
        for (const mode of ["cors", "no-cors"]) for (const credentials of ["omit", "include"])
            here.push([path, mode, await fetched(path, { mode, credentials })]);
        here.push([path, "image", await settled(() =>
            Object.assign(new Image(), { src: to + path }))]);
        here.push([path, "script", await settled(() =>
            Object.assign(document.createElement("script"), { src: to + path }))]);
    }
    here.push(["/", "post", await fetched("/", { method: "POST", body: "x" })]);
    const sockets = ["/live", "/_nicegui_ws/socket.io/?EIO=4&transport=websocket"];
    for (const path of sockets)
        here.push([path, "socket", await settled(() =>
            new WebSocket(to.replace("http", "ws") + path))]);
    return here;
}"""
FRAMED = """async (to) => {
    const frame = document.createElement("iframe");
    frame.src = to + "/";
    document.body.append(frame);
    await new Promise((resolve) => (frame.onload = resolve));
    try { return frame.contentDocument.body.innerText; } catch { return "closed"; }
}"""


class Blank(BaseHTTPRequestHandler):
    def do_GET(self):
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(b"<!doctype html><title>theirs</title><body></body>")

    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def site():
    """The port of a foreign site."""
    with ThreadingHTTPServer(("127.0.0.1", 0), Blank) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield server.server_port
        server.shutdown()


@pytest.fixture(scope="module", params=thorough.some(["exposed", "loopback"], 1))
def running(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp(request.param)
    (folder / "runs" / "theirs").mkdir(parents=True)
    (folder / "runs" / "theirs" / "report.html").write_text("<p>secret</p>")
    words = ("--expose", "127.0.0.1") if request.param == "exposed" else ()
    with dashboard(folder, "nanosat", *words) as there:
        yield there


@pytest.fixture(scope="module")
def chromium():
    with browser(f"--host-resolver-rules=MAP {FOREIGN} 127.0.0.1") as opened:
        yield opened


@pytest.fixture
def context(chromium, running):
    """A browser in which our page is open and commands; a cookie is there where one is used."""
    made = chromium.new_context()
    page = made.new_page()
    page.goto(running.url)
    expect(page.locator("#eq-link")).to_contain_text("connected", timeout=LATER)
    page.get_by_label("Token").fill(running.token)
    page.keyboard.press("Enter")
    expect(page.get_by_role("button", name="Stop", exact=True)).to_be_enabled(timeout=LATER)
    yield made
    expect(page.locator("#eq-link")).to_contain_text("connected")
    assert page.evaluate("window.equipoise.state().steps") == 0
    page.get_by_role("button", name="Release", exact=True).click()  # it still commands
    expect(page.get_by_role("button", name="Command", exact=True)).to_be_visible()
    made.close()


def ours(running):
    return f"http://127.0.0.1:{running.port}"


@pytest.mark.parametrize("host", thorough.some([FOREIGN, "127.0.0.1", "localhost"], 1))
def test_it_neither_reads_nor_commands(context, running, site, host):
    """From another site, and from another port of this computer, which a cookie does not tell."""
    theirs = context.new_page()
    theirs.goto(f"http://{host}:{site}/")
    outcomes = theirs.evaluate(TRIES, ours(running))
    assert len(outcomes) > 20
    assert [outcome for outcome in outcomes if outcome[2] != "refused"] == []
    assert theirs.evaluate(FRAMED, ours(running)) == "closed"


@thorough.whole  # the gate's own tests hold the headers that a browser sends
@pytest.mark.parametrize("host", ["127.0.0.1", FOREIGN])
def test_a_link_on_another_site_does_not_open_it(context, running, site, host):
    theirs = context.new_page()
    theirs.goto(f"http://{host}:{site}/")
    with theirs.expect_navigation() as gone:
        theirs.evaluate("to => { location.href = to; }", running.url)
    assert gone.value.status == 403


@thorough.whole
def test_our_address_under_a_foreign_name_is_not_answered(context, running):
    answer = context.new_page().goto(f"http://{FOREIGN}:{running.port}/?token={running.token}")
    assert answer.status == 403


def test_a_report_of_others_runs_nothing_and_reads_nothing(context, running):
    report = running.folder / "runs" / "theirs" / "attack.html"
    report.write_text(
        "<title>still</title><p style='color: red'>shown</p>"
        "<script>document.title = 'ran'; fetch('/').then(() => document.title = 'read')</script>"
        "<img src=x onerror=\"document.title = 'ran'\"><svg onload=\"document.title = 'ran'\"/>"
    )
    page = context.new_page()
    page.goto(f"{ours(running)}/runs/theirs/attack.html")
    expect(page.get_by_text("shown")).to_be_visible()
    page.wait_for_timeout(300)
    assert page.title() == "still"
    assert page.evaluate("window.origin") == "null"
