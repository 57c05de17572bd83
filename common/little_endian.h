/* Numbers of binary files, lowest byte first, taken apart and put together byte by byte so that files are the
 * same on any machine. Each put_...() returns the place behind what it has put. */
#ifndef COMMON_LITTLE_ENDIAN_H
#define COMMON_LITTLE_ENDIAN_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* The low `size` bytes of bits. */
static inline unsigned char *put_bits(unsigned char *to, uint64_t bits, size_t size)
{
    for (size_t i = 0; i < size; i++)
        to[i] = (unsigned char)(bits >> 8 * i);
    return to + size;
}

/* The number of `size` bytes, at most 8. */
static inline uint64_t get_bits(const unsigned char *from, size_t size)
{
    uint64_t bits = 0;
    for (size_t i = 0; i < size; i++)
        bits |= (uint64_t)from[i] << 8 * i;
    return bits;
}

static inline unsigned char *put_float(unsigned char *to, double value)
{
    const float single = (float)value;
    uint32_t bits;
    memcpy(&bits, &single, sizeof bits);
    return put_bits(to, bits, sizeof bits);
}

static inline unsigned char *put_double(unsigned char *to, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return put_bits(to, bits, sizeof bits);
}

#endif
