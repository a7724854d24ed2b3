"""Who may speak with the dashboard: by host, origin, token, size; and who commands."""

import pytest
from starlette.applications import Starlette
from starlette.responses import PlainTextResponse
from starlette.routing import Route, WebSocketRoute
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from equipoise.app.dashboard.protocol import data_folder
from equipoise.app.dashboard.protocol.data_folder import recordings, within
from equipoise.app.dashboard.server.authorisation import Guard, new_token
from equipoise.app.dashboard.server.gate import COOKIE, LARGEST, SOCKETS, Doors, Gate
from equipoise.app.dashboard.server.limits import Bucket
from equipoise.app.dashboard.server.policies import of_file
from equipoise.app.dashboard.server.serving import bracketed, names
from equipoise.model.errors import InputError

HERE, TOKEN = "127.0.0.1:8080", "the-token"


async def page(request):
    return PlainTextResponse(f"{len(await request.body())} bytes")


async def live(socket):
    await socket.accept()
    await socket.send_text("rows")
    await socket.close()


def client(exposed=False, host=HERE):
    routes = [Route("/", page), Route("/static/a", page), WebSocketRoute("/live", live)]
    doors = Doors(frozenset({HERE, "localhost:8080"}), exposed)
    gate = Gate(Starlette(routes=routes), doors, Guard(TOKEN))
    return TestClient(gate, base_url=f"http://{host}", raise_server_exceptions=False)


def receives(client, headers=None):
    with client.websocket_connect(f"ws://{client.base_url.netloc.decode()}/live",
                                  headers=headers or {}) as socket:  # fmt: skip
        return socket.receive_text()


def with_token(token=TOKEN, origin=f"http://{HERE}"):
    cookie = {} if token is None else {"cookie": f"{COOKIE}={token}"}
    return cookie | ({} if origin is None else {"origin": origin})


def test_a_request_to_our_own_address_is_admitted():
    for host in (HERE, "localhost:8080"):
        assert client(host=host).get("/").status_code == 200
        assert receives(client(host=host), {"origin": f"http://{host}"}) == "rows"


def test_another_name_for_us_is_refused():
    """A foreign page may have its own name lead to 127.0.0.1."""
    for host in ("evil.example:8080", "127.0.0.1:9999", "127.0.0.1"):
        answer = client(host=host).get("/")
        assert answer.status_code == 403
        assert "not served at" in answer.json()["refused"]


FOREIGN = ("http://evil.example", "https://127.0.0.1:8080", "null", "http://127.0.0.1:8081",
           "http://127.0.0.1:8080.evil.example")  # fmt: skip


@pytest.mark.parametrize("origin", FOREIGN)
def test_a_foreign_origin_is_refused(origin):
    assert client().get("/", headers={"origin": origin}).status_code == 403
    with pytest.raises(WebSocketDisconnect) as refused:
        receives(client(), {"origin": origin})
    assert refused.value.code == 1008


@pytest.mark.parametrize("site", ["cross-site", "same-site", "anything"])
def test_what_another_site_has_begun_is_refused(site):
    """A picture, a form, a link: no origin, but the browser says from where it comes."""
    headers = {"sec-fetch-site": site}
    assert client().get("/", headers=headers).status_code == 403
    assert client().get("/static/a", headers=headers).status_code == 403
    given = client(exposed=True).get("/", params={"token": TOKEN}, headers=headers)
    assert given.status_code == 403
    assert "set-cookie" not in given.headers
    with pytest.raises(WebSocketDisconnect):
        receives(client(), headers)


@pytest.mark.parametrize("site", ["none", "same-origin"])
def test_what_a_person_types_and_what_our_page_fetches_passes(site):
    assert client().get("/", headers={"sec-fetch-site": site}).status_code == 200


def test_beyond_loopback_a_socket_needs_an_origin():
    assert receives(client()) == "rows"
    with pytest.raises(WebSocketDisconnect):
        receives(client(exposed=True), with_token(origin=None))
    assert receives(client(exposed=True), with_token()) == "rows"


@pytest.mark.parametrize("query", ["", "?token=", "?token=wrong", "?other=1", "?token=%00%ff"])
def test_beyond_loopback_nothing_is_served_without_the_token(query):
    assert client(exposed=True).get("/" + query).status_code == 401
    with pytest.raises(WebSocketDisconnect):
        receives(client(exposed=True), with_token(None))
    with pytest.raises(WebSocketDisconnect):
        receives(client(exposed=True), with_token("wrong"))


