#include "common/crc.h"

/* The remainder of each byte; the polynomial of ISO 3309 with its lowest power first. */
static void make_table(uint32_t table[256])
{
    for (uint32_t byte = 0; byte < 256; byte++) {
        uint32_t remainder = byte;
        for (int bit = 0; bit < 8; bit++)
            remainder = remainder & 1 ? 0xedb88320u ^ remainder >> 1 : remainder >> 1;
        table[byte] = remainder;
    }
}

uint32_t crc32_bytes(uint32_t crc, const void *data, size_t size)
{
    uint32_t table[256];
    make_table(table);
    const unsigned char *byte = data;
    crc = ~crc;
    for (size_t i = 0; i < size; i++)
        crc = table[(crc ^ byte[i]) & 0xff] ^ crc >> 8;
    return ~crc;
}
