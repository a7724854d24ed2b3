"""Who may speak with the dashboard: by host, origin, token, size; and who commands."""

from urllib.parse import urlencode

import pytest
from starlette.applications import Starlette
from starlette.responses import PlainTextResponse
from starlette.routing import Route, WebSocketRoute
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from equipoise.app.dashboard.protocol.data_folder import recordings, within
from equipoise.app.dashboard.server.authorisation import Guard, new_token
from equipoise.app.dashboard.server.gate import LARGEST, Doors, Gate
from equipoise.app.dashboard.server.session import bracketed, names
from equipoise.model.errors import InputError

HERE, TOKEN = "127.0.0.1:8080", "the-token"


async def page(request):
    return PlainTextResponse(f"{len(await request.body())} bytes")


async def live(socket):
    await socket.accept()
    await socket.send_text("rows")
    await socket.close()


def client(exposed=False, host=HERE):
    routes = [Route("/", page, methods=["GET", "POST"]), WebSocketRoute("/live", live)]
    doors = Doors(frozenset({HERE, "localhost:8080"}), exposed)
    gate = Gate(Starlette(routes=routes), doors, Guard(TOKEN))
    return TestClient(gate, base_url=f"http://{host}", raise_server_exceptions=False)


def receives(client, headers=None, query=""):
    with client.websocket_connect(f"ws://{client.base_url.netloc.decode()}/live{query}",
                                  headers=headers or {}) as socket:  # fmt: skip
        return socket.receive_text()


def test_a_request_to_our_own_address_is_admitted():
    for host in (HERE, "localhost:8080"):
        assert client(host=host).get("/").status_code == 200
        assert receives(client(host=host), {"origin": f"http://{host}"}) == "rows"


def test_another_name_for_us_is_refused():
    """A foreign page may have its own name lead to 127.0.0.1."""
    for host in ("evil.example:8080", "127.0.0.1:9999", "127.0.0.1"):
        answer = client(host=host).get("/")
        assert answer.status_code == 403
        assert "not at" in answer.json()["refused"]


FOREIGN = ("http://evil.example", "https://127.0.0.1:8080", "null", "http://127.0.0.1:8081",
           "http://127.0.0.1:8080.evil.example")  # fmt: skip


@pytest.mark.parametrize("origin", FOREIGN)
def test_a_foreign_origin_is_refused(origin):
    assert client().get("/", headers={"origin": origin}).status_code == 403
    with pytest.raises(WebSocketDisconnect) as refused:
        receives(client(), {"origin": origin})
    assert refused.value.code == 1008


def test_beyond_loopback_a_socket_needs_an_origin():
    query = "?" + urlencode({"token": TOKEN})
    assert receives(client(), {}) == "rows"
    with pytest.raises(WebSocketDisconnect):
        receives(client(exposed=True), {}, query)
    assert receives(client(exposed=True), {"origin": f"http://{HERE}"}, query) == "rows"


@pytest.mark.parametrize("query", ["", "?token=", "?token=wrong", "?other=1"])
def test_beyond_loopback_nothing_is_served_without_the_token(query):
    assert client(exposed=True).get("/" + query).status_code == 401
    with pytest.raises(WebSocketDisconnect):
        receives(client(exposed=True), {"origin": f"http://{HERE}"}, query)


def test_the_token_is_kept_in_a_cookie():
    browser = client(exposed=True)
    answer = browser.get("/", params={"token": TOKEN})
    assert answer.status_code == 200
    cookie = answer.headers["set-cookie"]
    assert "HttpOnly" in cookie
    assert "SameSite=Strict" in cookie
    assert browser.get("/").status_code == 200
    assert client(exposed=True).get("/", headers={"cookie": "equipoise_token=x"}).status_code == 401


def test_a_request_that_is_too_large_is_refused():
    assert client().post("/", content=bytes(LARGEST)).text == f"{LARGEST} bytes"
    assert client().post("/", content=bytes(LARGEST + 1)).status_code == 413


def test_a_request_that_does_not_say_how_large_it_is_is_cut_off():
    def pieces():
        for _ in range(3 * LARGEST // 1000):
            yield bytes(1000)

    assert client().post("/", content=pieces()).status_code != 200


def test_nothing_from_outside_is_allowed_into_the_page():
    policy = client().get("/").headers["content-security-policy"]
    assert "default-src 'self'" in policy
    assert "http" not in policy
    assert "frame-ancestors 'none'" in policy


# --- Who commands --------------------------------------------------------------------------------


def test_the_token_and_one_page_at_a_time():
    guard = Guard(TOKEN)
    assert "not the token" in guard.take("a", "wrong")
    assert "not the token" in guard.take("a", "")
    assert not guard.commands("a")
    assert guard.take("a", TOKEN) == ""
    assert guard.take("a", TOKEN) == ""
    assert "Another page commands" in guard.take("b", TOKEN)
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
    (tmp_path / "secret.csv").write_text("secret")
    (made / "link.csv").symlink_to(tmp_path / "secret.csv")
    return made


def test_files_within_the_data_folder(folder):
    assert within(folder, "recordings/a.mcap").read_text() == "a"
    assert set(recordings(folder)) == {"recordings/a.mcap", "run/recording.csv"}


OUTSIDE = ("../secret.csv", "run/../../secret.csv", "/etc/passwd", "link.csv", "missing.csv", "",
           "run", "%2e%2e/secret.csv")  # fmt: skip


@pytest.mark.parametrize("name", OUTSIDE)
def test_a_path_outside_the_data_folder_is_refused(folder, name):
    with pytest.raises(InputError, match="a file within"):
        within(folder, name)
