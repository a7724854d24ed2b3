"""The C header, compiled: it decodes to the last bit, and refuses and fades as Python does."""

import shutil
import subprocess

import numpy as np
import pytest

from equipoise.io.stream.c_header import HEADER, header
from equipoise.io.stream.gravity_datagram import FIELDS, packed, replaces, unpacked, weight_at
from equipoise.model.gravity_torque import GravityTorque, TorqueStatus

COMPILER = shutil.which("gcc") or shutil.which("cc")
pytestmark = pytest.mark.skipif(COMPILER is None, reason="there is no C compiler here")
STRICT = ["-std=c99", "-Wall", "-Wextra", "-Wconversion", "-Werror", "-pedantic", "-O2"]
SENT_NS = 1_790_000_000_123_456_789
FORMATS = {"char": "%c", "uint16_t": "%u", "uint32_t": "%lu", "uint64_t": "%llu", "double": "%a"}
CASTS = {"uint32_t": "(unsigned long)", "uint64_t": "(unsigned long long)"}


def printed_field(field):
    form, cast = FORMATS[field.c_type], CASTS.get(field.c_type, "")
    if field.elements == 1:
        return f'printf("{field.name} {form}\\n", {cast}found.{field.name});'
    each = f'printf(" {form}", {cast}found.{field.name}[k]);'
    return (f'printf("{field.name}"); for (int k = 0; k < {field.elements}; ++k) {each} '
            'printf("\\n");')  # fmt: skip


PROGRAM = f"""
#include <stdio.h>
#include <stdlib.h>
#include "{HEADER}"

/* Arguments: age (s), gravity x y z. On stdin datagrams, each after its length in two bytes. */
int main(int count, char **words)
{{
    static equipoise_gravity_torque last, found;
    static uint8_t data[4096];
    double gravity[3], torque[3];
    const double age = atof(words[1]);
    if (count < 5) return 2;
    for (int k = 0; k < 3; ++k) gravity[k] = atof(words[2 + k]);
    for (int head; (head = getchar()) != EOF;) {{
        const size_t length = (size_t)head + 256 * (size_t)getchar();
        if (fread(data, 1, length, stdin) != length) return 3;
        const int code = equipoise_decode(data, length, &found);
        const int taken = code == EQUIPOISE_OK && equipoise_replaces(&found, &last, age);
        printf("code %d taken %d\\n", code, taken);
        if (code != EQUIPOISE_OK) continue;
        {"".join(map(printed_field, FIELDS))}
        if (taken) last = found;
        equipoise_torque(&last, age, gravity, torque);
        printf("acted_on %a %a %a\\n", torque[0], torque[1], torque[2]);
    }}
    return 0;
}}
"""


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    folder = tmp_path_factory.mktemp("header")
    (folder / HEADER).write_text(header())
    (folder / "main.c").write_text(PROGRAM)
    built = folder / "main"
    subprocess.run([COMPILER, *STRICT, "-o", built, folder / "main.c"], check=True, timeout=60)
    return built


def ran(program, datagrams, age=0.0, gravity=(0.0, 0.0, -9.81)):
    """Return what the program prints of each datagram, as words by their first."""
    given = b"".join(len(data).to_bytes(2, "little") + data for data in datagrams)
    words = [str(program), repr(age), *map(repr, gravity)]
    done = subprocess.run(words, input=given, capture_output=True, check=True, timeout=60)
    blocks = done.stdout.decode().split("code ")[1:]
    return [
        {name: rest for name, *rest in map(str.split, f"code {block}".splitlines())}
        for block in blocks
    ]


def content(seed, status=TorqueStatus.USABLE):
    """Return numbers of every size, minus zero and the least there is among them."""
    rng = np.random.default_rng(seed)
    numbers = rng.normal(size=(5, 3)) * 10.0 ** rng.integers(-12, 3, (5, 3))
    numbers[0, 0], numbers[1, 1] = -0.0, 5e-324
    return GravityTorque(float(rng.uniform(0, 1e5)), 0.0625, *numbers, status)


def test_every_field_is_decoded_to_the_last_bit(program):
    sent = [content(seed, TorqueStatus(seed % 3)) for seed in range(20)]
    found = ran(program, [packed(each, k, SENT_NS + k) for k, each in enumerate(sent)])
    assert len(found) == len(sent)
    for k, (each, shown) in enumerate(zip(sent, found, strict=True)):
        numbers = {
            name: [float.fromhex(word) for word in words]
            for name, words in shown.items()
            if name.endswith(("_s", "_m", "s2"))
        }
        assert shown["code"][0] == "0"
        assert shown["magic"] == list("EQGT")
        whole = {"version": 1, "size": 168, "sequence": k, "status": each.status,
                 "host_time_ns": SENT_NS + k}  # fmt: skip
        assert {name: int(shown[name][0]) for name in whole} == whole
        expected = (
            [each.t], [each.lead], [2.0], each.torque, each.torque_sd, each.first_moment,
            each.first_moment_sd, each.gravity,
        )  # fmt: skip
        assert len(numbers) == len(expected)
        for got, wanted in zip(numbers.values(), expected, strict=True):
            assert np.array(got).tobytes() == np.array(wanted).tobytes()


def test_the_torque_acted_on_is_the_weighted_cross_product(program):
    given, gravity = content(1), (0.5, -0.7, -9.78)
    for age in (0.0, 3.0, 7.0, 20.0):
        (shown,) = ran(program, [packed(given, 0, SENT_NS)], age, gravity)
        got = [float.fromhex(word) for word in shown["acted_on"]]
        expected = weight_at(age, 2.0) * np.cross(given.first_moment, gravity)
        assert got == pytest.approx(expected, rel=1e-15, abs=1e-30)


@pytest.mark.parametrize("age", [0.1, 2.5])
def test_it_takes_what_python_takes(program, age):
    """Numbers that go back, repeat, and pass the end of 32 bits, usable or not."""
    given = [(5, 1), (5, 1), (4, 1), (6, 2), (7, 0), (8, 1), (2**31 + 8, 1), (2**32 - 1, 1), (0, 1)]
    datagrams = [packed(content(2, TorqueStatus(status)), k, SENT_NS) for k, status in given]
    shown = [each["code"][2] == "1" for each in ran(program, datagrams, age)]
    last, expected = None, []
    for data in datagrams:
        found = unpacked(data)
        expected.append(replaces(found, last, age))
        last = found if expected[-1] else last
    assert shown == expected
    assert {True, False} == set(shown)


def test_it_refuses_what_python_refuses(program):
    whole = packed(content(3), 0, SENT_NS)
    infinite = whole[:48] + np.array([np.inf]).tobytes() + whole[56:]
    no_lead = whole[:32] + np.array([np.nan]).tobytes() + whole[40:]
    spoilt = [b"", whole[:-1], b"XXXX" + whole[4:], whole + b"\0", infinite, no_lead]
    spoilt.append(whole[:4] + b"\2\0" + whole[6:])
    codes = [each["code"][0] for each in ran(program, spoilt)]
    assert codes == ["1", "1", "1", "2", "3", "3", "2"]
