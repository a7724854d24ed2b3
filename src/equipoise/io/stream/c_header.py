"""The header in C99 that decodes the datagram of the gravity torque, written from its fields.

It needs no heap, no library beside memcpy and no byte order of its own.
"""

from equipoise.io.stream.gravity_datagram import (
    FADE,
    FIELDS,
    MAGIC,
    OFFSETS,
    SIZE,
    VERSION,
    Field,
)
from equipoise.model.gravity_torque import TorqueStatus

HEADER = "equipoise_gravity_torque.h"
WIDTHS = {"H": 2, "I": 4, "Q": 8}
TABLE_HEAD = ("offset", "bytes", "field", "type", "meaning")

TOP = """\
/* Equipoise: the torque of gravity for the feed-forward of an attitude controller.
 *
 * One UDP datagram holds it, little endian. Vectors are x, y, z in body axes, SI units.
 * C99, no heap; copy this file into your firmware. Written from the table of fields in
 * equipoise.io.stream.gravity_datagram: do not edit.
 *
 *     static equipoise_gravity_torque last, found;        (all zero before the first)
 *     if (equipoise_decode(data, length, &found) == EQUIPOISE_OK
 *         && equipoise_replaces(&found, &last, age_s)) { last = found; age_s = 0; }
 *     equipoise_torque(&last, age_s, gravity, torque);
 *     command = your_controller() - torque;               (N m, on the platform)
 *
 * `age_s` is the time since the last usable datagram arrived, by your own clock: the clocks of two
 * computers differ. When the stream stops, equipoise_torque holds the first moment for hold_s and
 * then fades to nothing in EQUIPOISE_FADE_S, so that your controller meets no step.
 * UDP carries a checksum of its own; over a bare serial line add one. A double has to have 8 bytes,
 * which it has not on AVR.
 */
#ifndef EQUIPOISE_GRAVITY_TORQUE_H
#define EQUIPOISE_GRAVITY_TORQUE_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef char equipoise_double_has_8_bytes[sizeof(double) == 8 ? 1 : -1];
"""

BODY = """\
/* What equipoise_decode returns. */
enum { EQUIPOISE_OK = 0, EQUIPOISE_NOT_OURS = 1, EQUIPOISE_OTHER_VERSION = 2,
       EQUIPOISE_NOT_FINITE = 3 };

static inline uint64_t equipoise_whole(const uint8_t *data, int bytes)
{
    uint64_t found = 0;
    for (int k = bytes - 1; k >= 0; --k) found = (found << 8) | data[k];
    return found;
}

static inline double equipoise_double(const uint8_t *data)
{
    const uint64_t bits = equipoise_whole(data, 8);
    double found;
    memcpy(&found, &bits, sizeof found);
    return found;
}

/* Not infinite and not NaN, whatever the compiler makes of fast mathematics. */
static inline int equipoise_is_finite(const uint8_t *data)
{
    return ((equipoise_whole(data, 8) >> 52) & 0x7ff) != 0x7ff;
}
"""

END = """\
/* Whether to act on a datagram from now on, in the place of the last: it is usable and newer, or
 * the last holds no more, since the sender may have begun anew. */
static inline int equipoise_replaces(const equipoise_gravity_torque *found,
                                     const equipoise_gravity_torque *last, double age_s)
{
    const uint32_t ahead = found->sequence - last->sequence;
    if (found->status != EQUIPOISE_USABLE) return 0;
    return last->status != EQUIPOISE_USABLE || age_s > last->hold_s
           || (ahead != 0 && ahead < UINT32_C(0x80000000));
}

/* The share to act on, 0 to 1, `age_s` after the last usable datagram arrived. */
static inline double equipoise_weight(double age_s, double hold_s)
{
    const double share = 1.0 - (age_s - hold_s) / EQUIPOISE_FADE_S;
    return share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
}

/* The torque of gravity, N m, weighted by its age: first moment x gravity (m/s^2, body axes, from
 * your own attitude; level it is 0, 0, -9.81). */
static inline void equipoise_torque(const equipoise_gravity_torque *last, double age_s,
                                    const double gravity_m_s2[3], double torque_N_m[3])
{
    const double share = last->status == EQUIPOISE_USABLE
                             ? equipoise_weight(age_s, last->hold_s) : 0.0;
    const double *mu = last->first_moment_kg_m, *g = gravity_m_s2;
    torque_N_m[0] = share * (mu[1] * g[2] - mu[2] * g[1]);
    torque_N_m[1] = share * (mu[2] * g[0] - mu[0] * g[2]);
    torque_N_m[2] = share * (mu[0] * g[1] - mu[1] * g[0]);
}

#endif
"""


