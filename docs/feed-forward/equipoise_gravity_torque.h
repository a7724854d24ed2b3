/* Equipoise: the torque of gravity for the feed-forward of an attitude controller.
 *
 * One UDP datagram holds it, little endian. Vectors are x, y, z in body axes, SI units.
 * C99, no heap; copy this file into your firmware. Written by Equipoise from the table of
 * fields on its page "Feed-forward": do not edit.
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

#define EQUIPOISE_MAGIC "EQGT"
#define EQUIPOISE_VERSION 1
#define EQUIPOISE_SIZE 168
#define EQUIPOISE_AT_VERSION 4
#define EQUIPOISE_AT_SIZE 6
#define EQUIPOISE_FADE_S 10.0

enum { EQUIPOISE_NOT_USABLE = 0, EQUIPOISE_USABLE = 1, EQUIPOISE_STALE = 2 }; /* of the field status */

typedef struct {
    char magic[4]; /* the letters "EQGT" */
    uint16_t version; /* of this layout */
    uint16_t size; /* bytes of the whole datagram */
    uint32_t sequence; /* counts datagrams from 0, and starts again after 4294967295 */
    uint32_t status; /* 0 not usable, 1 usable, 2 stale: sensors are silent */
    double bench_time_s; /* bench time of the newest row that it rests on */
    uint64_t host_time_ns; /* when it was sent: UTC, nanoseconds since 1970 */
    double lead_s; /* the torque is that at bench time + lead */
    double hold_s; /* how long a receiver may act on it in full */
    double torque_N_m[3]; /* of gravity, on the platform, about the centre of rotation */
    double torque_sd_N_m[3]; /* one standard deviation of each */
    double first_moment_kg_m[3]; /* mass times centre of mass, masses as they stand */
    double first_moment_sd_kg_m[3]; /* one standard deviation of each */
    double gravity_m_s2[3]; /* gravity, by which the torque is formed */
} equipoise_gravity_torque;

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

/* Decode `length` bytes; nothing is written unless EQUIPOISE_OK is returned. */
static inline int equipoise_decode(const uint8_t *data, size_t length,
                                   equipoise_gravity_torque *found)
{
    if (length < EQUIPOISE_SIZE || memcmp(data, EQUIPOISE_MAGIC, 4) != 0) return EQUIPOISE_NOT_OURS;
    if (equipoise_whole(data + EQUIPOISE_AT_VERSION, 2) != EQUIPOISE_VERSION
        || equipoise_whole(data + EQUIPOISE_AT_SIZE, 2) != length) return EQUIPOISE_OTHER_VERSION;
    if (!equipoise_is_finite(data + 16)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 32)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 40)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 48)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 56)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 64)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 72)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 80)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 88)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 96)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 104)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 112)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 120)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 128)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 136)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 144)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 152)) return EQUIPOISE_NOT_FINITE;
    if (!equipoise_is_finite(data + 160)) return EQUIPOISE_NOT_FINITE;
    memcpy(found->magic, data + 0, 4);
    found->version = (uint16_t)equipoise_whole(data + 4, 2);
    found->size = (uint16_t)equipoise_whole(data + 6, 2);
    found->sequence = (uint32_t)equipoise_whole(data + 8, 4);
    found->status = (uint32_t)equipoise_whole(data + 12, 4);
    found->bench_time_s = equipoise_double(data + 16);
    found->host_time_ns = (uint64_t)equipoise_whole(data + 24, 8);
    found->lead_s = equipoise_double(data + 32);
    found->hold_s = equipoise_double(data + 40);
    for (int k = 0; k < 3; ++k)
        found->torque_N_m[k] = equipoise_double(data + 48 + 8 * k);
    for (int k = 0; k < 3; ++k)
        found->torque_sd_N_m[k] = equipoise_double(data + 72 + 8 * k);
    for (int k = 0; k < 3; ++k)
        found->first_moment_kg_m[k] = equipoise_double(data + 96 + 8 * k);
    for (int k = 0; k < 3; ++k)
        found->first_moment_sd_kg_m[k] = equipoise_double(data + 120 + 8 * k);
    for (int k = 0; k < 3; ++k)
        found->gravity_m_s2[k] = equipoise_double(data + 144 + 8 * k);
    return EQUIPOISE_OK;
}

/* Whether to act on a datagram from now on, in the place of the last: it is usable and newer, or
 * the last holds no more, since the sender may have restarted. */
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