def test_the_token_moves_from_the_address_into_a_cookie():
    browser = client(exposed=True)
    answer = browser.get("/", params={"token": TOKEN}, follow_redirects=False)
    assert answer.status_code == 303
    assert answer.headers["location"] == "/"
    cookie = answer.headers["set-cookie"].lower()
    for part in (f"{COOKIE}={TOKEN}", "httponly", "samesite=strict", "path=/"):
        assert part in cookie
    assert browser.get("/").status_code == 200
    assert browser.get("/static/a").status_code == 200


def test_the_token_in_an_address_opens_the_page_alone():
    query = {"token": TOKEN}
    for path in ("/static/a", "/live", "/runs/a", "/nothing"):
        answer = client(exposed=True).get(path, params=query, follow_redirects=False)
        assert answer.status_code == 401
        assert "set-cookie" not in answer.headers


def test_on_loopback_no_address_sets_a_cookie():
    answer = client().get("/", params={"token": TOKEN}, follow_redirects=False)
    assert answer.status_code == 200
    assert "set-cookie" not in answer.headers


def test_the_dashboard_is_read_alone():
    for method in ("POST", "PUT", "DELETE", "OPTIONS", "PATCH", "TRACE"):
        assert client().request(method, "/").status_code == 405


@pytest.mark.parametrize("path", ["/nothing", "/runs", "/%00", "/..%2fsecret", "/_nicegui_ws/x"])
def test_what_is_not_there_costs_one_sentence(path):
    answer = client().get(path)
    assert answer.status_code == 404
    assert set(answer.json()) == {"refused"}


@pytest.mark.parametrize("size", [str(LARGEST + 1), "-1", "1e9", "9" * 5000, "a", "\u00b2"])
def test_a_request_that_is_too_large_is_refused(size):
    answer = client().get("/", headers={"content-length": size.encode("latin-1")})
    assert answer.status_code == 413