def header() -> str:
    """Return the whole header."""
    return "\n".join((TOP, _constants(), _structure(), BODY, _decode(), END))


def table() -> str:
    """Return the fields as a table in Markdown."""
    rows = [
        (str(offset), str(each.size), f"`{each.name}`", _type(each), each.meaning)
        for each, offset in zip(FIELDS, OFFSETS, strict=True)
    ]
    lines = [TABLE_HEAD, tuple("---" for _ in TABLE_HEAD), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _type(field: Field) -> str:
    return field.c_type if field.elements == 1 else f"{field.c_type}[{field.elements}]"


def _constants() -> str:
    statuses = ", ".join(f"EQUIPOISE_{each.name} = {each.value}" for each in TorqueStatus)
    return (
        f"#define EQUIPOISE_VERSION {VERSION}\n"
        f"#define EQUIPOISE_SIZE {SIZE}\n"
        f"#define EQUIPOISE_FADE_S {FADE}\n\n"
        f"enum {{ {statuses} }}; /* of the field status */\n"
    )


def _structure() -> str:
    lines = [
        f"    {each.c_type} {each.name}{'' if each.elements == 1 else f'[{each.elements}]'};"
        f" /* {each.meaning} */\n"
        for each in FIELDS
    ]
    return f"typedef struct {{\n{''.join(lines)}}} equipoise_gravity_torque;\n"


def _decode() -> str:
    """Return the function that decodes: checks first, then a line for each field."""
    text = MAGIC.decode()
    taken = "".join(map(_taken, FIELDS, OFFSETS))
    first = next(at for each, at in zip(FIELDS, OFFSETS, strict=True) if each.name == "torque_N_m")
    numbers = [at for each, at in zip(FIELDS, OFFSETS, strict=True) if each.code == "d"]
    alone = "".join(
        f"    if (!equipoise_is_finite(data + {at})) return EQUIPOISE_NOT_FINITE;\n"
        for at in numbers
        if at < first
    )
    return f"""\
/* Decode `length` bytes; nothing is written unless EQUIPOISE_OK is returned. */
static inline int equipoise_decode(const uint8_t *data, size_t length,
                                   equipoise_gravity_torque *found)
{{
    if (length < EQUIPOISE_SIZE || memcmp(data, "{text}", 4) != 0) return EQUIPOISE_NOT_OURS;
    if (equipoise_whole(data + {_at("version")}, 2) != EQUIPOISE_VERSION
        || equipoise_whole(data + {_at("size")}, 2) != length) return EQUIPOISE_OTHER_VERSION;
{alone}    for (int at = {first}; at < EQUIPOISE_SIZE; at += 8)
        if (!equipoise_is_finite(data + at)) return EQUIPOISE_NOT_FINITE;
{taken}    return EQUIPOISE_OK;
}}
"""


def _at(name: str) -> int:
    return OFFSETS[[each.name for each in FIELDS].index(name)]


def _taken(field: Field, offset: int) -> str:
    if field.code == "4s":
        return f"    memcpy(found->{field.name}, data + {offset}, {field.size});\n"
    if field.code in WIDTHS:
        width = WIDTHS[field.code]
        return (
            f"    found->{field.name} = "
            f"({field.c_type})equipoise_whole(data + {offset}, {width});\n"
        )
    if field.count == 1:
        return f"    found->{field.name} = equipoise_double(data + {offset});\n"
    return (
        f"    for (int k = 0; k < {field.count}; ++k)\n"
        f"        found->{field.name}[k] = equipoise_double(data + {offset} + 8 * k);\n"
    )