def test_a_request_that_does_not_say_how_large_it_is_is_cut_off():
    def pieces():
        for _ in range(3 * LARGEST // 1000):
            yield bytes(1000)

    assert client().request("GET", "/", content=pieces()).status_code != 200


# --- What a browser keeps to ---------------------------------------------------------------------


def directives(answer):
    policy = answer.headers["content-security-policy"]
    return {words.split()[0]: words.split()[1:] for words in policy.split("; ")}


def test_the_page_runs_no_script_but_its_own():
    policy = directives(client().get("/"))
    assert policy["default-src"] == ["'none'"]
    (script,) = policy["script-src"]
    assert script.startswith("'nonce-")
    assert len(script) > 22
    assert policy["style-src-attr"] == ["'none'"]
    assert policy["connect-src"] == ["'self'", f"ws://{HERE}"]
    assert policy["frame-ancestors"] == ["'none'"]


def test_no_answer_has_the_number_of_another():
    browser = client()
    assert len({browser.get("/").headers["content-security-policy"] for _ in range(20)}) == 20


@pytest.mark.parametrize("path", ["/", "/static/a", "/nothing", "/runs/a"])
def test_no_policy_allows_what_a_text_brings(path):
    for host in (HERE, "evil.example"):
        answer = client(host=host).get(path)
        policy = answer.headers["content-security-policy"]
        for word in ("unsafe", "http", "ws: ", "wss:", "*", "evil"):
            assert word not in policy
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert answer.headers["referrer-policy"] == "no-referrer"
        assert answer.headers["cross-origin-opener-policy"] == "same-origin"


@pytest.mark.parametrize("name", ["report.html", "report.HTM", "a.svg", "a.xml", "a", "a.pdf.html"])
def test_a_file_of_a_run_is_shown_without_scripts(name):
    policy = of_file(name)
    assert policy.startswith("sandbox; default-src 'none'")
    assert "script" not in policy


def test_a_pdf_is_shown_by_the_browser_itself():
    assert "sandbox" not in of_file("report.pdf")
    assert "default-src 'none'" in of_file("report.pdf")


# --- How many ------------------------------------------------------------------------------------


def test_pages_and_requests_are_limited():
    gate = client().app
    gate.pages, gate.requests = Bucket(0.0, 3), Bucket(0.0, 10)
    browser = TestClient(gate, base_url=f"http://{HERE}")
    assert [browser.get("/").status_code for _ in range(5)] == [200] * 3 + [429] * 2
    assert [browser.get("/static/a").status_code for _ in range(9)] == [200] * 7 + [429] * 2


def test_what_is_refused_takes_nobody_elses_place():
    gate = client().app
    gate.pages = gate.requests = Bucket(0.0, 2)
    for host, headers in (("evil.example", {}), (HERE, {"sec-fetch-site": "cross-site"})):
        visitor = TestClient(gate, base_url=f"http://{host}")
        assert [visitor.get("/", headers=headers).status_code for _ in range(5)] == [403] * 5
    assert TestClient(gate, base_url=f"http://{HERE}").get("/").status_code == 200


def test_sockets_are_limited():
    browser = client()
    browser.app.sockets = SOCKETS
    with pytest.raises(WebSocketDisconnect):
        receives(browser)
    browser.app.sockets = SOCKETS - 1
    assert receives(browser) == "rows"
    assert browser.app.sockets == SOCKETS - 1


# --- Who commands --------------------------------------------------------------------------------


def test_the_token_and_one_page_at_a_time():
    guard = Guard(TOKEN)
    assert "Wrong token" in guard.take("a", "wrong")
    assert "Wrong token" in guard.take("a", "")
    assert not guard.commands("a")
    assert guard.take("a", TOKEN) == ""
    assert guard.take("a", TOKEN) == ""
    assert "Another page is in command" in guard.take("b", TOKEN)
    assert guard.commands("a")
    assert not guard.commands("b")
    guard.leave("b")
    assert guard.commands("a")
    guard.leave("a")
    assert guard.take("b", TOKEN) == ""


def test_tokens_differ_and_are_long():
    drawn = {new_token() for _ in range(100)}
    assert len(drawn) == 100
    assert min(map(len, drawn)) >= 22  # 128 bits in base 64


def test_what_a_browser_may_call_us():
    assert set(names("127.0.0.1", 8080)) == {"127.0.0.1:8080", "localhost:8080"}
    assert set(names("192.168.1.5", 80)) == {"192.168.1.5:80"}
    assert bracketed("::1") == "[::1]"


# --- Files ---------------------------------------------------------------------------------------


@pytest.fixture
def folder(tmp_path):
    made = tmp_path / "runs"
    (made / "recordings").mkdir(parents=True)
    (made / "recordings" / "a.mcap").write_text("a")
    (made / "run").mkdir()
    (made / "run" / "recording.csv").write_text("b")
    (made / "2026-11" / "run").mkdir(parents=True)
    (made / "2026-11" / "run" / "recording.csv").write_text("c")
    (tmp_path / "secret.csv").write_text("secret")
    (made / "link.csv").symlink_to(tmp_path / "secret.csv")
    return made


def test_files_within_the_data_folder(folder):
    assert within(folder, "recordings/a.mcap").read_text() == "a"
    kept = {"run/recording.csv", "2026-11/run/recording.csv"}
    assert set(recordings(folder)) == {"recordings/a.mcap", *kept}


def test_of_many_runs_the_last_recordings_are_offered(folder, monkeypatch):
    """Names begin with their time: of months and of runs the last by name come first."""
    monkeypatch.setattr(data_folder, "LAST", 3)
    for name in ("2026-11/0", "2026-12/1", "2026-12/0"):
        (folder / name).mkdir(parents=True)
        (folder / name / "recording.csv").write_text("d")
    offered = {"2026-12/1", "2026-12/0", "2026-11/run"}
    assert set(recordings(folder)) == {
        "recordings/a.mcap", *(f"{name}/recording.csv" for name in offered)}  # fmt: skip


OUTSIDE = ("../secret.csv", "run/../../secret.csv", "/etc/passwd", "link.csv", "missing.csv", "",
           "run", "%2e%2e/secret.csv", "\x00", "a\x00.html", "\x1b[31m", "a\nb", "x" * 300,
           "x/" * 3000, "\ud800")  # fmt: skip


@pytest.mark.parametrize("name", OUTSIDE)
def test_a_path_outside_the_data_folder_is_refused(folder, name):
    with pytest.raises(InputError, match="a file within"):
        within(folder, name)
